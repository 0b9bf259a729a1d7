// SPDX-License-Identifier: Apache-2.0
// Conics: ellipses that must come back, the monotone test against sampling, the weight chain, and
// chains with freed headings, proved by other code.
#include "obvid/contour/conics.h"
#include "../common/angles.h"
#include "../common/ten_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "obvid/certify/certify.h"
#include "obvid/chain/internal/series_chain.h"
#include "obvid/region/internal/segment_region.h"

namespace obvid {
namespace {

/// Ellipse with half axes a > b whose major axis has heading `rotation`.
struct TrueEllipse {
  Vec2 centre;
  double a, b, rotation;

  [[nodiscard]] Element at(double e, int way) const {
    const Vec2 d = {-a * std::sin(e), b * std::cos(e)};
    const Vec2 turn = unit_at(rotation);
    const double speed = norm(d);
    return {centre + complex_product(turn, {a * std::cos(e), b * std::sin(e)}),
            heading(complex_product(turn, way * d)), way * a * b / (speed * speed * speed)};
  }
};

TEST(Conics, PiecesOfAnEllipseComeBackAsThatEllipse) {
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> draw(0.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const TrueEllipse t = {
        {draw(rng), -draw(rng)}, 1.0 + draw(rng), 0.3 + 0.6 * draw(rng), kPi * (draw(rng) - 0.5)};
    const double from = 2.0 * kPi * draw(rng), step = 0.3 + 2.0 * draw(rng);
    const int way = draw(rng) < 0.5 ? 1 : -1;
    const Element e0 = t.at(from, way), e1 = t.at(from + way * step, way);
    const double w = std::cos(0.5 * step);
    const auto chain = conic_chain({e0, e1}, {w});
    ASSERT_TRUE(chain.has_value()) << i;
    const auto e = ellipse_of(chain->pieces[0]);
    ASSERT_TRUE(e) << i;
    EXPECT_NEAR(norm(e->centre - t.centre), 0.0, 1e-12) << i;
    EXPECT_NEAR(e->semi_major, t.a, 1e-12) << i;
    EXPECT_NEAR(e->semi_minor, t.b, 1e-12) << i;
    EXPECT_NEAR(std::remainder(e->rotation - t.rotation, kPi), 0.0, 1e-11) << i;
    EXPECT_NEAR(e->to - e->from, way * step, 1e-11) << i;
    EXPECT_NEAR(chain->elements[0].kappa / e0.kappa, 1.0, 1e-12) << i;
    EXPECT_NEAR(chain->elements[1].kappa / e1.kappa, 1.0, 1e-12) << i;
    const auto on = [&](double angle) {
      return e->centre + complex_product(unit_at(e->rotation), {e->semi_major * std::cos(angle),
                                                                e->semi_minor * std::sin(angle)});
    };
    EXPECT_NEAR(norm(on(e->from) - e0.point), 0.0, 1e-12) << i;
    EXPECT_NEAR(norm(on(e->to) - e1.point), 0.0, 1e-12) << i;
    EXPECT_NEAR(norm(on(0.5 * (e->from + e->to)) - evaluate(chain->pieces[0], 0.5).point), 0.0,
                1e-12);
  }
}

TEST(Conics, AnEllipseSampledUnevenlyHasCosinesOfHalfStepsAsWeights) {
  const TrueEllipse t = {{3, -2}, 5.0, 2.0, 0.4};
  const std::vector<double> at = {0.02, 0.1, 0.35, 0.4, 0.8, 1.1, 1.55};
  std::vector<Element> elements;
  for (const double e : at) elements.push_back(t.at(e, 1));
  const auto chain = conic_chain(elements, {std::cos(0.5 * (at[1] - at[0]))});
  ASSERT_TRUE(chain.has_value());
  EXPECT_TRUE(chain->elliptic);
  EXPECT_TRUE(chain->monotone);
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    // headings are rounded to 2e-16 and stand at 0.02 from the shortest chord
    EXPECT_NEAR(chain->weights[i], std::cos(0.5 * (at[i + 1] - at[i])), 1e-12) << i;
    EXPECT_NEAR(chain->elements[i].kappa / elements[i].kappa, 1.0, 1e-11) << i;
  }
}

TEST(Conics, ParabolasAndHyperbolasAreNoEllipses) {
  RationalBezier p;
  p.degree = 2;
  p.offset = {Vec2{0, 0}, Vec2{1, 1}, Vec2{2, 0}};
  p.weight = {1, 1, 1};
  EXPECT_FALSE(ellipse_of(p));
  p.weight[1] = 1.5;
  EXPECT_FALSE(ellipse_of(p));
  p.weight[1] = 0.5;
  EXPECT_TRUE(ellipse_of(p));
  p.offset[1] = {1, 0};
  EXPECT_FALSE(ellipse_of(p)) << "a line";
  p.weight = {1, -0.5, 1};
  EXPECT_FALSE(ellipse_of(p)) << "the other part of the conic";
}

/// What dense sampling says about curvature: 0 when it goes both ways.
int sampled_direction(const RationalBezier& p) {
  bool up = false, down = false;
  for (int j = 0; j <= 400; ++j) {
    const double rate = curvature_rate(evaluate(p, j / 400.0));
    up = up || rate > 0.0;
    down = down || rate < 0.0;
  }
  return up && down ? 0 : up ? 1 : -1;
}

TEST(Conics, MonotoneTestAgreesWithSamplingOnConicsOfAllKinds) {
  std::mt19937_64 rng(2);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  int monotone = 0, with_vertex = 0;
  for (int i = 0; i < 5000; ++i) {
    RationalBezier p;
    p.degree = 2;
    const double theta = kPi * draw(rng);
    const Vec2 first = {draw(rng), draw(rng)};
    const Vec2 second = first + std::exp(draw(rng)) * unit_at(theta);
    p.offset = {first, second, second + std::exp(draw(rng)) * unit_at(theta + 2.0 * draw(rng))};
    const double w = std::exp(0.5 * draw(rng)), scale = std::exp(draw(rng));  // unequal end weights
    p.weight = {1.0, w * scale, scale * scale};
    const int direction = conic_direction(p);
    EXPECT_EQ(direction, sampled_direction(p)) << i;
    (direction != 0 ? monotone : with_vertex) += 1;
  }
  EXPECT_GT(monotone, 500);
  EXPECT_GT(with_vertex, 1000);
}

TEST(Conics, EqualSignsOfTheRateAtBothEndsAreNotEnough) {
  // more than a quarter of an ellipse, from before one vertex to behind the next but one
  const TrueEllipse t = {{0, 0}, 2.0, 1.0, 0.0};
  const Element a = t.at(-0.3, 1), b = t.at(1.8, 1);
  const auto chain = conic_chain({a, b}, {std::cos(0.5 * 2.1)});
  ASSERT_TRUE(chain.has_value());
  const auto rate = [&](double u) { return curvature_rate(evaluate(chain->pieces[0], u)); };
  EXPECT_GT(rate(0.0), 0.0);
  EXPECT_GT(rate(1.0), 0.0);
  EXPECT_LT(rate(0.5), 0.0);
  EXPECT_EQ(conic_direction(chain->pieces[0]), 0);
  EXPECT_FALSE(chain->monotone);
}

TEST(Conics, WeightRangeEndsWhereTheCurvatureRateVanishesAtAnEnd) {
  const Element a = {{0, 0}, 0.5, 0.0}, b = {{1, 0}, -0.4, 0.0};
  const auto range = monotone_weights(a, b);
  ASSERT_TRUE(range);
  const auto rates = [&](double w) {
    const auto p = conic_chain({a, b}, {w})->pieces[0];
    return std::array{curvature_rate(evaluate(p, 0.0)), curvature_rate(evaluate(p, 1.0))};
  };
  EXPECT_NEAR(rates(range->low)[1], 0.0, 1e-12);
  EXPECT_NEAR(rates(range->high)[0], 0.0, 1e-12);
  const double inside = 0.5 * (range->low + range->high);
  EXPECT_TRUE(conic_chain({a, b}, {inside})->monotone);
  EXPECT_FALSE(conic_chain({a, b}, {range->low * 0.999})->monotone);
  EXPECT_FALSE(conic_chain({a, b}, {range->high * 1.001})->monotone);
  EXPECT_FALSE(monotone_weights({{0, 0}, 0.5, 0}, {{1, 0}, -0.5, 0})) << "only a circle";
  EXPECT_FALSE(monotone_weights({{0, 0}, 0.5, 0}, {{1, 0}, 0.2, 0})) << "an inflection";
}

TEST(Conics, MedianWeightPassesBetweenBothBoundaries) {
  const Element a = {{0, 0}, 0.55, -1.4}, b = {{1, 0}, -0.4, -0.7};
  const auto w = median_weight(a, b);
  ASSERT_TRUE(w);
  const ChordFrame frame = chord_frame(a, b);
  const auto region = segment_region(frame, 1);
  ASSERT_TRUE(region);
  const Vec2 k = evaluate(conic_chain({a, b}, {*w})->pieces[0], 0.5).point;
  const Vec2 foot = {0.5, 0.0}, along = (k - foot) / norm(k - foot);
  // steps along the median from K to the boundaries, by marching
  const auto reach = [&](const Boundary& boundary, double way) {
    double s = 0.0;
    for (double step = 0.01; step > 1e-13; step *= 0.5) {
      const auto beyond = [&](double t) {
        const Vec2 p = k + (way * t) * along;
        return way * (p.y - *boundary_ordinate(frame, boundary, p.x)) > 0.0;
      };
      while (!beyond(s + step)) s += step;
    }
    return s;
  };
  const bool start_is_upper = *boundary_ordinate(frame, region->from_start, k.x) >
                              *boundary_ordinate(frame, region->to_end, k.x);
  const Boundary& upper = start_is_upper ? region->from_start : region->to_end;
  const Boundary& lower = start_is_upper ? region->to_end : region->from_start;
  EXPECT_NEAR(reach(upper, 1.0), reach(lower, -1.0), 1e-12);
  EXPECT_GT(reach(upper, 1.0), 1e-4);
}

TEST(Conics, UnknownCurvaturesGiveTheMedianOfTheTangentsAlone) {
  const double none = std::numeric_limits<double>::infinity();
  const auto open = median_weight({{0, 0}, 0.55, -none}, {{1, 0}, -0.4, 0.0});
  const auto nearly = median_weight({{0, 0}, 0.55, -1e9}, {{1, 0}, -0.4, 0.0});
  ASSERT_TRUE(open && nearly);
  EXPECT_NEAR(*open, *nearly, 1e-6);
}

std::vector<Element> chosen_elements(const std::vector<Vec2>& points) {
  const auto analysis = analyse(points);
  EXPECT_TRUE(analysis.has_value());
  ChainConstraints constraints;
  constraints.convex = true;
  Watch nobody;
  const auto chain = choose_elements(points, *analysis, constraints, nobody);
  EXPECT_TRUE(chain.has_value());
  std::vector<Element> elements;
  for (std::size_t i = 0; chain && i < chain->elements.size(); ++i) {
    if (chain->source[i]) elements.push_back(chain->elements[i]);
  }
  return elements;
}

void expect_good(const ConicChain& chain, const std::vector<Vec2>& points,
                 const std::string& name) {
  EXPECT_TRUE(chain.elliptic) << name;
  EXPECT_TRUE(chain.monotone) << name;
  EXPECT_EQ(chain.why_not.obstacle, ConicObstacle::kNone) << name;
  ASSERT_EQ(chain.pieces.size() + 1, points.size()) << name;
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    const RationalBezier& p = chain.pieces[i];
    const Jet start = evaluate(p, 0.0), end = evaluate(p, 1.0);
    EXPECT_EQ(start.point, points[i]) << name << ' ' << i;
    EXPECT_EQ(end.point, points[i + 1]) << name << ' ' << i;
    for (const auto& [jet, e] :
         {std::pair{start, chain.elements[i]}, {end, chain.elements[i + 1]}}) {
      EXPECT_NEAR(norm(jet.d1 / norm(jet.d1) - unit_at(e.theta)), 0.0, 1e-12) << name << ' ' << i;
      EXPECT_NEAR(curvature(jet) / e.kappa, 1.0, 1e-10) << name << ' ' << i;
    }
    const auto change = std::abs(chain.elements[i + 1].kappa) - std::abs(chain.elements[i].kappa);
    const double sign = chain.elements[i].kappa * change;
    const auto proof = prove_piece(p);
    EXPECT_EQ(proof.verdict, sign > 0.0 ? Verdict::kIncreasing : Verdict::kDecreasing) << name;
  }
}

TEST(ConicChain, TenPointsSayWhyNotAndBecomeMonotoneWithFreedHeadings) {
  const auto elements = chosen_elements(kTenPoints);
  ASSERT_EQ(elements.size(), 10u);
  const auto fixed = conic_chain(elements);
  ASSERT_TRUE(fixed.has_value());
  EXPECT_TRUE(fixed->elliptic);
  EXPECT_FALSE(fixed->monotone);
  EXPECT_EQ(fixed->why_not.obstacle, ConicObstacle::kNoCommonWeight);
  EXPECT_GT(fixed->why_not.excess, 0.0);
  EXPECT_NE(fixed->why_not.first, fixed->why_not.second);
  const auto freed = headings_for_conics(elements);
  ASSERT_TRUE(freed.has_value());
  constexpr double kOneDegree = kPi / 180.0;
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_LT(std::abs((*freed)[i].theta - elements[i].theta), kOneDegree) << i;
  }
  const auto chain = conic_chain(*freed);
  ASSERT_TRUE(chain.has_value());
  expect_good(*chain, kTenPoints, "ten points");
}

TEST(ConicChain, FirstWeightOfThePaperGivesEllipsesOnTheFirstTwoSegments) {
  auto elements = chosen_elements(kTenPoints);
  const auto median = median_weight(elements[0], elements[1]);
  ASSERT_TRUE(median);
  elements.resize(3);
  const auto chain = conic_chain(elements, {median});
  ASSERT_TRUE(chain.has_value());
  EXPECT_EQ(chain->weights[0], *median);
  EXPECT_TRUE(chain->elliptic);
  EXPECT_NEAR(
      curvature(evaluate(chain->pieces[0], 1.0)) / curvature(evaluate(chain->pieces[1], 0.0)), 1.0,
      1e-12);
}

/// Points of curves with monotone curvature, unevenly sampled.
std::vector<Vec2> random_spiral(std::mt19937_64& rng) {
  std::uniform_real_distribution<double> draw(0.0, 1.0);
  const int n = 4 + static_cast<int>(30 * draw(rng)), kind = static_cast<int>(4 * draw(rng));
  const double turn = 0.3 + 2.5 * draw(rng), shape = 0.1 + draw(rng);
  const bool mirrored = draw(rng) < 0.5, backwards = draw(rng) < 0.5;
  std::vector<double> at = {0.0};
  while (static_cast<int>(at.size()) < n) at.push_back(at.back() + 0.3 + draw(rng));
  std::vector<Vec2> points;
  for (const double u : at) {
    const double s = u / at.back(), a = 0.2 + s * turn, q = 0.05 + 2.0 * s * shape;
    Vec2 p;
    if (kind == 0) p = std::exp(shape * a) * unit_at(a);
    if (kind == 1) p = unit_at(a) - a * left_normal(unit_at(a));
    if (kind == 2) p = {(1.3 + 3.0 * shape) * std::sin(1.5 * s), std::cos(1.5 * s)};
    if (kind == 3) p = {q, q * q};
    points.push_back(mirrored ? Vec2{p.x, -p.y} : p);
  }
  if (backwards) std::reverse(points.begin(), points.end());
  return points;
}

TEST(ConicChain, FreedHeadingsMakeNearlyEveryRandomSpiralMonotoneAndProved) {
  std::mt19937_64 rng(3);
  int as_given = 0, made = 0;
  for (int i = 0; i < 500; ++i) {
    const auto points = random_spiral(rng);
    const auto elements = chosen_elements(points);
    const auto found = headings_for_conics(elements);
    if (!found) {
      EXPECT_EQ(found.error().code, ErrorCode::kNotProved);
      continue;
    }
    ++made;
    const auto chain = conic_chain(*found);
    ASSERT_TRUE(chain.has_value());
    const bool rises = elements[1].kappa > elements[0].kappa;
    for (const RationalBezier& piece : chain->pieces) {
      EXPECT_EQ(conic_direction(piece), rises ? 1 : -1) << i;
    }
    expect_good(*chain, points, "series " + std::to_string(i));
    as_given += std::equal(found->begin(), found->end(), elements.begin(),
                           [](const Element& a, const Element& b) { return a.theta == b.theta; });
  }
  EXPECT_LT(as_given, 400);  // so most series needed it
  EXPECT_GE(made, 480);
}

TEST(ConicChain, ScaledAndMirroredSeriesHaveTheSameWeights) {
  const auto elements = chosen_elements(kTenPoints);
  const auto chain = conic_chain(elements);
  auto other = elements;
  const double scale = 1e-4;
  for (Element& e : other)
    e = {{scale * e.point.x, -scale * e.point.y}, -e.theta, -e.kappa / scale};
  const auto mirrored = conic_chain(other);
  ASSERT_TRUE(chain && mirrored);
  for (std::size_t i = 0; i < chain->weights.size(); ++i) {
    EXPECT_NEAR(chain->weights[i] / mirrored->weights[i], 1.0, 1e-10) << i;
  }
}

TEST(ConicChain, RefusesInflectionsAndBadWeights) {
  const std::vector<Element> wave = {{{0, 0}, 0.5, 0}, {{1, 0}, -0.5, 0}, {{2, 0}, 0.5, 0}};
  const auto s = conic_chain(wave);
  ASSERT_FALSE(s.has_value());
  EXPECT_EQ(s.error().code, ErrorCode::kNoSpiral);
  EXPECT_EQ(s.error().index, 1);
  EXPECT_EQ(headings_for_conics(wave).error().code, ErrorCode::kNoSpiral);
  const auto few = conic_chain({{{0, 0}, 0.5, 0}});
  EXPECT_EQ(few.error().code, ErrorCode::kTooFewPoints);
  const std::vector<Element> good = {{{0, 0}, 0.5, 0}, {{1, 0}, -0.4, 0}};
  EXPECT_EQ(conic_chain(good, {0.0}).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(conic_chain(good, {std::nan("")}).error().code, ErrorCode::kBadOption);
}

}  // namespace
}  // namespace obvid
