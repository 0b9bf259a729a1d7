// SPDX-License-Identifier: Apache-2.0
// One direction of the tensor product: least squares by splines for rows of points at once.
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/curve/internal/basis.h"
#include "obvid/geom/vec3.h"

namespace obvid {

/// Points in rows of `width`: row i belongs to parameter i (or coefficient i).
struct Rows {
  std::size_t width = 0;
  std::vector<Vec3> points;

  [[nodiscard]] std::size_t count() const { return points.size() / width; }
  [[nodiscard]] Vec3* row(std::size_t i) { return points.data() + i * width; }
  [[nodiscard]] const Vec3* row(std::size_t i) const { return points.data() + i * width; }
};

[[nodiscard]] Rows transposed(const Rows& rows);

/// Bound of coefficients of cubics for data within [-1, 1], one direction. Dense data give 22 to 41
/// (the bound; coefficients themselves reach 5 to 7), two points in each span 60 where they are
/// even. Beyond 100 the surface begins to leave the data between the points.
inline constexpr double kMostSwing = 100.0;
inline constexpr int kMostLineDegree = 5;

/// What is known of a spline at its ends: the point, and as many derivatives as there are more rows
/// (none, one or two). No row: nothing is kept.
struct LineEnds {
  Rows first, last;
};

/// The first and the last coefficients of a spline with these knots, which what is kept determines.
/// False when there are too few for that.
[[nodiscard]] bool end_coefficients(int degree, const std::vector<double>& knots,
                                    const LineEnds& kept, Rows& first, Rows& last);

/// For each inner knot about how far a spline with these coefficients moves without it: the jump of
/// the highest derivative times that power of the mean of its spans, largest of all rows.
[[nodiscard]] std::vector<double> knot_needs(int degree, const std::vector<double>& knots,
                                             const Rows& coefficients);

/// Splines over ascending parameters in [0, 1]. Knots stay such that each coefficient has a
/// parameter of its own under its B-spline (Schoenberg and Whitney), the solution is unique, and
/// such that coefficients cannot swing far beyond the data (`kMostSwing`).
class SplineLine {
 public:
  /// Without inner knots; a lower degree when there are not more parameters than `degree` (at most
  /// `kMostLineDegree`). Coefficients may swing as far as `most_swing`.
  explicit SplineLine(std::vector<double> parameters, int degree = 3,
                      double most_swing = kMostSwing);

  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] const std::vector<double>& knots() const { return knots_; }
  [[nodiscard]] const std::vector<double>& parameters() const { return at_; }
  [[nodiscard]] std::size_t coefficients() const {
    return knots_.size() - static_cast<std::size_t>(degree_) - 1;
  }

  /// Coefficients of least squares for the rows: orthogonal rotations, so that the condition is not
  /// squared. O(points). What is kept at the ends is met exactly. False when the knots are too
  /// close for double precision, or too few for what is kept.
  [[nodiscard]] bool fit(const Rows& data, const LineEnds& kept, Rows& coefficients) const;
  /// Values at the parameters.
  [[nodiscard]] Rows values(const Rows& coefficients) const;

  /// Splits spans whose error (one for each parameter) exceeds the threshold, at a parameter in
  /// their middle, as far as the data determine the halves well. Returns how many were split.
  std::size_t split(const std::vector<double>& errors, double threshold);

  /// The knots of interpolation (not-a-knot).
  void saturate();
  /// Bound of coefficients for data between -1 and 1; exceeds what was allowed only after
  /// `saturate`.
  [[nodiscard]] double swing() const;

  /// `knot_needs` of its inner knots.
  [[nodiscard]] std::vector<double> needs(const Rows& coefficients) const {
    return knot_needs(degree_, knots_, coefficients);
  }
  /// Removes inner knots, by their ascending numbers as in `needs`.
  void remove(const std::vector<std::size_t>& inner);

 private:
  [[nodiscard]] bool determined(const std::vector<double>& knots) const;
  [[nodiscard]] std::vector<double> swings() const;
  std::size_t insert(const std::vector<double>& added);
  void set_knots(std::vector<double> knots);

  int degree_;
  double most_swing_;
  std::vector<double> at_;
  std::vector<double> knots_;
  std::vector<BasisValues> basis_;  ///< at each parameter
};

/// Of the inner knots of each line, by their `SplineLine::needs`: ascending numbers of those that
/// are needed least, at most so many of all lines together. Of two neighbours one stays: without
/// the other it is needed more.
[[nodiscard]] std::vector<std::vector<std::size_t>> least_needed(
    const std::vector<std::vector<double>>& needs, std::size_t most);

}  // namespace obvid
