// SPDX-License-Identifier: Apache-2.0
#include "obvid/region/internal/convex_triangle.h"

#include <cmath>

namespace obvid {

std::optional<ConvexTriangle> tangent_triangle(Vec2 start, Vec2 start_tangent, Vec2 end,
                                               Vec2 end_tangent) {
  const Vec2 chord = end - start;
  const double h = norm(chord), a = norm(start_tangent), b = norm(end_tangent);
  if (!(h > 0.0 && a > 0.0 && b > 0.0)) return std::nullopt;
  const Vec2 u = start_tangent / a, v = end_tangent / b;
  const double turn = cross(u, v);  // sine of the angle at the apex
  const double to_apex = cross(chord, v) / turn, from_apex = cross(u, chord) / turn;
  const bool meets = std::isfinite(to_apex) && std::isfinite(from_apex);
  if (!meets || !(to_apex > 0.0 && from_apex > 0.0)) return std::nullopt;
  const double sine = cross(chord, u) / h;
  return ConvexTriangle{start + to_apex * u, std::abs(sine) * to_apex, to_apex, from_apex,
                        sine > 0.0 ? 1 : -1};
}

std::optional<ConvexTriangle> chord_triangle(Vec2 before, Vec2 start, Vec2 end, Vec2 after) {
  return tangent_triangle(start, start - before, end, after - end);
}

}  // namespace obvid
