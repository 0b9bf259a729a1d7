// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/surface_cut/internal/plane_section.h"

namespace obvid {

/// The parts of branches of whole patches that lie inside the trims of the model's patches, their
/// ends joined where they are not farther apart than `meet` (units). Branches have their places at
/// borders twice, with the parameters of both patches (`stands_again`); in what is returned once.
[[nodiscard]] std::vector<SectionBranch> inside_trims(const std::vector<SectionBranch>& branches,
                                                      const SurfaceModel& model,
                                                      const CutPlane& plane, double meet);

}  // namespace obvid
