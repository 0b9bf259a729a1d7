// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/report/airfoil_figures.h"

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

/// How a trailing edge that is not sharp ends.
enum class TrailingEdgeForm {
  kBlunt,  ///< where the sides end
  kRound,  ///< by an arc that both sides touch
};

struct AirfoilOptions {
  std::string name = "airfoil";  ///< first line of the file
  AirfoilLayout layout = AirfoilLayout::kSelig;
  AirfoilSpacing spacing = AirfoilSpacing::kCosine;
  std::size_t count = 161;                   ///< points around; the leading edge counts once
  std::optional<double> trailing_thickness;  ///< chords, 0 closes it [as the contour has it]
  TrailingEdgeForm trailing_form = TrailingEdgeForm::kBlunt;
  bool unit_chord = false;  ///< leading edge to 0, 0, trailing edge to 1, 0
  /// Of the file, chords, measured as `AirfoilFigures` are; camber with its sign [as the contour
  /// has them].
  std::optional<double> thickness{}, camber{};
};

/// The arc that ends a round trailing edge; x along the chord, all in chords.
struct RoundedEdge {
  double diameter = 0.0;
  double upper_from = 0.0, lower_from = 0.0;  ///< x at which it touches the sides
  std::size_t points = 0;                     ///< of the file between these, both ends counted once
  double turn = 0.0;  ///< rad: from the contour's chord to the direction of its hindmost point
};

/// A trailing edge of thickness 0: both sides end at one point. All in chords.
struct ClosedEdge {
  double gap = 0.0;       ///< by which one side ended before the other one, along the chord
  bool upper = false;     ///< that side
  double gone_on = 0.0;   ///< length of the straight that it goes on by, with its tangent
  double moved = 0.0;     ///< each end, across the chord
  std::string left_open;  ///< why that side does not go on; the ends are as far apart then
};

struct AirfoilText {
  std::string text;
  AirfoilFigures figures;            ///< of the contour, with the straight of `closed`
  std::size_t upper = 0, lower = 0;  ///< points on each side, the leading edge on both
  double last_digit = 0.0;           ///< a unit of the last digit written, units of the file
  std::optional<RoundedEdge> rounded{};
  std::optional<ClosedEdge> closed{};                ///< where a thickness of 0 was asked for
  double thickness_scale = 1.0, camber_scale = 1.0;  ///< of the file over those of `figures`
};

/// A list of points on the contour. With `thickness` or `camber` on the contour whose sides'
/// distance and middle, normal to the chord, are multiplied each by one factor, before the trailing
/// edge is formed; places along the chord stay. With `trailing_thickness` on the contour whose
/// sides are moved apart by an amount times (x / chord)^2, which leaves the nose as it is: that the
/// ends are so far apart across the chord, or that an arc of this diameter touches both sides (G1)
/// and its hindmost point, the one farthest from the leading edge, is a chord away from that. With
/// a thickness of 0 both sides end at one point: a side that ends before the other one along the
/// chord, by up to a tenth of it, goes on straight to there first, and the chord is that to this
/// point. A round edge without a thickness has that of the contour. The points of the arc follow
/// the spacing of the sides. Closed contours need a trailing edge: one corner, two with the base
/// between them, or a round one at which they begin. Errors: E203 options out of range, a camber
/// asked of a section that has none, sides that would cross, or no room for the arc; E311 no
/// trailing edge, or a side that folds back along the chord.
[[nodiscard]] Result<AirfoilText> airfoil_text(const Contour& contour,
                                               const AirfoilOptions& options);

/// Figures of a contour that is an airfoil: both sides run along the chord, and its ends are no
/// farther apart than half of it. Errors: E311.
[[nodiscard]] Result<AirfoilFigures> airfoil_figures(const Contour& contour);

/// What points in order around an airfoil say without any curve: straight lines between them,
/// measured along the chord of `contour`. Nothing where they do not run along it on both sides.
[[nodiscard]] std::optional<AirfoilPointFigures> airfoil_point_figures(
    std::span<const Vec2> points, const AirfoilFigures& contour);

}  // namespace obvid
