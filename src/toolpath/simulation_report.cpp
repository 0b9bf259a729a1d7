// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "deepest.h"
#include "obvid/core/internal/parallel.h"
#include "simulation.h"

namespace obvid::toolpath {
namespace {

constexpr std::size_t kCellsTogether = 2048;  // cells looked into before bounds are compared again
// Pieces of cells that are looked at for what stays, in all: some 20 a cell do on domes, 50 on
// cones with walls of 79 degrees. Upright walls ask for thousands; then the bound stays above what
// was found.
constexpr std::size_t kPiecesOfCell = 16, kPiecesBesides = 200'000;
/// Where cutters only graze borders no quartering leads to a bound: a few cells show whether it is
/// so, and for the others it is enough to look for what is highest.
constexpr std::size_t kCellsFirst = 64;
constexpr std::size_t kMostPieces = 512;  // of one cell

void raise_extreme(Extreme& extreme, double found, Vec3 place) {
  if (!(found > extreme.found)) return;
  extreme.found = found;
  extreme.place = place;
}

/// Way along a cell's normal out of a box; not above 0: it begins outside.
double out_of_box(const std::array<Vec3, 2>& box, const Cell& cell) {
  double way = std::numeric_limits<double>::infinity();
  const auto leave = [&](double at, double along, double low, double high) {
    if (along != 0.0) way = std::min(way, ((along > 0.0 ? high : low) - at) / along);
    if (at < low || at > high) way = std::min(way, 0.0);
  };
  leave(cell.point.x, cell.normal.x, box[0].x, box[1].x);
  leave(cell.point.y, cell.normal.y, box[0].y, box[1].y);
  leave(cell.point.z, cell.normal.z, box[0].z, box[1].z);
  return way;
}

/// A short line on the surface in the middle of a cell.
std::array<Vec3, 2> stroke_on(const Cell& cell) {
  constexpr double kLong = 0.35;  // of the cell, to both sides
  const Vec3 n = cell.normal;
  const Vec3 along = unit(std::abs(n.x) < 0.5 ? cross(n, Vec3{1, 0, 0}) : cross(n, Vec3{0, 1, 0}));
  const Vec3 half = kLong * cell.reach * along;
  return {cell.point - half, cell.point + half};
}

/// Strokes that stand for many, evenly: every second one goes when there are too many.
class Strokes {
 public:
  void add(const Cell& cell) {
    constexpr std::size_t kMostStrokes = 2'000;
    if (count_++ % every_ != 0) return;
    list_.push_back(stroke_on(cell));
    if (list_.size() < kMostStrokes) return;
    for (std::size_t k = 0; 2 * k < list_.size(); ++k) list_[k] = list_[2 * k];
    list_.resize((list_.size() + 1) / 2);
    every_ *= 2;
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::vector<std::array<Vec3, 2>> taken() { return std::move(list_); }

 private:
  std::vector<std::array<Vec3, 2>> list_;
  std::size_t count_ = 0, every_ = 1;
};

}  // namespace

Result<void> Simulation::report_depth(double allowed, SimulationReport& out,
                                      const RunContext& run) const {
  std::vector<std::size_t> deep;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    raise_extreme(out.depth, nodes_[i].depth, cells_.cells()[i].point);
  }
  const double limit = std::max(allowed, out.depth.found);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].depth_most > limit) {
      deep.push_back(i);
    } else {
      out.depth.most = std::max(out.depth.most, nodes_[i].depth_most);
    }
  }
  std::vector<Extreme> found(deep.size());
  const auto looked = in_parallel(deep.size(), with_threads(run, threads_), [&](std::size_t k) {
    quarter(kForDepth, deep[k], [&](const Piece& part, int levels) {
      raise_extreme(found[k], part.bounds.depth, part.cell.point);
      const bool deeper = part.bounds.depth_most > std::max(limit, found[k].found);
      if (!deeper || levels == 0) found[k].most = std::max(found[k].most, part.bounds.depth_most);
      return deeper;
    });
  });
  OBVID_TRY(looked);
  for (const Extreme& e : found) {
    raise_extreme(out.depth, e.found, e.place);
    out.depth.most = std::max({out.depth.most, e.most, e.found});
  }
  out.depth.most = std::max(out.depth.most, out.depth.found);
  return {};
}

Result<void> Simulation::report_reach(SimulationReport& out, const RunContext& run) {
  OBVID_TRY(look_into_reach(part_.tolerance(), run));
  Strokes hidden, held_at;
  std::vector<HeldCell> held;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Cell& cell = cells_.cells()[i];
    out.area += cell.area;
    out.places += cell.there ? 1 : 0;
    if (!(nodes_[i].left > part_.tolerance()) || !counts(i)) continue;
    const Nearest& near = nearest_[i];
    if (near.reach == Reach::kHidden) {
      if (hidden.count() == 0 || cell.point.z < out.hidden_place.z) out.hidden_place = cell.point;
      hidden.add(cell);
      out.hidden_area += cell.area;
    }
    if (near.reach != Reach::kHeld) continue;
    held_at.add(cell);
    out.held_area += cell.area;
    held.push_back({i, near, std::isfinite(nodes_[i].depth) ? -nodes_[i].depth : 0.0});
  }
  const auto deepest = deepest_of(part_, cells_, std::move(held), threads_, run);
  OBVID_TRY(deepest);
  if (deepest->height() > 0.0) {
    out.held = deepest->height();
    out.held_place = cells_.cells()[deepest->cell].point;
  }
  out.hidden = hidden.count();
  out.held_places = held_at.count();
  out.hidden_strokes = hidden.taken();
  out.held_strokes = held_at.taken();
  return {};
}

// In order of what cells can hide at most, some at a time: what they show counts for the next.
Result<void> Simulation::report_left(double within, SimulationReport& out, const RunContext& run) {
  std::vector<std::size_t> high;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Cell& cell = cells_.cells()[i];
    if (!counts(i)) continue;
    const bool touched =
        nodes_[i].left <= part_.tolerance() || nearest_[i].reach == Reach::kReached;
    if (cell.normal.z > flat_from_) {
      if (!touched) continue;
      raise_extreme(out.flat_left, nodes_[i].left, cell.point);
      if (nodes_[i].left > flat_limit_) out.flat_area += cell.area;
      continue;
    }
    if (touched) raise_extreme(out.left, nodes_[i].left, cell.point);
    if (touched || at_edge(i, part_.tolerance())) high.push_back(i);
  }
  // the others can show nothing more: what is highest of all is known from them
  const std::size_t all = high.size();
  const double shown = out.left.found + within;
  double most_of_others = 0.0;
  std::erase_if(high, [&](std::size_t i) {
    const bool hides = nodes_[i].left_most > shown;
    if (!hides) most_of_others = std::max(most_of_others, nodes_[i].left_most);
    return !hides;
  });
  std::sort(high.begin(), high.end(), [&](std::size_t a, std::size_t b) {
    return nodes_[a].left_most != nodes_[b].left_most ? nodes_[a].left_most > nodes_[b].left_most
                                                      : a < b;
  });
  std::size_t begin = 0, together = kCellsFirst;
  std::size_t pieces_left = kPiecesOfCell * all + kPiecesBesides;
  while (begin < high.size() && pieces_left > 0) {
    const double limit = out.left.found;
    if (nodes_[high[begin]].left_most <= limit + within) break;
    const std::size_t count = std::min(together, high.size() - begin);
    const bool bounded = std::isfinite(out.left.most);
    const std::size_t most_pieces = bounded ? kMostPieces : kPiecesOfCell;
    std::vector<Extreme> found(count, {limit, 0.0, {}});
    std::vector<std::size_t> pieces(count, 0);
    const auto looked = in_parallel(count, with_threads(run, threads_), [&](std::size_t k) {
      const std::size_t node = high[begin + k];
      quarter(for_left(limit, within), node, [&](const Piece& part, int levels) {
        ++pieces[k];
        const bool deeper = part.bounds.left_most > found[k].found + within;
        const bool spent = pieces[k] >= most_pieces;
        if (part.bounds.left > found[k].found && !spent) {
          const bool held = nearest(node, part).reach != Reach::kReached;
          if (held) return deeper && levels > kMostLevels - kEdgeLevels;
          raise_extreme(found[k], part.bounds.left, part.cell.point);
        }
        if (!deeper || spent || levels == 0) {
          found[k].most = std::max(found[k].most, part.bounds.left_most);
        }
        return deeper && !spent;
      });
    });
    OBVID_TRY(looked);
    pieces_left -=
        std::min(pieces_left, std::accumulate(pieces.begin(), pieces.end(), std::size_t{0}));
    for (const Extreme& e : found) {
      raise_extreme(out.left, e.found, e.place);
      out.left.most = std::max(out.left.most, e.most);
    }
    const double share = static_cast<double>(begin) / static_cast<double>(high.size());
    OBVID_TRY(tell(run, "checking", share));
    begin += count;
    together = kCellsTogether;
  }
  if (begin < high.size()) out.left.most = std::max(out.left.most, nodes_[high[begin]].left_most);
  out.left.most = std::max(out.left.most, most_of_others);
  out.left.most = std::max(out.left.most, out.left.found);
  return {};
}

Result<SimulationReport> Simulation::report(double allowed, double within, const RunContext& run) {
  SimulationReport out;
  OBVID_TRY(report_depth(allowed, out, run));
  OBVID_TRY(report_reach(out, run));
  OBVID_TRY(may_go_on(run));
  OBVID_TRY(report_left(within, out, run));
  return out;
}

Result<SimulationReport> Simulation::rough_report(double allowed, const std::array<Vec3, 2>& stock,
                                                  const RunContext& run) {
  SimulationReport out;
  OBVID_TRY(report_depth(allowed, out, run));
  for (const Cell& cell : cells_.cells()) out.area += cell.area;
  std::vector<Extreme> found((nodes_.size() + kCellsTogether - 1) / kCellsTogether);
  OBVID_TRY(in_parallel(found.size(), with_threads(run, threads_), [&](std::size_t k) {
    const std::size_t end = std::min(nodes_.size(), (k + 1) * kCellsTogether);
    for (std::size_t i = k * kCellsTogether; i < end; ++i) {
      const Cell& cell = cells_.cells()[i];
      if (cell.normal == Vec3{}) continue;
      const double left = std::min(nodes_[i].left, out_of_box(stock, cell));
      if (left > found[k].found && !hidden(part_, cell.point, cell.normal)) {
        raise_extreme(found[k], left, cell.point);
      }
    }
  }));
  for (const Extreme& e : found) raise_extreme(out.left, e.found, e.place);
  constexpr double kNotLookedFor = std::numeric_limits<double>::quiet_NaN();
  out.hidden_area = out.held_area = out.held = kNotLookedFor;
  out.left.most = std::numeric_limits<double>::infinity();
  return out;
}

}  // namespace obvid::toolpath
