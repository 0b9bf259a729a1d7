// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/internal/topology.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obvid {
namespace {

/// Corners at (u, v) = (0, 0), (1, 0), (0, 1), (1, 1).
NurbsSurface plate(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  return {1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, {a, b, c, d}, {}};
}
const NurbsSurface kSquare = plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0});
constexpr double kNear = 1e-6;

TEST(Topology, SidesAreTheSurfacesOwnBordersWithItsWeights) {
  NurbsSurface s{2, 1, {0, 0, 0, 1, 1, 1}, {0, 0, 1, 1}, {}, {}};
  for (int k = 0; k < 6; ++k) {
    s.points.push_back({1.0 * k, k * k / 7.0, std::sin(k)});
    s.weights.push_back(1.0 + 0.1 * k);
  }
  for (const PatchSide side : kPatchSides) {
    const SpaceCurve border = border_of(s, side);
    ASSERT_TRUE(check(border));
    for (const double t : {0.0, 0.3, 1.0}) {
      const double end = is_far_end(side) ? 1.0 : 0.0;
      const Vec3 there = runs_along_u(side) ? evaluate(s, t, end).point : evaluate(s, end, t).point;
      EXPECT_LT(norm(evaluate(border, t).point - there), 1e-14) << side;
    }
    EXPECT_EQ(opposite(opposite(side)), side);
    EXPECT_EQ(runs_along_u(opposite(side)), runs_along_u(side));
    EXPECT_NE(is_far_end(opposite(side)), is_far_end(side));
  }
}

TEST(Topology, NeighboursShareAnEdgeWhicheverWayTheyRun) {
  // beside x = 1: its side v = start runs along y, against it, or is v = end
  const NurbsSurface along = plate({1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0});
  for (const NurbsSurface& other : {along, reversed_u(along), transposed(along)}) {
    const Topology t = topology_of({&kSquare, &other}, kNear);
    EXPECT_EQ(t.vertices.size(), 6U);
    EXPECT_EQ(t.edges.size(), 7U);
    const TopologyEdge& edge = t.edges[t.edge_of[0][kUEnd]];
    ASSERT_EQ(edge.uses.size(), 2U);
    const EdgeUse& use = edge.uses[1];
    EXPECT_EQ(&use, &t.use(1, use.side));
    EXPECT_EQ(use.patch, 1U);
    EXPECT_FALSE(use.other_parameters);
    const SpaceCurve side = border_of(other, use.side);
    EXPECT_EQ(use.along, side.points.front() == edge.curve.points.front());
  }
}

TEST(Topology, ThreeSidesAtOneLineAreOneEdge) {
  const NurbsSurface b = plate({0, 0, 0}, {1, 0, 0}, {0, -1, 1}, {1, -1, 1});
  const NurbsSurface c = plate({0, 0, 0}, {1, 0, 0}, {0, -1, -1}, {1, -1, -1});
  const Topology t = topology_of({&kSquare, &b, &c}, kNear);
  EXPECT_EQ(t.edges[t.edge_of[0][kVStart]].uses.size(), 3U);
  EXPECT_EQ(t.edges.size(), 10U);
}

TEST(Topology, ASideThatMeetsPartOfAnotherHasAnEdgeOfItsOwn) {
  const NurbsSurface half = plate({1, 0, 0}, {2, 0, 0}, {1, 0.5, 0}, {2, 0.5, 0});
  const Topology t = topology_of({&kSquare, &half}, kNear);
  EXPECT_EQ(t.edges.size(), 8U);
  EXPECT_EQ(t.vertices.size(), 7U);
}

TEST(Topology, CurvesThatMeetOnlyAtTheirEndsAreTwoEdges) {
  NurbsSurface bulge = with_degrees(plate({1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}), 2, 1);
  bulge.points[1].x += 1e-3;
  EXPECT_EQ(topology_of({&kSquare, &bulge}, kNear).edges.size(), 8U);
  EXPECT_EQ(topology_of({&kSquare, &bulge}, 1e-2).edges.size(), 7U);
}

TEST(Topology, AWayThereAndBackIsNotTheStraightWay) {
  // along y to 0.8, back to 0.2 and on to 1: on the same line, but not in order
  NurbsSurface back = with_degrees(plate({1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}), 3, 1);
  back.points[1].y = 3.0;
  back.points[2].y = -2.0;
  const Topology t = topology_of({&kSquare, &back}, kNear);
  EXPECT_EQ(t.edges.size(), 8U);
}

TEST(Topology, OneCurveAtAnotherPaceIsOneEdgeAndSaysSo) {
  // y = t^2 along the same line, and its mirror image y = 1 - t^2
  NurbsSurface slow = with_degrees(plate({1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}), 2, 1);
  slow.points[1].y = slow.points[4].y = 0.0;
  for (const bool along : {true, false}) {
    const NurbsSurface other = along ? slow : reversed_u(slow);
    const Topology t = topology_of({&kSquare, &other}, kNear);
    const TopologyEdge& edge = t.edges[t.edge_of[0][kUEnd]];
    ASSERT_EQ(edge.uses.size(), 2U);
    EXPECT_TRUE(edge.uses[1].other_parameters);
    EXPECT_EQ(edge.uses[1].along, along);
    EXPECT_LE(edge.uses[1].gap, 1e-12);
  }
}

TEST(Topology, GapsOfCornersAndBordersAreTold) {
  NurbsSurface off = plate({1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0});
  for (Vec3& p : off.points) p.z = 3e-7;
  const Topology t = topology_of({&kSquare, &off}, kNear);
  const TopologyEdge& edge = t.edges[t.edge_of[1][kVStart]];
  ASSERT_EQ(edge.uses.size(), 2U);
  EXPECT_EQ(edge.uses[0].gap, 0.0);
  EXPECT_NEAR(edge.uses[1].gap, 3e-7, 1e-15);
  EXPECT_NEAR(t.vertices[edge.from].gap, 3e-7, 1e-15);
  EXPECT_EQ(topology_of({&kSquare, &off}, 0.0).edges.size(), 8U);
  EXPECT_EQ(topology_of({&kSquare, &off}, 2e-7).edges.size(), 8U);
}

TEST(Topology, SeamsPolesAndClosedBorders) {
  // half a circle turned once: a sphere, seam along the meridian, two points
  const SpaceCurve meridian = arc_about({0, 0, -2}, {0, 0, 0}, {0, -1, 0}, std::acos(-1.0));
  const auto sphere =
      to_nurbs(RevolutionSurface{meridian, {0, 0, 0}, {0, 0, 1}, 2.0 * std::acos(-1.0)}, kNear);
  ASSERT_TRUE(sphere);
  const Topology t = topology_of({{"sphere"}, {}, {{"ball", sphere->surface}}});
  ASSERT_EQ(t.edges.size(), 3U);
  EXPECT_EQ(t.vertices.size(), 2U);
  std::size_t points = 0;
  for (const TopologyEdge& edge : t.edges) {
    points += edge.point ? 1 : 0;
    EXPECT_EQ(edge.uses.size(), edge.point ? 1U : 2U);
    EXPECT_EQ(edge.from == edge.to, edge.point);
  }
  EXPECT_EQ(points, 2U);
  // a tube: both circles begin and end in one vertex each
  const auto tube = to_nurbs(
      RevolutionSurface{
          line_between({1, 0, 0}, {1, 0, 3}), {0, 0, 0}, {0, 0, 1}, 2.0 * std::acos(-1.0)},
      kNear);
  const Topology round = topology_of({&tube->surface}, kNear);
  EXPECT_EQ(round.vertices.size(), 2U);
  EXPECT_EQ(round.edges.size(), 3U);
}

TEST(Topology, NothingDependsOnSizeAndPlace) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    for (const double away : {0.0, 1e5}) {
      SurfaceModel model{"two", {}, {}};
      model.patches = {{"a", kSquare}, {"b", plate({1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0})}};
      for (SurfacePatch& patch : model.patches) {
        for (Vec3& p : patch.surface.points) p = scale * (p + Vec3{away, -away, away});
      }
      EXPECT_EQ(topology_of(model).edges.size(), 7U) << scale << ' ' << away;
    }
  }
}

TEST(Topology, TheNearestPointOfACurveIsTheFootOfThePerpendicular) {
  const SpaceCurve arc = arc_about({2, 0, 0}, {0, 0, 0}, {0, 0, 1}, 2.0);
  for (const double angle : {0.0, 0.1, 0.77, 1.9, 2.0}) {
    const Vec3 direction{std::cos(angle), std::sin(angle), 0};
    const Vec3 found = evaluate(arc, nearest_parameter(arc, 1.5 * direction)).point;
    EXPECT_LT(norm(found - 2.0 * direction), 1e-7) << angle;
  }
  EXPECT_EQ(nearest_parameter(arc, {5, -4, 0}), 0.0);
}

}  // namespace
}  // namespace obvid
