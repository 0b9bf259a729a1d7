// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/strays_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace obvid::pipeline_detail {

std::string strays_text(const std::vector<std::size_t>& numbers) {
  constexpr std::size_t kMostNamed = 5;
  std::string named;
  for (std::size_t k = 0; k < std::min(numbers.size(), kMostNamed); ++k) {
    named += fmt::format("{}{}", k > 0 ? ", " : "", numbers[k]);
  }
  if (numbers.size() == 1) {
    return fmt::format(
        "point {} lies off the curve of its neighbours: --drop-outliers leaves it out", named);
  }
  return fmt::format(
      "points {} {} off the curve of their neighbours: --drop-outliers leaves them out", named,
      numbers.size() <= kMostNamed ? "lie" : "and more lie");
}

}  // namespace obvid::pipeline_detail
