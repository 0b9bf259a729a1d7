// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "read_points_header.h"
#include "read_points_raw.h"
#include "text_digits.h"
#include "text_lines.h"
#include "text_number.h"

namespace obvid {

/// Reads the rows of one text. Its functions stand in
/// read_points_{preamble,rows,cells,trailer}.cpp.
class RowReader {
 public:
  RowReader(std::string_view text, std::string_view name, const PointListOptions& options)
      : text_(text), name_(name), options_(options), cursor_(text) {}

  Result<RawPoints> read();

 private:
  struct Place {
    std::string_view line;
    const char* at = nullptr;
  };

  Result<void> read_preamble();
  Result<bool> read_preamble_line(std::string_view line);
  void watch_comment(std::string_view line);
  Result<void> take_count(std::string_view line, double count);
  Result<void> take_text(std::string_view line);
  bool is_first_row(std::string_view body);
  [[nodiscard]] bool rows_have(const Columns& columns, std::string_view header) const;
  void skip_lines();
  void take_chosen_columns();
  Result<void> take_vsp(std::string_view line, const text::ParsedNumber& number);

  Result<void> take_unit();
  Result<void> read_all_rows();
  bool read_plain_pair();
  Result<void> read_row(std::string_view line);
  Result<void> read_unnamed_row(Place place);
  Result<void> read_named_row(Place place);
  [[nodiscard]] std::size_t most_rows_left(std::size_t cells) const;

  Result<double> number_at(std::string_view line, std::size_t column);
  Result<std::optional<double>> optional_cell(std::string_view line,
                                              std::optional<std::size_t> column,
                                              bool infinite_allowed);
  [[nodiscard]] bool is_given(std::optional<std::size_t> column) const;
  Result<FixedData> read_fixed(std::string_view line);
  Result<std::optional<double>> read_curvature(std::string_view line);
  Result<std::optional<ValueRange>> read_range(std::string_view line,
                                               std::optional<std::size_t> low,
                                               std::optional<std::size_t> high,
                                               bool infinite_allowed);
  Result<std::optional<ValueRange>> read_heading_range(std::string_view line);
  Result<std::optional<ValueRange>> read_curvature_range(std::string_view line);
  Result<bool> read_corner(std::string_view line);

  Result<void> check_columns(Place place, std::size_t count);
  bool drop_grid_bounds(std::size_t count);
  void watch_third(double value);
  void watch_length(const std::array<double, 3>& row);
  [[nodiscard]] bool first_counts() const;
  [[nodiscard]] Result<void> refuse_numbers() const;
  void warn_about_meaning();
  void warn_about_names();
  void warn_about_level();
  void take_unknown_names();
  void push(Vec2 point, const text::PrintedDigits& x, const text::PrintedDigits& y);

  bool is_trailer(const Error& error, std::string_view line) const;
  bool is_airfoil_loop() const;
  bool number_row_follows() const;
  void warn_about_trailer();

  [[nodiscard]] Error error(ErrorCode code, std::string what, Place place) const;

  std::string_view text_;
  std::string_view name_;
  const PointListOptions& options_;
  text::LineCursor cursor_;
  RawPoints raw_;
  Columns layout_;
  std::optional<Columns> commented_;  ///< names that a comment gives the columns
  text::Separator separator_ = text::Separator::kWhite;
  text::Fields fields_;
  std::array<double, 4> first_row_{};
  std::optional<std::array<double, 3>> row_before_;
  bool degrees_named_ = false;   ///< columns called lon and lat
  bool first_is_length_ = true;  ///< so far the first column grows by the distance of the others
  std::size_t length_rows_ = 0;
  bool first_counts_ = true;  ///< so far whole numbers, each larger by 1 than the one before
  bool second_changes_ = false;
  double least_of_others_ = HUGE_VAL;  ///< magnitude in the second and third column
  std::optional<double> third_;
  bool third_changes_ = false;
  bool title_seen_ = false;
  bool blank_before_ = false;
  bool decimal_comma_seen_ = false;
  bool decimal_point_seen_ = false;
  bool is_vsp_ = false;
};

[[nodiscard]] inline bool starts_like_number(std::string_view cell) {
  return !cell.empty() &&
         std::string_view("+-.0123456789").find(cell.front()) != std::string_view::npos;
}

}  // namespace obvid
