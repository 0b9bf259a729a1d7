// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/contour.h"

namespace obvid {

const char* to_string(Carrier carrier) {
  switch (carrier) {
    case Carrier::kArcs:
      return "arcs";
    case Carrier::kClothoids:
      return "clothoids";
    case Carrier::kSpiral:
      break;
  }
  return "spiral";
}

}  // namespace obvid
