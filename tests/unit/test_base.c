/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/random.h"

/* Known answers published with the generator (Random123, kat_vectors). */
static void given_the_published_vectors_then_random_blocks_agree(void **state)
{
    uint32_t out[4];
    crease_random_block(0, 0, 0, out);
    assert_int_equal(out[0], 0x6627e8d5);
    assert_int_equal(out[1], 0xe169c58d);
    assert_int_equal(out[2], 0xbc57ac4c);
    assert_int_equal(out[3], 0x9b00dbd8);
    crease_random_block(UINT64_MAX, UINT64_MAX, UINT64_MAX, out);
    assert_int_equal(out[0], 0x408f276d);
    assert_int_equal(out[1], 0x41c83b0e);
    assert_int_equal(out[2], 0xa20bc7c6);
    assert_int_equal(out[3], 0x6d5451fd);
}

static void given_a_run_of_blocks_then_each_is_the_block_of_its_number(void **state)
{
    enum { COUNT = 37 };
    uint32_t run[4 * COUNT], block[4];
    crease_random_blocks(5, 9, UINT32_MAX - 10, COUNT, run);
    for (size_t i = 0; i < COUNT; i++) {
        crease_random_block(5, 9, (uint64_t)UINT32_MAX - 10 + i, block);
        assert_memory_equal(block, run + 4 * i, sizeof block);
    }
}

static void given_many_draws_then_moments_are_those_of_the_distribution(void **state)
{
    enum { COUNT = 200000 };
    double uniform = 0, mean = 0, square = 0;
    for (uint64_t i = 0; i < COUNT; i++) {
        const double normal = crease_random_normal(7, 3, i);
        uniform += crease_random_uniform(7, 2, i);
        mean += normal;
        square += normal * normal;
        assert_true(crease_random_below(7, 1, i, 17) < 17);
    }
    assert_near(uniform / COUNT, 0.5, 0.004);
    assert_near(mean / COUNT, 0.0, 0.012);
    assert_near(square / COUNT, 1.0, 0.016);
}

static void square(void *user, size_t begin, size_t end, int worker)
{
    for (size_t i = begin; i < end; i++)
        ((size_t *)user)[i] = i * i;
}

static void given_any_number_of_threads_then_every_item_is_done_once(void **state)
{
    for (int threads = 1; threads <= 4; threads++) {
        size_t items[1001] = {0};
        crease_context *context = given_context_with_threads(threads);
        assert_int_equal(crease_parallel_for(context, 1001, 10, square, items), CREASE_OK);
        for (size_t i = 0; i < 1001; i++)
            assert_int_equal(items[i], i * i);
        crease_context_free(context);
    }
}

static int stop(void *user)
{
    return 1;
}

static void given_a_caller_who_stops_then_work_ends_cancelled(void **state)
{
    crease_context_options options = crease_context_options_default();
    options.cancelled = stop;
    crease_context *context = NULL;
    assert_int_equal(crease_context_create(&options, &context), CREASE_OK);
    size_t items[100];
    assert_int_equal(crease_parallel_for(context, 100, 1, square, items), CREASE_ERROR_CANCELLED);
    assert_non_null(strstr(crease_context_message(context), "cancelled"));
    crease_context_free(context);
}

static void given_a_limit_then_that_allocation_fails_and_says_so(void **state)
{
    crease_context *context = given_context();
    crease_context_fail_allocation(context, 1);
    void *first = crease_allocate(context, 4, 8);
    assert_non_null(first);
    assert_null(crease_allocate(context, 4, 8));
    assert_non_null(strstr(crease_context_message(context), "memory"));
    void *third = crease_allocate(context, 4, 8);
    assert_non_null(third);
    free(first);
    free(third);
    assert_null(crease_allocate(context, SIZE_MAX / 2, 8));
    crease_context_free(context);
}

static void given_every_status_then_it_has_a_sentence_and_a_kind(void **state)
{
    for (int i = 0; i <= CREASE_ERROR_UNSUPPORTED; i++)
        assert_true(strlen(crease_status_sentence((crease_status)i)) > 5);
    assert_int_equal(crease_status_kind(CREASE_OK), CREASE_KIND_NONE);
    assert_int_equal(crease_status_kind((crease_status)999), CREASE_KIND_FAILURE);
    assert_int_equal(crease_status_kind(CREASE_ERROR_VALUE), CREASE_KIND_INPUT);
}

static void given_a_wrong_number_of_threads_then_no_context(void **state)
{
    crease_context_options options = crease_context_options_default();
    options.threads = -1;
    crease_context *context = NULL;
    assert_int_equal(crease_context_create(&options, &context), CREASE_ERROR_ARGUMENT);
    assert_null(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_the_published_vectors_then_random_blocks_agree),
        cmocka_unit_test(given_a_run_of_blocks_then_each_is_the_block_of_its_number),
        cmocka_unit_test(given_many_draws_then_moments_are_those_of_the_distribution),
        cmocka_unit_test(given_any_number_of_threads_then_every_item_is_done_once),
        cmocka_unit_test(given_a_caller_who_stops_then_work_ends_cancelled),
        cmocka_unit_test(given_a_limit_then_that_allocation_fails_and_says_so),
        cmocka_unit_test(given_every_status_then_it_has_a_sentence_and_a_kind),
        cmocka_unit_test(given_a_wrong_number_of_threads_then_no_context),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
