// SPDX-License-Identifier: Apache-2.0
#include "obvid/series/analysis.h"
#include "../common/angles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace obvid {
namespace {

std::vector<Vec2> sample(int n, double from, double to, const std::function<Vec2(double)>& curve) {
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i) points.push_back(curve(from + (to - from) * i / (n - 1)));
  return points;
}

Vec2 sine(double x) { return {x, std::sin(x)}; }
Vec2 on_ellipse(double t) { return {2.0 * std::cos(t), std::sin(t)}; }
Vec2 log_spiral(double t) { return std::exp(0.2 * t) * unit_at(t); }

TEST(Analysis, AdjacentCirclesOfACircleAreThatCircle) {
  const auto points = sample(9, 0.0, 2.5, [](double t) {
    return Vec2{3.0, -1.0} + 4.0 * unit_at(t);
  });
  const auto circles = measure_circles(points, measure_chords(points));
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    EXPECT_NEAR(circles[i].kappa, 0.25, circles[i].rounding + 1e-16);
    EXPECT_NEAR(circles[i].eta_in, 0.5 * 2.5 / 8.0, 1e-14);
    EXPECT_NEAR(circles[i].eta_out, 0.5 * 2.5 / 8.0, 1e-14);
  }
}

TEST(Analysis, AdjacentCircleOfThreePointsInLineIsStraight) {
  const std::vector<Vec2> points = {{0, 0}, {1, 2}, {3, 6}, {4, 8}};
  const auto circles = measure_circles(points, measure_chords(points));
  for (const AdjacentCircle& c : circles) EXPECT_EQ(c.kappa, 0.0);
}

TEST(Analysis, ClockwiseCirclesHaveNegativeCurvature) {
  const std::vector<Vec2> points = {{-1, 0}, {0, 1}, {1, 0}};
  EXPECT_NEAR(measure_circles(points, measure_chords(points))[1].kappa, -1.0, 1e-15);
}

TEST(Analysis, ChordHeadingsAreUnwrapped) {
  const auto points = sample(60, 0.0, 15.0, [](double t) { return (1.0 + t) * unit_at(t); });
  const auto chords = measure_chords(points);
  for (std::size_t i = 1; i < chords.size(); ++i) {
    EXPECT_GT(chords[i].omega, chords[i - 1].omega);
    EXPECT_LT(chords[i].omega, chords[i - 1].omega + 0.5);
  }
}

TEST(Analysis, RoundingBoundsWhatHalfAnUlpMovesTheCurvature) {
  const auto exact = [](const long double(&c)[6]) {
    const long double ax = c[2] - c[0], ay = c[3] - c[1], bx = c[4] - c[2], by = c[5] - c[3];
    const long double dx = c[4] - c[0], dy = c[5] - c[1];
    return 2.0L * (ax * by - ay * bx) /
           (std::hypot(ax, ay) * std::hypot(bx, by) * std::hypot(dx, dy));
  };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  double most = 0.0;
  for (int round = 0; round < 2000; ++round) {
    const double offset = std::pow(10.0, 3.0 * (1.0 + unit(random)));
    const double t0 = unit(random), step = 0.3 * (1.1 + unit(random)), ratio = 1.5 + unit(random);
    std::vector<Vec2> points;
    for (const double t : {t0, t0 + step, t0 + step * (1.0 + ratio)}) {
      points.push_back(Vec2{offset, -0.7 * offset} + unit_at(t));
    }
    const auto circle = measure_circles(points, measure_chords(points))[1];
    for (int signs = 0; signs < 64; ++signs) {
      long double c[6];
      for (int j = 0; j < 6; ++j) {
        const Vec2 p = points[static_cast<std::size_t>(j / 2)];
        const long double value = j % 2 == 0 ? p.x : p.y;
        c[j] = value * (1.0L + ((signs >> j) & 1 ? 0x1p-53L : -0x1p-53L));
      }
      const double moved = static_cast<double>(std::abs(exact(c) - circle.kappa));
      ASSERT_LE(moved, circle.rounding);
      most = std::max(most, moved / circle.rounding);
    }
  }
  EXPECT_GT(most, 0.2);  // a bound, but not a careless one
}

TEST(Analysis, SpiralHasOneRunAndNoVertex) {
  const auto a = analyse(sample(15, 0.0, 6.0, log_spiral)).value();
  EXPECT_EQ(a.vertices, 0);
  EXPECT_EQ(a.vertices_lower_bound, 0);
  EXPECT_EQ(a.inflections, 0);
  ASSERT_EQ(a.runs.size(), 1u);
  EXPECT_EQ(a.runs[0].direction, -1);
  EXPECT_TRUE(a.rounding_decided.empty());
}

TEST(Analysis, SpiralStaysBetweenTheArcsOfItsAdjacentCircles) {
  const int n = 15;
  const auto points = sample(n, 0.0, 6.0, log_spiral);
  const auto a = analyse(points).value();
  for (std::size_t i = 1; i + 2 < points.size(); ++i) {
    double top = 0.0;
    const Vec2 u = (points[i + 1] - points[i]) / a.chords[i].length;
    for (int j = 0; j <= 200; ++j) {
      const Vec2 p = log_spiral(6.0 / (n - 1) * (static_cast<double>(i) + j / 200.0));
      top = std::max(top, std::abs(cross(u, p - points[i])));
    }
    const double before = sagitta(a.circles[i].kappa, a.chords[i].length);
    const double after = sagitta(a.circles[i + 1].kappa, a.chords[i].length);
    EXPECT_LT(top, before) << i;
    EXPECT_GT(top, after * (1.0 - 1e-4)) << i;
    EXPECT_NEAR(a.points_only_error[i], before - after, 1e-14) << i;
  }
  EXPECT_TRUE(std::isnan(a.points_only_error.front()));
  EXPECT_TRUE(std::isnan(a.points_only_error.back()));
}

TEST(Analysis, PointsOnlyErrorReachesOverArcsOfMoreThanHalfACircle) {
  // over the chord from (0, 0) to (2, 0): three quarters of a circle of radius sqrt 2 around (1,
  // -1), and a sixth of one of radius 2 around (1, sqrt 3); their heights below it by Pythagoras
  const auto on = [](Vec2 centre, double radius, double degrees) {
    return centre + radius * unit_at(degrees * kPi / 180.0);
  };
  const Vec2 small{1.0, -1.0}, large{1.0, std::sqrt(3.0)};
  const auto before = on(small, std::sqrt(2.0), 120.0);
  const double expected = (std::sqrt(2.0) + 1.0) - (2.0 - std::sqrt(3.0));
  const auto near = analyse({before, {0, 0}, {2, 0}, on(large, 2.0, -55.0)}).value();
  EXPECT_NEAR(near.points_only_error[1], expected, 1e-13);  // the chords turn by 175 degrees
  // by 182.5: no curve turns by less than half a turn through these points
  const auto far = analyse({before, {0, 0}, {2, 0}, on(large, 2.0, -40.0)}).value();
  EXPECT_TRUE(std::isnan(far.points_only_error[1]));
}

TEST(Analysis, ALineBesideAnArcRisesToItsCurvature) {
  // a line of 4 points and an arc of radius 0.5 that touches it, of which the line has the first
  std::vector<Vec2> points{{-3.0, 0.1}, {-2.0, 0.1}, {-1.0, 0.1}, {0.0, 0.1}};
  for (int i = 1; i <= 5; ++i) {
    const double t = 0.3 * i;
    points.push_back({0.5 * std::sin(t), 0.6 - 0.5 * std::cos(t)});
  }
  for (const double back : {1.0, 0.1, 1e-3}) {  // coordinates that round differently
    for (const double turned : {0.0, 0.4, 1.1, 2.5, 4.0}) {
      std::vector<Vec2> moved = points;
      for (Vec2& p : moved) p = back * complex_product(p, unit_at(turned));
      const auto a = analyse(moved).value();
      EXPECT_EQ(a.direction[3], 1) << back << ' ' << turned;
      EXPECT_EQ(a.change[3], 1) << back << ' ' << turned;
      EXPECT_EQ(a.vertices, 0) << back << ' ' << turned;
    }
  }
}

TEST(Analysis, DirectionsThatRoundingDecidesAreUndecidedAndCountForNothing) {
  // two sides of a polygon, an ulp or so beside the lines: a triangle of a drawing
  const std::vector<Vec2> points{{0, 0},
                                 {1.6843055207991688e-09, -5.4187872047280697e-09},
                                 {3.3686110415983376e-09, -1.0837574409456139e-08},
                                 {5.0529165623975064e-09, -1.6256361614184208e-08},
                                 {8.5457935657803781e-09, -1.2199523595180838e-08},
                                 {1.203867056916325e-08, -8.1426855761774692e-09},
                                 {1.5531547572546121e-08, -4.0858475571740989e-09},
                                 {1.0354365048364079e-08, -2.7238983714493996e-09}};
  const auto a = analyse(points).value();
  EXPECT_EQ(a.change[2], 1);  // from the side into the corner, whatever the last digits are
  EXPECT_EQ(a.change[3], -1);
  EXPECT_FALSE(a.change[4]);
  EXPECT_EQ(a.change[5], 1);
  EXPECT_GE(a.rounding_decided.size(), 1U);
  EXPECT_EQ(a.vertices, 2);  // up, down, up
  EXPECT_EQ(a.inflections, 0);
}

TEST(Analysis, EllipseForcesAtMostItsFourVertices) {
  for (const int n : {13, 24, 50, 101, 400}) {
    // from inside a quarter to the same place: all four vertices lie inside
    const auto a = analyse(sample(n, 0.7, 0.7 + 2.0 * kPi, on_ellipse)).value();
    EXPECT_LE(a.vertices_lower_bound, 4) << n;
    EXPECT_LE(a.vertices, 4) << n;
    EXPECT_EQ(a.inflections, 0) << n;
    EXPECT_EQ(a.inflections_lower_bound, 0) << n;
    if (n < 24) continue;  // coarser samples may hide one
    EXPECT_EQ(a.vertices, 4) << n;
    EXPECT_EQ(a.vertices_lower_bound, 4) << n;
  }
}

TEST(Analysis, SineForcesAtMostItsInflectionsAndVertices) {
  for (const int n : {23, 40, 101, 500}) {
    const auto a = analyse(sample(n, 0.3, 4.0 * kPi - 0.4, sine)).value();
    EXPECT_EQ(a.inflections, 3) << n;
    EXPECT_LE(a.inflections_lower_bound, 3) << n;
    EXPECT_LE(a.vertices_lower_bound, 4) << n;
    EXPECT_EQ(a.vertices, 4) << n;
    if (n < 40) continue;
    EXPECT_EQ(a.inflections_lower_bound, 3) << n;
  }
}

TEST(Analysis, LowerBoundsNeverExceedWhatTheCurveHas) {
  // random samples of y = sin x on [0.3, 9]: extrema at pi/2, 3pi/2, 5pi/2; inflections pi, 2pi
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.3, 9.0);
  for (int round = 0; round < 300; ++round) {
    std::vector<double> x(12 + round % 30);
    for (double& v : x) v = unit(random);
    std::sort(x.begin(), x.end());
    std::vector<Vec2> points;
    for (const double v : x) points.push_back(sine(v));
    const auto a = analyse(points);
    if (!a) continue;
    EXPECT_LE(a->vertices_lower_bound, 3);
    EXPECT_LE(a->inflections_lower_bound, 2);
  }
}

TEST(Analysis, CocircularAndCollinearPointsAreStretches) {
  std::vector<Vec2> points = {{-3, 1}, {-2, 1}, {-1, 1}, {0, 1}};
  for (int i = 1; i <= 5; ++i) points.push_back({std::sin(0.2 * i), std::cos(0.2 * i)});
  const auto a = analyse(points).value();
  ASSERT_EQ(a.stretches.size(), 2u);
  EXPECT_EQ(a.stretches[0].first, 0u);
  EXPECT_EQ(a.stretches[0].last, 3u);
  EXPECT_EQ(a.stretches[0].kappa, 0.0);
  EXPECT_EQ(a.stretches[1].last, 8u);
  EXPECT_NEAR(a.stretches[1].kappa, -1.0, 1e-14);
  EXPECT_EQ(a.direction[0], 0);
  EXPECT_EQ(a.direction[7], 0);
  EXPECT_EQ(a.points_only_error[1], 0.0);
}

TEST(Analysis, CloseCocircularPointsFarFromTheOriginLeaveCurvesOpen) {
  const auto on = [](Vec2 centre, double degrees) {
    return centre + 10.0 * unit_at(degrees * kPi / 180.0);
  };
  // the middle two 1e-4 apart: rounding of coordinates of 5e6 turns the chord between them by 1e-5
  const Vec2 away{3e6, 4e6}, near{3.0, 4.0};
  const auto far = analyse({on(away, 0.0), on(away, 15.0), on(away, 15.0006), on(away, 30.0)});
  ASSERT_EQ(far->stretches.size(), 1u);
  EXPECT_NE(far->points_only_error[1], 0.0);
  EXPECT_TRUE(std::isnan(far->points_only_error[0]));
  EXPECT_TRUE(std::isnan(far->points_only_error[2]));
  const auto even = analyse({on(near, 0.0), on(near, 10.0), on(near, 20.0), on(near, 30.0)});
  for (const double error : even->points_only_error) EXPECT_EQ(error, 0.0);
}

TEST(Analysis, ComputedPointsOfACircleAreOneStretch) {
  std::mt19937_64 rng(5);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  for (int trial = 0; trial < 300; ++trial) {
    const double radius = std::pow(10.0, 3.0 * draw(rng)), start = 4.0 * draw(rng);
    const double x = trial % 3 == 0 ? 2.0 * radius * draw(rng) : 0.0, y = trial % 2 == 0 ? x : 0.0;
    const int n = 17 + static_cast<int>(12.0 * draw(rng));
    const double step = (trial % 4 == 0 ? 3.0 + 2.9 * draw(rng) : 2.0 * kPi * (n - 1) / n) / (n - 1);
    std::vector<Vec2> points;
    for (int i = 0; i < n; ++i) {
      const double t = start + i * step;
      points.push_back({x + radius * std::cos(t), y + radius * std::sin(t)});
    }
    const auto a = analyse(points).value();
    ASSERT_EQ(a.stretches.size(), 1u) << trial;
    EXPECT_EQ(a.stretches[0].first, 0u) << trial;
    EXPECT_EQ(a.stretches[0].last + 1, points.size()) << trial;
  }
}

TEST(Analysis, ThreePointsAreOneCircleAndTwoALine) {
  const auto three = analyse({{-1, 0}, {0, 1}, {1, 0}}).value();
  ASSERT_EQ(three.stretches.size(), 1u);
  EXPECT_NEAR(three.stretches[0].kappa, -1.0, 1e-15);
  const auto two = analyse({{0, 0}, {3, 4}}).value();
  ASSERT_EQ(two.stretches.size(), 1u);
  EXPECT_EQ(two.stretches[0].kappa, 0.0);
  EXPECT_EQ(two.chords[0].length, 5.0);
}

TEST(Analysis, TurningBackIsE402AndNamesThePoint) {
  const auto a = analyse({{0, 0}, {1, 0}, {2, 0.1}, {1, 0.1}, {0, 1}});
  ASSERT_FALSE(a);
  EXPECT_EQ(a.error().code, ErrorCode::kChordReversal);
  EXPECT_EQ(a.error().index, 2);
}

TEST(Analysis, MeasuresPointsThatTurnBackAsCircles) {
  // two chords of length 1 that turn by 175 degrees: their circle has the radius
  // 1 / (2 sin(87.5 deg))
  constexpr double kSharpTurn = 175.0 * std::numbers::pi / 180.0;
  const std::vector<Vec2> points = {
      {0.0, 0.0}, {1.0, 0.0}, {1.0 + std::cos(kSharpTurn), std::sin(kSharpTurn)}};
  ASSERT_FALSE(analyse(points));
  const auto measured = measure_series(points);
  ASSERT_TRUE(measured);
  EXPECT_NEAR(measured->largest_turning, kSharpTurn, 1e-15);
  EXPECT_NEAR(measured->circles[1].kappa, 2.0 * std::sin(0.5 * kSharpTurn), 1e-13);
}

TEST(Analysis, SizesBeyondDoublesAreE309) {
  const auto a = analyse({{0, 0}, {1e-120, 0}, {2e-120, 1e-120}});
  ASSERT_FALSE(a);
  EXPECT_EQ(a.error().code, ErrorCode::kSizeOutOfRange);
}

TEST(Analysis, ScaleAndMirrorLeaveTheCountsAlone) {
  const auto points = sample(40, 0.3, 11.0, sine);
  const auto a = analyse(points).value();
  for (const double scale : {0x1p-60, 0x1p40}) {
    auto moved = points;
    for (Vec2& p : moved) p = {scale * p.x, -scale * p.y};
    const auto b = analyse(moved).value();
    EXPECT_EQ(b.vertices_lower_bound, a.vertices_lower_bound);
    EXPECT_EQ(b.inflections_lower_bound, a.inflections_lower_bound);
    for (std::size_t i = 0; i < a.circles.size(); ++i) {
      EXPECT_EQ(b.circles[i].kappa * scale, -a.circles[i].kappa) << i;
    }
  }
}

TEST(Analysis, SagittaIsTheHeightOfTheArc) {
  EXPECT_NEAR(sagitta(1.0, 2.0), 1.0, 1e-15);
  EXPECT_NEAR(sagitta(-0.5, 2.0), -(2.0 - std::sqrt(3.0)), 1e-15);
  EXPECT_EQ(sagitta(0.0, 2.0), 0.0);
  EXPECT_NEAR(sagitta(1e-9, 1.0), 0.125e-9, 1e-24);
}

/// The first and the last of them nearly meet: they tell little of the circle.
TEST(Analysis, PointsOfNearlyAWholeCircleAreOneStretch) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  for (int trial = 0; trial < 300; ++trial) {
    const double radius = std::pow(10.0, 12.0 * any(random) - 6.0), from = 6.3 * any(random);
    const int count = 5 + static_cast<int>(20.0 * any(random));
    const double step = (2.0 * std::numbers::pi - 0.02 * any(random)) / (count - 1);
    std::vector<Vec2> points;
    for (int i = 0; i < count; ++i) points.push_back(radius * unit_at(from + i * step));
    const auto a = analyse(points);
    ASSERT_TRUE(a) << to_line(a.error());
    ASSERT_EQ(a->stretches.size(), 1U) << trial;
    EXPECT_EQ(a->stretches[0].first, 0U) << trial;
    EXPECT_EQ(a->stretches[0].last + 1, points.size()) << trial;
  }
}

/// Where rounding makes circles equal to the last bit beside a stretch, the curve has some way to go.
TEST(Analysis, OnlyChordsOfStretchesHaveNoDirection) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int between = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const double blur = std::pow(10.0, -13.0 - 3.0 * std::abs(any(random)));
    const double most = trial % 3 == 0 ? -4.0 : 0.0;
    double along = 3.0 * any(random);
    std::vector<Vec2> points;
    for (int i = 0; i < 6; ++i, along += std::pow(10.0, most * std::abs(any(random)))) {
      points.push_back((1.0 + (trial % 2 == 0 ? blur * any(random) : 0.0)) * unit_at(along));
    }
    const auto a = analyse(points);
    ASSERT_TRUE(a) << to_line(a.error());
    for (std::size_t i = 0; i < a->direction.size(); ++i) {
      const bool inside =
          std::any_of(a->stretches.begin(), a->stretches.end(),
                      [i](const auto& s) { return i >= s.first && i < s.last; });
      EXPECT_EQ(a->direction[i] == 0, inside) << trial << ", chord " << i + 1;
      between += !inside && !a->stretches.empty() ? 1 : 0;
    }
  }
  EXPECT_GT(between, 0);
}

}  // namespace
}  // namespace obvid
