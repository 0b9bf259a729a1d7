// SPDX-License-Identifier: Apache-2.0
#include "assemble.h"

#include <utility>

namespace obvid::pipeline_detail {

void Assembly::append(Contour section) {
  if (whole_.pieces.empty()) {
    whole_ = std::move(section);
    return;
  }
  const std::size_t offset = whole_.pieces.size();
  whole_.joints.back().leaving = section.joints.front().element;
  whole_.joints.insert(whole_.joints.end(), section.joints.begin() + 1, section.joints.end());
  whole_.pieces.insert(whole_.pieces.end(), section.pieces.begin(), section.pieces.end());
  for (const Run& run : section.runs) {
    whole_.runs.push_back({run.first_piece + offset, run.last_piece + offset, run.direction});
  }
}

void Assembly::close(bool smooth) {
  whole_.closed = true;
  const Joint last = whole_.joints.back();
  whole_.joints.pop_back();
  if (smooth) return;
  whole_.joints.front().leaving = whole_.joints.front().element;
  whole_.joints.front().element = last.element;
}

}  // namespace obvid::pipeline_detail
