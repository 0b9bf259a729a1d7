// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace obvid {

/// Family of curves that carries a contour: docs/carriers.md, one entry each in curve/carriers.inc.
enum class Carrier {
#define OBVID_CARRIER(enumerator, ...) enumerator,
#define OBVID_CARRIER_AS_DRAWN(enumerator, ...) enumerator,
#include "obvid/curve/carriers.inc"
#undef OBVID_CARRIER
#undef OBVID_CARRIER_AS_DRAWN
};

/// What a carrier is formed of.
enum class CarrierNeeds {
  kSpirals,   ///< the spirals over the same elements, which it follows
  kElements,  ///< elements alone
  kPoints,    ///< points alone, and headings given at its ends
  kDrawing,   ///< a drawing has it: no fit forms it
};

/// What two of its pieces have in common at every joint between corners.
enum class CarrierJoints {
  kHeading,    ///< the curvature steps there
  kCurvature,  ///< heading and curvature
  kSlope,      ///< the slope of curvature too, where it is wanted
};

/// Weights of its rational Bezier pieces.
enum class CarrierWeights { kAny, kEqual, kUnequal };

/// Pieces that a carrier has, besides those that a drawing drew.
struct CarrierPieces {
  const char* text = "";  ///< "parabolas and lines"
  bool lines = false;
  bool arcs = false;
  bool clothoids = false;
  int degree = 0;  ///< of rational Bezier pieces; 0: there are none; `kAnyDegree`
  CarrierWeights weights = CarrierWeights::kAny;
};
inline constexpr int kAnyDegree = -1;

/// What is known of a carrier.
struct CarrierInfo {
  Carrier carrier{};
  const char* name = "";   ///< on the command line and in contour files
  const char* title = "";  ///< what a picture calls such a contour: "Arc contour"
  const char* about = "";  ///< two or three words for a list of carriers
  bool monotone = false;   ///< promises monotone curvature on every run
  CarrierJoints joints{};
  CarrierNeeds needs{};
  CarrierPieces pieces{};
  bool one_spline = false;      ///< its pieces are the spans of one spline, C2 by its parameter
  bool between_joints = false;  ///< passes points that are no joints, within a tolerance
  bool wants_room = false;  ///< may need more than the least possible largest curvature, where that
                            ///< is preferred
};

/// All carriers, in the order of their enumerators.
inline constexpr std::array kCarriers = {
#define OBVID_CARRIER(enumerator, word, ...) \
  CarrierInfo{.carrier = Carrier::enumerator, .name = #word, __VA_ARGS__},
#define OBVID_CARRIER_AS_DRAWN(...) OBVID_CARRIER(__VA_ARGS__)
#include "obvid/curve/carriers.inc"
#undef OBVID_CARRIER
#undef OBVID_CARRIER_AS_DRAWN
};

/// Carriers that a fit forms.
inline constexpr std::array kAllCarriers = {
#define OBVID_CARRIER(enumerator, ...) Carrier::enumerator,
#define OBVID_CARRIER_AS_DRAWN(...)
#include "obvid/curve/carriers.inc"
#undef OBVID_CARRIER
#undef OBVID_CARRIER_AS_DRAWN
};

[[nodiscard]] constexpr const CarrierInfo& info_of(Carrier carrier) {
  return kCarriers[static_cast<std::size_t>(carrier)];
}
/// Whether another system drew the curve: no fit forms it, nothing is promised of it.
[[nodiscard]] constexpr bool is_as_drawn(Carrier carrier) {
  return info_of(carrier).needs == CarrierNeeds::kDrawing;
}
/// Name on the command line and in contour files: spiral, arcs, conics, ...
[[nodiscard]] constexpr const char* to_string(Carrier carrier) { return info_of(carrier).name; }
/// Carrier of this name.
[[nodiscard]] std::optional<Carrier> carrier_of(std::string_view name);

/// Whether a contour of this carrier claims that its curvature is monotone on every run; the others
/// are compared with it.
[[nodiscard]] constexpr bool promises_monotone(Carrier carrier) {
  return info_of(carrier).monotone;
}
/// Whether the curvature steps at joints: arcs.
[[nodiscard]] constexpr bool steps_at_joints(Carrier carrier) {
  return info_of(carrier).joints == CarrierJoints::kHeading;
}
/// Whether a fit can make the slope of curvature continuous (G3).
[[nodiscard]] constexpr bool can_be_g3(Carrier carrier) {
  return info_of(carrier).joints == CarrierJoints::kSlope;
}
/// Whether it stands for the spirals over the same elements, and is measured against them.
[[nodiscard]] constexpr bool follows_spirals(Carrier carrier) {
  return carrier != Carrier::kSpiral;
}

}  // namespace obvid
