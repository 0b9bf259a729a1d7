// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/surface/nurbs_surface.h"

namespace obvid::cad {

/// Curves and surfaces as the kernel has them: degree, knots, points and weights as they are.
[[nodiscard]] Handle(Geom_BSplineCurve) spline_of(const SpaceCurve& curve);
[[nodiscard]] Handle(Geom_BSplineSurface) spline_of(const NurbsSurface& surface);

/// Back again; knots clamped, periods opened. Error: what `check` finds, degrees above 9 among it.
[[nodiscard]] Result<NurbsSurface> surface_of(Handle(Geom_BSplineSurface) spline);

/// The same of a curve; clamped as it is.
[[nodiscard]] Result<SpaceCurve> curve_of(Handle(Geom_BSplineCurve) spline);

/// The kernel's table of knots: each once, ascending, and how often it stands.
struct KnotTable {
  TColStd_Array1OfReal values;
  TColStd_Array1OfInteger multiplicities;
};
[[nodiscard]] KnotTable knot_table(const std::vector<double>& knots);

}  // namespace obvid::cad
