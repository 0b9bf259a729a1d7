// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cut_blocks.h"
#include "obvid/exchange/internal/gcode/path.h"

namespace obvid::cutting {

/// The text of blocks.
class CutText {
 public:
  /// Of heights: as of places, or those that every program has.
  [[nodiscard]] static int height_decimals(int decimals, bool inches);

  CutText(const CutOptions& options, const BlockRules& rules, bool inches, int decimals);

  void add(const CutBlock& block);

  [[nodiscard]] const exchange::GcodePath& path() const { return path_; }
  /// Tracks of all motions that are printed, once the tool is placed.
  [[nodiscard]] const std::vector<std::size_t>& motions() const { return motions_; }
  /// Of each piece of the path.
  [[nodiscard]] const std::vector<std::size_t>& cut_tracks() const { return cut_tracks_; }
  [[nodiscard]] const std::vector<bool>& first_pass() const { return first_pass_; }
  [[nodiscard]] const std::vector<bool>& over_tab() const { return over_tab_; }
  /// What stands before the blocks, and behind them.
  [[nodiscard]] std::string start() const;
  [[nodiscard]] std::string end() const;

 private:
  void cut(const CutBlock& block);
  /// The feed of a block, or less where its arc bends more as it is printed.
  [[nodiscard]] double printed_feed(const CutBlock& block) const;
  [[nodiscard]] std::string on_words() const;
  [[nodiscard]] std::string dwell_words() const;
  [[nodiscard]] std::string feed_words(double feed);
  [[nodiscard]] std::string height_words(double z);

  const CutOptions& options_;
  const BlockRules& rules_;
  int height_decimals_;
  exchange::GcodePath path_;
  bool placed_ = false;
  double z_ = 0.0;
  std::string feed_;
  std::vector<std::size_t> motions_, cut_tracks_;
  std::vector<bool> first_pass_, over_tab_;
};

}  // namespace obvid::cutting
