// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/contour.h"

#include <cmath>
#include <numbers>

namespace obvid {

bool is_corner(const Joint& joint) {
  if (!joint.leaving) return false;
  const double turn = joint.leaving->theta - joint.element.theta;
  return !(std::abs(std::remainder(turn, 2.0 * std::numbers::pi)) <= kTangentTurn);
}

const char* to_string(Carrier carrier) {
  switch (carrier) {
    case Carrier::kArcs:
      return "arcs";
    case Carrier::kConics:
      return "conics";
    case Carrier::kBeziers:
      return "beziers";
    case Carrier::kClothoids:
      return "clothoids";
    case Carrier::kBspline:
      return "bspline";
    case Carrier::kCubic:
      return "cubic";
    case Carrier::kBaseline:
      return "baseline";
    case Carrier::kSpiral:
      break;
  }
  return "spiral";
}

std::optional<Carrier> carrier_of(std::string_view name) {
  for (const Carrier carrier : kAllCarriers) {
    if (name == to_string(carrier)) return carrier;
  }
  return std::nullopt;
}

namespace {

/// Whether piece `i` goes on with the arc or ellipse of the piece before it.
bool goes_on(const Contour& contour, std::size_t i) {
  constexpr double kSame = 1e-9;  // of the curvature
  const Piece &before = contour.pieces[i - 1], &piece = contour.pieces[i];
  if (i < contour.joints.size() && contour.joints[i].leaving) return false;
  if (std::holds_alternative<RationalBezier>(piece)) {
    return std::holds_alternative<RationalBezier>(before);
  }
  const auto *a = std::get_if<ArcPiece>(&before), *b = std::get_if<ArcPiece>(&piece);
  return a != nullptr && b != nullptr &&
         std::abs(a->kappa - b->kappa) <= kSame * std::abs(b->kappa);
}

}  // namespace

KeptPieces kept_pieces(const Contour& contour) {
  KeptPieces out;
  std::size_t before = contour.pieces.size();
  for (const std::size_t i : contour.kept) {
    const bool more = before + 1 == i && goes_on(contour, i);
    before = i;
    if (more) continue;
    const Piece& piece = contour.pieces[i];
    if (std::holds_alternative<LinePiece>(piece)) ++out.lines;
    if (std::holds_alternative<ArcPiece>(piece)) ++out.arcs;
    if (std::holds_alternative<RationalBezier>(piece)) ++out.ellipses;
    if (std::holds_alternative<ClothoidPiece>(piece)) ++out.clothoids;
  }
  return out;
}

}  // namespace obvid
