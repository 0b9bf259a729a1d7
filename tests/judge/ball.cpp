// SPDX-License-Identifier: Apache-2.0
#include "ball.h"

namespace judge {
namespace {
thread_local long bits_in_use = kFiftyDigits;
}

long working_bits() { return bits_in_use; }

Bits::Bits(long bits) : before_(bits_in_use) { bits_in_use = bits; }
Bits::~Bits() { bits_in_use = before_; }

Ball Ball::of(Real value) {
  const auto high = static_cast<double>(value);
  const auto low = static_cast<double>(value - static_cast<Real>(high));
  return Ball(high) + Ball(low);
}

Ball Ball::pi() {
  Ball out;
  arb_const_pi(out.x_, working_bits());
  return out;
}

int Ball::sign() const {
  if (arb_is_positive(x_)) return 1;
  if (arb_is_negative(x_)) return -1;
  return arb_is_zero(x_) ? 0 : 2;
}

double Ball::upper() const {
  arf_t bound;
  arf_init(bound);
  arb_get_ubound_arf(bound, x_, 64);
  const double out = arf_get_d(bound, ARF_RND_CEIL);
  arf_clear(bound);
  return out;
}

double Ball::lower() const {
  arf_t bound;
  arf_init(bound);
  arb_get_lbound_arf(bound, x_, 64);
  const double out = arf_get_d(bound, ARF_RND_FLOOR);
  arf_clear(bound);
  return out;
}

Real Ball::middle() const {
  const double high = arf_get_d(arb_midref(x_), ARF_RND_NEAR);
  arf_t rest;
  arf_init(rest);
  arf_set_d(rest, high);
  arf_sub(rest, arb_midref(x_), rest, 64, ARF_RND_NEAR);
  const double low = arf_get_d(rest, ARF_RND_NEAR);
  arf_clear(rest);
  return static_cast<Real>(high) + static_cast<Real>(low);
}

Ball operator+(const Ball& a, const Ball& b) {
  Ball out;
  arb_add(out.x_, a.x_, b.x_, working_bits());
  return out;
}
Ball operator-(const Ball& a, const Ball& b) {
  Ball out;
  arb_sub(out.x_, a.x_, b.x_, working_bits());
  return out;
}
Ball operator*(const Ball& a, const Ball& b) {
  Ball out;
  arb_mul(out.x_, a.x_, b.x_, working_bits());
  return out;
}
Ball operator/(const Ball& a, const Ball& b) {
  Ball out;
  arb_div(out.x_, a.x_, b.x_, working_bits());
  return out;
}
Ball operator-(const Ball& a) {
  Ball out;
  arb_neg(out.x_, a.x_);
  return out;
}
Ball sqrt(const Ball& a) {
  Ball out;
  arb_sqrtpos(out.x_, a.x_, working_bits());
  return out;
}
Ball abs(const Ball& a) {
  Ball out;
  arb_abs(out.x_, a.x_);
  return out;
}
Ball larger(const Ball& a, const Ball& b) {
  Ball out;
  arb_max(out.x_, a.x_, b.x_, working_bits());
  return out;
}
Ball atan2(const Ball& y, const Ball& x) {
  Ball out;
  arb_atan2(out.x_, y.x_, x.x_, working_bits());
  return out;
}
void sin_cos(const Ball& a, Ball& sine, Ball& cosine) {
  arb_sin_cos(sine.x_, cosine.x_, a.x_, working_bits());
}

}  // namespace judge
