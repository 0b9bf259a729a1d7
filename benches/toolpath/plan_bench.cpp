// SPDX-License-Identifier: Apache-2.0
// Tool paths of a wavy part: time, passes and the scallop that stays, by cutters and strategies.
#include <benchmark/benchmark.h>

#include <cmath>

#include "obvid/surface_builders/internal/grid.h"
#include "obvid/toolpath/toolpath.h"

namespace obvid {
namespace {

constexpr double kPlateSide = 30.0;
constexpr std::size_t kPoints = 61;

SurfaceModel wavy_part() {
  PointGrid grid{kPoints, kPoints, {}, "waves"};
  for (std::size_t j = 0; j < kPoints; ++j) {
    for (std::size_t i = 0; i < kPoints; ++i) {
      const double x = kPlateSide * static_cast<double>(i) / static_cast<double>(kPoints - 1);
      const double y = kPlateSide * static_cast<double>(j) / static_cast<double>(kPoints - 1);
      grid.points.push_back({x, y, 2.0 * std::sin(x / 4.5) * std::cos(y / 4.5)});
    }
  }
  SurfaceModel model;
  model.patches.push_back({"waves", *interpolated(grid, Spread::kUniform)});
  return model;
}

void plan_waves(benchmark::State& state, Cutter cutter, ToolpathStrategy strategy) {
  const SurfaceModel model = wavy_part();
  ToolpathOptions options;
  options.cutter = cutter;
  options.strategy = strategy;
  options.tolerance = 0.01;
  options.scallop = 0.05;
  ToolpathReport report;
  for (auto _ : state) {
    const Result<Toolpath> path = plan(model, options);
    if (!path) return state.SkipWithError(path.error().what.c_str());
    report = path->report;
  }
  state.counters["passes"] = static_cast<double>(report.passes);
  state.counters["added"] = static_cast<double>(report.added_passes);
  state.counters["length"] = report.cutting_length;
  state.counters["scallop"] = report.scallop.found;
}

constexpr Cutter kBall{CutterKind::kBall, 6.0, 0.0};
constexpr Cutter kBullNose{CutterKind::kBullNose, 6.0, 1.5};
constexpr Cutter kFlat{CutterKind::kFlat, 4.0, 0.0};

BENCHMARK_CAPTURE(plan_waves, ball_zigzag, kBall, ToolpathStrategy::kZigzag)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan_waves, ball_isoparametric, kBall, ToolpathStrategy::kIsoparametric)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan_waves, ball_constant_scallop, kBall, ToolpathStrategy::kConstantScallop)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan_waves, bull_nose_zigzag, kBullNose, ToolpathStrategy::kZigzag)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan_waves, bull_nose_constant_scallop, kBullNose,
                  ToolpathStrategy::kConstantScallop)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan_waves, flat_zigzag, kFlat, ToolpathStrategy::kZigzag)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace obvid
