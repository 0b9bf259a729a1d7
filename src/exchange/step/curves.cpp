// SPDX-License-Identifier: Apache-2.0
#include "step/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obvid::exchange {
namespace {

/// Knots without repetitions, and how often each stands.
struct KnotRows {
  std::vector<double> values;
  std::vector<int> counts;
};

KnotRows knot_rows(const std::vector<double>& knots) {
  KnotRows out;
  for (const double knot : knots) {
    if (!out.values.empty() && out.values.back() == knot) {
      ++out.counts.back();
    } else {
      out.values.push_back(knot);
      out.counts.push_back(1);
    }
  }
  return out;
}

/// Kernels take knots nearer than 1e-9 for one, whatever the unit of the drawing makes of them.
constexpr double kKnotsApart = 1e-6;

/// The knots, by a power of two farther apart where they are nearer: the curve is the same.
std::vector<double> told_apart(std::vector<double> knots) {
  double least = knots.back() - knots.front();
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double step = knots[i] - knots[i - 1];
    if (step > 0.0) least = std::min(least, step);
  }
  if (!(least > 0.0 && least < kKnotsApart)) return knots;
  const int doublings = static_cast<int>(std::ceil(std::log2(kKnotsApart / least)));
  for (double& knot : knots) knot = std::ldexp(knot, doublings);
  return knots;
}

template <class Value>
std::string list_of(const std::vector<Value>& values) {
  return step_list<Value>(values);
}

std::string trim_of(StepId point, double parameter) {
  return fmt::format("({},PARAMETER_VALUE({}))", step_value(point), step_value(parameter));
}

}  // namespace

StepCurves::StepCurves(StepFile& file) : file_(file) {
  up_ = file_.add("DIRECTION('',(0.,0.,1.))");
  origin_ = axes(point({}, 0.0), up_, direction({1.0, 0.0}));
}

StepId StepCurves::point(Vec2 p, double z) {
  return file_.add(fmt::format("CARTESIAN_POINT('',({},{},{}))", step_value(p.x), step_value(p.y),
                               step_value(z)));
}

StepId StepCurves::direction(Vec2 d) {
  return file_.add(fmt::format("DIRECTION('',({},{},0.))", step_value(d.x), step_value(d.y)));
}

StepId StepCurves::axes(StepId at, StepId z, StepId x) {
  return file_.add(
      fmt::format("AXIS2_PLACEMENT_3D('',{},{},{})", step_value(at), step_value(z), step_value(x)));
}

StepId StepCurves::line(const StepShape& shape, const StepLine& one, double z) {
  const StepId start = point(shape.start, z);
  const StepId vector =
      file_.add(fmt::format("VECTOR('',{},1.)", step_value(direction(one.direction))));
  return file_.add(fmt::format("LINE('',{},{})", step_value(start), step_value(vector)));
}

StepId StepCurves::down() {
  if (!down_) down_ = file_.add("DIRECTION('',(0.,0.,-1.))");
  return *down_;
}

StepId StepCurves::conic(const StepConic& one, double z) {
  const StepId at = axes(point(one.centre, z), one.left ? up_ : down(), direction(one.axis));
  if (one.major == one.minor) {
    return file_.add(fmt::format("CIRCLE('',{},{})", step_value(at), step_value(one.major)));
  }
  return file_.add(fmt::format("ELLIPSE('',{},{},{})", step_value(at), step_value(one.major),
                               step_value(one.minor)));
}

StepId StepCurves::spline(const NurbsCurve& curve, bool closed, double z) {
  std::vector<StepId> points;
  for (const Vec2 p : curve.points) {
    if (file_.has_ended()) break;
    points.push_back(point(p, z));
  }
  return spline_through(curve, points, closed);
}

StepId StepCurves::spline(const SpaceCurve& curve) {
  std::vector<StepId> points;
  for (const Vec3& p : curve.points) {
    if (file_.has_ended()) break;
    points.push_back(point({p.x, p.y}, p.z));
  }
  return spline_through(curve, points, curve.points.front() == curve.points.back());
}

template <class Curve>
StepId StepCurves::spline_through(const Curve& curve, const std::vector<StepId>& points,
                                  bool closed) {
  const KnotRows knots = knot_rows(told_apart(curve.knots));
  const std::string general = fmt::format("{},{},.UNSPECIFIED.,{},.U.", curve.degree,
                                          list_of(points), closed ? ".T." : ".F.");
  const std::string with_knots =
      fmt::format("{},{},.UNSPECIFIED.", list_of(knots.counts), list_of(knots.values));
  const bool rational = std::any_of(curve.weights.begin(), curve.weights.end(),
                                    [&](double w) { return w != curve.weights.front(); });
  if (!rational) {
    return file_.add(fmt::format("B_SPLINE_CURVE_WITH_KNOTS('',{},{})", general, with_knots));
  }
  return file_.add(fmt::format(
      "(BOUNDED_CURVE()B_SPLINE_CURVE({})B_SPLINE_CURVE_WITH_KNOTS({})CURVE()"
      "GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE({})REPRESENTATION_ITEM(''))",
      general, with_knots, list_of(curve.weights)));
}

StepId StepCurves::basis(const StepShape& shape, double z) {
  if (const auto* one = std::get_if<StepLine>(&shape.curve)) return line(shape, *one, z);
  if (const auto* one = std::get_if<StepConic>(&shape.curve)) return conic(*one, z);
  return spline(std::get<NurbsCurve>(shape.curve), shape.start == shape.end, z);
}

StepId StepCurves::trimmed(const StepShape& shape) {
  const StepId whole = basis(shape, 0.0);
  if (std::holds_alternative<NurbsCurve>(shape.curve)) return whole;
  double from = 0.0, to = 0.0;
  if (const auto* one = std::get_if<StepLine>(&shape.curve)) to = one->length;
  if (const auto* one = std::get_if<StepConic>(&shape.curve)) {
    from = one->from;
    to = one->to;
  }
  const StepId start = point(shape.start, 0.0), end = point(shape.end, 0.0);
  return file_.add(fmt::format("TRIMMED_CURVE('',{},{},{},.T.,.PARAMETER.)", step_value(whole),
                               trim_of(start, from), trim_of(end, to)));
}

StepId StepCurves::whole(const StepChain& chain) {
  const StepShape& first = chain.shapes.front();
  if (chain.shapes.size() == 1) {
    // a whole circle has no ends to be trimmed at
    const bool circle = chain.closed && std::holds_alternative<StepConic>(first.curve);
    return circle ? basis(first, 0.0) : trimmed(first);
  }
  std::vector<StepId> segments;
  for (const StepShape& shape : chain.shapes) {
    const bool end = &shape == &chain.shapes.back() && !chain.closed;
    segments.push_back(file_.add(fmt::format("COMPOSITE_CURVE_SEGMENT({},.T.,{})",
                                             end ? ".DISCONTINUOUS." : ".CONTINUOUS.",
                                             step_value(trimmed(shape)))));
  }
  return file_.add(fmt::format("COMPOSITE_CURVE('',{},.U.)", list_of(segments)));
}

}  // namespace obvid::exchange
