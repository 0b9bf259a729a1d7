// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "obvid/exchange/internal/gcode/gcode.h"

namespace obvid::exchange {

// What controllers want before and behind the blocks of a program. Ends are absolute (G90), centres
// of arcs count from their start, the plane is XY, feeds are per minute.

inline constexpr std::array kGcodeControllers = {
    std::pair{"grbl", GcodeController::kGrbl}, std::pair{"linuxcnc", GcodeController::kLinuxCnc},
    std::pair{"fanuc", GcodeController::kFanuc}, std::pair{"marlin", GcodeController::kMarlin}};

inline constexpr int kLeastGcodeDecimals = 3, kMostGcodeDecimals = 6;
/// The fewest decimals, at least 3 (of inches 4), whose last digit is worth no more than a tenth of
/// the tolerance, in units of the machine.
[[nodiscard]] int gcode_decimals(double tolerance, bool inches);

/// A line that controllers leave out.
[[nodiscard]] std::string gcode_remark(GcodeController controller, std::string_view text);
/// Start of a program with such lines, and the words that stay in force.
[[nodiscard]] std::string gcode_head(GcodeController controller, bool inches,
                                     const std::vector<std::string>& remarks);
/// End of the program. Marlin has none: M30 would delete a file there.
/// E203 for controllers without cubic splines (G5), and for Marlin: its firmware replaces them by
/// chords that may lie 0.1 mm off (SIGMA in planner_bezier.cpp), whatever the program says.
[[nodiscard]] Result<void> check_g5(GcodeController controller);

[[nodiscard]] std::string gcode_end(GcodeController controller);

}  // namespace obvid::exchange
