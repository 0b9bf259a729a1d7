// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <array>
#include <span>
#include <variant>

#include "obvid/geom/element.h"

namespace obvid {

/// Straight piece.
struct LinePiece {
  Vec2 start;
  Vec2 end;
};

/// Circle arc: from `start` with heading `theta0` along `length` at constant `kappa` (not 0).
/// `end` is kept beside it so that neighbouring pieces share their joint exactly.
struct ArcPiece {
  Vec2 start;
  Vec2 end;
  double theta0 = 0.0;
  double kappa = 0.0;
  double length = 0.0;
};

/// Clothoid: from `start` with heading `theta0` along `length`, curvature changing linearly from
/// `kappa0` to `kappa1` (equal ones: an arc or a line). `end` is kept beside it like an arc's.
struct ClothoidPiece {
  Vec2 start;
  Vec2 end;
  double theta0 = 0.0;
  double kappa0 = 0.0;
  double kappa1 = 0.0;
  double length = 0.0;
};

/// Largest degree of a Bezier piece.
inline constexpr int kMaxBezierDegree = 7;

/// Rational Bezier piece, t in [0, 1]. Control point j is exactly `origin + offset[j]`.
///
/// With `origin` = (0, 0) the offsets are the coordinates themselves. A piece that is small
/// against its coordinates keeps its start as origin, because coordinates rounded to doubles
/// would lose its curvature (docs/methods/curve.md).
struct RationalBezier {
  Vec2 origin;
  int degree = 0;
  std::array<Vec2, kMaxBezierDegree + 1> offset{};
  std::array<double, kMaxBezierDegree + 1> weight{};
};

using Piece = std::variant<LinePiece, ArcPiece, RationalBezier, ClothoidPiece>;

/// Point, first three derivatives by the native parameter t in [0, 1].
struct Jet {
  Vec2 point;
  Vec2 d1;
  Vec2 d2;
  Vec2 d3;
};

[[nodiscard]] Jet evaluate(const LinePiece& piece, double t);
[[nodiscard]] Jet evaluate(const ArcPiece& piece, double t);
[[nodiscard]] Jet evaluate(const RationalBezier& piece, double t);
[[nodiscard]] Jet evaluate(const ClothoidPiece& piece, double t);
[[nodiscard]] Jet evaluate(const Piece& piece, double t);
/// At several parameters, as many as `jets` has places: bit for bit what each gives alone, in less
/// time where neighbours lie in the same half of the piece.
void evaluate(const RationalBezier& piece, std::span<const double> t, std::span<Jet> jets);

/// Signed curvature of a jet, 1/unit.
[[nodiscard]] double curvature(const Jet& jet);
/// Derivative of the curvature by arc length, 1/unit^2.
[[nodiscard]] double curvature_rate(const Jet& jet);

/// How far a piece turns between two parameters, 0 <= t0 <= t1 <= 1, to both sides together, rad, 0
/// or more: exact, to rounding, for lines, arcs and clothoids, however often they go around. A
/// Bezier piece must have one inflection at the most and turn by less than half a turn to either
/// side of it.
[[nodiscard]] double turning_both_ways(const Piece& piece, double t0, double t1);

/// All weights are the same double: the piece is a polynomial.
[[nodiscard]] bool is_polynomial(const RationalBezier& bezier);

/// Whether the control point beside this end (t = 0 or 1) of a Bezier piece stands on it: the
/// derivative is zero there, and the curvature has no bound in general. False elsewhere.
[[nodiscard]] bool is_singular_end(const Piece& piece, double t);

/// Element of a piece at parameter t; heading in (-pi, pi]. At a singular end the heading is the
/// limit of those beside it, and the curvature NaN: undefined.
[[nodiscard]] Element element_at(const Piece& piece, double t);

[[nodiscard]] Vec2 start_point(const Piece& piece);
[[nodiscard]] Vec2 end_point(const Piece& piece);

/// Arc length of t in [0, 1] by Gauss-Legendre quadrature refined until `tolerance` (model units).
[[nodiscard]] double arc_length(const Piece& piece, double tolerance);

/// The piece shifted by a vector. A Bezier piece with an origin of its own keeps its offsets.
[[nodiscard]] Piece moved(const Piece& piece, Vec2 by);

/// The same piece from its end to its start.
[[nodiscard]] Piece reversed(const Piece& piece);

/// The two halves [0, t] and [t, 1] of a rational Bezier (de Casteljau), 0 < t < 1.
[[nodiscard]] std::array<RationalBezier, 2> split(const RationalBezier& piece, double t);

}  // namespace obvid
