// SPDX-License-Identifier: Apache-2.0
// Least squares for heights over a rectangle, with the bending of a thin plate.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"

namespace obvid {

/// A height over a place, u and v in [0, 1].
struct HeightPoint {
  double u = 0.0, v = 0.0, height = 0.0;
};

/// Coefficients of a bicubic spline f over [0, 1] x [0, 1]; number i along u in row j along v is
/// `value[j * count_u + i]`.
struct HeightSpline {
  std::vector<double> knots_u, knots_v;  ///< of degree 3, clamped
  std::vector<double> value;

  [[nodiscard]] std::size_t count_u() const { return knots_u.size() - 4; }
  [[nodiscard]] std::size_t count_v() const { return knots_v.size() - 4; }
  [[nodiscard]] double at(double u, double v) const;
};

/// The normal equations of one pair of knot rows: the smallest sum of squares of the residuals plus
/// a weight times the bending, the integral of f_xx^2 + 2 f_xy^2 + f_yy^2 over a rectangle of
/// `width` x `depth` in the unit of the heights (Duchon 1977), integrated exactly.
class HeightFit {
 public:
  HeightFit(const std::vector<HeightPoint>& points, std::vector<double> knots_u,
            std::vector<double> knots_v, double width, double depth);

  /// Weight of the bending that makes the sums of the diagonals of both matrices equal.
  [[nodiscard]] double balance() const { return balance_; }
  /// Nothing when the equations are singular in double precision. Error: E103.
  [[nodiscard]] Result<std::optional<HeightSpline>> solved(double weight,
                                                           const RunContext& run) const;
  [[nodiscard]] double bending(const HeightSpline& spline) const;

 private:
  static constexpr std::size_t kWidth = 4, kHalf = 7;  // B-splines over a place; neighbours of one
  using Stencil = std::array<double, kWidth * kHalf>;  // rows 0 to 3 above, columns -3 to 3
  using Gram = std::vector<std::array<double, kWidth>>;  // of numbers i and i + k

  [[nodiscard]] double plate(std::size_t i, std::size_t j, std::size_t i2, std::size_t j2) const;

  std::vector<double> knots_u_, knots_v_;
  double width_, depth_, balance_ = 0.0;
  std::array<Gram, 3> along_u_, along_v_;  ///< of values, first and second derivatives
  std::vector<Stencil> normal_;
  std::vector<double> right_;
};

}  // namespace obvid
