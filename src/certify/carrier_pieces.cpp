// SPDX-License-Identifier: Apache-2.0
#include "obvid/certify/internal/carrier_pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "double_double.h"

namespace obvid {
namespace {

bool has_equal_weights(const RationalBezier& piece) {
  const auto count = static_cast<std::ptrdiff_t>(piece.degree) + 1;
  return std::all_of(piece.weight.begin(), piece.weight.begin() + count,
                     [&](double w) { return w == piece.weight[0]; });
}

/// w1^2 < w0 w2, exactly, once the weights are scaled: an arc of an ellipse.
bool is_ellipse(const RationalBezier& piece) {
  const double scale = 1.0 / std::max({piece.weight[0], piece.weight[1], piece.weight[2]});
  const std::array<double, 3> w = {scale * piece.weight[0], scale * piece.weight[1],
                                   scale * piece.weight[2]};
  const DoubleDouble square = two_product(w[1], w[1]), ends = two_product(w[0], w[2]);
  return square.hi != ends.hi ? square.hi < ends.hi : square.lo < ends.lo;
}

std::string name_of(const Piece& piece) {
  struct Names {
    std::string operator()(const LinePiece&) const { return "a line"; }
    std::string operator()(const ArcPiece&) const { return "an arc"; }
    std::string operator()(const ClothoidPiece&) const { return "a clothoid"; }
    std::string operator()(const RationalBezier& b) const {
      return fmt::format("a {} of degree {}",
                         has_equal_weights(b) ? "polynomial" : "rational curve", b.degree);
    }
  };
  return std::visit(Names{}, piece);
}

/// In closed form but for what keeps the digits of curvature at joints (curve/end_curvatures.h).
bool belongs(const CarrierPieces& pieces, const RationalBezier& bezier) {
  if (pieces.degree == kAnyDegree) return true;
  if (bezier.degree != pieces.degree) return false;
  if (pieces.weights == CarrierWeights::kAny) return true;
  return has_equal_weights(bezier) == (pieces.weights == CarrierWeights::kEqual);
}

bool belongs(const CarrierPieces& pieces, const Piece& piece) {
  if (std::holds_alternative<LinePiece>(piece)) return pieces.lines;
  if (std::holds_alternative<ArcPiece>(piece)) return pieces.arcs;
  if (std::holds_alternative<ClothoidPiece>(piece)) return pieces.clothoids;
  return belongs(pieces, std::get<RationalBezier>(piece));
}

/// What drawings draw and contours take over, whatever their carrier is.
bool is_drawn(const Piece& piece) {
  const auto* bezier = std::get_if<RationalBezier>(&piece);
  return bezier == nullptr || (bezier->degree == 2 && is_ellipse(*bezier));
}
constexpr const char* kDrawn = "lines, arcs, ellipse arcs and clothoids";

}  // namespace

std::optional<ForeignPiece> foreign_piece(const Contour& contour) {
  const CarrierPieces& kinds = info_of(contour.carrier).pieces;
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    const bool kept = std::binary_search(contour.kept.begin(), contour.kept.end(), i);
    if (kept ? is_drawn(contour.pieces[i]) : belongs(kinds, contour.pieces[i])) continue;
    const std::string what = name_of(contour.pieces[i]);
    if (kept) return ForeignPiece{i, fmt::format("drawings have {}, not {}", kDrawn, what)};
    return ForeignPiece{
        i, fmt::format("carrier {} has {}, not {}", to_string(contour.carrier), kinds.text, what)};
  }
  return std::nullopt;
}

bool keeps_foreign_pieces(const Contour& contour) {
  const CarrierPieces& kinds = info_of(contour.carrier).pieces;
  return std::any_of(contour.kept.begin(), contour.kept.end(), [&](std::size_t i) {
    return i < contour.pieces.size() && !belongs(kinds, contour.pieces[i]);
  });
}

}  // namespace obvid
