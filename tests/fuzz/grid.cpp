// SPDX-License-Identifier: Apache-2.0
// Any bytes give a grid whose points are as many as its counts say, or an error that says what.
#include <cstdint>
#include <cstdlib>

#include "obvid/io/internal/read_control_net.h"
#include "obvid/io/internal/read_grid.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto grid = obvid::parse_grid(text, "fuzz");
  if (!grid && grid.error().what.empty()) std::abort();
  if (grid) {
    if (grid->count_u < 2 || grid->count_v < 2) std::abort();
    if (grid->points.size() != grid->count_u * grid->count_v) std::abort();
    for (const obvid::Vec3& p : grid->points) {
      if (!obvid::is_finite(p)) std::abort();
    }
  }
  const auto net = obvid::parse_control_net(text, "fuzz");
  if (!net && net.error().what.empty()) std::abort();
  if (net && net->patches.empty()) std::abort();
  return 0;
}
