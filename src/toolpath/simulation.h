// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "leftover.h"
#include "reach.h"
#include "surface_cells.h"
#include "sweep.h"

namespace obvid::toolpath {

/// What sweeps leave over a place, along its normal, and how deep they cut into it.
struct CellBounds {
  double left = 0.0, left_most = 0.0;    ///< over its middle; anywhere in it at most
  double depth = 0.0, depth_most = 0.0;  ///< likewise; below 0: distance from the nearest sweep
};

/// A place of the part over which too much stays.
struct HighSpot {
  std::size_t cell = 0;
  double height = 0.0;  ///< along the normal
  CellPlace place;
  Vec3 point;
  Vec3 normal;
  Vec3 tip;   ///< of a cutter that touches it
  Vec2 axis;  ///< where the cutter would come nearest to it
};

struct Extreme {
  double found = 0.0;  ///< at a place that was looked at
  double most = 0.0;   ///< anywhere, by the bounds of the cells
  Vec3 place;
};

struct SimulationReport {
  Extreme left;            ///< where the cutter can touch the part
  Extreme flat_left;       ///< likewise, where levels are not meant for: over the middles of cells
  double flat_area = 0.0;  ///< cells of these with more than the limit over their middle
  Extreme depth;           ///< of gouges
  double held = 0.0;       ///< where it cannot: distance of the cutter from the part
  Vec3 held_place;
  double hidden_area = 0.0, held_area = 0.0, area = 0.0;
  std::size_t hidden = 0, held_places = 0, places = 0;            ///< cells
  Vec3 hidden_place;                                              ///< the lowest one
  std::vector<std::array<Vec3, 2>> hidden_strokes, held_strokes;  ///< on some of them, for pictures
};

/// What bounds of a cell are for. Nothing has to be looked into any closer once no more than `left`
/// stays over its middle and no more than `left_most` anywhere in it.
struct Looking {
  bool for_left = true, for_depth = true;
  double left = -1.0, left_most = -1.0;
  [[nodiscard]] bool settled(const CellBounds& b) const {
    return !for_depth && b.left <= left && b.left_most <= left_most;
  }
};
inline constexpr Looking kForBoth{};
inline constexpr Looking kForDepth{false, true, -1.0, -1.0};
/// What stays, as far as it is more than a limit.
[[nodiscard]] inline Looking for_left(double limit, double within) {
  return {true, false, limit, limit + within};
}

/// Takes a cutter's body along straight ways out of the stock over a part's surface. Places of the
/// surface are looked at as exact points of the patches with their normals, walls as well as level
/// places; where the bounds of a cell do not decide, the cell is quartered.
class Simulation {
 public:
  /// `reach` is known to all simulations of a part: as many as cells, filled as it is asked for.
  /// `sway`: how far each place of the cutter may lie from the sweeps; all bounds hold for that.
  Simulation(const Part& part, const SurfaceCells& cells, LargeList<Nearest>& reach,
             std::size_t threads, double sway = 0.0);

  /// Places whose normal's z is larger are judged apart; more than `limit` there is counted.
  void judge_flat_apart(double flat_from, double limit) {
    flat_from_ = flat_from;
    flat_limit_ = limit;
  }
  /// What stays counts only where an earlier cutter left something; null: everywhere.
  void judge_only(const Leftover* left) { left_ = left; }
  [[nodiscard]] Result<void> cut(const std::vector<Sweep>& sweeps, const RunContext& run);
  /// Where more than `limit` stays though the cutter can touch the part: one place of each cell at
  /// most. Heights within `within` above the limit can stay unseen.
  [[nodiscard]] Result<std::vector<HighSpot>> above(double limit, double within,
                                                    const RunContext& run);
  /// `allowed`: depth that need not be looked into any closer; `within`: how near bounds come to
  /// what was found, where quartering has not to go too far for it.
  [[nodiscard]] Result<SimulationReport> report(double allowed, double within,
                                                const RunContext& run);
  /// Depth of gouges as above; of what stays of a box of stock the most over the middles of cells,
  /// with no bound beside. What is hidden or held is not looked for: no numbers.
  [[nodiscard]] Result<SimulationReport> rough_report(double allowed,
                                                      const std::array<Vec3, 2>& stock,
                                                      const RunContext& run);

 private:
  static constexpr int kMostLevels = 9;  ///< of quarters
  static constexpr int kEdgeLevels = 2;  ///< where the cutter does not reach: searches are dear
  using Numbers = std::vector<std::uint32_t>;
  struct Piece {
    CellPlace place;
    Cell cell;
    CellBounds bounds;
  };

  /// A sweep's entry from a place beside the cell's middle lies no higher than top + lean * way.
  struct EntryPlane {
    double top = 0.0, height = 0.0;
    Vec3 lean;
  };
  struct Candidate {
    double least = 0.0;  ///< distance from the cell's middle at least
    std::uint32_t sweep = 0;
  };
  [[nodiscard]] bool counts(std::size_t node) const {
    return !(cells_.cells()[node].normal == Vec3{}) && (left_ == nullptr || left_->at(node));
  }
  /// `planes`: of the sweeps that were looked at before.
  void look(const Looking& what, const Cell& cell, const Sweep& sweep, CellBounds& bounds,
            std::vector<EntryPlane>& planes) const;
  /// Takes sweeps in, the nearest first; `candidates`: those of them that are no farther from the
  /// cell's middle than `enough`.
  void look(const Looking& what, const Cell& cell, std::span<const std::uint32_t> sweeps,
            double enough, CellBounds& bounds, std::vector<Candidate>& candidates) const;
  /// What matters to a cell by its bounds, from its middle.
  [[nodiscard]] double radius_of(const Looking& what, const Cell& cell,
                                 const CellBounds& bounds) const;
  void bound_by_bend(const Cell& cell, const SweepEntry& entry, double& most,
                     std::vector<EntryPlane>& planes) const;
  [[nodiscard]] double bound_by_bottom(const Cell& cell, const Sweep& sweep, double height,
                                       double most) const;
  /// Bounds of a cell by these sweeps; `near` gets those that matter to any part of it. They lie
  /// within `about` of the middle most likely, within `most` in any case.
  [[nodiscard]] CellBounds bounds(const Looking& what, const Cell& cell,
                                  std::span<const std::uint32_t> sweeps, double about, double most,
                                  Numbers& near) const;
  /// Quarters a cell; look(piece, levels left) says of each quarter whether to go on.
  template <class Look>
  void quarter(const Looking& what, const Piece& whole, std::span<const std::uint32_t> sweeps,
               int levels, const Look& look) const;
  template <class Look>
  void quarter(const Looking& what, std::size_t node, const Look& look) const;
  [[nodiscard]] const Nearest& nearest(std::size_t node);
  [[nodiscard]] Nearest nearest(std::size_t node, const Piece& piece);  ///< of a piece of a node
  /// The cutter does not reach the middle of the node, but that of one beside it, where more than
  /// `limit` was looked into.
  [[nodiscard]] bool at_edge(std::size_t node, double limit) const;
  [[nodiscard]] Result<void> look_into_reach(double limit,
                                             const RunContext& run);  ///< nodes with more than that
  [[nodiscard]] HighSpot spot_at(std::size_t node, const Piece& piece, Vec2 axis) const;
  [[nodiscard]] bool find_above(std::size_t node, double limit, double within, HighSpot& spot);
  [[nodiscard]] bool find_inside(std::size_t node, double limit, double within, HighSpot& spot);
  [[nodiscard]] Result<void> report_depth(double allowed, SimulationReport& out,
                                          const RunContext& run) const;
  Result<void> report_reach(SimulationReport& out, const RunContext& run);
  Result<void> report_left(double within, SimulationReport& out, const RunContext& run);

  const Part& part_;
  const SurfaceCells& cells_;
  std::size_t threads_;
  double sway_;
  double flat_from_ = 2.0, flat_limit_ = 0.0;
  const Leftover* left_ = nullptr;
  std::vector<Sweep> sweeps_;
  std::vector<Numbers> of_tile_;
  LargeList<std::uint32_t> tile_of_;
  LargeList<CellBounds> nodes_;
  LargeList<double> searched_;  ///< no more was found in a cell: it becomes no more
  LargeList<Nearest>& nearest_;
};

template <class Look>
void Simulation::quarter(const Looking& what, const Piece& whole,
                         std::span<const std::uint32_t> sweeps, int levels,
                         const Look& look) const {
  struct Waiting {
    Piece part;
    Numbers near;
    int levels;
  };
  std::deque<Waiting> waiting;  // large pieces first: they may show that small ones are not needed
  waiting.push_back({whole, {sweeps.begin(), sweeps.end()}, levels});
  for (; !waiting.empty(); waiting.pop_front()) {
    const Waiting& one = waiting.front();
    const CellPlace& at = one.part.place;
    const double du = 0.5 * at.du, dv = 0.5 * at.dv;
    for (const double v : {at.v - dv, at.v + dv}) {
      for (const double u : {at.u - du, at.u + du}) {
        if (!part_.is_there(at.patch, u, v)) continue;
        Waiting next{{{at.patch, u, v, du, dv}, {}, {}}, {}, one.levels - 1};
        next.part.cell =
            cell_at(part_.model(), next.part.place, one.part.cell.normal, part_.allowance());
        if (next.part.cell.normal == Vec3{}) continue;
        const double most = radius_of(what, next.part.cell, one.part.bounds);
        next.part.bounds = bounds(what, next.part.cell, one.near, most, most, next.near);
        if (look(next.part, next.levels) && next.levels > 0) waiting.push_back(std::move(next));
      }
    }
  }
}

template <class Look>
void Simulation::quarter(const Looking& what, std::size_t node, const Look& look) const {
  Numbers near;
  const Cell& cell = cells_.cells()[node];
  const double about = radius_of(what, cell, nodes_[node]);
  const Piece whole{cells_.place(node), cell,
                    bounds(what, cell, of_tile_[tile_of_[node]], about, about, near)};
  quarter(what, whole, near, kMostLevels, look);
}

}  // namespace obvid::toolpath
