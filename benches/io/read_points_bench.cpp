// SPDX-License-Identifier: Apache-2.0
// Time to turn a million lines into points, per notation, and a large contour file into a contour.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <iterator>
#include <random>
#include <string>

#include "obvid/io/contour_json.h"
#include "obvid/io/read_points.h"

namespace obvid {
namespace {

constexpr int kLines = 1'000'000;
constexpr int kPieces = 100'000;

// `pattern` takes x and y with nine digits, as measuring programs print them.
template <class Pattern>
std::string lines(const char* head, Pattern pattern) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-1e3, 1e3);
  std::string text = head;
  for (int i = 0; i < kLines; ++i) {
    fmt::format_to(std::back_inserter(text), pattern, coordinate(random), coordinate(random));
  }
  return text;
}

void parse(benchmark::State& state, const std::string& text) {
  for (auto step : state) {
    const auto series = parse_points(text, "bench");
    if (!series || series->points.size() != static_cast<std::size_t>(kLines)) {
      state.SkipWithError("not all points were read");
      break;
    }
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(text.size()));
}

void read_commas(benchmark::State& state) {
  parse(state, lines("x,y\n", FMT_STRING("{:.9g},{:.9g}\n")));
}
void read_blanks(benchmark::State& state) {
  parse(state, lines("", FMT_STRING("{:.9g} {:.9g}\n")));
}
void read_four_columns(benchmark::State& state) {
  parse(state, lines("# x_m,y_m,w_right_m,w_left_m\n", FMT_STRING("{:.9g},{:.9g},1.5,2.5\n")));
}
void read_headings(benchmark::State& state) {
  parse(state, lines("x,y,heading_deg\n", FMT_STRING("{:.9g},{:.9g},\n")));
}

StoredContour large_contour() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> number(0.0, 1e3);
  StoredContour stored;
  Contour& contour = stored.contour;
  for (int i = 0; i <= kPieces; ++i) {
    contour.points.push_back({number(random), number(random)});
    contour.joints.push_back({{contour.points.back(), number(random), number(random)}, {}, {}});
    if (i == kPieces) break;
    RationalBezier piece;
    piece.degree = 3;
    for (std::size_t j = 0; j < 4; ++j) {
      piece.offset[j] = {number(random), number(random)};
      piece.weight[j] = 1.0 + number(random);
    }
    contour.pieces.push_back(piece);
  }
  return stored;
}

void write_contour(benchmark::State& state) {
  const StoredContour stored = large_contour();
  for (auto step : state) benchmark::DoNotOptimize(contour_to_json(stored));
}

void read_contour(benchmark::State& state) {
  const std::string text = contour_to_json(large_contour());
  for (auto step : state) {
    if (!contour_from_json(text, "bench")) state.SkipWithError("the contour was not read");
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(text.size()));
}

BENCHMARK(read_commas)->Unit(benchmark::kMillisecond);
BENCHMARK(read_blanks)->Unit(benchmark::kMillisecond);
BENCHMARK(read_four_columns)->Unit(benchmark::kMillisecond);
BENCHMARK(read_headings)->Unit(benchmark::kMillisecond);
BENCHMARK(write_contour)->Unit(benchmark::kMillisecond);
BENCHMARK(read_contour)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace obvid
