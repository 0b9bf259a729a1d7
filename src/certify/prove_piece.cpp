// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "decide.h"
#include "piece_facts.h"
#include "scaled_piece.h"
#include "obvid/certify/certify.h"

namespace obvid {
namespace {

/// Differences without any rounding.
template <int N>
ControlDifferences<N, DoubleDouble> exact_differences(const RationalBezier& piece) {
  ControlDifferences<N, DoubleDouble> p;
  for (std::size_t k = 0; k <= N; ++k) {
    p.weight[k] = {piece.weight[k], 0.0};
    for (std::size_t l = k + 1; l <= N; ++l) {
      p.x[k][l] = two_sum(piece.offset[l].x, -piece.offset[k].x);
      p.y[k][l] = two_sum(piece.offset[l].y, -piece.offset[k].y);
    }
  }
  return p;
}

template <int N>
CurvatureForm<N, double> majorant_of(const ControlDifferences<N, double>& p) {
  return curvature_form<true>(absolute(p));
}

PieceFacts straight(bool forward) {
  PieceFacts facts;
  facts.proof.verdict = forward ? Verdict::kConstant : Verdict::kUndecided;
  facts.turns_below_pi = forward;
  return facts;
}

bool finite(Vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); }

PieceFacts examine_line(const LinePiece& line) {
  return straight(finite(line.start) && finite(line.end) && !(line.start == line.end));
}

PieceFacts examine_arc(const ArcPiece& arc) {
  constexpr double kHalfTurn = 3.141592653589793;  // the double below pi
  const bool valid = finite(arc.start) && finite(arc.end) && std::isfinite(arc.theta0) &&
                     std::isfinite(arc.kappa) && std::isfinite(arc.length) && arc.length > 0.0;
  PieceFacts facts = straight(valid);
  facts.turns_below_pi = valid && std::abs(arc.kappa * arc.length) < kHalfTurn;
  return facts;
}

bool undecided(const PieceFacts& facts) { return facts.proof.verdict == Verdict::kUndecided; }

/// The tiers: doubles with a bound, double-doubles with a bound, exact integers.
PieceFacts examine_bezier(const RationalBezier& piece) {
  if (piece.degree < 1 || piece.degree > kMaxBezierDegree) return {};
  const auto unit = scaled(piece);
  if (!unit) return {};
  if (piece.degree == 1) return straight(piece.weight[0] > 0.0 && piece.weight[1] > 0.0);
  const TestDirections directions = test_directions(*unit);
  return with_degree(piece.degree, [&]<int N>() -> PieceFacts {
    const auto p = differences_in_doubles<N>(*unit);
    const auto majorant = majorant_of(p);
    PieceFacts facts = decide(p, majorant, directions);
    if (!undecided(facts)) return facts;
    facts = decide(exact_differences<N>(*unit), majorant, directions);
    if (undecided(facts)) facts = examine_exactly(piece);
    facts.proof.exact_arithmetic = true;
    return facts;
  });
}

}  // namespace

PieceFacts examine_piece(const Piece& piece) {
  if (const auto* bezier = std::get_if<RationalBezier>(&piece)) return examine_bezier(*bezier);
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) return examine_arc(*arc);
  return examine_line(std::get<LinePiece>(piece));
}

PieceFacts examine_in_doubles(const RationalBezier& piece) {
  const auto unit = scaled(piece);
  if (!unit) return {};
  return with_degree(piece.degree, [&]<int N>() -> PieceFacts {
    const auto p = differences_in_doubles<N>(*unit);
    return decide(p, majorant_of(p), test_directions(*unit));
  });
}

PieceFacts examine_in_double_double(const RationalBezier& piece) {
  const auto unit = scaled(piece);
  if (!unit) return {};
  return with_degree(piece.degree, [&]<int N>() -> PieceFacts {
    const auto majorant = majorant_of(differences_in_doubles<N>(*unit));
    return decide(exact_differences<N>(*unit), majorant, test_directions(*unit));
  });
}

PieceProof prove_piece(const Piece& piece) { return examine_piece(piece).proof; }

}  // namespace obvid
