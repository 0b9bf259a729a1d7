// SPDX-License-Identifier: Apache-2.0
// A contour with all that its own numbers say: ends, joints, laws of curvature, stations, parts.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "contour_file.h"
#include "joints.h"
#include "monotone.h"
#include "region.h"

namespace judge {

/// What lies between two neighbouring stations. Orders count pieces: 2.5 is the middle of piece 2.
struct Part {
  std::size_t from_point = 0, to_point = 0;
  Real from = 0.0L, to = 0.0L;
  std::vector<Real>
      cuts;  ///< from, vertices and corners inside (all joints where it turns far), to
  std::vector<Real> turns;  ///< from, vertices and corners inside, to
};

struct Course {
  Course(const ContourFile& contour);  // NOLINT: a course is a contour seen closely

  const ContourFile& file;
  Point origin;  ///< real numbers are seen from here
  ContourEnds ends;
  std::vector<JointFacts> joints;
  std::vector<CurvatureLaw> laws;
  Path path;
  std::vector<Part> parts;
  std::vector<Real> away;  ///< of each point, from the nearest place of the contour
  bool stations_known = false;

  /// Length below which figures are rounding of the coordinates.
  [[nodiscard]] Real resolution() const;
  /// Element of the contour at an order; at a joint that of the piece behind or before it.
  [[nodiscard]] Element element(Real order, bool behind) const;
  /// Least and greatest curvature within a length of an order, to both sides.
  [[nodiscard]] std::pair<Real, Real> curvatures_near(Real order, Real length) const;
  /// Rounding of a curvature that doubles evaluate: the second derivative of a Bezier piece is a
  /// sum of differences, each wrong by roundings of the piece's own size.
  [[nodiscard]] Real curvature_rounding(Real order) const;
  [[nodiscard]] std::vector<Real> cuts_of(Real from, Real to, bool all_joints) const;
  /// Whether curvature changes one way from order a to order b.
  [[nodiscard]] bool monotone(Real a, Real b) const;
  [[nodiscard]] Real turning(Real a, Real b) const;
  /// The same of the pieces that reach into the stretch, to both sides together.
  [[nodiscard]] Real turning_both_ways(Real a, Real b) const;
};

}  // namespace judge
