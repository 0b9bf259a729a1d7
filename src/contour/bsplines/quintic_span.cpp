// SPDX-License-Identifier: Apache-2.0
#include "quintic_span.h"

#include <algorithm>
#include <cmath>

#include "obvid/numeric/internal/bernstein.h"

namespace obvid::bsplines {
namespace {

/// Coefficients of d kappa this small against the largest one are taken for zero: rounding of the
/// control points, seen through three differences, stays below.
constexpr double kRoundingOfSlope = 1e-10;
/// Halvings of the parameter that may be needed until all coefficients have one sign.
constexpr int kMostHalvings = 5;
constexpr std::size_t kCount = 15;  // coefficients of d kappa: degree 14

using Form = std::array<double, kCount>;

/// One coordinate of the first three derivatives in scaled Bernstein form, common factors left out.
struct Derivatives {
  std::array<double, 5> first{};   // over 5
  std::array<double, 4> second{};  // over 20
  std::array<double, 3> third{};   // over 60
};

Derivatives derivatives(const std::array<double, 6>& p) {
  Derivatives d;
  for (std::size_t j = 0; j < 5; ++j) d.first[j] = p[j + 1] - p[j];
  for (std::size_t j = 0; j < 4; ++j) d.second[j] = d.first[j + 1] - d.first[j];
  for (std::size_t j = 0; j < 3; ++j) d.third[j] = d.second[j + 1] - d.second[j];
  const auto scale = [](auto& c) {
    const int n = static_cast<int>(c.size()) - 1;
    for (int j = 0; j <= n; ++j) c[static_cast<std::size_t>(j)] *= binomial(n, j);
  };
  scale(d.first);
  scale(d.second);
  scale(d.third);
  return d;
}

/// (r'.r')(r' x r''') - 3 (r'.r'')(r' x r''), which has the sign of d kappa.
Form slope_of_curvature(const Quintic& q) {
  // in units of the first leg, so that nothing over- or underflows
  const double unit = 1.0 / norm(q[1] - q[0]);
  std::array<double, 6> px{}, py{};
  for (std::size_t j = 0; j < 6; ++j) {
    px[j] = unit * (q[j].x - q[0].x);
    py[j] = unit * (q[j].y - q[0].y);
  }
  const Derivatives x = derivatives(px), y = derivatives(py);
  std::array<double, 9> square{};       // r'.r' over 25
  std::array<double, 8> along{};        // r'.r'' over 100
  std::array<double, 8> across{};       // r' x r'' over 100
  std::array<double, 7> third_cross{};  // r' x r''' over 300
  add_product(square, x.first, x.first);
  add_product(square, y.first, y.first);
  add_product(along, x.first, x.second);
  add_product(along, y.first, y.second);
  add_product(across, x.first, y.second);
  subtract_product(across, y.first, x.second);
  add_product(third_cross, x.first, y.third);
  subtract_product(third_cross, y.first, x.third);
  // 25 * 300 = 7500 against 3 * 100 * 100 = 30000
  Form out{}, second{};
  add_product(out, square, third_cross);
  add_product(second, along, across);
  for (std::size_t j = 0; j < kCount; ++j) {
    out[j] = (out[j] - 4.0 * second[j]) / binomial(kCount - 1, static_cast<int>(j));
  }
  return out;
}

double largest(const Form& c) {
  double most = 0.0;
  for (const double v : c) most = std::max(most, std::abs(v));
  return most;
}

bool all_above(const Form& c, int sign, double least) {
  return std::all_of(c.begin(), c.end(), [=](double v) { return sign * v > least; });
}

/// Whether sign * c is positive on [0, 1], by halving.
bool positive(Form c, int sign, double least, int halvings) {
  if (all_above(c, sign, least)) return true;
  if (halvings == 0 || !(sign * c.front() > least) || !(sign * c.back() > least)) return false;
  Form left{};
  for (std::size_t j = 0; j < kCount; ++j) {
    left[j] = c.front();
    for (std::size_t i = 0; i + j + 1 < kCount; ++i) c[i] = 0.5 * (c[i] + c[i + 1]);
  }
  // what de Casteljau leaves in place are the right half's coefficients
  return positive(left, sign, least, halvings - 1) && positive(c, sign, least, halvings - 1);
}

}  // namespace

Quintic hermite_quintic(const Element& a, const Element& b, double length) {
  const double leg = length / 5.0, bend = length * length / 20.0;
  const Vec2 u = unit_at(a.theta), v = unit_at(b.theta);
  return {a.point,
          a.point + leg * u,
          a.point + 2.0 * leg * u + (bend * a.kappa) * left_normal(u),
          b.point - 2.0 * leg * v + (bend * b.kappa) * left_normal(v),
          b.point - leg * v,
          b.point};
}

Vec2 point_at(const Quintic& q, double t) {
  Quintic p = q;
  for (std::size_t level = 5; level > 0; --level) {
    for (std::size_t j = 0; j < level; ++j) p[j] = p[j] + t * (p[j + 1] - p[j]);
  }
  return p[0];
}

int curvature_direction(const Quintic& q) {
  const Form c = slope_of_curvature(q);
  const double least = kRoundingOfSlope * largest(c);
  if (positive(c, 1, least, kMostHalvings)) return 1;
  return positive(c, -1, least, kMostHalvings) ? -1 : 0;
}

}  // namespace obvid::bsplines
