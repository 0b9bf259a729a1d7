// SPDX-License-Identifier: Apache-2.0
#include "moves.h"

#include <algorithm>
#include <cmath>

#include "entry.h"
#include "move_list.h"
#include "obvid/geom/internal/chord.h"

namespace obvid::toolpath {
namespace {

constexpr double kLinkSteps = 3.0;   // level steps seen from above: farther, the cutter is lifted
constexpr double kLinkDetour = 3.0;  // a link up and down is not longer than this times straight
constexpr double kRampHeight = 0.5;  // diameters
constexpr double kRampWay = 1.0;     // diameters, of straight ways beside a pass
constexpr double kSameFall = 1e-6;   // of a fall: rounding

class Layer {
 public:
  Layer(const ToolpathOptions& options, double level_step, Walker& walker, Toolpath& out)
      : options_(options),
        level_step_(level_step),
        fall_(fall_of(options)),
        walker_(walker),
        report_(out.report),
        list_(out) {}

  void cut(std::vector<Vec3> points, PassPlane plane) {
    if (!list_.begun() || !linked(points.front())) {
      list_.leave();
      enter(points);
    }
    list_.add(ToolMove::kPass, std::move(points), plane);
  }

  void leave() { list_.leave(); }
  [[nodiscard]] Vec3 at() const { return list_.at(); }
  [[nodiscard]] bool begun() const { return list_.begun(); }

 private:
  bool linked(Vec3 start) {
    const Vec3 at = list_.at();
    const double level = std::hypot(start.x - at.x, start.y - at.y);
    if (options_.one_way || level > kLinkSteps * level_step_) return false;
    auto way = walker_.link(at, start);
    if (!way || length_of(*way) > kLinkDetour * (norm(start - at) + level_step_)) return false;
    list_.add(ToolMove::kLink, std::move(*way));
    return true;
  }

  /// Down to a pass, as it is asked for and there is room.
  void enter(const std::vector<Vec3>& points) {
    std::optional<std::vector<Vec3>> way;
    const double height =
        std::min(options_.ramp_height.value_or(kRampHeight * options_.cutter.diameter),
                 report_.safe_z - points.front().z);
    if (fall_ && height > 0.0) {
      if (options_.entry == ToolpathEntry::kHelix) way = helix_to(points, height);
      if (way) {
        ++report_.entries.helical;
      } else if ((way = ramp_to(points, height))) {
        ++report_.entries.ramped;
      }
    }
    if (!way) {
      ++report_.entries.straight;
      return list_.enter(points.front());
    }
    list_.enter(way->front());
    list_.add(ToolMove::kPlunge, std::move(*way));
  }

  [[nodiscard]] Descent descent(double height) const { return {height, *fall_, report_.safe_z}; }

  /// The least steep of several ways down: nothing is better than the angle that was asked for.
  class Choice {
   public:
    explicit Choice(double fall) : enough_(fall * (1.0 + kSameFall)) {}
    /// True: good enough, nothing else needs to be looked at.
    bool take(std::optional<std::vector<Vec3>> way) {
      if (!way) return false;
      const double fall = steepest_of(*way).fall;
      if (!best_ || fall < fall_) {
        best_ = std::move(way);
        fall_ = fall;
      }
      return fall_ <= enough_;
    }
    [[nodiscard]] std::optional<std::vector<Vec3>> best() { return std::move(best_); }

   private:
    double enough_, fall_ = 0.0;
    std::optional<std::vector<Vec3>> best_;
  };

  /// In which a pass begins; nothing: it goes nowhere but up and down.
  [[nodiscard]] static std::optional<Vec2> direction_of(const std::vector<Vec3>& points) {
    for (const Vec3 p : points) {
      const Vec2 way{p.x - points.front().x, p.y - points.front().y};
      if (norm(way) > 0.0) return way / norm(way);
    }
    return std::nullopt;
  }

  /// Turns over a circle through the beginning of the pass, no lower than that, and nowhere higher
  /// by `height`: beside the pass, else behind its beginning or where the part falls.
  [[nodiscard]] std::optional<std::vector<Vec3>> helix_to(const std::vector<Vec3>& points,
                                                          double height) {
    const Vec3 start = points.front();
    const auto along = direction_of(points);
    if (!along) return std::nullopt;
    const Vec2 beside = left_normal(*along);
    struct Turn {
      Vec2 along;  ///< in which the circle leaves
      double side;
    };
    std::vector<Turn> turns{{*along, 1.0}, {*along, -1.0}, {beside, 1.0}};
    if (const auto down = walker_.downhill({start.x, start.y})) {
      turns.push_back({-left_normal(*down), 1.0});
    }
    Choice choice(*fall_);
    for (const double part : kHelixRadii) {
      const double radius = 0.5 * part * options_.cutter.diameter;
      for (const Turn& turn : turns) {
        auto ring = walker_.over(
            circle_from({start.x, start.y}, turn.along, turn.side, radius, options_.tolerance),
            start.z);
        if (!ring) continue;
        const auto highest =
            std::max_element(ring->begin(), ring->end(), [](Vec3 a, Vec3 b) { return a.z < b.z; });
        if (!(highest->z < start.z + height)) continue;
        ring->front() = ring->back() = start;
        auto helix = helix_over(*ring, descent(height), 1.0);
        if (helix && choice.take(std::move(helix->points))) return choice.best();
      }
    }
    return choice.best();
  }

  /// Back and forth over the pass; where that rises or falls too much, over a straight way from its
  /// beginning, no lower than that.
  [[nodiscard]] std::optional<std::vector<Vec3>> ramp_to(const std::vector<Vec3>& points,
                                                         double height) {
    const Vec3 start = points.front();
    Choice choice(*fall_);
    if (choice.take(flattest_ramp_over(points, descent(height)))) return choice.best();
    const auto along = direction_of(points);
    if (!along) return choice.best();
    const Vec2 beside = left_normal(*along), from{start.x, start.y};
    std::vector<Vec2> ways{*along, -*along, beside, -beside};
    if (const auto down = walker_.downhill(from)) ways.push_back(*down);
    for (const Vec2 to : ways) {
      auto way = walker_.over({from, from + kRampWay * options_.cutter.diameter * to}, start.z);
      if (!way) continue;
      way->front() = start;
      if (choice.take(flattest_ramp_over(*way, descent(height)))) return choice.best();
    }
    return choice.best();
  }

  const ToolpathOptions& options_;
  double level_step_;
  std::optional<double> fall_;
  Walker& walker_;
  ToolpathReport& report_;
  MoveList list_;
};

std::vector<Vec3> tips(const std::vector<PassPoint>& piece, bool backwards) {
  std::vector<Vec3> out;
  out.reserve(piece.size());
  for (const PassPoint& p : piece) out.push_back(p.place.tip);
  if (backwards) std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace

double off_chord(const std::vector<Vec3>& points, std::size_t first, std::size_t last) {
  double worst = 0.0;
  for (std::size_t i = first + 1; i < last; ++i) {
    worst = std::max(worst, distance_from_chord(points[i], points[first], points[last]));
  }
  return worst;
}

std::vector<Vec3> thinned(const std::vector<Vec3>& points, double within) {
  if (points.size() < 3) return points;
  std::vector<Vec3> out{points.front()};
  for (std::size_t at = 0; at + 1 < points.size();) {
    at = furthest_good(at, points.size() - 1,
                       [&](std::size_t last) { return off_chord(points, at, last) <= within; });
    out.push_back(points[at]);
  }
  return out;
}

void lay_moves(const Family& family, const ToolpathOptions& options, double level_step,
               Walker& walker, Toolpath& out) {
  out.moves.clear();
  Layer layer(options, level_step, walker, out);
  for (const Pass& pass : family) {
    if (pass.empty()) continue;
    const auto distance = [&](const PassPoint& p) { return norm(p.place.tip - layer.at()); };
    const bool backwards =
        !options.one_way && layer.begun() &&
        distance(pass.pieces.back().back()) < distance(pass.pieces.front().front());
    for (std::size_t k = 0; k < pass.pieces.size(); ++k) {
      const auto& piece = pass.pieces[backwards ? pass.pieces.size() - 1 - k : k];
      layer.cut(tips(piece, backwards), pass.rail.plane);
    }
  }
  layer.leave();
}

}  // namespace obvid::toolpath
