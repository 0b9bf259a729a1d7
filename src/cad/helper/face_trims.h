// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Geom_Surface.hxx>
#include <TopoDS_Face.hxx>
#include <optional>
#include <vector>

#include "obvid/surface/surface.h"

namespace obvid::cad {

/// The boundary of a face as loops of parameters of `patch`, which is the face's surface over the
/// box `u` x `v` of the kernel's parameters, not turned round: the kernel's own curves where both
/// have the same parameters, else cubics that are as far off as 1e-7 of the patch's size at most,
/// as measured. Nothing where curves are missing, leave the box or do not come that near.
[[nodiscard]] std::optional<std::vector<TrimLoop>> trims_of(const TopoDS_Face& face,
                                                            const Handle(Geom_Surface) & surface,
                                                            const Range& u, const Range& v,
                                                            const NurbsSurface& patch);

/// How far cubics may be from the edges that they stand for.
[[nodiscard]] double trims_follow_within(const NurbsSurface& patch);

/// The same loops where u runs backwards.
[[nodiscard]] std::vector<TrimLoop> with_u_reversed(const std::vector<TrimLoop>& loops,
                                                    const Range& u);

}  // namespace obvid::cad
