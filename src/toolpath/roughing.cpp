// SPDX-License-Identifier: Apache-2.0
#include "roughing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "cleared.h"
#include "entry.h"
#include "move_list.h"
#include "obvid/core/internal/parallel.h"
#include "pass_families.h"

namespace obvid::toolpath {
namespace {

constexpr double kOutside = 1.05;                     // radii that lines begin beside the stock
constexpr std::array kHelixPlaces = {1.0, 2.0, 4.0};  // radii of the helix from the stretch's end
constexpr double kLeastTurns = 2.0;                   // of a helix: each takes half a level at most
constexpr double kStepDown = 0.5;                     // diameters
constexpr double kLevelRounding = 1e-9;               // of a level: no further one for that
constexpr int kHalvings = 12;  // of the spacing of places, to the end of a stretch

/// A line over the stock: height of the resting tip at places side by side.
struct Line {
  double b = 0.0, from = 0.0, spacing = 0.0;  ///< in the directions of the passes
  std::vector<double> heights;
  [[nodiscard]] double a(std::size_t i) const { return from + static_cast<double>(i) * spacing; }
};

/// Where the cutter may go on one level.
struct Stretch {
  double from = 0.0, to = 0.0;
  bool done = false;
  bool cut = false;
};
using Stretches = std::vector<std::vector<Stretch>>;  ///< by lines

class Roughing {
 public:
  Roughing(const Part& part, const ToolpathOptions& options, Toolpath& out)
      : part_(part),
        options_(options),
        stock_(stock_of(part, options)),
        frame_(pass_frame(part, options.angle_deg)),
        spacing_(level_spacing(part)),
        fall_(*fall_of(options)),
        out_(out),
        list_(out) {}

  Result<void> run(const RunContext& run) {
    OBVID_TRY(measure(run));
    const double top = stock_[1].z, bottom = stock_[0].z;
    const double step = options_.step_down.value_or(kStepDown * options_.cutter.diameter);
    const double levels = std::ceil((top - bottom) / step - kLevelRounding);
    if (!(levels <= kMostLevels)) {
      return error(ErrorCode::kBadOption, fmt::format("that would be {:.2g} levels", levels))
          .hint("check the units of the surface, the step down and the stock")
          .value(levels);
    }
    const auto count = static_cast<std::size_t>(std::max(1.0, levels));
    const auto level = [&](std::size_t k) {
      return top + (bottom - top) * static_cast<double>(k) / static_cast<double>(count);
    };
    for (std::size_t k = 1; k <= count; ++k) {
      OBVID_TRY(tell(run, "levels", static_cast<double>(k - 1) / static_cast<double>(count)));
      OBVID_TRY(cut_level(level(k - 1), level(k), run));
    }
    list_.leave();
    out_.report.levels = count;
    return {};
  }

 private:
  [[nodiscard]] double height(double a, double b) const {
    const auto rest = part_.drop(frame_.at(a, b));
    return rest ? rest->tip.z : kNothing;
  }

  /// The stretch of a line over the stock and a little more.
  [[nodiscard]] std::optional<std::pair<double, double>> over_stock(double b) const {
    const double out = kOutside * part_.cutter().radius;
    const Vec2 start = frame_.at(0.0, b);
    double from = kNothing, to = -kNothing;
    const auto between = [&](double at, double along, double low, double high) {
      if (along == 0.0) {
        if (at < low || at > high) to = kNothing;
        return;
      }
      const double p = (low - at) / along, q = (high - at) / along;
      from = std::max(from, std::min(p, q));
      to = std::min(to, std::max(p, q));
    };
    between(start.x, frame_.along.x, stock_[0].x - out, stock_[1].x + out);
    between(start.y, frame_.along.y, stock_[0].y - out, stock_[1].y + out);
    if (!(from < to)) return std::nullopt;
    return std::pair{from, to};
  }

  /// Heights along all lines: the same for all levels.
  Result<void> measure(const RunContext& run) {
    double low = -kNothing, high = kNothing;
    for (const double x : {stock_[0].x, stock_[1].x}) {
      for (const double y : {stock_[0].y, stock_[1].y}) {
        const double b = dot(Vec2{x, y}, frame_.across());
        low = std::min(low, b);
        high = std::max(high, b);
      }
    }
    const double step = *options_.step_over;
    const double gaps = std::max(1.0, std::ceil((high - low) / step - kLevelRounding));
    double places = 0.0;
    for (double k = 0.0; k <= gaps; ++k) {
      Line line;
      line.b = low + (high - low) * k / gaps;
      const auto ends = over_stock(line.b);
      if (!ends) continue;
      const double parts = std::ceil((ends->second - ends->first) / spacing_);
      places += parts + 1.0;
      if (!(places <= static_cast<double>(options_.most_points))) {
        return error(ErrorCode::kToleranceNotReached,
                     fmt::format("roughing needs more than {} places", options_.most_points))
            .hint("allow a larger tolerance or step over")
            .value(static_cast<double>(options_.most_points));
      }
      line.from = ends->first;
      line.spacing = (ends->second - ends->first) / parts;
      line.heights.resize(static_cast<std::size_t>(parts) + 1);
      lines_.push_back(std::move(line));
    }
    OBVID_TRY(tell(run, "levels", 0.0));
    return in_parallel(lines_.size(), options_.threads, run, [&](std::size_t k) {
      Line& line = lines_[k];
      for (std::size_t i = 0; i < line.heights.size(); ++i) {
        line.heights[i] = height(line.a(i), line.b);
      }
    });
  }

  /// From a place where the cutter may go towards one where it may not.
  [[nodiscard]] double last_clear(double b, double clear, double held, double z) const {
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (clear + held);
      (height(middle, b) <= z ? clear : held) = middle;
    }
    return clear;
  }

  [[nodiscard]] std::vector<Stretch> stretches(const Line& line, double z) const {
    std::vector<Stretch> out;
    const std::size_t n = line.heights.size();
    for (std::size_t i = 0; i < n;) {
      if (line.heights[i] > z) {
        ++i;
        continue;
      }
      std::size_t end = i;
      while (end + 1 < n && line.heights[end + 1] <= z) ++end;
      Stretch s{line.a(i), line.a(end)};
      if (i > 0) s.from = last_clear(line.b, s.from, line.a(i - 1), z);
      if (end + 1 < n) s.to = last_clear(line.b, s.to, line.a(end + 1), z);
      if (s.from < s.to) out.push_back(s);
      i = end + 1;
    }
    return out;
  }

  Result<void> cut_level(double over, double z, const RunContext& run) {
    Stretches level(lines_.size());
    OBVID_TRY(in_parallel(lines_.size(), options_.threads, run,
                          [&](std::size_t k) { level[k] = stretches(lines_[k], z); }));
    for (std::size_t first = 0; first < level.size(); ++first) {
      OBVID_TRY(may_go_on(run));
      for (Stretch& s : level[first]) {
        if (s.done || !begin(first, s, over, z)) continue;
        follow(level, first, over, z);
      }
    }
    above_.emplace(part_.cutter());
    for (std::size_t k = 0; k < level.size(); ++k) {
      std::vector<Cleared::Cut> cuts;
      for (const Stretch& s : level[k]) {
        if (s.cut) cuts.push_back({s.from, s.to});
      }
      above_->add_line(lines_[k].b, std::move(cuts));
    }
    return {};
  }

  [[nodiscard]] Vec3 place(double a, std::size_t line, double z) const {
    const Vec2 p = frame_.at(a, lines_[line].b);
    return {p.x, p.y, z};
  }

  [[nodiscard]] bool beside_stock(Vec3 p) const {
    const double dx = std::max({stock_[0].x - p.x, p.x - stock_[1].x, 0.0});
    const double dy = std::max({stock_[0].y - p.y, p.y - stock_[1].y, 0.0});
    return std::hypot(dx, dy) >= part_.cutter().radius;
  }

  [[nodiscard]] bool can_begin(const Stretch& s, std::size_t line, double over, double z) const {
    const Vec3 from = place(s.from, line, z), to = place(s.to, line, z);
    return beside_stock(from) || beside_stock(to) ||
           legs_of_ramp(norm(to - from), over - z, fall_) ||
           (options_.entry == ToolpathEntry::kHelix && helix_beside(from, to, over, z));
  }

  /// Comes down at one end of a stretch and takes it; false: it is too short to go down. One way
  /// alone, too short for a ramp: down beside the stock at its end, and first to its beginning.
  bool begin(std::size_t line, Stretch& s, double over, double z) {
    s.done = true;
    const bool from_end = !options_.one_way && !beside_stock(place(s.from, line, z)) &&
                          beside_stock(place(s.to, line, z));
    const Vec3 start = place(from_end ? s.to : s.from, line, z);
    const Vec3 end = place(from_end ? s.from : s.to, line, z);
    if (beside_stock(start)) {
      list_.leave();
      list_.enter(start);
      ++out_.report.entries.straight;
    } else if (!go_down(start, end, over, z)) {
      if (!beside_stock(end)) {
        ++out_.report.narrow_stretches;
        return false;
      }
      list_.leave();
      list_.enter(end);
      ++out_.report.entries.straight;
      list_.add(ToolMove::kLink, {end, start});
    }
    s.cut = true;
    list_.add(ToolMove::kPass, {start, end});
    return true;
  }

  /// Into the stock, from where the level before has left a stretch free, to its start.
  bool go_down(Vec3 start, Vec3 end, double over, double z) {
    auto way =
        options_.entry == ToolpathEntry::kHelix ? helix_beside(start, end, over, z) : std::nullopt;
    const bool helical = way.has_value();
    if (!helical) way = ramp_over({start, end}, {over - z, fall_});
    if (!way) return false;
    ++(helical ? out_.report.entries.helical : out_.report.entries.ramped);
    const Vec3 last = way->back();
    list_.leave();
    list_.enter(way->front());
    list_.add(ToolMove::kPlunge, std::move(*way));
    if (!(last == start)) list_.add(ToolMove::kLink, {last, start});
    return true;
  }

  /// Around a circle that touches the stretch, where the cutter is clear of the part on the level,
  /// and no more than what one turn takes less than a level stands over the one before.
  [[nodiscard]] std::optional<std::vector<Vec3>> helix_beside(Vec3 start, Vec3 end, double over,
                                                              double z) const {
    const Vec2 from{start.x, start.y};
    const double length = norm(end - start);
    const Vec2 along = Vec2{end.x - start.x, end.y - start.y} / length;
    for (const double part : kHelixRadii) {
      const double radius = part * part_.cutter().radius;
      for (const double places : kHelixPlaces) {
        if (!(places * radius < length)) break;
        const Vec2 touch = from + places * radius * along;
        for (const double side : {1.0, -1.0}) {
          std::vector<Vec3> ring;
          for (const Vec2 p : circle_from(touch, along, side, radius, options_.tolerance)) {
            ring.push_back({p.x, p.y, z});
          }
          auto helix = helix_over(ring, {over - z, fall_}, kLeastTurns);
          if (!helix) continue;
          const Vec2 centre = touch + side * radius * left_normal(along);
          const double most = (over - z) * (1.0 - 1.0 / helix->turns);
          if (is_low(centre, radius + part_.cutter().radius, most) && is_clear(ring)) {
            return std::move(helix->points);
          }
        }
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] bool is_low(Vec2 centre, double radius, double most) const {
    const auto outside = [&](Vec2 p, double around) {
      const Vec2 q = frame_.at(p.x, p.y);
      return q.x < stock_[0].x - around || q.x > stock_[1].x + around ||
             q.y < stock_[0].y - around || q.y > stock_[1].y + around;
    };
    const Vec2 in_frame{dot(centre, frame_.along), dot(centre, frame_.across())};
    return !above_ || above_->holds(in_frame, radius, most, outside);
  }

  [[nodiscard]] bool is_clear(const std::vector<Vec3>& ring) const {
    for (std::size_t i = 1; i < ring.size(); ++i) {
      const auto rest = part_.drop({ring[i].x, ring[i].y});
      if ((rest && rest->tip.z > ring[i].z) || !clear_way(ring[i - 1], ring[i])) return false;
    }
    return true;
  }

  /// From line to line as long as a straight way on the level leads on.
  void follow(Stretches& level, std::size_t line, double over, double z) {
    while (!options_.one_way && line + 1 < level.size()) {
      Stretch* next = nullptr;
      bool backwards = false;
      double nearest = -kNothing;
      for (Stretch& s : level[line + 1]) {
        // what is too short for a ramp stays on all levels: else several would be cut at once
        if (s.done || !can_begin(s, line + 1, over, z)) continue;
        for (const bool from_end : {false, true}) {
          const Vec3 start = place(from_end ? s.to : s.from, line + 1, z);
          const double far = norm(start - list_.at());
          if (far >= nearest || !clear_way(list_.at(), start)) continue;
          nearest = far;
          next = &s;
          backwards = from_end;
        }
      }
      if (next == nullptr) return;
      ++line;
      next->done = next->cut = true;
      const Vec3 start = place(backwards ? next->to : next->from, line, z);
      list_.add(ToolMove::kLink, {list_.at(), start});
      list_.add(ToolMove::kPass, {start, place(backwards ? next->from : next->to, line, z)});
    }
  }

  [[nodiscard]] bool clear_way(Vec3 from, Vec3 to) const {
    const double parts = std::max(1.0, std::ceil(norm(to - from) / spacing_));
    for (double k = 1.0; k < parts; ++k) {
      const Vec3 p = from + (k / parts) * (to - from);
      const auto rest = part_.drop({p.x, p.y});
      if (rest && rest->tip.z > p.z) return false;
    }
    return true;
  }

  const Part& part_;
  const ToolpathOptions& options_;
  std::array<Vec3, 2> stock_;
  PassFrame frame_;
  double spacing_, fall_;
  Toolpath& out_;
  MoveList list_;
  std::vector<Line> lines_;
  std::optional<Cleared> above_;  ///< the level that was cut before
};

}  // namespace

std::array<Vec3, 2> stock_of(const Part& part, const ToolpathOptions& options) {
  if (options.stock) return *options.stock;
  const Vec3 low = part.field().low(), high = part.field().high();
  const double a = options.allowance;
  return {Vec3{low.x - a, low.y - a, low.z}, high + Vec3{a, a, a}};
}

Result<void> lay_rough(const Part& part, const ToolpathOptions& options, const RunContext& run,
                       Toolpath& out) {
  return Roughing(part, options, out).run(run);
}

}  // namespace obvid::toolpath
