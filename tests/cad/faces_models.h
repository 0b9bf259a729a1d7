// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "obvid/surface/surface.h"

namespace obvid {

/// Models with areas and counts of faces in closed form, for the tests of CAD files. Lengths in the
/// model's units.
struct KnownModel {
  SurfaceModel model;
  std::size_t faces = 1;
  double area = 0.0;           ///< 0: no closed form
  std::string kind;            ///< shape: "Face", "Shell", "Solid", or "Compound" of them
  std::size_t open_edges = 0;  ///< borders of one face only
  double volume = 0.0;         ///< of solids
};

inline NurbsSurface bilinear(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  return {1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, {a, b, c, d}, {}};
}

/// A curve in the plane y = 0 (x: radius) turned about z once: quarters of a rational circle.
inline NurbsSurface turned_about_z(const SpaceCurve& profile) {
  constexpr double kHalf = std::numbers::sqrt2 / 2.0;
  const std::array<Vec3, 9> circle = {{{1, 0, 1},
                                       {1, 1, 1},
                                       {0, 1, 1},
                                       {-1, 1, 1},
                                       {-1, 0, 1},
                                       {-1, -1, 1},
                                       {0, -1, 1},
                                       {1, -1, 1},
                                       {1, 0, 1}}};
  NurbsSurface out;
  out.degree_u = profile.degree;
  out.knots_u = profile.knots;
  out.degree_v = 2;
  out.knots_v = {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1};
  for (std::size_t j = 0; j < circle.size(); ++j) {
    for (std::size_t i = 0; i < profile.points.size(); ++i) {
      const Vec3 p = profile.points[i];
      out.points.push_back({p.x * circle[j].x, p.x * circle[j].y, p.z});
      const double own = profile.weights.empty() ? 1.0 : profile.weights[i];
      out.weights.push_back(own * (j % 2 == 0 ? 1.0 : kHalf));
    }
  }
  return out;
}

/// Half a circle in the plane y = 0 from the south to the north.
inline SpaceCurve half_circle(double radius) {
  constexpr double kHalf = std::numbers::sqrt2 / 2.0;
  SpaceCurve out{2, {0, 0, 0, 0.5, 0.5, 1, 1, 1}, {}, {1, kHalf, 1, kHalf, 1}};
  for (const Vec3 p : {Vec3{0, 0, -1}, {1, 0, -1}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}) {
    out.points.push_back(radius * p);
  }
  return out;
}

inline SpaceCurve whole_circle(double centre, double radius) {
  constexpr double kHalf = std::numbers::sqrt2 / 2.0;
  SpaceCurve out{2, {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1}, {}, {}};
  for (const auto& [x, z] :
       {std::pair{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}}) {
    out.points.push_back({centre + radius * x, 0.0, radius * z});
    out.weights.push_back(x != 0 && z != 0 ? kHalf : 1.0);
  }
  return out;
}

inline SpaceCurve straight(Vec3 a, Vec3 b) { return {1, {0, 0, 1, 1}, {a, b}, {}}; }

inline KnownModel plane_model() {
  return {{"plane", "mm", {{"floor", bilinear({0, 0, 1}, {4, 0, 1}, {0, 3, 1}, {4, 3, 1})}}},
          1,
          12.0,
          "Face",
          4};
}
inline KnownModel sphere_model(double radius = 10.0) {
  return {{"sphere", "mm", {{"ball", turned_about_z(half_circle(radius))}}},
          1,
          4.0 * std::numbers::pi * radius * radius,
          "Solid",
          0,
          4.0 / 3.0 * std::numbers::pi * radius * radius * radius};
}
inline KnownModel torus_model() {
  return {{"torus", "mm", {{"ring", turned_about_z(whole_circle(10.0, 3.0))}}},
          1,
          4.0 * std::numbers::pi * std::numbers::pi * 30.0,
          "Solid",
          0,
          2.0 * std::numbers::pi * std::numbers::pi * 90.0};
}
inline KnownModel cone_model() {
  return {{"cone", "mm", {{"tip", turned_about_z(straight({4, 0, 0}, {0, 0, 3}))}}},
          1,
          std::numbers::pi * 4.0 * 5.0,
          "Face",
          1};
}
inline KnownModel cylinder_model() {
  return {{"cylinder", "mm", {{"tube", turned_about_z(straight({2, 0, 0}, {2, 0, 7}))}}},
          1,
          std::numbers::pi * 4.0 * 7.0,
          "Face",
          2};
}

/// Bicubic with uneven knots, heights as given.
template <class Height>
NurbsSurface bicubic(std::size_t n, std::size_t m, Height height) {
  const auto knots = [](std::size_t count) {
    std::vector<double> out(4, 0.0);
    for (std::size_t k = 1; k + 3 < count; ++k) {
      const double part = static_cast<double>(k) / static_cast<double>(count - 3);
      out.push_back(part * (0.8 + 0.2 * part));
    }
    out.insert(out.end(), 4, 1.0);
    return out;
  };
  NurbsSurface out{3, 3, knots(n), knots(m), {}, {}};
  for (std::size_t j = 0; j < m; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto x = static_cast<double>(i), y = static_cast<double>(j);
      out.points.push_back({x, y, height(x, y)});
    }
  }
  return out;
}

inline KnownModel grid_model() {
  return {{"grid",
           "mm",
           {{"waves",
             bicubic(12, 9, [](double x, double y) { return std::sin(x) / 3.0 + y * y / 17.0; })}}},
          1,
          0.0,
          "Face",
          4};
}

/// A box 2 x 3 x 5 of six patches whose normals look anywhere and whose sides run anyhow.
inline KnownModel box_model() {
  const auto p = [](int i) {
    return Vec3{i & 1 ? 2.0 : 0.0, i & 2 ? 3.0 : 0.0, i & 4 ? 5.0 : 0.0};
  };
  KnownModel out{{"box", "mm", {}}, 6, 2.0 * (6.0 + 10.0 + 15.0), "Solid", 0, 30.0};
  const std::array<std::array<int, 4>, 6> sides = {
      {{0, 1, 2, 3}, {4, 5, 6, 7}, {1, 0, 5, 4}, {2, 3, 6, 7}, {0, 4, 2, 6}, {7, 3, 5, 1}}};
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const auto& s = sides[k];
    NurbsSurface side = bilinear(p(s[0]), p(s[1]), p(s[2]), p(s[3]));
    if (k % 2 == 1) side = with_domain(side, {2.0, 5.0}, {-1.0, 0.5});  // parameters may differ
    out.model.patches.push_back({"side " + std::to_string(k), std::move(side)});
  }
  return out;
}

/// 32 bicubic patches; public data, empty when they are not there.
inline KnownModel teapot_model() {
  KnownModel out{{"teapot", "mm", {}}, 32, 0.0, "Compound", 16};
  std::ifstream file(std::string(OBVID_SHARED_DATA) + "/surfaces/utah_teapot_bezier_patches.csv");
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] < '0' || line[0] > '9') continue;
    for (char& c : line) c = c == ',' ? ' ' : c;
    std::istringstream in(line);
    std::size_t patch = 0, row = 0, column = 0;
    Vec3 p;
    in >> patch >> row >> column >> p.x >> p.y >> p.z;
    while (out.model.patches.size() <= patch) {
      out.model.patches.push_back(
          {"teapot " + std::to_string(out.model.patches.size()),
           {3, 3, {0, 0, 0, 0, 1, 1, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1}, {}, {}}});
    }
    out.model.patches[patch].surface.points.push_back(10.0 * p);
  }
  return out;
}

/// A roof: C0 in the middle, where the normal jumps.
inline KnownModel roof_model() {
  NurbsSurface roof{1, 1, {0, 0, 0.5, 1, 1}, {0, 0, 1, 1}, {}, {}};
  roof.points = {{0, 0, 0}, {3, 0, 4}, {6, 0, 0}, {0, 7, 0}, {3, 7, 4}, {6, 7, 0}};
  return {{"roof", "mm", {{"roof", roof}}}, 2, 70.0, "Shell", 6};
}

inline std::vector<KnownModel> known_models() {
  std::vector<KnownModel> out = {plane_model(),    sphere_model(), torus_model(), cone_model(),
                                 cylinder_model(), grid_model(),   box_model(),   roof_model()};
  KnownModel teapot = teapot_model();
  if (!teapot.model.patches.empty()) out.push_back(std::move(teapot));
  return out;
}

}  // namespace obvid
