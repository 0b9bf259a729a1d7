// SPDX-License-Identifier: Apache-2.0
// The light of the page as one number, so that surfaces can be cut into shades.
#include "space/light.h"

#include <algorithm>
#include <cmath>

namespace obvid::picture {
namespace {

constexpr double kGamma = 2.2;
constexpr Vec3 kFront{0.45, 0.61, 0.79}, kBack{0.80, 0.65, 0.46}, kPale{0.70, 0.74, 0.79};
constexpr Vec3 kKey{-0.62, 0.58, 0.52}, kFill{0.85, -0.05, 0.40};
/// Light between which shades are told apart: full shadow and the gloss.
constexpr double kDarkest = 0.12, kBrightest = 1.30;
/// Shades of isolines begin here: lines stay readable.
constexpr double kPaleDarkest = 0.42;

double perceived(double light) { return std::pow(light, 1.0 / kGamma); }

std::uint8_t channel(double linear) {
  return static_cast<std::uint8_t>(std::lround(255.0 * perceived(std::clamp(linear, 0.0, 1.0))));
}

}  // namespace

double light_at(Vec3 n) {
  const Vec3 viewer{0.0, 0.0, 1.0}, key = unit(kKey);
  const double lit = std::max(dot(n, key), 0.0);
  const double gloss = std::pow(std::max(dot(n, unit(key + viewer)), 0.0), 60.0);
  const double around = 0.13 + 0.14 * (0.5 + 0.5 * n.y);
  const double light = around + 0.80 * lit * (0.55 + 0.45 * lit) +
                       0.13 * std::max(dot(n, unit(kFill)), 0.0) + 0.12 * gloss;
  const double part =
      (perceived(light) - perceived(kDarkest)) / (perceived(kBrightest) - perceived(kDarkest));
  return kShades * std::clamp(part, 0.0, 1.0);
}

Rgb shade_colour(int shade, bool front, bool pale) {
  const double part = (shade + 0.5) / kShades;
  const double from = perceived(pale ? kPaleDarkest : kDarkest), to = perceived(kBrightest);
  const double light = std::pow(from + part * (to - from), kGamma);
  Vec3 base = front ? kFront : kBack;
  if (pale) base = 0.5 * (base + kPale);
  // what is brighter than the base itself turns white
  const double shine = std::max(light - 1.0, 0.0);
  const Vec3 c = std::min(light, 1.0) * base + shine * Vec3{1.0, 1.0, 1.0};
  return {channel(c.x), channel(c.y), channel(c.z)};
}

}  // namespace obvid::picture
