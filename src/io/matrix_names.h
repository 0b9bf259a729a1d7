// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

namespace obvid {

/// Three files that hold one coordinate of the same points each: their names differ in one letter
/// that stands by itself, x, y and z: hull_x.dat, hull_x_in.dat, x.dat.
struct MatrixName {
  std::string before, after;  ///< the letter; with folders and ending
  std::size_t axis = 0;       ///< 0, 1, 2
  bool upper = false;         ///< the letter is a capital

  [[nodiscard]] std::string path(std::size_t of_axis) const;
  /// Name of the three together, without folders and ending.
  [[nodiscard]] std::string common_name() const;
  [[nodiscard]] bool same_grid(const MatrixName& other) const {
    return before == other.before && after == other.after && upper == other.upper;
  }
};

/// The letter that the other two files of the same grid have changed; where it ends the name after
/// an underscore, one of them is enough. Nothing: no such letter, or no such files.
[[nodiscard]] std::optional<MatrixName> matrix_with_siblings(const std::string& path);

/// Whether the name alone says that it is one of three: it ends with _x, _y or _z.
[[nodiscard]] std::optional<MatrixName> matrix_by_ending(const std::string& path);

/// Whether the name speaks of a coordinate (`_x_` or `_y_` inside, or `_x`, `_y`, `_z` at its end),
/// though the other files of the grid are not there.
[[nodiscard]] std::optional<MatrixName> lonely_matrix(const std::string& path);

}  // namespace obvid
