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
#include "obvid/core/internal/questions.h"
#include "pass_families.h"

namespace obvid::toolpath {
namespace {

constexpr double kOutside = 1.05;                     // radii that lines begin beside the stock
constexpr std::array kHelixPlaces = {1.0, 2.0, 4.0};  // radii of the helix from the stretch's end
constexpr double kLeastTurns = 2.0;                   // of a helix: each takes half a level at most
constexpr double kStepDown = 0.5;                     // diameters
constexpr double kLevelRounding = 1e-9;               // of a level: no further one for that
constexpr std::size_t kLevelsTogether = 16;           // planned side by side
constexpr int kGuesses = 2;    // of what levels leave, before they are planned one after another
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
using Cuts = std::vector<std::vector<Cleared::Cut>>;  ///< likewise

/// A move on a level; without a kind: the cutter rises, and comes down at the only point.
struct LevelMove {
  std::optional<ToolMove> kind;
  std::vector<Vec3> points;
};

/// What one level asks for.
struct LevelPlan {
  std::vector<LevelMove> moves;
  ToolpathEntries entries;
  std::size_t narrow_stretches = 0;
  Cuts cuts;
};

bool with_helices(const ToolpathOptions& options) { return options.entry == ToolpathEntry::kHelix; }

/// What all levels have in common.
struct RoughField {
  const Part& part;
  const ToolpathOptions& options;
  std::array<Vec3, 2> stock;
  PassFrame frame;
  double spacing = 0.0, fall = 0.0;
  std::vector<Line> lines;
};

/// Plans one level. It knows of the others only what the one above it has taken.
class LevelPlanner {
 public:
  /// `above`: null for the first level.
  LevelPlanner(const RoughField& field, const Cuts* above)
      : part_(field.part),
        options_(field.options),
        stock_(field.stock),
        frame_(field.frame),
        spacing_(field.spacing),
        fall_(field.fall),
        lines_(field.lines) {
    if (above == nullptr) return;
    above_.emplace(part_.cutter());
    for (std::size_t k = 0; k < lines_.size(); ++k) above_->add_line(lines_[k].b, (*above)[k]);
  }

  /// `over`: the level above. What it returns is worth nothing once `questions` end.
  LevelPlan plan(Stretches level, double over, double z, Questions& questions) {
    for (std::size_t first = 0; first < level.size() && !questions.end(); ++first) {
      for (Stretch& s : level[first]) {
        if (s.done || !begin(first, s, over, z)) continue;
        follow(level, first, over, z);
      }
    }
    for (const auto& line : level) {
      out_.cuts.emplace_back();
      for (const Stretch& s : line) {
        if (s.cut) out_.cuts.back().push_back({s.from, s.to});
      }
    }
    return std::move(out_);
  }

  /// What is taken of a level, most likely: helices need more room than ramps.
  Cuts likely(const Stretches& level, double over, double z) const {
    Cuts out(level.size());
    for (std::size_t k = 0; k < level.size(); ++k) {
      for (const Stretch& s : level[k]) {
        if (can_begin(s, k, over, z, false)) out[k].push_back({s.from, s.to});
      }
    }
    return out;
  }

 private:
  void enter(Vec3 start) {
    out_.moves.push_back({std::nullopt, {start}});
    at_ = start;
  }
  void add(ToolMove kind, std::vector<Vec3> points) {
    at_ = points.back();
    out_.moves.push_back({kind, std::move(points)});
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

  [[nodiscard]] bool can_begin(const Stretch& s, std::size_t line, double over, double z,
                               bool helices) const {
    const Vec3 from = place(s.from, line, z), to = place(s.to, line, z);
    return beside_stock(from) || beside_stock(to) ||
           legs_of_ramp(norm(to - from), over - z, fall_) ||
           (helices && helix_beside(from, to, over, z));
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
      enter(start);
      ++out_.entries.straight;
    } else if (!go_down(start, end, over, z)) {
      if (!beside_stock(end)) {
        ++out_.narrow_stretches;
        return false;
      }
      enter(end);
      ++out_.entries.straight;
      add(ToolMove::kLink, {end, start});
    }
    s.cut = true;
    add(ToolMove::kPass, {start, end});
    return true;
  }

  /// Into the stock, from where the level before has left a stretch free, to its start.
  bool go_down(Vec3 start, Vec3 end, double over, double z) {
    auto way = with_helices(options_) ? helix_beside(start, end, over, z) : std::nullopt;
    const bool helical = way.has_value();
    if (!helical) way = ramp_over({start, end}, {over - z, fall_});
    if (!way) return false;
    ++(helical ? out_.entries.helical : out_.entries.ramped);
    const Vec3 last = way->back();
    enter(way->front());
    add(ToolMove::kPlunge, std::move(*way));
    if (!(last == start)) add(ToolMove::kLink, {last, start});
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
        if (s.done || !can_begin(s, line + 1, over, z, with_helices(options_))) continue;
        for (const bool from_end : {false, true}) {
          const Vec3 start = place(from_end ? s.to : s.from, line + 1, z);
          const double far = norm(start - at_);
          if (far >= nearest || !clear_way(at_, start)) continue;
          nearest = far;
          next = &s;
          backwards = from_end;
        }
      }
      if (next == nullptr) return;
      ++line;
      next->done = next->cut = true;
      const Vec3 start = place(backwards ? next->to : next->from, line, z);
      add(ToolMove::kLink, {at_, start});
      add(ToolMove::kPass, {start, place(backwards ? next->from : next->to, line, z)});
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
  const std::array<Vec3, 2>& stock_;
  const PassFrame& frame_;
  double spacing_, fall_;
  const std::vector<Line>& lines_;
  std::optional<Cleared> above_;  ///< what the level above has taken
  Vec3 at_;
  LevelPlan out_;
};

class Roughing {
 public:
  Roughing(const Part& part, const ToolpathOptions& options, Toolpath& out)
      : field_{part,
               options,
               stock_of(part, options),
               pass_frame(part, options.angle_deg),
               level_spacing(part),
               *fall_of(options),
               {}},
        out_(out),
        list_(out) {}

  Result<void> run(const RunContext& run) {
    OBVID_TRY(measure(run));
    const ToolpathOptions& options = field_.options;
    const double top = field_.stock[1].z, bottom = field_.stock[0].z;
    const double step = options.step_down.value_or(kStepDown * options.cutter.diameter);
    const double levels = std::ceil((top - bottom) / step - kLevelRounding);
    if (!(levels <= kMostLevels)) {
      return error(ErrorCode::kBadOption, fmt::format("that would be {:.2g} levels", levels))
          .hint("check the units of the surface, the step down and the stock")
          .value(levels);
    }
    const auto count = static_cast<std::size_t>(std::max(1.0, levels));
    for (std::size_t k = 0; k <= count; ++k) {
      heights_.push_back(top +
                         (bottom - top) * static_cast<double>(k) / static_cast<double>(count));
    }
    for (std::size_t k = 1; k <= count; k += kLevelsTogether) {
      OBVID_TRY(tell(run, "levels", static_cast<double>(k - 1) / static_cast<double>(count)));
      OBVID_TRY(cut_levels(k, std::min(kLevelsTogether, count + 1 - k), run));
    }
    list_.leave();
    out_.report.levels = count;
    return {};
  }

 private:
  [[nodiscard]] double height(double a, double b) const {
    const auto rest = field_.part.drop(field_.frame.at(a, b));
    return rest ? rest->tip.z : kNothing;
  }

  /// The stretch of a line over the stock and a little more.
  [[nodiscard]] std::optional<std::pair<double, double>> over_stock(double b) const {
    const double out = kOutside * field_.part.cutter().radius;
    const Vec2 start = field_.frame.at(0.0, b);
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
    between(start.x, field_.frame.along.x, field_.stock[0].x - out, field_.stock[1].x + out);
    between(start.y, field_.frame.along.y, field_.stock[0].y - out, field_.stock[1].y + out);
    if (!(from < to)) return std::nullopt;
    return std::pair{from, to};
  }

  /// Heights along all lines: the same for all levels.
  Result<void> measure(const RunContext& run) {
    double low = -kNothing, high = kNothing;
    for (const double x : {field_.stock[0].x, field_.stock[1].x}) {
      for (const double y : {field_.stock[0].y, field_.stock[1].y}) {
        const double b = dot(Vec2{x, y}, field_.frame.across());
        low = std::min(low, b);
        high = std::max(high, b);
      }
    }
    const double step = *field_.options.step_over;
    const double gaps = std::max(1.0, std::ceil((high - low) / step - kLevelRounding));
    double places = 0.0;
    for (double k = 0.0; k <= gaps; ++k) {
      Line line;
      line.b = low + (high - low) * k / gaps;
      const auto ends = over_stock(line.b);
      if (!ends) continue;
      const double parts = std::ceil((ends->second - ends->first) / field_.spacing);
      places += parts + 1.0;
      if (!(places <= static_cast<double>(field_.options.most_points))) {
        return error(ErrorCode::kToleranceNotReached,
                     fmt::format("roughing needs more than {} places", field_.options.most_points))
            .hint("allow a larger tolerance or step over")
            .value(static_cast<double>(field_.options.most_points));
      }
      line.from = ends->first;
      line.spacing = (ends->second - ends->first) / parts;
      line.heights.resize(static_cast<std::size_t>(parts) + 1);
      field_.lines.push_back(std::move(line));
    }
    OBVID_TRY(tell(run, "levels", 0.0));
    return in_parallel(field_.lines.size(), with_threads(run, field_.options.threads),
                       [&](std::size_t k) {
                         Line& line = field_.lines[k];
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

  struct Level {
    Stretches stretches;
    Cuts above;  ///< that it was planned for
    LevelPlan plan;
  };

  /// Some levels, from the k-th on, side by side: each as if the one above it had taken what is
  /// likely, and once more where it has taken something else. The plans are those of one level
  /// after another.
  Result<void> cut_levels(std::size_t k, std::size_t count, const RunContext& run) {
    std::vector<Level> levels(count);
    const std::size_t lines = field_.lines.size();
    for (Level& level : levels) level.stretches.resize(lines);
    OBVID_TRY(
        in_parallel(count * lines, with_threads(run, field_.options.threads), [&](std::size_t n) {
          levels[n / lines].stretches[n % lines] =
              stretches(field_.lines[n % lines], heights_[k + n / lines]);
        }));
    const auto plan = [&](std::size_t i, const RunContext& own) {
      Watch watch(own);
      Questions questions(&watch, 1);
      LevelPlanner planner(field_, k + i == 1 ? nullptr : &levels[i].above);
      levels[i].plan =
          planner.plan(levels[i].stretches, heights_[k + i - 1], heights_[k + i], questions);
    };
    for (std::size_t i = 0; i < count; ++i) {
      levels[i].above =
          i == 0 ? above_
                 : LevelPlanner(field_, nullptr)
                       .likely(levels[i - 1].stretches, heights_[k + i - 2], heights_[k + i - 1]);
    }
    OBVID_TRY(in_parallel(count, with_threads(run, field_.options.threads), plan));
    // whether it was planned for something else than what the level above takes
    const auto is_off = [&](std::size_t i) {
      return with_helices(field_.options) && i > 0 && levels[i].above != levels[i - 1].plan.cuts;
    };
    for (int guess = 1; guess < kGuesses; ++guess) {
      std::vector<std::size_t> off;
      for (std::size_t i = 0; i < count; ++i) {
        if (is_off(i)) off.push_back(i);
      }
      for (const std::size_t i : off) levels[i].above = levels[i - 1].plan.cuts;
      OBVID_TRY(in_parallel(off.size(), with_threads(run, field_.options.threads),
                            [&](std::size_t n, const RunContext& own) { plan(off[n], own); }));
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (is_off(i)) {
        levels[i].above = levels[i - 1].plan.cuts;
        OBVID_TRY(in_parallel(1, with_threads(run, 1),
                              [&](std::size_t, const RunContext& own) { plan(i, own); }));
      }
      lay(std::move(levels[i].plan.moves));
      ToolpathReport& report = out_.report;
      report.entries.helical += levels[i].plan.entries.helical;
      report.entries.ramped += levels[i].plan.entries.ramped;
      report.entries.straight += levels[i].plan.entries.straight;
      report.narrow_stretches += levels[i].plan.narrow_stretches;
    }
    above_ = std::move(levels.back().plan.cuts);
    return {};
  }

  void lay(std::vector<LevelMove> moves) {
    for (LevelMove& move : moves) {
      if (move.kind) {
        list_.add(*move.kind, std::move(move.points));
      } else {
        list_.leave();
        list_.enter(move.points.front());
      }
    }
  }

  RoughField field_;
  Toolpath& out_;
  MoveList list_;
  std::vector<double> heights_;  ///< of the stock's top and the levels
  Cuts above_;                   ///< what the last level has taken
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
