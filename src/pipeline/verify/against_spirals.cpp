// SPDX-License-Identifier: Apache-2.0
#include "verify/against_spirals.h"

#include <algorithm>

#include "fit/outside_regions.h"
#include "obvid/curve/internal/nearest_along.h"

namespace obvid::pipeline_detail {
namespace {

/// Samples of a piece, and of the whole contour at least (carriers with few pieces). Between two of
/// 32 along a swing the distance is at most half a percent larger.
constexpr int kLeastPerPiece = 16;
constexpr std::size_t kLeastSamples = 256;

std::vector<CurvePoint> sample_points(const Contour& contour, Watch& watch) {
  const std::size_t pieces = std::max<std::size_t>(contour.pieces.size(), 1);
  const int each = std::max(kLeastPerPiece, static_cast<int>(kLeastSamples / pieces));
  std::vector<CurvePoint> out;
  out.reserve(contour.pieces.size() * static_cast<std::size_t>(each) + 1);
  for (std::size_t k = 0; k < contour.pieces.size() && !watch.cancelled(); ++k) {
    const Piece& piece = contour.pieces[k];
    out.push_back({start_point(piece), station_of(contour, k)});
    for (int i = 1; i < each; ++i) {
      out.push_back({evaluate(piece, static_cast<double>(i) / each).point, std::nullopt});
    }
  }
  if (!contour.pieces.empty()) out.push_back({end_point(contour.pieces.back()), std::nullopt});
  return out;
}

double farthest_from(const Contour& spirals, const std::vector<CurvePoint>& points, Watch& watch) {
  NearestAlong path(spirals.pieces);
  double most = 0.0;
  for (const CurvePoint& p : points) {
    if (watch.cancelled()) break;
    most = std::max(most, path.next(p.point, most).distance);
  }
  return most;
}

}  // namespace

void measure_against(const Contour& spirals, const Contour& contour, Watch& watch,
                     FitReport& report) {
  const std::vector<CurvePoint> points = sample_points(contour, watch);
  report.outside_spirals_region = distance_outside_regions(spirals, points, watch);
  report.carrier_deviation = farthest_from(spirals, points, watch);
}

}  // namespace obvid::pipeline_detail
