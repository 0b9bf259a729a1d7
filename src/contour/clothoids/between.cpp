// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "chord_clothoid.h"
#include "obvid/contour/clothoids.h"
#include "obvid/geom/internal/angle.h"

namespace obvid {
namespace {}  // namespace

std::optional<ClothoidPiece> clothoid_between(Vec2 start, double theta0, Vec2 end, double theta1) {
  const Vec2 chord = end - start;
  const double h = norm(chord), omega = heading(chord);
  if (!(h > 0.0) || !std::isfinite(h + theta0 + theta1)) return std::nullopt;
  const double alpha = turn_between(omega, theta0), beta = turn_between(omega, theta1);
  auto c = clothoids::solve_chord(alpha, beta);
  // headings half a turn from the chord count either way; where one way has no solution the other
  // one has
  if (!c.found) c = clothoids::solve_chord(alpha, beta - std::copysign(kFullTurn, beta));
  if (!c.found) return std::nullopt;
  const double length = h / c.shrink, rate = 2.0 / length;
  return ClothoidPiece{
      start, end, theta0, rate * (c.linear - 2.0 * c.square), rate * (c.linear + 2.0 * c.square),
      length};
}

}  // namespace obvid
