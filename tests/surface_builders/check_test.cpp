// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/check.h"
#include "../common/angles.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "obvid/surface/internal/trim.h"

namespace obvid {
namespace {

NurbsSurface nurbs(const Surface& surface) { return to_nurbs(surface, 1e-9)->surface; }

NurbsSurface sphere_zone() {
  // latitudes -60 to 60 degrees, a full turn
  const Vec3 start{2 * std::cos(-kPi / 3), 0, 2 * std::sin(-kPi / 3)};
  return nurbs(RevolutionSurface{
      arc_about(start, {0, 0, 0}, {0, -1, 0}, 2 * kPi / 3), {0, 0, 0}, {0, 0, 1}, 2 * kPi});
}

SurfaceCheck checked(const SurfaceModel& model, const CheckOptions& options = {}) {
  const auto found = check_surface(model, options);
  EXPECT_TRUE(found);
  return found.value_or(SurfaceCheck{});
}

TEST(CheckSurface, MeasuresASphereAndItsSeam) {
  const SurfaceCheck found = checked({"s", "mm", {{"zone", sphere_zone()}}});
  ASSERT_EQ(found.patches.size(), 1u);
  const PatchReport& p = found.patches[0];
  EXPECT_NEAR(p.gaussian.least, 0.25, 1e-11);
  EXPECT_NEAR(p.gaussian.most, 0.25, 1e-11);
  // 2 pi r h with h = 2 r sin 60
  const double area = 2 * kPi * 2 * (2 * 2 * std::sin(kPi / 3));
  EXPECT_NEAR(p.area, area, 1e-9 * area);
  EXPECT_LE(std::abs(p.area - area), p.area_error + 1e-14 * area);
  EXPECT_GT(p.area_error, 0.0);
  EXPECT_LT(p.area_error, 1e-8 * area);
  EXPECT_TRUE(p.rational);
  EXPECT_EQ(p.order_v, 0);                         // double knots of quarter arcs say no more
  EXPECT_EQ(p.along_u.monotone, p.along_u.lines);  // circles
  EXPECT_EQ(p.along_u.vertices, 0u);
  EXPECT_EQ(p.along_v.inflections, 0u);
  // the seam is a border that meets itself smoothly
  ASSERT_EQ(found.joints.size(), 1u);
  EXPECT_EQ(found.joints[0].side, (std::array{kVStart, kVEnd}));
  EXPECT_EQ(found.joints[0].order, 2);
  EXPECT_LT(found.joints[0].angle, 1e-12);
}

/// A profile that meets its axis aslant: curvature has no bound at the pole, and a surface of
/// revolution is smooth at its seam all the same.
TEST(CheckSurface, ThePoleAtTheEndOfASeamIsNoStepOfCurvature) {
  const Vec3 axis = unit({0.3, -0.5, 0.8}), beside = unit(cross(axis, {1, 0, 0}));
  const Vec3 pole = 48.0 * axis, centre = pole - 60.0 * beside - 35.0 * axis;
  NurbsSurface vase = nurbs(RevolutionSurface{
      arc_about(pole, centre, unit(cross(axis, beside)), 0.5), {0, 0, 0}, axis, 2 * kPi});
  std::size_t k = 0;  // the last digits of its points, as files have them
  for (Vec3& p : vase.points) p = p + 1e-14 * static_cast<double>(k++ % 7) * Vec3{1, -1, 1};
  const SurfaceCheck found = checked({"s", "mm", {{"vase", vase}}});
  ASSERT_EQ(found.joints.size(), 1u);
  EXPECT_EQ(found.joints[0].order, 2);
  EXPECT_LT(found.joints[0].curvature, 1e-6);
}

/// A sphere turned and moved: the points that its poles have become are apart by rounding, which is
/// no line with vertices and inflections.
TEST(CheckSurface, APoleIsNoLine) {
  const Vec3 centre{123.456, -55.3, 77.7}, axis = unit({0.3, -0.5, 0.8});
  const Vec3 beside = unit(cross(axis, {1, 0, 0}));
  NurbsSurface sphere = nurbs(RevolutionSurface{
      arc_about(centre - 10.0 * axis, centre, beside, kPi), centre, axis, 2 * kPi});
  std::size_t pole = 0;  // the last digits of its points, as files have them
  for (Vec3& p : sphere.points) {
    if (norm(p - centre - 10.0 * axis) < 1e-9 || norm(p - centre + 10.0 * axis) < 1e-9) {
      p = p + 1e-14 * static_cast<double>(++pole % 5) * Vec3{1, -1, 1};
    }
  }
  ASSERT_GT(pole, 10u);
  const SurfaceCheck found = checked({"s", "mm", {{"sphere", sphere}}});
  const PatchReport& p = found.patches[0];
  for (const LineReport& lines : {p.along_u, p.along_v}) {
    EXPECT_EQ(lines.vertices, 0u);
    EXPECT_EQ(lines.inflections, 0u);
    EXPECT_EQ(lines.monotone, lines.lines);
    EXPECT_GE(lines.lines, 63u);
  }
  EXPECT_EQ(p.along_u.lines + p.along_v.lines, 2u * 65u - 2u);  // the poles are none
}

/// A disc cut out of a plate: what lies between its trim and what that stands for is a ring.
TEST(CheckSurface, TheAreaOfATrimmedPatchIsAsExactAsItsTrims) {
  NurbsSurface plate;
  plate.degree_u = plate.degree_v = 1;
  plate.knots_u = plate.knots_v = {0, 0, 1, 1};
  plate.points = {{-3, -3, 0}, {3, -3, 0}, {-3, 3, 0}, {3, 3, 0}};
  const double w = std::sqrt(0.5), r = 1.0 / 6.0;
  NurbsCurve circle{2,
                    {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4},
                    {{r, 0}, {r, -r}, {0, -r}, {-r, -r}, {-r, 0}, {-r, r}, {0, r}, {r, r}, {r, 0}},
                    {1, w, 1, w, 1, w, 1, w, 1}};
  for (Vec2& p : circle.points) p = p + Vec2{0.5, 0.5};
  SurfacePatch patch{"plate", plate, {outline_of(plate), {{circle}}}, 1e-3};
  const PatchReport p = checked({"s", "mm", {patch}}).patches[0];
  EXPECT_NEAR(p.area, 36.0 - kPi, 1e-9);
  EXPECT_NEAR(p.area_error, 2 * kPi * 1e-3, 1e-6);  // the sides of the plate are exact
  patch.trims_within = 0.0;
  EXPECT_LT(checked({"s", "mm", {patch}}).patches[0].area_error, 1e-6);
}

TEST(CheckSurface, TellsCornersFromSmoothBorders) {
  const NurbsSurface flat = nurbs(cylinder_over(line_between({0, 0, 0}, {2, 0, 0}), {0, 1, 0}));
  const NurbsSurface wall = nurbs(cylinder_over(line_between({0, 1, 0}, {2, 1, 0}), {0, 0, 1}));
  const auto [left, right] = split_u(flat, 0.25);
  const SurfaceCheck found = checked(
      {"s", "mm", {{"left", left}, {"right", reversed_u(right)}, {"whole", flat}, {"wall", wall}}});
  int smooth = 0, square = 0;
  for (const JointReport& j : found.joints) {
    if (j.patch == std::array<std::size_t, 2>{0, 1}) {
      ++smooth;
      EXPECT_EQ(j.order, 2);
      EXPECT_EQ(j.side, (std::array{kUEnd, kUEnd}));  // the second runs backwards
    }
    if (j.patch == std::array<std::size_t, 2>{2, 3}) {
      ++square;
      EXPECT_NEAR(j.angle, kPi / 2, 1e-12);
      EXPECT_EQ(j.order, 0);
    }
  }
  EXPECT_EQ(smooth, 1);
  EXPECT_EQ(square, 1);
}

TEST(CheckSurface, SeesTheStepOfCurvatureFromPlaneToCylinder) {
  const SpaceCurve arc = arc_about({0, 0, 0}, {0, 0, 1}, {0, -1, 0}, 1.0);  // leaves along +x, up
  const NurbsSurface round = nurbs(cylinder_over(arc, {0, 3, 0}));
  const NurbsSurface flat = nurbs(cylinder_over(line_between({-2, 0, 0}, {0, 0, 0}), {0, 3, 0}));
  const SurfaceCheck found = checked({"s", "mm", {{"flat", flat}, {"round", round}}});
  ASSERT_EQ(found.joints.size(), 1u);
  EXPECT_LT(found.joints[0].angle, 1e-12);
  EXPECT_NEAR(found.joints[0].curvature, 1.0, 1e-9);
  EXPECT_EQ(found.joints[0].order, 1);
}

TEST(CheckSurface, MeasuresShortSpansToo) {
  // a cylinder over a line of 1000 with a quarter of a circle of radius 1 at its end, whose span of
  // the parameter is far shorter than a cell of the raster
  const double length = 1000.0;
  SpaceCurve bend;
  bend.degree = 2;
  bend.knots = {0, 0, 0, length, length, length + 1, length + 1, length + 1};
  const double w = std::sqrt(0.5);
  bend.points = {
      {0, 0, 0}, {length / 2, 0, 0}, {length, 0, 0}, {length + 1, 0, 0}, {length + 1, 1, 0}};
  bend.weights = {1, 1, 1, w, 1};
  const NurbsSurface s = nurbs(cylinder_over(bend, {0, 0, 1}));
  const SurfaceCheck found = checked({"s", "mm", {{"bend", s}}}, {5, {}});
  EXPECT_NEAR(std::max(std::abs(found.patches[0].mean.least), std::abs(found.patches[0].mean.most)),
              0.5, 1e-9);
  EXPECT_NEAR(found.patches[0].area, length + kPi / 2, 0.1 * kPi);
}

/// z = (x^2 + y^2) / 2 over [from, to]^2: Gaussian curvature 1 / (1 + x^2 + y^2)^2.
NurbsSurface paraboloid(double from, double to) {
  NurbsSurface s;
  s.degree_u = s.degree_v = 2;
  s.knots_u = s.knots_v = {0, 0, 0, 1, 1, 1};
  const std::array<double, 3> at{from, (from + to) / 2, to},
      square{from * from, from * to, to * to};
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) {
      s.points.push_back({at[i], at[j], (square[i] + square[j]) / 2});
    }
  }
  return s;
}

TEST(CheckSurface, FindsExtremesBetweenItsPlacesAndOnBorders) {
  const auto gaussian = [](double r2) { return 1.0 / ((1.0 + r2) * (1.0 + r2)); };
  // half of the sum of 1 and 1 / (1 + r^2), over sqrt(1 + r^2)
  const auto mean = [](double r2) { return (2.0 + r2) / (2.0 * std::pow(1.0 + r2, 1.5)); };
  for (const std::size_t samples : {3u, 5u, 65u}) {
    const CurvatureExtents inside = curvature_extents(paraboloid(-1.0, 0.7), samples);
    EXPECT_NEAR(inside.gaussian.most, 1.0, 1e-9);
    EXPECT_NEAR(inside.mean.most, 1.0, 1e-9);
    EXPECT_NEAR(inside.gaussian.least, gaussian(2.0), 1e-6);
    const CurvatureExtents border = curvature_extents(paraboloid(0.5, 1.5), samples);
    EXPECT_NEAR(border.gaussian.most, gaussian(0.5), 1e-6);
    EXPECT_NEAR(border.gaussian.least, gaussian(4.5), 1e-6);
    EXPECT_NEAR(border.mean.least, mean(4.5), 1e-6);
    EXPECT_NEAR(border.k1.most, std::pow(1.5, -0.5), 1e-6);
    EXPECT_NEAR(border.k2.most, std::pow(1.5, -1.5), 1e-6);
  }
}

/// Turned about z from its first point, which lies on the axis.
NurbsSurface with_pole(const SpaceCurve& profile) {
  return nurbs(RevolutionSurface{profile, {0, 0, 0}, {0, 0, 1}, 2 * kPi});
}

TEST(CheckSurface, TheTipOfAConeHasNoBoundHoweverManyPlacesAreLookedAt) {
  const NurbsSurface cone = with_pole(line_between({0, 0, 0}, {3, 0, 4}));
  for (const std::size_t samples : {3u, 5u, 65u, 200u}) {
    const CurvatureExtents found = curvature_extents(cone, samples);
    // across the generators 4/5 over the distance from the axis, 3 at the most; along them nothing
    const double rim = 0.8 / 3.0, side = found.mean.most > 0.0 ? 1.0 : -1.0;
    const double endless = side > 0.0 ? found.mean.most : -found.mean.least;
    const double least = side > 0.0 ? found.mean.least : -found.mean.most;
    EXPECT_TRUE(std::isinf(endless)) << samples;
    EXPECT_NEAR(least, 0.5 * rim, 1e-6) << samples;
    EXPECT_NEAR(found.gaussian.least, 0.0, 1e-6) << samples;
    EXPECT_NEAR(found.gaussian.most, 0.0, 1e-6) << samples;
  }
}

TEST(CheckSurface, APoleOfABoundedCurvatureHasIt) {
  const NurbsSurface half_ball = with_pole(arc_about({0, 0, -2}, {0, 0, 0}, {0, -1, 0}, kPi / 2));
  SpaceCurve parabola;  // z = x^2 / 2: both curvatures are 1 at the pole and fall from there
  parabola.degree = 2;
  parabola.knots = {0, 0, 0, 1, 1, 1};
  parabola.points = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0.5}};
  for (const std::size_t samples : {3u, 5u, 65u}) {
    const CurvatureExtents ball = curvature_extents(half_ball, samples);
    EXPECT_NEAR(ball.gaussian.least, 0.25, 1e-6) << samples;
    EXPECT_NEAR(ball.gaussian.most, 0.25, 1e-6) << samples;
    const CurvatureExtents bowl = curvature_extents(with_pole(parabola), samples);
    EXPECT_NEAR(std::max(bowl.mean.most, -bowl.mean.least), 1.0, 1e-4) << samples;
    EXPECT_NEAR(bowl.gaussian.most, 1.0, 1e-4) << samples;
    EXPECT_NEAR(bowl.gaussian.least, 0.25, 1e-6) << samples;  // 1 / (1 + r^2)^2 at r = 1
  }
}

TEST(CheckSurface, LastDigitsOfAPoleAreNoCurvatureWithoutBound) {
  // as files have it: the control points of the pole and beside it are a few roundings apart
  NurbsSurface ball = with_pole(arc_about({0, 0, -2}, {0, 0, 0}, {0, -1, 0}, kPi / 2));
  int k = 0;
  for (Vec3& p : ball.points) {
    p.z += 1e-15 * (k % 5 - 2);
    p.x += 1e-15 * (k++ % 7 - 3);
  }
  for (const std::size_t samples : {5u, 65u}) {
    const CurvatureExtents found = curvature_extents(ball, samples);
    EXPECT_NEAR(found.gaussian.most, 0.25, 1e-4) << samples;
    EXPECT_NEAR(found.gaussian.least, 0.25, 1e-4) << samples;
    EXPECT_NEAR(std::max(found.mean.most, -found.mean.least), 0.5, 1e-4) << samples;
  }
}

/// Two squares have eight sides; where one of them nearly meets one of the other six are left.
TEST(CheckSurface, CountsEachBorderOnce) {
  const auto square = [](double x) {
    return NurbsSurface{
        1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}, {x + 1, 1, 0}}, {}};
  };
  struct Case {
    double gap;
    std::size_t met, apart, free;
  };
  for (const Case& one : {Case{0.0, 2, 0, 6}, Case{1e-5, 2, 2, 6}, Case{1e-2, 0, 0, 8}}) {
    const SurfaceCheck found =
        checked({"s", "mm", {{"a", square(0.0)}, {"b", square(1.0 + one.gap)}}}, {5, {}});
    EXPECT_EQ(found.met_borders, one.met) << one.gap;
    EXPECT_EQ(found.apart_borders, one.apart) << one.gap;
    EXPECT_EQ(found.free_borders, one.free) << one.gap;
  }
}

/// Lines of a cone are straight: 0, not what rounding leaves of it.
TEST(CheckSurface, AConeHasNoGaussianCurvature) {
  const NurbsSurface cone =
      nurbs(RevolutionSurface{line_between({4, 0, 0}, {2, 3, 0}), {0, 0, 0}, {0, 1, 0}, 2 * kPi});
  const SurfaceCheck found = checked({"s", "mm", {{"cone", cone}}}, {9, {}});
  EXPECT_EQ(found.patches[0].gaussian.least, 0.0);
  EXPECT_EQ(found.patches[0].gaussian.most, 0.0);
  // 1 / (r / cos a), with tan a = 2 / 3
  const double cosine = 3.0 / std::sqrt(13.0);
  EXPECT_NEAR(std::max(found.patches[0].k1.most, -found.patches[0].k2.least), cosine / 2.0, 1e-9);
}

TEST(CheckSurface, CountsVerticesAndInflectionsOfLines) {
  // y = sin x over one and a half waves: extrema of curvature at the crests, inflections between
  std::vector<Vec3> points;
  std::vector<double> at;
  for (int k = 0; k <= 400; ++k) {
    const double x = 0.3 + 3 * kPi * k / 400.0;
    points.push_back({x, std::sin(x), 0});
    at.push_back(k / 400.0);
  }
  const NurbsSurface wave = nurbs(cylinder_over(*interpolated(points, at), {0, 0, 1}));
  const SurfaceCheck found = checked({"s", "mm", {{"wave", wave}}}, {5, {}});
  const LineReport& lines = found.patches[0].along_u;
  EXPECT_EQ(lines.lines, 5u);
  EXPECT_EQ(lines.most_vertices, 3u);     // pi/2, 3 pi/2, 5 pi/2
  EXPECT_EQ(lines.inflections, 5u * 3u);  // pi, 2 pi, 3 pi
  EXPECT_EQ(lines.monotone, 0u);
  // rulings are straight
  EXPECT_EQ(found.patches[0].along_v.monotone, 5u);
  EXPECT_EQ(found.patches[0].along_v.inflections, 0u);
  EXPECT_NEAR(found.patches[0].gaussian.most, 0.0, 1e-9);
}

TEST(CheckSurface, SaysWhereThereIsNoTangentPlane) {
  const SpaceCurve circle = arc_about({1, 0, 0}, {0, 0, 0}, {0, 0, 1}, 2 * kPi);
  SurfaceModel model{"s", "mm", {{"point", nurbs(RuledSurface{circle, circle})}}};
  const SurfaceCheck found = checked(model, {9, {}});
  EXPECT_GE(found.patches[0].without_normal, 81u);  // a surface of no width
  EXPECT_EQ(found.patches[0].area, 0.0);
}

/// Of degree 3 x 1 over [0, 1] x [from, to] of x and y, with heights `z` of the control points.
NurbsSurface strip(double from, double to, const std::array<double, 8>& z) {
  NurbsSurface s;
  s.degree_u = 3;
  s.degree_v = 1;
  s.knots_u = {0, 0, 0, 0, 1, 1, 1, 1};
  s.knots_v = {0, 0, 1, 1};
  for (std::size_t k = 0; k < z.size(); ++k) {
    s.points.push_back({static_cast<double>(k % 4) / 3.0, k < 4 ? from : to, z[k]});
  }
  return s;
}

TEST(CheckSurface, ClimbsToGapAndAngleOfAJointAndSaysWhere) {
  // a plane, and beside it z = g 3 x (1 - x)^2 along the border with the slope c 3 x^2 (1 - x):
  // largest at x = 1/3 and 2/3, 4/9 of g and of c
  constexpr double kG = 5e-6, kC = 0.3;
  const NurbsSurface flat = strip(0, 1, {});
  const NurbsSurface bent = strip(-1, 0, {0, kG, -kC, 0, 0, kG, 0, 0});
  for (const bool turned : {false, true}) {
    const SurfaceCheck found =
        checked({"s", "mm", {{"flat", flat}, {"bent", turned ? reversed_u(bent) : bent}}});
    ASSERT_EQ(found.joints.size(), 1u);
    const JointReport& joint = found.joints[0];
    EXPECT_NEAR(joint.gap, 4.0 / 9.0 * kG, 1e-12);
    EXPECT_LT(norm(joint.gap_at - Vec3{1.0 / 3.0, 0, 0}), 1e-6);
    EXPECT_NEAR(joint.angle, std::atan(4.0 / 9.0 * kC), 1e-10);
    EXPECT_LT(norm(joint.angle_at - Vec3{2.0 / 3.0, 0, 0}), 1e-6);
    EXPECT_EQ(joint.order, 0);
    EXPECT_FALSE(joint.shared);  // 2e-6 of the size apart
  }
}

TEST(CheckSurface, FindsWhatHappensInAShortSpanOfAJoint) {
  // the slope stands out by c in one span of 1e-3 between the 33 places that were looked at once
  NurbsSurface bent;
  bent.degree_u = 2;
  bent.degree_v = 1;
  const double a = 0.5101, b = 0.5111;
  bent.knots_u = {0, 0, 0, a, a, b, b, 1, 1, 1};
  bent.knots_v = {0, 0, 1, 1};
  const double x[] = {0, a / 2, a, (a + b) / 2, b, (1 + b) / 2, 1};
  constexpr double kC = 0.2;
  for (const double at : x) bent.points.push_back({at, -1, at == (a + b) / 2 ? -kC : 0.0});
  for (const double at : x) bent.points.push_back({at, 0, 0});
  const SurfaceCheck found = checked({"s", "mm", {{"flat", strip(0, 1, {})}, {"bent", bent}}});
  ASSERT_EQ(found.joints.size(), 1u);
  EXPECT_NEAR(found.joints[0].angle, std::atan(kC / 2), 1e-9);
  EXPECT_LT(norm(found.joints[0].angle_at - Vec3{(a + b) / 2, 0, 0}), 1e-6);
}

TEST(CheckSurface, BordersMeetWithinWhatIsAskedFor) {
  const NurbsSurface flat = strip(0, 1, {}), apart = strip(-1, -0.01, {});
  const SurfaceModel model{"s", "mm", {{"flat", flat}, {"apart", apart}}};
  EXPECT_TRUE(checked(model).joints.empty());
  const SurfaceCheck found = checked(model, {65, 0.02});
  ASSERT_EQ(found.joints.size(), 1u);
  EXPECT_NEAR(found.joints[0].gap, 0.01, 1e-15);
  EXPECT_FALSE(found.joints[0].shared);
}

TEST(CheckSurface, SaysWhereCurvatureIsLargest) {
  const CurvatureExtents found = curvature_extents(paraboloid(-1.0, 0.7));
  EXPECT_LT(norm(found.gaussian.most_at.point), 1e-4);  // the bottom
  EXPECT_NEAR(norm(found.gaussian.least_at.point - Vec3{-1, -1, 1}), 0.0, 1e-6);
  EXPECT_NEAR(found.gaussian.most_at.u, 1.0 / 1.7, 1e-4);
}

TEST(CheckSurface, ClimbsASecondHillWhoseTopLiesBetweenThePlaces) {
  // two folds of a sheet over x, the narrower one sharper: wherever the raster falls, the sharper
  // one is found
  for (const double shift : {0.0, 0.01, 0.02, 0.03, 0.05}) {
    NurbsSurface s;
    s.degree_u = 2;
    s.degree_v = 1;
    s.knots_u = {0, 0, 0, 0.5, 0.5, 1, 1, 1};
    s.knots_v = {0, 0, 1, 1};
    // parabolas: curvature 2 h / w^2 at their tops, w half the width
    const double w1 = 1.0, h1 = 1.0, w2 = 0.5 + shift, h2 = 0.45;
    const double x[] = {0, w1, 2 * w1, 2 * w1 + w2, 2 * w1 + 2 * w2};
    const double z[] = {0, 2 * h1, 0, 2 * h2, 0};
    for (const double y : {0.0, 1.0}) {
      for (std::size_t i = 0; i < 5; ++i) s.points.push_back({x[i], y, z[i]});
    }
    const CurvatureExtents found = curvature_extents(s, 5);
    const double sharper = std::max(2 * h1 / (w1 * w1), 2 * h2 / (w2 * w2));
    EXPECT_NEAR(std::max(found.mean.most, -found.mean.least), sharper / 2, 1e-8) << shift;
  }
}

/// A plate a..b, a..d (second corner along u, third along v), cut off by lines of its parameters.
SurfacePatch cut_plate(const char* name, Vec3 a, Vec3 b, Vec3 c, std::vector<Vec2> corners) {
  NurbsSurface s;
  s.degree_u = s.degree_v = 1;
  s.knots_u = s.knots_v = {0, 0, 1, 1};
  s.points = {a, b, c, b + c - a};
  TrimLoop loop;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    loop.curves.push_back(parameter_line(corners[k], corners[(k + 1) % corners.size()]));
  }
  return {name, s, {loop}};
}

/// Floor and wall of 3 x 4 that begin at 0.5 from their corner, and a quarter of a cylinder.
SurfaceModel rounded_corner(double lowered) {
  const std::vector<Vec2> from_sixth{{0.5 / 3, 0}, {1, 0}, {1, 1}, {0.5 / 3, 1}};
  const Vec3 down{0, 0, -lowered};
  const NurbsSurface blend =
      nurbs(cylinder_over(arc_about({0.5, 0, 0}, {0.5, 0, 0.5}, {0, 1, 0}, kPi / 2), {0, 4, 0}));
  return {"s",
          "mm",
          {cut_plate("floor", down, Vec3{3, 0, 0} + down, Vec3{0, 4, 0} + down, from_sixth),
           cut_plate("wall", {0, 0, 0}, {0, 0, 3}, {0, 4, 0}, from_sixth),
           {"blend", blend}}};
}

TEST(CheckSurface, TrimmedFacesMeetTheirBlendWithoutAGapOrAnAngle) {
  const SurfaceCheck found = checked(rounded_corner(0.0));
  EXPECT_TRUE(found.joints.empty());
  ASSERT_EQ(found.trim_joints.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const TrimJointReport& j = found.trim_joints[k];
    EXPECT_EQ(j.patch, (std::array<std::size_t, 2>{k, 2}));
    EXPECT_LT(j.gap, 1e-8);
    EXPECT_LT(j.angle, 1e-8);
    EXPECT_EQ(j.order, 1);
    EXPECT_NEAR(j.length, 4.0, 1e-12);
    EXPECT_GE(j.places, 2 * 64u);
  }
  // each face has three sides of its own: 2.5 + 4 + 2.5
  EXPECT_NEAR(found.trimmed_borders.length, 2 * 13.0, 1e-12);
  EXPECT_NEAR(found.trimmed_borders.free, 2 * 9.0, 1e-12);
  EXPECT_NEAR(found.trimmed_borders.longest_free, 4.0, 1e-12);
  EXPECT_EQ(found.met_borders, 2u);  // of the blend: its ends are free
  EXPECT_EQ(found.free_borders, 2u);
}

TEST(CheckSurface, AGapBesideATrimIsFoundAndMeasured) {
  const SurfaceModel apart = rounded_corner(0.01);
  const SurfaceCheck narrow = checked(apart);  // farther apart than what meets
  ASSERT_EQ(narrow.trim_joints.size(), 1u);
  EXPECT_EQ(narrow.trim_joints[0].patch, (std::array<std::size_t, 2>{1, 2}));
  EXPECT_NEAR(narrow.trimmed_borders.free, 13.0 + 9.0, 1e-12);
  EXPECT_EQ(narrow.free_borders, 3u);
  for (const double meeting : {0.02, 0.3}) {  // the latter above the step from place to place
    const SurfaceCheck found = checked(apart, {65, meeting});
    ASSERT_EQ(found.trim_joints.size(), 2u) << meeting;
    const TrimJointReport& j = found.trim_joints[0];
    EXPECT_EQ(j.patch, (std::array<std::size_t, 2>{0, 2}));
    EXPECT_NEAR(j.gap, 0.01, 1e-8) << meeting;
    EXPECT_NEAR(norm(j.gap_at - Vec3{0.5, j.gap_at.y, j.gap_at.z}), 0.0, 1e-12);
    EXPECT_LT(j.angle, 1e-6);
    EXPECT_NEAR(j.length, 4.0, 1e-12) << meeting;
  }
}

TEST(CheckSurface, TrimmedFacesThatMeetInACornerMeetAtItsAngle) {
  // three sides of a cube, each cut out of a larger plate
  const std::vector<Vec2> quarter{{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  const Vec3 x{2, 0, 0}, y{0, 2, 0}, z{0, 0, 2};
  const SurfaceCheck found =
      checked({"s",
               "mm",
               {cut_plate("xy", {}, x, y, quarter), cut_plate("yz", {}, y, z, quarter),
                cut_plate("zx", {}, z, x, quarter)}});
  ASSERT_EQ(found.trim_joints.size(), 3u);
  for (const TrimJointReport& j : found.trim_joints) {
    EXPECT_LT(j.gap, 1e-9);
    EXPECT_NEAR(j.angle, kPi / 2, 1e-12);
    EXPECT_EQ(j.order, 0);
    EXPECT_NEAR(j.length, 1.0, 1e-12);  // not the borders that leave the corner
  }
  EXPECT_NEAR(found.trimmed_borders.free, 3 * 2.0, 1e-12);
}

TEST(CheckSurface, ATrimThatGoesOnFromFaceToFaceIsMetAllAlong) {
  const std::vector<Vec2> lower{{0, 0}, {1, 0}, {1, 0.5}, {0, 0.5}};
  const auto plate = [](double from, double to) {
    return nurbs(cylinder_over(line_between({from, 1, 0}, {to, 1, 0}), {0, 0, 1}));
  };
  const SurfaceCheck found = checked({"s",
                                      "mm",
                                      {cut_plate("floor", {}, {3, 0, 0}, {0, 2, 0}, lower),
                                       {"left", plate(0, 1.234)},
                                       {"right", plate(1.234, 3)}}});
  ASSERT_EQ(found.trim_joints.size(), 2u);
  EXPECT_NEAR(found.trim_joints[0].length, 1.234, 1e-12);  // by the wall's own border
  EXPECT_NEAR(found.trim_joints[1].length, 3 - 1.234, 1e-12);
  EXPECT_NEAR(found.trimmed_borders.free, 1 + 3 + 1, 1e-12);
}

TEST(CheckSurface, AClosedFaceWithTrimsMeetsItselfAtItsSeam) {
  SurfacePatch zone{"zone", sphere_zone()};
  zone.trims = {outline_of(zone.surface)};
  const SurfaceCheck found = checked({"s", "mm", {zone}});
  ASSERT_EQ(found.trim_joints.size(), 1u);
  const TrimJointReport& j = found.trim_joints[0];
  EXPECT_EQ(j.patch, (std::array<std::size_t, 2>{0, 0}));
  EXPECT_LT(j.gap, 1e-12);
  EXPECT_LT(j.angle, 1e-12);
  EXPECT_NEAR(j.length, 2 * 2 * kPi / 3, 1e-3);  // of chords
  EXPECT_NEAR(found.trimmed_borders.free, 2 * 2 * kPi * 2 * std::cos(kPi / 3), 1e-2);
}

}  // namespace
}  // namespace obvid
