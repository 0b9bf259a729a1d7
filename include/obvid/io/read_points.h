// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "obvid/core/result.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// Whether two distinct points are enough: they are when somebody else gives headings at both.
enum class TwoPoints { kTooFew, kDo };

/// What two points lack, for who gives headings by options.
inline constexpr const char* kTwoWithHeadings =
    "two do when both have a heading: --start-heading and --end-heading, or column heading_deg";

/// What somebody says of a list of points beside what stands in it.
struct PointListOptions {
  TwoPoints two = TwoPoints::kTooFew;
  const char* hint_of_two = kTwoWithHeadings;  ///< where two are too few; lasts as long
  std::size_t skip = 0;  ///< lines at the beginning that are not looked at; errors count them
  std::optional<std::array<std::size_t, 2>>
      columns{};         ///< of x and y, from 0, whatever their names
  bool heights = false;  ///< a column z is that of heights (FixedData::height)
};

/// What is left of a text behind its first lines.
[[nodiscard]] std::string_view behind_lines(std::string_view text, std::size_t lines);

/// Reads a file, or standard input for "-". Errors: E301 and those of `parse_points`.
[[nodiscard]] Result<PointSeries> read_points(const std::string& path,
                                              const PointListOptions& options = {});

/// Reads points from text in any of the forms of docs/formats.md. `name` stands in errors as
/// `name:line:column`. Consecutive duplicates are merged with a warning.
/// Errors: E302 bad number, E303 NaN or infinite, E304 fewer than 3 distinct points (2 with
/// headings at both suffice), E305 fewer than 2 columns, E306 not text, E307 a stated count does
/// not match. Cost O(size).
[[nodiscard]] Result<PointSeries> parse_points(std::string_view text, std::string_view name,
                                               const PointListOptions& options = {});

}  // namespace obvid
