// SPDX-License-Identifier: Apache-2.0
// What stands before the first row: title, column names, counts.
#include <algorithm>
#include <array>
#include <cmath>

#include "read_points_reader.h"

namespace obvid {

using std::string_view;
using text::NumberKind;
using text::ParsedNumber;
using text::Separator;
using text::shown;

namespace {

// Largest count that a line before the points may state.
constexpr double kMaxStatedCount = 1e9;

bool is_count(const ParsedNumber& number) {
  return number.kind == NumberKind::kNumber && number.value >= 0.0 &&
         number.value <= kMaxStatedCount && number.value == std::floor(number.value);
}

}  // namespace

void RowReader::skip_lines() {
  for (std::size_t i = 0; i < options_.skip && !cursor_.at_end(); ++i) cursor_.skip(cursor_.peek());
}

// What the user says goes before the names; those of other columns keep their meaning.
void RowReader::take_chosen_columns() {
  if (!options_.columns) return;
  const auto [x, y] = *options_.columns;
  if (!raw_.named) {
    const std::vector<ColumnName> names = column_names(raw_.title);
    for (const ColumnName& name : names) layout_.units.push_back(name.unit);
    if (names.size() > 1 && names.size() == raw_.columns) raw_.title.clear();
    layout_.units.resize(names.size() == raw_.columns ? names.size() : 0);
  }
  layout_.choose(x, y);
  raw_.named = true;
}

Result<void> RowReader::read_preamble() {
  while (!cursor_.at_end()) {
    const string_view line = cursor_.peek();
    if (text::is_comment(line)) {
      watch_comment(line);
    } else if (!text::trim(line).empty()) {
      const Result<bool> more = read_preamble_line(line);
      OBVID_TRY(more);
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
  OBVID_TRY(taken);
  return true;
}

// "# x_m,y_m": a comment may name the columns. Only what names as many of them as the rows have is
// believed; "# x and y of the outline" is prose.
void RowReader::watch_comment(string_view line) {
  string_view body = text::trim(line);
  body.remove_prefix(std::min(body.find_first_not_of("#;!/ \t"), body.size()));
  if (auto columns = read_header(body)) commented_ = std::move(columns);
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
  const bool row = leading >= 2 && (finite || leading == fields_.count);
  const bool named_all =
      commented_ && (commented_->count == leading ||
                     (commented_->of_survey && commented_->count == fields_.count));
  if (row && named_all) {
    layout_ = *commented_;
    raw_.named = true;
  }
  return row;
}

// "Road from east to north" is a title: words of surveys name columns only where the rows have as
// many.
bool RowReader::rows_have(const Columns& columns, string_view header) const {
  if (!columns.of_survey) return true;
  text::LineCursor ahead(cursor_.rest());
  ahead.skip(header);
  text::Fields fields;
  while (!ahead.at_end()) {
    const string_view line = ahead.peek();
    ahead.skip(line);
    if (text::is_comment(line) || text::trim(line).empty()) continue;
    const string_view body = text::without_comment(line);
    const Separator separator = text::detect_separator(body);
    text::split(body, separator, fields);
    const std::size_t needed = std::max(columns.x, columns.y) + 1;
    return fields.count >= (separator == Separator::kWhite ? columns.count : needed);
  }
  return false;
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
    const string_view cell = fields_.cell[1];
    return fail(error(ErrorCode::kBadNumber,
                      cell.empty() ? "a number is missing" : shown(cell) + " is not a number",
                      {line, cell.data()}));
  }
  // "1,2,3;4,5,6": several points in one line.
  if (separator_ == Separator::kSemicolon && starts_like_number(fields_.cell[0])) {
    return fail(error(ErrorCode::kBadNumber, shown(fields_.cell[0]) + " is not a number",
                      {line, fields_.cell[0].data()}));
  }
  if (const auto columns = read_header(line); columns && rows_have(*columns, line)) {
    layout_ = *columns;
    raw_.named = true;
    return {};
  }
  if (title_seen_ && !is_vsp_) {
    Error second = error(ErrorCode::kBadNumber, "the line is no row of numbers",
                         {line, text::trim(line).data()});
    second.hint =
        "one title and one line of column names may stand before the points; begin "
        "other lines of text with #, or leave lines out with --skip";
    return fail(std::move(second));
  }
  title_seen_ = true;
  raw_.title = text::to_utf8(text::trim(line));
  return {};
}

// "length,curvature": names, but not x and y. No title of a drawing, and worth a warning.
void RowReader::take_unknown_names() {
  degrees_named_ = layout_.degrees;
  for (const ColumnName& column : column_names(raw_.title)) {
    constexpr std::array<string_view, 5> kDegrees{"lon", "lat", "lng", "longitude", "latitude"};
    degrees_named_ = degrees_named_ ||
                     std::find(kDegrees.begin(), kDegrees.end(), column.name) != kDegrees.end();
  }
  if (raw_.named || separator_ == Separator::kWhite || raw_.title.empty()) return;
  text::Fields names;
  text::split(raw_.title, separator_, names);
  if (names.count < 2 || names.count != std::min(raw_.columns, text::kMaxColumns)) return;
  raw_.warnings.push_back("The columns " + shown(names.cell[0]) + " and " + shown(names.cell[1]) +
                          " are taken as x and y.");
  raw_.title.clear();
}

}  // namespace obvid
