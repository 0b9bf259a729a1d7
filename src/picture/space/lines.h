// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "space/camera.h"
#include "space/depth.h"
#include "space/raster.h"

namespace obvid::picture {

/// A scene on the sheet, for the lines that are drawn over it.
struct Scene {
  const SurfaceModel& model;
  const std::vector<DrawnPatch>& patches;
  const PictureCamera& camera;
  const DepthBuffer& depth;
};

/// Isolines, borders and outlines without their hidden parts.
[[nodiscard]] std::string surface_lines(const Scene& scene, const SurfacePictureOptions& options);
/// The options' lines; hidden parts of sections stay faint, those of others are left out.
[[nodiscard]] std::string extra_lines(const Scene& scene, const std::vector<ScenePolyline>& lines);

}  // namespace obvid::picture
