// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/alignment_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "obvid/geom/angle.h"
#include "obvid/io/internal/json_text.h"
#include "obvid/pipeline/audit.h"

namespace obvid {
namespace {

Result<std::vector<double>> tolerances_of(const PointSeries& series, const AlignmentJob& job) {
  if (job.noise && !(*job.noise > 0.0 && std::isfinite(*job.noise))) {
    return fail({ErrorCode::kBadOption, "the tolerance must be a positive length", "noise",
                 "give it in the units of the points"});
  }
  const double rounding = std::max(series.rounding.x, series.rounding.y);
  const double all = job.noise.value_or(rounding);
  std::vector<double> out(series.points.size(), all);
  for (std::size_t i = 0; i < series.fixed.size(); ++i) {
    if (series.fixed[i].tolerance) out[i] = *series.fixed[i].tolerance;
  }
  const auto bad = std::find_if(out.begin(), out.end(), [](double t) { return !(t > 0.0); });
  if (bad != out.end()) {
    return fail({ErrorCode::kBadOption, "an alignment needs a tolerance", "noise",
                 "say how far it may pass the points", bad - out.begin(), *bad});
  }
  return out;
}

Piece piece_of(const AlignmentElement& e, Vec2 end) {
  const Element& a = e.start;
  switch (e.kind) {
    case AlignmentKind::kLine:
      return LinePiece{a.point, end};
    case AlignmentKind::kArc:
      return ArcPiece{a.point, end, a.theta, a.kappa, e.length};
    case AlignmentKind::kClothoid:
      break;
  }
  return ClothoidPiece{a.point, end, a.theta, a.kappa, e.kappa1, e.length};
}

DrawnCurve curve_of(const Alignment& alignment, const std::string& name) {
  DrawnCurve out;
  out.label = name;
  for (std::size_t k = 0; k < alignment.elements.size(); ++k) {
    const bool last = k + 1 == alignment.elements.size();
    out.pieces.push_back(piece_of(alignment.elements[k],
                                  (last ? alignment.end : alignment.elements[k + 1].start).point));
  }
  return out;
}

std::string radius_cell(double kappa) {
  return kappa == 0.0 ? "" : fmt::format("{:.17g}", 1.0 / kappa);
}

}  // namespace

Result<AlignmentReport> alignment_report(const PointSeries& series, const AlignmentJob& job,
                                         const RunContext& run) {
  const auto tolerance = tolerances_of(series, job);
  if (!tolerance) return fail(tolerance.error());
  auto alignment = fit_alignment(series.points, *tolerance, {}, run);
  if (!alignment) return fail(alignment.error());
  AlignmentReport out;
  out.name = series.name;
  out.units = series.units;
  out.tolerance = *std::max_element(tolerance->begin(), tolerance->end());
  CurveAudit audited = audit(curve_of(*alignment, series.name), series.units);
  out.stored = {std::move(audited.contour), std::nullopt, std::move(audited.certificate)};
  out.alignment = std::move(*alignment);
  return out;
}

const char* to_string(AlignmentKind kind) {
  static constexpr std::array kNames = {"line", "arc", "clothoid"};
  return kNames[static_cast<std::size_t>(kind)];
}

double clothoid_parameter(const AlignmentElement& element) {
  const double change = std::abs(element.kappa1 - element.start.kappa);
  return change > 0.0 ? std::sqrt(element.length / change) : 0.0;
}

double azimuth_deg(double theta) {
  const double angle = std::remainder(0.5 * std::numbers::pi - theta, kFullTurn) / kOneDegree;
  return angle < 0.0 ? angle + 360.0 : angle;
}

std::size_t curvature_steps(const Alignment& alignment) {
  return static_cast<std::size_t>(std::count_if(
      alignment.elements.begin(), alignment.elements.end(), [](const auto& e) { return e.step; }));
}

std::string alignment_json(const AlignmentReport& report) {
  const Alignment& alignment = report.alignment;
  JsonText json;
  json.begin_object().pair("format", "obvid-alignment").pair("version", 1);
  json.pair("name", report.name).pair("units", report.units.text());
  json.pair("tolerance", report.tolerance).pair("length", alignment.length);
  json.pair("largest_share", alignment.largest_share).pair("rms", alignment.rms);
  json.pair("curvature_steps", curvature_steps(alignment));
  json.key("elements").begin_array();
  for (const AlignmentElement& e : alignment.elements) {
    json.begin_object().pair("kind", to_string(e.kind)).pair("station", e.station);
    json.pair("length", e.length).pair("x", e.start.point.x).pair("y", e.start.point.y);
    json.pair("heading", e.start.theta).pair("curvature_start", e.start.kappa);
    json.pair("curvature_end", e.kappa1).pair("step", e.step).end_object();
  }
  json.end_array().key("deviations").begin_array();
  for (const AlignmentDeviation& d : alignment.deviations) {
    json.begin_object().pair("station", d.station).pair("offset", d.offset).end_object();
  }
  json.end_array().end_object();
  return json.take();
}

std::string alignment_csv(const AlignmentReport& report) {
  std::string out = "kind,station,length,radius_start,radius_end,A,azimuth_deg,x,y\n";
  for (const AlignmentElement& e : report.alignment.elements) {
    const double parameter = clothoid_parameter(e);
    out += fmt::format("{},{:.17g},{:.17g},{},{},{},{:.17g},{:.17g},{:.17g}\n", to_string(e.kind),
                       e.station, e.length, radius_cell(e.start.kappa), radius_cell(e.kappa1),
                       parameter > 0.0 ? fmt::format("{:.17g}", parameter) : "",
                       azimuth_deg(e.start.theta), e.start.point.x, e.start.point.y);
  }
  return out;
}

}  // namespace obvid
