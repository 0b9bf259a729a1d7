// SPDX-License-Identifier: Apache-2.0
#include "set_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "obvid/geom/internal/angle.h"

namespace obvid::chain_detail {
namespace {

/// Infeasible by less than this many roundings of the coordinates: the rounding decides.
constexpr double kRoundingsThatDecide = 64.0;

double heading_on_stretch(const Analysis& a, const CircularStretch& s, std::size_t i) {
  // next to the stretch's ends the adjacent circle is another one: go by the chord inside
  if (i < s.last) {
    const std::size_t inner = i == s.first ? i + 1 : i;
    const double angle = i == s.first ? a.circles[inner].eta_in : a.circles[inner].eta_out;
    return a.chords[i].omega - (s.kappa == 0.0 ? 0.0 : angle);
  }
  return a.chords[i - 1].omega + (s.kappa == 0.0 ? 0.0 : a.circles[i - 1].eta_out);
}

/// Sign that the curvature must keep at a point: that of its circle, unless the series changes
/// sign right beside it.
int forced_sign(const Analysis& a, std::size_t i) {
  const auto sign = [&a](std::size_t j) {
    const AdjacentCircle& c = a.circles[j];
    return std::abs(c.kappa) <= c.rounding ? 0 : c.kappa > 0.0 ? 1 : -1;
  };
  const int own = sign(i);
  const int before = i > 0 ? sign(i - 1) : own,
            after = i + 1 < a.circles.size() ? sign(i + 1) : own;
  return before == -own || after == -own ? 0 : own;
}

/// Whether a value lies outside a range by more than `off`.
bool leaves(const std::optional<ValueRange>& range, double value, double off) {
  return range && (value < range->low - off || value > range->high + off);
}

/// Whether data given at a point of a stretch are others than the stretch's own.
bool contradicts(const FixedData& data, double theta, double kappa, double rounding) {
  // as nearly as given data are kept (docs/methods/certify.md)
  constexpr double kSameHeading = 1e-6;    // rad
  constexpr double kSameCurvature = 1e-6;  // of the stretch's curvature
  const double off = std::max(kSameCurvature * std::abs(kappa), rounding);
  if (data.theta && std::abs(theta - nearest_angle(*data.theta, theta)) > kSameHeading) return true;
  if (data.kappa && std::abs(*data.kappa - kappa) > off) return true;
  return (data.thetas && leaves(data.thetas, turned_to(*data.thetas, theta), kSameHeading)) ||
         leaves(data.kappas, kappa, off);
}

std::string point_range(const Infeasibility& why) {
  return "points " + std::to_string(why.first_point + 1) + " to " +
         std::to_string(why.last_point + 1);
}

bool touches_stretch(const Analysis& a, const Infeasibility& why) {
  return std::any_of(a.stretches.begin(), a.stretches.end(), [&](const CircularStretch& s) {
    return s.first <= why.last_point && why.first_point <= s.last;
  });
}

/// Largest move of a point by rounding, among the points of the infeasible part and its neighbours.
double rounding_move(const std::vector<Vec2>& points, const Infeasibility& why) {
  double largest = 0.0;
  const std::size_t first = why.first_point >= 2 ? why.first_point - 2 : 0;
  for (std::size_t i = first; i < std::min(points.size(), why.last_point + 3); ++i) {
    largest = std::max(largest, 0x1p-53 * (std::abs(points[i].x) + std::abs(points[i].y)));
  }
  return largest;
}

int sign_of(double value) { return value > 0.0 ? 1 : value < 0.0 ? -1 : 0; }

/// The way in which most points turn, 1 or -1; where they do not tell, that of the fixed
/// curvatures.
int way_of_turning(const Analysis& a, const ChainConstraints& constraints) {
  int turns = 0;
  for (const AdjacentCircle& circle : a.circles) turns += sign_of(circle.kappa);
  for (std::size_t i = 0; turns == 0 && i < constraints.fixed.size(); ++i) {
    turns = sign_of(constraints.fixed[i].kappa.value_or(0.0));
  }
  return turns > 0 ? 1 : -1;
}

}  // namespace

bool anything_constrained(const ChainConstraints& constraints) {
  return constraints.convex || std::any_of(constraints.fixed.begin(), constraints.fixed.end(),
                                           [](const FixedData& f) { return f.says_how(); });
}

Error explain(const std::vector<Vec2>& points, const Analysis& a,
              const ChainConstraints& constraints, const Infeasibility& why) {
  const auto index = static_cast<std::ptrdiff_t>(why.first_point);
  const auto last = static_cast<std::ptrdiff_t>(why.last_point);
  const std::string where = point_range(why);
  const bool leaps = why.slack == 0.0;
  if (!leaps && why.move <= kRoundingsThatDecide * rounding_move(points, why)) {
    return error(
               ErrorCode::kRoundingDecides,
               "the rounding of the coordinates, not the curve, decides how the curvature changes")
        .where(where)
        .hint(
            "say how far the curve may pass the points (--noise), give coordinates relative to a "
            "nearer origin, or leave out points that lie closer together than their digits can "
            "tell")
        .points(index, last)
        .value(why.move);
  }
  if (touches_stretch(a, why)) {
    return error(
               ErrorCode::kNoRoomForTransition,
               "a straight or circular stretch leaves no room for a change of curvature beside it")
        .where(where)
        .hint("remove a point at the end of the stretch, or move one off it")
        .points(index, last)
        .value(why.move);
  }
  if (anything_constrained(constraints)) {
    return error(ErrorCode::kFixedDataContradict,
                 "the fixed headings, curvatures or convexity cannot be met by a monotone contour")
        .where(where)
        .hint("free the data there")
        .points(index, last)
        .value(why.move);
  }
  if (leaps) {
    return error(ErrorCode::kNoSpiral,
                 "a curve with curvature changing as the points demand would have to leap at them")
        .where(where)
        .hint("move points there, or add points")
        .points(index, last)
        .value(why.move);
  }
  return error(ErrorCode::kNoSpiral,
               "no curve with curvature changing as the points demand runs through them")
      .where(where)
      .hint("move points there, or add points")
      .points(index, last)
      .value(why.move);
}

}  // namespace obvid::chain_detail

namespace obvid {

Result<ChainProblem> chain_problem(const Analysis& a, const ChainConstraints& constraints) {
  using namespace chain_detail;
  ChainProblem p{a.chords, a.circles, a.direction, {}, std::vector<NodeData>(a.circles.size())};
  p.least_change = constraints.least_change;
  for (const std::int8_t d : a.direction)
    p.cone.push_back(d == 0 ? Cone::kNone : Cone::kClosedForm);
  for (std::size_t i = 0; i < p.nodes.size(); ++i) {
    p.nodes[i].curvature_sign = forced_sign(a, i);
    if (i < constraints.fixed.size()) {
      p.nodes[i].theta = constraints.fixed[i].theta;
      p.nodes[i].kappa = constraints.fixed[i].kappa;
    }
  }
  if (constraints.convex) {
    const int turns = way_of_turning(a, constraints);
    for (std::size_t i = 0; i < p.nodes.size(); ++i) {
      const AdjacentCircle& c = a.circles[i];
      if (turns * c.kappa < 0.0 && std::abs(c.kappa) > c.rounding) {
        return error(ErrorCode::kFixedDataContradict,
                     "a convex contour was asked for, but the points turn the other way here")
            .where("point " + std::to_string(i + 1))
            .hint("do not ask for a convex contour")
            .point(i)
            .value(c.kappa);
      }
      if (p.nodes[i].kappa && turns * *p.nodes[i].kappa < 0.0) {
        return error(
                   ErrorCode::kFixedDataContradict,
                   "a convex contour was asked for, but the fixed radius turns the other way here")
            .where("point " + std::to_string(i + 1))
            .hint("do not ask for a convex contour, or change the sign of the radius")
            .point(i)
            .value(*p.nodes[i].kappa);
      }
      p.nodes[i].curvature_sign = turns;
    }
  }
  for (const CircularStretch& s : a.stretches) {
    for (std::size_t i = s.first; i <= s.last; ++i) {
      const double theta = heading_on_stretch(a, s, i);
      if (i < constraints.fixed.size() &&
          contradicts(constraints.fixed[i], theta, s.kappa, a.circles[i].rounding)) {
        return error(ErrorCode::kFixedDataContradict,
                     "the points lie on one circle or line here, with another heading or radius "
                     "than the fixed one")
            .where(fmt::format("point {}", i + 1))
            .hint("free the heading and radius there")
            .point(i)
            .value(s.kappa);
      }
      p.nodes[i].theta = theta;
      p.nodes[i].kappa = s.kappa;
      p.nodes[i].curvature_sign = 0;
    }
  }
  return p;
}

}  // namespace obvid
