// SPDX-License-Identifier: Apache-2.0
#include "obvid/certify/carrier_pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "double_double.h"
#include "obvid/numeric/internal/bernstein.h"

namespace obvid {
namespace {

bool is_polynomial(const RationalBezier& piece) {
  const auto count = static_cast<std::ptrdiff_t>(piece.degree) + 1;
  return std::all_of(piece.weight.begin(), piece.weight.begin() + count,
                     [&](double w) { return w == piece.weight[0]; });
}

/// w1^2 < w0 w2, exactly, once the weights are scaled: an arc of an ellipse.
bool is_ellipse(const RationalBezier& piece) {
  const double scale = 1.0 / std::max({piece.weight[0], piece.weight[1], piece.weight[2]});
  const std::array<double, 3> w = {scale * piece.weight[0], scale * piece.weight[1],
                                   scale * piece.weight[2]};
  const DoubleDouble square = two_product(w[1], w[1]), ends = two_product(w[0], w[2]);
  return square.hi != ends.hi ? square.hi < ends.hi : square.lo < ends.lo;
}

// A rational quartic N/W is the Moebius image of a conic, as the spirals in closed form are, when
// it is a quotient M/D of complex quadratics: N and W have a common factor of degree two. Then N D
// - W M = 0 has a solution, which are seven linear equations for the six coefficients of D and M.
constexpr std::size_t kEquations = 7;
constexpr std::size_t kUnknowns = 6;
using Column = std::array<std::complex<double>, kEquations>;

std::complex<double> product(const Column& a, const Column& b) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < kEquations; ++i) sum += std::conj(a[i]) * b[i];
  return sum;
}

double squared(const Column& a) {
  double sum = 0.0;
  for (const std::complex<double>& z : a) sum += std::norm(z);
  return sum;
}

/// How far the columns are from being dependent: what is left of the last of them, the longest
/// first, once the parts along the others are taken away.
double independence(std::array<Column, kUnknowns> columns) {
  double left = 0.0;
  for (std::size_t k = 0; k < kUnknowns; ++k) {
    const auto longest =
        std::max_element(columns.begin() + static_cast<std::ptrdiff_t>(k), columns.end(),
                         [](const Column& a, const Column& b) { return squared(a) < squared(b); });
    std::swap(columns[k], *longest);
    left = std::sqrt(squared(columns[k]));
    if (left == 0.0) return 0.0;
    for (std::complex<double>& z : columns[k]) z /= left;
    for (std::size_t j = k + 1; j < kUnknowns; ++j) {
      const std::complex<double> along = product(columns[k], columns[j]);
      for (std::size_t i = 0; i < kEquations; ++i) columns[j][i] -= along * columns[k][i];
    }
  }
  return left;
}

bool has_closed_form(const RationalBezier& piece) {
  constexpr std::size_t kDegree = 4;
  double extent = 0.0, coordinate = 0.0, heaviest = 0.0;
  for (std::size_t j = 0; j <= kDegree; ++j) {
    extent = std::max(extent, norm(piece.offset[j] - piece.offset[0]));
    coordinate = std::max(coordinate, norm(piece.offset[j]));
    heaviest = std::max(heaviest, piece.weight[j]);
  }
  std::array<Column, kUnknowns> columns{};
  for (std::size_t j = 0; j <= kDegree; ++j) {
    const double w = binomial(kDegree, static_cast<int>(j)) * (piece.weight[j] / heaviest);
    const Vec2 q = (piece.offset[j] - piece.offset[0]) / extent;
    for (std::size_t shift = 0; shift < kUnknowns / 2; ++shift) {
      columns[shift][j + shift] = {w * q.x, w * q.y};
      columns[kUnknowns / 2 + shift][j + shift] = -w;
    }
  }
  // what rounded control points and weights leave of an exact solution, with room
  constexpr double kRoundings = 4096.0;
  const double rounding = kUnitRoundoff * kRoundings * (1.0 + coordinate / extent);
  // control points are moved along tangents, and weights with them, to keep curvatures at joints
  constexpr double kMoved = 1e-7;  // of a leg
  return independence(columns) <= std::max(rounding, kMoved);
}

std::string name_of(const Piece& piece) {
  struct Names {
    std::string operator()(const LinePiece&) const { return "a line"; }
    std::string operator()(const ArcPiece&) const { return "an arc"; }
    std::string operator()(const ClothoidPiece&) const { return "a clothoid"; }
    std::string operator()(const RationalBezier& b) const {
      return fmt::format("a {} of degree {}", is_polynomial(b) ? "polynomial" : "rational curve",
                         b.degree);
    }
  };
  return std::visit(Names{}, piece);
}

/// What the pieces of a carrier are.
struct Kinds {
  const char* text;
  bool lines, arcs, clothoids;
  bool (*bezier)(const RationalBezier&);
};

Kinds kinds_of(Carrier carrier) {
  switch (carrier) {
    case Carrier::kSpiral:
      return {"rational quartics in the closed form, arcs and lines", true, true, false,
              [](const RationalBezier& b) { return b.degree == 4 && has_closed_form(b); }};
    case Carrier::kArcs:
      return {"arcs and lines", true, true, false, nullptr};
    case Carrier::kConics:
      return {"ellipse arcs, arcs and lines", true, true, false,
              [](const RationalBezier& b) { return b.degree == 2 && is_ellipse(b); }};
    case Carrier::kBeziers:
      return {"parabolas and lines", true, false, false,
              [](const RationalBezier& b) { return b.degree == 2 && is_polynomial(b); }};
    case Carrier::kClothoids:
      return {"clothoids, arcs and lines", true, true, true, nullptr};
    case Carrier::kBspline:
      return {"polynomials of degree 5, arcs and lines", true, true, false,
              [](const RationalBezier& b) { return b.degree == 5 && is_polynomial(b); }};
    case Carrier::kCubic:
      return {"polynomials of degree 3 and lines", true, false, false,
              [](const RationalBezier& b) { return b.degree == 3 && is_polynomial(b); }};
    case Carrier::kBaseline:
      break;
  }
  return {"any curve", true, true, true, [](const RationalBezier&) { return true; }};
}

/// What drawings draw and contours take over, whatever their carrier is.
constexpr Kinds kDrawn = {"lines, arcs, ellipse arcs and clothoids", true, true, true,
                          [](const RationalBezier& b) { return b.degree == 2 && is_ellipse(b); }};

bool belongs(const Kinds& kinds, const Piece& piece) {
  if (std::holds_alternative<LinePiece>(piece)) return kinds.lines;
  if (std::holds_alternative<ArcPiece>(piece)) return kinds.arcs;
  if (std::holds_alternative<ClothoidPiece>(piece)) return kinds.clothoids;
  return kinds.bezier != nullptr && kinds.bezier(std::get<RationalBezier>(piece));
}

}  // namespace

std::optional<ForeignPiece> foreign_piece(const Contour& contour) {
  const Kinds kinds = kinds_of(contour.carrier);
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    const bool kept = std::binary_search(contour.kept.begin(), contour.kept.end(), i);
    if (belongs(kept ? kDrawn : kinds, contour.pieces[i])) continue;
    const std::string what = name_of(contour.pieces[i]);
    if (kept) return ForeignPiece{i, fmt::format("drawings have {}, not {}", kDrawn.text, what)};
    return ForeignPiece{
        i, fmt::format("carrier {} has {}, not {}", to_string(contour.carrier), kinds.text, what)};
  }
  return std::nullopt;
}

}  // namespace obvid
