// SPDX-License-Identifier: Apache-2.0
// Curves whose number of vertices is known, sampled in many ways.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "../common/plane_curves.h"

namespace obvid::test {

/// A point of a curve with its first three derivatives by any parameter.
struct KnownJet {
  Vec2 p, d1, d2, d3;

  [[nodiscard]] double curvature() const { return cross(d1, d2) / std::pow(norm(d1), 3.0); }
  /// Sign of the curvature's rate: of (r' x r''')(r' . r') - 3 (r' x r'')(r' . r'').
  [[nodiscard]] double rate() const {
    return cross(d1, d3) * dot(d1, d1) - 3.0 * cross(d1, d2) * dot(d1, d2);
  }
};

struct KnownCurve {
  std::string name;
  std::function<KnownJet(double)> at;
  double from = 0.0, to = 1.0;
  bool closed = false;

  /// Changes of sign of the rate on a fine grid.
  [[nodiscard]] int vertices() const {
    constexpr int kGrid = 20000;
    int n = 0;
    double first = 0.0, last = 0.0;
    for (int i = 0; i < kGrid; ++i) {
      const double rate = at(from + (to - from) * (i + 0.5) / kGrid).rate();
      if (last * rate < 0.0) ++n;
      if (first == 0.0) first = rate;
      if (rate != 0.0) last = rate;
    }
    return closed && first * last < 0.0 ? n + 1 : n;
  }
};

/// r(t) e^{it} from r and its derivatives.
inline KnownJet polar(double t, double r, double r1, double r2, double r3) {
  const Vec2 e = unit_at(t);
  const auto turned = [&](double along, double across) {
    return complex_product({along, across}, e);
  };
  return {turned(r, 0.0), turned(r1, r), turned(r2 - r, 2.0 * r1),
          turned(r3 - 3.0 * r1, 3.0 * r2 - r)};
}

inline KnownJet graph(double x, double y, double y1, double y2, double y3) {
  return {{x, y}, {1.0, y1}, {0.0, y2}, {0.0, y3}};
}

inline KnownCurve random_ellipse(std::mt19937_64& rng) {
  const double b = uniform(rng, 0.1, 0.95), start = uniform(rng, 0.0, kTurn);
  const auto at = [b](double t) {
    const double c = std::cos(t), s = std::sin(t);
    return KnownJet{{c, b * s}, {-s, b * c}, {-c, -b * s}, {s, -b * c}};
  };
  return {"ellipse", at, start, start + kTurn, true};
}

inline KnownCurve random_fourier(std::mt19937_64& rng) {
  std::vector<std::array<double, 3>> terms;  // size, wave number, phase
  const std::size_t count = 2 + rng() % 4;
  for (std::size_t k = 2; k < count + 2; ++k) {
    const double order = static_cast<double>(k);
    terms.push_back({uniform(rng, -0.3, 0.3) / (order * order), order, uniform(rng, 0.0, kTurn)});
  }
  const auto at = [terms](double t) {
    std::array<double, 4> r = {1.0, 0.0, 0.0, 0.0};
    for (const auto& [size, k, phase] : terms) {
      const double c = size * std::cos(k * t + phase), s = size * std::sin(k * t + phase);
      r[0] += c;
      r[1] -= k * s;
      r[2] -= k * k * c;
      r[3] += k * k * k * s;
    }
    return polar(t, r[0], r[1], r[2], r[3]);
  };
  return {"Fourier", at, 0.0, kTurn, true};
}

inline KnownCurve random_limacon(std::mt19937_64& rng) {
  const double q = uniform(rng, 0.1, 0.9), start = uniform(rng, 0.0, kTurn);
  const auto at = [q](double t) {
    const double c = q * std::cos(t), s = q * std::sin(t);
    return polar(t, 1.0 + c, -s, -c, s);
  };
  return {"limacon", at, start, start + kTurn, true};
}

inline KnownCurve random_polynomial(std::mt19937_64& rng) {
  std::array<double, 6> a{};
  for (double& c : a) c = uniform(rng, -1.0, 1.0);
  const auto at = [a](double x) {
    std::array<double, 4> y{};  // Horner with derivatives
    for (std::size_t k = a.size(); k-- > 0;) {
      y[3] = y[3] * x + 3.0 * y[2];
      y[2] = y[2] * x + 2.0 * y[1];
      y[1] = y[1] * x + y[0];
      y[0] = y[0] * x + a[k];
    }
    return graph(x, y[0], y[1], y[2], y[3]);
  };
  return {"polynomial", at, -1.0, 1.0, false};
}

inline KnownCurve random_sine(std::mt19937_64& rng) {
  const double size = uniform(rng, 0.05, 1.5), wave = uniform(rng, 2.0, 20.0);
  const auto at = [=](double x) {
    const double c = size * std::cos(wave * x), s = size * std::sin(wave * x);
    return graph(x, s / wave, c, -wave * s, -wave * wave * c);
  };
  return {"sine", at, 0.0, uniform(rng, 1.0, 3.0), false};
}

inline KnownCurve random_known_curve(std::size_t kind, std::mt19937_64& rng) {
  using Maker = KnownCurve (*)(std::mt19937_64&);
  constexpr std::array<Maker, 5> kMakers = {random_ellipse, random_fourier, random_limacon,
                                            random_polynomial, random_sine};
  return kMakers[kind % kMakers.size()](rng);
}

/// n places from `from` to `to`, both included: even, random, over two decades, or growing.
inline std::vector<double> strides(std::size_t n, double from, double to, std::mt19937_64& rng) {
  const auto mode = rng() % 4;
  const bool backwards = rng() % 2 == 0;
  const double growth = std::pow(uniform(rng, 0.001, 1.0), 1.0 / static_cast<double>(n));
  std::vector<double> step(n - 1);
  double sum = 0.0;
  for (std::size_t i = 0; i < step.size(); ++i) {
    step[i] = mode == 0   ? 1.0
              : mode == 1 ? uniform(rng, 0.05, 1.0)
              : mode == 2 ? std::pow(10.0, uniform(rng, -2.0, 0.0))
                          : std::pow(growth, static_cast<double>(i));
    sum += step[i];
  }
  if (backwards) std::reverse(step.begin(), step.end());
  std::vector<double> at = {from};
  for (const double s : step) at.push_back(at.back() + (to - from) * s / sum);
  return at;
}

/// A curve of monotone curvature that winds by up to 60 rad.
struct Coil {
  std::string name;
  std::vector<Vec2> points;
  double largest_turn = 0.0;  ///< of the curve between neighbouring points, rad
};

inline double largest_step(const std::vector<double>& at) {
  double most = 0.0;
  for (std::size_t i = 1; i < at.size(); ++i) most = std::max(most, at[i] - at[i - 1]);
  return most;
}

inline Coil random_coil(std::size_t kind, std::mt19937_64& rng) {
  const double winds = uniform(rng, 2.0, 60.0), start = uniform(rng, 0.0, kTurn);
  const auto n = 4 + static_cast<std::size_t>(std::pow(10.0, uniform(rng, 0.3, 2.6)));
  Coil out;
  if (kind % 3 == 0) {
    out.name = "logarithmic spiral";
    const double growth = uniform(rng, 0.01, 0.5);
    const std::vector<double> at = strides(n, 0.0, winds, rng);
    for (const double t : at) out.points.push_back(std::exp(growth * t) * unit_at(t + start));
    out.largest_turn = largest_step(at);
  } else if (kind % 3 == 1) {
    out.name = "involute";
    const double first = uniform(rng, 0.05, 3.0);
    const std::vector<double> at = strides(n, first, first + winds, rng);
    for (const double t : at) out.points.push_back(complex_product({1.0, -t}, unit_at(t + start)));
    out.largest_turn = largest_step(at);
  } else {
    out.name = "clothoid";  // heading s^2/2, with an inflection where s begins below 0
    const double first = uniform(rng, -3.0, 3.0);
    std::vector<double> at = strides(n, 0.0, std::sqrt(first * first + 2.0 * winds) - first, rng);
    for (std::size_t i = 1; i < at.size(); ++i) {
      const double a = at[i - 1] + first, b = at[i] + first;
      out.largest_turn = std::max(out.largest_turn, (b - a) * std::max(std::abs(a), std::abs(b)));
    }
    const double longest = at.back() + std::abs(first);  // headings turn by up to this per length
    out.points = trace([&](double s) { return start + 0.5 * (s + first) * (s + first); }, at,
                       0.01 / longest);
  }
  if (rng() % 2 == 0) std::reverse(out.points.begin(), out.points.end());
  if (rng() % 2 == 0) {
    for (Vec2& p : out.points) p.y = -p.y;
  }
  return out;
}

inline double size_of_points(const std::vector<Vec2>& points) {
  Vec2 low = points.front(), high = low;
  for (const Vec2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return norm(high - low);
}

}  // namespace obvid::test
