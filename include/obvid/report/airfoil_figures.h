// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>

#include "obvid/geom/vec2.h"

namespace obvid {

/// Figures of an airfoil. The chord goes from the middle of the trailing edge to the point of the
/// contour farthest from it, the leading edge; x along it from the leading edge. Thickness and
/// camber are measured normal to the chord (not to the camber line). All but angles in chords.
struct AirfoilFigures {
  double chord = 0.0;  ///< units of the contour
  double turn = 0.0;   ///< rad: of the direction from leading to trailing edge
  Vec2 leading_edge;   ///< units of the contour
  double thickness = 0.0, thickness_at = 0.0;
  double camber = 0.0, camber_at = 0.0;  ///< of the largest amount, with its sign
  double nose_radius = 0.0;              ///< of the contour at its leading edge
  double trailing_thickness = 0.0;  ///< distance of both ends across the chord; of a round edge its
                                    ///< diameter there
  bool trailing_round = false;      ///< both sides end at one point, turned against each other
  double trailing_gap = 0.0;        ///< distance of both ends along the chord
  double trailing_angle = 0.0;      ///< rad, between the tangents of both sides at the ends
  /// Within 1 % of the chord of the leading edge: the largest corner, rad, and how often the
  /// curvature turns back, as samples tell; a fair nose has no corner and turns back once at most.
  double nose_corner = 0.0;
  std::size_t nose_turns = 0;
};

/// The same of points with straight lines between them, along the chord of a contour through them;
/// in chords. Largest values of such lines lie at points, so the places are no finer than these.
struct AirfoilPointFigures {
  double thickness = 0.0, thickness_at = 0.0;
  double camber = 0.0, camber_at = 0.0;  ///< of the largest amount, with its sign
  double nose_radius = 0.0;         ///< of the circle through the foremost point and its neighbours
  double nose_gap = 0.0;            ///< the longer one of the chords to these neighbours
  double trailing_thickness = 0.0;  ///< distance of the last points of both sides across the chord;
                                    ///< where they go around a circle its diameter
  bool trailing_round = false;
};

}  // namespace obvid
