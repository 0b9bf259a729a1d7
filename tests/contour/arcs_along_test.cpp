// SPDX-License-Identifier: Apache-2.0
// Arcs and chords along contours whose curvature is known in closed form.
#include "obvid/contour/arcs/arcs_along.h"
#include "../common/angles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "clothoid_data.h"
#include "obvid/contour/arcs/polyline_along.h"

namespace obvid {
namespace {

/// Pieces in a row as a contour; corners at these joints.
Contour contour_of(std::vector<Piece> pieces, std::vector<std::size_t> corners = {}) {
  Contour c;
  for (const Piece& piece : pieces) {
    const Jet jet = evaluate(piece, 0.0);
    c.joints.push_back({{jet.point, heading(jet.d1), curvature(jet)}, std::nullopt});
  }
  const Jet jet = evaluate(pieces.back(), 1.0);
  c.joints.push_back({{jet.point, heading(jet.d1), curvature(jet)}, std::nullopt});
  for (const std::size_t i : corners) c.joints[i].leaving = c.joints[i].element;
  c.pieces = std::move(pieces);
  return c;
}

ClothoidPiece clothoid_from(Vec2 start, double theta, double kappa0, double kappa1, double length) {
  ClothoidPiece p = {start, {}, theta, kappa0, kappa1, length};
  p.end = start + test::end_by_quadrature(theta, kappa0, kappa1, length);
  return p;
}

/// Quarter of an ellipse as a rational quadratic: points (a cos, b sin), turned by `quarter`.
RationalBezier quarter_ellipse(double a, double b, int quarter) {
  const std::array<Vec2, 5> corner = {{{a, 0.0}, {0.0, b}, {-a, 0.0}, {0.0, -b}, {a, 0.0}}};
  const auto q = static_cast<std::size_t>(quarter);
  RationalBezier bezier;
  bezier.degree = 2;
  bezier.offset[0] = corner[q];
  bezier.offset[1] = corner[q] + corner[q + 1];
  bezier.offset[2] = corner[q + 1];
  bezier.weight[0] = bezier.weight[2] = 1.0;
  bezier.weight[1] = std::numbers::sqrt2 / 2.0;
  return bezier;
}

Contour ellipse(double a, double b) {
  std::vector<Piece> pieces;
  for (int q = 0; q < 4; ++q) pieces.emplace_back(quarter_ellipse(a, b, q));
  Contour c = contour_of(std::move(pieces));
  c.closed = true;
  c.joints.pop_back();
  return c;
}

std::vector<Vec2> dense(const std::vector<Piece>& pieces, int each) {
  std::vector<Vec2> out;
  for (const Piece& piece : pieces) {
    for (int k = 0; k <= each; ++k) {
      out.push_back(evaluate(piece, static_cast<double>(k) / each).point);
    }
  }
  return out;
}

/// Largest distance of points from a dense polyline, searched everywhere.
double farthest(const std::vector<Vec2>& points, const std::vector<Vec2>& line) {
  double most = 0.0;
  for (const Vec2 p : points) {
    double least = HUGE_VAL;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Vec2 along = line[i] - line[i - 1], v = p - line[i - 1];
      const double square = dot(along, along);
      const double t = square > 0.0 ? std::clamp(dot(v, along) / square, 0.0, 1.0) : 0.0;
      least = std::min(least, norm(v - t * along));
    }
    most = std::max(most, least);
  }
  return most;
}

double distance_both_ways(const std::vector<Piece>& a, const std::vector<Piece>& b) {
  const auto fine = [](const std::vector<Piece>& pieces) {
    return dense(pieces, 8000 / static_cast<int>(pieces.size()));
  };
  return std::max(farthest(dense(a, 200), fine(b)), farthest(dense(b, 30), fine(a)));
}

void expect_joined(const std::vector<Piece>& pieces, const std::vector<double>& corner_turns = {}) {
  std::size_t corners = 0;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    EXPECT_EQ(end_point(pieces[i - 1]), start_point(pieces[i])) << i;
    const double turn = turning(evaluate(pieces[i - 1], 1.0).d1, evaluate(pieces[i], 0.0).d1);
    if (std::abs(turn) < 1e-9) continue;
    ASSERT_LT(corners, corner_turns.size()) << i << ": " << turn;
    EXPECT_NEAR(turn, corner_turns[corners++], 1e-9);
  }
  EXPECT_EQ(corners, corner_turns.size());
}

double turn_of(const Piece& piece) {
  const auto* arc = std::get_if<ArcPiece>(&piece);
  return arc != nullptr ? std::abs(arc->kappa * arc->length) : 0.0;
}

TEST(ArcsAlong, DeviationIsTheLargestDistanceBothWaysToOnePercent) {
  const Contour c = contour_of({clothoid_from({1.0, 2.0}, 0.3, -0.4, 1.2, 6.0)});
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4}) {
    const auto arcs = arcs_along(c, tolerance);
    ASSERT_TRUE(arcs) << arcs.error().what;
    EXPECT_LE(arcs->deviation, tolerance);
    const double measured = distance_both_ways(c.pieces, arcs->pieces);
    EXPECT_NEAR(arcs->deviation, measured, 0.01 * measured + 1e-7);
    expect_joined(arcs->pieces);
  }
}

TEST(ArcsAlong, NumberOnAClothoidIsNearTheBestPossible) {
  // kappa' = 1 over length 2: best arcs have length cbrt(216/sqrt(3) tolerance)
  const Contour c = contour_of({clothoid_from({0.0, 0.0}, 0.0, 0.0, 2.0, 2.0)});
  for (const double tolerance : {1e-6, 1e-8, 1e-9}) {
    const double best = 2.0 / std::cbrt(216.0 / std::sqrt(3.0) * tolerance);
    const auto arcs = arcs_along(c, tolerance);
    ASSERT_TRUE(arcs);
    const auto number = static_cast<double>(arcs->pieces.size());
    EXPECT_LT(number, 1.12 * best + 4.0);
    // pairs with the clothoid's own headings have error L^3/40.5: 45 % more arcs
    EXPECT_GT(number, 0.98 * best);
  }
}

TEST(ArcsAlong, RadiiAreMonotoneOnASpiralAndTangentsItsOwnAtTheEnds) {
  const Contour c = contour_of({clothoid_from({0.0, 0.0}, 0.5, 0.1, 0.9, 3.0),
                                clothoid_from({0.0, 0.0}, 0.0, 0.0, 0.0, 1.0)});
  Contour one = contour_of({c.pieces[0]});
  const auto arcs = arcs_along(one, 1e-6);
  ASSERT_TRUE(arcs);
  double before = -HUGE_VAL;
  for (const Piece& piece : arcs->pieces) {
    const double kappa = std::get<ArcPiece>(piece).kappa;
    EXPECT_GE(kappa, before);
    before = kappa;
  }
  EXPECT_NEAR(std::get<ArcPiece>(arcs->pieces.front()).theta0, 0.5, 1e-12);
  EXPECT_NEAR(heading(evaluate(arcs->pieces.back(), 1.0).d1), 0.5 + 1.5, 1e-9);
}

TEST(ArcsAlong, ClosedCurveStaysClosedAndSmoothAtItsSeam) {
  const Contour c = ellipse(3.0, 1.0);
  for (const double tolerance : {3e-2, 1e-3, 1e-5}) {
    const auto arcs = arcs_along(c, tolerance);
    ASSERT_TRUE(arcs) << arcs.error().what;
    expect_joined(arcs->pieces);
    EXPECT_EQ(end_point(arcs->pieces.back()), start_point(arcs->pieces.front()));
    EXPECT_NEAR(
        turning(evaluate(arcs->pieces.back(), 1.0).d1, evaluate(arcs->pieces.front(), 0.0).d1), 0.0,
        1e-9);
    // both are taken as 8,000 chords of 1.7e-3, where the curvature is 3 at the most: 1.1e-6
    EXPECT_LE(distance_both_ways(c.pieces, arcs->pieces), 1.01 * tolerance + 1.1e-6);
    for (const Piece& piece : arcs->pieces) EXPECT_LT(turn_of(piece), kPi);
  }
}

TEST(ArcsAlong, CornersLinesAndArcsStay) {
  const LinePiece line = {{-3.0, 0.0}, {0.0, 0.0}};
  const ClothoidPiece in = clothoid_from({0.0, 0.0}, 0.0, 0.0, 1.0, 2.0);  // turns by 1
  const Jet end = evaluate(in, 1.0);
  ArcPiece arc = {end.point, {}, 1.0, 1.0, 4.0};  // more than half a turn
  arc.end = arc.start + Vec2{std::sin(5.0) - std::sin(1.0), std::cos(1.0) - std::cos(5.0)};
  const ClothoidPiece out = clothoid_from(arc.end, 5.0 + 1.2, -0.5, 0.3, 2.0);
  const Contour c = contour_of({line, in, arc, out}, {3});
  const auto arcs = arcs_along(c, 1e-4);
  ASSERT_TRUE(arcs);
  expect_joined(arcs->pieces, {1.2});
  EXPECT_TRUE(std::holds_alternative<LinePiece>(arcs->pieces.front()));
  EXPECT_EQ(std::get<LinePiece>(arcs->pieces.front()).end, line.end);
  EXPECT_EQ(std::count_if(arcs->pieces.begin(), arcs->pieces.end(),
                          [](const Piece& p) { return turn_of(p) == 4.0; }),
            1);
}

TEST(ArcsAlong, ClothoidsOfConstantCurvatureAreArcs) {
  const Contour c = contour_of({clothoid_from({0.0, 0.0}, 0.0, 0.5, 0.5, 3.0),
                                clothoid_from({0.0, 0.0}, 0.0, 0.0, 0.0, 3.0)});
  const auto arcs = arcs_along(c, 1e-6);
  ASSERT_TRUE(arcs);
  ASSERT_EQ(arcs->pieces.size(), 2U);
  EXPECT_EQ(std::get<ArcPiece>(arcs->pieces[0]).length, 3.0);
  EXPECT_TRUE(std::holds_alternative<LinePiece>(arcs->pieces[1]));
}

TEST(ArcsAlong, ToleranceAsLargeAsTheContourGivesOnePair) {
  const auto arcs = arcs_along(contour_of({clothoid_from({0.0, 0.0}, 0.0, 0.1, 0.9, 2.0)}), 10.0);
  ASSERT_TRUE(arcs);
  EXPECT_EQ(arcs->pieces.size(), 2U);
}

TEST(ArcsAlong, SizeDoesNotMatter) {
  std::vector<std::size_t> numbers;
  for (const double size : {1e-6, 1.0, 1e6}) {
    const auto arcs =
        arcs_along(contour_of({clothoid_from({0.0, 0.0}, 0.0, 0.1 / size, 0.9 / size, 2.0 * size)}),
                   1e-5 * size);
    ASSERT_TRUE(arcs);
    numbers.push_back(arcs->pieces.size());
  }
  EXPECT_EQ(numbers[0], numbers[1]);
  EXPECT_EQ(numbers[2], numbers[1]);
}

TEST(ArcsAlong, RefusesMoreThanAMillionArcsAtOnce) {
  const Contour c = contour_of({clothoid_from({0.0, 0.0}, 0.0, 0.0, 2.0, 2.0)});
  const auto arcs = arcs_along(c, 1e-22);
  ASSERT_FALSE(arcs);
  EXPECT_EQ(arcs.error().code, ErrorCode::kToleranceNotReached);
  EXPECT_EQ(arcs_along(c, -1.0).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(arcs_along(c, std::nan("")).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(arcs_along(Contour{}, 1.0).error().code, ErrorCode::kNothingThere);
}

TEST(PolylineAlong, TakesTheFewestChordsOfACircle) {
  // a chord with sagitta h turns by 2 acos(1 - h/r)
  ArcPiece arc = {{2.0, 0.0}, {-2.0, 0.0}, 0.5 * kPi, 0.5, 2.0 * kPi};
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    const auto line = polyline_along(contour_of({arc}), tolerance);
    ASSERT_TRUE(line);
    const double chords = kPi / (2.0 * std::acos(1.0 - tolerance / 2.0));
    EXPECT_GE(static_cast<double>(line->points.size() - 1), chords);
    EXPECT_LT(static_cast<double>(line->points.size() - 1), 1.02 * chords + 2.0);
    EXPECT_LE(line->deviation, tolerance);
    EXPECT_EQ(line->points.back(), (Vec2{-2.0, 0.0}));
    for (const Vec2 p : line->points) EXPECT_NEAR(norm(p), 2.0, 1e-12);
  }
}

TEST(PolylineAlong, StaysNearAnEllipseAndKeepsCornersAndLines) {
  const Contour c = ellipse(3.0, 1.0);
  const auto line = polyline_along(c, 1e-3);
  ASSERT_TRUE(line);
  EXPECT_LE(farthest(dense(c.pieces, 200), line->points), 1e-3);
  const Contour square = contour_of({LinePiece{{0, 0}, {1, 0}}, LinePiece{{1, 0}, {1, 1}}}, {1});
  const auto corner = polyline_along(square, 10.0);
  ASSERT_TRUE(corner);
  EXPECT_EQ(corner->points, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}}));
}

TEST(PolylineAlong, RefusesMoreThanTenMillionPoints) {
  const auto line =
      polyline_along(contour_of({clothoid_from({0.0, 0.0}, 0.0, 1.0, 2.0, 2.0)}), 1e-16);
  ASSERT_FALSE(line);
  EXPECT_EQ(line.error().code, ErrorCode::kToleranceNotReached);
  EXPECT_EQ(polyline_along(Contour{}, 1.0).error().code, ErrorCode::kNothingThere);
}

Contour whole_ellipse(double a, double b) {
  Contour out = contour_of({quarter_ellipse(a, b, 0), quarter_ellipse(a, b, 1),
                            quarter_ellipse(a, b, 2), quarter_ellipse(a, b, 3)});
  out.closed = true;
  out.joints.pop_back();
  for (std::size_t k = 0; k < 4; ++k) out.runs.push_back({k, k, k % 2 == 0 ? -1 : 1});
  return out;
}

/// Arcs that the change of curvature of an ellipse asks for: the integral of (r / (125 e))^(1/3),
/// docs/methods/gcode.md.
double best_count(double a, double b, double tolerance) {
  constexpr int kPlaces = 4000;
  double sum = 0.0;
  for (int k = 0; k < kPlaces; ++k) {
    const double t = 2.0 * std::numbers::pi * (k + 0.5) / kPlaces;
    const double g = std::pow(a * std::sin(t), 2) + std::pow(b * std::cos(t), 2);
    const double rate =
        std::abs(3.0 * a * b * (a * a - b * b) * std::sin(t) * std::cos(t)) / std::pow(g, 3);
    sum += std::cbrt(rate / (124.7 * tolerance)) * std::sqrt(g) * 2.0 * std::numbers::pi / kPlaces;
  }
  return sum;
}

TEST(ArcsAlong, OfSlimAndRoundEllipsesAreHardlyMoreThanTheBestEither) {
  for (const double b : {5.0, 18.0, 30.0, 47.5}) {
    for (const double tolerance : {1e-2, 1e-3}) {
      const Contour ellipse = whole_ellipse(50.0, b);
      const auto made = arcs_along(ellipse, tolerance);
      ASSERT_TRUE(made);
      EXPECT_LE(made->deviation, tolerance);
      expect_joined(made->pieces);
      EXPECT_LE(static_cast<double>(made->pieces.size()),
                1.12 * best_count(50.0, b, tolerance) + 4.0)
          << b << " " << tolerance;
    }
  }
}

TEST(ArcsAlong, OfTheSharpEndsOfASlimEllipseAreATenthMoreThanTheBestAtMost) {
  for (const double tolerance : {8e-3, 1e-3, 1e-4}) {
    const auto made = arcs_along(whole_ellipse(50.0, 5.0), tolerance);
    ASSERT_TRUE(made);
    EXPECT_LE(made->deviation, tolerance);
    expect_joined(made->pieces);
    EXPECT_LE(static_cast<double>(made->pieces.size()), 1.1 * best_count(50.0, 5.0, tolerance))
        << tolerance;
  }
}

TEST(ArcsAlong, OfStretchesOfHundredsOfPairsAreAsFewAsOfShortOnes) {
  for (const double tolerance : {1e-5, 1e-6}) {
    const auto made = arcs_along(whole_ellipse(50.0, 5.0), tolerance);
    ASSERT_TRUE(made);
    EXPECT_LE(made->deviation, tolerance);
    expect_joined(made->pieces);
    EXPECT_LE(static_cast<double>(made->pieces.size()), 1.05 * best_count(50.0, 5.0, tolerance))
        << tolerance;
  }
}

TEST(ArcsAlong, OfAWholeEllipseAreHardlyMoreThanTheBest) {
  const Contour ellipse = whole_ellipse(12.37, 7.42);
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const auto made = arcs_along(ellipse, tolerance);
    ASSERT_TRUE(made);
    EXPECT_LE(made->deviation, tolerance);
    // pairs, one joint of which lies where the contour begins
    EXPECT_LE(static_cast<double>(made->pieces.size()),
              1.08 * best_count(12.37, 7.42, tolerance) + 2.0)
        << tolerance;
  }
}

}  // namespace
}  // namespace obvid
