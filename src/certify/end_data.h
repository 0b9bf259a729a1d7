// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/curve/pieces.h"

namespace obvid {

/// Where a piece ends: point, direction, curvature, and how far the rounding of its stored
/// numbers alone can move each (docs/methods/certify.md).
struct EndData {
  Vec2 point;
  Vec2 direction;  ///< unit
  double kappa = 0.0;
  double point_rounding = 0.0;    ///< units
  double heading_rounding = 0.0;  ///< rad
  double kappa_rounding = 0.0;    ///< 1/unit
};

[[nodiscard]] EndData start_data(const Piece& piece);
[[nodiscard]] EndData end_data(const Piece& piece);

}  // namespace obvid
