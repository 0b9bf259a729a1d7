// SPDX-License-Identifier: Apache-2.0
// What a printed program leaves of a stock and cuts into a part, by formulas and loops of the
// tests' own: no line of the library's simulation is used.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "nc_interpreter.h"

namespace obvid::test {

/// A mill by its radius and the radius of its corner, tip in the origin.
struct Mill {
  double radius, corner;

  /// How far a point lies from the body; negative inside.
  [[nodiscard]] double gap(Vec3 p) const {
    const double level = std::hypot(p.x, p.y), ring = radius - corner;
    if (p.z >= corner && level <= radius)
      return std::max(level - radius, level > ring ? level - radius : -p.z);
    if (level <= ring) return -p.z;
    return p.z >= corner ? level - radius : std::hypot(level - ring, corner - p.z) - corner;
  }
  /// Height of the body's lower side over the tip.
  [[nodiscard]] double rise(double level) const {
    const double out = std::max(0.0, level - (radius - corner));
    return corner - std::sqrt(std::max(0.0, corner * corner - out * out));
  }
};

/// Points in square columns.
class Columns {
 public:
  Columns(const std::vector<Vec3>& points, double size) : size_(size) {
    low_ = high_ = {points.front().x, points.front().y};
    for (const Vec3 p : points) {
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
      high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
    }
    nx_ = number(high_.x - low_.x) + 1;
    ny_ = number(high_.y - low_.y) + 1;
    cells_.resize(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_));
    for (const Vec3 p : points) cell(number(p.x - low_.x), number(p.y - low_.y)).push_back(p);
  }

  /// All points nearer than `reach` seen from above, and some more.
  template <class Look>
  void near(Vec3 p, double reach, const Look& look) {
    const int x1 = std::min(nx_ - 1, number(p.x + reach - low_.x));
    const int y1 = std::min(ny_ - 1, number(p.y + reach - low_.y));
    for (int y = std::max(0, number(p.y - reach - low_.y)); y <= y1; ++y) {
      for (int x = std::max(0, number(p.x - reach - low_.x)); x <= x1; ++x) {
        for (const Vec3 q : cell(x, y)) look(q);
      }
    }
  }

 private:
  [[nodiscard]] int number(double d) const { return static_cast<int>(std::floor(d / size_)); }
  std::vector<Vec3>& cell(int x, int y) {
    return cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) +
                  static_cast<std::size_t>(x)];
  }

  double size_;
  Vec2 low_, high_;
  int nx_ = 0, ny_ = 0;
  std::vector<std::vector<Vec3>> cells_;
};

/// A point of a part with its normal, upwards.
struct Sample {
  Vec3 point, normal;
};

/// Places of a mill's tip.
class Cut {
 public:
  Cut(Mill mill, const std::vector<Vec3>& tips) : mill_(mill), tips_(tips, 0.5 * mill.radius) {}

  /// How deep the mill goes into the part at a point, at most.
  double depth(Vec3 p) {
    double deepest = 0.0;
    tips_.near(p, mill_.radius,
               [&](Vec3 tip) { deepest = std::max(deepest, -mill_.gap(p - tip)); });
    return deepest;
  }
  /// What stays over a point along its normal, up to `most`.
  double left(const Sample& s, double most) {
    double left = most;
    tips_.near(s.point, mill_.radius + most, [&](Vec3 tip) {
      // distances from convex bodies are convex along the normal: Newton's method comes from
      // outside, and where it comes no nearer the body is never met
      constexpr double kNear = 1e-5, kAlong = 1e-7;
      double up = 0.0;
      for (int k = 0; k < 50 && up < left; ++k) {
        const double gap = mill_.gap(s.point + up * s.normal - tip);
        if (gap <= kNear) {
          left = up;
          break;
        }
        const double nearer = gap - mill_.gap(s.point + (up + kAlong) * s.normal - tip);
        if (!(nearer > 0.0)) break;
        up += std::max(1.0, kAlong / nearer) * gap;
      }
    });
    return left;
  }

 private:
  Mill mill_;
  Columns tips_;
};

inline std::vector<Vec3> tips_of(const NcRun& run) {
  std::vector<Vec3> out;
  for (const NcMove& move : run.moves)
    out.insert(out.end(), move.points.begin(), move.points.end());
  return out;
}

/// Tips of a mill that rests on points of a part, on a raster of axes that leads over its borders.
inline std::vector<Vec3> resting(const std::vector<Sample>& part, Mill mill, double raster) {
  std::vector<Vec3> points;
  Vec2 low{1e9, 1e9}, high{-1e9, -1e9};
  for (const Sample& s : part) {
    points.push_back(s.point);
    low = {std::min(low.x, s.point.x), std::min(low.y, s.point.y)};
    high = {std::max(high.x, s.point.x), std::max(high.y, s.point.y)};
  }
  Columns columns(points, 0.5 * mill.radius);
  std::vector<Vec3> out;
  for (double y = low.y - mill.radius; y <= high.y + mill.radius; y += raster) {
    for (double x = low.x - mill.radius; x <= high.x + mill.radius; x += raster) {
      std::optional<double> z;
      columns.near({x, y, 0.0}, mill.radius, [&](Vec3 p) {
        const double level = std::hypot(p.x - x, p.y - y);
        if (level <= mill.radius) z = std::max(z.value_or(-1e9), p.z - mill.rise(level));
      });
      if (z) out.push_back({x, y, *z});
    }
  }
  return out;
}

}  // namespace obvid::test
