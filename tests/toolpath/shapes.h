// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "obvid/surface/surface.h"
#include "obvid/surface_builders/internal/grid.h"

namespace obvid::test {

/// Interpolates z = f(x, y) over [x0, x1] x [y0, y1] with n by n points.
inline NurbsSurface surface_of(const std::function<double(double, double)>& f, Vec2 low, Vec2 high,
                               std::size_t n) {
  PointGrid grid;
  grid.count_u = grid.count_v = n;
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      const double s = static_cast<double>(i) / static_cast<double>(n - 1);
      const double t = static_cast<double>(j) / static_cast<double>(n - 1);
      const double x = low.x + s * (high.x - low.x), y = low.y + t * (high.y - low.y);
      grid.points.push_back({x, y, f(x, y)});
    }
  }
  return *interpolated(grid, Spread::kUniform);
}

/// Flat four-cornered patch.
inline NurbsSurface plate(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  NurbsSurface s;
  s.degree_u = s.degree_v = 1;
  s.knots_u = s.knots_v = {0, 0, 1, 1};
  s.points = {a, b, c, d};
  return s;
}

inline SurfaceModel model_of(std::vector<NurbsSurface> surfaces) {
  SurfaceModel model;
  for (NurbsSurface& s : surfaces) model.patches.push_back({"patch", std::move(s)});
  return model;
}

}  // namespace obvid::test
