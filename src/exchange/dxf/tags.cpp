// SPDX-License-Identifier: Apache-2.0
// Tags of ASCII and binary DXF: docs/methods/dxf.md, section 2.
#include "dxf/tags.h"

#include <fast_float/fast_float.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace obvid::dxf {
namespace {

constexpr std::string_view kSentinel("AutoCAD Binary DXF\r\n\x1a\0", 22);
constexpr int kLargestCode = 1071;

/// How binary files store the values of a group code.
enum class Store { kText, kReal, kByte, kInt16, kInt32, kInt64, kChunk, kUnknown };

struct StoreOfCodes {
  int first, last;
  Store store;
};

constexpr std::array kStores = {
    StoreOfCodes{0, 9, Store::kText},        StoreOfCodes{10, 59, Store::kReal},
    StoreOfCodes{60, 79, Store::kInt16},     StoreOfCodes{90, 99, Store::kInt32},
    StoreOfCodes{100, 109, Store::kText},    StoreOfCodes{110, 149, Store::kReal},
    StoreOfCodes{160, 169, Store::kInt64},   StoreOfCodes{170, 179, Store::kInt16},
    StoreOfCodes{210, 239, Store::kReal},    StoreOfCodes{270, 289, Store::kInt16},
    StoreOfCodes{290, 299, Store::kByte},    StoreOfCodes{300, 309, Store::kText},
    StoreOfCodes{310, 319, Store::kChunk},   StoreOfCodes{320, 369, Store::kText},
    StoreOfCodes{370, 389, Store::kInt16},   StoreOfCodes{390, 399, Store::kText},
    StoreOfCodes{400, 409, Store::kInt16},   StoreOfCodes{410, 419, Store::kText},
    StoreOfCodes{420, 429, Store::kInt32},   StoreOfCodes{430, 439, Store::kText},
    StoreOfCodes{440, 459, Store::kInt32},   StoreOfCodes{460, 469, Store::kReal},
    StoreOfCodes{470, 481, Store::kText},    StoreOfCodes{999, 1003, Store::kText},
    StoreOfCodes{1004, 1004, Store::kChunk}, StoreOfCodes{1005, 1009, Store::kText},
    StoreOfCodes{1010, 1059, Store::kReal},  StoreOfCodes{1060, 1070, Store::kInt16},
    StoreOfCodes{1071, 1071, Store::kInt32},
};

Store store_of(int code) {
  for (const StoreOfCodes& one : kStores) {
    if (code >= one.first && code <= one.last) return one.store;
  }
  return Store::kUnknown;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

}  // namespace

std::optional<double> number(const Tag& tag) {
  if (tag.real) return std::isfinite(*tag.real) ? tag.real : std::nullopt;
  std::string_view text = tag.text;
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, code] = fast_float::from_chars(text.data(), end, value);
  if (text.empty() || code == std::errc::invalid_argument || stop != end) return std::nullopt;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<int> integer(const Tag& tag) {
  const auto value = number(tag);
  constexpr double kMost = std::numeric_limits<int>::max();
  if (!value || std::abs(*value) > kMost || *value != std::floor(*value)) return std::nullopt;
  return static_cast<int>(*value);
}

TagReader::TagReader(std::string_view bytes, std::string_view name) : name_(name), text_(bytes) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
  binary_ = text_.starts_with(kSentinel);
  if (!binary_) return;
  position_ = kSentinel.size();
  // The first tag is 0 SECTION: its code has one zero byte or two.
  wide_codes_ = text_.size() > position_ + 1 && text_[position_ + 1] == '\0';
}

std::string TagReader::place(std::size_t line) const {
  return std::string(name_) + (binary_ ? ": byte " : ":") + std::to_string(line);
}

Result<std::optional<Tag>> TagReader::next() { return binary_ ? next_binary() : next_ascii(); }

tl::unexpected<Error> TagReader::bad_code(std::string_view shown, std::size_t line) const {
  return fail({ErrorCode::kBadNumber,
               "a group code of the DXF file is wrong: " + std::string(shown), place(line),
               "the file is damaged; write it again", -1, 0.0});
}

std::optional<std::string_view> TagReader::line() {
  if (position_ >= text_.size()) return std::nullopt;
  const std::size_t end = text_.find_first_of("\r\n", position_);
  const std::size_t stop = end == std::string_view::npos ? text_.size() : end;
  const std::string_view line = text_.substr(position_, stop - position_);
  const bool two = text_.substr(stop, 2) == "\r\n";
  position_ = stop + (two ? 2 : 1);
  ++lines_;
  return line;
}

Result<std::optional<Tag>> TagReader::next_ascii() {
  const auto code_line = line();
  if (!code_line) return std::optional<Tag>();
  Tag tag;
  tag.line = lines_;
  tag.text = trimmed(*code_line);
  if (tag.text.empty() && position_ >= text_.size()) return std::optional<Tag>();
  const auto code = integer(tag);
  if (!code || *code < -5 || *code > kLargestCode) {  // -5 to -1 stand in files of other programs
    constexpr std::size_t kShown = 24;                // bytes of a line that an error repeats
    std::string shown = "\"";
    for (const char c : tag.text.substr(0, kShown)) shown += c >= ' ' && c < '\x7f' ? c : '?';
    return bad_code(shown + '"', tag.line);
  }
  const auto value = line();
  if (!value) {
    cut_ = true;
    return std::optional<Tag>();
  }
  tag.code = *code;
  tag.text = trimmed(*value);
  return std::optional(tag);
}

std::optional<unsigned long long> TagReader::bytes(std::size_t count) {
  if (text_.size() - position_ < count) return std::nullopt;
  unsigned long long value = 0;  // little-endian
  for (std::size_t i = count; i-- > 0;) {
    value = value << 8U | static_cast<unsigned char>(text_[position_ + i]);
  }
  position_ += count;
  return value;
}

std::optional<int> TagReader::binary_code() {
  constexpr unsigned long long kEscape = 255;  // of codes in one byte: two bytes follow
  auto code = bytes(wide_codes_ ? 2 : 1);
  if (code && !wide_codes_ && *code == kEscape) code = bytes(2);
  return code ? std::optional(static_cast<int>(*code)) : std::nullopt;
}

bool TagReader::binary_text(Tag& tag) {
  const std::size_t end = text_.find('\0', position_);
  if (end == std::string_view::npos) return false;
  tag.text = trimmed(text_.substr(position_, end - position_));
  position_ = end + 1;
  return true;
}

bool TagReader::binary_value(Tag& tag) {
  const auto store_signed = [&](std::size_t count) {
    const auto value = bytes(count);
    if (!value) return false;
    const unsigned shift = 64U - 8U * static_cast<unsigned>(count);
    tag.real = static_cast<double>(static_cast<std::int64_t>(*value << shift) >> shift);
    return true;
  };
  switch (store_of(tag.code)) {
    case Store::kText:
      return binary_text(tag);
    case Store::kReal: {
      const auto value = bytes(8);
      if (value) tag.real = std::bit_cast<double>(static_cast<std::uint64_t>(*value));
      return value.has_value();
    }
    case Store::kByte:
      return store_signed(1);
    case Store::kInt16:
      return store_signed(2);
    case Store::kInt32:
      return store_signed(4);
    case Store::kInt64:
      return store_signed(8);
    case Store::kChunk: {
      const auto length = bytes(1);
      if (!length || text_.size() - position_ < *length) return false;
      position_ += *length;
      return true;
    }
    case Store::kUnknown:
      return false;
  }
  return false;
}

Result<std::optional<Tag>> TagReader::next_binary() {
  if (position_ >= text_.size()) return std::optional<Tag>();
  Tag tag;
  tag.line = position_;
  const auto code = binary_code();
  if (code && store_of(*code) == Store::kUnknown) return bad_code(std::to_string(*code), tag.line);
  tag.code = code.value_or(0);
  cut_ = !code || !binary_value(tag);
  if (cut_) {
    position_ = text_.size();
    return std::optional<Tag>();
  }
  return std::optional(tag);
}

}  // namespace obvid::dxf
