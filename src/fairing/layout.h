// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "node_ends.h"
#include "tube.h"

namespace obvid::fairing_detail {

/// How the curvature changes over a link: one way, or with a vertex at a free node inside the link.
enum class Course : std::int8_t {
  kFalls = -1,
  kRises = 1,
  kFallsThenRises = -2,
  kRisesThenFalls = 2
};

[[nodiscard]] constexpr bool is_split(Course c) {
  return c == Course::kFallsThenRises || c == Course::kRisesThenFalls;
}
[[nodiscard]] constexpr std::int8_t first_direction(Course c) {
  return static_cast<std::int8_t>(c) > 0 ? std::int8_t{1} : std::int8_t{-1};
}
[[nodiscard]] constexpr std::int8_t last_direction(Course c) {
  return static_cast<std::int8_t>(is_split(c) ? -first_direction(c) : first_direction(c));
}
[[nodiscard]] constexpr Course course(std::int8_t direction) {
  return direction > 0 ? Course::kRises : Course::kFalls;
}
[[nodiscard]] constexpr Course split_course(std::int8_t first) {
  return first > 0 ? Course::kRisesThenFalls : Course::kFallsThenRises;
}

/// Course of every link of a tube.
using Layout = std::vector<Course>;

/// Changes of direction along a layout; along the seam too when closed.
[[nodiscard]] int count_vertices(const Layout& layout, bool closed);

/// Part of a tube: links first .. last - 1 and their nodes.
struct Window {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// A window of a tube as a tube of its own, with a free node inside every split link.
struct LaidTube {
  Tube tube;
  State start;
  std::vector<std::int8_t> direction;
  std::vector<std::optional<std::size_t>> node;  ///< index in the whole tube; nothing: free node
};

/// A free node in the middle of the quintic Hermite curve over a link.
[[nodiscard]] TubeNode middle_node(const NodeEnd& a, const NodeEnd& b);

[[nodiscard]] LaidTube lay_out(const Tube& tube, const State& state, Window window,
                               const Layout& layout);

}  // namespace obvid::fairing_detail
