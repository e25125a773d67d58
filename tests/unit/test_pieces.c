/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A cloud cut into pieces: whatever the cut, each piece finds for its own points what the whole
 * cloud says of them. */
#include "given.h"

#include "detect/scores.h"
#include "detect/scoring.h"
#include "space/morton.h"
#include "space/piece.h"

typedef struct cut {
    crease_cloud *cloud;
    const double *points;
    size_t count, pieces;
    uint32_t *order; /* Morton order */
    uint8_t *held;   /* pieces x count: 1 own, 2 another's */
} cut;

static size_t first_of(const cut *all, size_t piece)
{
    return piece * all->count / all->pieces;
}

/* The tree of a piece's own points; its indices are places in the Morton order after the first. */
static crease_tree *own_tree(crease_context *context, const cut *all, size_t piece)
{
    const size_t first = first_of(all, piece), count = first_of(all, piece + 1) - first;
    double *points = malloc((count + 1) * 3 * sizeof *points);
    crease_tree *tree = NULL;
    for (size_t i = 0; i < count; i++)
        memcpy(points + 3 * i, all->points + 3 * all->order[first + i], 3 * sizeof *points);
    assert_int_equal(crease_tree_create(context, points, count, &tree), CREASE_OK);
    free(points);
    return tree;
}

/* What a piece asks of another, marked. */
static void ask(const cut *all, const crease_reach *reaches, size_t count, size_t piece,
    const crease_tree *other, size_t from)
{
    uint8_t *wanted = calloc(other->count + 1, 1);
    for (size_t i = 0; i < count; i++)
        crease_reach_mark(&reaches[i], other, wanted);
    for (size_t i = 0; i < other->count; i++)
        if (wanted[i])
            all->held[piece * all->count + all->order[first_of(all, from) + i]] = 2;
    free(wanted);
}

static void complete(crease_context *context, const cut *all, size_t piece, int k)
{
    crease_tree *own = own_tree(context, all, piece);
    crease_reaches reaches;
    assert_int_equal(crease_reaches_find(context, own, k, &reaches), CREASE_OK);
    for (size_t i = 0; i < own->count; i++)
        all->held[piece * all->count + all->order[first_of(all, piece) + i]] = 1;
    for (size_t from = 0; from < all->pieces; from++)
        if (from != piece) {
            crease_tree *other = own_tree(context, all, from);
            ask(all, reaches.items, reaches.count, piece, other, from);
            crease_tree_free(other);
        }
    crease_reaches_free(&reaches);
    crease_tree_free(own);
}

static cut given_cut(crease_context *context, crease_cloud *cloud, size_t pieces, int k)
{
    cut all = {.cloud = cloud,
        .points = crease_cloud_points(cloud),
        .count = crease_cloud_count(cloud),
        .pieces = pieces};
    uint64_t *keys = malloc(all.count * sizeof *keys);
    all.order = malloc(all.count * sizeof *all.order);
    all.held = calloc(all.count, pieces);
    assert_int_equal(
        crease_morton_sort(context, all.points, all.count, keys, all.order), CREASE_OK);
    free(keys);
    for (size_t piece = 0; piece < pieces; piece++)
        complete(context, &all, piece, k);
    return all;
}

static void cut_free(cut *all)
{
    crease_cloud_free(all->cloud);
    free(all->order);
    free(all->held);
}

/* One piece in memory of its own. */
typedef struct held {
    crease_piece piece;
    double *points;
    uint32_t *numbers;
    uint8_t *own;
    crease_tree *tree;
} held;

static held hold(crease_context *context, const cut *all, size_t piece)
{
    held out = {.points = malloc(all->count * 3 * sizeof(double)),
        .numbers = malloc(all->count * sizeof(uint32_t)),
        .own = malloc(all->count)};
    size_t count = 0;
    for (size_t i = 0; i < all->count; i++)
        if (all->held[piece * all->count + i]) {
            memcpy(out.points + 3 * count, all->points + 3 * i, 3 * sizeof(double));
            out.own[count] = all->held[piece * all->count + i] == 1;
            out.numbers[count++] = (uint32_t)i;
        }
    out.piece = (crease_piece){count, out.points, out.numbers, out.own};
    assert_int_equal(crease_tree_create(context, out.points, count, &out.tree), CREASE_OK);
    return out;
}

static void let_go(held *piece)
{
    crease_tree_free(piece->tree);
    free(piece->points);
    free(piece->numbers);
    free(piece->own);
}

/* The scores of all pieces, one after another, as if each were far away. */
static void score_pieces(crease_context *context, const cut *all,
    const crease_detect_options *options, double *variance, uint8_t *features)
{
    held *pieces = malloc(all->pieces * sizeof *pieces);
    crease_scoring_counts *counts = calloc(1, sizeof *counts);
    double threshold = 0;
    for (size_t p = 0; p < all->pieces; p++) {
        pieces[p] = hold(context, all, p);
        double *own = calloc(pieces[p].piece.count, sizeof *own);
        const crease_scoring scoring = {
            .tree = pieces[p].tree, .piece = pieces[p].piece, .options = *options, .variance = own};
        assert_int_equal(crease_scoring_compute(context, &scoring, counts), CREASE_OK);
        for (size_t i = 0; i < pieces[p].piece.count; i++)
            if (pieces[p].own[i])
                variance[pieces[p].numbers[i]] = own[i];
        free(own);
    }
    assert_int_equal(crease_scoring_decide(context, counts, options, &threshold), CREASE_OK);
    for (size_t p = 0; p < all->pieces; p++) {
        const size_t count = pieces[p].piece.count;
        double *known = malloc(count * sizeof *known);
        uint8_t *marks = calloc(count, 1);
        for (size_t i = 0; i < count; i++)
            known[i] = variance[pieces[p].numbers[i]];
        const crease_scoring scoring = {.tree = pieces[p].tree,
            .piece = pieces[p].piece,
            .options = *options,
            .variance = known};
        assert_int_equal(
            crease_scoring_mark(context, &scoring, all->count, threshold, marks), CREASE_OK);
        for (size_t i = 0; i < count; i++)
            if (pieces[p].own[i])
                features[pieces[p].numbers[i]] = marks[i];
        free(known);
        free(marks);
        let_go(&pieces[p]);
    }
    free(counts);
    free(pieces);
}

static void expect_same(crease_cloud *cloud, size_t pieces, const crease_detect_options *options)
{
    crease_context *context = given_context();
    const size_t count = crease_cloud_count(cloud);
    cut all = given_cut(context, cloud, pieces, crease_scoring_reach(count, options));
    crease_scores *whole = NULL;
    double *variance = calloc(count, sizeof *variance);
    uint8_t *features = calloc(count, 1);
    assert_int_equal(crease_scores_compute(context, cloud, options, &whole), CREASE_OK);
    score_pieces(context, &all, options, variance, features);
    assert_memory_equal(variance, crease_scores_variance(whole), count * sizeof *variance);
    assert_memory_equal(features, crease_scores_features(whole), count);
    crease_scores_free(whole);
    free(variance);
    free(features);
    cut_free(&all);
    crease_context_free(context);
}

static crease_cloud *given_panel(size_t count)
{
    crease_context *context = given_context();
    crease_panel_options options = crease_panel_options_default();
    options.count = count;
    crease_cloud *cloud = NULL;
    assert_int_equal(crease_shape_panel(context, &options, &cloud), CREASE_OK);
    crease_context_free(context);
    return cloud;
}

static crease_cloud *given_cube(int intervals)
{
    crease_context *context = given_context();
    crease_cloud *cloud = NULL;
    assert_int_equal(crease_shape_cube(context, intervals, &cloud), CREASE_OK);
    crease_context_free(context);
    return cloud;
}

static void given_a_noisy_panel_in_pieces_then_scores_and_features_are_the_same_bytes(void **state)
{
    const crease_detect_options options = crease_detect_options_default();
    expect_same(given_panel(1500), 1, &options);
    expect_same(given_panel(1500), 3, &options);
    expect_same(given_panel(1500), 8, &options);
}

static void given_pieces_of_fewer_points_than_neighbours_then_nothing_changes(void **state)
{
    crease_detect_options options = crease_detect_options_default();
    options.neighbours = 12;
    options.resamples = 10;
    expect_same(given_panel(60), 9, &options);
    expect_same(given_panel(13), 5, &options);
}

static void given_equal_distances_then_they_are_ordered_as_in_the_whole_cloud(void **state)
{
    crease_detect_options options = crease_detect_options_default();
    options.detector = CREASE_DETECTOR_JACKKNIFE;
    options.neighbours = 7;
    expect_same(given_cube(12), 5, &options);
}

static void given_far_coordinates_then_rounding_hides_no_neighbour(void **state)
{
    crease_context *context = given_context();
    crease_cloud *near = given_cube(10), *far = NULL;
    const size_t count = crease_cloud_count(near);
    double *points = malloc(3 * count * sizeof *points);
    for (size_t i = 0; i < 3 * count; i++)
        points[i] = 1e13 + crease_cloud_points(near)[i];
    far = given_cloud_of(context, points, count);
    crease_detect_options options = crease_detect_options_default();
    options.resamples = 10;
    free(points);
    crease_cloud_free(near);
    crease_context_free(context);
    expect_same(far, 4, &options);
}

/* A panel, and points that are scattered far around it. */
static crease_cloud *given_outliers(size_t count)
{
    crease_context *context = given_context();
    crease_cloud *panel = given_panel(count), *cloud = NULL;
    double *points = malloc(3 * count * sizeof *points), low[3], high[3];
    crease_cloud_bounds(panel, low, high);
    memcpy(points, crease_cloud_points(panel), 3 * count * sizeof *points);
    uint32_t random = 1;
    for (size_t i = 0; i < 3 * count; i++) {
        random = random * 1664525u + 1013904223u;
        if (i / 3 % 40 == 0)
            points[i] = low[0] + (high[0] - low[0]) * 3.0 * ((double)random / 4294967296.0 - 0.5);
    }
    cloud = given_cloud_of(context, points, count);
    free(points);
    crease_cloud_free(panel);
    crease_context_free(context);
    return cloud;
}

static void given_outliers_then_pieces_ask_for_little_and_nothing_changes(void **state)
{
    crease_detect_options options = crease_detect_options_default();
    options.resamples = 10;
    expect_same(given_outliers(4000), 6, &options);
    crease_context *context = given_context();
    cut all = given_cut(context, given_outliers(20000), 4, 16);
    for (size_t piece = 0; piece < all.pieces; piece++) {
        size_t own = 0, others = 0;
        for (size_t i = 0; i < all.count; i++) {
            own += all.held[piece * all.count + i] == 1;
            others += all.held[piece * all.count + i] == 2;
        }
        assert_true(others < own); /* with one reach for each leaf they are nearly all there are */
    }
    cut_free(&all);
    crease_context_free(context);
}

static void given_the_boxes_of_a_tree_then_they_hold_all_its_points(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_panel(700);
    crease_tree *tree = NULL;
    double boxes[6 * 16];
    assert_int_equal(
        crease_tree_create(context, crease_cloud_points(cloud), 700, &tree), CREASE_OK);
    const size_t count = crease_tree_boxes(tree, 16, boxes);
    assert_in_range(count, 1, 16);
    for (size_t i = 0; i < 700; i++) {
        const double *const p = crease_cloud_points(cloud) + 3 * i;
        size_t holders = 0;
        for (const double *b = boxes; b < boxes + 6 * count; b += 6)
            holders += p[0] >= b[0] && p[1] >= b[1] && p[2] >= b[2] && p[0] <= b[3] &&
                p[1] <= b[4] && p[2] <= b[5];
        assert_true(holders > 0);
    }
    crease_tree_free(tree);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_a_noisy_panel_in_pieces_then_scores_and_features_are_the_same_bytes),
        cmocka_unit_test(given_pieces_of_fewer_points_than_neighbours_then_nothing_changes),
        cmocka_unit_test(given_equal_distances_then_they_are_ordered_as_in_the_whole_cloud),
        cmocka_unit_test(given_far_coordinates_then_rounding_hides_no_neighbour),
        cmocka_unit_test(given_outliers_then_pieces_ask_for_little_and_nothing_changes),
        cmocka_unit_test(given_the_boxes_of_a_tree_then_they_hold_all_its_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
