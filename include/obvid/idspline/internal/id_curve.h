// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "obvid/core/result.h"
#include "obvid/idspline/internal/id_spline.h"

namespace obvid {

/// Curve in the plane (N = 2) or in space (N = 3): one integro-differential spline per coordinate
/// over the chord length summed up along its points ([004], formula (22)).
template <std::size_t N>
struct IdCurve {
  std::array<IdSpline, N> part;  ///< all with the same nodes, from 0 on
};

/// Point and derivatives by the parameter.
template <std::size_t N>
struct VectorJet {
  std::array<double, N> point{}, d1{}, d2{}, d3{};
};

/// Curve along points, N = 2 or 3. It passes through them unless values are free; then
/// `largest_move` says how far it stays away. Degree 2 without smoothing has kinks. Where chords
/// are uneven their lengths are no arc lengths, and the order of approximation is at most 4 with
/// any degree. Errors: E203, E304, E309 and E405 as `id_spline`; E303 a coordinate that is not
/// finite, E402 neighbours that coincide (`index`: the point).
template <std::size_t N>
[[nodiscard]] Result<IdCurve<N>> id_curve(std::span<const std::array<double, N>> points,
                                          const IdSplineOptions& options = {
                                              4, IdSmoothing::kValuesKept});

/// Point and derivatives at parameter u; outside the nodes the end pieces go on. O(log n).
template <std::size_t N>
[[nodiscard]] VectorJet<N> evaluate(const IdCurve<N>& curve, double u);

/// Largest distance between a point and the place of the curve at its parameter.
template <std::size_t N>
[[nodiscard]] double largest_move(const IdCurve<N>& curve,
                                  std::span<const std::array<double, N>> points);

}  // namespace obvid
