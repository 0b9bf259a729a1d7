// SPDX-License-Identifier: Apache-2.0
#include "monotone.h"

#include <algorithm>

namespace judge {
namespace {

/// Digits that are tried one after the other: 50, 200, 800, 5,000. Products of doubles are exact
/// with the last ones unless their exponents differ by thousands.
constexpr long kTries[] = {kFiftyDigits, 680, 2720, 17000};
constexpr int kMostHalvings = 200;

Form product(const Form& a, const Form& b) {
  Form out(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) out[i + j].add_product(a[i], b[j]);
  }
  return out;
}

Form combined(const Ball& p, const Form& a, const Ball& q, const Form& b) {
  Form out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = p * a[i] + q * b[i];
  return out;
}

Form difference(const Form& a, const Form& b) { return combined(1.0, a, -1.0, b); }

/// d/dt of sum c_j t^j (1-t)^(n-j).
Form derivative(const Form& c) {
  const std::size_t n = c.size() - 1;
  if (n == 0) return {Ball(0.0)};
  Form out(n);
  for (std::size_t j = 0; j < n; ++j) {
    out[j] = Ball(static_cast<double>(j + 1)) * c[j + 1] - Ball(static_cast<double>(n - j)) * c[j];
  }
  return out;
}

struct BallForms {
  Form x, y, w;
};

BallForms forms_of(const Bezier& bezier) {
  BallForms out;
  const std::size_t n = bezier.offset.size() - 1;
  double binomial = 1.0;
  for (std::size_t j = 0; j <= n; ++j) {
    const Ball w = Ball(binomial) * Ball(bezier.weight[j]);
    out.x.push_back(w * (Ball(bezier.offset[j].x) - Ball(bezier.offset[0].x)));
    out.y.push_back(w * (Ball(bezier.offset[j].y) - Ball(bezier.offset[0].y)));
    out.w.push_back(w);
    binomial = binomial * static_cast<double>(n - j) / static_cast<double>(j + 1);
  }
  return out;
}

/// Speed squared (times W^4) and the numerator of d kappa / dt.
/// kappa = W^2 C / g^(3/2) with U = X'W - XW', V likewise, C = UV' - VU', g = U^2 + V^2, so
/// d kappa / dt = W ((2W'C + WC') g - 3/2 W C g') / g^(5/2).
struct Tests {
  Form speed, slope;
};

Tests tests_of(const Bezier& bezier) {
  const BallForms h = forms_of(bezier);
  const Form w1 = derivative(h.w);
  const Form u = difference(product(derivative(h.x), h.w), product(h.x, w1));
  const Form v = difference(product(derivative(h.y), h.w), product(h.y, w1));
  const Form c = difference(product(u, derivative(v)), product(v, derivative(u)));
  Tests out;
  out.speed = combined(1.0, product(u, u), 1.0, product(v, v));
  const Form changing = combined(2.0, product(w1, c), 1.0, product(h.w, derivative(c)));
  out.slope = combined(1.0, product(changing, out.speed), -1.5,
                       product(product(h.w, c), derivative(out.speed)));
  return out;
}

/// The form on [0, 1/2], times 2^n: t = u/2, 1 - t = (2 (1-u) + u)/2, which is a Taylor shift by 1.
/// Nothing is rounded but sums, and those not with enough digits.
Form left_half(const Form& form) {
  const std::size_t n = form.size() - 1;
  Form a(form.rbegin(), form.rend());
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = n; j-- > i;) a[j] += a[j + 1];
  }
  Form out(n + 1);
  Ball power(1.0);
  for (std::size_t m = 0; m <= n; ++m) {
    out[n - m] = power * a[m];
    power += power;
  }
  return out;
}

Form reversed(const Form& form) { return {form.rbegin(), form.rend()}; }

/// Isolates the changes of sign; gives up where a sign stays open.
class Isolation {
 public:
  Signs run(const Form& form) {
    follow(form, 0.0, 1.0, 0);
    if (out_.signs.empty()) out_.signs.push_back(0);
    return out_;
  }

 private:
  void meet(int sign, double from, double to) {
    if (sign == 0) return;
    if (!out_.signs.empty() && out_.signs.back() != sign) out_.turns.push_back({from, to});
    if (out_.signs.empty() || out_.signs.back() != sign) out_.signs.push_back(sign);
  }

  void follow(const Form& form, double from, double to, int depth) {
    std::vector<int> signs;
    for (const Ball& c : form) {
      const int sign = c.sign();
      if (sign == 2) {
        open_ = true;
        out_.decided = false;
        return;
      }
      if (sign != 0 && (signs.empty() || signs.back() != sign)) signs.push_back(sign);
    }
    if (signs.size() <= 2) {  // Descartes: no change of sign, or exactly one
      for (std::size_t k = 0; k < signs.size(); ++k) meet(signs[k], from, k == 0 ? from : to);
      return;
    }
    if (depth > kMostHalvings) {
      out_.decided = false;
      return;
    }
    const double middle = 0.5 * (from + to);
    const Form left = left_half(form);
    out_.touches = out_.touches || left.back().sign() == 0;
    follow(left, from, middle, depth + 1);
    if (!open_) follow(reversed(left_half(reversed(form))), middle, to, depth + 1);
  }

  Signs out_;
  bool open_ = false;
};

template <class Try>
auto with_more_digits(const Try& attempt) {
  decltype(attempt()) out;
  for (const long bits : kTries) {
    const Bits more(bits);
    out = attempt();
    if (out.decided) break;
  }
  return out;
}

bool positive(const std::vector<double>& weights) {
  return std::all_of(weights.begin(), weights.end(), [](double w) { return w > 0.0; });
}

CurvatureLaw bezier_law(const Bezier& bezier) {
  return with_more_digits([&] {
    CurvatureLaw law;
    const Tests tests = tests_of(bezier);
    const Signs speed = signs_of(tests.speed);
    const Signs slope = signs_of(tests.slope);
    law.decided = speed.decided && slope.decided;
    law.regular = speed.decided && !speed.touches && speed.signs == std::vector<int>{1} &&
                  positive(bezier.weight);
    law.signs = slope.signs;
    law.turns = slope.turns;
    return law;
  });
}

}  // namespace

Signs signs_of(const Form& form) {
  Isolation isolation;
  return isolation.run(form);
}

CurvatureLaw curvature_law(const Piece& piece) {
  if (const auto* bezier = std::get_if<Bezier>(&piece)) return bezier_law(*bezier);
  CurvatureLaw law;
  law.decided = law.regular = true;
  law.signs = {0};
  if (const auto* one = std::get_if<Clothoid>(&piece)) {
    law.signs = {one->kappa1 > one->kappa0 ? 1 : (one->kappa1 < one->kappa0 ? -1 : 0)};
    law.regular = one->length > 0.0;
  } else if (const auto* arc = std::get_if<Arc>(&piece)) {
    law.regular = arc->length > 0.0;
  } else {
    const auto& line = std::get<Line>(piece);
    law.regular = !(line.start == line.end);
  }
  return law;
}

int slope_sign(const Bezier& bezier, double t) {
  struct Answer {
    int sign = 2;
    bool decided = false;
  };
  const Answer answer = with_more_digits([&] {
    const Form slope = tests_of(bezier).slope;
    const Ball at(t), rest = Ball(1.0) - at;
    Ball power(1.0), sum(0.0);
    std::vector<Ball> rests{Ball(1.0)};
    for (std::size_t j = 1; j < slope.size(); ++j) rests.push_back(rests.back() * rest);
    for (std::size_t j = 0; j < slope.size(); ++j) {
      sum.add_product(slope[j], power * rests[slope.size() - 1 - j]);
      power = power * at;
    }
    Answer one;
    one.sign = sum.sign();
    one.decided = one.sign != 2;
    return one;
  });
  return answer.sign;
}

}  // namespace judge
