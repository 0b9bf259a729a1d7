// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/units.h"
#include "obvid/curve/nurbs.h"
#include "obvid/curve/pieces.h"
#include "obvid/surface/space_curve.h"

namespace obvid {

/// A curve for STEP, IGES and BREP: one NURBS curve, of the plane z = 0 or of space, becomes one
/// edge; pieces become one edge each (lines, circles and rational curves as such), joined in one
/// wire. No clothoids.
struct CadCurve {
  std::string name;
  std::variant<NurbsCurve, std::vector<Piece>, SpaceCurve> geometry;
};

/// Units that STEP and IGES files are written in.
inline constexpr std::array<std::string_view, 9> kCadUnits = {"um",  "mm", "cm", "m", "km",
                                                              "mil", "in", "ft", "mi"};

/// The unit of a STEP or IGES file for lengths in `unit`: itself, or the next one of its system,
/// into which lengths are converted. Empty for units without a length.
[[nodiscard]] inline std::string_view cad_unit(std::string_view unit) {
  return unit_for_file(unit, kCadUnits);
}

}  // namespace obvid
