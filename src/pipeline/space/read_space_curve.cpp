// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "obvid/contour/bsplines/nurbs_of.h"
#include "obvid/core/internal/figures.h"
#include "obvid/pipeline/audit.h"
#include "obvid/pipeline/skin_sections.h"
#include "obvid/pipeline/surface_job.h"
#include "surface/surface_inputs.h"
#include "surface/surface_kinds.h"
#include "verify/report.h"

namespace obvid {
namespace {

/// Of curves that NURBS do not hold (clothoids): far below what a surface is made within.
constexpr double kFollowing = 1e-8;  ///< of the size

Result<ReadCurve> curve_of_contour(const Contour& contour, const Frame& frame, std::string name) {
  double size = 0.0;
  for (const Piece& piece : contour.pieces)
    size = std::max(size, norm(end_point(piece) - start_point(contour.pieces.front())));
  auto made = nurbs_of(contour, {true, kFollowing * size});
  OBVID_TRY(made);
  ReadCurve curve{std::move(name), contour.units, placed(made->curve, frame), {}, made->deviation};
  if (made->deviation > 0.0) {
    curve.warnings.push_back(
        fmt::format("{}: clothoids are followed by a C2 cubic within {} {}", curve.name,
                    significant_above(made->deviation, kDigitsOfBounds), contour.units.text()));
  }
  return curve;
}

Result<ReadCurve> from_drawing(const SurfaceInput& input, const CurveReading& how,
                               const RunContext& run) {
  const std::string& path = input.name;
  const Result<Drawing> drawing = input.text
                                      ? parse_drawing(*input.text, path, how.import.planes, run)
                                      : read_drawing(path, how.import.planes, run);
  OBVID_TRY(drawing);
  const auto chosen = chosen_curve(*drawing, how.import.curve, path);
  OBVID_TRY(chosen);
  if (*chosen >= drawing->curves.size()) {
    return error(ErrorCode::kUnsupported, "the drawing holds points, not a curve")
        .where(path)
        .hint("write the points to a text file and give that");
  }
  const DrawnCurve& drawn = drawing->curves[*chosen];
  auto curve = curve_of_contour(contour_as_drawn(drawn, drawing->units), Frame{}, drawn.label);
  if (!curve) return curve;
  curve->warnings.insert(curve->warnings.end(), drawing->warnings.begin(), drawing->warnings.end());
  return curve;
}

/// How far points are from a plane, at most.
double flatness(const std::vector<Vec3>& points, const Frame& frame) {
  double worst = 0.0;
  for (const Vec3& p : points) worst = std::max(worst, std::abs(frame.height(p)));
  return worst;
}

Result<ReadCurve> spline_through(const SpaceSeries& series) {
  std::vector<Vec3> points;
  for (const Vec3& p : series.points) {
    if (points.empty() || !(points.back() == p)) points.push_back(p);
  }
  auto curve = interpolated(points, chord_parameters(points));
  OBVID_TRY(curve);
  return ReadCurve{series.name, series.units, std::move(*curve), {}, 0.0};
}

Result<ReadCurve> from_points(const SurfaceInput& input, const CurveReading& how,
                              const RunContext& run) {
  const std::string& path = input.name;
  const auto section = pipeline_detail::section_of(input, run);
  OBVID_TRY(section);
  const SpaceSeries& series = *section;
  const Frame frame = plane_of(series.points);
  double size = 0.0;
  for (const Vec3& p : series.points) size = std::max(size, norm(p - series.points.front()));
  constexpr double kRounding = 1e-9;  // of the size: printed points of a plane that lies askew
  const PlaneRounding printed = rounding_in(frame, series.rounding);
  const double noise =
      how.sections.noise_from_rounding ? printed.across : how.sections.noise.value_or(0.0);
  const double allowed = std::max(noise, kRounding * size);
  if (flatness(series.points, frame) > allowed) {
    auto curve = spline_through(series);
    if (!curve) return curve;
    curve->warnings.push_back(fmt::format(
        "{}: the points lie in no plane: the C2 cubic by chord lengths runs through them", path));
    return curve;
  }
  PointSeries flat;
  flat.name = series.name;
  flat.units = series.units;
  flat.rounding = printed.within;
  for (const Vec3& p : series.points) flat.points.push_back(frame.in_plane(p));
  if (flat.points.size() == 2) {
    return ReadCurve{series.name,
                     series.units,
                     line_between(series.points.front(), series.points.back()),
                     {},
                     0.0};
  }
  const Result<Fit> made = fit(flat, how.sections, without_progress(run));
  if (!made && how.plain_when_refused && category(made.error().code) == ErrorCategory::kNoContour) {
    auto curve = spline_through(series);
    if (!curve) return curve;
    curve->warnings.push_back(
        fmt::format("{}: no fair contour ({}), the C2 cubic through its points stands for it", path,
                    made.error().what));
    return curve;
  }
  if (!made) {
    Error error = made.error();
    if (category(error.code) == ErrorCategory::kNoContour) {
      error.hint = pipeline_detail::without_fair_contour(how.sections);
    }
    error.where = error.where.empty() ? path : path + ", " + error.where;
    return fail(error);
  }
  auto curve = curve_of_contour(made->contour, frame, series.name);
  if (!curve) return curve;
  curve->warnings.insert(curve->warnings.end(), made->warnings.begin(), made->warnings.end());
  return curve;
}

}  // namespace

Result<ReadCurve> read_space_curve(const SurfaceInput& input, const CurveReading& how,
                                   const RunContext& run) {
  OBVID_TRY(may_go_on(run));
  const bool drawing = input.text ? is_drawing_text(*input.text, input.name)
                                  : input.is_file() && is_drawing(input.name);
  return drawing ? from_drawing(input, how, run) : from_points(input, how, run);
}

}  // namespace obvid
