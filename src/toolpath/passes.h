// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "bulge_map.h"
#include "part.h"

namespace obvid::toolpath {

/// Distance seen from above.
[[nodiscard]] double level_distance(Vec3 a, Vec3 b);

/// What a pass follows, over t in [0, 1]: places of the axis seen from above, or a line of
/// parameters that the cutter is to touch.
struct Rail {
  std::vector<Vec2> axis;  ///< not for lines of parameters; equal shares of t between them
  PassPlane plane = PassPlane::kNone;
  std::size_t patch = 0;
  bool along_v = false;
  double fixed = 0.0;  ///< the other parameter
  double from = 0.0, to = 1.0;
  bool across = false;            ///< a link: not in the direction of the passes
  std::optional<double> floor{};  ///< the tip goes no lower, and goes on where it rests on nothing

  [[nodiscard]] bool of_parameters() const { return axis.empty(); }
  [[nodiscard]] Vec2 axis_at(double t) const;
};

/// Half way between two rails of a family.
[[nodiscard]] Rail between(const Rail& a, const Rail& b);

struct PassPoint {
  double t = 0.0;
  Place place;
  bool lifted = false;
};
/// Stretches where the rail leads over the part.
struct Pass {
  Rail rail;
  std::vector<std::vector<PassPoint>> pieces;
  [[nodiscard]] bool empty() const { return pieces.empty(); }
};

/// The least of `most` and what `of` says of the points of a pass, shared out among threads.
[[nodiscard]] double least_over(const Pass& pass, double most, std::size_t threads,
                                const std::function<double(const PassPoint&)>& of);

/// Of a piece of a pass the points that are kept, as pieces of their own; single points are none.
void append_kept(const std::vector<PassPoint>& piece, const std::vector<bool>& kept,
                 std::vector<std::vector<PassPoint>>& out);

/// Leaves of a pass what lies within `beyond` of places whose normal's z is larger than
/// `flat_from`.
void keep_flat(Pass& pass, double flat_from, double beyond);

/// Follows rails with points so near to each other that the cutter, moved straight between
/// neighbours, cuts nothing deeper than its share of the tolerance and leaves no more than that.
class Walker {
 public:
  /// `overrun`: how far the axis may run beside open borders, farther out than where the cutter
  /// still touches the surface; across them it ends there. `direction`: of all passes; nothing:
  /// any.
  Walker(const Part& part, double overrun, std::optional<Vec2> direction,
         const ToolpathOptions& options)
      : part_(part),
        bulges_(part, direction, options.threads),
        overrun_(overrun),
        most_points_(options.most_points),
        threads_(options.threads) {}

  /// Errors: E502 more points than allowed, in all passes so far.
  [[nodiscard]] Result<Pass> walk(const Rail& rail);
  /// The same for many, side by side. Errors: as above, E103.
  [[nodiscard]] Result<std::vector<Pass>> walk(const std::vector<Rail>& rails,
                                               const RunContext& run);
  /// A straight way on the surface; nothing: it leads where there is nothing to go on.
  [[nodiscard]] std::optional<std::vector<Vec3>> link(Vec3 from, Vec3 to);
  /// Places of the tip over these of the axis, no lower than a floor, and between them as near to
  /// each other as those of passes; nothing: too many of them.
  [[nodiscard]] std::optional<std::vector<Vec3>> over(const std::vector<Vec2>& axis, double floor);
  /// Where the resting tip falls most, seen from above, length 1; nothing: it is level, or rests on
  /// nothing.
  [[nodiscard]] std::optional<Vec2> downhill(Vec2 axis) const;
  [[nodiscard]] std::size_t threads() const { return threads_; }

 private:
  using Station = std::optional<PassPoint>;
  /// What lies behind a station up to and with the next: points, and where nothing is between.
  struct Stretch {
    std::vector<Station> points;
    std::size_t most = 0;
  };
  struct Walk;
  struct Lot;
  [[nodiscard]] static std::vector<Lot> lots_of(const std::vector<Walk>& walks);
  void walk_lot(Walk& walk, const Lot& lot) const;
  [[nodiscard]] static Pass pass_of(Walk& walk);
  [[nodiscard]] Result<void> count(const std::vector<Walk>& walks);
  [[nodiscard]] Station at(const Rail& rail, double t) const;
  [[nodiscard]] Station touching(const Rail& rail, double t) const;
  [[nodiscard]] Station resting(const Rail& rail, double t) const;
  [[nodiscard]] Vec2 out_of_part(const Place& place) const;
  [[nodiscard]] bool ends_at_border(const Rail& rail, double t, Place& place) const;
  [[nodiscard]] Station no_lower(Vec2 axis, double t, double floor) const;
  [[nodiscard]] bool round_enough(Vec3 a, Vec3 b) const;
  [[nodiscard]] bool flat_enough(const Rail& rail, Vec3 a, Vec3 b) const;
  [[nodiscard]] bool measured_enough(const std::array<Vec3, 5>& quarters) const;
  [[nodiscard]] std::vector<double> stations(const Rail& rail) const;
  void fill(const Rail& rail, const Station& a, double ta, const Station& b, double tb, int depth,
            Stretch& out) const;
  void fill_both(const Rail& rail, const Station& a, double ta, const Station& b, double tb,
                 int depth, Stretch& out) const;
  /// Of a rail that leads over the part from end to end.
  [[nodiscard]] std::optional<std::vector<Vec3>> tips_of(const Rail& rail);

  const Part& part_;
  BulgeMap bulges_;
  double overrun_;
  std::size_t most_points_, threads_;
  std::size_t points_ = 0;
};

}  // namespace obvid::toolpath
