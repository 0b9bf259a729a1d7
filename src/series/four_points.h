// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "obvid/geom/vec2.h"

namespace obvid::series_detail {

/// A point and how far from it the curve may pass.
struct Disc {
  Vec2 centre;
  double reach = 0.0;
};

/// The angle under which an outer one of four points sees the two inner ones, and how close the
/// discs may come. Of a, b, c, d one side has the apex a, near b, far c; the other d, near c, far
/// b.
struct Side {
  Vec2 angle;  ///< unit vector, from the far to the near point
  double near_gap = 0.0, far_gap = 0.0;
  double reach = 0.0;
  bool apart = false;  ///< no point belongs to two of the discs

  static Side of(const Disc& apex, const Disc& near, const Disc& far) {
    const Vec2 to_near = near.centre - apex.centre, to_far = far.centre - apex.centre;
    const double near_length = norm(to_near), far_length = norm(to_far);
    const double unit = 1.0 / (near_length * far_length);
    Side out;
    out.angle = {unit * dot(to_near, to_far), unit * cross(to_far, to_near)};
    out.near_gap = near_length - apex.reach - near.reach;
    out.far_gap = far_length - apex.reach - far.reach;
    out.reach = apex.reach;
    out.apart = out.near_gap > 0.0 && out.far_gap > 0.0;
    return out;
  }
};

/// Whether the curvature of the circle through b, c, d exceeds that of the circle through a, b, c
/// (+1) or stays below it (-1) wherever the points lie in their discs; 0: that depends.
///
/// The sum of both angles is the argument of (b-a)(d-c) / ((c-a)(d-b)). A move of a by e turns it
/// by at most e |bc| / (|ab| |ac|), and so on; with least lengths below and largest lengths above
/// the line that holds for finite moves of all four (docs/methods/series.md).
[[nodiscard]] inline int compare_circles(const Side& before, const Side& behind, const Disc& b,
                                         const Disc& c, double largest_bc, double largest_ad) {
  constexpr double kComputing = 32.0 * 0x1p-53;  // rad: of a product of two rounded unit vectors
  if (!before.apart || !behind.apart) return 0;
  const Vec2 sum = complex_product(before.angle, behind.angle);
  if (!(sum.x > 0.0)) return 0;
  const double outer = before.reach / (before.near_gap * before.far_gap) +
                       behind.reach / (behind.near_gap * behind.far_gap);
  const double inner =
      b.reach / (before.near_gap * behind.far_gap) + c.reach / (before.far_gap * behind.near_gap);
  const double moved = largest_bc * outer + largest_ad * inner + kComputing;
  return std::abs(sum.y) <= moved ? 0 : sum.y > 0.0 ? 1 : -1;
}

}  // namespace obvid::series_detail
