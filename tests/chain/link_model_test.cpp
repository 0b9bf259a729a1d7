// SPDX-License-Identifier: Apache-2.0
// Derivatives of the chain's merit function against differences of it. The Hessian is Gauss and
// Newton's: that of the merit in m, q, sigma and S, seen through their first derivatives.
#include "link_model.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "../common/merit_by_hand.h"
#include "../common/plane_curves.h"

namespace obvid::chain_detail {
namespace {

using test::Long;
using test::uniform;

constexpr double kOfExistence = 1.05;  ///< of mere existence, docs/methods/chain.md section 1

/// Random points whose neighbouring chords turn by up to 0.9 rad, with cones, directions, wanted
/// signs and fixed data of every kind.
struct Problem {
  std::vector<Vec2> points;
  ChainProblem problem;
  std::vector<double> x;  ///< sigma between about -1.5 and 1.5

  Problem(std::mt19937_64& rng, Cone cone) {
    constexpr std::size_t kPoints = 6;
    double theta = uniform(rng, -3.0, 3.0);
    Vec2 at{1.0, -2.0};
    for (std::size_t i = 0; i < kPoints; ++i) {
      points.push_back(at);
      at = at + uniform(rng, 0.5, 2.0) * unit_at(theta);
      theta += uniform(rng, -0.9, 0.9);
    }
    problem.chords = measure_chords(points);
    problem.circles = measure_circles(points, problem.chords);
    problem.nodes.resize(kPoints);
    for (std::size_t i = 0; i + 1 < kPoints; ++i) {
      const bool none = rng() % 8 == 0;
      problem.direction.push_back(none             ? std::int8_t{0}
                                  : rng() % 2 == 0 ? std::int8_t{1}
                                                   : std::int8_t{-1});
      problem.cone.push_back(none ? Cone::kNone : cone);
    }
    for (NodeData& node : problem.nodes) {
      if (rng() % 3 == 0) node.curvature_sign = rng() % 2 == 0 ? 1 : -1;
      if (rng() % 6 == 0) node.theta = uniform(rng, -3.0, 3.0);
      if (rng() % 6 == 0) node.kappa = uniform(rng, -1.0, 1.0);
    }
    for (std::size_t k = 0; k < 2 * kPoints; ++k) x.push_back(uniform(rng, -0.75, 0.75));
  }

  [[nodiscard]] bool fixed(std::size_t unknown) const {
    const NodeData& node = problem.nodes[unknown / 2];
    return unknown % 2 == 0 ? node.theta.has_value() : node.kappa.has_value();
  }
  /// Next to no link with a cone: the unknown takes part in nothing.
  [[nodiscard]] bool idle(std::size_t unknown) const {
    const std::size_t i = unknown / 2;
    const bool before = i == 0 || problem.cone[i - 1] == Cone::kNone;
    const bool after = i + 1 == problem.nodes.size() || problem.cone[i] == Cone::kNone;
    const bool sign = problem.nodes[i].curvature_sign != 0 && !problem.nodes[i].kappa;
    return before && after && !(sign && unknown % 2 == 1);
  }
};

/// Largest slack that any link or sign needs, with room.
double enough_slack(const LinkModel& model, const std::vector<double>& x) {
  double slack = 1.0;
  while (!model.inside(x, slack)) slack *= 1.5;
  return 1.5 * slack;
}

double moved(double value, double by) { return value + by; }

/// Gradient and Hessian of unknowns, the slack last, as the system holds them.
struct Assembled {
  std::vector<double> g;
  std::vector<std::vector<double>> h;

  Assembled(const LinkModel& model, const std::vector<double>& x, double slack, double energy,
            double barrier) {
    NewtonSystem system;
    model.assemble(x, slack, energy, barrier, system);
    const std::size_t n = x.size();
    g.assign(n + 1, 0.0);
    h.assign(n + 1, std::vector<double>(n + 1, 0.0));
    const auto put = [&](std::size_t r, std::size_t c, double v) { h[r][c] = h[c][r] = v; };
    for (std::size_t i = 0; i < n / 2; ++i) {
      const NewtonSystem::Block& b = system[i];
      const std::size_t r = 2 * i;
      g[r] = b.g0;
      g[r + 1] = b.g1;
      put(r, r, b.a00);
      put(r + 1, r, b.a10);
      put(r + 1, r + 1, b.a11);
      put(r, n, b.c0);
      put(r + 1, n, b.c1);
      if (i + 1 == n / 2) break;
      put(r, r + 2, b.o00);
      put(r, r + 3, b.o01);
      put(r + 1, r + 2, b.o10);
      put(r + 1, r + 3, b.o11);
    }
    g[n] = system.slack_gradient;
    h[n][n] = system.slack_hessian;
  }
};

TEST(LinkModel, GradientIsThatOfTheMerit) {
  std::mt19937_64 rng(1);
  int beyond = 0;
  for (int k = 0; k < 300; ++k) {
    Problem p(rng, k % 2 == 0 ? Cone::kClosedForm : Cone::kSpiral);
    const LinkModel model(p.problem);
    const double slack = enough_slack(model, p.x);
    const double energy = k % 3 == 0 ? 0.0 : 0.7, barrier = k % 3 == 1 ? 0.2 : 1.0;
    const Assembled a(model, p.x, slack, energy, barrier);
    double largest = 0.0;
    for (const double g : a.g) largest = std::max(largest, std::abs(g));
    for (const LinkState& link : model.links(p.x)) beyond += std::abs(link.sigma) > 1.3 ? 1 : 0;
    for (std::size_t i = 0; i <= p.x.size(); ++i) {
      if (i < p.x.size() && p.fixed(i)) {
        EXPECT_EQ(a.g[i], 0.0) << k;
        continue;
      }
      const double step = 1e-4 * (i < p.x.size() ? 1.0 : slack);
      const auto value = [&](double by) {
        std::vector<double> x = p.x;
        if (i < x.size()) x[i] += by;
        return model.merit(x, i < x.size() ? slack : moved(slack, by), energy, barrier);
      };
      const double numeric =
          (8.0 * (value(step) - value(-step)) - (value(2.0 * step) - value(-2.0 * step))) /
          (12.0 * step);
      EXPECT_NEAR(a.g[i], numeric, 1e-6 * largest) << k << ", unknown " << i;
    }
  }
  EXPECT_GT(beyond, 40);
}

/// Sum over links of J^T H J: H of the merit written by hand, with S linear in sigma; J of the
/// links' A, B, sigma by differences.
std::vector<std::vector<double>> gauss_newton(const Problem& p, const LinkModel& model,
                                              double slack, double energy, double barrier,
                                              const std::vector<double>& size,
                                              const std::vector<double>& sign_size) {
  const std::size_t n = p.x.size();
  std::vector<std::vector<double>> h(n + 1, std::vector<double>(n + 1, 0.0));
  const auto links_at = [&](std::size_t unknown, double by) {
    std::vector<double> x = p.x;
    x[unknown] += by;
    return model.links(x);
  };
  const std::vector<LinkState> now = model.links(p.x);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (p.problem.cone[i] == Cone::kNone) continue;
    const LinkState& s = now[i];
    const double scale = size[i];
    const test::ConeMerit merit{p.problem.cone[i],
                                kOfExistence,
                                static_cast<Long>(p.problem.direction[i]),
                                scale,
                                kFairEnergy,
                                energy / (scale * scale),
                                barrier};
    const auto linear = merit.with_linear_width_at(s.sigma);
    const std::array<Long, 4> at = {s.B - s.A, s.A + s.B, s.sigma, slack};
    std::array<std::array<double, 4>, 5> J{};  // by the four unknowns of the link and the slack
    std::array<std::size_t, 5> place{};
    for (std::size_t k = 0; k < 4; ++k) {
      place[k] = 2 * i + k;
      constexpr double kStep = 1e-5;
      const LinkState up = links_at(place[k], kStep)[i], down = links_at(place[k], -kStep)[i];
      const auto slope = [&](double a, double b) { return (a - b) / (2.0 * kStep); };
      J[k] = {slope(up.B - up.A, down.B - down.A), slope(up.A + up.B, down.A + down.B),
              slope(up.sigma, down.sigma), 0.0};
    }
    place[4] = n;
    J[4] = {0.0, 0.0, 0.0, 1.0};
    std::array<std::array<double, 4>, 4> H{};
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t l = 0; l < 4; ++l) {
        H[k][l] = static_cast<double>(test::partial(
            [&](const std::array<Long, 4>& y) { return test::partial(linear, y, k); }, at, l));
      }
    }
    for (std::size_t a = 0; a < 5; ++a) {
      for (std::size_t b = 0; b < 5; ++b) {
        for (std::size_t k = 0; k < 4; ++k) {
          for (std::size_t l = 0; l < 4; ++l) h[place[a]][place[b]] += J[a][k] * H[k][l] * J[b][l];
        }
      }
    }
  }
  for (std::size_t i = 0; i < p.problem.nodes.size(); ++i) {  // - barrier/2 log(sign curvature)
    const NodeData& node = p.problem.nodes[i];
    if (node.curvature_sign == 0 || node.kappa) continue;
    const double before = p.problem.chords[i > 0 ? i - 1 : 0].length;
    const double after = p.problem.chords[i + 1 < p.problem.nodes.size() ? i : i - 1].length;
    const double length = 0.5 * (before + after), sign = node.curvature_sign;
    const double v =
        sign * (p.problem.circles[i].kappa * length + p.x[2 * i + 1]) + slack * sign_size[i];
    const double w = 0.5 * barrier / (v * v);
    h[2 * i + 1][2 * i + 1] += w;
    h[2 * i + 1][n] += w * sign * sign_size[i];
    h[n][2 * i + 1] += w * sign * sign_size[i];
    h[n][n] += w * sign_size[i] * sign_size[i];
  }
  return h;
}

/// Units of the links, docs/methods/chain.md section 4.
std::vector<double> sizes_by_hand(const ChainProblem& p) {
  const std::size_t m = p.chords.size();
  std::vector<double> rate(m, 0.0), size(m);
  for (std::size_t i = 1; i + 1 < m; ++i) {
    const double third = (p.chords[i - 1].length + p.chords[i].length + p.chords[i + 1].length) / 3;
    rate[i] = std::abs(p.circles[i + 1].kappa - p.circles[i].kappa) / third;
  }
  rate[0] = rate[1];
  rate[m - 1] = rate[m - 2];
  for (std::size_t i = 0; i < m; ++i) {
    const double beside = 0.5 * (rate[i > 0 ? i - 1 : i] + rate[i + 1 < m ? i + 1 : i]);
    size[i] = std::max(rate[i], beside) * p.chords[i].length * p.chords[i].length / 3.0;
  }
  return size;
}

TEST(LinkModel, HessianIsGaussAndNewtons) {
  std::mt19937_64 rng(2);
  for (int k = 0; k < 60; ++k) {
    Problem p(rng, k % 2 == 0 ? Cone::kClosedForm : Cone::kSpiral);
    const LinkModel model(p.problem);
    const double slack = enough_slack(model, p.x), energy = 0.7, barrier = 0.3;
    const std::vector<double> size = sizes_by_hand(p.problem);
    std::vector<double> sign_size;
    for (std::size_t i = 0; i < p.problem.nodes.size(); ++i) {
      sign_size.push_back(size[i > 0 ? i - 1 : 0] + size[std::min(i, size.size() - 1)]);
    }
    const auto expected = gauss_newton(p, model, slack, energy, barrier, size, sign_size);
    const Assembled a(model, p.x, slack, energy, barrier);
    const std::size_t n = p.x.size();
    for (std::size_t r = 0; r <= n; ++r) {
      for (std::size_t c = 0; c <= n; ++c) {
        const bool out =
            (r < n && (p.fixed(r) || p.idle(r))) || (c < n && (p.fixed(c) || p.idle(c)));
        const double want = out ? (r == c ? 1.0 : 0.0) : expected[r][c];
        const double unit = std::sqrt(std::abs(expected[r][r] * expected[c][c]));
        EXPECT_NEAR(a.h[r][c], want, 1e-6 * unit + 1e-12) << k << ": " << r << ", " << c;
      }
    }
  }
}

}  // namespace
}  // namespace obvid::chain_detail
