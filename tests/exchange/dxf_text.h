// SPDX-License-Identifier: Apache-2.0
// DXF files for tests: entities in words, as ASCII or binary.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace obvid::test {

using Tags = std::vector<std::pair<int, std::string>>;

inline std::string ascii(const Tags& tags) {
  std::string out;
  for (const auto& [code, value] : tags) out += std::to_string(code) + "\n" + value + "\n";
  return out;
}

/// Sections around entities; `blocks` and `header` may be empty.
inline Tags file_of(const Tags& entities, const Tags& blocks = {}, const Tags& header = {}) {
  Tags out;
  const auto section = [&](const char* name, const Tags& tags) {
    out.insert(out.end(), {{0, "SECTION"}, {2, name}});
    out.insert(out.end(), tags.begin(), tags.end());
    out.emplace_back(0, "ENDSEC");
  };
  if (!header.empty()) section("HEADER", header);
  if (!blocks.empty()) section("BLOCKS", blocks);
  section("ENTITIES", entities);
  out.emplace_back(0, "EOF");
  return out;
}

inline const Tags kMillimetres = {{9, "$INSUNITS"}, {70, "4"}};

inline std::string dxf(const Tags& entities, const Tags& blocks = {}) {
  return ascii(file_of(entities, blocks, kMillimetres));
}

/// Tags one after the other.
inline Tags operator+(Tags a, const Tags& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline Tags line(const char* x0, const char* y0, const char* x1, const char* y1,
                 const char* layer = "0") {
  return {{0, "LINE"}, {8, layer}, {10, x0}, {20, y0}, {11, x1}, {21, y1}};
}

inline Tags arc(const char* x, const char* y, const char* radius, const char* from,
                const char* to) {
  return {{0, "ARC"}, {8, "0"}, {10, x}, {20, y}, {40, radius}, {50, from}, {51, to}};
}

/// Binary DXF by the published table of group codes; `wide` as since R13.
inline std::string binary(const Tags& tags, bool wide) {
  std::string out("AutoCAD Binary DXF\r\n\x1a\0", 22);
  const auto put = [&](std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xFFU);
  };
  for (const auto& [code, value] : tags) {
    if (wide) {
      put(static_cast<std::uint64_t>(code), 2);
    } else if (code < 255) {
      put(static_cast<std::uint64_t>(code), 1);
    } else {
      put(255, 1);
      put(static_cast<std::uint64_t>(code), 2);
    }
    if ((code >= 10 && code <= 59) || (code >= 210 && code <= 239)) {
      put(std::bit_cast<std::uint64_t>(std::stod(value)), 8);
    } else if (code >= 60 && code <= 79) {
      put(static_cast<std::uint64_t>(std::stoi(value)), 2);
    } else if (code >= 90 && code <= 99) {
      put(static_cast<std::uint64_t>(std::stoi(value)), 4);
    } else {
      out += value;
      out += '\0';
    }
  }
  return out;
}

}  // namespace obvid::test
