// SPDX-License-Identifier: Apache-2.0
// Curves in space with corners: circles and lines of known planes, helices of known torsion.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "obvid/pipeline/space_fit.h"

namespace obvid {
namespace {

constexpr double kQuarter = 0.5 * std::numbers::pi;

void append(std::vector<Vec3>& points, const std::function<Vec3(double)>& curve, int steps) {
  for (int i = points.empty() ? 0 : 1; i <= steps; ++i) {
    points.push_back(curve(static_cast<double>(i) / steps));
  }
}

/// A line along x, a quarter of a circle upright in the plane x = 40, and a turn of a helix around
/// an axis along x, which leaves at an angle.
SpaceSeries rail() {
  SpaceSeries out;
  out.name = "rail";
  append(
      out.points,
      [](double u) {
        return Vec3{40.0 * u, 0.0, 0.0};
      },
      5);
  append(
      out.points,
      [](double u) {
        const double a = kQuarter * u;
        return Vec3{40.0, 30.0 * std::sin(a), 30.0 * (1.0 - std::cos(a))};
      },
      10);
  append(
      out.points,
      [](double u) {
        const double a = 2.0 * u;
        return Vec3{40.0 + 8.0 * a, 30.0 + 20.0 * std::sin(a), 30.0 + 20.0 * (1.0 - std::cos(a))};
      },
      12);
  return out;
}

SpaceJob along_x() {
  SpaceJob job;
  job.along = Vec3{1, 0, 0};
  return job;
}

TEST(SpaceChainTest, CornersCutASeriesIntoCurvesOfTheirOwnPlanes) {
  const auto made = fit_space_chain(rail(), {});
  ASSERT_TRUE(made) << to_line(made.error());
  ASSERT_EQ(made->parts.size(), 3U);
  ASSERT_EQ(made->corners.size(), 2U);
  EXPECT_EQ(made->corners[0].point, 5U);
  EXPECT_EQ(made->corners[1].point, 15U);
  EXPECT_FALSE(made->parts[0].unrolled);
  EXPECT_FALSE(made->parts[1].unrolled);
  EXPECT_TRUE(made->parts[2].unrolled);
  // from the line along x into the circle, whose tangent lies along y
  EXPECT_NEAR(made->corners[0].turn, kQuarter, 1e-6);
  EXPECT_NEAR(std::abs(made->parts[1].frame.normal().x), 1.0, 1e-12);
  for (const Element& e : {made->parts[1].plan.contour.joints.front().element,
                           made->parts[1].plan.contour.joints.back().element}) {
    EXPECT_NEAR(std::abs(e.kappa), 1.0 / 30.0, 1e-9);
  }
  for (const SpaceFit& part : made->parts) EXPECT_TRUE(part.plan.certificate.proved);
}

TEST(SpaceChainTest, TheAngleAtACornerIsThatOfTheTangents) {
  // seen along x the helix is a circle and its heights are a line: both are met exactly
  const auto made = fit_space_chain(rail(), along_x());
  ASSERT_FALSE(made);  // the first part runs along the direction itself
  SpaceSeries late = rail();
  late.points.erase(late.points.begin(), late.points.begin() + 5);
  const auto from_circle = fit_space_chain(late, along_x());
  ASSERT_TRUE(from_circle) << to_line(from_circle.error());
  ASSERT_EQ(from_circle->corners.size(), 1U);
  const Vec3 before{0, 0, 1}, behind{8, 20, 0};
  const double turn = std::acos(dot(before, behind) / norm(behind));
  EXPECT_NEAR(from_circle->corners[0].turn, turn, 1e-6);
  const SpaceFit& helix = from_circle->parts[1];
  const double torsion = -8.0 / (8.0 * 8.0 + 20.0 * 20.0);
  EXPECT_NEAR(std::abs(helix.least_torsion), std::abs(torsion), 1e-5 * std::abs(torsion));
}

SpaceSeries gable() {
  SpaceSeries out;
  out.name = "gable";
  append(
      out.points,
      [](double u) {
        const double a = 2.0 * kQuarter * u;
        return Vec3{20.0 * std::cos(a), 20.0 * std::sin(a), 0.0};
      },
      16);
  append(
      out.points,
      [](double u) {
        const double a = 2.0 * kQuarter * u;
        return Vec3{-20.0 * std::cos(a), 0.0, 20.0 * std::sin(a)};
      },
      16);
  out.points.back() = out.points.front();  // without the rounding of half a turn
  return out;
}

TEST(SpaceChainTest, AClosedSeriesRunsFromCornerToCornerAllRound) {
  // two half circles, in the planes of x and y and of x and z
  const auto made = fit_space_chain(gable(), {});
  ASSERT_TRUE(made) << to_line(made.error());
  EXPECT_TRUE(made->closed);
  EXPECT_EQ(made->points.size(), 32U);
  ASSERT_EQ(made->corners.size(), 2U);
  EXPECT_EQ(made->corners[0].point, 0U);
  EXPECT_EQ(made->corners[1].point, 16U);
  for (const SpaceCorner& corner : made->corners) EXPECT_NEAR(corner.turn, kQuarter, 1e-6);
  // begun elsewhere the same corners are found
  SpaceSeries turned = gable();
  turned.points.pop_back();
  std::rotate(turned.points.begin(), turned.points.begin() + 7, turned.points.end());
  turned.points.push_back(turned.points.front());
  const auto again = fit_space_chain(turned, {});
  ASSERT_TRUE(again) << to_line(again.error());
  ASSERT_EQ(again->corners.size(), 2U);
  EXPECT_EQ(again->corners[0].point, 9U);
  EXPECT_EQ(again->corners[1].point, 25U);
  EXPECT_EQ(again->parts[1].points.back().x, turned.points[9].x);
}

TEST(SpaceChainTest, AMovedAndTurnedSeriesHasTheSameCorners) {
  const SpaceSeries here = rail();
  SpaceSeries there = here;
  const Vec3 x = unit(Vec3{1, 2, -1}), y = unit(cross(Vec3{0.3, -0.2, 1}, x)), z = cross(x, y);
  for (Vec3& p : there.points) {
    p = 25.4 * (p.x * x + p.y * y + p.z * z) + Vec3{1000, -500, 300};
  }
  const auto a = fit_space_chain(here, {}), b = fit_space_chain(there, {});
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->corners.size(), b->corners.size());
  EXPECT_EQ(a->corners[0].point, b->corners[0].point);
  EXPECT_EQ(a->corners[1].point, b->corners[1].point);
  EXPECT_NEAR(a->corners[0].turn, b->corners[0].turn, 1e-6);
}

TEST(SpaceChainTest, ASmoothCurveHasNoCornersAndOneIsMarked) {
  SpaceSeries helix;
  append(
      helix.points,
      [](double u) {
        const double a = 3.0 * u;
        return Vec3{20.0 * std::cos(a), 20.0 * std::sin(a), 6.0 * a};
      },
      11);
  SpaceJob job;
  job.along = Vec3{0, 0, 1};
  const auto smooth = fit_space_chain(helix, job);
  ASSERT_TRUE(smooth) << to_line(smooth.error());
  EXPECT_TRUE(smooth->corners.empty());
  EXPECT_EQ(smooth->parts.size(), 1U);
  job.fit.constraints.push_back({5, std::nullopt, std::nullopt, true});
  const auto marked = fit_space_chain(helix, job);
  ASSERT_TRUE(marked) << to_line(marked.error());
  ASSERT_EQ(marked->corners.size(), 1U);
  EXPECT_NEAR(marked->corners[0].turn, 0.0, 1e-6);  // both parts are the helix
}

TEST(SpaceChainTest, WithNoisePartsStillMeetInTheirCorners) {
  SpaceSeries series = rail();
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    const double wave = 0.004 * (static_cast<double>(i % 3) - 1.0);
    series.points[i] = series.points[i] + Vec3{wave, -wave, wave};
  }
  SpaceJob job;
  job.fit.noise = 0.01;
  const auto made = fit_space_chain(series, job);
  ASSERT_TRUE(made) << to_line(made.error());
  ASSERT_EQ(made->corners.size(), 2U);
  const auto nurbs = chain_nurbs(*made, 1e-4);
  ASSERT_TRUE(nurbs) << to_line(nurbs.error());
  for (std::size_t k = 0; k < made->corners.size(); ++k) {
    const Vec3 corner = made->points[made->corners[k].point];
    EXPECT_LT(norm((*nurbs)[k].curve.points.back() - corner), 1e-10);
    EXPECT_LT(norm((*nurbs)[k + 1].curve.points.front() - corner), 1e-10);
  }
}

TEST(SpaceChainTest, DataAtPointsBelongToOnePart) {
  SpaceSeries late = rail();
  late.points.erase(late.points.begin(), late.points.begin() + 5);
  SpaceJob job = along_x();
  PointConstraint wish;
  wish.index = 13;  // of the helix, the third behind the corner
  wish.theta = 0.0;
  job.fit.noise = 0.05;
  const double seen =
      fit_space_chain(late, along_x())->parts[1].plan.contour.joints[3].element.theta;
  wish.theta = seen + 0.01;
  job.fit.constraints = {wish};
  const auto made = fit_space_chain(late, job);
  ASSERT_TRUE(made) << to_line(made.error());
  EXPECT_EQ(made->parts[1].plan.report.given.headings, 1);
  wish.index = made->corners[0].point;
  job.fit.constraints = {wish};
  const auto refused = fit_space_chain(late, job);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kBadOption);
  EXPECT_NE(refused.error().what.find("is a corner in space"), std::string::npos);
  job.along.reset();
  EXPECT_EQ(fit_space_chain(late, job).error().code, ErrorCode::kBadOption);
}

std::string false_chain(const StoredSpaceChain& stored) {
  const auto found = verify(stored);
  const auto broken = broken_promise(stored, found);
  return broken ? broken->where : "";
}

TEST(SpaceChainTest, AFileIsProvedAgainAndEveryFalseFigureIsFound) {
  for (const SpaceSeries& series : {rail(), gable()}) {
    const auto made = fit_space_chain(series, {});
    ASSERT_TRUE(made);
    const auto nurbs = chain_nurbs(*made, std::nullopt);
    ASSERT_TRUE(nurbs) << to_line(nurbs.error());
    const auto sound = space_chain_from_json(space_chain_json(*made, *nurbs), "chain.json");
    ASSERT_TRUE(sound) << to_line(sound.error());
    ASSERT_EQ(false_chain(*sound), "");
    ASSERT_EQ(sound->corners.size(), 2U);
    const auto doctored = [&](auto change) {
      StoredSpaceChain one = *sound;
      change(one);
      return false_chain(one);
    };
    using Stored = StoredSpaceChain;
    EXPECT_EQ(doctored([](Stored& s) { s.corners[1].turn += 1e-6; }), "/corners/1/turn");
    EXPECT_EQ(doctored([](Stored& s) { s.corners[1].point += 1; }).substr(0, 6), "/parts");
    EXPECT_EQ(doctored([](Stored& s) { s.points[7].y += 1e-9; }).substr(0, 6), "/parts");
    EXPECT_EQ(doctored([](Stored& s) {
                s.parts[1].largest_move = 1.0;
                s.largest_move = 0.5;
              }),
              "/largest_move");
    EXPECT_EQ(doctored([](Stored& s) { s.parts[0].flatness = 1.0; }), "/parts/0/flatness");
    const auto gap = doctored([](Stored& s) {
      s.parts[0].frame.origin = s.parts[0].frame.origin + Vec3{0, 0, 1e-6};
    });
    EXPECT_NE(gap, "");
  }
}

}  // namespace
}  // namespace obvid
