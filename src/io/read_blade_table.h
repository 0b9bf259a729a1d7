// SPDX-License-Identifier: Apache-2.0
// Blades of wind turbines: airfoils with a chord of 1, and a table that places them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/geom/vec2.h"
#include "obvid/surface/point_grid.h"

namespace obvid {

/// One line of the table, lengths in its units.
struct BladeStation {
  double span = 0.0;          ///< along the blade: z
  double out_of_plane = 0.0;  ///< of the reference point: x
  double in_plane = 0.0;      ///< likewise: y
  double twist = 0.0;         ///< rad
  double chord = 0.0;
  int airfoil = 0;  ///< from 1
};

struct BladeAirfoil {
  std::vector<Vec2> points;  ///< chord from (0, 0) to (1, 0)
  Vec2 reference;            ///< the point that lies on the blade's axis
  Vec2 rounding;             ///< half a unit of the last digit printed
};

[[nodiscard]] bool is_blade_table(std::string_view text);
[[nodiscard]] Result<std::vector<BladeStation>> parse_blade_table(std::string_view text,
                                                                  std::string_view name);

/// A file with `NumCoords`: the first pair is the reference point and not on the contour.
[[nodiscard]] bool is_airfoil_of_blade(std::string_view text);
[[nodiscard]] Result<BladeAirfoil> parse_airfoil_of_blade(std::string_view text,
                                                          std::string_view name);

/// The airfoil at its station: chord along y from the leading edge on, thickness along x, turned by
/// the twist about z.
[[nodiscard]] SpaceSeries placed(const BladeAirfoil& airfoil, const BladeStation& station,
                                 std::string name);

}  // namespace obvid
