// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "space/camera.h"
#include "space/depth.h"
#include "space/raster.h"

namespace obvid::picture {

/// Bands into which the range of curvature colours is divided.
inline constexpr int kBands = 24;

/// What colours a picture: the options' colouring with the range of its values.
struct Colours {
  SurfaceColouring colouring = SurfaceColouring::kShaded;
  ValueScale scale;
  int zebra_stripes = 1;
  double ceiling = 1.0;  ///< units above the centre, of the lamps of reflection lines
  std::string title;     ///< of the legend
};

/// Cells of all patches on the sheet, in order.
[[nodiscard]] std::vector<DepthBuffer::Quad> projected(const std::vector<DrawnPatch>& patches,
                                                       const PictureCamera& camera);

/// The cells that can be seen as SVG paths: those with something before them from back to front,
/// then all others by colour, and what no order gets right, where patches cross; cut along the
/// borders between shades or bands. Where the watch says stop, not all of them.
[[nodiscard]] std::string facet_paths(const std::vector<DrawnPatch>& patches,
                                      const std::vector<DepthBuffer::Quad>& quads,
                                      DepthBuffer& depth, const PictureCamera& camera,
                                      const Colours& colours, Watch* watch);

}  // namespace obvid::picture
