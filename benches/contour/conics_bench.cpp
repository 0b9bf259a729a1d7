// SPDX-License-Identifier: Apache-2.0
// The weight chain, and freeing the headings for it.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "obvid/contour/conics.h"

namespace {

using namespace obvid;

/// Logarithmic spiral with headings a little off, as a chain of conics meets them.
std::vector<Element> spiral(std::size_t n, double off) {
  std::vector<Element> elements(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double k = static_cast<double>(i), t = 0.1 * k;
    const double r = std::exp(0.3 * t);
    const double kappa = 1.0 / (r * std::hypot(1.0, 0.3));
    elements[i] = {r * unit_at(t), t + std::atan2(1.0, 0.3) + off * std::sin(5.0 * k), kappa};
  }
  return elements;
}

void weight_chain(benchmark::State& state) {
  const auto elements = spiral(static_cast<std::size_t>(state.range(0)), 0.0);
  bool good = true;
  for (auto _ : state) {
    const auto chain = conic_chain(elements);
    good = good && chain && chain->elliptic;
  }
  if (!good) state.SkipWithError("not elliptic");
}
BENCHMARK(weight_chain)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMicrosecond);

void freed_headings(benchmark::State& state) {
  const auto elements = spiral(static_cast<std::size_t>(state.range(0)), 1e-3);
  bool good = true;
  for (auto _ : state) {
    const auto found = headings_for_conics(elements);
    good = good && found;
  }
  if (!good) state.SkipWithError("not found");
}
BENCHMARK(freed_headings)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace
