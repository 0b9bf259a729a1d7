// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/curve/pieces.h"

namespace obvid::exchange {

/// A vertex of a DXF polyline, and the tangent of a quarter of the angle of the arc that follows
/// it.
struct BulgeVertex {
  Vec2 at;
  double bulge = 0.0;
};

/// Vertices for lines and arcs, with the end of the last one unless the polyline is closed. Arcs of
/// half a turn and more are cut: the bulge of a whole turn would be infinite.
[[nodiscard]] std::vector<BulgeVertex> bulge_vertices(const std::vector<Piece>& pieces,
                                                      bool closed);

}  // namespace obvid::exchange
