// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/contour.h"

namespace obvid::exchange {

/// Of one block before it is rounded, rad: half a turn and half a degree, so that half circles of
/// drawings are one block, and circles two. Arcs that turn by more are told in parts: ends of one
/// that nearly meet leave its centre to rounding.
inline constexpr double kMostBlockTurn = 3.15;
/// Blocks of an arc that turns by so much.
[[nodiscard]] std::size_t blocks_of_turn(double turn);

/// Fixed decimals, never "-0.000".
[[nodiscard]] std::string fixed(double value, int decimals);

/// A place as it is printed: whole numbers of the last digit. Where coordinates are large doubles
/// do not hold that digit, and what the program says would not be what it was reckoned with.
struct GridPlace {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const GridPlace&, const GridPlace&) = default;
};

/// Blocks of a program, and the path that a controller makes of what is printed.
class GcodePath {
 public:
  /// `scale`: machine units in a unit of the contour. Ends have `decimals` decimals.
  GcodePath(double scale, int decimals);

  /// One without blocks that begins where this one ends.
  [[nodiscard]] GcodePath from_here() const;

  void start_at(Vec2 point);  ///< the tool is brought there
  void line_to(Vec2 point);
  void follow_arc(const ArcPiece& arc);
  void follow_cubic(const RationalBezier& cubic);
  /// Words behind the next block that is printed (" Z-1.000 F300.000"); blocks that round away
  /// leave them to it.
  void say_behind(std::string words) { behind_ = std::move(words); }
  /// Lines of their own: words that do not move the tool in the plane.
  void say(std::string_view lines) { text_ += lines; }

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] std::string start() const;  ///< words of the start
  [[nodiscard]] std::size_t arcs() const { return arcs_; }
  /// In units of the contour, as printed.
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  /// How far the radii of an arc as printed are apart at its two ends, units of the contour, at
  /// most: controllers make of them what they like, and are that far from `pieces`.
  [[nodiscard]] double radius_mismatch() const { return radius_mismatch_; }
  /// Whether arcs became lines because their centres cannot be printed: they are too far away.
  [[nodiscard]] bool lost_arcs() const { return lost_arcs_; }
  /// Whether places of such coordinates (units of the contour) can be printed.
  [[nodiscard]] bool holds(double coordinate) const;

 private:
  [[nodiscard]] std::string behind() { return std::exchange(behind_, {}); }
  [[nodiscard]] GridPlace printed(Vec2 machine) const;
  [[nodiscard]] std::string place(GridPlace at) const;
  [[nodiscard]] std::string number(std::int64_t last_digits) const;
  /// Machine units.
  [[nodiscard]] Vec2 between(GridPlace from, GridPlace to) const;
  /// Units of the contour.
  [[nodiscard]] Vec2 in_contour(GridPlace at) const { return between({}, at) / scale_; }
  void line(GridPlace end);
  void arc(Vec2 middle, GridPlace end, bool left);

  double scale_, unit_;
  int decimals_;
  GridPlace start_, at_;
  double radius_mismatch_ = 0.0;
  bool lost_arcs_ = false;
  std::string text_, behind_;
  std::size_t arcs_ = 0;
  std::vector<Piece> pieces_;
};

}  // namespace obvid::exchange
