// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace obvid {

/// Which column holds what.
struct Columns {
  std::size_t x = 0;
  std::size_t y = 1;
  std::optional<std::size_t> z, heading_deg, radius, kappa, tolerance, corner;
  bool tab_separated = false;  ///< header with tabs: a tab ends a cell, cells may be empty

  [[nodiscard]] bool has_fixed_data() const {
    return heading_deg || radius || kappa || tolerance || corner;
  }
};

/// Reads a line that names the columns; nothing when it names no x and y.
[[nodiscard]] std::optional<Columns> read_header(std::string_view line);

}  // namespace obvid
