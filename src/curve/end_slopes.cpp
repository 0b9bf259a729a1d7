// SPDX-License-Identifier: Apache-2.0
// Weights with more digits of the slope of curvature than points have: docs/methods/curve.md.
#include "obvid/curve/internal/end_slopes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "exact_cross.h"

namespace obvid {
namespace {

using namespace curve_detail;
using numeric::DoubleDouble;

constexpr int kQuartic = 4;
/// Slopes that are right to this part of the larger one stay as they are.
constexpr double kRightSlope = 1e-9;
/// What a weight may change by: curvatures at the ends change by less than three times this.
constexpr double kMostOfWeights = 1e-9;
constexpr int kWeightSteps = 4;

/// Slope of curvature at an end, with derivatives by the logarithms of weights 1, 2, 3.
struct SlopeByWeights {
  double value = 0.0;
  std::array<double, 3> by{};
};

/// From the end on, with legs v1, v2, v3 and L = |v1|: 3 w0/(16 w1^4 L^6) (T1 - T2 + T3),
/// T1 = 2 w0 w1 w3 L^2 v1 x v3, T2 = 9 w0 w2^2 (v1 x v2) v1.v2, T3 = 12 w1^2 w2 L^2 v1 x v2: a
/// small difference where the curvature changes slowly. A curve read backwards has the same slope.
SlopeByWeights slope_by_weights(const RationalBezier& piece, bool at_start) {
  const auto at = [&](std::size_t j) { return at_start ? j : kQuartic - j; };
  const Vec2 p0 = piece.offset[at(0)];
  const Vec2 first = piece.offset[at(1)] - p0;
  const double scale = std::exp2(-std::ilogb(norm(first)));
  const auto scaled = [&](std::size_t j) {
    Leg l = leg(p0, piece.offset[at(j)]);
    for (DoubleDouble* d : {&l.x, &l.y}) *d = {scale * d->hi, scale * d->lo};
    return l;
  };
  const Leg v1 = scaled(1), v2 = scaled(2), v3 = scaled(3);
  const auto inner = [&](const Leg& v) { return v1.x * v.x + v1.y * v.y; };
  const auto number = [](double x) { return DoubleDouble{x, 0.0}; };
  const DoubleDouble w0 = number(piece.weight[at(0)]), w1 = number(piece.weight[at(1)]),
                     w2 = number(piece.weight[at(2)]), w3 = number(piece.weight[at(3)]);
  const DoubleDouble square = inner(v1), bend = w2 * cross(v1, v2);
  const DoubleDouble t1 = number(2.0) * w0 * w1 * w3 * square * cross(v1, v3);
  const DoubleDouble t2 = number(9.0) * w0 * w2 * bend * inner(v2);
  const DoubleDouble t3 = number(12.0) * w1 * w1 * square * bend;
  const double quad = w1.hi * w1.hi * w1.hi * w1.hi, cube = square.hi * square.hi * square.hi;
  constexpr double kFactor = 3.0 / 16.0;
  const double factor = scale * scale * (kFactor * w0.hi / (quad * cube));
  SlopeByWeights out;
  out.value = factor * (t1 - t2 + t3).hi;
  const double by1 = factor * (t1.hi + 2.0 * t3.hi) - 4.0 * out.value;
  const double by3 = factor * t1.hi;
  out.by = {at_start ? by1 : by3, factor * (t3.hi - 2.0 * t2.hi), at_start ? by3 : by1};
  return out;
}

/// The least change of the logarithms of weights that makes up for two errors.
std::array<double, 3> least_change(const SlopeByWeights& start, const SlopeByWeights& end,
                                   double start_error, double end_error) {
  const auto product = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  const double ss = product(start.by, start.by), se = product(start.by, end.by),
               ee = product(end.by, end.by), determinant = ss * ee - se * se;
  const double along_start = (ee * start_error - se * end_error) / determinant;
  const double along_end = (ss * end_error - se * start_error) / determinant;
  std::array<double, 3> out{};
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k] = along_start * start.by[k] + along_end * end.by[k];
  }
  return out;
}

}  // namespace

double stored_slope(const RationalBezier& piece, bool at_start) {
  return slope_by_weights(piece, at_start).value;
}

void keep_end_slopes(RationalBezier& piece, WantedSlopes wanted) {
  if (piece.degree != kQuartic) return;
  const double unit = std::max(std::abs(wanted.start), std::abs(wanted.end));
  RationalBezier best = piece, now = piece;
  double least = INFINITY;
  for (int step = 0;; ++step) {
    const SlopeByWeights start = slope_by_weights(now, true), end = slope_by_weights(now, false);
    const double start_error = wanted.start - start.value, end_error = wanted.end - end.value;
    const double error = std::max(std::abs(start_error), std::abs(end_error));
    if (!(error < least)) break;
    least = error;
    best = now;
    if (error <= kRightSlope * unit || step == kWeightSteps) break;
    const std::array<double, 3> change = least_change(start, end, start_error, end_error);
    for (std::size_t k = 0; k < change.size(); ++k) {
      double& weight = now.weight[k + 1];
      weight += weight * change[k];
      const double whole = std::abs(weight - piece.weight[k + 1]);
      if (!(whole <= kMostOfWeights * piece.weight[k + 1])) return;
    }
  }
  piece = best;
}

}  // namespace obvid
