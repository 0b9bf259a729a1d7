// SPDX-License-Identifier: Apache-2.0
// One biarc: through two elements with a given first curvature, and with its choice.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "obvid/contour/arcs.h"
#include "obvid/region/internal/segment_region.h"

namespace obvid {
namespace {

struct Segment {
  Element start, end;
};

/// Neighbouring elements of a logarithmic spiral: increasing curvature, turns of 0.1 to 1 rad.
std::vector<Segment> segments() {
  const auto at = [](double t) {
    constexpr double kGrowth = 0.2;
    const double r = std::exp(-kGrowth * t);
    return Element{{r * std::cos(t), r * std::sin(t)},
                   t + std::atan2(1.0, -kGrowth),
                   1.0 / (r * std::sqrt(1.0 + kGrowth * kGrowth))};
  };
  std::vector<Segment> out;
  double t = 0.0;
  for (int k = 0; k < 64; ++k) {
    const double next = t + 0.1 + 0.9 * k / 63.0;
    out.push_back({at(t), at(next)});
    t = next;
  }
  return out;
}

void biarc_given(benchmark::State& state) {
  const auto all = segments();
  std::vector<BiarcCurvatures> chosen;
  for (const Segment& s : all) {
    chosen.push_back(*choose_biarc(chord_frame(s.start, s.end), 1));
  }
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(biarc(all[i].start, all[i].end, chosen[i]));
    i = (i + 1) % all.size();
  }
}
BENCHMARK(biarc_given);

void biarc_chosen(benchmark::State& state) {
  const auto all = segments();
  std::size_t i = 0;
  for (auto _ : state) {
    const auto chosen = choose_biarc(chord_frame(all[i].start, all[i].end), 1);
    benchmark::DoNotOptimize(biarc(all[i].start, all[i].end, *chosen));
    i = (i + 1) % all.size();
  }
}
BENCHMARK(biarc_chosen);

}  // namespace
}  // namespace obvid
