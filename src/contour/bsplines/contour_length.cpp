// SPDX-License-Identifier: Apache-2.0
#include "contour_length.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "obvid/region/refine.h"

namespace obvid::bsplines {
namespace {

constexpr std::size_t kLengthCells = 8;  // per piece: the quadrature then errs by rounding only

/// Eight-point Gauss-Legendre over [from, to] of the parameter.
double length_between(const Piece& piece, double from, double to) {
  constexpr std::array<double, 4> kNode = {0.1834346424956498, 0.5255324099163290,
                                           0.7966664774136267, 0.9602898564975363};
  constexpr std::array<double, 4> kWeight = {0.3626837833783620, 0.3137066458778873,
                                             0.2223810344533745, 0.1012285362903763};
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0.0;
  for (std::size_t g = 0; g < kNode.size(); ++g) {
    sum += kWeight[g] * (norm(evaluate(piece, middle - half * kNode[g]).d1) +
                         norm(evaluate(piece, middle + half * kNode[g]).d1));
  }
  return half * sum;
}

}  // namespace

ContourLength::ContourLength(const Contour& contour) : contour_(contour) {
  cells_.reserve(kLengthCells * contour.pieces.size() + 1);
  double sum = 0.0;
  cells_.push_back(0.0);
  for (const Piece& piece : contour.pieces) {
    for (std::size_t c = 0; c < kLengthCells; ++c) {
      constexpr double kStep = 1.0 / static_cast<double>(kLengthCells);
      const auto from = static_cast<double>(c) * kStep;
      sum += length_between(piece, from, from + kStep);
      cells_.push_back(sum);
    }
  }
}

ContourLength::Place ContourLength::split(double place) const {
  const double last = static_cast<double>(contour_.pieces.size() - 1);
  const double piece = std::clamp(std::floor(place), 0.0, last);
  return {static_cast<std::size_t>(piece), place - piece};
}

double ContourLength::at(double place) const {
  const Place p = split(place);
  const auto cell = std::min(static_cast<std::size_t>(p.t * kLengthCells), kLengthCells - 1);
  const double from = static_cast<double>(cell) / kLengthCells;
  const double before = cells_[p.piece * kLengthCells + cell];
  return p.t > from ? before + length_between(contour_.pieces[p.piece], from, p.t) : before;
}

Element ContourLength::element(double place) const {
  const Place p = split(place);
  const auto joint = [&](std::size_t i) {
    return contour_.joints[i == contour_.joints.size() ? 0 : i].element;
  };
  const Element start = joint(p.piece);
  if (p.t == 0.0) return start;
  Element e = p.t == 1.0 ? joint(p.piece + 1) : element_at(contour_.pieces[p.piece], p.t);
  e.theta = start.theta + std::remainder(e.theta - start.theta, 2.0 * std::numbers::pi);
  return e;
}

Vec2 ContourLength::point(double place) const {
  const Place p = split(place);
  return evaluate(contour_.pieces[p.piece], p.t).point;
}

}  // namespace obvid::bsplines
