// SPDX-License-Identifier: Apache-2.0
// The region of two elements (Kurnosenko, "Biarcs and bilens", 2013): what lies between two biarcs.
#pragma once

#include <optional>

#include "real_curve.h"

namespace judge {

struct Element {
  Vec point;
  Real theta = 0.0L, kappa = 0.0L;
};

/// Circle arc, or straight for kappa = 0.
struct BoundaryArc {
  Vec start, end;
  Real theta = 0.0L, kappa = 0.0L, turn = 0.0L;

  [[nodiscard]] Real distance(Vec p) const;
};

/// Two arcs with a common tangent, seen from the chord: starts in (0, 0), ends in (h, 0).
struct Biarc {
  BoundaryArc first, second;

  [[nodiscard]] Real distance(Vec p) const {
    return std::min(first.distance(p), second.distance(p));
  }
};

class Region {
 public:
  /// None where no monotone curve of this direction (1, -1) has both elements.
  static std::optional<Region> of(const Element& from, const Element& to, int direction);

  /// Distance from a point (contour coordinates) to the farther boundary.
  [[nodiscard]] Real farther(Vec p) const;
  [[nodiscard]] Real nearer(Vec p) const;
  /// The larger of the distance of touching parallels to the chord and of the gap across it.
  [[nodiscard]] Real width() const;
  /// 0 inside; unknown (0) where a boundary is no graph over the chord.
  [[nodiscard]] Real outside(Vec p) const;

 private:
  [[nodiscard]] Vec local(Vec p) const;

  Vec origin_, along_;
  Real h_ = 0.0L;
  Biarc from_start_, to_end_;
};

/// Largest distance between curves that lie between two arcs over the same chord, each from one to
/// the other; `k0`, `k1` curvatures, `h` the chord, both arcs less than half a turn.
Real between_arcs(Real k0, Real k1, Real h);

}  // namespace judge
