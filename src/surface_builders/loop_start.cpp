// SPDX-License-Identifier: Apache-2.0
#include "loop_start.h"

#include <algorithm>

namespace obvid {
namespace {

/// Runs after a turn by `first` pieces; the run that crosses the new start is cut there.
std::vector<Run> turned(const std::vector<Run>& runs, std::size_t first, std::size_t pieces) {
  std::vector<Run> result;
  for (const Run& run : runs) {
    const std::size_t from = (run.first_piece + pieces - first) % pieces;
    const std::size_t to = (run.last_piece + pieces - first) % pieces;
    if (from <= to) {
      result.push_back({from, to, run.direction});
    } else {
      result.push_back({from, pieces - 1, run.direction});
      result.push_back({0, to, run.direction});
    }
  }
  std::sort(result.begin(), result.end(),
            [](const Run& a, const Run& b) { return a.first_piece < b.first_piece; });
  return result;
}

}  // namespace

Result<Contour> begun_at_first_point(const Contour& contour) {
  if (!contour.closed || contour.joints.empty()) return contour;
  const auto at = std::find_if(contour.joints.begin(), contour.joints.end(),
                               [](const Joint& joint) { return joint.source == 0; });
  if (at == contour.joints.end()) {
    return error(ErrorCode::kUnsupported, "the closed contour has no joint on its first point")
        .hint("begin the section at one of its corners");
  }
  const auto first = at - contour.joints.begin();
  if (first == 0) return contour;
  Contour result = contour;
  std::rotate(result.joints.begin(), result.joints.begin() + first, result.joints.end());
  std::rotate(result.pieces.begin(), result.pieces.begin() + first, result.pieces.end());
  result.runs = turned(contour.runs, static_cast<std::size_t>(first), contour.pieces.size());
  return result;
}

}  // namespace obvid
