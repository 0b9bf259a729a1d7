// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/network.h"
#include "../common/angles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <random>

#include "network_crossing.h"
#include "network_side.h"

namespace obvid {
namespace {

Vec3 at(const SpaceCurve& curve, double part) {
  return evaluate(curve, domain(curve).at(part)).point;
}

/// Distance of a point from a curve by rasters around the nearest place: 0 to some 1e-9.
double distance_from_curve(const SpaceCurve& curve, Vec3 point) {
  double best = 1e300, centre = 0.5, half = 0.5;
  for (int level = 0; level < 10; ++level) {
    const int steps = level == 0 ? 400 : 20;
    double next = centre;
    for (int i = -steps; i <= steps; ++i) {
      const double part = std::clamp(centre + half * i / steps, 0.0, 1.0);
      const double distance = norm(at(curve, part) - point);
      if (distance < best) {
        best = distance;
        next = part;
      }
    }
    centre = next;
    half *= 2.0 / steps;
  }
  return best;
}

double farthest(const SpaceCurve& curve, const SpaceCurve& from) {
  double worst = 0.0;
  for (int i = 0; i <= 40; ++i) {
    worst = std::max(worst, distance_from_curve(from, at(curve, i / 40.0)));
  }
  return worst;
}

/// A curve through points of f; `warp` bunches the parameters.
template <class Function>
SpaceCurve curve_of(const Function& f, double warp = 0.0, std::size_t n = 41) {
  std::vector<Vec3> points;
  std::vector<double> parameters;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(n - 1);
    points.push_back(f(x));
    parameters.push_back(x + warp * x * (1.0 - x));
  }
  return *interpolated(points, parameters);
}

double hill(double x, double y) { return 0.3 * std::sin(3 * x + 1) * std::cos(2 * y); }
Vec3 place(double x, double y) { return {x, y, hill(x, y)}; }

// ---- nearest points ----

TEST(NearestPoints, OfSkewLinesAreTheFeetOfTheirCommonPerpendicular) {
  const BoxedCurve a(line_between({-1, 0, 0}, {3, 0, 0}));
  const BoxedCurve b(line_between({1, -2, 0.5}, {1, 6, 0.5}));
  const Crossing found = nearest_points(a, b);
  EXPECT_NEAR(found.s, 0.5, 1e-12);
  EXPECT_NEAR(found.t, 0.25, 1e-12);
  EXPECT_NEAR(found.distance, 0.5, 1e-15);
}

TEST(NearestPoints, LieAtEndsWhereCurvesMissEachOther) {
  const Crossing found = nearest_points(BoxedCurve(line_between({0, 0, 0}, {1, 0, 0})),
                                        BoxedCurve(line_between({2, 1, 0}, {5, 1, 0})));
  EXPECT_EQ(found.s, 1.0);
  EXPECT_EQ(found.t, 0.0);
  EXPECT_NEAR(found.distance, std::sqrt(2.0), 1e-15);
}

TEST(NearestPoints, OfRandomCurvesAreNoFartherThanARasterFinds) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int round = 0; round < 60; ++round) {
    std::array<SpaceCurve, 2> curves;
    for (SpaceCurve& c : curves) {
      std::vector<Vec3> points;
      for (int i = 0; i < 8; ++i)
        points.push_back({number(random), number(random), number(random)});
      c = *interpolated(points, chord_parameters(points));
    }
    const Crossing found = nearest_points(BoxedCurve(curves[0]), BoxedCurve(curves[1]));
    EXPECT_NEAR(norm(at(curves[0], found.s) - at(curves[1], found.t)), found.distance, 1e-14);
    double raster = 1e300;
    for (int i = 0; i <= 200; ++i) {
      for (int j = 0; j <= 200; ++j) {
        raster = std::min(raster, norm(at(curves[0], i / 200.0) - at(curves[1], j / 200.0)));
      }
    }
    EXPECT_LE(found.distance, raster);
    EXPECT_GT(found.distance, raster - 0.08);  // some 14 long: half a step each is 0.07
  }
}

TEST(NearestPoints, AreFoundInTimeWhereCurvesRunAlongEachOther) {
  const SpaceCurve wave = curve_of([](double x) { return place(x, x * x); }, 0.0, 2001);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(nearest_points(BoxedCurve(wave), BoxedCurve(wave)).distance, 0.0);
  // a circle and its axis: all points are as near
  const SpaceCurve circle = arc_about({1, 0, 0}, {0, 0, 0}, {0, 0, 1}, 2 * kPi);
  EXPECT_NEAR(
      nearest_points(BoxedCurve(circle), BoxedCurve(line_between({0, 0, -1}, {0, 0, 2}))).distance,
      1.0, 1e-12);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

// ---- Coons ----

std::vector<SpaceCurve> four_borders() {
  return {curve_of([](double x) { return place(x, 0); }),
          curve_of([](double y) { return place(1, y); }),
          curve_of([](double x) { return place(1 - x, 1); }),
          curve_of([](double y) { return place(0, 1 - y); })};
}

void expect_corners_meet(const CoonsPatch& patch) {
  EXPECT_EQ(at(patch.u_at_v0, 0), at(patch.v_at_u0, 0));
  EXPECT_EQ(at(patch.u_at_v0, 1), at(patch.v_at_u1, 0));
  EXPECT_EQ(at(patch.u_at_v1, 0), at(patch.v_at_u0, 1));
  EXPECT_EQ(at(patch.u_at_v1, 1), at(patch.v_at_u1, 1));
}

TEST(CoonsFrom, TakesCurvesInAnyOrderAndDirection) {
  const std::vector<SpaceCurve> borders = four_borders();
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  int tried = 0;
  do {
    for (unsigned turns = 0; turns < 16; ++turns) {
      std::vector<SpaceCurve> given;
      for (std::size_t k = 0; k < 4; ++k) {
        given.push_back((turns >> k & 1U) != 0 ? reversed(borders[order[k]]) : borders[order[k]]);
      }
      const Result<CoonsPatch> patch = coons_from(given, 1e-6);
      ASSERT_TRUE(patch) << patch.error().what;
      expect_corners_meet(*patch);
      EXPECT_LT(norm(at(patch->u_at_v0, 0.3) - at(given[0], 0.3)), 1e-12);
      // the opposite border is the one two further on
      const SpaceCurve& opposite = borders[(order[0] + 2) % 4];
      EXPECT_LT(distance_from_curve(opposite, at(patch->u_at_v1, 0.3)), 1e-8);
      ++tried;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(tried, 24 * 16);
}

TEST(CoonsFrom, ClosesGapsWithinTheToleranceInTheMiddle) {
  std::vector<SpaceCurve> borders = four_borders();
  borders[1].points.front() = borders[1].points.front() + Vec3{0, 0, 2e-3};
  const Result<CoonsPatch> patch = coons_from(borders, 2.1e-3);
  ASSERT_TRUE(patch) << patch.error().what;
  expect_corners_meet(*patch);
  EXPECT_LT(norm(at(patch->u_at_v0, 1) - (place(1, 0) + Vec3{0, 0, 1e-3})), 1e-12);
  EXPECT_LE(farthest(patch->u_at_v0, borders[0]), 1e-3);
  const auto open = coons_from(borders, 1.9e-3);
  ASSERT_FALSE(open);
  EXPECT_EQ(open.error().code, ErrorCode::kBadOption);
  EXPECT_NEAR(open.error().value, 2e-3, 1e-12);
  EXPECT_TRUE(open.error().index == 0 || open.error().index == 1) << open.error().index;
}

TEST(CoonsFrom, TakesTrianglesWithAPointForTheFourthSide) {
  std::vector<SpaceCurve> sides{line_between({0, 0, 0}, {4, 0, 0}),
                                line_between({4, 0, 0}, {0, 3, 0}),
                                line_between({0, 3, 0}, {0, 0, 0})};
  const auto three = coons_from(sides, 1e-6);
  ASSERT_FALSE(three);
  EXPECT_EQ(three.error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(three.error().value, 3.0);
  sides.push_back(line_between({0, 3, 0}, {0, 3, 0}));
  const Result<CoonsPatch> patch = coons_from(sides, 1e-6);
  ASSERT_TRUE(patch) << patch.error().what;
  expect_corners_meet(*patch);
}

TEST(CoonsFrom, JoinsClosedCurvesAlongASeamWithoutTwist) {
  const Vec3 up{0, 0, 1};
  const SpaceCurve low = arc_about({2, 0, 0}, {0, 0, 0}, up, 2 * kPi);
  const SpaceCurve high = arc_about({1, 0, 3}, {0, 0, 3}, up, -2 * kPi);  // runs the other way
  const SpaceCurve seam = line_between({1, 0, 3}, {2, 0, 0});
  const Result<CoonsPatch> patch = coons_from({low, high, seam, seam}, 1e-9);
  ASSERT_TRUE(patch) << patch.error().what;
  expect_corners_meet(*patch);
  EXPECT_EQ(patch->u_at_v0, low);
  for (const double part : {0.2, 0.6}) {  // a cone: the rim above is half as wide
    const Vec3 below = at(patch->u_at_v0, part), above = at(patch->u_at_v1, part);
    EXPECT_LT(norm(above - Vec3{below.x / 2, below.y / 2, 3}), 1e-12);
  }
}

TEST(CoonsFrom, RefusesWhatMakesNoPatch) {
  std::vector<SpaceCurve> borders = four_borders();
  EXPECT_EQ(coons_from({}, 1.0).error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(coons_from(borders, 0.0).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(coons_from(borders, std::nan("")).error().code, ErrorCode::kBadOption);
  // a border twice instead of the opposite one
  EXPECT_EQ(coons_from({borders[0], borders[1], borders[0], borders[3]}, 1e-6).error().code,
            ErrorCode::kBadOption);
  // there and back again
  const auto flat = coons_from({borders[0], borders[0], borders[1], borders[1]}, 1e-6);
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::kBadOption);
  borders[2].points[3].y = std::nan("");
  const auto bad = coons_from(borders, 1e-6);
  EXPECT_EQ(bad.error().code, ErrorCode::kNotFinite);
  EXPECT_EQ(bad.error().index, 2);
}

// ---- Gordon ----

void expect_net(const GordonSurface& net, double exact) {
  ASSERT_EQ(net.along_u.size(), net.v_at.size());
  ASSERT_EQ(net.along_v.size(), net.u_at.size());
  for (const std::vector<double>* list : {&net.u_at, &net.v_at}) {
    EXPECT_EQ(list->front(), 0.0);
    EXPECT_EQ(list->back(), 1.0);
    EXPECT_TRUE(std::is_sorted(list->begin(), list->end(), std::less_equal<>()) ||
                std::adjacent_find(list->begin(), list->end(), std::greater_equal<>()) ==
                    list->end());
  }
  for (std::size_t j = 0; j < net.v_at.size(); ++j) {
    ASSERT_TRUE(check(net.along_u[j]));
    EXPECT_EQ(domain(net.along_u[j]).from, 0.0);
    EXPECT_EQ(domain(net.along_u[j]).to, 1.0);
    for (std::size_t i = 0; i < net.u_at.size(); ++i) {
      EXPECT_LT(norm(at(net.along_u[j], net.u_at[i]) - at(net.along_v[i], net.v_at[j])), exact);
    }
  }
}

const std::vector<double> kColumns{0.0, 0.25, 0.4, 0.8, 1.0};
const std::vector<double> kRows{0.0, 0.35, 0.7, 1.0};

struct HillNet {
  std::vector<SpaceCurve> rows, columns;
};

/// Curves y = const and x = const of the hill, each with a speed of its own.
HillNet hill_net(double warp) {
  HillNet net;
  for (std::size_t j = 0; j < kRows.size(); ++j) {
    const double sign = j % 2 == 0 ? 1.0 : -0.6;
    net.rows.push_back(curve_of([&](double x) { return place(x, kRows[j]); }, sign * warp));
  }
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    const double sign = i % 2 == 0 ? -0.8 : 1.0;
    net.columns.push_back(curve_of([&](double y) { return place(kColumns[i], y); }, sign * warp));
  }
  return net;
}

TEST(GordonFrom, LeavesCurvesAloneThatAgree) {
  const HillNet given = hill_net(0.0);
  const Result<GordonSurface> net = gordon_from(given.rows, given.columns, 1e-4);
  ASSERT_TRUE(net) << net.error().what;
  expect_net(*net, 1e-8);
  EXPECT_EQ(net->along_u, given.rows);
  EXPECT_EQ(net->along_v, given.columns);
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    EXPECT_NEAR(net->u_at[i], kColumns[i], 1e-6);  // where the curves differ by 1e-7 between points
  }
}

TEST(GordonFrom, MakesParametersAgreeWithinTheTolerance) {
  const HillNet given = hill_net(0.7);
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    const Result<GordonSurface> net = gordon_from(given.rows, given.columns, tolerance);
    ASSERT_TRUE(net) << net.error().what;
    expect_net(*net, 1e-12);
    for (std::size_t j = 0; j < kRows.size(); ++j) {
      EXPECT_LE(farthest(net->along_u[j], given.rows[j]), tolerance);
      EXPECT_LE(farthest(given.rows[j], net->along_u[j]), tolerance);
    }
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      EXPECT_LE(farthest(net->along_v[i], given.columns[i]), tolerance);
    }
  }
}

TEST(GordonFrom, PutsCurvesInOrderAndTurnsThem) {
  HillNet given = hill_net(0.3);
  std::mt19937_64 random(8);
  for (int round = 0; round < 20; ++round) {
    HillNet mixed = given;
    std::shuffle(mixed.rows.begin(), mixed.rows.end(), random);
    std::shuffle(mixed.columns.begin(), mixed.columns.end(), random);
    for (auto* curves : {&mixed.rows, &mixed.columns}) {
      for (SpaceCurve& c : *curves) {
        if (random() % 2 == 0) c = with_domain(reversed(c), {-3.0, 7.0});
      }
    }
    const Result<GordonSurface> net = gordon_from(mixed.rows, mixed.columns, 1e-4);
    ASSERT_TRUE(net) << net.error().what;
    expect_net(*net, 1e-8);
    // the first of each kind keeps its direction: it decides where u and v run
    const bool left = at(mixed.rows[0], 0).x > 0.5, down = at(mixed.columns[0], 0).y > 0.5;
    const Vec3 corner = at(net->along_u[0], 0);
    EXPECT_NEAR(corner.x, left ? 1.0 : 0.0, 1e-4);
    EXPECT_NEAR(corner.y, down ? 1.0 : 0.0, 1e-4);
  }
}

TEST(GordonFrom, TakesGapsWithinTheToleranceIntoTheMiddle) {
  HillNet given = hill_net(0.4);
  for (std::size_t i = 0; i < given.columns.size(); ++i) {
    for (Vec3& p : given.columns[i].points) p.z += i % 2 == 0 ? 4e-4 : -4e-4;
  }
  const double tolerance = 1e-3;
  const Result<GordonSurface> net = gordon_from(given.rows, given.columns, tolerance);
  ASSERT_TRUE(net) << net.error().what;
  expect_net(*net, 1e-12);
  for (std::size_t j = 0; j < kRows.size(); ++j) {
    EXPECT_LE(farthest(net->along_u[j], given.rows[j]), tolerance + 4e-4);
  }
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    EXPECT_LE(farthest(net->along_v[i], given.columns[i]), tolerance + 4e-4);
  }
  // crossings lie half way: as far from the one curve as from the other
  const Vec3 crossing = at(net->along_u[1], net->u_at[1]);
  const double to_row = distance_from_curve(given.rows[1], crossing);
  EXPECT_GT(to_row, 1e-4);
  EXPECT_LT(to_row, 2e-4);
  EXPECT_NEAR(to_row, distance_from_curve(given.columns[1], crossing), 1e-8);
}

TEST(GordonFrom, CutsOffWhatSticksOut) {
  std::vector<SpaceCurve> rows, columns;
  for (const double y : {0.0, 0.5, 1.0}) {
    rows.push_back(curve_of([&](double x) { return place(1.4 * x - 0.2, y); }));
  }
  for (const double x : {0.0, 0.3, 1.0}) {
    columns.push_back(curve_of([&](double y) { return place(x, 1.1 * y); }));
  }
  const Result<GordonSurface> net = gordon_from(rows, columns, 1e-5);
  ASSERT_TRUE(net) << net.error().what;
  expect_net(*net, 1e-8);
  EXPECT_LT(norm(at(net->along_u[1], 0) - place(0, 0.5)), 1e-5);
  EXPECT_LT(norm(at(net->along_u[1], 1) - place(1, 0.5)), 1e-5);
  EXPECT_LT(norm(at(net->along_v[1], 1) - place(0.3, 1)), 1e-5);
}

TEST(GordonFrom, KeepsRationalArcsOfASphere) {
  // parallels and meridians of an eighth of a sphere, with its pole
  const Vec3 up{0, 0, 1};
  const auto on_sphere = [](double lat, double lon) {
    return Vec3{std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
  };
  std::vector<SpaceCurve> parallels, meridians;
  for (const double lat : {0.0, kPi / 4}) {
    parallels.push_back(arc_about(on_sphere(lat, 0), {0, 0, 0}, up, kPi / 2));
  }
  parallels.push_back(line_between({0, 0, 1}, {0, 0, 1}));
  for (const double lon : {0.0, kPi / 4, kPi / 2}) {
    const Vec3 axis{std::sin(lon), -std::cos(lon), 0};
    meridians.push_back(arc_about(on_sphere(0, lon), {0, 0, 0}, axis, kPi / 2));
  }
  const Result<GordonSurface> net = gordon_from(parallels, meridians, 1e-6);
  ASSERT_TRUE(net) << net.error().what;
  expect_net(*net, 1e-9);
  EXPECT_EQ(net->along_u, parallels);
  EXPECT_EQ(net->along_v, meridians);
  EXPECT_NEAR(net->u_at[1], 0.5, 1e-12);  // halves of a quarter circle by symmetry
  EXPECT_NEAR(net->v_at[1], 0.5, 1e-12);
}

TEST(GordonFrom, ClosesRingsWithTheCurveTheyBeginOn) {
  const Vec3 up{0, 0, 1};
  std::vector<SpaceCurve> rings, lines;
  for (const double z : {0.0, 1.0, 2.0, 4.0}) {
    const double r = 1.0 + 0.1 * z;
    const double turn = z == 1.0 || z == 4.0 ? -2 * kPi : 2 * kPi;
    rings.push_back(arc_about({r, 0, z}, {0, 0, z}, up, turn));
  }
  for (const double a : {2.0, 0.0, 4.5}) {
    const Vec3 way{std::cos(a), std::sin(a), 0};
    lines.push_back(line_between(way, 1.4 * way + 4.0 * up));
  }
  const Result<GordonSurface> net = gordon_from(rings, lines, 1e-5);
  ASSERT_TRUE(net) << net.error().what;
  expect_net(*net, 1e-8);
  ASSERT_EQ(net->along_v.size(), 4u);
  EXPECT_EQ(net->along_v.front(), net->along_v.back());
  for (std::size_t j = 0; j < rings.size(); ++j) {
    EXPECT_LT(norm(at(net->along_u[j], 0) - at(net->along_u[j], 1)), 1e-8);
    EXPECT_GT(at(net->along_u[j], 0.2).y, 0.0);  // all run as the first one does
  }
  // one line besides the seam: tangents tell the direction
  EXPECT_TRUE(gordon_from(rings, {lines[0], lines[1]}, 1e-5));
  const auto adrift = gordon_from(rings, {lines[0], lines[2]}, 1e-5);
  ASSERT_FALSE(adrift);
  EXPECT_EQ(adrift.error().code, ErrorCode::kBadOption);
}

TEST(GordonFrom, FollowsCorners) {
  // rows with a corner at different parameters
  std::vector<SpaceCurve> rows, columns;
  for (const double y : {0.0, 1.0}) {
    const double knot = y == 0.0 ? 0.3 : 0.6;
    rows.push_back({1, {0, 0, knot, 1, 1}, {{0, y, 0}, {0.5, y, 0.2}, {1, y, 0}}, {}});
  }
  for (const double x : {0.0, 0.5, 1.0}) {
    const double z = x == 0.5 ? 0.2 : 0.0;
    columns.push_back(line_between({x, 0, z}, {x, 1, z}));
  }
  const Result<GordonSurface> net = gordon_from(rows, columns, 1e-4);
  ASSERT_TRUE(net) << net.error().what;
  expect_net(*net, 1e-12);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_LE(farthest(net->along_u[j], rows[j]), 1e-4);
    EXPECT_LE(farthest(rows[j], net->along_u[j]), 1e-4);
  }
}

TEST(GordonFrom, BecomesANurbsSurfaceThatHoldsAllCurves) {
  for (const double warp : {0.0, 0.6}) {
    const HillNet given = hill_net(warp);
    const double tolerance = 1e-4;
    const Result<GordonSurface> net = gordon_from(given.rows, given.columns, tolerance);
    ASSERT_TRUE(net) << net.error().what;
    const Result<NurbsForm> form = to_nurbs(*net, 1e-8);
    ASSERT_TRUE(form) << form.error().what;
    for (std::size_t j = 0; j < kRows.size(); ++j) {
      EXPECT_LE(farthest(isocurve_at_v(form->surface, net->v_at[j]), given.rows[j]),
                tolerance + 1e-7);
    }
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      EXPECT_LE(farthest(isocurve_at_u(form->surface, net->u_at[i]), given.columns[i]),
                tolerance + 1e-7);
    }
    // between the curves it is the hill as far as few curves tell
    for (double u = 0.05; u < 1.0; u += 0.1) {
      for (double v = 0.05; v < 1.0; v += 0.1) {
        const Vec3 p = evaluate(form->surface, u, v).point;
        EXPECT_NEAR(p.z, hill(p.x, p.y), 0.01);
      }
    }
  }
}

TEST(GordonFrom, SaysThatAToleranceBelowRoundingIsNotReached) {
  NetSide side{"of the first kind", {}, {0}, {0}, {{0.0, 0.6, 1.0}}};
  side.curves.push_back(curve_of([](double x) { return place(x, x * x); }));
  const std::vector<double> common{0.0, 0.4, 1.0};
  CrossingPoints points{{}};
  for (const double t : side.at[0]) points[0].push_back(at(side.curves[0], t));
  ASSERT_TRUE(rebuilt(side, common, points, 1e-9));
  const auto impossible = rebuilt(side, common, points, 1e-17);
  ASSERT_FALSE(impossible);
  EXPECT_EQ(impossible.error().code, ErrorCode::kToleranceNotReached);
  EXPECT_LT(impossible.error().value, 1e-12);
}

TEST(GordonFrom, RefusesNetsThatAreNone) {
  const HillNet good = hill_net(0.2);
  const auto code = [](const Result<GordonSurface>& made) {
    return made ? ErrorCode::kInternal : made.error().code;
  };
  EXPECT_EQ(code(gordon_from({good.rows[0]}, good.columns, 1e-4)), ErrorCode::kTooFewPoints);
  EXPECT_EQ(code(gordon_from(good.rows, {}, 1e-4)), ErrorCode::kTooFewPoints);
  EXPECT_EQ(code(gordon_from(good.rows, good.columns, -1.0)), ErrorCode::kBadOption);
  // a column that passes over a row
  HillNet bad = good;
  for (Vec3& p : bad.columns[3].points) p.z += 0.01;
  const Result<GordonSurface> missed = gordon_from(bad.rows, bad.columns, 1e-3);
  ASSERT_FALSE(missed);
  EXPECT_EQ(missed.error().code, ErrorCode::kBadOption);
  EXPECT_EQ(missed.error().index, 0);
  EXPECT_GT(missed.error().value, 0.005);  // 0.01 upright, less across the slope
  EXPECT_LE(missed.error().value, 0.01);
  EXPECT_NE(missed.error().what.find("curve 4 of the second kind"), std::string::npos)
      << missed.error().what;
  // the same curve twice, once backwards
  bad = good;
  bad.columns.push_back(reversed(bad.columns[1]));
  const Result<GordonSurface> twice = gordon_from(bad.rows, bad.columns, 1e-3);
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().code, ErrorCode::kBadOption);
  EXPECT_NE(twice.error().what.find("same place"), std::string::npos) << twice.error().what;
  // columns that cross each other between two rows
  bad = good;
  bad.columns[1] = line_between({0.2, 0, 0}, {0.7, 1, 0});
  bad.columns[2] = line_between({0.6, 0, 0}, {0.3, 1, 0});
  for (auto* curves : {&bad.rows, &bad.columns}) {
    for (SpaceCurve& c : *curves) {
      for (Vec3& p : c.points) p.z = 0.0;
    }
  }
  const Result<GordonSurface> crossed = gordon_from(bad.rows, bad.columns, 1e-3);
  ASSERT_FALSE(crossed);
  EXPECT_NE(crossed.error().what.find("another order"), std::string::npos) << crossed.error().what;
  // both kinds the same curves
  EXPECT_EQ(code(gordon_from(good.rows, good.rows, 1e-3)), ErrorCode::kBadOption);
  bad = good;
  bad.rows[2].knots[2] = 9.0;
  const Result<GordonSurface> broken = gordon_from(bad.rows, bad.columns, 1e-3);
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().index, 2);
}

}  // namespace
}  // namespace obvid
