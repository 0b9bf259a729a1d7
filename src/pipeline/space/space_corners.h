// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/geom/vec2.h"
#include "obvid/geom/vec3.h"
#include "obvid/series/internal/sections.h"

namespace obvid::pipeline_detail {

/// The polygon of points in space laid into a plane, with its chords and turns; it turns to the
/// other side where the planes of neighbouring turns lie opposite. A plane series stays itself, but
/// for its place.
[[nodiscard]] std::vector<Vec2> developed(const std::vector<Vec3>& points);

/// Corners of a series in space, ascending: those of the series laid into a plane
/// (`find_corners`), and the marked ones. `blur`: how far points may lie from where they belong,
/// units. A closed series does not repeat its first point; an open one has none at its ends.
[[nodiscard]] std::vector<std::size_t> corners_in_space(const std::vector<Vec3>& points,
                                                        bool closed, double blur,
                                                        const std::vector<std::size_t>& marked,
                                                        const CornerConstraints& constraints);

}  // namespace obvid::pipeline_detail
