// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "obvid/pipeline/skin_sections.h"

namespace obvid {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Columns: directions of a symmetric matrix, by rotations of Jacobi until nothing is left beside
/// the diagonal.
Matrix directions_of(Matrix a) {
  Matrix v = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  constexpr int kSweeps = 50;  // converges quadratically: some six are enough
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const auto& [p, q] : std::array<std::array<std::size_t, 2>, 3>{{{0, 1}, {0, 2}, {1, 2}}}) {
      if (a[p][q] == 0.0) continue;
      const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
      const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::hypot(theta, 1.0));
      const double c = 1.0 / std::hypot(t, 1.0), s = t * c;
      for (std::size_t k = 0; k < 3; ++k) {
        const double kp = a[k][p], kq = a[k][q];
        a[k][p] = c * kp - s * kq;
        a[k][q] = s * kp + c * kq;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const double pk = a[p][k], qk = a[q][k];
        a[p][k] = c * pk - s * qk;
        a[q][k] = s * pk + c * qk;
        const double vp = v[k][p], vq = v[k][q];
        v[k][p] = c * vp - s * vq;
        v[k][q] = s * vp + c * vq;
      }
      a[p][q] = a[q][p] = 0.0;
    }
  }
  // largest spread first
  std::array<std::size_t, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return a[i][i] > a[j][j]; });
  Matrix sorted{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t j = 0; j < 3; ++j) sorted[k][j] = v[k][order[j]];
  }
  return sorted;
}

bool all_equal(const std::vector<Vec3>& points, double Vec3::*coordinate) {
  return std::all_of(points.begin(), points.end(),
                     [&](const Vec3& p) { return p.*coordinate == points.front().*coordinate; });
}

Vec3 column(const Matrix& m, std::size_t j) { return {m[0][j], m[1][j], m[2][j]}; }

/// With its largest coordinate positive, so that neighbouring sections are seen from one side.
Vec3 upright(Vec3 a) {
  const double largest = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
  const double lead = std::abs(a.x) == largest ? a.x : std::abs(a.y) == largest ? a.y : a.z;
  return lead < 0.0 ? -a : a;
}

}  // namespace

Frame plane_of(const std::vector<Vec3>& points) {
  if (points.empty() || all_equal(points, &Vec3::z)) {
    return {{0, 0, points.empty() ? 0.0 : points.front().z}, {1, 0, 0}, {0, 1, 0}};
  }
  if (all_equal(points, &Vec3::x)) return {{points.front().x, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  if (all_equal(points, &Vec3::y)) return {{0, points.front().y, 0}, {0, 0, 1}, {1, 0, 0}};
  Vec3 centre;
  for (const Vec3& p : points) centre = centre + p / static_cast<double>(points.size());
  double scale = 0.0;
  for (const Vec3& p : points) scale = std::max(scale, norm(p - centre));
  Matrix spread{};
  for (const Vec3& p : points) {
    const Vec3 d = (p - centre) / scale;
    const std::array<double, 3> c = {d.x, d.y, d.z};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) spread[i][j] += c[i] * c[j];
    }
  }
  const Matrix directions = directions_of(spread);
  const Vec3 normal = upright(unit(column(directions, 2)));
  const Vec3 x = upright(unit(column(directions, 0)));
  return {centre, x, cross(normal, x)};
}

PlaneRounding rounding_in(const Frame& plane, Vec3 rounding) {
  const auto along = [&](Vec3 axis) {
    return std::abs(axis.x) * rounding.x + std::abs(axis.y) * rounding.y +
           std::abs(axis.z) * rounding.z;
  };
  return {{along(plane.x), along(plane.y)}, along(plane.normal())};
}

}  // namespace obvid
