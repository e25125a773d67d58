/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/** @file crease.h
 * The C interface of libcrease, in the order of the pipeline: context, cloud, neighbours, noise,
 * scores, regions, splines, creases, sheets, files and figures. Trimmed sheets, clouds larger than
 * memory and CAD models have headers of their own. Manners, the same everywhere:
 *  - A function that can fail returns a crease_status; its result is the last argument and is set
 *    only when CREASE_OK is returned (otherwise it is set to NULL). crease_context_message() then
 *    holds one sentence: what, where, what to do.
 *  - Objects are opaque, never change once made, and are freed by crease_<noun>_free(), which
 *    accepts NULL. Pointers got from an object live as long as the object.
 *  - Where options may be NULL, they are what crease_<noun>_options_default() returns.
 *  - Coordinates are doubles, packed x y z; lengths have the cloud's unit; angles are degrees.
 *  - A context serves one call at a time; inside that call the library uses context threads. The
 *    result never depends on the number of threads: it is the same bytes.
 *  - The library never prints, never exits, never aborts and never touches the locale.
 */
#ifndef CREASE_CREASE_H
#define CREASE_CREASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define CREASE_API __attribute__((visibility("default")))
#define CREASE_FORMAT(text, first) __attribute__((format(printf, text, first)))
#else
#define CREASE_API
#define CREASE_FORMAT(text, first)
#endif

/* ------------------------------------------------------------------------------------ status -- */

/** Every status: code, kind, sentence. The kind decides the exit code of the program. */
#define CREASE_STATUS_TABLE(X)                                                                     \
    X(CREASE_OK, CREASE_KIND_NONE, "no error")                                                     \
    X(CREASE_ERROR_ARGUMENT, CREASE_KIND_USAGE, "an argument or option is out of its range")       \
    X(CREASE_ERROR_NO_SUCH_FILE, CREASE_KIND_INPUT, "the file does not exist")                     \
    X(CREASE_ERROR_CANNOT_READ, CREASE_KIND_INPUT, "the file cannot be read")                      \
    X(CREASE_ERROR_FORMAT, CREASE_KIND_INPUT, "the file is not what its header says")              \
    X(CREASE_ERROR_TRUNCATED, CREASE_KIND_INPUT, "the file ends too early")                        \
    X(CREASE_ERROR_VALUE, CREASE_KIND_INPUT, "a coordinate is not a finite number")                \
    X(CREASE_ERROR_TOO_FEW_POINTS, CREASE_KIND_INPUT, "the cloud has too few points")              \
    X(CREASE_ERROR_DEGENERATE, CREASE_KIND_INPUT, "the points do not span a surface")              \
    X(CREASE_ERROR_CANNOT_WRITE, CREASE_KIND_FAILURE, "the file cannot be written")                \
    X(CREASE_ERROR_NO_MEMORY, CREASE_KIND_FAILURE, "memory ran out")                               \
    X(CREASE_ERROR_CANCELLED, CREASE_KIND_FAILURE, "the work was cancelled")                       \
    X(CREASE_ERROR_NUMERIC, CREASE_KIND_FAILURE, "the computation did not succeed")                \
    X(CREASE_ERROR_UNSUPPORTED, CREASE_KIND_FAILURE, "this build cannot do that")

/** What a caller can do about a status: nothing, mend the call, mend the input, or neither. */
typedef enum crease_kind {
    CREASE_KIND_NONE,
    CREASE_KIND_USAGE,
    CREASE_KIND_INPUT,
    CREASE_KIND_FAILURE
} crease_kind;

typedef enum crease_status {
#define CREASE_STATUS_CODE(code, kind, sentence) code,
    CREASE_STATUS_TABLE(CREASE_STATUS_CODE)
#undef CREASE_STATUS_CODE
} crease_status;

/** The general sentence for a status; never NULL, also for numbers that are no status. */
CREASE_API const char *crease_status_sentence(crease_status status);
/** The kind of a status; CREASE_KIND_FAILURE for numbers that are no status. */
CREASE_API crease_kind crease_status_kind(crease_status status);
/** The version of the library, "major.minor.patch". */
CREASE_API const char *crease_version(void);

/* ----------------------------------------------------------------------------------- context -- */

/** Threads, seed, messages and callbacks of a series of calls. */
typedef struct crease_context crease_context;

typedef struct crease_context_options {
    int threads;   /**< number of threads, 1..1024; 0 = one for each processor */
    uint64_t seed; /**< seed of every random draw */
    size_t memory; /**< bytes that the whole process may have, 0: no limit. On Linux, a large block
                        that would take more fails with CREASE_ERROR_NO_MEMORY; all are counted */
    /** Called now and then during long work, always from the calling thread; fraction is 0..1. */
    void (*progress)(void *user, const char *stage, double fraction);
    /** Asked now and then; non-zero ends the work with CREASE_ERROR_CANCELLED. */
    int (*cancelled)(void *user);
    /** Receives sentences about input that is usable but odd. */
    void (*warn)(void *user, const char *sentence);
    void *user; /**< handed to the callbacks */
} crease_context_options;

CREASE_API crease_context_options crease_context_options_default(void);
CREASE_API crease_status crease_context_create(
    const crease_context_options *options, crease_context **out);
CREASE_API void crease_context_free(crease_context *context);
/** The sentence of the last failed call: what, where, what to do. Empty when nothing failed. */
CREASE_API const char *crease_context_message(const crease_context *context);
/** Sets that sentence and returns the status, for code built on the library that fails in the same
 * way: `return crease_context_fail(context, CREASE_ERROR_ARGUMENT, "%s: ...", path)`. */
CREASE_API crease_status crease_context_fail(
    crease_context *context, crease_status status, const char *format, ...) CREASE_FORMAT(3, 4);
/** The number of threads in force (never 0). */
CREASE_API int crease_context_threads(const crease_context *context);
CREASE_API uint64_t crease_context_seed(const crease_context *context);
/** Lets the stages that take long, scores and regions, keep what they found in a folder, which is
 * made when it is not there, and begin with what they find in it: work that was broken off goes on
 * after its last finished stage, with the same result. Files of other points, options or versions
 * are not used. A warning tells of each stage that is taken from there. The name must outlive the
 * context; NULL: nothing is kept, as at first. Errors: CANNOT_WRITE. */
CREASE_API crease_status crease_context_keep(crease_context *context, const char *folder);

/* ------------------------------------------------------------------------------------- cloud -- */

/** An unorganised set of points with optional unit normals and named scalar fields. */
typedef struct crease_cloud crease_cloud;

/** Element type of a scalar field, kept as read so that what is written is what was read. */
typedef enum crease_type {
    CREASE_TYPE_INT8,
    CREASE_TYPE_UINT8,
    CREASE_TYPE_INT16,
    CREASE_TYPE_UINT16,
    CREASE_TYPE_INT32,
    CREASE_TYPE_UINT32,
    CREASE_TYPE_FLOAT32,
    CREASE_TYPE_FLOAT64
} crease_type;

/** Bytes of one element, 1 to 8. */
CREASE_API size_t crease_type_size(crease_type type);

/** One named value per point. */
typedef struct crease_field {
    const char *name;   /**< unique within a cloud, no white space */
    crease_type type;   /**< element type of values */
    const void *values; /**< count elements */
} crease_field;

/** What a cloud is made from; everything is copied. */
typedef struct crease_cloud_parts {
    size_t count;               /**< number of points, at most UINT32_MAX */
    const double *points;       /**< count x 3, finite */
    const double *normals;      /**< count x 3 or NULL */
    const crease_field *fields; /**< field_count fields or NULL */
    size_t field_count;
    crease_type coordinate_type; /**< FLOAT32 or FLOAT64: how coordinates are written back */
} crease_cloud_parts;

/** Makes a cloud, also of zero points. O(n). Errors: ARGUMENT (missing points, doubled field
 * names), VALUE (a coordinate is not finite), NO_MEMORY. */
CREASE_API crease_status crease_cloud_create(
    crease_context *context, const crease_cloud_parts *parts, crease_cloud **out);
/** The same cloud with further fields; a field of the same name is replaced. O(n). */
CREASE_API crease_status crease_cloud_with_fields(crease_context *context,
    const crease_cloud *cloud, const crease_field *fields, size_t field_count, crease_cloud **out);
CREASE_API void crease_cloud_free(crease_cloud *cloud);

CREASE_API size_t crease_cloud_count(const crease_cloud *cloud);
/** count x 3 coordinates. */
CREASE_API const double *crease_cloud_points(const crease_cloud *cloud);
/** count x 3 unit normals as read, or NULL. */
CREASE_API const double *crease_cloud_normals(const crease_cloud *cloud);
CREASE_API crease_type crease_cloud_coordinate_type(const crease_cloud *cloud);
CREASE_API size_t crease_cloud_field_count(const crease_cloud *cloud);
/** Field number index; name NULL when there is no such field. */
CREASE_API crease_field crease_cloud_field(const crease_cloud *cloud, size_t index);
/** The field of this name; name NULL when there is no such field. */
CREASE_API crease_field crease_cloud_find_field(const crease_cloud *cloud, const char *name);
/** One value of a field as a double. */
CREASE_API double crease_field_value(const crease_field *field, size_t point);
/** Lowest and highest coordinates, x y z each; zeros for an empty cloud. O(n). */
CREASE_API void crease_cloud_bounds(const crease_cloud *cloud, double lowest[3], double highest[3]);

/* ----------------------------------------------------------------------------------- shapes -- */

/** The cube of the paper: the unit cube, a square grid of this many intervals on every face
 * (1..8192; the paper: 32), no point doubled: 6 intervals^2 + 2 points. Errors: ARGUMENT,
 * NO_MEMORY. */
CREASE_API crease_status crease_shape_cube(
    crease_context *context, int intervals, crease_cloud **out);

/** A sample of the cube around its edge x = 1, z = 1, as in the paper. */
typedef struct crease_sample_options {
    int across;       /**< points across the edge, 2..10000; default 17 */
    int along;        /**< points along the edge, 1..10000; default 3 */
    bool roof;        /**< turned by 45 degrees and moved so that the edge is x = z = 0 and both
                           faces fall away from it; default true */
    double spacing;   /**< h, distance of neighbouring points; default 1/32 */
    double shift;     /**< moves the points across the edge, in spacings; default 0: centred */
    double noise;     /**< d: the moved points go along z by N(0, (h d)^2); default 0 */
    int moved;        /**< how many points the noise moves; default 13 */
    uint64_t variant; /**< which noise: another one for each number and seed, below 2^32 */
} crease_sample_options;

CREASE_API crease_sample_options crease_sample_options_default(void);
/** Errors: ARGUMENT, NO_MEMORY. */
CREASE_API crease_status crease_shape_sample(
    crease_context *context, const crease_sample_options *options, crease_cloud **out);

/** A panel of 0.8 x 0.6 with one crease along no axis, as a scanner would see it: random points
 * on two sagging faces, noise in every direction, a few outliers. */
typedef struct crease_panel_options {
    size_t count;    /**< points, at least 4; default 20000 */
    double noise;    /**< standard deviation in mean spacings; default 0.2 */
    double outliers; /**< share of the points that lie off the panel, 0..1; default 0.005 */
} crease_panel_options;

CREASE_API crease_panel_options crease_panel_options_default(void);
/** Errors: ARGUMENT, NO_MEMORY. */
CREASE_API crease_status crease_shape_panel(
    crease_context *context, const crease_panel_options *options, crease_cloud **out);

/** A bracket of 80 x 50 x 55, as a scanner would see it: an angle with three drilled holes, eight
 * planes and three cylinders, seen from eight sides, with the density that each side gets, noise
 * along the line of sight, and outliers. What no line of sight reaches has no points. */
typedef struct crease_bracket_options {
    size_t count;    /**< points, at least 4; default 30000 */
    double noise;    /**< standard deviation in mean spacings; default 0.2 */
    double outliers; /**< share of the points that lie off the bracket, 0..1; default 0.005 */
} crease_bracket_options;

CREASE_API crease_bracket_options crease_bracket_options_default(void);
/** Errors: ARGUMENT, NO_MEMORY. */
CREASE_API crease_status crease_shape_bracket(
    crease_context *context, const crease_bracket_options *options, crease_cloud **out);

/* -------------------------------------------------------------------------- reading clouds -- */

typedef struct crease_read_options {
    /** Leave out points that are not finite or beyond 1e150, where squared distances overflow (with
     * one warning that counts them). Default: the first of them is an error. */
    bool skip_invalid;
    /** Of a mesh (OBJ, STL, OFF, PLY with faces): about how many points are drawn on the faces that
     * its triangles approximate, up to 10^7; 0, and when points are left out: its vertices; -1,
     * default: these where they are 5000 and more, triangles being not much larger than their
     * distances, else 10^4 to 10^5 points, as the narrowest faces ask for, with a warning. */
    int mesh_points;
} crease_read_options;

CREASE_API crease_read_options crease_read_options_default(void);
/** Reads a cloud: PLY, PCD, XYZ / TXT / CSV / ASC / PTS, LAS (not LAZ), or the vertices of OBJ,
 * STL, OFF, or points on their faces. The format is found by signature first, by the extension
 * second.
 * "-" is standard input. Errors: NO_SUCH_FILE, CANNOT_READ, FORMAT, TRUNCATED, VALUE, NO_MEMORY. */
CREASE_API crease_status crease_cloud_read(crease_context *context, const char *path,
    const crease_read_options *options, crease_cloud **out);
/** Name of the format of the file ("PLY", "STEP", ...), by signature first, or NULL. */
CREASE_API const char *crease_file_format(const char *path);

/* ------------------------------------------------------------------------------- neighbours -- */

/** The K nearest neighbours of every point of a cloud. */
typedef struct crease_neighbours crease_neighbours;

/** Finds the k nearest points of every point, the point itself first (eq. 2 of the paper: Euclidean
 * distance). Exact; equal distances are ordered by index, so the result is unique.
 * k: 1..256 and at most the number of points. O(n log n). Errors: ARGUMENT, TOO_FEW_POINTS,
 * NO_MEMORY, CANCELLED. */
CREASE_API crease_status crease_neighbours_find(
    crease_context *context, const crease_cloud *cloud, int k, crease_neighbours **out);
CREASE_API void crease_neighbours_free(crease_neighbours *neighbours);
CREASE_API size_t crease_neighbours_count(const crease_neighbours *neighbours);
CREASE_API int crease_neighbours_k(const crease_neighbours *neighbours);
/** The k neighbours of a point, nearest first. */
CREASE_API const uint32_t *crease_neighbours_of(const crease_neighbours *neighbours, size_t point);

/** A k-d tree over points, for queries at any place. Copies the points. */
typedef struct crease_tree crease_tree;
CREASE_API crease_status crease_tree_create(
    crease_context *context, const double *points, size_t count, crease_tree **out);
CREASE_API void crease_tree_free(crease_tree *tree);
CREASE_API size_t crease_tree_count(const crease_tree *tree);
/** The k nearest points of each query, nearest first, ties by index. indices: query_count x k;
 * squared_distances: the same shape or NULL. k must not exceed the tree's count. */
CREASE_API crease_status crease_tree_nearest(crease_context *context, const crease_tree *tree,
    const double *queries, size_t query_count, int k, uint32_t *indices, double *squared_distances);
/** All points within the radius of one place, by ascending index. *found is the number of all such
 * points; at most capacity indices are stored. */
CREASE_API crease_status crease_tree_within(const crease_tree *tree, const double place[3],
    double radius, size_t capacity, uint32_t *indices, size_t *found);

/* ------------------------------------------------------------------------------------- noise -- */

/** How dense and how noisy a cloud is, and which way its surface faces. */
typedef struct crease_noise crease_noise;

/** Estimates them from quadrics fitted to the 24 nearest neighbours of every point (10 and 8 where
 * walls are thin), and from wider windows, up to 192 neighbours, where these show errors that
 * neighbours share. Deterministic; O(n log n). Errors: TOO_FEW_POINTS (below 4), DEGENERATE (all
 * points equal or on one line), NO_MEMORY, CANCELLED. */
CREASE_API crease_status crease_noise_estimate(
    crease_context *context, const crease_cloud *cloud, crease_noise **out);
CREASE_API void crease_noise_free(crease_noise *noise);
CREASE_API size_t crease_noise_count(const crease_noise *noise);
/** Mean spacing sqrt(area / points), in the unit of the cloud. */
CREASE_API double crease_noise_spacing(const crease_noise *noise);
/** Standard deviation of the points along the surface's normal, errors that neighbours share
 * included. Never below 0.03 spacings, so that results for exact data do not hang on rounding. */
CREASE_API double crease_noise_sigma(const crease_noise *noise);
/** Unit normals, count x 3, sign arbitrary. Beside a sharp edge the normal is that of the side the
 * point lies on, not a mean of both. */
CREASE_API const double *crease_noise_normals(const crease_noise *noise);

/* ----------------------------------------------------------------------------------- filter -- */

/** A cloud with less noise, its outliers set aside. */
typedef struct crease_filtered crease_filtered;

typedef struct crease_filter_options {
    int neighbours; /**< points that a point's surface is sought among, itself included; 25..256;
                         default 64 */
    int passes;     /**< times every point is moved, 0..10; 0: only outliers are found; default 1 */
    double outlier_sigmas; /**< an outlier is further from the surface than this many standard
                                deviations, above 0; default 5 */
    double sigma;          /**< noise along the normal, when it is known; default 0: estimated */
    bool remove_outliers;  /**< leave outliers out instead of marking them; default false */
} crease_filter_options;

CREASE_API crease_filter_options crease_filter_options_default(void);
/** Moves every point onto the surface that the points on its own side of any edge suggest: a plane
 * or a quadric through those neighbours whose normals agree. Edges stay sharp. Outliers are points
 * further from that surface than noise explains, or with neighbours several times as far as theirs:
 * they stay where they are. Normals and fields come along unchanged. Deterministic. O(n log n); 700
 * bytes of memory for each point. Errors: ARGUMENT, TOO_FEW_POINTS (below 4), DEGENERATE (all
 * points equal or on one line), NO_MEMORY, CANCELLED. */
CREASE_API crease_status crease_cloud_filter(crease_context *context, const crease_cloud *cloud,
    const crease_filter_options *options, crease_filtered **out);
CREASE_API void crease_filtered_free(crease_filtered *filtered);
/** The filtered cloud: all points in their order with the field `outlier` (1 or 0), or, with
 * remove_outliers, the others in their order. */
CREASE_API const crease_cloud *crease_filtered_cloud(const crease_filtered *filtered);
/** For every point of the input 1 if it is an outlier, else 0. */
CREASE_API const uint8_t *crease_filtered_outliers(const crease_filtered *filtered);
CREASE_API size_t crease_filtered_outlier_count(const crease_filtered *filtered);
/** Mean spacing, in the unit of the cloud. */
CREASE_API double crease_filtered_spacing(const crease_filtered *filtered);
/** Noise along the normal before: given or estimated. */
CREASE_API double crease_filtered_sigma(const crease_filtered *filtered);
/** Noise estimated again: the roughness that is left, at least 0.03 spacings. The error of the
 * surface itself is larger, because neighbours now err alike. */
CREASE_API double crease_filtered_sigma_after(const crease_filtered *filtered);
/** Root mean square of the distances that points were moved by. */
CREASE_API double crease_filtered_movement(const crease_filtered *filtered);

/* ------------------------------------------------------------------------------------ scores -- */

/** What every point tells about a sharp edge near it. */
typedef struct crease_scores crease_scores;

/** What is looked at in the neighbourhood of a point, and what its score then is. All scores are
 * pure numbers that grow with the square of an angle, do not change when the cloud is moved, turned
 * or scaled, and are 0 for points in a plane. */
typedef enum crease_detector {
    /** Bootstrap variance: trace of the covariance of the resampled unit normals, 0..1 (eq. 3 and 4
     * of the paper). O(K B) for each point. */
    CREASE_DETECTOR_BOOTSTRAP,
    /** What that tends to with ever more resamples, to first order in 1/K, 0..1: no random draws.
     * The bootstrap is 1.5 times it on average at K = 16, 1.06 times at 64, 1.01 times at 256.
     * O(K). Based on: Jaeckel. The infinitesimal jackknife. 1972. */
    CREASE_DETECTOR_JACKKNIFE,
    /** Surface variation: the least eigenvalue of the covariance over the sum of all three, 0..1/3.
     * O(K). Based on: Pauly, Gross, Kobbelt. Efficient simplification of point-sampled surfaces.
     * 2002. */
    CREASE_DETECTOR_VARIATION,
    /** Gauss map: the greatest squared sine, 0..1, by which the normals of the triangles of the
     * point and two neighbours fall into two clusters. O(K^2) up to K = 16, then constant.
     * Based on: Weber, Hahmann, Hagen. Sharp feature detection in point clouds. 2010. */
    CREASE_DETECTOR_GAUSS_MAP
} crease_detector;

typedef struct crease_detect_options {
    int neighbours; /**< K: neighbours of a point, itself included; 4..256; default 16 */
    int resamples;  /**< B: bootstrap resamples; 2..10000; default 100 */
    double false_discovery_rate; /**< expected share of wrong features, 0..1; default 0.05 */
    crease_detector detector;    /**< default CREASE_DETECTOR_BOOTSTRAP */
} crease_detect_options;

CREASE_API crease_detect_options crease_detect_options_default(void);
/** The score of every point and the decision which points are features: those whose score noise
 * does not explain at the false-discovery rate, the null being taken from the lower half of all
 * scores, and that are at least as sharp as the mean of their 2 K neighbours. Errors: ARGUMENT,
 * TOO_FEW_POINTS, DEGENERATE, NO_MEMORY, CANCELLED. O(n log n) and the detector's own cost for each
 * point. */
CREASE_API crease_status crease_scores_compute(crease_context *context, const crease_cloud *cloud,
    const crease_detect_options *options, crease_scores **out);
CREASE_API void crease_scores_free(crease_scores *scores);
CREASE_API size_t crease_scores_count(const crease_scores *scores);
/** The detector's score of every point: see crease_detector. */
CREASE_API const double *crease_scores_variance(const crease_scores *scores);
/** Unit normals of the neighbourhoods (sign arbitrary), count x 3. */
CREASE_API const double *crease_scores_normals(const crease_scores *scores);
/** 1 where the point is taken for a feature, else 0. */
CREASE_API const uint8_t *crease_scores_features(const crease_scores *scores);

/* ----------------------------------------------------------------------------------- regions -- */

/** The smooth pieces that the surface of a cloud consists of. */
typedef struct crease_regions crease_regions;

/** Kind of surface of a region, and its parameters; places and directions are x y z. */
typedef enum crease_region_type {
    CREASE_REGION_PLANE,    /**< point, unit normal: 6 numbers */
    CREASE_REGION_SPHERE,   /**< centre, radius: 4 */
    CREASE_REGION_CYLINDER, /**< point of the axis, unit axis, radius: 7 */
    CREASE_REGION_CONE,     /**< point of the axis, unit axis, radius there, its growth per length
                                 along the axis: 8 */
    CREASE_REGION_TORUS,    /**< centre, unit axis, radius of the circle, radius of the tube: 8 */
    CREASE_REGION_FREEFORM  /**< any other smooth surface: none */
} crease_region_type;

/** What one region is. */
typedef struct crease_region {
    crease_region_type type;
    double parameters[8];   /**< see the type; unused ones are 0 */
    size_t parameter_count; /**< how many of them are used */
    size_t point_count;     /**< points with this label */
    double rms;             /**< root mean square distance of these points from the surface */
    double chi;         /**< mean squared distance over the squared noise, each cut at 9: about 1
                             when the surface explains the points */
    int32_t tangent[2]; /**< fillets, which are cylinders: the two regions that the surface is
                             exactly tangent to; -1: none */
    /* Standard errors, from the covariance of the fit with the noise of the points; 0 for what the
     * type does not have. Of a fillet: with its planes given. */
    double place_error;     /**< plane: of its place along the normal; cylinder, cone: of the axis,
                                 across it, at its point; sphere, torus: of the centre; free form:
                                 along the normal, in the mean */
    double direction_error; /**< of the normal or the axis, degrees */
    double radius_error;
    double shape_error; /**< cone: of the growth of its radius; torus: of the tube's radius */
} crease_region;

typedef struct crease_regions_options {
    double sigma;        /**< noise along the normal, when it is known; default 0: estimated */
    size_t least_points; /**< 8 or more; default 8; of 4, 16, 64 times 10 000 points 1, 2, 3 more */
    bool united;         /**< regions that join without an angle become one free form where that is
                              as close to the points; default false */
} crease_regions_options;

CREASE_API crease_regions_options crease_regions_options_default(void);
/** Finds the smooth regions: grown from smooth interiors, merged where one surface explains both,
 * and bounded where the points' distances from the surfaces say so. What rounds the edge of two
 * planes becomes a cylinder tangent to both. Deterministic. O(n log n) for a fixed number of
 * regions. Errors: ARGUMENT, TOO_FEW_POINTS (below 8), DEGENERATE (all points
 * equal or on one line), NO_MEMORY, CANCELLED. */
CREASE_API crease_status crease_regions_find(crease_context *context, const crease_cloud *cloud,
    const crease_regions_options *options, crease_regions **out);
CREASE_API void crease_regions_free(crease_regions *regions);
/** Number of points. */
CREASE_API size_t crease_regions_point_count(const crease_regions *regions);
/** Number of regions. */
CREASE_API size_t crease_regions_count(const crease_regions *regions);
/** For every point the number of its region, or -1 for outliers. */
CREASE_API const int32_t *crease_regions_labels(const crease_regions *regions);
/** Unit normals of the points, count x 3: see crease_noise_normals(). */
CREASE_API const double *crease_regions_normals(const crease_regions *regions);
/** Spacing and noise that the regions were found with. */
CREASE_API double crease_regions_spacing(const crease_regions *regions);
CREASE_API double crease_regions_sigma(const crease_regions *regions);
/** Region number index, below the count. */
CREASE_API crease_region crease_regions_at(const crease_regions *regions, size_t index);
/** Signed distance of a place from the surface of a region, extended beyond its points, and its
 * unit gradient there. Free forms: to first order. */
CREASE_API double crease_regions_distance(
    const crease_regions *regions, size_t index, const double place[3], double gradient[3]);

/** What several surfaces have in common. */
typedef enum crease_snap_kind {
    CREASE_SNAP_PARALLEL,      /**< normals of planes, axes of cylinders, cones and tori */
    CREASE_SNAP_PERPENDICULAR, /**< two of these, each standing for all that are parallel to it */
    CREASE_SNAP_COAXIAL,       /**< cylinders, cones, tori */
    CREASE_SNAP_EQUAL_RADII,   /**< parallel cylinders, spheres */
    CREASE_SNAP_SYMMETRIC /**< of two directions, or of places: a mirror takes them to each other */
} crease_snap_kind;

/** Regions whose surfaces were made to have something exactly in common. */
typedef struct crease_snap {
    crease_snap_kind kind;
    size_t region_count;     /**< 2 or more */
    const uint32_t *regions; /**< their numbers, as long as the regions live */
} crease_snap;

/** Makes surfaces parallel, perpendicular, coaxial, equally large or symmetric that are so within
 * their errors: none moves further than 99 of 100 fits of the same kind err; its other parameters
 * move to what is then the most probable. Fillets follow their planes. Mirrors lie across
 * directions of surfaces, where there are at most 60 places. Free forms, surfaces that do not suit
 * their points or have fewer than 20 stay. A second call does nothing. O(points + regions^2). */
CREASE_API crease_status crease_regions_snap(crease_context *context, crease_regions *regions);
/** What has been snapped: nothing before crease_regions_snap(). */
CREASE_API size_t crease_regions_snap_count(const crease_regions *regions);
CREASE_API crease_snap crease_regions_snap_at(const crease_regions *regions, size_t index);

/* ----------------------------------------------------------------------------------- splines -- */

/** A B-spline curve in space of any order and knot vector. */
typedef struct crease_curve crease_curve;

/** order = degree + 1, 1..16; count control points >= order; count + order knots, not decreasing,
 * no multiplicity above the order. control_points: count x 3. Errors: ARGUMENT, NO_MEMORY. */
CREASE_API crease_status crease_curve_create(crease_context *context, int order, size_t count,
    const double *knots, const double *control_points, crease_curve **out);
CREASE_API void crease_curve_free(crease_curve *curve);
CREASE_API int crease_curve_order(const crease_curve *curve);
CREASE_API size_t crease_curve_count(const crease_curve *curve);
CREASE_API const double *crease_curve_knots(const crease_curve *curve);
CREASE_API const double *crease_curve_control_points(const crease_curve *curve);
/** First and last parameter of the curve's domain. */
CREASE_API void crease_curve_domain(const crease_curve *curve, double domain[2]);

/** From which side a derivative is taken at a knot where it may jump. */
typedef enum crease_side { CREASE_SIDE_RIGHT, CREASE_SIDE_LEFT } crease_side;

/** Point and derivatives 0..derivatives at t: (derivatives + 1) x 3 numbers. Outside the domain t
 * is moved to its border. Derivatives above the degree are zero. */
CREASE_API void crease_curve_evaluate(
    const crease_curve *curve, double t, crease_side side, int derivatives, double *out);

/** A tensor-product B-spline surface (eq. 1) of any orders and knot vectors. */
typedef struct crease_surface crease_surface;

typedef struct crease_surface_parts {
    int order[2];                 /**< orders k (u) and l (v), 1..16 */
    size_t count[2];              /**< control points along u and v, each at least the order */
    const double *knots[2];       /**< count + order knots each, not decreasing */
    const double *control_points; /**< count[0] x count[1] x 3, v fastest */
} crease_surface_parts;

CREASE_API crease_status crease_surface_create(
    crease_context *context, const crease_surface_parts *parts, crease_surface **out);
CREASE_API void crease_surface_free(crease_surface *surface);
/** The surface's parts; the pointers live as long as the surface. */
CREASE_API crease_surface_parts crease_surface_parts_of(const crease_surface *surface);
/** First and last parameter along direction 0 (u) or 1 (v). */
CREASE_API void crease_surface_domain(
    const crease_surface *surface, int direction, double domain[2]);
/** Point and partial derivatives: out holds (derivatives + 1)^2 x 3 numbers, out[a][b] being the
 * a-th derivative in u and b-th in v. sides: one for u, one for v. */
CREASE_API void crease_surface_evaluate(const crease_surface *surface, const double uv[2],
    const crease_side sides[2], int derivatives, double *out);
/** The surface's point only. */
CREASE_API void crease_surface_point(
    const crease_surface *surface, const double uv[2], double point[3]);
/** Unit normal, by limits where a partial derivative vanishes; sides as in evaluate. */
CREASE_API void crease_surface_normal(const crease_surface *surface, const double uv[2],
    const crease_side sides[2], double normal[3]);
/** Multiplicity of the knot at t (0 when t is no knot). */
CREASE_API int crease_surface_multiplicity(const crease_surface *surface, int direction, double t);
/** Inserts the knot t `times` times along a direction: the same surface, a finer net.
 * Based on: Boehm. Inserting new knots into B-spline curves. 1980. */
CREASE_API crease_status crease_surface_insert_knot(crease_context *context,
    const crease_surface *surface, int direction, double t, int times, crease_surface **out);
/** Splits at t along a direction into two clamped surfaces that share their border control points
 * exactly. t must lie inside the domain. */
CREASE_API crease_status crease_surface_split(crease_context *context,
    const crease_surface *surface, int direction, double t, crease_surface **lower,
    crease_surface **upper);
/** The same surface with knots of full multiplicity at both ends of both directions. */
CREASE_API crease_status crease_surface_clamp(
    crease_context *context, const crease_surface *surface, crease_surface **out);
/** The surface with u and v exchanged. */
CREASE_API crease_status crease_surface_transpose(
    crease_context *context, const crease_surface *surface, crease_surface **out);

/** Where a point falls on a surface. */
typedef struct crease_foot {
    double uv[2];    /**< parameters of the closest point */
    double point[3]; /**< the closest point */
    double distance; /**< from the point asked for, signed: positive along the surface's normal */
} crease_foot;

/** Orthogonal projection of count points onto the surface: the closest point of the whole surface,
 * borders and creases included. Threaded. feet: count of them. */
CREASE_API crease_status crease_surface_project(crease_context *context,
    const crease_surface *surface, const double *points, size_t count, crease_foot *feet);

/* ----------------------------------------------------------------------------------- creases -- */

/** The creases of a cloud: curves in which its smooth regions meet at an angle, joined in corners.
 */
typedef struct crease_network crease_network;

typedef struct crease_network_options {
    double least_turn; /**< a crease turns the surface by at least this: 180 less the dihedral
                          angle, 1..90 degrees; default 10 */
    double reach;      /**< features are the points within this many spacings of a crease, above 0,
                            at most 100; default 1 */
} crease_network_options;

/** What one crease is. */
typedef struct crease_network_crease {
    uint32_t regions[2];   /**< numbers of the regions that meet in it, ascending */
    int32_t corners[2];    /**< numbers of the corners at its ends; -1: it fades out, leaves the
                                points, or is closed */
    bool closed;           /**< its end is its beginning */
    double length;         /**< nearly the domain of the curve, too: 0..length */
    double angle;          /**< mean dihedral angle of the regions: 180 = flat */
    double angle_error;    /**< its standard error */
    double position_error; /**< standard error of the curve's place, across it */
} crease_network_crease;

/** Where creases end together, or one at a third region. */
typedef struct crease_corner {
    double position[3];
    uint32_t valence; /**< how many ends of creases; 3 or more at a corner of a solid */
} crease_corner;

CREASE_API crease_network_options crease_network_options_default(void);
/** Finds where the surfaces of neighbouring regions intersect, as far as points of both support it:
 * borders of an open cloud are no creases, nor are the seams of smoothly joined regions, and a
 * crease ends where it fades out. Deterministic. O(n log n); 70 bytes of memory for each point,
 * most of them for the tree of the points. Errors: ARGUMENT, NO_MEMORY, NUMERIC, CANCELLED. */
CREASE_API crease_status crease_network_find(crease_context *context, const crease_regions *regions,
    const crease_network_options *options, crease_network **out);
CREASE_API void crease_network_free(crease_network *network);
/** Number of creases. */
CREASE_API size_t crease_network_count(const crease_network *network);
/** Crease number index, below the count. */
CREASE_API crease_network_crease crease_network_at(const crease_network *network, size_t index);
/** A cubic curve for each crease, twice differentiable, within 0.01 spacings of the intersection.
 * Creases that share a corner end there exactly. */
CREASE_API const crease_curve *const *crease_network_curves(const crease_network *network);
CREASE_API size_t crease_network_corner_count(const crease_network *network);
CREASE_API crease_corner crease_network_corner(const crease_network *network, size_t index);
CREASE_API size_t crease_network_point_count(const crease_network *network);
/** For every point 1 where it is within reach of a crease, else 0. */
CREASE_API const uint8_t *crease_network_features(const crease_network *network);
/** Mean spacing of the points away from creases and borders: the unit of the reach. */
CREASE_API double crease_network_spacing(const crease_network *network);

/* ------------------------------------------------------------------------------------ sheets -- */

/** One tensor-product surface fitted to a cloud, with its creases. */
typedef struct crease_sheet crease_sheet;

/** A line of constant parameter along which a sheet is sharp. */
typedef struct crease_line {
    int direction;    /**< 0: u is constant on the line (it runs along v), 1: v is constant */
    double parameter; /**< the constant parameter */
    double angle;     /**< mean dihedral angle of the faces beside it: 180 = flat, in degrees */
    double standard_error; /**< of the line's position across itself, 0 when not known */
} crease_line;

/** How a cloud is turned so that it is a height field over x and y, the edge running along y. */
typedef enum crease_orientation {
    CREASE_ORIENTATION_AUTOMATIC, /**< main axes and edge direction found from the data */
    CREASE_ORIENTATION_NONE,      /**< as it is: z is the height, the edge runs along x or y */
    CREASE_ORIENTATION_GIVEN      /**< by the rotation in the options */
} crease_orientation;

/** The constants of the paper's Algorithm 1, the paper's values as defaults where it gives them. */
typedef struct crease_averaging_options {
    crease_detect_options detect;   /**< step 1: K and B */
    crease_orientation orientation; /**< step 3; default automatic */
    double rotation[9];             /**< step 3: M, row by row, for CREASE_ORIENTATION_GIVEN */
    size_t net[2];            /**< step 4: control points along x and y, >= 4; default 6 x 6 */
    int averaging_neighbours; /**< step 5: data points averaged, 1..256; default 2 */
    int passes;               /**< step 5: passes, 1..1000; default 3 */
    int marking_neighbours;   /**< step 7: data points averaged, 1..256; default 4 */
    double mark_threshold;    /**< step 7: e; default 0.20 */
    int row_threshold; /**< step 9: g, a row is repeated when more points are marked; default 4 */
    int multiplicity;  /**< step 9: times a row stands in the net, 1..3; default 3 (= k - 1) */
} crease_averaging_options;

CREASE_API crease_averaging_options crease_averaging_options_default(void);
/** Algorithm 1 of the paper, literally: "Sharp edge preservation using bicubic B-spline surfaces".
 * Errors: ARGUMENT, TOO_FEW_POINTS, DEGENERATE, NO_MEMORY, CANCELLED. */
CREASE_API crease_status crease_averaging_fit(crease_context *context, const crease_cloud *cloud,
    const crease_averaging_options *options, crease_sheet **out);

/** The same edge, done right: creases are knot lines of multiplicity 3 (degree), placed where the
 * data show them, and the control points are a least-squares fit. */
typedef struct crease_sheet_options {
    crease_orientation orientation; /**< default automatic */
    double rotation[9];             /**< for CREASE_ORIENTATION_GIVEN */
    size_t net[2];    /**< control points along u and v; 0 0 = as many as the data ask for */
    int order;        /**< order of both directions, 2..8; default 4 (bicubic) */
    int creases;      /**< most crease lines in each direction; -1 = as many as are significant */
    double smoothing; /**< weight of the thin-plate term; negative = found from the data */
    double tolerance; /**< refine until the rms deviation is below; 0 = until only noise is left */
} crease_sheet_options;

CREASE_API crease_sheet_options crease_sheet_options_default(void);
/** Tells whether one sheet can follow the cloud: whether its points, seen along the z that
 * crease_sheet_fit() would choose, are nearly nowhere one above the other. A part seen from all
 * around is none. O(n log n). Errors: TOO_FEW_POINTS (below 4), DEGENERATE (all points on one
 * line), NO_MEMORY, CANCELLED. */
CREASE_API crease_status crease_sheet_suits(
    crease_context *context, const crease_cloud *cloud, bool *suits);
/** Fits a sheet. When the orientation is automatic, and neither net nor smoothing is prescribed,
 * the creases are looked for as by crease_network_find(): curved ones that run side by side become
 * knot lines, and the patch may be folded so that it is no height field; all coordinates are
 * fitted. Otherwise, or when straight lines will do, the sheet is a height over a rectangle. O(n
 * log n) for a fixed number of control points. Errors: ARGUMENT, TOO_FEW_POINTS, DEGENERATE,
 * NUMERIC, NO_MEMORY, CANCELLED. */
CREASE_API crease_status crease_sheet_fit(crease_context *context, const crease_cloud *cloud,
    const crease_sheet_options *options, crease_sheet **out);
/** Tells whether a sheet carries the creases of its cloud: its points are no further from it than
 * noise explains, nine tenths of the creases within half a spacing of its lines (or 3 sigma over
 * the tangent of the bend, up to a spacing), it bends sharply nowhere else within 2 spacings of a
 * point; or they lie on it within 1e-7 spacings, four or more for each control point. regions,
 * network: of the same cloud. Errors: ARGUMENT (of another), NO_MEMORY, CANCELLED. */
CREASE_API crease_status crease_sheet_carries(crease_context *context, const crease_sheet *sheet,
    const crease_regions *regions, const crease_network *network, bool *carries);

CREASE_API void crease_sheet_free(crease_sheet *sheet);
CREASE_API const crease_surface *crease_sheet_surface(const crease_sheet *sheet);
CREASE_API size_t crease_sheet_line_count(const crease_sheet *sheet);
CREASE_API crease_line crease_sheet_line(const crease_sheet *sheet, size_t index);
/** The curve in space of a crease line. The caller frees it. */
CREASE_API crease_status crease_sheet_line_curve(
    crease_context *context, const crease_sheet *sheet, size_t index, crease_curve **out);
/** The rotation M (row by row) and the origin: local = M (point - origin). */
CREASE_API void crease_sheet_frame(const crease_sheet *sheet, double rotation[9], double origin[3]);
/** Number of data points the sheet was fitted to. */
CREASE_API size_t crease_sheet_point_count(const crease_sheet *sheet);
/** u and v of every data point's projection, point_count x 2; NULL with the paper's algorithm. */
CREASE_API const double *crease_sheet_parameters(const crease_sheet *sheet);
/** Step 11: every data point projected onto the sheet, point_count x 3. */
CREASE_API const double *crease_sheet_projected(const crease_sheet *sheet);
/** Signed distance of every data point to the sheet. */
CREASE_API const double *crease_sheet_deviations(const crease_sheet *sheet);
/** Bootstrap variance of every data point, or NULL when the method needed none. */
CREASE_API const double *crease_sheet_variance(const crease_sheet *sheet);
/** Standard error of the sheet at the foot of every data point, along its normal: from the
 * covariance of control points, places of lines and turn of the frame, with the points' scatter.
 * NULL where not known: curved creases, nets of more than 4096 control points, the paper's
 * algorithm. Based on: Wahba. Bayesian confidence intervals for the cross-validated smoothing
 * spline. 1983. */
CREASE_API const double *crease_sheet_standard_errors(const crease_sheet *sheet);
/** Splits the sheet at all its crease lines into smooth surfaces, u-major, that share their border
 * control points exactly. *count surfaces; free each and the array with
 * crease_surfaces_free(). */
CREASE_API crease_status crease_sheet_faces(
    crease_context *context, const crease_sheet *sheet, crease_surface ***out, size_t *count);
CREASE_API void crease_surfaces_free(crease_surface **surfaces, size_t count);

/** How true a sheet is to the two planes that its points were taken from. */
typedef struct crease_accuracy {
    size_t lines; /**< crease lines of the sheet */
    /** Root mean square distance of the crease line nearest to the true edge from it; not a number
     * when the sheet has no crease line. */
    double position;
    double angle; /**< dihedral angle at that line; 180 when there is none */
    /** Width of the rounded or flattened zone: the length of the sheet, across the edge and through
     * its place nearest to it, whose normal is more than 10 degrees off both planes. */
    double width;
    double rms; /**< distance of the sheet from the true faces, root mean square over its area */
    double max; /**< largest such distance */
} crease_accuracy;

/** Measures a sheet fitted to crease_shape_sample(options): 16 sections of 256 places each. */
CREASE_API crease_accuracy crease_sample_accuracy(
    const crease_sample_options *options, const crease_sheet *sheet);

/* ------------------------------------------------------------------------------------ meshes -- */

/** Triangles with shared vertices. */
typedef struct crease_mesh crease_mesh;

/** Triangulates surfaces so that the mesh stays within the tolerance (a length) of them; borders
 * that coincide are meshed with the same points and share no vertices' normals (sharp edges stay
 * sharp when shaded). tolerance 0: 1/2000 of the diagonal. */
CREASE_API crease_status crease_mesh_create(crease_context *context,
    const crease_surface *const *surfaces, size_t count, double tolerance, crease_mesh **out);
/** Triangles from elsewhere. */
typedef struct crease_mesh_parts {
    size_t vertex_count, triangle_count;
    const double *vertices;    /**< vertex_count x 3 */
    const uint32_t *triangles; /**< triangle_count x 3: numbers of vertices, counterclockwise seen
                                    from where the normal points */
    const uint32_t *owners;    /**< of the triangles; NULL: all 0 */
} crease_mesh_parts;

/** A mesh of given triangles, copied. Normals are those of the triangles around a vertex, weighted
 * by their areas: split vertices where edges are sharp. Errors: ARGUMENT (a triangle with a vertex
 * that there is not), VALUE (a coordinate that is not finite), NO_MEMORY. */
CREASE_API crease_status crease_mesh_from_parts(
    crease_context *context, const crease_mesh_parts *parts, crease_mesh **out);
CREASE_API void crease_mesh_free(crease_mesh *mesh);
CREASE_API size_t crease_mesh_vertex_count(const crease_mesh *mesh);
CREASE_API size_t crease_mesh_triangle_count(const crease_mesh *mesh);
CREASE_API const double *crease_mesh_vertices(const crease_mesh *mesh);    /**< count x 3 */
CREASE_API const double *crease_mesh_normals(const crease_mesh *mesh);     /**< count x 3 */
CREASE_API const uint32_t *crease_mesh_triangles(const crease_mesh *mesh); /**< count x 3 */
/** Number of the surface that each triangle belongs to. */
CREASE_API const uint32_t *crease_mesh_owners(const crease_mesh *mesh);

/** Where a point falls on a mesh. */
typedef struct crease_mesh_foot {
    double point[3];   /**< the closest point of the mesh */
    double distance;   /**< from the point asked for, signed: positive on the side from which the
                            triangle's corners are seen counterclockwise */
    uint32_t triangle; /**< where it lies; of several, the one that faces the point most */
} crease_mesh_foot;

/** The closest point of the mesh for each of count points. Threaded; O(log triangles) for a point
 * near the mesh. feet: count of them. Errors: ARGUMENT (no triangle), VALUE (a coordinate that is
 * not finite), NO_MEMORY, CANCELLED. */
CREASE_API crease_status crease_mesh_project(crease_context *context, const crease_mesh *mesh,
    const double *points, size_t count, crease_mesh_foot *feet);

/* ----------------------------------------------------------------------------------- writing -- */

/** Writes a cloud with its normals and fields: PLY or PCD (binary), XYZ / TXT / CSV / ASC / PTS by
 * extension. What is read back is the same to the bit, text in the digits of its type. Every writer
 * writes beside the target first and then renames: a failure or a signal leaves the old file or
 * none, never half of one. Errors: CANNOT_WRITE, ARGUMENT. */
CREASE_API crease_status crease_cloud_write(
    crease_context *context, const crease_cloud *cloud, const char *path);
/** Writes bytes to a file, in the same careful way. */
CREASE_API crease_status crease_file_write(
    crease_context *context, const char *path, const void *bytes, size_t size);
/** Writes a mesh: PLY, OBJ, STL (binary) or GLB (binary glTF 2.0) by extension. */
CREASE_API crease_status crease_mesh_write(
    crease_context *context, const crease_mesh *mesh, const char *path);
/** Writes curves as polylines within the tolerance: PLY with elements `vertex` (x y z, crease) and
 * `edge` (vertex1 vertex2), OBJ lines, or CSV, by extension. tolerance 0: 1/2000 of the diagonal.
 */
CREASE_API crease_status crease_curves_write(crease_context *context,
    const crease_curve *const *curves, size_t count, double tolerance, const char *path);

/** Writes creases as polylines within 0.02 spacings of their curves, in the formats of
 * crease_curves_write(). In PLY and OBJ creases share the vertex of their corner, and only corners
 * have more than two lines; CSV says region_1, region_2, closed, angle, angle_error and
 * position_error of each point's crease, too. Errors: as there. */
CREASE_API crease_status crease_network_write(
    crease_context *context, const crease_network *network, const char *path);

/* ----------------------------------------------------------------------------------- seeing -- */

/** What a figure or the page shows. Everything is copied in. */
typedef struct crease_scene crease_scene;

CREASE_API crease_status crease_scene_create(
    crease_context *context, const char *title, crease_scene **out);
CREASE_API void crease_scene_free(crease_scene *scene);
/** Adds a cloud: a layer of points, coloured by any of its fields. */
CREASE_API crease_status crease_scene_add_cloud(
    crease_context *context, crease_scene *scene, const char *name, const crease_cloud *cloud);
/** Adds surfaces as one layer, and their control nets as another when nets is true. */
CREASE_API crease_status crease_scene_add_surfaces(crease_context *context, crease_scene *scene,
    const char *name, const crease_surface *const *surfaces, size_t count, bool nets);
/** Adds the control nets of surfaces as one layer, called "NAME control net". */
CREASE_API crease_status crease_scene_add_nets(crease_context *context, crease_scene *scene,
    const char *name, const crease_surface *const *surfaces, size_t count);
/** Adds a mesh as one layer of surfaces, its triangles' owners being the surfaces. Sides of
 * triangles that share no vertices with others are drawn as edges. */
CREASE_API crease_status crease_scene_add_mesh(
    crease_context *context, crease_scene *scene, const char *name, const crease_mesh *mesh);
/** Adds curves, such as creases, as one layer. */
CREASE_API crease_status crease_scene_add_curves(crease_context *context, crease_scene *scene,
    const char *name, const crease_curve *const *curves, size_t count);
/** Something that is known of an item of a layer, such as the radius of a face. */
typedef struct crease_fact {
    const char *name;    /**< such as "radius"; "radius_error" is the standard error of "radius" */
    const char *text;    /**< what it is in words; NULL: in numbers */
    double numbers[8];   /**< one number, or the three of a place or a direction; what is not finite
                              is not known */
    size_t number_count; /**< how many of them are used */
} crease_fact;

/** Says what is known of an item of the layer added last: of the surface or curve with this number;
 * of a cloud, of the points whose field `region` (or `face`) has this number; of surfaces added
 * with their nets, of the surfaces. The page shows it where the item is picked. Copied; several
 * calls for one item add up. Errors: ARGUMENT (no layer, more than 8 numbers), NO_MEMORY. */
CREASE_API crease_status crease_scene_describe(crease_context *context, crease_scene *scene,
    size_t item, const crease_fact *facts, size_t count);

typedef struct crease_figure_options {
    int width, height;     /**< pixels (PNG) or points (SVG, PDF); default 1200 x 900 */
    double azimuth;        /**< of the eye around z, degrees; default -65 */
    double elevation;      /**< of the eye above the x-y plane, degrees; default 35 */
    const char *colour_by; /**< field that colours the points, or NULL: the paper's green */
    bool axes;             /**< draw the box with numbered axes; default true */
} crease_figure_options;

CREASE_API crease_figure_options crease_figure_options_default(void);
/** Draws a scene as PNG, SVG or PDF by extension. */
CREASE_API crease_status crease_figure_write(crease_context *context, const crease_scene *scene,
    const crease_figure_options *options, const char *path);
/** Draws several scenes as the panels (a), (b), (c) ... of one figure, row by row. options: count
 * of them, or NULL for the defaults; every panel has the width and height of the first.
 * count: 1..26.
 */
CREASE_API crease_status crease_figure_panels_write(crease_context *context,
    const crease_scene *const *scenes, const crease_figure_options *options, size_t count,
    int columns, const char *path);
/** Writes a scene as one self-contained HTML page that works offline. */
CREASE_API crease_status crease_page_write(
    crease_context *context, const crease_scene *scene, const char *path);

#ifdef __cplusplus
}
#endif

#endif
