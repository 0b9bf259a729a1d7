// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "obvid/core/result.h"
#include "obvid/exchange/internal/gcode/gcode.h"

namespace obvid {

struct Toolpath;

struct ToolpathGcodeOptions {
  GcodeController controller = GcodeController::kGrbl;
  /// Passes in planes upright on X or Y as biarcs (G18, G19) where they save blocks, else G1 only.
  /// No controller here knows splines outside XY (G5 of LinuxCNC is for G17 alone).
  bool arcs = true;
  std::optional<int> decimals{};  ///< 1 to 6 [the fewest, at least 3, that cost no more than a
                                  ///< third of what printing may; in inches one more]
  std::string name = "tool path";
};

struct ToolpathGcode {
  std::string text;
  std::size_t blocks = 0;      ///< that move
  std::size_t arc_blocks = 0;  ///< of them G2 and G3
  double minutes = 0.0;        ///< from the first place on, with acceleration
  // of the blocks as they are printed, from the first place on, units of the path
  double cutting_length = 0.0, plunge_length = 0.0, rapid_length = 0.0;
};

/// A program with absolute ends; it holds no tool change; M3 and M5 where the path has a speed of
/// the spindle. G21 and millimetres, or G20 for inches; other units are converted to millimetres.
/// Errors: E203 decimals out of range, a unit without a length in metres; E502 decimals too few
/// for the tolerance. `threads`: 0 for as many as the machine has; the text does not depend on it.
[[nodiscard]] Result<ToolpathGcode> toolpath_gcode(const Toolpath& path,
                                                   const ToolpathGcodeOptions& options = {},
                                                   std::size_t threads = 1);

}  // namespace obvid
