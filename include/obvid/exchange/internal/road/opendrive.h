// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "obvid/alignment/profile.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/exchange/drawing.h"

namespace obvid {

/// Reference lines of the roads of an OpenDRIVE file (planView), one curve to a road, units "m":
/// line, arc, spiral as they are, poly3 and paramPoly3 as polynomial cubics. Each element starts
/// where the file says and ends where its formula ends: gaps between them are the file's. Where an
/// element is left out (no length, unreadable numbers, an unknown kind), a warning names it, and a
/// new curve begins behind it. Lanes, heights and the header's offset are not used.
///
/// Linear time. Errors: E308 XML that is not well-formed (truncated files), E310 another kind of
/// XML, E311 no geometry. Never throws on any input. `name` stands in errors. Source: ASAM
/// OpenDRIVE 1.6, 7.3 to 7.8.
[[nodiscard]] Result<Drawing> parse_opendrive(std::string_view text, std::string_view name);

struct OpenDriveOptions {
  std::string name = "contour";
  double lane_width = 3.5;  ///< m; of the one lane to the right; 0: none, which readers may refuse
  double first_station = 0.0;  ///< of the start, units of the contour
  std::optional<VerticalProfile>
      profile{};            ///< of heights, stations as from `first_station`, units of the
                            ///< contour; its first and last grade go on to both ends
  double tolerance = 1e-6;  ///< of cubics in place of its arcs, units of the contour
};

/// An OpenDRIVE 1.6 file whose reference line is the contour in metres (converted from its units):
/// line, arc and spiral elements, exactly. One road; at corners, where a reference line must not
/// bend, a new one begins, linked to the one before; a closed contour is linked to itself. A
/// profile is exact where it has parabolas; arcs become cubics within the tolerance. Errors:
/// those of `road_lines` (other pieces than lines, arcs and clothoids: E310), E203 a lane width
/// that is negative or not finite.
[[nodiscard]] Result<std::string> opendrive_text(const Contour& contour,
                                                 const OpenDriveOptions& options = {});

}  // namespace obvid
