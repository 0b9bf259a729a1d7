// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/contour.h"

namespace obvid {

const char* to_string(Carrier carrier) {
  switch (carrier) {
    case Carrier::kArcs:
      return "arcs";
    case Carrier::kConics:
      return "conics";
    case Carrier::kBeziers:
      return "beziers";
    case Carrier::kClothoids:
      return "clothoids";
    case Carrier::kBspline:
      return "bspline";
    case Carrier::kCubic:
      return "cubic";
    case Carrier::kBaseline:
      return "baseline";
    case Carrier::kSpiral:
      break;
  }
  return "spiral";
}

std::optional<Carrier> carrier_of(std::string_view name) {
  for (const Carrier carrier : kAllCarriers) {
    if (name == to_string(carrier)) return carrier;
  }
  return std::nullopt;
}

}  // namespace obvid
