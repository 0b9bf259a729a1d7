// SPDX-License-Identifier: Apache-2.0
#include "check_joints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "obvid/curve/internal/basis.h"
#include "obvid/geom/internal/directions.h"
#include "obvid/numeric/internal/golden.h"

namespace obvid {
namespace {

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
        other_parameters_(a.other_parameters || b.other_parameters) {}

  /// Of both patches, at a part of the first one's border.
  [[nodiscard]] std::array<SurfaceJet, 2> at(double part) const {
    const double t = domain(borders_[0]).at(part);
    const double other = other_parameters_ && part > 0.0 && part < 1.0
                             ? nearest_parameter(borders_[1], evaluate(borders_[0], t).point)
                             : domain(borders_[1]).at(along_ ? part : 1.0 - part);
    const SidePlace a = place_on(first_, sides_[0], t), b = place_on(second_, sides_[1], other);
    return {evaluate(first_, a.u, a.v), evaluate(second_, b.u, b.v)};
  }

  /// Parts of the first border where a span of either begins or ends, 0 and 1 included.
  [[nodiscard]] std::vector<double> ends() const {
    constexpr std::size_t kMostParts = 256;  // spans: each place is looked for on all of them
    const auto parts_of = [](const SpaceCurve& border) {
      std::vector<double> parts = distinct(border.knots);
      const Range range = domain(border);
      for (double& t : parts) t = std::clamp((t - range.from) / range.length(), 0.0, 1.0);
      return parts;
    };
    std::vector<double> all = parts_of(borders_[0]);
    std::vector<double> other = parts_of(borders_[1]);
    if (other_parameters_ && all.size() + other.size() > kMostParts) {
      all.clear();
      for (std::size_t k = 0; k <= kMostParts; ++k) {
        all.push_back(static_cast<double>(k) / kMostParts);
      }
    } else {
      for (const double part : other) all.push_back(part_on_first(part));
    }
    std::sort(all.begin(), all.end());
    constexpr double kSame = 1e-9;  // parts nearer than this are one knot, found twice
    std::vector<double> out{0.0};
    for (const double part : all) {
      if (part > out.back() + kSame && part < 1.0 - kSame) out.push_back(part);
    }
    out.push_back(1.0);
    return out;
  }

 private:
  /// Where a part of the second border lies on the first.
  [[nodiscard]] double part_on_first(double part) const {
    if (!other_parameters_) return along_ ? part : 1.0 - part;
    const Range range = domain(borders_[0]);
    const Vec3 point = evaluate(borders_[1], domain(borders_[1]).at(part)).point;
    return (nearest_parameter(borders_[0], point) - range.from) / range.length();
  }

  const NurbsSurface& first_;
  const NurbsSurface& second_;
  std::array<PatchSide, 2> sides_;
  std::array<SpaceCurve, 2> borders_;
  bool along_, other_parameters_;
};

/// Normal curvature in a tangential direction; its sign with the normal.
double normal_curvature(const SurfaceCurvature& k, Vec3 direction) {
  const double c = dot(direction, k.direction1), s = dot(direction, cross(k.normal, k.direction1));
  return k.k1 * c * c + k.k2 * s * s;
}

/// What is measured at a place of a joint; not numbers where a patch has no tangent plane.
struct AtJoint {
  double gap = 0.0;
  double angle = std::nan(""), step = std::nan("");
  double largest = 0.0;  ///< of the curvatures beside it
  Vec3 point;
};

/// Of du x dv, on the side where it is less.
double lesser_area(const SurfaceJet& a, const SurfaceJet& b) {
  return std::min(norm(cross(a.du, a.dv)), norm(cross(b.du, b.dv)));
}

AtJoint at_joint(const EdgePair& pair, PatchSide side, double part, double least_area) {
  const auto [a, b] = pair.at(part);
  AtJoint out;
  out.gap = norm(a.point - b.point);
  out.point = a.point;
  if (lesser_area(a, b) < least_area) return out;
  const SurfaceCurvature ka = curvature(a), kb = curvature(b);
  if (ka.normal == Vec3{} || kb.normal == Vec3{}) return out;
  const double sign = dot(ka.normal, kb.normal) < 0.0 ? -1.0 : 1.0;
  out.angle = angle_between_lines(ka.normal, kb.normal);
  // across the border: perpendicular to it in the tangent plane
  const Vec3 along = runs_along_u(side) ? a.du : a.dv;
  const Vec3 across = unit(cross(ka.normal, along));
  out.step = std::abs(normal_curvature(ka, across) - sign * normal_curvature(kb, across));
  for (const double k : {ka.k1, ka.k2, kb.k1, kb.k2}) {
    out.largest = std::max(out.largest, std::abs(k));
  }
  return out;
}

/// The places at which a joint is looked at: rows of places in cells that end at the knots of
/// both sides.
std::vector<std::vector<double>> places_along(const EdgePair& pair) {
  constexpr double kInside = 1e-9;  // of a cell: behind the knot may be another curvature
  std::vector<std::vector<double>> cells;
  const std::vector<double> ends = pair.ends();
  const std::size_t spans = ends.size() - 1;
  // at least so many cells: extremes inside a long span are found too
  constexpr std::size_t kLeastCells = 16;
  const std::size_t parts = (kLeastCells + spans - 1) / spans;
  for (std::size_t k = 0; k < spans; ++k) {
    for (std::size_t i = 0; i < parts; ++i) {
      const Range span{ends[k], ends[k + 1]};
      const Range cell{span.at(static_cast<double>(i) / static_cast<double>(parts)),
                       span.at(static_cast<double>(i + 1) / static_cast<double>(parts))};
      // the ends of the border itself belong to it
      cells.push_back({cell.from > 0.0 ? cell.at(kInside) : 0.0, cell.at(1.0 / 3.0),
                       cell.at(2.0 / 3.0), cell.to < 1.0 ? cell.at(1.0 - kInside) : 1.0});
    }
  }
  return cells;
}

/// Where one of the figures is largest: climbed to from the best places.
class Largest {
 public:
  explicit Largest(double AtJoint::*figure) : figure_(figure) {}

  void look_at(const AtJoint& there, const Range& around) {
    const double value = there.*figure_;
    if (!(value >= 0.0)) return;
    if (value > best_ || !found_) best_ = value, at_ = there.point;
    found_ = true;
    starts_.emplace_back(value, around);
    std::sort(starts_.begin(), starts_.end(),
              [](const auto& x, const auto& y) { return x.first > y.first; });
    if (starts_.size() > kClimbs) starts_.pop_back();
  }
  template <class Measure>
  void climb(const Measure& measure) {
    for (const auto& [value, around] : starts_) {
      const auto figure_at = [&](double part) {
        const double there = measure(part).*figure_;
        return there >= 0.0 ? there : -1.0;
      };
      const AtJoint top = measure(highest_place(around.from, around.to, figure_at));
      if (top.*figure_ > best_) best_ = top.*figure_, at_ = top.point;
    }
  }
  [[nodiscard]] double value() const { return best_; }
  [[nodiscard]] Vec3 at() const { return at_; }

 private:
  static constexpr std::size_t kClimbs = 3;
  double AtJoint::*figure_;
  double best_ = 0.0;
  bool found_ = false;
  Vec3 at_;
  std::vector<std::pair<double, Range>> starts_;  ///< best first
};

Result<JointReport> joint_of(const SurfaceModel& model, const EdgeUse& one, const EdgeUse& two,
                             const RunContext& run) {
  constexpr std::size_t kCellsUnasked = 64;  // before whoever waits is asked whether to go on
  JointReport joint;
  joint.patch = {one.patch, two.patch};
  joint.side = {one.side, two.side};
  const EdgePair pair(model, one, two);
  const auto cells = places_along(pair);
  double least_area = 0.0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (c % kCellsUnasked == 0) OBVID_TRY(may_go_on(run));
    for (const double place : cells[c]) {
      const auto [a, b] = pair.at(place);
      least_area = std::max(least_area, kBesidePoint * lesser_area(a, b));
    }
  }
  const auto measure = [&](double part) { return at_joint(pair, one.side, part, least_area); };
  Largest gap(&AtJoint::gap), angle(&AtJoint::angle), step(&AtJoint::step);
  double largest = 0.0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (c % kCellsUnasked == 0) OBVID_TRY(may_go_on(run));
    const std::vector<double>& places = cells[c];
    for (std::size_t i = 0; i < places.size(); ++i) {
      const AtJoint there = measure(places[i]);
      const Range around{places[i > 0 ? i - 1 : 0], places[std::min(i + 1, places.size() - 1)]};
      for (Largest* figure : {&gap, &angle, &step}) figure->look_at(there, around);
      largest = std::max(largest, there.largest);
      ++joint.places;
    }
  }
  for (Largest* figure : {&gap, &angle, &step}) {
    OBVID_TRY(may_go_on(run));
    figure->climb(measure);
  }
  joint.gap = gap.value();
  joint.angle = angle.value();
  joint.curvature = largest > 0.0 ? step.value() / largest : 0.0;
  joint.gap_at = gap.at();
  joint.angle_at = angle.at();
  joint.curvature_at = step.at();
  joint.order = joint.angle > kSmoothAngle ? 0 : joint.curvature > kSmoothCurvature ? 1 : 2;
  return joint;
}

}  // namespace

Result<std::vector<JointReport>> joints_of(const SurfaceModel& model, const Topology& same,
                                           double nearness, const RunContext& run) {
  std::vector<JointReport> joints;
  const Topology near = topology_of(surfaces_of(model), nearness);
  for (const TopologyEdge& edge : near.edges) {
    for (std::size_t a = 0; a < edge.uses.size(); ++a) {
      for (std::size_t b = a + 1; b < edge.uses.size(); ++b) {
        OBVID_TRY(may_go_on(run));
        const EdgeUse &one = edge.uses[a], &two = edge.uses[b];
        auto joint = joint_of(model, one, two, run);
        OBVID_TRY(joint);
        joints.push_back(std::move(*joint));
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

}  // namespace obvid
