// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "obvid/geom/vec3.h"

namespace obvid {

/// Point and two derivatives by a parameter.
struct Hermite {
  Vec3 point;
  Vec3 d1;
  Vec3 d2;
};

/// Control points of the Bezier piece of degree 5 over a span of this length with these ends.
[[nodiscard]] std::array<Vec3, 6> quintic(const Hermite& from, const Hermite& to, double length);

/// Point and two derivatives of the piece at a share of its span.
[[nodiscard]] Hermite evaluate(const std::array<Vec3, 6>& piece, double part, double length);

inline constexpr int kSkinDegree = 5;

/// Knots of the C2 spline of degree 5 with these breaks: inner ones three times.
[[nodiscard]] std::vector<double> quintic_knots(const std::vector<double>& breaks);
/// Its control points: 3 for each break and span, 6 for the first.
[[nodiscard]] std::vector<Vec3> quintic_points(const std::vector<double>& breaks,
                                               const std::vector<Hermite>& data);

}  // namespace obvid
