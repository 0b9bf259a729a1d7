// SPDX-License-Identifier: Apache-2.0
// Any bytes give a surface that is written and read back as the same one, or an error.
#include <cstdint>
#include <cstdlib>

#include "obvid/io/surface_json.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto model = obvid::surface_from_json({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (!model) {
    if (model.error().what.empty()) std::abort();
    return 0;
  }
  const auto again = obvid::surface_from_json(obvid::surface_json(*model), "again");
  if (!again || again->patches.size() != model->patches.size()) std::abort();
  for (std::size_t i = 0; i < model->patches.size(); ++i) {
    if (again->patches[i].surface != model->patches[i].surface) std::abort();
  }
  return 0;
}
