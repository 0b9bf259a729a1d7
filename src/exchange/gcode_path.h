// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/contour.h"

namespace obvid::exchange {

/// Fixed decimals, never "-0.000".
[[nodiscard]] std::string fixed(double value, int decimals);

/// Blocks of a program, and the path that a controller makes of what is printed.
class GcodePath {
 public:
  /// `scale`: machine units in a unit of the contour. Ends have `decimals` decimals.
  GcodePath(double scale, int decimals);

  void start_at(Vec2 point);  ///< the tool is brought there
  void line_to(Vec2 point);
  void follow_arc(const ArcPiece& arc);
  void follow_cubic(const RationalBezier& cubic);

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] std::string start() const;  ///< words of the start
  [[nodiscard]] std::size_t arcs() const { return arcs_; }
  /// In units of the contour, as printed.
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  [[nodiscard]] Vec2 printed(Vec2 machine) const;
  [[nodiscard]] std::string place(Vec2 machine) const;
  void line(Vec2 end);
  void arc(Vec2 middle, Vec2 end, bool left);

  double scale_, unit_;
  int decimals_;
  Vec2 start_, at_;  ///< machine units, as printed
  std::string text_;
  std::size_t arcs_ = 0;
  std::vector<Piece> pieces_;
};

}  // namespace obvid::exchange
