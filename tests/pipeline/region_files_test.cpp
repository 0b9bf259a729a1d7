// SPDX-License-Identifier: Apache-2.0
// The worksheet's drawing and its LaTeX.
#include "obvid/pipeline/internal/region_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <variant>
#include <vector>

#include "obvid/core/units.h"

namespace obvid {
namespace {

/// Three points on the unit circle, 130 degrees apart, and one farther out.
PointSeries coarse_spiral(double size) {
  PointSeries series;
  series.points = {{size, 0.0},
                   {size * std::cos(130.0 * kOneDegree), size * std::sin(130.0 * kOneDegree)},
                   {size * std::cos(260.0 * kOneDegree), size * std::sin(260.0 * kOneDegree)},
                   {2.0 * size, 0.5 * size}};
  return series;
}

const SketchLayer* layer_of(const RegionDrawing& drawing, const std::string& name) {
  for (const SketchLayer& layer : drawing.sketch.layers) {
    if (layer.name == name) return &layer;
  }
  return nullptr;
}

TEST(RegionDrawing, AdjacentCirclesGoThroughTheirPointHoweverFarTheyTurn) {
  const PointSeries series = coarse_spiral(1.0);
  RegionJob job;
  job.job.find_corners = false;
  const auto table = region_table(series, job);
  ASSERT_TRUE(table) << table.error().what;
  const RegionDrawing drawing = region_drawing(series, *table);
  const SketchLayer* circles = layer_of(drawing, "ADJACENT_CIRCLES");
  ASSERT_TRUE(circles);
  ASSERT_EQ(circles->pieces.size(), 2u);
  const auto& arc = std::get<ArcPiece>(circles->pieces.front());
  EXPECT_NEAR(arc.kappa, 1.0, 1e-14);
  EXPECT_NEAR(arc.length, 260.0 * kOneDegree, 1e-13);
  const Vec2 halfway = evaluate(circles->pieces.front(), 0.5).point;
  EXPECT_NEAR(norm(halfway - series.points[1]), 0.0, 1e-14);
}

/// Numbers of a text, those inside words too.
std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> out;
  for (std::size_t at = text.find("& "); at != std::string::npos; at = text.find("& ", at + 1)) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str() + at + 2, &end);
    if (end != text.c_str() + at + 2) out.push_back(value);
  }
  return out;
}

TEST(RegionLatex, TellsAsManyDigitsOfSmallSeriesAsOfLargeOnes) {
  constexpr double kSmall = 1e-9;
  RegionJob job;
  job.job.find_corners = false;
  const auto large = region_table(coarse_spiral(1.0), job);
  const auto small = region_table(coarse_spiral(kSmall), job);
  ASSERT_TRUE(large && small);
  const auto a = numbers_of(region_latex(coarse_spiral(1.0), *large)),
             b = numbers_of(region_latex(coarse_spiral(kSmall), *small));
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 40u);
  std::size_t lengths = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool angle = std::abs(a[i] - b[i]) <= 0.002;  // told to a thousandth of a degree
    if (angle && std::abs(a[i]) > 0.01) continue;
    ++lengths;
    EXPECT_NEAR(b[i] / kSmall, a[i], 2e-4 + 1e-6 * std::abs(a[i])) << i;
  }
  EXPECT_GT(lengths, 20u);
}

}  // namespace
}  // namespace obvid
