// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "obvid/chain/internal/series_chain.h"
#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/region/internal/feasible_data.h"
#include "obvid/series/analysis.h"

namespace obvid::pipeline_detail {

/// What every point of an open series may have while the curvature changes as its adjacent circles
/// say and all other constraints stay: the curves among which `form_elements` chooses before it
/// turns a direction. Error: E403 as `chain_problem` has it.
[[nodiscard]] Result<std::vector<FeasibleData>> series_ranges(const Analysis& analysis,
                                                              const ChainConstraints& constraints);

/// The least curvature (unsigned, 1/unit) that no point of an open series need exceed, good to a
/// thousandth of it and rounded upward, while all constraints stay. Nothing where they leave no
/// curve.
[[nodiscard]] std::optional<double> least_largest_curvature(const Analysis& analysis,
                                                            const ChainConstraints& constraints,
                                                            Watch& watch);

/// The same around a closed series, each point of it once.
[[nodiscard]] std::optional<double> least_largest_curvature_of_loop(
    const std::vector<Vec2>& points, const ChainConstraints& constraints, Watch& watch);

/// One turn of a closed series as the neighbours on both sides of its seam make it.
struct LoopProblem {
  std::vector<std::int8_t> direction;  ///< one per point: of the chord behind it
  std::vector<NodeData> nodes;         ///< given data, those of circular stretches, and signs
  std::vector<double> adjacent_kappa;  ///< of the adjacent circles
  std::vector<RangeLink> links;        ///< the same for `central_loop`
  std::vector<RangeNode> range_nodes;
};

/// `points` and `constraints.fixed` have each point once. Errors: those of `analyse` and
/// `chain_problem`, points numbered along more than one turn.
[[nodiscard]] Result<LoopProblem> loop_problem(const std::vector<Vec2>& points,
                                               const ChainConstraints& constraints);

/// Elements in the middle of these ranges (`central_data`), joined by spirals with the directions
/// of the analysis. Nothing when there are none, or when rounding leaves no room for them.
[[nodiscard]] std::optional<SeriesChain> central_chain(const std::vector<Vec2>& points,
                                                       const Analysis& analysis,
                                                       const ChainConstraints& constraints,
                                                       ChoiceOrder order, Watch& watch);

/// The same around a closed series (`central_loop`): one turn, whose last element is the first one
/// again.
[[nodiscard]] std::optional<SeriesChain> central_chain_of_loop(const std::vector<Vec2>& points,
                                                               const ChainConstraints& constraints,
                                                               Watch& watch);

}  // namespace obvid::pipeline_detail
