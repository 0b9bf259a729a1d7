// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "obvid/core/internal/format_into.h"
#include "obvid/geom/vec2.h"

namespace obvid {

/// Text of a picture in the making: thin helper around one growing string.
class PictureCanvas {
 public:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    format_into(text_, format, std::forward<Args>(args)...);
  }
  /// Text element; `anchor` is start, middle or end.
  void label(Vec2 at, std::string_view anchor, std::string_view css, std::string_view text);
  /// The line with the verdict of a picture: as large as it fits into `room` px.
  void verdict(Vec2 at, std::string_view css, std::string_view text, double room);
  void line(Vec2 a, Vec2 b, std::string_view css);
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

/// Data of one SVG path, coordinates in px with two decimals.
class PicturePath {
 public:
  void move(Vec2 p);
  void line(Vec2 p);
  void cubic(Vec2 a, Vec2 b, Vec2 end);
  /// Back to the last move.
  void close() { text_ += 'Z'; }
  /// A line, left out while it is shorter than `step` px: keeps dense curves small.
  void thin_line(Vec2 p, double step);
  [[nodiscard]] bool empty() const { return text_.empty(); }
  [[nodiscard]] Vec2 at() const { return at_; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void number(double value);
  void pair(char command, Vec2 p);
  std::string text_;
  Vec2 at_;
};

/// Px as short text: at most two decimals.
[[nodiscard]] std::string px(double value);

}  // namespace obvid
