/* SPDX-License-Identifier: Apache-2.0 */
/* The C interface of Obvid: fair contours through points, proved. docs/c.md explains it.
 *
 * - Every call may be made from any thread; a handle may be read by several threads at once.
 * - A function that can fail returns 0, or the code of its error (401 for E401). `error`, unless it
 *   is NULL, then gets the error; nothing else that the call returns is set.
 * - Texts are UTF-8 and end with a zero. What a call returns is the caller's: texts are freed with
 *   obvid_free, handles and errors with the function of their name. NULL may be freed.
 * - Options are one JSON object with the names of the command line, {"noise": 0.01}; NULL: none.
 * - Reports are one JSON object, the same as the command line prints with --json.
 * - Lengths are in units of the input, angles of arrays in radians, curvatures positive to the
 * left.
 */
#ifndef OBVID_H
#define OBVID_H

#include <stddef.h>

#if defined(OBVID_BUILDING) && defined(__GNUC__)
#define OBVID_API __attribute__((visibility("default")))
#else
#define OBVID_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Changes when a program that was compiled with an older header no longer runs. */
#define OBVID_ABI 3

OBVID_API int obvid_abi(void);
/* "0.1.0"; the library's, never freed. */
OBVID_API const char* obvid_version(void);

typedef struct obvid_input obvid_input;
typedef struct obvid_contour obvid_contour;
typedef struct obvid_files obvid_files;
typedef struct obvid_space obvid_space; /* curves in space, from corner to corner */

/* ---- errors ---------------------------------------------------------------------------------- */

typedef enum obvid_category {
  OBVID_INTERNAL = 1,   /* ours, the machine's, or cancelled */
  OBVID_USAGE = 2,      /* an option or a call that is not possible */
  OBVID_INPUT = 3,      /* the input cannot be read */
  OBVID_NO_CONTOUR = 4, /* no such contour exists */
  OBVID_NOT_PROVED = 5  /* formed, but it does not keep its promise */
} obvid_category;

enum { OBVID_CANCELLED = 103 };

typedef struct obvid_error {
  int code;                /* 401 for E401, `obvid explain E401` */
  obvid_category category; /* code / 100 */
  const char* message;     /* one sentence without a full stop */
  const char* where;       /* "file.csv:12:7", "point 3", a field of the options; may be "" */
  const char* advice;      /* what to do; may be "" */
  const size_t* points;    /* points it is about, from 0; NULL when there are none */
  size_t point_count;
} obvid_error;

OBVID_API void obvid_error_free(obvid_error* error);
/* What an error code means and what helps: `text` is JSON, of "E401" an object, of NULL an array of
 * all. OBVID_USAGE for codes that there are not. */
OBVID_API int obvid_explain(const char* code, char** text, obvid_error** error);
OBVID_API void obvid_free(char* text);

/* ---- progress and cancellation ----------------------------------------------------------------
 */

/* Both functions may be NULL, threads 0, and so may the pointer to a run be NULL. They are called by
 * the thread that called, and must not throw or jump. */
typedef struct obvid_run {
  void* user; /* handed back */
  void (*progress)(void* user, const char* stage, double fraction);
  int (*cancelled)(
      void* user); /* not 0: stop, with OBVID_CANCELLED; docs/c.md says how often it is asked */
  size_t threads;  /* at work at a time, at most; 0: as many as the process may run at once. The
                    * result does not depend on it */
} obvid_run;

/* ---- input ------------------------------------------------------------------------------------
 */

/* n points, x and y one after the other; neighbours that are equal are merged. Two are enough for
 * obvid_fit where the options have both headings, else E304. */
OBVID_API int obvid_points(const double* xy, size_t n, obvid_input** input, obvid_error** error);
/* n points in space, x, y and z one after the other, for surfaces and for obvid_fit_space, which
 * merges equal neighbours and needs 3 distinct ones (E304). */
OBVID_API int obvid_space_points(const double* xyz, size_t n, obvid_input** input,
                                 obvid_error** error);
/* A file in memory: a list of points, a contour file, DXF, SVG, GPX, GeoJSON, LandXML, OpenDRIVE;
 * STEP, IGES and BREP, too, where the helper obvid-cad is installed. `name` stands in errors. */
OBVID_API int obvid_read_text(const char* text, size_t size, const char* name, obvid_input** input,
                              obvid_error** error);
/* The same from a file. */
OBVID_API int obvid_read_file(const char* path, obvid_input** input, obvid_error** error);
OBVID_API void obvid_input_free(obvid_input* input);

/* ---- jobs -------------------------------------------------------------------------------------
 */

/* Forms a contour and proves it. Both results may be there although the call fails with
 * OBVID_NOT_PROVED: the contour was formed and does not keep its promise. A construction of the
 * papers (option "construction") promises nothing. `contour`, `report` may be NULL: not wanted. */
OBVID_API int obvid_fit(const obvid_input* input, const char* options, const obvid_run* run,
                        obvid_contour** contour, char** report, obvid_error** error);
/* Why obvid_fit finds no contour (OBVID_NO_CONTOUR), and what would do: takes some 15 times as
 * long. The error is that of obvid_fit, its points those that would have to move, its advice what
 * would do; `report` is set beside it. 0 and a report of NULL: there is a contour. */
OBVID_API int obvid_why_not(const obvid_input* input, const char* options, const obvid_run* run,
                            char** report, obvid_error** error);
/* The nearest contour that there is and what would have to move, as a file: "svg". Without points
 * that would have to move, the error of obvid_fit; E203 where there is a contour. */
OBVID_API int obvid_why_not_file(const obvid_input* input, const char* options, const char* ending,
                                 const obvid_run* run, obvid_files** files, obvid_error** error);
/* How many vertices which tolerance would need. Fails with OBVID_NO_CONTOUR or OBVID_NOT_PROVED,
 * the report there, where no tolerance gives a contour that keeps its promise. */
OBVID_API int obvid_suggest(const obvid_input* input, const char* options, const obvid_run* run,
                            char** report, obvid_error** error);
/* The same as a file: "svg" (a chart) or "json". */
OBVID_API int obvid_suggest_file(const obvid_input* input, const char* options, const char* ending,
                                 const obvid_run* run, obvid_files** files, obvid_error** error);
/* The points that were read and what is given at them; of a drawing those of the
 * curve that is taken. */
OBVID_API int obvid_series(const obvid_input* input, const char* options, const obvid_run* run,
                           char** report, obvid_error** error);

/* What the points say; of a drawing: what a curvature comb would show of its curves. */
OBVID_API int obvid_analyse(const obvid_input* input, const char* options, const obvid_run* run,
                            char** report, obvid_error** error);
/* The same as a file: "csv" or "json" (tables), of a drawing "svg", too: the curve of the option
 * "curve", else the longest. Takes the options of pictures, as obvid_export does. */
OBVID_API int obvid_analyse_file(const obvid_input* input, const char* options, const char* ending,
                                 const obvid_run* run, obvid_files** files, obvid_error** error);
/* Where every fair contour through the points must lie; with the option "construction" also the
 * table of that construction. */
OBVID_API int obvid_region(const obvid_input* input, const char* options, const obvid_run* run,
                           char** report, obvid_error** error);
/* The tables and drawings of obvid_region as a file: "csv", "tex", "json", "svg",
 * "dxf" or "html". */
OBVID_API int obvid_worksheet(const obvid_input* input, const char* options, const char* ending,
                              const obvid_run* run, obvid_files** files, obvid_error** error);
/* Both boundaries of the region of all curves of monotone curvature between two elements (x, y,
 * heading, curvature; the region of a segment in these reports): one or two arcs each, from `start`
 * to `end`, 5 numbers each: x and y where it begins, heading there, curvature (0: a line), length.
 * `arcs` has room for 20 numbers: first the boundary that begins with the circle of `start`, then
 * the one that ends with that of `end`; `counts`, 2 numbers, how many arcs they have, 0 where there
 * is no such curve. E303 for numbers that are not finite. */
OBVID_API int obvid_region_arcs(const double* start, const double* end, double* arcs,
                                size_t* counts, obvid_error** error);

/* All curve families side by side. */
OBVID_API int obvid_compare(const obvid_input* input, const char* options, const obvid_run* run,
                            char** report, obvid_error** error);
/* The same as a file: "svg" (side by side), "csv" or "json" (tables). Takes the option
 * "curvature-range", too. */
OBVID_API int obvid_compare_file(const obvid_input* input, const char* options, const char* ending,
                                 const obvid_run* run, obvid_files** files, obvid_error** error);
/* Curves laid over each other: points are formed, contour files and curves of drawings are taken as
 * they are. How far all are from the first one; `files`: a picture (suffix ".svg"), the deviation at
 * every place (".csv") and the report (".json"); NULL: not wanted. Remarks are the warnings of the
 * inputs, and what keeps the figures from saying more. */
OBVID_API int obvid_compare_curves(const obvid_input* const* inputs, size_t count,
                                   const char* options, const obvid_run* run, obvid_files** files,
                                   char** report, obvid_error** error);
/* The contour of a contour file, or a curve of a drawing as it is drawn. */
OBVID_API int obvid_stored(const obvid_input* input, const char* options, const obvid_run* run,
                           obvid_contour** contour, obvid_error** error);
/* Proves a contour again from its numbers alone. Fails with OBVID_NOT_PROVED, and the report is
 * set, when it does not keep its promise or its file makes a false claim. */
OBVID_API int obvid_verify(const obvid_contour* contour, const obvid_run* run, char** report,
                           obvid_error** error);

/* The same as a file: "json", "csv" (a row for each piece) or "html" (a page). The file is there
 * with OBVID_NOT_PROVED, too. */
OBVID_API int obvid_verify_file(const obvid_contour* contour, const char* ending,
                                const obvid_run* run, obvid_files** files, obvid_error** error);

/* ---- contours ---------------------------------------------------------------------------------
 */

OBVID_API size_t obvid_contour_pieces(const obvid_contour* contour);
OBVID_API int obvid_contour_closed(const obvid_contour* contour);
OBVID_API double obvid_contour_length(const obvid_contour* contour);
/* What was to be warned of when it was formed; NULL beyond the last. */
OBVID_API const char* obvid_contour_warning(const obvid_contour* contour, size_t warning);
OBVID_API void obvid_contour_free(obvid_contour* contour);

/* What is proved and measured of a contour, as the report has it; without a report as long as the
 * contour. Counts are -1 and lengths NaN where nothing is known. */
typedef struct obvid_figures {
  int proved;         /* 1, 0; -1: never looked at */
  int points, pieces; /* of the contour */
  int vertices, inflections;
  int bound;    /* no curve that does not wind between the points has fewer (docs/claims.md) */
  int corners;  /* joints that are continuous in position only */
  double error; /* largest distance to a curve with the same elements, units */
  double move;  /* largest distance of a point from the contour, an upper bound, units */
  double width; /* largest width of the region, units */
} obvid_figures;
OBVID_API void obvid_contour_figures(const obvid_contour* contour, obvid_figures* figures);

typedef enum obvid_place {
  OBVID_BY_LENGTH = 0,   /* arc length from the start */
  OBVID_BY_PARAMETER = 1 /* piece + t, t in [0, 1]: 2.5 is the middle of the third piece */
} obvid_place;

/* Points, headings and curvatures at `n` places; each array may be NULL. `xy` holds 2 n numbers.
 * E203 for places beyond the contour. */
OBVID_API int obvid_evaluate(const obvid_contour* contour, obvid_place by, const double* at,
                             size_t n, double* xy, double* heading, double* curvature,
                             obvid_error** error);

/* Derivatives of the point by the parameter t of its piece, of order 1, 2 or 3, at `n` parameters
 * (OBVID_BY_PARAMETER). `xy` holds 2 n numbers. E203 for places beyond the contour and other
 * orders. */
OBVID_API int obvid_derivatives(const obvid_contour* contour, const double* at, size_t n, int order,
                                double* xy, obvid_error** error);

/* One NURBS curve in the plane: count + degree + 1 knots, the first and the last degree + 1 of them
 * equal; the numbers are the structure's. */
typedef struct obvid_nurbs {
  int degree;
  size_t count;          /* of control points */
  const double* knots;   /* one for each piece and its cuts, from 0 */
  const double* xy;      /* 2 count numbers */
  const double* weights; /* count numbers, greater than 0 */
} obvid_nurbs;

/* The contour as the one curve that its STEP file holds: the pieces themselves apart from rounding,
 * C1 at every joint (knots of multiplicity degree - 1) but corners (multiplicity degree), curvature
 * as continuous as the contour's. OBVID_INPUT (E310) for clothoids, which are no NURBS curves;
 * OBVID_NOT_PROVED (E501) where pieces differ too much in length or weight for one curve. */
OBVID_API int obvid_contour_nurbs(const obvid_contour* contour, obvid_nurbs** nurbs,
                                  obvid_error** error);
OBVID_API void obvid_nurbs_free(obvid_nurbs* nurbs);

/* What makes a joint G2 here: headings that differ by less (rad), and curvatures by less of the
 * largest, are one. */
OBVID_API double obvid_joint_limit(void);

/* ---- curves in space --------------------------------------------------------------------------
 */

/* Forms a curve through points x, y, z whose z changes (points of an array: always) and proves it:
 * planar, or fair over a fair projection; corners cut it into parts. Options are those of obvid_fit
 * and "along". The report is what the command line prints with --json. Both results may be there
 * with OBVID_NOT_PROVED. */
OBVID_API int obvid_fit_space(const obvid_input* input, const char* options, const obvid_run* run,
                              obvid_space** space, char** report, obvid_error** error);
/* The curves of a file of format obvid-space-curve or obvid-space-chain. */
OBVID_API int obvid_stored_space(const obvid_input* input, obvid_space** space,
                                 obvid_error** error);
/* Proves them again, as obvid_verify does a contour. */
OBVID_API int obvid_verify_space(const obvid_space* space, const obvid_run* run, char** report,
                                 obvid_error** error);

OBVID_API size_t obvid_space_parts(const obvid_space* space);
OBVID_API int obvid_space_closed(const obvid_space* space);
/* Arc length of a part; 0 beyond the last. */
OBVID_API double obvid_space_length(const obvid_space* space, size_t part);
OBVID_API const char* obvid_space_warning(const obvid_space* space, size_t warning);
/* Sums over projections and heights of all parts, the largest of lengths; proved: of all. */
OBVID_API void obvid_space_figures(const obvid_space* space, obvid_figures* figures);
/* Points (3 n numbers), unit tangents (3 n), curvatures (>= 0) and torsions (n each; nan where the
 * curvature is 0) at `n` arc lengths of a part; each array may be NULL. E203 beyond the part. */
OBVID_API int obvid_space_evaluate(const obvid_space* space, size_t part, const double* at,
                                   size_t n, double* xyz, double* tangent, double* curvature,
                                   double* torsion, obvid_error** error);
/* The curvature of a NURBS curve in space: `count` control points (3 numbers each), weights (NULL:
 * all 1) and count + degree + 1 knots, clamped. Vertices, joints that are not G2 and where the
 * curvature is largest, found at 64 places of each span: they are not proved. OBVID_USAGE for numbers
 * that do not belong together. */
OBVID_API int obvid_space_audit(int degree, size_t count, const double* knots, const double* xyz,
                                const double* weights, const obvid_run* run, char** report,
                                obvid_error** error);

/* "json", "step", "iges", "brep", "dxf", "csv", "sldcrv". */
OBVID_API int obvid_space_export(const obvid_space* space, const char* ending, const char* options,
                                 const obvid_run* run, obvid_files** files, obvid_error** error);
OBVID_API void obvid_space_free(obvid_space* space);

/* ---- surfaces ---------------------------------------------------------------------------------
 */

typedef struct obvid_surface obvid_surface;

/* A surface of `count` inputs, and of `crossing` ones that cross them (kind "gordon"; else NULL,
 * 0). Kinds: "skin" (sections), "ruled", "revolve", "coons", "gordon" (curves), "grid", "id" (one
 * grid; of obvid_space_points with the option "row"), "scatter" (points in any order), "offset",
 * "trim", "fillet", "match", "convert" (a surface). Inputs are those of obvid_read_file, obvid_read_text, obvid_space_points
 * and, with z = 0, obvid_points. Where a skin has contours that are not proved, the call fails with
 * OBVID_NOT_PROVED and surface and report are there. */
OBVID_API int obvid_surface_make(const char* kind, const obvid_input* const* inputs, size_t count,
                                 const obvid_input* const* across, size_t crossing,
                                 const char* options, const obvid_run* run, obvid_surface** surface,
                                 char** report, obvid_error** error);
/* Curvatures, joints of patches, monotone parameter lines. */
OBVID_API int obvid_surface_check(const obvid_surface* surface, const char* options,
                                  const obvid_run* run, char** report, obvid_error** error);
/* What was found as a file: "svg" or "html", with the options of both, those of obvid_surface_check
 * and obvid_surface_export. */
OBVID_API int obvid_surface_check_file(const obvid_surface* surface, const char* options,
                                       const char* ending, const obvid_run* run,
                                       obvid_files** files, obvid_error** error);
/* Sections by planes, and what is below a waterplane; `files`: all points (suffixes ".json",
 * ".csv"), and the lines drawing (".svg", ".dxf"). Where contours were asked for that are refused
 * or not proved the call fails, and files and report are there. NULL: not wanted. */
OBVID_API int obvid_surface_cut(const obvid_surface* surface, const char* options,
                                const obvid_run* run, obvid_files** files, char** report,
                                obvid_error** error);
/* The branches of these sections, a file each with its name as suffix ("waterline-1-2"): "csv",
 * points in their planes; with the option "fair" their contours, in any format of obvid_export. Files
 * are there with an error where contours are refused or not proved. */
OBVID_API int obvid_surface_branches(const obvid_surface* surface, const char* options,
                                     const char* ending, const obvid_run* run, obvid_files** files,
                                     obvid_error** error);
/* "json", "step", "iges", "brep", "stl", "obj", "glb", "ply", "html", "svg"; glb is no text. */
OBVID_API int obvid_surface_export(const obvid_surface* surface, const char* ending,
                                   const char* options, const obvid_run* run, obvid_files** files,
                                   obvid_error** error);
/* Program of a three-axis mill; `files`: its G-code, a picture of the path (suffix ".svg") and a
 * page (".html"). Fails with OBVID_NOT_PROVED, files and report
 * there, where something is not kept that was asked for. */
OBVID_API int obvid_surface_toolpath(const obvid_surface* surface, const char* options,
                                     const obvid_run* run, obvid_files** files, char** report,
                                     obvid_error** error);
/* Few lines, arcs and clothoids that pass within a tolerance of the points, and of heights
 * in a column z, or in `heights` (stations and heights; NULL: none), few grades and vertical
 * curves. `contour` is what was found, with stations and profile in LandXML and OpenDRIVE; `files`
 * are tables of the elements (suffix ".csv"), of all offsets (".deviations.csv"), of the profile
 * where there is one (".profile.csv"), and a picture over the stations (".svg"). NULL: not
 * wanted. */
OBVID_API int obvid_alignment(const obvid_input* input, const obvid_input* heights,
                              const char* options, const obvid_run* run, obvid_contour** contour,
                              obvid_files** files, char** report, obvid_error** error);
/* Every curve of drawings and contour files as one program for a mill, a laser or a torch: files
 * are the G-code, a picture (suffix ".svg"), a drawing of the paths (".dxf") and a table of the
 * outlines (".csv"). Points are refused. */
OBVID_API int obvid_cut(const obvid_input* const* inputs, size_t count, const char* options,
                        const obvid_run* run, obvid_files** files, char** report,
                        obvid_error** error);
/* An integro-differential spline of a table: of a function (columns x and f), of points of a curve
 * (option "curve"), or of a function of two variables (x, y and f). `table`, and `against`, more
 * places of the same function that errors are measured by (NULL: none), are those of
 * obvid_read_text and obvid_read_file. `files`: the one of file extension `ending`, "csv", "json",
 * "svg", "dxf" (of two variables "csv", "json"); `graph`: of two variables, else NULL. Each may be
 * NULL: not wanted. */
OBVID_API int obvid_spline(const obvid_input* table, const obvid_input* against,
                           const char* options, const char* ending, const obvid_run* run,
                           obvid_surface** graph, obvid_files** files, char** report,
                           obvid_error** error);
/* A NURBS curve of control points, weights and knots (columns x, y, z, w), or the surface of a net
 * (row and col, too): `surface`, else NULL. `files`: of a curve, the one of file extension
 * `ending`: "csv", "json", "dxf", "step", "iges", "brep". Each may be NULL: not wanted. */
OBVID_API int obvid_nurbs_make(const obvid_input* table, const char* options, const char* ending,
                               const obvid_run* run, obvid_surface** surface, obvid_files** files,
                               char** report, obvid_error** error);
OBVID_API size_t obvid_surface_patches(const obvid_surface* surface);
/* NULL beyond the last. */
OBVID_API const char* obvid_surface_warning(const obvid_surface* surface, size_t warning);
/* Places of a patch at n pairs u, v from 0 to 1: 3 n coordinates, 3 n of the unit normal (du x dv;
 * 0 where there is none), 2 n principal curvatures, larger first; NULL: not wanted. Fails with
 * OBVID_USAGE for patches that are not there and parameters outside. */
OBVID_API int obvid_surface_evaluate(const obvid_surface* surface, size_t patch, const double* uv,
                                     size_t n, double* xyz, double* normal, double* curvatures,
                                     obvid_error** error);
OBVID_API void obvid_surface_free(obvid_surface* surface);

/* ---- files ------------------------------------------------------------------------------------
 */

/* The contour in a format, named by its file extension: "json", "svg", "step", "dxf", "nc", "csv",
 * ... */
OBVID_API int obvid_export(const obvid_contour* contour, const char* ending, const char* options,
                           const obvid_run* run, obvid_files** files, obvid_error** error);
/* Most formats are one file. `suffix` goes between name and ending; the texts are the handle's. */
OBVID_API size_t obvid_files_count(const obvid_files* files);
OBVID_API const char* obvid_files_suffix(const obvid_files* files, size_t file);
OBVID_API const char* obvid_files_data(const obvid_files* files, size_t file, size_t* size);
/* What the format could not hold, and what may be wrong; NULL beyond the last. */
OBVID_API const char* obvid_files_remark(const obvid_files* files, size_t remark);
OBVID_API void obvid_files_free(obvid_files* files);

#ifdef __cplusplus
}
#endif

#endif
