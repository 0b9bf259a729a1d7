// SPDX-License-Identifier: Apache-2.0
#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "read_points_header.h"
#include "read_points_raw.h"
#include "text_lines.h"
#include "text_number.h"

namespace obvid {
namespace {

using std::string_view;
using text::NumberKind;
using text::ParsedNumber;
using text::Separator;
using text::shown;

// Largest count that a line before the points may state.
constexpr double kMaxStatedCount = 1e9;

// An airfoil's ends lie this close to its largest x, relative to its chord. Open trailing edges
// of the public sets lie within 0.06.
constexpr double kTrailingEdgePart = 0.1;

// Fewest points of an airfoil behind which free text may stand.
constexpr std::size_t kMinAirfoilPoints = 10;

bool starts_like_number(string_view cell) {
  return !cell.empty() && string_view("+-.0123456789").find(cell.front()) != string_view::npos;
}

bool is_count(const ParsedNumber& number) {
  return number.kind == NumberKind::kNumber && number.value >= 0.0 &&
         number.value <= kMaxStatedCount && number.value == std::floor(number.value);
}

class RowReader {
 public:
  RowReader(string_view text, string_view name) : text_(text), name_(name), cursor_(text) {}

  Result<RawPoints> read();

 private:
  struct Place {
    string_view line;
    const char* at = nullptr;
  };

  Result<void> read_preamble();
  Result<bool> read_preamble_line(string_view line);
  Result<void> take_count(string_view line, double count);
  Result<void> take_text(string_view line);
  bool is_first_row(string_view body);
  Result<void> take_vsp(string_view line, const ParsedNumber& number);

  Result<void> read_all_rows();
  bool read_plain_pair();
  Result<void> read_row(string_view line);
  Result<void> read_unnamed_row(Place place);
  Result<void> read_named_row(Place place);
  Result<FixedData> read_fixed(string_view line);
  Result<std::optional<double>> optional_cell(string_view line, std::optional<std::size_t> column,
                                              bool infinite_allowed);
  Result<double> number_at(string_view line, std::size_t column);
  Result<void> check_columns(Place place, std::size_t count);
  bool drop_grid_bounds(std::size_t count);
  void watch_third(double value);
  void take_unknown_names();
  void push(Vec2 point);

  bool is_trailer(const Error& error, string_view line) const;
  bool is_airfoil_loop() const;
  bool number_row_follows() const;
  void warn_about_trailer();

  [[nodiscard]] Error error(ErrorCode code, std::string what, Place place) const;

  string_view text_;
  string_view name_;
  text::LineCursor cursor_;
  RawPoints raw_;
  Columns layout_;
  Separator separator_ = Separator::kWhite;
  text::Fields fields_;
  std::array<double, 4> first_row_{};
  std::optional<double> third_;
  bool third_changes_ = false;
  bool title_seen_ = false;
  bool blank_before_ = false;
  bool decimal_comma_seen_ = false;
  bool decimal_point_seen_ = false;
  bool is_vsp_ = false;
};

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
  if (auto done = read_preamble(); !done) return fail(std::move(done.error()));
  if (auto done = read_all_rows(); !done) return fail(std::move(done.error()));
  raw_.white = separator_ == Separator::kWhite;
  return std::move(raw_);
}

// ---- before the first row ------------------------------------------------------------------

Result<void> RowReader::read_preamble() {
  while (!cursor_.at_end()) {
    const string_view line = cursor_.peek();
    if (!text::trim(line).empty() && !text::is_comment(line)) {
      const Result<bool> more = read_preamble_line(line);
      if (!more) return fail(more.error());
      if (!*more) return {};
    }
    cursor_.skip(line);
  }
  return {};
}

// Whether the preamble goes on behind this line.
Result<bool> RowReader::read_preamble_line(string_view line) {
  const string_view body = text::without_comment(line);
  if (is_first_row(body)) return false;
  // Counts are followed by words, in which commas do not separate.
  text::Fields words;
  text::split(body, Separator::kWhite, words);
  const ParsedNumber first =
      words.count > 0 ? text::parse_number(words.cell[0], true) : ParsedNumber{};
  Result<void> taken;
  if (is_vsp_ && is_count(first) && words.count > 1) {
    taken = take_vsp(line, first);
  } else if (is_count(first) && body.find("NumCoords") != string_view::npos) {
    raw_.reference_first = true;
    taken = take_count(line, first.value);
  } else if (words.count == 1 && first.kind == NumberKind::kNumber) {
    if (!is_count(first) || raw_.stated_count) {
      return fail(error(ErrorCode::kTooFewColumns, "a point needs two numbers, the line has one",
                        {line, words.cell[0].data()}));
    }
    taken = take_count(line, first.value);
  } else {
    taken = take_text(line);
  }
  if (!taken) return fail(std::move(taken.error()));
  return true;
}

// Whether the rows begin here; sets their separator and number of columns.
bool RowReader::is_first_row(string_view body) {
  separator_ = text::detect_separator(body);
  text::split(body, separator_, fields_);
  if (raw_.named) {
    const bool tabs = layout_.tab_separated && body.find('\t') != string_view::npos;
    if (tabs) separator_ = Separator::kTab;
    return true;
  }
  std::size_t leading = 0;
  bool finite = true;
  for (; leading < fields_.count; ++leading) {
    const auto number = text::parse_number(fields_.cell[leading], separator_ != Separator::kComma);
    if (number.kind == NumberKind::kNotNumber) break;
    finite = finite && number.kind == NumberKind::kNumber;
    if (leading < first_row_.size()) first_row_[leading] = number.value;
  }
  raw_.columns = leading;
  // "Inf wing" may be a title, "nan 1.5" is a row.
  return leading >= 2 && (finite || leading == fields_.count);
}

Result<void> RowReader::take_count(string_view line, double count) {
  if (raw_.stated_count) {
    return fail(error(ErrorCode::kBadNumber, "a second count stands before the points",
                      {line, line.data()}));
  }
  raw_.stated_count = static_cast<std::size_t>(count);
  raw_.stated_line = static_cast<std::uint32_t>(cursor_.line_number());
  return {};
}

Result<void> RowReader::take_vsp(string_view line, const ParsedNumber& number) {
  if (!raw_.vsp) raw_.vsp.emplace();
  const auto count = static_cast<std::size_t>(number.value);
  if (line.find("Sym Flag") != string_view::npos) {
    raw_.vsp->symmetric = count == 1;
  } else if (line.find("Num Pnts Upper") != string_view::npos) {
    raw_.vsp->upper = count;
    raw_.stated_line = static_cast<std::uint32_t>(cursor_.line_number());
  } else if (line.find("Num Pnts Lower") != string_view::npos) {
    raw_.vsp->lower = count;
  } else {
    return take_text(line);
  }
  return {};
}

// One title and one header may stand before the points.
Result<void> RowReader::take_text(string_view line) {
  const bool comma_like = separator_ == Separator::kComma || separator_ == Separator::kSemicolon;
  const bool first_is_number =
      fields_.count > 0 && text::parse_number(fields_.cell[0], true).kind == NumberKind::kNumber;
  const bool row_like =
      first_is_number && fields_.count > 1 && (comma_like || starts_like_number(fields_.cell[1]));
  if (row_like) {
    return fail(error(ErrorCode::kBadNumber, shown(fields_.cell[1]) + " is not a number",
                      {line, fields_.cell[1].data()}));
  }
  // "1,2,3;4,5,6": several points in one line.
  if (separator_ == Separator::kSemicolon && starts_like_number(fields_.cell[0])) {
    return fail(error(ErrorCode::kBadNumber, shown(fields_.cell[0]) + " is not a number",
                      {line, fields_.cell[0].data()}));
  }
  if (const auto columns = read_header(line)) {
    layout_ = *columns;
    raw_.named = true;
    return {};
  }
  if (title_seen_ && !is_vsp_) {
    Error second = error(ErrorCode::kBadNumber, "the line is no row of numbers",
                         {line, text::trim(line).data()});
    second.hint =
        "one title and one line of column names may stand before the points; begin "
        "other lines of text with #";
    return fail(std::move(second));
  }
  title_seen_ = true;
  raw_.title = text::to_utf8(text::trim(line));
  return {};
}

// "length,curvature": names, but not x and y. No title of a drawing, and worth a warning.
void RowReader::take_unknown_names() {
  if (raw_.named || separator_ == Separator::kWhite || raw_.title.empty()) return;
  text::Fields names;
  text::split(raw_.title, separator_, names);
  if (names.count < 2 || names.count != std::min(raw_.columns, text::kMaxColumns)) return;
  raw_.warnings.push_back("The columns " + shown(names.cell[0]) + " and " + shown(names.cell[1]) +
                          " are taken as x and y.");
  raw_.title.clear();
}

// ---- rows ----------------------------------------------------------------------------------

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

void RowReader::push(Vec2 point) {
  if (blank_before_ && !raw_.points.empty()) raw_.breaks.push_back(raw_.points.size());
  blank_before_ = false;
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
  push(point);
  cursor_.skip_line_of(length);
  return true;
}

Result<void> RowReader::read_row(string_view line) {
  text::split(text::without_comment(line), separator_, fields_);
  const Place place{line, text::trim(line).data()};
  return raw_.named ? read_named_row(place) : read_unnamed_row(place);
}

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

Result<void> RowReader::read_unnamed_row(Place place) {
  if (fields_.count == 1 && text::parse_number(fields_.cell[0], true).kind == NumberKind::kNumber) {
    return fail(
        error(ErrorCode::kTooFewColumns, "a point needs two numbers, the line has one", place));
  }
  std::array<double, 2> xy{};
  for (std::size_t i = 0; i < std::min<std::size_t>(fields_.count, 2); ++i) {
    const Result<double> number = number_at(place.line, i);
    if (!number) return fail(number.error());
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
  }
  if (auto same = check_columns(place, count); !same) return same;
  push({xy[0], xy[1]});
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

// A third column that changes may be a height or a width: say that it is not used.
void RowReader::watch_third(double value) {
  if (!third_) third_ = value;
  if (third_changes_ || value == *third_) return;
  third_changes_ = true;
  raw_.warnings.push_back(std::string(raw_.named ? "The column z" : "The third column") +
                          " is not used although it changes, first in line " +
                          std::to_string(cursor_.line_number()) + ".");
}

Result<void> RowReader::read_named_row(Place place) {
  const std::size_t needed = std::max(layout_.x, layout_.y) + 1;
  if (fields_.count < needed) {
    // Prose is told from a short row by its first field.
    if (fields_.count > 0 && layout_.x == 0) {
      if (const auto x = number_at(place.line, 0); !x) return fail(x.error());
    }
    return fail(error(ErrorCode::kTooFewColumns,
                      "the line has " + std::to_string(fields_.count) + " columns, x and y need " +
                          std::to_string(needed),
                      place));
  }
  const Result<double> x = number_at(place.line, layout_.x);
  if (!x) return fail(x.error());
  const Result<double> y = number_at(place.line, layout_.y);
  if (!y) return fail(y.error());
  if (layout_.z) {
    const auto z = optional_cell(place.line, layout_.z, false);
    if (!z) return fail(z.error());
    if (*z) watch_third(**z);
  }
  if (layout_.has_fixed_data()) {
    const Result<FixedData> fixed = read_fixed(place.line);
    if (!fixed) return fail(fixed.error());
    raw_.fixed.push_back(*fixed);
  }
  push({*x, *y});
  return {};
}

Result<std::optional<double>> RowReader::optional_cell(string_view line,
                                                       std::optional<std::size_t> column,
                                                       bool infinite_allowed) {
  const bool given = column && *column < fields_.count && !fields_.cell[*column].empty();
  if (!given) return std::optional<double>();
  if (infinite_allowed) {
    const ParsedNumber number = text::parse_number(fields_.cell[*column], true);
    if (number.kind == NumberKind::kNotFinite && std::isinf(number.value)) return number.value;
  }
  const Result<double> value = number_at(line, *column);
  if (!value) return fail(value.error());
  return std::optional<double>(*value);
}

Result<FixedData> RowReader::read_fixed(string_view line) {
  const auto heading = optional_cell(line, layout_.heading_deg, false);
  if (!heading) return fail(heading.error());
  const auto radius = optional_cell(line, layout_.radius, true);
  if (!radius) return fail(radius.error());
  const auto kappa = optional_cell(line, layout_.kappa, false);
  if (!kappa) return fail(kappa.error());
  const auto tolerance = optional_cell(line, layout_.tolerance, false);
  if (!tolerance) return fail(tolerance.error());
  const auto at = [&](std::size_t column) { return Place{line, fields_.cell[column].data()}; };
  if (*radius && *kappa) {
    return fail(
        error(ErrorCode::kBadNumber, "radius and kappa are both given", at(*layout_.kappa)));
  }
  const bool radius_fits = !*radius || std::isfinite(1.0 / **radius);
  if (!radius_fits) {
    return fail(
        error(ErrorCode::kNotFinite,
              "a radius of " + shown(fields_.cell[*layout_.radius]) + " has no finite curvature",
              at(*layout_.radius)));
  }
  if (*tolerance && **tolerance < 0.0) {
    return fail(
        error(ErrorCode::kBadNumber, "a tolerance is never negative", at(*layout_.tolerance)));
  }
  FixedData fixed;
  if (*heading) fixed.theta = **heading * (std::numbers::pi / 180.0);
  fixed.kappa = *radius ? std::optional<double>(1.0 / **radius) : *kappa;
  fixed.tolerance = *tolerance;
  return fixed;
}

// ---- text behind the points ----------------------------------------------------------------

// Airfoil files often end with remarks. They are passed over, with a warning, only where the
// points make a whole airfoil, the line does not look like a damaged row, and no row follows.
bool RowReader::is_trailer(const Error& error, string_view line) const {
  if (error.code != ErrorCode::kBadNumber || raw_.named || separator_ != Separator::kWhite) {
    return false;
  }
  const string_view body = text::trim(line);
  if (!blank_before_ && starts_like_number(body)) return false;
  text::Fields fields;
  text::split(body, Separator::kWhite, fields);
  const bool row_like = fields.count > 1 &&
                        text::parse_number(fields.cell[0], true).kind != NumberKind::kNotNumber &&
                        starts_like_number(fields.cell[1]);
  return !row_like && is_airfoil_loop() && !number_row_follows();
}

bool RowReader::is_airfoil_loop() const {
  if (raw_.points.size() < kMinAirfoilPoints) return false;
  const auto [least, most] = std::minmax_element(raw_.points.begin(), raw_.points.end(),
                                                 [](Vec2 a, Vec2 b) { return a.x < b.x; });
  const double edge = most->x - kTrailingEdgePart * (most->x - least->x);
  return raw_.points.front().x >= edge && raw_.points.back().x >= edge && least->x < edge;
}

bool RowReader::number_row_follows() const {
  text::LineCursor ahead(cursor_.rest());
  text::Fields fields;
  while (!ahead.at_end()) {
    const string_view line = ahead.peek();
    ahead.skip(line);
    text::split(line, Separator::kWhite, fields);
    const auto end = fields.cell.begin() + static_cast<std::ptrdiff_t>(fields.count);
    const bool row =
        fields.count >= 2 && std::all_of(fields.cell.begin(), end, [](string_view cell) {
          return text::parse_number(cell, true).kind != NumberKind::kNotNumber;
        });
    if (row) return true;
  }
  return false;
}

void RowReader::warn_about_trailer() {
  const std::size_t first = cursor_.line_number();
  raw_.warnings.push_back("Text behind the points is passed over, from line " +
                          std::to_string(first) + " on.");
}

}  // namespace

Result<RawPoints> read_rows(std::string_view text, std::string_view name) {
  return RowReader(text, name).read();
}

}  // namespace obvid
