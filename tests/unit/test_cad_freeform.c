/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Parts with free forms that run all the way round. */
#define _XOPEN_SOURCE 700 /* mkdtemp, nftw */

#include "given_cad.h"

#include "base/random.h"

enum { AROUND = 130, UP = 30, ACROSS = 54 };

static const double S = 0.025;

/* Distance of a vase's wall from its axis. */
static double wall(double angle, double z)
{
    return 0.5 * (1 + 0.12 * cos(3 * angle + z) + 0.15 * sin(2 * z));
}

/* By its sections, which are exact. */
static double volume_of_vase(double height)
{
    const double pi = acos(-1.0);
    double volume = 0;
    for (int k = 0; k < 1000; k++)
        for (int i = 0; i < 100; i++) {
            const double r = wall(2 * pi * i / 100, height * (k + 0.5) / 1000);
            volume += 0.5 * r * r * (2 * pi / 100) * (height / 1000);
        }
    return volume;
}

typedef struct vase {
    size_t count;
    double (*points)[3];
    double sigma;
} vase;

static void add(vase *v, const double place[3], const double normal[3])
{
    const double off = v->sigma * crease_random_normal(3, 9, v->count);
    for (int c = 0; c < 3; c++)
        v->points[v->count][c] = place[c] + off * normal[c];
    v->count++;
}

static double draw(const vase *v, uint64_t stream)
{
    return crease_random_uniform(3, stream, v->count);
}

/* The share of a turn that is there; a whole one has a bottom and a lid. */
static vase given_vase(double turn, double sigma)
{
    const double tau = 2 * acos(-1.0), height = UP * S;
    vase v = {
        .points = malloc((AROUND * UP + 2 * ACROSS * ACROSS) * sizeof *v.points), .sigma = sigma};
    for (int i = 0; i < AROUND * turn; i++)
        for (int k = 0; k < UP; k++) {
            const double angle = tau * (i + draw(&v, 1)) / AROUND, z = S * (k + draw(&v, 2));
            const double r = wall(angle, z);
            add(&v, (double[]){r * cos(angle), r * sin(angle), z},
                (double[]){cos(angle), sin(angle), 0});
        }
    for (int cell = 0; cell < 2 * ACROSS * ACROSS && turn == 1; cell++) {
        const double z = cell < ACROSS * ACROSS ? 0 : height;
        const double x = S * (cell % ACROSS - ACROSS / 2 + draw(&v, 1));
        const double y = S * (cell / ACROSS % ACROSS - ACROSS / 2 + draw(&v, 2));
        if (hypot(x, y) < wall(atan2(y, x), z))
            add(&v, (double[]){x, y, z}, (double[]){0, 0, 1});
    }
    return v;
}

typedef struct scene {
    crease_context *context;
    crease_cloud *cloud;
    crease_regions *regions;
    crease_part *part;
} scene;

static scene when_divided(vase v)
{
    scene s = {.context = given_context_with_threads(1)};
    s.cloud = given_cloud_of(s.context, v.points[0], v.count);
    assert_int_equal(crease_regions_find(s.context, s.cloud, NULL, &s.regions), CREASE_OK);
    free(v.points);
    return s;
}

static void end(scene *s)
{
    crease_part_free(s->part);
    crease_regions_free(s->regions);
    crease_cloud_free(s->cloud);
    crease_context_free(s->context);
}

static void then_a_solid(scene *s, size_t faces, double volume)
{
    crease_cad_info info;
    if (crease_part_build(s->context, s->cloud, s->regions, NULL, NULL, &s->part) != CREASE_OK)
        fail_msg("%s", crease_context_message(s->context));
    if (crease_part_state_of(s->part) != CREASE_PART_SOLID)
        fail_msg("%s", crease_part_message(s->part));
    assert_int_equal(crease_part_face_count(s->part), faces);
    assert_near(crease_part_volume(s->part), volume, 1e-3 * volume);
    assert_int_equal(crease_part_write(s->context, s->part, in_folder("vase.step")), CREASE_OK);
    assert_int_equal(crease_cad_info_read(s->context, in_folder("vase.step"), &info), CREASE_OK);
    assert_true(info.valid);
    assert_int_equal(info.closed_shells, 1);
    assert_int_equal(info.free_edges, 0);
    assert_int_equal(info.faces, faces);
}

/* Two rims and a seam. */
static void given_a_vase_then_its_wall_is_one_face(void **state)
{
    scene s = when_divided(given_vase(1, 0));
    then_a_solid(&s, 3, volume_of_vase(UP * S));
    end(&s);
}

static void given_a_noisy_vase_then_its_wall_is_one_region(void **state)
{
    scene s = when_divided(given_vase(1, 0.25 * S));
    assert_int_equal(crease_regions_count(s.regions), 3);
    assert_int_equal(crease_regions_at(s.regions, 0).type, CREASE_REGION_FREEFORM);
    end(&s);
}

/* Half an ellipsoid: no height over a plane, and no axis to run round. */
static void given_a_dome_then_two_faces(void **state)
{
    const double pi = acos(-1.0), axes[3] = {0.6, 0.4, 0.35};
    vase v = {.points = malloc(AROUND * AROUND * sizeof *v.points)};
    for (int i = 0; i < 4000; i++) {
        const double u = 2 * pi * draw(&v, 1), z = draw(&v, 2), r = sqrt(1 - z * z);
        add(&v, (double[]){axes[0] * r * cos(u), axes[1] * r * sin(u), axes[2] * z},
            (double[]){0, 0, 1});
    }
    for (int i = 0; i < 2400; i++) {
        const double u = 2 * pi * draw(&v, 1), r = sqrt(draw(&v, 2));
        add(&v, (double[]){axes[0] * r * cos(u), axes[1] * r * sin(u), 0}, (double[]){0, 0, 1});
    }
    scene s = when_divided(v);
    then_a_solid(&s, 2, 2 * pi / 3 * axes[0] * axes[1] * axes[2]);
    end(&s);
}

/* A body without any edge: two halves that are nearly one surface where they meet. */
static void given_an_ellipsoid_then_two_halves_with_a_common_ring(void **state)
{
    const double pi = acos(-1.0), axes[3] = {0.6, 0.4, 0.35};
    vase v = {.points = malloc(AROUND * AROUND * sizeof *v.points)};
    for (int i = 0; i < 5000; i++) {
        const double u = 2 * pi * draw(&v, 1), z = 2 * draw(&v, 2) - 1, r = sqrt(1 - z * z);
        add(&v, (double[]){axes[0] * r * cos(u), axes[1] * r * sin(u), axes[2] * z},
            (double[]){0, 0, 1});
    }
    scene s = when_divided(v);
    then_a_solid(&s, 2, 4 * pi / 3 * axes[0] * axes[1] * axes[2]);
    end(&s);
}

/* It turns too far for a height over a plane. */
static void given_most_of_a_wall_then_one_free_form(void **state)
{
    scene s = when_divided(given_vase(0.7, 0.1 * S));
    assert_int_equal(crease_regions_count(s.regions), 1);
    assert_int_equal(crease_regions_at(s.regions, 0).type, CREASE_REGION_FREEFORM);
    assert_true(crease_regions_at(s.regions, 0).rms < 0.15 * S);
    end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_a_vase_then_its_wall_is_one_face),
        cmocka_unit_test(given_a_noisy_vase_then_its_wall_is_one_region),
        cmocka_unit_test(given_a_dome_then_two_faces),
        cmocka_unit_test(given_an_ellipsoid_then_two_halves_with_a_common_ring),
        cmocka_unit_test(given_most_of_a_wall_then_one_free_form),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
