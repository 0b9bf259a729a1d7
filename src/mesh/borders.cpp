// SPDX-License-Identifier: Apache-2.0
#include "borders.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace obvid::mesh {
namespace {

/// Steps by which two curves with the same ends are compared.
constexpr int kCompared = 32;
/// Points of each span among which the foot of a perpendicular is looked for, and steps from there.
constexpr int kPerSpan = 4;
constexpr int kNewtonSteps = 20;

/// Corners are numbered 2 * (v at its end) + (u at its end).
std::array<std::size_t, 2> corners_of(std::size_t side) {
  switch (side) {
    case 0:
      return {0, 1};
    case 1:
      return {2, 3};
    case 2:
      return {0, 2};
    default:
      return {1, 3};
  }
}

/// Number of the first point within `same` for each point, found along a direction in which few
/// points of regular models coincide.
std::vector<std::size_t> first_of_same(const std::vector<Vec3>& points, double same) {
  const Vec3 way = unit(Vec3{1.0, 0.6180339887, 0.3819660113});
  std::vector<double> place(points.size());
  std::vector<std::size_t> order(points.size()), first(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) place[k] = dot(points[k], way);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::iota(first.begin(), first.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return place[a] != place[b] ? place[a] < place[b] : a < b;
  });
  for (std::size_t k = 0; k < order.size(); ++k) {
    for (std::size_t m = k; m-- > 0 && place[order[k]] - place[order[m]] <= same;) {
      if (norm(points[order[k]] - points[order[m]]) > same) continue;
      first[order[k]] = first[order[m]];
      break;
    }
  }
  return first;
}

/// Lines of a tree that end on a side, ascending.
std::vector<Line> lines_on(const CellTree& tree, std::size_t side, Line last_u, Line last_v) {
  std::vector<Line> lines;
  for (const Cell& c : tree.cells()) {
    const bool on = side == 0   ? c.v0 == 0
                    : side == 1 ? c.v1 == last_v
                    : side == 2 ? c.u0 == 0
                                : c.u1 == last_u;
    if (!on) continue;
    lines.push_back(runs_along_u(side) ? c.u0 : c.v0);
    lines.push_back(runs_along_u(side) ? c.u1 : c.v1);
  }
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

}  // namespace

Borders::Borders(const std::vector<PatchSampler>& patches, double same)
    : patches_(patches), same_(same), nodes_(patches.size() * kSides) {
  find_corners();
  find_groups();
}

const PatchAxis& Borders::axis(std::size_t side) const {
  const PatchSampler& patch = patches_[side / kSides];
  return runs_along_u(side % kSides) ? patch.u() : patch.v();
}

SurfacePoint Borders::at(std::size_t side, double t) const {
  const PatchSampler& patch = patches_[side / kSides];
  const PatchAxis& across = runs_along_u(side % kSides) ? patch.v() : patch.u();
  const Place along = axis(side).locate(t);
  const Place end =
      is_far_end(side % kSides) ? Place{across.spans() - 1, across.to()} : Place{0, across.from()};
  return runs_along_u(side % kSides) ? patch.at(along, end) : patch.at(end, along);
}

Vec3 Borders::point(std::size_t side, double t) const { return at(side, t).point; }

void Borders::find_corners() {
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      const PatchAxis& u = patches_[p].u();
      corners_.push_back(point(p * kSides + side, u.from()));
      corners_.push_back(point(p * kSides + side, u.to()));
    }
  }
  const std::vector<std::size_t> first = first_of_same(corners_, same_);
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    for (std::size_t side = 0; side < kSides; ++side) {
      const auto ends = corners_of(side);
      Curve curve;
      curve.end = {first[p * kSides + ends[0]], first[p * kSides + ends[1]]};
      curves_.push_back(curve);
    }
  }
}

bool Borders::is_collapsed(std::size_t side) const {
  if (curves_[side].end[0] != curves_[side].end[1]) return false;
  const PatchAxis& a = axis(side);
  const Vec3 corner = corners_[curves_[side].end[0]];
  for (std::size_t k = 0; k < a.spans(); ++k) {
    for (const double part : {0.25, 0.5, 0.75, 1.0}) {
      const double t = Range{a.end(k), a.end(k + 1)}.at(part);
      if (norm(point(side, t) - corner) > same_) return false;
    }
  }
  return true;
}

bool Borders::are_same(std::size_t a, std::size_t b, bool reversed) const {
  const Range ra{axis(a).from(), axis(a).to()}, rb{axis(b).from(), axis(b).to()};
  for (int k = 1; k < kCompared; ++k) {
    const double part = static_cast<double>(k) / kCompared;
    const Vec3 gap = point(a, ra.at(part)) - point(b, rb.at(reversed ? 1.0 - part : part));
    if (norm(gap) > same_) return false;
  }
  return true;
}

/// Parameter of the side's point nearest to a point: from the nearest of some points per span.
double Borders::foot(std::size_t side, Vec3 of) const {
  const PatchAxis& a = axis(side);
  double t = a.from(), least = norm(point(side, t) - of);
  for (std::size_t k = 0; k < a.spans(); ++k) {
    for (int i = 1; i <= kPerSpan; ++i) {
      const double next = Range{a.end(k), a.end(k + 1)}.at(static_cast<double>(i) / kPerSpan);
      const double far = norm(point(side, next) - of);
      if (far >= least) continue;
      least = far;
      t = next;
    }
  }
  for (int k = 0; k < kNewtonSteps; ++k) {
    const SurfacePoint here = at(side, t);
    const Vec3 slope = runs_along_u(side % kSides) ? here.du : here.dv;
    const double speed2 = dot(slope, slope);
    if (!(speed2 > 0.0)) break;
    const double next = std::clamp(t + dot(of - here.point, slope) / speed2, a.from(), a.to());
    const double far = norm(point(side, next) - of);
    if (far >= least) break;
    least = far;
    t = next;
  }
  return t;
}

/// The same curve, but parameters run differently: feet of perpendiculars both ways, in order.
bool Borders::follows(std::size_t a, std::size_t b, bool reversed) const {
  const Range ra{axis(a).from(), axis(a).to()}, rb{axis(b).from(), axis(b).to()};
  double before = reversed ? ra.to : ra.from;
  for (int k = 1; k < kCompared; ++k) {
    const double part = static_cast<double>(k) / kCompared;
    const Vec3 on_a = point(a, ra.at(part)), on_b = point(b, rb.at(part));
    if (norm(point(b, foot(b, on_a)) - on_a) > same_) return false;
    const double t = foot(a, on_b);
    if (norm(point(a, t) - on_b) > same_) return false;
    if (reversed ? t >= before : t <= before) return false;
    before = t;
  }
  return true;
}

/// Whether a side is the curve of a group's first; if so it is noted how.
bool Borders::joins(std::size_t side, std::size_t first) {
  Curve& curve = curves_[side];
  for (const bool own_pace : {false, true}) {
    for (const bool reversed : {false, true}) {
      if (curves_[first].end[reversed ? 1 : 0] != curve.end[0]) continue;
      if (!(own_pace ? follows(first, side, reversed) : are_same(first, side, reversed))) continue;
      curve.reversed = reversed;
      curve.own_pace = own_pace;
      curve.group = curves_[first].group;
      return true;
    }
  }
  return false;
}

void Borders::find_groups() {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> by_ends;
  for (std::size_t side = 0; side < curves_.size(); ++side) {
    Curve& curve = curves_[side];
    curve.collapsed = is_collapsed(side);
    curve.group = groups_.size();
    if (curve.collapsed) {
      groups_.push_back({side});
      continue;
    }
    auto& candidates = by_ends[std::minmax(curve.end[0], curve.end[1])];
    const bool found = std::any_of(candidates.begin(), candidates.end(),
                                   [&](std::size_t first) { return joins(side, first); });
    if (found) {
      groups_[curve.group].push_back(side);
    } else {
      candidates.push_back(side);
      groups_.push_back({side});
    }
  }
}

/// Where a line of a patch ends on its side, as a part of the range of the group's first.
double Borders::part_in_group(std::size_t side, Line line) const {
  const PatchAxis& own = axis(side);
  const Curve& curve = curves_[side];
  double part = line == own.last() ? 1.0 : 0.0;
  if (line != 0 && line != own.last()) {
    if (curve.own_pace) {
      const std::size_t first = groups_[curve.group].front();
      const PatchAxis& other = axis(first);
      return (foot(first, point(side, own.at(line))) - other.from()) / (other.to() - other.from());
    }
    part = (own.at(line) - own.from()) / (own.to() - own.from());
  }
  return curve.reversed ? 1.0 - part : part;
}

double Borders::own_parameter(std::size_t side, double part) const {
  const PatchAxis& own = axis(side);
  const Curve& curve = curves_[side];
  if (curve.own_pace && part > 0.0 && part < 1.0) {
    const std::size_t first = groups_[curve.group].front();
    const Range range{axis(first).from(), axis(first).to()};
    return foot(side, point(first, range.at(part)));
  }
  return Range{own.from(), own.to()}.at(curve.reversed ? 1.0 - part : part);
}

void Borders::update_group(const std::vector<std::size_t>& sides,
                           const std::vector<CellTree>& trees) {
  struct Mark {
    double part;  ///< of the first side's range
    std::size_t member;
    double t;  ///< the member's own
  };
  std::vector<Mark> marks;
  for (std::size_t m = 0; m < sides.size(); ++m) {
    const std::size_t side = sides[m];
    const PatchSampler& patch = patches_[side / kSides];
    for (const Line line :
         lines_on(trees[side / kSides], side % kSides, patch.u().last(), patch.v().last())) {
      marks.push_back({part_in_group(side, line), m, axis(side).at(line)});
    }
    nodes_[side].clear();
  }
  std::sort(marks.begin(), marks.end(),
            [](const Mark& a, const Mark& b) { return a.part < b.part; });

  const Curve& curve = curves_[sides[0]];
  const Range range{axis(sides[0]).from(), axis(sides[0]).to()};
  for (std::size_t k = 0; k < marks.size();) {
    std::size_t end = k + 1;
    const auto is_new = [&](const Mark& mark) {  // two lines of one patch stay two
      return std::none_of(marks.begin() + static_cast<std::ptrdiff_t>(k),
                          marks.begin() + static_cast<std::ptrdiff_t>(end),
                          [&](const Mark& other) { return other.member == mark.member; });
    };
    while (end < marks.size() && marks[end].part - marks[k].part <= kSameKnot &&
           is_new(marks[end])) {
      ++end;
    }
    Vec3 at = corners_[curve.end[k == 0 ? 0 : 1]];
    if (k > 0 && end < marks.size() && !curve.collapsed)
      at = point(sides[0], range.at(marks[k].part));
    for (std::size_t m = 0; m < sides.size(); ++m) {
      double t = own_parameter(sides[m], marks[k].part);
      for (std::size_t i = k; i < end; ++i) {
        if (marks[i].member == m) t = marks[i].t;
      }
      nodes_[sides[m]].push_back({t, at});
    }
    k = end;
  }
  for (const std::size_t side : sides) {
    if (curves_[side].reversed) std::reverse(nodes_[side].begin(), nodes_[side].end());
    std::stable_sort(nodes_[side].begin(), nodes_[side].end(),  // feet may swap by rounding
                     [](const BorderNode& a, const BorderNode& b) { return a.t < b.t; });
  }
}

void Borders::update(const std::vector<CellTree>& trees, std::vector<bool>& changed) {
  const std::vector<bool> trees_changed = changed;
  for (const auto& group : groups_) {
    const bool any = std::any_of(group.begin(), group.end(),
                                 [&](std::size_t side) { return trees_changed[side / kSides]; });
    if (!any) continue;
    for (const std::size_t side : group) changed[side / kSides] = true;
    update_group(group, trees);
  }
}

}  // namespace obvid::mesh
