// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/units.h"
#include "obvid/io/read_points.h"
#include "obvid/series/point_series.h"
#include "text_digits.h"

namespace obvid {

/// Head of an OpenVSP .af file.
struct VspHead {
  bool symmetric = false;
  std::optional<std::size_t> upper;
  std::optional<std::size_t> lower;
};

/// The rows of a point file as they stand, before an airfoil format is recognised in them.
struct RawPoints {
  std::string title;
  bool named = false;        ///< a header names the columns
  bool our_samples = false;  ///< columns as `samples_csv` writes them
  Units units;               ///< of the column names; assumed when they have none
  bool white = false;        ///< blanks or tabs separate the fields
  std::size_t columns = 2;   ///< numbers per row
  std::vector<Vec2> points;
  std::vector<std::uint32_t> lines;                 ///< line of each point, from 1
  std::vector<FixedData> fixed;                     ///< empty, or one per point
  std::array<text::ColumnDigits, 2> digits;         ///< of x and y, without the first row
  std::array<text::PrintedDigits, 2> first_digits;  ///< first row: it may turn out to be no point
  text::ColumnDigits height_digits;                 ///< of z, where heights are read
  bool first_is_point = true;
  std::vector<std::size_t> breaks;          ///< points before which a blank line stands
  std::optional<std::size_t> stated_count;  ///< a count that stands before the points
  std::uint32_t stated_line = 0;
  bool reference_first = false;  ///< OpenFAST: the first pair is no point of the contour
  std::optional<VspHead> vsp;
  std::vector<std::string> warnings;
};

/// Reads title, header and rows. Errors: E302, E303, E305 with line and column.
[[nodiscard]] Result<RawPoints> read_rows(std::string_view text, std::string_view name,
                                          const PointListOptions& options);

/// Recognises Lednicer, OpenVSP .af, OpenFAST coordinates and a plain count line, checks the
/// counts (E307), and puts two-sided airfoils into one series: upper trailing edge, leading edge,
/// lower trailing edge.
[[nodiscard]] Result<void> resolve_layout(RawPoints& raw, std::string_view name);

}  // namespace obvid
