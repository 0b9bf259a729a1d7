// SPDX-License-Identifier: Apache-2.0
// Normals of surfaces that close around a volume point out of it, however they were listed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../common/angles.h"
#include "obvid/pipeline/surface_job.h"

namespace obvid {
namespace {

SpaceSeries in_order(std::vector<Vec3> points, bool backwards) {
  if (backwards) std::reverse(points.begin(), points.end());
  SpaceSeries series;
  series.name = "points";
  series.points = std::move(points);
  return series;
}

/// Calls `visit(point, normal)` for places inside all patches.
template <class Visit>
void over_normals(const MadeSurface& made, const Visit& visit) {
  for (const SurfacePatch& patch : made.model.patches) {
    for (const double a : {0.05, 0.2, 0.45, 0.6, 0.83, 0.95}) {
      for (const double b : {0.0, 0.1, 0.3, 0.5, 0.77, 1.0}) {
        const SurfaceJet jet =
            evaluate(patch.surface, domain_u(patch.surface).at(a), domain_v(patch.surface).at(b));
        visit(jet.point, unit(cross(jet.du, jet.dv)));
      }
    }
  }
}

Vec3 away_from_z(Vec3 p) { return unit({p.x, p.y, 0.0}); }

MadeSurface revolved(std::vector<Vec3> profile, bool backwards, double angle = kFullTurn) {
  SurfaceJob job;
  job.kind = RevolveKind{{}, {0, 0, 1}, angle};
  job.inputs = {SurfaceInput::of_points(in_order(std::move(profile), backwards))};
  auto made = make_surface(job);
  if (!made) {
    ADD_FAILURE() << to_line(made.error());
    return {};
  }
  return *made;
}

TEST(SkinOutward, ASphereByRevolve) {
  std::vector<Vec3> half;
  for (int i = 0; i <= 16; ++i) {
    const double t = kPi * (i / 16.0 - 0.5);
    half.push_back({2.0 * std::cos(t), 0.0, 2.0 * std::sin(t)});
  }
  half.front().x = half.back().x = 0.0;
  for (const bool backwards : {false, true}) {
    for (const double angle : {kFullTurn, 1.0, -1.0, -kFullTurn}) {
      over_normals(revolved(half, backwards, angle),
                   [](Vec3 p, Vec3 normal) { EXPECT_GT(dot(normal, unit(p)), 0.99); });
    }
  }
}

TEST(SkinOutward, AConeByRevolve) {
  // radius 3 - z, from z = 0 to 2: the normal is (1, 1) in the plane of radius and z
  std::vector<Vec3> side;
  for (int i = 0; i <= 4; ++i) side.push_back({3.0 - 0.5 * i, 0.0, 0.5 * i});
  for (const bool backwards : {false, true}) {
    for (const double angle : {kFullTurn, 2.0, -2.0}) {
      over_normals(revolved(side, backwards, angle), [](Vec3 p, Vec3 normal) {
        EXPECT_NEAR(dot(normal, away_from_z(p)), std::sqrt(0.5), 1e-9);
        EXPECT_NEAR(normal.z, std::sqrt(0.5), 1e-9);
      });
    }
  }
}

TEST(SkinOutward, ARingByRevolve) {
  // a closed profile, a circle about (5, 0): the inside is that of the circle
  std::vector<Vec3> loop;
  for (int i = 0; i <= 24; ++i) {
    const double t = 2.0 * kPi * (i % 24) / 24.0;
    loop.push_back({5.0 + std::cos(t), 0.0, std::sin(t)});
  }
  for (const bool backwards : {false, true}) {
    over_normals(revolved(loop, backwards), [](Vec3 p, Vec3 normal) {
      EXPECT_GT(dot(normal, unit(p - 5.0 * away_from_z(p))), 0.99);
    });
  }
}

TEST(SkinOutward, ATubeOfSectionsInEitherDirection) {
  for (const bool clockwise : {false, true}) {
    for (const bool downwards : {false, true}) {
      SurfaceJob job;
      for (int k = 0; k < 4; ++k) {
        std::vector<Vec3> ring;
        for (int i = 0; i <= 20; ++i) {
          const double t = 2.0 * kPi * (i % 20) / 20.0;
          ring.push_back({3.0 * std::cos(t), 2.0 * std::sin(t), downwards ? -2.0 * k : 2.0 * k});
        }
        job.inputs.push_back(SurfaceInput::of_points(in_order(ring, clockwise)));
      }
      const auto made = make_surface(job);
      ASSERT_TRUE(made) << to_line(made.error());
      over_normals(*made, [](Vec3 p, Vec3 normal) {
        EXPECT_GT(dot(normal, unit({p.x / 9.0, p.y / 4.0, 0.0})), 0.99);
      });
    }
  }
}

}  // namespace
}  // namespace obvid
