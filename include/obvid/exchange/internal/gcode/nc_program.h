// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/geom/vec3.h"

namespace obvid::exchange {

/// A motion block as a controller carries it out: places of the tip in machine units.
struct NcMotion {
  bool rapid = false;
  bool arc = false;
  std::vector<Vec3>
      points;  ///< the ends; of arcs and splines so many that chords keep within the stated depth
};

struct NcProgram {
  std::vector<NcMotion> motions;
  bool inches = false;
};

/// Reads the text of a program as RS274 says, with nothing known about how it came about: absolute
/// ends, centres of arcs from their start, the planes XY, ZX and YZ, cubic splines (G5) in XY,
/// words that stay in force. The first words have to place the tip in X, Y and Z, or in X and Y
/// where its `level` is known. `within`: depth of chords under arcs. Errors: E101 with the line for
/// words that it does not know and for arcs that controllers refuse: ends whose distances from the
/// centre differ by more than 0.002 mm and 0.1 % of the radius.
[[nodiscard]] Result<NcProgram> read_program(std::string_view text, double within,
                                             std::optional<double> level = {});

}  // namespace obvid::exchange
