// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "obvid/mesh/mesh.h"
#include "patch_sampler.h"

namespace obvid::mesh {

struct Measured {
  double deviation = 0.0;  ///< units, largest distance of a triangle from the surface
  std::vector<bool> bad;   ///< per cell: a triangle too far off, or turned over
  bool any_bad = false;
};

/// Distances of triangles from the surface, at points between those that led to the triangles:
/// middles of edges (of borders: from the border curve), centroids, more of them where a triangle
/// reaches over several spans.
[[nodiscard]] Measured measure(const PatchSampler& sampler, const Mesh& mesh,
                               const std::vector<std::uint32_t>& cell_of, std::size_t cells,
                               double tolerance);

}  // namespace obvid::mesh
