// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/curve/contour.h"

namespace obvid {

/// A contour by its arc length.
class ContourPath {
 public:
  explicit ContourPath(const Contour& contour);

  struct Place {
    Vec2 point;
    Vec2 tangent;  ///< length 1
    double kappa = 0.0;
  };

  [[nodiscard]] double length() const { return start_.empty() ? 0.0 : start_.back(); }
  /// Arc length at the start of piece k; of the end for k = number of pieces.
  [[nodiscard]] double joint(std::size_t k) const { return start_[k]; }
  /// At a joint the piece after it counts, or the one before.
  [[nodiscard]] Place at(double s, bool before_joint = false) const;
  /// Arc length of the point nearest to p near `guess`, within [from, to].
  [[nodiscard]] double nearest(Vec2 p, double guess, double from, double to) const;

 private:
  /// Parameter of a rational piece at a share of its arc length.
  [[nodiscard]] double parameter(std::size_t piece, double s) const;

  std::vector<Piece> pieces_;
  std::vector<double> start_;
  /// Of a rational piece, at equal parameters: arc length, and its derivative.
  struct Table {
    std::vector<double> length;
    std::vector<double> speed;
  };
  std::vector<Table> table_;
};

}  // namespace obvid
