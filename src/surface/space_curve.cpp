// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/space_curve.h"

#include <fmt/format.h>

#include <cmath>

#include "control_points.h"
#include "homogeneous.h"
#include "knots.h"
#include "obvid/surface/internal/basis.h"

namespace obvid {

Result<void> check(const SpaceCurve& curve) {
  if (auto knots = check_knots(curve.degree, curve.knots, "the knots"); !knots) return knots;
  return check_points(curve.points, curve.weights,
                      curve.knots.size() - static_cast<std::size_t>(curve.degree) - 1);
}

Range domain(const SpaceCurve& curve) { return {curve.knots.front(), curve.knots.back()}; }

SpaceJet evaluate(const SpaceCurve& curve, double u) {
  const BasisValues basis = basis_at(curve.degree, curve.knots, u, 3);
  std::array<Vec4, 4> h{};
  for (std::size_t j = 0; j <= static_cast<std::size_t>(curve.degree); ++j) {
    const Vec4 p = lifted(curve.points, curve.weights, basis.first + j);
    for (std::size_t r = 0; r < 4; ++r) h[r] = h[r] + basis.value[r][j] * p;
  }
  if (curve.weights.empty()) {
    return {numerator(h[0]), numerator(h[1]), numerator(h[2]), numerator(h[3])};
  }
  SpaceJet jet;
  const double w = h[0].w;
  jet.point = numerator(h[0]) / w;
  jet.d1 = (numerator(h[1]) - h[1].w * jet.point) / w;
  jet.d2 = (numerator(h[2]) - 2.0 * h[1].w * jet.d1 - h[2].w * jet.point) / w;
  jet.d3 =
      (numerator(h[3]) - 3.0 * h[1].w * jet.d2 - 3.0 * h[2].w * jet.d1 - h[3].w * jet.point) / w;
  return jet;
}

double curvature(const SpaceJet& jet) {
  const double speed = norm(jet.d1);
  return speed > 0.0 ? norm(cross(jet.d1, jet.d2)) / (speed * speed * speed) : 0.0;
}

Result<void> check_points(const std::vector<Vec3>& points, const std::vector<double>& weights,
                          std::size_t wanted) {
  if (points.size() != wanted || (!weights.empty() && weights.size() != wanted)) {
    return fail({ErrorCode::kBadOption,
                 fmt::format("{} control points and {} weights where the knots need {}",
                             points.size(), weights.size(), wanted),
                 "", "", -1, static_cast<double>(wanted)});
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto index = static_cast<std::ptrdiff_t>(i);
    if (!is_finite(points[i]) || (!weights.empty() && !std::isfinite(weights[i]))) {
      return fail({ErrorCode::kNotFinite, fmt::format("control point {} is not finite", i), "", "",
                   index, 0.0});
    }
    if (!weights.empty() && !(weights[i] > 0.0)) {
      return fail({ErrorCode::kBadOption,
                   fmt::format("weight {} is {:g}, weights are greater than 0", i, weights[i]), "",
                   "", index, weights[i]});
    }
  }
  return {};
}

}  // namespace obvid
