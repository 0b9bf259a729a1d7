// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/pieces.h"
#include "obvid/geom/element.h"

namespace obvid {

/// Four parabolas that replace one link.
struct Condensation {
  std::array<RationalBezier, 4> parabolas;  ///< quadratic, origin at the start of the link
  double cut = 0.0;    ///< where the first tangent cuts the triangle's sides, 0 at its ends
  double shift = 0.0;  ///< d of [001]: of the point of contact from the middle of that tangent
  double k1 = 0.0, k2 = 0.0;  ///< factors by which the second cuts change the radii of the two new
                              ///< triangles: k1 and k2 of [001]
  double margin = 0.0;        ///< of the tightest parabola: a.b / |a|^2 - 1, a its shorter leg; > 0
};

/// The condensation of [001]: a tangent parallel to the chord cuts the triangle of chord and end
/// tangents in two, its point of contact is shifted so that both can meet the given curvatures, and
/// a second cut of each makes them do so. The chain meets both elements, is continuous in curvature
/// and each parabola has monotone curvature (Sapidis, Frey, "Controlling the curvature of a
/// quadratic Bezier curve", 1992), all in the same direction. `direction` +1: signed curvature
/// increases. The place of the first cut is chosen for the largest margin.
///
/// Points met exactly, headings and curvatures to rounding. Nothing when the data are no convex
/// spiral link that turns by less than half a turn, or when no such cut gives monotone parabolas:
/// a parabola of turning `theta` changes its radius at least by the factor `cos(theta)^-3`, so the
/// link must be short where curvature changes little (docs/methods/beziers.md, section 3).
[[nodiscard]] std::optional<Condensation> condense(const Element& start, const Element& end,
                                                   int direction);

/// A chain of parabolas in place of one piece of a spiral.
struct ParabolaChain {
  std::vector<RationalBezier> parabolas;
  std::vector<double> at;  ///< parameters on the piece whose elements are met, 0 and 1 included
  double width = 0.0;  ///< widest region between those elements: bounds the distance between the
                       ///< chain and the piece
};

/// Replaces a convex piece with monotone curvature by parabolas: elements are taken on it, halving
/// its parameter, until every link can be condensed and its region is at most `tolerance` wide.
/// Errors: E401 when curvature is zero or changes sign on the piece (no parabola has an
/// inflection); E502 when halving does not get there (`value`: width or 0), which is what happens
/// where curvature hardly changes.
[[nodiscard]] Result<ParabolaChain> condense_piece(const Piece& piece, int direction,
                                                   double tolerance);

/// The same with the elements that the piece joins, where they are known: its own have their
/// curvatures to rounding only, 1e-5 of them where the curvature leaps in the last 1e-6 of a piece.
[[nodiscard]] Result<ParabolaChain> condense_piece(const Piece& piece, const Element& start,
                                                   const Element& end, int direction,
                                                   double tolerance);

/// Signed curvatures for points with given headings (rad), order of fixation 1: at an inner point
/// the geometric mean of what the parabolas of both neighbouring triangles have there; the ends lie
/// beyond their triangle's by as much as their neighbours do. `closed`: the last point is the first
/// one again, and its mean goes round. Nothing at a point where a triangle is missing or both turn
/// different ways. They need not change in one way: `central_data` takes them where a spiral has
/// them. At least two points, one heading for each.
[[nodiscard]] std::vector<std::optional<double>> curvatures_of_triangles(
    const std::vector<Vec2>& points, const std::vector<double>& headings, bool closed = false);

}  // namespace obvid
