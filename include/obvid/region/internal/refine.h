// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "obvid/curve/pieces.h"
#include "obvid/region/internal/segment_region.h"

namespace obvid {

/// Least tolerance that widths may be asked to keep, units: 1e-12 of the size of the series, and
/// eight roundings of its largest coordinate. Widths below are what is left of coordinates.
[[nodiscard]] double least_tolerance(const std::vector<Vec2>& points);

/// Error bound of a part of one piece of a spiral contour.
struct PieceBound {
  double width = 0.0;        ///< largest region width after refinement
  std::size_t inserted = 0;  ///< elements taken on the part so that every width is small enough
  bool reached = true;  ///< false: the tolerance was not reached with the most elements allowed
};

/// Takes elements on the piece between parameters t0 and t1 (equal steps, as few as do it) until
/// the region between neighbours is nowhere wider than `tolerance`. The piece itself stays as it
/// is. Widths fall about by 8 per halving. `direction` +1: signed curvature increases; 0: constant,
/// and nothing is open. `unrefined`: the width between both ends, where it is known.
[[nodiscard]] PieceBound bound_piece(const Piece& piece, double t0, double t1, int direction,
                                     double tolerance, std::optional<double> unrefined = {});

/// Parameters 0 = t_0 < t_1 < ... < t_k = 1 with the region between neighbours at most
/// `tolerance` wide, each step as long as that allows (k nearly the least).
[[nodiscard]] std::vector<double> fewest_elements(const Piece& piece, int direction,
                                                  double tolerance);

}  // namespace obvid
