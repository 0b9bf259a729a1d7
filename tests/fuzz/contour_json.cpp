// SPDX-License-Identifier: Apache-2.0
// Any bytes give a contour or an error; a contour that was read is written and read the same.
#include "obvid/io/contour_json.h"

#include <cstddef>
#include <cstdint>

#include "promise.h"

using obvid::require;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto stored = obvid::contour_from_json({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (!stored) {
    require(obvid::exit_code(stored.error().code) == 3);
    require(!stored.error().what.empty() && !stored.error().where.empty());
    return 0;
  }
  const std::string text = obvid::contour_to_json(*stored);
  const auto again = obvid::contour_from_json(text, "fuzz");
  require(again.has_value());
  require(obvid::contour_to_json(*again) == text);
  return 0;
}
