// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "decide.h"
#include "obvid/certify/certify.h"
#include "piece_facts.h"
#include "scaled_piece.h"

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

bool has_finite_numbers(Vec2 v) { return is_finite(v.x) && is_finite(v.y); }

PieceFacts examine_line(const LinePiece& line) {
  return straight(has_finite_numbers(line.start) && has_finite_numbers(line.end) &&
                  !(line.start == line.end));
}

constexpr double kHalfTurn = 3.141592653589793;  // the double below pi

PieceFacts examine_arc(const ArcPiece& arc) {
  const bool valid = has_finite_numbers(arc.start) && has_finite_numbers(arc.end) &&
                     is_finite(arc.theta0) && is_finite(arc.kappa) && is_finite(arc.length) &&
                     arc.length > 0.0;
  PieceFacts facts = straight(valid);
  facts.turns_below_pi = valid && std::abs(arc.kappa * arc.length) < kHalfTurn;
  return facts;
}

/// Two lobes that turn opposite ways count with half their curvature times the whole length, which
/// is more than either turns.
bool turns_below_pi(const ClothoidPiece& piece) {
  const double k0 = piece.kappa0, k1 = piece.kappa1;
  const bool one_way = (k0 >= 0.0) == (k1 >= 0.0);
  const double kappa =
      one_way ? 0.5 * std::abs(k0 + k1) : 0.5 * std::max(std::abs(k0), std::abs(k1));
  return kappa * piece.length < kHalfTurn;
}

/// Curvature is linear along a clothoid: comparing its ends decides without any rounding.
PieceFacts examine_clothoid(const ClothoidPiece& piece) {
  const bool valid = has_finite_numbers(piece.start) && has_finite_numbers(piece.end) &&
                     is_finite(piece.theta0) && is_finite(piece.kappa0) &&
                     is_finite(piece.kappa1) && is_finite(piece.length) && piece.length > 0.0;
  PieceFacts facts = straight(valid);
  if (!valid) return facts;
  facts.turns_below_pi = turns_below_pi(piece);
  if (piece.kappa0 == piece.kappa1) return facts;
  const bool rises = piece.kappa0 < piece.kappa1;
  facts.proof.verdict = rises ? Verdict::kIncreasing : Verdict::kDecreasing;
  facts.first_change = facts.last_change = rises ? 1 : -1;
  return facts;
}

bool undecided(const PieceFacts& facts) { return facts.proof.verdict == Verdict::kUndecided; }

/// +1 or -1 when every coefficient is beyond its share of the bound with that sign, else 0.
template <std::size_t Count>
int common_sign(const std::array<double, Count>& c, double plain_bound) {
  static constexpr auto kInverse = inverse_binomials<Count>();
  double low = kInverse[0] * c[0];
  double high = low;
  for (std::size_t j = 1; j < Count; ++j) {
    const double plain = kInverse[j] * c[j];
    low = std::min(low, plain);
    high = std::max(high, plain);
  }
  return low > plain_bound ? 1 : (high < -plain_bound ? -1 : 0);
}

template <int N>
using Determinant = std::array<double, 3 * N - 5>;

/// Norms of the majorants, in plain Bernstein form; see `largest`.
template <int N>
struct MajorantNorms {
  double u = 0.0;
  double v = 0.0;
  double test = 0.0;

  /// `a`: absolute differences and weights; `d`: majorant of the determinant.
  MajorantNorms(const ControlDifferences<N, double>& a, const Determinant<N>& d) {
    CurvatureForm<N, double> f;
    add_hodograph(a, f);
    u = largest(f.u);
    v = largest(f.v);
    const double det = largest(d);
    const double weight = *std::max_element(a.weight.begin(), a.weight.end());
    // |partial derivative of a form of degree m| <= m |form|: 3 W_x D + W D_x has 3 N + (3 N - 6).
    constexpr double kSlopes = 2.0 * (6.0 * N - 6.0) * (4.0 * N - 4.0);
    test = kSlopes * weight * det * (u * u + v * v);
  }
};

/// Doubles with one bound for all coefficients: decides nearly every piece, at half the cost of a
/// bound per coefficient. `d` is the determinant, wrong by at most its share of `d_majorant`.
template <int N>
PieceFacts decide_by_norms(const ControlDifferences<N, double>& p, const Determinant<N>& d,
                           const Determinant<N>& d_majorant, LatticeDirection direction) {
  using Count = form::Roundings<N>;
  constexpr int kScaling = 2;  // into plain form, by an inverse that is itself rounded
  constexpr int kAlong = 2;
  const MajorantNorms<N> norms(absolute(p), d_majorant);
  const auto f = curvature_form<false>(p, d);
  const double along_norm = norms.u * std::abs(direction.x) + norms.v * std::abs(direction.y);
  std::array<double, 2 * N - 1> along{};
  for (std::size_t j = 0; j < along.size(); ++j) {
    along[j] = f.u[j] * direction.x + f.v[j] * direction.y;
  }
  const double along_bound = error_bound<double>(Count::kHodograph + kAlong + kScaling, along_norm);
  if (common_sign(along, along_bound) <= 0) return {};
  const int sign = common_sign(f.test, error_bound<double>(Count::kTest + kScaling, norms.test));
  if (sign == 0) return {};
  return facts_of({sign > 0 ? SignVerdict::kPositive : SignVerdict::kNegative}, true);
}

/// The determinant with areas right to three roundings of their own size, however flat the
/// triangles, and its majorant. False where even double-double does not give that.
template <int N>
bool sharp_determinant(const RationalBezier& piece, Determinant<N>& d, Determinant<N>& d_majorant) {
  // Six operations of relative error 8 u^2 at most, against one rounding u of the result.
  constexpr double kSharpest = 6.0 * kDoubleDoubleRoundoff / kUnitRoundoff;
  d = d_majorant = {};
  for (std::size_t k = 0; k <= N; ++k) {
    for (std::size_t l = k + 1; l <= N; ++l) {
      const Vec2 a = piece.offset[k], b = piece.offset[l];
      const DoubleDouble x = two_sum(b.x, -a.x), y = two_sum(b.y, -a.y);
      for (std::size_t m = l + 1; m <= N; ++m) {
        const Vec2 c = piece.offset[m];
        const DoubleDouble first = x * two_sum(c.y, -b.y), second = y * two_sum(c.x, -b.x);
        const double area = (first - second).hi;
        if (!(std::abs(area) > kSharpest * (std::abs(first.hi) + std::abs(second.hi)))) {
          return false;
        }
        const double w =
            piece.weight[k] * piece.weight[l] * piece.weight[m] * form::kFactors<N>.triple[k][l][m];
        d[k + l + m - 3] += w * area;
        d_majorant[k + l + m - 3] += w * std::abs(area);
      }
    }
  }
  return true;
}

/// Doubles, for pieces so flat that their areas cancel: only these are computed sharper.
template <int N>
[[gnu::noinline]] PieceFacts decide_flat(const RationalBezier& piece,
                                         const ControlDifferences<N, double>& p) {
  Determinant<N> d;
  Determinant<N> d_majorant;
  if (!sharp_determinant<N>(piece, d, d_majorant)) return {};
  return decide_by_norms<N>(p, d, d_majorant, chord_direction(piece));
}

/// The quick tiers.
template <int N>
PieceFacts decide_quickly(const RationalBezier& piece, const ControlDifferences<N, double>& p) {
  if (!std::all_of(p.weight.begin(), p.weight.end(), [](double w) { return w > 0.0; })) return {};
  const PieceFacts facts = decide_by_norms<N>(
      p, determinant<false>(p), determinant<true>(absolute(p)), chord_direction(piece));
  return undecided(facts) ? decide_flat<N>(piece, p) : facts;
}

/// The tiers: doubles with a coarse bound, doubles with a bound per coefficient, double-doubles
/// likewise, exact integers.
PieceFacts examine_bezier(const RationalBezier& piece) {
  if (piece.degree < 1 || piece.degree > kMaxBezierDegree) return {};
  const auto unit = scaled(piece);
  if (!unit) return {};
  if (piece.degree == 1) return straight(piece.weight[0] > 0.0 && piece.weight[1] > 0.0);
  return with_degree(piece.degree, [&]<int N>() -> PieceFacts {
    const auto p = differences_in_doubles<N>(*unit);
    PieceFacts facts = decide_quickly<N>(*unit, p);
    if (!undecided(facts)) return facts;
    const auto majorant = majorant_of(p);
    const TestDirections directions = test_directions(*unit);
    facts = decide(p, majorant, directions);
    if (!undecided(facts)) return facts;
    facts = decide(exact_differences<N>(*unit), majorant, directions);
    if (undecided(facts)) facts = examine_exactly(piece);
    facts.proof.exact_arithmetic = true;
    return facts;
  });
}

}  // namespace

PieceFacts examine_piece(const Piece& piece) {
  if (fault_of_arithmetic() != nullptr) return {};
  if (const auto* bezier = std::get_if<RationalBezier>(&piece)) return examine_bezier(*bezier);
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) return examine_arc(*arc);
  if (const auto* one = std::get_if<ClothoidPiece>(&piece)) return examine_clothoid(*one);
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

std::vector<SignFrom> curvature_changes(const RationalBezier& piece) {
  if (piece.degree < 2 || piece.degree > kMaxBezierDegree) return {};
  const auto unit = scaled(piece);
  if (!unit) return {};
  std::vector<SignFrom> signs;
  bool sure = false;
  static_cast<void>(with_degree(piece.degree, [&]<int N>() -> PieceFacts {
    const auto majorant = majorant_of(differences_in_doubles<N>(*unit));
    sure = change_signs(exact_differences<N>(*unit), majorant, signs);
    return {};
  }));
  return sure ? signs : curvature_changes_exactly(piece);
}

std::vector<SignFrom> curvature_signs(const RationalBezier& piece) {
  if (piece.degree < 2 || piece.degree > kMaxBezierDegree) return {};
  const auto unit = scaled(piece);
  if (!unit) return {};
  std::vector<SignFrom> signs;
  bool sure = false;
  static_cast<void>(with_degree(piece.degree, [&]<int N>() -> PieceFacts {
    const auto majorant = determinant<true>(absolute(differences_in_doubles<N>(*unit)));
    sure = bend_signs(exact_differences<N>(*unit), majorant, signs);
    return {};
  }));
  return sure ? signs : curvature_signs_exactly(piece);
}

PieceProof prove_piece(const Piece& piece) { return examine_piece(piece).proof; }

}  // namespace obvid
