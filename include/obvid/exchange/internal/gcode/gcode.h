// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// How a controller is told to move.
enum class GcodeMotion {
  kArcs,     ///< G2 and G3, nearly straight ones as G1
  kLines,    ///< G1 only, the longest chords one after another
  kSplines,  ///< G5, cubic Beziers (LinuxCNC)
};

enum class GcodeController { kGrbl, kLinuxCnc, kFanuc, kMarlin };

/// Feed where none is given: 1000 mm/min, for inches 40 in/min.
[[nodiscard]] double default_feed(const Units& units);

struct GcodeOptions {
  GcodeMotion motion = GcodeMotion::kArcs;
  GcodeController controller = GcodeController::kGrbl;
  double tolerance = 0.01;         ///< units of the contour: printed path against contour
  std::optional<double> feed{};    ///< mm/min, for contours in inches in/min [default_feed]
  std::optional<int> decimals{};   ///< of the ends, 1 to 6 [the fewest, at least 3, that cost no
                                   ///< more than a tenth of the tolerance; in inches one more]
  std::optional<double> safe_z{};  ///< mm or in: approach and leave at this height, cut at Z0;
                                   ///< nothing: no word about Z
  std::string name = "contour";    ///< stands in a comment
};

/// A name as it may stand in a comment of a program: in plain letters (`plain_letters`), at most 58
/// characters, without what ends comments, lines or programs.
[[nodiscard]] std::string gcode_comment(std::string_view name);

/// A program in the plane G17, absolute ends (G90), centres from the start of the arc (G91.1): it
/// begins with a rapid move to the start and holds no tool and no spindle.
struct GcodeText {
  std::string text;
  std::size_t blocks = 0;      ///< that move along the contour
  std::size_t arc_blocks = 0;  ///< of them G2 and G3
  double deviation = 0.0;      ///< largest distance, both ways, of the path as printed from the
                               ///< contour, units of the contour: an upper bound
};

/// G21 and millimetres, or G20 for contours in inches; other units are converted to millimetres,
/// which a comment says; one that is merely assumed is named so. Centres have 5 decimals (6, where
/// the ends have) and lie on the bisector of the ends as printed: radii at both ends of an arc
/// differ by less than 2e-5. Arcs turn by less than half a turn; those lower than half of the last
/// digit, or with chords below 20 of it, are lines; ends that round to the place where the tool
/// stands are left out. Errors: E203 a tolerance or feed that is not greater than 0, decimals out
/// of range, G5 for another controller than LinuxCNC (`check_g5`); E203 a unit without a length in
/// metres; E502 the tolerance is too small for the decimals; those of `arcs_along`,
/// `polyline_along` and `cubic_along`; E103 where `watch` ends it.
[[nodiscard]] Result<GcodeText> gcode_text(const Contour& contour, const GcodeOptions& options = {},
                                           Watch* watch = nullptr);

}  // namespace obvid
