// SPDX-License-Identifier: Apache-2.0
#include "against_spirals.h"

#include <algorithm>

#include "obvid/certify/certify.h"
#include "place_in_regions.h"

namespace obvid::pipeline_detail {
namespace {

/// Samples of a piece, and of the whole contour at least (carriers with few pieces).
constexpr int kLeastPerPiece = 16;
constexpr std::size_t kLeastSamples = 2000;

std::vector<CurvePoint> sample_points(const Contour& contour) {
  const std::size_t pieces = std::max<std::size_t>(contour.pieces.size(), 1);
  const int each = std::max(kLeastPerPiece, static_cast<int>(kLeastSamples / pieces));
  std::vector<CurvePoint> out;
  for (std::size_t k = 0; k < contour.pieces.size(); ++k) {
    const Piece& piece = contour.pieces[k];
    out.push_back({start_point(piece), contour.joints[k].source});
    for (int i = 1; i < each; ++i) {
      out.push_back({evaluate(piece, static_cast<double>(i) / each).point, std::nullopt});
    }
  }
  if (!contour.pieces.empty()) out.push_back({end_point(contour.pieces.back()), std::nullopt});
  return out;
}

/// Distances of points from the spirals, each a proved upper bound.
double farthest_from(const Contour& spirals, const std::vector<CurvePoint>& points) {
  Contour probe = spirals;
  probe.points.clear();
  for (const CurvePoint& p : points) probe.points.push_back(p.point);
  probe.point_tolerance.clear();  // the samples are no points of the series
  for (Joint& joint : probe.joints) joint.source.reset();
  double most = 0.0;
  for (const double d : point_distances(probe)) most = std::max(most, d);
  return most;
}

}  // namespace

void measure_against(const Contour& spirals, const Contour& contour, FitReport& report) {
  const std::vector<CurvePoint> points = sample_points(contour);
  report.outside_spirals_region = distance_outside_regions(spirals, points);
  report.carrier_deviation = farthest_from(spirals, points);
}

}  // namespace obvid::pipeline_detail
