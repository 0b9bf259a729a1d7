// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/chain/series_chain.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/series/analysis.h"

namespace obvid::pipeline_detail {

/// Elements for every point: from the chain, or from the one circle or line that 2 or 3 points or
/// a wholly circular series determine.
[[nodiscard]] Result<SeriesChain> form_elements(const std::vector<Vec2>& points,
                                                const Analysis& analysis,
                                                const ChainWishes& wishes);

/// Pieces over the elements: closed-form spirals, and arcs or lines over circular stretches.
/// Error E501 when a piece came out with a weight that is not positive.
[[nodiscard]] Result<Contour> form_spirals(const std::vector<Vec2>& points,
                                           const SeriesChain& chain);

/// Arcs in place of spirals: elements on each spiral piece as far apart as the tolerance allows,
/// two arcs between neighbours. Error E502 when the tolerance asks for too many arcs.
[[nodiscard]] Result<Contour> form_arcs(const Contour& spirals, double tolerance);

/// Clothoids over the elements, three to a link, and arcs or lines over circular stretches. Error
/// E501 when a link is carried by no such three.
[[nodiscard]] Result<Contour> form_clothoids(const std::vector<Vec2>& points,
                                             const SeriesChain& chain);

/// Circle or line over a chord: heading from chord and curvature, so that the arc ends on its end.
[[nodiscard]] Piece arc_over_chord(const LinkState& link, const Element& a, const Element& b);

/// Runs of a contour from the direction of each piece.
[[nodiscard]] std::vector<Run> collect_runs(const std::vector<int>& direction);

/// Direction of every piece: its run's.
[[nodiscard]] std::vector<int> piece_directions(const Contour& contour);

}  // namespace obvid::pipeline_detail
