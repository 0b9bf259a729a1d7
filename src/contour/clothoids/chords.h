// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/result.h"
#include "obvid/geom/vec2.h"

namespace obvid::clothoids {

/// Chords of a series, headings unwrapped.
struct Chords {
  std::vector<double> length;
  std::vector<double> omega;
};

/// Errors: E304 fewer than `fewest` points, E402 neighbours that coincide or chords that turn back.
[[nodiscard]] Result<Chords> chords_of(const std::vector<Vec2>& points, std::size_t fewest);

}  // namespace obvid::clothoids
