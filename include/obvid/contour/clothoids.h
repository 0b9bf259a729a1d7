// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <vector>

#include "obvid/chain/internal/chain.h"
#include "obvid/core/result.h"
#include "obvid/curve/pieces.h"
#include "obvid/geom/element.h"

namespace obvid {

/// The clothoid with given end points and headings (G1 Hermite), of all such clothoids the one
/// that turns least: both headings count as at most half a turn from the chord. `theta0` of the
/// piece is the given one.
///
/// Newton's method for one unknown from a start within 1e-3 of it: two or three steps
/// (Bertolazzi, Frego, "G1 fitting with clothoids", 2015, show that the solution is unique).
/// End point met to 1e-14 of the chord while the clothoid is at most ten chords long. Nothing when
/// the points coincide or a number is not finite.
[[nodiscard]] std::optional<ClothoidPiece> clothoid_between(Vec2 start, double theta0, Vec2 end,
                                                            double theta1);

/// Headings given at the ends of a series, rad.
struct EndHeadings {
  std::optional<double> start;
  std::optional<double> end;
};

/// Headings by the neighbour rule of [002]: at an inner point the heading of the chord between
/// its neighbours; at an end the given one, or that of the circle which leads to the neighbour's.
/// Unwrapped along the series. At least two distinct points, neighbours distinct.
[[nodiscard]] std::vector<double> neighbour_headings(const std::vector<Vec2>& points,
                                                     const EndHeadings& ends = {});

/// One clothoid per chord with the given headings (G1: curvature jumps at the joints).
/// Errors: E201 when headings and points differ in number; E313 when a chord has no length.
[[nodiscard]] Result<std::vector<ClothoidPiece>> g1_clothoids(const std::vector<Vec2>& points,
                                                              const std::vector<double>& headings);

/// A G2 clothoid spline: one clothoid per chord, curvature continuous.
struct ClothoidSpline {
  std::vector<Element> elements;  ///< at the points; headings unwrapped
  std::vector<ClothoidPiece> pieces;
  int newton_steps = 0;
};

/// The G2 clothoid spline through the points: headings such that curvature is continuous, by
/// Newton's method with a tridiagonal matrix, O(n) per step. An end without a given heading is
/// natural in the sense that sharpness is the same on the last two chords (one clothoid through
/// the last three points). Curvature is linear on each chord, not monotone along the series: what
/// it does between the chords is up to the points.
/// Errors: E304 fewer than three points; E313 a chord without length; E402 chords that turn back;
/// E501 Newton's method did not converge (`value`: the curvature jump left, times the chord).
[[nodiscard]] Result<ClothoidSpline> clothoid_spline(const std::vector<Vec2>& points,
                                                     const EndHeadings& ends = {});

/// Appends three clothoids over a link with given end elements: curvature piecewise linear,
/// monotone, equal to that of the elements at the ends (G2). `direction` +1 when it increases. One
/// that turns by more than about 140 degrees is appended in parts of equal length. End points are
/// stored exactly and met to 1e-14 of the chord. Curvature is strictly monotone as long as doubles
/// can tell the curvatures apart.
///
/// Returns false, appending nothing, when no such three clothoids were found.
[[nodiscard]] bool append_clothoids(const LinkState& link, int direction, const Element& start,
                                    const Element& end, std::vector<ClothoidPiece>& pieces);

}  // namespace obvid
