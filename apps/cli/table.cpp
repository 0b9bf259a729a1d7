// SPDX-License-Identifier: Apache-2.0
#include "table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

namespace obvid {
namespace {

constexpr std::size_t kShortList = 40;
constexpr std::size_t kEach = 6;  // rows shown of the start, of the end, and of the greatest
constexpr const char* kBetween = "  ";

/// Letters of a cell before the place where columns of numbers are aligned.
std::size_t before_point(const std::string& cell) {
  return std::min(cell.find_first_of(".e"), cell.size());
}

bool is_number(const std::string& cell) {
  return cell.find_first_of("0123456789") != std::string::npos;
}

void end_line(std::string& out) {
  while (!out.empty() && out.back() == ' ') out.pop_back();
  out += '\n';
}

}  // namespace

void Table::column(std::string head, Align align) {
  Column column;
  column.align = align;
  for (std::size_t from = 0; from <= head.size();) {
    const std::size_t to = std::min(head.find('\n', from), head.size());
    column.head.push_back(head.substr(from, to - from));
    from = to + 1;
  }
  columns_.push_back(std::move(column));
}

void Table::column_if_told(std::string head, Align align) {
  column(std::move(head), align);
  columns_.back().if_told = true;
}

bool Table::is_told(std::size_t c) const {
  return !columns_[c].if_told || std::any_of(rows_.begin(), rows_.end(), [c](const auto& row) {
    return !row.empty() && !row[c].empty() && row[c] != "-";
  });
}

void Table::row(std::vector<std::string> cells) {
  cells.resize(columns_.size());
  rows_.push_back(std::move(cells));
}

void Table::gap() { rows_.emplace_back(); }

Table::Width Table::width_of(std::size_t c) const {
  Width width;
  for (const auto& line : columns_[c].head) width.total = std::max(width.total, line.size());
  for (const auto& row : rows_) {
    if (row.empty()) continue;
    width.total = std::max(width.total, row[c].size());
    if (columns_[c].align == Align::kLeft || !is_number(row[c])) continue;
    width.before = std::max(width.before, before_point(row[c]));
    width.after = std::max(width.after, row[c].size() - before_point(row[c]));
  }
  width.total = std::max(width.total, width.before + width.after);
  return width;
}

std::string Table::padded(const std::string& cell, const Width& width, Align align) {
  if (align == Align::kLeft) return fmt::format("{:<{}}", cell, width.total);
  if (!is_number(cell)) return fmt::format("{:>{}}", cell, width.total);
  const std::size_t after = cell.size() - before_point(cell);
  return fmt::format("{:>{}}", cell + std::string(width.after - after, ' '), width.total);
}

std::string Table::head_text(const std::vector<Width>& widths) const {
  std::size_t lines = 0;
  for (const Column& column : columns_) lines = std::max(lines, column.head.size());
  std::string out;
  for (std::size_t line = 0; line < lines; ++line) {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const auto& head = columns_[c].head;
      const std::size_t skipped = lines - head.size();
      const std::string word = line < skipped ? "" : head[line - skipped];
      if (c > 0) out += kBetween;
      out += columns_[c].align == Align::kLeft ? fmt::format("{:<{}}", word, widths[c].total)
                                               : fmt::format("{:>{}}", word, widths[c].total);
    }
    end_line(out);
  }
  return out;
}

std::string Table::text() const {
  Table told;
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (!is_told(c)) continue;
    told.columns_.push_back(columns_[c]);
    columns.push_back(c);
  }
  for (const auto& row : rows_) {
    auto& cells = told.rows_.emplace_back();
    if (row.empty()) continue;
    for (const std::size_t c : columns) cells.push_back(row[c]);
  }
  return told.all_columns();
}

std::string Table::all_columns() const {
  std::vector<Width> widths;
  for (std::size_t c = 0; c < columns_.size(); ++c) widths.push_back(width_of(c));
  std::string out = head_text(widths);
  for (const auto& row : rows_) {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (c > 0) out += kBetween;
      out += padded(row.empty() ? "..." : row[c], widths[c], columns_[c].align);
    }
    end_line(out);
  }
  return out;
}

std::vector<std::size_t> rows_worth_showing(const std::vector<double>& value) {
  std::vector<std::size_t> order(value.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (value.size() <= kShortList) return order;
  std::set<std::size_t> shown(order.begin(), order.begin() + kEach);
  shown.insert(order.end() - kEach, order.end());
  const auto greater = [&value](std::size_t a, std::size_t b) {
    const double va = std::isnan(value[a]) ? -HUGE_VAL : value[a];
    const double vb = std::isnan(value[b]) ? -HUGE_VAL : value[b];
    return va != vb ? va > vb : a < b;
  };
  std::partial_sort(order.begin(), order.begin() + kEach, order.end(), greater);
  shown.insert(order.begin(), order.begin() + kEach);
  return {shown.begin(), shown.end()};
}

std::string shown_note(std::size_t shown, std::size_t all, const char* greatest, const char* what) {
  if (shown == all) return {};
  return fmt::format("shown: the first {0}, the last {0} and the {0} {1} of {2} {3}\n", kEach,
                     greatest, all, what);
}

}  // namespace obvid
