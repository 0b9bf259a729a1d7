// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "obvid/core/run_context.h"
#include "obvid/mesh/mesh.h"
#include "obvid/picture/surface_svg.h"
#include "obvid/surface/surface.h"
#include "page/values.h"

namespace obvid::picture {

inline constexpr std::array kPageQuantities = {SurfaceColouring::kGaussian, SurfaceColouring::kMean,
                                               SurfaceColouring::kK1, SurfaceColouring::kK2};

/// Nodes of one direction of a raster: spans (or several neighbouring ones together) of the
/// surface, each divided evenly. Each has nodes at both of its ends, so values may jump there.
struct RasterSide {
  std::vector<double> breaks;  ///< ascending from 0 to 1, parts of the domain
  std::size_t cells = 1;       ///< between two breaks

  [[nodiscard]] std::size_t spans() const { return breaks.size() - 1; }
  [[nodiscard]] std::size_t nodes() const { return spans() * (cells + 1); }
  /// Part of the domain of a node, those at breaks a little inside their span.
  [[nodiscard]] double at(std::size_t node) const;
};

/// What a pixel of a page is coloured by: values over the parameters of one patch, linear in both
/// between nodes; rows along u.
struct ValueRaster {
  RasterSide u, v;
  std::vector<PrincipalCurvatures> k;
  std::vector<Vec3> normals;  ///< length 1; 0 where there is none
  std::vector<double> offs;   ///< deviations; empty where there are none of places
  std::vector<double> areas;  ///< that a node stands for; 0 outside the triangles of the patch
  [[nodiscard]] std::size_t nodes() const { return u.nodes() * v.nodes(); }
};

/// One for each patch: so fine that in nearly all cells the middle is within half a band of colour
/// of what the nodes say, and that the told extremes of the deviation are met. A span has six
/// cells each way or more, up to 300,000 nodes of all patches together; where these are not enough
/// spans have fewer cells, then neighbours share them. Finer than its spans a raster gets up to
/// 150,000 nodes, with a deviation 60,000.
/// Errors: E103.
[[nodiscard]] Result<std::vector<ValueRaster>> value_rasters(
    const SurfaceModel& model, const std::vector<Mesh>& meshes,
    const std::optional<ShownDeviation>& deviation, const RunContext& run);

/// Of the nodes inside the patches, by their area; `size` of what is shown.
[[nodiscard]] ValueScale scale_of(const std::vector<ValueRaster>& rasters,
                                  SurfaceColouring colouring, double size);
[[nodiscard]] ValueScale scale_of_offs(const std::vector<ValueRaster>& rasters, double size);

}  // namespace obvid::picture
