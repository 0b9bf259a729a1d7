// SPDX-License-Identifier: Apache-2.0
// The shapes of hostile series. Formulas of the known curves: their usual parametrisations.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "series.h"

namespace judge {
namespace {

constexpr Real kHalfTurn = std::numbers::pi_v<Real>;

/// Parameters from a to b: even, random, in geometric ratio, or with close pairs.
std::vector<Real> spaced(Dice& dice, Real a, Real b, int n) {
  std::vector<Real> out;
  const int way = dice.whole(0, 9);
  const double ratio = std::pow(dice.logarithmic(1.1, 1e6), 1.0 / n);
  Real sum = 0.0L, step = 1.0L;
  for (int i = 0; i < n; ++i) {
    out.push_back(sum);
    if (way < 4) step = 1.0L;
    if (way >= 4 && way < 7) step = dice.between(0.2, 1.8);
    if (way == 7) step *= ratio;
    if (way == 8) step = dice.chance(0.2) ? dice.logarithmic(1e-8, 1e-2) : 1.0L;
    if (way == 9) step = dice.chance(0.1) ? 1000.0L : 1.0L;
    sum += step;
  }
  for (Real& t : out) t = a + (b - a) * t / out.back();
  if (dice.chance(0.15)) std::reverse(out.begin(), out.end());
  return out;
}

Shape sampled(Dice& dice, const std::string& family, std::function<Vec(Real)> at, Real a, Real b,
              int n, const std::vector<Real>& vertices) {
  Shape out;
  out.family = family;
  Truth truth;
  truth.at = std::move(at);
  truth.parameters = spaced(dice, a, b, n);
  for (const Real t : truth.parameters) out.points.push_back(truth.at(t));
  const auto [low, high] = std::minmax_element(truth.parameters.begin(), truth.parameters.end());
  for (const Real v : vertices) truth.vertices += v > *low && v < *high ? 1 : 0;
  truth.monotone = truth.vertices == 0;
  // turning between neighbours, from the chords of their quarters
  for (std::size_t i = 0; i + 1 < truth.parameters.size(); ++i) {
    const Real t0 = truth.parameters[i], t1 = truth.parameters[i + 1];
    Real turn = 0.0L;
    Vec before = truth.at(t0 + (t1 - t0) / 16) - truth.at(t0);
    for (int k = 2; k <= 16; ++k) {
      const Vec now = truth.at(t0 + (t1 - t0) * k / 16) - truth.at(t0 + (t1 - t0) * (k - 1) / 16);
      turn += std::abs(std::atan2(cross(before, now), dot(before, now)));
      before = now;
    }
    truth.largest_turn = std::max(truth.largest_turn, turn);
  }
  out.truth = std::move(truth);
  return out;
}

std::vector<Real> every(Real first, Real step, Real from, Real to) {
  std::vector<Real> out;
  for (Real v = first + step * std::ceil((from - first) / step); v <= to; v += step) {
    out.push_back(v);
  }
  return out;
}

Shape known_curve(Dice& dice) {
  const int n = dice.whole(2, dice.chance(0.1) ? 150 : 24);
  const Real a = dice.between(0.2, 3.0);
  switch (dice.whole(0, 9)) {
    case 0: {  // logarithmic spiral, up to many turns
      const Real b = dice.logarithmic(0.02, 1.0);
      const auto at = [b](Real t) { return std::exp(b * t) * unit_at(t); };
      return sampled(dice, "logarithmic spiral", at, 0.0L, dice.logarithmic(0.5, 50.0), n, {});
    }
    case 1: {  // involute of a circle
      const auto at = [](Real t) {
        return Vec{std::cos(t) + t * std::sin(t), std::sin(t) - t * std::cos(t)};
      };
      return sampled(dice, "involute", at, 0.1L, 0.1L + dice.logarithmic(0.5, 40.0), n, {});
    }
    case 2: {  // clothoid, also through its inflection
      const Clothoid c{{}, {}, 0.0, dice.between(-20.0, 0.0), dice.between(0.5, 40.0), 1.0};
      const Span span(c, {});
      const auto at = [span](Real t) { return span.point(t); };
      return sampled(dice, "clothoid", at, 0.0L, 1.0L, n, {});
    }
    case 3:
      return sampled(dice, "parabola",
                     [a](Real t) {
                       return Vec{t, a * t * t};
                     },
                     dice.between(-1.0, 0.5), dice.between(0.6, 3.0), n, {0.0L});
    case 4: {
      const Real b = dice.between(0.1, 1.0), to = dice.between(0.5, 6.2);
      const auto at = [b](Real t) { return Vec{std::cos(t), b * std::sin(t)}; };
      return sampled(dice, "ellipse", at, 0.0L, to, n, every(0.0L, 0.5L * kHalfTurn, 0.0L, to));
    }
    case 5: {
      const auto at = [](Real t) { return t * unit_at(t); };
      return sampled(dice, "Archimedean spiral", at, dice.between(0.0, 3.0),
                     3.1L + dice.logarithmic(0.5, 40.0), n, {});
    }
    case 6: {  // curvature of y = a sin x is extreme at the crests alone
      const Real to = dice.between(1.0, 20.0);
      const auto at = [a](Real t) { return Vec{t, a * std::sin(t)}; };
      return sampled(dice, "sine", at, 0.0L, to, n, every(0.5L * kHalfTurn, kHalfTurn, 0.0L, to));
    }
    case 7:
      return sampled(dice, "catenary",
                     [](Real t) {
                       return Vec{t, std::cosh(t)};
                     },
                     dice.between(-2.0, 0.5), dice.between(0.6, 3.0), n, {0.0L});
    case 8: {  // y = x^3 has extreme curvature at x^4 = 1/45
      const Real v = std::pow(1.0L / 45.0L, 0.25L);
      return sampled(dice, "cubic parabola",
                     [](Real t) {
                       return Vec{t, t * t * t};
                     },
                     dice.between(-1.0, -0.1), dice.between(0.1, 1.0), n, {-v, v});
    }
    default: {
      const auto at = [](Real t) { return Vec{t - std::sin(t), 1.0L - std::cos(t)}; };
      return sampled(dice, "cycloid", at, dice.between(0.05, 3.0), dice.between(3.3, 6.2), n,
                     {kHalfTurn});
    }
  }
}

Shape plain(std::string family, std::vector<Vec> points, bool closed = false) {
  Shape out;
  out.family = std::move(family);
  out.points = std::move(points);
  out.closed = closed;
  return out;
}

Shape random_points(Dice& dice) {
  std::vector<Vec> p;
  const int n = dice.whole(2, 5);
  for (int i = 0; i < n; ++i) p.push_back({dice.unit(), dice.unit()});
  return plain("few random points", std::move(p));
}

Shape zigzag(Dice& dice) {
  std::vector<Vec> p;
  const int n = dice.whole(4, 40);
  const double height = dice.logarithmic(1e-6, 1.0);
  for (int i = 0; i < n; ++i)
    p.push_back({static_cast<Real>(i), (i % 2 == 0 ? 1.0 : -1.0) * height});
  return plain("zigzag", std::move(p));
}

Shape collinear(Dice& dice) {
  std::vector<Vec> p;
  const int n = dice.whole(3, 30);
  const double off = dice.chance(0.3) ? 0.0 : dice.logarithmic(1e-15, 1e-4);
  for (int i = 0; i < n; ++i) p.push_back({static_cast<Real>(i), off * dice.normal()});
  return plain("nearly collinear", std::move(p));
}

Shape circular(Dice& dice) {
  std::vector<Vec> p;
  const int n = dice.whole(3, 40);
  const double off = dice.chance(0.4) ? 0.0 : dice.logarithmic(1e-15, 1e-3);
  const bool closed = dice.chance(0.4);
  const Real turn = closed ? 2.0L * kHalfTurn : dice.between(0.2, 7.0);
  for (int i = 0; i < n; ++i) {
    const Real t = turn * i / (closed ? n : n - 1);
    p.push_back((1.0L + off * dice.normal()) * unit_at(t));
  }
  return plain("nearly circular", std::move(p), closed);
}

/// Points along the sides of a polygon.
Shape polygon(Dice& dice) {
  static const std::vector<std::vector<Vec>> kCorners = {
      {{0, 0}, {3, 0}, {3, 1}, {0, 1}},
      {{0, 0}, {1, 0}, {0.5L, 0.8L}},
      {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
      {{0, 0}, {1, 0.3L}, {2, 0}, {1.7L, 1}, {2, 2}, {1, 1.7L}, {0, 2}, {0.3L, 1}}};
  const auto& corners = kCorners[static_cast<std::size_t>(dice.whole(0, 3))];
  const int per_side = dice.whole(1, 6);
  std::vector<Vec> p;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec a = corners[k], b = corners[(k + 1) % corners.size()];
    for (int i = 0; i < per_side; ++i) p.push_back(a + (static_cast<Real>(i) / per_side) * (b - a));
  }
  p.push_back(corners[0]);
  return plain("polygon", std::move(p), true);
}

/// Lines and arcs with common tangents, as slots and rounded ends are.
Shape slot(Dice& dice) {
  std::vector<Vec> p;
  const double length = dice.logarithmic(0.01, 100.0);
  const int on_line = dice.whole(2, 6), on_arc = dice.whole(2, 9);
  for (int i = 0; i < on_line; ++i) p.push_back({length * i / on_line, -1.0});
  for (int i = 0; i < on_arc; ++i) {
    p.push_back(Vec{length, 0.0L} + unit_at(kHalfTurn * (static_cast<Real>(i) / on_arc - 0.5L)));
  }
  for (int i = 0; i < on_line; ++i) p.push_back({length - length * i / on_line, 1.0});
  if (dice.chance(0.5)) return plain("line-arc-line", std::move(p));
  for (int i = 0; i < on_arc; ++i) {
    p.push_back(unit_at(kHalfTurn * (static_cast<Real>(i) / on_arc + 0.5L)));
  }
  p.push_back(p.front());
  return plain("slot", std::move(p), true);
}

Shape blob(Dice& dice) {
  std::array<double, 8> c{};
  for (double& one : c) one = dice.normal() * 0.08;
  const int n = dice.whole(5, 60);
  std::vector<Vec> p;
  for (int i = 0; i < n; ++i) {
    const Real t = 2.0L * kHalfTurn * i / n;
    Real r = 1.0L;
    for (std::size_t k = 0; k < 4; ++k) {
      r += c[2 * k] * std::cos((k + 1) * t) + c[2 * k + 1] * std::sin((k + 1) * t);
    }
    p.push_back(r * unit_at(t));
  }
  if (dice.chance(0.5)) p.push_back(p.front());
  return plain("closed blob", std::move(p), true);
}

Shape limacon(Dice& dice) {
  const double loop = dice.between(0.5, 3.0);
  const int n = dice.whole(8, 40);
  std::vector<Vec> p;
  for (int i = 0; i < n; ++i) {
    const Real t = 2.0L * kHalfTurn * i / n;
    p.push_back((1.0L + loop * std::cos(t)) * unit_at(t));
  }
  return plain("limacon", std::move(p), true);
}

Shape walk(Dice& dice) {
  std::vector<Vec> p{{}};
  Real heading = 0.0L, kappa = 0.0L;
  const int n = dice.whole(4, dice.chance(0.05) ? 600 : 40);
  for (int i = 1; i < n; ++i) {
    kappa += 0.3L * dice.normal() - 0.2L * kappa;
    heading += kappa;
    p.push_back(p.back() + static_cast<Real>(dice.between(0.3, 1.7)) * unit_at(heading));
  }
  return plain("random walk", std::move(p));
}

Shape airfoil(Dice& dice) {
  const int n = dice.whole(10, 60);
  const double thick = dice.between(0.06, 0.25);
  std::vector<Vec> p;
  for (int i = 0; i <= n; ++i) {
    const double u = -1.0 + 2.0 * i / n, x = u * u;
    const double y = 5.0 * thick *
                     (0.2969 * std::sqrt(x) - 0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x -
                      0.1036 * x * x * x * x);
    p.push_back({x, u < 0 ? y : -y});
  }
  return plain("airfoil", std::move(p));
}

}  // namespace

Shape make_shape(Dice& dice) {
  using Maker = Shape (*)(Dice&);
  static constexpr Maker kMakers[] = {known_curve, known_curve, known_curve,   known_curve, zigzag,
                                      collinear,   circular,    polygon,       slot,        blob,
                                      limacon,     walk,        random_points, airfoil};
  return kMakers[dice.whole(0, static_cast<int>(std::size(kMakers)) - 1)](dice);
}

}  // namespace judge
