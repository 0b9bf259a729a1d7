// SPDX-License-Identifier: Apache-2.0
// The cells of a row: coordinates, and data fixed at a point.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "obvid/core/units.h"
#include "read_points_reader.h"

namespace obvid {

using std::string_view;
using text::NumberKind;
using text::ParsedNumber;
using text::Separator;
using text::shown;

namespace {

// Stands for an empty cell where blanks separate.
constexpr string_view kNothing = "-";

}  // namespace

Result<double> RowReader::number_at(string_view line, std::size_t column) {
  const string_view cell = fields_.cell[column];
  const Place place{line, cell.data()};
  const ParsedNumber number = text::parse_number(cell, separator_ != Separator::kComma);
  if (number.kind == NumberKind::kNotNumber) {
    const std::string what =
        cell.empty() ? "a number is missing" : shown(cell) + " is not a number";
    return fail(error(ErrorCode::kBadNumber, what, place));
  }
  if (number.kind == NumberKind::kNotFinite) {
    return fail(error(ErrorCode::kNotFinite, shown(cell) + " is not a finite number", place));
  }
  decimal_comma_seen_ = decimal_comma_seen_ || number.decimal_comma;
  decimal_point_seen_ = decimal_point_seen_ || number.decimal_point;
  if (decimal_comma_seen_ && decimal_point_seen_) {
    return fail(error(ErrorCode::kBadNumber,
                      shown(cell) + ": decimal comma and decimal point in one file", place));
  }
  return number.value;
}

bool RowReader::is_given(std::optional<std::size_t> column) const {
  return column && *column < fields_.count && !fields_.cell[*column].empty() &&
         fields_.cell[*column] != kNothing;
}

Result<std::optional<double>> RowReader::optional_cell(string_view line,
                                                       std::optional<std::size_t> column,
                                                       bool infinite_allowed) {
  if (!is_given(column)) return std::optional<double>();
  if (infinite_allowed) {
    const ParsedNumber number = text::parse_number(fields_.cell[*column], true);
    if (number.kind == NumberKind::kNotFinite && std::isinf(number.value)) return number.value;
  }
  const Result<double> value = number_at(line, *column);
  OBVID_TRY(value);
  return std::optional<double>(*value);
}

Result<std::optional<double>> RowReader::read_curvature(string_view line) {
  const auto radius = optional_cell(line, layout_.radius, true);
  OBVID_TRY(radius);
  auto kappa = optional_cell(line, layout_.kappa, false);
  if (kappa && *kappa) **kappa *= layout_.kappa_scale;
  if (!kappa || !*radius) return kappa;
  if (*kappa) {
    return fail(error(ErrorCode::kBadNumber, "radius and kappa are both given",
                      {line, fields_.cell[*layout_.kappa].data()}));
  }
  const double curvature = 1.0 / (**radius * layout_.radius_scale);
  if (!std::isfinite(curvature)) {
    const string_view cell = fields_.cell[*layout_.radius];
    return fail(error(ErrorCode::kNotFinite,
                      "a radius of " + shown(cell) + " has no finite curvature; inf is straight",
                      {line, cell.data()}));
  }
  return std::optional<double>(curvature);
}

Result<std::optional<ValueRange>> RowReader::read_range(string_view line,
                                                        std::optional<std::size_t> low,
                                                        std::optional<std::size_t> high,
                                                        bool infinite_allowed) {
  const auto least = optional_cell(line, low, infinite_allowed);
  OBVID_TRY(least);
  const auto greatest = optional_cell(line, high, infinite_allowed);
  OBVID_TRY(greatest);
  if (!*least && !*greatest) return std::optional<ValueRange>();
  ValueRange out;
  if (*least) out.low = **least;
  if (*greatest) out.high = **greatest;
  if (out.empty()) {
    return fail(error(ErrorCode::kBadNumber, "the least value is larger than the greatest",
                      {line, fields_.cell[*low].data()}));
  }
  return std::optional(out);
}

Result<std::optional<ValueRange>> RowReader::read_heading_range(string_view line) {
  const auto degrees = read_range(line, layout_.heading_min, layout_.heading_max, false);
  if (!degrees || !*degrees) return degrees;
  const ValueRange& range = **degrees;
  if (!(range.high - range.low <= 180.0)) {
    const auto column = is_given(layout_.heading_min) ? layout_.heading_min : layout_.heading_max;
    return fail(error(ErrorCode::kBadNumber,
                      "a range of headings needs heading_min and heading_max, at most 180 degrees "
                      "apart",
                      {line, fields_.cell[*column].data()}));
  }
  return std::optional(ValueRange{range.low * kOneDegree, range.high * kOneDegree});
}

Result<std::optional<ValueRange>> RowReader::read_curvature_range(string_view line) {
  auto radii = read_range(line, layout_.radius_min, layout_.radius_max, true);
  if (!radii) return radii;
  auto kappas = read_range(line, layout_.kappa_min, layout_.kappa_max, false);
  if (kappas && *kappas) {
    (*kappas)->low *= layout_.kappa_min_scale;
    (*kappas)->high *= layout_.kappa_max_scale;
  }
  if (!kappas || !*radii) return kappas;
  (*radii)->low *= layout_.radius_min_scale;
  (*radii)->high *= layout_.radius_max_scale;
  const auto of_radii = curvatures_of_radii(**radii);
  if (of_radii && !*kappas) return std::optional(*of_radii);
  const auto column = is_given(layout_.radius_min) ? layout_.radius_min : layout_.radius_max;
  return fail(error(ErrorCode::kBadNumber,
                    of_radii ? "ranges of radius and of kappa are both given"
                             : "both ends of a range of radii have one sign",
                    {line, fields_.cell[*column].data()}));
}

Result<bool> RowReader::read_corner(string_view line) {
  static constexpr std::array<string_view, 3> kYes{"1", "yes", "true"};
  static constexpr std::array<string_view, 3> kNo{"0", "no", "false"};
  if (!is_given(layout_.corner)) return false;
  const string_view cell = fields_.cell[*layout_.corner];
  std::string word;
  for (const char c : cell) {
    if (c != '"') word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (std::find(kYes.begin(), kYes.end(), word) != kYes.end()) return true;
  if (std::find(kNo.begin(), kNo.end(), word) != kNo.end()) return false;
  return fail(error(ErrorCode::kBadNumber, "corner is 0 or 1, yes or no, not " + shown(cell),
                    {line, cell.data()}));
}

Result<FixedData> RowReader::read_fixed(string_view line) {
  const auto heading = optional_cell(line, layout_.heading_deg, false);
  OBVID_TRY(heading);
  const auto kappa = read_curvature(line);
  OBVID_TRY(kappa);
  const auto tolerance = optional_cell(line, layout_.tolerance, false);
  OBVID_TRY(tolerance);
  if (*tolerance && **tolerance < 0.0) {
    return fail(error(ErrorCode::kBadNumber, "a tolerance is never negative",
                      {line, fields_.cell[*layout_.tolerance].data()}));
  }
  const auto corner = read_corner(line);
  OBVID_TRY(corner);
  FixedData fixed;
  if (*heading) fixed.theta = **heading * kOneDegree;
  fixed.kappa = *kappa;
  if (*tolerance) fixed.tolerance = **tolerance * layout_.tolerance_scale;
  fixed.corner = *corner;
  const auto thetas = read_heading_range(line);
  OBVID_TRY(thetas);
  fixed.thetas = *thetas;
  const auto kappas = read_curvature_range(line);
  OBVID_TRY(kappas);
  fixed.kappas = *kappas;
  return fixed;
}

}  // namespace obvid
