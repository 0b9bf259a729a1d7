// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/deviation.h"
#include "../common/angles.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "obvid/surface/internal/trim.h"

namespace obvid {
namespace {

NurbsSurface ball(Vec3 centre, double radius) {
  const Vec3 south = centre + Vec3{0, 0, -radius};
  const RevolutionSurface turned{
      arc_about(south, centre, {0, -1, 0}, kPi), centre, {0, 0, 1}, 2 * kPi};
  return to_nurbs(turned, 1e-9)->surface;
}

SurfaceModel model_of(std::vector<NurbsSurface> surfaces) {
  SurfaceModel model;
  for (NurbsSurface& s : surfaces) model.patches.push_back({"patch", std::move(s)});
  return model;
}

NurbsSurface flat(double from, double to, double z) {
  NurbsSurface s;
  s.degree_u = s.degree_v = 1;
  s.knots_u = s.knots_v = {0, 0, 1, 1};
  s.points = {{from, from, z}, {to, from, z}, {from, to, z}, {to, to, z}};
  return s;
}

/// The plate from -3 to 3 at z = 0 without the disc of radius 1 in its middle.
SurfaceModel holed_plate() {
  SurfaceModel model = model_of({flat(-3.0, 3.0, 0.0)});
  const double w = std::sqrt(0.5), r = 1.0 / 6.0;  // of the parameters
  NurbsCurve circle{2,
                    {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4},
                    {{r, 0}, {r, -r}, {0, -r}, {-r, -r}, {-r, 0}, {-r, r}, {0, r}, {r, r}, {r, 0}},
                    {1, w, 1, w, 1, w, 1, w, 1}};
  for (Vec2& p : circle.points) p = p + Vec2{0.5, 0.5};
  model.patches[0].trims = {outline_of(model.patches[0].surface), {{circle}}};
  return model;
}

TEST(NearestOnModel, IsNotWhereTheSurfaceIsTrimmedAway) {
  const SurfaceModel model = holed_plate();
  ASSERT_TRUE(check(model.patches[0]));
  const NearestOnModel nearest(model);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-2.5, 2.5), height(-1.0, 1.0);
  for (int k = 0; k < 400; ++k) {
    const Vec3 p{place(random), place(random), height(random)};
    const double from_hole = 1.0 - std::hypot(p.x, p.y);
    const double wanted = from_hole > 0.0 ? std::hypot(from_hole, p.z) : std::abs(p.z);
    const NearestPlace found = nearest.at(p);
    EXPECT_NEAR(found.distance, wanted, 1e-9) << p.x << " " << p.y << " " << p.z;
    EXPECT_EQ(found.beside, from_hole > 0.0) << p.x << " " << p.y;
    EXPECT_GE(std::hypot(found.point.x, found.point.y), 1.0 - 1e-9);
  }
}

TEST(DeviationOfSurfaces, IsOfWhatTrimsLeave) {
  const SurfaceModel holed = holed_plate();
  const SurfaceModel whole = model_of({flat(-3.0, 3.0, 0.0)});
  const NearestOnModel from_holed(holed), from_whole(whole);
  const auto off = deviation_of(holed, from_whole, 17, {});
  ASSERT_TRUE(off);
  EXPECT_NEAR(off->farthest().off, 0.0, 1e-12);
  const auto back = deviation_of(whole, from_holed, 17, {});
  ASSERT_TRUE(back);
  // its middle is a radius away from what is left; a disc of pi of 36 lies beside that
  EXPECT_NEAR(std::abs(back->farthest().off), 1.0, 1e-6);
  EXPECT_NEAR(back->beside, kPi / 36.0, 0.02);
}

TEST(NearestOnModel, IsThePointOfASphereOnTheRayFromItsCentre) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const double scale : {1e-9, 1.0, 1e9}) {
    for (const double offset : {0.0, 1e3}) {
      const Vec3 centre = offset * scale * Vec3{1, -2, 3};
      const SurfaceModel model = model_of({ball(centre, 2 * scale)});
      const NearestOnModel nearest(model);
      for (int k = 0; k < 200; ++k) {
        const Vec3 way = unit({normal(random), normal(random), normal(random)});
        const double from = scale * (0.1 + 0.02 * k);
        const NearestPlace found = nearest.at(centre + from * way);
        const double rounding = 1e-13 * scale * (1.0 + offset);
        EXPECT_NEAR(found.distance, std::abs(from - 2 * scale), rounding);
        EXPECT_LT(norm(found.point - (centre + 2 * scale * way)), 1e-6 * scale * (1.0 + offset));
        EXPECT_EQ(std::abs(found.off), found.distance);
        EXPECT_FALSE(found.beside && found.distance > 0.1 * scale) << k;
      }
      // outside and inside have different signs
      const double outside = nearest.at(centre + 3 * scale * Vec3{1, 0, 0}).off;
      const double inside = nearest.at(centre + 1 * scale * Vec3{1, 0, 0}).off;
      EXPECT_LT(outside * inside, 0.0);
    }
  }
}

TEST(NearestOnModel, FindsTheNearestOfManyPlacesLookedAtOneByOne) {
  // a wavy sheet that has several places of locally smallest distance
  NurbsSurface s;
  s.degree_u = s.degree_v = 3;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> height(-1.0, 1.0);
  for (int k = 0; k < 4; ++k) s.knots_u.push_back(0);
  for (int k = 1; k < 9; ++k) s.knots_u.push_back(k);
  for (int k = 0; k < 4; ++k) s.knots_u.push_back(9);
  s.knots_v = s.knots_u;
  for (int j = 0; j < 12; ++j) {
    for (int i = 0; i < 12; ++i) s.points.push_back({0.5 * i, 0.5 * j, height(random)});
  }
  const SurfaceModel model = model_of({s});
  const NearestOnModel nearest(model);
  std::uniform_real_distribution<double> place(-1.0, 6.5);
  for (int k = 0; k < 20; ++k) {
    const Vec3 p{place(random), place(random), place(random) - 2.5};
    double least = HUGE_VAL;
    for (int j = 0; j <= 150; ++j) {
      for (int i = 0; i <= 150; ++i) {
        least = std::min(least, norm(evaluate(s, i * 0.06, j * 0.06).point - p));
      }
    }
    const NearestPlace found = nearest.at(p);
    EXPECT_LE(found.distance, least + 1e-12) << k;
    EXPECT_GT(found.distance, least - 0.1) << k;
    EXPECT_NEAR(norm(evaluate(s, found.u, found.v).point - p), found.distance, 1e-12);
  }
}

/// One patch of 7 x 7 control points, cubic with inner knots that lie close to one end.
NurbsSurface uneven_cubic() {
  NurbsSurface s;
  s.degree_u = s.degree_v = 3;
  s.knots_u = s.knots_v = {0, 0, 0, 0, 0.02, 0.05, 0.6, 1, 1, 1, 1};
  s.points.resize(49);
  return s;
}

/// Waves higher than long, 0.3 wide: seen from beside, several are nearly equally near.
NurbsSurface thin_waves() {
  NurbsSurface s = uneven_cubic();
  for (int j = 0; j < 7; ++j) {
    for (int i = 0; i < 7; ++i) {
      const double height = i % 2 == 0 ? 1.0 : -1.0;
      s.points[static_cast<std::size_t>(7 * j + i)] = {0.25 * i, 0.05 * j, height + 0.03 * j};
    }
  }
  return s;
}

/// A quarter of a cylinder of radius 1 about z whose weights differ by a factor of 400.
NurbsSurface uneven_cylinder() {
  NurbsSurface s;
  s.degree_u = 2;
  s.degree_v = 1;
  s.knots_u = {0, 0, 0, 1, 1, 1};
  s.knots_v = {0, 0, 1, 1};
  s.points = {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}};
  // w0 w2 / w1^2 = 2 makes a quarter circle
  s.weights = {1, 20 * std::sqrt(0.5), 400, 1, 20 * std::sqrt(0.5), 400};
  return s;
}

/// All of one border is a point, and beside it the sheet bends back over itself.
NurbsSurface degenerate() {
  NurbsSurface s = uneven_cubic();
  for (int j = 0; j < 7; ++j) {
    for (int i = 0; i < 7; ++i) {
      const double a = 0.5 * (i - 3), r = 0.4 * j * (6.5 - j) / 3.0;
      s.points[static_cast<std::size_t>(7 * j + i)] = {r * std::cos(a), r * std::sin(a),
                                                       0.3 * std::sin(2.0 * j)};
    }
  }
  return s;
}

TEST(NearestOnModel, IsNeverFartherThanARasterNorRunsAheadOfThePoint) {
  std::mt19937 random(19);
  for (const NurbsSurface& s : {thin_waves(), uneven_cylinder(), degenerate()}) {
    const SurfaceModel model = model_of({s});
    const NearestOnModel nearest(model);
    std::vector<Vec3> raster;
    constexpr int kRaster = 200;  // also close to the beginnings, where the knots are
    for (int j = 0; j <= kRaster; ++j) {
      for (int i = 0; i <= kRaster; ++i) {
        const double u = std::pow(i / double{kRaster}, 2), v = std::pow(j / double{kRaster}, 2);
        raster.push_back(evaluate(s, u, v).point);
      }
    }
    std::uniform_real_distribution<double> part(0.0, 1.0), beside(-1.0, 1.0);
    const auto off = [&] { return Vec3{beside(random), beside(random), beside(random)}; };
    for (int line = 0; line < 40; ++line) {
      const double size = line % 2 == 0 ? 1.0 : 0.05;
      const Vec3 from = evaluate(s, part(random), std::pow(part(random), 3)).point + size * off();
      const Vec3 by = 0.002 * size * off();
      double before = nearest.at(from).distance;
      for (int k = 0; k < 20; ++k) {
        const Vec3 p = from + static_cast<double>(k) * by;
        const NearestPlace found = nearest.at(p);
        EXPECT_NEAR(norm(evaluate(s, found.u, found.v).point - p), found.distance, 1e-12);
        EXPECT_LE(std::abs(found.distance - before), norm(by) + 1e-9) << line;
        before = found.distance;
        if (k % 10 != 0) continue;
        double least = HUGE_VAL;
        for (const Vec3& q : raster) least = std::min(least, norm(q - p));
        EXPECT_LE(found.distance, least + 1e-9) << line;
      }
    }
  }
}

TEST(NearestOnModel, OfAPieceOfACylinderIsThatOfAnArcOrOfItsEnds) {
  const SurfaceModel model = model_of({uneven_cylinder()});
  const NearestOnModel nearest(model);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-2.0, 3.0);
  for (int k = 0; k < 300; ++k) {
    const Vec3 p{place(random), place(random), place(random)};
    const double along = std::max({-p.z, p.z - 2.0, 0.0});
    const double round = p.x >= 0.0 && p.y >= 0.0
                             ? std::abs(std::hypot(p.x, p.y) - 1.0)
                             : std::min(std::hypot(p.x - 1.0, p.y), std::hypot(p.x, p.y - 1.0));
    EXPECT_NEAR(nearest.at(p).distance, std::hypot(along, round), 1e-9) << k;
  }
  // as near everywhere: an end to the search all the same
  EXPECT_NEAR(nearest.at({0, 0, 1}).distance, 1.0, 1e-12);
}

TEST(NearestOnModel, SaysWhatLiesBesideTheSurface) {
  const SurfaceModel model = model_of({flat(0, 1, 0), flat(2, 3, 0)});
  const NearestOnModel nearest(model);
  EXPECT_FALSE(nearest.at({0.5, 0.25, 0.1}).beside);
  EXPECT_NEAR(nearest.at({0.5, 0.25, -0.1}).off, -0.1, 1e-15);
  const NearestPlace outside = nearest.at({1.3, 0.5, 0.4});
  EXPECT_TRUE(outside.beside);
  EXPECT_NEAR(outside.distance, 0.5, 1e-15);
  EXPECT_EQ(outside.patch, 0u);
  EXPECT_EQ(nearest.at({1.9, 2.5, 0}).patch, 1u);
  EXPECT_FALSE(nearest.at({0.5, 0.5, 0}).beside);  // on it
}

TEST(Deviation, OfPointsFromASphere) {
  const SurfaceModel model = model_of({ball({0, 0, 0}, 2)});
  const NearestOnModel nearest(model);
  std::vector<Vec3> points;
  double squares = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const double a = 0.37 * k, z = std::cos(0.01 + 3.0 * k / 1000.0), r = std::sqrt(1 - z * z);
    const double off = 1e-3 * std::sin(0.1 * k);
    points.push_back((2 + off) * Vec3{r * std::cos(a), r * std::sin(a), z});
    squares += off * off;
  }
  points[400] = 2.01 / norm(points[400]) * points[400];
  squares += 1e-4 - std::pow(1e-3 * std::sin(40.0), 2);
  const auto found = deviation_of(points, nearest, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->places, 1000u);
  EXPECT_NEAR(std::abs(found->farthest().off), 0.01, 1e-13);
  EXPECT_EQ(found->farthest().number, 400u);
  EXPECT_NEAR(found->root_mean_square, std::sqrt(squares / 1000), 1e-13);
  EXPECT_EQ(found->beside, 0.0);
}

TEST(Deviation, OfASphereFromOneBesideItIsClimbedTo) {
  // centres d apart: from r - R - d to r - R + d, at the poles of the axis between the centres
  const Vec3 d = 0.01 * unit(Vec3{3, 1, 2});
  const SurfaceModel big = model_of({ball({0, 0, 0}, 2)}), small = model_of({ball(d, 1.9)});
  const NearestOnModel nearest(big);
  const auto found = deviation_of(small, nearest, 9, {});
  ASSERT_TRUE(found);
  const bool outwards = nearest.at({3, 0, 0}).off > 0.0;
  const double sign = outwards ? 1.0 : -1.0;
  EXPECT_NEAR((outwards ? found->least : found->most).off, -sign * 0.11, 1e-12);
  EXPECT_NEAR((outwards ? found->most : found->least).off, -sign * 0.09, 1e-12);
  EXPECT_LT(norm(found->farthest().point - (d - 1.9 * unit(d))), 1e-4);
  // over the smaller sphere the distance is R - |d + r e|: the mean of |d + r e| is r + d^2 / 3 r
  EXPECT_NEAR(found->mean, -sign * (2.0 - (1.9 + 1e-4 / (3 * 1.9))), 2e-5);
  EXPECT_EQ(found->beside, 0.0);
}

TEST(Deviation, ShareOfTheAreaThatLiesBeside) {
  const SurfaceModel small = model_of({flat(0, 1, 0)}), large = model_of({flat(0, 2, 0.5)});
  const NearestOnModel nearest(small);
  const auto found = deviation_of(large, nearest, 64, {});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->beside, 0.75, 0.02);
  EXPECT_NEAR(found->farthest().off, std::sqrt(2 + 0.25), 1e-12);  // the corner
  EXPECT_NEAR(found->least.off, 0.5, 1e-12);
}

TEST(Deviation, StopsWhenAsked) {
  const SurfaceModel model = model_of({flat(0, 1, 0)});
  RunContext run;
  run.cancelled = [] { return true; };
  const auto found = deviation_of(model, NearestOnModel(model), 65, run);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace obvid
