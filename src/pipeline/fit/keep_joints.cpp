// SPDX-License-Identifier: Apache-2.0
#include "fit/keep_joints.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "obvid/curve/internal/end_curvatures.h"
#include "obvid/geom/internal/angle.h"

namespace obvid::pipeline_detail {
namespace {

struct HeadingAndCurvature {
  double theta = 0.0, kappa = 0.0;
};

struct EndOf {
  bool at_start;
  HeadingAndCurvature operator()(const LinePiece& p) const {
    return {heading(p.end - p.start), 0.0};
  }
  HeadingAndCurvature operator()(const ArcPiece& p) const {
    return {p.theta0 + (at_start ? 0.0 : p.kappa * p.length), p.kappa};
  }
  HeadingAndCurvature operator()(const ClothoidPiece& p) const {
    if (at_start) return {p.theta0, p.kappa0};
    return {p.theta0 + 0.5 * (p.kappa0 + p.kappa1) * p.length, p.kappa1};
  }
  HeadingAndCurvature operator()(const RationalBezier& p) const {
    const auto n = static_cast<std::size_t>(p.degree);
    const Vec2 leg = at_start ? p.offset[1] - p.offset[0] : p.offset[n] - p.offset[n - 1];
    return {heading(leg), p.degree > 1 ? stored_curvature(p, at_start) : 0.0};
  }
};

/// `value`, or the nearest that is between both ends; beside them what rounding leaves.
double between(double value, double a, double b, double unit) {
  constexpr double kRounding = 1e-12;  // of the unit
  const double low = std::min(a, b), high = std::max(a, b);
  if (value >= low - kRounding * unit && value <= high + kRounding * unit) return value;
  return std::clamp(value, low, high);
}

void take(Element& element, const HeadingAndCurvature& left, const HeadingAndCurvature& right) {
  if (!std::isfinite(left.kappa + right.kappa + left.theta + right.theta)) return;
  const double to_left = turn_between(element.theta, left.theta);
  const double to_right = turn_between(element.theta, right.theta);
  element.theta += between(0.0, to_left, to_right, 1.0);
  element.kappa = between(element.kappa, left.kappa, right.kappa,
                          std::max(std::abs(left.kappa), std::abs(right.kappa)));
}

}  // namespace

void take_piece_ends(Contour& contour) {
  const std::size_t n = contour.pieces.size();
  const auto end = [&](std::size_t piece) {
    return std::visit(EndOf{false}, contour.pieces[piece]);
  };
  const auto start = [&](std::size_t piece) {
    return std::visit(EndOf{true}, contour.pieces[piece]);
  };
  for (std::size_t j = 0; n > 0 && j < contour.joints.size(); ++j) {
    Joint& joint = contour.joints[j];
    const bool comes = j > 0 || contour.closed, goes = j < n;
    const HeadingAndCurvature left = comes ? end((j + n - 1) % n) : start(0);
    const HeadingAndCurvature right = goes ? start(j) : left;
    take(joint.element, left, joint.leaving ? left : right);
    if (joint.leaving) take(*joint.leaving, right, right);
  }
}

}  // namespace obvid::pipeline_detail
