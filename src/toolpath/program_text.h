// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/exchange/internal/gcode/motion_time.h"
#include "obvid/toolpath/toolpath.h"

namespace obvid::toolpath {

/// Blocks of a program. Places come in machine units and are rounded as they are printed; what
/// follows starts where the tool stands, so nothing drifts.
class ProgramText {
 public:
  /// `within`: machine units, how far blocks may lie from the points they stand for.
  ProgramText(int decimals, double within, bool arcs, const exchange::MotionRules& machine);

  void rapid(const std::vector<Vec3>& points);
  void straight(const std::vector<Vec3>& points, double feed);
  void pass(const std::vector<Vec3>& points, PassPlane plane, double feed);
  void level_plane();  ///< back to G17

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] std::size_t blocks() const { return blocks_; }
  [[nodiscard]] std::size_t arcs() const { return arc_blocks_; }
  /// Of all blocks from the first place on, as they are printed.
  [[nodiscard]] double seconds() { return time_.seconds(); }

 private:
  struct Flat;
  /// A block in the plane of a pass, as it is printed.
  struct Block {
    Vec2 from, to, to_centre;
    bool arc = false, left = false;
    [[nodiscard]] double distance(Vec2 p) const;
    [[nodiscard]] double turn() const;  ///< of an arc, rad
  };
  [[nodiscard]] Vec3 printed(Vec3 p) const;
  /// Words of the axes that change; empty: the tool stands there.
  [[nodiscard]] std::string words(Vec3 to) const;
  void line(bool rapid, Vec3 to);
  void feed(double value);
  void plane(PassPlane plane);
  [[nodiscard]] Block block(Vec2 from, Vec2 middle, Vec2 to) const;
  [[nodiscard]] std::optional<std::array<Block, 2>> biarc(const Flat& flat, std::size_t first,
                                                          std::size_t last) const;
  void print(const Flat& flat, const Block& block);

  int decimals_;
  double unit_, within_;
  bool with_arcs_;
  bool placed_ = false;
  Vec3 at_;
  double feed_ = 0.0;
  PassPlane plane_ = PassPlane::kNone;
  std::string text_;
  std::size_t blocks_ = 0, arc_blocks_ = 0;
  exchange::MotionTime time_;
};

}  // namespace obvid::toolpath
