// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "obvid/chain/internal/chain.h"

namespace obvid::chain_detail {

/// Elements on either side with which a neighbourhood begins; it is doubled until it settles.
inline constexpr std::size_t kFirstHalfWidth = 24;

/// Elements first..last of a chain.
struct PartWindow {
  std::size_t first = 0, last = 0;
  bool from_start = false, to_end = false;  ///< whether they are the ends of an open chain

  [[nodiscard]] bool has(std::size_t i) const { return i >= first && i <= last; }
  /// With more elements on the sides where the chain goes on.
  [[nodiscard]] PartWindow widened(std::size_t by) const {
    return {from_start ? first : first - by, to_end ? last : last + by, from_start, to_end};
  }

  /// The elements from..to of a chain that ends with element `end`, and `half` more on either side,
  /// such that it can be widened by `margin`. Nothing where that would be the whole, or lead over
  /// the seam of a loop.
  [[nodiscard]] static std::optional<PartWindow> around(std::size_t from, std::size_t to,
                                                        std::size_t half, std::size_t margin,
                                                        std::size_t end, bool loop) {
    PartWindow out;
    out.from_start = from < half + margin + 1;
    out.to_end = to + half + margin + 1 > end;
    if ((out.from_start && out.to_end) || (loop && (out.from_start || out.to_end))) {
      return std::nullopt;
    }
    out.first = out.from_start ? 0 : from - half;
    out.last = out.to_end ? end : to + half;
    return out;
  }
};

/// Full turns put on the headings of a solved slice such that they go on those of the chain.
void turn_to(const std::vector<Element>& chain, const PartWindow& slice, ChainSolution& solved);

/// Whether the elements next to those that stay have not moved, in parts of their links' turning.
[[nodiscard]] bool settled(const std::vector<Element>& chain, const PartWindow& window,
                           const PartWindow& slice, const ChainSolution& solved);

}  // namespace obvid::chain_detail
