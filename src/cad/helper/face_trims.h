// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Geom_Surface.hxx>
#include <TopoDS_Face.hxx>
#include <optional>
#include <vector>

#include "obvid/surface/surface.h"

namespace obvid::cad {

/// Loops of parameters of a patch.
struct FaceTrims {
  std::vector<TrimLoop> loops;
  double within = 0.0;  ///< units: how far they are from the kernel's own curves, as measured; 0:
                        ///< these themselves
};

/// The boundary of a face as loops of parameters of `patch`, which is the face's surface over the
/// box `u` x `v` of the kernel's parameters, not turned round: the kernel's own curves where both
/// have the same parameters, else cubics that are as far off as 1e-9 of the patch's size at most,
/// as measured. Nothing where curves are missing, leave the box or do not come that near.
[[nodiscard]] std::optional<FaceTrims> trims_of(const TopoDS_Face& face,
                                                const Handle(Geom_Surface) & surface,
                                                const Range& u, const Range& v,
                                                const NurbsSurface& patch);

/// The ranges of the kernel's parameters, made so large that all control points of the boundary's
/// curves lie in them: these leave the box of the curves where an arc touches its side.
void make_room_for_trims(const TopoDS_Face& face, Range& u, Range& v);

/// The same loops where u runs backwards.
[[nodiscard]] std::vector<TrimLoop> with_u_reversed(const std::vector<TrimLoop>& loops,
                                                    const Range& u);

}  // namespace obvid::cad
