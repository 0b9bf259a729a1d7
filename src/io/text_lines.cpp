// SPDX-License-Identifier: Apache-2.0
#include "text_lines.h"

#include <algorithm>

#include "text_number.h"

namespace obvid::text {

std::string_view LineCursor::peek() const {
  const std::string_view left = text_.substr(position_);
  const std::size_t end = left.find_first_of("\r\n");
  return left.substr(0, end);
}

void LineCursor::skip(std::string_view line) { skip_line_of(line.size()); }

void LineCursor::skip_line_of(std::size_t bytes) {
  position_ += bytes;
  const bool cr = position_ < text_.size() && text_[position_] == '\r';
  if (cr) ++position_;
  if (position_ < text_.size() && text_[position_] == '\n') ++position_;
  ++number_;
}

std::string_view trim(std::string_view line) {
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return line;
}

bool is_comment(std::string_view line) {
  line = trim(line);
  if (line.empty()) return false;
  const char c = line.front();
  return c == '#' || c == ';' || c == '!' || line.substr(0, 2) == "//";
}

std::string_view without_comment(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '#' || c == '!' || (c == '/' && line.substr(i, 2) == "//")) return line.substr(0, i);
  }
  return line;
}

namespace {

// Whether each of at least two fields between blanks is a number, a comma in it being decimal.
bool reads_with_decimal_commas(std::string_view line) {
  Fields fields;
  split(line, Separator::kWhite, fields);
  if (fields.count < 2) return false;
  for (std::size_t i = 0; i < fields.count; ++i) {
    const std::string_view cell = fields.cell[i];
    // A comma at either end of a field separates, it is not decimal.
    if (cell.front() == ',' || cell.back() == ',') return false;
    if (parse_number(cell, true).kind != NumberKind::kNumber) return false;
  }
  return true;
}

void split_white(std::string_view line, Fields& fields) {
  std::size_t i = 0;
  while (fields.count < kMaxColumns) {
    while (i < line.size() && is_blank(line[i])) ++i;
    if (i == line.size()) return;
    const std::size_t start = i;
    while (i < line.size() && !is_blank(line[i])) ++i;
    fields.cell[fields.count++] = line.substr(start, i - start);
  }
}

void split_at(std::string_view line, char separator, Fields& fields) {
  while (fields.count < kMaxColumns) {
    const std::size_t end = line.find(separator);
    fields.cell[fields.count++] = trim(line.substr(0, end));
    if (end == std::string_view::npos) break;
    line.remove_prefix(end + 1);
  }
  // A separator at the end of the line opens no further column.
  while (fields.count > 0 && fields.cell[fields.count - 1].empty()) --fields.count;
}

}  // namespace

Separator detect_separator(std::string_view line) {
  line = trim(line);
  if (line.find(';') != std::string_view::npos) return Separator::kSemicolon;
  if (line.find(',') == std::string_view::npos) return Separator::kWhite;
  return reads_with_decimal_commas(line) ? Separator::kWhite : Separator::kComma;
}

void split(std::string_view line, Separator separator, Fields& fields) {
  fields.count = 0;
  switch (separator) {
    case Separator::kWhite:
      return split_white(line, fields);
    case Separator::kTab:
      return split_at(line, '\t', fields);
    case Separator::kComma:
      return split_at(line, ',', fields);
    case Separator::kSemicolon:
      return split_at(line, ';', fields);
  }
}

std::size_t column_of(std::string_view line, const char* place) {
  std::size_t column = 1;
  for (const char* p = line.data(); p < place; ++p) {
    const bool continuation = (static_cast<unsigned char>(*p) & 0xC0U) == 0x80U;
    if (!continuation) ++column;
  }
  return column;
}

std::string position(std::string_view name, std::size_t line, std::size_t column) {
  return std::string(name) + ":" + std::to_string(line) + ":" + std::to_string(column);
}

namespace {

// Length of the well-formed UTF-8 sequence at the front, 0 when there is none (RFC 3629).
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const auto tail = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  const unsigned a = byte(0);
  if (a < 0x80U) return 1;
  if (a >= 0xC2U && a <= 0xDFU) return tail(1) ? 2 : 0;
  if (a >= 0xE0U && a <= 0xEFU) {
    const bool overlong = a == 0xE0U && byte(1) < 0xA0U;
    const bool surrogate = a == 0xEDU && byte(1) > 0x9FU;
    return tail(1) && tail(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (a >= 0xF0U && a <= 0xF4U) {
    const bool overlong = a == 0xF0U && byte(1) < 0x90U;
    const bool beyond = a == 0xF4U && byte(1) > 0x8FU;
    return tail(1) && tail(2) && tail(3) && !overlong && !beyond ? 4 : 0;
  }
  return 0;
}

}  // namespace

std::string to_utf8(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const auto byte = static_cast<unsigned char>(text.front());
    if (length == 0) {
      out += static_cast<char>(0xC0U | (byte >> 6U));
      out += static_cast<char>(0x80U | (byte & 0x3FU));
    } else if (byte >= 0x20U && byte != 0x7FU) {
      out += text.substr(0, length);
    } else if (byte == '\t') {
      out += ' ';
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

std::string shown(std::string_view cell) {
  // Longest piece that an error shows, in bytes.
  constexpr std::size_t kShownLength = 24;
  const bool cut = cell.size() > kShownLength;
  return '"' + to_utf8(cell.substr(0, kShownLength)) + (cut ? "...\"" : "\"");
}

}  // namespace obvid::text
