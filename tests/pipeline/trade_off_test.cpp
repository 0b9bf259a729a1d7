// SPDX-License-Identifier: Apache-2.0
// Eight tolerances and what each of them brings.
#include "obvid/pipeline/trade_off.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string_view>
#include <vector>

namespace obvid {
namespace {

constexpr double kNoise = 5e-4;

/// A quarter of an ellipse, which has no vertex inside, with noise of a known size.
PointSeries noisy_quarter() {
  std::mt19937_64 rng(7);
  PointSeries series;
  series.name = "quarter";
  for (int i = 0; i < 40; ++i) {
    const double t = 0.05 + 1.45 * i / 39.0;
    const double off = kNoise * (2.0 * static_cast<double>(rng() % 4096) / 4095.0 - 1.0);
    series.points.push_back({2.0 * std::cos(t) + off, std::sin(t) + off});
  }
  series.rounding = {1e-6, 1e-6};
  return series;
}

std::vector<TradeOffRow> rows_of(const std::vector<int>& vertices) {
  std::vector<TradeOffRow> rows;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    TradeOffRow row;
    row.tolerance = std::pow(10.0, static_cast<double>(i) - 6.0);
    row.formed = row.kept = row.proved = vertices[i] >= 0;
    row.vertices = vertices[i];
    rows.push_back(row);
  }
  return rows;
}

TEST(TradeOff, GivesTheRowsThatWereDoneWhenItIsCancelled) {
  const PointSeries series = noisy_quarter();
  double told = 0.0;
  const RunContext run([&told](std::string_view, double done) { told = done; },
                       [&told] { return told > 2.5 / 8.0; });
  TradeOff finished;
  const auto t = trade_off(series, {}, run, &finished);
  ASSERT_FALSE(t);
  EXPECT_EQ(t.error().code, ErrorCode::kCancelled);
  const auto whole = trade_off(series, {});
  ASSERT_TRUE(whole);
  ASSERT_EQ(finished.rows.size(), 2U);
  for (std::size_t i = 0; i < finished.rows.size(); ++i) {
    EXPECT_EQ(finished.rows[i].tolerance, whole->rows[i].tolerance);
    EXPECT_EQ(finished.rows[i].vertices, whole->rows[i].vertices);
  }
}

TEST(TradeOff, RunsFromTheRoundingToOnePercentInEqualRatios) {
  const PointSeries series = noisy_quarter();
  const auto t = trade_off(series, {});
  ASSERT_TRUE(t);
  ASSERT_EQ(t->rows.size(), 8U);
  EXPECT_DOUBLE_EQ(t->rows.front().tolerance, 1e-6);
  const double width = 2.0 * (std::cos(0.05) - std::cos(1.5));
  const double height = std::sin(1.5) - std::sin(0.05);
  EXPECT_NEAR(t->rows.back().tolerance, 0.01 * std::hypot(width, height), 2e-4);
  for (std::size_t k = 2; k < 8; ++k) {
    const double ratio = t->rows[k].tolerance / t->rows[k - 1].tolerance;
    EXPECT_NEAR(ratio / (t->rows[1].tolerance / t->rows[0].tolerance), 1.0, 0.02);
  }
}

TEST(TradeOff, EveryRowIsWhatFitSaysAtItsTolerance) {
  const PointSeries series = noisy_quarter();
  const auto t = trade_off(series, {});
  ASSERT_TRUE(t);
  for (const TradeOffRow& row : t->rows) {
    FitJob job;
    job.noise = row.tolerance;
    const auto made = fit(series, job);
    ASSERT_EQ(made.has_value(), row.formed);
    if (!made) continue;
    EXPECT_EQ(made->report.vertices, row.vertices);
    EXPECT_EQ(made->contour.pieces.size(), row.pieces);
    EXPECT_LE(row.largest_move, row.tolerance);
    EXPECT_LE(row.vertices_lower_bound, row.vertices);
  }
}

TEST(TradeOff, ManyVerticesBelowTheNoiseAndNoneAboveIt) {
  const auto t = trade_off(noisy_quarter(), {});
  ASSERT_TRUE(t);
  EXPECT_GT(t->rows.front().vertices, 10);
  const double moved = kNoise * std::sqrt(2.0);
  for (const TradeOffRow& row : t->rows) {
    if (row.tolerance < moved) continue;
    EXPECT_EQ(row.vertices, 0) << row.tolerance;
  }
  ASSERT_TRUE(t->recommended);
  const TradeOffRow& best = t->rows[*t->recommended];
  EXPECT_LT(best.tolerance, 10.0 * moved);
  EXPECT_GT(best.tolerance, 0.05 * moved);
}

TEST(TradeOff, RecommendsTheKnee) {
  EXPECT_EQ(recommended_row(rows_of({29, 20, 12, 3, 3, 3, 2, 1})), 3U);
  EXPECT_EQ(recommended_row(rows_of({10, 3, 3, 3, 3, 2, 1, 0})), 1U);
}

TEST(TradeOff, RecommendsTheSmallestToleranceWhereNothingIsSaved) {
  EXPECT_EQ(recommended_row(rows_of({2, 2, 2, 2, 2, 2, 2, 2})), 0U);
  EXPECT_EQ(recommended_row(rows_of({7, 6, 5, 4, 3, 2, 1, 0})), 0U);
}

TEST(TradeOff, RecommendsProvedRowsOnly) {
  EXPECT_EQ(recommended_row(rows_of({-1, -1, 9, 9, 3, 3, 3, 3})), 4U);
  EXPECT_FALSE(recommended_row(rows_of({-1, -1})));
  EXPECT_FALSE(recommended_row({}));
}

TEST(TradeOff, CoarselyPrintedFilesGetADecadeOfTolerances) {
  PointSeries series;
  for (int i = 0; i < 8; ++i) series.points.push_back({double(i), std::round(0.2 * i * i)});
  series.rounding = {0.5, 0.5};
  const auto t = trade_off(series, {});
  ASSERT_TRUE(t);
  EXPECT_DOUBLE_EQ(t->rows.front().tolerance, 0.5);
  EXPECT_DOUBLE_EQ(t->rows.back().tolerance, 5.0);
}

TEST(TradeOff, RefusesWhatNoToleranceMends) {
  PointSeries series;
  series.points = {{0.0, 0.0}};
  const auto t = trade_off(series, {});
  ASSERT_FALSE(t);
  EXPECT_EQ(t.error().code, ErrorCode::kTooFewPoints);
}

TEST(TradeOff, TheChartShowsBothCurvesAndTheRecommendation) {
  TradeOff t{"a & b", "mm", false, rows_of({5, 3, -1, 1}), 1};
  const std::string svg = trade_off_svg(t);
  EXPECT_NE(svg.find("a &amp; b"), std::string::npos);
  EXPECT_NE(svg.find("class=\"graph up\""), std::string::npos);
  EXPECT_NE(svg.find("class=\"curve down\""), std::string::npos);
  EXPECT_NE(svg.find("3 vertices"), std::string::npos);
  EXPECT_NE(svg.find("no proved contour"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  const std::string whole = trade_off_svg({"", "mm", false, rows_of({2, 1}), 0});
  EXPECT_EQ(whole.find("no proved contour"), std::string::npos);
}

}  // namespace
}  // namespace obvid
