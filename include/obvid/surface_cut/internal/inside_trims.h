// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/surface_cut/internal/plane_section.h"

namespace obvid {

/// The parts of a section of whole patches that lie inside the trims of the model's patches. Ends
/// are where the chord between the last place inside and the first outside, moved into the plane,
/// crosses the trim: to rounding along the surface. A branch that leaves what is there and comes
/// back between two neighbours of at least 512 places along it is not parted. Of patches without
/// trims all of it.
[[nodiscard]] PlaneSection inside_trims(PlaneSection section, const SurfaceModel& model,
                                        const CutPlane& plane);

}  // namespace obvid
