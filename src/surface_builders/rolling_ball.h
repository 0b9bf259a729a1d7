// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/surface/internal/trim.h"
#include "obvid/surface/surface.h"
#include "offset_raster.h"

namespace obvid {

/// A face that a ball rolls on, with the side that the ball is on. Beyond its borders the spans go
/// on; one that closes on itself goes around.
class BallFace {
 public:
  /// `side` 1: where du x dv points to, -1: the other.
  BallFace(const SurfacePatch& patch, double side, double size);

  [[nodiscard]] SurfaceJet jet(Vec2 at) const;
  [[nodiscard]] Vec2 into_domain(Vec2 at) const;  ///< by whole turns
  [[nodiscard]] bool inside(Vec2 at) const;
  [[nodiscard]] bool is_trimmed() const { return region_.has_value(); }
  /// How much the face bends towards the ball, 1/unit; 0 where it bends away.
  [[nodiscard]] double bend(Vec2 at) const;
  [[nodiscard]] const SurfacePatch& patch() const { return patch_; }
  [[nodiscard]] double side() const { return side_; }
  [[nodiscard]] Vec2 sizes() const { return {u_.length(), v_.length()}; }

 private:
  const SurfacePatch& patch_;
  double side_;
  Bending bending_;
  Range u_, v_;
  bool closed_u_ = false, closed_v_ = false;
  std::optional<TrimRegion> region_;  ///< of trimmed ones
};

/// Where a ball touches a face.
struct BallTouch {
  Vec2 at;
  Vec3 point;
  Vec3 inwards;  ///< to the centre, length 1
};

/// The ball at a place of its way.
struct BallPlace {
  double s = 0.0;  ///< arc length of the spine, units
  double radius = 0.0;
  Vec3 centre;
  Vec3 along;  ///< of the spine, length 1: inwards of the first face x that of the second
  std::array<BallTouch, 2> touch;
};

/// A ball whose radius is linear along its way between two faces.
class RollingBall {
 public:
  RollingBall(const BallFace& first, const BallFace& second, double radius, double slope,
              double size)
      : faces_{&first, &second}, radius_(radius), slope_(slope), size_(size) {}

  [[nodiscard]] double radius_at(double s) const { return radius_ + slope_ * s; }
  [[nodiscard]] double slope() const { return slope_; }
  /// The ball whose centre lies in a plane, from places near where it touches (Newton's method).
  [[nodiscard]] std::optional<BallPlace> in_plane(std::array<Vec2, 2> near, double s, Vec3 point,
                                                  Vec3 normal) const;
  /// The ball farther along the spine by h, which may be negative: a step of Runge and Kutta's
  /// method, corrected.
  [[nodiscard]] std::optional<BallPlace> stepped(const BallPlace& from, double h) const;
  [[nodiscard]] const BallFace& face(std::size_t i) const { return *faces_[i]; }
  [[nodiscard]] double size() const { return size_; }

 private:
  struct Offset;
  struct Motion {
    Vec3 along;
    std::array<Vec2, 2> by{};
  };
  [[nodiscard]] std::optional<Offset> offset(std::size_t face, Vec2 at, double radius) const;
  [[nodiscard]] std::optional<Motion> motion(const std::array<Vec2, 2>& at, double s) const;

  std::array<const BallFace*, 2> faces_;
  double radius_, slope_, size_;
};

/// The way of a ball from end to end.
struct BallWay {
  std::vector<BallPlace> places;  ///< s ascending; closed: the last is the first again
  bool closed = false;
  std::array<Range, 2> on;  ///< s between which the ball touches each face inside its borders
};

/// From a place inside both faces to where the ball has left both, on both sides; s of the start
/// stays. Errors: E310 a face is left long before the other, E408 the ball cannot go on; E103.
[[nodiscard]] Result<BallWay> way_of(const RollingBall& ball, const BallPlace& start,
                                     const RunContext& run);

/// The ball anywhere on its way.
[[nodiscard]] std::optional<BallPlace> place_at(const RollingBall& ball, const BallWay& way,
                                                double s);

/// "near x y z"
[[nodiscard]] std::string near_text(Vec3 p);

}  // namespace obvid
