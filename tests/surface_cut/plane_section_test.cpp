// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_cut/internal/plane_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "obvid/surface/space_curve.h"
#include "obvid/surface/surface.h"
#include "obvid/surface_cut/internal/displaced.h"

namespace obvid {
namespace {

constexpr double kPi = std::numbers::pi;

SurfaceModel model_of(std::vector<NurbsSurface> surfaces) {
  SurfaceModel model;
  for (NurbsSurface& surface : surfaces) model.patches.push_back({"patch", std::move(surface)});
  return model;
}

NurbsSurface revolved(const SpaceCurve& profile) {
  RevolutionSurface turned;
  turned.profile = profile;
  turned.angle = 2.0 * kPi;
  return to_nurbs(turned, 1e-6)->surface;
}
SurfaceModel sphere(double radius) {
  return model_of({revolved(arc_about({0, 0, -radius}, {}, {0, -1, 0}, kPi))});
}
SurfaceModel torus(double large, double small) {
  return model_of(
      {revolved(arc_about({large + small, 0, 0}, {large, 0, 0}, {0, -1, 0}, 2.0 * kPi))});
}

/// Half of Wigley's hull: y = B / 2 (1 - (2 x / L)^2) (1 - (z / T)^2), z from -T to 0.
NurbsSurface wigley(double length, double breadth, double draught) {
  NurbsSurface s{2, 2, {0, 0, 0, 1, 1, 1}, {0, 0, 0, 1, 1, 1}, {}, {}};
  const double xs[] = {-1, 0, 1}, as[] = {0, 2, 0}, zs[] = {-1, -0.5, 0}, bs[] = {0, 1, 1};
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      s.points.push_back({length / 2 * xs[i], breadth / 2 * as[i] * bs[j], draught * zs[j]});
    }
  }
  return s;
}

PlaneSection section(const SurfaceModel& model, CutPlane plane, double tolerance = 1e-4) {
  const auto made = ModelCutter(model).section(plane, {tolerance * size_of(model)});
  EXPECT_TRUE(made) << to_line(made.error());
  return made ? *made : PlaneSection{};
}

double farthest(const PlaneSection& s, const std::function<double(Vec3)>& off) {
  double most = 0.0;
  for (const SectionBranch& branch : s.branches) {
    for (const SectionPoint& p : branch.points) most = std::max(most, std::abs(off(p.point)));
  }
  return most;
}

TEST(PlaneSection, OfASphereIsOneClosedCircleAtAnySize) {
  for (const double r : {1e-9, 1.0, 1e9}) {
    const SurfaceModel model = sphere(r);
    const Vec3 n = unit(Vec3{1.0, -2.0, 0.5});
    const PlaneSection s = section(model, {n, 0.6 * r});
    ASSERT_EQ(s.branches.size(), 1U);
    EXPECT_TRUE(s.branches[0].closed);
    EXPECT_LE(farthest(s, [&](Vec3 p) { return norm(p) - r; }), 1e-15 * r);
    EXPECT_LE(farthest(s, [&](Vec3 p) { return dot(n, p) - 0.6 * r; }), 1e-15 * r);
    EXPECT_TRUE(s.touching.empty());
  }
}

TEST(PlaneSection, AlongKnotsAndThroughPolesIsThereOnce) {
  const SurfaceModel model = sphere(2.0);
  for (const Vec3 n : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}}) {
    const PlaneSection s = section(model, {n, 0.0});
    ASSERT_EQ(s.branches.size(), 1U);
    EXPECT_TRUE(s.branches[0].closed);
    EXPECT_LE(s.residual, 1e-15);
    EXPECT_TRUE(s.touching.empty());
    // all round: no angle between neighbours is large
    const auto& points = s.branches[0].points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 next = points[(i + 1) % points.size()].point;
      EXPECT_LT(norm(next - points[i].point), 0.2);
    }
  }
}

TEST(PlaneSection, OfATorusHasTheBranchesOfVillarceauAndSpiricCurves) {
  const SurfaceModel model = torus(2.0, 0.7);
  // about z: across the axis two circles, along it two, beside the hole one
  for (const auto& [plane, branches] :
       {std::pair{CutPlane{{0, 0, 1}, 0.3}, 2U}, std::pair{CutPlane{{1, 0, 0}, 0.0}, 2U},
        std::pair{CutPlane{{1, 0, 0}, 1.2}, 2U}, std::pair{CutPlane{{1, 0, 0}, 1.5}, 1U},
        std::pair{CutPlane{{1, 0, 0}, 2.8}, 0U}}) {
    const PlaneSection s = section(model, plane);
    EXPECT_EQ(s.branches.size(), branches) << plane.offset;
    for (const SectionBranch& branch : s.branches) EXPECT_TRUE(branch.closed);
  }
}

TEST(PlaneSection, FindsALoopOfAHundredThousandthOfTheSize) {
  const SurfaceModel model = sphere(1.0);
  const double depth = 1e-10;  // of the cap: a circle of radius 1.4e-5
  const Vec3 n = unit(Vec3{0.3, 0.4, 0.7});
  const PlaneSection s = section(model, {n, 1.0 - depth}, 1e-8);
  ASSERT_EQ(s.branches.size(), 1U);
  EXPECT_TRUE(s.branches[0].closed);
}

TEST(PlaneSection, TellsWhereThePlaneTouches) {
  const PlaneSection point = section(sphere(1.0), {unit(Vec3{0.3, 0.4, 0.7}), 1.0});
  EXPECT_TRUE(point.branches.empty());
  ASSERT_EQ(point.touching.size(), 1U);
  EXPECT_LE(norm(point.touching[0] - unit(Vec3{0.3, 0.4, 0.7})), 1e-4);
  const PlaneSection circle = section(torus(2.0, 0.7), {{0, 0, 1}, 0.7});
  EXPECT_TRUE(circle.branches.empty());
  EXPECT_GE(circle.touching_lines + circle.undecided, 1U);
  EXPECT_TRUE(section(sphere(1.0), {{0, 0, 1}, 1.0 + 1e-9}).touching.empty());
}

TEST(PlaneSection, ALineAlongWhichItTouchesIsThereOnce) {
  // with knots on its top a torus is met on both sides of them
  const SurfaceModel model = torus(5.0, 1.5);
  for (const double z : {1.5, -1.5}) {
    for (const double up : {1.0, -1.0}) {
      const PlaneSection s = section(model, {{0, 0, up}, up * z});
      EXPECT_TRUE(s.branches.empty());
      EXPECT_EQ(s.undecided, 0U);
      EXPECT_EQ(s.touching_lines, 1U);
    }
  }
}

TEST(PlaneSection, APlaneThatTouchesACappedBodyCutsNoSliverOfIt) {
  for (const double top : {1.0, 0.3}) {  // a cylinder, a cone
    SpaceCurve profile;
    profile.degree = 1;
    profile.knots = {0, 0, 1, 2, 3, 3};
    profile.points = {{0, 0, 0}, {1, 0, 0}, {top, 0, 2}, {0, 0, 2}};
    const SurfaceModel body = model_of({revolved(profile)});
    for (const double turn : {0.0, 0.4, 2.0}) {
      const Vec3 normal = unit(Vec3{2.0 * std::cos(turn), 2.0 * std::sin(turn), 1.0 - top});
      const Vec3 on_wall{std::cos(turn), std::sin(turn), 0.0};
      const PlaneSection s = section(body, {normal, dot(normal, on_wall)});
      EXPECT_TRUE(s.branches.empty()) << top << ' ' << turn;
      EXPECT_GE(s.touching.size() + s.touching_lines + s.undecided, 1U);
      // beside it there is a branch, however narrow: 2 sqrt(2 d) wide at the foot
      const PlaneSection beside = section(body, {normal, dot(normal, on_wall) - 1e-8});
      EXPECT_EQ(beside.branches.size(), 1U) << top << ' ' << turn;
    }
  }
}

TEST(PlaneSection, BordersInThePlaneAreExactAndJoined) {
  const SurfaceModel model = model_of({wigley(10.0, 1.0, 0.625)});
  const PlaneSection s = section(model, {{0, 1, 0}, 0.0});
  ASSERT_EQ(s.branches.size(), 1U);  // stem, keel and stern
  EXPECT_FALSE(s.branches[0].closed);
  EXPECT_EQ(farthest(s, [](Vec3 p) { return p.y; }), 0.0);
  const auto& points = s.branches[0].points;
  EXPECT_EQ(points.front().point.z, 0.0);
  EXPECT_EQ(points.back().point.z, 0.0);
  EXPECT_EQ(points.size(), 4U);
}

TEST(PlaneSection, GoesOnAcrossPatches) {
  const NurbsSurface whole = wigley(10.0, 1.0, 0.625);
  const auto [aft, fore] = split_u(whole, 0.4);
  const auto [low, high] = split_v(fore, 0.5);
  const SurfaceModel model = model_of({aft, reversed_u(low), transposed(high)});
  for (const double z : {-0.5, -0.15625, -0.1, 0.0}) {
    const PlaneSection s = section(model, {{0, 0, 1}, z});
    // the side of the aft patch is longer than those of the others: ends are joined by their places
    ASSERT_EQ(s.branches.size(), 1U) << z;
    const auto off = [&](Vec3 p) {
      return p.y - 0.5 * (1 - p.x * p.x / 25.0) * (1 - z * z / (0.625 * 0.625));
    };
    EXPECT_LE(farthest(s, off), 1e-15);
    EXPECT_LE(s.branches[0].gap, 1e-12);
  }
}

TEST(PlaneSection, FarFromTheOriginIsAsExactAsItsCoordinates) {
  NurbsSurface hull = wigley(10.0, 1.0, 0.625);
  for (Vec3& p : hull.points) p = p + Vec3{1e6, -3e6, 2e6};
  const SurfaceModel model = model_of({hull});
  const PlaneSection s = section(model, {{0, 0, 1}, 2e6 - 0.3});
  ASSERT_EQ(s.branches.size(), 1U);
  EXPECT_LE(s.residual, 1e-9);
}

TEST(PlaneSection, ParametersAreThoseOfThePoints) {
  const SurfaceModel model = torus(3.0, 1.0);
  const PlaneSection s = section(model, {unit(Vec3{1, 2, 3}), 0.4});
  for (const SectionBranch& branch : s.branches) {
    for (const SectionPoint& p : branch.points) {
      EXPECT_EQ(evaluate(model.patches[p.patch].surface, p.u, p.v).point, p.point);
    }
  }
}

TEST(PlaneSection, RefusesWhatIsNoPlane) {
  const SurfaceModel model = sphere(1.0);
  const ModelCutter cutter(model);
  EXPECT_EQ(cutter.section({{0, 0, 2}, 0.0}, {0.1}).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(cutter.section({{0, 0, 1}, 0.0}, {0.0}).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(cutter.section({{0, 0, 1}, NAN}, {0.1}).error().code, ErrorCode::kNotFinite);
  RunContext run;
  run.cancelled = [] { return true; };
  EXPECT_EQ(cutter.section({{0, 0, 1}, 0.0}, {0.1}, run).error().code, ErrorCode::kCancelled);
}

void expect_near(const MeasuredFigure& found, double expected, double size) {
  EXPECT_NEAR(found.value, expected, 1e-11 * size);
  EXPECT_LE(std::abs(found.value - expected), found.error + 1e-13 * size);
}

TEST(DisplacedVolume, OfASphericalSegment) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const double r = 2.0 * scale, water = 0.7 * scale, h = r + water;
    const auto found = displaced(sphere(r), {water, false});
    ASSERT_TRUE(found);
    const double volume = kPi * h * h * (3.0 * r - h) / 3.0;
    expect_near(found->volume, volume, r * r * r);
    expect_near(found->wetted, 2.0 * kPi * r * h, r * r);
    const double a2 = r * r - water * water;
    expect_near(found->waterplane, kPi * a2, r * r);
    expect_near(found->inertia_x, kPi * a2 * a2 / 4.0, r * r * r * r);
    // centroid of a segment of height h below the cut: 3 (2 r - h)^2 / (4 (3 r - h)) from the
    // centre
    const double z = -3.0 * (2.0 * r - h) * (2.0 * r - h) / (4.0 * (3.0 * r - h));
    expect_near(found->centre_z, z, r);
    expect_near(found->centre_x, 0.0, r);
  }
}

TEST(DisplacedVolume, OfHalfOfWigleysHullWhereverItsPatchesAreCut) {
  const double l = 10.0, b = 1.0, t = 0.625;
  const NurbsSurface whole = wigley(l, b, t);
  const auto [aft, fore] = split_u(whole, 0.4);
  for (const SurfaceModel& model :
       {model_of({whole}), model_of({aft, reversed_u(fore)}), model_of({transposed(whole)})}) {
    const auto found = displaced(model, {0.0, true});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->parts, 1U);
    EXPECT_EQ(found->twisted, 0U);
    expect_near(found->volume, 4.0 / 9.0 * l * b * t, l * b * t);
    expect_near(found->waterplane, 2.0 / 3.0 * l * b, l * b);
    expect_near(found->centre_z, -3.0 / 8.0 * t, t);
    expect_near(found->centre_x, 0.0, l);
    expect_near(found->inertia_x, 2.0 / 3.0 * std::pow(b / 2, 3) * l * 16.0 / 35.0, l * b);
    const double z = -0.25, w = -z / t;  // a lower water
    const auto lower = displaced(model, {z, true});
    expect_near(lower->volume, 2.0 / 3.0 * l * b * t * (2.0 / 3.0 - w + w * w * w / 3.0),
                l * b * t);
  }
}

/// A flat patch with these corners.
NurbsSurface flat(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  NurbsSurface out;
  out.degree_u = out.degree_v = 1;
  out.knots_u = out.knots_v = {0, 0, 1, 1};
  out.points = {a, b, c, d};  // a b along u, then c d
  return out;
}

TEST(DisplacedVolume, TellsWhatIsOpenBelowTheWater) {
  // a box 4 x 2 x 1 from the origin on without its lid; the bottom may be missing, or begin at y =
  // s
  const auto walls = [](double s, bool bottom, double raked) {
    std::vector<NurbsSurface> out = {
        flat({0, s, 0}, {0, 2, 0}, {0, s, 1}, {0, 2, 1}),
        flat({4, s, 0}, {4, 2, 0}, {4 + raked, s, 1}, {4 + raked, 2, 1}),
        flat({0, 2, 0}, {4, 2, 0}, {0, 2, 1}, {4 + raked, 2, 1})};
    if (s == 0.0) out.push_back(flat({0, 0, 0}, {4, 0, 0}, {0, 0, 1}, {4 + raked, 0, 1}));
    if (bottom) out.push_back(flat({0, s, 0}, {4, s, 0}, {0, 2, 0}, {4, 2, 0}));
    return out;
  };
  const auto of = [](const std::vector<NurbsSurface>& patches, double water, bool half) {
    return displaced(model_of(patches), {water, half});
  };
  const auto closed = of(walls(0, true, 0), 0.5, false);
  ASSERT_TRUE(closed);
  EXPECT_EQ(closed->open_volume, 0.0);
  EXPECT_NEAR(closed->volume.value, 4.0, 1e-12);
  // without its bottom: all of it, 4 x 2 x 0.5
  const auto without = of(walls(0, false, 0), 0.5, false);
  EXPECT_NEAR(without->open_volume, 4.0, 1e-9);
  EXPECT_NEAR(without->open_width, 2.0, 1e-12);
  // half a barge that begins at 0.1: 2 x 0.1 x 4 x 0.5 lack in 4.0 of both halves
  auto half = walls(0.1, true, 0);
  const auto siding = of(half, 0.5, true);
  EXPECT_NEAR(siding->volume.value, 2 * 1.9 * 4 * 0.5, 1e-12);
  EXPECT_NEAR(siding->open_volume, 0.4, 1e-12);
  EXPECT_NEAR(siding->open_width, 0.1, 1e-12);
  EXPECT_EQ(of(half, 0.5, false)->open_volume, 0.0);  // its own body ends there
  // an upright end may be missing; a raked one is told: 2 x 0.6 x 0.5^2 / 2
  auto open_end = walls(0, true, 0.6);
  open_end.erase(open_end.begin() + 1);
  const auto raked = of(open_end, 0.5, false);
  EXPECT_NEAR(raked->open_volume, 2.0 * 0.6 * 0.125, 1e-9);
  auto upright = walls(0, true, 0);
  upright.erase(upright.begin() + 1);
  EXPECT_EQ(of(upright, 0.5, false)->open_volume, 0.0);
}

TEST(DisplacedVolume, OfWhatDoesNotReachTheWaterIsNothing) {
  const auto above = displaced(sphere(1.0), {-2.0, false});
  ASSERT_TRUE(above);
  EXPECT_EQ(above->volume.value, 0.0);
  EXPECT_TRUE(std::isnan(above->centre_x.value));
  const auto below = displaced(sphere(1.0), {5.0, false});
  EXPECT_NEAR(below->volume.value, 4.0 / 3.0 * kPi, 1e-11);
  EXPECT_TRUE(std::isnan(below->plane_x.value));
  for (const double r : {1e-3, 1.0, 2.256, 1e5}) {  // nothing, not what rounding leaves of it
    const auto sunk = displaced(sphere(r), {1.5 * r, false});
    ASSERT_TRUE(sunk);
    EXPECT_EQ(sunk->waterplane.value, 0.0);
    EXPECT_EQ(sunk->inertia_x.value, 0.0);
  }
}

}  // namespace
}  // namespace obvid
