// SPDX-License-Identifier: Apache-2.0
#include "dxf/text.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <optional>

namespace obvid::dxf {
namespace {

using std::string_view;

void append_utf8(std::uint32_t code, std::string& out) {
  const auto byte = [&](std::uint32_t value) { out += static_cast<char>(value); };
  if (code < 0x80U) {
    byte(code);
  } else if (code < 0x800U) {
    byte(0xC0U | code >> 6U);
    byte(0x80U | (code & 0x3FU));
  } else if (code < 0x10000U) {
    byte(0xE0U | code >> 12U);
    byte(0x80U | (code >> 6U & 0x3FU));
    byte(0x80U | (code & 0x3FU));
  } else {
    byte(0xF0U | code >> 18U);
    byte(0x80U | (code >> 12U & 0x3FU));
    byte(0x80U | (code >> 6U & 0x3FU));
    byte(0x80U | (code & 0x3FU));
  }
}

bool is_scalar(std::uint32_t code) {
  return code <= 0x10FFFFU && (code < 0xD800U || code > 0xDFFFU);
}

/// The well-formed UTF-8 character at the front, taken off; nothing when there is none.
std::optional<std::uint32_t> take_utf8(string_view& text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = first < 0x80U ? 1 : first < 0xE0U ? 2 : first < 0xF0U ? 3 : 4;
  if ((first >= 0x80U && first < 0xC2U) || first > 0xF4U || text.size() < length) {
    return std::nullopt;
  }
  std::uint32_t code = length == 1 ? first : first & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    const auto next = static_cast<unsigned char>(text[i]);
    if ((next & 0xC0U) != 0x80U) return std::nullopt;
    code = code << 6U | (next & 0x3FU);
  }
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};  // shorter forms exist below
  if (!is_scalar(code) || code < kLeast[length]) return std::nullopt;
  text.remove_prefix(length);
  return code;
}

/// \U+00E4 at the front, taken off.
std::optional<std::uint32_t> take_escape(string_view& text) {
  constexpr std::size_t kPrefix = 3, kDigits = 4;
  if (!text.starts_with("\\U+") || text.size() < kPrefix + kDigits) return std::nullopt;
  std::uint32_t code = 0;
  const char* from = text.data() + kPrefix;
  const auto [stop, error] = std::from_chars(from, from + kDigits, code, 16);
  if (error != std::errc() || stop != from + kDigits || !is_scalar(code)) return std::nullopt;
  text.remove_prefix(kPrefix + kDigits);
  return code;
}

}  // namespace

std::string to_label(string_view name, std::size_t longest) {
  std::string out;
  for (std::size_t count = 0; !name.empty(); ++count) {
    if (count == longest) return out + "...";
    auto code = take_escape(name);
    if (!code) code = take_utf8(name);
    if (!code) {
      code = static_cast<unsigned char>(name.front());  // Latin-1
      name.remove_prefix(1);
    }
    const bool control = *code < 0x20U || (*code >= 0x7FU && *code < 0xA0U);
    append_utf8(control ? '?' : *code, out);
  }
  return out;
}

std::string layer_name(string_view label) {
  constexpr string_view kForbidden = "<>/\\\":;?*|,=`";
  constexpr std::uint32_t kPlane = 0x10000U;  // letters beyond have no such escape
  std::string out;
  for (std::size_t count = 0; !label.empty() && count < kLongestName; ++count) {
    const auto code = take_utf8(label);
    if (!code) label.remove_prefix(1);
    // the code page of such files; two in a row could be read as UTF-8
    const bool alone = label.empty() || static_cast<unsigned char>(label.front()) < 0x80U;
    const bool behind = !out.empty() && static_cast<unsigned char>(out.back()) >= 0x80U;
    if (code && *code >= 0xA0U && *code <= 0xFFU && alone && !behind) {
      out += static_cast<char>(*code);
      continue;
    }
    if (code && *code >= 0xA0U && *code < kPlane) {
      out += fmt::format("\\U+{:04X}", *code);
      continue;
    }
    const bool plain = code && *code >= 0x20U && *code < 0x7FU;
    const char c = plain ? static_cast<char>(*code) : '_';
    out += kForbidden.find(c) == string_view::npos ? c : '_';
  }
  // blanks around it get lost where values are trimmed
  const std::size_t first = out.find_first_not_of(' ');
  if (first == std::string::npos) return "0";
  return out.substr(first, out.find_last_not_of(' ') + 1 - first);
}

}  // namespace obvid::dxf
