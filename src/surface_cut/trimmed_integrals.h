// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "branches.h"
#include "cells.h"
#include "integrals.h"
#include "obvid/surface/internal/trim.h"

namespace obvid::afloat {

/// Integrals over what of a trimmed patch lies inside its trims and below the water, by Green's
/// theorem in the plane of the parameters: along the trims where they are wet, and along the
/// waterline where it is inside, of the integral across from one side of the trims' box. Each runs
/// over a smooth part of its curve: between knots of the curve and of the patch, the waterline and
/// the trims.
///
/// What is wet along a trim, and inside along the waterline, is told at 16 places of each span and
/// part; what changes twice between two of these goes on as if it did not. Boundaries that do not
/// close by that add to the error what the gap may count.
class TrimmedIntegrals {
 public:
  /// `decided`: the plane that tells wet from dry. Keeps references to all but `origin` and `size`.
  TrimmedIntegrals(const SurfacePatch& patch, const std::vector<TrimLoop>& oriented,
                   const CutPatch& cut, const PlaneFoot& foot, const CutPlane& decided, Vec3 origin,
                   double size);

  void take(const SectionCell& cell, CellKind kind);
  /// After all cells, once.
  void finish();

  Sum sum;
  std::size_t undecided = 0;

 private:
  /// A place in the plane of the parameters, and its derivative.
  struct Foot {
    Vec2 at, d1;
  };
  using Path = std::function<Foot(double)>;

  [[nodiscard]] bool is_wet(Vec2 p) const;
  void along_trim(const NurbsCurve& curve);
  void add_error_of(const NurbsCurve& curve, Range part);
  void along_waterline(const SectionCell& cell, bool over_u, Range u, Range v);
  void around(Range u, Range v);
  /// Where `state` of a place holds, `direction` (1, or -1 backwards).
  void where(const Path& path, Range t, double direction, const std::function<bool(Vec2)>& state);
  void along(const Path& path, Range t, double direction);
  template <std::size_t N>
  [[nodiscard]] Integrals across(double inner, double outer, int halvings, Rule<N>) const;

  const SurfacePatch& patch_;
  const std::vector<TrimLoop>& loops_;
  const CutPatch& cut_;
  const PlaneFoot& foot_;
  const CutPlane& decided_;
  Vec3 origin_;
  Integrals small_;
  TrimRegion region_;
  bool inner_u_;  ///< first across lines of constant v
  double inner_from_ = 0.0;
  std::vector<double> inner_knots_, outer_knots_;
  mutable Integrals largest_{};  ///< across
  mutable std::vector<double> places_, weights_;
  mutable std::vector<SurfacePoint> points_;
  double left_open_ = 0.0;  ///< of the outer parameter
};

}  // namespace obvid::afloat
