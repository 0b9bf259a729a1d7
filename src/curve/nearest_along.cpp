// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/nearest_along.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "obvid/curve/internal/nearest.h"

namespace obvid {
namespace {

constexpr std::size_t kPlaces = 8;  // of a piece, that are looked at for its nearest one
constexpr double kRecord = 1.01;    // of the farthest before
/// Roundings of a coordinate by which another place is not nearer: a closed path is at its seam
/// twice.
constexpr double kSamePlace = 64.0 * std::numeric_limits<double>::epsilon();

double place_parameter(std::size_t k) { return (static_cast<double>(k) + 0.5) / kPlaces; }

}  // namespace

NearestAlong::NearestAlong(std::span<const Piece> path) : path_(path) {
  places_.reserve(path.size() * kPlaces);
  for (const Piece& piece : path) {
    Vec2 before = evaluate(piece, 0.0).point;
    double apart = 0.0;
    for (std::size_t k = 0; k < kPlaces; ++k) {
      places_.push_back(evaluate(piece, place_parameter(k)).point);
      apart = std::max(apart, norm(places_.back() - before));
      before = places_.back();
    }
    apart_.push_back(std::max(apart, norm(evaluate(piece, 1.0).point - before)));
  }
}

NearestAlong::Place NearestAlong::next(Vec2 p, double known) {
  const double away = distance(p, known);
  return {at_, t_, away};
}

double NearestAlong::distance(Vec2 p, double known) {
  double here = settle(at_, t_, p);
  while (t_ == 1.0 && at_ + 1 < path_.size() && step_to(at_ + 1, 0.0, p, here)) {
  }
  while (t_ == 0.0 && at_ > 0 && step_to(at_ - 1, 1.0, p, here)) {
  }
  if (here <= known) return here;
  while (at_ + 1 < path_.size() && improve(at_ + 1, 0.0, p, here)) {
  }
  while (at_ > 0 && improve(at_ - 1, 1.0, p, here)) {
  }
  if (here <= kRecord * farthest_) return here;
  look_everywhere(p, here);
  farthest_ = std::max(farthest_, here);
  return here;
}

/// From every place that may lead nearer, by more than rounding: a sharp turn may lie inside of a
/// piece.
void NearestAlong::look_everywhere(Vec2 p, double& here) {
  const double same = kSamePlace * std::max(std::abs(p.x), std::abs(p.y));
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const std::size_t piece = i / kPlaces;
    if (norm(places_[i] - p) - apart_[piece] >= here - same) continue;
    double t = place_parameter(i % kPlaces);
    const double there = settle(piece, t, p);
    if (there >= here - same) continue;
    here = there;
    at_ = piece;
    t_ = t;
  }
}

double NearestAlong::settle(std::size_t piece, double& t, Vec2 p) const {
  t = nearest_parameter(path_[piece], p, t);
  return norm(evaluate(path_[piece], t).point - p);
}

/// Goes on to a neighbour that is not farther.
bool NearestAlong::step_to(std::size_t piece, double t, Vec2 p, double& here) {
  const double there = settle(piece, t, p);
  if (there > here) return false;
  here = there;
  at_ = piece;
  t_ = t;
  return true;
}

bool NearestAlong::improve(std::size_t piece, double t, Vec2 p, double& here) {
  const double before = here;
  return step_to(piece, t, p, here) && here < before;
}

}  // namespace obvid
