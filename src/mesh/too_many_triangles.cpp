// SPDX-License-Identifier: Apache-2.0
#include "too_many_triangles.h"

#include <fmt/format.h>

namespace obvid::mesh {

Error too_many_triangles(std::size_t most) {
  return error(ErrorCode::kToleranceNotReached,
               fmt::format("the surface needs more than {} triangles", most))
      .hint("allow a larger chord tolerance or angle")
      .value(static_cast<double>(most));
}

}  // namespace obvid::mesh
