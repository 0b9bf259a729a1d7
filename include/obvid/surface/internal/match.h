// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/result.h"
#include "obvid/surface/internal/topology.h"

namespace obvid {

/// A side of a patch.
struct SideOfPatch {
  const NurbsSurface& surface;
  PatchSide side;
};

/// A patch whose border became that of another.
struct MatchedSurface {
  NurbsSurface surface;
  double moved =
      0.0;  ///< units: bound of how far any point moved at its parameters, of the control
            ///< points of the difference, by the convex hull, apart from rounding
  double reach = 0.0;  ///< share of the domain across the border up to which the patch changed
  double pace = 0.0;   ///< derivatives across the border: those of the other patch times this;
                       ///< 0 for order 0
};

/// Changes the control points of a patch nearest to a side so that it goes on from the other
/// patch: its border becomes the other's at equal parts of the parameters, in the direction in
/// which the ends lie nearer (order 0); across it the first derivatives become those of the other
/// patch times one factor (1), and the second ones those times its square plus a multiple of the
/// first (2), each factor by least squares of the derivatives that the patch had. That is exact in
/// common knots (docs/methods/blends.md), so both have one border, tangent planes and curvatures in
/// common. The patch gets the knots of the other along the border;
/// its degree across is raised until the opposite side keeps as much as this one gets.
///
/// Errors: those of `check`; E203 an order that is not 0, 1 or 2; E310 rational patches; E408 the
/// patch would turn back onto the other one, or a border that is a point.
[[nodiscard]] Result<MatchedSurface> matched(const SideOfPatch& patch, const SideOfPatch& to,
                                             int order);

}  // namespace obvid
