// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "obvid/alignment/transition.h"
#include "obvid/geom/element.h"
#include "plane.h"

namespace obvid::alignment {

/// Elements one behind another, each beginning where the one before ends, with its tangent. Ends of
/// elements that share a number of `kappa` have the same curvature, whatever it is: both ends of an
/// arc, both sides of a joint without a step.
struct Chain {
  static constexpr int kStraight = -1;  ///< in place of a number: curvature 0

  Plane plane = Plane::kMap;
  Vec2 start;
  double theta = 0.0;                    ///< heading at the start, rad
  std::vector<double> length;            ///< of each element
  std::vector<double> kappa;             ///< 1/unit
  std::vector<std::array<int, 2>> ends;  ///< of each element: numbers of its curvatures
  std::vector<Transition> law;           ///< of each element; of none in a graph but clothoids

  [[nodiscard]] std::size_t size() const { return length.size(); }
  [[nodiscard]] double curvature(std::size_t element, std::size_t end) const {
    const int number = ends[element][end];
    return number == kStraight ? 0.0 : kappa[static_cast<std::size_t>(number)];
  }
  /// Points and headings at the joints: one more than elements.
  [[nodiscard]] std::vector<Element> joints() const;
  /// The headings alone, which cost a hundredth of that.
  [[nodiscard]] std::vector<double> headings() const;
};

/// A point's foot on the chain.
struct Foot {
  std::size_t element = 0;
  double s = 0.0;       ///< from the start of the element; beyond the chain's ends also outside
  double offset = 0.0;  ///< of the point, to the left positive
  double along = 0.0;  ///< of the point, beyond the foot: rounding but for the first and last point
};

/// A chain with the feet of the points that it was made for.
struct FootedChain {
  Chain chain;
  std::vector<Foot> feet;
};

/// Feet of points, in order, searched from those given (the stations before the chain changed).
void find_feet(const Chain& chain, const std::vector<Vec2>& points, std::vector<Foot>& feet);

/// What stays as it is while elements are fitted.
struct Held {
  bool start = false;            ///< the pose at the start
  std::optional<Element> end{};  ///< the pose at the end: point and heading
  std::vector<int> kappa{};      ///< numbers of curvatures
  double least_length = 0.0;     ///< that elements keep
  /// Largest offset over its tolerance after least squares at which the fit gives up.
  double hopeless = std::numeric_limits<double>::infinity();
  double largest_curvature = std::numeric_limits<double>::infinity();  ///< that ends keep
  /// Asked between steps: once true, what is left is infinite.
  std::function<bool()> cancelled{};
};

/// Moves the chain to where the largest offset over its tolerance is small: least squares first,
/// and where that is not within 1, higher powers (weights of [Lawson 1961]). Returns the largest
/// |offset| over tolerance that is left; `squares` the sum of their squares after least squares.
struct Fitted {
  double largest = 0.0;
  double squares = 0.0;
};
Fitted fit_chain(Chain& chain, const std::vector<Vec2>& points,
                 const std::vector<double>& tolerance, std::vector<Foot>& feet, const Held& held);

/// How much the sum of squares of a fitted chain grows, to first order, when curvature number `a`
/// has to be that of number `b`, or straight.
[[nodiscard]] double growth_of(const Chain& chain, const std::vector<Vec2>& points,
                               const std::vector<double>& tolerance, const std::vector<Foot>& feet,
                               const Held& held, int a, int b);

}  // namespace obvid::alignment
