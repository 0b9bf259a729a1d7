// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cutter_shape.h"

namespace obvid::toolpath {

/// A straight way of the tip; the cutter's body on all of it is the sweep.
struct Sweep {
  Vec3 from, to;
};

/// Distance of a point from a sweep, negative inside, and how it changes with the point. Bodies are
/// convex, so the distance is a convex function of the point: it lies nowhere below the plane of
/// value and gradient, however far away.
struct SweepDistance {
  double value = 0.0;
  Vec3 gradient;
};

/// The place on the way that is nearest is found to 1e-6 of the radius.
[[nodiscard]] SweepDistance distance_from(const CutterShape& cutter, const Sweep& sweep, Vec3 p);

/// Where a ray enters a sweep: the height over its start, and the distance's gradient there.
struct SweepEntry {
  double height = 0.0;  ///< 0: it starts inside; infinite: beyond `most` or never
  Vec3 gradient;
};

[[nodiscard]] SweepEntry entry_into(const CutterShape& cutter, const Sweep& sweep, Vec3 from,
                                    Vec3 direction, double most);

/// The height alone, of cutters with sharp corners and directions that rise, in a closed form.
[[nodiscard]] double height_into_sharp(const CutterShape& cutter, const Sweep& sweep, Vec3 from,
                                       Vec3 direction, double most);

/// At most the distance from a sweep, quickly: by what a box says, then by the plane of value and
/// slope half way. Where the first exceeds `enough` it is the answer.
[[nodiscard]] double distance_at_least(const CutterShape& cutter, const Sweep& sweep, Vec3 p,
                                       double enough);

}  // namespace obvid::toolpath
