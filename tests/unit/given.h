/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What every test begins with: cmocka in its required include order, a context and a cloud. */
#ifndef CREASE_TESTS_GIVEN_H
#define CREASE_TESTS_GIVEN_H

/* Tests take a state that most do not need, callbacks a user. */
#pragma GCC diagnostic ignored "-Wunused-parameter"

#include "base/context.h"
#include "crease/crease.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static inline crease_context *given_context_with_threads(int threads)
{
    crease_context_options options = crease_context_options_default();
    options.threads = threads;
    crease_context *context = NULL;
    assert_int_equal(crease_context_create(&options, &context), CREASE_OK);
    return context;
}

/* Two threads; as many as CREASE_TEST_THREADS says where races are sought. */
static inline crease_context *given_context(void)
{
    const char *const threads = getenv("CREASE_TEST_THREADS");
    return given_context_with_threads(threads ? atoi(threads) : 2);
}

/* x, y, z of each point. */
static inline crease_cloud *given_cloud_of(
    crease_context *context, const double *points, size_t count)
{
    const crease_cloud_parts parts = {
        .count = count, .points = points, .coordinate_type = CREASE_TYPE_FLOAT64};
    crease_cloud *cloud = NULL;
    assert_int_equal(crease_cloud_create(context, &parts, &cloud), CREASE_OK);
    return cloud;
}

#define assert_near(a, b, tolerance)                                                               \
    do {                                                                                           \
        const double near_a = (a), near_b = (b), near_t = (tolerance);                             \
        if (!(fabs(near_a - near_b) <= near_t))                                                    \
            fail_msg("%s = %.17g, expected %.17g within %g", #a, near_a, near_b, near_t);          \
    } while (0)

#endif
