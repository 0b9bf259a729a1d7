// SPDX-License-Identifier: Apache-2.0
// Errors and orders of convergence in one and two variables and along a helix.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "methods.h"
#include "obvid/idspline/internal/id_curve.h"
#include "obvid/idspline/internal/id_spline_2d.h"

namespace obvid::bench {
namespace {

constexpr double kEnd = 3.0;

/// exp(-x) cos 4x with its derivative and integral from 0.
double f(double x) { return std::exp(-x) * std::cos(4.0 * x); }
double slope(double x) { return -std::exp(-x) * (std::cos(4.0 * x) + 4.0 * std::sin(4.0 * x)); }
double sum_to(double x) {
  return (1.0 + std::exp(-x) * (4.0 * std::sin(4.0 * x) - std::cos(4.0 * x))) / 17.0;
}

double uniform(std::mt19937& random) { return double(random()) / double(random.max()); }

/// Equal steps, or inner nodes moved by up to 0.35 of a step.
std::vector<double> nodes_of(std::size_t n, bool random_steps, unsigned seed) {
  constexpr double kMove = 0.7;
  std::mt19937 random(seed);
  std::vector<double> x;
  for (std::size_t i = 0; i <= n; ++i) {
    const bool inner = i > 0 && i < n;
    const double move = inner && random_steps ? kMove * (uniform(random) - 0.5) : 0.0;
    x.push_back(kEnd * (double(i) + move) / double(n));
  }
  x.back() = kEnd;
  return x;
}

/// Errors of value, first derivative and integral from the start: the largest, or root mean
/// squares. Inner ones leave out what is near the ends, where data come from one side only.
struct Errors {
  double value = 0.0, slope = 0.0, integral = 0.0, inner_value = 0.0, inner_slope = 0.0;
};
constexpr double kInnerStart = 0.6, kInnerEnd = 2.4;

constexpr int kErrorPlaces = 4000;

Errors largest_errors(const AnySpline& s) {
  Errors e;
  for (int k = 0; k <= kErrorPlaces; ++k) {
    const double x = kEnd * k / kErrorPlaces;
    const ScalarJet jet = s.at(x);
    const double at = std::abs(jet.value - f(x)), along = std::abs(jet.d1 - slope(x));
    e.value = std::max(e.value, at);
    e.slope = std::max(e.slope, along);
    if (x < kInnerStart || x > kInnerEnd) continue;
    e.inner_value = std::max(e.inner_value, at);
    e.inner_slope = std::max(e.inner_slope, along);
  }
  for (int k = 0; k <= kErrorPlaces; k += 10) {
    const double x = kEnd * k / kErrorPlaces;
    e.integral = std::max(e.integral, std::abs(s.integral(0.0, x) - sum_to(x)));
  }
  return e;
}

Errors add_squares(const AnySpline& s, Errors e) {
  for (int k = 0; k <= kErrorPlaces; ++k) {
    const double x = kEnd * k / kErrorPlaces;
    const ScalarJet jet = s.at(x);
    e.value += std::pow(jet.value - f(x), 2) / (kErrorPlaces + 1);
    e.slope += std::pow(jet.d1 - slope(x), 2) / (kErrorPlaces + 1);
    if (k % 40 == 0) e.integral += std::pow(s.integral(0.0, x) - sum_to(x), 2) * 40 / kErrorPlaces;
  }
  return e;
}

AnySpline make(const Method& method, const std::vector<double>& x, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> values, sums;
  for (const double at : x) values.push_back(f(at) + noise * (2.0 * uniform(random) - 1.0));
  for (std::size_t i = 0; i + 1 < x.size(); ++i) sums.push_back(sum_to(x[i + 1]) - sum_to(x[i]));
  return method.make(x, values, sums);
}

constexpr unsigned kSeeds = 8;

constexpr double Errors::*kParts[] = {&Errors::value, &Errors::inner_value, &Errors::slope,
                                      &Errors::inner_slope, &Errors::integral};

/// Largest errors, as geometric mean over grids.
Errors smooth_errors(const Method& method, std::size_t n, bool random_steps) {
  Errors product{1.0, 1.0, 1.0, 1.0, 1.0};
  const unsigned seeds = random_steps ? kSeeds : 1;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const Errors e = largest_errors(make(method, nodes_of(n, random_steps, seed), 0.0, seed));
    for (const auto part : kParts) product.*part *= std::pow(e.*part, 1.0 / seeds);
  }
  return product;
}

Errors noisy_errors(const Method& method, std::size_t n, bool random_steps, double noise) {
  Errors sum;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    sum = add_squares(make(method, nodes_of(n, random_steps, seed), noise, 100 + seed), sum);
  }
  const auto mean = [](double x) { return std::sqrt(x / kSeeds); };
  return {mean(sum.value), mean(sum.slope), mean(sum.integral)};
}

void print_smooth(bool random_steps) {
  constexpr std::size_t kCoarse = 40, kFine = 160;
  fmt::print("\nSmooth data, {} steps: largest error with {} cells, order from {} to {}\n\n",
             random_steps ? "random" : "equal", kFine, kCoarse, kFine);
  fmt::print(
      "| spline | value | order | inner value | order | slope | order | inner slope | order | "
      "integral | order |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const Method& method : methods()) {
    const Errors a = smooth_errors(method, kCoarse, random_steps);
    const Errors b = smooth_errors(method, kFine, random_steps);
    fmt::print("| {} |", method.name);
    for (const auto part : kParts) {
      const double order = std::log(a.*part / b.*part) / std::log(double(kFine) / double(kCoarse));
      fmt::print(" {:.1e} | {:.1f} |", b.*part, order);
    }
    fmt::print("\n");
  }
}

void print_noisy(bool random_steps) {
  constexpr double kNoise = 1e-3;
  fmt::print(
      "\nValues with noise, even in +-{}, {} steps: root mean square errors, 40 and 640 cells\n\n",
      kNoise, random_steps ? "random" : "equal");
  fmt::print("| spline | value | | slope | | integral | |\n");
  fmt::print("|---|---:|---:|---:|---:|---:|---:|\n");
  for (const Method& method : methods()) {
    const Errors a = noisy_errors(method, 40, random_steps, kNoise);
    const Errors b = noisy_errors(method, 640, random_steps, kNoise);
    fmt::print("| {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} |\n", method.name,
               a.value, b.value, a.slope, b.slope, a.integral, b.integral);
  }
}

/// Bell with its integral over [-2, 2] x [-2, 2].
double bell(double x, double y) { return std::exp(-x * x - y * y); }

/// Errors of value on the section y = 0 and everywhere, and of the integral over the domain.
Errors grid_errors(std::size_t n, bool smooth) {
  std::vector<double> nodes;
  for (std::size_t i = 0; i <= n; ++i) nodes.push_back(4.0 * double(i) / double(n) - 2.0);
  IdSpline2dData data{nodes, nodes, {}, {}, {}, {}};
  for (const double y : nodes) {
    for (const double x : nodes) data.values.push_back(bell(x, y));
  }
  const auto s = id_spline_2d(std::move(data), smooth);
  if (!s) return {};
  constexpr int kSide = 400;
  Errors e;
  for (int j = 0; j <= kSide; ++j) {
    const double y = 4.0 * j / kSide - 2.0;
    const IdSpline line = section_along_x(*s, y);
    for (int i = 0; i <= kSide; ++i) {
      const double x = 4.0 * i / kSide - 2.0;
      const double error = std::abs(evaluate(line, x).value - bell(x, y));
      e.value = std::max(e.value, error);
      if (2 * j == kSide) e.slope = std::max(e.slope, error);
    }
  }
  const double exact = std::numbers::pi * std::pow(std::erf(2.0), 2);
  e.integral = std::abs(integral(*s, -2.0, 2.0, -2.0, 2.0) - exact);
  return e;
}

std::array<double, 3> on_helix(double t) { return {std::cos(t), std::sin(t), 0.2 * t}; }

/// Largest distance from the cylinder on which the helix lies.
double helix_error(std::size_t n, bool random_steps, const IdSplineOptions& options) {
  std::vector<std::array<double, 3>> points;
  for (const double x : nodes_of(n, random_steps, 1)) points.push_back(on_helix(3.0 * x));
  const auto curve = id_curve<3>(points, options);
  if (!curve) return -1.0;
  double worst = 0.0;
  for (int k = 0; k <= kErrorPlaces; ++k) {
    const auto p = evaluate(*curve, curve->part[0].nodes.back() * k / kErrorPlaces).point;
    worst = std::max(worst, std::abs(std::hypot(p[0], p[1]) - 1.0));
  }
  return worst;
}

}  // namespace

void print_convergence() {
  print_smooth(false);
  print_smooth(true);
  print_noisy(false);
  print_noisy(true);
}

void print_two_variables() {
  fmt::print("\nexp(-x^2 - y^2) on [-2, 2] x [-2, 2] from values alone: largest errors\n\n");
  fmt::print("| cells | smoothing | section y = 0 | order | everywhere | order | integral |\n");
  fmt::print("|---:|---|---:|---:|---:|---:|---:|\n");
  for (const bool smooth : {false, true}) {
    Errors before;
    for (const std::size_t n : {10u, 20u, 40u, 80u}) {
      const Errors e = grid_errors(n, smooth);
      const auto order = [&](double a, double b) {
        return before.value > 0.0 ? fmt::format("{:.1f}", std::log2(a / b)) : std::string();
      };
      fmt::print("| {0} x {0} | {1} | {2:.1e} | {3} | {4:.1e} | {5} | {6:.1e} |\n", n,
                 smooth ? "C1" : "none", e.slope, order(before.slope, e.slope), e.value,
                 order(before.value, e.value), e.integral);
      before = e;
    }
  }
}

void print_curves() {
  fmt::print(
      "\nHelix from its points: distance from its cylinder with 160 points, order from 80\n\n");
  fmt::print("| spline | equal | order | random | order |\n|---|---:|---:|---:|---:|\n");
  const std::pair<const char*, IdSplineOptions> kinds[] = {
      {"ID 2, values free", {2, IdSmoothing::kValuesFree}},
      {"ID 4, values kept", {4, IdSmoothing::kValuesKept}},
      {"ID 4, values free", {4, IdSmoothing::kValuesFree}},
      {"ID 6, values kept", {6, IdSmoothing::kValuesKept}}};
  for (const auto& [name, options] : kinds) {
    fmt::print("| {} |", name);
    for (const bool random_steps : {false, true}) {
      const double a = helix_error(80, random_steps, options);
      const double b = helix_error(160, random_steps, options);
      fmt::print(" {:.1e} | {:.1f} |", b, std::log2(a / b));
    }
    fmt::print("\n");
  }
}

}  // namespace obvid::bench
