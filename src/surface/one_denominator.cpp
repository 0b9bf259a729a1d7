// SPDX-License-Identifier: Apache-2.0
#include "one_denominator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "obvid/curve/internal/basis.h"
#include "obvid/curve/internal/homogeneous.h"
#include "obvid/curve/internal/knots.h"
#include "obvid/surface/internal/collocation.h"
#include "snap.h"

namespace obvid {
namespace {

Vec4 homogeneous_at(const SpaceCurve& curve, double u) {
  const BasisValues basis = basis_at(curve.degree, curve.knots, u, 0);
  Vec4 sum;
  for (std::size_t j = 0; j <= static_cast<std::size_t>(curve.degree); ++j) {
    sum = sum + basis.value[0][j] * lifted(curve.points, curve.weights, basis.first + j);
  }
  return sum;
}

/// Knots of a product: it is as smooth as the less smooth factor.
std::vector<double> product_knots(const SpaceCurve& a, const SpaceCurve& b) {
  const auto p = static_cast<std::size_t>(a.degree), q = static_cast<std::size_t>(b.degree);
  std::vector<double> distinct;
  std::set_union(a.knots.begin(), a.knots.end(), b.knots.begin(), b.knots.end(),
                 std::back_inserter(distinct));
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  std::vector<double> knots;
  for (const double u : distinct) {
    const std::size_t in_a = multiplicity(a.knots, u), in_b = multiplicity(b.knots, u);
    const std::size_t times = std::max(in_a > 0 ? in_a + q : 0, in_b > 0 ? in_b + p : 0);
    knots.insert(knots.end(), times, u);
  }
  return knots;
}

}  // namespace

std::optional<std::array<SpaceCurve, 2>> with_one_denominator(SpaceCurve first, SpaceCurve second) {
  const int degree = first.degree + second.degree;
  if (degree > kMaxNurbsDegree) return std::nullopt;
  snap(second.knots, first.knots);
  const auto system = greville_collocation(degree, product_knots(first, second));
  if (!system) return std::nullopt;
  std::vector<Vec3> a, b;  // numerators times the other one's denominator
  std::vector<double> weights;
  for (const double u : greville(degree, system->knots)) {
    const Vec4 one = homogeneous_at(first, u), two = homogeneous_at(second, u);
    a.push_back(two.w * numerator(one));
    b.push_back(one.w * numerator(two));
    weights.push_back(one.w * two.w);
  }
  a = system->matrix.solve(std::move(a));
  b = system->matrix.solve(std::move(b));
  weights = system->matrix.solve(std::move(weights));
  for (std::size_t i = 0; i < weights.size(); ++i) {
    a[i] = a[i] / weights[i];
    b[i] = b[i] / weights[i];
  }
  return std::array{SpaceCurve{degree, system->knots, std::move(a), weights},
                    SpaceCurve{degree, system->knots, std::move(b), weights}};
}

}  // namespace obvid
