// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/picture/surface_svg.h"

namespace obvid::picture {

/// Parallel projection onto the sheet.
struct PictureCamera {
  Vec3 right, up, back;  ///< unit vectors; `back` points to the viewer
  Vec3 centre;           ///< units
  double scale = 1.0;    ///< px/unit
  Vec2 middle;           ///< px: where the centre stands on the sheet

  /// x and y on the sheet (y downwards), z towards the viewer, all in px.
  [[nodiscard]] Vec3 project(Vec3 p) const {
    const Vec3 q = p - centre;
    return {middle.x + scale * dot(q, right), middle.y - scale * dot(q, up), scale * dot(q, back)};
  }
  /// A direction as the viewer sees it: to the right, upwards, towards the viewer.
  [[nodiscard]] Vec3 seen(Vec3 direction) const {
    return {dot(direction, right), dot(direction, up), dot(direction, back)};
  }
};

/// Axes of the projection that the options ask for.
[[nodiscard]] PictureCamera camera_of(const SurfacePictureOptions& options);

}  // namespace obvid::picture
