// SPDX-License-Identifier: Apache-2.0
#include "chain_edits.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace obvid::alignment {
namespace {

constexpr double kSlowRate = 0.1;  ///< of the fastest change of curvature: what may be an arc

/// Elements with those beside them.
Edit edit_around(FootedChain next, std::size_t begin, std::size_t end) {
  const std::size_t first = begin - std::min(begin, kBeside);
  const std::size_t last = std::min(end + kBeside, next.chain.size());
  return {std::move(next), first, last};
}

void erase_elements(Chain& chain, std::size_t first, std::size_t last) {
  const auto erase = [&](auto& of_elements) {
    of_elements.erase(of_elements.begin() + static_cast<std::ptrdiff_t>(first),
                      of_elements.begin() + static_cast<std::ptrdiff_t>(last));
  };
  erase(chain.length);
  erase(chain.ends);
  erase(chain.law);
}

void insert_element(Chain& chain, std::size_t k, double length, const std::array<int, 2>& ends,
                    Transition law) {
  const auto at = static_cast<std::ptrdiff_t>(k);
  chain.length.insert(chain.length.begin() + at, length);
  chain.ends.insert(chain.ends.begin() + at, ends);
  chain.law.insert(chain.law.begin() + at, law);
}

/// Elements [k, k + count) as one, with the ends of the first.
FootedChain joined(const FootedChain& now, std::size_t k, std::size_t count) {
  FootedChain next = now;
  for (Foot& foot : next.feet) {
    if (foot.element <= k) continue;
    if (foot.element >= k + count) {
      foot.element -= count - 1;
      continue;
    }
    for (std::size_t e = k; e < foot.element; ++e) foot.s += now.chain.length[e];
    foot.element = k;
  }
  for (std::size_t e = k + 1; e < k + count; ++e) next.chain.length[k] += next.chain.length[e];
  erase_elements(next.chain, k + 1, k + count);
  return next;
}

/// Neighbours that belong together: of one curvature, or one transition.
struct Group {
  std::size_t begin = 0, end = 0;
  bool constant = false;
};

std::vector<Group> groups_of(const Chain& chain, std::size_t first, std::size_t last) {
  const auto rate = [&](std::size_t k) {
    return std::abs(chain.curvature(k, 1) - chain.curvature(k, 0)) / chain.length[k];
  };
  double fastest = 0.0;
  for (std::size_t k = first; k < last; ++k) fastest = std::max(fastest, rate(k));
  std::vector<Group> out;
  for (std::size_t k = first; k < last; ++k) {
    const bool constant = rate(k) <= kSlowRate * fastest;
    if (out.empty() || out.back().constant != constant) out.push_back({k, k, constant});
    out.back().end = k + 1;
  }
  return out;
}

/// Gives each constant group the mean curvature of its longest element. Returns their numbers, and
/// of the others that of an end.
std::vector<int> numbers_of(const std::vector<Group>& groups, const Chain& chain, Chain& next) {
  std::vector<int> out;
  for (const Group& g : groups) {
    std::size_t longest = g.begin;
    for (std::size_t k = g.begin; k < g.end; ++k) {
      if (chain.length[k] > chain.length[longest]) longest = k;
    }
    out.push_back(chain.ends[longest][0]);
    if (!g.constant || out.back() == Chain::kStraight) continue;
    next.kappa[static_cast<std::size_t>(out.back())] =
        0.5 * (chain.curvature(longest, 0) + chain.curvature(longest, 1));
  }
  return out;
}

}  // namespace

bool is_used(const Chain& chain, int number) {
  return std::any_of(chain.ends.begin(), chain.ends.end(), [&](const std::array<int, 2>& ends) {
    return ends[0] == number || ends[1] == number;
  });
}

Edit as_one(const FootedChain& now, std::size_t k, const std::array<int, 2>& ends) {
  const Chain& chain = now.chain;
  FootedChain next = joined(now, k, 2);
  next.chain.ends[k] = ends;
  next.chain.law[k] = ends == chain.ends[k]       ? chain.law[k]
                      : ends == chain.ends[k + 1] ? chain.law[k + 1]
                                                  : std::max(chain.law[k], chain.law[k + 1]);
  return edit_around(std::move(next), k, k + 1);
}

Edit as_transition(const FootedChain& now, std::size_t k, std::size_t count,
                   const std::array<int, 2>& ends, Transition law) {
  FootedChain next = joined(now, k, count);
  next.chain.ends[k] = ends;
  next.chain.law[k] = law;
  if (k + 1 < next.chain.size()) {
    auto& behind = next.chain.ends[k + 1];
    behind[1] = behind[0];
  }
  return edit_around(std::move(next), k, k + 1);
}

std::optional<Edit> without_element(const FootedChain& now, std::size_t k) {
  const Chain& chain = now.chain;
  const std::vector<Element> joints = chain.joints();
  const double whole = chain.length[k];
  const double turn = turn_between(chain.plane, joints[k].theta, joints[k + 1].theta);
  const double before = chain.curvature(k - 1, 1), behind = chain.curvature(k + 1, 0);
  const double share = (turn / whole - behind) / (before - behind);
  if (!(share >= 0.0 && share <= 1.0)) return std::nullopt;
  const double own = share * whole;
  FootedChain next = now;
  for (Foot& foot : next.feet) {
    if (foot.element < k) continue;
    if (foot.element == k && foot.s <= own) {
      foot.element = k - 1;
      foot.s += chain.length[k - 1];
      continue;
    }
    foot.s += foot.element == k ? -own : foot.element == k + 1 ? whole - own : 0.0;
    if (foot.element > k) --foot.element;
  }
  next.chain.length[k - 1] += own;
  next.chain.length[k + 1] += whole - own;
  erase_elements(next.chain, k, k + 1);
  return edit_around(std::move(next), k, k);
}

std::optional<Edit> with_curve(const FootedChain& now, std::size_t k, std::size_t count,
                               const CurveBetween& curve, double least) {
  const std::vector<Element> joints = now.chain.joints();
  FootedChain next = now;
  Chain& chain = next.chain;
  chain.length[k - 1] += curve.before;
  chain.length[k + count] += curve.behind;
  if (std::min(chain.length[k - 1], chain.length[k + count]) < least) return std::nullopt;
  chain.length[k] = curve.length;
  const int number = static_cast<int>(chain.kappa.size());
  chain.kappa.push_back(turn_between(chain.plane, joints[k].theta, joints[k + count].theta) /
                        curve.length);
  chain.ends[k] = {number, number};
  erase_elements(chain, k + 1, k + count);
  for (Foot& foot : next.feet) {
    if (foot.element <= k) continue;
    foot.element = std::max(k, foot.element - std::min(foot.element, count - 1));
  }
  return edit_around(std::move(next), k, k + 1);
}

std::optional<Edit> with_transition(const FootedChain& now, std::size_t k, double length,
                                    Transition law, double least) {
  FootedChain next = now;
  Chain& chain = next.chain;
  const double half = 0.5 * length;
  chain.length[k - 1] -= half;
  chain.length[k] -= half;
  if (std::min(chain.length[k - 1], chain.length[k]) < least) return std::nullopt;
  insert_element(chain, k, length, {now.chain.ends[k - 1][1], now.chain.ends[k][0]}, law);
  for (Foot& foot : next.feet) {
    if (foot.element == k - 1 && foot.s > chain.length[k - 1]) {
      foot.s -= chain.length[k - 1];
      foot.element = k;
    } else if (foot.element == k && foot.s < half) {
      foot.s += half;
    } else if (foot.element == k) {
      foot.s -= half;
      foot.element = k + 1;
    } else if (foot.element > k) {
      ++foot.element;
    }
  }
  return edit_around(std::move(next), k, k + 1);
}

Edit without_step(const FootedChain& now, std::size_t k, std::size_t element, std::size_t end) {
  FootedChain next = now;
  next.chain.ends[element][end] = end == 0 ? now.chain.ends[k - 1][1] : now.chain.ends[k][0];
  return edit_around(std::move(next), k, k);
}

std::optional<Edit> regrouped(const FootedChain& now, std::size_t first, std::size_t last,
                              Transition law) {
  const Chain& chain = now.chain;
  const std::vector<Group> groups = groups_of(chain, first, last);
  const bool any = std::any_of(groups.begin(), groups.end(), [&](const Group& g) {
    return !g.constant && (g.end > g.begin + 1 || chain.law[g.begin] != law);
  });
  if (!any) return std::nullopt;
  FootedChain next = now;
  const std::vector<int> number = numbers_of(groups, chain, next.chain);
  erase_elements(next.chain, first, last);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Group& group = groups[g];
    std::array<int, 2> ends = {number[g], number[g]};
    if (!group.constant) {
      ends = {g > 0 ? number[g - 1] : chain.ends[group.begin][0],
              g + 1 < groups.size() ? number[g + 1] : chain.ends[group.end - 1][1]};
      if (ends[0] == ends[1]) return std::nullopt;
    }
    double length = 0.0;
    for (std::size_t i = 0; i < next.feet.size(); ++i) {
      const std::size_t element = now.feet[i].element;
      if (element < group.begin || element >= group.end) continue;
      next.feet[i].element = first + g;
      for (std::size_t e = group.begin; e < element; ++e) next.feet[i].s += chain.length[e];
    }
    for (std::size_t e = group.begin; e < group.end; ++e) length += chain.length[e];
    insert_element(next.chain, first + g, length, ends,
                   group.constant ? Transition::kClothoid : law);
  }
  for (std::size_t i = 0; i < next.feet.size(); ++i) {
    const std::size_t element = now.feet[i].element;
    if (element >= last) next.feet[i].element = element - last + first + groups.size();
  }
  return edit_around(std::move(next), first, first + groups.size());
}

void halve(FootedChain& now, std::size_t k, bool constant) {
  Chain& chain = now.chain;
  const double middle = 0.5 * (chain.curvature(k, 0) + chain.curvature(k, 1));
  const auto [k0, k1] = chain.ends[k];
  const int number = static_cast<int>(chain.kappa.size());
  chain.kappa.insert(chain.kappa.end(), {middle, middle});
  chain.length[k] *= 0.5;
  if (constant) {
    chain.ends[k] = {number, number};
    insert_element(chain, k, chain.length[k], {k0, k0}, chain.law[k]);
  } else {
    chain.ends[k] = {number + 1, k1};
    insert_element(chain, k, chain.length[k], {k0, number}, chain.law[k]);
  }
  for (Foot& foot : now.feet) {
    if (foot.element < k || (foot.element == k && foot.s <= chain.length[k])) continue;
    if (foot.element == k) foot.s -= chain.length[k];
    ++foot.element;
  }
}

}  // namespace obvid::alignment
