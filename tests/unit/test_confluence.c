/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A box whose edges and corners are all rounded: no crease tells where its vertices are. */
#include "given_models.h"

#include "topology/assembly.h"

static const double S = 1.0 / 16, RADIUS = 0.4;
static const double HALF[3] = {1.2, 1.0, 0.8}; /* of the box between the roundings */

/* The number of the face on the side where sign is 1, -1 or 0: six planes, twelve cylinders, eight
 * spheres. */
static int32_t face_at(const int sign[3])
{
    int32_t number = 0;
    for (int kind = 1; kind <= 3; kind++)
        for (int code = 0; code < 27; code++) {
            const int at[3] = {code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1};
            if (abs(at[0]) + abs(at[1]) + abs(at[2]) != kind)
                continue;
            if (at[0] == sign[0] && at[1] == sign[1] && at[2] == sign[2])
                return number;
            number++;
        }
    return -1;
}

static crease_model model_at(const int sign[3])
{
    double place[3], along[3];
    const int kind = abs(sign[0]) + abs(sign[1]) + abs(sign[2]);
    for (int c = 0; c < 3; c++) {
        place[c] = sign[c] * (HALF[c] + (kind == 1 ? RADIUS : 0.0));
        along[c] = kind == 1 ? sign[c] : sign[c] == 0;
    }
    if (kind == 1)
        return given_plane(place, along);
    const double up[3] = {0, 0, 1};
    return kind == 2 ? given_model(CREASE_REGION_CYLINDER, place, along, RADIUS, 0)
                     : given_model(CREASE_REGION_SPHERE, place, up, RADIUS, 0);
}

static given_body rounded_box(void)
{
    given_body body = {.size = 2};
    for (int32_t number = 0; number < 26; number++)
        for (int code = 0; code < 27; code++) {
            const int sign[3] = {code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1};
            if (face_at(sign) == number)
                given_add(&body, model_at(sign));
        }
    return body;
}

/* Even points: of random ones on the surface those that are not near an earlier one. */
static given_points points_on_it(double sigma)
{
    given_points out = {0, 0, NULL, NULL};
    for (uint64_t draw = 0; draw < 100000; draw++) {
        double place[3], from[3], length = 0.0;
        int sign[3];
        bool apart = true;
        for (int c = 0; c < 3; c++) {
            place[c] =
                (HALF[c] + 1.1 * RADIUS) * (2 * crease_random_uniform(3, (uint64_t)c, draw) - 1);
            sign[c] = place[c] > HALF[c] ? 1 : place[c] < -HALF[c] ? -1 : 0;
            from[c] = sign[c] ? sign[c] * HALF[c] : place[c];
            length += (place[c] - from[c]) * (place[c] - from[c]);
        }
        length = sqrt(length);
        if (fabs(length - RADIUS) > 0.1 * RADIUS)
            continue;
        const double to = RADIUS + sigma * crease_random_normal(3, 4, draw);
        for (int c = 0; c < 3; c++)
            place[c] = from[c] + to / length * (place[c] - from[c]);
        for (size_t i = 0; i < out.count && apart; i++)
            apart = crease_vector_distance(out.points + 3 * i, place) > 0.7 * S;
        if (apart)
            given_point(&out, place, face_at(sign));
    }
    return out;
}

static void check_rounded_box(double sigma, double near)
{
    const given_body body = rounded_box();
    crease_context *const context = given_context();
    crease_regions *const regions = given_regions(context, &body, points_on_it(sigma), S, sigma);
    crease_topology *t = NULL;
    assert_int_equal(crease_topology_find(context, regions, false, &t), CREASE_OK);
    assert_int_equal(t->face_count, 26);
    assert_int_equal(t->edge_count, 48);
    size_t used = 0;
    for (size_t v = 0; v < t->vertex_count; v++) {
        size_t ends = 0;
        for (size_t e = 0; e < t->edge_count; e++)
            for (int w = 0; w < 2; w++)
                ends += t->edges[e].vertices[w] == (int32_t)v ? 1U : 0U;
        if (ends == 0)
            continue;
        assert_int_equal(ends, 4);
        used++;
        /* beside the end of an edge of the box that is left between two corners */
        size_t away = 0;
        for (int c = 0; c < 3; c++)
            away += fabs(fabs(t->vertices[v].place[c]) - HALF[c]) > near ? 1U : 0U;
        assert_int_equal(away, 1);
    }
    assert_int_equal(used, 24);
    crease_topology_free(t);
    given_regions_free(regions);
    crease_context_free(context);
}

static void given_rounded_box_when_found_then_four_smooth_edges_at_each_vertex(void **state)
{
    (void)state;
    check_rounded_box(0.0, 0.1 * S);
}

static void given_noise_when_found_then_the_same_vertices(void **state)
{
    (void)state;
    check_rounded_box(0.1 * S, 0.5 * S);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_rounded_box_when_found_then_four_smooth_edges_at_each_vertex),
        cmocka_unit_test(given_noise_when_found_then_the_same_vertices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
