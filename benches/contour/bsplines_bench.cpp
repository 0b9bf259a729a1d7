// SPDX-License-Identifier: Apache-2.0
// The C2 cubic spline: interpolation and evaluation.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "obvid/contour/bsplines.h"

namespace {

using namespace obvid;

/// Points of a logarithmic spiral with uneven steps.
std::vector<Vec2> wavy_spiral(std::size_t n) {
  std::vector<Vec2> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double k = static_cast<double>(i), t = 0.03 * k + 0.008 * std::sin(7.0 * k);
    points[i] = std::exp(0.01 * t) * unit_at(t);
  }
  return points;
}

void c2_cubic(benchmark::State& state) {
  const auto points = wavy_spiral(static_cast<std::size_t>(state.range(0)));
  const auto end = static_cast<SplineEnd>(state.range(1));
  for (auto _ : state) {
    const auto spline = cubic_spline(points, {SplineParameter::kChord, end, {0, 1}, {0, 1}});
    if (!spline) return state.SkipWithError("no spline");
    benchmark::DoNotOptimize(spline->slopes.data());
  }
}
BENCHMARK(c2_cubic)
    ->ArgNames({"points", "end"})
    ->ArgsProduct({{10, 10000}, {0, 1, 2, 3}})
    ->Unit(benchmark::kMicrosecond);

/// `per_span` parameters on each of 9,999 spans.
void sorted_parameters(benchmark::State& state) {
  const auto spline = cubic_spline(wavy_spiral(10000));
  if (!spline) return state.SkipWithError("no spline");
  const auto count = static_cast<std::size_t>(9999 * state.range(0));
  std::vector<double> u(count);
  for (std::size_t j = 0; j < count; ++j) {
    u[j] = spline->knots.back() * static_cast<double>(j) / static_cast<double>(count);
  }
  std::vector<Vec2> out(count);
  for (auto _ : state) {
    evaluate_sorted(*spline, u, out);
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["per_point"] =
      benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
}
BENCHMARK(sorted_parameters)->ArgName("per_span")->Arg(1)->Arg(10)->Unit(benchmark::kMicrosecond);

void through_tangents(benchmark::State& state) {
  const auto points = wavy_spiral(static_cast<std::size_t>(state.range(0)));
  std::vector<double> theta(points.size());
  for (std::size_t i = 0; i < theta.size(); ++i) theta[i] = heading(left_normal(points[i]));
  for (auto _ : state) benchmark::DoNotOptimize(spline_through_tangents(points, theta));
}
BENCHMARK(through_tangents)->Arg(10)->Arg(10000)->Unit(benchmark::kMicrosecond);

}  // namespace
