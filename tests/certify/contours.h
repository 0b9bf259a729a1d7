// SPDX-License-Identifier: Apache-2.0
// Contours put together from pieces, for the tests of their proofs.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "obvid/certify/certify.h"

namespace obvid::testing_data {

inline Joint joint(Vec2 point, double theta, double kappa, std::size_t source) {
  return {{point, theta, kappa}, source, {}};
}

/// Joints from the analytic jets, points at every joint.
inline Contour contour_of(std::vector<Piece> pieces, std::vector<Run> runs) {
  Contour contour;
  contour.pieces = std::move(pieces);
  contour.runs = std::move(runs);
  const auto add = [&](const Piece& piece, double t) {
    const Jet jet = evaluate(piece, t);
    contour.joints.push_back(
        joint(jet.point, heading(jet.d1), curvature(jet), contour.points.size()));
    contour.points.push_back(jet.point);
  };
  for (const Piece& piece : contour.pieces) add(piece, 0.0);
  add(contour.pieces.back(), 1.0);
  return contour;
}

inline RationalBezier quarter_ellipse(Vec2 from, Vec2 corner, Vec2 to) {
  // s^2 + 2 s t.. : weights 1, 1, 2 put cos = (1 - t^2)/(1 + t^2) at exact numbers.
  return {{}, 2, {from, corner, to}, {1, 1, 2}};
}

inline Contour closed_contour(std::vector<Piece> pieces, std::vector<Run> runs) {
  Contour contour = contour_of(std::move(pieces), std::move(runs));
  contour.joints.pop_back();
  contour.points.pop_back();
  contour.closed = true;
  return contour;
}

inline ArcPiece arc_from(Vec2 start, double theta, double kappa, double length) {
  const double half = 0.5 * kappa * length;
  return {start, start + length * std::sin(half) / half * unit_at(theta + half), theta, kappa,
          length};
}

inline void expect_refused(const Contour& contour, const std::string& why) {
  const Certificate certificate = certify(contour);
  EXPECT_FALSE(certificate.proved) << why;
  EXPECT_FALSE(certificate.reason.empty()) << why;
}

}  // namespace obvid::testing_data
