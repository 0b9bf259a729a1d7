// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace obvid::exchange {

/// A number at a place of a binary file; the bytes have to be there.
template <class T>
[[nodiscard]] T bytes_as(std::string_view text, std::size_t at, bool little) {
  std::array<char, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), text.data() + at, sizeof(T));
  if (little != (std::endian::native == std::endian::little)) {
    std::reverse(bytes.begin(), bytes.end());
  }
  return std::bit_cast<T>(bytes);
}

}  // namespace obvid::exchange
