// SPDX-License-Identifier: Apache-2.0
#include "alignment/drawn_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "obvid/core/internal/figures.h"
#include "obvid/curve/pieces.h"

namespace obvid::pipeline_detail {
namespace {

constexpr double kOfTolerance = 0.5;    ///< that chords between the points are off what is drawn
constexpr double kFewestOfPiece = 8.0;  ///< distances on the shortest piece, for its kind to show
constexpr double kMostDistances = 2000.0;  ///< on the whole curve: more take minutes

struct Drawn {
  double length = 0.0, shortest = HUGE_VAL, sharpest = 0.0;
};

Drawn measured(const PointSeries& series) {
  Drawn out;
  for (const KeptPiece& kept : series.kept) {
    const double length = arc_length(kept.piece, 0.0);
    out.length += length;
    out.shortest = std::min(out.shortest, length);
    for (const double t : {0.0, 0.5, 1.0}) {
      out.sharpest = std::max(out.sharpest, std::abs(element_at(kept.piece, t).kappa));
    }
  }
  return out;
}

}  // namespace

Result<void> drawn_curve_has_tolerance(const PointSeries& series, bool given) {
  if (series.kept.empty() || given) return {};
  return fail({ErrorCode::kBadOption, "a drawn curve has no tolerance of its own", "--noise",
               "say how far new elements may be off; `analyse` lists those that are drawn, "
               "`convert` writes them"});
}

PointSeries with_drawn_points(const PointSeries& series, double tolerance,
                              std::vector<std::string>& remarks,
                              std::vector<std::string>& warnings) {
  if (series.kept.empty()) return series;
  const Drawn drawn = measured(series);
  // an arc of radius R is h^2 / 8 R above a chord of length h
  double wanted = drawn.shortest / kFewestOfPiece;
  if (drawn.sharpest > 0.0) {
    wanted = std::min(wanted, std::sqrt(8.0 * kOfTolerance * tolerance / drawn.sharpest));
  }
  const double step = std::max(wanted, drawn.length / kMostDistances);
  PointSeries out = series;
  out.kept.clear();
  out.points.clear();
  out.fixed.clear();
  auto kept = series.kept.begin();
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    out.points.push_back(series.points[i]);
    if (!series.fixed.empty()) out.fixed.push_back(series.fixed[i]);
    if (kept == series.kept.end() || kept->from != i) continue;
    const int parts = std::max(2, static_cast<int>(std::ceil(arc_length(kept->piece, 0.0) / step)));
    for (int k = 1; k < parts; ++k) {
      out.points.push_back(evaluate(kept->piece, static_cast<double>(k) / parts).point);
      if (!series.fixed.empty()) out.fixed.emplace_back();
    }
    ++kept;
  }
  const std::string at =
      fmt::format("points of what is drawn were taken at distances of at most {} {}",
                  significant(step, 3), series.units.text());
  if (step > wanted) {
    warnings.push_back(
        fmt::format("{}, the nearest that there are: between them the alignment may "
                    "be farther off than the tolerance",
                    at));
  } else {
    remarks.push_back(at);
  }
  return out;
}

}  // namespace obvid::pipeline_detail
