// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

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
  int corners = 0;              ///< joints that are continuous in position only
  int curvature_steps = 0;      ///< joints with a common tangent whose curvature is said to step
  int slope_steps = 0;          ///< joints of a G3 contour that are said to be G2 only
  std::vector<std::size_t> loose_slopes{};  ///< joints of one whose gap is beyond its bound
  int vertices = 0;
  int inflections = 0;
  int self_intersections = 0;
  bool proved = false;
  std::string reason;  ///< empty when proved, else the first claim that failed
};

}  // namespace obvid
