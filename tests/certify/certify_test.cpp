// SPDX-License-Identifier: Apache-2.0
#include "obvid/certify/certify.h"
#include "../common/angles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "contours.h"
#include "end_data.h"
#include "spiral_table.h"

namespace obvid {
namespace {

using testing_data::arc_from;
using testing_data::closed_contour;
using testing_data::contour_of;
using testing_data::expect_refused;
using testing_data::joint;
using testing_data::kSpirals;
using testing_data::quarter_ellipse;
using testing_data::spiral;
using testing_data::SpiralRow;

/// One spiral of the table in three pieces, shifted so that nothing is centred.
Contour three_pieces(const SpiralRow& row) {
  RationalBezier whole = spiral(row);
  for (Vec2& q : whole.offset) q = q + Vec2{3.0, -2.0};
  const auto [a, rest] = split(whole, 0.4);
  const auto [b, c] = split(rest, 0.5);
  return contour_of({a, b, c}, {{0, 2, 1}});
}

/// y = x^2 from -1 to 1 in two exact pieces: the vertex is their joint.
Contour parabola_over_its_vertex() {
  return contour_of({RationalBezier{{}, 2, {Vec2{-1, 1}, {-0.5, 0}, {0, 0}}, {1, 1, 1}},
                     RationalBezier{{}, 2, {Vec2{0, 0}, {0.5, 0}, {1, 1}}, {1, 1, 1}}},
                    {{0, 0, 1}, {1, 1, -1}});
}

/// Arcs that continue each other's tangent, with the given curvatures and a length of 1.
Contour arcs_of(const std::vector<double>& kappas, int direction) {
  Contour contour;
  contour.carrier = Carrier::kArcs;
  Vec2 at{1.0, 2.0};
  double theta = 0.3;
  for (const double kappa : kappas) {
    const ArcPiece arc = arc_from(at, theta, kappa, 1.0);
    contour.joints.push_back(joint(at, theta, kappa, contour.points.size()));
    contour.points.push_back(at);
    contour.pieces.emplace_back(arc);
    at = arc.end;
    theta += kappa;
  }
  contour.joints.push_back(joint(at, theta, kappas.back(), contour.points.size()));
  contour.points.push_back(at);
  contour.runs.push_back({0, kappas.size() - 1, direction});
  return contour;
}

TEST(Certify, SpiralsInThreePiecesAreProved) {
  int count = 0;
  for (const SpiralRow& row : kSpirals) {
    const Certificate certificate = certify(three_pieces(row));
    EXPECT_TRUE(certificate.proved) << count << ": " << certificate.reason;
    EXPECT_TRUE(certificate.reason.empty());
    EXPECT_TRUE(certificate.inside_region);
    EXPECT_TRUE(certificate.through_points);
    EXPECT_EQ(certificate.vertices, 0);
    EXPECT_EQ(certificate.inflections, row.kappa0 < 0.0 && row.kappa1 > 0.0 ? 1 : 0) << count;
    EXPECT_EQ(certificate.self_intersections, 0);
    EXPECT_LT(certificate.gaps.position, 1e-15);
    EXPECT_LT(certificate.gaps.heading, 1e-13);
    ++count;
  }
  EXPECT_GE(count, 9);
}

TEST(Certify, ParabolaOverItsVertexHasExactlyOneVertexAtTheJoint) {
  const Certificate certificate = certify(parabola_over_its_vertex());
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_EQ(certificate.vertices, 1);
  EXPECT_EQ(certificate.inflections, 0);
  EXPECT_LT(certificate.gaps.curvature, 1e-14);  // a bound: 0 and what its evaluation may hide
}

TEST(Certify, VerticesComeFromTheProofsNotFromTheRuns) {
  Contour contour = parabola_over_its_vertex();
  contour.runs = {{0, 1, 1}};
  EXPECT_EQ(certify(contour).vertices, 1);
  expect_refused(contour, "one run claimed over a vertex");
  contour.runs = {{0, 0, -1}, {1, 1, 1}};
  expect_refused(contour, "directions swapped");
  contour.runs = {{0, 0, 1}};
  expect_refused(contour, "a piece without a run");
  contour.runs = {{0, 0, 1}, {1, 2, -1}};
  expect_refused(contour, "a run beyond the pieces");
  contour.runs = {{1, 1, -1}, {0, 0, 1}};
  expect_refused(contour, "runs out of order");
  contour.runs = {};
  expect_refused(contour, "no runs");
}

TEST(Certify, EllipseOfFourQuartersIsClosedWithFourVertices) {
  const Contour ellipse = closed_contour(
      {quarter_ellipse({3, 0}, {3, 1}, {0, 1}), quarter_ellipse({0, 1}, {-3, 1}, {-3, 0}),
       quarter_ellipse({-3, 0}, {-3, -1}, {0, -1}), quarter_ellipse({0, -1}, {3, -1}, {3, 0})},
      {{0, 0, -1}, {1, 1, 1}, {2, 2, -1}, {3, 3, 1}});
  const Certificate certificate = certify(ellipse);
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_EQ(certificate.vertices, 4);
  EXPECT_EQ(certificate.inflections, 0);
  EXPECT_EQ(certificate.self_intersections, 0);
}

TEST(Certify, EveryControlPointMovedByAMillionthIsNoticed) {
  int refused = 0;
  for (const SpiralRow& row : kSpirals) {
    const Contour good = three_pieces(row);
    for (std::size_t i = 0; i < good.pieces.size(); ++i) {
      for (std::size_t j = 0; j <= 4; ++j) {
        for (const Vec2 way : {Vec2{1, 0}, {0, 1}, {0.6, -0.8}}) {
          Contour doctored = good;
          Vec2& point = std::get<RationalBezier>(doctored.pieces[i]).offset[j];
          point = point + 2e-6 * way;  // the spiral's chord is 2
          expect_refused(doctored, "control point " + std::to_string(j));
          ++refused;
        }
      }
    }
  }
  EXPECT_GT(refused, 300);
}

TEST(Certify, EveryWeightChangedByThreeMillionthsIsNoticed) {
  for (const SpiralRow& row : kSpirals) {
    const Contour good = three_pieces(row);
    for (std::size_t i = 0; i < good.pieces.size(); ++i) {
      for (std::size_t j = 0; j <= 4; ++j) {
        Contour doctored = good;
        std::get<RationalBezier>(doctored.pieces[i]).weight[j] *= 1.0 + 3e-6;
        expect_refused(doctored, "weight " + std::to_string(j));
      }
    }
  }
}

TEST(Certify, HiddenVertexIsRefusedAndNamed) {
  const Contour contour =
      contour_of({spiral(kSpirals[1]), spiral(testing_data::kHiddenVertex)}, {{0, 1, 1}});
  const Certificate certificate = certify(contour);
  EXPECT_FALSE(certificate.proved);
  EXPECT_FALSE(certificate.inside_region);
  EXPECT_GE(certificate.vertices, 2);
  EXPECT_NE(certificate.reason.find("piece 2 has a vertex"), std::string::npos)
      << certificate.reason;
}

TEST(Certify, ElementsThatDisagreeWithTheirPiecesAreRefused) {
  const Contour good = three_pieces(kSpirals[1]);
  const auto doctored = [&](const std::function<void(Contour&)>& change, const char* why) {
    Contour contour = good;
    change(contour);
    expect_refused(contour, why);
  };
  for (std::size_t j = 0; j < good.joints.size(); ++j) {
    doctored([j](Contour& c) { c.joints[j].element.theta += 1e-7; }, "heading");
    doctored([j](Contour& c) { c.joints[j].element.kappa *= 1 + 1e-7; }, "curvature");
    doctored([j](Contour& c) { c.joints[j].element.point.x += 1e-7; }, "point");
    doctored([j](Contour& c) { c.joints[j].element.kappa = NAN; }, "NaN curvature");
    doctored([j](Contour& c) { c.joints[j].element.theta = NAN; }, "NaN heading");
    doctored([j](Contour& c) { c.points[j].y = std::nextafter(c.points[j].y, 9.0); }, "an ulp");
    doctored([j](Contour& c) { c.joints[j].source.reset(); }, "a point left out");
  }
  doctored([](Contour& c) { std::swap(c.joints[1].source, c.joints[2].source); }, "order");
  doctored([](Contour& c) { c.joints.pop_back(); }, "a joint missing");
  doctored([](Contour& c) { c.joints.push_back(c.joints.back()); }, "a joint too many");
  doctored([](Contour& c) { c.points.push_back({9, 9}); }, "a point not met");
  doctored([](Contour& c) { c.pieces.clear(); }, "no pieces");
  doctored([](Contour& c) { c.closed = true; }, "not closed");
}

TEST(Certify, HeadingsMayBeUnwrapped) {
  Contour contour = three_pieces(kSpirals[1]);
  for (Joint& j : contour.joints) j.element.theta += 8.0 * kPi;
  EXPECT_TRUE(certify(contour).proved);
}

TEST(Certify, CurvatureJumpBetweenMonotonePiecesIsRefused) {
  // Same tangent line at the joint, curvature 2 before and 1 after.
  const RationalBezier rise{{}, 2, {Vec2{-1, 1}, {-0.5, 0}, {0, 0}}, {1, 1, 1}};
  const RationalBezier fall{{}, 2, {Vec2{0, 0}, {1, 0}, {2, 2}}, {1, 1, 1}};
  Contour contour = contour_of({rise, fall}, {{0, 0, 1}, {1, 1, -1}});
  const Certificate certificate = certify(contour);
  EXPECT_FALSE(certificate.proved);
  EXPECT_NEAR(certificate.gaps.curvature, 0.5, 1e-12);
  EXPECT_EQ(certificate.gaps.position, 0.0);
  EXPECT_TRUE(certificate.through_points) << "its points are met all the same";
}

TEST(Certify, AGapIsTheReasonOfACarrierThatPromisesNoMonotoneCurvature) {
  // the first piece is a parabola over its vertex, between the two the curvature steps
  const RationalBezier over{{}, 2, {Vec2{-1, 1}, {0, -1}, {1, 1}}, {1, 1, 1}};
  const RationalBezier beyond{{}, 2, {Vec2{1, 1}, {2, 3}, {4, 8}}, {1, 1, 1}};
  Contour contour = contour_of({over, beyond}, {{0, 0, 0}, {1, 1, -1}});
  contour.carrier = Carrier::kBaseline;
  const Certificate stepping = certify(contour);
  EXPECT_EQ(stepping.reason.find("the curvature gap at joint 2"), 0U) << stepping.reason;
  EXPECT_FALSE(keeps_promise(contour.carrier, stepping));
  contour = contour_of({over}, {{0, 0, 0}});
  contour.carrier = Carrier::kBaseline;
  const Certificate alone = certify(contour);
  EXPECT_EQ(alone.reason.find("piece 1 has a vertex"), 0U) << alone.reason;
  EXPECT_TRUE(keeps_promise(contour.carrier, alone));
}

TEST(Certify, ChainOfArcsWithGrowingCurvatureIsProvedWithItsGapReported) {
  const Certificate certificate = certify(arcs_of({0.1, 0.2, 0.4, 0.8}, 1));
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_NEAR(certificate.gaps.curvature, 0.5, 1e-12);
  EXPECT_LT(certificate.gaps.heading, 1e-14);
  EXPECT_EQ(certificate.vertices, 0);
}

TEST(Certify, ChainOfArcsAgainstItsDirectionIsRefused) {
  expect_refused(arcs_of({0.1, 0.2, 0.4, 0.8}, -1), "direction");
  const Certificate certificate = certify(arcs_of({0.1, 0.4, 0.2, 0.8}, 1));
  EXPECT_FALSE(certificate.proved);
  EXPECT_EQ(certificate.vertices, 2);
}

TEST(Certify, ArcsThroughZeroCurvatureInflectOnce) {
  const Certificate certificate = certify(arcs_of({-0.5, -0.1, 0.2, 0.6}, 1));
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_EQ(certificate.inflections, 1);
}

TEST(Certify, ArcWhoseStoredEndIsElsewhereIsRefused) {
  Contour contour = arcs_of({0.1, 0.2, 0.4}, 1);
  auto& arc = std::get<ArcPiece>(contour.pieces[1]);
  const double length = arc.length;
  arc.length = length * (1 + 1e-9);
  expect_refused(contour, "length");
  arc.length = length;
  EXPECT_TRUE(certify(contour).proved);
  arc.end.x += 1e-8;
  expect_refused(contour, "end");
}

TEST(Certify, ArcOfMoreThanHalfATurnIsRefused) { expect_refused(arcs_of({3.2}, 0), "winding"); }

TEST(Certify, SmallContourFarAwayIsProvedByItsOwnOffsets) {
  const Vec2 far{1e6, -2e6};
  RationalBezier whole = spiral(kSpirals[1]);
  for (Vec2& q : whole.offset) q = 0x1p-10 * q;
  const auto [a, b] = split(whole, 0.5);
  Contour contour = contour_of({a, b}, {{0, 1, 1}});
  // Each piece keeps its start as origin; the shared joint is rounded to a double first.
  for (Piece& piece : contour.pieces) {
    auto& bezier = std::get<RationalBezier>(piece);
    const Vec2 start = bezier.offset[0];
    for (Vec2& q : bezier.offset) q = q - start;
    bezier.origin = far + start;
  }
  for (std::size_t j = 0; j < contour.joints.size(); ++j) {
    contour.points[j] = contour.joints[j].element.point = far + contour.joints[j].element.point;
  }
  const Certificate certificate = certify(contour);
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_LT(certificate.gaps.curvature, 1e-12);
}

TEST(Certify, SizeDoesNotMatter) {
  for (const double size : {0x1p-200, 0x1p200}) {
    Contour contour = three_pieces(kSpirals[0]);
    for (Piece& piece : contour.pieces) {
      for (Vec2& q : std::get<RationalBezier>(piece).offset) q = size * q;
    }
    for (std::size_t j = 0; j < contour.joints.size(); ++j) {
      Element& element = contour.joints[j].element;
      element.point = contour.points[j] = size * element.point;
      element.kappa /= size;
    }
    const Certificate certificate = certify(contour);
    EXPECT_TRUE(certificate.proved) << certificate.reason;
    EXPECT_EQ(certificate.gaps.curvature, certify(three_pieces(kSpirals[0])).gaps.curvature);
  }
}

TEST(Certify, StraightContourIsProved) {
  const Certificate certificate =
      certify(contour_of({LinePiece{{0, 0}, {1, 2}}, LinePiece{{1, 2}, {2, 4}}}, {{0, 1, 0}}));
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_EQ(certificate.inflections, 0);
  EXPECT_EQ(certificate.gaps.curvature, 0.0);
}

TEST(EndData, MatchesTheJetsOfBothEnds) {
  for (const SpiralRow& row : kSpirals) {
    const RationalBezier piece = spiral(row);
    const EndData start = ends_of(piece).start;
    const EndData end = ends_of(piece).end;
    EXPECT_NEAR(heading(start.direction), row.theta0, 1e-14);
    EXPECT_NEAR(heading(end.direction), row.theta1, 1e-14);
    EXPECT_NEAR(start.kappa, row.kappa0, 1e-13);
    EXPECT_NEAR(end.kappa, row.kappa1, 1e-13);
  }
}

TEST(EndData, RoundingBoundCoversWhatHalfAnUlpMoves) {
  std::mt19937_64 rng(3);
  std::uniform_int_distribution<int> step(-1, 1);
  const auto nudged = [&](double x) {
    const int k = step(rng);
    return k == 0 ? x : std::nextafter(x, k * std::numeric_limits<double>::infinity());
  };
  double largest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    RationalBezier piece = spiral(kSpirals[static_cast<std::size_t>(i) % std::size(kSpirals)]);
    const double offset = std::ldexp(1.0, i % 24);
    for (Vec2& q : piece.offset) q = q + Vec2{offset, -0.7 * offset};
    RationalBezier moved = piece;
    for (std::size_t j = 0; j <= 4; ++j) {
      moved.offset[j] = {nudged(piece.offset[j].x), nudged(piece.offset[j].y)};
      moved.weight[j] = nudged(piece.weight[j]);
    }
    const EndData a = ends_of(piece).start, b = ends_of(moved).start;
    const EndData c = ends_of(piece).end, d = ends_of(moved).end;
    EXPECT_LE(std::abs(turning(a.direction, b.direction)), a.heading_rounding);
    EXPECT_LE(std::abs(a.kappa - b.kappa), a.kappa_rounding);
    EXPECT_LE(std::abs(c.kappa - d.kappa), c.kappa_rounding);
    largest = std::max(largest, std::abs(a.kappa - b.kappa) / a.kappa_rounding);
  }
  EXPECT_GT(largest, 0.02) << "the bound must not be absurdly wide";
}

}  // namespace
}  // namespace obvid
