// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/surface/point_grid.h"

namespace obvid {

struct GridOptions {
  double spacing = 1.0;  ///< units between rows and columns of a matrix of heights
};

/// A grid of points, in any of the forms of docs/formats.md ("Surfaces"):
/// three files whose names differ in one letter x, y, z that stands by itself (hull_x.dat,
/// hull_x_in.dat), one matrix in each (one of the names is enough); a list x y z, rows separated by blank lines, or led by a line with the two
/// counts, or found by a coordinate that repeats; named columns row, col, x, y, z; a matrix of
/// heights; a table of half-breadths over stations (first row) and waterlines (first column).
/// Errors: E301 to E307 with place, E307 also for rows of different length and for a matrix whose
/// name says that it holds x or y alone.
[[nodiscard]] Result<PointGrid> read_grid(const std::vector<std::string>& paths,
                                          const GridOptions& options = {});
/// One text; not the form of three matrices.
[[nodiscard]] Result<PointGrid> parse_grid(std::string_view text, std::string_view name,
                                           const GridOptions& options = {});

}  // namespace obvid
