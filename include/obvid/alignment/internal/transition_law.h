// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "obvid/alignment/transition.h"
#include "obvid/geom/vec2.h"

namespace obvid {

/// f of `Transition` and its integral for a transition with these ends and this length > 0.
class TransitionLaw {
 public:
  TransitionLaw(Transition kind, double kappa0, double kappa1, double length);

  /// Whether there is such a curve. A cubic parabola's curvature is greatest where it has turned by
  /// atan(1/sqrt 5) = 24.1 deg from its inflection: beyond, none leads to it. `share` and `turn`
  /// are those of the nearest one then.
  [[nodiscard]] bool exists() const { return exists_; }
  /// As given; where the curvature stays as it is, that of a clothoid.
  [[nodiscard]] Transition kind() const { return kind_; }
  /// Whether the curvature is linear: a clothoid, or none that changes.
  [[nodiscard]] bool is_linear() const { return kind_ == Transition::kClothoid; }
  /// The share of its length at which a cubic parabola passes its inflection, if it does.
  [[nodiscard]] std::optional<double> inflection() const;
  /// The share up to which the curvature bends to one side and behind which to the other: the
  /// middle, the inflection of a cubic parabola; 1 where it bends to one side all along.
  [[nodiscard]] double bends_back() const;
  /// f(u), u in [0, 1]. Where the curvature stays as it is, u.
  [[nodiscard]] double share(double u) const;
  /// Its integral from 0 to u. To 1 it is 1/2 but for a cubic parabola.
  [[nodiscard]] double turn(double u) const;
  /// Both at once, and what a cubic parabola that exists has in closed form.
  struct Place {
    double share = 0.0, turn = 0.0;
    std::optional<Vec2> step{};  ///< from the start, in a frame along its tangent, units
  };
  [[nodiscard]] Place at(double u) const;

 private:
  Transition kind_;
  bool exists_ = true;
  /// Of a cubic parabola, in units in which its tangent at the abscissa x has the slope x^2: from
  /// its inflection, arc length up to its start, and from there to its end.
  double from_ = 0.0, to_ = 0.0, before_ = 0.0, along_ = 0.0;
  double bent_ = 0.0, bends_ = 0.0;  ///< half the curvature at its start, and what it changes by
  double scale_ = 0.0, side_ = 1.0;  ///< units in one of these; its curvature grows or falls
};

/// `transition_at` with the law of its ends and length.
[[nodiscard]] Element transition_at(const TransitionLaw& law, const Element& start, double kappa1,
                                    double length, double s);

}  // namespace obvid
