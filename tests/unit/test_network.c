/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Creases between regions whose models are exact, so that every number is known. */
#include "given_models.h"

#include "base/frame.h"
#include "crease/spur.h"

static const double S = 1.0 / 24;

/* Everything that a test looks at. */
typedef struct world {
    crease_context *context;
    crease_regions *regions;
    crease_network *network;
} world;

static crease_network *network_of(
    crease_context *context, const crease_regions *regions, const crease_network_options *options)
{
    crease_network *network = NULL;
    if (crease_network_find(context, regions, options, &network) != CREASE_OK)
        fail_msg("%s", crease_context_message(context));
    return network;
}

static world world_of_points(const given_body *body, given_points points, double s, double sigma)
{
    world w = {given_context(), NULL, NULL};
    w.regions = given_regions(w.context, body, points, s, sigma);
    w.network = network_of(w.context, w.regions, NULL);
    return w;
}

static world world_of(const given_body *body, double s, double sigma)
{
    return world_of_points(body, given_sample(body, s, sigma, 5), s, sigma);
}

static void end_world(world *w)
{
    crease_network_free(w->network);
    given_regions_free(w->regions);
    crease_context_free(w->context);
}

/* Calls a function with 101 places of each curve. */
static void along_curves(const crease_network *network,
    void (*check)(const double place[3], const double *given), const double *given)
{
    for (size_t i = 0; i < crease_network_count(network); i++)
        for (int k = 0; k <= 100; k++) {
            const crease_curve *curve = crease_network_curves(network)[i];
            double domain[2], place[3];
            crease_curve_domain(curve, domain);
            crease_curve_evaluate(
                curve, domain[0] + (domain[1] - domain[0]) * k / 100, CREASE_SIDE_RIGHT, 0, place);
            check(place, given);
        }
}

/* The ends of all creases that have corners are those corners, exactly. */
static void check_ends(const crease_network *network)
{
    for (size_t i = 0; i < crease_network_count(network); i++) {
        const crease_network_crease crease = crease_network_at(network, i);
        const crease_curve *curve = crease_network_curves(network)[i];
        double domain[2], place[3];
        crease_curve_domain(curve, domain);
        assert_true(crease.regions[0] < crease.regions[1]);
        for (int end = 0; end < 2; end++) {
            if (crease.corners[end] < 0)
                continue;
            crease_curve_evaluate(curve, domain[end], CREASE_SIDE_RIGHT, 0, place);
            const crease_corner corner =
                crease_network_corner(network, (size_t)crease.corners[end]);
            assert_memory_equal(place, corner.position, sizeof place);
        }
    }
}

static size_t corners_of(const crease_network *network, uint32_t valence)
{
    size_t count = 0;
    for (size_t i = 0; i < crease_network_corner_count(network); i++)
        count += crease_network_corner(network, i).valence == valence;
    return count;
}

/* Distance from the edges of a box. */
static double from_box_edges(const double p[3], const double *half)
{
    double best = INFINITY;
    for (int along = 0; along < 3; along++)
        for (int signs = 0; signs < 4; signs++) {
            const int a = (along + 1) % 3, b = (along + 2) % 3;
            const double da = p[a] - (signs & 1 ? half[a] : -half[a]);
            const double db = p[b] - (signs & 2 ? half[b] : -half[b]);
            const double dc = fmax(fabs(p[along]) - half[along], 0);
            best = fmin(best, sqrt(da * da + db * db + dc * dc));
        }
    return best;
}

static void on_box_edges(const double place[3], const double *half)
{
    assert_true(from_box_edges(place, half) < 1e-6);
}

static void given_box_when_found_then_twelve_edges_and_eight_corners(void **state)
{
    const double half[3] = {0.5, 0.4, 0.3};
    const given_body body = given_box(half[0], half[1], half[2]);
    world w = world_of(&body, S, 0.2 * S);
    assert_int_equal(crease_network_count(w.network), 12);
    assert_int_equal(crease_network_corner_count(w.network), 8);
    assert_int_equal(corners_of(w.network, 3), 8);
    check_ends(w.network);
    along_curves(w.network, on_box_edges, half);
    double total = 0;
    for (size_t i = 0; i < 12; i++) {
        const crease_network_crease crease = crease_network_at(w.network, i);
        assert_near(crease.angle, 90, 1e-6);
        assert_false(crease.closed);
        total += crease.length;
    }
    assert_near(total, 8 * (half[0] + half[1] + half[2]), 1e-6);
    end_world(&w);
}

static void given_box_when_found_then_features_are_within_one_spacing(void **state)
{
    const double half[3] = {0.5, 0.5, 0.5};
    const given_body body = given_box(0.5, 0.5, 0.5);
    world w = world_of(&body, S, 0.2 * S);
    const double s = crease_network_spacing(w.network);
    assert_near(s / S, 1, 0.03);
    assert_int_equal(crease_network_point_count(w.network), w.regions->count);
    size_t features = 0;
    for (size_t i = 0; i < w.regions->count; i++) {
        const double away = from_box_edges(w.regions->points + 3 * i, half);
        const bool feature = crease_network_features(w.network)[i];
        features += feature;
        if (fabs(away - s) > 1e-3 * s)
            assert_int_equal(feature, away < s);
    }
    assert_true(features > 200);
    end_world(&w);
}

static void given_reach_when_found_then_features_within_it(void **state)
{
    const given_body body = given_box(0.5, 0.5, 0.5);
    const double half[3] = {0.5, 0.5, 0.5};
    world w = world_of(&body, S, 0);
    crease_network_options options = crease_network_options_default();
    options.reach = 2.5;
    crease_network *wide = network_of(w.context, w.regions, &options);
    const double s = crease_network_spacing(wide);
    for (size_t i = 0; i < w.regions->count; i++) {
        const double away = from_box_edges(w.regions->points + 3 * i, half);
        if (fabs(away - 2.5 * s) > 1e-3 * s)
            assert_int_equal(crease_network_features(wide)[i], away < 2.5 * s);
    }
    crease_network_free(wide);
    end_world(&w);
}

static void on_rod_edges(const double place[3], const double *s)
{
    assert_near(hypot(place[0], place[1]), 0.4, 0.011 * *s);
    assert_near(fabs(place[2]), 0.5, 0.011 * *s);
}

static void given_rod_when_found_then_two_rings_and_no_corner(void **state)
{
    const given_body body = given_rod(0.4, 0.5);
    world w = world_of(&body, S, 0.2 * S);
    assert_int_equal(crease_network_count(w.network), 2);
    assert_int_equal(crease_network_corner_count(w.network), 0);
    for (size_t i = 0; i < 2; i++) {
        const crease_network_crease crease = crease_network_at(w.network, i);
        assert_true(crease.closed);
        assert_int_equal(crease.corners[0], -1);
        assert_int_equal(crease.corners[1], -1);
        assert_near(crease.angle, 90, 1e-6);
        assert_near(crease.length, 0.8 * acos(-1), 1e-2);
    }
    along_curves(w.network, on_rod_edges, &S);
    end_world(&w);
}

static void given_cut_sphere_when_found_then_one_ring_at_the_right_angle(void **state)
{
    const double z[3] = {0, 0, 1}, top[3] = {0, 0, 0.3}, origin[3] = {0, 0, 0};
    given_body body = {.size = 0.5};
    given_add(&body, given_model(CREASE_REGION_SPHERE, origin, z, 0.5, 0));
    given_add(&body, given_plane(top, z));
    world w = world_of(&body, S, 0.1 * S);
    assert_int_equal(crease_network_count(w.network), 1);
    const crease_network_crease crease = crease_network_at(w.network, 0);
    assert_true(crease.closed);
    /* the normals are up and 0.6 up: a turn of acos(0.6) */
    assert_near(crease.angle, 180 - acos(0.6) * 180 / acos(-1), 1e-6);
    assert_near(crease.length, 0.8 * acos(-1), 1e-2);
    end_world(&w);
}

static void given_pyramids_when_found_then_apex_of_that_valence(void **state)
{
    for (int sides = 3; sides <= 6; sides++) {
        const given_body body = given_pyramid(sides, 1);
        world w = world_of(&body, 2 * S, 0.2 * S);
        assert_int_equal(crease_network_count(w.network), 2 * sides);
        assert_int_equal(crease_network_corner_count(w.network), sides + 1);
        check_ends(w.network);
        bool apex = false;
        for (size_t i = 0; i < crease_network_corner_count(w.network); i++) {
            const crease_corner corner = crease_network_corner(w.network, i);
            if (corner.position[2] < 0.4)
                continue;
            apex = true;
            assert_int_equal(corner.valence, sides);
            assert_near(corner.position[0], 0, 1e-9);
            assert_near(corner.position[1], 0, 1e-9);
            assert_near(corner.position[2], 0.5, 1e-9);
        }
        assert_true(apex);
        assert_int_equal(corners_of(w.network, 3), sides + (sides == 3));
        end_world(&w);
    }
}

/* Two half-planes that meet in the y axis, the surface turning by so many degrees. */
static given_body given_roof(double turn)
{
    const double half = turn * acos(-1) / 360;
    const double left[3] = {-sin(half), 0, cos(half)}, right[3] = {sin(half), 0, cos(half)};
    const double origin[3] = {0, 0, 0};
    given_body body = {.size = 0.5};
    given_add(&body, given_plane(origin, left));
    given_add(&body, given_plane(origin, right));
    return body;
}

static given_points within(given_points from, double size)
{
    given_points out = {0, 0, NULL, NULL};
    for (size_t i = 0; i < from.count; i++) {
        const double *p = from.points + 3 * i;
        if (fabs(p[0]) < size && fabs(p[1]) < size && fabs(p[2]) < size)
            given_point(&out, p, from.labels[i]);
    }
    free(from.points);
    free(from.labels);
    return out;
}

static void given_roofs_when_found_then_one_open_crease_between_borders(void **state)
{
    for (double turn = 15; turn < 160; turn += 20) {
        const given_body body = given_roof(turn);
        world w = world_of_points(&body, within(given_sample(&body, S, 0, 7), 0.5), S, 0);
        assert_int_equal(crease_network_count(w.network), 1);
        const crease_network_crease crease = crease_network_at(w.network, 0);
        assert_near(crease.angle, 180 - turn, 1e-6);
        assert_near(crease.length, 1, 2 * S);
        assert_false(crease.closed);
        assert_int_equal(crease.corners[0], -1);
        assert_int_equal(crease.corners[1], -1);
        assert_int_equal(crease_network_corner_count(w.network), 0);
        end_world(&w);
    }
}

static void given_least_turn_when_roof_is_flatter_then_no_crease(void **state)
{
    const given_body body = given_roof(20);
    world w = world_of_points(&body, within(given_sample(&body, S, 0, 7), 0.5), S, 0);
    crease_network_options options = crease_network_options_default();
    options.least_turn = 25;
    crease_network *none = network_of(w.context, w.regions, &options);
    assert_int_equal(crease_network_count(w.network), 1);
    assert_int_equal(crease_network_count(none), 0);
    crease_network_free(none);
    end_world(&w);
}

static void given_open_sheet_when_found_then_its_border_is_no_crease(void **state)
{
    const double origin[3] = {0, 0, 0}, z[3] = {0, 0, 1};
    given_body body = {.size = 0.25};
    given_add(&body, given_plane(origin, z));
    world w = world_of(&body, S, 0.3 * S);
    assert_int_equal(crease_network_count(w.network), 0);
    for (size_t i = 0; i < w.regions->count; i++)
        assert_int_equal(crease_network_features(w.network)[i], 0);
    end_world(&w);
}

static void given_plane_that_runs_into_a_cylinder_smoothly_when_found_then_no_crease(void **state)
{
    const double x[3] = {1, 0, 0}, z[3] = {0, 0, 1}, top[3] = {0, 0, 0.5}, origin[3] = {0, 0, 0};
    given_body body = {.size = 0.6};
    given_add(&body, given_plane(top, z));
    given_add(&body, given_model(CREASE_REGION_CYLINDER, origin, x, 0.5, 0));
    given_points all = {0, 0, NULL, NULL};
    for (size_t i = 0; i < 40; i++)
        for (size_t k = 0; k < 60; k++) {
            const double along = ((double)i + 0.3 * (double)(k % 2)) * S - 0.8;
            const double across = ((double)k - 29.7) * S * 0.9, angle = across / 0.5;
            const double flat[3] = {along, across, 0.5};
            const double round[3] = {along, 0.5 * sin(angle), 0.5 * cos(angle)};
            given_point(&all, across < 0 ? flat : round, across < 0 ? 0 : 1);
        }
    world w = world_of_points(&body, all, S, 0.05 * S);
    assert_int_equal(crease_network_count(w.network), 0);
    end_world(&w);
}

static void given_crease_that_fades_out_when_found_then_it_ends(void **state)
{
    /* z = 0 for x < 0; z = x (0.7 - y) beside it: flat at y = 0.7, 45 degrees at y = -0.3 */
    double coefficients[6] = {0, 0.7, 0, 0, -1, 0};
    const double origin[3] = {0, 0, 0}, z[3] = {0, 0, 1};
    given_body body = {.size = 1};
    given_add(&body, given_plane(origin, z));
    crease_model twisted = {.type = CREASE_REGION_FREEFORM, .axes = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    twisted.patch = (crease_patch){.degree = 2,
        .low = {-1, -1},
        .high = {1, 1},
        .unit = {1, 1},
        .coefficient_count = 6,
        .coefficients = coefficients};
    given_add(&body, twisted);
    given_points points = {0, 0, NULL, NULL};
    for (size_t i = 0; i < 48 * 28; i++) {
        const double x = ((double)(i % 48) - 23.5 + 0.6 * crease_random_uniform(1, 1, i)) * S / 1.5;
        const double y = ((double)(i / 48) - 12 + 0.6 * crease_random_uniform(1, 2, i)) * S;
        const double place[3] = {x, y, x > 0 ? x * (0.7 - y) : 0};
        given_point(&points, place, x > 0);
    }
    world w = world_of_points(&body, points, S, 0);
    assert_int_equal(crease_network_count(w.network), 1);
    const crease_curve *curve = crease_network_curves(w.network)[0];
    double domain[2], ends[2][3];
    crease_curve_domain(curve, domain);
    for (int end = 0; end < 2; end++)
        crease_curve_evaluate(curve, domain[end], CREASE_SIDE_RIGHT, 0, ends[end]);
    const double high = fmax(ends[0][1], ends[1][1]), low = fmin(ends[0][1], ends[1][1]);
    assert_near(low, -0.5, 2 * S);
    /* it turns by 10 degrees, the least, where 0.7 - y = tan(10 degrees) */
    assert_near(high, 0.7 - tan(acos(-1) / 18), 2 * S);
    end_world(&w);
}

static void given_thin_wall_when_found_then_both_sides_have_their_edges(void **state)
{
    const double half[3] = {0.5, 0.5, 1.5 * S};
    const given_body body = given_box(half[0], half[1], half[2]);
    world w = world_of(&body, S, 0.1 * S);
    assert_int_equal(crease_network_count(w.network), 12);
    assert_int_equal(corners_of(w.network, 3), 8);
    along_curves(w.network, on_box_edges, half);
    end_world(&w);
}

static void given_outliers_when_found_then_the_same_creases(void **state)
{
    const double half[3] = {0.5, 0.5, 0.5};
    const given_body body = given_box(0.5, 0.5, 0.5);
    given_points points = given_sample(&body, S, 0.1 * S, 9);
    for (uint64_t i = 0; i < 200; i++) {
        double place[3];
        for (uint64_t c = 0; c < 3; c++)
            place[c] = 1.4 * crease_random_uniform(4, c, i) - 0.7;
        given_point(&points, place, CREASE_NO_REGION);
    }
    world w = world_of_points(&body, points, S, 0.1 * S);
    assert_int_equal(crease_network_count(w.network), 12);
    assert_int_equal(corners_of(w.network, 3), 8);
    along_curves(w.network, on_box_edges, half);
    end_world(&w);
}

static void given_hole_in_the_points_when_found_then_crease_stops_at_it(void **state)
{
    const given_body body = given_roof(90);
    given_points all = within(given_sample(&body, S, 0, 7), 0.5);
    given_points some = {0, 0, NULL, NULL};
    for (size_t i = 0; i < all.count; i++)
        if (fabs(all.points[3 * i + 1]) > 6 * S)
            given_point(&some, all.points + 3 * i, all.labels[i]);
    free(all.points);
    free(all.labels);
    world w = world_of_points(&body, some, S, 0);
    assert_int_equal(crease_network_count(w.network), 2);
    for (size_t i = 0; i < 2; i++)
        assert_near(crease_network_at(w.network, i).length, 0.5 - 6 * S, 2 * S);
    end_world(&w);
}

static void given_no_regions_when_found_then_nothing(void **state)
{
    const given_body body = {.size = 1};
    given_points points = {0, 0, NULL, NULL};
    for (uint64_t i = 0; i < 30; i++) {
        const double place[3] = {crease_random_uniform(1, 1, i), (double)i, 0};
        given_point(&points, place, CREASE_NO_REGION);
    }
    world w = world_of_points(&body, points, S, 0);
    assert_int_equal(crease_network_count(w.network), 0);
    assert_int_equal(crease_network_corner_count(w.network), 0);
    assert_near(crease_network_spacing(w.network), S, 0);
    end_world(&w);
}

static void given_any_number_of_threads_when_found_then_the_same_bytes(void **state)
{
    const given_body body = given_pyramid(5, 1);
    world w = world_of(&body, S, 0.3 * S);
    for (int threads = 1; threads <= 7; threads += 3) {
        crease_context *context = given_context_with_threads(threads);
        crease_network *other = network_of(context, w.regions, NULL);
        assert_int_equal(crease_network_count(other), crease_network_count(w.network));
        assert_memory_equal(
            crease_network_features(other), crease_network_features(w.network), w.regions->count);
        assert_true(crease_network_spacing(other) == crease_network_spacing(w.network));
        for (size_t i = 0; i < crease_network_count(other); i++) {
            const crease_curve *a = crease_network_curves(other)[i];
            const crease_curve *b = crease_network_curves(w.network)[i];
            assert_int_equal(crease_curve_count(a), crease_curve_count(b));
            assert_memory_equal(crease_curve_control_points(a), crease_curve_control_points(b),
                3 * sizeof(double) * crease_curve_count(a));
        }
        crease_network_free(other);
        crease_context_free(context);
    }
    end_world(&w);
}

/* A body turned about (1, 2, 3), made larger and moved. */
static void carry(given_body *body, given_points *points, double scale, const double move[3])
{
    const double a = 1 / sqrt(14), b = 2 / sqrt(14), c = 3 / sqrt(14), s = sin(1), k = 1 - cos(1);
    const crease_frame frame = {
        .rotation = {1 - k * (1 - a * a), a * b * k - c * s, a * c * k + b * s, a * b * k + c * s,
            1 - k * (1 - b * b), b * c * k - a * s, a * c * k - b * s, b * c * k + a * s,
            1 - k * (1 - c * c)}};
    assert_true(crease_frame_defect(frame.rotation) < 1e-12);
    crease_frame_enter(&frame, points->points, points->count, points->points);
    for (size_t i = 0; i < 3 * points->count; i++)
        points->points[i] = scale * points->points[i] + move[i % 3];
    for (size_t i = 0; i < body->count; i++) {
        crease_model *model = &body->models[i];
        crease_frame_enter(&frame, model->centre, 1, model->centre);
        crease_frame_enter(&frame, model->axes, 3, model->axes);
        for (int d = 0; d < 3; d++)
            model->centre[d] = scale * model->centre[d] + move[d];
        model->radius *= scale;
    }
}

static void given_moved_and_scaled_body_when_found_then_the_same_creases(void **state)
{
    const double move[3] = {300, -200, 100}, scale = 37;
    given_body body = given_rod(0.4, 0.5);
    const double x[3] = {1, 0, 0.2}, side[3] = {0.25, 0, 0};
    given_add(&body, given_plane(side, x));
    given_points points = given_sample(&body, S, 0.2 * S, 5);
    world one = world_of(&body, S, 0.2 * S);
    carry(&body, &points, scale, move);
    world other = world_of_points(&body, points, scale * S, 0.2 * scale * S);
    assert_int_equal(crease_network_count(one.network), crease_network_count(other.network));
    assert_int_equal(
        crease_network_corner_count(one.network), crease_network_corner_count(other.network));
    for (size_t i = 0; i < crease_network_count(one.network); i++) {
        const crease_network_crease a = crease_network_at(one.network, i);
        const crease_network_crease b = crease_network_at(other.network, i);
        assert_int_equal(a.regions[0], b.regions[0]);
        assert_int_equal(a.regions[1], b.regions[1]);
        assert_near(scale * a.length, b.length, 1e-3 * b.length);
        assert_near(a.angle, b.angle, 1e-3);
    }
    size_t differing = 0;
    for (size_t i = 0; i < one.regions->count; i++)
        differing +=
            crease_network_features(one.network)[i] != crease_network_features(other.network)[i];
    assert_true(differing <= 2);
    end_world(&one);
    end_world(&other);
}

static FILE *opened(const char *path)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    return file;
}

static void given_network_when_written_as_ply_then_only_corners_have_three_lines(void **state)
{
    const given_body body = given_box(0.5, 0.4, 0.3);
    const char *path = "test_network.ply";
    world w = world_of(&body, S, 0);
    assert_int_equal(crease_network_write(w.context, w.network, path), CREASE_OK);
    FILE *file = opened(path);
    char line[128];
    size_t vertices = 0, edges = 0;
    while (fgets(line, sizeof line, file) && strcmp(line, "end_header\n") != 0) {
        if (strncmp(line, "element vertex ", 15) == 0)
            vertices = strtoul(line + 15, NULL, 10);
        else if (strncmp(line, "element edge ", 13) == 0)
            edges = strtoul(line + 13, NULL, 10);
    }
    assert_true(vertices >= 8 && vertices < 100 && edges >= 12 && edges < 100);
    assert_int_equal(fseek(file, (long)vertices * 28, SEEK_CUR), 0);
    int degree[100] = {0}, counts[5] = {0};
    for (size_t i = 0; i < edges; i++) {
        uint32_t ends[2];
        assert_int_equal(fread(ends, sizeof *ends, 2, file), 2);
        for (int k = 0; k < 2; k++) {
            assert_true(ends[k] < vertices);
            degree[ends[k]]++;
        }
    }
    fclose(file);
    for (size_t i = 0; i < vertices; i++) {
        assert_true(degree[i] >= 1 && degree[i] <= 3);
        counts[degree[i]]++;
    }
    assert_int_equal(counts[3], 8);
    assert_int_equal(counts[1], 0);
    remove(path);
    end_world(&w);
}

static void given_network_when_written_as_csv_then_rows_say_the_angle(void **state)
{
    const given_body body = given_rod(0.4, 0.5);
    const char *path = "test_network.csv";
    world w = world_of(&body, S, 0);
    assert_int_equal(crease_network_write(w.context, w.network, path), CREASE_OK);
    FILE *file = opened(path);
    char line[256];
    assert_non_null(fgets(line, sizeof line, file));
    assert_string_equal(
        line, "crease,x,y,z,region_1,region_2,closed,angle,angle_error,position_error\n");
    size_t rows = 0;
    double numbers[10];
    for (; fgets(line, sizeof line, file); rows++) {
        char *at = line;
        for (int i = 0; i < 10; i++, at++)
            numbers[i] = strtod(at, &at);
        assert_near(numbers[4], 0, 0);
        assert_near(numbers[6], 1, 0);
        assert_near(numbers[7], 90, 1e-6);
    }
    fclose(file);
    assert_true(rows > 20);
    remove(path);
    end_world(&w);
}

static void given_options_out_of_range_when_found_then_error(void **state)
{
    const given_body body = given_rod(0.4, 0.5);
    world w = world_of(&body, 2 * S, 0);
    const double turns[] = {0.5, 91, NAN, 10, 10, 10}, reaches[] = {1, 1, 1, 0, -1, NAN};
    for (size_t i = 0; i < 6; i++) {
        const crease_network_options options = {turns[i], reaches[i]};
        crease_network *none = w.network;
        assert_int_equal(
            crease_network_find(w.context, w.regions, &options, &none), CREASE_ERROR_ARGUMENT);
        assert_null(none);
        assert_non_null(strstr(crease_context_message(w.context), "creases: "));
    }
    end_world(&w);
}

static void given_failing_memory_when_found_then_error_and_no_leak(void **state)
{
    const given_body body = given_box(0.25, 0.25, 0.25);
    world w = world_of(&body, S, 0.1 * S);
    long n = 0;
    for (;; n++) {
        crease_network *network = NULL;
        crease_context_fail_allocation(w.context, n);
        const crease_status status = crease_network_find(w.context, w.regions, NULL, &network);
        crease_context_fail_allocation(w.context, -1);
        if (status == CREASE_OK) {
            assert_int_equal(crease_network_count(network), 12);
            crease_network_free(network);
            break;
        }
        assert_int_equal(status, CREASE_ERROR_NO_MEMORY);
        assert_null(network);
    }
    assert_true(n > 50);
    end_world(&w);
}

static int stop(void *user)
{
    return 1;
}

static void given_cancelled_context_when_found_then_cancelled(void **state)
{
    const given_body body = given_box(0.25, 0.25, 0.25);
    world w = world_of(&body, S, 0.1 * S);
    crease_context_options options = crease_context_options_default();
    options.cancelled = stop;
    crease_context *context = NULL;
    crease_network *network = NULL;
    assert_int_equal(crease_context_create(&options, &context), CREASE_OK);
    assert_int_equal(
        crease_network_find(context, w.regions, NULL, &network), CREASE_ERROR_CANCELLED);
    assert_null(network);
    crease_context_free(context);
    end_world(&w);
}

/* Points of a plane that is turned about y, from `low` to 1 across it. */
static void add_turned(given_points *to, double turn, double low, int32_t label)
{
    for (double u = low; u < 1; u += S)
        for (double v = -1; v < 1; v += S) {
            const uint64_t draw = to->count;
            const double across = u + S * crease_random_uniform(8, 1, draw);
            const double along = v + S * crease_random_uniform(8, 2, draw);
            const double place[3] = {across * cos(turn), along, across * sin(turn)};
            given_point(to, place, label);
        }
}

/* The plane z = 0 and one at an angle to it, which begins at `low`. */
static world world_of_planes(double degrees, double low)
{
    const double turn = degrees * acos(-1) / 180, origin[3] = {0}, up[3] = {0, 0, 1};
    const double across[3] = {-sin(turn), 0, cos(turn)};
    given_body body = {.size = 1};
    given_points points = {0, 0, NULL, NULL};
    given_add(&body, given_plane(origin, up));
    given_add(&body, given_plane(origin, across));
    add_turned(&points, 0, -1, 0);
    add_turned(&points, turn, low, 1);
    return world_of_points(&body, points, S, 0);
}

static void given_rib_on_plate_when_found_then_crease_at_its_foot(void **state)
{
    world w = world_of_planes(60, 0);
    assert_int_equal(crease_network_count(w.network), 1);
    assert_near(crease_network_at(w.network, 0).length, 2, 2 * S);
    end_world(&w);
}

static void given_surfaces_that_cross_when_found_then_no_crease(void **state)
{
    const double degrees[] = {15, 60, 90};
    for (int i = 0; i < 3; i++) {
        world w = world_of_planes(degrees[i], -1);
        assert_int_equal(crease_network_count(w.network), 0);
        end_world(&w);
    }
}

/* A chain along x from 0.1 to some length less 0.1; ends at these corners. */
static crease_chain given_chain(crease_context *context, double length, int32_t a, int32_t b)
{
    crease_chain chain = crease_chain_between(0, 1);
    for (int i = 0; i < 5; i++) {
        const double place[3] = {0.1 + (length - 0.2) * i / 4, 0, 0};
        assert_int_equal(crease_chain_append(context, &chain, place, 1), CREASE_OK);
    }
    chain.corners[0] = a;
    chain.corners[1] = b;
    return chain;
}

static void given_spurs_when_dropped_then_chains_that_lead_on_stay(void **state)
{
    crease_context *context = given_context();
    /* Corner 0: of the short loop alone; 1: three ends; 2: two ends, at x = 0.9; 3: an end of a
     * long chain alone; 4: of a spur alone. */
    crease_junction places[5] = {{.valence = 2}, {.valence = 3}, {.place = {0.9}, .valence = 2},
        {.place = {7}, .valence = 1}, {.place = {0.9}, .valence = 1}};
    crease_junctions corners = {5, places};
    crease_chain given[] = {given_chain(context, 0.4, 0, 0), given_chain(context, 0.9, 1, 2),
        given_chain(context, 7, 2, 3), given_chain(context, 0.9, 1, 4),
        given_chain(context, 0.5, CREASE_NO_CORNER, CREASE_NO_CORNER),
        given_chain(context, 0.6, CREASE_NO_CORNER, CREASE_NO_CORNER),
        given_chain(context, 1.3, 1, CREASE_NO_CORNER)};
    given[5].closed = true;
    crease_chains chains = {0};
    for (size_t i = 0; i < sizeof given / sizeof *given; i++)
        assert_int_equal(crease_chains_take(context, &chains, &given[i]), CREASE_OK);

    crease_spurs_drop(&chains, &corners, 1.0);

    assert_int_equal(chains.count, 4);
    assert_int_equal(corners.count, 3);
    const int32_t expected[4][2] = {{0, 1}, {1, 2}, {CREASE_NO_CORNER, CREASE_NO_CORNER}, {0, -1}};
    for (size_t i = 0; i < 4; i++)
        for (int end = 0; end < 2; end++)
            assert_int_equal(chains.items[i].corners[end], expected[i][end]);
    assert_int_equal(corners.items[0].valence, 2);
    assert_int_equal(corners.items[2].valence, 1);
    assert_near(corners.items[2].place[0], 7, 0);
    assert_true(chains.items[2].closed);
    crease_chains_clear(&chains);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_box_when_found_then_twelve_edges_and_eight_corners),
        cmocka_unit_test(given_box_when_found_then_features_are_within_one_spacing),
        cmocka_unit_test(given_reach_when_found_then_features_within_it),
        cmocka_unit_test(given_rod_when_found_then_two_rings_and_no_corner),
        cmocka_unit_test(given_cut_sphere_when_found_then_one_ring_at_the_right_angle),
        cmocka_unit_test(given_pyramids_when_found_then_apex_of_that_valence),
        cmocka_unit_test(given_roofs_when_found_then_one_open_crease_between_borders),
        cmocka_unit_test(given_least_turn_when_roof_is_flatter_then_no_crease),
        cmocka_unit_test(given_open_sheet_when_found_then_its_border_is_no_crease),
        cmocka_unit_test(given_plane_that_runs_into_a_cylinder_smoothly_when_found_then_no_crease),
        cmocka_unit_test(given_crease_that_fades_out_when_found_then_it_ends),
        cmocka_unit_test(given_thin_wall_when_found_then_both_sides_have_their_edges),
        cmocka_unit_test(given_outliers_when_found_then_the_same_creases),
        cmocka_unit_test(given_hole_in_the_points_when_found_then_crease_stops_at_it),
        cmocka_unit_test(given_no_regions_when_found_then_nothing),
        cmocka_unit_test(given_any_number_of_threads_when_found_then_the_same_bytes),
        cmocka_unit_test(given_moved_and_scaled_body_when_found_then_the_same_creases),
        cmocka_unit_test(given_network_when_written_as_ply_then_only_corners_have_three_lines),
        cmocka_unit_test(given_network_when_written_as_csv_then_rows_say_the_angle),
        cmocka_unit_test(given_options_out_of_range_when_found_then_error),
        cmocka_unit_test(given_failing_memory_when_found_then_error_and_no_leak),
        cmocka_unit_test(given_cancelled_context_when_found_then_cancelled),
        cmocka_unit_test(given_rib_on_plate_when_found_then_crease_at_its_foot),
        cmocka_unit_test(given_surfaces_that_cross_when_found_then_no_crease),
        cmocka_unit_test(given_spurs_when_dropped_then_chains_that_lead_on_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
