// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/chain/internal/chain.h"
#include "obvid/chain/internal/spiral_shape.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// What the designer asks of the whole chain, beyond the data at single points.
struct ChainConstraints {
  std::vector<FixedData> fixed;  ///< empty, or one entry per point
  bool convex = false;           ///< no inflection anywhere
  bool least_change = false;     ///< as `ChainProblem` has it
  bool central = false;          ///< each heading and curvature in the middle of what is left to it
  bool to_the_edge = false;  ///< what is fixed is what somebody asked for: it is met as far as a
                             ///< proof reaches, however unevenly the curvature then changes
};

/// Elements of a whole series, with free elements between its points where one closed-form
/// piece cannot carry a link.
struct SeriesChain {
  std::vector<Element> elements;
  std::vector<std::optional<std::size_t>> source;  ///< point index, or nothing for free elements
  std::vector<LinkState> links;
  std::vector<std::int8_t> direction;
  std::vector<Cone> cone;        ///< kClosedForm, or kNone inside circular stretches
  std::vector<SpiralForm> form;  ///< of each link; empty: kOneSided everywhere
  bool smooth = false;           ///< slopes of curvature were made equal (`smooth_slopes`)
  std::vector<bool> slope_step;  ///< then: elements at which the slope still steps
  std::vector<NodeData> nodes;   ///< what was given at the elements; empty: nothing
  std::size_t free_elements = 0;
  int newton_steps = 0;
  double smallest_margin = 0.0;
  bool converged = false;
  std::size_t turned_directions = 0;  ///< links that run against their adjacent circles
  bool unforced_inflection = false;   ///< an inflection was needed that the adjacent circles hide
};

/// The problem that `choose_elements` solves first: directions and cones from the analysis, given
/// data and the data of circular stretches fixed. Error E403 when constraints contradict the
/// points.
[[nodiscard]] Result<ChainProblem> chain_problem(const Analysis& analysis,
                                                 const ChainConstraints& constraints);

/// Chooses headings and curvatures for a series of at least 4 points (fewer are one circle):
/// first with the closed form's cones; where those have no solution, with the cones of mere
/// existence and a free element in every link that one piece cannot carry. Monotone adjacent
/// circles do not suffice for a spiral: where none exists, directions of single links are turned
/// (series of up to 5,000 points), which moves a vertex or adds two, and is reported.
/// Errors: E401 no such spiral runs through the points; E403 fixed data contradict the points or
/// each other; E404 a straight or circular stretch leaves no room for a transition; E405 the
/// rounding of the coordinates decides.
/// Where directions have to be turned that search ends after a number of steps that grows with the
/// points; the error says so.
[[nodiscard]] Result<SeriesChain> choose_elements(const std::vector<Vec2>& points,
                                                  const Analysis& analysis,
                                                  const ChainConstraints& constraints,
                                                  Watch& watch);

/// Nodes with the direction of every link already chosen.
struct DirectedSeries {
  std::vector<Vec2> points;                        ///< n nodes
  std::vector<std::optional<std::size_t>> source;  ///< n
  std::vector<std::int8_t> direction;              ///< n - 1; 0: arc or line, its ends given
  std::vector<NodeData> nodes;                     ///< n
  std::vector<Element> start;                      ///< n: headings and curvatures to begin with
  bool to_the_edge = false;                        ///< as `ChainConstraints` has it
};

/// Elements for nodes whose directions are known (from a fairing, or one turn of a closed series).
/// The given headings and curvatures are kept where they lie inside the cones of existence;
/// otherwise all are chosen again. No direction is turned. Errors: E401, naming nodes.
[[nodiscard]] Result<SeriesChain> follow_directions(DirectedSeries series, Watch& watch);

/// The free element of a link for which a spiral exists but one closed-form piece does not: close
/// to the joint of the middle biarc, such that both halves lie inside the closed form's cone.
[[nodiscard]] Element free_element(const LinkState& link, int direction, Vec2 start);

/// A free element for a link over which the curvature leaps at one end and rests else, so sharply
/// that doubles do not hold it in one piece: behind the leap, three times as far from that end as
/// the first arc of the middle biarc is long. Behind it the link hardly changes its curvature.
[[nodiscard]] Element element_beyond_leap(const LinkState& link, int direction, Vec2 start);

}  // namespace obvid
