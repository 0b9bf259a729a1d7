// SPDX-License-Identifier: Apache-2.0
#include "fit/keep_joints.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "obvid/chain/internal/spiral_shape.h"
#include "obvid/curve/internal/end_curvatures.h"
#include "obvid/curve/internal/end_slopes.h"

namespace obvid::pipeline_detail {
namespace {

/// The curve is its control points alone: weights that are all 1 stay 1.
bool polynomial(const RationalBezier& piece) {
  const auto end = piece.weight.begin() + piece.degree + 1;
  return std::all_of(piece.weight.begin(), end, [](double w) { return w == 1.0; });
}

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
  constexpr double kRounding = 1e-12;
  const double low = std::min(a, b), high = std::max(a, b);
  if (value >= low - kRounding * unit && value <= high + kRounding * unit) return value;
  return std::clamp(value, low, high);
}

void take(Element& element, const HeadingAndCurvature& left, const HeadingAndCurvature& right) {
  if (!std::isfinite(left.kappa + right.kappa + left.theta + right.theta)) return;
  const double turn = 2.0 * std::numbers::pi;
  const double to_left = std::remainder(left.theta - element.theta, turn);
  const double to_right = std::remainder(right.theta - element.theta, turn);
  element.theta += between(0.0, to_left, to_right, 1.0);
  element.kappa = between(element.kappa, left.kappa, right.kappa,
                          std::max(std::abs(left.kappa), std::abs(right.kappa)));
}

}  // namespace

void keep_joint_curvatures(Contour& contour) {
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    auto* piece = std::get_if<RationalBezier>(&contour.pieces[i]);
    if (piece == nullptr) continue;
    const bool free_end = i + 1 < contour.pieces.size() && !contour.joints[i + 1].source;
    Element& end = contour.joints[i + 1].element;
    if (free_end) end.kappa = stored_curvature(*piece, false);
    keep_end_curvatures(*piece, {contour.joints[i].element.kappa, end.kappa},
                        polynomial(*piece) ? InnerWeights::kFixed : InnerWeights::kFree);
  }
}

namespace {

/// At rest: this part of a clothoid's slope, but no less than the last bits of a weight make, and
/// no more than the form has (docs/methods/g3.md).
double resting_slope(const LinkState& link, int direction, double stored) {
  constexpr double kRestingPart = 1e-7;
  constexpr double kBitsOfWeights = 384.0 * 0x1p-53;
  const double clothoid = 6.0 * std::abs(link.sigma) / (link.h * link.h);
  const double turn = std::max(std::abs(link.alpha), std::abs(link.beta));
  const double bits = kBitsOfWeights * turn / (link.h * link.h);
  const double least = std::max(kRestingPart * clothoid, bits);
  const double now = direction * stored;
  return direction * (now > 0.0 ? std::min(now, least) : least);
}

WantedSlopes slopes_of_link(const LinkState& link, int direction, SpiralForm form,
                            const RationalBezier& piece) {
  const SpiralSlopes slopes = spiral_slopes(link, direction, form);
  const auto in_units = [&](const LinkGradient& one, bool at_start) {
    if (std::isinf(one.value)) return resting_slope(link, direction, stored_slope(piece, at_start));
    return direction * 4.0 * std::exp(one.value) / (link.h * link.h);
  };
  return {in_units(slopes.start, true), in_units(slopes.end, false)};
}

}  // namespace

void keep_joint_slopes(const SeriesChain& chain, Contour& contour) {
  if (!chain.smooth) return;
  std::size_t piece = 0;
  for (std::size_t i = 0; i < chain.links.size() && piece < contour.pieces.size(); ++i) {
    const std::size_t first = piece++;
    while (piece < contour.pieces.size() &&
           !(contour.joints[piece].element.point == chain.elements[i + 1].point)) {
      ++piece;
    }
    auto* spiral = std::get_if<RationalBezier>(&contour.pieces[first]);
    if (spiral == nullptr || piece > first + 1 || chain.form[i] == SpiralForm::kOneSided) continue;
    const WantedSlopes wanted =
        slopes_of_link(chain.links[i], chain.direction[i], chain.form[i], *spiral);
    if (std::isfinite(wanted.start) && std::isfinite(wanted.end)) keep_end_slopes(*spiral, wanted);
  }
}

void chain_conic_weights(Contour& contour) {
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    auto* conic = std::get_if<RationalBezier>(&contour.pieces[i]);
    if (conic == nullptr || conic->degree != 2) continue;
    Element& start = contour.joints[i].element;
    const double stored = stored_curvature(*conic, true);
    const double ratio = i > 0 ? stored / start.kappa : 1.0;
    if (ratio > 0.0 && std::isfinite(ratio)) conic->weight[1] *= std::sqrt(ratio);
    if (i == 0) start.kappa = stored;
    contour.joints[i + 1].element.kappa = stored_curvature(*conic, false);
  }
}

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
