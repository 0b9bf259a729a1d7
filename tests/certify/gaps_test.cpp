// SPDX-License-Identifier: Apache-2.0
// Gaps at joints against the same gaps in 50 digits: never too small, hardly too large.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <random>

#include "contours.h"
#include "spiral_table.h"

namespace obvid {
namespace {

using testing_data::arc_from;
using testing_data::contour_of;
using Real = boost::multiprecision::cpp_bin_float_50;

struct Exact {
  Real x, y;    // the end
  Real dx, dy;  // its direction
  Real kappa;
};

Real length(const Real& x, const Real& y) { return sqrt(x * x + y * y); }

Exact bezier_end(const RationalBezier& b, bool start) {
  const auto n = static_cast<std::size_t>(b.degree);
  const auto at = [&](std::size_t j) { return start ? j : n - j; };
  const auto x = [&](std::size_t j) { return Real(b.offset[at(j)].x) - b.offset[at(0)].x; };
  const auto y = [&](std::size_t j) { return Real(b.offset[at(j)].y) - b.offset[at(0)].y; };
  const Real w0 = b.weight[at(0)], w1 = b.weight[at(1)], w2 = b.weight[at(2)];
  const Real size = length(x(1), y(1)), side = start ? 1 : -1;
  const Real area = x(1) * y(2) - y(1) * x(2);
  return {
      Real(b.origin.x) + b.offset[at(0)].x, Real(b.origin.y) + b.offset[at(0)].y, side * x(1),
      side * y(1),
      side * (Real(b.degree) - 1) / b.degree * w0 * w2 / (w1 * w1) * area / (size * size * size)};
}

/// Where curvature k0 to k1 leads over a length, from (0, 0) and the given heading.
Exact along(const Real& theta0, const Real& k0, const Real& k1, const Real& length) {
  constexpr int kPanels = 12;
  const Real sharpness = (k1 - k0) / length, step = length / kPanels;
  const auto theta = [&](const Real& s) { return theta0 + s * (k0 + sharpness * s / 2); };
  Exact end{0, 0, cos(theta(length)), sin(theta(length)), k1};
  using Rule = boost::math::quadrature::gauss<Real, 20>;
  for (int k = 0; k < kPanels; ++k) {
    const Real a = k * step, b = a + step;
    end.x += Rule::integrate([&](const Real& s) { return Real(cos(theta(s))); }, a, b);
    end.y += Rule::integrate([&](const Real& s) { return Real(sin(theta(s))); }, a, b);
  }
  return end;
}

Exact moved(Exact end, Vec2 by) {
  end.x += by.x;
  end.y += by.y;
  return end;
}

Exact start_of(const Piece& piece) {
  if (const auto* b = std::get_if<RationalBezier>(&piece)) return bezier_end(*b, true);
  if (const auto* a = std::get_if<ArcPiece>(&piece)) {
    return {a->start.x, a->start.y, cos(Real(a->theta0)), sin(Real(a->theta0)), a->kappa};
  }
  if (const auto* c = std::get_if<ClothoidPiece>(&piece)) {
    return {c->start.x, c->start.y, cos(Real(c->theta0)), sin(Real(c->theta0)), c->kappa0};
  }
  const auto& l = std::get<LinePiece>(piece);
  return {l.start.x, l.start.y, Real(l.end.x) - l.start.x, Real(l.end.y) - l.start.y, 0};
}

Exact end_of(const Piece& piece) {
  if (const auto* b = std::get_if<RationalBezier>(&piece)) return bezier_end(*b, false);
  if (const auto* a = std::get_if<ArcPiece>(&piece)) {
    return moved(along(a->theta0, a->kappa, a->kappa, a->length), a->start);
  }
  if (const auto* c = std::get_if<ClothoidPiece>(&piece)) {
    return moved(along(c->theta0, c->kappa0, c->kappa1, c->length), c->start);
  }
  const auto& l = std::get<LinePiece>(piece);
  return {l.end.x, l.end.y, Real(l.end.x) - l.start.x, Real(l.end.y) - l.start.y, 0};
}

Real distance(const Exact& a, const Exact& b) { return length(a.x - b.x, a.y - b.y); }

Exact at(Vec2 p) { return {p.x, p.y, 1, 0, 0}; }

/// Diagonal of the box around ends and middles: the size that gaps are told of.
Real size_of(const Contour& contour) {
  Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (const Piece& piece : contour.pieces) {
    for (const Vec2 p : {start_point(piece), end_point(piece), evaluate(piece, 0.5).point}) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  return length(Real(high.x) - low.x, Real(high.y) - low.y);
}

struct Gaps {
  Real position = 0, heading = 0, curvature = 0;
};

Gaps true_gaps(const Contour& contour) {
  Gaps gaps;
  const auto apart = [&](const Exact& a, const Exact& b) {
    gaps.position = std::max(gaps.position, Real(distance(a, b) / size_of(contour)));
  };
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    apart(start_of(contour.pieces[i]), at(contour.joints[i].element.point));
    apart(end_of(contour.pieces[i]), at(contour.joints[i + 1].element.point));
    apart(end_of(contour.pieces[i]), at(end_point(contour.pieces[i])));
    if (i == 0) continue;
    const Exact left0 = start_of(contour.pieces[i - 1]), left = end_of(contour.pieces[i - 1]);
    const Exact right = start_of(contour.pieces[i]), right1 = end_of(contour.pieces[i]);
    apart(left, right);
    const Real turn = abs(atan2(Real(left.dx * right.dy - left.dy * right.dx),
                                Real(left.dx * right.dx + left.dy * right.dy)));
    gaps.heading = std::max(gaps.heading, turn);
    const Real there = std::max(Real(abs(left.kappa)), Real(abs(right.kappa)));
    const Real beside = std::max({there, Real(abs(left0.kappa)), Real(abs(right1.kappa))});
    const Real scale = std::max(there, Real(beside * Real(1e-6)));
    const Real jump = abs(left.kappa - right.kappa);
    gaps.curvature = std::max(gaps.curvature, jump == 0 ? Real(0) : Real(jump / scale));
  }
  return gaps;
}

/// Pieces of all kinds that continue each other nearly.
class Pieces {
 public:
  explicit Pieces(unsigned seed) : random_(seed) {}

  Contour contour() {
    Contour out;
    const Vec2 far = power(6.0) * unit_at(angle());
    Element at{far, angle(), 0.0};
    std::vector<Piece> pieces;
    const double size = power(3.0);
    for (int k = 0; k < 3; ++k) {
      pieces.push_back(piece(at, size));
      const Jet end = evaluate(pieces.back(), 1.0);
      const double off = power_down();
      at = {end.point + (off * size) * unit_at(angle()), heading(end.d1) + off * angle(), 0.0};
    }
    out = contour_of(pieces, {{0, pieces.size() - 1, 1}});
    out.carrier = Carrier::kSpiral;
    return out;
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double angle() { return uniform(-3.0, 3.0); }
  double power(double decades) { return std::pow(10.0, uniform(-decades, decades)); }
  double power_down() { return std::pow(10.0, uniform(-17.0, -3.0)); }

  Piece piece(const Element& at, double size) {
    const double length = size * uniform(0.5, 2.0);
    const double turn = uniform(-2.0, 2.0) * (uniform(0, 1) < 0.3 ? 1e-6 : 1.0);
    switch (random_() % 5) {
      case 0:
        return LinePiece{at.point, at.point + length * unit_at(at.theta)};
      case 1:
        return arc_from(at.point, at.theta, turn / length, length);
      case 2: {
        ClothoidPiece one{at.point, {}, at.theta, turn / length, uniform(-2.0, 2.0) / length,
                          length};
        one.end = one.start + clothoid_chord(one);
        return one;
      }
      default:
        return bezier(at, length, turn);
    }
  }

  static Vec2 clothoid_chord(const ClothoidPiece& c) {
    const Exact end = along(c.theta0, c.kappa0, c.kappa1, c.length);
    return {static_cast<double>(end.x), static_cast<double>(end.y)};
  }

  Piece bezier(const Element& at, double length, double turn) {
    RationalBezier b;
    b.degree = 2 + static_cast<int>(random_() % 4);
    if (random_() % 2 == 0) b.origin = at.point;
    Vec2 p = at.point - b.origin;
    for (int j = 0; j <= b.degree; ++j) {
      b.offset[static_cast<std::size_t>(j)] = p;
      b.weight[static_cast<std::size_t>(j)] = uniform(0.3, 3.0);
      const double theta = at.theta + turn * j / b.degree * uniform(0.8, 1.2);
      p = p + (length / b.degree * uniform(0.5, 1.5)) * unit_at(theta);
    }
    return b;
  }

  std::mt19937_64 random_;
};

TEST(Gaps, AreNeverSmallerThanInFiftyDigitsAndHardlyLarger) {
  Pieces pieces(11);
  int small = 0;
  for (int i = 0; i < 200; ++i) {
    const Contour contour = pieces.contour();
    const JointGaps found = certify(contour).gaps;
    const Gaps truth = true_gaps(contour);
    EXPECT_GE(Real(found.position), truth.position) << i;
    EXPECT_GE(Real(found.heading), truth.heading) << i;
    EXPECT_GE(Real(found.curvature), truth.curvature) << i;
    constexpr double kOfRounding = 1e-13;  // of angles and lengths in doubles
    constexpr double kOfCurvature =
        1e-9;  // pieces that turn by 1e-6 know a curvature of 0 less well
    EXPECT_LE(found.position, static_cast<double>(truth.position) * (1 + 1e-9) + kOfRounding) << i;
    EXPECT_LE(found.heading, static_cast<double>(truth.heading) * (1 + 1e-9) + kOfRounding) << i;
    EXPECT_LE(found.curvature, static_cast<double>(truth.curvature) * (1 + 1e-9) + kOfCurvature)
        << i;
    small += truth.heading < 1e-9 ? 1 : 0;
  }
  EXPECT_GT(small, 40) << "gaps of the size of roundings are among them";
}

/// Contour of clothoids with the given curvatures at their ends, tangents continuous.
Contour clothoids(const std::vector<std::pair<double, double>>& kappas, double first_length) {
  std::vector<Piece> pieces;
  Vec2 at{1, 2};
  double theta = 0.4, length = first_length;
  for (const auto& [k0, k1] : kappas) {
    ClothoidPiece one{at, {}, theta, k0, k1, length};
    one.end = evaluate(Piece{ClothoidPiece{at, at, theta, k0, k1, length}}, 0.5).point;
    const Exact end = along(theta, k0, k1, length);
    one.end = at + Vec2{static_cast<double>(end.x), static_cast<double>(end.y)};
    pieces.emplace_back(one);
    at = one.end;
    theta += 0.5 * (k0 + k1) * length;
    length = 0.3;
  }
  Contour contour = contour_of(pieces, {{0, pieces.size() - 1, -1}});
  contour.carrier = Carrier::kClothoids;
  return contour;
}

TEST(Gaps, AreThoseOfTheFourEndsAtTheJointHoweverStronglyAnotherPieceIsCurved) {
  // a piece that hides nothing: 1e9 times as curved as its neighbours
  const Contour good = clothoids({{1e9, 0.9}, {0.9, 0.5}, {0.5, 0.35}}, 3e-9);
  EXPECT_TRUE(certify(good).gaps_within_bounds) << certify(good).reason;
  for (const double step : {1e-5, 0.1, 0.4}) {
    const Contour bad = clothoids({{1e9, 0.9}, {0.9, 0.5}, {0.5 * (1 - step), 0.2}}, 3e-9);
    const Certificate certificate = certify(bad);
    EXPECT_FALSE(certificate.proved);
    EXPECT_NEAR(certificate.gaps.curvature, step, 1e-9);
    EXPECT_NE(certificate.reason.find("the curvature gap at joint 3"), std::string::npos)
        << certificate.reason;
  }
}

TEST(Gaps, OfCurvatureUpToAMillionthOfTheLargerAreContinuous) {
  const auto stepped = [](double step) {
    return certify(clothoids({{0.9, 0.5}, {0.5 * (1 - step), 0.2}}, 0.3));
  };
  EXPECT_TRUE(stepped(0.99e-6).proved) << stepped(0.99e-6).reason;
  EXPECT_NEAR(stepped(0.99e-6).gaps.curvature, 0.99e-6, 1e-12);
  EXPECT_FALSE(stepped(1.01e-6).proved);
  EXPECT_EQ(stepped(0.99e-6).vertices, 0);
  EXPECT_TRUE(stepped(-0.99e-6).proved) << "a step against the run that is called continuous";
  EXPECT_FALSE(stepped(-1.01e-6).proved);
}

TEST(Gaps, OfHeadingUpToAMillionthOfARadianAreContinuous) {
  const auto turned = [](double by) {
    Contour contour = clothoids({{0.9, 0.5}, {0.5, 0.2}}, 0.3);
    auto& second = std::get<ClothoidPiece>(contour.pieces[1]);
    second.theta0 += by;
    const Exact end = along(second.theta0, second.kappa0, second.kappa1, second.length);
    second.end = second.start + Vec2{static_cast<double>(end.x), static_cast<double>(end.y)};
    Contour out = contour_of(contour.pieces, contour.runs);
    out.carrier = contour.carrier;
    return certify(out).gaps_within_bounds;
  };
  // (the element at the joint agrees with the right piece only: to 1e-9 or what rounding explains)
  EXPECT_TRUE(turned(1e-10));
  EXPECT_FALSE(turned(1.01e-6));
  EXPECT_FALSE(turned(7e-5));
}

TEST(Gaps, OfCurvatureBetweenFlatJointsAreToldOfTheirPieces) {
  // through an inflection at the joint: both curvatures there are rounding
  const Certificate flat = certify(clothoids({{0.9, 1e-15}, {-1e-15, -0.5}}, 0.3));
  EXPECT_TRUE(flat.proved) << flat.reason;
  EXPECT_NEAR(flat.gaps.curvature, 2e-15 / (1e-6 * 0.9), 1e-11);
  EXPECT_EQ(flat.inflections, 1);
  EXPECT_FALSE(certify(clothoids({{0.9, 1e-11}, {-1e-11, -0.5}}, 0.3)).proved);
}

TEST(Gaps, JumpsOfArcsAreJudgedAgainstBothNeighboursOnly) {
  std::vector<Piece> pieces;
  Vec2 at{0, 0};
  double theta = 0.0;
  for (const double kappa : {1e9, 0.9, 0.2, 0.8, 0.1}) {
    const double length = kappa > 1.0 ? 1e-9 : 0.3;
    pieces.emplace_back(arc_from(at, theta, kappa, length));
    at = end_point(pieces.back());
    theta += kappa * length;
  }
  Contour contour = contour_of(pieces, {{0, 4, -1}});
  contour.carrier = Carrier::kArcs;
  const Certificate certificate = certify(contour);
  EXPECT_FALSE(certificate.proved);
  EXPECT_EQ(certificate.vertices, 2);
  EXPECT_NE(certificate.reason.find("jumps the other way before piece 4"), std::string::npos)
      << certificate.reason;
}

TEST(Gaps, TheNameArcsExcusesOnlyArcsAndLines) {
  Contour contour = clothoids({{0.9, 0.5}, {0.4, 0.2}}, 0.3);
  contour.carrier = Carrier::kArcs;
  EXPECT_FALSE(certify(contour).proved);
}

TEST(Gaps, StraightCubicsThatMeetHaveNone) {
  // control points of a line are a third of a foot apart: their products are rounded
  const auto straight = [](double from, const std::vector<double>& at) {
    RationalBezier piece{{from, 2.0 * from}, 3, {}, {1, 1, 1, 1}};
    for (std::size_t j = 0; j < 4; ++j) piece.offset[j] = {at[j], 2.0 * at[j]};
    return piece;
  };
  const double third = 1.0 / 3.0;
  const Contour contour = contour_of(
      {straight(0.0, {0.0, 0.1, 0.7 * third, 0.5}), straight(0.5, {0.0, third, 0.4, 1.0})},
      {{0, 1, 0}});
  const Certificate certificate = certify(contour);
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_EQ(certificate.gaps.curvature, 0.0);
}

TEST(Gaps, CubicsThatAreStraightButForTheLastBitAreNot) {
  RationalBezier bent{{}, 3, {}, {1, 1, 1, 1}};
  for (std::size_t j = 0; j < 4; ++j) {
    const double x = static_cast<double>(j) / 3.0;
    bent.offset[j] = {x, 2.0 * x};
  }
  bent.offset[2].y = std::nextafter(bent.offset[2].y, 9.0);
  const Contour contour = contour_of({bent}, {{0, 0, 0}});
  EXPECT_NE(certify(contour).pieces.front().verdict, Verdict::kConstant);
}

}  // namespace
}  // namespace obvid
