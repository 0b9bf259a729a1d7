// SPDX-License-Identifier: Apache-2.0
#include "node_ends.h"

#include <cmath>

namespace obvid::fairing_detail {
namespace {

/// Below this turning the series replace quotients of small numbers; the first terms left out are
/// below 1e-13.
constexpr double kSmallTurn = 0.05;

/// int_0^1 e^{i x v} dv.
Vec2 mean_direction(double x) {
  const double y = x * x;
  if (std::abs(x) < kSmallTurn) {
    return {1.0 - y / 6.0 * (1.0 - y / 20.0 * (1.0 - y / 42.0)),
            0.5 * x * (1.0 - y / 12.0 * (1.0 - y / 30.0 * (1.0 - y / 56.0)))};
  }
  const double half = std::sin(0.5 * x);
  return {std::sin(x) / x, 2.0 * half * half / x};
}

/// int_0^1 v e^{i x v} dv.
Vec2 mean_moment(double x) {
  const double y = x * x;
  if (std::abs(x) < kSmallTurn) {
    return {0.5 - y / 8.0 * (1.0 - y / 18.0 * (1.0 - y / 40.0)),
            x / 3.0 * (1.0 - y / 10.0 * (1.0 - y / 28.0))};
  }
  const double s = std::sin(x), c = std::cos(x);
  return {(c + x * s - 1.0) / y, (s - x * c) / y};
}

NodeEnd end_at(const PlacedNode& placed, double kappa, double s) {
  if (s == 0.0) return {placed.anchor, placed.tangent, kappa};
  const double turn = kappa * s;
  return {placed.anchor + s * complex_product(placed.tangent, mean_direction(turn)),
          complex_product(placed.tangent, unit_at(turn)), kappa};
}

}  // namespace

PlacedNode place(const TubeNode& node, const double* v) {
  PlacedNode out;
  out.anchor = node.point + v[0] * node.reach * node.normal;
  out.tangent = unit_at(node.theta + v[1]);
  const double kappa = node.kappa + v[2] / node.length;
  out.in = end_at(out, kappa, -node.before);
  out.out = end_at(out, kappa, node.after);
  return out;
}

EndJet end_jet(const TubeNode& node, const PlacedNode& placed, double s) {
  EndJet jet;
  const double unit = 1.0 / node.length;
  jet.position[0] = node.reach * node.normal;
  jet.theta = {0.0, 1.0, s * unit};
  jet.kappa = {0.0, 0.0, unit};
  if (s == 0.0) return jet;
  const double turn = placed.in.kappa * s;
  jet.position[1] = left_normal(s * complex_product(placed.tangent, mean_direction(turn)));
  jet.position[2] = left_normal(s * s * unit * complex_product(placed.tangent, mean_moment(turn)));
  return jet;
}

CircleDistance circle_distance(const TubeNode& node, const PlacedNode& placed, Vec2 point) {
  const Vec2 q = point - placed.anchor;
  const double u = dot(placed.tangent, q), v = cross(placed.tangent, q), k = placed.in.kappa;
  const double square = u * u + v * v;
  // D: distance from the centre over the radius; the distance is (1 - D) / k without cancellation
  const double D = std::sqrt(1.0 - 2.0 * k * v + k * k * square);
  const double numerator = 2.0 * v - k * square, one = 1.0 + D;
  CircleDistance out;
  out.value = numerator / one;
  const double by_u = -k * u / D, by_v = (1.0 - k * v) / D;
  const double by_k = (-square - out.value * (k * square - v) / D) / one;
  const Vec2 move = -node.reach * node.normal;  // of q with the offset
  out.slope = {by_u * dot(placed.tangent, move) + by_v * cross(placed.tangent, move),
               by_u * v - by_v * u, by_k / node.length};
  return out;
}

}  // namespace obvid::fairing_detail
