// SPDX-License-Identifier: Apache-2.0
// Any bytes give a drawing of finite pieces and points, or an error that says where.
#include "drawing_promises.h"
#include "obvid/exchange/internal/road/landxml.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  obvid::require_promises(
      obvid::parse_landxml({reinterpret_cast<const char*>(data), size}, "fuzz"));
  return 0;
}
