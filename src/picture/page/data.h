// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "obvid/core/run_context.h"
#include "obvid/mesh/mesh.h"
#include "obvid/picture/surface_svg.h"
#include "obvid/surface/surface.h"
#include "page/value_raster.h"
#include "page/values.h"

namespace obvid::picture {

/// All numbers of a page: for each patch positions relative to the centre, normals folded onto an
/// octahedron, parameters scaled to [0, 1]; its raster of values: breaks along u and v, at each
/// node both principal curvatures, the normal (-32768 twice where there is none) and the deviation
/// where it has one; and the triangles; then the points of the lines, then measured points with
/// theirs. Little-endian, each array padded to 4 bytes.
struct PageData {
  std::string bytes;
  Vec3 centre;
  Vec3 size;            ///< of the box around all triangles
  double radius = 1.0;  ///< of the sphere around the centre that holds everything
  std::array<ValueScale, kPageQuantities.size()> scales;
  ValueScale deviation;                            ///< where there is one
  std::size_t dots = 0;                            ///< measured points
  std::vector<std::array<RasterSide, 2>> rasters;  ///< of each patch along u and v
};

/// Patches, meshes and lines as `surface_page` has checked them.
[[nodiscard]] Result<PageData> page_data(const SurfaceModel& model, const std::vector<Mesh>& meshes,
                                         const std::vector<ScenePolyline>& lines,
                                         const std::optional<ShownDeviation>& deviation,
                                         const RunContext& run);

[[nodiscard]] std::string base64(const std::string& bytes);

}  // namespace obvid::picture
