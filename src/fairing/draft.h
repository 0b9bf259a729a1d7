// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "layout.h"
#include "obvid/fairing/internal/exact_runs.h"

namespace obvid::fairing_detail {

/// Exact points, and free nodes between them, with a direction per link.
struct Draft {
  Tube tube;
  State x;      ///< on a smooth curve through the points
  State plain;  ///< with the headings and curvatures of the adjacent circles: another start
  std::vector<std::int8_t> direction;
  std::vector<std::optional<std::size_t>> source;  ///< per node: its point; nothing: free

  [[nodiscard]] std::size_t links() const { return direction.size(); }
};

/// The points with the directions that were given.
[[nodiscard]] Draft draft_of(const ExactSeries& series, Watch& watch);

/// Links window.first .. window.last - 1 as a draft of their own.
[[nodiscard]] Draft part_of(const Draft& draft, Window window);

/// Puts a changed part in the place of its window.
void splice(Draft& draft, Window window, Draft part);

/// How the course of a link may be changed.
enum class Change : std::uint8_t {
  kTurn,        ///< the other direction
  kSplit,       ///< a free node inside, with a vertex
  kSplitTwice,  ///< two free nodes inside, two vertices: both neighbours keep what they had
};

/// The draft with one link changed, in all ways that there are.
[[nodiscard]] std::vector<Draft> changed(const Draft& draft, Change change, std::size_t link);

/// Changes of direction.
[[nodiscard]] int vertices_of(const std::vector<std::int8_t>& direction);

}  // namespace obvid::fairing_detail
