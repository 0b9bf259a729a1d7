// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/shown_text.h"

#include <algorithm>
#include <cstddef>

namespace obvid {
namespace {

constexpr std::size_t kMostShown = 60;  // bytes of a foreign text in a message

}  // namespace

std::string shortened(std::string_view text) {
  std::size_t length = std::min(text.size(), kMostShown);
  // Not inside a character of UTF-8.
  while (length > 0 && length < text.size() &&
         (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) {
    --length;
  }
  std::string out(text.substr(0, length));
  for (char& c : out) {
    if (static_cast<unsigned char>(c) < 0x20U) c = ' ';
  }
  if (length < text.size()) out += "...";
  return out;
}

std::string escaped_xml(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20U ? ' ' : c;
    }
  }
  return out;
}

}  // namespace obvid
