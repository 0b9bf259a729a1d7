// SPDX-License-Identifier: Apache-2.0
// Control points of a part of one span, and what they bound: how near it can come to a point, and
// whether its distance from a point has one valley there.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "obvid/surface/surface.h"

namespace obvid::nearest_detail {

/// Of g x + h y + (a x^2 + 2 b x y + c y^2) / 2, convex, where it is least in a box that holds
/// (0, 0).
struct Bowl {
  double a = 0.0, b = 0.0, c = 0.0, g = 0.0, h = 0.0;

  [[nodiscard]] double at(double x, double y) const {
    return g * x + h * y + 0.5 * (a * x * x + 2.0 * b * x * y + c * y * y);
  }
  [[nodiscard]] std::array<double, 2> lowest_in(const Range& x, const Range& y) const;
};

/// Vectors that lie within `radius` of `middle`.
struct VectorBall {
  Vec3 middle;
  double radius = 0.0;

  [[nodiscard]] double most() const { return norm(middle) + radius; }
};

/// Where derivatives lie, by parameters from 0 to 1.
struct SpanSlopes {
  VectorBall du, dv, duu, duv, dvv;
};

struct FlatFoot {
  double least = 0.0;       ///< no place of the part is nearer
  double u = 0.0, v = 0.0;  ///< of the part's parameters, from 0 to 1: about where it is nearest
};

class SpanNet {
 public:
  /// `u` and `v` inside one span each.
  SpanNet(const NurbsSurface& surface, const Range& u, const Range& v);

  /// From the flat part beside it, less how far control points are off that.
  [[nodiscard]] FlatFoot flat_foot(Vec3 from) const;
  /// The squared distance is convex over the parameters: one place of the part is nearest, and
  /// downhill leads there.
  [[nodiscard]] bool one_valley(Vec3 from) const;
  [[nodiscard]] bool longer_along_u() const;

 private:
  void bound();
  [[nodiscard]] SpanSlopes slopes() const;

  std::size_t columns_, rows_;
  std::vector<Vec3> points_;
  std::vector<double> weights_;  ///< about 1
  Vec3 middle_, along_u_, along_v_;
  double uneven_ = 0.0;  ///< control points from the flat part
  double reach_ = 0.0;   ///< likewise from the middle
  double weight_off_ = 0.0;
};

}  // namespace obvid::nearest_detail
