// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "obvid/core/result.h"
#include "obvid/curve/contour.h"

namespace obvid {

enum class AirfoilLayout {
  kSelig,     ///< one list, from the trailing edge over the upper side around the nose and back
  kLednicer,  ///< upper side, then lower side, each from the leading edge; counts of both before
};

/// How points lie on each side between leading and trailing edge.
enum class AirfoilSpacing {
  kCosine,     ///< equal steps of the angle a, x = (1 - cos a) / 2 chords
  kCurvature,  ///< half of the density even, half as the square root of curvature
  kUniform,    ///< equal arc lengths
};

struct AirfoilOptions {
  std::string name = "airfoil";  ///< first line of the file
  AirfoilLayout layout = AirfoilLayout::kSelig;
  AirfoilSpacing spacing = AirfoilSpacing::kCosine;
  std::size_t count = 161;                   ///< points around; the leading edge counts once
  std::optional<double> trailing_thickness;  ///< chords, 0 closes it [as the contour has it]
  bool unit_chord = false;                   ///< leading edge to 0, 0, trailing edge to 1, 0
};

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
  double trailing_thickness = 0.0;       ///< distance of both ends
  double trailing_angle = 0.0;           ///< rad, between the tangents of both sides at the ends
};

struct AirfoilText {
  std::string text;
  AirfoilFigures figures;            ///< of the contour
  std::size_t upper = 0, lower = 0;  ///< points on each side, the leading edge on both
  double last_digit = 0.0;           ///< a unit of the last digit written, units of the file
};

/// A list of points on the contour (with `trailing_thickness`: on the contour whose sides are moved
/// apart by the difference times (x / chord)^2, which leaves the nose as it is). Closed contours
/// need a trailing edge: one corner, or two with the base between them.
/// Errors: E203 options out of range, or sides that would cross; E311 no trailing edge, or (cosine)
/// a side that folds back along the chord.
[[nodiscard]] Result<AirfoilText> airfoil_text(const Contour& contour,
                                               const AirfoilOptions& options);

}  // namespace obvid
