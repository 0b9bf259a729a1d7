// SPDX-License-Identifier: Apache-2.0
// C2 cubic within a tolerance of a contour: docs/methods/monotone_bspline.md, section 5.
#include "obvid/contour/bsplines/cubic_along.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "contour_length.h"
#include "obvid/contour/bsplines.h"
#include "obvid/curve/internal/path_distance.h"

namespace obvid {
namespace {

using bsplines::ContourLength;

constexpr std::size_t kMostSpans = 65536;
/// Cells per piece over which the density of knots is taken for constant.
constexpr std::size_t kDensityCells = 8;
constexpr int kSpanSamples = 8;  // per span
/// What the largest sampled deviation is aimed at, so that nothing between the samples exceeds the
/// tolerance: eight samples see the flat maximum of a quartic error within 4 %. Where the bound
/// says that it does, the aim is lowered by as much.
constexpr double kOfCubicTolerance = 0.95;
constexpr int kCubicTrials = 8;
/// Spans that err so little, in roundings of the largest coordinate, and no less than half of what
/// half as many did, will not do better.
constexpr double kSpanRoundings = 16.0 * std::numeric_limits<double>::epsilon();
constexpr double kLeastGain = 0.5;
/// Knots that are known to a rounding r only leave the curvature of spans of length h uncertain by
/// as many r / h^2: the second difference of three of them.
constexpr double kOfSecondDifference = 4.0;
/// Spans and pieces that are measured between two questions whether to go on: about a millisecond.
constexpr std::size_t kSpansBetweenQuestions = 64;
/// What making and measuring a span takes, in steps of a solver on one point.
constexpr double kStepsOfSpan = 2.0;
/// Integral of the density that the contour has by its length alone: straight parts get knots too.
constexpr double kLeastDensity = 0.2;

/// Places on the contour with the integral of the wanted density of knots.
struct Density {
  std::vector<double> place, sum;

  /// Place between two others, where the integral has gone this part of the way.
  [[nodiscard]] double between(std::size_t first, std::size_t last, double part) const {
    const double wanted = sum[first] + part * (sum[last] - sum[first]);
    const auto begin = sum.begin();
    const auto from = begin + static_cast<std::ptrdiff_t>(first);
    const auto to = begin + static_cast<std::ptrdiff_t>(last);
    const auto i = static_cast<std::size_t>(std::upper_bound(from + 1, to, wanted) - begin);
    const double t = (wanted - sum[i - 1]) / (sum[i] - sum[i - 1]);
    return place[i - 1] + t * (place[i] - place[i - 1]);
  }

  /// Places of the knots of about n spans. Where there are enough of them the joints are knots: the
  /// slope of the curvature jumps there, which a cubic spline can follow at its knots only.
  [[nodiscard]] std::vector<double> knots(std::size_t n) const {
    constexpr std::size_t kEnough = 2;  // spans per piece
    const std::size_t last = sum.size() - 1, pieces = last / kDensityCells;
    const std::size_t stride = n < kEnough * pieces ? last : kDensityCells;
    std::vector<double> out = {0.0};
    for (std::size_t i = 0; i < last; i += stride) {
      const double share = (sum[i + stride] - sum[i]) / sum.back() * static_cast<double>(n);
      const double count = std::max(1.0, std::round(share));
      for (double k = 1.0; k < count; k += 1.0) out.push_back(between(i, i + stride, k / count));
      out.push_back(place[i + stride]);
    }
    return out;
  }
};

/// A cubic errs with |r''''| h^4, so knots stand as dense as the fourth root of
/// r'''' = (kappa'' - kappa^3) n - 3 kappa kappa' t.
/// Without meaning when the watch ended it.
Density knot_density(const Contour& contour, const ContourLength& length, Watch& watch) {
  Density d{{0.0}, {0.0}};
  const double whole = length.at(static_cast<double>(contour.pieces.size()));
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    if (i % kSpansBetweenQuestions == 0 && watch.cancelled()) break;
    const Piece& piece = contour.pieces[i];
    for (std::size_t c = 0; c < kDensityCells; ++c) {
      const double from = static_cast<double>(c) / kDensityCells;
      const double to = static_cast<double>(c + 1) / kDensityCells;
      const double place = static_cast<double>(i) + to;
      const double ds = length.at(place) - length.at(d.place.back());
      const Jet a = evaluate(piece, from), m = evaluate(piece, 0.5 * (from + to)),
                b = evaluate(piece, to);
      const double kappa = curvature(m), rate = curvature_rate(m);
      const double second = (curvature_rate(b) - curvature_rate(a)) / ds;
      const double fourth = std::hypot(second - kappa * kappa * kappa, 3.0 * kappa * rate);
      d.place.push_back(place);
      // one over a length, so that the size of the drawing does not matter
      const double density = std::sqrt(std::sqrt(fourth / whole)) + kLeastDensity / whole;
      d.sum.push_back(d.sum.back() + density * ds);
    }
  }
  return d;
}

/// Distance of p from the spline near the parameter u.
double distance_from(const CubicSpline& spline, Vec2 p, double u) {
  constexpr int kSteps = 3;  // Newton, from a start that is right to the second order
  for (int k = 0; k < kSteps; ++k) {
    const Jet j = evaluate(spline, u);
    u += dot(p - j.point, j.d1) / dot(j.d1, j.d1);
  }
  return norm(evaluate(spline, u).point - p);
}

Error rounding_keeps_off(double deviation) {
  return error(ErrorCode::kToleranceNotReached,
               "rounding of the coordinates keeps cubic spans from the tolerance")
      .hint("allow more, or move the contour near the origin")
      .value(deviation);
}

class CubicBuilder {
 public:
  CubicBuilder(const Contour& contour, Watch& watch)
      : closed_(contour.closed),
        length_(contour, watch),
        density_(knot_density(contour, length_, watch)),
        watch_(watch) {
    for (const Joint& joint : contour.joints) {
      const Vec2 p = joint.element.point;
      largest_ = std::max({largest_, std::abs(p.x), std::abs(p.y)});
    }
  }

  [[nodiscard]] std::size_t fewest_spans() const { return closed_ ? 4 : 2; }

  /// What rounding of the coordinates may be to blame for.
  [[nodiscard]] double blur() const { return kSpanRoundings * largest_; }

  /// Whether on most of the curved spans the rounding of the knots bends the spline more than the
  /// contour.
  [[nodiscard]] bool rounding_bends(std::size_t n) const {
    const std::vector<double> places = density_.knots(n);
    const double rounding = std::numeric_limits<double>::epsilon() * largest_;
    std::size_t bent = 0, curved = 0;
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      const double h = length_.at(places[i + 1]) - length_.at(places[i]);
      const double kappa = std::max(std::abs(length_.element(places[i]).kappa),
                                    std::abs(length_.element(places[i + 1]).kappa));
      curved += kappa > 0.0 ? 1 : 0;
      bent += kappa > 0.0 && kOfSecondDifference * rounding > kappa * h * h ? 1 : 0;
    }
    return 2 * bent > curved;
  }

  Result<CubicAlong> with_spans(std::size_t n) const {
    const std::vector<double> places = density_.knots(n);
    std::vector<Vec2> points;
    points.reserve(places.size());
    for (const double place : places) points.push_back(length_.element(place).point);
    CubicSplineOptions options;
    options.end = closed_ ? SplineEnd::kPeriodic : SplineEnd::kTangents;
    options.start_slope = unit_at(length_.element(0.0).theta);
    options.end_slope = unit_at(length_.element(places.back()).theta);
    if (closed_) points.pop_back();
    if (watch_.cancelled()) return fail(cancelled_error());
    auto spline = cubic_spline(points, options);
    if (!spline &&
        spline.error().code == ErrorCode::kOutOfOrder) {  // they fall together in doubles
      return fail(rounding_keeps_off(blur()));
    }
    OBVID_TRY(spline);
    watch_.spend(kStepsOfSpan * static_cast<double>(places.size()));
    CubicAlong out{std::move(*spline), 0.0};
    out.deviation = deviation(out.spline, places);
    if (watch_.was_cancelled()) return fail(cancelled_error());
    return out;
  }

 private:
  double deviation(const CubicSpline& spline, const std::vector<double>& places) const {
    double most = 0.0;
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      if (i % kSpansBetweenQuestions == 0 && watch_.cancelled()) break;
      const double from = length_.at(places[i]), to = length_.at(places[i + 1]);
      for (int k = 0; k < kSpanSamples; ++k) {
        const double part = (k + 0.5) / kSpanSamples;
        const double place = places[i] + part * (places[i + 1] - places[i]);
        const double along = (length_.at(place) - from) / (to - from);
        const double u = spline.knots[i] + along * (spline.knots[i + 1] - spline.knots[i]);
        most = std::max(most, distance_from(spline, length_.point(place), u));
      }
    }
    return most;
  }

  bool closed_;
  ContourLength length_;
  Density density_;
  Watch& watch_;
  double largest_ = 0.0;  // coordinate
};

/// Fewest spans, nearly: grown by the fourth root of what is missing, then cut in halves of what is
/// left between a number that does and one that does not.
Result<CubicAlong> search(const CubicBuilder& builder, double tolerance) {
  const std::size_t least = builder.fewest_spans();
  std::size_t failed = 0, n = least, gained_with = least;
  double gained = HUGE_VAL;  // the deviation when it last fell by much
  auto found = builder.with_spans(n);
  while (found && !(found->deviation <= tolerance)) {
    if (n >= kMostSpans) {
      return error(ErrorCode::kToleranceNotReached, "65,536 cubic spans do not reach the tolerance")
          .hint("allow more")
          .value(found->deviation);
    }
    if (found->deviation < kLeastGain * gained) {
      gained = found->deviation;
      gained_with = n;
    } else if (n >= 2 * gained_with && found->deviation <= builder.blur()) {
      return fail(rounding_keeps_off(found->deviation));
    }
    failed = n;
    constexpr double kMostGrowth = 4.0;
    const double growth =
        std::clamp(std::pow(found->deviation / tolerance, 0.25), 1.0, kMostGrowth);
    n = std::min(kMostSpans, static_cast<std::size_t>(growth * static_cast<double>(n)) + 1);
    found = builder.with_spans(n);
  }
  while (found && n - failed > 1 + n / 32) {
    const std::size_t middle = (n + failed) / 2;
    if (middle < least) break;
    auto fewer = builder.with_spans(middle);
    if (fewer && fewer->deviation <= tolerance) {
      n = middle;
      found = std::move(fewer);
    } else {
      failed = middle;
    }
  }
  if (found && builder.rounding_bends(n)) return fail(rounding_keeps_off(found->deviation));
  return found;
}

double distance_of(const Contour& contour, const CubicSpline& spline, Watch& watch) {
  const std::vector<RationalBezier> spans = bezier_pieces(spline);
  return path_distance(contour.pieces, std::vector<Piece>(spans.begin(), spans.end()), &watch);
}

}  // namespace

Result<CubicAlong> cubic_along(const Contour& contour, double tolerance, Watch* watch) {
  if (!(tolerance > 0.0)) {
    return error(ErrorCode::kBadOption, "the tolerance must be greater than 0").value(tolerance);
  }
  if (contour.pieces.empty()) {
    return error(ErrorCode::kNothingThere, "the contour has no pieces");
  }
  for (std::size_t i = 0; i < contour.joints.size(); ++i) {
    if (!contour.joints[i].leaving) continue;
    return error(ErrorCode::kUnsupported, "the contour has a corner")
        .where("joint " + std::to_string(i + 1))
        .hint("split it there")
        .point(i);
  }
  Watch nobody;
  Watch& asked = watch == nullptr ? nobody : *watch;
  const CubicBuilder builder(contour, asked);
  if (asked.was_cancelled()) return fail(cancelled_error());
  double aim = kOfCubicTolerance * tolerance, bound = 0.0;
  for (int trial = 0; trial < kCubicTrials; ++trial) {
    auto found = search(builder, aim);
    if (!found) return found;
    found->deviation = bound = distance_of(contour, found->spline, asked);
    if (asked.was_cancelled()) return fail(cancelled_error());
    if (bound <= tolerance) return found;
    aim *= kOfCubicTolerance * tolerance / bound;
  }
  return error(ErrorCode::kToleranceNotReached, "no cubic was found within the tolerance")
      .hint("allow more")
      .value(bound);
}

}  // namespace obvid
