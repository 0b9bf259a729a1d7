// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace obvid::arcs {

/// Largest of three neighbouring values, and of the parabola through them.
[[nodiscard]] inline double peak(double before, double here, double after) {
  const double bend = 2.0 * here - before - after;
  if (here < before || here < after || !(bend > 0.0)) return here;
  return here + (after - before) * (after - before) / (8.0 * bend);
}

}  // namespace obvid::arcs
