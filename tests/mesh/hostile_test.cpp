// SPDX-License-Identifier: Apache-2.0
// Surfaces that nobody would build on purpose, and the teapot.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "../common/mesh_checks.h"
#include "../common/mesh_shapes.h"
#include "../common/shared_data.h"
#include "obvid/mesh/mesh.h"

namespace obvid {
namespace {

/// Finite, normals of length 1, closed inside: every open edge lies on the border of [0, 1]^2.
void expect_sound(const NurbsSurface& surface, const Mesh& mesh) {
  std::set<checks::Key> border;
  for (const MeshVertex& v : mesh.vertices) {
    ASSERT_TRUE(is_finite(v.point));
    ASSERT_NEAR(norm(v.normal), 1.0, 1e-9);
    const bool outside = v.u == domain_u(surface).from || v.u == domain_u(surface).to ||
                         v.v == domain_v(surface).from || v.v == domain_v(surface).to;
    if (outside) border.insert(checks::key(v.point));
  }
  for (const auto& [from, to] : checks::open_edges({mesh})) {
    ASSERT_TRUE(border.count(from) == 1 && border.count(to) == 1);
  }
}

TEST(TessellateHostile, RandomControlPointsAndWeightsGiveClosedTrianglesOrAnError) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1.0, 1.0), power(-2.0, 2.0);
  int drawn = 0;
  for (int k = 0; k < 60; ++k) {
    NurbsSurface s = shapes::from_function(
        1 + k % 4, 5 + static_cast<std::size_t>(k % 3), 6, [&](double, double) {
          return Vec3{place(random), place(random), place(random)};
        });
    if (k % 2 == 0) {
      for (std::size_t i = 0; i < s.points.size(); ++i) {
        s.weights.push_back(std::pow(10.0, power(random)));
      }
    }
    const auto mesh = tessellate(s, {0.05, kAnyAngle});
    if (!mesh) continue;
    ++drawn;
    EXPECT_LE(mesh->deviation, 0.05);
    expect_sound(s, *mesh);
  }
  EXPECT_GE(drawn, 53);
}

TEST(TessellateHostile, EqualControlPointsHereAndThereDoNoHarm) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  std::bernoulli_distribution same(0.3);
  for (int k = 0; k < 20; ++k) {
    NurbsSurface s = shapes::from_function(3, 6, 6, [&](double u, double v) {
      return Vec3{u, v, 0.2 * place(random)};
    });
    for (std::size_t i = 1; i < s.points.size(); ++i) {
      if (same(random)) s.points[i] = s.points[i - 1];
    }
    const auto mesh = tessellate(s, {0.01, 0.5});
    if (mesh) expect_sound(s, *mesh);
  }
}

TEST(TessellateHostile, APointAndALineHaveNoTriangles) {
  const auto point = tessellate(shapes::from_function(3, 5, 5,
                                                      [](double, double) {
                                                        return Vec3{1.0, 2.0, 3.0};
                                                      }),
                                {0.1, 0.1});
  ASSERT_TRUE(point);
  EXPECT_TRUE(point->triangles.empty());
  const auto line = tessellate(shapes::from_function(3, 5, 5,
                                                     [](double u, double) {
                                                       return Vec3{u, u * u, 0.0};
                                                     }),
                               {0.1, 0.1});
  ASSERT_TRUE(line);
  EXPECT_TRUE(line->triangles.empty());
}

TEST(TessellateHostile, ADiscWithFourStraightCornersHasNoNeedles) {
  // one rational biquadratic patch: du and dv are parallel in the corners
  const double h = std::sqrt(0.5), w = h;
  NurbsSurface s;
  s.degree_u = s.degree_v = 2;
  s.knots_u = s.knots_v = {0, 0, 0, 1, 1, 1};
  s.points = {{-h, -h, 0},   {0, -2 * h, 0}, {h, -h, 0},    {-2 * h, 0, 0}, {0, 0, 0},
              {2 * h, 0, 0}, {-h, h, 0},     {0, 2 * h, 0}, {h, h, 0}};
  s.weights = {1, w, 1, w, 1, w, 1, w, 1};
  const double tolerance = 1e-3;
  const auto mesh = tessellate(s, {tolerance, kAnyAngle});
  ASSERT_TRUE(mesh) << mesh.error().what;
  EXPECT_EQ(checks::turned_over(*mesh), 0u);
  EXPECT_GT(checks::slimmest(*mesh), 1e-6);
  const double pi = std::numbers::pi;
  EXPECT_LT(checks::area(*mesh), pi);
  EXPECT_GT(checks::area(*mesh), pi * (1.0 - 2.0 * tolerance));
  expect_sound(s, *mesh);
}

TEST(TessellateHostile, ABumpWithinOneOfManySpansIsSeen) {
  NurbsSurface s = shapes::from_function(3, 203, 203, [](double u, double v) {
    return Vec3{200.0 * u, 200.0 * v, 0.0};
  });
  s.points[117 * 203 + 61].z = 1.0;
  const auto mesh = tessellate(s, {0.01, kAnyAngle});
  ASSERT_TRUE(mesh);
  double highest = 0.0;
  for (const MeshVertex& v : mesh->vertices) highest = std::max(highest, v.point.z);
  EXPECT_GT(highest, 4.0 / 9.0 - 0.02);  // the bicubic B-spline's height in the middle
  EXPECT_LT(mesh->triangles.size(), 3000u);
}

TEST(TessellateHostile, KnotsThatNearlyCoincideAreOne) {
  NurbsSurface s = shapes::from_function(3, 8, 8, [](double u, double v) {
    return Vec3{u, v, std::sin(3.0 * u) * v};
  });
  s.knots_u[5] = s.knots_u[4] + 1e-16;
  s.knots_v[5] = std::nextafter(s.knots_v[4], 1.0);
  const auto mesh = tessellate(s, {1e-4, kAnyAngle});
  ASSERT_TRUE(mesh) << mesh.error().what;
  expect_sound(s, *mesh);
}

SurfaceModel teapot() {
  SurfaceModel model;
  std::ifstream file(shared_data() / "surfaces/utah_teapot_bezier_patches.csv");
  std::map<int, std::vector<Vec3>> patches;
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] < '0' || line[0] > '9') continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream in(line);
    int patch = 0, row = 0, column = 0;
    Vec3 p;
    in >> patch >> row >> column >> p.x >> p.y >> p.z;
    patches[patch].push_back(p);
  }
  for (const auto& [number, points] : patches) {
    model.patches.push_back({std::to_string(number), shapes::bezier(points)});
  }
  return model;
}

using Side = std::array<checks::Key, 4>;

/// Control points of the sides of a patch and the mesh's points there.
std::vector<std::pair<Side, std::set<checks::Key>>> sides_of(const NurbsSurface& s,
                                                             const Mesh& mesh) {
  std::vector<std::pair<Side, std::set<checks::Key>>> sides;
  const auto add = [&](std::size_t first, std::size_t step, auto&& is_on) {
    Side side{};
    for (std::size_t k = 0; k < 4; ++k) side[k] = checks::key(s.points[first + k * step]);
    std::set<checks::Key> points;
    for (const MeshVertex& v : mesh.vertices) {
      if (is_on(v)) points.insert(checks::key(v.point));
    }
    sides.emplace_back(side, points);
  };
  add(0, 1, [](const MeshVertex& v) { return v.v == 0.0; });
  add(12, 1, [](const MeshVertex& v) { return v.v == 1.0; });
  add(0, 4, [](const MeshVertex& v) { return v.u == 0.0; });
  add(3, 4, [](const MeshVertex& v) { return v.u == 1.0; });
  return sides;
}

TEST(TessellateHostile, TheTeapotsPatchesMeetAndItsLidComesToAPoint) {
  SKIP_WITHOUT("surfaces/utah_teapot_bezier_patches.csv");
  const SurfaceModel model = teapot();
  ASSERT_EQ(model.patches.size(), 32u);
  const auto meshes = tessellate(model, {0.002, 0.3});
  ASSERT_TRUE(meshes) << meshes.error().what;
  std::map<Side, std::set<checks::Key>> known;
  int shared = 0;
  for (std::size_t p = 0; p < meshes->size(); ++p) {
    const Mesh& mesh = (*meshes)[p];
    EXPECT_LE(mesh.deviation, 0.002);
    EXPECT_EQ(checks::turned_over(mesh), 0u) << p;
    EXPECT_GT(checks::slimmest(mesh), 1e-5) << p;
    expect_sound(model.patches[p].surface, mesh);
    for (const auto& [side, points] : sides_of(model.patches[p].surface, mesh)) {
      Side back = side;
      std::reverse(back.begin(), back.end());
      for (const Side& other : {side, back}) {
        const auto found = known.find(other);
        if (found == known.end()) continue;
        ++shared;
        EXPECT_EQ(found->second, points) << p;
        break;
      }
      known.emplace(side, points);
    }
  }
  EXPECT_GE(shared, 40);
}

}  // namespace
}  // namespace obvid
