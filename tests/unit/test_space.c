/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "base/random.h"
#include "space/kdtree.h"
#include "space/morton.h"

struct points {
    const char *name;
    size_t count;
    double *xyz;
};

typedef double maker(size_t i, int axis);

static double draw(size_t i, int axis)
{
    return crease_random_uniform(11, (uint64_t)axis, i);
}

static double random_points(size_t i, int axis)
{
    return draw(i, axis);
}

static double lattice(size_t i, int axis)
{
    const size_t cells[3] = {i % 9, i / 9 % 9, i / 81};
    return 0.25 * (double)cells[axis];
}

static double plane_lattice(size_t i, int axis)
{
    return axis == 2 ? 0 : (double)(axis == 0 ? i % 25 : i / 25) / 32;
}

static double doubled(size_t i, int axis)
{
    return draw(i / 5, axis);
}

static double equal(size_t i, int axis)
{
    return 0.1 * axis;
}

static double collinear(size_t i, int axis)
{
    return (axis + 1) * floor(100 * draw(i, 0)) / 8;
}

static double clustered(size_t i, int axis)
{
    const double size = i % 3 == 0 ? 1 : i % 3 == 1 ? 1e-3 : 1e-9;
    return (double)(i % 3) * 0.3 + size * draw(i, axis);
}

static double far_from_origin(size_t i, int axis)
{
    return 4.5e6 * (axis + 1) + draw(i, axis);
}

static double huge_and_tiny(size_t i, int axis)
{
    return (draw(i, axis) - 0.5) * (i % 2 ? 1e308 : 1e-308);
}

static double tiny(size_t i, int axis)
{
    return (draw(i, axis) - 0.5) * 1e-161;
}

static double half_at_zero(size_t i, int axis)
{
    return i % 2 ? 0 : 0.01 * draw(i, axis);
}

static struct points given_points(const char *name, maker *make, size_t count)
{
    struct points cloud = {name, count, malloc(3 * count * sizeof(double))};
    for (size_t i = 0; i < 3 * count; i++)
        cloud.xyz[i] = make(i / 3, (int)(i % 3));
    return cloud;
}

static crease_cloud *given_cloud(crease_context *context, const struct points *points)
{
    crease_cloud *cloud = given_cloud_of(context, points->xyz, points->count);
    return cloud;
}

static const struct {
    const char *name;
    maker *make;
} kinds[] = {{"random", random_points}, {"lattice", lattice}, {"plane lattice", plane_lattice},
    {"doubled", doubled}, {"equal", equal}, {"collinear", collinear}, {"clustered", clustered},
    {"far from the origin", far_from_origin}, {"huge and tiny", huge_and_tiny}, {"tiny", tiny},
    {"half at zero", half_at_zero}};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* The oracle: all points sorted by distance, ties by index, `self` before all others. */
struct rank {
    double distance;
    uint32_t index;
};

static int compare(const void *a, const void *b)
{
    const struct rank *x = a, *y = b;
    if (x->distance != y->distance)
        return x->distance < y->distance ? -1 : 1;
    return x->index < y->index ? -1 : x->index > y->index;
}

static double squared(const double *a, const double *b)
{
    const double dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
    return dx * dx + dy * dy + dz * dz;
}

static void brute_force(
    const struct points *points, const double *place, size_t self, struct rank *ranks)
{
    for (size_t i = 0; i < points->count; i++)
        ranks[i] = (struct rank){squared(points->xyz + 3 * i, place), (uint32_t)i};
    if (self < points->count)
        ranks[self].distance = -1;
    qsort(ranks, points->count, sizeof *ranks, compare);
    if (self < points->count)
        ranks[0].distance = 0;
}

static void given_any_cloud_then_neighbours_are_those_of_brute_force(void **state)
{
    enum { COUNT = 300, STEP = 31 };
    crease_context *context = given_context();
    struct rank ranks[COUNT];
    for (int kind = 0; kind < KINDS; kind++) {
        struct points points = given_points(kinds[kind].name, kinds[kind].make, COUNT);
        crease_cloud *cloud = given_cloud(context, &points);
        for (int k = 1 + kind % 5; k <= 64; k += 5) {
            crease_neighbours *found = NULL;
            assert_int_equal(crease_neighbours_find(context, cloud, k, &found), CREASE_OK);
            assert_int_equal(crease_neighbours_k(found), k);
            for (size_t i = (size_t)k % STEP; i < COUNT; i += STEP) {
                brute_force(&points, points.xyz + 3 * i, i, ranks);
                for (int j = 0; j < k; j++)
                    if (crease_neighbours_of(found, i)[j] != ranks[j].index)
                        fail_msg("%s: neighbour %d of %d of point %zu", points.name, j, k, i);
            }
            crease_neighbours_free(found);
        }
        crease_cloud_free(cloud);
        free(points.xyz);
    }
    crease_context_free(context);
}

static void given_a_larger_cloud_then_neighbours_are_those_of_brute_force(void **state)
{
    enum { COUNT = 2000, STEP = 107 };
    const int ks[] = {2, 16, 33, 256};
    crease_context *context = given_context();
    struct rank *ranks = malloc(COUNT * sizeof *ranks);
    for (int kind = 0; kind < KINDS; kind++) {
        struct points points = given_points(kinds[kind].name, kinds[kind].make, COUNT);
        crease_cloud *cloud = given_cloud(context, &points);
        for (size_t n = 0; n < sizeof ks / sizeof ks[0]; n++) {
            crease_neighbours *found = NULL;
            assert_int_equal(crease_neighbours_find(context, cloud, ks[n], &found), CREASE_OK);
            for (size_t i = n; i < COUNT; i += STEP * (n + 1)) {
                brute_force(&points, points.xyz + 3 * i, i, ranks);
                for (int j = 0; j < ks[n]; j++)
                    if (crease_neighbours_of(found, i)[j] != ranks[j].index)
                        fail_msg("%s: neighbour %d of %d of point %zu", points.name, j, ks[n], i);
            }
            crease_neighbours_free(found);
        }
        crease_cloud_free(cloud);
        free(points.xyz);
    }
    free(ranks);
    crease_context_free(context);
}

/* The reach of the leaf before is a hint: a wrong one costs time alone. */
static void given_any_reach_then_a_leaf_finds_the_same(void **state)
{
    enum { COUNT = 3000, K = 12 };
    static const double reaches[] = {0, 1e-300, 1e-6, 0.02, 1, 1e200, INFINITY, NAN};
    static uint32_t expected[CREASE_LEAF_POINTS * K], found[CREASE_LEAF_POINTS * K];
    static double squared[CREASE_LEAF_POINTS * K];
    crease_context *context = given_context();
    for (int kind = 0; kind < KINDS; kind++) {
        crease_tree *tree = NULL;
        struct points points = given_points(kinds[kind].name, kinds[kind].make, COUNT);
        assert_int_equal(crease_tree_create(context, points.xyz, COUNT, &tree), CREASE_OK);
        for (size_t leaf = 0; leaf < tree->leaf_count; leaf += 23) {
            const crease_node *node = tree->nodes + tree->leaves[leaf];
            for (size_t n = 0; n < sizeof reaches / sizeof reaches[0]; n++) {
                double reach = reaches[n];
                crease_tree_leaf_nearest(tree, leaf, K, &reach, n ? found : expected, squared);
                const size_t size = (node->end - node->begin) * K * sizeof *found;
                if (n > 0 && memcmp(found, expected, size) != 0)
                    fail_msg("%s: leaf %zu, reach %g", points.name, leaf, reaches[n]);
            }
        }
        crease_tree_free(tree);
        free(points.xyz);
    }
    crease_context_free(context);
}

static void given_any_place_then_the_tree_finds_what_brute_force_finds(void **state)
{
    enum { COUNT = 700, QUERIES = 40, K = 20 };
    crease_context *context = given_context();
    struct rank ranks[COUNT];
    uint32_t indices[QUERIES * K];
    double distances[QUERIES * K], places[QUERIES * 3];
    for (int kind = 0; kind < KINDS; kind++) {
        struct points points = given_points(kinds[kind].name, kinds[kind].make, COUNT);
        for (size_t i = 0; i < 3 * QUERIES; i++)
            places[i] = points.xyz[i] + (i % 2 ? 2 * draw(i, 7) : 0);
        crease_tree *tree = NULL;
        assert_int_equal(crease_tree_create(context, points.xyz, COUNT, &tree), CREASE_OK);
        assert_int_equal(
            crease_tree_nearest(context, tree, places, QUERIES, K, indices, distances), CREASE_OK);
        for (size_t i = 0; i < QUERIES; i++) {
            brute_force(&points, places + 3 * i, SIZE_MAX, ranks);
            for (size_t j = 0; j < K; j++) {
                assert_int_equal(indices[i * K + j], ranks[j].index);
                assert_true(distances[i * K + j] == ranks[j].distance);
            }
        }
        crease_tree_free(tree);
        free(points.xyz);
    }
    crease_context_free(context);
}

static size_t brute_within(
    const struct points *points, const double *place, double radius, uint32_t *out)
{
    size_t found = 0;
    for (size_t i = 0; i < points->count; i++)
        if (squared(points->xyz + 3 * i, place) <= radius * radius)
            out[found++] = (uint32_t)i;
    return found;
}

static void given_a_radius_then_all_points_within_come_by_ascending_index(void **state)
{
    enum { COUNT = 900, ROOM = 50 };
    const double radii[] = {0, 0.01, 0.25, 0.3, 1.7, INFINITY};
    crease_context *context = given_context();
    uint32_t expected[COUNT], indices[COUNT];
    for (int kind = 0; kind < KINDS; kind++) {
        struct points points = given_points(kinds[kind].name, kinds[kind].make, COUNT);
        crease_tree *tree = NULL;
        assert_int_equal(crease_tree_create(context, points.xyz, COUNT, &tree), CREASE_OK);
        for (size_t i = 0; i < sizeof radii / sizeof radii[0] * 5; i++) {
            const double *place = points.xyz + 3 * (i * 17);
            size_t found = 0;
            const size_t count = brute_within(&points, place, radii[i / 5], expected);
            crease_tree_within(tree, place, radii[i / 5], COUNT, indices, &found);
            assert_int_equal(found, count);
            assert_memory_equal(indices, expected, count * sizeof *expected);
            crease_tree_within(tree, place, radii[i / 5], ROOM, indices, &found);
            assert_int_equal(found, count);
            assert_memory_equal(
                indices, expected, (count < ROOM ? count : ROOM) * sizeof *expected);
        }
        crease_tree_free(tree);
        free(points.xyz);
    }
    crease_context_free(context);
}

static void given_an_impossible_radius_then_it_is_refused(void **state)
{
    crease_context *context = given_context();
    crease_tree *tree = NULL;
    const double place[3] = {0};
    uint32_t index;
    size_t found = 1;
    assert_int_equal(crease_tree_create(context, place, 1, &tree), CREASE_OK);
    assert_int_equal(crease_tree_within(tree, place, -1, 1, &index, &found), CREASE_ERROR_ARGUMENT);
    assert_int_equal(
        crease_tree_within(tree, place, NAN, 1, &index, &found), CREASE_ERROR_ARGUMENT);
    assert_int_equal(found, 0);
    assert_int_equal(crease_tree_within(tree, place, 0, 0, NULL, &found), CREASE_OK);
    assert_int_equal(found, 1);
    crease_tree_free(tree);
    crease_context_free(context);
}

static void given_no_points_then_the_tree_is_empty(void **state)
{
    crease_context *context = given_context();
    crease_tree *tree = NULL;
    const double place[3] = {0};
    uint32_t index;
    size_t found = 1;
    assert_int_equal(crease_tree_create(context, NULL, 0, &tree), CREASE_OK);
    assert_int_equal(crease_tree_count(tree), 0);
    assert_int_equal(crease_tree_within(tree, place, 1, 1, &index, &found), CREASE_OK);
    assert_int_equal(found, 0);
    assert_int_equal(
        crease_tree_nearest(context, tree, place, 1, 1, &index, NULL), CREASE_ERROR_ARGUMENT);
    crease_tree_free(tree);
    crease_tree_free(NULL);
    crease_context_free(context);
}

static void given_wrong_arguments_then_each_is_named(void **state)
{
    crease_context *context = given_context();
    const double place[3] = {0}, wrong[6] = {0, 0, 0, 0, NAN, 0};
    crease_tree *tree = NULL;
    uint32_t index;
    assert_int_equal(crease_tree_create(context, wrong, 2, &tree), CREASE_ERROR_VALUE);
    assert_null(tree);
    assert_non_null(strstr(crease_context_message(context), "point 1"));
    assert_int_equal(crease_tree_create(context, place, 1, &tree), CREASE_OK);
    assert_int_equal(
        crease_tree_nearest(context, tree, place, 1, 0, &index, NULL), CREASE_ERROR_ARGUMENT);
    assert_int_equal(
        crease_tree_nearest(context, tree, wrong + 3, 1, 1, &index, NULL), CREASE_ERROR_VALUE);
    crease_tree_free(tree);

    struct points points = given_points("random", random_points, 10);
    crease_cloud *cloud = given_cloud(context, &points);
    crease_neighbours *found = NULL;
    assert_int_equal(crease_neighbours_find(context, cloud, 0, &found), CREASE_ERROR_ARGUMENT);
    assert_int_equal(crease_neighbours_find(context, cloud, 257, &found), CREASE_ERROR_ARGUMENT);
    assert_int_equal(
        crease_neighbours_find(context, cloud, 11, &found), CREASE_ERROR_TOO_FEW_POINTS);
    assert_null(found);
    crease_neighbours_free(NULL);
    crease_cloud_free(cloud);
    free(points.xyz);
    crease_context_free(context);
}

static uint32_t *all_neighbours(int threads, const struct points *points, int k)
{
    crease_context *context = given_context_with_threads(threads);
    crease_cloud *cloud = given_cloud(context, points);
    crease_neighbours *found = NULL;
    assert_int_equal(crease_neighbours_find(context, cloud, k, &found), CREASE_OK);
    const size_t bytes = points->count * (size_t)k * sizeof(uint32_t);
    uint32_t *copy = malloc(bytes);
    memcpy(copy, crease_neighbours_of(found, 0), bytes);
    crease_neighbours_free(found);
    crease_cloud_free(cloud);
    crease_context_free(context);
    return copy;
}

static void given_any_number_of_threads_then_neighbours_are_the_same_bytes(void **state)
{
    enum { COUNT = 40000, K = 9 };
    for (int kind = 0; kind < 4; kind++) {
        struct points points = given_points(kinds[kind].name, kinds[kind].make, COUNT);
        uint32_t *one = all_neighbours(1, &points, K);
        for (int threads = 2; threads <= 4; threads += 2) {
            uint32_t *more = all_neighbours(threads, &points, K);
            assert_memory_equal(one, more, COUNT * K * sizeof *one);
            free(more);
        }
        free(one);
        free(points.xyz);
    }
}

static void given_a_failing_allocation_then_no_memory_and_no_leak(void **state)
{
    crease_context *context = given_context();
    struct points points = given_points("random", random_points, 500);
    crease_cloud *cloud = given_cloud(context, &points);
    crease_neighbours *found = NULL;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    long n = 0;
    for (; n < 100 && status != CREASE_OK; n++) {
        crease_context_fail_allocation(context, n);
        status = crease_neighbours_find(context, cloud, 5, &found);
        assert_true(status == CREASE_OK || (status == CREASE_ERROR_NO_MEMORY && !found));
    }
    assert_in_range(n, 12, 99);
    crease_neighbours_free(found);
    crease_cloud_free(cloud);
    free(points.xyz);
    crease_context_free(context);
}

static void given_a_sorted_cloud_then_keys_ascend_and_the_order_is_a_permutation(void **state)
{
    enum { COUNT = 50000 };
    crease_context *context = given_context();
    uint64_t *keys = malloc(COUNT * sizeof *keys);
    uint32_t *order = malloc(COUNT * sizeof *order);
    for (int kind = 0; kind < KINDS; kind++) {
        struct points points = given_points(kinds[kind].name, kinds[kind].make, COUNT);
        uint8_t *seen = calloc(COUNT, 1);
        assert_int_equal(crease_morton_sort(context, points.xyz, COUNT, keys, order), CREASE_OK);
        for (size_t i = 0; i < COUNT; i++) {
            assert_int_equal(seen[order[i]]++, 0);
            assert_true(i == 0 || keys[i - 1] < keys[i] ||
                (keys[i - 1] == keys[i] && order[i - 1] < order[i]));
        }
        free(seen);
        free(points.xyz);
    }
    free(keys);
    free(order);
    crease_context_free(context);
}

/* As many points as fill the chunks of the sort to the last one. */
static void given_a_whole_number_of_chunks_then_the_order_is_a_permutation(void **state)
{
    enum { COUNT = 2 * 16384 };
    crease_context *context = given_context();
    double *xyz = malloc(3 * COUNT * sizeof *xyz);
    uint64_t *keys = malloc(COUNT * sizeof *keys);
    uint32_t *order = malloc(COUNT * sizeof *order);
    uint8_t *seen = calloc(COUNT, 1);
    for (size_t i = 0; i < COUNT; i++)
        for (int axis = 0; axis < 3; axis++)
            xyz[3 * i + (size_t)axis] = draw(i, axis);
    assert_int_equal(crease_morton_sort(context, xyz, COUNT, keys, order), CREASE_OK);
    for (size_t i = 0; i < COUNT; i++) {
        assert_true(i == 0 || keys[i - 1] <= keys[i]);
        assert_true(order[i] < COUNT && !seen[order[i]]);
        seen[order[i]] = 1;
    }
    free(xyz);
    free(keys);
    free(order);
    free(seen);
    crease_context_free(context);
}

/* The corners of a cube, in the order in which the curve meets them. */
static void given_the_corners_of_a_cube_then_the_curve_goes_z_first(void **state)
{
    crease_context *context = given_context();
    double corners[24];
    uint64_t keys[8];
    uint32_t order[8];
    for (int i = 0; i < 8; i++)
        for (int axis = 0; axis < 3; axis++)
            corners[3 * i + axis] = (7 - i) >> (2 - axis) & 1;
    assert_int_equal(crease_morton_sort(context, corners, 8, keys, order), CREASE_OK);
    for (uint32_t i = 0; i < 8; i++)
        assert_int_equal(order[i], 7 - i);
    assert_true(keys[0] == 0);
    assert_true(keys[7] == (UINT64_C(1) << 63) - 1);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_any_cloud_then_neighbours_are_those_of_brute_force),
        cmocka_unit_test(given_a_larger_cloud_then_neighbours_are_those_of_brute_force),
        cmocka_unit_test(given_any_reach_then_a_leaf_finds_the_same),
        cmocka_unit_test(given_any_place_then_the_tree_finds_what_brute_force_finds),
        cmocka_unit_test(given_a_radius_then_all_points_within_come_by_ascending_index),
        cmocka_unit_test(given_an_impossible_radius_then_it_is_refused),
        cmocka_unit_test(given_no_points_then_the_tree_is_empty),
        cmocka_unit_test(given_wrong_arguments_then_each_is_named),
        cmocka_unit_test(given_any_number_of_threads_then_neighbours_are_the_same_bytes),
        cmocka_unit_test(given_a_failing_allocation_then_no_memory_and_no_leak),
        cmocka_unit_test(given_a_sorted_cloud_then_keys_ascend_and_the_order_is_a_permutation),
        cmocka_unit_test(given_a_whole_number_of_chunks_then_the_order_is_a_permutation),
        cmocka_unit_test(given_the_corners_of_a_cube_then_the_curve_goes_z_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
