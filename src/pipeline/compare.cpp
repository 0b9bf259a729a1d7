// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/compare.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "obvid/certify/certify.h"
#include "place_in_regions.h"

namespace obvid {
namespace {

using namespace pipeline_detail;

/// Calls that are timed: as many as take this long, at least one, at most this many.
constexpr double kLongEnough = 0.1;  // s
constexpr int kMostCalls = 9;
/// Samples of a piece, and of the whole contour at least (carriers with few pieces).
constexpr int kLeastPerPiece = 16;
constexpr std::size_t kLeastSamples = 2000;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Median time of the calls; the contour is the same every time.
Result<Fit> timed_fit(const PointSeries& series, const FitJob& job, double& median) {
  std::vector<double> times;
  Result<Fit> made;
  double all = 0.0;
  while (times.empty() || (all < kLongEnough && times.size() < kMostCalls)) {
    const auto begin = std::chrono::steady_clock::now();
    made = fit(series, job);
    times.push_back(seconds_since(begin));
    all += times.back();
    if (!made) return made;
  }
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2),
                   times.end());
  median = times[times.size() / 2];
  return made;
}

int continuity_of(const Certificate& certificate) {
  // gaps below these are what rounding leaves (docs/methods/certify.md)
  constexpr double kSameHeading = 1e-7, kSameCurvature = 1e-4;
  if (certificate.gaps.heading > kSameHeading) return 0;
  return certificate.gaps.curvature > kSameCurvature ? 1 : 2;
}

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

void measure_against(const Contour& spirals, ComparedCarrier& row) {
  const std::vector<CurvePoint> points = sample_points(row.fit.contour);
  const RegionDistances distances = place_in_regions(spirals, points);
  row.error_bound = distances.farther;
  row.outside = distances.outside;
  row.deviation = row.carrier == Carrier::kSpiral ? 0.0 : farthest_from(spirals, points);
  row.control_points = control_points(row.fit.contour);
  row.continuity = continuity_of(row.fit.certificate);
}

std::size_t control_points_of(const Piece& piece) {
  if (std::holds_alternative<LinePiece>(piece)) return 2;
  if (const auto* bezier = std::get_if<RationalBezier>(&piece)) {
    return static_cast<std::size_t>(bezier->degree) + 1;
  }
  const auto* arc = std::get_if<ArcPiece>(&piece);
  if (arc == nullptr) return 0;
  // a rational quadratic turns by less than half a turn; a quarter is what CAD systems take
  constexpr double kQuarter = 1.5707963267948966;
  const double quarters = std::ceil(std::abs(arc->kappa * arc->length) / kQuarter);
  return 2 * static_cast<std::size_t>(std::max(quarters, 1.0)) + 1;
}

/// Control points that a joint saves: one is shared, and each order of continuity by the parameter
/// takes one more.
std::size_t saved_by_joint(Carrier carrier) {
  constexpr std::size_t kC2 = 3;
  switch (carrier) {
    case Carrier::kBspline:
    case Carrier::kCubic:
    case Carrier::kBaseline:
      return kC2;
    default:
      return 1;
  }
}

}  // namespace

std::size_t control_points(const Contour& contour) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    const std::size_t own = control_points_of(contour.pieces[i]);
    if (own == 0) return 0;
    const bool corner = i < contour.joints.size() && contour.joints[i].leaving.has_value();
    const bool alike = i > 0 && contour.pieces[i].index() == contour.pieces[i - 1].index() &&
                       !std::holds_alternative<LinePiece>(contour.pieces[i]);
    const std::size_t saved = i == 0 ? 0 : corner || !alike ? 1 : saved_by_joint(contour.carrier);
    count += own - std::min(saved, own);
  }
  return count;
}

Result<Comparison> compare_carriers(const PointSeries& series, const FitJob& job,
                                    const Progress& progress) {
  Comparison out;
  for (const Carrier carrier : kAllCarriers) {
    if (progress) {
      progress(to_string(carrier),
               static_cast<double>(out.carriers.size()) / static_cast<double>(kAllCarriers.size()));
    }
    FitJob one = job;
    one.carrier = carrier;
    ComparedCarrier row;
    row.carrier = carrier;
    auto made = timed_fit(series, one, row.seconds);
    if (!made && carrier == Carrier::kSpiral) return tl::unexpected(made.error());
    if (made) {
      row.fit = std::move(*made);
      const Contour& spirals =
          carrier == Carrier::kSpiral ? row.fit.contour : out.carriers.front().fit.contour;
      measure_against(spirals, row);
    } else {
      row.refusal = made.error();
    }
    out.carriers.push_back(std::move(row));
  }
  if (progress) progress("done", 1.0);
  return out;
}

}  // namespace obvid
