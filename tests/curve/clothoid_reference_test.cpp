// SPDX-License-Identifier: Apache-2.0
// End points of clothoids against MPFR: the power series of exp(i (b0 s + (b1 - b0) s^2/2)), summed
// with so many digits that its cancellation does not matter.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "obvid/curve/internal/clothoid.h"
#include "uniform.h"

#ifdef OBVID_HAS_MPFR
#include <mpfr.h>

namespace obvid {
namespace {

constexpr double kBound = 1e-14;  // of the length: what clothoid.h promises

class Real {
 public:
  explicit Real(mpfr_prec_t digits) { mpfr_init2(value_, digits); }
  Real(const Real&) = delete;
  Real& operator=(const Real&) = delete;
  ~Real() { mpfr_clear(value_); }
  operator mpfr_ptr() { return value_; }

 private:
  mpfr_t value_;
};

/// Terms and sums of the series for one size of phase.
class Reference {
 public:
  /// `phase` bounds |b0| + |b1|, rad.
  explicit Reference(double phase)
      : digits_(static_cast<mpfr_prec_t>(128.0 + 3.0 * phase)),
        c_(digits_),
        s_(digits_),
        c1_(digits_),
        s1_(digits_),
        next_c_(digits_),
        next_s_(digits_),
        a_(digits_),
        x_(digits_),
        y_(digits_),
        t_(digits_),
        u_(digits_) {}

  /// Difference of the unit clothoid's end point from `z`.
  double error(double theta, double b0, double b1, Vec2 z) {
    sum(b0, b1);
    mpfr_set_d(t_, theta, MPFR_RNDN);
    mpfr_sin_cos(u_, t_, t_, MPFR_RNDN);  // u = sin, t = cos
    mpfr_fmms(c_, x_, t_, y_, u_, MPFR_RNDN);
    mpfr_fmma(s_, x_, u_, y_, t_, MPFR_RNDN);
    mpfr_sub_d(c_, c_, z.x, MPFR_RNDN);
    mpfr_sub_d(s_, s_, z.y, MPFR_RNDN);
    return std::hypot(mpfr_get_d(c_, MPFR_RNDN), mpfr_get_d(s_, MPFR_RNDN));
  }

 private:
  /// f = exp(i phase): (n + 1) f_{n+1} = i (b0 f_n + a f_{n-1}); x + i y = sum of f_n/(n + 1).
  void sum(double b0, double b1) {
    mpfr_set_d(a_, b1, MPFR_RNDN);
    mpfr_sub_d(a_, a_, b0, MPFR_RNDN);
    mpfr_set_ui(c_, 1, MPFR_RNDN);
    mpfr_set_zero(s_, 1);
    mpfr_set_zero(c1_, 1);
    mpfr_set_zero(s1_, 1);
    mpfr_set(x_, c_, MPFR_RNDN);
    mpfr_set_zero(y_, 1);
    const auto exponent_at_end = -static_cast<mpfr_exp_t>(100);
    for (unsigned long n = 1;; ++n) {
      step(next_c_, s_, s1_, b0, n, true);
      step(next_s_, c_, c1_, b0, n, false);
      mpfr_swap(c1_, c_);
      mpfr_swap(s1_, s_);
      mpfr_swap(c_, next_c_);
      mpfr_swap(s_, next_s_);
      add(x_, c_, n + 1);
      add(y_, s_, n + 1);
      if (below(c_, exponent_at_end) && below(s_, exponent_at_end) && below(c1_, exponent_at_end) &&
          below(s1_, exponent_at_end)) {
        return;
      }
    }
  }

  void step(Real& out, Real& here, Real& before, double b0, unsigned long n, bool minus) {
    mpfr_mul_d(t_, here, minus ? -b0 : b0, MPFR_RNDN);
    mpfr_mul(u_, a_, before, MPFR_RNDN);
    minus ? mpfr_sub(t_, t_, u_, MPFR_RNDN) : mpfr_add(t_, t_, u_, MPFR_RNDN);
    mpfr_div_ui(out, t_, n, MPFR_RNDN);
  }

  void add(Real& sum, Real& term, unsigned long n) {
    mpfr_div_ui(t_, term, n, MPFR_RNDN);
    mpfr_add(sum, sum, t_, MPFR_RNDN);
  }

  static bool below(Real& x, mpfr_exp_t exponent) {
    return mpfr_zero_p(static_cast<mpfr_ptr>(x)) != 0 || mpfr_get_exp(x) < exponent;
  }

  mpfr_prec_t digits_;
  Real c_, s_, c1_, s1_, next_c_, next_s_, a_, x_, y_, t_, u_;
};

double either_sign(std::mt19937_64& rng, double low_power, double high_power) {
  const double size = std::pow(10.0, uniform(rng, low_power, high_power));
  return (rng() & 1U) != 0 ? size : -size;
}

/// Curvatures at both ends, times the length.
using Draw = Vec2 (*)(std::mt19937_64&);

void expect_close(const char* what, int cases, double phase, Draw draw) {
  std::mt19937_64 rng(20260401);
  Reference reference(phase);
  double worst = 0.0;
  for (int i = 0; i < cases; ++i) {
    const double theta = uniform(rng, -3.2, 3.2);
    const Vec2 b = draw(rng);
    // of any length: the clothoid is a similarity of the unit one
    const double length = std::ldexp(1.0, static_cast<int>(rng() % 41U) - 20);
    const Vec2 z = clothoid_step(theta, b.x / length, b.y / length, length) / length;
    const double error = reference.error(theta, b.x, b.y, z);
    worst = std::max(worst, error);
    ASSERT_LE(error, kBound) << what << ": " << theta << " " << b.x << " " << b.y;
  }
  std::printf("%s: %d cases, largest error %.2e of the length\n", what, cases, worst);
}

TEST(ClothoidAgainstMpfr, EveryKindOfEndIsMetToItsBound) {
  expect_close("short", 30000, 4.0, [](std::mt19937_64& rng) {
    return Vec2{uniform(rng, -2.0, 2.0), uniform(rng, -2.0, 2.0)};
  });
  expect_close("ordinary", 20000, 16.0, [](std::mt19937_64& rng) {
    return Vec2{uniform(rng, -8.0, 8.0), uniform(rng, -8.0, 8.0)};
  });
  expect_close("nearly circular", 20000, 16.0, [](std::mt19937_64& rng) {
    const double b0 = uniform(rng, -8.0, 8.0) / 1.1;
    return Vec2{b0, b0 * (1.0 + either_sign(rng, -16.0, -1.0))};
  });
  expect_close("nearly straight", 20000, 4.0, [](std::mt19937_64& rng) {
    return Vec2{either_sign(rng, -20.0, -1.0), either_sign(rng, -20.0, -1.0)};
  });
  expect_close("any size of curvature", 8000, 60.0, [](std::mt19937_64& rng) {
    return Vec2{either_sign(rng, -8.0, 1.4), either_sign(rng, -8.0, 1.4)};
  });
  expect_close("many turns", 2000, 400.0, [](std::mt19937_64& rng) {
    return Vec2{uniform(rng, -200.0, 200.0), uniform(rng, -200.0, 200.0)};
  });
}

TEST(ClothoidAgainstMpfr, NothingLeapsWhereTheSeriesHandsOverToTheTails) {
  // phases seen from the middle: (b0 + b1)/4 = 0.5, (b1 - b0)/8 = 0.25
  expect_close("hand-over", 10000, 8.0, [](std::mt19937_64& rng) {
    const bool by_linear = (rng() & 1U) != 0;
    const double near = 1.0 + either_sign(rng, -16.0, -2.0);
    const double linear = by_linear ? 0.5 * near : uniform(rng, -0.5, 0.5);
    const double square = by_linear ? uniform(rng, -0.25, 0.25) : 0.25 * near;
    return Vec2{2.0 * linear - 4.0 * square, 2.0 * linear + 4.0 * square};
  });
}

}  // namespace
}  // namespace obvid

#else

TEST(ClothoidAgainstMpfr, IsSkippedWithoutLibmpfr) { GTEST_SKIP() << "libmpfr-dev is missing"; }

#endif
