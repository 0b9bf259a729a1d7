// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <variant>
#include <vector>

#include "obvid/chain/internal/chain.h"
#include "obvid/contour/common/internal/carry.h"

// What builders of several families share.
namespace obvid::contour_detail {

/// A contour without pieces, of the points that the spirals have.
[[nodiscard]] Contour like(const Contour& spirals, Carrier carrier);

/// Element of a piece, its heading unwrapped to be near another one.
[[nodiscard]] Element element_near(const Piece& piece, double t, double theta);

/// What to do where a family cannot carry what is there.
inline constexpr const char* kOtherCarriers = "use --carrier spiral, arcs or clothoids";

/// An error about joint `index` of a section, told in points of the series.
[[nodiscard]] tl::unexpected<Error> at_point(Error error, const Contour& spirals,
                                             std::ptrdiff_t index, const char* hint);

/// What was given at the point on which a joint stands, if anything.
[[nodiscard]] const GivenDatum* given_at(const Joint& joint, const std::vector<GivenDatum>& given);

/// Lines and arcs only: every carrier of lines has the lines, ellipse arcs are circle arcs too. A
/// conic or polynomial of the same shape would have vertices by its rounding.
template <class... Kinds>
[[nodiscard]] bool only(const Contour& spirals) {
  return std::all_of(spirals.pieces.begin(), spirals.pieces.end(), [](const Piece& piece) {
    return (std::holds_alternative<Kinds>(piece) || ...);
  });
}

[[nodiscard]] Carried as_they_are(const Contour& spirals, Carrier carrier);

/// Pieces of one smooth curve; the joints between them are no points of the series.
void add_free_pieces(const std::vector<RationalBezier>& pieces, Contour& contour);

/// Circle or line over a chord: heading from chord and curvature, so that the arc ends on its end.
[[nodiscard]] Piece arc_over_chord(const LinkState& link, const Element& a, const Element& b);

}  // namespace obvid::contour_detail
