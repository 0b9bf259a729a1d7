// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/surface/point_grid.h"

namespace obvid {

struct SectionOptions {
  double spacing = 1.0;  ///< units along z between sections whose files have no z
};

/// Sections of a body, in any of the forms of docs/formats.md ("Surfaces"): one file each, with x y
/// z or with x y (z then counts by the spacing); one file with sections separated by blank lines or
/// titles, or by a column named `section`; the rows of three matrices as of `read_grid`, of
/// several panels too, each beginning where the one before ends (a corner); rotor
/// blades in cylindrical coordinates (Z R THETA 1 THETA 2, rad); airfoils of a blade with the table
/// that places them (columns BlSpn, BlCrvAC, BlSwpAC, BlTwist, BlChord, BlAFID); tables of
/// half-breadths of a ship, with labels and empty cells: a section for each station, of the cells
/// that are there. `assumed`, where it is not null, gets what was read into labels and what was
/// left out. Asks between files, and in long ones on streamsurfaces. Errors: E103; E301 to E307
/// with place.
[[nodiscard]] Result<std::vector<SpaceSeries>> read_sections(
    const std::vector<std::string>& paths, const SectionOptions& options = {},
    std::vector<std::string>* assumed = nullptr, const RunContext& run = {});
/// One text with one section or more. `flat` tells that no z was there.
struct ParsedSections {
  std::vector<SpaceSeries> sections;
  bool flat = false;
  std::vector<std::string> assumed{};  ///< as of `read_sections`
};
[[nodiscard]] Result<ParsedSections> parse_sections(std::string_view text, std::string_view name,
                                                    const SectionOptions& options = {},
                                                    const RunContext& run = {});

}  // namespace obvid
