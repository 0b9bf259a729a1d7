// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/analyse.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "obvid/core/internal/figures.h"
#include "obvid/pipeline/import.h"

namespace obvid {
namespace {

/// What the points of the chosen series say; a warning instead where they say nothing.
std::optional<AnalysedSeries> analysed(Drawing& drawing, std::size_t number) {
  PointSeries series = drawing.series[number];
  series.units = drawing.units;
  auto analysis = analyse(series.points);
  if (!analysis) {
    drawing.warnings.push_back(fmt::format("{}: {}", series.name, analysis.error().what));
    return std::nullopt;
  }
  add_rounding_warning(series, *analysis);
  drawing.warnings.insert(drawing.warnings.end(), series.warnings.begin(), series.warnings.end());
  return AnalysedSeries{std::move(series), std::move(*analysis)};
}

Vec2 extent_of(const std::vector<Vec2>& points) {
  Vec2 low = points.front(), high = low;
  for (const Vec2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return high - low;
}

}  // namespace

Result<AnalysedDrawing> analyse_drawing(Drawing drawing, const std::optional<std::size_t>& curve,
                                        const std::string& where) {
  const auto chosen = chosen_curve(drawing, curve, where);
  if (!chosen && curve) return fail(chosen.error());
  AnalysedDrawing out{std::move(drawing), {}, {}};
  for (const DrawnCurve& one : out.drawing.curves) {
    out.audits.push_back(audit(one, out.drawing.units));
  }
  const std::size_t curves = out.audits.size();
  if (chosen && *chosen >= curves) out.points = analysed(out.drawing, *chosen - curves);
  return out;
}

void add_rounding_warning(PointSeries& series, const Analysis& analysis) {
  if (analysis.rounding_decided.empty()) return;
  const std::size_t first = analysis.rounding_decided.front();
  series.warnings.push_back(fmt::format(
      "the rounding of the coordinates decides which way curvature changes on {}, first between "
      "points {} and {}",
      counted(analysis.rounding_decided.size(), "chord", "chords"), first + 1, first + 2));
}

SeriesFigures figures_of(const PointSeries& series) {
  constexpr const char* kSeriesKinds[] = {"points", "route", "single points", "waypoints"};
  const std::vector<Vec2>& points = series.points;
  SeriesFigures out;
  out.kind = kSeriesKinds[static_cast<int>(series.kind)];
  for (std::size_t i = 1; i < points.size(); ++i) out.length += norm(points[i] - points[i - 1]);
  out.closed = points.size() > 2 && points.front() == points.back();
  out.box = extent_of(points);
  return out;
}

}  // namespace obvid
