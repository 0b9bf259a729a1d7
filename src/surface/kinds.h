// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/surface/surface.h"

namespace obvid {

// Each kind has its evaluation and its NURBS form; surface.cpp chooses among them.
[[nodiscard]] SurfaceJet evaluate_kind(const RuledSurface& s, double u, double v);
[[nodiscard]] SurfaceJet evaluate_kind(const DirectedSurface& s, double u, double v);
[[nodiscard]] SurfaceJet evaluate_kind(const RevolutionSurface& s, double u, double v);
[[nodiscard]] SurfaceJet evaluate_kind(const CoonsPatch& s, double u, double v);
[[nodiscard]] SurfaceJet evaluate_kind(const GordonSurface& s, double u, double v);
[[nodiscard]] SurfaceJet evaluate_kind(const OffsetSurface& s, double u, double v);
[[nodiscard]] SurfaceJet evaluate_kind(const IdSurface& s, double u, double v);

[[nodiscard]] Result<NurbsForm> nurbs_of(const RuledSurface& s);
[[nodiscard]] Result<NurbsForm> nurbs_of(const DirectedSurface& s);
[[nodiscard]] Result<NurbsForm> nurbs_of(const RevolutionSurface& s);
/// Rational curves followed within a third of `tolerance` each, which bounds the `deviation` of a
/// Coons patch only; gaps between curves up to `gap` are let pass.
[[nodiscard]] Result<NurbsForm> nurbs_of(const CoonsPatch& s, double tolerance, double gap);
[[nodiscard]] Result<NurbsForm> nurbs_of(const GordonSurface& s, double tolerance, double gap);
[[nodiscard]] Result<NurbsForm> nurbs_of(const OffsetSurface& s, double tolerance);
[[nodiscard]] Result<NurbsForm> nurbs_of(const IdSurface& s);

/// Point and derivatives by the curve's domain scaled to [0, 1].
[[nodiscard]] SpaceJet evaluate_unit(const SpaceCurve& curve, double t);

/// A rational curve as C1 cubic within the tolerance, over [0, 1]; polynomial ones as they are.
/// Error: E502 beyond 2^12 parts of a span.
struct PolynomialForm {
  SpaceCurve curve;
  double deviation = 0.0;
};
[[nodiscard]] Result<PolynomialForm> polynomial_near(const SpaceCurve& curve, double tolerance);

/// The same degrees and knots for all surfaces; polynomial ones over [0, 1]^2.
void make_alike(std::vector<NurbsSurface>& surfaces);

}  // namespace obvid
