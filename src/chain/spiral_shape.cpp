// SPDX-License-Identifier: Apache-2.0
#include "obvid/chain/internal/spiral_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace obvid {
namespace {

/// A link of increasing curvature by its three invariants.
struct Increasing {
  double A = 0.0, B = 0.0, sigma = 0.0;
  double turn = 0.0;  ///< rad, of the larger angle between chord and tangent: for roundings alone

  [[nodiscard]] bool valid() const { return A < 0.0 && B > 0.0 && sigma > 0.0; }
};

Increasing increasing(const LinkState& link, int direction) {
  const double d = direction;
  const double turn = std::max(std::abs(link.alpha), std::abs(link.beta));
  return {d * link.A, d * link.B, d * link.sigma, turn};
}

/// Reads a link from its end: the curve backwards turns the other way round and its curvature
/// grows again.
Increasing backwards(const Increasing& l) { return {-l.B, -l.A, l.sigma, l.turn}; }

/// tan(lead) of the spiral at rest at its start: the negative root of
/// T^3 - 3 tan(sigma) T^2 + (q - 3) T + tan(sigma), q = -4 A B / (sin^2(sigma) cos(sigma)).
/// The cubic is concave left of it: Newton's method from the left goes there without leaving out.
double resting_tangent(double product, double sigma) {
  const double tangent = std::tan(sigma), sine = std::sin(sigma);
  const double linear = 4.0 * product / (sine * sine * std::cos(sigma)) - 3.0;
  // left of all roots (Fujiwara): twice the largest of |c2|, sqrt|c1|, cbrt|c0|
  double t = -2.0 * std::max({3.0 * tangent, std::sqrt(std::abs(linear)), std::cbrt(tangent)});
  constexpr int kMostSteps = 100;
  for (int k = 0; k < kMostSteps; ++k) {
    const double value = ((t - 3.0 * tangent) * t + linear) * t + tangent;
    const double slope = (3.0 * t - 6.0 * tangent) * t + linear;
    const double next = t - value / slope;
    if (!(next > t)) break;  // rounding ends the ascent
    t = next;
  }
  return t;
}

double resting_lead(const Increasing& l) { return std::atan(resting_tangent(-l.A * l.B, l.sigma)); }

/// The spiral of given leads and 1/g^2.
SpiralShape with_leads(const Increasing& l, double lead, double trail, double inverse_gain) {
  const double gain = 1.0 / inverse_gain;
  return {lead, trail, gain, -(std::sin(lead) + gain * std::sin(trail)) / (l.A * gain)};
}

/// -A B = (y sin(lead) + sin(trail)) (y sin(trail) + sin(lead)), y = 1/g^2.
SpiralShape one_sided(const Increasing& l) {
  const double sine = std::sin(l.sigma);
  return with_leads(l, l.sigma, 0.0, -l.A * l.B / (sine * sine));
}

SpiralShape even(const Increasing& l) {
  const double half = 0.5 * l.sigma;
  return with_leads(l, half, half, std::sqrt(-l.A * l.B) / std::sin(half) - 1.0);
}

/// The slope at an end at rest is this part of that of a clothoid with the link's sigma, not zero:
/// what a proof of a strict growth can tell from the rounding of the numbers, and a tenth of
/// what counts as a step.
constexpr double kRestingPart = 1e-7;
/// Rounding of stored control points moves a slope by some units of 2^-53 over sigma, relatively.
constexpr double kRestingRoundings = 1e4;
constexpr double kMostRestingPart = 1e-3;  ///< whatever their rounding
/// Where a piece turns by more than this, weights make up for it (curve/internal/end_slopes.h):
/// what is left are their own roundings, less by as much as it turns.
constexpr double kLeastTurn = 1e-6;
constexpr double kRestingWeights = 64.0;

double resting_part(const Increasing& l) {
  const double of_points = kRestingRoundings * 0x1p-53 / l.sigma;
  const double of_weights = kRestingWeights * 0x1p-53 * l.turn / l.sigma;
  return std::clamp(l.turn > kLeastTurn ? std::min(of_points, of_weights) : of_points, kRestingPart,
                    kMostRestingPart);
}

/// Leads and y of a spiral near rest at its start.
struct NearRest {
  double lead = 0.0, trail = 0.0, y = 1.0;

  /// y on the curve -A B = (y sin(lead) + sin(trail)) (y sin(trail) + sin(lead)).
  void settle(double product) {
    const double s0 = std::sin(lead), s1 = std::sin(trail);
    constexpr int kSteps = 3;
    for (int k = 0; k < kSteps; ++k) {
      const double u = y * s0 + s1, v = y * s1 + s0;
      y -= (u * v - product) / (s0 * v + s1 * u);
    }
  }
  /// Slope at the start over that of a clothoid, 3/2 sigma.
  [[nodiscard]] double part(const Increasing& l) const {
    const double skew = std::sin(trail - lead);
    const double u = y * std::sin(lead) + std::sin(trail);
    return l.A * l.A * y * (y * std::sin(2.0 * lead) + skew) / (u * u * l.sigma);
  }
  /// Slope at the end.
  [[nodiscard]] double far_slope(const Increasing& l) const {
    const double skew = std::sin(trail - lead);
    const double v = y * std::sin(trail) + std::sin(lead);
    return 1.5 * l.B * l.B * y * (y * std::sin(2.0 * trail) - skew) / (v * v);
  }
};

/// y = sin(lead - trail)/sin(2 lead) is at rest at the start; the lead is shortened from there.
NearRest near_rest(const Increasing& l, double lead) {
  const double trail = l.sigma - lead;
  NearRest rest{lead, trail, std::sin(lead - trail) / std::sin(2.0 * lead)};
  constexpr double kProbe = 1e-5;  // of the lead: the slope grows in proportion
  NearRest probe{(1.0 - kProbe) * lead, l.sigma - (1.0 - kProbe) * lead, rest.y};
  probe.settle(-l.A * l.B);
  const double share = kProbe * resting_part(l) / probe.part(l);
  rest.lead = (1.0 - share) * lead;
  rest.trail = l.sigma - rest.lead;
  rest.settle(-l.A * l.B);
  return rest;
}

SpiralShape from_rest(const Increasing& l) {
  const NearRest rest = near_rest(l, resting_lead(l));
  return with_leads(l, rest.lead, rest.trail, rest.y);
}

/// The mirror image of the curve backwards.
SpiralShape to_rest(const Increasing& l) {
  const SpiralShape there = from_rest(backwards(l));
  return {there.trail, there.lead, there.gain, 1.0 / there.mu};
}

constexpr double kLog1_5 = 0.4054651081081644;

SpiralSlopes even_slopes(const Increasing& l) {
  SpiralSlopes out;
  const double half = 0.5 * l.sigma, sine = std::sin(half), cosine = std::cos(half);
  const double root = std::sqrt(-l.A * l.B) / sine;  // 1 + y
  const double y = root - 1.0;
  // log y
  const double by = root / y;
  const LinkGradient log_y{std::log(y), 0.5 * by / l.A, 0.5 * by / l.B, -0.5 * by * cosine / sine};
  const double cot = 0.5 * (cosine / sine - sine / cosine);
  const double common = kLog1_5 + std::log(2.0 * sine * cosine) + 2.0 * log_y.value;
  const double ratio = std::log(-l.B / l.A);
  out.start = {common - ratio, 2.0 * log_y.by_A + 1.0 / l.A, 2.0 * log_y.by_B - 1.0 / l.B,
               2.0 * log_y.by_sigma + cot};
  out.end = {common + ratio, 2.0 * log_y.by_A - 1.0 / l.A, 2.0 * log_y.by_B + 1.0 / l.B,
             2.0 * log_y.by_sigma + cot};
  out.change = {2.0 * ratio, -2.0 / l.A, 2.0 / l.B, 0.0};
  // middle against the geometric mean of the ends
  const double x = 0.25 * std::abs(ratio), m = std::expm1(-2.0 * x);
  const double lift = std::copysign(-m / (2.0 + m), ratio);         // tanh(ratio/4)
  out.bend = {4.0 * (x + std::log1p(0.5 * m)) - 2.5 * log_y.value,  // log cosh(ratio/4)
              -lift / l.A - 2.5 * log_y.by_A, lift / l.B - 2.5 * log_y.by_B, -2.5 * log_y.by_sigma};
  return out;
}

SpiralSlopes slopes_from_rest(const Increasing& l) {
  SpiralSlopes out;
  constexpr double kMinusInfinity = -std::numeric_limits<double>::infinity();
  const double g = resting_lead(l), s = l.sigma;
  const double sine = std::sin(s), cot = std::cos(s) / sine;
  const double s2 = std::sin(2.0 * g - s), c2 = std::cos(2.0 * g - s);
  const double s3 = std::sin(3.0 * g - s), cot3 = std::cos(3.0 * g - s) / s3;
  // -A B = sin^2(sigma) sin(3 g - sigma) / (4 sin(g) cos^2(g))
  const double by_g = 3.0 * cot3 - 1.0 / std::tan(g) + 2.0 * std::tan(g);
  const double g_product = 1.0 / by_g;                // by log(-A B)
  const double g_sigma = -(2.0 * cot - cot3) / by_g;  // by sigma
  const double log_g = 4.0 * c2 / s2 - 2.0 * s2 / c2 - 6.0 * cot3;
  const double log_sigma = -2.0 * c2 / s2 + s2 / c2 - cot + 2.0 * cot3;
  out.start = {kMinusInfinity, 0.0, 0.0, 0.0};
  // exactly at rest the far slope is 3 B^2 sin^2(2 g - sigma) cos(2 g - sigma) /
  // (sin(sigma) sin^2(3 g - sigma)): good for derivatives
  out.end = {std::log(near_rest(l, g).far_slope(l)), log_g * g_product / l.A,
             (2.0 + log_g * g_product) / l.B, log_sigma + log_g * g_sigma};
  out.change = {std::log(-3.0 * l.A / l.B), 1.0 / l.A, -1.0 / l.B, 0.0};
  out.bend = {std::log(-4.0 * l.A * l.B / (3.0 * sine * sine)), 1.0 / l.A, 1.0 / l.B, -2.0 * cot};
  return out;
}

/// Derivatives of what was computed for the link read from its end.
LinkGradient forwards(const LinkGradient& g) { return {g.value, -g.by_B, -g.by_A, g.by_sigma}; }

}  // namespace

SpiralShape spiral_shape(const LinkState& link, int direction, SpiralForm form) {
  const Increasing l = increasing(link, direction);
  switch (form) {
    case SpiralForm::kOneSided:
      return one_sided(l);
    case SpiralForm::kEven:
      return even(l);
    case SpiralForm::kRestAtStart:
      return from_rest(l);
    case SpiralForm::kRestAtEnd:
      return to_rest(l);
  }
  return {};
}

SpiralSlopes spiral_slopes(const LinkState& link, int direction, SpiralForm form) {
  const Increasing l = increasing(link, direction);
  if (!l.valid()) {
    SpiralSlopes none;
    none.start.value = none.end.value = none.change.value = none.bend.value =
        std::numeric_limits<double>::quiet_NaN();
    return none;
  }
  if (form == SpiralForm::kEven) return even_slopes(l);
  if (form == SpiralForm::kRestAtStart) return slopes_from_rest(l);
  const SpiralSlopes there = slopes_from_rest(backwards(l));
  return {forwards(there.end), forwards(there.start), forwards(there.change), forwards(there.bend)};
}

}  // namespace obvid
