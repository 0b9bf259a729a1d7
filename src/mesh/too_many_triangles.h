// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "obvid/core/error.h"

namespace obvid::mesh {

/// E502: a surface needs more triangles than a patch may have.
[[nodiscard]] Error too_many_triangles(std::size_t most);

}  // namespace obvid::mesh
