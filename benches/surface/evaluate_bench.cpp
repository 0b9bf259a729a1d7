// SPDX-License-Identifier: Apache-2.0
// A bicubic surface of 300 x 300 points: interpolation, and points with both partial derivatives.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "obvid/surface_builders/internal/grid.h"

namespace obvid {
namespace {

constexpr std::size_t kSide = 300;

Vec3 wavy(double x, double y) { return {x, y, 0.1 * std::sin(7.0 * x) * std::cos(5.0 * y)}; }

PointGrid wavy_grid() {
  PointGrid grid{kSide, kSide, {}, "wavy"};
  for (std::size_t j = 0; j < kSide; ++j) {
    for (std::size_t i = 0; i < kSide; ++i) {
      grid.points.push_back(
          wavy(static_cast<double>(i) / (kSide - 1), static_cast<double>(j) / (kSide - 1)));
    }
  }
  return grid;
}

void interpolate_300x300(benchmark::State& state) {
  const PointGrid grid = wavy_grid();
  double worst = 0.0;
  for (auto _ : state) {
    const Result<NurbsSurface> surface = interpolated(grid);
    benchmark::DoNotOptimize(surface->points.data());
  }
  const NurbsSurface surface = *interpolated(grid);
  const std::vector<double> u = *grid_parameters(grid, true, Spread::kChord);
  const std::vector<double> v = *grid_parameters(grid, false, Spread::kChord);
  const std::vector<SurfacePoint> raster = evaluate_raster(surface, u, v);
  for (std::size_t i = 0; i < raster.size(); ++i) {
    worst = std::max(worst, norm(raster[i].point - grid.points[i]));
  }
  state.counters["error"] = worst;
}
BENCHMARK(interpolate_300x300)->Unit(benchmark::kMillisecond);

std::vector<double> steps(std::size_t count) {
  std::vector<double> at(count);
  for (std::size_t i = 0; i < count; ++i) {
    at[i] = static_cast<double>(i) / static_cast<double>(count - 1);
  }
  return at;
}

void raster_of(benchmark::State& state, const NurbsSurface& surface) {
  const std::vector<double> at = steps(1000);
  std::vector<SurfacePoint> out(at.size() * at.size());
  for (auto _ : state) {
    evaluate_raster(surface, at, at, out);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  state.counters["per_point"] = benchmark::Counter(
      static_cast<double>(out.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void raster_bicubic(benchmark::State& state) { raster_of(state, *interpolated(wavy_grid())); }
BENCHMARK(raster_bicubic)->Unit(benchmark::kMillisecond);

void raster_rational_bicubic(benchmark::State& state) {
  NurbsSurface surface = *interpolated(wavy_grid());
  surface.weights.assign(surface.points.size(), 1.0);
  raster_of(state, surface);
}
BENCHMARK(raster_rational_bicubic)->Unit(benchmark::kMillisecond);

void single_point_second_order(benchmark::State& state) {
  const NurbsSurface surface = *interpolated(wavy_grid());
  double u = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(evaluate(surface, u, 0.37));
    u = u > 0.99 ? 0.0 : u + 0.001;
  }
}
BENCHMARK(single_point_second_order);

}  // namespace
}  // namespace obvid
