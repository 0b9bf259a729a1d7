// SPDX-License-Identifier: Apache-2.0
// Time of forming and evaluating integro-differential splines, and with --tables their errors:
//   bench_idspline --tables [folder of published series]
#include <benchmark/benchmark.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "methods.h"
#include "obvid/idspline/internal/id_spline.h"
#include "obvid/idspline/internal/id_spline_2d.h"
#include "obvid/idspline/internal/scalar_cubic.h"

namespace {

using namespace obvid;

constexpr std::size_t kNodes = 10000;

IdSplineData wave() {
  IdSplineData data;
  for (std::size_t i = 0; i < kNodes; ++i) {
    const double k = static_cast<double>(i);
    data.nodes.push_back(0.03 * k + 0.008 * std::sin(7.0 * k));
    data.values.push_back(std::sin(data.nodes.back()));
  }
  return data;
}

void form(benchmark::State& state) {
  const IdSplineData data = wave();
  const IdSplineOptions options{static_cast<int>(state.range(0)),
                                static_cast<IdSmoothing>(state.range(1))};
  for (auto _ : state) {
    const auto spline = id_spline(data, options);
    if (!spline) return state.SkipWithError("no spline");
    benchmark::DoNotOptimize(spline->values.data());
  }
}
BENCHMARK(form)
    ->ArgNames({"degree", "smoothing"})
    ->Args({2, 0})
    ->Args({2, 2})
    ->Args({4, 0})
    ->Args({4, 1})
    ->Args({4, 2})
    ->Args({6, 0})
    ->Args({6, 1})
    ->Args({6, 2})
    ->Unit(benchmark::kMicrosecond);

void form_global_cubic(benchmark::State& state) {
  const IdSplineData data = wave();
  for (auto _ : state) {
    const auto spline = global_cubic_by_slopes(data.nodes, data.values);
    if (!spline) return state.SkipWithError("no spline");
    benchmark::DoNotOptimize(spline->slopes.data());
  }
}
BENCHMARK(form_global_cubic)->Unit(benchmark::kMicrosecond);

/// Ten places per cell, ascending.
void values_in_order(benchmark::State& state) {
  const auto spline = id_spline(wave(), {static_cast<int>(state.range(0)), IdSmoothing::kNone});
  if (!spline) return state.SkipWithError("no spline");
  std::vector<double> x(10 * kNodes), out(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = spline->nodes.back() * static_cast<double>(i) / static_cast<double>(x.size());
  }
  for (auto _ : state) {
    evaluate_sorted(*spline, x, out);
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["per_value"] = benchmark::Counter(
      static_cast<double>(x.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(values_in_order)
    ->ArgName("degree")
    ->Arg(2)
    ->Arg(4)
    ->Arg(6)
    ->Unit(benchmark::kMicrosecond);

void form_grid(benchmark::State& state) {
  IdSpline2dData data;
  for (int i = 0; i < 300; ++i) data.x.push_back(0.01 * i);
  data.y = data.x;
  for (const double y : data.y) {
    for (const double x : data.x) data.values.push_back(std::exp(-x * x - y * y));
  }
  for (auto _ : state) {
    const auto spline = id_spline_2d(data, state.range(0) != 0);
    if (!spline) return state.SkipWithError("no spline");
    benchmark::DoNotOptimize(spline->cells.data());
  }
}
BENCHMARK(form_grid)->ArgName("smooth")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "--tables") {
    bench::print_convergence();
    bench::print_two_variables();
    bench::print_curves();
    if (argc > 2) bench::print_overshoot(argv[2]);
    return 0;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
