// SPDX-License-Identifier: Apache-2.0
// Tables of half-breadths of ships, with labels and empty cells.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/surface/point_grid.h"

namespace obvid {

/// Stations of a table as sections in the order of their places: x the station, y the half-breadth,
/// z the waterline; of the cells that are there, upwards.
struct OffsetSections {
  std::vector<SpaceSeries> sections;
  std::vector<std::string> assumed;  ///< what was read into labels, and what was left out
};

/// A first line of a word and numbers, or of labels like `wl_0.5` or `Station 3`, two at least.
[[nodiscard]] bool is_offset_text(std::string_view text);

/// Rows are waterlines or stations by labels, else by the word in the corner, else waterlines.
/// Labels are numbers, with WL or Station before them, or FP and AP: the station 0 and the one that
/// lies as far behind the last number as FP before the first. Rows and columns with other labels
/// are left out and named, and so are stations with fewer than three cells; empty cells (nothing or
/// a dash) are never 0. Errors: E302 a cell that is no number, E303, E304 fewer than two stations,
/// E307 a row of another length, E313 stations or waterlines out of order; with line and column.
[[nodiscard]] Result<OffsetSections> parse_offset_table(std::string_view text,
                                                        std::string_view name);

}  // namespace obvid
