// SPDX-License-Identifier: Apache-2.0
#include "waviness.h"

#include <algorithm>
#include <cmath>

namespace obvid::pipeline_detail {
namespace {

/// Equal steps of the parameter of each piece at whose ends the slope is taken (docs/claims.md).
constexpr int kSlopeSteps = 8;
/// The figure is told to this part of itself.
constexpr double kToldTo = 1e-3;
/// Third derivatives of coordinates of size 1 have an error of so many roundings at the most: the
/// binomial sums of degree 5 and their products.
constexpr double kSlopeRoundings = 100.0 * 0x1p-53;

/// A piece seen from its own start, where its coordinates are as small as it is.
Piece seen_from_start(const Piece& piece) {
  const auto* bezier = std::get_if<RationalBezier>(&piece);
  if (bezier == nullptr) return piece;
  RationalBezier local = *bezier;
  const Vec2 start = local.offset[0];
  local.origin = {};
  for (int j = 0; j <= local.degree; ++j) {
    Vec2& offset = local.offset[static_cast<std::size_t>(j)];
    offset = offset - start;
  }
  return local;
}

/// Size of the coordinates of a piece that is seen from its own start.
double coordinates_of(const Piece& piece) {
  const auto* bezier = std::get_if<RationalBezier>(&piece);
  if (bezier == nullptr) return 0.0;
  double largest = 0.0;
  for (int j = 1; j <= bezier->degree; ++j) {
    largest = std::max(largest, norm(bezier->offset[static_cast<std::size_t>(j)]));
  }
  return largest;
}

}  // namespace

void Waviness::add(const Contour& contour, bool loop) {
  if (contour.runs.empty()) return;
  const std::size_t n = contour.pieces.size();
  const Run &first = contour.runs.front(), &last = contour.runs.back();
  const auto strange = [n](const Run& run) {
    return run.last_piece >= n || run.first_piece > run.last_piece;
  };
  if (std::any_of(contour.runs.begin(), contour.runs.end(), strange)) {  // of a file
    known_ = false;
    return;
  }
  const bool wraps = loop && contour.runs.size() > 1 && first.direction == last.direction;
  for (const Run& run : contour.runs) {
    if (run.direction == 0 || (wraps && run.first_piece == 0)) continue;
    const bool over_seam = wraps && run.last_piece + 1 == n;
    add_run(contour, run.first_piece, over_seam ? n + first.last_piece : run.last_piece);
  }
}

/// Pieces are counted on around the contour.
void Waviness::add_run(const Contour& contour, std::size_t first, std::size_t last) {
  double variation = 0.0, largest = 0.0, rounding = 0.0, before = 0.0;
  const auto meet = [&](double slope) {
    variation += std::abs(slope - before);
    largest = std::max(largest, std::abs(slope));
    before = slope;
  };
  for (std::size_t i = first; i <= last; ++i) {
    const Piece& piece = contour.pieces[i % contour.pieces.size()];
    if (const auto* clothoid = std::get_if<ClothoidPiece>(&piece)) {  // exact where they are alike
      meet((clothoid->kappa1 - clothoid->kappa0) / clothoid->length);
      continue;
    }
    const Piece local = seen_from_start(piece);
    const double size = coordinates_of(local);
    for (int k = 0; k <= kSlopeSteps; ++k) {
      const Jet jet = evaluate(local, static_cast<double>(k) / kSlopeSteps);
      meet(curvature_rate(jet));
      const double speed = norm(jet.d1);
      rounding += 2.0 * kSlopeRoundings * size / (speed * speed * speed);
    }
  }
  meet(0.0);
  known_ = known_ && largest > 0.0 && std::isfinite(variation) && rounding <= kToldTo * variation;
  hills_ += variation / (2.0 * largest);
  ++runs_;
}

std::optional<double> Waviness::value() const {
  if (!known_ || runs_ == 0) return std::nullopt;
  return hills_ / static_cast<double>(runs_);
}

std::optional<double> waviness(const Contour& contour) {
  if (!promises_monotone(contour.carrier) || contour.carrier == Carrier::kArcs) return std::nullopt;
  Waviness whole;
  whole.add(contour, contour.closed && !contour.joints.empty() && !contour.joints.front().leaving);
  return whole.value();
}

}  // namespace obvid::pipeline_detail
