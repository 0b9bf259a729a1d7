// SPDX-License-Identifier: Apache-2.0
#include "simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "obvid/core/internal/parallel.h"
#include "obvid/core/internal/questions.h"

namespace obvid::toolpath {
namespace {

constexpr double kNotThere = std::numeric_limits<double>::infinity();
constexpr double kFarthest = 4.0;  // radii: rays are not followed any farther
constexpr double kAbout = 1.5;     // as far as in the cell before: most likely enough
constexpr double kRising = 1e-3;   // z of a normal
constexpr double kGrazing = 1e-3;  // cosine of rays that hardly come nearer
/// Round bodies bend by this much more than the corner where a place is lifted a little.
constexpr double kMoreBent = 1.1;
/// Planes that a sweep lies above: no width of the cell counts across its normal, none of a level
/// bottom across the axis, nothing of the way to the sweep across the gradient. Shares on the way
/// from the first.
struct Lean {
  double to_axis = 0.0, to_gradient = 0.0;
};
constexpr std::array<Lean, 5> kLeans = {
    {{0.0, 0.0}, {1.0, 0.0}, {0.5, 0.0}, {0.0, 0.2}, {0.0, 0.5}}};
constexpr double kOpposed = 1e-6;       // size of a mean of opposite directions: it is none
constexpr std::size_t kMostPlanes = 8;  // of entries, compared with each other
/// Pieces that are quartered in a cell, to find a place above a limit, by round and by sharp
/// corners: few round ones take more than some tens. What they do not tell the report does.
constexpr std::size_t kQuarteredRound = 64, kQuarteredSharp = 5;

/// Heights of sharp corners over a cell whose normal rises.
bool in_closed_form(const CutterShape& cutter, const Cell& cell) {
  return cutter.corner <= 0.0 && cell.normal.z > kRising;
}

/// The body is convex: it lies where its distance grows by the gradient, at least.
double deepest_by_gradient(const Cell& cell, const SweepDistance& d) {
  const double out = dot(d.gradient, cell.normal);
  return -d.value + std::abs(out) * cell.rise + norm(d.gradient - out * cell.normal) * cell.reach;
}

/// All of a sweep lies above the plane across `up`, upwards or level, that touches it at one of its
/// ends.
double deepest_by_plane(const CutterShape& cutter, const Cell& cell, const Sweep& sweep, Vec3 up) {
  const double lean = std::sqrt(up.x * up.x + up.y * up.y);
  const double under_tip = cutter.corner * (1.0 - up.z) + cutter.flat() * lean;
  const double plane = std::min(dot(up, sweep.from), dot(up, sweep.to)) - under_tip;
  const double out = dot(up, cell.normal);
  return dot(up, cell.point) - plane + std::abs(out) * cell.rise +
         norm(up - out * cell.normal) * cell.reach;
}

/// The least of bounds by planes; those behind one that is no more than `enough` are left out.
double deepest(const CutterShape& cutter, const Cell& cell, const Sweep& sweep,
               const SweepDistance& d, double enough) {
  const Vec3 n = cell.normal, axis{0.0, 0.0, 1.0};
  double least = deepest_by_gradient(cell, d);
  if (n.z < 0.0) return least;
  for (const Lean& lean : kLeans) {
    if (least <= enough) break;
    const Vec3 up = n + lean.to_axis * (axis - n) - lean.to_gradient * (d.gradient + n);
    const double size = norm(up);
    if (size < kOpposed) continue;
    least = std::min(least, deepest_by_plane(cutter, cell, sweep, up / size));
  }
  return least;
}

}  // namespace

Simulation::Simulation(const Part& part, const SurfaceCells& cells, LargeList<Nearest>& reach,
                       std::size_t threads, double sway)
    : part_(part),
      cells_(cells),
      threads_(threads),
      sway_(sway),
      of_tile_(cells.tiles().size()),
      tile_of_(cells.cells().size()),
      nodes_(large_list<CellBounds>(cells.cells().size(),
                                    {kNotThere, kNotThere, -kNotThere, -kNotThere}, threads)),
      searched_(large_list(cells.cells().size(), kNotThere, threads)),
      nearest_(reach) {
  for (std::size_t t = 0; t < cells.tiles().size(); ++t) {
    const SurfaceCells::Tile& tile = cells.tiles()[t];
    std::fill_n(tile_of_.begin() + tile.first, tile.count, static_cast<std::uint32_t>(t));
  }
}

// The body is convex: beside the entry its surface falls away by the gradient and, where it is
// round, by the bend of its corner. Where one falls and another one rises, no place lies higher
// than a mean of both that is level. Derivation: docs/methods/toolpath.md.
void Simulation::bound_by_bend(const Cell& cell, const SweepEntry& entry, double& most,
                               std::vector<EntryPlane>& planes) const {
  const CutterShape& cutter = part_.cutter();
  const double towards = -dot(entry.gradient, cell.normal);
  if (!(cutter.corner > 0.0 && towards > kGrazing)) return;
  const double beside = cell.reach + entry.height * cell.turn;
  const double bend = kMoreBent * 0.5 * beside * beside / cutter.corner;
  const EntryPlane own{entry.height + bend / towards + cell.rise, entry.height,
                       (1.0 / towards) * (entry.gradient + towards * cell.normal)};
  most = std::min(most, own.top + norm(own.lean) * beside);
  for (const EntryPlane& other : planes) {
    const Vec3 apart = own.lean - other.lean;
    const double apart2 = dot(apart, apart);
    if (!(apart2 > 0.0)) continue;
    const double part = std::clamp(-dot(other.lean, apart) / apart2, 0.0, 1.0), rest = 1.0 - part;
    const double level = norm(part * own.lean + rest * other.lean) * cell.reach;
    // normals beside the middle differ: entries at other heights lie elsewhere on them
    const double turned =
        norm(part * own.height * own.lean + rest * other.height * other.lean) * cell.turn;
    most = std::min(most, part * own.top + rest * other.top + level + turned);
  }
  if (own.top < most && planes.size() < kMostPlanes) planes.push_back(own);
}

/// What a narrower, higher cutter reaches from here, the whole one reaches from all of the cell.
double Simulation::bound_by_bottom(const Cell& cell, const Sweep& sweep, double height,
                                   double most) const {
  const CutterShape& cutter = part_.cutter();
  const double beside = cell.reach + height * cell.turn;
  const double in = beside + cell.rise;
  if (cutter.flat() <= in) return most;
  const double farthest = std::min(most, kFarthest * cutter.radius);
  const double lean = std::sqrt(cell.normal.x * cell.normal.x + cell.normal.y * cell.normal.y);
  const CutterShape narrow{cutter.radius - in, cutter.corner};
  const Vec3 up{0.0, 0.0, lean * beside + cell.rise};
  const Sweep higher{sweep.from + up, sweep.to + up};
  return std::min(most, in_closed_form(cutter, cell)
                            ? height_into_sharp(narrow, higher, cell.point, cell.normal, farthest)
                            : entry_into(narrow, higher, cell.point, cell.normal, farthest).height);
}

void Simulation::look(const Looking& what, const Cell& cell, const Sweep& sweep, CellBounds& b,
                      std::vector<EntryPlane>& planes) const {
  const CutterShape& cutter = part_.cutter();
  if (!what.for_depth && in_closed_form(cutter, cell)) {
    const double most = std::min(b.left_most, kFarthest * cutter.radius);
    const double height = height_into_sharp(cutter, sweep, cell.point, cell.normal, most);
    b.left = std::min(b.left, height);
    if (height < kNotThere) b.left_most = bound_by_bottom(cell, sweep, height, b.left_most);
    return;
  }
  const SweepDistance d = distance_from(cutter, sweep, cell.point);
  if (what.for_depth) {
    b.depth = std::max(b.depth, -d.value);
    b.depth_most = std::max(b.depth_most, deepest(cutter, cell, sweep, d, b.depth_most));
  }
  if (!what.for_left || d.value >= b.left_most) return;
  const double most = std::min(b.left_most, kFarthest * cutter.radius);
  const SweepEntry entry = d.value <= 0.0
                               ? SweepEntry{0.0, d.gradient}
                               : entry_into(cutter, sweep, cell.point, cell.normal, most);
  if (!(entry.height < kNotThere)) return;
  b.left = std::min(b.left, entry.height);
  bound_by_bend(cell, entry, b.left_most, planes);
  b.left_most = bound_by_bottom(cell, sweep, entry.height, b.left_most);
}

double Simulation::radius_of(const Looking& what, const Cell& cell,
                             const CellBounds& bounds) const {
  const double wide = cell.reach + cell.rise + 2.0 * sway_;
  if (!what.for_left) return wide;
  const double most = kFarthest * part_.cutter().radius;
  return std::clamp(bounds.left_most, 0.0, most) + wide;
}

void Simulation::look(const Looking& what, const Cell& cell, std::span<const std::uint32_t> sweeps,
                      double enough, CellBounds& b, std::vector<Candidate>& candidates) const {
  candidates.clear();
  for (const std::uint32_t s : sweeps) {
    const double least = distance_at_least(part_.cutter(), sweeps_[s], cell.point, enough);
    if (least <= enough) candidates.push_back({least, s});
  }
  if (candidates.empty()) return;
  const auto nearest =
      std::min_element(candidates.begin(), candidates.end(),
                       [](const Candidate& x, const Candidate& y) { return x.least < y.least; });
  std::swap(*nearest, candidates.front());
  std::vector<EntryPlane> planes;
  for (const Candidate& c : candidates) {
    const double left_matters = what.for_left ? b.left_most : 0.0;
    const double depth_matters = what.for_depth ? cell.reach + cell.rise : 0.0;
    if (c.least > std::max(left_matters, depth_matters)) continue;
    look(what, cell, sweeps_[c.sweep], b, planes);
    if (what.settled(b)) return;
  }
}

CellBounds Simulation::bounds(const Looking& what, const Cell& cell,
                              std::span<const std::uint32_t> sweeps, double about, double most,
                              Numbers& near) const {
  std::vector<Candidate> candidates;
  Cell wide = cell;  // that the cutter sways is as if the cell's points did
  wide.reach += sway_;
  wide.rise += sway_;
  for (double enough = about;; enough = most) {
    CellBounds out{kNotThere, kNotThere, -kNotThere, -kNotThere};
    look(what, wide, sweeps, enough, out, candidates);
    const double matters = radius_of(what, cell, out);
    if (matters > enough && enough < most) continue;  // what was passed over matters
    near.clear();
    for (const Candidate& c : candidates) {
      if (c.least <= matters) near.push_back(c.sweep);
    }
    return out;
  }
}

Result<void> Simulation::cut(const std::vector<Sweep>& sweeps, const RunContext& run) {
  const std::size_t first = sweeps_.size();
  sweeps_.insert(sweeps_.end(), sweeps.begin(), sweeps.end());
  std::vector<std::size_t> had(of_tile_.size());
  std::vector<std::size_t> touched;
  for (std::size_t t = 0; t < had.size(); ++t) had[t] = of_tile_[t].size();
  for (std::size_t s = first; s < sweeps_.size(); ++s) {
    const Sweep& w = sweeps_[s];
    cells_.tiles_near({std::min(w.from.x, w.to.x), std::min(w.from.y, w.to.y)},
                      {std::max(w.from.x, w.to.x), std::max(w.from.y, w.to.y)},
                      part_.cutter().radius + cells_.spacing(), [&](std::size_t t) {
                        if (of_tile_[t].size() == had[t]) touched.push_back(t);
                        of_tile_[t].push_back(static_cast<std::uint32_t>(s));
                      });
  }
  return in_parallel(
      touched.size(), with_threads(run, threads_), [&](std::size_t k, const RunContext& own) {
        Watch watch(own);
        Questions questions(&watch, kCellsBetweenQuestions);
        const SurfaceCells::Tile& tile = cells_.tiles()[touched[k]];
        const auto fresh =
            std::span<const std::uint32_t>(of_tile_[touched[k]]).subspan(had[touched[k]]);
        Numbers near;
        double about = kAbout * part_.cutter().radius;
        for (std::size_t i = tile.first; i < tile.first + tile.count && !questions.end(); ++i) {
          const Cell& cell = cells_.cells()[i];
          if (!cell.there) continue;
          const double most = radius_of(kForBoth, cell, nodes_[i]);
          const CellBounds b = bounds(kForBoth, cell, fresh, std::min(about, most), most, near);
          about = kAbout * radius_of(kForBoth, cell, b);  // the next one is much alike
          nodes_[i] = {std::min(nodes_[i].left, b.left), std::min(nodes_[i].left_most, b.left_most),
                       std::max(nodes_[i].depth, b.depth),
                       std::max(nodes_[i].depth_most, b.depth_most)};
        }
      });
}

const Nearest& Simulation::nearest(std::size_t node) {
  Nearest& known = nearest_[node];
  const Cell& cell = cells_.cells()[node];
  if (known.reach == Reach::kUnknown) known = nearest_to(part_, cell.point, cell.normal);
  return known;
}

Result<void> Simulation::look_into_reach(double limit, const RunContext& run) {
  const auto look_into = [&](std::size_t t, const RunContext& own) {
    Watch watch(own);
    Questions questions(&watch, kCellsBetweenQuestions);
    const SurfaceCells::Tile& tile = cells_.tiles()[t];
    for (std::size_t i = tile.first; i < tile.first + tile.count && !questions.end(); ++i) {
      if (nodes_[i].left > limit && counts(i)) static_cast<void>(nearest(i));
    }
  };
  return in_parallel(cells_.tiles().size(), with_threads(run, threads_), look_into);
}

bool Simulation::at_edge(std::size_t node, double limit) const {
  if (nearest_[node].reach != Reach::kHeld) return false;
  bool out = false;
  cells_.neighbours(node, [&](std::size_t k) {
    out = out || nodes_[k].left <= limit || nearest_[k].reach == Reach::kReached;
  });
  return out;
}

Nearest Simulation::nearest(std::size_t node, const Piece& piece) {
  const Nearest& whole = nearest(node);
  const Vec3 way = piece.cell.point - cells_.cells()[node].point;
  const Vec2 first = whole.axis + Vec2{way.x, way.y};
  return nearest_to(part_, piece.cell.point, piece.cell.normal, first);
}

HighSpot Simulation::spot_at(std::size_t node, const Piece& piece, Vec2 axis) const {
  const Cell& cell = piece.cell;
  return {node,       piece.bounds.left, piece.place,
          cell.point, cell.normal,       part_.cutter().tip(cell.point, cell.normal),
          axis};
}

// The highest place of a cell that the cutter reaches.
bool Simulation::find_above(std::size_t node, double limit, double within, HighSpot& spot) {
  const CellBounds& b = nodes_[node];
  const Cell& cell = cells_.cells()[node];
  if (!(b.left_most > limit + within) || !counts(node) || searched_[node] <= limit) return false;
  if (b.left > limit) {
    const Nearest& near = nearest(node);
    if (near.reach == Reach::kReached) {
      spot = spot_at(node, {cells_.place(node), cell, b}, near.axis);
      return true;
    }
    if (!at_edge(node, limit)) return false;
  }
  return find_inside(node, limit, within, spot);
}

bool Simulation::find_inside(std::size_t node, double limit, double within, HighSpot& spot) {
  double most = 0.0;
  const std::size_t all = part_.cutter().corner > 0.0 ? kQuarteredRound : kQuarteredSharp;
  std::size_t quartered = 1;
  spot.height = 0.0;
  quarter(for_left(limit, within), node, [&](const Piece& part, int levels) {
    const double left = part.bounds.left;
    bool held = false;
    if (left > std::max(limit, spot.height)) {
      const Nearest near = nearest(node, part);
      held = near.reach != Reach::kReached;
      if (!held) spot = spot_at(node, part, near.axis);
    }
    const int least = held ? kMostLevels - kEdgeLevels : 0;
    if (spot.height > 0.0) return false;  // one is enough
    const bool deeper = part.bounds.left_most > limit + within;
    const bool ends = quartered >= all || levels <= least;
    if ((!deeper || ends) && !held) most = std::max(most, part.bounds.left_most);
    if (deeper && !ends) ++quartered;
    return deeper && !ends;
  });
  if (spot.height > 0.0) return true;
  nodes_[node].left_most = std::min(nodes_[node].left_most, most);  // for the next round
  searched_[node] = limit;
  return false;
}

Result<std::vector<HighSpot>> Simulation::above(double limit, double within,
                                                const RunContext& run) {
  OBVID_TRY(look_into_reach(limit, run));
  std::vector<std::vector<HighSpot>> found(cells_.tiles().size());
  const auto looked = in_parallel(found.size(), with_threads(run, threads_), [&](std::size_t t) {
    const SurfaceCells::Tile& tile = cells_.tiles()[t];
    for (std::size_t i = tile.first; i < tile.first + tile.count; ++i) {
      HighSpot spot;
      if (find_above(i, limit, within, spot)) found[t].push_back(spot);
    }
  });
  OBVID_TRY(looked);
  std::size_t count = 0;
  for (const auto& spots : found) count += spots.size();
  std::vector<HighSpot> out;
  out.reserve(count);
  for (const auto& spots : found) out.insert(out.end(), spots.begin(), spots.end());
  return out;
}

}  // namespace obvid::toolpath
