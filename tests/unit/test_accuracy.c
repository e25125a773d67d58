/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "fit/accuracy.h"

static const double H = 0.03125;

static crease_accuracy when_measured(
    crease_context *context, const crease_sample_options *options, bool averaging)
{
    crease_cloud *cloud = NULL;
    crease_sheet *sheet = NULL;
    assert_int_equal(crease_shape_sample(context, options, &cloud), CREASE_OK);
    assert_int_equal(averaging ? crease_averaging_fit(context, cloud, NULL, &sheet)
                               : crease_sheet_fit(context, cloud, NULL, &sheet),
        CREASE_OK);
    const crease_roof roof = crease_shape_sample_truth(options);
    const crease_accuracy accuracy = crease_accuracy_measure(sheet, &roof);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    return accuracy;
}

static void given_the_papers_sample_then_knots_are_exact_and_rows_are_not(void **state)
{
    crease_context *context = given_context();
    crease_sample_options options = crease_sample_options_default();
    for (int roof = 0; roof < 2; roof++) {
        options.roof = roof;
        const crease_accuracy knots = when_measured(context, &options, false);
        assert_int_equal(knots.lines, 1);
        assert_near(knots.position, 0, 0.02 * H);
        assert_near(knots.angle, 90, 0.5);
        assert_true(knots.width == 0);
        assert_true(knots.rms < 1e-3 * H && knots.max < 1e-3 * H);
        const crease_accuracy rows = when_measured(context, &options, true);
        assert_int_equal(rows.lines, 2);
        assert_near(rows.position / H, 1.33, 0.05);
        assert_true(rows.width > 0.0706 && rows.width < 0.11);
        assert_true(rows.max > 0.5 * H && rows.max < H);
        assert_true(rows.rms > 0.1 * H && rows.rms < rows.max);
    }
    crease_context_free(context);
}

static void given_no_crease_line_then_position_is_not_a_number(void **state)
{
    crease_context *context = given_context();
    crease_sample_options options = crease_sample_options_default();
    options.across = 3, options.along = 17;
    const crease_accuracy accuracy = when_measured(context, &options, true);
    assert_int_equal(accuracy.lines, 0);
    assert_true(isnan(accuracy.position));
    assert_near(accuracy.angle, 180, 0);
    assert_true(accuracy.width > 0 && accuracy.max > 0);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_the_papers_sample_then_knots_are_exact_and_rows_are_not),
        cmocka_unit_test(given_no_crease_line_then_position_is_not_a_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
