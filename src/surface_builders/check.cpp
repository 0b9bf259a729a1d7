// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>

#include "check_lines.h"
#include "obvid/surface/internal/topology.h"

namespace obvid {
namespace {

/// A number of cells is not rounded up for the rounding of a quotient.
constexpr double kCellRounding = 1e-9;

/// Order of continuity that the multiplicities of inner knots leave.
int order_of(const std::vector<double>& knots, int degree) {
  int order = degree;
  const auto p = static_cast<std::ptrdiff_t>(degree);
  for (auto at = knots.begin() + p + 1; at < knots.end() - p - 1;) {
    const auto next = std::upper_bound(at, knots.end() - p - 1, *at);
    order = std::min(order, degree - static_cast<int>(next - at));
    at = next;
  }
  return order;
}

/// A parameter, the part of the domain that it stands for, and where its neighbours may lie: the
/// cells beside it in the same span.
struct Node {
  double at = 0.0;
  double weight = 0.0;
  Range reach;
};

/// About `n` nodes of Gauss's rule, two in each cell, no cell over a knot: a short span has a
/// curvature of its own, and areas are exact to the third degree.
std::vector<Node> nodes_of(const std::vector<double>& knots, const Range& domain, std::size_t n) {
  constexpr double kBefore = 1e-9;  // part of the span: behind the knot curvature may be another
  const double apart = 0.5 / std::numbers::sqrt3;  // of a cell, from its middle
  std::vector<Node> nodes;
  double from = domain.from;
  for (const double knot : knots) {
    const Range span{from, std::min(knot, domain.to)};
    if (!(span.length() > 0.0)) continue;
    const double share = span.length() / domain.length() * (1.0 - kCellRounding);
    const double cells = std::ceil(0.5 * static_cast<double>(n) * share);
    const double cell = span.length() / cells, end = span.at(1.0 - kBefore);
    for (double k = 0.0; k < cells; k += 1.0) {
      for (const double side : {-apart, apart}) {
        const double at = span.at((k + 0.5 + side) / cells);
        nodes.push_back(
            {at, 0.5 * cell, {std::max(span.from, at - cell), std::min(end, at + cell)}});
      }
    }
    from = span.to;
  }
  return nodes;
}

/// The place of a raster where a quantity is greatest (`sign` 1) or least (-1).
struct Extreme {
  double SurfaceCurvature::*quantity;
  double sign;
  double value = -std::numeric_limits<double>::infinity();  ///< times the sign
  Node u{}, v{};

  void look_at(const SurfaceCurvature& k, const Node& at_u, const Node& at_v) {
    if (!(sign * k.*quantity > value)) return;
    value = sign * k.*quantity;
    u = at_u;
    v = at_v;
  }
};

/// The extreme near that place: compass steps through the cells around it, halved until they are
/// far below the raster. Not to where du x dv shrinks to less than half: the surface ends in a
/// point there, its curvature may have no bound, and nothing but the steps would decide it.
double climbed(const NurbsSurface& s, Extreme from) {
  constexpr int kHalvings = 20;  // a millionth of the raster's step: 1e-12 of the curvature's rise
  constexpr int kMostSteps = 200;
  constexpr double kLeastArea = 0.5;
  const auto area_of = [](const SurfaceJet& jet) { return norm(cross(jet.du, jet.dv)); };
  const double least = kLeastArea * area_of(evaluate(s, from.u.at, from.v.at));
  double step_u = from.u.weight, step_v = from.v.weight;
  int halvings = 0;
  for (int step = 0; step < kMostSteps && halvings < kHalvings; ++step) {
    Extreme best = from;
    for (int place = 0; place < 9; ++place) {
      Node u = from.u, v = from.v;
      u.at = std::clamp(u.at + (place % 3 - 1) * step_u, u.reach.from, u.reach.to);
      v.at = std::clamp(v.at + (place / 3 - 1) * step_v, v.reach.from, v.reach.to);
      const SurfaceJet jet = evaluate(s, u.at, v.at);
      if (area_of(jet) >= least) best.look_at(curvature(jet), u, v);
    }
    if (best.value > from.value) {
      from = best;
    } else {
      ++halvings;
      step_u /= 2.0;
      step_v /= 2.0;
    }
  }
  return from.value;
}

/// From a place beside a border towards it, each step half as far away as the one before.
constexpr int kApproach = 8;

/// A way to the border of a patch: straight at it, or into a corner.
struct Way {
  double u = 0.0, v = 0.0;    ///< the place on the border
  double du = 0.0, dv = 0.0;  ///< from there to the beginning of the way

  [[nodiscard]] SurfaceJet jet(const NurbsSurface& s, int step) const {
    const double part = std::ldexp(1.0, -step);
    return evaluate(s, u + part * du, v + part * dv);
  }
};

/// Ways from the outermost nodes to the border and into the corners.
std::vector<Way> ways_out(const NurbsSurface& s, const std::vector<Node>& us,
                          const std::vector<Node>& vs) {
  const Range u = domain_u(s), v = domain_v(s);
  const std::array u_ends{Way{u.from, 0.0, us.front().at - u.from, 0.0},
                          Way{u.to, 0.0, us.back().at - u.to, 0.0}};
  const std::array v_ends{Way{0.0, v.from, 0.0, vs.front().at - v.from},
                          Way{0.0, v.to, 0.0, vs.back().at - v.to}};
  std::vector<Way> ways;
  for (const Way& end : u_ends) {
    for (const Node& node : vs) ways.push_back({end.u, node.at, end.du, 0.0});
    for (const Way& other : v_ends) ways.push_back({end.u, other.v, end.du, other.dv});
  }
  for (const Way& end : v_ends) {
    for (const Node& node : us) ways.push_back({node.at, end.v, 0.0, end.dv});
  }
  return ways;
}

/// Whether the surface ends in a point there: du x dv shrinks with the distance.
bool vanishes(const NurbsSurface& s, const Way& way) {
  constexpr double kShrunk = 0.02;  // five times what a simple pole leaves
  const auto area_of = [](const SurfaceJet& jet) { return norm(cross(jet.du, jet.dv)); };
  return area_of(way.jet(s, kApproach)) < kShrunk * area_of(way.jet(s, 0));
}

/// What moving control points by their last digits makes of curvatures at the end of a way, 1/unit:
/// as much as a bump of that height on the disc that is left there.
double rounding_on(const NurbsSurface& s, const Way& way) {
  constexpr double kDigits = 2e-12;  // of the coordinates: files have twelve digits or more
  const Vec3 end = evaluate(s, way.u, way.v).point;
  const double distance = norm(way.jet(s, kApproach).point - end);
  const double coordinate = std::max({std::abs(end.x), std::abs(end.y), std::abs(end.z)});
  const double height = kDigits * std::max(coordinate, size_of(s));
  return height / (distance * distance);
}

/// Where a quantity leads on such a way: its last value, or infinity when its steps do not shrink.
/// (Towards a bound as a power p of the distance they shrink by 2^-p; logarithms step evenly.)
/// `rounding`: what the digits of the control points may make of a curvature there, 1/unit.
double led_to(const std::array<SurfaceCurvature, kApproach + 1>& along, const Extreme& one,
              double rounding) {
  constexpr double kShrinks = 0.9;
  constexpr double kRounding = 1e-9;  // of the largest curvature there: of its evaluation
  constexpr std::size_t kLast = kApproach, kMiddle = kLast / 2;
  std::array<double, kApproach + 1> value{};
  for (std::size_t k = 0; k <= kLast; ++k) value[k] = one.sign * along[k].*(one.quantity);
  double largest = std::max(std::abs(along[kLast].k1), std::abs(along[kLast].k2));
  double least = std::max(kRounding * largest, rounding);
  if (one.quantity == &SurfaceCurvature::gaussian) least *= largest;
  bool grows = value[kLast] - value[kMiddle] > least;
  for (std::size_t k = kMiddle; k + 1 < kLast; ++k) {
    const double step = value[k + 1] - value[k];
    grows = grows && step > 0.0 && value[k + 2] - value[k + 1] > kShrinks * step;
  }
  return grows ? std::numeric_limits<double>::infinity() : value[kLast];
}

constexpr std::size_t kWaysUnasked = 64;  // before whoever waits is asked whether to go on

/// Area and curvature of a patch.
struct Measured {
  double area = 0.0;
  CurvatureExtents curvature;
};

Result<Measured> measured(const NurbsSurface& s, std::size_t n, const RunContext& run) {
  constexpr std::array kQuantities{&SurfaceCurvature::gaussian, &SurfaceCurvature::mean,
                                   &SurfaceCurvature::k1, &SurfaceCurvature::k2};
  std::vector<Extreme> extremes;
  for (const auto quantity : kQuantities) {
    extremes.push_back({quantity, -1.0});
    extremes.push_back({quantity, 1.0});
  }
  Measured out;
  const std::vector<Node> along_u = nodes_of(s.knots_u, domain_u(s), n);
  const std::vector<Node> along_v = nodes_of(s.knots_v, domain_v(s), n);
  for (const Node& v : along_v) {
    OBVID_TRY(may_go_on(run));
    for (const Node& u : along_u) {
      const SurfaceJet jet = evaluate(s, u.at, v.at);
      out.area += norm(cross(jet.du, jet.dv)) * u.weight * v.weight;
      const SurfaceCurvature k = curvature(jet);
      if (k.normal == Vec3{}) {
        ++out.curvature.without_normal;
        continue;
      }
      for (Extreme& one : extremes) one.look_at(k, u, v);
    }
  }
  if (!std::isfinite(extremes.front().value)) return out;  // no tangent plane anywhere
  std::vector<double> most;
  for (const Extreme& one : extremes) {
    OBVID_TRY(may_go_on(run));
    most.push_back(climbed(s, one));
  }
  std::size_t ways = 0;
  for (const Way& way : ways_out(s, along_u, along_v)) {
    if (++ways % kWaysUnasked == 0) OBVID_TRY(may_go_on(run));
    if (!vanishes(s, way)) continue;
    std::array<SurfaceCurvature, kApproach + 1> along;
    bool tangent = true;
    for (int k = 0; k <= kApproach; ++k) {
      SurfaceCurvature& there = along[static_cast<std::size_t>(k)];
      there = curvature(way.jet(s, k));
      tangent = tangent && !(there.normal == Vec3{});
    }
    const double rounding = rounding_on(s, way);
    for (std::size_t q = 0; tangent && q < most.size(); ++q) {
      most[q] = std::max(most[q], led_to(along, extremes[q], rounding));
    }
  }
  const auto extent = [&](std::size_t q) { return Extent{-most[2 * q], most[2 * q + 1]}; };
  out.curvature.gaussian = extent(0);
  out.curvature.mean = extent(1);
  out.curvature.k1 = extent(2);
  out.curvature.k2 = extent(3);
  return out;
}

Result<PatchReport> report_of(const SurfacePatch& patch, std::size_t samples,
                              const RunContext& run) {
  const NurbsSurface& s = patch.surface;
  PatchReport report;
  report.name = patch.name;
  report.degree_u = s.degree_u;
  report.degree_v = s.degree_v;
  report.count_u = s.count_u();
  report.count_v = s.count_v();
  report.order_u = order_of(s.knots_u, s.degree_u);
  report.order_v = order_of(s.knots_v, s.degree_v);
  report.rational = !s.weights.empty();
  const auto measures = measured(s, samples, run);
  OBVID_TRY(measures);
  const Measured& found = *measures;
  report.area = found.area;
  report.gaussian = found.curvature.gaussian;
  report.mean = found.curvature.mean;
  report.k1 = found.curvature.k1;
  report.k2 = found.curvature.k2;
  report.without_normal = found.curvature.without_normal;
  const auto along_u = check_lines(s, samples, run);
  OBVID_TRY(along_u);
  const auto along_v = check_lines(transposed(s), samples, run);
  OBVID_TRY(along_v);
  report.along_u = *along_u;
  report.along_v = *along_v;
  return report;
}

/// A place on a side of a patch.
struct SidePlace {
  double u = 0.0, v = 0.0;
};

SidePlace place_on(const NurbsSurface& s, PatchSide side, double t) {
  const Range u = domain_u(s), v = domain_v(s);
  if (runs_along_u(side)) return {t, is_far_end(side) ? v.to : v.from};
  return {is_far_end(side) ? u.to : u.from, t};
}

/// Two sides of an edge, place by place.
class EdgePair {
 public:
  EdgePair(const SurfaceModel& model, const EdgeUse& a, const EdgeUse& b)
      : first_(model.patches[a.patch].surface),
        second_(model.patches[b.patch].surface),
        sides_{a.side, b.side},
        borders_{border_of(first_, a.side), border_of(second_, b.side)},
        along_(a.along == b.along),
        own_pace_(a.own_pace || b.own_pace) {}

  /// Of both patches, at a part of the first one's border.
  [[nodiscard]] std::array<SurfaceJet, 2> at(double part) const {
    const double t = domain(borders_[0]).at(part);
    const double other = own_pace_ && part > 0.0 && part < 1.0
                             ? nearest_parameter(borders_[1], evaluate(borders_[0], t).point)
                             : domain(borders_[1]).at(along_ ? part : 1.0 - part);
    const SidePlace a = place_on(first_, sides_[0], t), b = place_on(second_, sides_[1], other);
    return {evaluate(first_, a.u, a.v), evaluate(second_, b.u, b.v)};
  }

 private:
  const NurbsSurface& first_;
  const NurbsSurface& second_;
  std::array<PatchSide, 2> sides_;
  std::array<SpaceCurve, 2> borders_;
  bool along_, own_pace_;
};

/// Normal curvature in a tangential direction; its sign with the normal.
double normal_curvature(const SurfaceCurvature& k, Vec3 direction) {
  const double c = dot(direction, k.direction1), s = dot(direction, cross(k.normal, k.direction1));
  return k.k1 * c * c + k.k2 * s * s;
}

JointReport joint_of(const SurfaceModel& model, const EdgeUse& one, const EdgeUse& two) {
  constexpr int kPlaces = 33;
  JointReport joint;
  joint.patch = {one.patch, two.patch};
  joint.side = {one.side, two.side};
  const EdgePair pair(model, one, two);
  double step = 0.0, largest = 0.0;
  for (int i = 0; i < kPlaces; ++i) {
    const auto [a, b] = pair.at(static_cast<double>(i) / (kPlaces - 1));
    joint.gap = std::max(joint.gap, norm(a.point - b.point));
    const SurfaceCurvature ka = curvature(a), kb = curvature(b);
    if (ka.normal == Vec3{} || kb.normal == Vec3{}) continue;
    const double sign = dot(ka.normal, kb.normal) < 0.0 ? -1.0 : 1.0;
    joint.angle = std::max(joint.angle, std::atan2(norm(cross(ka.normal, kb.normal)),
                                                   std::abs(dot(ka.normal, kb.normal))));
    // across the border: perpendicular to it in the tangent plane
    const Vec3 along = runs_along_u(one.side) ? a.du : a.dv;
    const Vec3 across = unit(cross(ka.normal, along));
    const double first = normal_curvature(ka, across), second = sign * normal_curvature(kb, across);
    step = std::max(step, std::abs(first - second));
    for (const double k : {ka.k1, ka.k2, kb.k1, kb.k2}) largest = std::max(largest, std::abs(k));
  }
  joint.curvature = largest > 0.0 ? step / largest : 0.0;
  joint.order = joint.angle > kSmoothAngle ? 0 : joint.curvature > kSmoothCurvature ? 1 : 2;
  return joint;
}

/// All pairs of sides at the edges, in the order of the patches.
Result<std::vector<JointReport>> joints_of(const SurfaceModel& model, const Topology& same,
                                           double nearness, const RunContext& run) {
  std::vector<JointReport> joints;
  const Topology near = topology_of(surfaces_of(model), nearness);
  for (const TopologyEdge& edge : near.edges) {
    for (std::size_t a = 0; a < edge.uses.size(); ++a) {
      for (std::size_t b = a + 1; b < edge.uses.size(); ++b) {
        OBVID_TRY(may_go_on(run));
        const EdgeUse &one = edge.uses[a], &two = edge.uses[b];
        joints.push_back(joint_of(model, one, two));
        joints.back().shared =
            same.edge_of[one.patch][one.side] == same.edge_of[two.patch][two.side];
      }
    }
  }
  const auto place = [](const JointReport& joint) {
    return std::tuple(joint.patch[0], joint.side[0], joint.patch[1], joint.side[1]);
  };
  std::sort(joints.begin(), joints.end(),
            [&](const JointReport& x, const JointReport& y) { return place(x) < place(y); });
  return joints;
}

}  // namespace

CurvatureExtents curvature_extents(const NurbsSurface& surface, std::size_t samples) {
  return measured(surface, samples, {})->curvature;  // nobody stops it
}

Result<SurfaceCheck> check_surface(const SurfaceModel& model, const CheckOptions& options,
                                   const RunContext& run) {
  SurfaceCheck result;
  result.size = size_of(model);
  for (const SurfacePatch& patch : model.patches) {
    const double part =
        static_cast<double>(result.patches.size()) / static_cast<double>(model.patches.size());
    OBVID_TRY(tell(run, "measuring", part));
    auto report = report_of(patch, options.samples, run);
    OBVID_TRY(report);
    result.patches.push_back(std::move(*report));
  }
  const Topology topology = topology_of(model);
  auto joints = joints_of(model, topology, options.meeting * result.size, run);
  OBVID_TRY(joints);
  result.joints = std::move(*joints);
  for (const TopologyEdge& edge : topology.edges) {
    if (!edge.point && edge.uses.size() == 1) ++result.free_borders;
  }
  return result;
}

}  // namespace obvid
