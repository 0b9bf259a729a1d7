// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/curve/internal/contour_path.h"
#include "obvid/numeric/internal/halving.h"
#include "obvid/report/airfoil_figures.h"

namespace obvid {

/// Place in [a, b] at which a function that changes its sign there does so.
template <class Function>
double sign_change(double a, double b, const Function& f) {
  const bool rises = f(b) > 0.0;
  return end_of_condition(a, b, [&](double x) { return (f(x) > 0.0) != rises; }).middle();
}

/// Place on a side of this length whose x, which rises, is the given one; beyond its ends the end.
template <class XOn>
double place_with_x(double x, double length, const XOn& x_on) {
  if (!(x > 0.0)) return 0.0;
  if (!(x < x_on(length))) return length;
  return sign_change(0.0, length, [&](double s) { return x_on(s) - x; });
}

/// The contour from one end of its trailing edge around to the other, upper side first. The contour
/// must live as long.
class Airfoil {
 public:
  /// Errors: E311 no trailing edge, or nothing that it goes around; E402 a cusp.
  [[nodiscard]] static Result<Airfoil> of(const Contour& contour);

  /// Arc length along the sides is counted from the upper end of the trailing edge.
  [[nodiscard]] double length() const { return to_ - from_; }
  [[nodiscard]] double nose() const { return nose_; }
  [[nodiscard]] ContourPath::Place at(double s) const;
  /// Along the chord from the leading edge and to the left of it, units.
  [[nodiscard]] Vec2 local(Vec2 p) const;
  [[nodiscard]] Vec2 back(Vec2 q) const {
    return leading_ + q.x * along_ + q.y * Vec2{-along_.y, along_.x};
  }
  [[nodiscard]] double chord() const { return chord_; }
  [[nodiscard]] Vec2 leading() const { return leading_; }
  [[nodiscard]] Vec2 along() const { return along_; }

  /// The side that ends before the other one, along the chord, goes on straight to where that one
  /// does; the chord is measured anew. Error, and nothing is changed: E311 why it does not.
  Result<void> level_ends();
  /// How far that side goes on, units.
  [[nodiscard]] double goes_on(bool upper) const { return goes_on_[upper ? 0 : 1]; }
  [[nodiscard]] Vec2 end(bool upper) const;
  /// Of an edge at which both sides end at one point, turned against each other; 0 of others.
  [[nodiscard]] double edge_radius() const;

  /// Arc length on a side from the leading edge, to its end.
  [[nodiscard]] double side_length(bool upper) const { return of_contour(upper) + goes_on(upper); }
  [[nodiscard]] ContourPath::Place on_side(bool upper, double s) const;
  [[nodiscard]] double x_on(bool upper, double s) const { return local(on_side(upper, s).point).x; }
  /// Whether x rises all along a side.
  [[nodiscard]] bool runs_along(bool upper) const;
  /// Height of a side at x, which must run along.
  [[nodiscard]] double height(bool upper, double x) const {
    return local(on_side(upper, place_of(upper, x)).point).y;
  }
  [[nodiscard]] double place_of(bool upper, double x) const;
  /// Places of a side at which a largest or a first one is sought.
  [[nodiscard]] std::size_t looks() const;
  /// Of an airfoil whose sides run along.
  [[nodiscard]] AirfoilFigures figures() const;

 private:
  explicit Airfoil(ContourPath path) : path_(std::move(path)) {}
  [[nodiscard]] double of_contour(bool upper) const { return upper ? nose_ : length() - nose_; }
  /// From the end of a side on.
  [[nodiscard]] Vec2 outward(bool upper) const {
    return upper ? -1.0 * at(0.0).tangent : at(length()).tangent;
  }
  bool open_at_corner();
  bool open_at_round_edge();
  [[nodiscard]] double farthest_from(Vec2 p) const;
  Result<void> measure_chord();
  void look_at_nose(AirfoilFigures& figures) const;

  ContourPath path_;
  double from_ = 0.0, to_ = 0.0;
  bool wraps_ = false, reversed_ = false;
  std::array<double, 2> goes_on_{};  ///< upper side, lower side
  double nose_ = 0.0, chord_ = 0.0;
  Vec2 leading_{}, along_{};
};

/// An airfoil both of whose sides run along the chord. Errors: those of `Airfoil::of`; E311 a side
/// that folds back.
[[nodiscard]] Result<Airfoil> airfoil_of(const Contour& contour);

}  // namespace obvid
