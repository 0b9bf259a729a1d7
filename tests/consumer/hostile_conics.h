// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/curve/pieces.h"

/// Ellipse arcs that begin at a vertex, turned, shifted and rounded: rounding alone decides whether
/// the vertex is inside, and only exact arithmetic can tell.
[[nodiscard]] std::vector<obvid::RationalBezier> hostile_conics(int count);
