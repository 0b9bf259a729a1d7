// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/alignment_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "obvid/io/internal/json_text.h"
#include "obvid/pipeline/audit.h"
#include "obvid/pipeline/element_table.h"

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

Result<std::optional<SpeedLimit>> speed_limit(const Units& units,
                                              const std::optional<double>& acceleration) {
  if (!acceleration) return std::optional<SpeedLimit>();
  if (!(*acceleration > 0.0 && std::isfinite(*acceleration))) {
    return fail({ErrorCode::kBadOption, "the acceleration must be positive", "acceleration",
                 "give it in m/s^2"});
  }
  const auto metres = unit_ratio(units, "m", "speeds");
  OBVID_TRY(metres);
  return std::optional(SpeedLimit{*acceleration, *metres});
}

}  // namespace

Result<AlignmentReport> alignment_report(const PointSeries& series, const AlignmentJob& job,
                                         const RunContext& run) {
  const auto tolerance = tolerances_of(series, job);
  if (!tolerance) return fail(tolerance.error());
  const auto limit = speed_limit(series.units, job.acceleration);
  OBVID_TRY(limit);
  AlignmentOptions limits;
  limits.least_length = job.least_length;
  limits.least_radius = job.least_radius;
  auto alignment = fit_alignment(series.points, *tolerance, limits, run);
  if (!alignment) return fail(alignment.error());
  for (AlignmentElement& e : alignment->elements) e.station += job.first_station;
  for (AlignmentDeviation& d : alignment->deviations) d.station += job.first_station;
  AlignmentReport out;
  out.name = series.name;
  out.units = series.units;
  out.tolerance = *std::max_element(tolerance->begin(), tolerance->end());
  CurveAudit audited = audit(curve_of(*alignment, series.name), series.units);
  out.stored = {std::move(audited.contour), std::nullopt, std::move(audited.certificate)};
  out.alignment = std::move(*alignment);
  out.limit = *limit;
  return out;
}

std::string deviations_csv(const AlignmentReport& report, const std::vector<Vec2>& points) {
  std::string out = "station,offset,x,y\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const AlignmentDeviation& d = report.alignment.deviations[i];
    out += fmt::format("{:.17g},{:.17g},{:.17g},{:.17g}\n", d.station, d.offset, points[i].x,
                       points[i].y);
  }
  return out;
}

std::string alignment_json(const AlignmentReport& report) {
  const Alignment& alignment = report.alignment;
  JsonText json;
  json.begin_object().pair("format", "obvid-alignment").pair("version", 1);
  json.pair("name", report.name).pair("units", report.units.text());
  json.pair("tolerance", report.tolerance).pair("length", alignment.length);
  json.pair("largest_share", alignment.largest_share).pair("rms", alignment.rms);
  json.pair("curvature_steps", curvature_steps(alignment.elements));
  json.key("elements");
  add_elements(json, alignment.elements, report.limit);
  json.key("deviations").begin_array();
  for (const AlignmentDeviation& d : alignment.deviations) {
    json.begin_object().pair("station", d.station).pair("offset", d.offset).end_object();
  }
  json.end_array().end_object();
  return json.take();
}

}  // namespace obvid
