// SPDX-License-Identifier: Apache-2.0
// Surfaces of known shape for the tests, made without the builders.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <vector>

#include "obvid/surface/nurbs_surface.h"
#include "obvid/surface/surface.h"

namespace obvid::shapes {

/// The profile (x = radius, z = height) turned once around the z axis; u along the profile.
inline NurbsSurface revolved(const SpaceCurve& profile, double angle = 2.0 * std::numbers::pi) {
  const SpaceCurve circle = arc_about({1.0, 0.0, 0.0}, {}, {0.0, 0.0, 1.0}, angle);
  NurbsSurface s;
  s.degree_u = profile.degree;
  s.knots_u = profile.knots;
  s.degree_v = circle.degree;
  s.knots_v = circle.knots;
  for (std::size_t j = 0; j < circle.points.size(); ++j) {
    for (std::size_t i = 0; i < profile.points.size(); ++i) {
      const Vec3 p = profile.points[i];
      s.points.push_back({p.x * circle.points[j].x, p.x * circle.points[j].y, p.z});
      s.weights.push_back((profile.weights.empty() ? 1.0 : profile.weights[i]) * circle.weights[j]);
    }
  }
  return s;
}

/// du x dv outwards: the meridian runs from the south pole to the north, v to the east... turned
/// round so that normals point outwards.
inline NurbsSurface sphere(double radius) {
  SpaceCurve meridian = arc_about({0.0, 0.0, -radius}, {}, {0.0, -1.0, 0.0}, std::numbers::pi);
  meridian.points.front().x = meridian.points.back().x = 0.0;
  return transposed(revolved(meridian));
}

inline NurbsSurface torus(double great, double small) {
  return transposed(revolved(arc_about({great + small, 0.0, 0.0}, {great, 0.0, 0.0},
                                       {0.0, -1.0, 0.0}, 2.0 * std::numbers::pi)));
}

inline NurbsSurface cylinder(double radius, double height) {
  return transposed(revolved(line_between({radius, 0.0, 0.0}, {radius, 0.0, height})));
}

inline NurbsSurface cone(double radius, double height) {
  return transposed(revolved(line_between({radius, 0.0, 0.0}, {0.0, 0.0, height})));
}

inline std::vector<double> uniform_knots(int degree, std::size_t count) {
  std::vector<double> knots(static_cast<std::size_t>(degree), 0.0);
  const std::size_t spans = count - static_cast<std::size_t>(degree);
  for (std::size_t k = 0; k <= spans; ++k) {
    knots.push_back(static_cast<double>(k) / static_cast<double>(spans));
  }
  knots.insert(knots.end(), static_cast<std::size_t>(degree), 1.0);
  return knots;
}

/// Control points from a function of the (Greville) parameters.
inline NurbsSurface from_function(int degree, std::size_t nu, std::size_t nv,
                                  const std::function<Vec3(double, double)>& at) {
  NurbsSurface s;
  s.degree_u = s.degree_v = degree;
  s.knots_u = uniform_knots(degree, nu);
  s.knots_v = uniform_knots(degree, nv);
  const auto greville = [&](const std::vector<double>& knots, std::size_t i) {
    double sum = 0.0;
    for (int k = 1; k <= degree; ++k) sum += knots[i + static_cast<std::size_t>(k)];
    return sum / degree;
  };
  for (std::size_t j = 0; j < nv; ++j) {
    for (std::size_t i = 0; i < nu; ++i) {
      s.points.push_back(at(greville(s.knots_u, i), greville(s.knots_v, j)));
    }
  }
  return s;
}

/// Four control points by four, [0, 1] x [0, 1].
inline NurbsSurface bezier(const std::vector<Vec3>& points) {
  NurbsSurface s;
  s.degree_u = s.degree_v = 3;
  s.knots_u = s.knots_v = {0, 0, 0, 0, 1, 1, 1, 1};
  s.points = points;
  return s;
}

inline NurbsSurface moved(NurbsSurface s, double scale, Vec3 by) {
  for (Vec3& p : s.points) p = scale * p + by;
  return s;
}

}  // namespace obvid::shapes
