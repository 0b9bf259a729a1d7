// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/internal/enclosed.h"

#include "kinds_shapes.h"

namespace obvid {
namespace {

using namespace kinds_test;

constexpr double kWhole = 2.0 * kPi;

/// A level circle about the axis of z, in either direction.
SpaceCurve level_circle(double radius, double z, bool clockwise) {
  return arc_about({radius, 0, z}, {0, 0, z}, clockwise ? -kZ : kZ, kWhole);
}

std::vector<SurfacePatch> patch_of(const Surface& surface) {
  return {{"part 1", to_nurbs(surface, 1e-9)->surface}};
}

/// Polygons of 32 sides and more in the place of circles take less than a hundredth of the area,
/// less than two of a volume that is round both ways.
constexpr double kOfPolygons = 0.02;

TEST(Enclosed, VolumesOfClosedFormsHaveTheSignOfTheirNormals) {
  struct Body {
    Surface surface;
    double volume;  ///< more than 0: du x dv points out of it
  };
  const SpaceCurve north = arc_about({0, 0, -2}, {}, {0, -1, 0}, kPi);  // by way of x = 2
  const SpaceCurve tube = arc_about({4, 0, 0}, {3, 0, 0}, {0, -1, 0}, kWhole);
  const double ball = 4.0 / 3.0 * kPi * 8.0, torus = 2.0 * kPi * kPi * 3.0;
  const double frustum = kPi * 5.0 / 3.0 * (4.0 + 2.0 + 1.0);
  for (const Vec3 shift : {Vec3{}, Vec3{1e4, -2e4, 3e4}}) {
    const auto moved = [&](SpaceCurve curve) {
      for (Vec3& p : curve.points) p = p + shift;
      return curve;
    };
    const auto turned = [&](const SpaceCurve& curve) {
      return RevolutionSurface{moved(curve), shift, kZ, kWhole};
    };
    for (const Body& body : std::vector<Body>{
             {turned(north), -ball},
             {turned(reversed(north)), ball},
             {turned(tube), -torus},
             {turned(reversed(tube)), torus},
             {RuledSurface{moved(level_circle(2, 0, false)), moved(level_circle(1, 5, false))},
              frustum},
             {RuledSurface{moved(level_circle(2, 0, true)), moved(level_circle(1, 5, true))},
              -frustum},
             {RuledSurface{moved(level_circle(1, 5, false)), moved(level_circle(2, 0, false))},
              -frustum},
         }) {
      const auto found = enclosed_volume(patch_of(body.surface));
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->value, body.volume, kOfPolygons * std::abs(body.volume));
      EXPECT_EQ(found->sign(), body.volume > 0.0 ? 1 : -1);
    }
  }
}

TEST(Enclosed, NothingIsWhereASurfaceIsOpen) {
  const SpaceCurve north = arc_about({0, 0, -2}, {}, {0, -1, 0}, kPi);
  for (const Surface& surface : std::vector<Surface>{
           RevolutionSurface{north, {}, kZ, 0.9 * kWhole},
           cylinder_over(north, {0, 1, 0}),
       }) {
    std::vector<SurfacePatch> patches = patch_of(surface);
    const std::vector<Vec3> before = patches.front().surface.points;
    EXPECT_FALSE(enclosed_volume(patches));
    EXPECT_FALSE(turn_outward(patches));
    EXPECT_TRUE(patches.front().surface.points == before);
  }
}

TEST(Enclosed, APlaneRingHasNoInside) {
  for (const bool clockwise : {false, true}) {
    for (const double z : {0.0, 1e6}) {
      std::vector<SurfacePatch> patches =
          patch_of(RuledSurface{level_circle(1, z, clockwise), level_circle(2, z, clockwise)});
      const auto found = enclosed_volume(patches);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->sign(), 0);
      EXPECT_FALSE(turn_outward(patches));
    }
  }
}

TEST(Enclosed, PatchesThatCloseTogetherAreTurnedTogether) {
  for (const bool clockwise : {false, true}) {
    const NurbsSurface whole =
        patch_of(RuledSurface{level_circle(2, 0, clockwise), level_circle(1, 5, clockwise)})
            .front()
            .surface;
    const auto halves = split_u(whole, 0.4);
    std::vector<SurfacePatch> patches{{"part 1", halves[0]}, {"part 2", halves[1]}};
    EXPECT_EQ(turn_outward(patches), clockwise);
    for (const SurfacePatch& patch : patches) {
      over(patch.surface, [&](double u, double v) {
        const SurfaceJet jet = evaluate(patch.surface, u, v);
        const Vec3 normal = unit(cross(jet.du, jet.dv));
        // radius 2 - z / 5: the normal of the cone is (5, 1) in the plane of radius and z
        const double rho = std::hypot(jet.point.x, jet.point.y);
        const double radial = (normal.x * jet.point.x + normal.y * jet.point.y) / rho;
        EXPECT_NEAR(radial, 5.0 / std::sqrt(26.0), 1e-12);
        EXPECT_NEAR(normal.z, 1.0 / std::sqrt(26.0), 1e-12);
      });
    }
    EXPECT_FALSE(turn_outward(patches));
  }
}

}  // namespace
}  // namespace obvid
