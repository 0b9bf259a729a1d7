// SPDX-License-Identifier: Apache-2.0
// Any bytes give a curve in space or an error of the reader; what was read has both its contours.
#include "obvid/io/space_json.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace {

void demand(bool promise) {
  if (!promise) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto stored =
      obvid::space_chain_from_json({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (!stored) {
    demand(obvid::exit_code(stored.error().code) == 3);
    demand(!stored.error().what.empty() && !stored.error().where.empty());
    return 0;
  }
  demand(!stored->parts.empty());
  for (const obvid::StoredSpace& part : stored->parts) {
    demand(part.points.size() >= 2);
    demand(obvid::check(part.curve).has_value());
  }
  return 0;
}
