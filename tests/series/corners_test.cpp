// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../common/angles.h"
#include "obvid/series/internal/sections.h"

namespace obvid {
namespace {

using Points = std::vector<Vec2>;
using Indices = std::vector<std::size_t>;

constexpr double kDeg = kPi / 180.0;

Indices corners_of(const Points& points, bool closed, double noise = 0.0, double angle_deg = 20.0) {
  const std::vector<double> tolerance(noise > 0.0 ? points.size() : 0, noise);
  return find_corners(points, tolerance, closed, {}, {true, angle_deg * kDeg});
}

Points ellipse_points(double a, double b, int n, double from = 0.0) {
  Points points;
  for (int i = 0; i < n; ++i) {
    const double t = from + 2.0 * kPi * i / n;
    points.push_back({a * std::cos(t), b * std::sin(t)});
  }
  return points;
}

// Each side of the polygon in `m` equal steps, beginning at its corner.
Points outline(const Points& corners, int m) {
  Points points;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 a = corners[k], b = corners[(k + 1) % corners.size()];
    for (int j = 0; j < m; ++j) points.push_back(a + (double(j) / m) * (b - a));
  }
  return points;
}

Indices multiples(std::size_t step, std::size_t count) {
  Indices result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(i * step);
  return result;
}

// Unit steps that turn by `each` degrees, and by `at_corner` more at point 8.
Points bent_row(double each, double at_corner) {
  Points points{{0, 0}};
  double theta = 0.0;
  for (int i = 1; i <= 16; ++i) {
    points.push_back(points.back() + unit_at(theta));
    theta += (i == 8 ? at_corner : each) * kDeg;
  }
  return points;
}

const Points kRectangle{{0, 0}, {3, 0}, {3, 2}, {0, 2}};
const Points kBracket{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};

TEST(Corners, CoarselySampledSmoothLoopsHaveNone) {
  for (const int n : {8, 12, 16, 24})
    EXPECT_EQ(corners_of(ellipse_points(1, 1, n), true), Indices{});
  for (const double ratio : {2.0, 4.0, 10.0}) {
    for (const int n : {12, 16, 17, 20, 32, 64}) {
      for (const double from : {0.0, 0.5, 1.0}) {  // in steps: tips on a point and between two
        EXPECT_EQ(corners_of(ellipse_points(ratio, 1, n, from * 2.0 * kPi / n), true), Indices{})
            << ratio << ":1 with " << n;
      }
    }
  }
}

TEST(Corners, CoarselySampledOpenArcsHaveNone) {
  Points points = ellipse_points(1, 1, 12);
  points.push_back(points.front());
  EXPECT_EQ(corners_of(points, false), Indices{});
  for (const double each : {10.0, 30.0, 45.0}) {
    EXPECT_EQ(corners_of(bent_row(each, each), false), Indices{}) << each;
  }
}

TEST(Corners, EachCornerOfAnOutlineIsFound) {
  for (const int m : {2, 3, 4, 10, 50}) {
    const auto step = static_cast<std::size_t>(m);
    EXPECT_EQ(corners_of(outline(kRectangle, m), true), multiples(step, 4)) << m;
    EXPECT_EQ(corners_of(outline(ellipse_points(1, 1, 6), m), true), multiples(step, 6)) << m;
    EXPECT_EQ(corners_of(outline(ellipse_points(1, 1, 8), m), true), multiples(step, 8)) << m;
    EXPECT_EQ(corners_of(outline(kBracket, m), true), multiples(step, 6)) << m;
  }
}

TEST(Corners, RoundedCornersThatArePointsOfAnArcAreNone) {
  // Rectangle 3 x 2 whose corners are quarter circles of radius 0.3 in steps of 22.5 degrees, which
  // begin half a step before and end half a step behind their ends as sampling at random would.
  Points points;
  const Points centres{{2.7, 0.3}, {2.7, 1.7}, {0.3, 1.7}, {0.3, 0.3}};
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j <= 4; ++j) {
      points.push_back(centres[static_cast<std::size_t>(k)] +
                       0.3 * unit_at((90.0 * (k - 1) + 22.5 * j) * kDeg));
    }
  }
  EXPECT_EQ(corners_of(points, true), Indices{});
}

TEST(Corners, SpacingThatJumpsAThousandfoldNeitherMakesNorHidesThem) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-3.0, 0.0);
  for (int round = 0; round < 20; ++round) {
    std::vector<double> place;
    for (double s = 0.0; place.size() < 60;) place.push_back(s += std::pow(10.0, exponent(random)));
    Points smooth;
    for (const double s : place) {
      const double t = 2.0 * kPi * s / place.back();
      smooth.push_back({2.0 * std::cos(t), std::sin(t)});
    }
    EXPECT_EQ(corners_of(smooth, true), Indices{}) << round;
    Points angular;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec2 a = kRectangle[k], b = kRectangle[(k + 1) % 4];
      angular.push_back(a);
      for (std::size_t j = 0; j < 8; ++j) {
        const double part = (place[15 * k + j] - place[15 * k]) + 0.01;
        angular.push_back(a + (0.9 * part / (place[15 * k + 8] - place[15 * k] + 0.01)) * (b - a));
      }
    }
    EXPECT_EQ(corners_of(angular, true), multiples(9, 4)) << round;
  }
}

// A tooth: two flanks of ten chords of a parabola, and an edge at the root and at the tip, longer
// than their chords by ten and by six times.
TEST(Corners, EdgesBetweenRowsOfShortChordsEndInCorners) {
  Points points;
  for (int k = 0; k <= 10; ++k) points.push_back({1.0 - 0.004 * k * k, 0.2 * k});
  for (int k = 10; k >= 0; --k) points.push_back({-1.0 + 0.004 * k * k, 0.2 * k});
  for (std::size_t first = 0; first < points.size(); ++first) {
    Points turned = points;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first), turned.end());
    Indices expected;
    for (const std::size_t corner : {0U, 10U, 11U, 21U}) {
      expected.push_back((corner + points.size() - first) % points.size());
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(corners_of(turned, true), expected) << first;
  }
}

// A circle measured finely, but for a part of it: the bend may go on there. (Equal chords are a
// drawing; their edge is one from 90 degrees on.)
TEST(Corners, HolesInTheMeasurementOfARoundCurveAreNoEdges) {
  for (const int hole : {30, 60, 90, 120, 180}) {  // of 360 points
    Points points;
    for (int k = 0; k <= 360 - hole; ++k) {
      const double angle = k * kDeg + 0.2 * kDeg * std::sin(3.0 * k);
      points.push_back({std::cos(angle), std::sin(angle)});
    }
    EXPECT_EQ(corners_of(points, true), Indices{}) << hole;
  }
}

TEST(Corners, AKinkBetweenTwoArcsIsFoundWhenItStandsOut) {
  for (const double each : {0.0, 1.0, 3.0}) {
    EXPECT_EQ(corners_of(bent_row(each, 45.0), false), Indices{8}) << each;
    EXPECT_EQ(corners_of(bent_row(-each, 45.0), false), Indices{8}) << each;
    EXPECT_EQ(corners_of(bent_row(each, 19.0), false), Indices{}) << each;
    // Chines of hulls: 25 degrees where the flanks turn by less than one.
    EXPECT_EQ(corners_of(bent_row(0.2 * each, 25.0), false), Indices{8}) << each;
    EXPECT_EQ(corners_of(bent_row(each, -120.0), false), Indices{8}) << each;
  }
  EXPECT_EQ(corners_of(bent_row(1.0, 19.0), false, 0.0, 12.0), Indices{8});
  EXPECT_EQ(corners_of(bent_row(1.0, 45.0), false, 0.0, 60.0), Indices{});
  EXPECT_EQ(corners_of(bent_row(15.0, 45.0), false), Indices{});
}

TEST(Corners, BothTipsOfALensAreFound) {
  for (const int steps : {6, 12, 20, 60}) {  // two arcs of 60 degrees that meet at 120
    Points points;
    for (int i = 0; i < steps; ++i) {
      const double t = (-30.0 + 60.0 * i / steps) * kDeg;
      points.push_back({std::sin(t), std::cos(t) - std::cos(30.0 * kDeg)});
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(steps); ++i) points.push_back(-points[i]);
    EXPECT_EQ(corners_of(points, true), (Indices{0, static_cast<std::size_t>(steps)})) << steps;
  }
}

// NACA 0012, its thickness closed or left open at the trailing edge, cosine spacing, from the
// trailing edge over the upper side; the closing point is not repeated.
Points naca0012(int n, bool sharp) {
  const auto half = [&](double x) {
    const double last = sharp ? 0.1036 : 0.1015;
    return 0.6 * (0.2969 * std::sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - last * x))));
  };
  Points points;
  for (int i = 0; i <= 2 * n; ++i) {
    const double x = 0.5 * (1.0 + std::cos(kPi * i / n));
    points.push_back({x, i <= n ? half(x) : -half(x)});
  }
  if (sharp) points.pop_back();
  return points;
}

TEST(Corners, TrailingEdgesAreCornersAndLeadingEdgesAreNot) {
  for (const int n : {8, 12, 20, 40, 100}) {
    EXPECT_EQ(corners_of(naca0012(n, true), true), Indices{0}) << n;
    const auto last = static_cast<std::size_t>(2 * n);
    EXPECT_EQ(corners_of(naca0012(n, false), true), (Indices{0, last})) << n;
    EXPECT_EQ(corners_of(naca0012(n, false), false), Indices{}) << n;
  }
}

Points moved(Points points, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * kPi), length(0.0, noise);
  for (Vec2& p : points) p = p + length(random) * unit_at(angle(random));
  return points;
}

// Rows 150 to 158 of ag12 (UIUC), its trailing edge as one point, and rows 2 to 10: chords as long
// as coarse tolerances need turn alike wherever they begin near such a tip.
TEST(Corners, TheCornerOfASharpTipIsTheTip) {
  const Points tip{
      {0.885322, 0.002011},  {0.899184, 0.001798}, {0.913057, 0.001557}, {0.926935, 0.001293},
      {0.940803, 0.001006},  {0.954669, 0.00069},  {0.968513, 0.000352}, {0.982113, -2e-06},
      {0.994133, -0.000323}, {1.0, 0.0},           {0.994142, 0.001042}, {0.982204, 0.002222},
      {0.968696, 0.003522},  {0.95491, 0.004823},  {0.941098, 0.006097}, {0.927274, 0.007345},
      {0.913441, 0.008575},  {0.899593, 0.009787}, {0.885734, 0.010985}};
  for (const double noise : {5e-7, 1e-4, 3e-4, 5e-4, 8e-4, 9e-4, 1e-3, 1.2e-3}) {
    EXPECT_EQ(corners_of(tip, false, noise), Indices{9}) << noise;
  }
}

// Whole numbers, as digitised pictures have them, without repeats.
Points on_grid(const Points& points) {
  Points result;
  for (const Vec2 p : points) {
    const Vec2 q{std::round(p.x), std::round(p.y)};
    if (result.empty() || !(q == result.back())) result.push_back(q);
  }
  if (result.back() == result.front()) result.pop_back();
  return result;
}

TEST(Corners, NoiseAndStaircasesAreNotTakenForThem) {
  for (const double radius : {40.0, 100.0, 300.0}) {
    const Points smooth = ellipse_points(2.0 * radius, radius, static_cast<int>(8.0 * radius));
    for (const double noise : {0.5, 1.0}) {
      EXPECT_EQ(corners_of(on_grid(smooth), true, noise), Indices{}) << radius;
      for (unsigned seed = 0; seed < 5; ++seed) {
        EXPECT_EQ(corners_of(moved(smooth, noise, seed), true, noise), Indices{}) << radius;
      }
    }
  }
}

TEST(Corners, TheyAreFoundUnderNoiseNearWhereTheyAre) {
  for (const double radius : {100.0, 300.0}) {
    for (const double noise : {0.5, 1.0}) {
      Points sharp = outline({{0, 0}, {3 * radius, 0}, {3 * radius, 2 * radius}, {0, 2 * radius}},
                             static_cast<int>(radius));
      for (Vec2& p : sharp) p = complex_product(p, unit_at(0.3));
      const auto step = static_cast<std::size_t>(radius);
      for (unsigned seed = 0; seed < 5; ++seed) {
        const Points noisy = moved(sharp, noise, seed);
        const Indices found = corners_of(noisy, true, noise);
        ASSERT_EQ(found.size(), 4U) << radius << " " << noise;
        for (const std::size_t i : found) {
          // Half the chord at which a right angle is looked for: 24 noise / (4 * 20 degrees).
          const std::size_t k = (i + step / 2) / step * step % sharp.size();
          EXPECT_LE(norm(sharp[i] - sharp[k]), 0.5 * 24.0 * noise / (80.0 * kDeg)) << i;
        }
      }
    }
  }
}

TEST(Corners, ARoundedCornerLargerThanTheNoiseIsNone) {
  // Radius 12 under noise 0.5: the arc misses the corner by 5, ten times the noise.
  Points points;
  const Points centres{{288, 12}, {288, 188}, {12, 188}, {12, 12}};
  for (std::size_t k = 0; k < 4; ++k) {
    for (int j = 0; j <= 12; ++j) {
      points.push_back(centres[k] + 12.0 * unit_at((90.0 * (double(k) - 1.0) + 7.5 * j) * kDeg));
    }
    const Vec2 from = points.back();
    const Vec2 to = centres[(k + 1) % 4] + 12.0 * unit_at(90.0 * double(k) * kDeg);
    const int m = static_cast<int>(norm(to - from) / 1.5);
    for (int j = 1; j < m; ++j) points.push_back(from + (double(j) / m) * (to - from));
  }
  for (unsigned seed = 0; seed < 5; ++seed) {
    EXPECT_EQ(corners_of(moved(points, 0.5, seed), true, 0.5), Indices{}) << seed;
  }
}

TEST(Corners, MotionScaleAndMirrorImageChangeNothing) {
  Points points = outline(kBracket, 5);
  for (const double scale : {1e-6, 1.0, 1e6}) {
    Points other, mirrored;
    for (const Vec2 p : points) {
      other.push_back(scale * (complex_product(p, unit_at(1.1)) + Vec2{7.0, -3.0}));
      mirrored.push_back(scale * Vec2{p.x, -p.y});
    }
    EXPECT_EQ(corners_of(other, true), multiples(5, 6));
    EXPECT_EQ(corners_of(mirrored, true), multiples(5, 6));
  }
}

TEST(Corners, MarkedPointsAreCornersWhateverTheyLookLike) {
  const Points points = ellipse_points(3, 1, 40);
  std::vector<FixedData> fixed(40);
  fixed[7].corner = true;
  fixed[0].corner = true;
  EXPECT_EQ(find_corners(points, {}, true, fixed, {}), (Indices{0, 7}));
  EXPECT_EQ(find_corners(points, {}, false, fixed, {}), Indices{7});
  EXPECT_EQ(find_corners(outline(kRectangle, 5), {}, true, std::vector<FixedData>(20),
                         {false, kDefaultCornerAngle}),
            Indices{});
  fixed.assign(20, {});
  fixed[5].corner = true;
  fixed[6].corner = true;
  EXPECT_EQ(find_corners(outline(kRectangle, 5), {}, true, fixed, {}), (Indices{0, 5, 6, 10, 15}));
  EXPECT_EQ(find_corners(outline(kRectangle, 5), {}, true, fixed, {false, 1.0}), (Indices{5, 6}));
}

TEST(Corners, AFewPointsWithoutCalmNeighboursHaveNone) {
  EXPECT_EQ(corners_of({{0, 0}, {1, 0}, {1, 1}}, false), Indices{});
  EXPECT_EQ(corners_of({{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}}, false), Indices{});
  EXPECT_EQ(corners_of({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}}, false), Indices{2});
  EXPECT_EQ(corners_of({{0, 0}, {1, 0}}, false), Indices{});
}

}  // namespace
}  // namespace obvid
