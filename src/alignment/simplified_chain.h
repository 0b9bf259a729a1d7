// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "chain_on_points.h"
#include "mended.h"
#include "obvid/alignment/alignment.h"
#include "plane.h"

namespace obvid::alignment {

/// How elements were found that are to be made fewer and simpler.
struct BegunWith {
  bool rounded = false;  ///< chords with rounded corners, no search's
  bool others = false;   ///< other searches are to come
};

/// Part of the tolerances that elements have before transitions are put between those with a step
/// of the curvature.
inline constexpr double kBeforeTransitions = 0.9;

/// Elements of a search, fitted to the points, made fewer and of simpler kinds where these allow
/// it.
class SimplifiedChain {
 public:
  /// Of a closed alignment the last point is the first one again, a lap on. What is rounded goes
  /// around as it is, and has no such point.
  SimplifiedChain(TolerantPoints points, FootedChain begun, const AlignmentOptions& options,
                  const Sought& sought, const BegunWith& by, const RunContext& run);

  Result<void> run(const RunContext& run);
  /// The same around a loop: the ends of what was found are joined, and everything is tried once
  /// with the seam where the points begin and once with it half way around, where it is no other
  /// joint than the rest. At last the chain begins with the element of the first point.
  Result<void> run_around(const RunContext& run);

  [[nodiscard]] ChainOnPoints& on_points() { return chain_; }
  [[nodiscard]] const ChainOnPoints& on_points() const { return chain_; }
  /// Whether there are more elements around a loop than the open search had: with one more, at the
  /// most, where the points begin, it has as many as the loop.
  [[nodiscard]] bool has_more_than_open() const;
  /// Whether stretches of it are no elements of the search.
  [[nodiscard]] bool has_chords() const { return mended_ || by_.rounded; }
  [[nodiscard]] bool is_mended() const { return mended_; }

 private:
  Result<bool> may_lead_within(double most, const RunContext& run);
  Result<bool> mend(const RunContext& run);
  Result<bool> mend(const PointStretch& intervals, std::size_t before, const RunContext& run);
  Result<void> simplify_mended(const RunContext& run);
  Result<void> simplify(const RunContext& run);
  Result<void> simplify_at_each_seam(const RunContext& run);

  ChainOnPoints chain_;
  Transition transitions_ = Transition::kClothoid;
  bool without_steps_ = false;
  bool constant_ = false;  ///< curvature of each element
  bool limited_ = false;   ///< lengths or radii, as was asked for
  BegunWith by_;
  std::size_t begun_with_ = 0;  ///< elements
  bool mended_ = false;         ///< stretches are chords with rounded corners
};

}  // namespace obvid::alignment
