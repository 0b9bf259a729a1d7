// SPDX-License-Identifier: Apache-2.0
// Least squares of grids: cost per point and knots that are left, smooth and noisy.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "obvid/surface_builders/internal/approximate.h"

namespace obvid {
namespace {

PointGrid waves(std::size_t n, double noise) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> error(0.0, 1.0);
  PointGrid grid{n, n, {}, "waves"};
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      const double x = static_cast<double>(i) / static_cast<double>(n - 1);
      const double y = static_cast<double>(j) / static_cast<double>(n - 1);
      const double z = 0.1 * std::sin(9 * x + 2 * y) * std::cos(7 * y * y);
      grid.points.push_back({x, y, z + noise * error(random)});
    }
  }
  return grid;
}

void approximate(benchmark::State& state, double noise, double tolerance) {
  const PointGrid grid = waves(static_cast<std::size_t>(state.range(0)), noise);
  std::size_t controls = 0;
  for (auto _ : state) {
    const Result<ApproximatedSurface> made = approximated(grid, tolerance);
    if (!made) return state.SkipWithError(made.error().what.c_str());
    controls = made->surface.points.size();
    benchmark::DoNotOptimize(controls);
  }
  state.counters["control points"] = static_cast<double>(controls);
  state.counters["points/s"] = benchmark::Counter(static_cast<double>(grid.points.size()),
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK_CAPTURE(approximate, smooth_loose, 0.0, 1e-3)
    ->Arg(100)
    ->Arg(300)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(approximate, smooth_tight, 0.0, 1e-6)
    ->Arg(100)
    ->Arg(300)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(approximate, noisy, 1e-3, 6e-3)
    ->Arg(100)
    ->Arg(300)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(approximate, noise_above_the_tolerance, 1e-3, 2e-3)
    ->Arg(100)
    ->Arg(300)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace obvid
