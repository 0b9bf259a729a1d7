// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "../common/angles.h"
#include "../common/mesh_checks.h"
#include "../common/mesh_shapes.h"
#include "obvid/mesh/mesh.h"

namespace obvid {
namespace {

Mesh drawn(const NurbsSurface& surface, double tolerance, double angle = kAnyAngle) {
  auto mesh = tessellate(surface, {tolerance, angle});
  EXPECT_TRUE(mesh) << (mesh ? "" : mesh.error().what);
  return mesh ? *mesh : Mesh{};
}

NurbsSurface hills(std::size_t spans) {
  return shapes::from_function(3, spans + 3, spans + 3, [](double u, double v) {
    return Vec3{10.0 * u, 10.0 * v, 0.5 * std::sin(9.0 * u) * std::cos(7.0 * v)};
  });
}

TEST(Tessellate, DrawsAPlaneWithTwoTrianglesHoweverItsParametersRun) {
  const auto plane = shapes::from_function(3, 40, 30, [](double u, double v) {
    return Vec3{100.0 * u * u, 50.0 * v + 20.0 * v * v * v, 0.0};
  });
  const Mesh mesh = drawn(plane, 1e-6, 0.01);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_NEAR(checks::area(mesh), 100.0 * 70.0, 1e-9);
  for (const MeshVertex& v : mesh.vertices) EXPECT_NEAR(v.normal.z, 1.0, 1e-12);
}

TEST(Tessellate, KeepsTheCurvedBorderOfAFlatDisc) {
  const NurbsSurface disc = shapes::revolved(line_between({0.0, 0.0, 0.0}, {5.0, 0.0, 0.0}));
  const Mesh mesh = drawn(disc, 0.01);
  // chords of n equal parts of a turn: the sagitta is r (1 - cos(pi / n))
  const double least = kPi / std::acos(1.0 - 0.01 / 5.0);
  EXPECT_GE(mesh.triangles.size(), static_cast<std::size_t>(least));
  EXPECT_LE(mesh.triangles.size(), static_cast<std::size_t>(3.0 * least));
  EXPECT_LT(checks::area(mesh), kPi * 25.0);
  EXPECT_GT(checks::area(mesh), kPi * 25.0 - 2.0 * kPi * 5.0 * 0.01);
}

TEST(Tessellate, SpheresAreClosedAndConvergeInVolumeAndAreaWithTheTolerance) {
  const NurbsSurface sphere = shapes::sphere(3.0);
  const double volume = 4.0 / 3.0 * kPi * 27.0, area = 4.0 * kPi * 9.0;
  for (const double tolerance : {0.3, 0.03, 0.003, 0.0003}) {
    const Mesh mesh = drawn(sphere, tolerance);
    EXPECT_TRUE(checks::open_edges({mesh}).empty()) << tolerance;
    EXPECT_EQ(checks::turned_over(mesh), 0u) << tolerance;
    // all points on the sphere, all triangles inside and no deeper than the tolerance
    EXPECT_LT(checks::volume({mesh}), volume);
    EXPECT_GT(checks::volume({mesh}), volume * std::pow(1.0 - tolerance / 3.0, 3.0));
    EXPECT_LT(checks::area(mesh), area);
    EXPECT_GT(checks::area(mesh), area * std::pow(1.0 - tolerance / 3.0, 2.0));
    EXPECT_LE(mesh.deviation, tolerance);
    EXPECT_GT(mesh.deviation, 0.3 * tolerance);
    // an equilateral triangle with its corners on the sphere and its plane at the tolerance has an
    // area of 3 sqrt(3) / 2 r tolerance: no mesh has fewer, a good one not more than thrice as many
    const double least = area / (1.5 * std::sqrt(3.0) * 3.0 * tolerance);
    EXPECT_LT(static_cast<double>(mesh.triangles.size()), 3.0 * least) << tolerance;
    for (const MeshVertex& v : mesh.vertices) {
      ASSERT_NEAR(norm(v.point), 3.0, 1e-13);
      ASSERT_NEAR(dot(v.normal, v.point), 3.0, 1e-4) << v.u << ' ' << v.v;  // poles: limits
    }
  }
}

TEST(Tessellate, TheDeviationIsWhatOneMeasuresFromTheSurfacesSide) {
  for (const NurbsSurface& surface : {shapes::sphere(1.0), shapes::torus(2.0, 0.5), hills(12)}) {
    const Mesh mesh = drawn(surface, 0.02);
    const double seen = checks::distance_from_mesh(surface, mesh, 4000);
    EXPECT_LE(seen, 1.02 * mesh.deviation);
    EXPECT_GE(seen, 0.7 * mesh.deviation);
    EXPECT_LE(mesh.deviation, 0.02);
  }
}

/// A strip over a line of ten that rises by 6 t (1 - t)^5, most at a sixth of its length: at its
/// third and its middle by half of that.
TEST(Tessellate, TheDeviationIsLookedForBesideTheMiddlesToo) {
  NurbsSurface strip;
  strip.degree_u = 6;
  strip.degree_v = 1;
  strip.knots_u = {0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1};
  strip.knots_v = {0, 0, 1, 1};
  for (const double y : {0.0, 9.0}) {
    for (int i = 0; i <= 6; ++i) strip.points.push_back({10.0 * i / 6.0, y, i == 1 ? 1.0 : 0.0});
  }
  const Mesh mesh = drawn(strip, 0.5);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  double true_deviation = 0.0;  // of points of the line from the curve
  for (int i = 0; i <= 400; ++i) {
    double nearest = 1.0;
    for (int k = 0; k <= 4000; ++k) {
      const double t = k / 4000.0, rise = 6.0 * t * std::pow(1.0 - t, 5);
      nearest = std::min(nearest, std::hypot(10.0 * (t - i / 400.0), rise));
    }
    true_deviation = std::max(true_deviation, nearest);
  }
  EXPECT_LE(mesh.deviation, 1.001 * true_deviation);
  EXPECT_GE(mesh.deviation, 0.94 * true_deviation);
}

TEST(Tessellate, KeepsTheAngleBetweenNormalsOfEachEdge) {
  for (const double angle : {0.5, 0.1}) {
    for (const NurbsSurface& surface :
         {shapes::sphere(1.0), shapes::torus(2.0, 0.5), shapes::cylinder(1.0, 9.0), hills(12)}) {
      const Mesh mesh = drawn(surface, 0.5, angle);
      EXPECT_LE(checks::largest_angle(mesh), angle * 1.0001);
      EXPECT_GT(checks::largest_angle(mesh), 0.3 * angle);
    }
  }
}

TEST(Tessellate, CutsACylinderAlongItsAxisOnly) {
  const Mesh mesh = drawn(shapes::cylinder(1.0, 100.0), 1e-3);
  const double least = kPi / std::acos(1.0 - 1e-3);  // chords of a turn
  EXPECT_LE(mesh.triangles.size(), static_cast<std::size_t>(2 * 2.0 * least + 16));
  EXPECT_EQ(checks::turned_over(mesh), 0u);
  // open at both ends only
  for (const auto& [from, to] : checks::open_edges({mesh})) {
    ASSERT_NEAR(from[2], to[2], 1e-12);
    ASSERT_NEAR(std::fabs(from[2] - 50.0), 50.0, 1e-12);
  }
}

TEST(Tessellate, AConesApexHasNoTrianglesWithoutAreaAndTheNormalsOfItsSides) {
  const Mesh mesh = drawn(shapes::cone(2.0, 2.0), 1e-3);
  EXPECT_GT(checks::slimmest(mesh), 1e-3);
  EXPECT_EQ(checks::turned_over(mesh), 0u);
  for (const MeshVertex& v : mesh.vertices) EXPECT_NEAR(v.normal.z, std::sqrt(0.5), 1e-6);
}

TEST(Tessellate, SurfacesOfAnySizeAndPlaceGetTheSameTriangles) {
  const Mesh here = drawn(shapes::sphere(1.0), 1e-3);
  for (const double scale : {std::exp2(-30.0), std::exp2(30.0)}) {  // some 1e-9 and 1e9
    const Mesh other = drawn(shapes::moved(shapes::sphere(1.0), scale, {}), scale * 1e-3);
    EXPECT_EQ(other.triangles, here.triangles);
    EXPECT_NEAR(other.deviation, scale * here.deviation, scale * 1e-12);
  }
  const Vec3 far{1e6, -1e6, 2e6};
  const Mesh there = drawn(shapes::moved(shapes::sphere(1.0), 1.0, far), 1e-3);
  EXPECT_TRUE(checks::open_edges({there}).empty());
  EXPECT_EQ(checks::turned_over(there), 0u);
  EXPECT_NEAR(static_cast<double>(there.triangles.size()),
              static_cast<double>(here.triangles.size()), 0.01 * 1e4);
  EXPECT_NEAR(checks::volume({there}, far), checks::volume({here}), 1e-6);
}

TEST(Tessellate, AThinStripThatWindsStaysAStrip) {
  // a screw, 0.001 wide, three turns of radius 100
  const auto strip = shapes::from_function(3, 300, 4, [](double u, double v) {
    const double turn = 6.0 * kPi * u;
    return Vec3{100.0 * std::cos(turn), 100.0 * std::sin(turn), 30.0 * u + 0.001 * v};
  });
  const Mesh mesh = drawn(strip, 0.01, 0.2);
  EXPECT_EQ(checks::turned_over(mesh), 0u);
  EXPECT_NEAR(checks::area(mesh), 0.001 * 600.0 * kPi, 0.01 * 0.001 * 600.0 * kPi);
  const double least = 3.0 * kPi / std::acos(1.0 - 0.01 / 100.0);  // chords of three turns
  EXPECT_LT(static_cast<double>(mesh.triangles.size()), 2.0 * 2.0 * least);
}

TEST(Tessellate, EdgesOfTheSurfaceAreSharpAndHaveNoCracks) {
  // a roof of two planes, ridge at u = 1/2, both planes many spans
  NurbsSurface roof = shapes::from_function(1, 11, 2, [](double u, double v) {
    return Vec3{2.0 * u, v, 1.0 - std::fabs(2.0 * u - 1.0)};
  });
  const Mesh mesh = drawn(roof, 1e-3, 0.3);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.vertices.size(), 8u);  // the ridge twice
  for (const MeshVertex& v : mesh.vertices) EXPECT_NEAR(v.normal.z, std::sqrt(0.5), 1e-12);
  EXPECT_EQ(checks::open_edges({mesh}).size(), 6u);
}

TEST(Tessellate, TrianglesDoNotDependOnTheNumberOfThreads) {
  const NurbsSurface surface = hills(12);
  TessellationOptions options{1e-4, 0.2};
  const auto one = tessellate(surface, options);
  ASSERT_TRUE(one);
  ASSERT_GT(one->triangles.size(), 10'000u);  // more than one lot of cells
  for (const std::size_t threads : {2u, 3u}) {
    options.threads = threads;
    const auto many = tessellate(surface, options);
    ASSERT_TRUE(many);
    EXPECT_EQ(many->triangles, one->triangles);
    EXPECT_EQ(many->deviation, one->deviation);
    ASSERT_EQ(many->vertices.size(), one->vertices.size());
    for (std::size_t i = 0; i < one->vertices.size(); ++i) {
      ASSERT_EQ(many->vertices[i].point, one->vertices[i].point) << i;
      ASSERT_EQ(many->vertices[i].normal, one->vertices[i].normal) << i;
    }
  }
}

TEST(Tessellate, NeighboursShareThePointsOfTheirBorder) {
  const NurbsSurface whole = hills(10);
  auto [left, right] = split_u(whole, 0.4);
  auto [low, high] = split_v(right, 0.7);
  // turned round, with another range, and of another degree: still the same border curves
  SurfaceModel model;
  model.patches = {{"left", with_domain(left, {5.0, 7.0}, {-1.0, 3.0})},
                   {"low", reversed_u(reversed_u(low))},
                   {"high", transposed(with_degrees(high, 4, 5))}};
  auto [left_low, left_high] = split_v(model.patches[0].surface, -1.0 + 0.7 * 4.0);
  model.patches[0].surface = left_low;
  model.patches.push_back({"left high", reversed_u(left_high)});
  auto meshes = tessellate(model, {0.002, kAnyAngle});
  ASSERT_TRUE(meshes) << meshes.error().what;
  std::size_t triangles = 0;
  for (Mesh& mesh : *meshes) {
    EXPECT_LE(mesh.deviation, 0.002);
    EXPECT_EQ(checks::turned_over(mesh), 0u);
    triangles += mesh.triangles.size();
  }
  // those turned round look the other way: turn their triangles before counting edges
  for (std::size_t p : {2u, 3u}) {
    for (auto& t : (*meshes)[p].triangles) std::swap(t[1], t[2]);
  }
  for (const auto& [from, to] : checks::open_edges(*meshes)) {
    const auto on = [&](std::size_t axis, double value) {
      return std::fabs(from[axis] - value) < 1e-12 && std::fabs(to[axis] - value) < 1e-12;
    };
    const bool outside = on(0, 0.0) || on(0, 10.0) || on(1, 0.0) || on(1, 10.0);
    EXPECT_TRUE(outside) << from[0] << ' ' << from[1] << " to " << to[0] << ' ' << to[1];
  }
  EXPECT_GT(triangles, 500u);
}

TEST(Tessellate, ABorderNextToAFinerPatchStaysWithinTheTolerance) {
  // a flat patch beside one whose border is the same line but which is full of waves inside
  const auto waves = shapes::from_function(3, 60, 60, [](double u, double v) {
    return Vec3{u, v, 0.05 * u * std::sin(60.0 * v) * (1.0 - u)};
  });
  const auto flat = shapes::from_function(3, 4, 60, [](double u, double v) {
    return Vec3{u - 1.0, v, 0.0};
  });
  SurfaceModel model;
  model.patches = {{"waves", waves}, {"flat", flat}};
  auto meshes = tessellate(model, {1e-4, kAnyAngle});
  ASSERT_TRUE(meshes) << meshes.error().what;
  for (const auto& [from, to] : checks::open_edges(*meshes)) {
    EXPECT_FALSE(std::fabs(from[0]) < 1e-12 && std::fabs(to[0]) < 1e-12) << from[1] << ' ' << to[1];
  }
  EXPECT_EQ(checks::turned_over((*meshes)[1]), 0u);
}

TEST(Tessellate, ABorderCurveWithOtherParametersIsStillTheSameBorder) {
  // a quarter of a circle by a rational parabola with equal end weights, and the same with its
  // parameter pushed to one side (weights 1, w c, c^2): above a flat sector, below a cylinder
  const double w = std::sqrt(0.5), c = 2.5;
  NurbsSurface wall;
  wall.degree_u = 2;
  wall.degree_v = 1;
  wall.knots_u = {0, 0, 0, 1, 1, 1};
  wall.knots_v = {0, 0, 1, 1};
  wall.points = {{1, 0, -2}, {1, 1, -2}, {0, 1, -2}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  wall.weights = {1, w, 1, 1, w, 1};
  NurbsSurface sector = wall;
  sector.points = {{0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  sector.weights = {1, w * c, c * c, 1, w * c, c * c};
  sector.points[3] = sector.points[4] = sector.points[5] = {0, 0, 0};
  SurfaceModel model;
  model.patches = {{"wall", wall}, {"sector", reversed_u(sector)}};
  auto meshes = tessellate(model, {1e-4, kAnyAngle});
  ASSERT_TRUE(meshes) << meshes.error().what;
  std::set<checks::Key> points[2];
  for (std::size_t p = 0; p < 2; ++p) {
    for (const MeshVertex& v : (*meshes)[p].vertices) {
      if (std::fabs(norm(v.point) - 1.0) < 1e-9) points[p].insert(checks::key(v.point));
    }
    EXPECT_LE((*meshes)[p].deviation, 1e-4);
    EXPECT_EQ(checks::turned_over((*meshes)[p]), 0u);
  }
  EXPECT_EQ(points[0], points[1]);
  EXPECT_GT(points[0].size(), 50u);
}

TEST(Tessellate, AThinWallKeepsItsTwoSidesApart) {
  SurfaceModel model;
  const auto side = [](double z) {
    return shapes::from_function(2, 3, 3, [=](double u, double v) { return Vec3{u, v, z}; });
  };
  model.patches = {{"below", side(0.0)}, {"above", side(1e-4)}};
  auto meshes = tessellate(model, {0.01, kAnyAngle});
  ASSERT_TRUE(meshes);
  for (const MeshVertex& v : (*meshes)[1].vertices) EXPECT_EQ(v.point.z, 1e-4);
}

TEST(Tessellate, RefusesWhatItCannotDo) {
  const NurbsSurface sphere = shapes::sphere(1.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    const auto chord = tessellate(sphere, {bad, 0.1}), angle = tessellate(sphere, {0.1, bad});
    ASSERT_FALSE(chord);
    ASSERT_FALSE(angle);
    EXPECT_EQ(chord.error().code, ErrorCode::kBadOption);
    EXPECT_EQ(angle.error().code, ErrorCode::kBadOption);
  }
  const auto rounding = tessellate(shapes::moved(sphere, 1.0, {1e9, 0.0, 0.0}), {1e-9, 0.1});
  ASSERT_FALSE(rounding);
  EXPECT_EQ(rounding.error().code, ErrorCode::kBadOption);
  const auto many = tessellate(sphere, {1e-6, 0.1, 1000});
  ASSERT_FALSE(many);
  EXPECT_EQ(many.error().code, ErrorCode::kToleranceNotReached);
  NurbsSurface broken = sphere;
  broken.points.pop_back();
  EXPECT_FALSE(tessellate(broken, {0.1, 0.1}));
  NurbsSurface infinite = sphere;
  infinite.points[3].y = nan;
  const auto bad = tessellate(infinite, {0.1, 0.1});
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, ErrorCode::kNotFinite);
  const auto none = tessellate(SurfaceModel{}, {0.1, 0.1});
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->empty());
}

TEST(Tessellate, TellsProgressUpToTheEnd) {
  SurfaceModel model;
  for (int k = 0; k < 5; ++k) {
    model.patches.push_back({"", shapes::moved(shapes::sphere(1.0), 1.0, {3.0 * k, 0.0, 0.0})});
  }
  std::vector<double> told;
  ASSERT_TRUE(
      tessellate(model, {0.01, 1.0}, [&](std::string_view, double part) { told.push_back(part); }));
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back(), 1.0);
}

}  // namespace
}  // namespace obvid
