// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/whole_arcs.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "obvid/curve/internal/clothoid.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/numeric/internal/wide.h"

namespace obvid::exchange {
namespace {

/// Both as one, that goes on as the first does.
[[nodiscard]] ArcPiece together(const ArcPiece& first, const ArcPiece& second) {
  ArcPiece both = first;
  both.end = second.end;
  both.length += second.length;
  return both;
}

/// Whether one arc from the start of the first is both, and ends where the second does, but for
/// what rounding leaves of coordinates and directions: far from the origin that is more than of the
/// arcs themselves. Curvatures do not know how far that is.
[[nodiscard]] bool is_one_arc(const ArcPiece& first, const ArcPiece& second) {
  constexpr double kSameCircle = 1e-10;  // of the length: what offsetting makes of rounding
  constexpr double kRoundings = 8.0 * numeric::kUnitRoundoff;  // of coordinates
  const double length = second.length;
  const double room = kSameCircle * length + kRoundings * (norm(second.start) + norm(second.end));
  const ArcPiece both = together(first, second);
  const double step = first.theta0 + first.kappa * first.length - second.theta0;
  const double off = norm(first.end - second.start) + std::abs(principal_angle(step)) * length;
  const double missed = norm(clothoid_step(both.theta0, both.kappa, both.kappa, both.length) -
                             (both.end - both.start));
  const bool bent_alike = 0.5 * std::abs(first.kappa - second.kappa) * length <= kSameCircle;
  const double turn = std::abs(both.kappa) * both.length;
  return bent_alike && std::max(off, missed) <= room &&
         turn <= kFullTurn + std::abs(first.kappa) * room;
}

}  // namespace

std::vector<Piece> whole_arcs(const std::vector<Piece>& pieces) {
  std::vector<Piece> out;
  for (const Piece& piece : pieces) {
    auto* before = out.empty() ? nullptr : std::get_if<ArcPiece>(&out.back());
    const auto* behind = std::get_if<ArcPiece>(&piece);
    if (before == nullptr || behind == nullptr || !is_one_arc(*before, *behind)) {
      out.push_back(piece);
      continue;
    }
    *before = together(*before, *behind);
  }
  return out;
}

}  // namespace obvid::exchange
