// SPDX-License-Identifier: Apache-2.0
#include "borders.h"

#include <algorithm>

namespace obvid::mesh {
namespace {

/// Lines of a tree that end on a side, ascending.
std::vector<Line> lines_on(const CellTree& tree, PatchSide side, Line last_u, Line last_v) {
  std::vector<Line> lines;
  for (const Cell& c : tree.cells()) {
    const bool on = side == kVStart   ? c.v0 == 0
                    : side == kVEnd   ? c.v1 == last_v
                    : side == kUStart ? c.u0 == 0
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

Borders::Borders(const std::vector<PatchSampler>& patches, const Topology& topology)
    : patches_(patches), topology_(topology), nodes_(patches.size()) {}

const PatchAxis& Borders::axis(const EdgeUse& use) const {
  const PatchSampler& patch = patches_[use.patch];
  return runs_along_u(use.side) ? patch.u() : patch.v();
}

Vec3 Borders::point(const EdgeUse& use, double t) const {
  const PatchSampler& patch = patches_[use.patch];
  const PatchAxis& across = runs_along_u(use.side) ? patch.v() : patch.u();
  const Place along = axis(use).locate(t);
  const Place end =
      is_far_end(use.side) ? Place{across.spans() - 1, across.to()} : Place{0, across.from()};
  return (runs_along_u(use.side) ? patch.at(along, end) : patch.at(end, along)).point;
}

/// Where a line of a patch ends on its side, as a part of the range of the edge's curve.
double Borders::part_of_edge(const TopologyEdge& edge, const EdgeUse& use, Line line) const {
  const PatchAxis& own = axis(use);
  double part = line == own.last() ? 1.0 : 0.0;
  if (line != 0 && line != own.last()) {
    if (use.other_parameters) {
      const Range range = domain(edge.curve);
      return (nearest_parameter(edge.curve, point(use, own.at(line))) - range.from) /
             range.length();
    }
    part = (own.at(line) - own.from()) / (own.to() - own.from());
  }
  return use.along ? part : 1.0 - part;
}

double Borders::own_parameter(const TopologyEdge& edge, const EdgeUse& use, double part) const {
  const PatchAxis& own = axis(use);
  if (use.other_parameters && part > 0.0 && part < 1.0) {
    const Vec3 on_edge = point(edge.uses.front(), domain(edge.curve).at(part));
    return nearest_parameter(border_of(patches_[use.patch].surface(), use.side), on_edge);
  }
  return Range{own.from(), own.to()}.at(use.along ? part : 1.0 - part);
}

void Borders::update_edge(const TopologyEdge& edge, const std::vector<CellTree>& trees) {
  struct Mark {
    double part;  ///< of the edge's curve
    std::size_t member;
    double t;  ///< the member's own
  };
  std::vector<Mark> marks;
  for (std::size_t m = 0; m < edge.uses.size(); ++m) {
    const EdgeUse& use = edge.uses[m];
    const PatchSampler& patch = patches_[use.patch];
    for (const Line line :
         lines_on(trees[use.patch], use.side, patch.u().last(), patch.v().last())) {
      marks.push_back({part_of_edge(edge, use, line), m, axis(use).at(line)});
    }
    nodes_[use.patch][use.side].clear();
  }
  std::sort(marks.begin(), marks.end(),
            [](const Mark& a, const Mark& b) { return a.part < b.part; });

  const Range range = domain(edge.curve);
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
    Vec3 at = topology_.vertices[k == 0 ? edge.from : edge.to].point;
    if (k > 0 && end < marks.size() && !edge.point) {
      at = point(edge.uses.front(), range.at(marks[k].part));
    }
    for (std::size_t m = 0; m < edge.uses.size(); ++m) {
      double t = own_parameter(edge, edge.uses[m], marks[k].part);
      for (std::size_t i = k; i < end; ++i) {
        if (marks[i].member == m) t = marks[i].t;
      }
      nodes_[edge.uses[m].patch][edge.uses[m].side].push_back({t, at});
    }
    k = end;
  }
  for (const EdgeUse& use : edge.uses) {
    auto& nodes = nodes_[use.patch][use.side];
    if (!use.along) std::reverse(nodes.begin(), nodes.end());
    std::stable_sort(nodes.begin(), nodes.end(),  // feet may swap by rounding
                     [](const BorderNode& a, const BorderNode& b) { return a.t < b.t; });
  }
}

void Borders::update(const std::vector<CellTree>& trees, std::vector<bool>& changed) {
  const std::vector<bool> trees_changed = changed;
  for (const TopologyEdge& edge : topology_.edges) {
    const bool any = std::any_of(edge.uses.begin(), edge.uses.end(),
                                 [&](const EdgeUse& use) { return trees_changed[use.patch]; });
    if (!any) continue;
    for (const EdgeUse& use : edge.uses) changed[use.patch] = true;
    update_edge(edge, trees);
  }
}

}  // namespace obvid::mesh
