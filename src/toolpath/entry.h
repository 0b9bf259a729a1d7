// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "obvid/toolpath/toolpath.h"

namespace obvid::toolpath {

/// Of a ramp up and down one stretch.
inline constexpr double kMostLegs = 40.0;
/// Of a cutter's radius, in this order: of helices, less than 1, so that they leave no core.
inline constexpr std::array kHelixRadii = {0.9, 0.45};

/// Height that ramps and helices go down for each length seen from above; nothing: the tip goes
/// straight down. Roughing always has ramps.
[[nodiscard]] std::optional<double> fall_of(const ToolpathOptions& options);
/// The angle of that; 0: straight down.
[[nodiscard]] double asked_deg(const ToolpathOptions& options);

/// Where a way goes down and forward at once most steeply.
struct Steepest {
  double fall = 0.0;  ///< height lost for each length seen from above
  Vec3 place;
};
[[nodiscard]] Steepest steepest_of(const std::vector<Vec3>& way);

/// Even number of ways back and forth over the beginning of a pass of this length; nothing: more
/// than `kMostLegs`.
[[nodiscard]] std::optional<double> legs_of_ramp(double length, double height, double fall);

/// A way down over a pass: from so far over its first point, by `fall` for each length seen from
/// above. Where it would lie higher than the ceiling, which is over the whole pass, it is level.
struct Descent {
  double height = 0.0, fall = 0.0;
  double ceiling = std::numeric_limits<double>::infinity();
};

/// Back and forth over the beginning of a pass, an even number of ways, down to its first point;
/// what is over the pass falls evenly, so no body on the way lies deeper than those of the pass.
/// Nothing: the pass is too short (`legs_of_ramp`).
[[nodiscard]] std::optional<std::vector<Vec3>> ramp_over(const std::vector<Vec3>& pass,
                                                         const Descent& descent);

/// The same of finishing: where more ways than `kMostLegs` would be needed it is as flat as so many
/// are. Nothing: the pass has no length seen from above.
[[nodiscard]] std::optional<std::vector<Vec3>> flattest_ramp_over(const std::vector<Vec3>& pass,
                                                                  Descent descent);

/// Likewise around a closed ring (its last point is its first one).
struct Helix {
  std::vector<Vec3> points;
  double turns = 0.0;  ///< whole ones
};
/// In at least so many turns. Nothing: it takes more than 100.
[[nodiscard]] std::optional<Helix> helix_over(const std::vector<Vec3>& ring, const Descent& descent,
                                              double least_turns);

/// Corners of a circle through `start` that leaves it in the direction `along` (length 1) and comes
/// back to it, `side` 1: the centre lies to the left, -1: to the right. Chords lie within `within`
/// of the circle.
[[nodiscard]] std::vector<Vec2> circle_from(Vec2 start, Vec2 along, double side, double radius,
                                            double within);

}  // namespace obvid::toolpath
