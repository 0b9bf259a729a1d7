// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/chain/internal/series_chain.h"
#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/curve/internal/runs.h"
#include "obvid/series/analysis.h"

namespace obvid::pipeline_detail {

/// Elements for every point: from the chain, or from the one circle or line that 2 or 3 points or
/// a wholly circular series determine.
[[nodiscard]] Result<SeriesChain> form_elements(const std::vector<Vec2>& points,
                                                const Analysis& analysis, const ChainWishes& wishes,
                                                Watch& watch);

/// Whether more than 3 points lie on one circle or line that has all that is given: to 1e-6 rad and
/// 1e-6 of the curvature, or to what the rounding of the coordinates leaves of it.
[[nodiscard]] bool is_one_circle(const std::vector<Vec2>& points, const Analysis& analysis,
                                 const ChainWishes& wishes);

/// Two or three points, which lie on one circle or line whatever curve was meant.
[[nodiscard]] bool is_few_on_one_circle(const std::vector<Vec2>& points, const Analysis& analysis);

/// Pieces over the elements: closed-form spirals, and arcs or lines over circular stretches.
/// Error E501 when a piece came out with a weight that is not positive.
[[nodiscard]] Result<Contour> form_spirals(const std::vector<Vec2>& points,
                                           const SeriesChain& chain);

/// Arcs in place of spirals: elements on each spiral piece as far apart as the tolerance allows,
/// two arcs between neighbours. A curvature given at an end is that of its arc. `loop`: the end is
/// the start, with one curvature. Error E502 when the
/// tolerance asks for too many arcs.
[[nodiscard]] Result<Contour> form_arcs(const Contour& spirals, double tolerance,
                                        const std::vector<GivenDatum>& given, bool loop,
                                        Watch& watch);

/// Clothoids over the elements, three to a link, and arcs or lines over circular stretches. Error
/// E501 when a link is carried by no such three.
[[nodiscard]] Result<Contour> form_clothoids(const std::vector<Vec2>& points,
                                             const SeriesChain& chain, Watch& watch);

/// A section in another carrier, and what is to be said about it.
struct Carried {
  Contour contour;
  std::vector<std::string> warnings;
};

/// Conics, headings freed so that all are monotone ellipse arcs: one to a link, or two, four, eight
/// where one does not do. Where no such headings are found, the chain over the given ones, with a
/// warning.
/// Headings that were given stay; of given curvatures one can be met, by the first weight.
/// Sections of lines and arcs only stay as they are. Errors: E401 where a link has no triangle
/// (inflections, lines), and for a closed contour without corners.
[[nodiscard]] Result<Carried> form_conics(const Contour& spirals,
                                          const std::vector<GivenDatum>& given);

/// Parabolas: every piece condensed until the region between their elements is as narrow as the
/// tolerance. Errors: E401 at inflections, arcs; E502.
[[nodiscard]] Result<Carried> form_beziers(const Contour& spirals, double tolerance, Watch& watch);

/// Monotone polynomial B-spline within the tolerance of the spirals; points that are no knots are
/// passed within it; those with given data are knots. Circular stretches stay arcs: no polynomial
/// is a circle. Errors: E405.
[[nodiscard]] Result<Carried> form_bspline(const Contour& spirals, double tolerance,
                                           const std::vector<GivenDatum>& given);

/// C2 cubic within the tolerance of the spirals; `loop`: continuous where the last joint is the
/// first again. Errors: E502.
[[nodiscard]] Result<Carried> form_cubic(const Contour& spirals, double tolerance, bool loop);

/// C2 cubic through the points (`source`: their indices), with headings (rad) at its ends where
/// they are given; the last point of a loop is the first again, and has no heading of its own.
[[nodiscard]] Result<Carried> form_baseline(const std::vector<Vec2>& points,
                                            const std::vector<std::size_t>& source, bool loop,
                                            std::optional<double> start_heading,
                                            std::optional<double> end_heading);

/// A piece of a drawing as it is, between two points of the series (`from`, `to`: their indices).
[[nodiscard]] Contour form_kept(const Piece& piece, const std::vector<Vec2>& points,
                                std::size_t from, std::size_t to);

/// Circle or line over a chord: heading from chord and curvature, so that the arc ends on its end.
[[nodiscard]] Piece arc_over_chord(const LinkState& link, const Element& a, const Element& b);

}  // namespace obvid::pipeline_detail
