// SPDX-License-Identifier: Apache-2.0
// One condensation, and a whole piece within a tolerance.
#include <benchmark/benchmark.h>

#include <cmath>

#include "obvid/contour/beziers.h"
#include "obvid/contour/clothoids.h"

namespace {

using namespace obvid;

/// Logarithmic spiral of growth 1.
Element log_spiral(double phi) {
  const double r = std::exp(phi);
  return {r * unit_at(phi), phi + std::atan2(1.0, 1.0), 1.0 / (r * std::sqrt(2.0))};
}

void condense_one_link(benchmark::State& state) {
  const Element a = log_spiral(0.0), b = log_spiral(0.3);
  for (auto _ : state) {
    const auto c = condense(a, b, -1);
    if (!c) return state.SkipWithError("no chain");
    state.counters["margin"] = c->margin;
  }
}
BENCHMARK(condense_one_link);

/// Tolerance 10^-range of the chord.
void condense_a_clothoid(benchmark::State& state) {
  const auto clothoid = clothoid_between({0, 0}, -0.4, {1, 0}, 0.6);
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  if (!clothoid) return state.SkipWithError("no clothoid");
  const int direction = clothoid->kappa1 > clothoid->kappa0 ? 1 : -1;
  for (auto _ : state) {
    const auto chain = condense_piece(*clothoid, direction, tolerance);
    if (!chain) return state.SkipWithError("no chain");
    state.counters["parabolas"] = static_cast<double>(chain->parabolas.size());
    state.counters["width"] = chain->width;
  }
}
BENCHMARK(condense_a_clothoid)->ArgName("digits")->Arg(3)->Arg(6)->Unit(benchmark::kMicrosecond);

}  // namespace
