// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "known_pieces.h"
#include "obvid/certify/certificate.h"
#include "obvid/curve/contour.h"
#include "piece_facts.h"

namespace obvid {

/// What the ends of the pieces say: gaps, jumps of curvature, inflections.
struct JointSurvey {
  JointGaps gaps;
  bool within_bounds = true;
  bool meeting = true;                       ///< every gap of position is within its bound
  std::string reason;                        ///< first gap beyond its bound
  std::optional<std::size_t> loose_joint{};  ///< where it is
  std::vector<std::int8_t> jump;  ///< sign of the curvature's jump at the start of each piece
  int joints = 0;                 ///< places at which two pieces meet
  int inflections = 0;
  int corners = 0;
  int curvature_steps = 0;
  int slope_steps = 0;
  std::vector<std::size_t> loose_slopes;  ///< joints of a G3 contour with a gap beyond its bound
};

/// How pieces bend whose ends do not tell it, by their indices.
using PieceBends = std::map<std::size_t, std::vector<SignFrom>>;

/// `bends`: of the pieces with vertices. `known`: null, or what is known of every piece.
[[nodiscard]] JointSurvey survey_joints(const Contour& contour, const PieceBends& bends = {},
                                        const std::vector<KnownPiece>* known = nullptr);

/// There are points, no two neighbours the same; joints stand on them in their order, around the
/// end of the list in a closed contour. Without tolerances every point is the source of one joint,
/// which stands exactly on it. Empty when so, else the first that is not.
[[nodiscard]] std::string missed_point(const Contour& contour);

}  // namespace obvid
