/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given_faces.h"

#include "base/vector.h"
#include "primitive/fitter.h"
#include "primitive/patch.h"
#include "primitive/primitive.h"
#include "primitive/uncertainty.h"

/* The primitives that the tests measure, in a frame along no axis, far from the origin. */
static crease_model given_model(crease_region_type type)
{
    crease_model model = {.type = type,
        .centre = {12, -7, 30},
        .axes = {0, 0, 0, 0, 0, 0, 2 / 7.0, 3 / 7.0, 6 / 7.0},
        .radius = 2,
        .shape = type == CREASE_REGION_CONE ? 0.4
            : type == CREASE_REGION_TORUS   ? 0.7
                                            : 0};
    crease_primitive_frame(model.axes);
    return model;
}

/* The point of the surface with parameters u, v = 0..1; turn: the part of the full circle that u
 * takes. */
static void surface_point(
    const crease_model *model, double u, double v, double turn, double point[3], double normal[3])
{
    const double pi = acos(-1.0), a = 2 * pi * turn * u, c = cos(a), s = sin(a);
    const double b = pi * (v - 0.5), t = 2 * pi * v, z = 3 * (v - 0.5), r = model->radius;
    double p[3] = {3 * (u - 0.5), z, 0}, n[3] = {0, 0, 1};
    if (model->type == CREASE_REGION_SPHERE) {
        memcpy(n, (double[]){c * cos(b), s * cos(b), sin(b)}, sizeof n);
        memcpy(p, (double[]){r * n[0], r * n[1], r * n[2]}, sizeof p);
    } else if (model->type == CREASE_REGION_CYLINDER || model->type == CREASE_REGION_CONE) {
        const double at = r + model->shape * z, k = 1 / hypot(1, model->shape);
        memcpy(n, (double[]){k * c, k * s, -k * model->shape}, sizeof n);
        memcpy(p, (double[]){at * c, at * s, z}, sizeof p);
    } else if (model->type == CREASE_REGION_TORUS) {
        const double at = r + model->shape * cos(t);
        memcpy(n, (double[]){c * cos(t), s * cos(t), sin(t)}, sizeof n);
        memcpy(p, (double[]){at * c, at * s, model->shape * sin(t)}, sizeof p);
    }
    for (int k = 0; k < 3; k++) {
        point[k] = model->centre[k];
        normal[k] = 0;
        for (int row = 0; row < 3; row++) {
            point[k] += p[row] * model->axes[3 * row + k];
            normal[k] += n[row] * model->axes[3 * row + k];
        }
    }
}

/* Random points of the surface, with noise along the normal. */
static void fill_sample(crease_sample *sample, const crease_model *model, size_t count, double turn,
    double sigma, uint64_t variant)
{
    sample->count = count;
    memcpy(sample->origin, model->centre, sizeof sample->origin);
    sample->origin[0] += 1;
    for (size_t i = 0; i < count; i++) {
        double point[3];
        surface_point(model, crease_random_uniform(variant, 1, i),
            crease_random_uniform(variant, 2, i), turn, point, sample->normals + 3 * i);
        const double noise = sigma * crease_random_normal(variant, 3, i);
        for (size_t c = 0; c < 3; c++)
            sample->points[3 * i + c] =
                point[c] - sample->origin[c] + noise * sample->normals[3 * i + c];
    }
}

struct bench {
    crease_context *context;
    crease_fitter *fitters;
};

static struct bench given_fitter(double sigma)
{
    struct bench bench = {.context = given_context()};
    assert_int_equal(crease_fitters_create(bench.context, &bench.fitters), CREASE_OK);
    bench.fitters[0].sigma = sigma;
    return bench;
}

static void end(struct bench *bench)
{
    crease_fitters_free(bench->context, bench->fitters);
    crease_context_free(bench->context);
}

static const char *const names[] = {"plane", "sphere", "cylinder", "cone", "torus", "free form"};

/* ---------------------------------------------------------------------------------- distance -- */

static void random_place(const crease_model *model, uint64_t i, double out[3])
{
    for (uint64_t c = 0; c < 3; c++)
        out[c] = model->centre[c] + 5 * (crease_random_uniform(5, i, c) - 0.5);
}

static void distances_are_those_of_the_nearest_point(void **state)
{
    enum { FINE = 400 };
    for (int type = CREASE_REGION_SPHERE; type <= CREASE_REGION_TORUS; type++) {
        const crease_model model = given_model((crease_region_type)type);
        for (uint64_t i = 0; i < 20; i++) {
            double place[3], gradient[3], point[3], normal[3], nearest = INFINITY;
            surface_point(&model, crease_random_uniform(9, 1, i),
                0.3 + 0.4 * crease_random_uniform(9, 2, i), 1, place, normal);
            const double off = 0.6 * (crease_random_uniform(9, 3, i) - 0.5);
            for (int c = 0; c < 3; c++)
                place[c] += off * normal[c];
            const double distance = crease_model_distance(&model, place, gradient);
            assert_near(distance, off, 1e-12);
            for (int a = 0; a < FINE; a++)
                for (int b = 0; b < FINE; b++) {
                    surface_point(&model, a / (double)FINE, b / (double)FINE, 1, point, normal);
                    nearest = fmin(nearest, crease_vector_distance(point, place));
                }
            assert_near(fabs(distance), nearest, 0.02);
        }
    }
}

static void gradients_are_the_slopes_of_distances(void **state)
{
    const double h = 1e-5;
    for (int type = CREASE_REGION_PLANE; type <= CREASE_REGION_TORUS; type++) {
        const crease_model model = given_model((crease_region_type)type);
        for (uint64_t i = 0; i < 50; i++) {
            double place[3], gradient[3], other[3];
            random_place(&model, i, place);
            crease_model_distance(&model, place, gradient);
            assert_near(crease_vector_length(gradient), 1, 1e-14);
            for (int c = 0; c < 3; c++) {
                double sides[2];
                for (int side = 0; side < 2; side++) {
                    memcpy(other, place, sizeof other);
                    other[c] += side ? h : -h;
                    double unused[3];
                    sides[side] = crease_model_distance(&model, other, unused);
                }
                assert_near(gradient[c], (sides[1] - sides[0]) / (2 * h), 1e-7);
            }
        }
    }
}

static void gradients_exist_on_axes_and_in_centres(void **state)
{
    for (int type = CREASE_REGION_PLANE; type <= CREASE_REGION_TORUS; type++) {
        const crease_model model = given_model((crease_region_type)type);
        double gradient[3];
        assert_true(isfinite(crease_model_distance(&model, model.centre, gradient)));
        assert_near(crease_vector_length(gradient), 1, 1e-14);
    }
}

static void derivatives_are_those_of_small_changes(void **state)
{
    const double h = 1e-6;
    for (int type = CREASE_REGION_PLANE; type <= CREASE_REGION_TORUS; type++) {
        const crease_model model = given_model((crease_region_type)type);
        for (uint64_t i = 0; i < 20; i++) {
            double place[3], gradient[3], unused[3], out[CREASE_PRIMITIVE_PARAMETERS];
            const double pivot[3] = {11, -6, 29};
            random_place(&model, i, place);
            const double distance = crease_model_distance(&model, place, gradient);
            crease_primitive_derivatives(&model, place, distance, gradient, pivot, out);
            for (int k = 0; k < CREASE_PRIMITIVE_PARAMETERS; k++) {
                double sides[2];
                for (int side = 0; side < 2; side++) {
                    double step[CREASE_PRIMITIVE_PARAMETERS] = {0};
                    step[k] = side ? h : -h;
                    crease_model changed = model;
                    crease_primitive_change(&changed, pivot, step);
                    sides[side] = crease_model_distance(&changed, place, unused);
                }
                const double slope = (sides[1] - sides[0]) / (2 * h);
                const bool fixed = (k == 6 && type == CREASE_REGION_PLANE) ||
                    (k == 7 && type != CREASE_REGION_CONE && type != CREASE_REGION_TORUS) ||
                    (k >= 3 && k < 6 && type == CREASE_REGION_SPHERE);
                assert_near(out[k], fixed ? 0 : slope, 1e-7);
            }
        }
    }
}

/* -------------------------------------------------------------------------------------- fits -- */

/* Largest distance of the true surface (of the part that was sampled) from the model. */
static double worst_distance(const crease_model *truth, const crease_model *model, double turn)
{
    double worst = 0, point[3], normal[3];
    for (int a = 0; a <= 20; a++)
        for (int b = 0; b <= 20; b++) {
            surface_point(truth, a / 20.0, b / 20.0, turn, point, normal);
            worst = fmax(worst, fabs(crease_model_distance(model, point, normal)));
        }
    return worst;
}

static void exact_samples_give_exact_primitives(void **state)
{
    static const double turns[] = {1, 0.4, 30 / 360.0};
    struct bench bench = given_fitter(1e-3);
    crease_fitter *const fitter = &bench.fitters[0];
    for (int type = CREASE_REGION_PLANE; type <= CREASE_REGION_TORUS; type++)
        for (int part = 0; part < 3; part++) {
            const crease_model truth = given_model((crease_region_type)type);
            fill_sample(&fitter->sample, &truth, 300, turns[part], 0, 1);
            if (!crease_fit_kind(fitter, &fitter->sample, truth.type, NULL))
                fail_msg("no %s over %g", names[type], turns[part]);
            assert_near(worst_distance(&truth, &fitter->best, turns[part]), 0, 1e-9);
            if (type != CREASE_REGION_PLANE)
                assert_near(fitter->best.radius + 0 * type,
                    type == CREASE_REGION_CONE ? fitter->best.radius : truth.radius, 1e-8);
            if (type == CREASE_REGION_CONE || type == CREASE_REGION_TORUS) {
                const double sign =
                    crease_vector_dot(fitter->best.axes + 6, truth.axes + 6) > 0 ? 1 : -1;
                const double shape = (type == CREASE_REGION_CONE ? sign : 1) * fitter->best.shape;
                assert_near(shape, truth.shape, 1e-8);
            }
        }
    end(&bench);
}

/* Mean square of the error of the surface in units of its own standard error, over some samples. */
static double mean_squared_error(
    crease_fitter *fitter, const crease_model *truth, double turn, double sigma, double *worst)
{
    double sum = 0;
    size_t count = 0;
    for (uint64_t variant = 0; variant < 12; variant++) {
        fill_sample(&fitter->sample, truth, 400, turn, sigma, variant + 10);
        assert_true(crease_fit_kind(fitter, &fitter->sample, truth->type, NULL));
        crease_fit_covariance(fitter, &fitter->sample, &fitter->best);
        for (int a = 0; a < 7; a++)
            for (int b = 0; b < 7; b++) {
                double point[3], normal[3];
                surface_point(truth, (a + 0.5) / 7, (b + 0.5) / 7, turn, point, normal);
                const double d = crease_model_distance(&fitter->best, point, normal);
                const double square = d * d / crease_model_variance(&fitter->best, point);
                *worst = fmax(*worst, square);
                sum += square;
                count++;
            }
    }
    return sum / (double)count;
}

static void noisy_fits_are_as_good_as_they_say(void **state)
{
    static const double turns[] = {1, 30 / 360.0};
    const double sigma = 0.02;
    struct bench bench = given_fitter(sigma);
    for (int type = CREASE_REGION_PLANE; type <= CREASE_REGION_TORUS; type++)
        for (int part = 0; part < 2; part++) {
            const crease_model truth = given_model((crease_region_type)type);
            double worst = 0;
            const double mean =
                mean_squared_error(&bench.fitters[0], &truth, turns[part], sigma, &worst);
            if (mean < 0.4 || mean > 2.5 || worst > 25)
                fail_msg("%s over %g: errors squared, over their variance: mean %g, worst %g",
                    names[type], turns[part], mean, worst);
        }
    end(&bench);
}

/* How far a model's parameters are from the true ones, in the sense of crease_uncertainty. */
static crease_uncertainty true_errors(const crease_model *model, const crease_model *truth)
{
    double d[3];
    for (int c = 0; c < 3; c++)
        d[c] = model->centre[c] - truth->centre[c];
    const crease_region_type type = truth->type;
    const double along = crease_vector_dot(d, truth->axes + 6);
    const double across = sqrt(fmax(crease_vector_dot(d, d) - along * along, 0));
    const double cosine = crease_vector_dot(model->axes + 6, truth->axes + 6);
    const double sign = cosine < 0 ? -1 : 1;
    /* what the true radius is where the found centre is */
    const double radius = truth->radius + (type == CREASE_REGION_CONE ? along * truth->shape : 0);
    return (crease_uncertainty){.place = type == CREASE_REGION_PLANE       ? fabs(along)
            : type == CREASE_REGION_CYLINDER || type == CREASE_REGION_CONE ? across
                                                                           : hypot(along, across),
        .direction = type == CREASE_REGION_SPHERE ? 0 : acos(fmin(fabs(cosine), 1)),
        .radius = type == CREASE_REGION_PLANE ? 0 : fabs(model->radius - radius),
        .shape = type == CREASE_REGION_CONE ? fabs(sign * model->shape - truth->shape)
            : type == CREASE_REGION_TORUS   ? fabs(model->shape - truth->shape)
                                            : 0};
}

static void assert_ratio(const char *kind, const char *what, double turn, double sum, double of)
{
    if (of == 0 && sum == 0)
        return;
    if (!(sum > 0.6 * of && sum < 1.6 * of))
        fail_msg(
            "%s over %g: squared error of its %s %g, said to be %g", kind, turn, what, sum, of);
}

static void parameters_err_as_much_as_they_say(void **state)
{
    enum { SAMPLES = 150, POINTS = 300 };
    static const double turns[] = {1, 0.3};
    const double sigma = 0.02;
    struct bench bench = given_fitter(sigma);
    crease_fitter *const fitter = &bench.fitters[0];
    for (int type = CREASE_REGION_PLANE; type <= CREASE_REGION_TORUS; type++)
        for (int part = 0; part < 2; part++) {
            const crease_model truth = given_model((crease_region_type)type);
            crease_uncertainty err = {0}, said = {0};
            for (uint64_t i = 0; i < SAMPLES; i++) {
                fill_sample(&fitter->sample, &truth, POINTS, turns[part], sigma, 100 + i);
                assert_true(crease_fit_kind(fitter, &fitter->sample, truth.type, &truth));
                crease_fit_covariance(fitter, &fitter->sample, &fitter->best);
                const crease_uncertainty e = true_errors(&fitter->best, &truth);
                const crease_uncertainty u = crease_model_uncertainty(&fitter->best, NULL);
                err.place += e.place * e.place, said.place += u.place * u.place;
                err.direction += e.direction * e.direction;
                said.direction += u.direction * u.direction;
                err.radius += e.radius * e.radius, said.radius += u.radius * u.radius;
                err.shape += e.shape * e.shape, said.shape += u.shape * u.shape;
            }
            assert_ratio(names[type], "place", turns[part], err.place, said.place);
            assert_ratio(names[type], "direction", turns[part], err.direction, said.direction);
            assert_ratio(names[type], "radius", turns[part], err.radius, said.radius);
            assert_ratio(names[type], "shape", turns[part], err.shape, said.shape);
        }
    end(&bench);
}

/* A square of side 3 with n points: sigma / sqrt(n), and that over 3 / sqrt(12), for each of two
 * directions. */
static void errors_of_a_plane_are_the_textbook_ones(void **state)
{
    const double sigma = 0.02, n = 300;
    struct bench bench = given_fitter(sigma);
    crease_fitter *const fitter = &bench.fitters[0];
    const crease_model truth = given_model(CREASE_REGION_PLANE);
    fill_sample(&fitter->sample, &truth, (size_t)n, 1, sigma, 3);
    assert_true(crease_fit_kind(fitter, &fitter->sample, truth.type, &truth));
    crease_fit_covariance(fitter, &fitter->sample, &fitter->best);
    const crease_uncertainty u = crease_model_uncertainty(&fitter->best, NULL);
    assert_near(u.place / (sigma / sqrt(n)), 1, 0.15);
    assert_near(u.direction / (sigma / sqrt(n) * sqrt(2) / (3 / sqrt(12))), 1, 0.15);
    assert_true(u.radius == 0 && u.shape == 0);
    end(&bench);
}

/* A quarter of a rolled cylinder: its radius alone is free, so it is known the better. */
static void a_fillet_errs_less_than_a_free_cylinder(void **state)
{
    struct bench bench = given_fitter(0.02);
    crease_fitter *const fitter = &bench.fitters[0];
    const crease_model truth = given_model(CREASE_REGION_CYLINDER);
    crease_model planes[2];
    for (int i = 0; i < 2; i++) { /* tangent where the quarter begins and ends */
        planes[i] = (crease_model){.type = CREASE_REGION_PLANE};
        memcpy(planes[i].axes + 6, truth.axes + 3 * i, 3 * sizeof(double));
        crease_primitive_frame(planes[i].axes);
        for (int c = 0; c < 3; c++)
            planes[i].centre[c] = truth.centre[c] + 2 * truth.axes[3 * i + c];
    }
    fill_sample(&fitter->sample, &truth, 300, 0.25, 0.02, 3);
    assert_true(crease_fit_kind(fitter, &fitter->sample, truth.type, &truth));
    crease_fit_covariance(fitter, &fitter->sample, &fitter->best);
    const crease_model *const pair[2] = {&planes[0], &planes[1]};
    const crease_uncertainty alone = crease_model_uncertainty(&fitter->best, NULL);
    const crease_uncertainty u = crease_model_uncertainty(&fitter->best, pair);
    /* the distance of a point changes with the radius by sqrt(2) cos(angle from the middle) - 1 */
    const double pi = acos(-1.0),
                 mean = 2 * (0.5 + 1 / pi) - 2 * sqrt(2) * sin(pi / 4) / (pi / 4) + 1;
    assert_near(u.radius / (0.02 / sqrt(300 * mean)), 1, 0.2);
    assert_near(u.place, sqrt(2) * u.radius, 1e-3 * u.radius);
    assert_true(u.radius < alone.radius && u.place < alone.place);
    end(&bench);
}

static void a_fifth_of_outliers_does_no_harm(void **state)
{
    struct bench bench = given_fitter(0.01);
    crease_fitter *const fitter = &bench.fitters[0];
    for (int type = CREASE_REGION_PLANE; type <= CREASE_REGION_TORUS; type++) {
        const crease_model truth = given_model((crease_region_type)type);
        fill_sample(&fitter->sample, &truth, 500, 0.5, 0.01, 4);
        for (size_t i = 0; i < 500; i += 5)
            for (size_t c = 0; c < 3; c++)
                fitter->sample.points[3 * i + c] += crease_random_uniform(8, c, i) - 0.5;
        assert_true(crease_fit_kind(fitter, &fitter->sample, truth.type, &truth));
        if (worst_distance(&truth, &fitter->best, 0.5) > 0.03)
            fail_msg("%s: off by %g", names[type], worst_distance(&truth, &fitter->best, 0.5));
    }
    end(&bench);
}

static void planes_are_no_round_bodies(void **state)
{
    struct bench bench = given_fitter(0.02);
    crease_fitter *const fitter = &bench.fitters[0];
    const crease_model truth = given_model(CREASE_REGION_PLANE);
    for (int noisy = 0; noisy < 2; noisy++)
        for (int type = CREASE_REGION_SPHERE; type <= CREASE_REGION_TORUS; type++) {
            fill_sample(&fitter->sample, &truth, 300, 1, 0.02 * noisy, 2);
            const bool found =
                crease_fit_kind(fitter, &fitter->sample, (crease_region_type)type, NULL);
            const double cost = found ? fitter->best.cost : INFINITY;
            assert_true(crease_fit_kind(fitter, &fitter->sample, CREASE_REGION_PLANE, NULL));
            if (!(cost > fitter->best.cost))
                fail_msg("a plane is taken for a %s", names[type]);
        }
    end(&bench);
}

static void degenerate_samples_are_refused_or_harmless(void **state)
{
    struct bench bench = given_fitter(0.01);
    crease_fitter *const fitter = &bench.fitters[0];
    for (int kind = 0; kind < 2; kind++)
        for (int type = CREASE_REGION_PLANE; type <= CREASE_REGION_FREEFORM; type++) {
            fitter->sample.count = 40;
            for (size_t i = 0; i < 120; i++) {
                fitter->sample.points[i] = kind ? (double)(i / 3) * (double)(i % 3) : 0;
                fitter->sample.normals[i] = i % 3 == 0;
            }
            if (crease_fit_kind(fitter, &fitter->sample, (crease_region_type)type, NULL))
                assert_true(isfinite(fitter->best.cost));
        }
    fitter->sample.count = 2;
    assert_false(crease_fit_choose(
        fitter, &fitter->sample, CREASE_RULE_BAYES, CREASE_LEVEL_ALL, NULL, INFINITY));
    end(&bench);
}

/* -------------------------------------------------------------------------------------- kind -- */

static void the_kind_of_surface_is_recognised(void **state)
{
    struct bench bench = given_fitter(0.02);
    crease_fitter *const fitter = &bench.fitters[0];
    for (int noisy = 0; noisy < 2; noisy++)
        for (int type = CREASE_REGION_PLANE; type <= CREASE_REGION_TORUS; type++) {
            const crease_model truth = given_model((crease_region_type)type);
            fill_sample(&fitter->sample, &truth, 800, 0.5, 0.02 * noisy, 3);
            assert_true(crease_fit_choose(
                fitter, &fitter->sample, CREASE_RULE_BAYES, CREASE_LEVEL_ALL, NULL, INFINITY));
            if ((int)fitter->best.type != type)
                fail_msg("%s taken for %s", names[type], names[fitter->best.type]);
            assert_near(fitter->best.cost,
                crease_fit_cost(&fitter->best, &fitter->sample, fitter->sigma),
                1e-6 * (1 + fitter->best.cost));
        }
    end(&bench);
}

/* z = f(x, y) over the unit square, turned into the frame of given_model. */
static void fill_heights(
    crease_sample *sample, double (*height)(double, double), size_t count, double sigma)
{
    const crease_model frame = given_model(CREASE_REGION_PLANE);
    sample->count = count;
    memcpy(sample->origin, frame.centre, sizeof sample->origin);
    for (size_t i = 0; i < count; i++) {
        const double x = crease_random_uniform(6, 1, i), y = crease_random_uniform(6, 2, i);
        const double z = height(x, y) + sigma * crease_random_normal(6, 3, i);
        for (size_t c = 0; c < 3; c++) {
            sample->points[3 * i + c] =
                x * frame.axes[c] + y * frame.axes[3 + c] + z * frame.axes[6 + c];
            sample->normals[3 * i + c] = frame.axes[6 + c];
        }
    }
}

static double saddle(double x, double y)
{
    return 0.2 * x * x - 0.3 * x * y - 0.1 * y * y + 0.05 * x;
}

static double waves(double x, double y)
{
    return 0.1 * sin(5 * x) * cos(4 * y);
}

static void heights_of_degree_two_are_exact_and_go_on(void **state)
{
    struct bench bench = given_fitter(1e-4);
    crease_fitter *const fitter = &bench.fitters[0];
    fill_heights(&fitter->sample, saddle, 200, 0);
    /* The frame of the fit is the mean normal's: given here, so that the polynomial stays one. */
    assert_true(crease_fit_kind(fitter, &fitter->sample, CREASE_REGION_FREEFORM, NULL));
    assert_int_equal(fitter->best.type, CREASE_REGION_FREEFORM);
    assert_near(fitter->best.chi, 0, 1e-6);
    double low[2], slope[2], next[2];
    const crease_patch *const patch = &fitter->best.patch;
    const double edge = patch->high[0], y = 0.5 * (patch->low[1] + patch->high[1]);
    low[0] = crease_patch_at(patch, edge, y, slope);
    low[1] = crease_patch_at(patch, edge + 3, y, next);
    assert_near(low[1], low[0] + 3 * slope[0], 1e-12);
    assert_near(next[0], slope[0], 1e-15);
    end(&bench);
}

static void free_forms_are_followed_to_the_noise(void **state)
{
    struct bench bench = given_fitter(0.005);
    crease_fitter *const fitter = &bench.fitters[0];
    fill_heights(&fitter->sample, waves, 3000, 0.005);
    assert_true(crease_fit_choose(
        fitter, &fitter->sample, CREASE_RULE_BAYES, CREASE_LEVEL_ALL, NULL, INFINITY));
    assert_int_equal(fitter->best.type, CREASE_REGION_FREEFORM);
    assert_true(fitter->best.chi < 1.1);
    crease_model copy;
    assert_int_equal(crease_model_copy(bench.context, &fitter->best, &copy), CREASE_OK);
    crease_fit_covariance(fitter, &fitter->sample, &copy);
    double place[3], gradient[3];
    for (size_t i = 0; i < 9; i++) {
        memcpy(place, fitter->sample.points + 300 * i, sizeof place);
        for (int c = 0; c < 3; c++)
            place[c] += fitter->sample.origin[c];
        assert_true(fabs(crease_model_distance(&copy, place, gradient)) < 0.025);
        assert_near(crease_vector_length(gradient), 1, 1e-14);
        const double variance = crease_model_variance(&copy, place);
        assert_true(variance > 1e-8 && variance < 0.005 * 0.005);
    }
    crease_context_fail_allocation(bench.context, 0);
    crease_model none;
    assert_int_equal(crease_model_copy(bench.context, &copy, &none), CREASE_ERROR_NO_MEMORY);
    crease_context_fail_allocation(bench.context, -1);
    crease_model_clear(&copy);
    end(&bench);
}

/* A tube whose distance from its axis varies, in the frame of given_model, and its normals. */
static void fill_tube(crease_sample *sample, size_t count, double sigma)
{
    const crease_model frame = given_model(CREASE_REGION_CYLINDER);
    sample->count = count;
    memcpy(sample->origin, frame.centre, sizeof sample->origin);
    for (size_t i = 0; i < count; i++) {
        const double u = 6.283185307179586 * crease_random_uniform(6, 1, i);
        const double z = crease_random_uniform(6, 2, i) - 0.5, r = 0.5 + 0.1 * cos(2 * u + z);
        const double around = -0.2 * sin(2 * u + z) / r, up = -0.1 * sin(2 * u + z);
        const double off = r + sigma * crease_random_normal(6, 3, i);
        const double place[3] = {off * cos(u), off * sin(u), z};
        double normal[3] = {cos(u) + around * sin(u), sin(u) - around * cos(u), -up};
        crease_vector_normalise(normal);
        for (size_t c = 0; c < 3; c++) {
            sample->points[3 * i + c] = sample->normals[3 * i + c] = 0.0;
            for (size_t k = 0; k < 3; k++) {
                sample->points[3 * i + c] += place[k] * frame.axes[3 * k + c];
                sample->normals[3 * i + c] += normal[k] * frame.axes[3 * k + c];
            }
        }
    }
}

static void tubes_are_heights_about_their_axis(void **state)
{
    struct bench bench = given_fitter(0.002);
    crease_fitter *const fitter = &bench.fitters[0];
    fill_tube(&fitter->sample, 4000, 0.002);
    const crease_model warm = {
        .type = CREASE_REGION_FREEFORM, .patch = {.spline = true, .spans = 8}};
    assert_true(crease_fit_choose(
        fitter, &fitter->sample, CREASE_RULE_AKAIKE, CREASE_LEVEL_ALL, &warm, INFINITY));
    const crease_model *const tube = &fitter->best;
    assert_int_equal(tube->type, CREASE_REGION_FREEFORM);
    assert_true(tube->patch.round);
    assert_true(tube->chi < 1.1);
    for (size_t i = 0; i < 40; i++) {
        double place[3], gradient[3], to[3], there[3];
        for (size_t c = 0; c < 3; c++)
            place[c] = fitter->sample.points[300 * i % 12000 + c] + fitter->sample.origin[c];
        const double from = crease_model_distance(tube, place, gradient);
        assert_true(fabs(from) < 0.012);
        assert_near(crease_vector_length(gradient), 1, 1e-14);
        assert_true(crease_vector_dot(gradient, fitter->sample.normals + 300 * i % 12000) > 0.99);
        for (int c = 0; c < 3; c++)
            to[c] = place[c] + 1e-4 * gradient[c];
        assert_near(crease_model_distance(tube, to, there) - from, 1e-4, 2e-6);
    }
    end(&bench);
}

/* Most of an ellipsoid, in the frame of given_model. */
static void balls_are_distances_from_their_centre(void **state)
{
    struct bench bench = given_fitter(0.002);
    crease_fitter *const fitter = &bench.fitters[0];
    crease_sample *const sample = &fitter->sample;
    const crease_model frame = given_model(CREASE_REGION_SPHERE);
    const double axes[3] = {0.6, 0.5, 0.4};
    memcpy(sample->origin, frame.centre, sizeof sample->origin);
    sample->count = 4000;
    for (size_t i = 0; i < sample->count; i++) {
        const double u = 6.283185307179586 * crease_random_uniform(8, 1, i);
        const double z = 1.5 * crease_random_uniform(8, 2, i) - 0.5, r = sqrt(1 - z * z);
        const double on[3] = {r * cos(u), r * sin(u), z};
        double normal[3];
        for (int c = 0; c < 3; c++)
            normal[c] = on[c] / axes[c];
        crease_vector_normalise(normal);
        const double off = 0.002 * crease_random_normal(8, 3, i);
        for (size_t c = 0; c < 3; c++) {
            sample->points[3 * i + c] = sample->normals[3 * i + c] = 0.0;
            for (size_t k = 0; k < 3; k++) {
                sample->points[3 * i + c] +=
                    (on[k] * axes[k] + off * normal[k]) * frame.axes[3 * k + c];
                sample->normals[3 * i + c] += normal[k] * frame.axes[3 * k + c];
            }
        }
    }
    fitter->trial.patch.coefficients = fitter->coefficients[0];
    assert_false(crease_fit_spline(fitter, sample, 6, &fitter->trial));
    assert_true(crease_fit_ball(fitter, sample, 6, &fitter->trial));
    const crease_model *const ball = &fitter->trial;
    for (size_t i = 0; i < 40; i++) {
        const double *const place = sample->points + 300 * i;
        double gradient[3], to[3], there[3];
        const double from = crease_model_distance(ball, place, gradient);
        assert_true(fabs(from) < 0.012);
        assert_near(crease_vector_length(gradient), 1, 1e-12);
        assert_true(crease_vector_dot(gradient, sample->normals + 300 * i) > 0.99);
        for (int c = 0; c < 3; c++)
            to[c] = place[c] + 1e-4 * gradient[c];
        assert_near(crease_model_distance(ball, to, there) - from, 1e-4, 2e-6);
    }
    for (size_t i = 0; i < 3 * sample->count; i += 3) /* all around: no gap for the projection */
        for (size_t c = 0; c < 3; c++) {
            const double sign = i % 2 ? -1.0 : 1.0;
            sample->points[i + c] *= sign;
            sample->normals[i + c] *= sign;
        }
    assert_false(crease_fit_ball(fitter, sample, 6, &fitter->trial));
    end(&bench);
}

static void sheets_are_no_tubes(void **state)
{
    struct bench bench = given_fitter(0.005);
    crease_fitter *const fitter = &bench.fitters[0];
    fill_heights(&fitter->sample, waves, 1000, 0.005);
    assert_false(crease_fit_tube(fitter, &fitter->sample, 6, &fitter->trial));
    fill_tube(&fitter->sample, 1000, 0);
    assert_false(crease_fit_tube(fitter, &fitter->sample, 3, &fitter->trial));
    end(&bench);
}

/* Where the surface bends within the size of its points, the polynomial's basis is that of its own
 * definition: derivatives against differences. */
static void bases_have_the_slopes_of_their_values(void **state)
{
    double coefficients[CREASE_PATCH_COEFFICIENTS];
    for (size_t k = 0; k < CREASE_PATCH_COEFFICIENTS; k++)
        coefficients[k] = crease_random_normal(2, 0, k);
    for (int spline = 0; spline < 3; spline++) {
        const double low = spline == 2 ? 0 : -1;
        const crease_patch patch = {.spline = spline > 0,
            .round = spline == 2,
            .degree = 4,
            .spans = 5,
            .low = {low, -2},
            .high = {low + 4, 2},
            .unit = {spline ? 4 / 5.0 : 2, spline ? 4 / 5.0 : 2},
            .coefficients = coefficients};
        for (uint64_t i = 0; i < 40; i++) {
            const double x = low + 4 * crease_random_uniform(2, 1, i), h = 1e-6;
            const double y = -2 + 4 * crease_random_uniform(2, 2, i);
            double slope[2], unused[2];
            crease_patch_at(&patch, x, y, slope);
            const double dx = crease_patch_at(&patch, x + h, y, unused) -
                crease_patch_at(&patch, x - h, y, unused);
            const double dy = crease_patch_at(&patch, x, y + h, unused) -
                crease_patch_at(&patch, x, y - h, unused);
            assert_near(slope[0], dx / (2 * h), 1e-5);
            assert_near(slope[1], dy / (2 * h), 1e-5);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_those_of_the_nearest_point),
        cmocka_unit_test(gradients_are_the_slopes_of_distances),
        cmocka_unit_test(gradients_exist_on_axes_and_in_centres),
        cmocka_unit_test(derivatives_are_those_of_small_changes),
        cmocka_unit_test(exact_samples_give_exact_primitives),
        cmocka_unit_test(noisy_fits_are_as_good_as_they_say),
        cmocka_unit_test(parameters_err_as_much_as_they_say),
        cmocka_unit_test(errors_of_a_plane_are_the_textbook_ones),
        cmocka_unit_test(a_fillet_errs_less_than_a_free_cylinder),
        cmocka_unit_test(a_fifth_of_outliers_does_no_harm),
        cmocka_unit_test(planes_are_no_round_bodies),
        cmocka_unit_test(degenerate_samples_are_refused_or_harmless),
        cmocka_unit_test(the_kind_of_surface_is_recognised),
        cmocka_unit_test(heights_of_degree_two_are_exact_and_go_on),
        cmocka_unit_test(free_forms_are_followed_to_the_noise),
        cmocka_unit_test(tubes_are_heights_about_their_axis),
        cmocka_unit_test(balls_are_distances_from_their_centre),
        cmocka_unit_test(sheets_are_no_tubes),
        cmocka_unit_test(bases_have_the_slopes_of_their_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
