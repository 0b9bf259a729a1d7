// SPDX-License-Identifier: Apache-2.0
// Curves in long double: quick evaluation, nearest points. What they find is decided elsewhere.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <variant>
#include <vector>

#include "ball.h"
#include "pieces.h"

namespace judge {

/// One degree in radians.
constexpr Real kDegree = std::numbers::pi_v<Real> / 180.0L;

struct Vec {
  Real x = 0.0L, y = 0.0L;
};
inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y}; }
inline Vec operator*(Real k, Vec a) { return {k * a.x, k * a.y}; }
inline Real dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y; }
inline Real cross(Vec a, Vec b) { return a.x * b.y - a.y * b.x; }
/// Long doubles hold squares of all lengths that occur: no need of std::hypot.
inline Real norm(Vec a) { return std::sqrt(a.x * a.x + a.y * a.y); }
inline Vec unit_at(Real theta) { return {std::cos(theta), std::sin(theta)}; }
inline Vec left_of(Vec a) { return {-a.y, a.x}; }
/// A point seen from an origin.
inline Vec seen(Point p, Point origin) {
  return {static_cast<Real>(p.x) - origin.x, static_cast<Real>(p.y) - origin.y};
}

/// Point with its first two derivatives by the parameter.
struct Jet {
  Vec p, d, dd;

  [[nodiscard]] Real kappa() const {
    const Real speed = norm(d);
    return cross(d, dd) / (speed * speed * speed);
  }
};

/// Line, arc or clothoid.
struct SpiralForm {
  Vec start;
  Real theta0 = 0.0L, kappa0 = 0.0L, kappa1 = 0.0L, length = 0.0L;
  std::vector<Vec> panel;    ///< chord vector up to each panel
  std::vector<Vec> ahead{};  ///< tangent at the start of each
};
/// Coefficients of a polynomial at t^j (1-t)^(m-j), and of a weight.
struct Homogeneous {
  Vec p;
  Real w = 0.0L;
};
struct RationalForm {
  Vec base;  ///< from where its points are seen: they keep the digits of a short span far away
  std::vector<Homogeneous> point;  ///< numerator and weight
  std::vector<Homogeneous> first;  ///< of their first derivatives, one degree lower
  std::vector<Homogeneous> second;
};

/// One piece over t in [0, 1], seen from an origin.
class Span {
 public:
  Span(const Piece& piece, Point origin);
  /// A rational Bezier span, control points as seen from `base`.
  Span(std::vector<Vec> points, std::vector<Real> weights, Vec base = {});
  /// A circle arc (or a line for kappa = 0).
  Span(Vec start, Real theta0, Real kappa, Real length);

  [[nodiscard]] Jet at(Real t) const;
  [[nodiscard]] Vec point(Real t) const;
  /// Third derivative by the parameter.
  [[nodiscard]] Vec third(Real t) const;
  /// Angle that the tangent turns between two parameters, unwrapped and signed.
  [[nodiscard]] Real turning(Real from = 0.0L, Real to = 1.0L) const;
  /// The same over the whole span, to both sides together.
  [[nodiscard]] Real turning_both_ways(Real from = 0.0L, Real to = 1.0L) const;

 private:
  /// Turning between two parameters with the tangents there, in halves until each turns little.
  [[nodiscard]] Real turning_between(Real from, Vec start, Real to, Vec end, int halvings) const;

  std::variant<SpiralForm, RationalForm> form_;
};

/// Place on a path: span and parameter.
struct Place {
  std::size_t span = 0;
  Real t = 0.0L;
  Real distance = 0.0L;

  [[nodiscard]] Real order() const { return static_cast<Real>(span) + t; }
};

/// Spans one after the other, for nearest points.
class Path {
 public:
  explicit Path(std::vector<Span> spans, int places_per_span = 8);
  [[nodiscard]] const std::vector<Span>& spans() const { return spans_; }
  /// Nearest place between two orders (span + t).
  [[nodiscard]] Place nearest(Vec p, Real from, Real to) const;
  [[nodiscard]] Place nearest(Vec p) const {
    return nearest(p, 0.0L, static_cast<Real>(spans_.size()));
  }
  [[nodiscard]] Vec at(Real order) const;
  [[nodiscard]] Real end() const { return static_cast<Real>(spans_.size()); }

 private:
  /// Stretches that lie in one disc.
  struct Block {
    Vec middle;
    Real radius;
  };
  static constexpr std::size_t kBlock = 32;

  [[nodiscard]] Place refined(Vec p, Real from, Real to) const;

  std::vector<Span> spans_;
  int per_span_;
  std::vector<Vec> places_;
  // behind each place: length of the way to the next at the faster end's rate, and how far from
  // the nearer of both the curve comes between them
  std::vector<Real> legs_, reach_;
  std::vector<Block> blocks_;
};

/// Where f is largest on [low, high], on which it has one top: golden sections.
template <class F>
Real climbed(const F& f, Real low, Real high) {
  constexpr Real kGolden = 0.6180339887498948482L;
  Real a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  Real fa = f(a), fb = f(b);
  constexpr int kSections = 44;  // 0.618^44 = 6e-10 of a step: the value is flat there
  for (int i = 0; i < kSections; ++i) {
    if (fa < fb) {
      low = a;
      a = b;
      fa = fb;
      b = low + kGolden * (high - low);
      fb = f(b);
    } else {
      high = b;
      b = a;
      fb = fa;
      a = high - kGolden * (high - low);
      fa = f(a);
    }
  }
  return 0.5L * (low + high);
}

/// Where f is largest: climbed to from the highest samples that have none higher beside them.
template <class F>
Real largest_place(const F& f, Real from, Real to, int steps) {
  constexpr std::size_t kMostTops = 3;
  std::vector<Real> seen;
  for (int i = 0; i <= steps; ++i) seen.push_back(f(from + (to - from) * i / steps));
  std::vector<std::size_t> tops;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const bool rising = i == 0 || seen[i] > seen[i - 1];
    if (rising && (i + 1 == seen.size() || !(seen[i + 1] > seen[i]))) tops.push_back(i);
  }
  std::stable_sort(tops.begin(), tops.end(),
                   [&](std::size_t a, std::size_t b) { return seen[a] > seen[b]; });
  if (tops.size() > kMostTops) tops.resize(kMostTops);
  Real best = from, most = f(from);
  const auto take = [&](Real place) {
    const Real value = f(place);
    if (!(value > most)) return;
    most = value;
    best = place;
  };
  for (const std::size_t top : tops) {
    const auto at = [&](std::size_t i) {
      return from + (to - from) * static_cast<Real>(i) / steps;
    };
    take(at(top));
    take(
        climbed(f, at(top > 0 ? top - 1 : 0), at(std::min<std::size_t>(top + 1, seen.size() - 1))));
  }
  return best;
}

}  // namespace judge
