// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

namespace obvid {

/// Lists of numbers as users type them, "1,2.5,-3": all of the text as finite numbers with
/// `separator` between them, each with a sign or without one, none with space around it; nothing
/// where one of them is none.
template <class Number = double>
[[nodiscard]] std::optional<std::vector<Number>> typed_numbers(std::string_view text,
                                                               char separator = ',') {
  std::vector<Number> out;
  for (;;) {
    const std::size_t to = text.find(separator);
    std::string_view one = text.substr(0, to);
    if (one.size() > 1 && one[0] == '+' && one[1] != '-') one.remove_prefix(1);
    Number value{};
    const char* const end = one.data() + one.size();
    const auto [stop, code] = std::from_chars(one.data(), end, value);
    if (one.empty() || code != std::errc{} || stop != end) return std::nullopt;
    if constexpr (std::is_floating_point_v<Number>) {
      if (!std::isfinite(value)) return std::nullopt;
    }
    out.push_back(value);
    if (to == std::string_view::npos) return out;
    text.remove_prefix(to + 1);
  }
}

}  // namespace obvid
