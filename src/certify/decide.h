// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "curvature_form.h"
#include "piece_facts.h"
#include "sign_search.h"

namespace obvid {
namespace {  // see strict_arithmetic.h

/// Direction with small integer components: a product with it is exact enough in every arithmetic.
struct LatticeDirection {
  int x = 0;
  int y = 0;
};

/// Directions against which the hodograph is tested: the chord, and the bisector of both ends.
using TestDirections = std::array<LatticeDirection, 2>;

/// Absolute error that underflow may cause in any coefficient, once coordinates and weights are
/// scaled to 1: fewer than 10^5 operations, each wrong by 2^-1022 at most (the low part of a
/// product of double-doubles), amplified by factors below 2^80.
inline constexpr double kUnderflow = 0x1p-900;

/// Covers the roundings of the majorant and of the bound themselves, and k u / (1 - k u) for k u.
inline constexpr double kMajorantRounding = 1.01;

template <class S>
[[nodiscard]] constexpr double error_bound(int roundings, double majorant) {
  if constexpr (Arithmetic<S>::kExact) {
    return 0.0;
  } else {
    return roundings * Arithmetic<S>::kRoundoff * kMajorantRounding * majorant + kUnderflow;
  }
}

/// Bernstein coefficients from scaled ones, with what rounding may have done to them.
template <class S, std::size_t Count>
[[nodiscard]] typename SignSearch<S>::Coefficients plain_form(
    const std::array<S, Count>& c, const std::array<double, Count>& majorant, int roundings) {
  typename SignSearch<S>::Coefficients plain;
  plain.value.reserve(Count);
  plain.bound.reserve(Count);
  for (std::size_t j = 0; j < Count; ++j) {
    if constexpr (Arithmetic<S>::kExact) {
      plain.value.push_back(
          Arithmetic<S>::unscaled(c[j], static_cast<int>(Count) - 1, static_cast<int>(j)));
      plain.bound.push_back(0.0);
    } else {
      const double scale = binomial(static_cast<int>(Count) - 1, static_cast<int>(j));
      plain.value.push_back(Arithmetic<S>::divided(c[j], scale));
      plain.bound.push_back(error_bound<S>(roundings + 1, majorant[j]) / scale);
    }
  }
  return plain;
}

/// Sign of a polynomial in scaled form: at a glance where all coefficients agree, else by search.
template <class S, std::size_t Count>
[[nodiscard]] SignProof prove_sign(const std::array<S, Count>& c,
                                   const std::array<double, Count>& majorant, int roundings) {
  std::array<double, Count> bound{};
  std::size_t positive = 0;
  std::size_t negative = 0;
  for (std::size_t j = 0; j < Count; ++j) {
    bound[j] = error_bound<S>(roundings, majorant[j]);
    const int sign = Arithmetic<S>::sign(c[j], bound[j]);
    positive += sign > 0;
    negative += sign < 0;
  }
  if (positive == Count) return {SignVerdict::kPositive};
  if (negative == Count) return {SignVerdict::kNegative};

  return SignSearch<S>{}.run(plain_form(c, majorant, roundings));
}

template <int N, class S>
[[nodiscard]] bool weight_is_positive(const ControlDifferences<N, S>& p) {
  std::array<S, N + 1> scaled{};
  std::array<double, N + 1> no_error{};
  bool all = true;
  for (std::size_t j = 0; j <= N; ++j) {
    scaled[j] = p.weight[j] * form::kFactors<N>.weight[j];
    all = all && Arithmetic<S>::sign(p.weight[j], 0.0) > 0;
    if constexpr (!Arithmetic<S>::kExact) no_error[j] = Arithmetic<S>::magnitude(scaled[j]);
  }
  return all || prove_sign(scaled, no_error, 1).verdict == SignVerdict::kPositive;
}

template <int N, class S>
[[nodiscard]] SignProof prove_forward(const CurvatureForm<N, S>& f,
                                      const CurvatureForm<N, double>& majorant,
                                      LatticeDirection direction) {
  std::array<S, 2 * N - 1> along{};
  std::array<double, 2 * N - 1> bound{};
  for (std::size_t j = 0; j < along.size(); ++j) {
    along[j] = f.u[j] * direction.x + f.v[j] * direction.y;
    bound[j] = majorant.u[j] * std::abs(direction.x) + majorant.v[j] * std::abs(direction.y);
  }
  constexpr int kProductAndSum = 2;
  return prove_sign(along, bound, form::Roundings<N>::kHodograph + kProductAndSum);
}

enum class Speed { kForward, kPositive, kOpen };

/// Is the piece regular, and does it stay within a half plane of directions?
template <int N, class S>
[[nodiscard]] Speed prove_speed(const CurvatureForm<N, S>& f,
                                const CurvatureForm<N, double>& majorant,
                                const TestDirections& directions) {
  bool open = false;
  for (const LatticeDirection direction : directions) {
    const SignProof proof = prove_forward(f, majorant, direction);
    if (proof.verdict == SignVerdict::kPositive) return Speed::kForward;
    open = open || proof.verdict == SignVerdict::kOpen;
  }
  if (open && !Arithmetic<S>::kExact) return Speed::kOpen;
  const SignProof speed = prove_sign(f.speed, majorant.speed, form::Roundings<N>::kSpeed);
  return speed.verdict == SignVerdict::kPositive ? Speed::kPositive : Speed::kOpen;
}

[[nodiscard]] inline PieceFacts facts_of(const SignProof& change, bool forward) {
  PieceFacts facts;
  facts.turns_below_pi = forward;
  switch (change.verdict) {
    case SignVerdict::kPositive:
      facts.proof.verdict = Verdict::kIncreasing;
      facts.first_change = facts.last_change = 1;
      break;
    case SignVerdict::kNegative:
      facts.proof.verdict = Verdict::kDecreasing;
      facts.first_change = facts.last_change = -1;
      break;
    case SignVerdict::kZero:
      facts.proof.verdict = Verdict::kConstant;
      break;
    case SignVerdict::kBoth:
      facts.proof = {Verdict::kHasVertex, false, change.t0, change.t1};
      facts.first_change = change.first_sign;
      facts.last_change = -change.first_sign;
      break;
    case SignVerdict::kOpen:
      facts.proof.t0 = change.t0;
      facts.proof.t1 = change.t1;
      break;
  }
  return facts;
}

/// The whole proof of a piece in one arithmetic; undecided where it does not suffice.
template <int N, class S>
[[nodiscard]] PieceFacts decide(const ControlDifferences<N, S>& p,
                                const CurvatureForm<N, double>& majorant,
                                const TestDirections& directions) {
  if (!weight_is_positive(p)) return {};
  const CurvatureForm<N, S> f = curvature_form<false>(p);
  const Speed speed = prove_speed(f, majorant, directions);
  if (speed == Speed::kOpen) return {};
  return facts_of(prove_sign(f.test, majorant.test, form::Roundings<N>::kTest),
                  speed == Speed::kForward);
}

/// Signs of the curvature from 0 to 1; false where they are not sure.
template <int N, class S>
[[nodiscard]] bool bend_signs(const ControlDifferences<N, S>& p,
                              const std::array<double, 3 * N - 5>& majorant,
                              std::vector<SignFrom>& signs) {
  signs.clear();
  return SignSearch<S>{}.sequence(
      plain_form(determinant<false>(p), majorant, form::Roundings<N>::kDeterminant), signs);
}

/// Signs of the test polynomial from 0 to 1; false where they are not sure.
template <int N, class S>
[[nodiscard]] bool change_signs(const ControlDifferences<N, S>& p,
                                const CurvatureForm<N, double>& majorant,
                                std::vector<SignFrom>& signs) {
  const CurvatureForm<N, S> f = curvature_form<false>(p);
  signs.clear();
  return SignSearch<S>{}.sequence(plain_form(f.test, majorant.test, form::Roundings<N>::kTest),
                                  signs);
}

}  // namespace
}  // namespace obvid
