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
  /// A block in the plane of a pass, as it is printed.
  struct Block {
    Vec2 from, to, to_centre;
    bool arc = false, left = false;
    [[nodiscard]] double distance(Vec2 p) const;
    [[nodiscard]] double turn() const;  ///< of an arc, rad
  };

 public:
  /// `within`: machine units, how far blocks may lie from the points they stand for.
  ProgramText(int decimals, double within, bool arcs, const exchange::MotionRules& machine);

  /// The plane upright on X or Y in which a pass lies.
  struct Upright {
    PassPlane plane = PassPlane::kNone;
    double other = 0.0;  ///< the axis that does not move
    [[nodiscard]] Vec2 flat(Vec3 p) const { return {plane == PassPlane::kXz ? p.x : p.y, p.z}; }
    [[nodiscard]] Vec3 place(Vec2 p) const {
      return plane == PassPlane::kXz ? Vec3{p.x, other, p.y} : Vec3{other, p.x, p.y};
    }
    /// Of length 1, in space.
    [[nodiscard]] Vec3 direction(Vec2 a) const {
      return unit(plane == PassPlane::kXz ? Vec3{a.x, 0.0, a.y} : Vec3{0.0, a.x, a.y});
    }
  };
  /// What stands for a move. That depends on its points alone, so several threads may ask for ways
  /// of several moves before the first one is printed.
  struct Way {
    struct Step {
      Vec3 to;                                   ///< straight
      std::optional<std::array<Block, 2>> arcs;  ///< instead
    };
    Upright in;
    std::vector<Step> steps;
  };
  [[nodiscard]] Way straight_way(const std::vector<Vec3>& points) const;
  [[nodiscard]] Way way_of_pass(const std::vector<Vec3>& points, PassPlane plane) const;
  void print(const Way& way, double feed);

  void rapid(const std::vector<Vec3>& points);
  void straight(const std::vector<Vec3>& points, double feed) { print(straight_way(points), feed); }
  void pass(const std::vector<Vec3>& points, PassPlane plane, double feed) {
    print(way_of_pass(points, plane), feed);
  }
  void level_plane();  ///< back to G17

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] std::size_t blocks() const { return blocks_; }
  [[nodiscard]] std::size_t arcs() const { return arc_blocks_; }
  /// Of all blocks from the first place on, as they are printed, machine units.
  [[nodiscard]] double length() const { return length_; }
  /// Of the same.
  [[nodiscard]] double seconds() { return time_.seconds(); }

 private:
  struct Flat;
  [[nodiscard]] Vec3 printed(Vec3 p) const;
  /// Words of the axes that change; empty: the tool stands there.
  [[nodiscard]] std::string words(Vec3 to) const;
  void line(bool rapid, Vec3 to);
  void feed(double value);
  void plane(PassPlane plane);
  [[nodiscard]] Block block(Vec2 from, Vec2 middle, Vec2 to) const;
  [[nodiscard]] std::optional<std::array<Block, 2>> biarc(const Flat& flat, std::size_t first,
                                                          std::size_t last) const;
  void print(const Upright& in, const Block& block);

  int decimals_;
  double unit_, within_;
  bool with_arcs_;
  bool placed_ = false;
  Vec3 at_;
  double feed_ = 0.0;
  PassPlane plane_ = PassPlane::kNone;
  std::string text_;
  std::size_t blocks_ = 0, arc_blocks_ = 0;
  double length_ = 0.0;
  exchange::MotionTime time_;
};

}  // namespace obvid::toolpath
