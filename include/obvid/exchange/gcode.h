// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "obvid/core/result.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// How a controller is told to move.
enum class GcodeMotion {
  kArcs,     ///< G2 and G3, nearly straight ones as G1
  kLines,    ///< G1 only
  kSplines,  ///< G5, cubic Beziers (LinuxCNC)
};

enum class GcodeController { kGrbl, kLinuxCnc, kFanuc };

struct GcodeOptions {
  GcodeMotion motion = GcodeMotion::kArcs;
  GcodeController controller = GcodeController::kGrbl;
  double tolerance = 0.01;       ///< units of the contour: printed path against contour
  double feed = 1000.0;          ///< mm/min, for contours in inches in/min
  std::string name = "contour";  ///< stands in a comment
};

/// A program in the plane G17, absolute ends (G90), centres from the start of the arc (G91.1): it
/// begins with a rapid move to the start and holds no tool, spindle or height.
struct GcodeText {
  std::string text;
  std::size_t blocks = 0;      ///< that move with feed
  std::size_t arc_blocks = 0;  ///< of them G2 and G3
  double deviation = 0.0;      ///< of the path as printed from the contour, units of the contour
};

/// G21 and millimetres, or G20 for contours in inches; other units are converted to millimetres.
/// Ends have 4 decimals (5 in inches), centres one more, computed from the rounded ends: radii at
/// both ends of an arc differ by less than 2e-5. No arc turns by more than a quarter. Errors: E203
/// a tolerance or feed that is not greater than 0, or a tolerance that the decimals do not keep;
/// those of `arcs_along` and `cubic_along`.
[[nodiscard]] Result<GcodeText> gcode_text(const Contour& contour,
                                           const GcodeOptions& options = {});

}  // namespace obvid
