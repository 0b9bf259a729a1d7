// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "obvid/geom/vec2.h"

namespace obvid::picture {

/// Data of an SVG path in tenths of a px, whole numbers and relative: it stands in a group with
/// `kPathTransform`.
class TenthsPath {
 public:
  void move(Vec2 p);
  void line(Vec2 p);  ///< nothing where the place stays the same
  void close() { text_ += 'z'; }
  [[nodiscard]] bool empty() const { return text_.empty(); }
  [[nodiscard]] std::string take() { return std::exchange(text_, {}); }
  [[nodiscard]] std::size_t size() const { return text_.size(); }

 private:
  void pair(long x, long y);
  std::string text_;
  long x_ = 0, y_ = 0;
  bool drawing_ = false;  ///< the last command was a line
};

inline constexpr const char* kPathTransform = "scale(.1)";

/// The line without points that lie within `tolerance` px of it.
[[nodiscard]] std::vector<Vec2> thinned(const std::vector<Vec2>& line, double tolerance);

}  // namespace obvid::picture
