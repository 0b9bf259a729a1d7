// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "obvid/curve/pieces.h"

namespace obvid {

/// The arc that leaves `start` in the direction `theta`; `kappa` is not 0.
inline ArcPiece arc_from(Vec2 start, double theta, double kappa, double length) {
  const double turn = kappa * length;
  const Vec2 chord = (2.0 * std::sin(0.5 * turn) / kappa) * unit_at(theta + 0.5 * turn);
  return {start, start + chord, theta, kappa, length};
}

}  // namespace obvid
