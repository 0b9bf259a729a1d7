// SPDX-License-Identifier: Apache-2.0
// Contours without an end: the seam is a joint like any other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "../common/angles.h"
#include "contours.h"

namespace obvid {
namespace {

using testing_data::arc_from;
using testing_data::closed_contour;
using testing_data::expect_refused;
using testing_data::quarter_ellipse;

/// Arcs and lines (curvature 0), each as {curvature, turn or length}, one after the other.
Contour loop_of(const std::vector<std::pair<double, double>>& steps, std::vector<Run> runs,
                double theta) {
  std::vector<Piece> pieces;
  Vec2 at{3.0, -2.0};
  for (const auto& [kappa, size] : steps) {
    if (kappa == 0.0) {
      pieces.emplace_back(LinePiece{at, at + size * unit_at(theta)});
    } else {
      pieces.emplace_back(arc_from(at, theta, kappa, size / std::abs(kappa)));
      theta += std::copysign(size, kappa);
    }
    at = end_point(pieces.back());
  }
  Contour contour = closed_contour(std::move(pieces), std::move(runs));
  contour.carrier = Carrier::kArcs;
  return contour;
}

Contour circle_of_four_arcs() {
  return loop_of({{0.5, kPi / 2}, {0.5, kPi / 2}, {0.5, kPi / 2}, {0.5, kPi / 2}}, {{0, 3, 0}},
                 0.7);
}

/// Radii 1 and 4, a quarter of each twice: half turns about its centre carry it into itself.
Contour oval_of_four_arcs() {
  return loop_of({{1.0, kPi / 2}, {0.25, kPi / 2}, {1.0, kPi / 2}, {0.25, kPi / 2}},
                 {{0, 0, 1}, {1, 1, -1}, {2, 2, 1}, {3, 3, -1}}, 0.2);
}

/// Circles of radius 1 around (+-2, 0) and their inner tangents, from the middle of one of these.
Contour figure_eight() {
  const double half = std::sqrt(3.0);  // tangent from the origin
  const double third = 2.0 * kPi / 3.0;
  return loop_of({{0.0, half},
                  {-1.0, third},
                  {-1.0, third},
                  {0.0, 2.0 * half},
                  {1.0, third},
                  {1.0, third},
                  {0.0, half}},
                 {{0, 2, -1}, {3, 5, 1}, {6, 6, -1}}, kPi / 6.0);
}

/// An ellipse whose seam lies inside a quarter: first and last run are parts of the same. The
/// quarter is halved by hand: its halves have exact numbers, so their ends stay vertices.
Contour ellipse_with_seam_inside_a_run() {
  const RationalBezier a{{}, 2, {Vec2{15, 0}, {15, 2.5}, {9, 4}}, {1, 1, 1.25}};
  const RationalBezier b{{}, 2, {Vec2{9, 4}, {5, 5}, {0, 5}}, {1.25, 1.5, 2}};
  return closed_contour({b, quarter_ellipse({0, 5}, {-15, 5}, {-15, 0}),
                         quarter_ellipse({-15, 0}, {-15, -5}, {0, -5}),
                         quarter_ellipse({0, -5}, {15, -5}, {15, 0}), a},
                        {{0, 0, -1}, {1, 1, 1}, {2, 2, -1}, {3, 3, 1}, {4, 4, -1}});
}

TEST(ClosedContour, CircleOfFourArcsHasNoVertex) {
  const Certificate certificate = certify(circle_of_four_arcs());
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_EQ(certificate.vertices, 0);
  EXPECT_EQ(certificate.inflections, 0);
  EXPECT_LT(certificate.gaps.position, 1e-14);
}

TEST(ClosedContour, OvalOfFourArcsHasFourVertices) {
  const Certificate certificate = certify(oval_of_four_arcs());
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_EQ(certificate.vertices, 4);
  EXPECT_NEAR(certificate.gaps.curvature, 0.75, 1e-14);
}

TEST(ClosedContour, SeamOfArcsMayHaveACurvatureBetweenBoth) {
  for (std::size_t j = 0; j < 4; ++j) {
    Contour contour = oval_of_four_arcs();
    contour.joints[j].element.kappa = 0.5;
    EXPECT_TRUE(certify(contour).proved) << "joint " << j << ": " << certify(contour).reason;
    contour.joints[j].element.kappa = 1.1;
    expect_refused(contour, "beyond both arcs at joint " + std::to_string(j));
  }
}

TEST(ClosedContour, SeamInsideARunIsNoVertex) {
  const Certificate certificate = certify(ellipse_with_seam_inside_a_run());
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_EQ(certificate.vertices, 4);
  EXPECT_EQ(certificate.self_intersections, 0);
}

TEST(ClosedContour, FigureEightInflectsTwiceWhereverItsSeamIs) {
  const Contour from_the_middle = figure_eight();
  const Certificate certificate = certify(from_the_middle);
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_EQ(certificate.inflections, 2);
  EXPECT_EQ(certificate.vertices, 2);
  for (std::size_t first = 1; first < from_the_middle.pieces.size(); ++first) {
    Contour turned = from_the_middle;
    const auto by = static_cast<std::ptrdiff_t>(first);
    std::rotate(turned.pieces.begin(), turned.pieces.begin() + by, turned.pieces.end());
    std::rotate(turned.joints.begin(), turned.joints.begin() + by, turned.joints.end());
    EXPECT_EQ(certify(turned).inflections, 2) << first;
    EXPECT_EQ(certify(turned).vertices, 2) << first;
  }
}

TEST(ClosedContour, EveryNumberAtTheSeamIsJudged) {
  for (const Contour& good : {ellipse_with_seam_inside_a_run(), circle_of_four_arcs()}) {
    ASSERT_TRUE(certify(good).proved);
    const std::function<void(Contour&)> changes[] = {
        [](Contour& c) { c.joints[0].element.theta += 1e-7; },
        [](Contour& c) { c.joints[0].element.kappa *= 1 + 1e-7; },
        [](Contour& c) { c.joints[0].element.point.y += 1e-7; },
        [](Contour& c) { c.joints[0].element.kappa = NAN; },
        [](Contour& c) { c.joints.push_back(c.joints.front()); },
        [](Contour& c) { c.joints.clear(); },
        [](Contour& c) { c.pieces.pop_back(), c.joints.pop_back(), c.runs.back().last_piece -= 1; },
    };
    for (std::size_t k = 0; k < std::size(changes); ++k) {
      Contour contour = good;
      changes[k](contour);
      expect_refused(contour, "change " + std::to_string(k));
    }
  }
}

TEST(ClosedContour, LastPieceThatMissesTheSeamIsRefused) {
  for (const std::size_t j : {0U, 1U, 2U}) {
    Contour contour = ellipse_with_seam_inside_a_run();
    auto& last = std::get<RationalBezier>(contour.pieces.back());
    last.offset[j] = last.offset[j] + Vec2{1e-6, 1e-6};
    expect_refused(contour, "control point " + std::to_string(j));
  }
  Contour contour = circle_of_four_arcs();
  std::get<ArcPiece>(contour.pieces.back()).length *= 1.0 + 1e-8;
  expect_refused(contour, "an arc too long");
}

TEST(ClosedContour, PointsMayBeginAnywhereButKeepTheirOrder) {
  Contour contour = circle_of_four_arcs();
  for (std::size_t shift = 0; shift < 4; ++shift) {
    std::rotate(contour.points.begin(), contour.points.begin() + 3, contour.points.end());
    for (Joint& joint : contour.joints) joint.source = (*joint.source + 1) % 4;
    EXPECT_TRUE(certify(contour).proved) << certify(contour).reason;
  }
  std::swap(contour.points[1], contour.points[2]);
  std::swap(contour.joints[1].source, contour.joints[2].source);
  expect_refused(contour, "two points swapped, each still met");
}

}  // namespace
}  // namespace obvid
