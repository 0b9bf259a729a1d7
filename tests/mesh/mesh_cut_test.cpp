// SPDX-License-Identifier: Apache-2.0
// Sections of meshes whose sections are known in closed form.
#include "obvid/mesh/mesh_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <random>

namespace obvid {
namespace {

constexpr double kPi = std::numbers::pi;

Frame level(double z) { return {{0.0, 0.0, z}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}; }

/// From 0 to the given corner, two triangles a side, outwards.
TriangleMesh box(Vec3 size) {
  TriangleMesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.points.push_back(
        {(i & 1U) != 0 ? size.x : 0.0, (i & 2U) != 0 ? size.y : 0.0, (i & 4U) != 0 ? size.z : 0.0});
  }
  const auto side = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  side(0, 2, 3, 1);  // down
  side(4, 5, 7, 6);  // up
  side(0, 1, 5, 4);
  side(1, 3, 7, 5);
  side(3, 2, 6, 7);
  side(2, 0, 4, 6);
  return mesh;
}

/// A grid over two parameters that both close, outwards where du x dv looks outwards.
TriangleMesh closed_grid(std::uint32_t nu, std::uint32_t nv,
                         const std::function<Vec3(double, double)>& at) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < nu; ++i) {
    for (std::uint32_t k = 0; k < nv; ++k)
      mesh.points.push_back(at(2 * kPi * i / nu, 2 * kPi * k / nv));
  }
  const auto place = [&](std::uint32_t i, std::uint32_t k) { return (i % nu) * nv + k % nv; };
  for (std::uint32_t i = 0; i < nu; ++i) {
    for (std::uint32_t k = 0; k < nv; ++k) {
      const auto a = place(i, k), b = place(i + 1, k), c = place(i + 1, k + 1), d = place(i, k + 1);
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

TriangleMesh torus_mesh(double great, double small, std::uint32_t n) {
  return closed_grid(2 * n, n, [=](double u, double v) {
    const double r = great + small * std::cos(v);
    return Vec3{r * std::cos(u), r * std::sin(u), small * std::sin(v)};
  });
}

/// A regular octahedron whose triangles are halved and put onto the sphere so many times.
TriangleMesh sphere_mesh(double radius, int halvings) {
  TriangleMesh mesh;
  mesh.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int step = 0; step < halvings; ++step) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), mesh.points.size());
      if (is_new) mesh.points.push_back(unit(mesh.points[a] + mesh.points[b]));
      return at->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const auto ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  for (Vec3& p : mesh.points) p = radius * p;
  return mesh;
}

double signed_area(const MeshSection& chain) {
  double twice = 0.0;
  for (std::size_t i = 0; i < chain.points.size(); ++i) {
    twice += cross(chain.points[i], chain.points[(i + 1) % chain.points.size()]);
  }
  return twice / 2;
}

TEST(MeshCut, ABoxHasItsRectangleCounterClockwise) {
  for (const double z : {0.25, 1.0, 4.999}) {
    const auto cut = cut_mesh(box({2.0, 3.0, 5.0}), level(z));
    ASSERT_TRUE(cut);
    ASSERT_EQ(cut->size(), 1U);
    EXPECT_TRUE(cut->front().closed);
    EXPECT_EQ(cut->front().turned, 0U);
    EXPECT_NEAR(signed_area(cut->front()), 6.0, 1e-15);
    // the corner with the largest x, of two the one with the largest y
    EXPECT_EQ(cut->front().points.front(), (Vec2{2.0, 3.0}));
    for (const Vec2 p : cut->front().points) {
      EXPECT_TRUE(p.x == 0.0 || p.x == 2.0 || p.y == 0.0 || p.y == 3.0);
    }
  }
}

TEST(MeshCut, AFaceInThePlaneCountsOnceAndWhatIsBesideThePlaneNotAtAll) {
  const TriangleMesh mesh = box({2.0, 3.0, 5.0});
  for (const double z : {0.0, 5.0}) {  // the lowest face and the highest
    const auto cut = cut_mesh(mesh, level(z));
    ASSERT_TRUE(cut);
    ASSERT_EQ(cut->size(), 1U) << z;
    EXPECT_TRUE(cut->front().closed);
    EXPECT_NEAR(signed_area(cut->front()), 6.0, 1e-15);
  }
  for (const double z : {-0.5, 5.5}) {
    const auto cut = cut_mesh(mesh, level(z));
    ASSERT_TRUE(cut);
    EXPECT_EQ(cut->size(), 0U) << z;
  }
}

TEST(MeshCut, ASphereHasCirclesWithinTheHeightOfItsTriangles) {
  const double radius = 10.0;
  const TriangleMesh mesh = sphere_mesh(radius, 5);
  // The farthest that a triangle lies inside the sphere, by its middle.
  double depth = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    depth =
        std::max(depth, radius - norm((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0));
  }
  for (double z = -9.37; z < 10.0; z += 1.31) {
    const auto cut = cut_mesh(mesh, level(z));
    ASSERT_TRUE(cut);
    ASSERT_EQ(cut->size(), 1U) << z;
    EXPECT_TRUE(cut->front().closed);
    EXPECT_GT(signed_area(cut->front()), 0.0);
    for (const Vec2 p : cut->front().points) {
      const double away = std::hypot(p.x, p.y, z);
      EXPECT_LE(away, radius * (1 + 1e-15));
      EXPECT_GE(away, radius - 1.5 * depth);
    }
    EXPECT_NEAR(signed_area(cut->front()), kPi * (radius * radius - z * z),
                2 * kPi * radius * 1.5 * depth);
  }
}

TEST(MeshCut, ATorusHasTwoCirclesAcrossItsAxisAndTwoAlongIt) {
  const double great = 5.0, small = 1.0;
  const TriangleMesh mesh = torus_mesh(great, small, 200);
  const auto across = cut_mesh(mesh, level(0.3));
  ASSERT_TRUE(across);
  ASSERT_EQ(across->size(), 2U);
  const double half = std::sqrt(small * small - 0.09);
  EXPECT_NEAR(signed_area((*across)[0]), kPi * (great + half) * (great + half), 0.02);
  EXPECT_NEAR(signed_area((*across)[1]), -kPi * (great - half) * (great - half), 0.02);  // a hole

  const auto along = cut_mesh(mesh, {{1e-3, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  ASSERT_TRUE(along);
  ASSERT_EQ(along->size(), 2U);
  for (const MeshSection& one : *along) {
    EXPECT_NEAR(signed_area(one), kPi * small * small, 2e-3);
    for (const Vec2 p : one.points) {
      EXPECT_NEAR(std::hypot(std::hypot(p.x, 1e-3) - great, p.y), small, 2e-3);
    }
  }
}

TEST(MeshCut, CornersInThePlaneLoseNothing) {
  const TriangleMesh mesh = torus_mesh(5.0, 1.0, 64);  // has rows of corners at these heights
  for (const std::size_t i : {0U, 5U, 20U, 40U}) {
    const auto cut = cut_mesh(mesh, level(mesh.points[i].z));
    ASSERT_TRUE(cut);
    ASSERT_EQ(cut->size(), 2U) << i;
    EXPECT_TRUE((*cut)[0].closed && (*cut)[1].closed);
  }
}

TEST(MeshCut, AnOpenMeshHasOpenChainsAndTurnedTrianglesAreCounted) {
  TriangleMesh mesh = box({2.0, 3.0, 5.0});
  mesh.triangles.erase(mesh.triangles.begin() + 4, mesh.triangles.begin() + 6);  // one side
  const auto open = cut_mesh(mesh, level(2.5));
  ASSERT_TRUE(open);
  ASSERT_EQ(open->size(), 1U);
  EXPECT_FALSE(open->front().closed);
  EXPECT_EQ(open->front().points.front(), (Vec2{2.0, 0.0}));
  EXPECT_EQ(open->front().points.back(), (Vec2{0.0, 0.0}));

  TriangleMesh turned = box({2.0, 3.0, 5.0});
  std::swap(turned.triangles[6][0], turned.triangles[6][1]);
  const auto still = cut_mesh(turned, level(2.5));
  ASSERT_TRUE(still);
  ASSERT_EQ(still->size(), 1U);
  EXPECT_TRUE(still->front().closed);
  EXPECT_EQ(still->front().turned, 1U);
  EXPECT_NEAR(signed_area(still->front()), 6.0, 1e-15);
}

TEST(MeshCut, AnEdgeOfThreeTrianglesEndsChains) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0.5}, {-1, 1, 0.5}, {-1, -1, 0.5}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const auto cut = cut_mesh(mesh, level(0.0));
  ASSERT_TRUE(cut);
  ASSERT_EQ(cut->size(), 3U);
  for (const MeshSection& one : *cut) EXPECT_FALSE(one.closed);
}

TEST(MeshCut, ASectionTurnsAndMovesWithTheMesh) {
  const TriangleMesh mesh = torus_mesh(5.0, 1.0, 40);
  const Frame plane{{0.1, 0.2, 0.3}, unit(Vec3{1, 2, -1}), unit(Vec3{2, -1, 0})};
  const auto cut = cut_mesh(mesh, plane);
  ASSERT_TRUE(cut);
  ASSERT_FALSE(cut->empty());
  for (const MeshSection& one : *cut) {
    for (const Vec2 p : one.points) EXPECT_NEAR(plane.height(plane.at(p)), 0.0, 1e-14);
  }
  TriangleMesh moved = mesh;  // a quarter turn about z is exact
  for (Vec3& p : moved.points) p = {-p.y, p.x, p.z};
  const auto turn = [](Vec3 p) { return Vec3{-p.y, p.x, p.z}; };
  const auto again = cut_mesh(moved, {turn(plane.origin), turn(plane.x), turn(plane.y)});
  ASSERT_TRUE(again);
  ASSERT_EQ(again->size(), cut->size());
  for (std::size_t i = 0; i < cut->size(); ++i) {
    ASSERT_EQ((*again)[i].points.size(), (*cut)[i].points.size());
    EXPECT_NEAR(signed_area((*again)[i]), signed_area((*cut)[i]), 1e-12);
  }
}

TEST(MeshCut, RandomTrianglesGiveChainsOrAnError) {
  std::mt19937 random(5);
  std::uniform_int_distribution<std::uint32_t> corner(0, 29);
  std::uniform_int_distribution<int> place(-3, 3);
  std::size_t chains = 0;
  for (int k = 0; k < 300; ++k) {
    TriangleMesh mesh;
    for (int i = 0; i < 30; ++i) {
      mesh.points.push_back({double(place(random)), double(place(random)), double(place(random))});
    }
    for (int i = 0; i < 80; ++i) {
      mesh.triangles.push_back({corner(random), corner(random), corner(random)});
    }
    const auto cut = cut_mesh(mesh, level(0.0));
    ASSERT_TRUE(cut);
    for (const MeshSection& one : *cut) {
      ++chains;
      ASSERT_GE(one.points.size(), 2U);
      for (std::size_t i = 1; i < one.points.size(); ++i) {
        ASSERT_FALSE(one.points[i] == one.points[i - 1]);
      }
    }
  }
  EXPECT_GT(chains, 300U);
}

TEST(MeshCut, RefusesCornersWithoutPointsAndPointsThatAreNotFinite) {
  TriangleMesh mesh = box({1, 1, 1});
  mesh.triangles.push_back({0, 1, 8});
  ASSERT_FALSE(cut_mesh(mesh, level(0.5)));
  EXPECT_EQ(cut_mesh(mesh, level(0.5)).error().code, ErrorCode::kBadCount);
  mesh = box({1, 1, 1});
  mesh.points[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(cut_mesh(mesh, level(0.5)).error().code, ErrorCode::kNotFinite);
  EXPECT_EQ(bounds_of({}).error().code, ErrorCode::kTooFewPoints);
  const auto bounds = bounds_of(box({2, 3, 5}));
  ASSERT_TRUE(bounds);
  EXPECT_EQ(bounds->low, (Vec3{0, 0, 0}));
  EXPECT_EQ(bounds->high, (Vec3{2, 3, 5}));
}

TEST(MeshCut, ASeamThatDiffersByRoundingOpensNoSection) {
  TriangleMesh seamed = box({3.0, 2.0, 1.0});
  // the edge from 0 to 4 once more, as another corner of its last side
  const auto copy = [&](std::uint32_t corner, double by) {
    Vec3 p = seamed.points[corner];
    p.x += by;
    seamed.points.push_back(p);
    return static_cast<std::uint32_t>(seamed.points.size() - 1);
  };
  for (const double by : {1e-15, 1e-3}) {
    seamed = box({3.0, 2.0, 1.0});
    const std::uint32_t low = copy(0, by), high = copy(4, by);
    for (std::size_t i = seamed.triangles.size() - 2; i < seamed.triangles.size(); ++i) {
      for (std::uint32_t& corner : seamed.triangles[i]) {
        corner = corner == 0 ? low : corner == 4 ? high : corner;
      }
    }
    const auto sections = cut_mesh(seamed, level(0.5));
    ASSERT_TRUE(sections);
    ASSERT_EQ(sections->size(), 1U);
    EXPECT_EQ(sections->front().closed, by < 1e-9);
  }
}

/// Corners of an equator lie a rounding above or below the plane by turns, as from sines and
/// cosines.
TEST(MeshCut, CornersNearlyInThePlaneAreOnePlaceEach) {
  constexpr std::uint32_t kMeridians = 120;
  constexpr double kRadius = 5.0, kTurn = 2.0 * 3.14159265358979323846;
  TriangleMesh mesh;
  for (const double height : {-1.0, 0.0, 1.0}) {
    for (std::uint32_t k = 0; k < kMeridians; ++k) {
      const double angle = kTurn * k / kMeridians, off = k % 2 == 0 ? 3e-16 : -3e-16;
      mesh.points.push_back({kRadius * std::cos(angle), kRadius * std::sin(angle), height + off});
    }
  }
  for (std::uint32_t row = 0; row < 2; ++row) {
    for (std::uint32_t k = 0; k < kMeridians; ++k) {
      const std::uint32_t a = row * kMeridians + k, b = row * kMeridians + (k + 1) % kMeridians;
      mesh.triangles.push_back({a, b, b + kMeridians});
      mesh.triangles.push_back({a, b + kMeridians, a + kMeridians});
    }
  }
  const auto cut = cut_mesh(mesh, Frame{});
  ASSERT_TRUE(cut);
  ASSERT_EQ(cut->size(), 1U);
  const std::vector<Vec2>& points = cut->front().points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_GT(norm(points[(i + 1) % points.size()] - points[i]), 1e-9);
  }
}

}  // namespace
}  // namespace obvid
