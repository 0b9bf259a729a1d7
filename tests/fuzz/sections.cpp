// SPDX-License-Identifier: Apache-2.0
// Any bytes give sections of finite points, or an error that says what.
#include <cstdint>
#include <cstdlib>

#include "obvid/io/read_sections.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto parsed = obvid::parse_sections({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (!parsed) {
    if (parsed.error().what.empty()) std::abort();
    return 0;
  }
  if (parsed->sections.empty()) std::abort();
  for (const obvid::SpaceSeries& section : parsed->sections) {
    if (section.points.empty()) std::abort();
    for (const obvid::Vec3& p : section.points) {
      if (!obvid::is_finite(p)) std::abort();
    }
  }
  return 0;
}
