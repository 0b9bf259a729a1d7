// SPDX-License-Identifier: Apache-2.0
// The C2 cubic spline: against an independent solver, closed forms, and its published singular
// points on the ten points of [000].
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "../common/ten_points.h"
#include "obvid/contour/bsplines.h"
#include "obvid/curve/nurbs.h"

namespace obvid {
namespace {

CubicSplineOptions with(SplineEnd end, SplineParameter parameter = SplineParameter::kChord) {
  return {parameter, end, {}, {}};
}

struct Reference {
  const char* name;
  CubicSplineOptions options;
  std::vector<Vec2> slopes;
};

/// Slopes by scipy.interpolate.CubicSpline (1.10) on the same knots.
const Reference kReferences[] = {{"chord, natural",
                                  with(SplineEnd::kNatural),
                                  {{0.199943835140631, -1.04628218011669},
                                   {-0.280663749562493, -0.905065646409934},
                                   {-1.00090121971978, -0.403384266508697},
                                   {-0.818288778074531, 0.615754778100959},
                                   {0.136472773401051, 1.03785874003684},
                                   {0.779267508375911, 0.664298471036857},
                                   {0.991341242334427, 0.154004573105511},
                                   {0.98396814781356, -0.222391154039765},
                                   {0.901817005986233, -0.428731882332468},
                                   {0.793976653873944, -0.622450016026311}}},
                                 {"chord, not a knot",
                                  with(SplineEnd::kNotAKnot),
                                  {{0.534418906945343, -1.07906852641139},
                                   {-0.385076648126089, -0.894830367905962},
                                   {-0.963255048327641, -0.407076276993797},
                                   {-0.830603629996953, 0.616972534710047},
                                   {0.139993052597952, 1.0374609482112},
                                   {0.778246632275182, 0.66461221819855},
                                   {0.991592468206776, 0.153098904375198},
                                   {0.984005827193, -0.219019521191301},
                                   {0.901295708730502, -0.443446157585876},
                                   {0.798176199933782, -0.511163382258366}}},
                                 {"chord, periodic",
                                  with(SplineEnd::kPeriodic),
                                  {{0.159169866155948, -1.01060522597347},
                                   {-0.267938682615114, -0.916200841705919},
                                   {-1.00547476389883, -0.399378450360047},
                                   {-0.816879595394391, 0.614498310838864},
                                   {0.136500865029498, 1.03795059741046},
                                   {0.77753886655444, 0.665339115397315},
                                   {0.998951347406033, 0.149291560167675},
                                   {0.954691468526486, -0.204228645220282},
                                   {1.02993137790702, -0.508221851750955},
                                   {-0.175224408496346, -0.0210906268595721},
                                   {0.159169866155948, -1.01060522597347}}},
                                 {"centripetal, natural",
                                  with(SplineEnd::kNatural, SplineParameter::kCentripetal),
                                  {{0.481308804597994, -2.33822328328502},
                                   {-0.688553620221105, -2.21430515622699},
                                   {-3.20580096330485, -1.1388869624244},
                                   {-3.58064262239176, 2.79455543169777},
                                   {0.58590230875514, 5.40214658225194},
                                   {4.448008001796, 3.71396489759954},
                                   {5.93686658578825, 0.933033024501897},
                                   {6.01561971902207, -1.24812361746798},
                                   {7.95398029282731, -4.15359381918944},
                                   {11.569935660874, -8.3738985052083}}},
                                 {"centripetal, periodic",
                                  with(SplineEnd::kPeriodic, SplineParameter::kCentripetal),
                                  {{-2.64822278468059, -1.11723491052321},
                                   {0.220475763846773, -2.5689581746833},
                                   {-3.49310596032126, -1.02681759911191},
                                   {-3.49782784175947, 2.76235026489501},
                                   {0.575223802843936, 5.40586416464944},
                                   {4.40370795439142, 3.73299222111757},
                                   {6.13471917816406, 0.849009554764588},
                                   {5.26122805215184, -0.92796927792042},
                                   {10.9946246244998, -5.44393807152515},
                                   {-3.95290880884365, -1.78656983340881},
                                   {-2.64822278468059, -1.11723491052321}}}};

TEST(CubicSplineThroughPoints, SlopesAgreeWithAnIndependentSolver) {
  for (const Reference& r : kReferences) {
    const auto s = cubic_spline(kTenPoints, r.options);
    ASSERT_TRUE(s.has_value()) << r.name;
    ASSERT_EQ(s->slopes.size(), r.slopes.size()) << r.name;
    for (std::size_t i = 0; i < r.slopes.size(); ++i) {
      EXPECT_NEAR(norm(s->slopes[i] - r.slopes[i]), 0.0, 1e-12) << r.name << ' ' << i;
    }
    for (std::size_t i = 0; i < kTenPoints.size(); ++i) EXPECT_EQ(s->points[i], kTenPoints[i]);
  }
}

/// Second derivatives of both neighbours at every inner knot, and over the seam when periodic.
double largest_jump(const CubicSpline& s, bool periodic) {
  const auto pieces = bezier_pieces(s);
  double worst = 0.0;
  const auto second = [&](std::size_t i, double t) {
    const double h = s.knots[i + 1] - s.knots[i];
    return evaluate(pieces[i], t).d2 / (h * h);
  };
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    worst = std::max(worst, norm(second(i, 0.0) - second(i - 1, 1.0)));
  }
  if (periodic) worst = std::max(worst, norm(second(0, 0.0) - second(pieces.size() - 1, 1.0)));
  return worst;
}

TEST(CubicSplineThroughPoints, SecondDerivativeIsContinuousForEveryNumberOfPoints) {
  for (std::size_t n = 2; n <= 60; ++n) {
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < n; ++i) {  // uneven steps of a turning, wavy series
      const double t = 0.3 * static_cast<double>(i) + 0.13 * std::sin(5.0 * static_cast<double>(i));
      points.push_back((1.0 + t) * unit_at(t));
    }
    for (const auto end :
         {SplineEnd::kNatural, SplineEnd::kNotAKnot, SplineEnd::kTangents, SplineEnd::kPeriodic}) {
      const bool periodic = end == SplineEnd::kPeriodic;
      const auto s = cubic_spline(points, {SplineParameter::kCentripetal, end, {1, 0}, {0, 1}});
      ASSERT_EQ(s.has_value(), !periodic || n >= 3) << n;
      if (!s) continue;
      EXPECT_LE(largest_jump(*s, periodic), 1e-11) << n << ' ' << static_cast<int>(end);
      if (end == SplineEnd::kTangents) {
        EXPECT_EQ(s->slopes.front(), (Vec2{1, 0}));
        EXPECT_EQ(s->slopes.back(), (Vec2{0, 1}));
      }
      if (end == SplineEnd::kNatural && n > 2) {
        EXPECT_NEAR(norm(evaluate(*s, s->knots.front()).d2), 0.0, 1e-12);
        EXPECT_NEAR(norm(evaluate(*s, s->knots.back()).d2), 0.0, 1e-11);
      }
    }
  }
}

TEST(CubicSplineThroughPoints, NotAKnotReproducesParabolasAndLines) {
  const auto line = cubic_spline({{1, 2}, {4, 6}});
  ASSERT_TRUE(line.has_value());
  EXPECT_NEAR(norm(evaluate(*line, 2.5).point - Vec2{2.5, 4.0}), 0.0, 1e-15);
  const auto parabola = cubic_spline({{-1, 1}, {0, 0}, {1, 1}});
  ASSERT_TRUE(parabola.has_value());
  for (double x = -1.0; x <= 1.0; x += 0.125) {
    const double u = std::sqrt(2.0) * (x + 1.0);
    EXPECT_NEAR(norm(evaluate(*parabola, u).point - Vec2{x, x * x}), 0.0, 1e-15);
  }
}

/// Of a catenary; the middle two are a ten-millionth of the others' distance apart.
TEST(CubicSplineThroughPoints, FourPointsHaveTheirCubicHoweverNearTwoOfThemAre) {
  using Real = long double;
  const std::vector<Vec2> points = {{2.97610067, -6.01729429},
                                    {-0.291102556, -3.48280403},
                                    {-0.291102679, -3.48280401},
                                    {-4.03169597, -4.85217105}};
  const auto s = cubic_spline(points);
  ASSERT_TRUE(s);
  const auto lagrange = [&](Real u, double Vec2::*coordinate) {
    Real sum = 0.0L;
    for (std::size_t i = 0; i < 4; ++i) {
      Real term = points[i].*coordinate;
      for (std::size_t j = 0; j < 4; ++j) {
        if (j != i) term *= (u - s->knots[j]) / (Real{s->knots[i]} - s->knots[j]);
      }
      sum += term;
    }
    return sum;
  };
  // over a span by its ends and slopes (Hermite)
  for (const std::size_t k : {std::size_t{0}, std::size_t{2}}) {
    const Real h = Real{s->knots[k + 1]} - s->knots[k], u = s->knots[k] + 0.5L * h;
    const Vec2 a = points[k], b = points[k + 1], m = s->slopes[k], n = s->slopes[k + 1];
    EXPECT_LT(std::abs(0.5L * (a.x + b.x) + 0.125L * h * (m.x - n.x) - lagrange(u, &Vec2::x)),
              1e-7L);
    EXPECT_LT(std::abs(0.5L * (a.y + b.y) + 0.125L * h * (m.y - n.y) - lagrange(u, &Vec2::y)),
              1e-7L);
  }
}

TEST(CubicSplineThroughPoints, ConvergesToACircleWithTheFourthPower) {
  const auto error = [](std::size_t n) {
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < n; ++i) {
      points.push_back(
          unit_at(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n)));
    }
    const auto s = cubic_spline(points, with(SplineEnd::kPeriodic));
    double worst = 0.0;
    for (double part = 0.0; part <= 1.0; part += 0.01) {
      const double u = s->knots[3] + part * (s->knots[4] - s->knots[3]);
      worst = std::max(worst, std::abs(norm(evaluate(*s, u).point) - 1.0));
    }
    return worst;
  };
  EXPECT_NEAR(error(20) / error(40), 16.0, 1.0);
}

TEST(CubicSplineThroughPoints, MovesWithThePointsAndScalesWithThem) {
  const auto s = cubic_spline(kTenPoints);
  std::vector<Vec2> moved;
  const double scale = 1e-3;
  const Vec2 turn = unit_at(1.1), shift = {0.3, -0.2};
  for (const Vec2 p : kTenPoints) moved.push_back(scale * complex_product(p, turn) + shift);
  const auto t = cubic_spline(moved);
  ASSERT_TRUE(s && t);
  for (std::size_t i = 0; i < kTenPoints.size(); ++i) {
    EXPECT_NEAR(norm(complex_product(s->slopes[i], turn) - t->slopes[i]), 0.0, 1e-11);
  }
}

/// Curvature changes of a curve between its extrema, ends included, by dense sampling.
struct Singular {
  int visible_extrema = 0;
  int inflections = 0;
};

Singular singular_points(const CubicSpline& s, double part_of_range) {
  std::vector<double> kappa;
  const auto pieces = bezier_pieces(s);
  constexpr int kSamples = 2000;
  for (const auto& piece : pieces) {
    for (int j = 0; j <= kSamples; ++j) {
      kappa.push_back(curvature(evaluate(piece, static_cast<double>(j) / kSamples)));
    }
  }
  const auto [low, high] = std::minmax_element(kappa.begin(), kappa.end());
  const double least = part_of_range * (*high - *low);
  Singular result;
  // an extremum is visible when the curve leaves it by more than `least` on both sides
  double top = kappa.front(), bottom = kappa.front();
  int way = 0;
  for (std::size_t i = 1; i < kappa.size(); ++i) {
    const double k = kappa[i];
    top = std::max(top, k);
    bottom = std::min(bottom, k);
    if (way >= 0 && k < top - least) {
      if (way > 0) ++result.visible_extrema;
      way = -1;
      bottom = k;
    } else if (way <= 0 && k > bottom + least) {
      if (way < 0) ++result.visible_extrema;
      way = 1;
      top = k;
    }
    const double noise = 1e-12 * (*high - *low);  // natural ends have curvature 0 within rounding
    if (std::min(kappa[i - 1], k) < -noise && std::max(kappa[i - 1], k) > noise) {
      ++result.inflections;
    }
  }
  return result;
}

TEST(CubicSplineThroughPoints, HasThePublishedSevenExtremaAndOneInflectionOnTheTenPoints) {
  // [000] and [003]: seven extrema and one inflection as a CAD system draws it. Nine extrema
  // exist; one pair of them differs by a ten-thousandth of the range, which no plot shows.
  const auto s = cubic_spline(kTenPoints);
  ASSERT_TRUE(s.has_value());
  EXPECT_EQ(singular_points(*s, 1e-3).visible_extrema, 7);
  EXPECT_EQ(singular_points(*s, 1e-3).inflections, 1);
  EXPECT_EQ(singular_points(*s, 1e-6).visible_extrema, 9);
}

TEST(CubicSplineThroughPoints, CentripetalNaturalSplineHasSevenExtremaAboveOnePercent) {
  const auto s = cubic_spline(kTenPoints, with(SplineEnd::kNatural, SplineParameter::kCentripetal));
  ASSERT_TRUE(s.has_value());
  EXPECT_EQ(singular_points(*s, 1e-2).visible_extrema, 7);
}

TEST(SplineThroughTangents, MeetsPointsAndHeadingsWithContinuousSecondDerivative) {
  for (std::size_t n = 2; n <= 40; ++n) {
    std::vector<Vec2> points;
    std::vector<double> theta;
    for (std::size_t i = 0; i < n; ++i) {
      const double t = 0.35 * static_cast<double>(i) + 0.1 * std::sin(3.0 * static_cast<double>(i));
      points.push_back(std::exp(0.2 * t) * unit_at(t));
      theta.push_back(t + std::atan2(1.0, 0.2));
    }
    const auto c = spline_through_tangents(points, theta);
    ASSERT_TRUE(c.has_value()) << n;
    EXPECT_EQ(c->points.size(), 2 * n);
    const auto spans = bezier_spans(*c);
    ASSERT_EQ(spans.size(), n == 2 ? 1 : 2 * n - 3);
    double u = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      if (i > 0) u += norm(points[i] - points[i - 1]);
      const Jet jet = evaluate(*c, u);
      EXPECT_NEAR(norm(jet.point - points[i]), 0.0, 1e-12 * norm(points[i])) << n << ' ' << i;
      EXPECT_NEAR(cross(unit_at(theta[i]), jet.d1 / norm(jet.d1)), 0.0, 1e-12) << n << ' ' << i;
      EXPECT_GT(dot(unit_at(theta[i]), jet.d1), 0.0);
    }
    for (std::size_t i = 1; i < spans.size(); ++i) {
      const double a = spans[i - 1].to - spans[i - 1].from, b = spans[i].to - spans[i].from;
      const Vec2 left = evaluate(spans[i - 1].piece, 1.0).d2 / (a * a);
      const Vec2 right = evaluate(spans[i].piece, 0.0).d2 / (b * b);
      EXPECT_NEAR(norm(left - right), 0.0, 1e-9) << n << ' ' << i;
    }
  }
}

TEST(CubicSplineThroughPoints, RefusesWhatIsNoSeries) {
  EXPECT_EQ(cubic_spline({{1, 1}}).error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(cubic_spline({{1, 1}, {2, 2}}, with(SplineEnd::kPeriodic)).error().code,
            ErrorCode::kTooFewPoints);
  const auto twice = cubic_spline({{0, 0}, {1, 0}, {1, 0}, {2, 1}});
  ASSERT_FALSE(twice.has_value());
  EXPECT_EQ(twice.error().code, ErrorCode::kOutOfOrder);
  EXPECT_EQ(twice.error().index, 2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(cubic_spline({{0, 0}, {nan, 0}}).has_value());
  EXPECT_EQ(cubic_spline({{0, 0}, {1, 0}},
                         {SplineParameter::kChord, SplineEnd::kTangents, {nan, 0}, {1, 0}})
                .error()
                .code,
            ErrorCode::kBadOption);
  EXPECT_EQ(spline_through_tangents({{0, 0}, {1, 0}}, {0.0}).error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace obvid
