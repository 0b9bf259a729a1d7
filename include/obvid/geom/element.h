// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include "obvid/geom/vec2.h"

namespace obvid {

/// A point of a contour with its tangent and curvature.
struct Element {
  Vec2 point;
  double theta = 0.0;  ///< heading, rad, counter-clockwise, unwrapped along a series
  double kappa = 0.0;  ///< signed curvature, 1/unit, positive where the curve turns left
};

}  // namespace obvid
