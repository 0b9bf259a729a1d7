// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "double_double.h"
#include "obvid/numeric/internal/bernstein.h"
#include "piece_facts.h"

namespace obvid {
namespace {  // see strict_arithmetic.h

/// What is proved about the sign of a polynomial on the open interval (0, 1).
enum class SignVerdict { kPositive, kNegative, kZero, kBoth, kOpen };

struct SignProof {
  SignVerdict verdict = SignVerdict::kOpen;
  double t0 = 0.0;  ///< kBoth: the sign changes between t0 and t1; kOpen: first part left open
  double t1 = 1.0;
  int first_sign = 0;  ///< kBoth: sign at t0
};

/// Arithmetic of one kind of coefficient. `kRoundoff` bounds the relative error of one operation.
template <class S>
struct Arithmetic;

template <>
struct Arithmetic<double> {
  static constexpr double kRoundoff = kUnitRoundoff;
  static constexpr int kDepth = 16;   ///< halvings; what is closer is left to the next arithmetic
  static constexpr int kParts = 128;  ///< looked at in all: time has an end on any polynomial
  static constexpr bool kExact = false;
  static int sign(double value, double bound) {
    return value > bound ? 1 : (value < -bound ? -1 : 0);
  }
  static double magnitude(double value) { return std::abs(value); }
  static double divided(double value, double by) { return value / by; }
  static double middle(double a, double b) { return 0.5 * (a + b); }
};

template <>
struct Arithmetic<DoubleDouble> {
  static constexpr double kRoundoff = kDoubleDoubleRoundoff;
  static constexpr int kDepth = 32;
  static constexpr int kParts = 128;
  static constexpr bool kExact = false;
  static int sign(const DoubleDouble& value, double bound) {
    // |lo| <= u |hi|, so hi alone understates the size by less than 2 u.
    constexpr double kLow = 1.0 - 4.0 * kUnitRoundoff;
    return kLow * value.hi > bound ? 1 : (kLow * value.hi < -bound ? -1 : 0);
  }
  static double magnitude(const DoubleDouble& value) {
    return std::abs(value.hi) * (1.0 + 4.0 * kUnitRoundoff);
  }
  static DoubleDouble divided(const DoubleDouble& value, double by) {
    // One Newton correction of the leading quotient: relative error below 8 u^2.
    const double q = value.hi / by;
    const DoubleDouble rest = value + (-two_product(q, by));
    return quick_two_sum(q, rest.hi / by);
  }
  static DoubleDouble middle(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble sum = a + b;
    return {0.5 * sum.hi, 0.5 * sum.lo};
  }
};

/// Proves the sign of a polynomial from its Bernstein coefficients, each known up to a bound, by
/// halving the interval where they disagree (docs/methods/certify.md).
template <class S>
class SignSearch {
 public:
  struct Coefficients {
    std::vector<S> value;       ///< Bernstein coefficients, not scaled
    std::vector<double> bound;  ///< absolute errors; all 0 in exact arithmetic
  };

  [[nodiscard]] SignProof run(const Coefficients& whole) {
    if (!Arithmetic<S>::kExact && (sign_of(whole, 0) == 0 || sign_of(whole, last(whole)) == 0)) {
      return {};  // no halving sharpens the value at an end
    }
    visit(whole, 0.0, 1.0, Arithmetic<S>::kDepth);
    if (both_) {
      // beyond the digits of a double the places are rounded, to one double perhaps
      const double outwards = beyond_double_ ? 1.0 : 0.0;
      return {SignVerdict::kBoth, std::nextafter(seen_at_, seen_at_ - outwards),
              std::nextafter(other_at_, other_at_ + outwards), seen_};
    }
    if (open_) return {SignVerdict::kOpen, open0_, open1_, 0};
    if (seen_ == 0) return {SignVerdict::kZero, 0.0, 1.0, 0};
    return {seen_ > 0 ? SignVerdict::kPositive : SignVerdict::kNegative, 0.0, 1.0, 0};
  }

  /// Strict signs from 0 to 1, none twice in a row. False when they are not sure: rounding hides
  /// signs somewhere, or the search was long.
  bool sequence(const Coefficients& whole, std::vector<SignFrom>& signs) {
    sequence_parts_ = kSequenceParts;
    return follow(whole, 0.0, 1.0, kSequenceDepth, signs);
  }

 private:
  static constexpr int kSequenceDepth = 40;  ///< halvings: closer changes count as none or as two
  static constexpr int kSequenceParts = 2000;

  /// Signs of all coefficients; unknown are those that rounding hides.
  struct SignCount {
    int positive = 0, negative = 0, unknown = 0;
    [[nodiscard]] bool none() const { return positive + negative == 0; }
    [[nodiscard]] bool agree() const { return unknown == 0 && (positive == 0 || negative == 0); }
    [[nodiscard]] int common() const { return none() ? 0 : (positive > 0 ? 1 : -1); }
  };

  static SignCount count_signs(const Coefficients& c) {
    SignCount out;
    for (std::size_t j = 0; j < c.value.size(); ++j) {
      const int sign = sign_of(c, j);
      out.positive += sign > 0;
      out.negative += sign < 0;
      out.unknown += sign == 0 && c.bound[j] > 0.0;
    }
    return out;
  }

  bool follow(const Coefficients& c, double t0, double t1, int depth,
              std::vector<SignFrom>& signs) {
    const SignCount found = count_signs(c);
    if (found.agree()) {
      const int sign = found.common();
      if (sign != 0 && (signs.empty() || signs.back().sign != sign)) signs.push_back({sign, t0});
      return true;
    }
    if (depth == 0) return true;
    if (found.none() || sequence_parts_-- <= 0) return false;
    const auto [left, right] = halves(c);
    const double middle = 0.5 * (t0 + t1);
    return follow(left, t0, middle, depth - 1, signs) &&
           follow(right, middle, t1, depth - 1, signs);
  }

  static std::size_t last(const Coefficients& c) { return c.value.size() - 1; }
  static int sign_of(const Coefficients& c, std::size_t j) {
    return Arithmetic<S>::sign(c.value[j], c.bound[j]);
  }

  void visit(const Coefficients& c, double t0, double t1, int depth) {
    const SignCount found = count_signs(c);
    if (found.agree()) {
      if (found.common() != 0) note(found.common(), c, t0, t1);
      return;
    }
    if (depth == 0 || found.none() || parts_left_ == 0) {
      leave_open(t0, t1);
      return;
    }
    --parts_left_;
    // halves of (0, 1), and the middle of one, are doubles as long as they have as many digits
    beyond_double_ =
        beyond_double_ || Arithmetic<S>::kDepth - depth + 2 > std::numeric_limits<double>::digits;
    const auto [left, right] = halves(c);
    const double middle = 0.5 * (t0 + t1);
    visit(left, t0, middle, depth - 1);
    if (!both_) visit(right, middle, t1, depth - 1);
  }

  /// The polynomial has a strict sign inside (t0, t1); at an end only if its coefficient has.
  void note(int sign, const Coefficients& c, double t0, double t1) {
    const double inside = 0.5 * (t0 + t1);
    if (seen_ != 0 && sign != seen_) {
      both_ = true;
      other_at_ = sign_of(c, 0) != 0 ? t0 : inside;
      return;
    }
    seen_ = sign;
    seen_at_ = sign_of(c, last(c)) != 0 ? t1 : inside;
  }

  void leave_open(double t0, double t1) {
    if (!open_) open0_ = t0;
    open1_ = t1;
    open_ = true;
  }

  /// de Casteljau at 1/2. Exact integers are kept as multiples of 2^-degree instead of halved.
  static std::array<Coefficients, 2> halves(Coefficients c) {
    const std::size_t n = last(c);
    std::array<Coefficients, 2> half = {c, c};
    for (std::size_t step = 0; step <= n; ++step) {
      store(half[0], step, c, 0, n - step);
      store(half[1], n - step, c, n - step, n - step);
      for (std::size_t j = 0; j + step < n; ++j) {
        c.value[j] = Arithmetic<S>::middle(c.value[j], c.value[j + 1]);
        c.bound[j] = (0.5 * (c.bound[j] + c.bound[j + 1]) +
                      Arithmetic<S>::kRoundoff * Arithmetic<S>::magnitude(c.value[j])) *
                     kBoundRounding;
      }
    }
    return half;
  }

  static void store(Coefficients& target, std::size_t j, const Coefficients& from, std::size_t k,
                    std::size_t doublings) {
    target.bound[j] = from.bound[k];
    if constexpr (Arithmetic<S>::kExact) {
      target.value[j] = Arithmetic<S>::doubled(from.value[k], doublings);
    } else {
      target.value[j] = from.value[k];
      static_cast<void>(doublings);
    }
  }

  /// Covers the roundings of the bound's own evaluation (four, each 2^-53).
  static constexpr double kBoundRounding = 1.0 + 0x1p-48;

  int parts_left_ = Arithmetic<S>::kParts;
  int sequence_parts_ = 0;
  bool both_ = false;
  bool open_ = false;
  bool beyond_double_ = false;
  int seen_ = 0;
  double seen_at_ = 0.0;
  double other_at_ = 1.0;
  double open0_ = 0.0;
  double open1_ = 1.0;
};

}  // namespace
}  // namespace obvid
