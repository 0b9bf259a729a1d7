// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bezier_rows.h"
#include "obvid/core/run_context.h"
#include "obvid/surface/nurbs_surface.h"
#include "obvid/surface_cut/internal/plane_section.h"

namespace obvid {

/// Halvings of a span after which a part is given up, and when so many parts are left that the
/// surface touches the plane along a line.
inline constexpr int kMostHalvings = 26;
inline constexpr int kHalvingsAlongLines = 10;
inline constexpr std::size_t kMostCellsAtOnce = 20'000;

/// A patch as the cutter knows it: independent of planes.
struct CutPatch {
  const NurbsSurface* surface = nullptr;
  BezierRows u, v;
};
[[nodiscard]] CutPatch cut_patch(const NurbsSurface& surface);

/// Distances of the control points from a plane times their weights, in the order of the points;
/// positive on the side of the normal.
[[nodiscard]] std::vector<double> heights_of(const NurbsSurface& surface, const CutPlane& plane);

/// A part of a span with the Bezier coefficients of weight times distance: number
/// l * (degree_u + 1) + k belongs to k along u and l along v.
struct SectionCell {
  std::size_t span_u = 0, span_v = 0;
  int halvings = 0;
  std::uint32_t at_u = 0, at_v = 0;  ///< which of 2^halvings parts of the span
  std::array<double, (kMaxNurbsDegree + 1) * (kMaxNurbsDegree + 1)> c{};

  [[nodiscard]] double share(std::uint32_t place) const {
    return static_cast<double>(place) / static_cast<double>(1U << static_cast<unsigned>(halvings));
  }
  [[nodiscard]] Range shares_u() const { return {share(at_u), share(at_u + 1)}; }
  [[nodiscard]] Range shares_v() const { return {share(at_v), share(at_v + 1)}; }
};

/// How a cell is decided. The zero of a distance counts as positive.
enum class CellKind {
  kAbove,      ///< no negative coefficient
  kBelow,      ///< negative coefficients only
  kOverU,      ///< the distance rises or falls along v: branches are functions of u
  kOverV,      ///< likewise along u: functions of v
  kUndecided,  ///< given up
};

/// Divides the patch until all parts are decided and hands each of them on; whole spans below
/// without coefficients, and those above not at all. `noise` is what rounding may have done to a
/// coefficient. Error: E103.
[[nodiscard]] Result<void> divide(const CutPatch& patch, std::span<const double> heights,
                                  double noise, const RunContext& run,
                                  const std::function<void(const SectionCell&, CellKind)>& take);

/// Sides of a cell as of `PatchSide`: the coefficients along one.
[[nodiscard]] std::vector<double> side_of(const SectionCell& cell, int degree_u, int degree_v,
                                          std::size_t side);

/// Roots of a polynomial in Bezier form over [0, 1], ascending: places where its sign changes, zero
/// counting as positive. Two roots within 1e-12 of each other may both be missed. Divided at
/// halves, so a half has the roots of the whole in it, apart from their rounding.
[[nodiscard]] std::vector<double> sign_changes(const std::vector<double>& coefficients);

}  // namespace obvid
