// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "obvid/mesh/mesh.h"
#include "patch_sampler.h"

namespace obvid::mesh {

/// Triangles of a cell: so many of the mesh, in the order of the cells.
struct CellTriangles {
  std::uint32_t count = 0;
  std::uint64_t outline = 0;  ///< a number that tells whether they are the same as last time
};

/// What is known of a cell from an earlier look, 0 for nothing.
struct CellSeen {
  std::uint64_t outline = 0;
  double deviation = 0.0;
};

struct Measured {
  double deviation = 0.0;  ///< units, largest distance of a triangle from the surface
  std::vector<bool> bad;   ///< per cell: a triangle too far off, or turned over
  bool any_bad = false;
};

/// How closely a triangle is looked at: at middles of its edges (of borders: from the border curve)
/// and its centroid, or at quarters and at the centroids of its corners, too; at more places where
/// it reaches over several spans.
enum class Look { kMiddles, kQuarters };

/// Distances of triangles from the surface, at points between those that led to the triangles.
/// Between these places a triangle may be farther off. Cells that were good and have not changed
/// are not looked at again. Error: E103.
[[nodiscard]] Result<Measured> measure(const PatchSampler& sampler, const Mesh& mesh,
                                       const std::vector<CellTriangles>& triangles,
                                       std::vector<CellSeen>& seen, double tolerance, Look look,
                                       const RunContext& run);

}  // namespace obvid::mesh
