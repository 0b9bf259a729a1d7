// SPDX-License-Identifier: Apache-2.0
// Monotone polynomial B-spline along the reference contour: time, control points, deviation.
#include <benchmark/benchmark.h>

#include <cmath>

#include "obvid/contour/bsplines/monotone.h"
#include "obvid/pipeline/fit.h"

namespace {

using namespace obvid;

/// Tolerance 10^-range mm.
void monotone_bspline(benchmark::State& state) {
  PointSeries series;
  series.points = {{0, 0},          {0.21, -5.28},   {-5.11, -10.13}, {-20.48, -7.65},
                   {-28.68, 16.23}, {-13.87, 40.95}, {17.95, 55.28},  {54.24, 53.04},
                   {100.94, 36.19}, {230.38, -50.82}};
  const auto spirals = fit(series, {});
  if (!spirals) return state.SkipWithError("no contour");
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  for (auto _ : state) {
    const auto spline = monotone_spline(spirals->contour, tolerance);
    if (!spline) return state.SkipWithError("no spline");
    state.counters["control_points"] = static_cast<double>(spline->curve.points.size());
    state.counters["deviation"] = spline->deviation;
  }
}
BENCHMARK(monotone_bspline)
    ->ArgName("digits")
    ->Arg(1)
    ->Arg(3)
    ->Arg(6)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
