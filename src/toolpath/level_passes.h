// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "pass_families.h"
#include "simulation.h"

namespace obvid::toolpath {

/// Passes at constant height around what stands out of their levels, with the part on their right.
/// The lines on which the resting tip is as high as the level are followed over a raster so fine
/// that nothing of the part can hide between two neighbouring places of a pass (docs/methods/
/// toolpath.md).
class LevelPasses {
 public:
  /// With `zigzag` passes are kept where the part is steep, and a step beyond; else everywhere.
  /// Likewise where an earlier cutter left something, unless `left` is null.
  LevelPasses(const Part& part, const ToolpathOptions& options, const StepRule& rule,
              const Leftover* left);

  /// From the highest to the lowest place of the tip at a wall. Errors: E203 more than 20,000
  /// levels; E502 more places than allowed.
  Result<void> lay(const SurfaceCells& cells, const RunContext& run);
  /// Half way between levels, where too much stays on walls between them, around these places.
  /// What has been added.
  Result<std::vector<Pass>> add(const std::vector<HighSpot>& spots, const RunContext& run);
  [[nodiscard]] const std::vector<Pass>& passes() const { return passes_; }
  [[nodiscard]] std::size_t levels() const { return levels_; }
  /// From the top down, each stretch a pass of its own that begins near to where the last ended.
  [[nodiscard]] Family in_order() const;

 private:
  struct Height {
    Vec2 at;
    double over = 0.0;  ///< the level
  };
  /// Where a line crosses a side of the raster: the last clear place, and a held one.
  struct Crossing {
    std::uint64_t side = 0;
    Height clear, held;
    void narrow(Vec2 at, double over);
    /// Until the clear place is no farther than `near` from the line or below it; the clear end
    /// stays clear by over(place).
    template <class Over>
    void close_in(double near, const Over& over);
  };
  /// Squares of the plane in which levels are followed; no square: everywhere.
  struct Squares {
    double side = 0.0;
    std::set<std::pair<long, long>> all;
    void mark(Vec2 p);  ///< the place's own and those around it
    [[nodiscard]] bool hold(Vec2 p) const;
  };
  struct Line {
    std::vector<Vec2> places;
    bool closed = false;
  };
  struct Heights {
    double low = 0.0, high = 0.0;
  };

  [[nodiscard]] Vec2 node(std::size_t i, std::size_t j) const;
  [[nodiscard]] bool held(std::size_t i, std::size_t j, double z) const {
    return heights_[j * nx_ + i] > z;
  }
  [[nodiscard]] double over(std::size_t i, std::size_t j, double z) const {
    return heights_[j * nx_ + i] - z;
  }
  [[nodiscard]] double height(Vec2 axis) const;
  /// By the raster's nodes around; where some of them have none: nothing.
  [[nodiscard]] double guessed(Vec2 axis) const;
  [[nodiscard]] Result<void> measure(const RunContext& run);
  [[nodiscard]] Result<std::optional<Heights>> wall_heights(const SurfaceCells& cells,
                                                            const RunContext& run) const;
  [[nodiscard]] Crossing crossing(std::uint64_t side, double z) const;
  [[nodiscard]] Result<std::vector<Line>> lines(double z, const Squares& squares,
                                                const RunContext& run) const;
  void between(Vec2 a, Vec2 b, double z, int depth, std::vector<Vec2>& out) const;
  struct Station {
    PassPoint point;
    bool kept = false;   ///< the part goes on there
    bool steep = false;  ///< as steep as levels are for
    double down = 0.0;   ///< the next level at most so far below
  };
  [[nodiscard]] Station station(Vec2 before, Vec2 at, Vec2 after, double z) const;
  /// The passes of a level; `down` is lowered to what its walls allow.
  Result<Pass> level(double z, const Squares& squares, double& down, const RunContext& run) const;
  void append_pieces(const Line& line, const std::vector<Station>& stations, Pass& pass) const;
  Result<void> keep(Pass pass);

  const Part& part_;
  const StepRule& rule_;
  const Leftover* left_;
  std::size_t most_points_, threads_;
  double flat_from_, most_down_;
  bool only_steep_;
  double share_;    ///< how far places may lie off the line
  double spacing_;  ///< of the raster
  Vec2 origin_;
  std::size_t nx_ = 0, ny_ = 0;
  std::vector<double> heights_;
  std::vector<double> at_;  ///< heights of levels, descending
  std::size_t levels_ = 0, points_ = 0;
  std::vector<Pass> passes_;
};

}  // namespace obvid::toolpath
