// SPDX-License-Identifier: Apache-2.0
// The pieces of a contour as its file gives them.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace judge {

struct Point {
  double x = 0.0, y = 0.0;
  bool operator==(const Point&) const = default;
};

struct Line {
  Point start, end;
};
struct Arc {
  Point start, end;
  double theta0 = 0.0, kappa = 0.0, length = 0.0;
};
struct Clothoid {
  Point start, end;
  double theta0 = 0.0, kappa0 = 0.0, kappa1 = 0.0, length = 0.0;
};
/// Control point j is exactly origin + offset[j].
struct Bezier {
  Point origin;
  std::vector<Point> offset;
  std::vector<double> weight;
  std::vector<Point> rounded;  ///< the field `points`

  [[nodiscard]] int degree() const { return static_cast<int>(offset.size()) - 1; }
};
using Piece = std::variant<Line, Arc, Clothoid, Bezier>;

Point stored_start(const Piece& piece);
Point stored_end(const Piece& piece);
/// The same piece in a unit that is smaller by the factor.
Piece scaled(const Piece& piece, double factor);
const char* type_name(const Piece& piece);

}  // namespace judge
