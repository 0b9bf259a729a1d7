// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "obvid/geom/vec2.h"
#include "plane_curves.h"

namespace obvid::test {

/// Points in extended precision: the truth that samples are rounded from.
struct LongVec2 {
  long double x = 0.0L;
  long double y = 0.0L;
};

/// Curves with monotone curvature in closed form (or, for clothoids, by quadrature).
enum class Oracle { kClothoid, kLogSpiral, kInvolute, kParabola, kEllipse, kInflectedClothoid };
inline constexpr int kOracleCount = 6;

inline const char* name_of(Oracle oracle) {
  constexpr const char* names[] = {"clothoid", "logarithmic spiral", "circle involute",
                                   "parabola", "ellipse quarter",    "clothoid with inflection"};
  return names[static_cast<int>(oracle)];
}

/// One curve, t in [t0, t1].
struct OracleCurve {
  Oracle kind = Oracle::kClothoid;
  long double p = 0.0L, q = 0.0L, t0 = 0.0L, t1 = 1.0L;

  [[nodiscard]] LongVec2 at(long double t) const {
    switch (kind) {
      case Oracle::kClothoid:
      case Oracle::kInflectedClothoid:
        return clothoid(t);
      case Oracle::kLogSpiral: {
        const long double r = std::exp(p * t);
        return {r * std::cos(t), r * std::sin(t)};
      }
      case Oracle::kInvolute:
        return {std::cos(t) + t * std::sin(t), std::sin(t) - t * std::cos(t)};
      case Oracle::kParabola:
        return {t, t * t / 2.0L};
      case Oracle::kEllipse:
        return {p * std::cos(t), std::sin(t)};
    }
    return {};
  }

  /// Heading, unwrapped, up to a constant.
  [[nodiscard]] long double heading_at(long double t) const {
    switch (kind) {
      case Oracle::kClothoid:
      case Oracle::kInflectedClothoid:
        return p * t + q * t * t / 2.0L;
      case Oracle::kLogSpiral:
      case Oracle::kInvolute:
        return t;
      case Oracle::kParabola:
        return std::atan(t);
      case Oracle::kEllipse:
        return std::atan2(std::cos(t), -p * std::sin(t));
    }
    return 0.0L;
  }

 private:
  /// theta = p s + q s^2/2 by composite 8-point Gauss-Legendre, far below double rounding.
  [[nodiscard]] LongVec2 clothoid(long double s) const {
    static const long double x[4] = {
        0.18343464249564980493947614236018398L, 0.52553240991632898581773904918924635L,
        0.79666647741362673959155393647583043L, 0.96028985649753623168356086856947299L};
    static const long double w[4] = {
        0.36268378337836198296515044927719561L, 0.31370664587788728733796220198660132L,
        0.22238103445337447054435599442624088L, 0.10122853629037625915253135430996219L};
    const int n = static_cast<int>(2.0L * (std::abs(p * s) + std::abs(q) * s * s)) + 1;
    const long double h = s / n;
    LongVec2 z;
    for (int j = 0; j < n; ++j) {
      const long double m = (j + 0.5L) * h;
      for (int g = 0; g < 4; ++g) {
        for (const long double u : {m - x[g] * h / 2.0L, m + x[g] * h / 2.0L}) {
          const long double theta = p * u + q * u * u / 2.0L;
          z.x += w[g] * h / 2.0L * std::cos(theta);
          z.y += w[g] * h / 2.0L * std::sin(theta);
        }
      }
    }
    return z;
  }
};

/// Rigid motion, mirror and scale.
struct OraclePlacement {
  long double scale = 1.0L, rotation = 0.0L, mirror = 1.0L, dx = 0.0L, dy = 0.0L;

  [[nodiscard]] LongVec2 apply(LongVec2 v) const {
    const long double c = std::cos(rotation), s = std::sin(rotation);
    const long double y = mirror * v.y;
    return {scale * (c * v.x - s * y) + dx, scale * (s * v.x + c * y) + dy};
  }
};

/// A sampled curve: the truth, and the doubles that a user would have.
struct Sampled {
  OracleCurve curve;
  OraclePlacement placement;
  std::vector<long double> parameters;
  std::vector<Vec2> points;
  double size = 0.0;
  double offset_sizes = 0.0;  ///< offset of the origin in sizes
  bool uneven = false;

  [[nodiscard]] LongVec2 truth(long double t) const { return placement.apply(curve.at(t)); }
};

inline OracleCurve random_curve(Oracle kind, std::mt19937_64& rng) {
  OracleCurve c;
  c.kind = kind;
  switch (kind) {
    case Oracle::kClothoid:
      c.p = uniform(rng, 0.0, 1.5);
      c.q = uniform(rng, 0.05, 2.0);
      c.t1 = uniform(rng, 1.0, 3.0);
      break;
    case Oracle::kLogSpiral:
      c.p = uniform(rng, 0.05, 0.6);
      c.t1 = uniform(rng, 1.0, 8.0);
      break;
    case Oracle::kInvolute:
      c.t0 = uniform(rng, 0.1, 1.0);
      c.t1 = c.t0 + uniform(rng, 1.0, 8.0);
      break;
    case Oracle::kParabola:
      c.t0 = uniform(rng, 0.0, 0.5);
      c.t1 = c.t0 + uniform(rng, 0.5, 4.0);
      break;
    case Oracle::kEllipse:
      c.p = uniform(rng, 1.2, 4.0);
      c.t0 = 0.02L;
      c.t1 = uniform(rng, 1.0, 1.55);
      break;
    case Oracle::kInflectedClothoid:
      c.p = uniform(rng, -1.5, -0.3);
      c.q = uniform(rng, 0.5, 2.0);
      c.t1 = uniform(rng, 1.5, 4.0);
      break;
  }
  return c;
}

/// n parameters, steps either similar or spread over 1:1000.
inline std::vector<long double> random_parameters(const OracleCurve& c, int n, bool uneven,
                                                  std::mt19937_64& rng) {
  std::vector<long double> t(static_cast<std::size_t>(n));
  long double sum = 0.0L;
  for (auto& value : t) {
    value = sum;
    sum += uneven ? std::exp(uniform(rng, 0.0, std::log(1000.0))) : uniform(rng, 0.3, 1.0);
  }
  const long double last = t.back();
  for (auto& value : t) value = c.t0 + (c.t1 - c.t0) * value / last;
  return t;
}

inline double largest_turning(const std::vector<Vec2>& points) {
  double largest = 0.0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    largest =
        std::max(largest, std::abs(turning(points[i] - points[i - 1], points[i + 1] - points[i])));
  }
  return largest;
}

/// Whether some step hides half a turn or more: the chords' turning would then be a full turn off.
inline bool hides_half_a_turn(const Sampled& s) {
  for (std::size_t i = 1; i < s.parameters.size(); ++i) {
    const long double turn =
        s.curve.heading_at(s.parameters[i]) - s.curve.heading_at(s.parameters[i - 1]);
    if (std::abs(turn) >= 3.14159265358979L) return true;
  }
  return false;
}

/// A random series whose neighbouring chords turn by at most `turning_limit`.
inline Sampled random_series(Oracle kind, std::mt19937_64& rng, double turning_limit) {
  for (;;) {
    Sampled s;
    s.curve = random_curve(kind, rng);
    const int n =
        static_cast<int>(std::lround(std::exp(uniform(rng, std::log(5.0), std::log(200.0)))));
    s.uneven = (rng() & 1U) != 0;
    s.parameters = random_parameters(s.curve, n, s.uneven, rng);
    s.placement.scale = std::pow(10.0, uniform(rng, -6.0, 6.0));
    s.placement.rotation = uniform(rng, 0.0, 6.28);
    s.placement.mirror = (rng() & 1U) != 0 ? 1.0L : -1.0L;
    const LongVec2 a = s.curve.at(s.curve.t0), b = s.curve.at(s.curve.t1);
    s.size = static_cast<double>(s.placement.scale * std::hypot(b.x - a.x, b.y - a.y));
    if ((rng() & 1U) != 0) {
      s.offset_sizes = std::pow(10.0, uniform(rng, 0.0, 3.0));
      s.placement.dx = s.size * s.offset_sizes * std::cos(uniform(rng, 0.0, 6.28));
      s.placement.dy = s.size * s.offset_sizes * std::sin(uniform(rng, 0.0, 6.28));
    }
    for (const long double t : s.parameters) {
      const LongVec2 p = s.truth(t);
      s.points.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
    }
    if ((rng() & 1U) != 0) {  // the other way round
      std::reverse(s.points.begin(), s.points.end());
      std::reverse(s.parameters.begin(), s.parameters.end());
    }
    if (!hides_half_a_turn(s) && largest_turning(s.points) <= turning_limit) return s;
  }
}

}  // namespace obvid::test
