// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/internal/data_table.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/import.h"
#include "obvid/report/curve_comparison.h"

namespace obvid {

/// What `compare_curves` compares.
struct CurvesJob {
  bool align_chord = false;  ///< also after each has the chord of the first; airfoils only
};

/// The job as it was typed: "" or "chord". Error: E203.
[[nodiscard]] Result<CurvesJob> curves_job(const std::string& align);
/// E203 where a factor of the picture is not positive.
[[nodiscard]] Result<void> check_enlarge(const std::optional<double>& enlarge);

/// How inputs become curves.
struct ReadCurveOptions {
  ImportOptions import{};
  FitJob fit{};                  ///< of points
  std::optional<Units> units{};  ///< of all, in place of what the inputs say
};

/// A curve with what the user should know of it.
struct CurveInput {
  ComparedCurve curve;
  std::vector<std::string> warnings{};
};

/// The contour through points. Errors: those of `fit`.
[[nodiscard]] Result<CurveInput> formed_curve(const PointSeries& series, const FitJob& job,
                                              const RunContext& run = {});
/// A curve that is drawn, as it is. Errors: those of `drawn_contour`.
[[nodiscard]] Result<CurveInput> drawn_curve(Drawing drawing, const ReadCurveOptions& how,
                                             const RunContext& run = {});
/// Of a file: a list of points and series of points of drawings are formed, curves of drawings and
/// stored contours are taken as they are (`DrawnUse::kPoints`: formed through points of them).
/// Errors: those of reading, and of `fit`; `where` begins with the path.
[[nodiscard]] Result<CurveInput> read_curve(const std::string& path, const ReadCurveOptions& how,
                                            const RunContext& run = {});
/// The same of a text in memory; `name` stands in errors.
[[nodiscard]] Result<CurveInput> parse_curve(const std::string& text, const std::string& name,
                                             const ReadCurveOptions& how,
                                             const RunContext& run = {});

/// How far the curves are from the first one, along its normals: at some two thousand places of it,
/// more of contours with many pieces, the other curve is looked for along the normal there, both
/// ways, and where it runs the same way as the first one does: upper sides of airfoils are compared
/// with upper sides. Of several such crossings the nearest counts. Where there is none (beyond the
/// end of the other curve) nothing is measured. The largest deviation is sought between places,
/// too. Curves may run either way along each other. Positive is outward where the first is closed
/// or an airfoil, else to its left.
/// Errors: E203 fewer than two curves, chords asked for of what is no airfoil; E310 units that
/// differ; E402 a curve with a cusp; E103. Cost: places times pieces.
[[nodiscard]] Result<CurveComparison> compare_curves(std::vector<ComparedCurve> curves,
                                                     const CurvesJob& job = {},
                                                     const RunContext& run = {});

/// Names curves by the files that they were read from, one for each; files of one name keep their
/// folders, and what was read from none ("") keeps its name.
void name_curves(const std::vector<std::string>& files, std::vector<ComparedCurve>& curves);

/// What keeps the figures from saying more: curves that are no airfoils beside others that are, and
/// chords that differ.
[[nodiscard]] std::vector<std::string> comparison_notes(const CurveComparison& compared);

/// Of airfoils one side of which ends before the other one: what the ends say is of two places.
[[nodiscard]] std::vector<std::string> comparison_warnings(const CurveComparison& compared);

/// One row for each place: where it is, and how far each other curve is from it.
[[nodiscard]] DataTable curves_rows(const CurveComparison& compared);
/// Figures of all curves and deviations; docs/formats.md.
[[nodiscard]] std::string curves_json(const CurveComparison& compared);
/// The curves over each other, deviations enlarged, and plotted below. `enlarge`: by how much;
/// nothing: a round number that makes them visible. On one chord where that was asked for.
[[nodiscard]] std::string curves_svg(const CurveComparison& compared,
                                     std::optional<double> enlarge = {});

}  // namespace obvid
