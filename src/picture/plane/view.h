// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/geom/vec2.h"

namespace obvid {

/// Model coordinates (relative to the track's reference) to px, y up.
struct PictureView {
  Vec2 centre;         // model
  Vec2 middle;         // px
  double scale = 1.0;  // px per unit

  [[nodiscard]] Vec2 operator()(Vec2 p) const {
    return {middle.x + (p.x - centre.x) * scale, middle.y - (p.y - centre.y) * scale};
  }
};

}  // namespace obvid
