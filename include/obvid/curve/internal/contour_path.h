// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/curve/pieces.h"

namespace obvid {

/// Largest error of an arc length that tables keep, as a share of the piece: near rounding.
inline constexpr double kFinestLength = 1e-14;

/// Arc length along one piece and its inverse, by a table made once: lines, arcs and clothoids run
/// evenly and need none; the speed of a rational piece is a polynomial on each of few cells.
///
/// Making it costs some ten evaluations a cell (one to four cells on pieces of fair contours), each
/// look-up none.
class PieceLength {
 public:
  /// `accuracy`: largest error of a length, as a share of the piece's; kFinestLength or more.
  PieceLength(const Piece& piece, double accuracy);

  [[nodiscard]] double length() const { return length_; }
  /// Arc length from the start to a parameter in [0, 1].
  [[nodiscard]] double at(double t) const;
  /// Its inverse: parameter in [0, 1]; lengths beyond the ends are the ends.
  [[nodiscard]] double parameter(double s) const;
  /// Parameter at which the piece turns back at once, or does not get on: there is no tangent.
  [[nodiscard]] std::optional<double> cusp() const { return cusp_; }

 private:
  static constexpr std::size_t kTerms = 8;
  /// Length from `from` on: y (c0 + c1 y + ...) with y = (t - from) / width.
  struct Cell {
    double from = 0.0, width = 0.0;
    double start = 0.0, length = 0.0;
    std::array<double, kTerms> c{};
    double end_slope = 0.0;  ///< by y, at y = 1; at y = 0 it is c0
  };
  class Builder;
  [[nodiscard]] static double within(const Cell& cell, double y);
  [[nodiscard]] double inverse(const Cell& cell, double s) const;

  std::vector<Cell> cells_;
  double length_ = 0.0;
  double settled_;  ///< steps of Newton, of a cell
  std::optional<double> cusp_;
};

/// Pieces in a row by their arc length. They must outlive the path.
class ContourPath {
 public:
  /// Cancelled, all pieces behind have length 0.
  explicit ContourPath(std::span<const Piece> pieces, double accuracy = kFinestLength,
                       Watch* watch = nullptr);
  /// E402 where a piece has a cusp (`index`: the piece, `value`: its parameter there).
  [[nodiscard]] static Result<ContourPath> without_cusps(std::span<const Piece> pieces,
                                                         double accuracy = kFinestLength);

  [[nodiscard]] std::span<const Piece> pieces() const { return pieces_; }
  [[nodiscard]] double length() const { return start_.back(); }
  /// Arc length at the start of piece k; of the end for k = number of pieces.
  [[nodiscard]] double joint(std::size_t k) const { return start_[k]; }
  /// Arc length at a parameter of a piece.
  [[nodiscard]] double length_at(std::size_t piece, double t) const;

  struct Parameter {
    std::size_t piece = 0;
    double t = 0.0;
  };
  /// At a joint the start of the piece after it, or the end of the one before.
  [[nodiscard]] Parameter parameter(double s, bool before_joint = false) const;
  [[nodiscard]] Jet jet(double s, bool before_joint = false) const;

  struct Place {
    Vec2 point;
    Vec2 tangent;  ///< length 1
    double kappa = 0.0;
  };
  [[nodiscard]] Place at(double s, bool before_joint = false) const;
  /// Arc length of the point nearest to p near `guess`, within [from, to].
  [[nodiscard]] double nearest(Vec2 p, double guess, double from, double to) const;

 private:
  std::span<const Piece> pieces_;
  std::vector<PieceLength> lengths_;
  std::vector<double> start_;
};

}  // namespace obvid
