// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "obvid/curve/contour.h"
#include "obvid/pipeline/internal/lines_and_arcs.h"

namespace obvid::pipeline_detail {

/// What was chosen among the points and what the contour showed not to hold
/// (docs/methods/fairing.md, "What is taken back").
struct TakenBack {
  std::vector<std::size_t> loose;     ///< measured points that lie on no line and no arc
  std::vector<std::size_t> unbroken;  ///< no corner lies between one of these and the next
  std::vector<std::string> told;      ///< of lines and arcs, for the user

  [[nodiscard]] bool is_loose(std::size_t point) const { return contains(loose, point); }
  [[nodiscard]] bool is_unbroken(std::size_t gap) const { return contains(unbroken, gap); }

 private:
  [[nodiscard]] static bool contains(const std::vector<std::size_t>& all, std::size_t one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  }
};

/// Corners between two points at which the contour turns by less than `angle`, rad, are none: where
/// they lie is taken from one line or arc on each side, and the contour may leave them otherwise.
/// False where there is none.
bool take_back_corners(const Contour& contour, double angle, TakenBack& out);

/// The line or arc beside a point, nearest of those that still are there, gives up its points.
/// False where there is none. `points`: how many the series has.
bool take_back_nearest(const std::vector<LineOrArc>& all, std::size_t point, std::size_t points,
                       bool closed, TakenBack& out);

/// The measured point nearest to a joint.
[[nodiscard]] std::size_t point_nearest_to(std::size_t joint, const Contour& contour);

}  // namespace obvid::pipeline_detail
