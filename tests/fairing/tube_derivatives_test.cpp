// SPDX-License-Identifier: Apache-2.0
// Gradient and Hessian of the tube's merit on random tubes of every kind. The Hessian is Gauss and
// Newton's: that of the merit in m, q, sigma, S(sigma), offsets, turns and residuals, seen through
// their first derivatives; here these come from differences of quantities computed once more by
// hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "../common/merit_by_hand.h"
#include "measured_curves.h"
#include "node_ends.h"
#include "tube_model.h"

namespace obvid::fairing_detail {
namespace {

using test::Long;
using test::uniform;

constexpr double kReserve = 1.0001;  ///< of mere existence in the search

struct LongPoint {
  Long x = 0.0L, y = 0.0L;
};
LongPoint operator-(LongPoint a, LongPoint b) { return {a.x - b.x, a.y - b.y}; }
Long along(LongPoint a, LongPoint b) { return a.x * b.x + a.y * b.y; }
Long across(LongPoint a, LongPoint b) { return a.x * b.y - a.y * b.x; }

struct LongEnd {
  LongPoint p;
  Long theta = 0.0L, kappa = 0.0L;
};

/// Where the node's arc is at the arc length s from its anchor.
LongEnd end_of(const TubeNode& n, const Long* x, Long s) {
  const Long theta = n.theta + x[1], kappa = n.kappa + x[2] / n.length;
  LongEnd out;
  out.p = {n.point.x + x[0] * n.reach * n.normal.x, n.point.y + x[0] * n.reach * n.normal.y};
  if (s != 0.0L) {  // the arcs of these tests are not straight
    out.p.x += (std::sin(theta + kappa * s) - std::sin(theta)) / kappa;
    out.p.y -= (std::cos(theta + kappa * s) - std::cos(theta)) / kappa;
  }
  out.theta = theta + kappa * s;
  out.kappa = kappa;
  return out;
}

struct LinkByHand {
  LongEnd a, b;
  Long h = 0.0L, alpha = 0.0L, beta = 0.0L;

  LinkByHand(const LongEnd& from, const LongEnd& to) : a(from), b(to) {
    const LongPoint c = b.p - a.p;
    h = std::hypot(c.x, c.y);
    const Long omega = std::atan2(c.y, c.x);
    constexpr Long kTurn = 2.0L * std::numbers::pi_v<Long>;
    alpha = std::remainder(a.theta - omega, kTurn);
    beta = std::remainder(b.theta - omega, kTurn);
  }
  [[nodiscard]] std::array<Long, 3> cone() const {
    const Long A = a.kappa * h / 2 + std::sin(alpha), B = b.kappa * h / 2 - std::sin(beta);
    return {B - A, A + B, alpha + beta};
  }
  /// Distance of a point from the quintic Hermite graph over the chord, docs/methods/fairing.md.
  [[nodiscard]] Long residual(const TubeRow& row) const {
    const LongPoint c = b.p - a.p, v = LongPoint{row.point.x, row.point.y} - a.p;
    const Long u = along(c, v) / (h * h), y = across(c, v) / h;
    const Long ta = std::tan(alpha), tb = std::tan(beta);
    const Long ka = h * a.kappa / std::pow(std::cos(alpha), 3.0L);
    const Long kb = h * b.kappa / std::pow(std::cos(beta), 3.0L);
    if (u < 0.0L) return (y - h * u * ta) / row.reach;
    if (u > 1.0L) return (y - h * (u - 1.0L) * tb) / row.reach;
    // polynomial with the given values, slopes and second derivatives at both ends
    const Long u3 = u * u * u, u4 = u3 * u, u5 = u4 * u;
    const Long f = ta * (u - 6 * u3 + 8 * u4 - 3 * u5) + tb * (-4 * u3 + 7 * u4 - 3 * u5) +
                   ka * (u * u - 3 * u3 + 3 * u4 - u5) / 2 + kb * (u3 - 2 * u4 + u5) / 2;
    return (y - h * f) / row.reach;
  }
};

/// A tube of five or six nodes with chords of about 1 that turn by up to 0.5 rad, headings off by
/// up to 0.5: sigma lies between -1.5 and 1.5.
struct RandomTube {
  Tube tube;
  std::vector<std::int8_t> direction;
  State x;

  RandomTube(std::mt19937_64& rng, bool closed, bool primitive, bool fixed) {
    const std::size_t n = closed ? 5 : 6;
    tube.closed = closed;
    std::vector<Vec2> points;
    if (closed) {
      points = test::ellipse(n, 0.9, 0.8, uniform(rng, 0.0, test::kTurn));
    } else {
      double theta = uniform(rng, -3.0, 3.0);
      Vec2 at;
      for (std::size_t i = 0; i < n; ++i) {
        points.push_back(at);
        at = at + uniform(rng, 0.7, 1.4) * unit_at(theta);
        theta += uniform(rng, -0.5, 0.5);
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      TubeNode node;
      node.point = points[i];
      const Vec2 before =
          closed || i > 0 ? points[i] - points[(i + n - 1) % n] : points[i + 1] - points[i];
      const Vec2 after = closed || i + 1 < n ? points[(i + 1) % n] - points[i] : before;
      node.theta = heading(before) + 0.5 * turning(before, after);
      node.kappa = uniform(rng, 0.3, 1.0) * (rng() % 2 == 0 ? 1.0 : -1.0);
      node.normal = left_normal(unit_at(node.theta));
      node.reach = 0.05;
      node.length = uniform(rng, 0.5, 2.0);
      if (rng() % 3 == 0) node.sign = rng() % 2 == 0 ? 1.0 : -1.0;
      if (rng() % 2 == 0) {
        node.turn_low = uniform(rng, -1.5, -0.8);
        node.turn_high = uniform(rng, 0.8, 1.5);
      }
      if (fixed && rng() % 3 == 0) node.reach = 0.0;
      if (fixed && rng() % 4 == 0) node.fix_theta = true;
      if (fixed && rng() % 4 == 0) node.fix_kappa = true;
      tube.nodes.push_back(node);
    }
    if (primitive) {
      for (const std::size_t i : {std::size_t{1}, n - 1}) make_primitive(tube.nodes[i], rng);
    }
    for (std::size_t i = 0; i < tube.links(); ++i) {
      tube.first_row.push_back(tube.rows.size());
      tube.size.push_back(uniform(rng, 0.05, 0.4));
      direction.push_back(rng() % 2 == 0 ? 1 : -1);
      if (rng() % 3 == 0) continue;  // a link without rows
      const Vec2 a = points[i], b = points[(i + 1) % n];
      for (const double t : {-0.1, 0.3, 0.55, 1.05}) {
        tube.rows.push_back({a + t * (b - a), uniform(rng, 0.9, 1.5)});
      }
    }
    tube.first_row.push_back(tube.rows.size());
    for (std::size_t i = 0; i < n; ++i) {
      x.push_back(uniform(rng, -0.8, 0.8));
      x.push_back(uniform(rng, -0.75, 0.75));
      x.push_back(uniform(rng, -0.2, 0.2));
    }
  }

  void make_primitive(TubeNode& n, std::mt19937_64& rng) {
    n.before = uniform(rng, 0.05, 0.2);
    n.after = uniform(rng, 0.05, 0.2);
    n.first_on = tube.on_primitives.size();
    for (const double s : {-n.before, 0.0, n.after}) {
      tube.on_primitives.push_back(
          {n.point + s * unit_at(n.theta) + 0.5 * n.kappa * s * s * n.normal, 1.0});
    }
    n.last_on = tube.on_primitives.size();
  }

  [[nodiscard]] bool fixed(std::size_t unknown) const {
    const TubeNode& n = tube.nodes[unknown / kPerNode];
    const std::size_t which = unknown % kPerNode;
    return which == 0 ? n.reach == 0.0 : which == 1 ? n.fix_theta : n.fix_kappa;
  }
};

struct Case {
  Cone cone = Cone::kSpiral;
  Weights weights;
  bool widen = false;
  double slack = 0.0;
};

/// What the merit is made of, at one state: barriers of distances r in units of half widths, cones.
struct Parts {
  std::vector<Long> walls;  ///< offsets of nodes, residuals of rows and of points on primitives
  std::vector<double> wall_weight;
  std::vector<std::array<Long, 3>> cones;
};

Parts parts_at(const RandomTube& t, const std::vector<Long>& x, double tube_weight) {
  Parts out;
  const Tube& tube = t.tube;
  const auto wall = [&](Long r, double weight) {
    out.walls.push_back(r);
    out.wall_weight.push_back(tube_weight * weight);
  };
  for (std::size_t i = 0; i < tube.nodes.size(); ++i) {
    const TubeNode& n = tube.nodes[i];
    wall(x[kPerNode * i], 1.0);
    if (!n.is_primitive()) continue;
    const LongEnd e = end_of(n, &x[kPerNode * i], 0.0L);
    const LongPoint centre = {e.p.x - std::sin(e.theta) / e.kappa,
                              e.p.y + std::cos(e.theta) / e.kappa};
    for (std::size_t k = n.first_on; k < n.last_on; ++k) {
      const TubeRow& row = tube.on_primitives[k];
      const LongPoint v = LongPoint{row.point.x, row.point.y} - centre;
      const Long outside = std::hypot(v.x, v.y) - 1.0L / std::abs(e.kappa);
      const Long left = e.kappa > 0.0L ? -outside : outside;
      wall(left / row.reach, 1.0 / static_cast<double>(n.last_on - n.first_on));
    }
  }
  for (std::size_t i = 0; i < tube.links(); ++i) {
    const std::size_t j = (i + 1) % tube.nodes.size();
    const LinkByHand link(end_of(tube.nodes[i], &x[kPerNode * i], tube.nodes[i].after),
                          end_of(tube.nodes[j], &x[kPerNode * j], -tube.nodes[j].before));
    out.cones.push_back(link.cone());
    const std::size_t first = tube.first_row[i], last = tube.first_row[i + 1];
    for (std::size_t k = first; k < last; ++k) {
      wall(link.residual(tube.rows[k]), 1.0 / static_cast<double>(last - first));
    }
  }
  return out;
}

test::ConeMerit cone_merit(const RandomTube& t, std::size_t link, const Case& c) {
  const Long z = t.tube.size[link];
  return {c.cone,
          kReserve,
          static_cast<Long>(t.direction[link]),
          z,
          kFairEnergy,
          c.weights.energy / (z * z),
          c.weights.cone};
}

Long merit_by_hand(const RandomTube& t, const std::vector<Long>& x, Long slack, const Case& c) {
  const Parts p = parts_at(t, x, c.weights.tube);
  const Long half = c.widen ? 1.0L + slack : 1.0L, cone_slack = c.weights.cone > 0.0 ? slack : 0.0L;
  Long sum = 0.0L;
  for (std::size_t k = 0; k < p.walls.size(); ++k) {
    sum -= p.wall_weight[k] * std::log(half * half - p.walls[k] * p.walls[k]);
  }
  for (std::size_t i = 0; i < p.cones.size(); ++i) {
    sum += cone_merit(t, i, c)({p.cones[i][0], p.cones[i][1], p.cones[i][2], cone_slack});
  }
  for (std::size_t i = 0; i < t.tube.nodes.size() && c.weights.cone > 0.0; ++i) {
    const TubeNode& n = t.tube.nodes[i];
    if (n.sign == 0.0) continue;
    sum -= 0.5L * c.weights.cone *
           std::log(n.sign * (n.kappa * n.length + x[kPerNode * i + 2]) + slack);
  }
  for (std::size_t i = 0; i < t.tube.nodes.size(); ++i) {
    const TubeNode& n = t.tube.nodes[i];
    if (!n.bounds_heading()) continue;
    const Long turn = x[kPerNode * i + 1];
    sum -= c.weights.tube * std::log((turn - n.turn_low) * (n.turn_high - turn));
  }
  return sum;
}

std::vector<Long> widened(const State& x) { return {x.begin(), x.end()}; }

/// All kinds of tubes and merits, with a slack that lets the state lie inside.
template <class Check>
int for_every_kind(int rounds, const Check& check) {
  std::mt19937_64 rng(1);
  int beyond = 0;
  for (int k = 0; k < rounds; ++k) {
    const bool closed = k % 2 == 1, primitive = k % 4 / 2 == 1;
    RandomTube t(rng, closed, primitive, k % 3 == 1);
    const auto links = parts_at(t, widened(t.x), 1.0).cones;
    for (const auto& link : links) {
      beyond += link[2] > 1.3L ? 1 : 0;
      beyond += link[2] < -1.3L ? 1 : 0;
    }
    for (const Cone cone : {Cone::kSpiral, Cone::kClosedForm}) {
      for (const auto& [weights, widen] : {std::pair{Weights{0.0, 1.0, 0.0}, false},
                                           {Weights{1.0, 0.0, 0.0}, false},
                                           {Weights{0.0, 0.0, 1.0}, false},
                                           {Weights{0.3, 1.0, 0.5}, false},
                                           {Weights{0.3, 0.0, 1.0}, true}}) {
        TubeModel model(t.tube, t.direction, cone, kFairEnergy);
        if (widen) model.let_slack_widen_the_tube();
        Case c{cone, weights, widen, 0.0};
        c.slack = widen                ? std::max(0.3, 1.4 * model.tube_use(t.x) - 1.0)
                  : weights.cone > 0.0 ? 1.4 * model.needed_slack(t.x) + 1.0
                                       : 0.0;
        if (!std::isfinite(model.merit(t.x, c.slack, weights))) continue;
        check(t, model, c,
              "tube " + std::to_string(k) + (closed ? ", closed" : "") +
                  (primitive ? ", primitives" : "") + ", cone " +
                  std::to_string(static_cast<int>(cone)) + (widen ? ", widened" : "") +
                  ", weights " + std::to_string(weights.energy) + " " +
                  std::to_string(weights.cone) + " " + std::to_string(weights.tube));
      }
    }
  }
  return beyond;
}

TEST(TubeDerivatives, MeritAndGradientAreThoseWrittenByHand) {
  int checked = 0;
  const int beyond = for_every_kind(60, [&](const RandomTube& t, TubeModel& model, const Case& c,
                                            const std::string& what) {
    const std::vector<Long> x = widened(t.x);
    const auto change = [&](std::size_t unknown) {
      return static_cast<double>(test::slope_of(
          [&](Long v) {
            std::vector<Long> y = x;
            if (unknown < y.size()) y[unknown] += v;
            return merit_by_hand(t, y, unknown < x.size() ? c.slack : c.slack + v, c);
          },
          0.0L, unknown < x.size() ? 1e-4L : 1e-4L * (1.0L + c.slack)));
    };
    BorderedSystem system;
    model.assemble(t.x, c.slack, c.weights, true, system);
    std::vector<double> unit(t.x.size(), 0.0);
    double largest = 1e-9;
    std::vector<double> wanted;
    for (std::size_t i = 0; i <= t.x.size(); ++i) {
      wanted.push_back(i < t.x.size() && t.fixed(i) ? 0.0 : change(i));
      largest = std::max(largest, std::abs(wanted.back()));
    }
    for (std::size_t i = 0; i <= t.x.size(); ++i) {
      if (i < t.x.size()) unit[i] = 1.0;
      const double g = -system.decrement(unit, i < t.x.size() ? 0.0 : 1.0);
      if (i < t.x.size()) unit[i] = 0.0;
      EXPECT_NEAR(g, wanted[i], 1e-6 * largest) << what << ", unknown " << i;
      ++checked;
    }
    // the merit itself, up to the constants that its logarithms leave out
    std::vector<Long> y = x;
    State z = t.x;
    for (std::size_t i = 0; i < y.size(); ++i) {
      if (t.fixed(i)) continue;
      z[i] += i % 2 == 0 ? 1e-3 : -1e-3;
      y[i] = z[i];
    }
    const double moved = model.merit(z, c.slack, c.weights) - model.merit(t.x, c.slack, c.weights);
    EXPECT_NEAR(
        moved,
        static_cast<double>(merit_by_hand(t, y, c.slack, c) - merit_by_hand(t, x, c.slack, c)),
        1e-9 * (1.0 + std::abs(model.merit(t.x, c.slack, c.weights))))
        << what;
  });
  EXPECT_GT(checked, 5000);
  EXPECT_GT(beyond, 5);
}

using Matrix = std::vector<std::vector<double>>;

/// Sum of J^T H J over all parts, the slack last.
Matrix gauss_newton(const RandomTube& t, const Case& c) {
  const std::size_t n = t.x.size();
  const std::vector<Long> x = widened(t.x);
  const Parts now = parts_at(t, x, c.weights.tube);
  std::vector<Parts> up, down;
  constexpr Long kStep = 1e-6L;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<Long> y = x;
    y[i] += kStep;
    up.push_back(parts_at(t, y, c.weights.tube));
    y[i] -= 2.0L * kStep;
    down.push_back(parts_at(t, y, c.weights.tube));
  }
  const auto slope = [&](Long a, Long b) { return static_cast<double>((a - b) / (2.0L * kStep)); };
  Matrix h(n + 1, std::vector<double>(n + 1, 0.0));
  const auto add = [&](const auto& J, const auto& H) {
    for (std::size_t r = 0; r <= n; ++r) {
      for (std::size_t s = 0; s <= n; ++s) {
        for (std::size_t k = 0; k < H.size(); ++k) {
          for (std::size_t l = 0; l < H.size(); ++l) h[r][s] += J[k][r] * H[k][l] * J[l][s];
        }
      }
    }
  };
  const double half = c.widen ? 1.0 + c.slack : 1.0;
  for (std::size_t k = 0; k < now.walls.size(); ++k) {
    const double r = static_cast<double>(now.walls[k]), f = half * half - r * r;
    const double w = 2.0 * now.wall_weight[k] / (f * f), both = half * half + r * r;
    std::array<std::vector<double>, 2> J = {std::vector<double>(n + 1, 0.0),
                                            std::vector<double>(n + 1, 0.0)};
    for (std::size_t i = 0; i < n; ++i) J[0][i] = slope(up[i].walls[k], down[i].walls[k]);
    J[1][n] = c.widen ? 1.0 : 0.0;
    add(J, std::array<std::array<double, 2>, 2>{
               {{w * both, -2.0 * w * half * r}, {-2.0 * w * half * r, w * both}}});
  }
  for (std::size_t k = 0; k < now.cones.size(); ++k) {
    const test::ConeMerit merit = cone_merit(t, k, c).with_linear_width_at(now.cones[k][2]);
    const std::array<Long, 4> at = {now.cones[k][0], now.cones[k][1], now.cones[k][2],
                                    c.weights.cone > 0.0 ? c.slack : 0.0};
    std::array<std::array<double, 4>, 4> H{};
    for (std::size_t p = 0; p < 4; ++p) {
      for (std::size_t q = 0; q < 4; ++q) {
        H[p][q] = static_cast<double>(test::partial(
            [&](const std::array<Long, 4>& y) { return test::partial(merit, y, p); }, at, q));
      }
    }
    std::array<std::vector<double>, 4> J;
    J.fill(std::vector<double>(n + 1, 0.0));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t p = 0; p < 3; ++p) J[p][i] = slope(up[i].cones[k][p], down[i].cones[k][p]);
    }
    J[3][n] = c.weights.cone > 0.0 ? 1.0 : 0.0;
    add(J, H);
  }
  for (std::size_t i = 0; i < t.tube.nodes.size() && c.weights.cone > 0.0; ++i) {
    const TubeNode& node = t.tube.nodes[i];
    if (node.sign == 0.0) continue;
    const std::size_t k = kPerNode * i + 2;
    const double v = node.sign * (node.kappa * node.length + t.x[k]) + c.slack;
    const double w = 0.5 * c.weights.cone / (v * v);
    h[k][k] += w;
    h[k][n] += w * node.sign;
    h[n][k] += w * node.sign;
    h[n][n] += w;
  }
  for (std::size_t i = 0; i < t.tube.nodes.size(); ++i) {
    const TubeNode& node = t.tube.nodes[i];
    if (!node.bounds_heading()) continue;
    const std::size_t k = kPerNode * i + 1;
    h[k][k] += c.weights.tube *
               (std::pow(t.x[k] - node.turn_low, -2.0) + std::pow(node.turn_high - t.x[k], -2.0));
  }
  return h;
}

TEST(TubeDerivatives, HessianIsGaussAndNewtons) {
  int checked = 0;
  for_every_kind(
      24, [&](const RandomTube& t, TubeModel& model, const Case& c, const std::string& what) {
        const std::size_t n = t.x.size();
        Matrix h = gauss_newton(t, c);
        double largest = 0.0;
        std::vector<bool> out(n + 1, false);  // fixed, or a curvature that nothing depends on
        for (std::size_t r = 0; r <= n; ++r) {
          largest = std::max(largest, h[r][r]);
          out[r] = r < n && (t.fixed(r) || (r % kPerNode == 2 && h[r][r] == 0.0));
        }
        const double ridge = 1e-2 * largest;  // some of these merits leave directions free
        for (std::size_t r = 0; r <= n; ++r) h[r][r] += ridge;
        BorderedSystem system;
        const auto assemble = [&] {
          model.assemble(t.x, c.slack, c.weights, true, system);
          for (std::size_t i = 0; i < t.tube.nodes.size(); ++i) {
            for (std::size_t k = 0; k < kPerNode; ++k) {
              if (!out[kPerNode * i + k]) system.add(i, k, 0.0, ridge);
            }
          }
          system.add_slack(0.0, ridge);
        };
        const auto solve = [&](std::optional<std::size_t> pushed) {
          assemble();
          if (pushed && *pushed < n)
            system.add(*pushed / kPerNode, *pushed % kPerNode, largest, 0.0);
          if (pushed == n) system.add_slack(largest, 0.0);
          std::vector<double> d;
          const double slack = system.solve(d);
          d.push_back(slack);
          return d;
        };
        // columns of the inverse: what a push at one unknown changes
        const std::vector<double> calm = solve(std::nullopt);
        for (std::size_t k = 0; k <= n; ++k) {
          if (k < n && t.fixed(k)) continue;
          const std::vector<double> pushed = solve(k);
          for (std::size_t r = 0; r <= n; ++r) {
            if (out[r]) continue;
            double sum = 0.0;
            for (std::size_t s = 0; s <= n; ++s) {
              if (out[s]) continue;
              sum += h[r][s] * (pushed[s] - calm[s]);
            }
            EXPECT_NEAR(sum / largest, r == k ? -1.0 : 0.0, 2e-5) << what << ": " << r << ", " << k;
            ++checked;
          }
        }
      });
  EXPECT_GT(checked, 20000);
}

TEST(TubeDerivatives, PlacesAndCircleDistancesAreDifferentiatedExactly) {
  std::mt19937_64 rng(3);
  for (int k = 0; k < 200; ++k) {
    RandomTube t(rng, false, true, false);
    for (const std::size_t i : {std::size_t{1}, t.tube.nodes.size() - 1}) {
      const TubeNode& n = t.tube.nodes[i];
      const double* x = &t.x[kPerNode * i];
      const PlacedNode placed = place(n, x);
      for (const double s : {-n.before, 0.0, n.after}) {
        const EndJet jet = end_jet(n, placed, s);
        for (std::size_t u = 0; u < kPerNode; ++u) {
          const auto end = [&](Long by) {
            std::array<Long, kPerNode> y = {x[0], x[1], x[2]};
            y[u] += by;
            return end_of(n, y.data(), s);
          };
          const auto by = [&](auto part) {
            return static_cast<double>(test::slope_of([&](Long v) { return part(end(v)); }, 0.0L));
          };
          EXPECT_NEAR(jet.position[u].x, by([](const LongEnd& e) { return e.p.x; }), 1e-10);
          EXPECT_NEAR(jet.position[u].y, by([](const LongEnd& e) { return e.p.y; }), 1e-10);
          EXPECT_NEAR(jet.theta[u], by([](const LongEnd& e) { return e.theta; }), 1e-10);
          EXPECT_NEAR(jet.kappa[u], by([](const LongEnd& e) { return e.kappa; }), 1e-10);
        }
      }
      const Vec2 point = n.point + Vec2{uniform(rng, -0.3, 0.3), uniform(rng, -0.3, 0.3)};
      const CircleDistance d = circle_distance(n, placed, point);
      for (std::size_t u = 0; u < kPerNode; ++u) {
        const auto value = [&](Long by) {
          std::array<double, kPerNode> y = {x[0], x[1], x[2]};
          y[u] += static_cast<double>(by);
          return static_cast<Long>(circle_distance(n, place(n, y.data()), point).value);
        };
        EXPECT_NEAR(d.slope[u], static_cast<double>(test::slope_of(value, 0.0L, 1e-3L)), 1e-8);
      }
    }
  }
}

}  // namespace
}  // namespace obvid::fairing_detail
