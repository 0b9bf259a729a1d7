// SPDX-License-Identifier: Apache-2.0
// The rows themselves.
#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "obvid/core/internal/figures.h"
#include "obvid/geom/internal/box.h"
#include "read_points_reader.h"

namespace obvid {

using std::string_view;
using text::NumberKind;
using text::ParsedNumber;
using text::Separator;
using text::shown;

Error RowReader::error(ErrorCode code, std::string what, Place place) const {
  Error error;
  error.code = code;
  error.what = std::move(what);
  error.where = text::position(name_, cursor_.line_number(), text::column_of(place.line, place.at));
  error.index = static_cast<std::ptrdiff_t>(raw_.points.size());
  return error;
}

Result<RawPoints> RowReader::read() {
  // OpenVSP files have two lines of text before their counts.
  constexpr std::size_t kVspHeadLength = 4096;
  is_vsp_ = text_.substr(0, kVspHeadLength).find("Num Pnts Upper") != string_view::npos;
  skip_lines();
  OBVID_TRY(read_preamble());
  take_chosen_columns();
  OBVID_TRY(read_all_rows());
  raw_.white = separator_ == Separator::kWhite;
  raw_.our_samples = raw_.named && layout_.our_samples;
  OBVID_TRY(take_unit());
  OBVID_TRY(refuse_numbers());
  warn_about_meaning();
  return std::move(raw_);
}

Result<void> RowReader::take_unit() {
  if (!raw_.named) return {};
  std::vector<Units> all;
  for (const std::string& unit : {layout_.unit_x, layout_.unit_y}) {
    if (!unit.empty()) all.emplace_back(unit);
  }
  auto units = common_units(all, name_);
  OBVID_TRY(units);
  raw_.units = std::move(*units);
  return {};
}

Result<void> RowReader::read_all_rows() {
  take_unknown_names();
  const bool pairs = !raw_.named && raw_.columns == 2 &&
                     (separator_ == Separator::kWhite || separator_ == Separator::kComma);
  const bool named_pairs = raw_.named && layout_.x == 0 && layout_.y == 1 &&
                           !layout_.has_fixed_data() && !layout_.z &&
                           separator_ == Separator::kComma;
  while (!cursor_.at_end()) {
    if ((pairs || named_pairs) && read_plain_pair()) continue;
    const string_view line = cursor_.peek();
    if (text::trim(line).empty()) {
      blank_before_ = true;
    } else if (!text::is_comment(line)) {
      if (auto row = read_row(line); !row) {
        if (!is_trailer(row.error(), line)) return row;
        warn_about_trailer();
        return {};
      }
    }
    cursor_.skip(line);
  }
  return {};
}

void RowReader::push(Vec2 point, const text::PrintedDigits& x, const text::PrintedDigits& y) {
  if (blank_before_ && !raw_.points.empty()) raw_.breaks.push_back(raw_.points.size());
  blank_before_ = false;
  if (raw_.points.empty()) {
    raw_.first_digits = {x, y};
  } else {
    raw_.digits[0].add(x);
    raw_.digits[1].add(y);
  }
  // Adding +0 turns -0 into +0: both are the same place, but not the same heading of a chord.
  raw_.points.push_back({point.x + 0.0, point.y + 0.0});
  raw_.lines.push_back(static_cast<std::uint32_t>(cursor_.line_number()));
}

// Fast way for rows that are two plain numbers and nothing else. Leaves the cursor where it was
// and says false when the row is anything else.
bool RowReader::read_plain_pair() {
  const string_view rest = cursor_.rest();
  const char* const end = rest.data() + rest.size();
  const char* p = rest.data();
  const auto skip_blanks = [&] {
    while (p != end && text::is_blank(*p)) ++p;
  };
  Vec2 point;
  skip_blanks();
  const char* const x_begin = p;
  const auto x = fast_float::from_chars(p, end, point.x);
  if (x.ec != std::errc() || x.ptr == end) return false;
  p = x.ptr;
  skip_blanks();
  if (separator_ == Separator::kComma) {
    if (p == end || *p != ',') return false;
    ++p;
    skip_blanks();
  } else if (p == x.ptr) {
    return false;
  }
  const char* const y_begin = p;
  const auto y = fast_float::from_chars(p, end, point.y);
  if (y.ec != std::errc()) return false;
  p = y.ptr;
  skip_blanks();
  if (raw_.named && p != end && *p == ',') {
    // Columns that the header gives no meaning are not looked at.
    p += std::min(rest.find_first_of("\r\n", static_cast<std::size_t>(p - rest.data())),
                  rest.size()) -
         static_cast<std::size_t>(p - rest.data());
  }
  const bool line_ends = p == end || *p == '\n' || *p == '\r';
  if (!line_ends || !std::isfinite(point.x) || !std::isfinite(point.y)) return false;
  const auto length = static_cast<std::size_t>(p - rest.data());
  if (!decimal_point_seen_) {
    decimal_point_seen_ = std::memchr(rest.data(), '.', length) != nullptr;
    if (decimal_point_seen_ && decimal_comma_seen_) return false;
  }
  const auto printed = [](const char* from, const char* to) {
    return text::digits_of({from, static_cast<std::size_t>(to - from)});
  };
  push(point, printed(x_begin, x.ptr), printed(y_begin, y.ptr));
  cursor_.skip_line_of(length);
  return true;
}

Result<void> RowReader::read_row(string_view line) {
  text::split(text::without_comment(line), separator_, fields_);
  const Place place{line, text::trim(line).data()};
  return raw_.named ? read_named_row(place) : read_unnamed_row(place);
}

Result<void> RowReader::read_unnamed_row(Place place) {
  if (fields_.count == 1 && text::parse_number(fields_.cell[0], true).kind == NumberKind::kNumber) {
    return fail(
        error(ErrorCode::kTooFewColumns, "a point needs two numbers, the line has one", place));
  }
  std::array<double, 2> xy{};
  for (std::size_t i = 0; i < std::min<std::size_t>(fields_.count, 2); ++i) {
    const Result<double> number = number_at(place.line, i);
    OBVID_TRY(number);
    xy[i] = *number;
  }
  if (fields_.count < 2) {
    return fail(error(ErrorCode::kTooFewColumns, "a point needs two numbers", place));
  }
  std::size_t count = 2;
  for (; count < fields_.count; ++count) {
    const auto number = text::parse_number(fields_.cell[count], separator_ != Separator::kComma);
    if (number.kind == NumberKind::kNotNumber) break;
    if (count == 2) watch_third(number.value);
    if (count > 2) continue;
    const string_view first = fields_.cell[0];
    first_counts_ = first_counts_ && first.find_first_not_of("0123456789") == first.npos;
    watch_length({xy[0], xy[1], number.value});
  }
  OBVID_TRY(check_columns(place, count));
  push({xy[0], xy[1]}, text::digits_of(fields_.cell[0]), text::digits_of(fields_.cell[1]));
  return {};
}

// Rows of different length are no point list but wrapped numbers or several tables.
Result<void> RowReader::check_columns(Place place, std::size_t count) {
  if (count == raw_.columns || drop_grid_bounds(count)) return {};
  const bool fewer = count < raw_.columns;
  Error uneven = error(fewer ? ErrorCode::kTooFewColumns : ErrorCode::kBadNumber,
                       "the row has " + std::to_string(count) + " numbers, the first row has " +
                           std::to_string(raw_.columns),
                       fewer ? place : Place{place.line, fields_.cell[raw_.columns].data()});
  uneven.hint = "give each point one row with the same columns";
  return fail(std::move(uneven));
}

// MSES writes xmin xmax ymin ymax of its grid before the points.
bool RowReader::drop_grid_bounds(std::size_t count) {
  const bool bounds = raw_.columns == 4 && count == 2 && raw_.points.size() == 1 &&
                      separator_ == Separator::kWhite && first_row_[0] < first_row_[1] &&
                      first_row_[2] < first_row_[3];
  if (!bounds) return false;
  raw_.columns = 2;
  raw_.points.clear();
  raw_.lines.clear();
  return true;
}

// Three columns without names may be s, x and y: then the first one grows by the distance of the
// points that the other two give.
void RowReader::watch_length(const std::array<double, 3>& row) {
  constexpr double kSame =
      0.02;  // of a step: a chord is that much shorter when it turns by 40 degrees
  if (row_before_ && (first_is_length_ || first_counts_)) {
    const std::array<double, 3>& before = *row_before_;
    const double step = row[0] - before[0];
    const double chord = std::hypot(row[1] - before[1], row[2] - before[2]);
    first_is_length_ = first_is_length_ && step > 0.0 && std::abs(chord - step) <= kSame * step;
    first_counts_ = first_counts_ && step == 1.0;
    second_changes_ = second_changes_ || row[1] != before[1];
    ++length_rows_;
  }
  least_of_others_ = std::min({least_of_others_, std::abs(row[1]), std::abs(row[2])});
  row_before_ = row;
}

// Whole numbers that rise by 1 beside two columns that change: points with their numbers.
bool RowReader::first_counts() const {
  constexpr std::size_t kFewestSteps = 3;
  return !raw_.named && first_counts_ && length_rows_ >= kFewestSteps && second_changes_ &&
         third_changes_;
}

// Numbers of points are refused as x where the other two columns lie as far out as places on a grid
// of a country do: nobody draws a height of millions over a count. Elsewhere, in a list of heights
// over a grid, say, the first column may be x all the same, and a warning has to do.
Result<void> RowReader::refuse_numbers() const {
  constexpr double kGrid = 1e4;  // units; false eastings are 100 km and more
  if (!first_counts() || least_of_others_ < kGrid) return {};
  return obvid::error(ErrorCode::kUnsupported,
                      "the first column looks like point numbers, the next two like eastings and "
                      "northings, in one order or the other")
      .where(std::string(name_))
      .hint(
          "--columns 2,3 where eastings come first, --columns 3,2 where northings do; or a first "
          "line that names the columns: `point,northing,easting,elevation,description`");
}

// Numbers that are probably not what they are taken for.
void RowReader::warn_about_meaning() {
  constexpr std::size_t kFewestRows = 4;
  if (!(first_is_length_ && length_rows_ >= kFewestRows) && first_counts()) {
    raw_.warnings.emplace_back(
        "The first column rises by 1 from row to row: it looks like point numbers, but is taken as "
        "x. --columns 2,3 takes the other two (3,2 where northings come first), and so does a "
        "first "
        "line `point x y`.");
  }
  if (first_is_length_ && length_rows_ >= kFewestRows) {
    raw_.warnings.emplace_back(
        "The first column grows by the distance of the points in the second and third: it looks "
        "like an arc length, but is taken as x. --columns 2,3 takes the other two, and so does a "
        "first line `s x y`.");
  }
  warn_about_names();
  warn_about_level();
  if (!layout_.no_unit.empty()) {
    raw_.warnings.push_back(fmt::format("{} is no unit that is known ({}): the lengths have none.",
                                        shown(layout_.no_unit), known_units()));
  }
  if (raw_.points.empty() || raw_.units.known()) return;
  Box2 box;
  for (const Vec2 p : raw_.points) box.add(p);
  // places on the globe lie far from its origin, within a part of a degree
  constexpr double kMostDegrees = 0.5, kPart = 0.02;
  const auto place = [&](double from, double to, double limit) {
    const double far = std::min(std::abs(from), std::abs(to));
    return to - from <= std::min(kMostDegrees, kPart * far) &&
           std::max(std::abs(from), std::abs(to)) <= limit;
  };
  const bool lon_lat = place(box.low.x, box.high.x, 180.0) && place(box.low.y, box.high.y, 90.0);
  const bool lat_lon = place(box.low.x, box.high.x, 90.0) && place(box.low.y, box.high.y, 180.0);
  if (degrees_named_ || lon_lat || lat_lon) {
    raw_.warnings.emplace_back(
        "The coordinates look like longitude and latitude in degrees, which are no lengths: as GPX "
        "or GeoJSON they are projected to metres.");
  }
}

// A heading that is not fixed because its column has another name would go unnoticed.
void RowReader::warn_about_names() {
  constexpr std::size_t kMostNames = 5;
  if (!raw_.named || layout_.unused.empty()) return;
  const std::size_t count = layout_.unused.size();
  std::string names;
  for (std::size_t i = 0; i < std::min(count, kMostNames); ++i) {
    names += (i == 0 ? "" : ", ") + shown(layout_.unused[i]);
  }
  names += and_more(count, kMostNames);
  raw_.warnings.push_back((count == 1 ? "The column " : "The columns ") + names +
                          (count == 1 ? " is" : " are") + " not used: known are " +
                          std::string(known_columns()) + ".");
}

// Heights that are all the same are left out as well.
void RowReader::warn_about_level() {
  if (!raw_.named || third_changes_ || third_.value_or(0.0) == 0.0) return;
  raw_.warnings.push_back("The column " + layout_.z_name + " is " + fmt::format("{}", *third_) +
                          " at every point: the contour is formed and written in x and y, at z 0.");
}

// A third column that changes may be a height or a width: say that it is not used.
void RowReader::watch_third(double value) {
  if (!third_) third_ = value;
  if (third_changes_ || value == *third_) return;
  third_changes_ = true;
  raw_.warnings.push_back((raw_.named ? "The column " + layout_.z_name : "The third column") +
                          " is not used although it changes, first in line " +
                          std::to_string(cursor_.line_number()) +
                          ": the contour lies in the plane of x and y. `obvid fit` forms points "
                          "with named columns x, y, z, or with --along Z, as a curve in space.");
}

/// Rows of at least so many cells that may follow, this one included.
std::size_t RowReader::most_rows_left(std::size_t cells) const {
  const string_view rest = cursor_.rest();
  const auto lines = static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '\n')) + 1;
  return std::min(lines, rest.size() / (2 * cells) + 1);  // a digit and what ends it
}

Result<void> RowReader::read_named_row(Place place) {
  const std::size_t needed = std::max(layout_.x, layout_.y) + 1;
  if (fields_.count < needed) {
    // Prose is told from a short row by its first field.
    if (fields_.count > 0 && layout_.x == 0) {
      OBVID_TRY(number_at(place.line, 0));
    }
    return fail(error(ErrorCode::kTooFewColumns,
                      "the line has " + std::to_string(fields_.count) + " columns, x and y need " +
                          std::to_string(needed),
                      place));
  }
  const Result<double> x = number_at(place.line, layout_.x);
  OBVID_TRY(x);
  const Result<double> y = number_at(place.line, layout_.y);
  OBVID_TRY(y);
  std::optional<double> height;
  if (layout_.z) {
    const auto z = optional_cell(place.line, layout_.z, false);
    OBVID_TRY(z);
    if (*z && options_.heights) {
      height = layout_.z_scale * **z;
      raw_.height_digits.add(text::digits_of(fields_.cell[*layout_.z]));
    } else if (*z) {
      watch_third(**z);
    }
  }
  if (layout_.has_fixed_data() || height || !raw_.fixed.empty()) {
    Result<FixedData> fixed = layout_.has_fixed_data() ? read_fixed(place.line) : FixedData{};
    OBVID_TRY(fixed);
    fixed->height = height;
    raw_.fixed.resize(raw_.points.size());
    if (raw_.fixed.empty()) raw_.fixed.reserve(most_rows_left(needed));
    raw_.fixed.push_back(*fixed);
  }
  push({*x, *y}, text::digits_of(fields_.cell[layout_.x]),
       text::digits_of(fields_.cell[layout_.y]));
  return {};
}

Result<RawPoints> read_rows(std::string_view text, std::string_view name,
                            const PointListOptions& options) {
  return RowReader(text, name, options).read();
}

}  // namespace obvid
