// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hermite_spline.h"
#include "obvid/core/result.h"
#include "obvid/idspline/internal/scalar_cubic.h"
#include "skin_marks.h"

namespace obvid {

/// One section between two matched corners, over the common parameter u in [0, 1]: a C2 curve.
///
/// Where a section closes smoothly and the stretch is all of it, the curve does so, too.
///
/// Arc length depends on u by a C2 function that is the identity where the section's marks lie like
/// the average of all sections, and monotone always.
class SectionCurve {
 public:
  /// `at`: common parameters of the stretch's marks.
  [[nodiscard]] static Result<SectionCurve> make(const MeasuredSection& section,
                                                 const std::vector<double>& marks,
                                                 const std::vector<double>& at);

  [[nodiscard]] Hermite at(double u) const;
  /// Arc length of the contour and its first two derivatives by u.
  struct Length {
    double s = 0.0, ds = 0.0, dds = 0.0;
  };
  [[nodiscard]] Length length_at(double u) const;
  /// Common parameter of an arc length; of a mark exactly.
  [[nodiscard]] double parameter_of(double s) const;
  [[nodiscard]] const Frame& frame() const { return frame_; }
  /// Of the section's points in space, units: what their rounding belongs to.
  [[nodiscard]] double largest_coordinate() const { return largest_coordinate_; }
  [[nodiscard]] bool is_point() const { return path_ == nullptr; }

 private:
  const ContourPath* path_ = nullptr;
  Frame frame_;
  Vec3 point_;  ///< of a section that is a point
  std::vector<double> u_, s_, slope_;
  double largest_coordinate_ = 0.0;
  ScalarCubic height_;  ///< over the plane, by arc length; no nodes: plane
};

}  // namespace obvid
