// SPDX-License-Identifier: Apache-2.0
// Cutters, where they rest on triangles and on meshes, and how far they are from what they sweep,
// against definitions that are searched for the least or greatest value by brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "cutter_shape.h"
#include "drop_field.h"
#include "drop_triangle.h"
#include "sweep.h"

namespace obvid::toolpath {
namespace {

constexpr int kRandomCases = 400;

struct CutterDraw {
  std::mt19937_64 rng;

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(rng);
  }
  Vec3 point(double size) {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }
  CutterShape cutter() {
    const double radius = std::pow(10.0, between(-1.0, 0.7));
    switch (rng() % 3) {
      case 0:
        return {radius, radius};
      case 1:
        return {radius, 0.0};
      default:
        return {radius, radius * between(0.05, 0.95)};
    }
  }
};

/// Least distance of a place in the half plane (from the axis, over the tip) from the outline of a
/// cutter's body, by its definition: disc, quarter of a circle, side; walked along in small steps.
double outline_distance(const CutterShape& c, double from_axis, double over_tip) {
  constexpr int kSteps = 20000;
  double least = std::numeric_limits<double>::infinity();
  const auto see = [&](double x, double z) {
    least = std::min(least, std::hypot(from_axis - x, over_tip - z));
  };
  const double high = 4.0 * c.radius + std::abs(over_tip);
  for (int i = 0; i <= kSteps; ++i) {
    const double s = static_cast<double>(i) / kSteps, w = 0.5 * std::numbers::pi * s;
    see(s * c.flat(), 0.0);
    see(c.flat() + c.corner * std::sin(w), c.corner * (1.0 - std::cos(w)));
    see(c.radius, c.corner + s * high);
  }
  return least;
}

bool inside_body(const CutterShape& c, double from_axis, double over_tip) {
  return from_axis < c.radius && over_tip > c.height(from_axis);
}

TEST(CutterShape, DistancesAreThoseFromItsOutline) {
  CutterDraw draw{std::mt19937_64(1)};
  for (int i = 0; i < 60; ++i) {
    const CutterShape c = draw.cutter();
    const double x = draw.between(0.0, 2.0) * c.radius, z = draw.between(-2.0, 2.0) * c.radius;
    const double away = outline_distance(c, x, z);
    const double signed_distance = inside_body(c, x, z) ? -away : away;
    EXPECT_NEAR(c.distance(x, z).value, signed_distance, 1e-3 * c.radius)
        << "radius " << c.radius << ", corner " << c.corner << ", at " << x << ", " << z;
  }
}

TEST(CutterShape, DistancesChangeAsTheirDerivativesSay) {
  CutterDraw draw{std::mt19937_64(2)};
  constexpr double kOffset = 1e-6;
  for (int i = 0; i < kRandomCases; ++i) {
    const CutterShape c = draw.cutter();
    const double x = draw.between(0.0, 2.0) * c.radius, z = draw.between(-2.0, 2.0) * c.radius;
    const double h = kOffset * c.radius;
    const BodyDistance at = c.distance(x, z);
    const double by_x = (c.distance(x + h, z).value - c.distance(x - h, z).value) / (2.0 * h);
    const double by_z = (c.distance(x, z + h).value - c.distance(x, z - h).value) / (2.0 * h);
    if (std::abs(std::hypot(by_x, by_z) - 1.0) > 1e-3) continue;  // across an edge of the regions
    EXPECT_NEAR(at.by_level, by_x, 1e-4);
    EXPECT_NEAR(at.by_height, by_z, 1e-4);
  }
}

TEST(CutterShape, TouchesSlopesWithItsOutlineAlongTheirNormal) {
  CutterDraw draw{std::mt19937_64(3)};
  for (int i = 0; i < kRandomCases; ++i) {
    const CutterShape c = draw.cutter();
    if (c.corner <= 0.0) continue;  // sharp rims have no normal
    const Vec3 normal = unit(Vec3{draw.between(-1, 1), draw.between(-1, 1), draw.between(0.05, 1)});
    const Vec3 contact = draw.point(10.0), from_tip = contact - c.tip(contact, normal);
    const double level = std::hypot(from_tip.x, from_tip.y);
    const BodyDistance d = c.distance(level, from_tip.z);
    EXPECT_NEAR(d.value, 0.0, 1e-12 * (10.0 + c.radius));
    // outwards of the body is against the normal of the part
    EXPECT_NEAR(d.by_height, -normal.z, 1e-9);
    EXPECT_NEAR(d.by_level * from_tip.x / level, -normal.x, 1e-9);
    EXPECT_NEAR(d.by_level * from_tip.y / level, -normal.y, 1e-9);
  }
}

TEST(CutterShape, SizesThatMakeNoCutterAreRefused) {
  for (const Cutter& cutter :
       {Cutter{CutterKind::kBall, 0.0, 0.0}, Cutter{CutterKind::kFlat, -1.0, 0.0},
        Cutter{CutterKind::kBall, std::nan(""), 0.0}, Cutter{CutterKind::kBullNose, 6.0, 0.0},
        Cutter{CutterKind::kBullNose, 6.0, 3.0}}) {
    const auto shape = shape_of(cutter);
    ASSERT_FALSE(shape);
    EXPECT_EQ(shape.error().code, ErrorCode::kBadOption);
  }
  const auto bull = shape_of({CutterKind::kBullNose, 6.0, 1.0});
  ASSERT_TRUE(bull);
  EXPECT_EQ(bull->radius, 3.0);
  EXPECT_EQ(bull->flat(), 2.0);
}

/// Greatest height of a tip on the axis that any point of a triangle causes. The height over the
/// triangle is the difference of a linear and a convex function, so that two nested searches of
/// thirds find its greatest value within the cutter's reach.
double brute_rest(const CutterShape& c, Vec2 axis, const Triangle& t) {
  const auto tip = [&](double u, double v) {
    const Vec3 p = (1.0 - v) * ((1.0 - u) * t[0] + u * t[1]) + v * t[2];
    const double away = std::hypot(p.x - axis.x, p.y - axis.y);
    return away <= c.radius ? p.z - c.height(away) : -1e6 - 1e3 * (away - c.radius);
  };
  const auto highest = [](const auto& f) {
    double low = 0.0, high = 1.0, best = std::max(f(0.0), f(1.0));
    for (int i = 0; i < 90; ++i) {
      const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
      const double fa = f(a), fb = f(b);
      best = std::max({best, fa, fb});
      (fa < fb ? low : high) = fa < fb ? a : b;
    }
    return best;
  };
  return highest([&](double v) { return highest([&](double u) { return tip(u, v); }); });
}

TEST(DropOnTriangle, RestsWhereNoPointOfItHoldsTheCutterHigher) {
  CutterDraw draw{std::mt19937_64(4)};
  int rested = 0;
  for (int i = 0; i < kRandomCases; ++i) {
    const CutterShape c = draw.cutter();
    const double size = c.radius * std::pow(10.0, draw.between(-1.0, 1.0));
    const Triangle t{draw.point(size), draw.point(size), draw.point(size)};
    const Vec2 axis{draw.between(-1.2, 1.2) * size, draw.between(-1.2, 1.2) * size};
    constexpr double kNothing = -1e5;
    Rest rest{kNothing, {}, -1};
    const bool hit = drop_on(c, axis, t, 0, rest);
    const double brute = brute_rest(c, axis, t);
    if (brute < kNothing) continue;  // beside the cutter: the search only comes near
    ASSERT_TRUE(hit) << i;
    ++rested;
    // the search walks straight lines, which lose the last digits of steep and flat-rimmed rests
    EXPECT_GE(rest.tip_z, brute - 1e-9 * size) << i;
    EXPECT_LE(rest.tip_z, brute + 1e-4 * size) << i;
    // and it rests on a point of the body's outline
    const double away = std::hypot(rest.point.x - axis.x, rest.point.y - axis.y);
    EXPECT_LE(away, c.radius * (1.0 + 1e-12)) << i;
    EXPECT_NEAR(rest.point.z - c.height(std::min(away, c.radius)), rest.tip_z, 1e-6 * size) << i;
    // coming down again on what holds it raises nothing
    EXPECT_FALSE(drop_on(c, axis, t, 0, rest)) << i;
  }
  EXPECT_GT(rested, kRandomCases / 3);
}

TEST(DropOnTriangle, LeavesOutWhatIsSkipped) {
  const CutterShape ball{1.0, 1.0};
  const Triangle t{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 4, 0}};
  Rest rest{-10.0, {}, -1};
  ASSERT_TRUE(drop_on(ball, {-0.6, 1.0}, t, 0, rest));
  EXPECT_EQ(rest.feature, 3);  // the edge from the third corner, x = 0
  EXPECT_NEAR(rest.tip_z, -(1.0 - 0.8), 1e-15);
  rest = {-10.0, {}, -1};
  EXPECT_FALSE(drop_on(ball, {-0.6, 1.0}, t, 1U << 3U, rest));
  EXPECT_EQ(rest.tip_z, -10.0);
}

TEST(DropField, FindsTheHighestOfAllTriangles) {
  CutterDraw draw{std::mt19937_64(5)};
  Mesh mesh;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const Vec3 middle = draw.point(10.0);
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back({middle + draw.point(1.0), {0, 0, 1}});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const DropField field({mesh}, 2);
  for (int i = 0; i < 300; ++i) {
    const CutterShape c = draw.cutter();
    const Vec2 axis{draw.between(-12.0, 12.0), draw.between(-12.0, 12.0)};
    Rest highest{-1e9, {}, -1};
    for (const auto& t : mesh.triangles) {
      (void)drop_on(
          c, axis,
          {mesh.vertices[t[0]].point, mesh.vertices[t[1]].point, mesh.vertices[t[2]].point}, 0,
          highest);
    }
    const auto found = field.drop(c, axis);
    ASSERT_EQ(found.has_value(), highest.feature >= 0) << i;
    if (!found) continue;
    EXPECT_EQ(found->rest.tip_z, highest.tip_z) << i;
  }
}

TEST(SweptCutter, IsAsFarAwayAsItsNearestPlaceOnTheWay) {
  CutterDraw draw{std::mt19937_64(6)};
  constexpr int kPlaces = 20000;
  for (int i = 0; i < 100; ++i) {
    const CutterShape c = draw.cutter();
    const Sweep sweep{draw.point(5.0), draw.point(5.0)};
    const Vec3 p = draw.point(6.0);
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= kPlaces; ++k) {
      const double s = static_cast<double>(k) / kPlaces;
      const Vec3 from_tip = p - (sweep.from + s * (sweep.to - sweep.from));
      least = std::min(least, c.distance(std::hypot(from_tip.x, from_tip.y), from_tip.z).value);
    }
    const double step = norm(sweep.to - sweep.from) / kPlaces;
    const double found = distance_from(c, sweep, p).value;
    EXPECT_LE(found, least + 2e-6 * c.radius) << i;
    EXPECT_GE(found, least - step) << i;  // a distance changes no faster than the place
  }
}

/// A point in the body of a flat mill at any of many places of its way, some more wide.
bool in_sharp(const CutterShape& cutter, const Sweep& sweep, Vec3 p, double more) {
  constexpr int kPlaces = 2000;
  for (int k = 0; k <= kPlaces; ++k) {
    const Vec3 tip = sweep.from + (static_cast<double>(k) / kPlaces) * (sweep.to - sweep.from);
    const bool over = std::hypot(p.x - tip.x, p.y - tip.y) <= cutter.radius + more;
    if (over && p.z >= tip.z - more) return true;
  }
  return false;
}

TEST(SharpCorners, AreEnteredWhereARayFirstComesIntoTheBody) {
  const CutterShape cutter{2.0, 0.0};
  const Sweep disc{{0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}};
  EXPECT_DOUBLE_EQ(height_into_sharp(cutter, disc, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 9.0), 1.0);
  EXPECT_DOUBLE_EQ(height_into_sharp(cutter, disc, {1.0, 0.0, 0.0}, {0.6, 0.0, 0.8}, 9.0), 1.25);
  EXPECT_DOUBLE_EQ(height_into_sharp(cutter, disc, {3.0, 0.0, 0.0}, {-0.6, 0.0, 0.8}, 9.0),
                   1.0 / 0.6);
  EXPECT_EQ(height_into_sharp(cutter, disc, {3.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 9.0),
            std::numeric_limits<double>::infinity());
  CutterDraw draw{std::mt19937_64(11)};
  constexpr int kRays = 25;
  int entered = 0;
  for (int k = 0; k < kRays; ++k) {
    const Sweep sweep{draw.point(2.0), draw.point(2.0)};
    const Vec3 from = draw.point(4.0);
    const Vec3 up =
        unit(Vec3{draw.between(-1.0, 1.0), draw.between(-1.0, 1.0), draw.between(0.05, 1.0)});
    const double height = height_into_sharp(cutter, sweep, from, up, 9.0);
    constexpr double kNear = 2e-3,
                     kStep = 0.02;  // places of the way lie up to 1e-3 from each other
    if (height < 9.0) {
      ++entered;
      EXPECT_TRUE(in_sharp(cutter, sweep, from + height * up, kNear)) << k;
    }
    for (double h = 0.0; h < std::min(height - kNear, 9.0); h += kStep) {
      ASSERT_FALSE(in_sharp(cutter, sweep, from + h * up, -1e-9))
          << k << " at " << h << " of " << height;
    }
  }
  EXPECT_GT(entered, kRays / 4);
}

}  // namespace
}  // namespace obvid::toolpath
