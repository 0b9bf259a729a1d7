// SPDX-License-Identifier: Apache-2.0
// G1 fit, G2 spline, three clothoids over a link, and the whole monotone clothoid contour with its
// proof.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "obvid/contour/clothoids.h"
#include "obvid/curve/internal/clothoid.h"
#include "obvid/pipeline/fit.h"

namespace {

using namespace obvid;

/// Random headings within `range` hundredths of a radian of the chord.
void g1_fit(benchmark::State& state) {
  const double range = 0.01 * static_cast<double>(state.range(0));
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> draw(-range, range);
  std::vector<Vec2> headings(4096);
  for (Vec2& h : headings) h = {draw(rng), draw(rng)};
  std::size_t i = 0;
  for (auto _ : state) {
    i = (i + 1) % headings.size();
    benchmark::DoNotOptimize(clothoid_between({0, 0}, headings[i].x, {1, 0}, headings[i].y));
  }
  double worst = 0.0;
  for (const Vec2 h : headings) {
    const auto p = clothoid_between({0, 0}, h.x, {1, 0}, h.y);
    if (!p) return state.SkipWithError("no fit");
    const Vec2 end = clothoid_step(h.x, p->kappa0, p->kappa1, p->length);
    worst = std::max(worst, norm(end - Vec2{1, 0}) / p->length);
  }
  state.counters["error"] = worst;
}
BENCHMARK(g1_fit)->ArgName("range_centi")->Arg(10)->Arg(100)->Arg(314);

/// Logarithmic spiral whose radius grows eightfold: three radians in all up to 100 points, 0.03 a
/// chord beyond.
std::vector<Vec2> spiral_points(std::size_t n) {
  const double turn_per_chord = n <= 100 ? 3.0 / static_cast<double>(n) : 0.03;
  const double total = turn_per_chord * static_cast<double>(n - 1);
  std::vector<Vec2> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = total * static_cast<double>(i) / static_cast<double>(n - 1);
    points[i] = std::exp(std::log(8.0) * t / total) * unit_at(t);
  }
  return points;
}

void g2_spline(benchmark::State& state) {
  const auto points = spiral_points(static_cast<std::size_t>(state.range(0)));
  int steps = 0;
  for (auto _ : state) {
    const auto spline = clothoid_spline(points);
    if (!spline) return state.SkipWithError("no spline");
    steps = spline->newton_steps;
  }
  state.counters["newton_steps"] = steps;
}
BENCHMARK(g2_spline)->Arg(10)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMicrosecond);

void three_clothoids(benchmark::State& state) {
  const double sigma = 0.06, alpha = -0.24, beta = 0.30, h = 1.0;
  const LinkState link = {h, 0.0, alpha, beta, -1.03 * sigma, 1.03 * sigma, sigma};
  const Element a = {{0, 0}, alpha, 2.0 * (link.A - std::sin(alpha))};
  const Element b = {{1, 0}, beta, 2.0 * (link.B + std::sin(beta))};
  std::vector<ClothoidPiece> pieces;
  for (auto _ : state) {
    pieces.clear();
    if (!append_clothoids(link, 1, a, b, pieces)) return state.SkipWithError("not found");
    benchmark::DoNotOptimize(pieces.data());
  }
}
BENCHMARK(three_clothoids);

void monotone_clothoid_contour(benchmark::State& state) {
  PointSeries series;
  series.points = spiral_points(static_cast<std::size_t>(state.range(0)));
  FitJob job;
  job.carrier = Carrier::kClothoids;
  bool proved = true;
  for (auto _ : state) {
    const auto result = fit(series, job);
    proved = proved && result && result->certificate.proved && result->report.vertices == 0;
  }
  if (!proved) state.SkipWithError("not proved");
}
BENCHMARK(monotone_clothoid_contour)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMicrosecond);

void monotone_clothoid_contour_of_the_reference_series(benchmark::State& state) {
  PointSeries series;
  series.points = {{0, 0},          {0.21, -5.28},   {-5.11, -10.13}, {-20.48, -7.65},
                   {-28.68, 16.23}, {-13.87, 40.95}, {17.95, 55.28},  {54.24, 53.04},
                   {100.94, 36.19}, {230.38, -50.82}};
  FitJob job;
  job.carrier = Carrier::kClothoids;
  for (auto _ : state) benchmark::DoNotOptimize(fit(series, job));
}
BENCHMARK(monotone_clothoid_contour_of_the_reference_series)->Unit(benchmark::kMicrosecond);

}  // namespace
