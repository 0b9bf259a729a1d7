// SPDX-License-Identifier: Apache-2.0
#include "monotone_parts.h"

#include "piece_facts.h"

namespace obvid {
namespace {

/// Closer vertices than 2^-10 of the parameter are counted as one pair or none. Of shorter parts
/// the rounding of the control points decides how the curvature changes: it enters with the third
/// power.
constexpr int kMostHalvings = 10;

/// Parts of one piece that are looked at: enough for the vertices of a septic, and an end to the
/// work on pieces that doubles cannot decide anywhere.
constexpr int kMostPartsOfPiece = 256;

/// Seen from its own start, so that only the digits of its shape are rounded.
RationalBezier seen_from_start(RationalBezier piece) {
  const Vec2 start = piece.offset[0];
  piece.origin = {};
  for (int j = 0; j <= piece.degree; ++j) {
    const auto k = static_cast<std::size_t>(j);
    piece.offset[k] = piece.offset[k] - start;
  }
  return piece;
}

void halve(const RationalBezier& part, int halvings, int& parts_left,
           std::vector<RationalBezier>& out) {
  const PieceFacts facts = examine_in_doubles(part);
  // what doubles cannot decide (a vertex at an end, a flat piece) is halved too
  if (halvings == 0 || parts_left-- <= 0 || facts.first_change * facts.last_change > 0) {
    out.push_back(part);
    return;
  }
  for (const RationalBezier& half : split(part, 0.5)) halve(half, halvings - 1, parts_left, out);
}

}  // namespace

std::vector<RationalBezier> monotone_parts(const RationalBezier& piece) {
  std::vector<RationalBezier> parts;
  int parts_left = kMostPartsOfPiece;
  halve(seen_from_start(piece), kMostHalvings, parts_left, parts);
  return parts;
}

}  // namespace obvid
