// SPDX-License-Identifier: Apache-2.0
#include "number_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "text_kind.h"
#include "text_lines.h"
#include "text_number.h"

namespace obvid {
namespace {

using std::string_view;

class NumberRowReader {
 public:
  NumberRowReader(string_view text, string_view name) : cursor_(text), name_(name) {}

  Result<NumberRows> read() {
    constexpr string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (cursor_.rest().starts_with(kByteOrderMark))
      cursor_ = text::LineCursor(cursor_.rest().substr(3));
    while (!cursor_.at_end()) {
      const string_view whole = cursor_.peek();
      OBVID_TRY(line(whole));
      cursor_.skip(whole);
    }
    if (out_.rows.empty()) {
      return error(ErrorCode::kNothingThere, "the file holds no numbers").where(std::string(name_));
    }
    return std::move(out_);
  }

 private:
  Result<void> line(string_view whole) {
    const string_view bare = text::trim(whole);
    if (bare.empty()) {
      gap_ = true;
      return {};
    }
    if (text::is_comment(bare)) return {};
    const string_view data = text::trim(text::without_comment(bare));
    split_all(data, text::detect_separator(data), fields_);
    // a mark at the end, unless the header has a column there
    const bool marked = fields_.size() > 1 && fields_.back().empty();
    if (marked && fields_.size() != out_.header.size()) fields_.pop_back();
    NumberRow row{cursor_.line_number(), gap_, {}};
    std::size_t words = 0, empty = 0;
    string_view word, gap;
    for (const string_view field : fields_) {
      if (field.empty() && empty++ == 0) gap = field;
      const text::ParsedNumber number = text::parse_number(field, true);
      if (number.kind == text::NumberKind::kNotFinite) {
        return fail(error_at(ErrorCode::kNotFinite, text::shown(field) + " is not a finite number",
                             name_, row.line, "remove the point"));
      }
      if (number.kind == text::NumberKind::kNotNumber) {
        if (words++ == 0) word = field;
        continue;
      }
      row.values.push_back(number.value);
    }
    if (words == 0) {
      add_digits();
      out_.rows.push_back(std::move(row));
      gap_ = false;
      return {};
    }
    if (is_broken(row.values.size(), words, empty))
      return fail(broken(bare, word.empty() ? gap : word, row.line));
    if (out_.rows.empty()) {
      out_.header.clear();
      for (const string_view field : fields_) out_.header.emplace_back(field);
      out_.columns = column_names(data);
    }
    out_.titles.push_back({out_.rows.size(), text::to_utf8(data)});
    gap_ = true;
    return {};
  }

  void add_digits() {
    if (out_.digits.size() < fields_.size()) out_.digits.resize(fields_.size());
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      out_.digits[i].add(text::digits_of(fields_[i]));
    }
  }

  /// Whether a line of numbers and words is a row with a fault and not a header or a title: none
  /// may be dropped as if it were a remark.
  [[nodiscard]] bool is_broken(std::size_t numbers, std::size_t words, std::size_t empty) const {
    if (numbers == 0) return false;
    const bool corner = fields_.front().empty() && empty == 1;  // of a table whose head it is
    if (empty > 0 && !(out_.rows.empty() && corner)) return true;
    const auto first = text::parse_number(fields_.front(), true).kind;
    if (first == text::NumberKind::kNumber) return !out_.rows.empty() || numbers > words;
    return !out_.rows.empty() && numbers > words;
  }

  [[nodiscard]] Error broken(string_view line, string_view word, std::size_t number) const {
    Error error = error_at(
        ErrorCode::kBadNumber,
        word.empty() ? "an empty cell where a number belongs" : text::shown(word) + " is no number",
        name_, number,
        word.empty()
            ? "fill the cell in, or leave out its row or column; `surface skin` takes tables of "
              "half-breadths with the cells that are there"
            : "correct the field, or begin the line with # when it is a remark");
    if (word.data() != nullptr) {
      error.where = text::position(name_, number, text::column_of(line, word.data()));
    }
    return error;
  }

  text::LineCursor cursor_;
  string_view name_;
  NumberRows out_;
  std::vector<string_view> fields_;
  bool gap_ = false;
};

}  // namespace

void split_all(string_view line, text::Separator separator, std::vector<string_view>& fields) {
  fields.clear();
  if (separator == text::Separator::kWhite) {
    for (std::size_t at = 0; at < line.size();) {
      while (at < line.size() && text::is_blank(line[at])) ++at;
      const std::size_t start = at;
      while (at < line.size() && !text::is_blank(line[at])) ++at;
      if (at > start) fields.push_back(line.substr(start, at - start));
    }
    return;
  }
  const char mark = separator == text::Separator::kTab     ? '\t'
                    : separator == text::Separator::kComma ? ','
                                                           : ';';
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(mark, start), line.size());
    fields.push_back(text::trim(line.substr(start, end - start)));
    start = end + 1;
  }
}

Result<NumberRows> number_rows(string_view text, string_view name) {
  OBVID_TRY(text::check_text_kind(text, name));
  return NumberRowReader(text, name).read();
}

int column_named(const NumberRows& rows, string_view name) {
  std::vector<ColumnName> names = rows.columns;
  name_places(names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

Result<Units> units_of_columns(const NumberRows& rows, string_view name) {
  std::vector<Units> all;
  for (const string_view axis : {"x", "y", "z"}) {
    const int at = column_named(rows, axis);
    if (at < 0) continue;
    const std::string& unit = rows.columns[static_cast<std::size_t>(at)].unit;
    if (!unit.empty()) all.emplace_back(unit);
  }
  return common_units(all, name);
}

std::vector<double> NumberRows::rounding(std::span<const int> wanted) const {
  std::vector<text::ColumnDigits> used;
  for (const int column : wanted) {
    const bool there = column >= 0 && static_cast<std::size_t>(column) < digits.size();
    if (there) used.push_back(digits[static_cast<std::size_t>(column)]);
  }
  const std::vector<double> known = text::half_units(used);
  std::vector<double> out;
  std::size_t next = 0;
  for (const int column : wanted) {
    const bool there = column >= 0 && static_cast<std::size_t>(column) < digits.size();
    out.push_back(there ? known[next++] : 0.0);
  }
  return out;
}

bool is_matrix(const NumberRows& rows) {
  constexpr std::size_t kLeastColumns = 5;
  return std::all_of(rows.rows.begin(), rows.rows.end(), [&](const NumberRow& row) {
    return row.values.size() >= kLeastColumns &&
           row.values.size() == rows.rows.front().values.size();
  });
}

Error error_at(ErrorCode code, std::string what, string_view name, std::size_t line,
               std::string hint) {
  return {code, std::move(what), fmt::format("{}:{}", name, line), std::move(hint), -1, 0.0};
}

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace obvid
