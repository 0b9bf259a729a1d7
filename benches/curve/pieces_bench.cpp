// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <cmath>

#include "obvid/curve/pieces.h"

namespace obvid {
namespace {

RationalBezier quarter_circle() {
  return {{}, 2, {Vec2{2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}}, {1.0, 1.0, 2.0}};
}

RationalBezier rational_quartic() {
  return {{10, 20},
          4,
          {Vec2{0, 0}, {1, 0.1}, {2, 0.6}, {2.6, 1.5}, {2.7, 2.6}},
          {1.0, 0.9, 1.3, 1.1, 0.7}};
}

void evaluate_quartic(benchmark::State& state) {
  const RationalBezier piece = rational_quartic();
  double t = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(curvature(evaluate(piece, t)));
    t = t > 0.9 ? 0.0 : t + 0.01;
  }
  // Achieved error: the curvature of a circle of radius 2.
  double worst = 0.0;
  for (int j = 0; j <= 100; ++j) {
    worst = std::max(worst, std::abs(curvature(evaluate(quarter_circle(), j / 100.0)) - 0.5));
  }
  state.counters["error"] = worst;
}
BENCHMARK(evaluate_quartic);

void split_quartic(benchmark::State& state) {
  const RationalBezier piece = rational_quartic();
  for (auto _ : state) benchmark::DoNotOptimize(split(piece, 0.37));
}
BENCHMARK(split_quartic);

void length_of_quarter_circle(benchmark::State& state) {
  const Piece piece = quarter_circle();
  double length = 0.0;
  for (auto _ : state) benchmark::DoNotOptimize(length = arc_length(piece, 1e-12));
  state.counters["error"] = std::abs(length - std::acos(-1.0));
}
BENCHMARK(length_of_quarter_circle);

}  // namespace
}  // namespace obvid
