// SPDX-License-Identifier: Apache-2.0
#pragma once

// What libc++ 13 lacks of C++20. Included before every source of the WebAssembly build.

#include <version>
#ifndef __cpp_lib_bit_cast
#include <charconv>
#include <cmath>
#include <system_error>

#include "fast_float/fast_float.h"

namespace std {

template <class To, class From>
[[nodiscard]] constexpr To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, from);
}

/// A number beyond all doubles is out of range here, infinity to fast_float.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  double read = 0.0;
  const auto [stop, code] = fast_float::from_chars(first, last, read);
  const bool named =
      first != last && (*first == '-' ? first + 1 != last && first[1] > '9' : *first > '9');
  if (code == errc() && std::isinf(read) && !named) return {stop, errc::result_out_of_range};
  if (code == errc()) value = read;
  return {stop, code};
}

}  // namespace std
#endif
