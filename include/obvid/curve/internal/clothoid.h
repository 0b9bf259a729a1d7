// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/geom/element.h"

namespace obvid {

/// Vector from the start of a clothoid to the point at signed arc length `s` from it: heading
/// `theta` and curvature `kappa0` at the start, `kappa1` there, curvature linear in between.
///
///     integral over u from 0 to s of (cos, sin)(theta + kappa0 u + (kappa1 - kappa0) u^2/(2 s))
///
/// Any sharpness, 0 included (arc, line); any number of turns. Error below 1e-14 |s|, plus what the
/// rounding of `theta` and of the turning `(kappa0 + kappa1) s/2` means where these are large.
/// Constant time. Method: docs/methods/clothoids.md, section 1.
[[nodiscard]] Vec2 clothoid_step(double theta, double kappa0, double kappa1, double s);

/// The element at arc length `s` behind `start` on the clothoid of this sharpness
/// (d kappa/ds, 1/unit^2).
[[nodiscard]] Element clothoid_at(const Element& start, double sharpness, double s);

}  // namespace obvid
