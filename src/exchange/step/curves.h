// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "step/file.h"
#include "step/piece_chain.h"

namespace obvid::exchange {

/// Writes points, directions and curves in planes z = const.
class StepCurves {
 public:
  explicit StepCurves(StepFile& file);

  StepId point(Vec2 p, double z);
  StepId direction(Vec2 d);
  /// Axes at a point: z as given, x along `x`.
  StepId axes(StepId at, StepId z, StepId x);

  /// The LINE, CIRCLE, ELLIPSE or spline that a shape is part of.
  StepId basis(const StepShape& shape, double z);
  /// Just the shape: trimmed unless it is a spline.
  StepId trimmed(const StepShape& shape);
  /// A NURBS curve in space.
  StepId spline(const SpaceCurve& curve);
  /// All of a chain as one curve.
  StepId whole(const StepChain& chain);

  [[nodiscard]] StepId up() const { return up_; }
  [[nodiscard]] StepId origin() const { return origin_; }

 private:
  StepId line(const StepShape& shape, const StepLine& one, double z);
  StepId conic(const StepConic& one, double z);
  StepId down();
  StepId spline(const NurbsCurve& curve, bool closed, double z);
  template <class Curve>
  StepId spline_through(const Curve& curve, const std::vector<StepId>& points, bool closed);

  StepFile& file_;
  StepId up_, origin_;
  std::optional<StepId> down_;
};

}  // namespace obvid::exchange
