// SPDX-License-Identifier: Apache-2.0
// Data around closed series: each chord has a spiral by Kurnosenko's inequality, written here
// again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "obvid/geom/vec2.h"
#include "obvid/region/internal/feasible_data.h"

namespace obvid {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

struct Loop {
  std::vector<Vec2> points;
  std::vector<RangeLink> links;
  std::vector<RangeNode> nodes;
};

/// Points at parameters of the ellipse (a cos t, b sin t), which has its vertices at quarters; the
/// parameters of the vertices are among them, so every chord has one direction.
Loop ellipse_loop(double a, double b, const std::vector<double>& parameters) {
  Loop out;
  for (const double t : parameters) out.points.push_back({a * std::cos(t), b * std::sin(t)});
  const std::size_t n = parameters.size();
  double omega = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 chord = out.points[(i + 1) % n] - out.points[i];
    const double next = std::atan2(chord.y, chord.x);
    omega = i == 0 ? next : omega + std::remainder(next - omega, kTurn);
    const double middle =
        0.5 * (parameters[i] + (i + 1 < n ? parameters[i + 1] : parameters[0] + kTurn));
    // the curvature of an ellipse grows where |cos t| does, for a > b
    const int grows = std::sin(2.0 * middle) < 0.0 ? 1 : -1;
    out.links.push_back({norm(chord), omega, a > b ? grows : -grows});
    out.nodes.emplace_back();
  }
  return out;
}

std::vector<double> with_vertices(std::mt19937& random, double from) {
  std::uniform_real_distribution<double> part(0.1, 0.9);
  std::vector<double> out;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double start = 0.25 * kTurn * quarter;
    out.push_back(start);
    std::vector<double> inner{part(random), part(random), part(random)};
    std::sort(inner.begin(), inner.end());
    for (const double p : inner) out.push_back(start + 0.25 * kTurn * p);
  }
  std::rotate(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(from * 16.0), out.end());
  for (double& t : out) {
    if (t < out.front()) t += kTurn;
  }
  return out;
}

/// Whether a spiral of this direction has both elements.
void expect_spiral(const RangeLink& link, const RangeNode& a, const RangeNode& b) {
  const double d = *link.direction, half = 0.5 * link.h;
  const double alpha = d * (*a.theta - link.omega), beta = d * (*b.theta - link.omega);
  const double A = d * *a.kappa * half + std::sin(alpha), B = d * *b.kappa * half - std::sin(beta);
  const double sine = std::sin(0.5 * (alpha + beta));
  EXPECT_LT(A, 0.0);
  EXPECT_GT(B, 0.0);
  EXPECT_LT(A * B, -sine * sine);
}

TEST(CentralLoop, HasASpiralOverEveryChordAndCloses) {
  std::mt19937 random(20261123);
  std::uniform_real_distribution<double> from(0.0, 0.99);
  for (int round = 0; round < 20; ++round) {
    const Loop loop = ellipse_loop(3.0, 2.0, with_vertices(random, from(random)));
    const auto found = central_loop(loop.links, loop.nodes);
    ASSERT_TRUE(found) << round;
    EXPECT_TRUE(loop_closes(loop.links, loop.nodes)) << round;
    ASSERT_EQ(found->size(), loop.nodes.size() + 1);
    for (std::size_t i = 0; i < loop.links.size(); ++i) {
      expect_spiral(loop.links[i], (*found)[i], (*found)[i + 1]);
    }
    EXPECT_NEAR(*found->back().theta - *found->front().theta, kTurn, 1e-12);
    EXPECT_EQ(*found->back().kappa, *found->front().kappa);
  }
}

TEST(CentralLoop, ClosesWhereItHasACurve) {
  std::mt19937 random(29);
  std::uniform_real_distribution<double> from(0.0, 0.99);
  std::size_t close = 0, open = 0;
  for (int round = 0; round < 5; ++round) {
    const Loop loop = ellipse_loop(3.0, 2.0, with_vertices(random, from(random)));
    for (const double most : {0.2, 0.5, 0.7, 0.74, 0.76, 0.8, 1.0, 4.0}) {
      Loop capped = loop;
      for (RangeNode& node : capped.nodes) node.kappas = ValueRange{-most, most};
      const bool closes = loop_closes(capped.links, capped.nodes);
      EXPECT_EQ(closes, central_loop(capped.links, capped.nodes).has_value())
          << round << ' ' << most;
      ++(closes ? close : open);
    }
  }
  EXPECT_GT(close, 0U);
  EXPECT_GT(open, 0U);
}

TEST(CentralLoop, KeepsWhatIsGiven) {
  std::mt19937 random(7);
  Loop loop = ellipse_loop(3.0, 2.0, with_vertices(random, 0.0));
  // at its vertex the ellipse has the heading of the y axis and the curvature a / b^2
  loop.nodes[0].theta = 0.25 * kTurn;
  loop.nodes[0].kappa = 3.0 / 4.0;
  loop.nodes[5].kappas = ValueRange{0.1, 0.3};
  const auto found = central_loop(loop.links, loop.nodes);
  ASSERT_TRUE(found);
  EXPECT_EQ(*found->front().theta, 0.25 * kTurn);
  EXPECT_EQ(*found->front().kappa, 0.75);
  EXPECT_EQ(*found->back().kappa, 0.75);
  EXPECT_GE(*(*found)[5].kappa, 0.1);
  EXPECT_LE(*(*found)[5].kappa, 0.3);
}

TEST(CentralLoop, TakesWantedCurvaturesThatAreTheEllipses) {
  std::mt19937 random(11);
  const std::vector<double> parameters = with_vertices(random, 0.3);
  Loop loop = ellipse_loop(3.0, 2.0, parameters);
  std::vector<std::optional<double>> wanted;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double s = std::sin(parameters[i]), c = std::cos(parameters[i]);
    wanted.push_back(6.0 / std::pow(9.0 * s * s + 4.0 * c * c, 1.5));
    const double theta = std::atan2(2.0 * c, -3.0 * s);
    loop.nodes[i].theta = loop.links[i].omega + std::remainder(theta - loop.links[i].omega, kTurn);
  }
  const auto found = central_loop(loop.links, loop.nodes, wanted);
  ASSERT_TRUE(found);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    EXPECT_EQ(*(*found)[i].kappa, *wanted[i]) << i;
  }
}

TEST(CentralLoop, RefusesWhatCannotClose) {
  std::mt19937 random(5);
  const Loop loop = ellipse_loop(3.0, 2.0, with_vertices(random, 0.0));
  Loop growing = loop;
  for (RangeLink& link : growing.links) link.direction = 1;
  EXPECT_FALSE(central_loop(growing.links, growing.nodes));
  EXPECT_FALSE(loop_closes(growing.links, growing.nodes));
  Loop blunt = loop;  // a full turn would be 2 pi / 0.2 = 31 long, around an ellipse of 16
  for (RangeNode& node : blunt.nodes) node.kappas = ValueRange{-0.2, 0.2};
  EXPECT_FALSE(central_loop(blunt.links, blunt.nodes));
  EXPECT_FALSE(loop_closes(blunt.links, blunt.nodes));
  Loop across = loop;
  across.nodes[0].theta = 0.0;  // square to the curve
  EXPECT_FALSE(central_loop(across.links, across.nodes));
  EXPECT_FALSE(loop_closes(across.links, across.nodes));
}

}  // namespace
}  // namespace obvid
