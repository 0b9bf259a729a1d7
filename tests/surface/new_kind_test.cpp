// SPDX-License-Identifier: Apache-2.0
// The recipe "a new kind of surface" of docs/conventions.md, followed by an example that is nowhere
// but here: with its struct, its name, its evaluation and its NURBS form everything that knows
// surfaces knows it, and no file of the library was touched.
#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "kinds.h"
#include "obvid/surface/internal/topology.h"

namespace obvid {
namespace {

/// Sum of two curves: S(u, v) = one(u) + other(v) over the curves' domains. Its NURBS form is exact
/// when both are polynomial: control points are sums of theirs.
struct TranslationSurface {
  SpaceCurve one, other;
};

const char* kind_name(const TranslationSurface&) { return "surface of translation"; }

std::array<Range, 2> ranges_of(const TranslationSurface& s) {
  return {domain(s.one), domain(s.other)};
}

SurfaceJet evaluate_kind(const TranslationSurface& s, double u, double v) {
  const SpaceJet a = evaluate(s.one, u), b = evaluate(s.other, v);
  return {a.point + b.point, a.d1, b.d1, a.d2, {}, b.d2};
}

Result<NurbsForm> nurbs_of(const TranslationSurface& s, double) {
  for (const SpaceCurve* curve : {&s.one, &s.other}) {
    OBVID_TRY(check(*curve));
    if (!curve->weights.empty()) {
      return fail({ErrorCode::kUnsupported, "only polynomial curves here", "", ""});
    }
  }
  NurbsForm form{{s.one.degree, s.other.degree, s.one.knots, s.other.knots, {}, {}}, 0.0};
  for (const Vec3& b : s.other.points) {
    for (const Vec3& a : s.one.points) form.surface.points.push_back(a + b);
  }
  return form;
}

using SurfacesHere =
    std::variant<NurbsSurface, RuledSurface, OffsetSurface, IdSurface, TranslationSurface>;

TranslationSurface saddle() {
  // z = x^2 - y^2 over [0, 2] x [0, 1]
  return {{2, {0, 0, 0, 2, 2, 2}, {{0, 0, 0}, {1, 0, 0}, {2, 0, 4}}, {}},
          {2, {0, 0, 0, 1, 1, 1}, {{0, 0, 0}, {0, 0.5, 0}, {0, 1, -1}}, {}}};
}

TEST(NewKindOfSurface, IsKnownByItsFiveFunctionsAlone) {
  const SurfacesHere surface = saddle();
  EXPECT_EQ(name_of_any(surface), "surface of translation");
  EXPECT_EQ(ranges_of_any(surface)[0].to, 2.0);
  EXPECT_EQ(ranges_of_any(surface)[1].to, 1.0);
  const auto form = nurbs_of_any(surface, 1e-6);
  ASSERT_TRUE(form) << form.error().what;
  ASSERT_TRUE(check(form->surface));
  EXPECT_EQ(form->deviation, 0.0);
  for (double x = 0.0; x <= 2.0; x += 0.25) {
    for (double y = 0.0; y <= 1.0; y += 0.25) {
      const SurfaceJet one = evaluate_any(surface, x, y), two = evaluate(form->surface, x, y);
      const Vec3 there{x, y, x * x - y * y};
      EXPECT_LT(norm(one.point - there), 1e-14);
      EXPECT_LT(norm(two.point - there), 1e-14);
      EXPECT_LT(norm(one.duu - two.duu) + norm(one.duv - two.duv) + norm(one.dvv - two.dvv), 1e-12);
      // Gaussian curvature of z = x^2 - y^2
      const double g = 1.0 + 4.0 * x * x + 4.0 * y * y;
      EXPECT_NEAR(curvature(two).gaussian, -4.0 / (g * g), 1e-12);
    }
  }
}

TEST(NewKindOfSurface, GoesOnAsNurbsLikeAnyOther) {
  const auto form = nurbs_of_any(SurfacesHere{saddle()}, 1e-6);
  ASSERT_TRUE(form);
  const Topology topology = topology_of({{"saddle"}, {}, {{"saddle", form->surface}}});
  EXPECT_EQ(topology.edges.size(), 4U);
  EXPECT_EQ(topology.vertices.size(), 4U);
}

TEST(NewKindOfSurface, RefusesWhatItDoesNotKnow) {
  TranslationSurface broken = saddle();
  broken.one.points.pop_back();
  EXPECT_EQ(nurbs_of_any(SurfacesHere{broken}, 1e-6).error().code, ErrorCode::kBadOption);
  TranslationSurface rational = saddle();
  rational.other.weights = {1.0, 2.0, 1.0};
  EXPECT_EQ(nurbs_of_any(SurfacesHere{rational}, 1e-6).error().code, ErrorCode::kUnsupported);
}

}  // namespace
}  // namespace obvid
