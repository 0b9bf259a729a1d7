// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/compare.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "obvid/certify/certify.h"

namespace obvid {
namespace {

/// Calls that are timed: as many as take this long, at least one, at most this many.
constexpr double kLongEnough = 0.1;  // s
constexpr int kMostCalls = 9;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Median time of the calls, without what is measured against the spirals; the contour is the same
/// every time.
Result<Fit> timed_fit(const PointSeries& series, const FitJob& job, double& median) {
  FitJob alone = job;
  alone.measure_against_spirals = false;
  std::vector<double> times;
  Result<Fit> made;
  double all = 0.0;
  while (times.empty() || (all < kLongEnough && times.size() < kMostCalls)) {
    const auto begin = std::chrono::steady_clock::now();
    made = fit(series, alone);
    times.push_back(seconds_since(begin));
    all += times.back();
    if (!made) return made;
  }
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2),
                   times.end());
  median = times[times.size() / 2];
  return job.carrier == Carrier::kSpiral ? made : fit(series, job);
}

int continuity_of(const Certificate& certificate) {
  // gaps below these are what rounding leaves (docs/methods/certify.md)
  constexpr double kSameHeading = 1e-7, kSameCurvature = 1e-4;
  if (certificate.gaps.heading > kSameHeading) return 0;
  return certificate.gaps.curvature > kSameCurvature ? 1 : 2;
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
      row.control_points = control_points(row.fit.contour);
      row.continuity = continuity_of(row.fit.certificate);
    } else {
      row.refusal = made.error();
    }
    out.carriers.push_back(std::move(row));
  }
  if (progress) progress("done", 1.0);
  return out;
}

}  // namespace obvid
