// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "obvid/geom/element.h"

namespace obvid {

inline Element mirrored(Element e) { return {{e.point.x, -e.point.y}, -e.theta, -e.kappa}; }

inline Element reversed(Element e) { return {e.point, e.theta + std::numbers::pi, -e.kappa}; }

}  // namespace obvid
