// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/chain/internal/series_chain.h"

namespace obvid::chain_detail {

/// A series with elements inserted between its points, and the problem of its chain.
struct Extended {
  std::vector<Vec2> points;
  std::vector<Element> start;
  std::vector<std::optional<std::size_t>> source;
  ChainProblem problem;
  std::vector<bool> turned;  ///< links whose direction was turned
  /// Least part of B - A that a sigma may be: below it the curvature leaps.
  double least_sigma = 1e-3;
};

/// The usual limits, with somebody who counts.
[[nodiscard]] inline ChainOptions watched(Watch& watch) {
  ChainOptions out;
  out.watch = &watch;
  return out;
}

/// Links solved beyond the ones in question, when only a neighbourhood is looked at.
inline constexpr std::size_t kWindow = 4;

/// Puts a free element into every link that one closed-form piece cannot carry well.
[[nodiscard]] Extended with_free_elements(const Extended& before, const ChainSolution& solution);

/// Links from..to of a series as a series of their own, with the cones of mere existence.
[[nodiscard]] Extended slice(const Extended& series, std::size_t from, std::size_t to);

/// Index of the worst link whose curvature leaps, its sigma below `least` of its B - A, or nothing.
[[nodiscard]] std::optional<std::size_t> leaping_link(const ChainProblem& problem,
                                                      const ChainSolution& solution, double least);

/// All cones with room, by the true cone of the closed form, and no leaps.
[[nodiscard]] bool carried(const ChainProblem& problem, const ChainSolution& solution,
                           double least_sigma);

/// The chain's outcome for the caller.
[[nodiscard]] SeriesChain collect(const Extended& e, ChainSolution solution, int steps);

}  // namespace obvid::chain_detail
