// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace obvid {

/// Heights over ascending places, each known within bounds.
struct Tube {
  std::vector<double> at;         ///< strictly ascending
  std::vector<double> low, high;  ///< as many; low <= high
};

/// Where a string bends that is drawn tight in a tube.
struct StringContact {
  std::size_t node = 0;
  int bend = 0;  ///< 1: upwards, at the upper bound (convex); -1: downwards, at the lower one
};

/// Contacts of the string that is drawn tight through a tube, its ends free to slide between their
/// bounds, ascending. Between contacts the string is straight, so its second differences change
/// their sign as often as neighbouring contacts are of unlike kind (`changes_of`). Funnel over
/// hulls of both bounds as Lee and Preparata (1984), its start as O'Rourke (1981): O(nodes).
[[nodiscard]] std::vector<StringContact> taut_string(const Tube& tube);
[[nodiscard]] std::size_t changes_of(const std::vector<StringContact>& contacts);

/// Lower bound of the changes of sign of second differences that any heights in the tube have.
/// Three nodes a < b < c with high(b) under the chord from low(a) to low(c) have a positive second
/// difference at a node between a and c in every choice of heights; with low(b) over the chord from
/// high(a) to high(c) a negative one. Triples of unlike kinds in turn whose inner nodes follow each
/// other force a change each; the earliest end first gives the most. O(nodes) where heights bend by
/// more than the bounds allow, O(nodes^2) where they are nearly straight.
[[nodiscard]] std::size_t changes_certified(const Tube& tube);

}  // namespace obvid
