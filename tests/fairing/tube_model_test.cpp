// SPDX-License-Identifier: Apache-2.0
// Derivatives of the merit function against differences of it.
#include "tube_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "measured_curves.h"
#include "run_search.h"

namespace obvid::fairing_detail {
namespace {

using test::uniform;

/// A hand-made tube on an arc-like spiral: nodes with rows between them, one sign wanted, one
/// primitive in the middle; all merit terms take part.
struct Fixture {
  Tube tube;
  std::vector<std::int8_t> direction;
  State x;

  Fixture(double bend, bool closed, bool primitive) {
    constexpr std::size_t kNodes = 6;
    tube.closed = closed;
    // closed: a full turn, an ellipse; open: curvature bend (1 + s), s in 0..1
    const auto heading_at = [&](double s) { return bend * (s + 0.5 * s * s); };
    const auto points = closed ? test::ellipse(kNodes, 1.2, 1.0)
                               : test::trace(heading_at, test::even_steps(kNodes, 1.0), 1e-3);
    for (std::size_t i = 0; i < kNodes; ++i) {
      TubeNode n;
      const double s = static_cast<double>(i) / (kNodes - 1);
      n.point = points[i];
      n.theta = closed ? heading(points[(i + 1) % kNodes] - points[(i + kNodes - 1) % kNodes])
                       : heading_at(s);
      n.kappa = closed ? 0.9 : bend * (1.0 + s);
      n.normal = left_normal(unit_at(n.theta));
      n.reach = 0.01;
      n.length = closed ? 1.0 : 0.2;
      tube.nodes.push_back(n);
    }
    if (!closed) tube.nodes[1].sign = 1.0;
    if (primitive) make_primitive(tube.nodes[3]);
    for (std::size_t i = 0; i < tube.links(); ++i) {
      tube.first_row.push_back(tube.rows.size());
      tube.size.push_back(0.02 + 0.003 * static_cast<double>(i));
      direction.push_back(i % 2 == 0 ? 1 : -1);
      const Vec2 a = points[i], b = points[(i + 1) % kNodes];
      if (i % 3 == 1) continue;  // a link without rows
      for (const double t : {0.3, 0.55}) {
        tube.rows.push_back({a + t * (b - a) - 0.02 * bend * left_normal(b - a), 0.2});
      }
    }
    tube.first_row.push_back(tube.rows.size());
    x.assign(kPerNode * kNodes, 0.0);
    std::mt19937_64 rng(7);
    for (double& v : x) v = uniform(rng, -0.02, 0.02) * std::max(bend, 0.05);
  }

  void make_primitive(TubeNode& n) {
    n.before = 0.03;
    n.after = 0.02;
    n.length = 0.05;
    for (const double s : {-0.03, 0.0, 0.02}) {
      tube.on_primitives.push_back(
          {n.point + s * unit_at(n.theta) + (0.5 * n.kappa * s * s + 0.001) * n.normal, 0.01});
    }
    n.first_on = 0;
    n.last_on = 3;
  }
};

/// Everything the merit and its assembled derivatives say at one state, the slack last.
class Derivatives {
 public:
  Derivatives(Fixture& f, Cone cone, Weights weights, bool widen)
      : model_(f.tube, f.direction, cone, kFairEnergy), weights_(weights) {
    if (widen) model_.let_slack_widen_the_tube();
  }

  double merit(const State& x, double slack) { return model_.merit(x, slack, weights_); }

  /// The gradient, read off the decrement of unit directions.
  std::vector<double> gradient(const State& x, double slack) {
    model_.assemble(x, slack, weights_, true, system_);
    std::vector<double> g, unit(x.size(), 0.0);
    for (double& u : unit) {
      u = 1.0;
      g.push_back(-system_.decrement(unit, 0.0));
      u = 0.0;
    }
    g.push_back(-system_.decrement(unit, 1.0));
    return g;
  }

 private:
  TubeModel model_;
  Weights weights_;
  BorderedSystem system_;
};

double largest(const std::vector<double>& v) {
  double m = 0.0;
  for (const double e : v) m = std::max(m, std::abs(e));
  return m;
}

void expect_gradient(Fixture f, Cone cone, Weights w, bool widen, const std::string& what) {
  Derivatives d(f, cone, w, widen);
  const double slack = widen ? 0.3 : 60.0;  // so large that all cones hold
  ASSERT_TRUE(std::isfinite(d.merit(f.x, slack))) << what;
  const std::vector<double> g = d.gradient(f.x, slack);
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double step = 1e-6 * (i < f.x.size() ? 1.0 : slack);
    const auto value = [&](double by) {
      State x = f.x;
      if (i < x.size()) x[i] += by;
      return d.merit(x, i < x.size() ? slack : slack + by);
    };
    // fourth order: errors step^4 and rounding / step
    const double numeric =
        (8.0 * (value(step) - value(-step)) - (value(2 * step) - value(-2 * step))) / (12.0 * step);
    EXPECT_NEAR(g[i], numeric, 1e-6 * largest(g)) << what << ", unknown " << i;
  }
}

TEST(TubeModel, GradientIsThatOfTheMerit) {
  for (const bool closed : {false, true}) {
    for (const bool primitive : {false, true}) {
      for (const Cone cone : {Cone::kSpiral, Cone::kClosedForm}) {
        const std::string what = std::string(closed ? "closed" : "open") +
                                 (primitive ? ", primitive" : "") +
                                 (cone == Cone::kSpiral ? ", spiral" : ", closed form");
        const Fixture f(1.0, closed, primitive);
        expect_gradient(f, cone, {0.0, 1.0, 0.0}, false, what + ": cones");
        expect_gradient(f, cone, {1.0, 0.0, 0.0}, false, what + ": energy");
        expect_gradient(f, cone, {0.0, 0.0, 1.0}, false, what + ": tube");
        expect_gradient(f, cone, {0.3, 1.0, 0.5}, false, what + ": all");
        expect_gradient(f, cone, {0.3, 0.0, 1.0}, true, what + ": widened tube");
      }
    }
  }
}

TEST(TubeModel, MeritIsInfiniteOutsideTheTubeAndTheCones) {
  Fixture f(0.5, false, false);
  TubeModel model(f.tube, f.direction, Cone::kSpiral, kFairEnergy);
  EXPECT_TRUE(std::isfinite(model.merit(f.x, 60.0, {1.0, 1.0, 1.0})));
  EXPECT_EQ(model.merit(f.x, 0.0, {1.0, 1.0, 1.0}), INFINITY);  // the directions alternate
  f.x[0] = 1.0;
  EXPECT_EQ(model.merit(f.x, 60.0, {1.0, 1.0, 1.0}), INFINITY);
  f.x[0] = -1.01;
  EXPECT_EQ(model.merit(f.x, 60.0, {0.0, 0.0, 1.0}), INFINITY);
  model.let_slack_widen_the_tube();
  EXPECT_TRUE(std::isfinite(model.merit(f.x, 0.02, {0.0, 0.0, 1.0})));
}

}  // namespace
}  // namespace obvid::fairing_detail
