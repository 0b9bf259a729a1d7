// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "cut_blocks.h"

namespace obvid::cutting {

/// How far the printed depth may be from the one asked for, of it.
inline constexpr double kPrintedDepth = 1e-2;

struct Checked {
  double beyond = 0.0;    ///< of an edge, by the edge of the tool
  double short_of = 0.0;  ///< of an edge, inner corners apart
};

/// What a program as printed does to the edges of tracks that are compensated, and how far it
/// strays from those that are followed, at places `spacing` apart. `motions`: the track of each of
/// its motions, in order. Lengths in units of the machine. Errors: E101 a program that a controller
/// would not take, that moves rapidly at or below Z0, or does not go down to the depth; E103.
[[nodiscard]] Result<Checked> checked(std::string_view text, const Tracks& tracks,
                                      const std::vector<std::size_t>& motions,
                                      const BlockRules& rules, double tolerance, double spacing,
                                      Watch& watch);

}  // namespace obvid::cutting
