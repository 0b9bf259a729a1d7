// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unordered_map>

#include "level_passes.h"
#include "pass_families.h"
#include "simulation.h"

namespace obvid::toolpath {

/// Looks over what a family of passes leaves on the whole surface, and adds passes half way between
/// those on whose two sides the cutter would have to be to take off what is too high.
class ScallopSurvey {
 public:
  ScallopSurvey(const Part& part, const ToolpathOptions& options, const StepRule& rule,
                const SurfaceCells& cells, LargeList<Nearest>& reach, const Leftover* left,
                Walker& walker);

  /// Adds passes to the family where more stays than `share` of the scallop that is asked for;
  /// their number.
  /// With levels, they get what is missing on walls.
  Result<std::size_t> complete(Family& family, LevelPasses* levels, double share,
                               const RunContext& run);

 private:
  struct Wanted {
    std::size_t behind = 0;  ///< pass of the family
    Rail rail;
  };
  /// Where on a family's rails the cutter touches a place: t along them, and across.
  struct Across {
    double t = 0.0, across = 0.0;
  };
  struct Sides {
    std::size_t low = 0, high = 0;
    friend bool operator<(const Sides& a, const Sides& b) {
      return a.low != b.low ? a.low < b.low : a.high < b.high;
    }
  };

  using Spots = std::vector<const HighSpot*>;

  /// Leaves those out where passes were added some times and took nothing off.
  void give_up(std::vector<HighSpot>& high);
  [[nodiscard]] Result<std::vector<Wanted>> wanted(const Family& family,
                                                   const std::vector<HighSpot>& high,
                                                   const RunContext& run);
  /// Passes behind those that they were wanted behind, those that lead nowhere left out; how many.
  static std::size_t insert(Family& family, const std::vector<Wanted>& wanted,
                            std::vector<Pass> passes);
  [[nodiscard]] Across across(const HighSpot& spot) const;
  [[nodiscard]] std::optional<double> across(const Rail& rail, const HighSpot& spot,
                                             double t) const;
  [[nodiscard]] std::optional<Sides> sides(const Family& family, const HighSpot& spot) const;
  [[nodiscard]] Vec2 outside(const Rail& rail, const Spots& spots) const;
  [[nodiscard]] double length(const Rail& rail) const;

  const Part& part_;
  Walker& walker_;
  bool of_parameters_, along_v_;
  PassFrame frame_;
  double level_, spacing_, scallop_, print_;
  double flat_from_;  ///< z of normals, where there are levels
  struct Tried {
    double height = 0.0;  ///< at last
    int times = 0;        ///< in vain, one after the other
  };
  std::unordered_map<std::size_t, Tried> tried_;  ///< by cells
  bool begun_ = false;
  Simulation simulation_;
};

}  // namespace obvid::toolpath
