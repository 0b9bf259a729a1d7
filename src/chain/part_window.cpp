// SPDX-License-Identifier: Apache-2.0
#include "part_window.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obvid::chain_detail {
namespace {

/// What a neighbourhood may turn the elements beside its ends by, of the turning of their link: a
/// heading that is off by d moves the curve by some d/8 chords, and farther off it fades.
constexpr double kSettledPart = 1e-9;
/// Beside what rounding of the headings leaves, of 1 rad and of themselves.
constexpr double kHeadingRounding = 0x1p-46;
/// Elements on either side that are looked at.
constexpr std::size_t kLookedAt = 2;

}  // namespace

void turn_to(const std::vector<Element>& chain, const PartWindow& slice, ChainSolution& solved) {
  const std::size_t k = slice.from_start ? slice.last : slice.first;  // a held one
  const double by =
      std::round((chain[k].theta - solved.elements[k - slice.first].theta) / kFullTurn) * kFullTurn;
  for (Element& e : solved.elements) e.theta += by;
  for (LinkState& link : solved.links) link.omega += by;
}

bool settled(const std::vector<Element>& chain, const PartWindow& window, const PartWindow& slice,
             const ChainSolution& solved) {
  const auto still = [&](std::size_t i, std::size_t link) {
    const LinkState& l = solved.links[link - slice.first];
    const Element &was = chain[i], &is = solved.elements[i - slice.first];
    const double moved =
        std::max(std::abs(is.theta - was.theta), std::abs(is.kappa - was.kappa) * l.h);
    return moved <=
           kSettledPart * std::abs(l.sigma) + kHeadingRounding * (1.0 + std::abs(was.theta));
  };
  for (std::size_t k = 0; k < kLookedAt; ++k) {
    if (!window.from_start && !still(window.first + k, window.first + k)) return false;
    if (!window.to_end && !still(window.last - k, window.last - k - 1)) return false;
  }
  return true;
}

}  // namespace obvid::chain_detail
