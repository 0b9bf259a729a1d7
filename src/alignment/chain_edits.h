// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "chain_of_elements.h"

namespace obvid::alignment {

inline constexpr std::size_t kBeside = 3;  ///< elements to both sides that move with an edited one

/// Other elements in the place of some: a chain that is to be fitted, in elements [first, last), to
/// the points on these. What lies beside them stays as it is.
struct Edit {
  FootedChain next;
  std::size_t first = 0, last = 0;
};

[[nodiscard]] inline bool bends(const Chain& chain, std::size_t element) {
  return chain.ends[element][0] != chain.ends[element][1];
}

[[nodiscard]] bool is_used(const Chain& chain, int number);

/// Elements k and k + 1 as one with these ends.
[[nodiscard]] Edit as_one(const FootedChain& now, std::size_t k, const std::array<int, 2>& ends);

/// Elements [k, k + count) as one transition with these ends, which leads to an arc.
[[nodiscard]] Edit as_transition(const FootedChain& now, std::size_t k, std::size_t count,
                                 const std::array<int, 2>& ends, Transition law);

/// Leaves out element k, neither the first nor the last: those beside it grow to where they turn as
/// it did, as one of the two alone would begin too far off. Nothing where they do not.
[[nodiscard]] std::optional<Edit> without_element(const FootedChain& now, std::size_t k);

/// One curve in the place of `count` elements: those beside them grow, or shrink, by these lengths.
/// Nothing where they become shorter than `least`.
struct CurveBetween {
  double before = 0.0, behind = 0.0;
  double length = 0.0;
};
[[nodiscard]] std::optional<Edit> with_curve(const FootedChain& now, std::size_t k,
                                             std::size_t count, const CurveBetween& curve,
                                             double least);

/// A transition between elements k - 1 and k, half of it from each. Nothing where they become
/// shorter than `least`.
[[nodiscard]] std::optional<Edit> with_transition(const FootedChain& now, std::size_t k,
                                                  double length, Transition law, double least);

/// Gives one of the elements at joint k, at that end, the curvature that the other has there.
[[nodiscard]] Edit without_step(const FootedChain& now, std::size_t k, std::size_t element,
                                std::size_t end);

/// Elements [first, last) as lines and arcs with transitions of this kind between them: what bends
/// slowly, beside the others, counts as an arc. Nothing where they are that, or cannot be.
[[nodiscard]] std::optional<Edit> regrouped(const FootedChain& now, std::size_t first,
                                            std::size_t last, Transition law);

/// Element k becomes two, which bend as they like, or with constant curvatures are arcs.
void halve(FootedChain& now, std::size_t k, bool constant);

}  // namespace obvid::alignment
