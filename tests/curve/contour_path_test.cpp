// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/contour_path.h"
#include "../common/angles.h"
#include "obvid/geom/internal/angle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace obvid {
namespace {

constexpr double kAccuracies[] = {1e-2, 1e-4, 1e-6, 1e-9, 1e-12, kFinestLength};
/// What rounding adds to figures of size 1 that are computed in two ways.
constexpr double kRounding = 4e-15;

/// A Bezier curve by control points, its parameter made uneven: weights w^j times its own.
Piece bezier(const std::vector<Vec2>& points, double w = 1.0, std::vector<double> weights = {}) {
  RationalBezier out;
  out.degree = static_cast<int>(points.size()) - 1;
  double factor = 1.0;
  for (std::size_t j = 0; j < points.size(); ++j, factor *= w) {
    out.offset[j] = points[j];
    out.weight[j] = factor * (weights.empty() ? 1.0 : weights[j]);
  }
  return out;
}

/// A quarter of the circle of radius 2 to the left.
Piece quarter(double w) { return bezier({{0, 0}, {2, 0}, {2, 2}}, w, {1.0, std::sqrt(0.5), 1.0}); }

/// A line, then a rational quarter circle of radius 2 whose parameter runs unevenly, to the left.
std::vector<Piece> line_and_arc() { return {LinePiece{{-3, 0}, {0, 0}}, quarter(1.7)}; }

/// Arc length between two parameters by short chords, and what they leave by their own difference
/// with half as many (the error falls by 4).
double by_chords(const Piece& piece, double from, double to, int chords = 100000) {
  const auto sum = [&](int n) {
    double length = 0.0;
    Vec2 before = evaluate(piece, from).point;
    for (int k = 1; k <= n; ++k) {
      const Vec2 here = evaluate(piece, from + (to - from) * k / n).point;
      length += norm(here - before);
      before = here;
    }
    return length;
  };
  const double few = sum(chords / 2), many = sum(chords);
  return many + (many - few) / 3.0;
}

TEST(ContourPath, ReachesEachPlaceByItsArcLength) {
  const std::vector<Piece> pieces = line_and_arc();
  const ContourPath path(pieces);
  EXPECT_NEAR(path.length(), 3 + kPi, 1e-13);
  EXPECT_EQ(path.joint(1), 3.0);
  for (int k = 0; k <= 400; ++k) {
    const double angle = kPi / 2 * k / 400.0;
    const ContourPath::Place place = path.at(3 + 2 * angle);
    EXPECT_NEAR(place.point.x, 2 * std::sin(angle), 1e-12) << k;
    EXPECT_NEAR(place.point.y, 2 - 2 * std::cos(angle), 1e-12) << k;
    EXPECT_NEAR(turning(unit_at(angle), place.tangent), 0.0, 1e-12) << k;
    EXPECT_NEAR(place.kappa, 0.5, 1e-12) << k;
  }
}

TEST(ContourPath, TakesTheAskedSideOfAJoint) {
  const std::vector<Piece> pieces = line_and_arc();
  const ContourPath path(pieces);
  EXPECT_EQ(path.at(3.0, true).kappa, 0.0);
  EXPECT_NEAR(path.at(3.0, false).kappa, 0.5, 1e-14);
  EXPECT_EQ(path.parameter(3.0, true).piece, 0U);
  EXPECT_EQ(path.parameter(3.0, true).t, 1.0);
  EXPECT_EQ(path.parameter(3.0, false).piece, 1U);
  EXPECT_EQ(path.parameter(3.0, false).t, 0.0);
}

TEST(ContourPath, FindsTheNearestPlace) {
  const std::vector<Piece> pieces = line_and_arc();
  const ContourPath path(pieces);
  for (const double angle : {0.1, 0.7, 1.5}) {
    for (const double away :
         {-0.5, 0.0, 1.0}) {  // along the normal, towards the centre at most half
      const Vec2 p{(2 - away) * std::sin(angle), 2 - (2 - away) * std::cos(angle)};
      EXPECT_NEAR(path.nearest(p, 3.5, 0.0, path.length()), 3 + 2 * angle, 1e-12);
    }
  }
  EXPECT_NEAR(path.nearest({-1, 5}, 0.5, 0.0, 3.0), 2.0, 1e-12);
  EXPECT_EQ(path.nearest({-9, 1}, 0.5, 0.0, 3.0), 0.0);
}

/// Lengths up to each parameter, and back, at every accuracy.
void expect_lengths(const Piece& piece, const std::function<double(Vec2)>& length_to) {
  const double whole = length_to(evaluate(piece, 1.0).point);
  for (const double accuracy : kAccuracies) {
    const PieceLength table(piece, accuracy);
    const double allowed = (accuracy + kRounding) * whole;
    EXPECT_NEAR(table.length(), whole, allowed) << accuracy;
    for (int k = 0; k <= 1000; ++k) {
      const double t = k / 1000.0;
      const Jet jet = evaluate(piece, t);
      const double s = length_to(jet.point);
      EXPECT_NEAR(table.at(t), s, allowed) << accuracy << " " << t;
      EXPECT_NEAR((table.parameter(s) - t) * norm(jet.d1), 0.0, 3 * allowed)
          << accuracy << " " << t;
    }
    EXPECT_EQ(table.parameter(-1.0), 0.0);
    EXPECT_EQ(table.parameter(2 * whole), 1.0);
    EXPECT_EQ(table.at(0.0), 0.0);
  }
}

TEST(PieceLength, IsThatOfACircleAtEveryAccuracy) {
  for (const double w : {0.2, 1.0, 6.0}) {
    expect_lengths(quarter(w), [](Vec2 p) { return 2 * std::atan2(p.x, 2 - p.y); });
  }
}

TEST(PieceLength, IsThatOfAParabolaAtEveryAccuracy) {
  // y = x^2 on [-1, 3], from its left end
  const auto from_vertex = [](double x) {
    return x / 2 * std::sqrt(1 + 4 * x * x) + std::asinh(2 * x) / 4;
  };
  for (const double w : {1.0, 0.4}) {
    expect_lengths(bezier({{-1, 1}, {1, -3}, {3, 9}}, w),
                   [&](Vec2 p) { return from_vertex(p.x) - from_vertex(-1); });
  }
}

TEST(PieceLength, RunsEvenlyAlongClothoids) {
  ClothoidPiece clothoid{{1, 2}, {}, 0.3, -0.2, 0.9, 4.0};
  const std::vector<Piece> pieces = {clothoid};
  const ContourPath path(pieces);
  EXPECT_EQ(path.length(), 4.0);
  for (int k = 0; k < 100; ++k) {
    const double s = 4.0 * k / 100;
    const double theta = 0.3 - 0.2 * s + 1.1 * s * s / 8;
    const ContourPath::Place place = path.at(s);
    EXPECT_NEAR(turning(unit_at(theta), place.tangent), 0.0, 1e-14);
    EXPECT_NEAR(place.kappa, -0.2 + 1.1 * s / 4, 1e-14);
  }
}

TEST(PieceLength, AgreesWithShortChords) {
  const std::vector<Piece> pieces = {
      bezier({{0, 0}, {1, 2}, {3, 3}, {4, -1}}),
      bezier({{0, 0}, {1, 0}, {2, 1}, {2, 3}, {1, 4}, {-2, 4}, {-4, 1}, {-5, -3}}, 1.0,
             {1, 5, 0.3, 2, 2, 7, 0.5, 1}),
      bezier({{0, 0}, {2, 2}, {-1, 2}, {1.2, 0}}),     // with a loop
      bezier({{0, 0}, {1, 1}, {0.02, 1}, {1.02, 0}}),  // nearly a cusp
  };
  for (const Piece& piece : pieces) {
    const PieceLength table(piece, kFinestLength);
    for (const double t : {0.1, 0.37, 0.5, 0.93, 1.0}) {
      EXPECT_NEAR(table.at(t), by_chords(piece, 0.0, t), 1e-9 * table.length()) << t;
    }
    EXPECT_FALSE(table.cusp());
  }
}

TEST(PieceLength, SeesWayThatLiesBetweenItsNodes) {
  // a weight so small that the parameter stands still but at both ends: the two legs
  const Piece piece = bezier({{0, 0}, {3, 0}, {3, 4}}, 1.0, {1.0, 1e-7, 1.0});
  double expected = 0.0;
  // with t/(1 - t) = e^u the curve depends on e^u alone, and its chords are even enough
  Vec2 before{0, 0};
  constexpr int kChords = 400000;
  for (int k = 1; k < kChords; ++k) {
    const double x = std::exp(-40.0 + 80.0 * k / kChords), w = 1e-7;
    const double d = 1 + 2 * w * x + x * x;
    const Vec2 here{(6 * w * x + 3 * x * x) / d, 4 * x * x / d};
    expected += norm(here - before);
    before = here;
  }
  EXPECT_NEAR(PieceLength(piece, 1e-9).length(), expected, 1e-7);
}

TEST(PieceLength, LeadsBackMonotonicallyAcrossItsCells) {
  const Piece piece = bezier({{0, 0}, {1, 1}, {0.05, 1}, {1.05, 0}});  // slow in the middle
  for (const double accuracy : kAccuracies) {
    const PieceLength table(piece, accuracy);
    double before = 0.0;
    for (int k = 1; k <= 20000; ++k) {
      const double s = table.length() * k / 20000;
      const double t = table.parameter(s);
      EXPECT_GE(t, before) << accuracy << " " << k;
      EXPECT_NEAR(table.at(t), s, (accuracy + kRounding) * table.length()) << accuracy << " " << k;
      before = t;
    }
    EXPECT_NEAR(before, 1.0, 1e-14);
  }
}

TEST(ContourPath, KeepsTheAccuracyOfShortPiecesBesideLongOnes) {
  const double tiny = 1e-6;
  std::vector<Piece> pieces = {LinePiece{{-1, 0}, {0, 0}}};
  pieces.push_back(bezier({{0, 0}, {tiny, 0}, {tiny, tiny}}, 2.0, {1.0, std::sqrt(0.5), 1.0}));
  pieces.push_back(LinePiece{{tiny, tiny}, {tiny, 1 + tiny}});
  const ContourPath path(pieces);
  EXPECT_NEAR(path.length(), 2 + tiny * kPi / 2, 1e-15);
  for (int k = 0; k <= 100; ++k) {
    const double angle = kPi / 2 * k / 100;
    const ContourPath::Parameter here = path.parameter(1 + tiny * angle);
    if (here.piece != 1) continue;  // its ends
    const Vec2 p = evaluate(pieces[1], here.t).point;
    EXPECT_NEAR(std::atan2(p.x, tiny - p.y), angle, 1e-9) << k;  // 1 + s keeps 1e-16 of 1e-6
  }
}

TEST(ContourPath, FollowsScaleAndMotion) {
  const Piece piece = bezier({{0, 0}, {1, 0}, {2, 1}, {2, 3}}, 1.3);
  const PieceLength table(piece, kFinestLength);
  for (const double scale : {1e-9, 1.0, 1e7}) {
    const Vec2 along = scale * unit_at(0.7), across = left_normal(along);
    RationalBezier other = std::get<RationalBezier>(piece);
    for (Vec2& p : other.offset) p = p.x * along + p.y * across;
    other.origin = {3 * scale, -2 * scale};
    const PieceLength there(other, kFinestLength);
    EXPECT_NEAR(there.length() / (scale * table.length()), 1.0, 4e-15);
    for (int k = 0; k <= 50; ++k) {
      EXPECT_NEAR(there.parameter(there.length() * k / 50),
                  table.parameter(table.length() * k / 50), 1e-13);
    }
  }
}

TEST(ContourPath, RefusesCusps) {
  const Piece cusp = bezier({{0, 0}, {1, 1}, {0, 1}, {1, 0}});  // B'(1/2) = 0
  const auto halves = split(std::get<RationalBezier>(cusp), 0.1);
  for (const Piece& piece : {cusp, Piece{halves[1]}}) {
    const std::vector<Piece> pieces = {LinePiece{{-1, -1}, start_point(piece)}, piece};
    for (const double accuracy : kAccuracies) {
      const auto path = ContourPath::without_cusps(pieces, accuracy);
      ASSERT_FALSE(path) << accuracy;
      EXPECT_EQ(path.error().code, ErrorCode::kChordReversal);
      EXPECT_EQ(path.error().index, 1);
      const Vec2 at = evaluate(piece, path.error().value).point;
      EXPECT_NEAR(at.x, 0.5, 1e-6);
      EXPECT_NEAR(at.y, 0.75, 1e-6);
    }
    // its length is known all the same
    EXPECT_NEAR(ContourPath(pieces).length() - ContourPath(pieces).joint(1),
                by_chords(piece, 0.0, 1.0), 1e-8);
  }
  EXPECT_TRUE(ContourPath::without_cusps(line_and_arc()));
}

TEST(ContourPath, RefusesPiecesThatStandStillAtAnEnd) {
  const std::vector<Piece> pieces = {bezier({{0, 0}, {0, 0}, {1, 0}, {1, 1}})};
  const auto path = ContourPath::without_cusps(pieces);
  ASSERT_FALSE(path);
  EXPECT_NEAR(path.error().value, 0.0, 1e-6);
}

TEST(NearestAngle, MeansTheSameDirectionAndIsNear) {
  for (const double to : {-20.0, 0.0, 3.0, 100.0}) {
    for (const double theta : {-7.0, 0.1, 2.0, 6.0}) {
      const double angle = nearest_angle(theta, to);
      EXPECT_LE(std::abs(angle - to), kPi * (1 + 1e-15));
      EXPECT_NEAR(turning(unit_at(angle), unit_at(theta)), 0.0, 1e-13);
    }
  }
}

}  // namespace
}  // namespace obvid
