// SPDX-License-Identifier: Apache-2.0
#include "put_transitions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "obvid/core/error.h"

namespace obvid::alignment {
namespace {

constexpr std::size_t kAtOnce = 12;     ///< elements that are made lines, arcs and transitions
constexpr std::size_t kLongestRun = 9;  ///< elements that one transition takes the place of
constexpr double kSlow = 0.25;  ///< of a run's change of curvature: what may be an arc beside it

[[nodiscard]] bool bends_less(const Chain& chain, std::size_t element, std::size_t k,
                              std::size_t count) {
  const double own = chain.curvature(element, 1) - chain.curvature(element, 0);
  const double run = chain.curvature(k + count - 1, 1) - chain.curvature(k, 0);
  return std::abs(own) <= kSlow * std::abs(run);
}

/// Elements [k, k + count) as one, without steps where it joins the others, or with the curvatures
/// that the first and the last have there.
bool take_transition(ChainOnPoints& chain, std::size_t k, std::size_t count, Transition law) {
  const auto& all = chain.chain().ends;
  const std::size_t last = k + count - 1;
  const std::array<int, 2> ends = {all[k][0], all[last][1]};
  std::array<int, 2> joined = ends;
  if (k > 0) joined[0] = all[k - 1][1];
  if (last + 1 < chain.size()) joined[1] = all[last + 1][0];
  for (const auto& one : {joined, ends}) {
    if (one[0] != one[1] && chain.take(as_transition(chain.now(), k, count, one, law))) return true;
    if (joined == ends) break;
  }
  return false;
}

/// The longest run from element k on. `slow`: up to a clothoid that bends so little that it may be
/// an arc.
bool take_longest(ChainOnPoints& chain, std::size_t k, Transition law, bool slow) {
  for (std::size_t count = std::min(kLongestRun, chain.size() - k); count > 0; --count) {
    const std::size_t behind = k + count;
    const bool open = behind < chain.size() && bends(chain.chain(), behind);
    if (open != slow || (count == 1 && !bends(chain.chain(), k))) continue;
    if (open && !bends_less(chain.chain(), behind, k, count)) continue;
    if (take_transition(chain, k, count, law)) return true;
  }
  return false;
}

bool put_longest_between(ChainOnPoints& chain, std::size_t k, Transition law) {
  const Chain& now = chain.chain();
  const bool between_constants = !bends(now, k - 1) && !bends(now, k);
  const double half = 0.5 * std::min(now.length[k - 1], now.length[k]);
  const double least = chain.limits().least_length;
  const auto put = [&](double length, Transition kind) {
    return chain.take(with_transition(chain.now(), k, length, kind, least));
  };
  for (double length = std::max(half, least);; length = std::max(0.5 * length, least)) {
    if (between_constants && law != Transition::kClothoid && put(length, law)) return true;
    if (put(length, Transition::kClothoid)) return true;
    if (length <= least) return false;
  }
}

/// Between elements k - 1 and k: clothoids that begin or end otherwise, else the longest transition
/// that is found, else arcs that become clothoids.
bool take_step_away(ChainOnPoints& chain, std::size_t k, Transition law) {
  const auto share = [&](std::size_t element, std::size_t end) {
    return chain.take(without_step(chain.now(), k, element, end));
  };
  if (bends(chain.chain(), k) && share(k, 0)) return true;
  if (bends(chain.chain(), k - 1) && share(k - 1, 1)) return true;
  return put_longest_between(chain, k, law) || share(k, 0) || share(k - 1, 1);
}

}  // namespace

Result<void> put_transitions(ChainOnPoints& chain, Transition law, const RunContext& run) {
  // all of a range at once: one by one they may not fit, where clothoids beside them make good what
  // those of the search cannot follow
  for (std::size_t first = 0; first < chain.size(); first += kAtOnce / 2) {
    OBVID_TRY(may_go_on(run));
    (void)chain.take(regrouped(chain.now(), first, std::min(first + kAtOnce, chain.size()), law));
  }
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const double done = static_cast<double>(k) / static_cast<double>(chain.size());
    OBVID_TRY(tell(run, "transitions", done));
    if (k > 0 && bends(chain.chain(), k - 1)) continue;  // what begins there is none of these
    if (!take_longest(chain, k, law, false)) (void)take_longest(chain, k, law, true);
  }
  return {};
}

Result<void> take_steps_away(ChainOnPoints& chain, Transition law, const RunContext& run) {
  for (std::size_t k = 1; k < chain.size(); ++k) {
    OBVID_TRY(may_go_on(run));
    if (chain.chain().ends[k - 1][1] == chain.chain().ends[k][0]) continue;
    if (take_step_away(chain, k, law)) continue;
    const double step = chain.chain().curvature(k, 0) - chain.chain().curvature(k - 1, 1);
    return fail(error(ErrorCode::kToleranceNotReached,
                      "a step of the curvature remains: no transition has room there")
                    .where("--joints")
                    .hint("allow a larger tolerance, or a smaller --min-length")
                    .value(std::abs(step)));
  }
  return {};
}

}  // namespace obvid::alignment
