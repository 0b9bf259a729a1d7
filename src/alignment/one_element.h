// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "found_chain.h"

namespace obvid::alignment {

/// One line, else one arc, that passes all points of an open series within their tolerances, in
/// coordinates from that of the points on (`origin` is none): found where there is one, as the
/// largest offset over its tolerance is made least, by linear programs one after the other. For
/// lines that is the least there is but for rounding, for arcs the one that the circle of least
/// squares leads to. In a graph a grade, else a parabola. Nothing where it is sharper than
/// `largest_curvature`, winds between neighbouring points or leaves one.
[[nodiscard]] std::optional<FoundChain> one_element(Plane plane, const std::vector<Vec2>& points,
                                                    const std::vector<double>& tolerance,
                                                    double largest_curvature);

}  // namespace obvid::alignment
