// SPDX-License-Identifier: Apache-2.0
// How well neighbouring pieces of a contour fit, proved.
#pragma once

#include <vector>

#include "ball.h"
#include "contour_file.h"
#include "ends.h"

namespace judge {

struct JointFacts {
  bool corner = false;
  bool step = false;        ///< of the curvature: said by the file
  Ball position;            ///< distance of the ends that meet, contour units
  Ball heading;             ///< rad; 0 at corners
  Ball curvature;           ///< of the larger of both (docs/claims.md); 0 at corners and steps
  bool slope_step = false;  ///< said by the file
  Ball slope;    ///< gap of d kappa/ds, of the largest slope of both pieces (docs/claims.md)
  int jump = 0;  ///< sign of the curvature behind less that before
  bool clear_jump = false;  ///< too large to be rounding
};

/// What is called continuous (docs/claims.md).
constexpr double kAngleBound = 1e-6;      // rad
constexpr double kCurvatureBound = 1e-6;  // of the larger curvature
constexpr double kSlopeBound = 1e-6;      // of the largest slope of both pieces

/// How many joints there are of each order, as their gaps say: what the file calls G2 is no G3.
struct JointOrders {
  int corners = 0, steps = 0;
  int g1 = 0, g2 = 0, g3 = 0;  ///< no corners, no steps
  [[nodiscard]] int all() const { return corners + steps + g1 + g2 + g3; }
  /// Of the most continuous ones: 3, 2, 1; 0: there are corners alone, or none.
  [[nodiscard]] int highest() const { return g3 > 0 ? 3 : g2 > 0 ? 2 : g1 + steps > 0 ? 1 : 0; }
};
JointOrders orders_of(const ContourFile& contour, const std::vector<JointFacts>& joints);

struct ContourEnds {
  std::vector<End> start, end;  ///< of each piece
  double size = 0.0;            ///< diagonal of the box around pieces and points
  double coordinate = 0.0;      ///< largest
  double length = 0.0;          ///< of the whole contour, roughly
};

ContourEnds ends_of(const ContourFile& contour);
/// At joint i between piece i - 1 and i; for closed contours joint 0 is the seam.
std::vector<JointFacts> joints_of(const ContourFile& contour, const ContourEnds& ends);

}  // namespace judge
