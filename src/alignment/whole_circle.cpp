// SPDX-License-Identifier: Apache-2.0
#include "whole_circle.h"

#include <cmath>
#include <cstddef>

#include "obvid/core/units.h"

namespace obvid::alignment {
namespace {

constexpr double kTurnRounding = 1e-9;  ///< rad

/// Centre of the circle through three points; not a number where they lie on a line.
Vec2 centre_through(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 u = b - a, v = c - a;
  const double d = 2.0 * cross(u, v);
  return a + Vec2{dot(u, u) * v.y - dot(v, v) * u.y, dot(v, v) * u.x - dot(u, u) * v.x} / d;
}

/// How far around a centre each point lies behind the first one, rad, to the left positive; nothing
/// where they do not go around it once, in one sense.
std::optional<std::vector<double>> turns_about(Vec2 centre, const std::vector<Vec2>& points) {
  const std::size_t n = points.size();
  std::vector<double> out = {0.0};
  for (std::size_t i = 0; i < n; ++i) {
    const double step = turning(points[i] - centre, points[(i + 1) % n] - centre);
    if (!(step * out.back() >= 0.0) || step == 0.0) return std::nullopt;
    out.push_back(out.back() + step);
  }
  if (!(std::abs(std::abs(out.back()) - kFullTurn) < kTurnRounding)) return std::nullopt;
  out.pop_back();
  return out;
}

/// An arc from the foot of the first point over an angle, with the feet of points at theirs.
FoundChain arc_of(Vec2 centre, double radius, double turn, const std::vector<double>& turns,
                  const std::vector<Vec2>& points) {
  const double side = turn > 0.0 ? 1.0 : -1.0;
  const Vec2 arm = points.front() - centre;
  FoundChain out;
  out.chain.start = centre + (radius / norm(arm)) * arm;
  out.chain.theta = heading(side * left_normal(arm));
  out.chain.length = {radius * std::abs(turn)};
  out.chain.kappa = {side / radius};
  out.chain.ends = {{0, 0}};
  out.chain.law = {Transition::kClothoid};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double off = side * (radius - norm(points[i] - centre));
    out.feet.push_back({0, radius * std::abs(turns[i]), off, 0.0});
  }
  return out;
}

}  // namespace

std::optional<FoundChain> whole_circle(const std::vector<Vec2>& points,
                                       const std::vector<double>& tolerance) {
  const std::size_t n = points.size();
  Vec2 centre = centre_through(points[0], points[n / 3], points[2 * n / 3]);
  auto turns = turns_about(centre, points);
  if (!turns) return std::nullopt;
  FoundChain open = arc_of(centre, norm(points.front() - centre), turns->back(), *turns, points);
  if (!(fit_chain(open.chain, points, tolerance, open.feet, {}).largest <= 1.0)) {
    return std::nullopt;
  }
  const double kappa = open.chain.kappa.front();
  centre = open.chain.start + left_normal(unit_at(open.chain.theta)) / kappa;
  turns = turns_about(centre, points);
  if (!turns) return std::nullopt;
  FoundChain out =
      arc_of(centre, 1.0 / std::abs(kappa), std::copysign(kFullTurn, kappa), *turns, points);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(std::abs(out.feet[i].offset) <= tolerance[i])) return std::nullopt;
  }
  return out;
}

}  // namespace obvid::alignment
