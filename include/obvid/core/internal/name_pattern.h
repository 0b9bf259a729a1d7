// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace obvid {

// Names of several files in one: "curves/{id}.step".

inline constexpr std::string_view kPlaceOfId = "{id}";
inline constexpr std::string_view kPlaceOfNumber = "{number}";

[[nodiscard]] inline bool has_place(std::string_view pattern, std::string_view place) {
  return pattern.find(place) != std::string_view::npos;
}

/// Every such place with its text in it; texts are not looked into.
[[nodiscard]] inline std::string filled(
    std::string_view pattern,
    std::initializer_list<std::pair<std::string_view, std::string_view>> texts) {
  std::string out;
  while (!pattern.empty()) {
    std::size_t taken = 0;
    for (const auto& [place, text] : texts) {
      if (taken > 0 || pattern.substr(0, place.size()) != place) continue;
      out += text;
      taken = place.size();
    }
    if (taken == 0) out += pattern[0];
    pattern.remove_prefix(taken > 0 ? taken : 1);
  }
  return out;
}

}  // namespace obvid
