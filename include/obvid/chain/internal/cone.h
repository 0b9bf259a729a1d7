// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "obvid/chain/internal/chain.h"

namespace obvid {

/// A link in the quantities of which its cone is made: m = B - A, q = A + B, sigma = alpha + beta.
struct ConeVariables {
  double m = 0.0, q = 0.0, sigma = 0.0, sin_sigma = 0.0, cos_sigma = 1.0;
};

/// S(sigma) of a cone (d m + s z)^2 - q^2 > S^2, odd, and its derivative, even.
struct ConeWidth {
  double value = 0.0, slope = 0.0;
};

/// `reserve`: how much more than mere existence needs the cone of kSpiral keeps, as a factor of
/// S^2. The closed form's cone keeps 1.1. Beyond sigma = 1.3 it is continued by its tangent: it has
/// no finite value at a right angle, and a search may start there. Results are judged by the true
/// cone.
[[nodiscard]] inline ConeWidth cone_width(Cone cone, const ConeVariables& v, double reserve) {
  constexpr double kClosedFormReserve = 1.1;
  constexpr double kStraightenedSigma = 1.3;  // rad
  if (cone == Cone::kSpiral) {
    const double k = 2.0 * std::sqrt(reserve);
    return {k * std::sin(0.5 * v.sigma), 0.5 * k * std::cos(0.5 * v.sigma)};
  }
  const bool straight = std::abs(v.sigma) > kStraightenedSigma;
  const double sine = straight ? std::sin(kStraightenedSigma) : v.sin_sigma;
  const double cosine = straight ? std::cos(kStraightenedSigma) : v.cos_sigma;
  const double scale = std::sqrt(2.0 * kClosedFormReserve) / std::sqrt(cosine);
  const double slope = scale * (cosine + 0.5 * sine * sine / cosine);
  if (!straight) return {scale * sine, slope};
  const double beyond = std::abs(v.sigma) - kStraightenedSigma;
  return {std::copysign(scale * sine + slope * beyond, v.sigma), slope};
}

/// Quadratic form departure (m - ratio sigma)^2 + size sigma^2 + skew q^2, over the square of the
/// link's expected size.
struct LinkEnergy {
  double departure = 0.0, ratio = 0.0, size = 0.0, skew = 0.0;

  [[nodiscard]] double of(const ConeVariables& v) const {
    const double off = v.m - ratio * v.sigma;
    return departure * off * off + size * v.sigma * v.sigma + skew * v.q * v.q;
  }
};

/// Weight of the barrier in the final problem, against the energy of a link of expected size.
inline constexpr double kFinalBarrier = 0.3;
/// Departure from a clothoid (m = 2 sigma), skewness, size. The size balances the final barrier, so
/// that the clothoid which the data predict is stationary (docs/methods/chain.md, section 4:
/// statistics of 1,200 random spirals decided).
inline constexpr LinkEnergy kFairEnergy{24.0, 2.0, 5.0 * kFinalBarrier, 6.0};

inline constexpr double kSigmaWeight = 0.5;  ///< of the barrier of sigma > 0, against the cone's
inline constexpr double kSignWeight = 0.5;   ///< of the barrier of the curvature's sign

/// The arguments of a link's barriers - log(f) - kSigmaWeight log(u): t, f > 0 in the cone of
/// direction d, u > 0 where sigma has its sign.
struct ConeRoom {
  double t = 0.0, f = 1.0, u = 1.0;
  ConeWidth width;

  [[nodiscard]] bool inside() const { return t > 0.0 && f > 0.0 && u > 0.0; }
};

/// `size` is the link's unit for the common slack.
[[nodiscard]] inline ConeRoom cone_room(const ConeVariables& v, const ConeWidth& width, double d,
                                        double size, double slack) {
  ConeRoom out;
  out.width = width;
  out.t = d * v.m + slack * size;
  out.f = out.t * out.t - v.q * v.q - width.value * width.value;
  out.u = d * v.sigma + slack * size;
  return out;
}

/// First and second derivatives of a link's merit by m, q, sigma (g, h) and with the slack (z).
struct ConeTerms {
  double gm = 0.0, gq = 0.0, gs = 0.0;
  double hmm = 0.0, hmq = 0.0, hms = 0.0, hqq = 0.0, hqs = 0.0, hss = 0.0;
  double zm = 0.0, zq = 0.0, zs = 0.0;
  double slack_gradient = 0.0, slack_hessian = 0.0;
};

/// Of weight * form + barrier * (- log(f) - kSigmaWeight log(u)). Gradients are exact. In `hss` the
/// second derivative of S is left out: the Hessian is that of the barrier of a cone in (m, q, S)
/// with S linear in sigma, so it is never indefinite.
[[nodiscard]] inline ConeTerms cone_terms(const ConeVariables& v, const ConeRoom& c, double d,
                                          double size, const LinkEnergy& form, double weight,
                                          double barrier) {
  ConeTerms out;
  const double departure = 2.0 * weight * form.departure;
  out.gm = departure * (v.m - form.ratio * v.sigma);
  out.gq = 2.0 * weight * form.skew * v.q;
  out.gs = 2.0 * weight * form.size * v.sigma - form.ratio * out.gm;
  out.hmm = departure;
  out.hms = -form.ratio * departure;
  out.hqq = 2.0 * weight * form.skew;
  out.hss = 2.0 * weight * form.size + form.ratio * form.ratio * departure;
  if (!(barrier > 0.0)) return out;
  const double fm = 2.0 * c.t * d, fq = -2.0 * v.q, fs = -2.0 * c.width.value * c.width.slope;
  const double fz = 2.0 * c.t * size;
  const double r = 1.0 / c.f, wr = barrier * r, wrr = wr * r;
  const double us = kSigmaWeight * barrier / c.u, uss = us / c.u;
  out.gm -= wr * fm;
  out.gq -= wr * fq;
  out.gs -= wr * fs + us * d;
  out.hmm += wrr * fm * fm - 2.0 * wr;
  out.hqq += wrr * fq * fq + 2.0 * wr;
  out.hss += wrr * fs * fs + 2.0 * wr * c.width.slope * c.width.slope + uss;
  out.hms += wrr * fm * fs;
  out.hmq = wrr * fm * fq;
  out.hqs = wrr * fq * fs;
  out.zm = wrr * fz * fm - 2.0 * wr * size * d;
  out.zq = wrr * fz * fq;
  out.zs = wrr * fz * fs + uss * size * d;
  out.slack_gradient = -wr * fz - us * size;
  out.slack_hessian = wrr * fz * fz - 2.0 * wr * size * size + uss * size * size;
  return out;
}

/// Sum of logarithms with one call of log for many factors.
class LogSum {
 public:
  void add(double factor) {
    product_ *= factor;
    constexpr double kLarge = 1e150, kSmall = 1e-150;  // the next factor cannot leave the range
    if (product_ > kLarge || product_ < kSmall) {
      sum_ += std::log(product_);
      product_ = 1.0;
    }
  }
  [[nodiscard]] double value() const { return sum_ + std::log(product_); }

 private:
  double product_ = 1.0, sum_ = 0.0;
};

}  // namespace obvid
