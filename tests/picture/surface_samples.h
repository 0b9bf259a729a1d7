// SPDX-License-Identifier: Apache-2.0
// Surfaces of known shape and triangles over even rasters of them.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "obvid/mesh/mesh.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// The profile (in the x, z plane, x > 0 but at its ends) turned all round the z axis; u runs along
/// the profile. Exact: nine control points around.
inline NurbsSurface turned(const SpaceCurve& profile) {
  static const double kHalf = std::numbers::sqrt2 / 2.0;
  static constexpr double kX[] = {1, 1, 0, -1, -1, -1, 0, 1, 1};
  static constexpr double kY[] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  NurbsSurface s;
  s.degree_u = profile.degree;
  s.degree_v = 2;
  s.knots_u = profile.knots;
  s.knots_v = {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1};
  for (int j = 0; j < 9; ++j) {
    for (std::size_t i = 0; i < profile.points.size(); ++i) {
      const Vec3 p = profile.points[i];
      const double weight = profile.weights.empty() ? 1.0 : profile.weights[i];
      s.points.push_back({p.x * kX[j], p.x * kY[j], p.z});
      s.weights.push_back(weight * (j % 2 == 0 ? 1.0 : kHalf));
    }
  }
  return s;
}

/// Sphere with the normal outwards.
inline NurbsSurface sphere(double radius, Vec3 centre = {}) {
  NurbsSurface s = turned(arc_about({0, 0, radius}, {}, {0, 1, 0}, std::numbers::pi));
  for (Vec3& p : s.points) p = p + centre;
  return s;
}

/// Torus around z, normal outwards.
inline NurbsSurface torus(double large, double small) {
  return turned(arc_about({large + small, 0, 0}, {large, 0, 0}, {0, 1, 0}, 2.0 * std::numbers::pi));
}

/// Flat rectangle in the plane z = 0, normal upwards.
inline NurbsSurface rectangle(double width, double depth) {
  NurbsSurface s;
  s.degree_u = s.degree_v = 1;
  s.knots_u = s.knots_v = {0, 0, 1, 1};
  s.points = {{0, 0, 0}, {width, 0, 0}, {0, depth, 0}, {width, depth, 0}};
  return s;
}

/// z = x y / scale over a square around the origin: Gaussian curvature -1/scale^2 in the middle.
inline NurbsSurface saddle(double half, double scale) {
  NurbsSurface s = rectangle(1, 1);
  s.points.clear();
  for (const double y : {-half, half}) {
    for (const double x : {-half, half}) s.points.push_back({x, y, x * y / scale});
  }
  return s;
}

/// Spans of 5 mm along x, parabolas in turn upwards and downwards with the second derivative
/// 0.0064: z is 0 between them and 0.02 off in the middle of each.
inline NurbsSurface rippled_plate() {
  constexpr int kSpans = 20;
  constexpr double kStep = 5.0, kControl = 0.04;
  NurbsSurface s = rectangle(1, 1);
  s.degree_u = 2;
  s.knots_u = {0.0, 0.0};
  for (int i = 0; i <= kSpans; ++i) s.knots_u.push_back(i * kStep);
  s.knots_u.insert(s.knots_u.end(), {kSpans * kStep, kSpans * kStep});
  s.points.clear();
  for (const double y : {0.0, 100.0}) {
    s.points.push_back({0, y, 0});
    for (int i = 1; i <= kSpans; ++i) {
      s.points.push_back({(i - 0.5) * kStep, y, i % 2 == 0 ? -kControl : kControl});
    }
    s.points.push_back({kSpans * kStep, y, 0});
  }
  return s;
}

/// Triangles over a raster of n x m cells; collapsed cells keep one of theirs or none.
inline Mesh raster_mesh(const NurbsSurface& surface, std::size_t n, std::size_t m) {
  const Range us = domain_u(surface), vs = domain_v(surface);
  Mesh mesh;
  for (std::size_t j = 0; j <= m; ++j) {
    for (std::size_t i = 0; i <= n; ++i) {
      const double u = us.at(static_cast<double>(i) / static_cast<double>(n));
      const double v = vs.at(static_cast<double>(j) / static_cast<double>(m));
      const SurfaceJet jet = evaluate(surface, u, v);
      // at a pole the normal beside it
      const double inner = us.at(0.5) + (1.0 - 1e-6) * (u - us.at(0.5));
      mesh.vertices.push_back({jet.point, curvature(evaluate(surface, inner, v)).normal, u, v});
    }
  }
  for (std::size_t j = 0; j < m; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (n + 1) + i);
      const auto above = static_cast<std::uint32_t>(a + n + 1);
      mesh.triangles.push_back({a, a + 1, above + 1});
      mesh.triangles.push_back({a, above + 1, above});
    }
  }
  return mesh;
}

inline SurfaceModel model_of(std::vector<SurfacePatch> patches, std::string name = "sample") {
  SurfaceModel model;
  model.name = std::move(name);
  model.units = "mm";
  model.patches = std::move(patches);
  return model;
}

inline std::vector<Mesh> meshes_of(const SurfaceModel& model, std::size_t n) {
  std::vector<Mesh> meshes;
  for (const SurfacePatch& p : model.patches) meshes.push_back(raster_mesh(p.surface, n, n));
  return meshes;
}

}  // namespace obvid
