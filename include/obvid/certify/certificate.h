// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/curve/carrier.h"

namespace obvid {

/// What is proved about the curvature of one piece.
enum class Verdict { kIncreasing, kDecreasing, kConstant, kHasVertex, kUndecided };

[[nodiscard]] const char* to_string(Verdict verdict);

/// Verdict with its evidence.
struct PieceProof {
  Verdict verdict = Verdict::kUndecided;
  bool exact_arithmetic = false;  ///< the fast floating-point bound could not decide
  double t0 = 0.0;                ///< has-vertex, undecided: parameter interval in question
  double t1 = 1.0;
  bool turns_below_half = true;  ///< proved: the piece turns by less than half a turn
};

/// Upper bounds of the gaps at the joints of the numbers as they stand. Position relative to the
/// contour's size, heading in radians, curvature relative to the larger of the two at the joint
/// (but not less than 1e-6 of the largest at the four ends of the two pieces). Slope of curvature,
/// d kappa/ds, relative to the largest of the two pieces (at their ends, and the mean over their
/// chords), where G3 is claimed.
struct JointGaps {
  double position = 0.0;
  double heading = 0.0;
  double curvature = 0.0;
  std::optional<double> slope{};
};

/// What is called continuous (docs/claims.md): gaps up to these, in rad, of the curvature, and of
/// the largest slope of the two pieces.
inline constexpr double kContinuousHeading = 1e-6;
inline constexpr double kContinuousCurvature = 1e-6;
inline constexpr double kContinuousSlope = 1e-6;

/// Everything that was proved about a contour (docs/methods/certify.md).
struct Certificate {
  std::vector<PieceProof> pieces;
  JointGaps gaps;
  bool gaps_within_bounds = false;  ///< position 1e-12 (or what the coordinates' rounding
                                    ///< explains), heading and curvature and slope 1e-6
  bool inside_region = false;
  bool through_points = false;  ///< every input point is met in order, exactly or within its
                                ///< tolerance where it has one
  double largest_move = 0.0;    ///< proved bound of the distance of a point with a tolerance, units
  int joints = 0;               ///< places at which two pieces meet
  int corners = 0;              ///< joints that are continuous in position only
  int curvature_steps = 0;      ///< joints with a common tangent whose curvature is said to step
  int slope_steps = 0;          ///< joints of a G3 contour that are said to be G2 only
  /// Joints whose slope of curvature goes on, too.
  [[nodiscard]] int smooth_joints() const {
    return gaps.slope ? joints - corners - curvature_steps - slope_steps : 0;
  }
  std::vector<std::size_t> loose_slopes{};   ///< joints of one whose gap is beyond its bound
  std::optional<std::size_t> loose_joint{};  ///< the first with any gap beyond its bound
  int vertices = 0;
  int inflections = 0;
  int self_intersections = 0;
  bool proved = false;
  /// Empty when proved, else the first claim that failed; of carriers that promise no monotone
  /// curvature a claim on joints or points goes before one on curvature inside pieces.
  std::string reason;
};

/// Whether a contour is what its carrier promises: proved, or without gaps through its points.
[[nodiscard]] inline bool keeps_promise(Carrier carrier, const Certificate& certificate) {
  if (promises_monotone(carrier)) return certificate.proved;
  return certificate.gaps_within_bounds && certificate.through_points;
}

}  // namespace obvid
