// SPDX-License-Identifier: Apache-2.0
// Few runs within tolerances: what is promised about every result, and what known curves give.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "measured_curves.h"

namespace obvid {
namespace {

using namespace test;

int changes(const FairedSeries& f, bool closed) {
  int n = 0;
  for (std::size_t i = closed ? 0 : 1; i < f.direction.size(); ++i) {
    const std::size_t before = i == 0 ? f.direction.size() - 1 : i - 1;
    n += f.direction[i] != f.direction[before] ? 1 : 0;
  }
  return n;
}

/// Every promise of a feasible result.
void expect_promises(const MeasuredSeries& series, const FairedSeries& f, const std::string& what) {
  ASSERT_TRUE(f.feasible) << what;
  ASSERT_EQ(f.elements.size(), f.source.size()) << what;
  ASSERT_EQ(f.direction.size(), f.elements.size() - (series.closed ? 0 : 1)) << what;
  double size = 0.0;
  for (const Vec2 p : series.points) size = std::max(size, norm(p - series.points.front()));
  const double rounding = 4.0 * 0x1p-52 * (norm(series.points.front()) + size);
  for (std::size_t i = 0; i < f.elements.size(); ++i) {
    if (!f.source[i]) continue;
    const std::size_t k = *f.source[i];
    EXPECT_LE(norm(f.elements[i].point - series.points[k]), series.reach[k] + rounding)
        << what << ", node " << i;
  }
  for (std::size_t i = 0; i < f.direction.size(); ++i) {
    const std::size_t next = (i + 1) % f.elements.size();
    EXPECT_TRUE(spiral_exists(f.elements[i], f.elements[next], f.direction[i]))
        << what << ", link " << i;
  }
  EXPECT_EQ(changes(f, series.closed), f.vertices) << what;
  EXPECT_GE(f.vertices, f.vertices_lower_bound) << what;
}

/// How far two descents may end apart, as a share of the room that a point or a curvature has: both
/// stop where Newton's decrement is below 1e-6 (`kFairEnough`), and the step from there leaves no
/// more than that over the least weight of a barrier, 0.02 (`kFinalTube`; Boyd and Vandenberghe
/// 2004, 9.6.4).
constexpr double kSettled = 2.0 * 1e-6 / 0.02;

/// The room of a node's curvature: the largest one of it and of its neighbours.
double curvature_by(const FairedSeries& f, std::size_t i) {
  double out = 0.0;
  for (std::size_t k = i > 0 ? i - 1 : 0; k < std::min(i + 2, f.elements.size()); ++k) {
    out = std::max(out, std::abs(f.elements[k].kappa));
  }
  return out;
}

FairedSeries fair_and_check(const MeasuredSeries& series, const std::string& what) {
  FairedSeries f = faired(series);
  expect_promises(series, f, what);
  return f;
}

std::vector<Vec2> airfoil(const std::string& name) {
  std::ifstream in(std::string(OBVID_TEST_DATA) + "/airfoils/" + name);
  std::string title;
  std::getline(in, title);
  std::vector<Vec2> points;
  for (Vec2 p; in >> p.x >> p.y;) points.push_back(p);
  return points;
}

TEST(Fair, Arad10WithinATenthOfAThousandthOfItsChordHasTwoVertices) {
  const auto points = airfoil("arad10.dat");
  ASSERT_EQ(points.size(), 51U);
  const auto f = fair_and_check(measured(points, 1e-4), "arad10");
  EXPECT_EQ(f.vertices, 2);  // found by a dense prototype as well; interpolated exactly: 3
  EXPECT_EQ(f.vertices_lower_bound, 2);
}

TEST(Fair, NoisyEllipsesAndOvalsKeepFourVertices) {
  std::mt19937_64 rng(11);
  for (int i = 0; i < 60; ++i) {
    const std::size_t n = 40 + static_cast<std::size_t>(rng() % 160);
    auto points = ellipse(n, uniform(rng, 1.5, 3.0), 1.0, uniform(rng, 0.0, kTurn));
    if (i % 2 == 1) {  // blunter at one end: still one vertex at each end of both axes
      for (Vec2& p : points) p.y *= 1.0 + 0.1 * p.x / 3.0;
    }
    const double reach = std::pow(10.0, uniform(rng, -5.0, -3.0));
    add_noise(points, reach, rng);
    const auto f = fair_and_check(measured(points, reach, true), std::to_string(i));
    EXPECT_EQ(f.vertices, 4) << i << ": " << n << " points, reach " << reach;
  }
}

TEST(Fair, ANoisyClothoidThroughItsInflectionIsOneRun) {
  std::mt19937_64 rng(12);
  int more = 0;
  for (int i = 0; i < 100; ++i) {
    const std::size_t n = 10 + static_cast<std::size_t>(rng() % 200);
    auto points = clothoid(n, 2.0, uniform(rng, -2.0, -0.5), uniform(rng, 0.8, 2.0));
    const double reach = std::pow(10.0, uniform(rng, -6.0, -3.0));
    add_noise(points, reach, rng);
    const auto f = fair_and_check(measured(points, reach), std::to_string(i));
    more += f.vertices > 0 ? 1 : 0;
    EXPECT_EQ(f.vertices_lower_bound, 0) << i;
  }
  EXPECT_LE(more, 1);  // of a hundred
}

TEST(Fair, TenThousandPointsOnASpiralNeedFewNodes) {
  std::mt19937_64 rng(13);
  constexpr double kReach = 1e-4;
  constexpr double kStart = 0.5, kRate = 1.0, kLength = 3.0;
  auto points = clothoid(10000, kLength, kStart, kRate);
  add_noise(points, kReach, rng);
  const auto f = fair_and_check(measured(points, kReach), "spiral");
  EXPECT_EQ(f.vertices, 0);
  EXPECT_LT(f.elements.size(), 400U);
  // against the clothoid at the same arc length, near enough: nodes lie on it within two reaches
  // and know its curvature
  for (std::size_t i = 1; i + 1 < f.elements.size(); ++i) {
    const double s = kLength * static_cast<double>(*f.source[i]) / 9999.0;
    EXPECT_NEAR(f.elements[i].kappa, kStart + kRate * s, 0.25) << i;
  }
}

TEST(Fair, TheOtherWayRoundHasAsManyVertices) {
  std::mt19937_64 rng(14);
  int same = 0;
  constexpr int kSeries = 40;
  for (int i = 0; i < kSeries; ++i) {
    auto points = meander(60 + static_cast<std::size_t>(rng() % 200), 2.0, uniform(rng, 0.3, 1.2));
    const double reach = std::pow(10.0, uniform(rng, -5.0, -3.5));
    add_noise(points, reach, rng);
    const auto there = fair_and_check(measured(points, reach), std::to_string(i));
    std::reverse(points.begin(), points.end());
    const auto back = fair_and_check(measured(points, reach), std::to_string(i) + " back");
    EXPECT_EQ(there.vertices_lower_bound, back.vertices_lower_bound) << i;
    same += there.vertices == back.vertices ? 1 : 0;
  }
  EXPECT_GE(same, kSeries - 1);  // a search may stop elsewhere
}

TEST(Fair, SizeAndPlaceDoNotMatter) {
  std::mt19937_64 rng(15);
  auto points = meander(150, 2.0, 0.8);
  add_noise(points, 1e-4, rng);
  const auto f = fair_and_check(measured(points, 1e-4), "as it is");
  EXPECT_EQ(f.vertices, 3);
  for (const double scale : {1e-9, 1e-3, 1e9}) {
    const double turn = uniform(rng, 0.0, kTurn);
    const Vec2 u = unit_at(turn), shift = scale * Vec2{3.0, -5.0};
    std::vector<Vec2> moved;
    for (const Vec2 p : points) moved.push_back(shift + scale * complex_product(u, p));
    const auto g = fair_and_check(measured(moved, 1e-4 * scale), std::to_string(scale));
    EXPECT_EQ(g.vertices, f.vertices) << scale;
    EXPECT_EQ(g.vertices_lower_bound, f.vertices_lower_bound) << scale;
    ASSERT_EQ(g.elements.size(), f.elements.size()) << scale;
    for (std::size_t i = 0; i < f.elements.size(); ++i) {
      const Vec2 expected = shift + scale * complex_product(u, f.elements[i].point);
      EXPECT_LT(norm(g.elements[i].point - expected), kSettled * 1e-4 * scale)
          << scale << ", node " << i;
      EXPECT_NEAR(g.elements[i].kappa * scale, f.elements[i].kappa, kSettled * curvature_by(f, i))
          << scale << ", node " << i;
    }
  }
}

TEST(Fair, SameInputSameResultBitForBit) {
  std::mt19937_64 rng(16);
  auto points = meander(300, 3.0, 0.8);
  add_noise(points, 1e-4, rng);
  const auto series = measured(points, 1e-4);
  const auto a = faired(series), b = faired(series);
  ASSERT_EQ(a.elements.size(), b.elements.size());
  for (std::size_t i = 0; i < a.elements.size(); ++i) {
    EXPECT_EQ(std::memcmp(&a.elements[i], &b.elements[i], sizeof(Element)), 0) << i;
  }
  EXPECT_EQ(a.newton_steps, b.newton_steps);
}

TEST(Fair, PointsWithoutReachStayWhereTheyAre) {
  std::mt19937_64 rng(17);
  auto points = meander(80, 1.0, 0.8);
  auto series = measured(points, 1e-4);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % 10 == 5) {
      series.reach[i] = 0.0;
    } else {
      const double r = 1e-4 * uniform(rng, -0.7, 0.7);
      series.points[i] = points[i] + r * unit_at(uniform(rng, 0.0, kTurn));
    }
  }
  const auto f = fair_and_check(series, "fixed points");
  EXPECT_EQ(f.vertices, 1);
  int stayed = 0;
  for (std::size_t k = 0; k < f.elements.size(); ++k) {
    if (!f.source[k] || series.reach[*f.source[k]] > 0.0) continue;
    EXPECT_EQ(f.elements[k].point, series.points[*f.source[k]]);
    ++stayed;
  }
  EXPECT_EQ(stayed, 8);  // every one of them is a node
}

TEST(Fair, GivenHeadingsCurvaturesAndSignsAreKept) {
  std::mt19937_64 rng(18);
  constexpr double kStart = 0.2, kRate = 1.0, kLength = 1.5;
  auto points = clothoid(60, kLength, kStart, kRate);
  auto series = measured(points, 1e-4);
  add_noise(series.points, 1e-4, rng);
  series.nodes.resize(points.size());
  const auto kappa_at = [&](double s) { return kStart + kRate * s; };
  series.nodes.front().theta = 0.0;
  series.nodes.back().kappa = kappa_at(kLength);
  for (auto& node : series.nodes) node.curvature_sign = 1;
  const auto f = fair_and_check(series, "fixed data");
  EXPECT_NEAR(f.elements.front().theta, 0.0, 1e-12);
  EXPECT_NEAR(f.elements.back().kappa, kappa_at(kLength), 1e-9);
  for (const Element& e : f.elements) EXPECT_GT(e.kappa, 0.0);
  EXPECT_EQ(f.vertices, 0);
}

/// Whatever the points are: an answer, finite, with every node in its place. When it is feasible,
/// every promise holds.
void expect_sane(const MeasuredSeries& series, const std::string& what) {
  const FairedSeries f = faired(series);
  if (f.feasible) expect_promises(series, f, what);
  for (const Element& e : f.elements) {
    EXPECT_TRUE(std::isfinite(e.point.x + e.point.y + e.theta + e.kappa)) << what;
  }
  EXPECT_GE(f.vertices, 0) << what;
}

TEST(FairHostile, NeighboursThatAreNearlyEqual) {
  auto points = meander(60, 1.0, 0.8);
  std::vector<Vec2> twice;
  for (const Vec2 p : points) {
    twice.push_back(p);
    twice.push_back({p.x + 1e-13, p.y});
  }
  expect_sane(measured(twice, 1e-4), "pairs");
  expect_sane(measured(twice, 1e-9), "pairs, small reach");
}

TEST(FairHostile, Staircases) {
  std::vector<Vec2> stairs;
  for (int i = 0; i < 200; ++i) stairs.push_back({i * 0.5, std::floor(i / 2.0)});
  for (const double reach : {0.01, 0.5, 0.8, 5.0}) {
    expect_sane(measured(stairs, reach), "stairs, " + std::to_string(reach));
  }
  std::vector<Vec2> circle;  // on the pixel grid
  for (const Vec2 p : ellipse(300, 30.0, 20.0)) {
    const Vec2 q{std::round(p.x), std::round(p.y)};
    if (circle.empty() || !(circle.back() == q)) circle.push_back(q);
  }
  if (circle.front() == circle.back()) circle.pop_back();
  const auto pixels = measured(circle, 0.75, true);
  expect_sane(pixels, "pixels");
}

TEST(FairHostile, SpacingFromOneToAThousandAndReachBeyondIt) {
  std::mt19937_64 rng(19);
  for (int i = 0; i < 40; ++i) {
    std::vector<double> at = {0.0};
    while (at.size() < 60) at.push_back(at.back() + std::pow(10.0, uniform(rng, -3.0, 0.0)));
    const double length = at.back();
    auto points = trace([&](double s) { return std::sin(5.0 * s / length); }, at, 1e-2);
    const double reach = std::pow(10.0, uniform(rng, -6.0, -1.0));
    add_noise(points, reach, rng);
    expect_sane(measured(points, reach), std::to_string(i) + ", reach " + std::to_string(reach));
  }
}

TEST(FairHostile, FewestPoints) {
  expect_sane(measured({{0, 0}, {1, 0.1}, {2, 0.5}, {3, 1.0}}, 1e-3), "four");
  expect_sane(measured({{0, 0}, {1, 0}, {2, 0}, {3, 0}}, 1e-3), "four on a line");
  expect_sane(measured({{0, 0}, {1, 0}, {0.5, 0.8}}, 1e-3, true), "three, closed");
  expect_sane(measured(ellipse(12, 1.0, 1.0), 1e-6, true), "circle");
  expect_sane(measured(ellipse(12, 1.0, 1.0), 2.0, true), "circle within its tolerance");
}

}  // namespace
}  // namespace obvid
