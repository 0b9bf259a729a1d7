// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/exchange/drawing.h"
#include "obvid/geom/vec2.h"

namespace obvid::exchange {

/// (x, y) -> (a x + c y + e, b x + d y + f), named as in SVG.
struct Affine {
  double a = 1.0, b = 0.0, c = 0.0, d = 1.0, e = 0.0, f = 0.0;

  [[nodiscard]] Vec2 point(Vec2 p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
  [[nodiscard]] double determinant() const { return a * d - b * c; }
  /// Whether circles stay circles, to rounding.
  [[nodiscard]] bool is_similarity() const;
  [[nodiscard]] bool is_finite() const;
};
/// First `inner`, then `outer`.
[[nodiscard]] Affine operator*(const Affine& outer, const Affine& inner);

/// Arc of an ellipse between two points, as path data give it.
struct SvgArc {
  double rx = 0.0, ry = 0.0;
  double rotation_deg = 0.0;
  bool large = false, sweep = false;
  Vec2 end;
};

/// Curves of one shape in the making: commands in user units, pieces in those of the sheet.
class SvgPathBuilder {
 public:
  SvgPathBuilder(const Affine& to_sheet, std::string label)
      : to_sheet_(to_sheet), label_(std::move(label)) {}

  void move_to(Vec2 p);
  void line_to(Vec2 p);
  void quadratic_to(Vec2 q, Vec2 p);
  void cubic_to(Vec2 q1, Vec2 q2, Vec2 p);
  void arc_to(const SvgArc& arc);
  void close();

  [[nodiscard]] Vec2 here() const { return here_; }
  /// Segments of no length, which draw nothing.
  [[nodiscard]] std::size_t empty_segments() const { return empty_; }
  [[nodiscard]] bool all_finite() const { return finite_; }
  [[nodiscard]] std::vector<DrawnCurve> take();

 private:
  void add(Piece piece, Vec2 end);
  void bezier(const std::vector<Vec2>& points, Vec2 end);
  void ellipse_arc(Vec2 centre, const Affine& from_circle, double from, double sweep, Vec2 end);
  void circle_arc(Vec2 centre, double sweep, Vec2 end);
  void end_part();

  Affine to_sheet_;
  std::string label_;
  Vec2 here_, start_;
  double extent_ = 0.0;  ///< largest coordinate of the part, user units
  bool finite_ = true;
  std::size_t empty_ = 0;
  DrawnCurve part_;
  std::vector<DrawnCurve> parts_;
};

}  // namespace obvid::exchange
