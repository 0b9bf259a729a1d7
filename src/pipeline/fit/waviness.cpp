// SPDX-License-Identifier: Apache-2.0
#include "fit/waviness.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace obvid::pipeline_detail {
namespace {

/// Equal steps of the parameter of each piece at whose ends the slope is taken (docs/claims.md).
constexpr int kSlopeSteps = 8;
/// The figure is told to this part of itself.
constexpr double kToldTo = 1e-3;
/// Second and third derivatives of coordinates of size 1 have an error of so many roundings at the
/// most: the binomial sums of degree 5 and their products. First derivatives have a tenth of them.
constexpr double kSlopeRoundings = 100.0 * 0x1p-53;
constexpr double kTangentRoundings = 10.0 * 0x1p-53;
/// Pieces between two questions whether to go on: some 2 ms.
constexpr std::size_t kPiecesBetweenQuestions = 1024;

/// The parameters at which the slope is taken: the first half's are seen from the start of the
/// piece, where coordinates beside it are small, the others from its end.
constexpr std::size_t kSlopePlaces = kSlopeSteps + 1;
constexpr std::array<double, kSlopePlaces> slope_places() {
  std::array<double, kSlopePlaces> out{};
  for (std::size_t k = 0; k < kSlopePlaces; ++k) out[k] = static_cast<double>(k) / kSlopeSteps;
  return out;
}

/// Sizes of a piece's control points, seen from one of its ends and in order from it.
using Sizes = std::array<double, kMaxBezierDegree + 1>;
Sizes sizes_from(const RationalBezier& piece, bool from_start) {
  Sizes out{};
  const auto last = static_cast<std::size_t>(piece.degree);
  const Vec2 end = piece.offset[from_start ? 0 : last];
  for (std::size_t j = 0; j <= last; ++j) {
    const std::size_t i = from_start ? j : last - j;
    out[j] = piece.weight[i] * norm(piece.offset[i] - end);
  }
  return out;
}

/// Sizes of the coordinates from whose differences the first three derivatives at a place are
/// made, `t` from the end they are seen from.
std::array<double, 3> coordinates_at(Sizes size, int degree, double t) {
  std::array<double, 3> out{};
  for (auto left = static_cast<std::size_t>(degree); left > 0; --left) {
    const auto kept = size.begin() + static_cast<std::ptrdiff_t>(left) + 1;
    if (left <= out.size()) out[left - 1] = *std::max_element(size.begin(), kept);
    for (std::size_t j = 0; j < left; ++j) size[j] = (1.0 - t) * size[j] + t * size[j + 1];
  }
  return out;
}

/// None of those is larger anywhere on the piece.
std::array<double, 3> largest_size(const Sizes& size) {
  const double largest = *std::max_element(size.begin(), size.end());
  return {largest, largest, largest};
}

struct Slope {
  double value = 0.0;
  double rounding = 0.0;  ///< bound of the value's error
};

/// The slope of curvature, (d1 x d3 / v^3 - 3 kappa d1 d2 / v^2) / v with v = |d1|: each derivative
/// is wrong by its roundings.
Slope slope_of(const std::array<double, 3>& size, const Jet& jet) {
  const double inverse = 1.0 / norm(jet.d1), cube = inverse * inverse * inverse;
  const Vec2 tangent = inverse * jet.d1, bend = inverse * jet.d2, third = inverse * jet.d3;
  const auto largest = [](Vec2 v) { return std::abs(v.x) + std::abs(v.y); };
  const double bends = largest(bend), thirds = largest(third);
  const double first = kTangentRoundings * size[0], second = kSlopeRoundings * size[1];
  return {
      (cross(tangent, third) - 3.0 * cross(tangent, bend) * dot(tangent, bend)) * inverse * inverse,
      (kSlopeRoundings * size[2] + 6.0 * bends * second + (thirds + 3.0 * bends * bends) * first) *
          cube};
}

/// What the sizes of coordinates are taken from: once for a piece, or dearer and closer at each
/// place.
enum class Bound { kOfPieces, kOfPlaces };

struct RunSlopes {
  double variation = 0.0, largest = 0.0, rounding = 0.0;

  [[nodiscard]] bool are_known() const {
    return largest > 0.0 && std::isfinite(variation) && rounding <= kToldTo * variation;
  }
};

RunSlopes slopes_of_run(const Contour& contour, std::size_t first, std::size_t last, Bound bound,
                        Watch& watch) {
  static constexpr std::array<double, kSlopePlaces> kAt = slope_places();
  RunSlopes out;
  std::array<Jet, kSlopePlaces> jets;
  double before = 0.0;
  const auto meet = [&](double slope) {
    out.variation += std::abs(slope - before);
    out.largest = std::max(out.largest, std::abs(slope));
    before = slope;
  };
  for (std::size_t i = first; i <= last; ++i) {
    if (i % kPiecesBetweenQuestions == 0 && watch.cancelled()) return {};
    const Piece& piece = contour.pieces[i % contour.pieces.size()];
    if (const auto* clothoid = std::get_if<ClothoidPiece>(&piece)) {  // exact where they are alike
      meet((clothoid->kappa1 - clothoid->kappa0) / clothoid->length);
      continue;
    }
    const auto* bezier = std::get_if<RationalBezier>(&piece);
    if (bezier == nullptr) {  // a line or an arc
      meet(0.0);
      continue;
    }
    evaluate(*bezier, kAt, jets);
    const std::array<Sizes, 2> sizes = {sizes_from(*bezier, true), sizes_from(*bezier, false)};
    const std::array<std::array<double, 3>, 2> largest = {largest_size(sizes[0]),
                                                          largest_size(sizes[1])};
    for (std::size_t k = 0; k < kSlopePlaces; ++k) {
      const std::size_t end = kAt[k] <= 0.5 ? 0 : 1;
      const Slope slope =
          slope_of(bound == Bound::kOfPieces
                       ? largest[end]
                       : coordinates_at(sizes[end], bezier->degree,
                                        end == 0 ? kAt[k] : 1.0 - kAt[k]),
                   jets[k]);
      meet(slope.value);
      out.rounding += 2.0 * slope.rounding;
    }
  }
  meet(0.0);
  return out;
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
  RunSlopes slopes = slopes_of_run(contour, first, last, Bound::kOfPieces, watch_);
  if (!slopes.are_known()) slopes = slopes_of_run(contour, first, last, Bound::kOfPlaces, watch_);
  known_ = known_ && slopes.are_known();
  hills_ += slopes.variation / (2.0 * slopes.largest);
  ++runs_;
}

std::optional<double> Waviness::value() const {
  if (!known_ || runs_ == 0) return std::nullopt;
  return hills_ / static_cast<double>(runs_);
}

std::optional<double> waviness(const Contour& contour, Watch& watch) {
  if (!promises_monotone(contour.carrier) || steps_at_joints(contour.carrier)) return std::nullopt;
  Waviness whole(watch);
  whole.add(contour, contour.closed && !contour.joints.empty() && !contour.joints.front().leaving);
  return whole.value();
}

}  // namespace obvid::pipeline_detail
