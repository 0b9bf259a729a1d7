// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "check_lines.h"

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

/// Where a quantity leads on such a way: its last value, or infinity when its steps do not shrink.
/// (Towards a bound as a power p of the distance they shrink by 2^-p; logarithms step evenly.)
double led_to(const std::array<SurfaceCurvature, kApproach + 1>& along, const Extreme& one) {
  constexpr double kShrinks = 0.9;
  constexpr double kRounding = 1e-9;  // of the largest curvature there, squared for products
  constexpr std::size_t kLast = kApproach, kMiddle = kLast / 2;
  std::array<double, kApproach + 1> value{};
  for (std::size_t k = 0; k <= kLast; ++k) value[k] = one.sign * along[k].*(one.quantity);
  double largest = std::max(std::abs(along[kLast].k1), std::abs(along[kLast].k2));
  if (one.quantity == &SurfaceCurvature::gaussian) largest *= largest;
  bool grows = value[kLast] - value[kMiddle] > kRounding * largest;
  for (std::size_t k = kMiddle; k + 1 < kLast; ++k) {
    const double step = value[k + 1] - value[k];
    grows = grows && step > 0.0 && value[k + 2] - value[k + 1] > kShrinks * step;
  }
  return grows ? std::numeric_limits<double>::infinity() : value[kLast];
}

/// Area and curvature of a patch.
struct Measured {
  double area = 0.0;
  CurvatureExtents curvature;
};

Measured measured(const NurbsSurface& s, std::size_t n) {
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
  for (const Extreme& one : extremes) most.push_back(climbed(s, one));
  for (const Way& way : ways_out(s, along_u, along_v)) {
    if (!vanishes(s, way)) continue;
    std::array<SurfaceCurvature, kApproach + 1> along;
    bool tangent = true;
    for (int k = 0; k <= kApproach; ++k) {
      SurfaceCurvature& there = along[static_cast<std::size_t>(k)];
      there = curvature(way.jet(s, k));
      tangent = tangent && !(there.normal == Vec3{});
    }
    for (std::size_t q = 0; tangent && q < most.size(); ++q) {
      most[q] = std::max(most[q], led_to(along, extremes[q]));
    }
  }
  const auto extent = [&](std::size_t q) { return Extent{-most[2 * q], most[2 * q + 1]}; };
  out.curvature.gaussian = extent(0);
  out.curvature.mean = extent(1);
  out.curvature.k1 = extent(2);
  out.curvature.k2 = extent(3);
  return out;
}

PatchReport report_of(const SurfacePatch& patch, std::size_t samples) {
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
  const Measured found = measured(s, samples);
  report.area = found.area;
  report.gaussian = found.curvature.gaussian;
  report.mean = found.curvature.mean;
  report.k1 = found.curvature.k1;
  report.k2 = found.curvature.k2;
  report.without_normal = found.curvature.without_normal;
  report.along_u = check_lines(s, samples);
  report.along_v = check_lines(transposed(s), samples);
  return report;
}

/// A place on a side of a patch; `t` in [0, 1] runs with the parameter along the side.
struct SidePlace {
  double u = 0.0, v = 0.0;
};

SidePlace on_side(const NurbsSurface& s, int side, double t) {
  const Range u = domain_u(s), v = domain_v(s);
  switch (side) {
    case 0:
      return {u.from, v.at(t)};
    case 1:
      return {u.to, v.at(t)};
    case 2:
      return {u.at(t), v.from};
    default:
      return {u.at(t), v.to};
  }
}

constexpr int kSideSamples = 33;

std::vector<Vec3> side_points(const NurbsSurface& s, int side) {
  std::vector<Vec3> points;
  for (int k = 0; k < kSideSamples; ++k) {
    const SidePlace at = on_side(s, side, static_cast<double>(k) / (kSideSamples - 1));
    points.push_back(evaluate(s, at.u, at.v).point);
  }
  return points;
}

/// Largest distance of corresponding points, and which way round it is smaller.
struct Meeting {
  double gap = 0.0;
  bool reversed = false;
};

double gap_between(const std::vector<Vec3>& a, const std::vector<Vec3>& b, bool reversed) {
  double gap = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    gap = std::max(gap, norm(a[i] - (reversed ? b[b.size() - 1 - i] : b[i])));
  }
  return gap;
}

Meeting meeting(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  const double same = gap_between(a, b, false), turned = gap_between(a, b, true);
  return turned < same ? Meeting{turned, true} : Meeting{same, false};
}

double polyline_length(const std::vector<Vec3>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += norm(points[i] - points[i - 1]);
  return length;
}

/// Normal curvature in a tangential direction; its sign with the normal.
double normal_curvature(const SurfaceCurvature& k, Vec3 direction) {
  const double c = dot(direction, k.direction1), s = dot(direction, cross(k.normal, k.direction1));
  return k.k1 * c * c + k.k2 * s * s;
}

void compare_across(const NurbsSurface& a, const NurbsSurface& b, bool reversed,
                    JointReport& joint) {
  double step = 0.0, largest = 0.0;
  for (int i = 0; i < kSideSamples; ++i) {
    const double t = static_cast<double>(i) / (kSideSamples - 1);
    const SidePlace pa = on_side(a, joint.side[0], t);
    const SidePlace pb = on_side(b, joint.side[1], reversed ? 1.0 - t : t);
    const SurfaceJet ja = evaluate(a, pa.u, pa.v);
    const SurfaceCurvature ka = curvature(ja), kb = curvature(evaluate(b, pb.u, pb.v));
    if (ka.normal == Vec3{} || kb.normal == Vec3{}) continue;
    const double sign = dot(ka.normal, kb.normal) < 0.0 ? -1.0 : 1.0;
    joint.angle = std::max(joint.angle, std::atan2(norm(cross(ka.normal, kb.normal)),
                                                   std::abs(dot(ka.normal, kb.normal))));
    // across the border: perpendicular to it in the tangent plane
    const Vec3 along = joint.side[0] < 2 ? ja.dv : ja.du;
    const Vec3 across = unit(cross(ka.normal, along));
    const double one = normal_curvature(ka, across), two = sign * normal_curvature(kb, across);
    step = std::max(step, std::abs(one - two));
    for (const double k : {ka.k1, ka.k2, kb.k1, kb.k2}) largest = std::max(largest, std::abs(k));
  }
  joint.curvature = largest > 0.0 ? step / largest : 0.0;
  joint.order = joint.angle > kSmoothAngle ? 0 : joint.curvature > kSmoothCurvature ? 1 : 2;
}

std::vector<JointReport> joints_of(const SurfaceModel& model, double nearness) {
  std::vector<std::array<std::vector<Vec3>, 4>> sides(model.patches.size());
  for (std::size_t k = 0; k < sides.size(); ++k) {
    for (int side = 0; side < 4; ++side) {
      sides[k][static_cast<std::size_t>(side)] = side_points(model.patches[k].surface, side);
    }
  }
  std::vector<JointReport> joints;
  for (std::size_t a = 0; a < 4 * sides.size(); ++a) {
    const std::vector<Vec3>& one = sides[a / 4][a % 4];
    if (polyline_length(one) <= nearness) continue;  // a pole is no border
    for (std::size_t b = a + 1; b < 4 * sides.size(); ++b) {
      const std::vector<Vec3>& two = sides[b / 4][b % 4];
      const double ends = std::min(norm(one.front() - two.front()), norm(one.front() - two.back()));
      if (ends > nearness) continue;
      const Meeting met = meeting(one, two);
      if (met.gap > nearness) continue;
      JointReport joint;
      joint.patch = {a / 4, b / 4};
      joint.side = {static_cast<int>(a % 4), static_cast<int>(b % 4)};
      joint.gap = met.gap;
      compare_across(model.patches[a / 4].surface, model.patches[b / 4].surface, met.reversed,
                     joint);
      joints.push_back(joint);
    }
  }
  return joints;
}

}  // namespace

CurvatureExtents curvature_extents(const NurbsSurface& surface, std::size_t samples) {
  return measured(surface, samples).curvature;
}

Result<SurfaceCheck> check_surface(const SurfaceModel& model, const CheckOptions& options,
                                   const RunContext& run) {
  SurfaceCheck result;
  result.size = size_of(model);
  for (const SurfacePatch& patch : model.patches) {
    const double part =
        static_cast<double>(result.patches.size()) / static_cast<double>(model.patches.size());
    OBVID_TRY(tell(run, "measuring", part));
    result.patches.push_back(report_of(patch, options.samples));
  }
  result.joints = joints_of(model, options.meeting * result.size);
  return result;
}

}  // namespace obvid
