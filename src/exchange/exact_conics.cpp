// SPDX-License-Identifier: Apache-2.0
#include "exact_conics.h"

#include <algorithm>
#include <cmath>

namespace obvid::exchange {
namespace {

/// What rounding of a centre and of angles may cost, of the size: a tenth of what readers must get.
constexpr double kArcRounding = 1e-10;

/// Where a conic is parallel to its chord: its middle by the eccentric angle.
Vec2 shoulder(const RationalBezier& conic) {
  const double t = 1.0 / (1.0 + std::sqrt(conic.weight[2] / conic.weight[0]));
  return evaluate(conic, t).point;
}

}  // namespace

bool centre_is_near(const ArcPiece& arc, double size) {
  constexpr double kFar = 1e5;  // sizes: 1e5 roundings of a double are below kArcRounding
  return std::abs(arc.kappa) * kFar * size >= 1.0;
}

std::optional<Ellipse> ellipse_within(const RationalBezier& piece, double size) {
  if (piece.degree != 2) return std::nullopt;
  const auto e = ellipse_of(piece);
  if (!e) return std::nullopt;
  const Vec2 axis = unit_at(e->rotation);
  const auto at = [&](double angle) {
    return e->centre + (e->semi_major * std::cos(angle)) * axis +
           (e->semi_minor * std::sin(angle)) * left_normal(axis);
  };
  const double off =
      std::max({norm(at(e->from) - start_point(piece)), norm(at(e->to) - end_point(piece)),
                norm(at(0.5 * (e->from + e->to)) - shoulder(piece))});
  return off <= kArcRounding * size ? e : std::nullopt;
}

}  // namespace obvid::exchange
