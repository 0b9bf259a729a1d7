// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "obvid/chain/internal/chain.h"

namespace obvid {

/// Which closed-form spiral carries a link. End points, headings and curvatures leave one number
/// free, and with it the slopes of curvature at both ends (docs/methods/g3.md).
enum class SpiralForm : std::uint8_t {
  kOneSided,     ///< all turning on the first leg (docs/methods/chain.md, 1): needs the cone of the
                 ///< closed form
  kEven,         ///< the turning shared alike: exists wherever a spiral exists, same both ways
  kRestAtStart,  ///< the slope of curvature is zero at the start
  kRestAtEnd,    ///< the slope of curvature is zero at the end
};

/// The cone that a link needs for a spiral of the form.
[[nodiscard]] constexpr Cone cone_of(SpiralForm form) {
  return form == SpiralForm::kOneSided ? Cone::kClosedForm : Cone::kSpiral;
}

/// A spiral z = (N - M)/(N + M) on the chord from -1 to 1 with
/// N = mu x (g e^{i lead} (1 - x) + x), M = (1 - x)(1 - x + g e^{i trail} x), x from 0 to 1,
/// and arg(mu) = alpha - lead. Curvature increases (a falling one is its mirror image).
struct SpiralShape {
  double lead = 0.0;   ///< rad; lead + trail = sigma
  double trail = 0.0;  ///< rad
  double gain = 1.0;   ///< g^2
  double mu = 1.0;     ///< |mu|

  /// Whether the form has a spiral there.
  [[nodiscard]] bool exists() const { return gain > 0.0 && std::isfinite(gain); }
};

/// The spiral of a form over a link, seen with increasing curvature; `direction` as of the chain.
/// A, B and sigma must have the signs of that direction. `gain` is not positive where the form has
/// no such spiral.
[[nodiscard]] SpiralShape spiral_shape(const LinkState& link, int direction, SpiralForm form);

/// A number with its derivatives by A, B and sigma of a link seen with increasing curvature.
struct LinkGradient {
  double value = 0.0, by_A = 0.0, by_B = 0.0, by_sigma = 0.0;
};

/// What is known of the slope of curvature along a spiral. Logarithms of |d kappa/ds| h^2/4; minus
/// infinity, without derivatives, where the slope is zero. NaN where the form has no spiral.
struct SpiralSlopes {
  LinkGradient start, end;
  /// Unevenness of the slope: how it changes over the link, and how it departs from that between
  /// the ends. Both vanish on a clothoid, and for the forms that begin or end at rest on a curve
  /// whose slope grows in proportion to the arc length.
  LinkGradient change, bend;
};

/// Slopes of the forms kEven, kRestAtStart and kRestAtEnd.
[[nodiscard]] SpiralSlopes spiral_slopes(const LinkState& link, int direction, SpiralForm form);

}  // namespace obvid
