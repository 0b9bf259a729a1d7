// SPDX-License-Identifier: Apache-2.0
// A point of a clothoid, over all kinds of it; the error against quadrature in long double.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "obvid/curve/internal/clothoid.h"
#include "obvid/curve/pieces.h"

namespace obvid {
namespace {

/// Distance from the end by composite Simpson in long double.
double error_of(double kappa0, double kappa1, double s, Vec2 z) {
  constexpr int kSteps = 20000;
  const long double a = (static_cast<long double>(kappa1) - kappa0) / s, h = s / (2.0L * kSteps);
  long double x = 0.0L, y = 0.0L;
  for (int j = 0; j <= 2 * kSteps; ++j) {
    const long double u = j * h, theta = kappa0 * u + a * u * u / 2.0L;
    const long double weight = (j == 0 || j == 2 * kSteps) ? 1.0L : (j % 2 == 1 ? 4.0L : 2.0L);
    x += weight * h / 3.0L * std::cos(theta);
    y += weight * h / 3.0L * std::sin(theta);
  }
  return static_cast<double>(std::hypot(x - z.x, y - z.y)) / s;
}

/// Points along one clothoid; arguments: curvatures at both ends in thousandths (length 1).
void point_of_a_clothoid(benchmark::State& state) {
  const double kappa0 = 1e-3 * static_cast<double>(state.range(0));
  const double kappa1 = 1e-3 * static_cast<double>(state.range(1));
  constexpr int kPlaces = 64;
  int j = 0;
  for (auto _ : state) {
    j = j % kPlaces + 1;
    const double s = static_cast<double>(j) / kPlaces;
    const Vec2 z = clothoid_step(0.3, kappa0, kappa0 + s * (kappa1 - kappa0), s);
    benchmark::DoNotOptimize(z);
  }
  state.counters["error"] = error_of(kappa0, kappa1, 1.0, clothoid_step(0.0, kappa0, kappa1, 1.0));
}
BENCHMARK(point_of_a_clothoid)
    ->ArgNames({"kappa0_milli", "kappa1_milli"})
    ->Args({0, 0})
    ->Args({300, 500})
    ->Args({900, 901})
    ->Args({2500, 2500})
    ->Args({2500, 2501})
    ->Args({0, 3000})
    ->Args({-2000, 3000})
    ->Args({-8000, 9000})
    ->Args({5000, 30000})
    ->Args({-60000, 100000});

void jet_of_a_clothoid_piece(benchmark::State& state) {
  const Vec2 end = clothoid_step(0.3, 0.4, 0.9, 1.0);
  const Piece piece = ClothoidPiece{{0.0, 0.0}, end, 0.3, 0.4, 0.9, 1.0};
  double t = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(evaluate(piece, t));
    t = t > 0.9 ? 0.0 : t + 0.01;
  }
}
BENCHMARK(jet_of_a_clothoid_piece);

}  // namespace
}  // namespace obvid
