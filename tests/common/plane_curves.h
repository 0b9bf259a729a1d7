// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "obvid/geom/vec2.h"

namespace obvid::test {

inline constexpr double kTurn = 2.0 * std::numbers::pi;

inline double uniform(std::mt19937_64& rng, double low, double high) {
  return low + (high - low) * (static_cast<double>(rng() >> 11) * 0x1p-53);
}

/// Points at arc lengths `at` of the curve with the given heading, integrated from arc length 0 by
/// Gauss's rule with two points on steps of at most `step`: errors of order step^4.
inline std::vector<Vec2> trace(const std::function<double(double)>& heading,
                               const std::vector<double>& at, double step) {
  std::vector<Vec2> out;
  Vec2 p;
  double s = 0.0;
  for (const double goal : at) {
    const int n = std::max(1, static_cast<int>(std::ceil((goal - s) / step)));
    const double h = (goal - s) / n;
    for (int k = 0; k < n; ++k) {
      const double middle = s + (k + 0.5) * h, beside = 0.5 * h / std::sqrt(3.0);
      p = p + 0.5 * h * (unit_at(heading(middle - beside)) + unit_at(heading(middle + beside)));
    }
    s = goal;
    out.push_back(p);
  }
  return out;
}

inline std::vector<double> even_steps(std::size_t n, double length) {
  std::vector<double> at(n);
  for (std::size_t i = 0; i < n; ++i) {
    at[i] = length * static_cast<double>(i) / static_cast<double>(n - 1);
  }
  return at;
}

/// Moves each point anywhere within its disc, evenly.
inline void add_noise(std::vector<Vec2>& points, double radius, std::mt19937_64& rng) {
  for (Vec2& p : points) {
    const double r = radius * std::sqrt(uniform(rng, 0.0, 1.0));
    p = p + r * unit_at(uniform(rng, 0.0, kTurn));
  }
}

/// n points of the sine-generated curve theta = turn sin(2 pi s), 0 <= s <= waves: a vertex at
/// every half wave (s = 0, 1/2, 1 ...), so 2 waves - 1 of them inside for whole waves.
inline std::vector<Vec2> meander(std::size_t n, double waves, double turn) {
  return trace([&](double s) { return turn * std::sin(kTurn * s); }, even_steps(n, waves), 1e-3);
}

/// n points around an ellipse, even in the parameter.
inline std::vector<Vec2> ellipse(std::size_t n, double a, double b, double start = 0.1) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = start + kTurn * static_cast<double>(i) / static_cast<double>(n);
    out.push_back({a * std::cos(t), b * std::sin(t)});
  }
  return out;
}

/// A spiral from its heading, theta = k0 s + k1 s^2 / 2.
inline std::vector<Vec2> clothoid(std::size_t n, double length, double k0, double k1) {
  return trace([&](double s) { return s * (k0 + 0.5 * k1 * s); }, even_steps(n, length),
               length * 1e-3);
}

}  // namespace obvid::test
