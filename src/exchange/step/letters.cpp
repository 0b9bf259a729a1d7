// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/step/letters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace obvid {
namespace {

std::uint32_t byte_at(const std::string& text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}
bool is_ascii(const std::string& text, std::size_t i) { return byte_at(text, i) < 0x80; }

/// How many bytes a letter has that starts with this one; 0 when none does.
std::size_t length_of(std::uint32_t lead) {
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  return lead >= 0xF0 && lead < 0xF5 ? 4 : 0;
}

/// The letter at `at`, which moves on; the kernel may have broken a line inside it.
std::uint32_t next_letter(const std::string& text, std::size_t& at) {
  const std::uint32_t lead = byte_at(text, at);
  const std::size_t length = length_of(lead);
  std::uint32_t letter = lead & (0x7FU >> length);
  std::size_t end = at + 1;
  for (std::size_t k = 1; k < length; ++k, ++end) {
    while (end < text.size() && text[end] == '\n') ++end;
    if (end >= text.size() || (byte_at(text, end) & 0xC0U) != 0x80) {
      ++at;
      return lead;
    }
    letter = letter << 6U | (byte_at(text, end) & 0x3FU);
  }
  at = length == 0 ? at + 1 : end;
  return length == 0 ? lead : letter;
}

}  // namespace

std::string in_step_letters(const std::string& text) {
  const auto beyond = [](char c) { return static_cast<unsigned char>(c) >= 0x80; };
  if (std::none_of(text.begin(), text.end(), beyond)) return text;  // nearly always
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    if (is_ascii(text, at)) {
      out += text[at++];
      continue;
    }
    std::string run;
    bool wide = false;
    for (std::size_t i = at; i < text.size() && !is_ascii(text, i);) {
      wide = wide || next_letter(text, i) > 0xFFFF;
    }
    while (at < text.size() && !is_ascii(text, at)) {
      run += fmt::format("{:0{}X}", next_letter(text, at), wide ? 8 : 4);
    }
    out.append(wide ? "\\X4\\" : "\\X2\\").append(run).append("\\X0\\");
  }
  return out;
}

std::string on_one_line(std::string name) {
  const auto is_control = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7F;
  };
  std::replace_if(name.begin(), name.end(), is_control, ' ');
  return name;
}

}  // namespace obvid
