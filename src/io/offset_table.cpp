// SPDX-License-Identifier: Apache-2.0
#include "offset_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <utility>

#include "number_rows.h"
#include "text_digits.h"
#include "text_kind.h"
#include "text_lines.h"
#include "text_number.h"

namespace obvid {
namespace {

using std::string_view;

constexpr std::size_t kLeastCells = 3;  // of a contour

enum class OffsetAxis { kUnknown, kStation, kWaterline };

std::string lower_word(string_view text) {
  std::string out;
  for (const char c : text) {
    const bool mark = c == '"' || c == '.' || c == '_' || c == ' ' || c == '-' || c == '#';
    if (!mark) out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return out;
}

/// Which axis a word names.
OffsetAxis axis_of(string_view word) {
  const std::string name = lower_word(word);
  for (const string_view known : {"wl", "wls", "waterline", "waterlines"}) {
    if (name == known) return OffsetAxis::kWaterline;
  }
  for (const string_view known : {"st", "sta", "stn", "station", "stations"}) {
    if (name == known) return OffsetAxis::kStation;
  }
  return OffsetAxis::kUnknown;
}

/// What stands over a column or before a row.
struct OffsetLabel {
  enum class Kind { kNumber, kForward, kAft, kOther };
  Kind kind = Kind::kOther;
  double value = 0.0;
  OffsetAxis axis = OffsetAxis::kUnknown;
  std::string text;
  string_view digits{};  ///< the number as it is printed
};

OffsetLabel label_of(string_view cell) {
  OffsetLabel label;
  label.text = text::to_utf8(cell);
  const auto number = [&](string_view digits) {
    const text::ParsedNumber parsed = text::parse_number(digits, true);
    if (parsed.kind != text::NumberKind::kNumber) return false;
    label.kind = OffsetLabel::Kind::kNumber;
    label.value = parsed.value;
    label.digits = digits;
    return true;
  };
  if (number(cell)) return label;
  const std::string word = lower_word(cell);
  if (word == "fp" || word == "ap") {
    label.kind = word == "fp" ? OffsetLabel::Kind::kForward : OffsetLabel::Kind::kAft;
    label.axis = OffsetAxis::kStation;
    return label;
  }
  const std::size_t letters =
      cell.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
  if (letters == 0 || letters == string_view::npos) return label;
  const OffsetAxis axis = axis_of(cell.substr(0, letters));
  const std::size_t digits = cell.find_first_not_of("_ .#:", letters);
  if (axis == OffsetAxis::kUnknown || digits == string_view::npos) return label;
  // "WL.5" is 0.5
  const bool point = digits > letters && cell[digits - 1] == '.';
  if (number(cell.substr(point ? digits - 1 : digits))) label.axis = axis;
  return label;
}

bool is_empty_cell(string_view cell) {
  return cell.empty() || cell == "-" || cell == "--" || cell == "\"\"";
}

/// Lines with something on them that are no comments.
class OffsetLines {
 public:
  explicit OffsetLines(string_view all) : cursor_(all) {
    constexpr string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (all.starts_with(kByteOrderMark)) cursor_ = text::LineCursor(all.substr(3));
  }
  bool next() {
    while (!cursor_.at_end()) {
      whole_ = cursor_.peek();
      number_ = cursor_.line_number();
      cursor_.skip(whole_);
      if (!text::trim(whole_).empty() && !text::is_comment(whole_)) return true;
    }
    return false;
  }
  [[nodiscard]] string_view line() const { return whole_; }
  [[nodiscard]] std::size_t number() const { return number_; }

 private:
  text::LineCursor cursor_;
  string_view whole_;
  std::size_t number_ = 0;
};

/// The first line, when it is that of a table of half-breadths.
struct OffsetHead {
  text::Separator separator = text::Separator::kComma;
  std::string corner;
  std::vector<OffsetLabel> columns;
};

std::optional<OffsetHead> head_of(string_view line) {
  OffsetHead head;
  head.separator = text::detect_separator(line);
  if (line.find('\t') != string_view::npos) head.separator = text::Separator::kTab;
  std::vector<string_view> cells;
  split_all(line, head.separator, cells);
  if (cells.size() < 3) return std::nullopt;
  const bool number = text::parse_number(cells[0], true).kind == text::NumberKind::kNumber;
  if (number) return std::nullopt;
  head.corner = text::to_utf8(cells[0]);
  std::size_t plain = 0, named = 0;
  for (std::size_t k = 1; k < cells.size(); ++k) {
    head.columns.push_back(label_of(cells[k]));
    const OffsetLabel& label = head.columns.back();
    if (label.kind == OffsetLabel::Kind::kOther) continue;
    ++(label.axis == OffsetAxis::kUnknown ? plain : named);
  }
  constexpr std::size_t kLeast = 2;
  const bool numbers = plain + named == head.columns.size() && plain + named >= kLeast;
  return numbers || named >= kLeast ? std::optional(std::move(head)) : std::nullopt;
}

struct OffsetRow {
  OffsetLabel label;
  std::vector<std::optional<double>> cells;
};

/// Which axis the rows are: by labels like FP and WL, then by the corner ("wl\\st": rows are
/// waterlines).
struct OffsetSides {
  bool rows_are_stations = false;
  std::string why;
};

OffsetSides sides_of(const OffsetHead& head, const std::vector<OffsetRow>& rows) {
  for (const OffsetLabel& label : head.columns) {
    if (label.axis == OffsetAxis::kUnknown) continue;
    return {label.axis == OffsetAxis::kWaterline, fmt::format("by the label '{}'", label.text)};
  }
  for (const OffsetRow& row : rows) {
    if (row.label.axis == OffsetAxis::kUnknown) continue;
    return {row.label.axis == OffsetAxis::kStation,
            fmt::format("by the label '{}'", row.label.text)};
  }
  const std::size_t bar = head.corner.find_first_of("\\/|");
  const OffsetAxis first = axis_of(string_view(head.corner).substr(0, bar));
  const OffsetAxis second =
      bar == std::string::npos ? OffsetAxis::kUnknown : axis_of(head.corner.substr(bar + 1));
  const bool stations = first == OffsetAxis::kStation || second == OffsetAxis::kWaterline;
  if (first == OffsetAxis::kUnknown && second == OffsetAxis::kUnknown) {
    return {false, "assumed, as no label says so"};
  }
  return {stations, fmt::format("by the corner '{}'", head.corner)};
}

/// Number of all empty cells, names of what is left out.
struct OffsetTally {
  std::size_t empty = 0;
  std::vector<std::string> rows, columns;
};

/// Places of stations: FP is 0, AP as far behind the last number as FP before the first; counted
/// from the other end where AP comes first.
Result<void> place_ends(std::vector<OffsetLabel>& stations, string_view name,
                        std::vector<std::string>& assumed) {
  std::vector<OffsetLabel*> used;
  for (OffsetLabel& one : stations) {
    if (one.kind != OffsetLabel::Kind::kOther) used.push_back(&one);
  }
  const auto is_end = [](const OffsetLabel* one) {
    return one->kind != OffsetLabel::Kind::kNumber;
  };
  const auto ends = static_cast<std::size_t>(std::count_if(used.begin(), used.end(), is_end));
  if (ends == 0) return {};
  const bool outside = ends <= 2 &&
                       (ends < 2 || (is_end(used.front()) && is_end(used.back()) &&
                                     used.front()->kind != used.back()->kind)) &&
                       (is_end(used.front()) || is_end(used.back()));
  if (!outside || used.size() < ends + 1) {
    return error(ErrorCode::kOutOfOrder, "FP and AP are not the first and the last station")
        .where(std::string(name))
        .hint("write their distances in place of their names");
  }
  const auto numbers = [&](bool front) {
    return front ? used[is_end(used.front()) ? 1 : 0]
                 : used[used.size() - (is_end(used.back()) ? 2 : 1)];
  };
  const double first = numbers(true)->value, last = numbers(false)->value;
  // the end that stands beside the smaller number is the origin
  const bool front_is_origin = std::abs(first) <= std::abs(last);
  const double margin = front_is_origin ? first : last;
  for (OffsetLabel* one : {used.front(), used.back()}) {
    if (!is_end(one)) continue;
    const bool origin = (one == used.front()) == front_is_origin;
    one->value = origin ? 0.0 : (front_is_origin ? last : first) + margin;
    assumed.push_back(fmt::format("{} is taken as station {:g}", one->text, one->value));
  }
  return {};
}

/// Ascending or descending, without repetitions; false with the place that breaks it.
Result<bool> ascends(const std::vector<double>& at, const char* what, string_view name) {
  const bool up = at.size() < 2 || at[1] > at[0];
  for (std::size_t k = 1; k < at.size(); ++k) {
    if (up ? at[k] > at[k - 1] : at[k] < at[k - 1]) continue;
    return error(ErrorCode::kOutOfOrder,
                 fmt::format("{} {:g} does not lie beyond {} {:g}", what, at[k], what, at[k - 1]))
        .where(std::string(name))
        .hint("order the table, and give each one once")
        .value(at[k]);
  }
  return up;
}

std::string names_of(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& one : names) out += (out.empty() ? "" : ", ") + one;
  return out;
}

class OffsetTable {
 public:
  OffsetTable(string_view text, string_view name) : lines_(text), name_(name) {}

  Result<OffsetSections> read() {
    std::optional<OffsetHead> head;
    if (lines_.next()) head = head_of(text::trim(lines_.line()));
    if (!head) return fail(error_at(ErrorCode::kUnsupported, "no table of offsets", name_, 1));
    head_ = std::move(*head);
    while (lines_.next()) OBVID_TRY(take_row());
    return sections();
  }

 private:
  Result<void> take_row() {
    // blanks at the ends are empty cells where tabs part them
    const string_view line =
        head_.separator == text::Separator::kTab ? lines_.line() : text::trim(lines_.line());
    split_all(line, head_.separator, cells_);
    OffsetRow row;
    row.label = label_of(cells_.front());
    const std::size_t wanted = head_.columns.size() + 1;
    while (cells_.size() > wanted && cells_.back().empty()) cells_.pop_back();
    if (cells_.size() > wanted ||
        (cells_.size() < wanted && head_.separator == text::Separator::kWhite)) {
      return fail(
          error_at(ErrorCode::kBadCount,
                   fmt::format("{} cells where the first line has {}", cells_.size(), wanted),
                   name_, lines_.number(), "part cells by commas, or mark empty ones by a dash"));
    }
    cells_.resize(wanted);  // what is missing at the end is empty
    if (row.label.kind == OffsetLabel::Kind::kOther) {
      tally_.rows.push_back(row.label.text);
      return {};
    }
    for (std::size_t k = 1; k < wanted; ++k) {
      row.cells.emplace_back();
      if (head_.columns[k - 1].kind == OffsetLabel::Kind::kOther) continue;
      if (is_empty_cell(cells_[k])) {
        ++tally_.empty;
        continue;
      }
      const text::ParsedNumber number = text::parse_number(cells_[k], true);
      if (number.kind != text::NumberKind::kNumber) {
        const bool word = number.kind == text::NumberKind::kNotNumber;
        Error bad = error_at(word ? ErrorCode::kBadNumber : ErrorCode::kNotFinite,
                             text::shown(cells_[k]) + (word ? " is no number" : " is not finite"),
                             name_, lines_.number(), "correct the cell, or leave it empty");
        bad.where = text::position(name_, lines_.number(),
                                   text::column_of(lines_.line(), cells_[k].data()));
        return fail(bad);
      }
      breadths_.add(text::digits_of(cells_[k]));
      row.cells.back() = number.value;
    }
    rows_.push_back(std::move(row));
    return {};
  }

  Result<OffsetSections> sections() {
    OffsetSections out;
    const OffsetSides sides = sides_of(head_, rows_);
    std::vector<OffsetLabel> of_rows;
    for (const OffsetRow& row : rows_) of_rows.push_back(row.label);
    std::vector<OffsetLabel>& stations = sides.rows_are_stations ? of_rows : head_.columns;
    std::vector<OffsetLabel>& waterlines = sides.rows_are_stations ? head_.columns : of_rows;
    out.assumed.push_back(fmt::format(
        "a table of half-breadths: rows are {}, columns {} ({}); x is the station, y the "
        "half-breadth, z the waterline",
        sides.rows_are_stations ? "stations" : "waterlines",
        sides.rows_are_stations ? "waterlines" : "stations", sides.why));
    OBVID_TRY(place_ends(stations, name_, out.assumed));
    std::vector<std::size_t> at_station, at_waterline;
    std::vector<double> x, z;
    text::ColumnDigits heights;
    for (std::size_t k = 0; k < stations.size(); ++k) {
      if (stations[k].kind == OffsetLabel::Kind::kOther) continue;
      at_station.push_back(k);
      x.push_back(stations[k].value);
    }
    for (std::size_t k = 0; k < waterlines.size(); ++k) {
      if (waterlines[k].kind != OffsetLabel::Kind::kNumber) continue;
      at_waterline.push_back(k);
      z.push_back(waterlines[k].value);
      heights.add(text::digits_of(waterlines[k].digits));
    }
    for (const OffsetLabel& label : head_.columns) {
      if (label.kind == OffsetLabel::Kind::kOther) tally_.columns.push_back(label.text);
    }
    OBVID_TRY(ascends(x, "station", name_));
    const auto upwards = ascends(z, "waterline", name_);
    OBVID_TRY(upwards);
    if (!*upwards) {
      std::reverse(at_waterline.begin(), at_waterline.end());
      std::reverse(z.begin(), z.end());
    }
    const std::vector<double> half = text::half_units(std::array{breadths_, heights});
    std::vector<std::string> short_ones;
    for (std::size_t s = 0; s < x.size(); ++s) {
      SpaceSeries section;
      section.name = fmt::format("station {}", stations[at_station[s]].text);
      section.rounding = {0.0, half[0], half[1]};
      for (std::size_t w = 0; w < z.size(); ++w) {
        const std::size_t row = sides.rows_are_stations ? at_station[s] : at_waterline[w];
        const std::size_t column = sides.rows_are_stations ? at_waterline[w] : at_station[s];
        if (const auto& cell = rows_[row].cells[column]) {
          section.points.push_back({x[s], *cell, z[w]});
        }
      }
      if (section.points.size() >= kLeastCells) {
        out.sections.push_back(std::move(section));
      } else {
        short_ones.push_back(stations[at_station[s]].text);
      }
    }
    tell_tally(short_ones, out.assumed);
    if (out.sections.size() >= 2) return out;
    return error(ErrorCode::kTooFewPoints,
                 fmt::format("{} stations have three cells or more", out.sections.size()))
        .where(std::string(name_))
        .hint("a hull needs two stations at least");
  }

  void tell_tally(const std::vector<std::string>& short_ones,
                  std::vector<std::string>& assumed) const {
    if (tally_.empty > 0) {
      assumed.push_back(fmt::format(
          "{} cells are empty: each station goes through those that are there", tally_.empty));
    }
    const auto left_out = [&](const char* what, const std::vector<std::string>& names) {
      if (!names.empty()) assumed.push_back(fmt::format("left out: {} {}", what, names_of(names)));
    };
    left_out("rows that are no station and no waterline:", tally_.rows);
    left_out("columns that are no station and no waterline:", tally_.columns);
    left_out("stations with fewer than three cells, which make no contour:", short_ones);
  }

  OffsetLines lines_;
  string_view name_;
  OffsetHead head_;
  std::vector<string_view> cells_;
  std::vector<OffsetRow> rows_;
  OffsetTally tally_;
  text::ColumnDigits breadths_;
};

}  // namespace

bool is_offset_text(string_view text) {
  OffsetLines lines(text);
  if (!lines.next()) return false;
  const auto head = head_of(text::trim(lines.line()));
  if (!head || !lines.next()) return false;
  const bool named = std::any_of(head->columns.begin(), head->columns.end(), [](const auto& label) {
    return label.axis != OffsetAxis::kUnknown;
  });
  const std::size_t bar = head->corner.find_first_of("\\/|");
  if (named || axis_of(string_view(head->corner).substr(0, bar)) != OffsetAxis::kUnknown)
    return true;
  // a title with two numbers is none: as many cells follow
  std::vector<string_view> cells;
  split_all(text::trim(lines.line()), head->separator, cells);
  return cells.size() == head->columns.size() + 1;
}

Result<OffsetSections> parse_offset_table(string_view text, string_view name) {
  OBVID_TRY(text::check_text_kind(text, name));
  return OffsetTable(text, name).read();
}

}  // namespace obvid
