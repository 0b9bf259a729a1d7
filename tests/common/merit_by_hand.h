// SPDX-License-Identifier: Apache-2.0
// The barrier of a link's cone, written once more from docs/methods/chain.md in extended precision,
// and differences of functions.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "obvid/chain/internal/cone.h"

namespace obvid::test {

using Long = long double;

/// Fourth-order central difference.
inline Long slope_of(const std::function<Long(Long)>& f, Long at, Long step = 1e-4L) {
  return (8.0L * (f(at + step) - f(at - step)) - (f(at + 2 * step) - f(at - 2 * step))) /
         (12.0L * step);
}

template <class F, std::size_t N>
Long partial(const F& f, const std::array<Long, N>& x, std::size_t k) {
  return slope_of(
      [&](Long v) {
        std::array<Long, N> y = x;
        y[k] = v;
        return f(y);
      },
      x[k], 1e-3L * (1.0L + std::abs(x[k])));
}

/// S(sigma): 2 sin(sigma/2), or sqrt(2) sin(sigma)/sqrt(cos(sigma)) going on straight beyond 1.3;
/// its square is enlarged by the reserve.
inline Long width_by_hand(Cone cone, Long sigma, Long existence_reserve) {
  if (cone == Cone::kSpiral) return std::sqrt(existence_reserve) * 2.0L * std::sin(sigma / 2.0L);
  constexpr Long kReserve = 1.1L, kStraight = 1.3L;
  const auto closed = [](Long s) {
    return std::sqrt(kReserve * 2.0L) * std::sin(s) / std::sqrt(std::cos(s));
  };
  if (std::abs(sigma) <= kStraight) return closed(sigma);
  const Long slope = slope_of(closed, kStraight);
  return std::copysign(closed(kStraight) + slope * (std::abs(sigma) - kStraight), sigma);
}

/// Of (m, q, sigma, slack).
struct ConeMerit {
  Cone cone = Cone::kSpiral;
  Long reserve = 1.0L, direction = 1.0L, size = 1.0L;
  LinkEnergy form;
  Long weight = 0.0L, barrier = 0.0L;
  std::optional<Long> linear_at{};  ///< S goes on straight from this sigma

  [[nodiscard]] ConeMerit with_linear_width_at(Long sigma) const {
    ConeMerit out = *this;
    out.linear_at = sigma;
    return out;
  }

  [[nodiscard]] Long width(Long sigma) const {
    const auto s = [&](Long v) { return width_by_hand(cone, v, reserve); };
    if (!linear_at) return s(sigma);
    return s(*linear_at) + slope_of(s, *linear_at) * (sigma - *linear_at);
  }

  Long operator()(const std::array<Long, 4>& x) const {
    const auto [m, q, sigma, slack] = x;
    const Long off = m - form.ratio * sigma, t = direction * m + slack * size, S = width(sigma);
    const Long energy = form.departure * off * off + form.size * sigma * sigma + form.skew * q * q;
    if (barrier == 0.0L) return weight * energy;
    return weight * energy - barrier * (std::log(t * t - q * q - S * S) +
                                        0.5L * std::log(direction * sigma + slack * size));
  }
};

}  // namespace obvid::test
