// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/mesh/mesh.h"

namespace obvid::mesh {

/// Triangles of what of a trimmed patch is there: rows of points along u at levels of v, from one
/// end of a band to the other, with strips between neighbouring rows. Levels are halved where
/// chords along the trims or triangles are farther off than the tolerance, lines of u in between.
/// Points of rows at the ends of bands belong to both sides: no T-joints inside of a patch;
/// neighbours have points of their own. `deviation` as of whole patches, measured at centroids and
/// middles of edges. Errors: those of `tessellate`.
[[nodiscard]] Result<Mesh> tessellate_trimmed(const SurfacePatch& patch,
                                              const TessellationOptions& options,
                                              const RunContext& run);

}  // namespace obvid::mesh
