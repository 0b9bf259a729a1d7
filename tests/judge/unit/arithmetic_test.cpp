// SPDX-License-Identifier: Apache-2.0
// The judge's own mathematics against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "drawing.h"
#include "ends.h"
#include "monotone.h"
#include "region.h"

namespace judge {
namespace {

Bezier bezier(std::vector<Point> points, std::vector<double> weights = {}) {
  Bezier out;
  out.rounded = out.offset = points;
  out.weight = weights.empty() ? std::vector<double>(points.size(), 1.0) : weights;
  return out;
}

TEST(JudgeArithmetic, AParabolaHasItsVertexInTheMiddle) {
  const CurvatureLaw law = curvature_law(bezier({{-1, 1}, {0, -1}, {1, 1}}));
  EXPECT_TRUE(law.decided);
  EXPECT_EQ(law.signs, (std::vector<int>{1, -1}));
  ASSERT_EQ(law.turns.size(), 1U);
  EXPECT_LE(law.turns[0].from, 0.5);
  EXPECT_GE(law.turns[0].to, 0.5);
  EXPECT_EQ(slope_sign(bezier({{-1, 1}, {0, -1}, {1, 1}}), 0.5), 0);
}

TEST(JudgeArithmetic, AQuarterOfAnEllipseIsMonotoneAndOfACircleConstant) {
  // weights 1, 1, 2 are exact: both vertices are at the ends
  EXPECT_EQ(curvature_law(bezier({{2, 0}, {2, 1}, {0, 1}}, {1, 1, 2})).signs, std::vector<int>{-1});
  EXPECT_EQ(curvature_law(bezier({{1, 0}, {1, 1}, {0, 1}}, {1, 1, 2})).signs, std::vector<int>{0});
}

TEST(JudgeArithmetic, ACircleInDoublesIsNotConstantAndIsDecided) {
  const double w = std::numbers::sqrt2 / 2.0;  // rounded: a conic, 1e-17 beside the circle
  const CurvatureLaw law = curvature_law(bezier({{1, 0}, {1, 1}, {0, 1}}, {1, w, 1}));
  EXPECT_TRUE(law.decided);
  EXPECT_EQ(law.signs.size(), 2U);  // symmetric: its vertex is in the middle
}

TEST(JudgeArithmetic, SlopesOfCurvatureAreThoseOfParabolaAndEllipse) {
  // y = x^2: kappa = 2 (1 + 4 x^2)^(-3/2), d kappa/ds = -24 x/(1 + 4 x^2)^3
  const Piece parabola = bezier({{-1, 1}, {0, -1}, {1, 1}});
  for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const double x = 2.0 * t - 1.0;
    EXPECT_NEAR(static_cast<double>(slope_at(parabola, t).middle()),
                -24.0 * x / std::pow(1.0 + 4.0 * x * x, 3.0), 1e-15);
  }
  // a quarter of the ellipse (2 cos, sin), at (1.2, 0.8): -3 a b (a^2 - b^2) sin cos/(...)^3
  const Piece ellipse = bezier({{2, 0}, {2, 1}, {0, 1}}, {1, 1, 2});
  EXPECT_NEAR(static_cast<double>(slope_at(ellipse, 0.5).middle()),
              -3.0 * 2.0 * 3.0 * 0.48 / std::pow(4.0 * 0.64 + 0.36, 3.0), 1e-15);
}

TEST(JudgeArithmetic, ACuspIsNotRegular) {
  // control polygon of a cross: the derivative is zero at t = 1/2
  EXPECT_FALSE(curvature_law(bezier({{0, 0}, {1, 1}, {0, 1}, {1, 0}})).regular);
  EXPECT_TRUE(curvature_law(bezier({{0, 0}, {1, 1}, {0.1, 1}, {1, 0}})).regular);
}

TEST(JudgeArithmetic, EndsOfAClothoidAreFresnelIntegrals) {
  // C(1) and S(1) with the phase pi s^2 / 2 (Abramowitz and Stegun, table 7.7)
  const Clothoid c{{0, 0}, {0.78, 0.44}, 0.0, 0.0, std::numbers::pi, 1.0};
  const End end = end_of(c);
  EXPECT_NEAR(static_cast<double>(end.point.x.middle()), 0.7798934003768228, 1e-15);
  EXPECT_NEAR(static_cast<double>(end.point.y.middle()), 0.4382591473903548, 1e-15);
  EXPECT_LT(end.point.x.upper() - end.point.x.lower(), 1e-15);
  const Vec p = Span(c, {}).point(1.0L);
  EXPECT_NEAR(static_cast<double>(p.x - end.point.x.middle()), 0.0, 1e-18);
  EXPECT_NEAR(static_cast<double>(p.y - end.point.y.middle()), 0.0, 1e-18);
}

TEST(JudgeArithmetic, EndsOfABezierAgreeWithItsJets) {
  const Bezier b = bezier({{0, 0}, {1, 0.2}, {2, 1}, {2.4, 2}, {2.5, 3}}, {1, 0.9, 0.95, 1.1, 1.2});
  const Span span(b, {});
  for (const auto& [end, t] : {std::pair{start_of(b), 0.0L}, std::pair{end_of(b), 1.0L}}) {
    const Jet jet = span.at(t);
    EXPECT_NEAR(static_cast<double>(end.kappa.middle() - jet.kappa()), 0.0, 1e-16);
    EXPECT_NEAR(static_cast<double>(std::atan2(end.tangent.y.middle(), end.tangent.x.middle()) -
                                    std::atan2(jet.d.y, jet.d.x)),
                0.0, 1e-16);
  }
}

TEST(JudgeArithmetic, ARegionHoldsTheClothoidWithItsElements) {
  const Clothoid c{{0, 0}, {0, 0}, 0.3, 0.1, 1.4, 1.0};
  const Span span(c, {});
  const auto element = [&](Real t) {
    const Jet jet = span.at(t);
    return Element{jet.p, std::atan2(jet.d.y, jet.d.x), jet.kappa()};
  };
  const auto region = Region::of(element(0.0L), element(1.0L), 1);
  ASSERT_TRUE(region.has_value());
  for (int k = 0; k <= 100; ++k) {
    const Vec p = span.point(k / 100.0L);
    EXPECT_LE(static_cast<double>(region->outside(p)), 1e-17) << k;
    EXPECT_LE(static_cast<double>(region->farther(p)), static_cast<double>(region->width()));
  }
  EXPECT_GT(static_cast<double>(region->outside({0.4L, 0.4L})), 0.1);
  // widths are of third order in the step
  const Real half = Region::of(element(0.0L), element(0.5L), 1)->width();
  EXPECT_NEAR(static_cast<double>(region->width() / half), 8.0, 1.0);
  // no curve of falling curvature has these elements
  EXPECT_FALSE(Region::of(element(0.0L), element(1.0L), -1).has_value());
}

TEST(JudgeArithmetic, ElementsThatNoShortCurveJoinsHaveNoRegion) {
  // Vogt: increasing curvature ends steeper over its chord than it begins; this does not, by 1e-5
  const Element from{{0.0L, 0.0L}, -0.44284L, 0.8L}, to{{1.0L, 0.0L}, 0.44283L, 0.9L};
  EXPECT_FALSE(Region::of(from, to, 1).has_value());
  const Element steeper{{1.0L, 0.0L}, 0.44285L, 0.9L};
  EXPECT_TRUE(Region::of(from, steeper, 1).has_value());
}

TEST(JudgeArithmetic, APartOfASpanTurnsByItsPart) {
  const Span arc({0.0L, 0.0L}, 0.3L, 2.0L, 1.5L);  // 3 rad
  EXPECT_NEAR(static_cast<double>(arc.turning()), 3.0, 1e-15);
  EXPECT_NEAR(static_cast<double>(arc.turning(0.25L, 0.5L)), 0.75, 1e-15);
  // y = x^2 from x = 0 to 1: atan 2 in all, atan 1 to its middle
  const Span parabola({{0.0L, 0.0L}, {0.5L, 0.0L}, {1.0L, 1.0L}}, {1.0L, 1.0L, 1.0L});
  EXPECT_NEAR(static_cast<double>(parabola.turning(0.0L, 0.5L)), std::atan(1.0), 1e-15);
  EXPECT_NEAR(static_cast<double>(parabola.turning()), std::atan(2.0), 1e-15);
}

TEST(JudgeArithmetic, PlacesOfAHairpinLieOnIt) {
  const std::vector<Real> one(4, 1.0L);
  const Span start(
      {{0.0L, 0.0L}, {-18411.0L, 9879.0L}, {-22735.0L, 12548.0L}, {-20203.0L, 11639.0L}}, one);
  const Span tip(
      {{-20203.0L, 11639.0L}, {-17602.0L, 10705.0L}, {-7769.0L, 5996.0L}, {1464.0L, 1446.0L}}, one);
  const Path path({start, tip});
  for (int k = 0; k <= 400; ++k) {
    const Real order = path.end() * k / 400;
    EXPECT_LT(static_cast<double>(path.nearest(path.at(order)).distance), 1e-6) << k;
  }
}

TEST(JudgeArithmetic, DistancesFromArcsAreThoseFromCircles) {
  const BoundaryArc arc{
      {0, 0}, {2, 0}, std::numbers::pi_v<Real> / 2, -1.0L, -std::numbers::pi_v<Real>};
  EXPECT_NEAR(static_cast<double>(arc.distance({1.0L, 3.0L})), 2.0, 1e-17);
  EXPECT_NEAR(static_cast<double>(arc.distance({1.0L, 0.25L})), 0.75, 1e-17);
  EXPECT_NEAR(static_cast<double>(arc.distance({2.0L, -4.0L})), 4.0, 1e-17);  // below: an end
  const BoundaryArc line{{0, 0}, {2, 0}, 0.0L, 0.0L, 0.0L};
  EXPECT_NEAR(static_cast<double>(line.distance({1.0L, 3.0L})), 3.0, 1e-17);
  EXPECT_NEAR(static_cast<double>(line.distance({5.0L, 4.0L})), 5.0, 1e-17);
}

TEST(JudgeArithmetic, BetweenElementsOfOneCircleThereIsOnlyTheCircle) {
  // 1,000 arcs, nearly flat, whose curvature is that of the element at the end (Vogt: a curve whose
  // curvature rises ends steeper over its chord than it begins)
  for (int i = 1; i <= 1000; ++i) {
    const Real kappa = -0.9L / i, length = 1e-4L, theta = 0.006L * i, turn = kappa * length;
    const Real chord = 2.0L * std::sin(0.5L * turn) / kappa;
    const Element from{{0.3L, -0.2L}, theta, 1.5L * kappa};
    const Element to{from.point + chord * unit_at(theta + 0.5L * turn), theta + turn, kappa};
    const auto region = Region::of(from, to, 1);
    EXPECT_LT(region ? static_cast<double>(region->width()) : 0.0, 1e-14 * 1e-4) << i;
  }
}

TEST(JudgeArithmetic, WhatLiesBetweenTwoArcsIsAsHighAsTheyAreApart) {
  // arcs below the chord from (0, 0) to (2, 0): three quarters of a circle of radius sqrt 2 around
  // (1, -1), a sixth of one of radius 2 around (1, sqrt 3)
  const Real degree = std::numbers::pi_v<Real> / 180.0L;
  const Vec small{1.0L, -1.0L}, large{1.0L, std::sqrt(3.0L)};
  const Vec before = small + std::sqrt(2.0L) * unit_at(120.0L * degree);
  const Lens lens =
      Lens::of(before, {0.0L, 0.0L}, {2.0L, 0.0L}, large + 2.0L * unit_at(-55.0L * degree));
  EXPECT_NEAR(static_cast<double>(lens.height()), std::sqrt(2.0) - 1.0 + std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(static_cast<double>(lens.turning / degree), 142.5 + 32.5, 1e-12);
  EXPECT_TRUE(lens.holds());
  EXPECT_FALSE(Lens::of(before, {0.0L, 0.0L}, {2.0L, 0.0L}, large + 2.0L * unit_at(-40.0L * degree))
                   .holds());
}

TEST(JudgeArithmetic, BothTurnsOfAClothoidWithAnInflectionCount) {
  // curvature from -2 to 1 over the length 3: triangles of 2 * 2 / 2 and 1 * 1 / 2
  const Clothoid c{{}, {}, 0.0, -2.0, 1.0, 3.0};
  EXPECT_NEAR(static_cast<double>(Span(c, {}).turning_both_ways()), 2.5, 1e-15);
}

TEST(JudgeArithmetic, BothTurnsOfACubicWithAnInflectionCount) {
  // y = 3 t - 9 t^2 + 6 t^3 over x = 3 t: slopes 1, -1/2, 1
  const Span wave({{0, 0}, {1, 1}, {2, -1}, {3, 0}}, {1, 1, 1, 1});
  const double found = static_cast<double>(wave.turning_both_ways());
  EXPECT_NEAR(found, 2.0 * (std::atan(1.0) + std::atan(0.5)), 1e-15);
  const double part = static_cast<double>(wave.turning_both_ways(0.1L, 0.97L));
  const auto heading = [](double t) { return std::atan(1.0 - 6.0 * t + 6.0 * t * t); };
  EXPECT_NEAR(part, heading(0.1) + heading(0.97) + 2.0 * std::atan(0.5), 1e-15);
}

TEST(JudgeArithmetic, NurbsSpansAreThoseOfTheWholeCurve) {
  // a full circle of four quarters, degree 2 (Piegl and Tiller, example 7.2)
  const Real w = std::numbers::sqrt2_v<Real> / 2.0L;
  const std::vector<Vec> points = {{1, 0},   {1, 1},  {0, 1},  {-1, 1}, {-1, 0},
                                   {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  const std::vector<Real> weights = {1, w, 1, w, 1, w, 1, w, 1};
  const auto spans = spans_of_nurbs(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, points, weights);
  ASSERT_EQ(spans.size(), 4U);
  for (const Span& span : spans) {
    for (const Real t : {0.0L, 0.3L, 0.9L}) {
      EXPECT_NEAR(static_cast<double>(norm(span.point(t))), 1.0, 1e-17);
    }
  }
}

TEST(JudgeArithmetic, ASimpleKnotIsTakenApart) {
  // uniform quadratic: the middle of the first span is (d0 + 6 d1 + d2) / 8
  const auto spans =
      spans_of_nurbs(2, {0, 1, 2, 3, 4, 5, 6}, {{0, 0}, {1, 2}, {3, 2}, {4, 0}}, {1, 1, 1, 1});
  ASSERT_EQ(spans.size(), 2U);
  EXPECT_NEAR(static_cast<double>(spans[0].point(0.5L).x), (0.0 + 6.0 + 3.0) / 8.0, 1e-17);
  EXPECT_NEAR(static_cast<double>(spans[0].point(0.5L).y), (0.0 + 12.0 + 2.0) / 8.0, 1e-17);
}

TEST(JudgeArithmetic, SharesNoLineWithTheLibrary) {
  int files = 0;
  const auto folder = std::filesystem::path(JUDGE_SOURCES);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    std::ifstream in(entry.path());
    ++files;
    for (std::string line; std::getline(in, line);) {
      const bool includes = line.starts_with("#include") && line.find("obvid") != std::string::npos;
      EXPECT_FALSE(includes) << entry.path() << ": " << line;
    }
  }
  EXPECT_GT(files, 30);
}

}  // namespace
}  // namespace judge
