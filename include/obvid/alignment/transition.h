// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/pieces.h"
#include "obvid/geom/element.h"

namespace obvid {

/// How curvature goes from one value to another along a transition, by the share u of its length:
/// kappa0 + (kappa1 - kappa0) f(u).
enum class Transition {
  kClothoid,  ///< u
  kBloss,     ///< 3 u^2 - 2 u^3
  kSine,      ///< u - sin(2 pi u)/(2 pi): Klein's
  kCosine,    ///< (1 - cos(pi u))/2
  kHelmert,   ///< 2 u^2 up to the middle, 1 - 2 (1 - u)^2 behind it: Schramm's
  kCubic,     ///< that of y = c x^3 between the two curvatures: a cubic parabola, f depends on them
};

/// A transition of which a contour has clothoids: pieces [first_piece, first_piece + pieces).
struct PlacedTransition {
  std::size_t first_piece = 0, pieces = 0;
  Transition kind = Transition::kClothoid;
  double kappa0 = 0.0, kappa1 = 0.0;  ///< curvatures at its ends, 1/unit
  double length = 0.0;                ///< units
};

/// A transition does not turn farther, rad: a hundred full turns. What is asked to is refused.
inline constexpr double kMostTransitionTurn = 200.0 * std::numbers::pi;
[[nodiscard]] inline bool turns_too_far(double kappa0, double kappa1, double length) {
  return !(0.5 * (std::abs(kappa0) + std::abs(kappa1)) * length <= kMostTransitionTurn);
}

/// Elements of so many pieces: clothoids that stand for a transition are one.
[[nodiscard]] std::size_t elements_in(std::size_t pieces,
                                      const std::vector<PlacedTransition>& transitions);

inline constexpr std::array<std::string_view, 6> kTransitionNames = {
    "clothoid", "bloss", "sine", "cosine", "helmert", "cubic"};

/// "clothoid", "bloss", "sine", "cosine", "helmert", "cubic".
[[nodiscard]] inline std::string_view name_of(Transition kind) {
  return kTransitionNames[static_cast<std::size_t>(kind)];
}
[[nodiscard]] std::optional<Transition> transition_named(std::string_view name);

/// The element at `s` behind `start` on a transition of this length from the curvature of `start`
/// to `kappa1`; beyond its ends curvature stays as it is there. By Gauss's rule on parts that turn
/// little: error below 1e-13 of the length.
[[nodiscard]] Element transition_at(Transition kind, const Element& start, double kappa1,
                                    double length, double s);

/// Clothoids within `tolerance` of a transition (units): for what has no other curves. Their
/// curvature goes on from piece to piece without a step and from that of `start` to `kappa1`
/// without turning back, as the transition's does, so that both have the same extrema and
/// inflections. Every second joint at least is a place of the transition with its heading; the ends
/// are exact. As few as do of those with stretches of equal length to both sides of where its
/// curvature bends back. Error: E310 where it turns so far between as many places as are tried that
/// none are found, or none so near.
[[nodiscard]] Result<std::vector<ClothoidPiece>> clothoids_along(Transition kind,
                                                                 const Element& start,
                                                                 double kappa1, double length,
                                                                 double tolerance);

}  // namespace obvid
