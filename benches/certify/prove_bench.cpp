// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "obvid/certify/certify.h"

namespace obvid {
namespace {

/// Closed-form spiral of a clothoid through an inflection (tests/certify/spiral_table.h, row 2).
RationalBezier quartic() {
  return {{},
          4,
          {Vec2{-1.0, 0.0},
           {-0.6039427034342335, 0.41061047472776074},
           {-0.023215999333661978, 0.5032118974013893},
           {0.5277442169629889, 0.320710085354088},
           {1.0, 0.0}},
          {1.0, 0.8278931050194358, 0.7731976236257646, 0.7598195227678485, 0.7525567222770941}};
}

void prove_quartic(benchmark::State& state) {
  const Piece piece = quartic();
  for (auto _ : state) benchmark::DoNotOptimize(prove_piece(piece));
}
BENCHMARK(prove_quartic);

void prove_conic(benchmark::State& state) {
  const Piece piece = RationalBezier{{}, 2, {Vec2{0, 0}, {0.5, 0}, {1, 1}}, {1, 0.9, 1}};
  for (auto _ : state) benchmark::DoNotOptimize(prove_piece(piece));
}
BENCHMARK(prove_conic);

/// A vertex right at the end: beyond doubles, decided exactly.
void prove_conic_exactly(benchmark::State& state) {
  const Piece piece = RationalBezier{{}, 2, {Vec2{3, 0}, {3, 1}, {0, 1}}, {1, 1, 2}};
  for (auto _ : state) benchmark::DoNotOptimize(prove_piece(piece));
}
BENCHMARK(prove_conic_exactly);

/// A quartic whose curvature changes too little for doubles.
void prove_flat_quartic(benchmark::State& state) {
  RationalBezier piece = quartic();
  for (int j = 0; j < 24; ++j) piece = split(piece, 0.5)[0];
  const Piece part = piece;
  for (auto _ : state) benchmark::DoNotOptimize(prove_piece(part));
  state.SetLabel(to_string(prove_piece(part).verdict));
}
BENCHMARK(prove_flat_quartic);

/// Parabola (x, x^2 / 2) on [0.5, 1.5] in equal steps of x: quadratic pieces raised to degree 4.
Contour parabola(std::size_t n) {
  Contour contour;
  const double h = 1.0 / static_cast<double>(n);
  for (std::size_t i = 0; i <= n; ++i) {
    const double x = 0.5 + static_cast<double>(i) * h;
    const Vec2 p{x, 0.5 * x * x};
    contour.points.push_back(p);
    contour.joints.push_back({{p, std::atan(x), std::pow(1 + x * x, -1.5)}, i, {}});
    if (i == n) break;
    // Bernstein points of the quadratic, then degree elevation twice.
    RationalBezier piece;
    piece.origin = p;
    piece.degree = 4;
    for (std::size_t j = 0; j <= 4; ++j) {
      const double t = static_cast<double>(j) / 4.0;
      const double squared = static_cast<double>(j * (j - (j > 0))) / 12.0;  // blossom of t^2
      piece.offset[j] = {h * t, h * (x * t + 0.5 * h * squared)};
      piece.weight[j] = 1.0;
    }
    contour.pieces.emplace_back(piece);
  }
  contour.runs.push_back({0, n - 1, -1});
  return contour;
}

void certify_contour(benchmark::State& state) {
  const Contour contour = parabola(static_cast<std::size_t>(state.range(0)));
  Certificate certificate;
  for (auto _ : state) certificate = certify(contour);
  std::size_t slow = 0;
  for (const PieceProof& proof : certificate.pieces) slow += proof.exact_arithmetic;
  state.SetLabel(certificate.proved ? "proved" : certificate.reason);
  state.counters["beyond_doubles"] = static_cast<double>(slow);
  state.counters["curvature_gap"] = certificate.gaps.curvature;
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(certify_contour)->RangeMultiplier(10)->Range(10, 1000000)->Unit(benchmark::kMicrosecond);

/// Every piece a run of its own: neighbouring boxes touch, all others are sorted out by the tree.
void count_crossings_of_many_runs(benchmark::State& state) {
  Contour contour = parabola(static_cast<std::size_t>(state.range(0)));
  contour.runs.clear();
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) contour.runs.push_back({i, i, -1});
  Certificate certificate;
  for (auto _ : state) certificate = certify(contour);
  state.counters["crossings"] = certificate.self_intersections;
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(count_crossings_of_many_runs)->Arg(1000)->Arg(100000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace obvid
