// SPDX-License-Identifier: Apache-2.0
// Time of drawing surfaces as triangles; counters: triangles, and what they are off by in parts of
// the tolerance.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "obvid/mesh/mesh.h"
#include "obvid/surface/nurbs_surface.h"

namespace {

using namespace obvid;

constexpr double kAnyAngle = 10.0;  // rad: only the chord tolerance counts

std::vector<double> uniform_knots(std::size_t spans) {
  std::vector<double> knots(3, 0.0);
  for (std::size_t k = 0; k <= spans; ++k) {
    knots.push_back(static_cast<double>(k) / static_cast<double>(spans));
  }
  knots.insert(knots.end(), 3, 1.0);
  return knots;
}

/// 100 x 100 with hills 2 high, cut into spans x spans bicubic patches.
NurbsSurface hills(std::size_t spans) {
  NurbsSurface s;
  s.degree_u = s.degree_v = 3;
  s.knots_u = s.knots_v = uniform_knots(spans);
  const std::size_t n = spans + 3;
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      const double u = static_cast<double>(i) / static_cast<double>(n - 1);
      const double v = static_cast<double>(j) / static_cast<double>(n - 1);
      s.points.push_back({100.0 * u, 100.0 * v, 2.0 * std::sin(20.0 * u) * std::cos(15.0 * v)});
    }
  }
  return s;
}

/// Radius 1, rational: eight patches.
NurbsSurface sphere() {
  const SpaceCurve half = arc_about({0.0, 0.0, -1.0}, {}, {0.0, -1.0, 0.0}, std::numbers::pi);
  const SpaceCurve circle = arc_about({1.0, 0.0, 0.0}, {}, {0.0, 0.0, 1.0}, 2.0 * std::numbers::pi);
  NurbsSurface s{circle.degree, half.degree, circle.knots, half.knots, {}, {}};
  for (std::size_t j = 0; j < half.points.size(); ++j) {
    const bool pole = j == 0 || j + 1 == half.points.size();
    const double r = pole ? 0.0 : half.points[j].x;
    for (std::size_t i = 0; i < circle.points.size(); ++i) {
      s.points.push_back({r * circle.points[i].x, r * circle.points[i].y, half.points[j].z});
      s.weights.push_back(half.weights[j] * circle.weights[i]);
    }
  }
  return s;
}

void draw(benchmark::State& state, const NurbsSurface& surface, double tolerance) {
  Mesh mesh;
  for (auto _ : state) {
    auto drawn = tessellate(surface, {tolerance, kAnyAngle});
    if (!drawn) return state.SkipWithError(drawn.error().what.c_str());
    mesh = std::move(*drawn);
    benchmark::DoNotOptimize(mesh.triangles.data());
  }
  state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
  state.counters["off"] = mesh.deviation / tolerance;
}

/// Tolerance 10^-argument.
void draw_hills(benchmark::State& state) {
  draw(state, hills(static_cast<std::size_t>(state.range(0))),
       std::pow(10.0, -static_cast<double>(state.range(1))));
}
BENCHMARK(draw_hills)
    ->ArgNames({"spans", "digits"})
    ->Args({30, 2})
    ->Args({300, 1})
    ->Args({300, 2})
    ->Args({300, 3})
    ->Unit(benchmark::kMillisecond);

void draw_sphere(benchmark::State& state) {
  draw(state, sphere(), std::pow(10.0, -static_cast<double>(state.range(0))));
}
BENCHMARK(draw_sphere)->ArgName("digits")->Arg(2)->Arg(3)->Arg(4)->Unit(benchmark::kMillisecond);

}  // namespace
