// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/surface/nurbs_surface.h"

namespace obvid {

/// What cuts a surface, as a function in space: 0 where it cuts, > 0 on its positive side, near the
/// cut the distance from it; and the direction in which it rises (length 1).
struct CuttingField {
  std::function<double(Vec3)> value;
  std::function<Vec3(Vec3)> rise;
};

/// Curves of parameters with what was measured of them.
struct TrimLine {
  std::vector<NurbsCurve> curves;  ///< end to end; a new one where the cut turns at once
  double deviation = 0.0;          ///< units: largest distance from the cut along the surface
};

/// Where the field's slope along the surface vanishes the cut has no direction.
struct CutPlace {
  SurfaceJet jet;
  double value = 0.0;
  double slope_u = 0.0, slope_v = 0.0;  ///< of the value by the parameters

  /// Distance from the cut along the surface, to the first order.
  [[nodiscard]] double off() const;
};
[[nodiscard]] CutPlace cut_place(const NurbsSurface& surface, const CuttingField& field, Vec2 at);

/// From a place near the cut onto it along the surface (Newton's method), inside the domain.
[[nodiscard]] Vec2 onto_cut(const NurbsSurface& surface, const CuttingField& field, Vec2 at);

/// Cubic curves through places of a cut, which are in order and so near to each other that the cut
/// runs along their chords: through as few of them as keep the tolerance (units, > 0), through more
/// where these do not suffice; with the cut's own directions, so that they are C1 in parameters of
/// its length. Measured at 9 places of each span, of which a new one comes where more than half of
/// the tolerance is found. Error: E502 where 12 halvings do not suffice.
[[nodiscard]] Result<TrimLine> trim_line(const NurbsSurface& surface, const CuttingField& field,
                                         const std::vector<Vec2>& places, bool closed,
                                         double tolerance);

}  // namespace obvid
