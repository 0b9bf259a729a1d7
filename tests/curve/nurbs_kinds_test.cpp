// SPDX-License-Identifier: Apache-2.0
// NURBS curves of the plane and of space against the definition of B-splines, and against each
// other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "obvid/curve/internal/basis.h"
#include "obvid/curve/nurbs.h"

namespace obvid {
namespace {

/// The recurrence of Cox and de Boor as it stands in books, 0/0 = 0.
double cox_de_boor(const std::vector<double>& t, std::size_t i, int p, double u) {
  if (p == 0) return t[i] <= u && u < t[i + 1] ? 1.0 : 0.0;
  const auto q = static_cast<std::size_t>(p);
  double sum = 0.0;
  if (t[i + q] > t[i]) sum += (u - t[i]) / (t[i + q] - t[i]) * cox_de_boor(t, i, p - 1, u);
  if (t[i + q + 1] > t[i + 1]) {
    sum += (t[i + q + 1] - u) / (t[i + q + 1] - t[i + 1]) * cox_de_boor(t, i + 1, p - 1, u);
  }
  return sum;
}

template <class V>
V by_cox_de_boor(const Nurbs<V>& c, double u) {
  V sum{};
  double weight = 0.0;
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    const double b =
        cox_de_boor(c.knots, i, c.degree, u) * (c.weights.empty() ? 1.0 : c.weights[i]);
    sum = sum + b * c.points[i];
    weight += b;
  }
  return sum / weight;
}

template <class V>
V made_of(double x, double y, double z) {
  if constexpr (std::is_same_v<V, Vec2>) {
    return {x, y};
  } else {
    return {x, y, z};
  }
}

/// Any curve of a degree: uneven knots, some of them double, weights or none.
template <class V>
Nurbs<V> any_curve(int degree, bool rational, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  Nurbs<V> c;
  c.degree = degree;
  const auto p = static_cast<std::size_t>(degree);
  c.knots.assign(p + 1, -1.0);
  double u = -1.0;
  for (int k = 0; k < 5; ++k) {
    u += 0.05 + part(random);
    c.knots.insert(c.knots.end(), k == 2 && degree > 1 ? 2 : 1, u);
  }
  c.knots.insert(c.knots.end(), p + 1, u + 0.3);
  while (c.points.size() + p + 1 < c.knots.size()) {
    const double x = static_cast<double>(c.points.size());
    c.points.push_back(made_of<V>(x, part(random), part(random)));
    if (rational) c.weights.push_back(0.3 + 2.0 * part(random));
  }
  return c;
}

template <class V>
class NurbsOf : public testing::Test {
 public:
  /// Each degree with and without weights.
  template <class Look>
  static void for_all(Look&& look) {
    for (int degree = 1; degree <= kMaxNurbsDegree; ++degree) {
      for (const bool rational : {false, true}) {
        SCOPED_TRACE(testing::Message() << "degree " << degree << (rational ? ", rational" : ""));
        const auto curve = any_curve<V>(degree, rational, static_cast<unsigned>(degree));
        ASSERT_TRUE(check(curve)) << check(curve).error().what;
        look(curve);
      }
    }
  }
  /// `other` has the points of `curve` at the same parameters, by their definition.
  static void expect_same(const Nurbs<V>& curve, const Nurbs<V>& other) {
    ASSERT_TRUE(check(other)) << check(other).error().what;
    const Range range = domain(other);
    for (int k = 0; k < 40; ++k) {
      const double u = range.at(k / 40.0);
      EXPECT_LT(norm(by_cox_de_boor(curve, u) - by_cox_de_boor(other, u)), 1e-12) << u;
    }
  }
};
using PlaneAndSpace = testing::Types<Vec2, Vec3>;
TYPED_TEST_SUITE(NurbsOf, PlaneAndSpace);

TYPED_TEST(NurbsOf, PointsAreThoseOfTheDefinition) {
  this->for_all([](const Nurbs<TypeParam>& curve) {
    const Range range = domain(curve);
    for (int k = 0; k < 50; ++k) {
      const double u = range.at(k / 50.0);
      EXPECT_LT(norm(evaluate(curve, u).point - by_cox_de_boor(curve, u)), 1e-13) << u;
    }
    EXPECT_LT(norm(evaluate(curve, range.to).point - curve.points.back()), 1e-14);
  });
}

TYPED_TEST(NurbsOf, DerivativesAreTheLimitsOfDifferences) {
  this->for_all([](const Nurbs<TypeParam>& curve) {
    const Range range = domain(curve);
    constexpr double h = 1e-5;
    for (const double part : {0.013, 0.49, 0.977}) {  // inside spans
      const double u = range.at(part);
      const auto at = evaluate(curve, u), up = evaluate(curve, u + h), down = evaluate(curve, u - h);
      EXPECT_LT(norm((up.point - down.point) / (2 * h) - at.d1), 1e-5 * (1 + norm(at.d3)));
      EXPECT_LT(norm((up.d1 - down.d1) / (2 * h) - at.d2), 1e-3 * (1 + norm(at.d2) + norm(at.d3)));
    }
  });
}

TYPED_TEST(NurbsOf, OperationsLeaveTheCurveAsItIs) {
  this->for_all([this](const Nurbs<TypeParam>& curve) {
    const Range range = domain(curve);
    const double inner = curve.knots[static_cast<std::size_t>(curve.degree) + 1];
    this->expect_same(curve, with_knots(curve, {range.at(0.2), range.at(0.2001), range.at(0.9)}));
    if (curve.degree < kMaxNurbsDegree) {
      const auto higher = with_degree(curve, curve.degree + 1);
      EXPECT_EQ(higher.degree, curve.degree + 1);
      this->expect_same(curve, higher);
    }
    EXPECT_EQ(with_degree(curve, curve.degree), curve);
    for (const double u : {inner, range.at(0.61)}) {
      const auto [before, after] = split(curve, u);
      EXPECT_EQ(domain(before).to, u);
      EXPECT_EQ(domain(after).from, u);
      this->expect_same(curve, before);
      this->expect_same(curve, after);
    }
    const auto back = reversed(reversed(curve));
    EXPECT_EQ(back.points, curve.points);
    const auto moved = with_domain(with_domain(curve, {0.0, 7.0}), range);
    this->expect_same(curve, moved);
  });
}

TYPED_TEST(NurbsOf, SpansAreTheCurveCutAtItsKnots) {
  this->for_all([this](const Nurbs<TypeParam>& curve) {
    const auto cut = spans(curve);
    ASSERT_EQ(cut.size(), 6U);
    double at = domain(curve).from;
    for (std::size_t k = 0; k < cut.size(); ++k) {
      EXPECT_EQ(cut[k].points.size(), static_cast<std::size_t>(curve.degree) + 1);
      EXPECT_EQ(cut[k].weights.empty(), curve.weights.empty());
      EXPECT_EQ(domain(cut[k]).from, at);
      at = domain(cut[k]).to;
      if (k > 0) {
        EXPECT_EQ(cut[k].points.front(), cut[k - 1].points.back());
      }
      this->expect_same(curve, cut[k]);
    }
    EXPECT_EQ(at, domain(curve).to);
  });
}

TYPED_TEST(NurbsOf, NoWeightsAreWeightsOfOne) {
  auto curve = any_curve<TypeParam>(4, false, 7);
  auto ones = curve;
  ones.weights.assign(ones.points.size(), 1.0);
  ASSERT_TRUE(check(ones));
  // sums of degree + 1 terms on either side, each rounded once more, and a quotient
  double farthest = 0.0;
  for (const TypeParam& p : curve.points) farthest = std::max(farthest, norm(p));
  const double rounding = 2.0 * (curve.degree + 3) * 0x1p-53 * farthest;
  for (double u = -1.0; u < domain(curve).to; u += 0.1) {
    EXPECT_LT(norm(evaluate(curve, u).point - evaluate(ones, u).point), rounding);
    EXPECT_LT(norm(evaluate(curve, u).d3 - evaluate(ones, u).d3), 1e-10);
  }
}

TYPED_TEST(NurbsOf, WhatMakesNoCurveIsRefused) {
  const auto curve = any_curve<TypeParam>(3, true, 5);
  const auto refused = [](auto broken, auto change) {
    change(broken);
    const auto good = check(broken);
    EXPECT_FALSE(good);
    return good ? ErrorCode::kInternal : good.error().code;
  };
  using Curve = Nurbs<TypeParam>;
  EXPECT_EQ(refused(curve, [](Curve& c) { c.weights.pop_back(); }), ErrorCode::kBadOption);
  EXPECT_EQ(refused(curve, [](Curve& c) { c.weights[2] = 0.0; }), ErrorCode::kBadOption);
  EXPECT_EQ(refused(curve, [](Curve& c) { c.points.pop_back(); }), ErrorCode::kBadOption);
  EXPECT_EQ(refused(curve, [](Curve& c) { c.knots[5] = -7.0; }), ErrorCode::kBadOption);
  EXPECT_EQ(refused(curve, [](Curve& c) { c.knots[0] = -2.0; }), ErrorCode::kBadOption);
  EXPECT_EQ(refused(curve, [](Curve& c) { c.degree = kMaxNurbsDegree + 1; }),
            ErrorCode::kBadOption);
  EXPECT_EQ(refused(curve, [](Curve& c) { c.points[1].y = std::nan(""); }), ErrorCode::kNotFinite);
  EXPECT_EQ(refused(Curve{}, [](Curve&) {}), ErrorCode::kBadOption);
  EXPECT_TRUE(spans(Curve{}).empty());
}

TEST(NurbsOfBoth, ACurveInAPlaneOfSpaceIsTheCurveOfThePlane) {
  for (int degree = 1; degree <= kMaxNurbsDegree; ++degree) {
    for (const bool rational : {false, true}) {
      const NurbsCurve flat = any_curve<Vec2>(degree, rational, 11);
      SpaceCurve high{flat.degree, flat.knots, {}, flat.weights};
      for (const Vec2 p : flat.points) high.points.push_back({p.x, p.y, 0.0});
      for (const double part : {0.0, 0.3, 0.5, 0.9, 1.0}) {
        const double u = domain(flat).at(part);
        const Jet one = evaluate(flat, u);
        const SpaceJet two = evaluate(high, u);
        EXPECT_EQ(two.point, (Vec3{one.point.x, one.point.y, 0.0}));
        EXPECT_EQ(two.d3, (Vec3{one.d3.x, one.d3.y, 0.0}));
      }
      const auto [a, b] = split(flat, domain(flat).at(0.4));
      EXPECT_EQ(split(high, domain(high).at(0.4))[0].weights, a.weights);
      EXPECT_EQ(with_degree(high, degree).knots, with_degree(flat, degree).knots);
    }
  }
}

TEST(NurbsOfBoth, SpansAsPiecesAndPiecesAsCurves) {
  const NurbsCurve curve = any_curve<Vec2>(4, true, 3);
  for (const BezierSpan& span : bezier_spans(curve)) {
    const NurbsCurve piece = with_domain(nurbs_of(span.piece), {span.from, span.to});
    for (const double part : {0.0, 0.25, 0.7, 1.0}) {
      const Vec2 there = evaluate(span.piece, part).point;
      EXPECT_LT(norm(there - evaluate(curve, Range{span.from, span.to}.at(part)).point), 1e-13);
      EXPECT_LT(norm(there - evaluate(piece, Range{span.from, span.to}.at(part)).point), 1e-13);
    }
  }
  EXPECT_EQ(bezier_spans(curve).size(), 6U);
  EXPECT_TRUE(bezier_spans(any_curve<Vec2>(8, true, 3)).empty()) << "no piece has this degree";
}

}  // namespace
}  // namespace obvid
