/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A cloud that is worked on in parts, from file to file: what it says of its points is what the
 * whole cloud says. */
#include "given.h"

#include "crease/crease_stream.h"
#include "stream/overview.h"

#include <unistd.h>

enum { LEAST = 8000000 }; /* the least limit */

static char folder[] = "/tmp/crease-test-XXXXXX";
static char input[64], output[64];

static int make_folder(void **state)
{
    assert_non_null(mkdtemp(folder));
    snprintf(input, sizeof input, "%s/in.ply", folder);
    snprintf(output, sizeof output, "%s/out.ply", folder);
    return 0;
}

static int remove_folder(void **state)
{
    unlink(input);
    unlink(output);
    return rmdir(folder); /* fails when anything else is left there */
}

/* A scan of a part, many of whose points are far from it. */
static crease_cloud *given_scan(crease_context *context, size_t count, double outliers)
{
    crease_bracket_options options = crease_bracket_options_default();
    crease_cloud *cloud = NULL;
    options.count = count;
    options.outliers = outliers;
    assert_int_equal(crease_shape_bracket(context, &options, &cloud), CREASE_OK);
    assert_int_equal(crease_cloud_write(context, cloud, input), CREASE_OK);
    return cloud;
}

static crease_stream_options given_options(bool by_score)
{
    crease_stream_options options = crease_stream_options_default();
    options.detect.detector = CREASE_DETECTOR_JACKKNIFE;
    options.memory = LEAST;
    options.by_score = by_score;
    return options;
}

/* What is known of the whole cloud, in memory. */
typedef struct whole {
    crease_scores *scores;
    crease_regions *regions;
    crease_network *network;
} whole;

static whole look_at_all(
    crease_context *context, const crease_cloud *cloud, const crease_stream_options *options)
{
    whole all = {0};
    assert_int_equal(
        crease_scores_compute(context, cloud, &options->detect, &all.scores), CREASE_OK);
    assert_int_equal(
        crease_regions_find(context, cloud, &options->regions, &all.regions), CREASE_OK);
    assert_int_equal(crease_network_find(context, all.regions, NULL, &all.network), CREASE_OK);
    return all;
}

static void whole_free(whole *all)
{
    crease_network_free(all->network);
    crease_regions_free(all->regions);
    crease_scores_free(all->scores);
}

/* What was written, and told. */
typedef struct streamed {
    crease_stream_summary summary;
    crease_regions *regions;
    crease_network *network;
    crease_cloud *cloud;
    const float *variance;
    const uint8_t *feature;
    const int32_t *region;
} streamed;

static streamed stream(crease_context *context, const crease_stream_options *options)
{
    streamed out = {0};
    assert_int_equal(crease_detect_stream(
                         context, input, options, output, &out.summary, &out.regions, &out.network),
        CREASE_OK);
    assert_int_equal(crease_cloud_read(context, output, NULL, &out.cloud), CREASE_OK);
    assert_int_equal(crease_cloud_count(out.cloud), out.summary.count);
    const size_t fields = crease_cloud_field_count(out.cloud);
    out.variance = crease_cloud_field(out.cloud, fields - 3).values;
    out.feature = crease_cloud_field(out.cloud, fields - 2).values;
    out.region = crease_cloud_field(out.cloud, fields - 1).values;
    return out;
}

static void streamed_free(streamed *out)
{
    crease_cloud_free(out->cloud);
    crease_network_free(out->network);
    crease_regions_free(out->regions);
}

static void expect_same_points(const crease_cloud *cloud, const streamed *out)
{
    const size_t count = crease_cloud_count(cloud);
    assert_int_equal(out->summary.count, count);
    for (size_t i = 0; i < 3 * count; i++)
        assert_near(crease_cloud_points(out->cloud)[i], crease_cloud_points(cloud)[i], 0);
}

static void expect_same_scores(const crease_scores *scores, const streamed *out)
{
    for (size_t i = 0; i < out->summary.count; i++)
        assert_near(out->variance[i], (float)crease_scores_variance(scores)[i], 0);
}

static void given_outliers_far_away_then_parts_have_the_scores_of_the_whole(void **state)
{
    crease_context *context = given_context();
    const crease_stream_options options = given_options(true);
    crease_cloud *cloud = given_scan(context, 30000, 0.05);
    crease_scores *scores = NULL;
    assert_int_equal(crease_scores_compute(context, cloud, &options.detect, &scores), CREASE_OK);
    streamed out = stream(context, &options);
    assert_in_range(out.summary.parts, 2, 4); /* what is around a part is no multiple of it */
    expect_same_points(cloud, &out);
    expect_same_scores(scores, &out);
    assert_memory_equal(out.feature, crease_scores_features(scores), out.summary.count);
    streamed_free(&out);
    crease_scores_free(scores);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

/* The share of points that two labellings put into the same region: those of the first with most
 * points of one of the second. */
static double agreement(const int32_t *labels, size_t regions, const int32_t *others, size_t count)
{
    size_t *pairs = calloc((regions + 1) * 64, sizeof *pairs), same = 0;
    for (size_t i = 0; i < count; i++) {
        assert_in_range(others[i] + 1, 0, 63);
        pairs[(size_t)(labels[i] + 1) * 64 + (size_t)(others[i] + 1)]++;
    }
    for (size_t r = 0; r <= regions; r++) {
        size_t most = 0;
        for (size_t o = 0; o < 64; o++)
            most = pairs[r * 64 + o] > most ? pairs[r * 64 + o] : most;
        same += most;
    }
    free(pairs);
    return (double)same / (double)count;
}

static void given_a_sample_then_every_point_is_labelled_as_the_whole_cloud_would(void **state)
{
    crease_context *context = given_context();
    const crease_stream_options options = given_options(false);
    crease_cloud *cloud = given_scan(context, 30000, 0.005);
    whole all = look_at_all(context, cloud, &options);
    streamed out = stream(context, &options);
    const uint8_t *const features = crease_network_features(all.network);
    const size_t count = out.summary.count, regions = crease_regions_count(all.regions);
    size_t found = 0, wrong = 0, outliers = 0, sum = 0;
    for (size_t i = 0; i < count; i++) {
        found += features[i];
        wrong += features[i] != out.feature[i];
        outliers += out.region[i] < 0;
    }
    assert_in_range(out.summary.sampled, 5000, 8000);
    expect_same_scores(all.scores, &out);
    assert_true(agreement(crease_regions_labels(all.regions), regions, out.region, count) > 0.97);
    assert_true(found > 500 && wrong < found / 8);
    assert_near(out.summary.spacing, crease_network_spacing(all.network),
        0.03 * crease_network_spacing(all.network));
    assert_int_equal(out.summary.outliers, outliers);
    for (size_t r = 0; r < crease_regions_count(out.regions); r++)
        sum += crease_regions_at(out.regions, r).point_count;
    assert_int_equal(sum + outliers, count);
    streamed_free(&out);
    whole_free(&all);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_a_cloud_that_fits_then_all_is_as_from_memory(void **state)
{
    crease_context *context = given_context();
    const crease_stream_options options = given_options(false);
    crease_cloud *cloud = given_scan(context, 5000, 0.005);
    whole all = look_at_all(context, cloud, &options);
    streamed out = stream(context, &options);
    const size_t count = out.summary.count;
    assert_int_equal(out.summary.sampled, count);
    expect_same_scores(all.scores, &out);
    assert_memory_equal(out.feature, crease_network_features(all.network), count);
    assert_memory_equal(out.region, crease_regions_labels(all.regions), count * sizeof(int32_t));
    streamed_free(&out);
    whole_free(&all);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_other_numbers_of_threads_then_the_same_bytes(void **state)
{
    crease_context *one = given_context_with_threads(1), *three = given_context_with_threads(3);
    const crease_stream_options options = given_options(false);
    crease_cloud *cloud = given_scan(one, 12000, 0.02);
    streamed a = stream(one, &options), b = stream(three, &options);
    const size_t count = a.summary.count;
    assert_memory_equal(a.variance, b.variance, count * sizeof(float));
    assert_memory_equal(a.feature, b.feature, count);
    assert_memory_equal(a.region, b.region, count * sizeof(int32_t));
    streamed_free(&a);
    streamed_free(&b);
    crease_cloud_free(cloud);
    crease_context_free(one);
    crease_context_free(three);
}

static void given_a_sample_then_it_is_of_the_file_from_beginning_to_end(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_scan(context, 5000, 0), *sample = NULL;
    size_t total = 0;
    assert_int_equal(
        crease_cloud_read_sample(context, input, NULL, 1000, &sample, &total), CREASE_OK);
    assert_int_equal(total, 5000);
    assert_int_equal(crease_cloud_count(sample), 1000);
    for (size_t i = 0; i < 1000; i++) { /* one of every five points */
        size_t matches = 0;
        for (size_t j = 5 * i; j < 5 * i + 5; j++)
            matches += memcmp(crease_cloud_points(sample) + 3 * i,
                           crease_cloud_points(cloud) + 3 * j, 3 * sizeof(double)) == 0;
        assert_int_equal(matches, 1);
    }
    crease_cloud_free(sample);
    assert_int_equal(
        crease_cloud_read_sample(context, input, NULL, 9000, &sample, &total), CREASE_OK);
    assert_memory_equal(crease_cloud_points(sample), crease_cloud_points(cloud), 5000 * 24);
    crease_cloud_free(sample);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_what_cannot_be_then_a_status_and_nothing_is_left(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_scan(context, 3000, 0);
    crease_stream_options options = given_options(false);
    crease_stream_summary summary;
    crease_regions *regions = NULL;
    crease_network *network = NULL;
    unlink(output);
    options.memory = 1000;
    assert_int_equal(
        crease_detect_stream(context, input, &options, output, &summary, &regions, &network),
        CREASE_ERROR_ARGUMENT);
    options = given_options(false);
    options.scratch = "/no/such/folder";
    assert_int_equal(
        crease_detect_stream(context, input, &options, output, &summary, &regions, &network),
        CREASE_ERROR_CANNOT_WRITE);
    assert_null(regions);
    assert_null(network);
    options = given_options(false);
    assert_int_equal(
        crease_detect_stream(context, folder, &options, output, &summary, &regions, &network),
        CREASE_ERROR_UNSUPPORTED);
    assert_int_not_equal(access(output, F_OK), 0);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_allocations_that_fail_then_nothing_is_lost(void **state)
{
    crease_context *context = given_context_with_threads(1);
    const crease_stream_options options = given_options(true);
    crease_cloud *cloud = given_scan(context, 800, 0.01);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    size_t failures = 0;
    for (long n = 0; status != CREASE_OK; n += 1 + n / 4) {
        crease_stream_summary summary;
        crease_regions *regions = NULL;
        crease_network *network = NULL;
        unlink(output);
        crease_context_fail_allocation(context, n);
        status =
            crease_detect_stream(context, input, &options, output, &summary, &regions, &network);
        crease_context_fail_allocation(context, -1);
        assert_true(status == CREASE_OK || status == CREASE_ERROR_NO_MEMORY);
        assert_true(n < 1000000);
        assert_int_equal(access(output, F_OK) == 0, status == CREASE_OK);
        failures += status != CREASE_OK;
        crease_network_free(network);
        crease_regions_free(regions);
    }
    assert_int_equal(status, CREASE_OK);
    assert_true(failures > 8);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

/* What the labels of all of a cloud's points are, the sample's own among them. */
static crease_found labels_of(
    crease_context *context, crease_labelling *labelling, const crease_cloud *cloud)
{
    const size_t count = crease_cloud_count(cloud);
    crease_tree *tree = NULL;
    crease_found found;
    uint8_t *own = malloc(count);
    assert_non_null(own);
    memset(own, 1, count);
    const crease_piece piece = {count, crease_cloud_points(cloud), NULL, own};
    assert_int_equal(
        crease_tree_create(context, crease_cloud_points(cloud), count, &tree), CREASE_OK);
    assert_int_equal(crease_found_create(context, count, &found), CREASE_OK);
    assert_int_equal(crease_label(context, labelling, &piece, tree, &found), CREASE_OK);
    crease_tree_free(tree);
    free(own);
    return found;
}

static void expect_same_labels(crease_context *context, const crease_cloud *cloud,
    crease_labelling *one, crease_labelling *other)
{
    const size_t count = crease_cloud_count(cloud), regions = one->regions->region_count;
    crease_found a = labels_of(context, one, cloud), b = labels_of(context, other, cloud);
    size_t features = 0;
    for (size_t i = 0; i < count; i++)
        features += a.features[i];
    assert_in_range(features, 1, count - 1);
    assert_memory_equal(a.regions, b.regions, count * sizeof *a.regions);
    assert_memory_equal(a.distances, b.distances, count * sizeof *a.distances);
    assert_memory_equal(a.features, b.features, count);
    assert_int_equal(other->regions->region_count, regions);
    assert_memory_equal(one->sizes, other->sizes, regions * sizeof *one->sizes);
    assert_memory_equal(one->squares, other->squares, regions * sizeof *one->squares);
    crease_found_free(&a);
    crease_found_free(&b);
}

static void given_labelling_as_bytes_then_another_process_labels_alike(void **state)
{
    crease_context *context = given_context_with_threads(1);
    crease_cloud *cloud = given_scan(context, 5000, 0.01), *sample = NULL;
    crease_overview overview = {0};
    crease_regions *regions = NULL;
    crease_network *network = NULL;
    crease_labelling other;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    size_t total = 0, size = 0;
    char *bytes = NULL;
    assert_int_equal(
        crease_cloud_read_sample(context, input, NULL, 2500, &sample, &total), CREASE_OK);
    assert_int_equal(crease_regions_find(context, sample, NULL, &overview.regions), CREASE_OK);
    assert_int_equal(
        crease_network_find(context, overview.regions, NULL, &overview.network), CREASE_OK);
    assert_int_equal(crease_labelling_create(
                         context, overview.regions, overview.network, total, &overview.labelling),
        CREASE_OK);
    assert_int_equal(crease_labelling_pack(context, &overview.labelling, &bytes, &size), CREASE_OK);
    for (long n = 0; status != CREASE_OK; n++) {
        crease_context_fail_allocation(context, n);
        status = crease_labelling_unpack(context, bytes, &regions, &network, &other);
        crease_context_fail_allocation(context, -1);
        assert_true(n < 10000 && (status == CREASE_OK || status == CREASE_ERROR_NO_MEMORY));
        assert_int_equal(regions != NULL, status == CREASE_OK);
    }
    expect_same_labels(context, cloud, &overview.labelling, &other);
    crease_labelling_free(&other);
    crease_network_free(network);
    crease_regions_free(regions);
    free(bytes);
    crease_overview_free(&overview);
    crease_cloud_free(sample);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SANITIZED 1 /* no limit is kept then */
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED 1
#endif

static void given_a_limit_of_memory_then_what_is_beyond_is_refused(void **state)
{
#ifdef SANITIZED
    skip();
#endif
    crease_context_options options = crease_context_options_default();
    crease_context *context = NULL;
    crease_cloud *cloud = NULL;
    crease_bracket_options bracket = crease_bracket_options_default();
    bracket.count = 20000;
    options.memory = 1 << 20; /* less than the process has */
    assert_int_equal(crease_context_create(&options, &context), CREASE_OK);
    assert_int_equal(crease_shape_bracket(context, &bracket, &cloud), CREASE_ERROR_NO_MEMORY);
    assert_non_null(strstr(crease_context_message(context), "within the limit"));
    crease_context_free(context);
    options.memory = (size_t)1 << 40;
    assert_int_equal(crease_context_create(&options, &context), CREASE_OK);
    assert_int_equal(crease_shape_bracket(context, &bracket, &cloud), CREASE_OK);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_outliers_far_away_then_parts_have_the_scores_of_the_whole),
        cmocka_unit_test(given_a_sample_then_every_point_is_labelled_as_the_whole_cloud_would),
        cmocka_unit_test(given_a_cloud_that_fits_then_all_is_as_from_memory),
        cmocka_unit_test(given_other_numbers_of_threads_then_the_same_bytes),
        cmocka_unit_test(given_a_sample_then_it_is_of_the_file_from_beginning_to_end),
        cmocka_unit_test(given_what_cannot_be_then_a_status_and_nothing_is_left),
        cmocka_unit_test(given_allocations_that_fail_then_nothing_is_lost),
        cmocka_unit_test(given_labelling_as_bytes_then_another_process_labels_alike),
        cmocka_unit_test(given_a_limit_of_memory_then_what_is_beyond_is_refused),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
