// SPDX-License-Identifier: Apache-2.0
// Numbers with a proved error bound: balls of arbitrary precision (the library Arb).
#pragma once

#include <arb.h>

#include <utility>

namespace judge {

using Real = long double;

/// Bits that operations on balls work with: 170 are 50 digits. A thread has its own.
constexpr long kFiftyDigits = 170;
long working_bits();

/// Works with more bits while it lives.
class Bits {
 public:
  explicit Bits(long bits);
  ~Bits();
  Bits(const Bits&) = delete;
  Bits& operator=(const Bits&) = delete;

 private:
  long before_;
};

class Ball {
 public:
  Ball() { arb_init(x_); }
  Ball(double value) : Ball() { arb_set_d(x_, value); }  // NOLINT: doubles are balls of radius 0
  Ball(const Ball& other) : Ball() { arb_set(x_, other.x_); }
  Ball(Ball&& other) noexcept : Ball() { arb_swap(x_, other.x_); }
  Ball& operator=(const Ball& other) {
    arb_set(x_, other.x_);
    return *this;
  }
  Ball& operator=(Ball&& other) noexcept {
    arb_swap(x_, other.x_);
    return *this;
  }
  ~Ball() { arb_clear(x_); }

  static Ball of(Real value);
  static Ball pi();

  Ball& operator+=(const Ball& b) {
    arb_add(x_, x_, b.x_, working_bits());
    return *this;
  }
  /// this += a b
  Ball& add_product(const Ball& a, const Ball& b) {
    arb_addmul(x_, a.x_, b.x_, working_bits());
    return *this;
  }

  /// -1, 0, 1 where the sign is certain; 2 where the ball holds numbers of different signs.
  [[nodiscard]] int sign() const;
  [[nodiscard]] bool finite() const { return arb_is_finite(x_) != 0; }
  [[nodiscard]] double upper() const;
  [[nodiscard]] double lower() const;
  [[nodiscard]] Real middle() const;

  friend Ball operator+(const Ball& a, const Ball& b);
  friend Ball operator-(const Ball& a, const Ball& b);
  friend Ball operator*(const Ball& a, const Ball& b);
  friend Ball operator/(const Ball& a, const Ball& b);
  friend Ball operator-(const Ball& a);
  friend Ball sqrt(const Ball& a);
  friend Ball abs(const Ball& a);
  friend Ball larger(const Ball& a, const Ball& b);
  friend Ball atan2(const Ball& y, const Ball& x);
  friend void sin_cos(const Ball& a, Ball& sine, Ball& cosine);
  /// Adds an error of the size of `bound`.
  void widen(const Ball& bound) { arb_add_error(x_, bound.x_); }

 private:
  arb_t x_;
};

/// Point or vector of balls.
struct BallVec {
  Ball x, y;
};
inline BallVec operator+(const BallVec& a, const BallVec& b) { return {a.x + b.x, a.y + b.y}; }
inline BallVec operator-(const BallVec& a, const BallVec& b) { return {a.x - b.x, a.y - b.y}; }
inline BallVec operator*(const Ball& k, const BallVec& a) { return {k * a.x, k * a.y}; }
inline Ball dot(const BallVec& a, const BallVec& b) { return a.x * b.x + a.y * b.y; }
inline Ball cross(const BallVec& a, const BallVec& b) { return a.x * b.y - a.y * b.x; }
inline Ball norm(const BallVec& a) { return sqrt(dot(a, a)); }

}  // namespace judge
