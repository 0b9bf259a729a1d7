// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "chain_of_elements.h"
#include "obvid/alignment/alignment.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"

namespace obvid::alignment {

/// Elements through points, in coordinates from `origin` on, with the foot of each point.
struct FoundChain {
  Vec2 origin;
  Chain chain;
  std::vector<Foot> feet;
  double found_within = 1.0;  ///< those of `Alignment`
  bool has_chords = false;
};

/// The fewest elements found (`fewest_pieces`), fitted, made one where the points allow it, and of
/// the simplest kinds that do. Every offset is at most its tolerance; least lengths and radii are
/// those of `options` but for what `fit_alignment` checks. Errors: those of `fit_alignment`.
[[nodiscard]] Result<FoundChain> find_chain(const std::vector<Vec2>& points,
                                            const std::vector<double>& tolerance,
                                            const AlignmentOptions& options, const Sought& sought,
                                            const RunContext& run);

}  // namespace obvid::alignment
