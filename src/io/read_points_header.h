// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace obvid {

/// A column by its name, and the unit that stands beside it ("x_mm", "X [mm]", "x / mm").
struct ColumnName {
  std::string name;       ///< lower case
  std::string unit;       ///< canonical; empty: none is stated
  std::string no_unit{};  ///< what stands in brackets in place of a unit and is none
};

/// The cells of a line as names of columns.
[[nodiscard]] std::vector<ColumnName> column_names(std::string_view line);

/// Which column holds what.
struct Columns {
  std::size_t count = 0;  ///< columns that have a name
  std::size_t x = 0;
  std::size_t y = 1;
  std::string unit_x, unit_y;  ///< canonical; empty: none is stated
  std::optional<std::size_t> z, heading_deg, radius, kappa, tolerance, corner;
  /// Ends of ranges.
  std::optional<std::size_t> heading_min, heading_max, radius_min, radius_max, kappa_min, kappa_max;
  /// Columns in another unit than x: what their numbers become in that of x.
  double radius_scale = 1.0, kappa_scale = 1.0, tolerance_scale = 1.0, z_scale = 1.0;
  double radius_min_scale = 1.0, radius_max_scale = 1.0;
  double kappa_min_scale = 1.0, kappa_max_scale = 1.0;
  std::vector<std::string> unused;  ///< names that mean nothing here
  std::vector<std::string> units;   ///< of all columns, canonical; empty: none is stated
  std::string no_unit;              ///< in brackets behind x or y, and none that is known
  bool tab_separated = false;       ///< header with tabs: a tab ends a cell, cells may be empty
  bool our_samples = false;         ///< columns of `samples_csv`: headings show corners
  bool of_survey = false;           ///< x and y are called easting and northing, or like them
  bool degrees = false;             ///< they are called longitude and latitude
  std::string z_name = "z";         ///< what the column z is called

  [[nodiscard]] bool has_fixed_data() const {
    return heading_deg || radius || kappa || tolerance || corner || heading_min || heading_max ||
           radius_min || radius_max || kappa_min || kappa_max;
  }

  /// Takes x and y from these columns, whatever they are called.
  void choose(std::size_t chosen_x, std::size_t chosen_y);
};

/// Of surveys: names of places (easting, northing, elevation and their like) become x, y and z
/// where no columns are called x and y. Whether there are such.
bool name_places(std::vector<ColumnName>& names);

/// The names that mean something, for messages.
[[nodiscard]] std::string_view known_columns();

/// Reads a line that names the columns; nothing when it names no x and y.
[[nodiscard]] std::optional<Columns> read_header(std::string_view line);

}  // namespace obvid
