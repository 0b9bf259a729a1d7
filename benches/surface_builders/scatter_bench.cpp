// SPDX-License-Identifier: Apache-2.0
// Surfaces near scattered points: time and control points, by tolerance.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "obvid/geom/internal/angle.h"
#include "obvid/surface_builders/internal/scatter.h"

namespace obvid {
namespace {

/// Points at random in [0, 1] x [0, 1] on two hills.
std::vector<Vec3> hills(std::size_t count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> at(0.0, 1.0);
  std::vector<Vec3> out;
  for (std::size_t k = 0; k < count; ++k) {
    const double x = at(random), y = at(random);
    const auto hill = [&](double x0, double y0, double width) {
      return std::exp(-((x - x0) * (x - x0) + (y - y0) * (y - y0)) / (width * width));
    };
    out.push_back({x, y, 0.75 * hill(0.2, 0.25, 0.25) + 0.5 * hill(0.75, 0.35, 0.2)});
  }
  return out;
}

void scatter(benchmark::State& state, double tolerance) {
  const auto points = hills(static_cast<std::size_t>(state.range(0)));
  ScatterOptions options;
  options.tolerance = tolerance;
  options.steepest = 85.0 * kOneDegree;
  std::size_t controls = 0;
  for (auto _ : state) {
    const auto made = scattered(points, options);
    if (!made) return state.SkipWithError(made.error().what.c_str());
    controls = made->surface.points.size();
    benchmark::DoNotOptimize(controls);
  }
  state.counters["control points"] = static_cast<double>(controls);
}

BENCHMARK_CAPTURE(scatter, loose, 1e-3)->Arg(1000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scatter, tight, 1e-5)->Arg(1000)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace obvid
