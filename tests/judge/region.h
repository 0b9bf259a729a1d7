// SPDX-License-Identifier: Apache-2.0
// The region of two elements (Kurnosenko, "Biarcs and bilens", 2013): what lies between two biarcs.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>
#include <optional>

#include "real_curve.h"

namespace judge {

struct Element {
  Vec point;
  Real theta = 0.0L, kappa = 0.0L;
};

/// Circle arc, or straight for kappa = 0. Where two arcs of nearly the same curvature touch is
/// known as badly as their curvatures differ: each is measured from the element at its other end.
struct BoundaryArc {
  Vec start, end;
  Real theta = 0.0L, kappa = 0.0L, turn = 0.0L;
  bool from_end = false;  ///< its end is that of the chord, its start touches the other arc

  [[nodiscard]] Real distance(Vec p) const;
};

/// Two arcs with a common tangent, seen from the chord: starts in (0, 0), ends in (h, 0).
struct Biarc {
  BoundaryArc first, second;

  [[nodiscard]] Real distance(Vec p) const {
    return std::min(first.distance(p), second.distance(p));
  }
};

/// Largest and least ordinate over a chord; both ends of it count.
struct Extent {
  Real high = 0.0L, low = 0.0L;
};

class Region {
 public:
  /// None where no monotone curve of this direction (1, -1) has both elements. A curvature may be
  /// infinite where it is unknown, at the start against the direction, at the end along it.
  static std::optional<Region> of(const Element& from, const Element& to, int direction);

  /// Distance from a point (contour coordinates) to the farther boundary.
  [[nodiscard]] Real farther(Vec p) const;
  [[nodiscard]] Real nearer(Vec p) const;
  /// The larger of the distance of touching parallels to the chord and of the gap across it.
  [[nodiscard]] Real width() const;
  /// 0 inside; unknown (0) where a boundary is no graph over the chord.
  [[nodiscard]] Real outside(Vec p) const;
  /// Ordinates of both boundaries over the middle of the chord; none where one is no graph over it.
  [[nodiscard]] std::optional<std::array<Real, 2>> over_middle() const;
  /// Whether a boundary with one unknown circle turns by half a turn or more.
  [[nodiscard]] bool turns_half() const;
  /// Of the boundary from the start, and of that to the end.
  [[nodiscard]] std::array<Extent, 2> extents() const;
  /// Both arcs of a boundary in the plane, 0: that from the start, 1: that to the end.
  [[nodiscard]] std::array<Span, 2> arcs(std::size_t boundary) const;
  /// Distance from one of both boundaries, 0: from the start, 1: to the end.
  [[nodiscard]] Real distance(Vec p, std::size_t boundary) const;

 private:
  [[nodiscard]] Vec local(Vec p) const;

  Vec origin_, along_;
  Real h_ = 0.0L;
  Biarc from_start_, to_end_;
};

constexpr Real kStraightAngle = std::numbers::pi_v<Real>;
/// Rounding of directions of chords in doubles, rad.
constexpr Real kRoundedDirection = 64.0L * 0x1p-53L;

/// What four points say of the curve between the inner two: it lies between two arcs over their
/// chord, those of the circles through the first three and through the last three.
struct Lens {
  Real before = 0.0L, after = 0.0L;  ///< half the turns of both arcs, rad
  Real chord = 0.0L, shortest = 0.0L;
  Real turning = 0.0L;  ///< of the four points at the inner two, to both sides together, rad

  static Lens of(Vec a, Vec b, Vec c, Vec d);
  /// Curves that turn by half a turn or more are not held by the arcs.
  [[nodiscard]] bool holds() const;
  /// Largest distance of two curves in it: the arcs lie farthest apart over the middle of the
  /// chord.
  [[nodiscard]] Real height() const;
  /// How much the height grows when the directions of the chords change by one radian.
  [[nodiscard]] Real growth() const;
};

}  // namespace judge
