// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "large_list.h"
#include "part.h"

namespace obvid::toolpath {

enum class Reach : unsigned char {
  kUnknown,
  kHidden,   ///< not seen from above
  kReached,  ///< some place of the cutter comes within the tolerance and cuts nothing else
  kHeld,     ///< other places of the part hold every place of the cutter up
};

/// How near a cutter that rests on the part comes to a place of it.
struct Nearest {
  Reach reach = Reach::kUnknown;
  double height = 0.0;  ///< along the normal, of what has to stay; looked for until it is reached
  Vec2 axis;            ///< of that place of the cutter
};

/// The normal, turned round where it stands up too little to say which side of a wall is open and
/// the other one has nothing over it.
[[nodiscard]] Vec3 open_side(const Part& part, Vec3 point, Vec3 normal);

/// Something of the part stands over it.
[[nodiscard]] bool hidden(const Part& part, Vec3 point, Vec3 normal);

/// The place of the cutter that would touch it; where that is held up, places around the best, by
/// steps of half the radius down to a fiftieth of it. `first`: what is best nearby, looked at
/// first.
[[nodiscard]] Nearest nearest_to(const Part& part, Vec3 point, Vec3 normal,
                                 std::optional<Vec2> first = std::nullopt);

/// The same of a place that is held, on from what is known of it, by steps down to a ten thousandth
/// of the radius.
[[nodiscard]] Nearest closer_to(const Part& part, Vec3 point, Vec3 normal, const Nearest& known);

}  // namespace obvid::toolpath
