// SPDX-License-Identifier: Apache-2.0
// Whole fit in memory, proof included, over the number of points; and its stages.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "obvid/certify/certify.h"
#include "obvid/contour/arcs.h"
#include "obvid/contour/spirals.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/live_fit.h"
#include "obvid/series/analysis.h"

namespace {

using namespace obvid;

/// Logarithmic spiral with a fixed turn per chord: any number of points, curvature that doubles
/// over the same part of the series, never decided by rounding.
std::vector<Vec2> points_of_spiral(std::size_t n) {
  constexpr double kGrowth = 8.0;  // of the radius over the whole series
  const double turn_per_chord = n <= 100 ? 3.0 / static_cast<double>(n) : 0.03;
  const double total = turn_per_chord * static_cast<double>(n - 1);
  const double b = std::log(kGrowth) / total;
  std::vector<Vec2> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = total * static_cast<double>(i) / static_cast<double>(n - 1);
    const double r = std::exp(b * t);
    points[i] = {r * std::cos(t), r * std::sin(t)};
  }
  return points;
}

/// Arguments: points, and 2 or 3 for continuous curvature or a continuous slope of it too.
void fit_of_a_spiral(benchmark::State& state) {
  PointSeries series;
  series.points = points_of_spiral(static_cast<std::size_t>(state.range(0)));
  FitJob job;
  job.continuity = state.range(1) == 3 ? Continuity::kG3 : Continuity::kG2;
  bool proved = true;
  int newton_steps = 0, slope_steps = 0;
  double inserted = 0, gap = 0;
  for (auto _ : state) {
    const auto result = fit(series, job);
    proved = proved && result && result->certificate.proved && result->report.vertices == 0;
    if (!proved) break;
    newton_steps = result->report.chain.newton_steps;
    inserted = static_cast<double>(result->report.inserted_points);
    gap = result->certificate.gaps.slope.value_or(0.0);
    slope_steps = result->certificate.slope_steps;
  }
  if (!proved) state.SkipWithError("not proved");
  state.counters["newton_steps"] = newton_steps;
  state.counters["inserted"] = inserted;
  state.counters["slope_gap"] = gap;
  state.counters["slope_steps"] = slope_steps;
  state.counters["us_per_point"] = benchmark::Counter(
      static_cast<double>(state.range(0)) * 1e-6,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(fit_of_a_spiral)
    ->ArgsProduct({benchmark::CreateRange(10, 1000000, 10), {2, 3}})
    ->Unit(benchmark::kMicrosecond);

/// One point of many moves to and fro, directions as they are: its neighbourhood is chosen again,
/// everything proved.
void refit_after_a_move(benchmark::State& state) {
  PointSeries series;
  series.points = points_of_spiral(static_cast<std::size_t>(state.range(0)));
  FitJob job;
  job.continuity = state.range(1) == 3 ? Continuity::kG3 : Continuity::kG2;
  Watch watch;
  auto live = LiveFit::form(series, job, watch);
  const std::size_t i = series.points.size() / 2;
  const Vec2 at = series.points[i], by = 1e-5 * (series.points[i + 1] - at);
  bool done = live && live->move_point(i, at, watch).has_value();
  int round = 0;
  for (auto _ : state) {
    const auto change = live->move_point(i, at + (++round % 2) * left_normal(by), watch);
    done = done && change && !change->whole && live->certificate().proved;
  }
  if (!done) state.SkipWithError("the whole was formed again");
}
BENCHMARK(refit_after_a_move)
    ->Args({1000, 2})
    ->Args({1000, 3})
    ->Args({100000, 2})
    ->Unit(benchmark::kMicrosecond);

void fit_of_the_reference_series(benchmark::State& state) {
  PointSeries series;
  series.points = {{0, 0},          {0.21, -5.28},   {-5.11, -10.13}, {-20.48, -7.65},
                   {-28.68, 16.23}, {-13.87, 40.95}, {17.95, 55.28},  {54.24, 53.04},
                   {100.94, 36.19}, {230.38, -50.82}};
  for (auto _ : state) {
    auto result = fit(series, FitJob{});
    benchmark::DoNotOptimize(result);
  }
}
BENCHMARK(fit_of_the_reference_series)->Unit(benchmark::kMicrosecond);

LinkState clothoid_like_link() {
  const double h = 1.0, alpha = -0.24, beta = 0.30, sigma = alpha + beta;
  const double A = -sigma, B = sigma;
  return {h, 0.1, alpha, beta, A, B, sigma};
}

void one_closed_form_spiral(benchmark::State& state) {
  const LinkState link = clothoid_like_link();
  const Vec2 start{1.0, 2.0}, end = start + unit_at(0.1);
  std::vector<RationalBezier> pieces;
  pieces.reserve(4);
  for (auto _ : state) {
    pieces.clear();
    bool formed = append_spiral(link, 1, start, end, pieces);
    benchmark::DoNotOptimize(formed);
    benchmark::DoNotOptimize(pieces.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(one_closed_form_spiral);

void one_biarc(benchmark::State& state) {
  const Element a{{0.0, 0.0}, 0.34, -0.3}, b{{1.0, 0.1}, -0.10, -0.9};
  const ChordFrame frame = chord_frame(a, b);
  double first = -0.4;
  for (auto _ : state) {
    benchmark::DoNotOptimize(first);
    const auto arcs = biarc(a, b, {first, second_curvature(frame, first)});
    benchmark::DoNotOptimize(&arcs);
    benchmark::ClobberMemory();
  }
}
BENCHMARK(one_biarc);

void analysis_of_a_spiral(benchmark::State& state) {
  const auto points = points_of_spiral(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(analyse(points));
}
BENCHMARK(analysis_of_a_spiral)->Arg(10)->Arg(1000)->Unit(benchmark::kMicrosecond);

void certificate_of_a_spiral(benchmark::State& state) {
  PointSeries series;
  series.points = points_of_spiral(static_cast<std::size_t>(state.range(0)));
  const auto result = fit(series, FitJob{});
  for (auto _ : state) benchmark::DoNotOptimize(certify(result->contour));
}
BENCHMARK(certificate_of_a_spiral)->Arg(10)->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace
