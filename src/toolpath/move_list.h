// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/toolpath/toolpath.h"

namespace obvid::toolpath {

[[nodiscard]] double length_of(const std::vector<Vec3>& points);

/// Moves of a tool path one after another, with their lengths in its report.
class MoveList {
 public:
  explicit MoveList(Toolpath& out) : out_(out) {}

  [[nodiscard]] Vec3 at() const { return at_; }
  [[nodiscard]] bool begun() const { return begun_; }

  /// Points begin where the last move ended.
  void add(ToolMove kind, std::vector<Vec3> points, PassPlane plane = PassPlane::kNone);
  /// At the safe height over a place, then down at the plunge feed.
  void enter(Vec3 start);
  void leave();  ///< up to the safe height

 private:
  Toolpath& out_;
  Vec3 at_;
  bool begun_ = false;
};

}  // namespace obvid::toolpath
