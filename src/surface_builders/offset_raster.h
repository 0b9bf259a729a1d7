// SPDX-License-Identifier: Apache-2.0
// Principal curvatures of a surface on rasters, with the sign of an offset.
#pragma once

#include <vector>

#include "obvid/surface/nurbs_surface.h"

namespace obvid {

/// A place of the surface and how much it bends there.
struct Bend {
  double u = 0.0, v = 0.0;
  double value = 0.0;  ///< 1/unit
};

/// How much a surface bends towards one side: `side` +1: the greatest principal curvature, -1: the
/// smallest one, turned round. Less what rounding may add, which matters next to poles only; 0
/// where it bends to the other side only and where it is flat but for rounding.
class Bending {
 public:
  explicit Bending(const NurbsSurface& surface);

  /// Both sides at once: {towards the normal, against it}.
  struct Sides {
    double along = 0.0, against = 0.0;
  };
  [[nodiscard]] Sides at(double u, double v) const;
  [[nodiscard]] double at(double u, double v, int side) const;

  /// The greatest bend near a place, inside the ranges: compass steps, halved until they are far
  /// below the raster.
  [[nodiscard]] Bend climbed(Bend from, double step_u, double step_v, int side, const Range& u,
                             const Range& v) const;

 private:
  const NurbsSurface& surface_;
  double coordinates_ = 0.0, flat_ = 0.0;
};

/// Parameters of a raster: `steps` in each span, and next to knots where curvature can jump a
/// parameter just before the knot.
[[nodiscard]] std::vector<double> raster_parameters(const std::vector<double>& knots, int degree,
                                                    std::size_t steps);
/// Spans with a length.
[[nodiscard]] std::size_t span_count(const std::vector<double>& knots);

}  // namespace obvid
