// SPDX-License-Identifier: Apache-2.0
// Headings and curvatures of a series: inside every cone, the same at every scale, true to what is
// fixed, and refused with the reason where nothing fits.
#include "obvid/chain/internal/series_chain.h"
#include "../common/angles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "../common/oracle_curves.h"
#include "feasible_series.h"

namespace obvid {
namespace {

using namespace test;

Result<SeriesChain> chain_of(const std::vector<Vec2>& points,
                             const ChainConstraints& constraints = {}) {
  const auto analysis = analyse(points);
  if (!analysis) return tl::unexpected(analysis.error());
  Watch nobody;
  return choose_elements(points, *analysis, constraints, nobody);
}

/// Whether a spiral exists between two elements ([Kurnosenko 2013]), from their numbers alone.
/// Headings belong to the turn that lies within half a turn of the expected angle at the start.
bool spiral_exists(const Element& a, const Element& b, int direction, double alpha_expected) {
  const long double dx = static_cast<long double>(b.point.x) - static_cast<long double>(a.point.x);
  const long double dy = static_cast<long double>(b.point.y) - static_cast<long double>(a.point.y);
  const long double h = std::hypot(dx, dy), omega = std::atan2(dy, dx);
  const long double full = 2.0L * std::numbers::pi_v<long double>;
  const long double raw = static_cast<long double>(a.theta) - omega;
  const long double turns =
      full * std::round((raw - static_cast<long double>(alpha_expected)) / full);
  const long double alpha = raw - turns, beta = static_cast<long double>(b.theta) - omega - turns;
  const long double A =
      direction * (static_cast<long double>(a.kappa) * h / 2.0L + std::sin(alpha));
  const long double B = direction * (static_cast<long double>(b.kappa) * h / 2.0L - std::sin(beta));
  const long double half = std::sin((alpha + beta) / 2.0L);
  return A < 0.0L && B > 0.0L && direction * (alpha + beta) > 0.0L && A * B + half * half < 0.0L;
}

/// Every promise of a chain, checked from its elements.
void expect_inside_all_cones(const SeriesChain& chain, const std::string& what) {
  EXPECT_GT(chain.smallest_margin, 0.0) << what;
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    if (chain.cone[i] == Cone::kNone) continue;
    EXPECT_GT(cone_margin(chain.links[i], chain.direction[i], chain.cone[i]), 0.0)
        << what << ", link " << i;
    EXPECT_TRUE(spiral_exists(chain.elements[i], chain.elements[i + 1], chain.direction[i],
                              chain.links[i].alpha))
        << what << ", link " << i;
    EXPECT_GT(chain.direction[i] * (chain.elements[i + 1].kappa - chain.elements[i].kappa), 0.0)
        << what << ", link " << i;
  }
}

/// A series whose coordinates hold the curve well: similar steps, near the origin.
Sampled even_series(int i, std::mt19937_64& rng) {
  for (;;) {
    Sampled s = random_series(static_cast<Oracle>(i % kOracleCount), rng, kRightAngle);
    if (s.offset_sizes == 0.0 && !s.uneven) return s;
  }
}

TEST(SeriesChain, RandomSpiralsLieInsideAllConesAfterFewSteps) {
  constexpr int kSeries = 400;
  std::mt19937_64 rng(11);
  std::vector<int> steps;
  for (int i = 0; i < kSeries; ++i) {
    const Sampled s = random_series(static_cast<Oracle>(i % kOracleCount), rng, kRightAngle);
    if (s.offset_sizes > 0.0) continue;  // their rounding is the subject of other tests
    const auto chain = chain_of(s.points);
    const std::string what = std::to_string(i) + ": " + name_of(s.curve.kind);
    if (!chain) {
      EXPECT_EQ(chain.error().code, ErrorCode::kRoundingDecides) << what;
      continue;
    }
    EXPECT_TRUE(chain->converged) << what;
    expect_inside_all_cones(*chain, what);
    steps.push_back(chain->newton_steps);
  }
  ASSERT_GT(steps.size(), 150U);
  std::sort(steps.begin(), steps.end());
  std::printf("%zu series, Newton steps: median %d, largest %d\n", steps.size(),
              steps[steps.size() / 2], steps.back());
  EXPECT_LE(steps[steps.size() / 2], 12);
  EXPECT_LE(steps.back(), 200);
}

TEST(SeriesChain, WhatThePrototypeFoundFeasibleIsFeasible) {
  ASSERT_EQ(feasible_series().size(), 20U);
  for (std::size_t i = 0; i < feasible_series().size(); ++i) {
    const auto chain = chain_of(feasible_series()[i]);
    ASSERT_TRUE(chain) << i << ": " << to_line(chain.error());
    EXPECT_EQ(chain->turned_directions, 0U) << i;
    EXPECT_EQ(chain->free_elements, 0U) << i;  // the prototype's cone is that of one closed form
    expect_inside_all_cones(*chain, std::to_string(i));
  }
}

TEST(SeriesChain, ScaleChangesCurvaturesOnly) {
  /// Scaled decimal numbers are rounded again; the curvature differences of these coarse series
  /// feel it some thousand times.
  constexpr double kSame = 1e-9;
  for (const auto& points : feasible_series()) {
    const auto chain = chain_of(points);
    ASSERT_TRUE(chain);
    for (const double scale : {1e-9, 1e-6, 0x1p-20, 3.0, 0x1p30, 1e6, 1e9}) {
      std::vector<Vec2> scaled;
      for (const Vec2 p : points) scaled.push_back(scale * p);
      const auto other = chain_of(scaled);
      ASSERT_TRUE(other) << scale;
      int power = 0;
      const bool exact = std::frexp(scale, &power) == 0.5;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Element &a = chain->elements[i], &b = other->elements[i];
        if (exact) {
          EXPECT_EQ(a.theta, b.theta);
          EXPECT_EQ(a.kappa, b.kappa * scale);
        } else {
          EXPECT_NEAR(a.theta, b.theta, kSame);
          EXPECT_NEAR(a.kappa, b.kappa * scale, kSame * std::abs(a.kappa) + 1e-15);
        }
      }
    }
  }
}

TEST(SeriesChain, FixedHeadingsAndCurvaturesAreMet) {
  /// Headings are stored as differences from the chords.
  constexpr double kSameHeading = 1e-12;
  /// Headings and curvatures are moved by this part of the room that the points leave.
  constexpr double kMoved = 0.1;
  std::mt19937_64 rng(12);
  int met = 0;
  for (int i = 0; i < 60; ++i) {
    const Sampled s = even_series(i, rng);
    const auto free = chain_of(s.points);
    ASSERT_TRUE(free) << i;
    if (free->free_elements > 0) continue;
    const std::size_t n = s.points.size(), at = rng() % n;
    const std::size_t link = at + 1 < n ? at : at - 1;
    const Element e = free->elements[at];
    ChainConstraints constraints;
    constraints.fixed.resize(n);
    const double turns = 2.0 * std::numbers::pi * static_cast<double>(rng() % 3);
    if (i % 3 != 1)
      constraints.fixed[at].theta = e.theta + kMoved * free->links[link].sigma + turns;
    if (i % 3 != 0) {
      const double change = free->elements[link + 1].kappa - free->elements[link].kappa;
      constraints.fixed[at].kappa = e.kappa + kMoved * (at + 1 < n ? change : -change);
    }
    const auto fixed = chain_of(s.points, constraints);
    ASSERT_TRUE(fixed) << i << ": " << to_line(fixed.error());
    std::size_t node = 0;
    while (fixed->source[node] != at) ++node;
    const Element& f = fixed->elements[node];
    if (constraints.fixed[at].theta) {
      const double off = f.theta - *constraints.fixed[at].theta;
      EXPECT_NEAR(std::remainder(off, 2.0 * std::numbers::pi), 0.0, kSameHeading) << i;
    }
    EXPECT_EQ(f.kappa, constraints.fixed[at].kappa.value_or(f.kappa)) << i;  // to the last bit
    EXPECT_EQ(fixed->turned_directions, 0U) << i;
    expect_inside_all_cones(*fixed, std::to_string(i));
    ++met;
  }
  EXPECT_GT(met, 40);
}

/// Eight points of a circle involute, counter-clockwise with falling curvature.
std::vector<Vec2> involute_points() {
  std::vector<Vec2> points;
  for (int i = 0; i < 8; ++i) {
    const double t = 1.0 + 0.4 * i;
    points.push_back({std::cos(t) + t * std::sin(t), std::sin(t) - t * std::cos(t)});
  }
  return points;
}

TEST(SeriesChain, ContradictoryFixedDataAreRefused) {
  const std::vector<Vec2> points = involute_points();
  const auto free = chain_of(points);
  ASSERT_TRUE(free);
  const auto refused = [&](const char* what, std::size_t at, auto set) {
    ChainConstraints constraints;
    constraints.fixed.resize(points.size());
    set(constraints.fixed, at);
    const auto chain = chain_of(points, constraints);
    ASSERT_FALSE(chain) << what << ": turned " << chain->turned_directions;
    EXPECT_EQ(chain.error().code, ErrorCode::kFixedDataContradict) << what;
    EXPECT_FALSE(chain.error().where.empty()) << what;
  };
  refused("a heading across the curve", 4, [&](std::vector<FixedData>& f, std::size_t at) {
    f[at].theta = free->elements[at].theta + 0.5 * std::numbers::pi;
  });
  refused("a heading backwards", 3, [&](std::vector<FixedData>& f, std::size_t at) {
    f[at].theta = free->elements[at].theta + std::numbers::pi;
  });
  refused("the curvature of a point far ahead", 2, [&](std::vector<FixedData>& f, std::size_t at) {
    f[at].kappa = free->elements[at + 4].kappa;
  });
  refused("curvatures in the wrong order", 2, [&](std::vector<FixedData>& f, std::size_t at) {
    f[at].kappa = free->elements[at + 1].kappa;
    f[at + 1].kappa = free->elements[at].kappa;
  });
  refused("a curvature of the other sign", 4,
          [&](std::vector<FixedData>& f, std::size_t at) { f[at].kappa = -1.0; });
}

TEST(SeriesChain, AConvexWishIsKeptOrRefused) {
  const std::vector<Vec2> bend = involute_points();
  ChainConstraints convex;
  convex.convex = true;
  const auto kept = chain_of(bend, convex);
  ASSERT_TRUE(kept) << to_line(kept.error());
  for (const Element& e : kept->elements) EXPECT_GT(e.kappa, 0.0);
  std::vector<Vec2> wave;
  for (int i = 0; i <= 12; ++i) wave.push_back({0.5 * i, std::sin(0.5 * i)});
  const auto refused = chain_of(wave, convex);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kFixedDataContradict);
}

/// Points on y = f(x) with unit steps: adjacent curvatures are second differences of y, and a
/// spiral needs the first differences of these (the third of y) to vary moderately.
std::vector<Vec2> from_third_differences(const std::vector<double>& third, double scale) {
  double y = 0.0, first = 0.0, second = 1.0;
  std::vector<Vec2> points = {{0.0, 0.0}};
  for (std::size_t i = 0; i <= third.size() + 1; ++i) {
    first += second;
    second += i < third.size() ? third[i] : third.back();
    y += first;
    points.push_back({static_cast<double>(i + 1), scale * y});
  }
  return points;
}

TEST(SeriesChain, MonotoneAdjacentCirclesDoNotSufficeAndDirectionsAreTurned) {
  // third differences 1, e, 1, e, ...: all positive, but no convex-rate cubic spline follows them
  std::vector<double> third;
  for (int i = 0; i < 9; ++i) third.push_back(i % 2 == 0 ? 1.0 : 1e-3);
  const std::vector<Vec2> points = from_third_differences(third, 1e-4);
  const auto analysis = analyse(points);
  ASSERT_TRUE(analysis);
  EXPECT_EQ(analysis->vertices, 0);
  const auto chain = chain_of(points);
  ASSERT_TRUE(chain) << to_line(chain.error());
  std::printf("turned %zu of %zu directions\n", chain->turned_directions, analysis->chords.size());
  EXPECT_GT(chain->turned_directions, 0U);
  expect_inside_all_cones(*chain, "alternating third differences");
  // steady third differences are a cubic parabola: nothing to turn
  const auto steady = chain_of(from_third_differences(std::vector<double>(9, 1.0), 1e-4));
  ASSERT_TRUE(steady);
  EXPECT_EQ(steady->turned_directions, 0U);
}

TEST(SeriesChain, ZigzagsOfFivePointsGetElementsOrAReason) {
  int found = 0;
  for (const double height : {0.05, 0.2, 0.5, 1.0, 2.0, 5.0}) {
    const std::vector<Vec2> zigzag = {{0, 0}, {1, height}, {2, 0}, {3, height}, {4, 0}};
    const auto chain = chain_of(zigzag);
    if (!chain) {
      EXPECT_EQ(exit_code(chain.error().code), 4) << to_line(chain.error());
      continue;
    }
    ++found;
    expect_inside_all_cones(*chain, std::to_string(height));
  }
  std::printf("%d of 6 zigzags\n", found);
  EXPECT_GE(found, 4);
}

TEST(SeriesChain, FreeElementsLieInsideBothHalves) {
  // random data for which a spiral exists but one closed-form piece does not
  std::mt19937_64 rng(13);
  int split = 0;
  for (int i = 0; i < 20000 && split < 2000; ++i) {
    LinkState link;
    link.h = std::pow(10.0, uniform(rng, -3.0, 3.0));
    link.omega = uniform(rng, -3.0, 3.0);
    link.alpha = uniform(rng, -1.0, 1.0);
    link.sigma = uniform(rng, 1e-3, 0.8);
    link.beta = link.sigma - link.alpha;
    const double half = std::sin(0.5 * link.sigma);
    const double product = half * half * uniform(rng, 1.02, 2.0);
    const double ratio = std::exp(uniform(rng, -1.5, 1.5));
    link.A = -std::sqrt(product * ratio);
    link.B = std::sqrt(product / ratio);
    if (cone_margin(link, 1, Cone::kClosedForm) > 0.0) continue;
    ++split;
    const Vec2 start = {uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0)};
    const Element a = {start, link.omega + link.alpha,
                       2.0 / link.h * (link.A - std::sin(link.alpha))};
    const Element b = {start + link.h * unit_at(link.omega), link.omega + link.beta,
                       2.0 / link.h * (link.B + std::sin(link.beta))};
    const Element middle = free_element(link, 1, start);
    EXPECT_TRUE(spiral_exists(a, middle, 1, link.alpha)) << i;
    EXPECT_TRUE(spiral_exists(middle, b, 1, 0.0)) << i;
  }
  EXPECT_EQ(split, 2000);
}

TEST(SeriesChain, ElementsBeyondALeapLeaveSpiralsOnBothSidesAndTheLeapOnOne) {
  // the curvature leaps at one end by up to 1e6 times what the rest of the link asks for
  std::mt19937_64 rng(14);
  for (int i = 0; i < 2000; ++i) {
    const int direction = i % 2 == 0 ? 1 : -1;
    const bool at_start = i % 4 < 2;
    const double d = direction;
    LinkState link;
    link.h = std::pow(10.0, uniform(rng, -3.0, 3.0));
    link.omega = uniform(rng, -3.0, 3.0);
    const double alpha = uniform(rng, -0.5, 0.5), sigma = std::pow(10.0, uniform(rng, -3.0, -1.0));
    const double half = std::sin(0.5 * sigma), product = half * half * uniform(rng, 1.5, 10.0);
    const double leap = std::pow(10.0, uniform(rng, 2.0, 6.0));
    const double A = -std::sqrt(product) * (at_start ? leap : 1.0 / leap), B = product / -A;
    link.alpha = d * alpha;
    link.beta = d * (sigma - alpha);
    link.sigma = d * sigma;
    link.A = d * A;
    link.B = d * B;
    const Vec2 start{};
    const Element a = {start, link.omega + link.alpha,
                       2.0 / link.h * (link.A - std::sin(link.alpha))};
    const Element b = {link.h * unit_at(link.omega), link.omega + link.beta,
                       2.0 / link.h * (link.B + std::sin(link.beta))};
    const Element middle = element_beyond_leap(link, direction, start);
    EXPECT_TRUE(spiral_exists(a, middle, direction, link.alpha)) << i;
    EXPECT_TRUE(spiral_exists(middle, b, direction, 0.0)) << i;
    // behind the leap the curvature hardly changes any more
    const double rest = std::abs((at_start ? b : a).kappa - middle.kappa);
    EXPECT_LT(rest, 0.1 * std::abs(a.kappa - b.kappa)) << i;
  }
}

}  // namespace
}  // namespace obvid
