// SPDX-License-Identifier: Apache-2.0
#include "simplified_chain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "fewer_elements.h"
#include "fewest_pieces.h"
#include "put_transitions.h"
#include "simpler_kinds.h"

namespace obvid::alignment {
namespace {

constexpr double kLeastLength = 0.25;  ///< of the mean distance of points: elements get no shorter
/// Of the shortest element where corners are rounded: likewise.
constexpr double kOfShortest = 0.5;
constexpr int kPasses = 12;      ///< over all conditions
constexpr int kPassesAlike = 4;  ///< where the points show none to be wrong
/// Intervals of points beside those that are passed otherwise than they may be that become chords
/// with them, one number after the other until that does.
constexpr std::array<std::size_t, 4> kMendedBeside = {0, 1, 3, 7};
/// Of the intervals: where more are passed otherwise than they may be, another search does better.
constexpr double kMostMended = 0.1;

[[nodiscard]] std::size_t number_of(const std::vector<bool>& bad) {
  return static_cast<std::size_t>(std::count(bad.begin(), bad.end(), true));
}

[[nodiscard]] double shortest_of(const Chain& chain) {
  return *std::min_element(chain.length.begin(), chain.length.end());
}

ElementLimits limits_of(const TolerantPoints& row, const Chain& chain,
                        const AlignmentOptions& options, const Sought& sought, bool rounded) {
  ElementLimits out;
  double length = 0.0;
  for (std::size_t i = 1; i < row.points.size(); ++i) {
    const Vec2 chord = row.points[i] - row.points[i - 1];
    length += chain.plane == Plane::kMap ? norm(chord) : chord.x;
  }
  double least = kLeastLength * length / static_cast<double>(row.points.size() - 1);
  if (sought.rounded) {
    out.grades = BorneGrades(row.points, row.tolerance, sought.lap.x);
  } else if (sought.corners) {
    out.grades = grades_borne_by(row.points, row.tolerance, sought);
  }
  // what rounds a corner is as short as the tolerance makes it
  if (sought.corners || rounded) least = std::min(least, kOfShortest * shortest_of(chain));
  out.least_length = std::max(least, options.least_length);
  if (options.least_radius > 0.0) out.largest_curvature = 1.0 / options.least_radius;
  return out;
}

ChainOnPoints begun_along(TolerantPoints points, FootedChain begun, const AlignmentOptions& options,
                          const Sought& sought, bool rounded, const RunContext& run) {
  ElementLimits limits = limits_of(points, begun.chain, options, sought, rounded);
  const bool closed = rounded && options.closed;  // these go around already
  return {std::move(points), std::move(begun), closed, std::move(limits), run.cancelled};
}

}  // namespace

SimplifiedChain::SimplifiedChain(TolerantPoints points, FootedChain begun,
                                 const AlignmentOptions& options, const Sought& sought,
                                 const BegunWith& by, const RunContext& run)
    : chain_(begun_along(std::move(points), std::move(begun), options, sought, by.rounded, run)),
      transitions_(options.transitions),
      without_steps_(options.without_steps && !sought.constant),
      constant_(sought.constant),
      limited_(options.least_length > 0.0 || options.least_radius > 0.0),
      by_(by),
      begun_with_(chain_.size()) {
  if (without_steps_) chain_.narrow_tolerances(kBeforeTransitions);
}

bool SimplifiedChain::has_more_than_open() const {
  return chain_.closed() && chain_.size() > begun_with_;
}

Result<void> SimplifiedChain::run(const RunContext& run) {
  const std::vector<Element> joints = chain_.chain().joints();  // of the search: points are there
  chain_.limit_curvatures();
  if (!by_.rounded) OBVID_TRY(chain_.polish(run, &joints));  // what is rounded passes the points
  if (by_.others) OBVID_TRY(chain_.polish_to_tolerance(run));
  const auto goes_on = may_lead_within(1.0, run);
  OBVID_TRY(goes_on);
  if (!*goes_on) return {};
  OBVID_TRY(simplify(run));
  OBVID_TRY(simplify_mended(run));
  chain_.straighten();
  if (!without_steps_) return {};
  chain_.widen_tolerances(kBeforeTransitions);
  return take_steps_away(chain_, transitions_, run);
}

Result<void> SimplifiedChain::run_around(const RunContext& run) {
  const std::vector<Element> joints = chain_.chain().joints();
  chain_.limit_curvatures();
  if (!by_.rounded) {
    OBVID_TRY(chain_.polish(run, &joints));
    auto goes_on = may_lead_within(kNoWayBack, run);
    OBVID_TRY(goes_on);
    if (!*goes_on) return {};
    OBVID_TRY(close_loop(chain_, constant_, run));
    if (by_.others) OBVID_TRY(chain_.polish_to_tolerance(run));
    goes_on = may_lead_within(1.0, run);
    OBVID_TRY(goes_on);
    if (!*goes_on) return {};
  }
  for (int turn = 0; turn < 2; ++turn) {
    OBVID_TRY(simplify(run));
    chain_.turn_to(chain_.size() / 2);
  }
  OBVID_TRY(simplify_at_each_seam(run));
  OBVID_TRY(simplify_mended(run));
  OBVID_TRY(take_fewer_elements(chain_, constant_, run));
  chain_.turn_to_first_given();
  if (chain_.largest() > 1.0) OBVID_TRY(chain_.polish(run));
  chain_.straighten();
  if (!without_steps_) return {};
  chain_.widen_tolerances(kBeforeTransitions);
  // once more with the joint between end and start inside
  OBVID_TRY(take_steps_away(chain_, transitions_, run));
  chain_.turn_to(chain_.size() / 2);
  OBVID_TRY(take_steps_away(chain_, transitions_, run));
  chain_.turn_to_first_given();
  return {};
}

/// Whether to go on with what was fitted. Where there are other searches, not with what leaves the
/// points by more than so many tolerances and cannot be mended: fewer elements come no nearer.
Result<bool> SimplifiedChain::may_lead_within(double most, const RunContext& run) {
  if (!by_.others || chain_.largest() <= most) return true;
  return mend(run);
}

/// Mends what fewer elements and simpler kinds made bad, and makes that fewer.
Result<void> SimplifiedChain::simplify_mended(const RunContext& run) {
  if (chain_.is_good()) return {};
  const auto mended = mend(run);
  OBVID_TRY(mended);
  return *mended ? simplify(run) : Result<void>();
}

/// Stretches whose points are left, or that are wound through, become their chords with rounded
/// corners; what lies beside stays. False where not all can, or, with other searches to come, where
/// they are many.
Result<bool> SimplifiedChain::mend(const RunContext& run) {
  const bool on_map = chain_.chain().plane == Plane::kMap;
  if (!on_map || constant_ || without_steps_ || limited_) return false;
  std::vector<bool> bad = chain_.bad_intervals();
  const auto intervals = static_cast<double>(bad.size());
  if (by_.others && static_cast<double>(number_of(bad)) > kMostMended * intervals) return false;
  while (number_of(bad) > 0) {
    const auto first = std::find(bad.begin(), bad.end(), true);
    const auto last = std::find(first, bad.end(), false) - 1;
    const auto mended = mend({static_cast<std::size_t>(first - bad.begin()),
                              static_cast<std::size_t>(last - bad.begin())},
                             number_of(bad), run);
    OBVID_TRY(mended);
    if (!*mended) return false;
    bad = chain_.bad_intervals();
  }
  chain_.allow_length(kOfShortest * shortest_of(chain_.chain()));
  mended_ = true;
  return true;
}

/// Bad intervals, and as many beside them as it takes that there are fewer than `before`.
Result<bool> SimplifiedChain::mend(const PointStretch& intervals, std::size_t before,
                                   const RunContext& run) {
  const std::size_t points = chain_.points().size();
  for (const std::size_t more : kMendedBeside) {
    OBVID_TRY(may_go_on(run));
    const PointStretch stretch{intervals.first - std::min(intervals.first, more),
                               std::min(intervals.last + 1 + more, points - 1)};
    if (chain_.closed() && (stretch.first == 0 || stretch.last + 1 == points)) return false;
    const FootedChain was = chain_.now();
    auto mended = with_rounded_chords(was.chain, was.feet, chain_.row(), stretch);
    if (!mended) continue;
    chain_.set(std::move(*mended));
    if (number_of(chain_.bad_intervals()) < before) return true;
    chain_.set(was);
  }
  return false;
}

/// Fewer elements and simpler kinds. What passes all points as it may does so afterwards.
Result<void> SimplifiedChain::simplify(const RunContext& run) {
  std::optional<FootedChain> good;
  const auto remember = [&] {
    if (chain_.is_good()) good = chain_.now();
  };
  remember();
  OBVID_TRY(take_fewer_elements(chain_, constant_, run));
  remember();
  const int passes = std::isfinite(chain_.scatter()) ? kPasses : kPassesAlike;
  for (int pass = 0; pass < passes; ++pass) {
    const auto taken = take_simpler_kinds(chain_, constant_, run);
    OBVID_TRY(taken);
    if (!*taken) break;
    remember();
  }
  OBVID_TRY(take_fewer_elements(chain_, constant_, run));
  if (transitions_ != Transition::kClothoid && !constant_) {
    // where clothoids lie beside transitions of another kind, lines are arcs and ends are off
    for (int pass = 0; pass < passes; ++pass) {
      remember();
      const std::size_t before = chain_.size();
      OBVID_TRY(put_transitions(chain_, transitions_, run));
      const auto taken = take_simpler_kinds(chain_, constant_, run);
      OBVID_TRY(taken);
      OBVID_TRY(take_fewer_elements(chain_, constant_, run));
      if (!*taken && chain_.size() == before) break;
    }
  }
  OBVID_TRY(chain_.polish_to_tolerance(run));
  if (good && !chain_.is_good()) chain_.set(std::move(*good));
  return {};
}

/// Windows of a loop of few elements reach from its seam to its seam, whose joint they hold where
/// it came to lie: with each joint as the seam once, each of the others moves. What has no fewer
/// elements then stays as it was.
Result<void> SimplifiedChain::simplify_at_each_seam(const RunContext& run) {
  constexpr std::size_t kFew = 2 * kBeside + 2;
  const std::size_t had = chain_.size();
  const ChainOnPoints whole = chain_;
  for (std::size_t turn = 1; had <= kFew && turn < had; ++turn) {
    chain_.turn_to(1);
    const FootedChain before = chain_.now();
    const bool was_good = chain_.is_good();
    OBVID_TRY(chain_.polish(run));
    if (was_good && !chain_.is_good()) chain_.set(before);
    OBVID_TRY(take_fewer_elements(chain_, constant_, run));
    if (chain_.size() == had) continue;
    OBVID_TRY(simplify(run));
    return simplify_at_each_seam(run);
  }
  chain_ = whole;
  return {};
}

}  // namespace obvid::alignment
