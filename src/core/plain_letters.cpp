// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/plain_letters.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace obvid {
namespace {

constexpr std::uint32_t kBroken = 0xFFFD;  // what no character begins with

/// Latin letters U+00C0 to U+017F: German, Danish and Norwegian ones in two letters, others without
/// their marks.
constexpr std::uint32_t kLatinFrom = 0xC0;
constexpr std::array kLatin = {
    // clang-format off
    "A", "A", "A", "A", "Ae", "Aa", "Ae", "C", "E", "E", "E", "E", "I", "I", "I", "I", "D", "N",
    "O", "O", "O", "O", "Oe", "x", "Oe", "U", "U", "U", "Ue", "Y", "Th", "ss", "a", "a", "a", "a",
    "ae", "aa", "ae", "c", "e", "e", "e", "e", "i", "i", "i", "i", "d", "n", "o", "o", "o", "o",
    "oe", "_", "oe", "u", "u", "u", "ue", "y", "th", "y", "A", "a", "A", "a", "A", "a", "C", "c",
    "C", "c", "C", "c", "C", "c", "D", "d", "D", "d", "E", "e", "E", "e", "E", "e", "E", "e", "E",
    "e", "G", "g", "G", "g", "G", "g", "G", "g", "H", "h", "H", "h", "I", "i", "I", "i", "I", "i",
    "I", "i", "I", "i", "Ij", "ij", "J", "j", "K", "k", "k", "L", "l", "L", "l", "L", "l", "L",
    "l", "L", "l", "N", "n", "N", "n", "N", "n", "n", "N", "n", "O", "o", "O", "o", "O", "o",
    "Oe", "oe", "R", "r", "R", "r", "R", "r", "S", "s", "S", "s", "S", "s", "S", "s", "T", "t",
    "T", "t", "T", "t", "U", "u", "U", "u", "U", "u", "U", "u", "U", "u", "U", "u", "W", "w", "Y",
    "y", "Y", "Z", "z", "Z", "z", "Z", "z", "s",
    // clang-format on
};

/// U+0400 to U+045F, as they sound in English.
constexpr std::uint32_t kCyrillicFrom = 0x400;
constexpr std::array kCyrillic = {
    // clang-format off
    "E", "Yo", "Dj", "G", "Ye", "Dz", "I", "Yi", "J", "Lj", "Nj", "C", "K", "I", "U", "Dz", "A",
    "B", "V", "G", "D", "E", "Zh", "Z", "I", "Y", "K", "L", "M", "N", "O", "P", "R", "S", "T",
    "U", "F", "Kh", "Ts", "Ch", "Sh", "Shch", "", "Y", "", "E", "Yu", "Ya", "a", "b", "v", "g",
    "d", "e", "zh", "z", "i", "y", "k", "l", "m", "n", "o", "p", "r", "s", "t", "u", "f", "kh",
    "ts", "ch", "sh", "shch", "", "y", "", "e", "yu", "ya", "e", "yo", "dj", "g", "ye", "dz", "i",
    "yi", "j", "lj", "nj", "c", "k", "i", "u", "dz",
    // clang-format on
};

/// The character at a place of UTF-8, which moves behind it.
std::uint32_t next_character(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const std::uint32_t first = byte(at++);
  if (first < 0x80) return first;
  const int more = first >= 0xF0 && first < 0xF8 ? 3 : first >= 0xE0 ? 2 : first >= 0xC2 ? 1 : 0;
  if (more == 0 || first >= 0xF8) return kBroken;
  std::uint32_t out = first & (0x3FU >> more);
  for (int k = 0; k < more; ++k, ++at) {
    if (at >= text.size() || (byte(at) & 0xC0U) != 0x80) return kBroken;
    out = (out << 6U) | (byte(at) & 0x3FU);
  }
  return out;
}

/// Marks that stand behind their letter, as file systems of macOS have them.
bool is_mark(std::uint32_t c) { return c >= 0x300 && c < 0x370; }

void add_mark(std::uint32_t mark, std::string& out) {
  constexpr std::uint32_t kTwoDots = 0x308, kRing = 0x30A;
  const char last = out.empty() ? ' ' : out.back();
  const std::string_view two_dots = "aouAOU", ring = "aA";
  if (mark == kTwoDots && two_dots.find(last) != std::string_view::npos) out += 'e';
  if (mark == kRing && ring.find(last) != std::string_view::npos) out += 'a';
}

std::string_view plain_of(std::uint32_t c) {
  if (c >= kLatinFrom && c - kLatinFrom < kLatin.size()) return kLatin[c - kLatinFrom];
  if (c >= kCyrillicFrom && c - kCyrillicFrom < kCyrillic.size()) {
    return kCyrillic[c - kCyrillicFrom];
  }
  if (c == 0xA0 || c == 0x202F) return " ";
  if (c >= 0x2010 && c <= 0x2015) return "-";
  if (c == 0x1E9E) return "SS";
  if (c == 0x2300) return "D";  // a diameter
  return "_";
}

}  // namespace

std::string plain_letters(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::uint32_t c = next_character(text, at);
    if (c < 0x80) {
      out += static_cast<char>(c);
    } else if (is_mark(c)) {
      add_mark(c, out);
    } else {
      out += plain_of(c);
    }
  }
  return out;
}

}  // namespace obvid
