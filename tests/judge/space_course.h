// SPDX-License-Identifier: Apache-2.0
// The curve in space that a file of format obvid-space-curve describes, from its own numbers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "course.h"
#include "json_text.h"
#include "space_nurbs.h"

namespace judge {

struct SpaceFrame {
  Vec3 origin, x, y, normal;

  [[nodiscard]] Vec3 at(Vec p) const { return origin + p.x * x + p.y * y; }
  [[nodiscard]] Vec in_plane(Vec3 p) const { return {dot(p - origin, x), dot(p - origin, y)}; }
  [[nodiscard]] Real height(Vec3 p) const { return dot(p - origin, normal); }
};

/// A plane path by its arc length.
class Lengths {
 public:
  explicit Lengths(const Path& path);
  [[nodiscard]] Real whole() const { return at_joint_.back(); }
  [[nodiscard]] Real joint(std::size_t i) const { return at_joint_[i]; }
  [[nodiscard]] Real of(Real order) const;
  /// Where so much length has been run; at a joint (within rounding) the end of the span before it.
  [[nodiscard]] Place place(Real length, bool before) const;

 private:
  struct Cell {
    Real t = 0.0L, length = 0.0L;  ///< from the start of the path
  };
  [[nodiscard]] Real inside(std::size_t span, Real t) const;
  Real lay(const Span& span, Real a, Real b, Real whole, int left, Real before);

  const Path& path_;
  std::vector<std::vector<Cell>> cells_;  ///< of each span: where Gauss's rule is exact in between
  std::vector<Real> at_joint_;
};

/// A contour with its course, which refers to it: neither is moved.
struct OwnedCourse {
  explicit OwnedCourse(const Json& json);  ///< std::runtime_error where it is none

  ContourFile file;
  Course course;
  Lengths lengths;
};

struct SpaceCourse {
  bool planar = false;
  std::string units, units_source;
  SpaceFrame frame;
  std::vector<Vec3> points;
  std::unique_ptr<OwnedCourse> plan, heights;  ///< the latter of curves that are not planar
  SpaceNurbs nurbs;
  Real size = 0.0L, coordinate = 0.0L;

  /// At an order of the unrolled contour; by its native parameter. `before`: at a joint of either
  /// contour the side before it.
  [[nodiscard]] SpaceJet at(Real order, bool before) const;
  /// Orders of the unrolled contour at which either contour has a joint, with both ends.
  [[nodiscard]] std::vector<Real> joints() const;
  /// Point over which a height stands: a closed projection may begin at any of its points.
  [[nodiscard]] std::size_t point_below(std::size_t height) const;
  /// Height of a point; the first one where there are two.
  [[nodiscard]] std::size_t height_of(std::size_t point) const;
  /// Distances below this are rounding.
  [[nodiscard]] Real resolution() const;
  [[nodiscard]] std::string printed_unit() const {
    return units_source == "assumed" ? "units" : units;
  }
};

struct ReadSpace {
  std::unique_ptr<SpaceCourse> curve;
  std::string fault;  ///< empty: it could be read
};
ReadSpace read_space(const Json& json);

}  // namespace judge
