// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "obvid/core/units.h"
#include "obvid/exchange/internal/gcode/gcode.h"

namespace obvid::exchange {

// What controllers want before and behind the blocks of a program. Ends are absolute (G90), centres
// of arcs count from their start, the plane is XY, feeds are per minute.

inline constexpr std::array kGcodeControllers = {
    std::pair{"grbl", GcodeController::kGrbl}, std::pair{"linuxcnc", GcodeController::kLinuxCnc},
    std::pair{"fanuc", GcodeController::kFanuc}, std::pair{"marlin", GcodeController::kMarlin}};

inline constexpr int kLeastGcodeDecimals = 3, kMostGcodeDecimals = 6;
/// E203 for decimals below 1 or above 6.
[[nodiscard]] Result<void> check_gcode_decimals(std::optional<int> decimals);
/// What the last digit of programs along curves may be worth, of their tolerance.
inline constexpr double kDigitOfTolerance = 0.1;
/// The fewest decimals, at least 3 (of inches 4), whose last digit is worth no more than `digit`,
/// in units of the machine.
[[nodiscard]] int decimals_of_digit(double digit, bool inches);

/// What machines are set to: inches for lengths in inches, else millimetres.
[[nodiscard]] bool in_inches(const Units& units);
/// Its name: "in" or "mm".
[[nodiscard]] const char* machine_unit(const Units& units);
/// Units of the machine in a unit of lengths. Error E203: it has no length in metres.
[[nodiscard]] Result<double> machine_units_in(const Units& units);
/// Remarks on the unit: that it is assumed, that lengths were converted.
[[nodiscard]] std::vector<std::string> gcode_unit_remarks(const Units& units);

/// A line that controllers leave out.
[[nodiscard]] std::string gcode_remark(GcodeController controller, std::string_view text);
/// How far the controller may leave the blocks where it blends them, as the program tells it: a
/// quarter of the tolerance for LinuxCNC (G64 P), which would blend without a limit; the blocks
/// keep the rest. None for others. In the unit of `tolerance`, that of the machine.
[[nodiscard]] double blending_of(GcodeController controller, double tolerance);
/// Start of a program with such lines, and the words that stay in force. `tolerance`: of the
/// program, units of the machine.
[[nodiscard]] std::string gcode_head(GcodeController controller, bool inches, double tolerance,
                                     const std::vector<std::string>& remarks);
/// End of the program. Marlin has none: M30 would delete a file there.
/// E203 for controllers without cubic splines (G5), and for Marlin: its firmware replaces them by
/// chords that may lie 0.1 mm off (SIGMA in planner_bezier.cpp), whatever the program says.
[[nodiscard]] Result<void> check_g5(GcodeController controller);

[[nodiscard]] std::string gcode_end(GcodeController controller);

}  // namespace obvid::exchange
