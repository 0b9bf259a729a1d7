// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "cut_order.h"

namespace obvid::cutting {

/// One block of a program, or a switch. Lengths in units of the machine, feeds a minute.
struct CutBlock {
  enum class Kind {
    kRapidAcross,  ///< to `to`
    kRapidLevel,   ///< to height `z`
    kDown,         ///< at feed to height `z`, down or up
    kCut,          ///< along `piece`, ends at height `z`
    kOn,           ///< beam or torch
    kOff,
    kDwell,
  };
  Kind kind = Kind::kCut;
  std::size_t track = 0;
  Piece piece{};
  Vec2 to;
  double z = 0.0;
  double feed = 0.0;
  bool first_pass = false;  ///< for pictures: once around
  bool over_tab = false;    ///< in the last pass
};

/// What the machine does with the visits. Lengths in units of the machine.
struct BlockRules {
  CutProcess process = CutProcess::kMill;
  double depth = 0.0, pass_depth = 0.0;
  int passes = 1;
  double fall = 0.0;  ///< of ramps: depth for each length; 0: straight down
  CutTabs tabs;
  double tool_diameter = 0.0;
  double safe_z = 0.0, clear_z = 0.0;  ///< of rapid moves; above the stock
  double feed = 0.0, plunge_feed = 0.0;
  double across = 0.0;  ///< most acceleration across the path, length/s^2; 0: no limit
  double pierce_seconds = 0.0;
};

struct CutBlocks {
  std::vector<CutBlock> blocks;
  int levels = 1;
  std::vector<std::size_t> without_tabs;  ///< tracks that are too short for them
  struct Place {
    std::size_t track = 0;
    Vec2 at;
  };
  std::vector<Place> straight_down;  ///< behind tabs, where there is no room for a ramp
};

/// The feed where the path has a curvature.
[[nodiscard]] double feed_for(double kappa, const BlockRules& rules);

/// Passes over each other of a mill; may be more than can be cut.
[[nodiscard]] double levels_of(const BlockRules& rules);

[[nodiscard]] CutBlocks blocks_of(const std::vector<Track>& tracks,
                                  const std::vector<Visit>& visits, const BlockRules& rules,
                                  const Leads& leads);

}  // namespace obvid::cutting
