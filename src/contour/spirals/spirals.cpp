// SPDX-License-Identifier: Apache-2.0
#include "obvid/contour/spirals.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace obvid {
namespace {

/// Bernstein coefficients of a complex quadratic, read from the start of the piece to its end.
using ComplexQuadratic = std::array<Vec2, 3>;

constexpr Vec2 conjugate(Vec2 z) { return {z.x, -z.y}; }

/// a * conj(b) as a complex quartic in Bernstein form.
std::array<Vec2, 5> product_with_conjugate(const ComplexQuadratic& a, const ComplexQuadratic& b) {
  const auto times = [&](std::size_t i, std::size_t j) {
    return complex_product(a[i], conjugate(b[j]));
  };
  return {times(0, 0), 0.5 * (times(0, 1) + times(1, 0)),
          (times(0, 2) + 4.0 * times(1, 1) + times(2, 0)) / 6.0, 0.5 * (times(1, 2) + times(2, 1)),
          times(2, 2)};
}

/// A rational quartic before division: weights and weighted points, relative to the start of the
/// chord, in half chords of the chord's frame.
struct Homogeneous {
  std::array<double, 5> weight;
  std::array<Vec2, 5> point;
};

/// Pieces that turn farther are split: the region's theorem and every CAD kernel want short ones.
constexpr double kLargestTurn = 2.4;
/// Splits that make every weight positive: the weight function is positive, so its Bernstein
/// coefficients become so after a few halvings.
constexpr int kMostSplits = 8;

Homogeneous homogeneous_piece(double rho, double sine, double sigma, double beta, double B) {
  const Vec2 one_minus_b = rho * unit_at(sigma);
  const Vec2 delta = (-rho * sine / B) * unit_at(beta);
  // z = N / D on the chord from -1 to 1; offsets from the start come from N + D
  const ComplexQuadratic denominator = {-delta, 0.5 * (one_minus_b - delta), Vec2{1.0, 0.0}};
  const ComplexQuadratic from_start = {Vec2{0.0, 0.0}, one_minus_b, Vec2{2.0, 0.0}};
  const std::array<Vec2, 5> weights = product_with_conjugate(denominator, denominator);
  Homogeneous h{{}, product_with_conjugate(from_start, denominator)};
  for (std::size_t j = 0; j < 5; ++j) h.weight[j] = weights[j].x;
  return h;
}

/// The same from the shape of any form: D = (1 - x)(1 - x + g e^{i trail} x) + mu x (g e^{i lead}
/// (1 - x) + x), z + 1 = 2 mu x (g e^{i lead} (1 - x) + x) / D (docs/methods/g3.md).
Homogeneous homogeneous_piece(const SpiralShape& shape, double alpha) {
  const double g = std::sqrt(shape.gain);
  const Vec2 mu = shape.mu * unit_at(alpha - shape.lead);
  const Vec2 lead = complex_product(mu, g * unit_at(shape.lead)), trail = g * unit_at(shape.trail);
  const ComplexQuadratic denominator = {Vec2{1.0, 0.0}, 0.5 * (lead + trail), mu};
  const ComplexQuadratic from_start = {Vec2{0.0, 0.0}, lead, 2.0 * mu};
  const std::array<Vec2, 5> weights = product_with_conjugate(denominator, denominator);
  Homogeneous h{{}, product_with_conjugate(from_start, denominator)};
  for (std::size_t j = 0; j < 5; ++j) h.weight[j] = weights[j].x;
  return h;
}

/// de Casteljau at t: the first part is returned, `h` becomes the second.
Homogeneous cut_off_first(Homogeneous& h, double t) {
  Homogeneous first = h;
  for (std::size_t level = 1; level < 5; ++level) {
    for (std::size_t j = 0; j + level < 5; ++j) {
      h.weight[j] += t * (h.weight[j + 1] - h.weight[j]);
      h.point[j] = h.point[j] + t * (h.point[j + 1] - h.point[j]);
    }
    first.weight[level] = h.weight[0];
    first.point[level] = h.point[0];
  }
  return first;
}

/// Parameter at which both halves weigh alike; the middle of the curve rather than of t.
double balanced_middle(const Homogeneous& h) {
  const double r = std::sqrt(std::sqrt(h.weight[0] / h.weight[4]));
  return r / (1.0 + r);
}

bool weights_positive(const Homogeneous& h) {
  return *std::min_element(h.weight.begin(), h.weight.end()) > 0.0;
}

/// Scales the end weights to 1 (a Moebius change of parameter leaves the curve as it is) and
/// places the piece. The origin is the start of the whole chord.
RationalBezier placed(const Homogeneous& h, double d, Vec2 origin, Vec2 half_chord) {
  RationalBezier piece;
  piece.origin = origin;
  piece.degree = 4;
  const double ratio = std::sqrt(std::sqrt(h.weight[4] / h.weight[0]));
  double scale = 1.0 / h.weight[4];
  for (std::size_t j = 5; j-- > 0; scale *= ratio) {
    const Vec2 z = h.point[j] / h.weight[j];
    piece.offset[j] = complex_product({z.x, d * z.y}, half_chord);
    piece.weight[j] = h.weight[j] * scale;
  }
  piece.weight[0] = piece.weight[4] = 1.0;
  return piece;
}

/// Whether the legs of the control polygon turn by no more than the limit in all: then so does a
/// curve with positive weights.
bool polygon_turns_little(const Homogeneous& h) {
  double turn = 0.0;
  Vec2 before;
  for (std::size_t j = 1; j < 5; ++j) {
    const Vec2 leg = h.point[j] / h.weight[j] - h.point[j - 1] / h.weight[j - 1];
    if (j > 1) turn += std::abs(turning(before, leg));
    before = leg;
  }
  return turn <= kLargestTurn;
}

/// `far`: the whole turns so far that its parts have to be looked at, however their weights are.
void append_parts(Homogeneous h, int splits_left, bool far, double d, Vec2 origin, Vec2 half_chord,
                  std::vector<RationalBezier>& pieces) {
  const bool too_much = !weights_positive(h) || (far && !polygon_turns_little(h));
  if (splits_left > 0 && too_much) {
    const Homogeneous first = cut_off_first(h, balanced_middle(h));
    append_parts(first, splits_left - 1, far, d, origin, half_chord, pieces);
    append_parts(h, splits_left - 1, far, d, origin, half_chord, pieces);
    return;
  }
  pieces.push_back(placed(h, d, origin, half_chord));
}

}  // namespace

bool append_spiral(const LinkState& link, int direction, SpiralForm form, Vec2 start, Vec2 end,
                   std::vector<RationalBezier>& pieces) {
  if (!(cone_margin(link, direction, cone_of(form)) > 0.0)) return false;
  const double d = direction;
  Homogeneous whole;
  if (form == SpiralForm::kOneSided) {
    const double sigma = d * link.sigma, A = d * link.A, B = d * link.B, sine = std::sin(sigma);
    whole = homogeneous_piece(sine * sine / (-A * B), sine, sigma, d * link.beta, B);
  } else {
    const SpiralShape shape = spiral_shape(link, direction, form);
    if (!shape.exists()) return false;
    whole = homogeneous_piece(shape, d * link.alpha);
  }
  const std::size_t before = pieces.size();
  const bool turns_far = std::abs(link.beta - link.alpha) > kLargestTurn;
  append_parts(whole, kMostSplits, turns_far, d, start, 0.5 * (end - start), pieces);
  pieces[before].offset[0] = {0.0, 0.0};
  pieces.back().offset[4] = end - start;
  return true;
}

bool append_spiral(const LinkState& link, int direction, Vec2 start, Vec2 end,
                   std::vector<RationalBezier>& pieces) {
  return append_spiral(link, direction, SpiralForm::kOneSided, start, end, pieces);
}

}  // namespace obvid
