// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "part.h"

namespace obvid::toolpath {

/// What a pass follows, over t in [0, 1]: places of the axis seen from above, or a line of
/// parameters that the cutter is to touch.
struct Rail {
  std::vector<Vec2> axis;  ///< not for lines of parameters; equal shares of t between them
  PassPlane plane = PassPlane::kNone;
  std::size_t patch = 0;
  bool along_v = false;
  double fixed = 0.0;  ///< the other parameter
  double from = 0.0, to = 1.0;

  [[nodiscard]] bool of_parameters() const { return axis.empty(); }
  [[nodiscard]] Vec2 axis_at(double t) const;
};

/// Half way between two rails of a family.
[[nodiscard]] Rail between(const Rail& a, const Rail& b);

struct PassPoint {
  double t = 0.0;
  Place place;
  bool lifted = false;
};
/// Stretches where the rail leads over the part.
struct Pass {
  Rail rail;
  std::vector<std::vector<PassPoint>> pieces;
  [[nodiscard]] bool empty() const { return pieces.empty(); }
};

/// Follows rails with points so near to each other that the cutter, moved straight between
/// neighbours, cuts nothing deeper than its share of the tolerance.
class Walker {
 public:
  /// `overrun`: how far the axis may leave open borders.
  Walker(const Part& part, double overrun, std::size_t most_points)
      : part_(part), overrun_(overrun), most_points_(most_points) {}

  /// Errors: E502 more points than allowed, in all passes so far.
  [[nodiscard]] Result<Pass> walk(const Rail& rail);
  /// A straight way on the surface; nothing: it leads where there is nothing to go on.
  [[nodiscard]] std::optional<std::vector<Vec3>> link(Vec3 from, Vec3 to);

 private:
  struct Step;
  [[nodiscard]] std::optional<PassPoint> at(const Rail& rail, double t) const;
  [[nodiscard]] std::optional<PassPoint> touching(const Rail& rail, double t) const;
  [[nodiscard]] std::optional<PassPoint> resting(Vec2 axis, double t) const;
  [[nodiscard]] bool near_enough(Vec3 a, Vec3 b) const;
  [[nodiscard]] bool straight(Vec3 a, Vec3 middle, Vec3 b) const;
  void append(Step& step, const PassPoint& p);
  [[nodiscard]] std::vector<double> stations(const Rail& rail) const;
  void fill(Step& step, const std::optional<PassPoint>& a, double ta,
            const std::optional<PassPoint>& b, double tb, int depth);

  const Part& part_;
  double overrun_;
  std::size_t most_points_;
  std::size_t points_ = 0;
};

}  // namespace obvid::toolpath
