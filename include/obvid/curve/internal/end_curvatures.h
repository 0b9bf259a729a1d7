// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/curve/contour.h"
#include "obvid/curve/pieces.h"

namespace obvid {

/// Signed curvatures wanted at both ends of a piece.
struct WantedCurvatures {
  double start = 0.0;
  double end = 0.0;
};

/// Which numbers of a piece may be changed beside its control points.
enum class InnerWeights { kFixed, kFree };

/// Signed curvature at an end, exactly what the stored numbers say but for the last bits: areas of
/// control points are computed without rounding.
[[nodiscard]] double stored_curvature(const RationalBezier& piece, bool at_start);

/// Signed curvature of a piece at t in [0, 1], per unit of length, with the digits that its numbers
/// have but for the last four: where more of them may cancel in the jet of a Bezier piece (nearly
/// straight ones, their ends), from control points of the part behind t in twice the precision.
[[nodiscard]] double accurate_curvature(const Piece& piece, double t);
/// The same where the jet is at hand.
[[nodiscard]] double accurate_curvature(const Piece& piece, double t, const Jet& jet);

/// Moves inner control points so that the stored curvatures are the wanted ones (degree 2, 4 or 5,
/// positive weights). In a nearly straight piece half a unit of the last bit of a control point is
/// a large part of its distance from the tangent. The doubles around it lie at many other distances
/// though: among those that are up to 1e-6 of the piece farther along the tangent, where they
/// hardly change the curve, there is one at nearly every distance wanted
/// (docs/methods/curve.md). Free inner weights take up what is left. A piece whose ends are right
/// to 1e-10 already (of the curvature; where it is flat beside the other end, of 1e-6 of that
/// one's) stays as it is; one that is stored in plain coordinates may come out with an origin.
/// End points stay; tangents at the ends turn by less than 2e-11 rad.
void keep_end_curvatures(RationalBezier& piece, WantedCurvatures wanted, InnerWeights weights);

/// Makes the stored curvatures of neighbouring Bezier pieces agree at their joint: both become that
/// of the joint's element (`keep_end_curvatures`). Where a joint stands on no point its curvature
/// is the one that the piece before it stores. For contours of one section, before their proof.
void keep_joint_curvatures(Contour& contour);

}  // namespace obvid
