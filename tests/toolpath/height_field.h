// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "nc_interpreter.h"

namespace obvid::test {

/// Heights over a raster of places. Cutters are told by diameter and corner radius alone.
struct HeightField {
  double x0, y0, step;
  int nx, ny;
  std::vector<double> z;

  HeightField(Vec2 low, Vec2 high, double spacing, double height)
      : x0(low.x),
        y0(low.y),
        step(spacing),
        nx(static_cast<int>(std::lround((high.x - low.x) / spacing)) + 1),
        ny(static_cast<int>(std::lround((high.y - low.y) / spacing)) + 1),
        z(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), height) {}

  [[nodiscard]] double& at(int i, int j) {
    return z[static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) +
             static_cast<std::size_t>(i)];
  }
  [[nodiscard]] Vec2 place(int i, int j) const { return {x0 + i * step, y0 + j * step}; }

  void fill(const std::function<double(double, double)>& f) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) at(i, j) = f(place(i, j).x, place(i, j).y);
    }
  }

  /// Calls what(height of the node, height of the cutter's body over its tip) under the cutter.
  template <class What>
  void under(Vec2 axis, double diameter, double corner, const What& what) {
    const double r = 0.5 * diameter, flat = r - corner;
    const int i0 = std::max(0, static_cast<int>(std::ceil((axis.x - r - x0) / step)));
    const int i1 = std::min(nx - 1, static_cast<int>(std::floor((axis.x + r - x0) / step)));
    const int j0 = std::max(0, static_cast<int>(std::ceil((axis.y - r - y0) / step)));
    const int j1 = std::min(ny - 1, static_cast<int>(std::floor((axis.y + r - y0) / step)));
    for (int j = j0; j <= j1; ++j) {
      for (int i = i0; i <= i1; ++i) {
        const Vec2 p = place(i, j);
        const double d2 = (p.x - axis.x) * (p.x - axis.x) + (p.y - axis.y) * (p.y - axis.y);
        if (d2 > r * r) continue;
        const double out = std::max(0.0, std::sqrt(d2) - flat);
        what(at(i, j), corner - std::sqrt(std::max(0.0, corner * corner - out * out)));
      }
    }
  }

  void cut(Vec3 tip, double diameter, double corner) {
    under({tip.x, tip.y}, diameter, corner,
          [&](double& node, double body) { node = std::min(node, tip.z + body); });
  }
  /// How deep points of a part (these heights) lie inside a cutter at this tip, at most.
  double depth(Vec3 tip, double diameter, double corner) {
    double deepest = 0.0;
    const double r = 0.5 * diameter;
    under({tip.x, tip.y}, diameter, corner, [&](double& node, double body) {
      const double up = node - tip.z;  // of the point over the tip
      if (up <= body) return;
      // body = corner - sqrt(corner^2 - out^2): how far out the point lies
      const double out = std::sqrt(std::max(0.0, body * (2.0 * corner - body)));
      const double side = corner - out;  // from the point to the cylinder, for points that far out
      double inside = out > 0.0 && up < corner ? corner - std::hypot(out, corner - up) : up;
      if (out > 0.0 && up >= corner) inside = side;
      deepest = std::max(deepest, std::min(inside, r));
    });
    return deepest;
  }
  double depth(const NcRun& run, double diameter, double corner) {
    double deepest = 0.0;
    for (const NcMove& move : run.moves) {
      for (const Vec3 p : move.points) deepest = std::max(deepest, depth(p, diameter, corner));
    }
    return deepest;
  }
  void cut(const NcRun& run, double diameter, double corner) {
    for (const NcMove& move : run.moves) {
      if (move.code == 0) continue;
      for (const Vec3 p : move.points) cut(p, diameter, corner);
    }
  }
};

/// The lowest that a cutter can reach without going below `part`: from all places of a raster that
/// leads over the part by `over`.
inline HeightField lowest_reachable(HeightField part, double diameter, double corner, double over) {
  const Vec2 low = part.place(0, 0), high = part.place(part.nx - 1, part.ny - 1);
  HeightField out(low, high, part.step, 1e9);
  const double edge = part.step * std::ceil(over / part.step);
  for (double y = low.y - edge; y <= high.y + edge + 1e-9; y += part.step) {
    for (double x = low.x - edge; x <= high.x + edge + 1e-9; x += part.step) {
      double tip = -1e9;
      part.under({x, y}, diameter, corner,
                 [&](double& node, double body) { tip = std::max(tip, node - body); });
      if (tip > -1e8) out.cut({x, y, tip}, diameter, corner);
    }
  }
  return out;
}

}  // namespace obvid::test
