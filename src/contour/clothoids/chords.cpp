// SPDX-License-Identifier: Apache-2.0
#include "chords.h"

#include <cmath>
#include <numbers>
#include <string>

#include "obvid/contour/clothoids.h"
#include "obvid/geom/internal/angle.h"

namespace obvid {
namespace clothoids {

Result<Chords> chords_of(const std::vector<Vec2>& points, std::size_t fewest) {
  if (points.size() < fewest) {
    return fail({ErrorCode::kTooFewPoints,
                 "a clothoid spline needs at least " + std::to_string(fewest) + " points", "",
                 "add points", -1, static_cast<double>(points.size())});
  }
  Chords chords;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec2 d = points[i + 1] - points[i];
    const double h = norm(d);
    const double turn = i == 0 ? 0.0 : turning(points[i] - points[i - 1], d);
    if (!(h > 0.0) || !(std::abs(turn) < std::numbers::pi)) {
      return fail({ErrorCode::kChordReversal, "two chords turn back onto each other, or coincide",
                   "point " + std::to_string(i + 1), "remove the point",
                   static_cast<std::ptrdiff_t>(i), turn});
    }
    chords.length.push_back(h);
    chords.omega.push_back(i == 0 ? heading(d) : chords.omega.back() + turn);
  }
  return chords;
}

}  // namespace clothoids

std::vector<double> neighbour_headings(const std::vector<Vec2>& points, const EndHeadings& ends) {
  std::vector<double> theta(points.size(), 0.0);
  const auto chords = clothoids::chords_of(points, 2);
  if (!chords) return theta;
  const auto& omega = chords->omega;
  const std::size_t n = points.size();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    theta[i] = omega[i - 1] + turning(points[i] - points[i - 1], points[i + 1] - points[i - 1]);
  }
  const auto unwrapped = [](double given, double near) { return nearest_angle(given, near); };
  const double first = n > 2 ? 2.0 * omega.front() - theta[1] : omega.front();
  const double last = n > 2 ? 2.0 * omega.back() - theta[n - 2] : omega.back();
  theta.front() = ends.start ? unwrapped(*ends.start, first) : first;
  theta.back() = ends.end ? unwrapped(*ends.end, last) : last;
  return theta;
}

Result<std::vector<ClothoidPiece>> g1_clothoids(const std::vector<Vec2>& points,
                                                const std::vector<double>& headings) {
  if (headings.size() != points.size()) {
    return fail({ErrorCode::kUsage, "one heading for each point is expected", "", "", -1,
                 static_cast<double>(headings.size())});
  }
  std::vector<ClothoidPiece> pieces;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto piece = clothoid_between(points[i], headings[i], points[i + 1], headings[i + 1]);
    if (!piece) {
      return fail({ErrorCode::kChordReversal, "two points coincide, or a heading is no number",
                   "point " + std::to_string(i + 1), "remove the point",
                   static_cast<std::ptrdiff_t>(i), 0.0});
    }
    pieces.push_back(*piece);
  }
  return pieces;
}

}  // namespace obvid
