// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/gcode/dialect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obvid::exchange {

Result<void> check_gcode_decimals(std::optional<int> decimals) {
  if (!decimals || (*decimals >= 1 && *decimals <= kMostGcodeDecimals)) return {};
  return error(ErrorCode::kBadOption, fmt::format("decimals must be 1 to {}", kMostGcodeDecimals))
      .where("--decimals")
      .value(*decimals);
}

bool in_inches(const Units& units) { return units.name == "in"; }

const char* machine_unit(const Units& units) { return in_inches(units) ? "in" : "mm"; }

Result<double> machine_units_in(const Units& units) {
  return unit_ratio(units, machine_unit(units), "machines");
}

std::vector<std::string> gcode_unit_remarks(const Units& units) {
  std::vector<std::string> out;
  if (!units.known()) out.emplace_back("the unit is assumed");
  if (units.name != machine_unit(units)) {
    out.push_back("converted from " + gcode_comment(units.name));
  }
  return out;
}

int decimals_of_digit(double digit, bool inches) {
  constexpr double kDigitRounding = 1e-9;  // 0.0001 asks for 4, not for 4.0000000001
  const double digits = -std::log10(digit);
  return static_cast<int>(std::clamp<double>(std::ceil(digits - kDigitRounding),
                                             kLeastGcodeDecimals + (inches ? 1 : 0),
                                             kMostGcodeDecimals));
}

std::string gcode_remark(GcodeController controller, std::string_view text) {
  if (text.empty()) return {};
  const bool semicolon = controller == GcodeController::kMarlin;
  std::string out(text);
  if (controller == GcodeController::kFanuc) {  // its characters have no small letters
    for (char& c : out) {
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
  }
  return (semicolon ? "; " : "(") + out + (semicolon ? "\n" : ")\n");
}

double blending_of(GcodeController controller, double tolerance) {
  constexpr double kOfTolerance = 0.25;
  constexpr double kDigits = 1e6,
                   kRounding = 1e-9;  // as it is printed, rounded down; P0 is no limit
  if (controller != GcodeController::kLinuxCnc) return 0.0;
  return std::max(1.0, std::floor(kOfTolerance * tolerance * kDigits * (1.0 + kRounding))) /
         kDigits;
}

std::string gcode_head(GcodeController controller, bool inches, double tolerance,
                       const std::vector<std::string>& remarks) {
  std::string out = controller == GcodeController::kFanuc ? "%\nO0001\n" : "";
  for (const std::string& remark : remarks) out += gcode_remark(controller, remark);
  const double blending = blending_of(controller, tolerance);
  if (blending > 0.0) {
    out += gcode_remark(controller, fmt::format("blended within {:.2g} {} more, G64", blending,
                                                inches ? "in" : "mm"));
  }
  out += inches ? "G20 " : "G21 ";
  switch (controller) {
    case GcodeController::kMarlin:
      return out + "G90 G17\n";
    case GcodeController::kFanuc:
      return out + "G90 G17 G40 G49 G80 G94\n";
    case GcodeController::kLinuxCnc:
      // Q0: no blocks are joined, which would leave them by as much again
      return out + fmt::format("G90 G91.1 G17 G40 G49 G80 G94\nG64 P{:.6f} Q0\n", blending);
    case GcodeController::kGrbl:
      break;
  }
  return out + "G90 G91.1 G17 G94\n";
}

Result<void> check_g5(GcodeController controller) {
  if (controller == GcodeController::kLinuxCnc) return {};
  return error(ErrorCode::kBadOption,
               controller == GcodeController::kMarlin
                   ? "Marlin may leave a G5 by 0.1 mm: no tolerance can be kept"
                   : "this controller has no splines (G5)")
      .where("--motion splines")
      .hint("choose arcs, or the controller linuxcnc");
}

std::string gcode_end(GcodeController controller) {
  switch (controller) {
    case GcodeController::kMarlin:
      return "";
    case GcodeController::kFanuc:
      return "M30\n%\n";
    case GcodeController::kGrbl:
    case GcodeController::kLinuxCnc:
      break;
  }
  return "M2\n";
}

}  // namespace obvid::exchange
