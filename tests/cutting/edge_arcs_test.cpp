// SPDX-License-Identifier: Apache-2.0
// Arcs in place of edges of curves that are known.
#include "edge_arcs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obvid::cutting {
namespace {

constexpr double kHalfCircle = std::numbers::pi;

ArcPath edges_through(const std::vector<Vec2>& vertices, bool closed = false) {
  ArcPath out;
  out.closed = closed;
  for (std::size_t k = 1; k < vertices.size(); ++k) {
    out.pieces.emplace_back(LinePiece{vertices[k - 1], vertices[k]});
  }
  return out;
}

/// Largest distance of places of one path from another, searched everywhere.
double farthest(const ArcPath& from, const ArcPath& to, int places) {
  double most = 0.0;
  for (const Piece& piece : from.pieces) {
    for (int k = 0; k <= places; ++k) {
      const Vec2 p = evaluate(piece, static_cast<double>(k) / places).point;
      double least = HUGE_VAL;
      for (const Piece& other : to.pieces) least = std::min(least, distance_from(other, p));
      most = std::max(most, least);
    }
  }
  return most;
}

TEST(EdgeArcs, OfACircleAreThreeWhateverItsEdges) {
  // less than half a turn each; the chords of 200 edges lie 1.2e-4 radii inside
  for (const int count : {60, 200, 1000}) {
    std::vector<Vec2> vertices;
    for (int k = 0; k <= count; ++k)
      vertices.push_back(10.0 * unit_at(2.0 * kHalfCircle * k / count));
    vertices.back() = vertices.front();
    const ArcPath edges = edges_through(vertices, true);
    const double sagitta = 10.0 * (1.0 - std::cos(kHalfCircle / count));
    const EdgeArcs made = arcs_over_edges(edges, 1.05 * sagitta);
    EXPECT_EQ(made.path.pieces.size(), 3U) << count;
    EXPECT_LE(made.deviation, 1.05 * sagitta);
    EXPECT_LE(farthest(made.path, edges, 200), 1.05 * sagitta + 1e-12);
    EXPECT_LE(farthest(edges, made.path, 10), 1.05 * sagitta + 1e-12);
    // half of the sagitta on both sides of the edges is the least that any arcs keep
    EXPECT_GT(arcs_over_edges(edges, 0.4 * sagitta).path.pieces.size(),
              static_cast<std::size_t>(count / 3));
  }
}

TEST(EdgeArcs, OfAnEllipseAreHardlyMoreThanItsCurvatureAsksFor) {
  // the integral of (rate of the curvature / (124.7 e))^(1/3), docs/methods/gcode.md: 15.7 for
  // half axes of 30 and 18 and e = 0.01; edges take a part of the tolerance, ends at vertices too
  std::vector<Vec2> vertices;
  constexpr int kCount = 2000;
  for (int k = 0; k <= kCount; ++k) {
    const double t = 2.0 * kHalfCircle * k / kCount;
    vertices.push_back({30.0 * std::cos(t), 18.0 * std::sin(t)});
  }
  vertices.back() = vertices.front();
  const ArcPath edges = edges_through(vertices, true);
  const EdgeArcs made = arcs_over_edges(edges, 0.01);
  EXPECT_LE(made.path.pieces.size(), 20U);
  EXPECT_GE(made.path.pieces.size(), 14U);
  EXPECT_LE(farthest(made.path, edges, 100), 0.01);
  EXPECT_LE(farthest(edges, made.path, 2), 0.01);
}

TEST(EdgeArcs, CornersAndEdgesThatAreAloneStayAndWhatIsStraightIsOneLine) {
  const ArcPath square = edges_through({{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}}, true);
  const EdgeArcs same = arcs_over_edges(square, 0.1);
  ASSERT_EQ(same.path.pieces.size(), 4U);
  EXPECT_EQ(same.deviation, 0.0);
  const EdgeArcs one = arcs_over_edges(edges_through({{0, 0}, {3, 0.001}, {5, 0}, {9, 0}}), 0.01);
  ASSERT_EQ(one.path.pieces.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<LinePiece>(one.path.pieces.front()));
  EXPECT_NEAR(one.deviation, 0.001, 1e-4);
}

}  // namespace
}  // namespace obvid::cutting
