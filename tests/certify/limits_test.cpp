// SPDX-License-Identifier: Apache-2.0
// Numbers beyond what `fit` forms, and arithmetic that does not round as the bounds assume.
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <functional>
#include <limits>

#include "contours.h"
#include "obvid/certify/internal/limits.h"
#include "spiral_table.h"

namespace obvid {
namespace {

using testing_data::arc_from;
using testing_data::contour_of;
using testing_data::kSpirals;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

RationalBezier quartic() { return testing_data::spiral(kSpirals[1]); }

Contour two_halves() {
  const auto [a, b] = split(quartic(), 0.5);
  return contour_of({a, b}, {{0, 1, 1}});
}

Contour two_arcs() {
  const ArcPiece a = arc_from({1, 2}, 0.3, 0.5, 1.0);
  Contour contour = contour_of({a, arc_from(a.end, 0.8, 0.5, 1.0)}, {{0, 1, 0}});
  contour.carrier = Carrier::kArcs;
  return contour;
}

void expect_out(const Contour& contour, const std::string& list, const std::string& why) {
  const auto found = out_of_range(contour);
  ASSERT_TRUE(found) << why;
  EXPECT_EQ(found->list, list) << why << ": " << found->what;
  const Certificate certificate = certify(contour);
  EXPECT_FALSE(certificate.proved) << why;
  EXPECT_FALSE(certificate.through_points) << why;
  EXPECT_NE(certificate.reason.find(found->what), std::string::npos) << certificate.reason;
  EXPECT_EQ(certificate.pieces.size(), contour.pieces.size()) << why;
}

TEST(Limits, HoldUsualContoursOfAllSizes) {
  for (const Contour& good : {two_halves(), two_arcs()}) {
    EXPECT_FALSE(out_of_range(good));
    EXPECT_TRUE(certify(good).proved) << certify(good).reason;
  }
  for (const double size : {1e-99, 1e-9, 1e9, 1e99}) {
    Contour contour = two_halves();
    for (Piece& piece : contour.pieces) {
      for (Vec2& q : std::get<RationalBezier>(piece).offset) q = size * q;
    }
    for (Vec2& p : contour.points) p = size * p;
    for (Joint& joint : contour.joints) {
      joint.element.point = size * joint.element.point;
      joint.element.kappa /= size;
    }
    EXPECT_FALSE(out_of_range(contour)) << size;
  }
}

TEST(Limits, RefuseEveryNumberOfAPieceThatIsNoneOrTooLarge) {
  for (const double value : {kUnbounded, -kUnbounded, std::nan(""), 1e130}) {
    const std::string why = std::to_string(value);
    const auto bezier = [&](const std::function<void(RationalBezier&)>& change) {
      Contour bad = two_halves();
      change(std::get<RationalBezier>(bad.pieces[1]));
      expect_out(bad, "pieces", why);
    };
    bezier([&](RationalBezier& b) { b.offset[2].x = value; });
    bezier([&](RationalBezier& b) { b.offset[4].y = value; });
    bezier([&](RationalBezier& b) { b.origin.x = value; });
    bezier([&](RationalBezier& b) { b.weight[0] = value; });
    bezier([&](RationalBezier& b) { b.weight[3] = value; });
    const auto arc = [&](const std::function<void(ArcPiece&)>& change) {
      Contour bad = two_arcs();
      change(std::get<ArcPiece>(bad.pieces[1]));
      expect_out(bad, "pieces", why);
    };
    arc([&](ArcPiece& a) { a.theta0 = value; });
    arc([&](ArcPiece& a) { a.kappa = value; });
    arc([&](ArcPiece& a) { a.length = value; });
    arc([&](ArcPiece& a) { a.end.y = value; });
    for (const bool first : {true, false}) {
      Contour bad = two_arcs();
      bad.pieces[1] =
          ClothoidPiece{{0, 0}, {1, 0}, 0.0, first ? value : 0.1, first ? 0.1 : value, 1.0};
      expect_out(bad, "pieces", why);
    }
    const auto element = [&](const std::function<void(Joint&)>& change) {
      Contour bad = two_arcs();
      change(bad.joints[1]);
      expect_out(bad, "elements", why);
    };
    element([&](Joint& j) { j.element.theta = value; });
    element([&](Joint& j) { j.element.point.x = value; });
    if (std::isinf(value)) element([&](Joint& j) { j.element.kappa = value; });
    Contour bad = two_arcs();
    bad.points[0].y = value;
    expect_out(bad, "points", why);
  }
}

TEST(Limits, AJointThatSaysOfNoCurvatureIsNamedAndNothingIsProvedOfIt) {
  EXPECT_FALSE(joint_without_curvature(two_arcs()).has_value());
  for (const bool leaving : {false, true}) {
    Contour contour = two_arcs();
    Joint& joint = contour.joints[1];
    if (leaving) joint.leaving = joint.element;
    (leaving ? joint.leaving->kappa : joint.element.kappa) = std::nan("");
    EXPECT_FALSE(out_of_range(contour).has_value());
    EXPECT_EQ(joint_without_curvature(contour), std::size_t{1});
    const Certificate certificate = certify(contour);
    EXPECT_FALSE(certificate.proved);
    EXPECT_EQ(certificate.reason, "element 2 has no curvature");
    for (const PieceProof& piece : certificate.pieces) {
      EXPECT_EQ(piece.verdict, Verdict::kUndecided);
    }
  }
}

TEST(Limits, RefuseWeightsWhoseQuotientsLeaveTheRange) {
  for (const double scale : {1e-130, 0x1p-537, 1e130}) {
    Contour bad = two_halves();
    for (double& w : std::get<RationalBezier>(bad.pieces[0]).weight) w *= scale;
    expect_out(bad, "pieces", "all weights");
  }
  Contour bad = two_halves();
  std::get<RationalBezier>(bad.pieces[0]).weight[1] = 1e-80;
  std::get<RationalBezier>(bad.pieces[0]).weight[2] = 1e80;
  expect_out(bad, "pieces", "quotient");
  Contour good = two_halves();  // a common factor changes nothing
  for (double& w : std::get<RationalBezier>(good.pieces[0]).weight) w *= 0x1p-300;
  EXPECT_TRUE(certify(good).proved) << certify(good).reason;
  EXPECT_EQ(certify(good).gaps.curvature, certify(two_halves()).gaps.curvature);
}

TEST(Limits, RefuseContoursTooSmallOrTooLargeForSeries) {
  for (const double size : {1e-120, 1e105, 1e160}) {
    const Contour lines =
        contour_of({LinePiece{{0, 0}, {size, 0}}, LinePiece{{size, 0}, {size, size}}}, {{0, 1, 0}});
    const auto found = out_of_range(lines);
    ASSERT_TRUE(found) << size;
    EXPECT_EQ(found->code, ErrorCode::kSizeOutOfRange);
    EXPECT_FALSE(certify(lines).proved);
  }
}

TEST(Limits, RefuseHeadingsThatAreTurnsBeyondTheirContour) {
  for (const double turns : {-1e9, -7.0, 7.0, 2e10}) {
    Contour bad = two_arcs();
    std::get<ArcPiece>(bad.pieces[0]).theta0 += turns * 2.0 * 3.141592653589793;
    expect_out(bad, "pieces", "theta0");
    bad = two_arcs();
    bad.joints[2].element.theta += turns * 2.0 * 3.141592653589793;
    expect_out(bad, "elements", "heading");
  }
}

TEST(Limits, RefuseOriginsFartherThanTheContourIsLarge) {
  Contour contour = two_halves();
  const auto with_origin = [&](Vec2 origin) {
    Contour out = contour;
    auto& piece = std::get<RationalBezier>(out.pieces[0]);
    piece.origin = origin;
    for (Vec2& q : piece.offset) q = q - origin;
    return out;
  };
  EXPECT_TRUE(certify(with_origin({1.0, 0.5})).proved);
  expect_out(with_origin({-4096.0, 0.0}), "pieces", "4096");
  expect_out(with_origin({-0x1p48, -0x1p48}), "pieces", "2^48");
}

/// Restores the rounding mode when a test ends.
class RoundingMode {
 public:
  explicit RoundingMode(int mode) : before_(std::fegetround()) { std::fesetround(mode); }
  ~RoundingMode() { std::fesetround(before_); }
  RoundingMode(const RoundingMode&) = delete;
  RoundingMode& operator=(const RoundingMode&) = delete;

 private:
  int before_;
};

TEST(Limits, NothingIsProvedWhileTheProcessorRoundsAnotherWay) {
  const Contour good = two_halves();
  const Piece piece = quartic();
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    Certificate certificate;
    PieceProof proof;
    {
      const RoundingMode other(mode);
      certificate = certify(good);
      proof = prove_piece(piece);
    }
    EXPECT_FALSE(certificate.proved);
    EXPECT_NE(certificate.reason.find("does not round to the nearest number"), std::string::npos)
        << certificate.reason;
    EXPECT_EQ(proof.verdict, Verdict::kUndecided);
  }
  EXPECT_TRUE(certify(good).proved);
}

}  // namespace
}  // namespace obvid
