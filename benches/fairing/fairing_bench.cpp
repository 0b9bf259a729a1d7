// SPDX-License-Identifier: Apache-2.0
// Fairing within tolerances, over the number of points: noisy samples of a meander, the
// sine-generated curve of Langbein and Leopold (1966), theta = sin(2 pi s), with two vertices per
// unit of length.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "build_tube.h"
#include "obvid/fairing/internal/fairing.h"
#include "obvid/pipeline/fit.h"
#include "obvid/series/internal/forced_vertices.h"

namespace {

using namespace obvid;

constexpr double kNoise = 1e-4;  ///< radius of the discs, in wavelengths
constexpr double kTurn = 2.0 * std::numbers::pi;

double uniform(std::mt19937_64& rng) { return static_cast<double>(rng() >> 11) * 0x1p-53; }

/// n points over `waves` wavelengths, each moved within its disc.
MeasuredSeries meander(std::size_t n, double waves) {
  constexpr int kSteps = 64;  // of the midpoint rule: errors far below the noise
  std::mt19937_64 rng(20260207);
  MeasuredSeries series;
  const double step = waves / static_cast<double>(n - 1);
  Vec2 at;
  for (std::size_t i = 0; i < n; ++i) {
    const double r = kNoise * std::sqrt(uniform(rng));
    series.points.push_back(at + r * unit_at(kTurn * uniform(rng)));
    series.reach.push_back(kNoise);
    for (int k = 0; k < kSteps; ++k) {
      const double s = step * (static_cast<double>(i) + (k + 0.5) / kSteps);
      at = at + step / kSteps * unit_at(std::sin(kTurn * s));
    }
  }
  return series;
}

/// Points, wavelengths, and an airfoil's worth as the first.
void sizes(benchmark::internal::Benchmark* b) {
  b->Args({70, 1})->Args({1000, 1})->Args({10000, 5})->Args({100000, 5})->Args({100000, 50});
  b->Unit(benchmark::kMillisecond);
}

void per_point(benchmark::State& state) {
  state.counters["us_per_point"] = benchmark::Counter(
      static_cast<double>(state.range(0)) * 1e-6,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void fairing_of_a_meander(benchmark::State& state) {
  const auto series =
      meander(static_cast<std::size_t>(state.range(0)), static_cast<double>(state.range(1)));
  FairedSeries faired;
  for (auto _ : state) {
    Watch watch;
    faired = fair(series, watch);
    benchmark::DoNotOptimize(&faired);
  }
  if (!faired.feasible) state.SkipWithError("not feasible");
  state.counters["vertices"] = faired.vertices;
  state.counters["forced"] = faired.vertices_lower_bound;
  state.counters["nodes"] = static_cast<double>(faired.elements.size());
  state.counters["newton_steps"] = faired.newton_steps;
  per_point(state);
}
BENCHMARK(fairing_of_a_meander)->Apply(sizes);

void lower_bound_alone(benchmark::State& state) {
  const auto series =
      meander(static_cast<std::size_t>(state.range(0)), static_cast<double>(state.range(1)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(forced_vertices(series.points, series.reach, series.closed));
  }
  per_point(state);
}
BENCHMARK(lower_bound_alone)->Apply(sizes);

void smooth_curve_alone(benchmark::State& state) {
  const auto series =
      meander(static_cast<std::size_t>(state.range(0)), static_cast<double>(state.range(1)));
  for (auto _ : state) {
    Watch watch;
    auto smooth = fairing_detail::build_tube(series, {}, watch);
    benchmark::DoNotOptimize(&smooth);
  }
  per_point(state);
}
BENCHMARK(smooth_curve_alone)->Apply(sizes);

/// With the contour and its proof.
void fit_of_a_noisy_meander(benchmark::State& state) {
  PointSeries series;
  series.points =
      meander(static_cast<std::size_t>(state.range(0)), static_cast<double>(state.range(1))).points;
  FitJob job;
  job.noise = kNoise;
  bool proved = true;
  int vertices = 0;
  for (auto _ : state) {
    const auto result = fit(series, job);
    proved = proved && result && result->certificate.proved;
    if (result) vertices = result->report.vertices;
  }
  if (!proved) state.SkipWithError("not proved");
  state.counters["vertices"] = vertices;
  per_point(state);
}
BENCHMARK(fit_of_a_noisy_meander)->Apply(sizes);

}  // namespace
