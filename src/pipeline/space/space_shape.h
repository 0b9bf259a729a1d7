// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/curve/internal/contour_path.h"
#include "obvid/pipeline/space_fit.h"

namespace obvid::pipeline_detail {

/// Place of a space curve with what its arc length's derivatives say.
struct SpacePlace {
  Vec3 point;
  double plan_length = 0.0;
  double height = 0.0;
  double curvature = 0.0;
  std::optional<double> torsion;  ///< nothing where the curvature is 0
  Vec3 tangent{};                 ///< length 1
};

/// The curve on the cylinder over a plane contour whose unrolled shape is another one, by its arc
/// length. Outlived by both contours.
///
/// With t, n tangent and left normal of the plane contour, kappa its curvature, d the direction of
/// heights, phi and g heading and curvature of the unrolled curve: T = cos(phi) t + sin(phi) d,
/// T' = g E + cos(phi)^2 kappa n with E = -sin(phi) t + cos(phi) d.
class SpaceShape {
 public:
  SpaceShape(const Frame& frame, const Contour& plan, const Contour& unrolled)
      : frame_(frame), plan_(plan.pieces), unrolled_(unrolled.pieces) {}

  [[nodiscard]] double length() const { return unrolled_.length(); }
  /// Of a closed curve: gaps between the end of the unrolled one and its start.
  [[nodiscard]] SpaceSeam seam() const;
  /// What is called continuous there, as at the joints of a contour (docs/claims.md): position
  /// 1e-12 or the rounding of the height, heading and curvature 1e-6.
  [[nodiscard]] SpaceSeam seam_bounds() const;
  [[nodiscard]] SpacePlace at(double sigma, bool before_joint = false) const;
  /// Arc length at which the projection has run so far; the unrolled curve must not run back.
  [[nodiscard]] double where(double plan_length) const;
  /// Joints of both contours, ascending, with both ends.
  [[nodiscard]] std::vector<double> joints() const;
  /// Curvature of both contours at a place.
  struct Curvatures {
    double plan = 0.0, unrolled = 0.0, slope = 0.0;  ///< slope: phi, rad
  };
  [[nodiscard]] Curvatures curvatures(double sigma, bool before_joint) const;

  [[nodiscard]] const ContourPath& plan() const { return plan_; }
  [[nodiscard]] const ContourPath& unrolled() const { return unrolled_; }

 private:
  /// Of the plane contour; a place that is a joint of it but for rounding is that joint.
  [[nodiscard]] Jet below(double plan_length, bool before_joint) const;

  Frame frame_;
  ContourPath plan_, unrolled_;
};

/// How far a cubic by arc length is from the curve at most, apart from rounding. Between two places
/// a distance d apart the distance of both, by the same parameter, is above the chord over its
/// values there by at most (largest second derivatives) d^2 / 8: the places are so close that this
/// is at most `between`.
[[nodiscard]] double distance_bound(const SpaceShape& shape, const SpaceCurve& cubic,
                                    double between, Watch* watch = nullptr);

/// The points of the projection in the order in which their heights stand over it: a closed one may
/// begin at any of its points, and the last height is that of the first one again.
class HeightOrder {
 public:
  explicit HeightOrder(const Contour& plan)
      : count_(plan.points.size()),
        closed_(plan.closed),
        first_(closed_ ? plan.joints.front().source.value_or(0) : 0) {}

  [[nodiscard]] std::size_t size() const { return closed_ ? count_ + 1 : count_; }
  [[nodiscard]] std::size_t point(std::size_t k) const { return (first_ + k) % count_; }

 private:
  std::size_t count_;
  bool closed_;
  std::size_t first_;
};

/// Whether no gap is beyond its bound; not where a gap is no number.
[[nodiscard]] bool meets(const SpaceSeam& seam, const SpaceSeam& bounds);

/// Everything that follows from frame, points and both contours: the figures of `fit`.
[[nodiscard]] Result<void> measure(SpaceFit& fit);

/// Ends of a series that are corners of a chain: neither they nor the curve move there.
struct SpaceEnds {
  bool first_is_corner = false, last_is_corner = false;
};

/// Whether a series is formed in a plane, and which: that of least squares, with corners the one
/// through both ends.
struct PlaneOfSpace {
  Frame frame;
  double flatness = 0.0;  ///< largest distance of a point from it
  bool holds = false;
};
[[nodiscard]] PlaneOfSpace plane_of_space(const SpaceSeries& series, const SpaceJob& job,
                                          const SpaceEnds& ends);

/// Whether the last point is the first one again but for noise and print.
[[nodiscard]] bool returns_in_space(const SpaceSeries& series, const FitJob& job);

/// Whether more than corners is asked for at points.
[[nodiscard]] bool fixes_space_data(const SpaceJob& job);

/// One curve without corners, or a planar one; errors as `fit_space`. Two points are a line.
[[nodiscard]] Result<SpaceFit> form_in_space(const SpaceSeries& series, const SpaceJob& job,
                                             const SpaceEnds& ends, const RunContext& run);

}  // namespace obvid::pipeline_detail
