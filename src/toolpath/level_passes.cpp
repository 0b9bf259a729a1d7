// SPDX-License-Identifier: Apache-2.0
#include "level_passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "obvid/core/internal/parallel.h"
#include "obvid/core/units.h"

namespace obvid::toolpath {
namespace {

constexpr double kSteepDeg = 45.0;
constexpr double kOnLine = 0.2;       // of a step's share: how near places lie to the line
constexpr double kGuessed = 0.25;     // of that: how near guesses come to the middle of it
constexpr int kMostCloser = 40;       // steps towards the line
constexpr int kChordHalvings = 8;     // of a chord in a side of the raster
constexpr double kLeastStep = 0.002;  // of the level step: nearer levels help no more
constexpr double kAround = 0.5;       // diameters: squares around high places

/// Of four values one apart the cubic through them, t from the second.
double cubic(const std::array<double, 4>& v, double t) {
  const double a = t + 1.0, b = t - 1.0, c = t - 2.0;
  return -t * b * c / 6.0 * v[0] + a * b * c / 2.0 * v[1] - a * t * c / 2.0 * v[2] +
         a * t * b / 6.0 * v[3];
}

bool all_finite(const std::array<double, 4>& v) {
  return std::all_of(v.begin(), v.end(), [](double one) { return std::isfinite(one); });
}

}  // namespace

void LevelPasses::Crossing::narrow(Vec2 at, double over) {
  (over > 0.0 ? held : clear) = {at, over};
}

// Regula falsi with halvings (Illinois).
template <class Over>
void LevelPasses::Crossing::close_in(double near, const Over& over) {
  constexpr double kNearEnd = 0.02;  // of the way: no step ends nearer to where it began
  constexpr int kHalvedEvery = 4;    // steps, so that a bent line ends, too
  double low = clear.over, high = held.over;
  int last = 0;
  for (int k = 0; k < kMostCloser && norm(held.at - clear.at) > near; ++k) {
    if (clear.over > -near) break;
    double part = 0.5;
    const bool halved = (k + 1) % kHalvedEvery == 0;
    if (std::isfinite(low) && !halved) {
      part = std::clamp(low / (low - high), kNearEnd, 1.0 - kNearEnd);
    }
    const Vec2 p = clear.at + part * (held.at - clear.at);
    const double h = over(p);
    narrow(p, h);
    if (h > 0.0) {
      high = h;
      if (last == 1) low *= 0.5;
      last = 1;
    } else {
      low = h;
      if (last == -1) high *= 0.5;
      last = -1;
    }
  }
}

std::optional<double> flat_from(const ToolpathOptions& options) {
  if (options.strategy != ToolpathStrategy::kZLevel && !options.steep_deg) return std::nullopt;
  return std::cos(options.steep_deg.value_or(kSteepDeg) * kOneDegree);
}

LevelPasses::LevelPasses(const Part& part, const ToolpathOptions& options, const StepRule& rule,
                         const Leftover* left)
    : part_(part),
      rule_(rule),
      left_(left),
      most_points_(options.most_points),
      threads_(options.threads),
      flat_from_(*flat_from(options)),
      most_down_(std::min(rule.level(), options.step_down.value_or(rule.level()))),
      only_steep_(options.strategy != ToolpathStrategy::kZLevel),
      share_(kStepShare * part.tolerance()),
      spacing_(std::sqrt(0.5) * level_spacing(part)) {
  const double out = 2.0 * part.cutter().radius + part.allowance() + 2.0 * spacing_;
  const Vec3 low = part.field().low(), high = part.field().high();
  origin_ = {low.x - out, low.y - out};
  nx_ = static_cast<std::size_t>(std::ceil(std::min((high.x - low.x + 2.0 * out) / spacing_, 1e9)));
  ny_ = static_cast<std::size_t>(std::ceil(std::min((high.y - low.y + 2.0 * out) / spacing_, 1e9)));
}

void LevelPasses::Squares::mark(Vec2 p) {
  const long x = std::lround(p.x / side), y = std::lround(p.y / side);
  for (long j = y - 1; j <= y + 1; ++j) {
    for (long i = x - 1; i <= x + 1; ++i) all.emplace(i, j);
  }
}

bool LevelPasses::Squares::hold(Vec2 p) const {
  return all.empty() || all.contains({std::lround(p.x / side), std::lround(p.y / side)});
}

Vec2 LevelPasses::node(std::size_t i, std::size_t j) const {
  return origin_ + spacing_ * Vec2{static_cast<double>(i), static_cast<double>(j)};
}

double LevelPasses::height(Vec2 axis) const {
  const auto rest = part_.drop(axis);
  return rest ? rest->tip.z : kNothing;
}

double LevelPasses::guessed(Vec2 axis) const {
  const Vec2 at = (1.0 / spacing_) * (axis - origin_);
  const double x = std::floor(at.x), y = std::floor(at.y);
  if (!(x >= 1.0 && y >= 1.0 && x + 2.0 < static_cast<double>(nx_) &&
        y + 2.0 < static_cast<double>(ny_))) {
    return kNothing;
  }
  const auto i = static_cast<std::size_t>(x), j = static_cast<std::size_t>(y);
  std::array<double, 4> rows{};
  for (std::size_t k = 0; k < 4; ++k) {
    const double* row = &heights_[(j + k - 1) * nx_ + i - 1];
    const std::array<double, 4> values = {row[0], row[1], row[2], row[3]};
    if (!all_finite(values)) return kNothing;
    rows[k] = cubic(values, at.x - x);
  }
  return cubic(rows, at.y - y);
}

Result<void> LevelPasses::measure(const RunContext& run) {
  const double places = static_cast<double>(nx_) * static_cast<double>(ny_);
  if (!(places <= static_cast<double>(most_points_))) {
    return error(ErrorCode::kToleranceNotReached,
                 fmt::format("levels need more than {} places", most_points_))
        .hint("allow a larger tolerance, or cut a part of the surface")
        .value(static_cast<double>(most_points_));
  }
  heights_.resize(nx_ * ny_);
  return in_parallel(ny_, with_threads(run, threads_), [&](std::size_t j) {
    for (std::size_t i = 0; i < nx_; ++i) heights_[j * nx_ + i] = height(node(i, j));
  });
}

/// Where the tip stands at walls that are seen from above.
Result<std::optional<LevelPasses::Heights>> LevelPasses::wall_heights(const SurfaceCells& cells,
                                                                      const RunContext& run) const {
  const auto& tiles = cells.tiles();
  std::vector<Heights> found(tiles.size(), {-kNothing, kNothing});
  OBVID_TRY(in_parallel(tiles.size(), with_threads(run, threads_), [&](std::size_t t) {
    for (std::size_t i = tiles[t].first; i < tiles[t].first + tiles[t].count; ++i) {
      const Cell& cell = cells.cells()[i];
      if (cell.normal == Vec3{} || cell.normal.z > flat_from_) continue;
      if (left_ != nullptr && !left_->at(i)) continue;
      if (hidden(part_, cell.point, cell.normal)) continue;
      const double z = part_.cutter().tip(cell.point, cell.normal).z;
      found[t].low = std::min(found[t].low, z - cell.reach);
      found[t].high = std::max(found[t].high, z + cell.reach);
    }
  }));
  Heights all{-kNothing, kNothing};
  for (const Heights& one : found) {
    all.low = std::min(all.low, one.low);
    all.high = std::max(all.high, one.high);
  }
  return all.low <= all.high ? std::optional(all) : std::nullopt;
}

LevelPasses::Crossing LevelPasses::crossing(std::uint64_t side, double z) const {
  const std::size_t from = side / 2, i = from % nx_, j = from / nx_;
  const std::size_t di = side % 2 == 0 ? 1 : 0, dj = 1 - di;
  Crossing out{side, {node(i, j), over(i, j, z)}, {node(i + di, j + dj), over(i + di, j + dj, z)}};
  if (out.clear.over > 0.0) std::swap(out.clear, out.held);
  const double near = kOnLine * share_;
  if (i >= di && j >= dj && i + 2 * di < nx_ && j + 2 * dj < ny_) {
    const std::array<double, 4> heights = {over(i - di, j - dj, z), over(i, j, z),
                                           over(i + di, j + dj, z),
                                           over(i + 2 * di, j + 2 * dj, z)};
    if (all_finite(heights)) {
      const Vec2 first = node(i, j);
      Crossing guess = out;
      guess.close_in(kGuessed * near, [&](Vec2 p) {
        return cubic(heights, norm(p - first) / spacing_) + 0.5 * near;
      });
      out.narrow(guess.clear.at, height(guess.clear.at) - z);
    }
  }
  out.close_in(near, [&](Vec2 p) { return height(p) - z; });
  return out;
}

Result<std::vector<LevelPasses::Line>> LevelPasses::lines(double z, const Squares& squares,
                                                          const RunContext& run) const {
  std::vector<std::uint64_t> sides;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ways;  // from side to side, in one field
  for (std::size_t j = 0; j + 1 < ny_; ++j) {
    for (std::size_t i = 0; i + 1 < nx_; ++i) {
      const bool a = held(i, j, z), b = held(i + 1, j, z), c = held(i + 1, j + 1, z),
                 d = held(i, j + 1, z);
      if (a == b && b == c && c == d) continue;
      if (!squares.hold(node(i, j))) continue;
      const std::uint64_t n = j * nx_ + i;
      const std::array<std::uint64_t, 4> all = {2 * n, 2 * (n + 1) + 1, 2 * (n + nx_), 2 * n + 1};
      const std::array<bool, 4> corner = {a, b, c, d};
      // corners run around to the left: from the side that leads to what is held to the one that
      // leads out of it, so that what is held lies on the right
      for (std::size_t k = 0; k < 4; ++k) {
        if (!corner[k] && corner[(k + 1) % 4]) {
          std::size_t end = k + 1;
          while (corner[(end + 1) % 4]) ++end;
          ways.emplace_back(all[k], all[end % 4]);
        }
      }
    }
  }
  for (const auto& [from, to] : ways) {
    sides.push_back(from);
    sides.push_back(to);
  }
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  std::vector<Crossing> crossings(sides.size());
  OBVID_TRY(in_parallel(sides.size(), with_threads(run, threads_),
                        [&](std::size_t k) { crossings[k] = crossing(sides[k], z); }));
  const auto number = [&](std::uint64_t side) {
    return static_cast<std::size_t>(std::lower_bound(sides.begin(), sides.end(), side) -
                                    sides.begin());
  };
  constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> next(sides.size(), kNowhere), before(sides.size(), kNowhere);
  for (const auto& [from, to] : ways) {
    next[number(from)] = number(to);
    before[number(to)] = number(from);
  }
  std::vector<Line> out;
  std::vector<bool> taken(sides.size(), false);
  const auto follow = [&](std::size_t start) {
    Line line;
    std::size_t k = start;
    for (; k != kNowhere && !taken[k]; k = next[k]) {
      taken[k] = true;
      line.places.push_back(crossings[k].clear.at);
    }
    line.closed = k == start && line.places.size() > 2;
    if (line.closed) line.places.push_back(line.places.front());
    if (line.places.size() > 1) out.push_back(std::move(line));
  };
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (before[k] == kNowhere) follow(k);
  }
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (!taken[k]) follow(k);
  }
  for (Line& line : out) {
    std::vector<std::vector<Vec2>> chords(line.places.size() - 1);
    OBVID_TRY(in_parallel(chords.size(), with_threads(run, threads_), [&](std::size_t k) {
      between(line.places[k], line.places[k + 1], z, 0, chords[k]);
    }));
    std::vector<Vec2> places{line.places.front()};
    for (std::size_t k = 0; k < chords.size(); ++k) {
      places.insert(places.end(), chords[k].begin(), chords[k].end());
      if (norm(line.places[k + 1] - places.back()) > 0.0) places.push_back(line.places[k + 1]);
    }
    line.places = std::move(places);
  }
  std::erase_if(out, [](const Line& line) { return line.places.size() < 2; });
  return out;
}

/// Places between two neighbours where their chord keeps away from what is held.
void LevelPasses::between(Vec2 a, Vec2 b, double z, int depth, std::vector<Vec2>& out) const {
  const double length = norm(b - a);
  if (depth >= kChordHalvings || length <= 2.0 * share_) return;
  const Vec2 right = (-1.0 / length) * left_normal(b - a);
  const Vec2 middle = 0.5 * (a + b);
  if (guessed(middle + (1.0 - kOnLine) * share_ * right) > z) return;
  if (height(middle) > z || height(middle + share_ * right) > z) return;
  double clear = share_, off = 2.0 * share_;
  for (; off < length; off *= 2.0) {
    if (height(middle + off * right) > z) break;
    clear = off;
  }
  if (off >= length) return;  // nothing near: a gap of the raster's size
  while (off - clear > kOnLine * share_) {
    const double half = 0.5 * (off + clear);
    (height(middle + half * right) > z ? off : clear) = half;
  }
  const Vec2 place = middle + clear * right;
  between(a, place, z, depth + 1, out);
  out.push_back(place);
  between(place, b, z, depth + 1, out);
}

LevelPasses::Station LevelPasses::station(Vec2 before, Vec2 at, Vec2 after, double z) const {
  Station out;
  const Vec3 tip{at.x, at.y, z};
  out.point.place.tip = out.point.place.contact = tip;
  const Vec2 way = after - before;
  const double length = norm(way);
  const double beside = part_.tolerance();
  const Vec2 right = length > 0.0 ? (-1.0 / length) * left_normal(way) : Vec2{};
  const Vec2 inside = at + beside * right;
  auto rest = part_.drop(inside);
  if (!rest || rest->tip.z <= z) rest = part_.drop(at);
  if (!rest) return out;
  out.point.place = *rest;
  out.point.place.tip = tip;
  const Vec2 away = at - Vec2{rest->contact.x, rest->contact.y};
  out.kept = !rest->open || norm(away) <= norm(part_.offset(rest->normal)) + rule_.level() ||
             part_.surface_over(at).has_value();
  const double slope = std::max(0.0, rest->tip.z - z) / beside;
  const double leans = 1.0 / std::sqrt(1.0 + slope * slope);  // z of the normal of the tip's places
  out.steep = leans <= flat_from_;
  out.down = rule_.down(part_, *rest, std::min(leans, flat_from_));
  return out;
}

void LevelPasses::append_pieces(const Line& line, const std::vector<Station>& stations,
                                Pass& pass) const {
  const std::size_t n = stations.size();
  std::vector<bool> wanted(n);
  for (std::size_t i = 0; i < n; ++i) {
    wanted[i] = stations[i].kept && (!only_steep_ || stations[i].steep);
  }
  // a step farther than steep places reach, so that no strip stays between them and flat ones
  std::vector<bool> taken = wanted;
  const auto spread = [&](auto number) {
    double left = 0.0;
    const std::size_t turns = line.closed ? 2 * n : n;
    for (std::size_t k = 0; k < turns; ++k) {
      const std::size_t i = number(k % n), last = number((k + n - 1) % n);
      if (wanted[i]) {
        left = rule_.level();
        continue;
      }
      left -= norm(line.places[i] - line.places[last]);
      if (k > 0 && left > 0.0 && stations[i].kept) taken[i] = true;
    }
  };
  if (only_steep_) {
    spread([](std::size_t k) { return k; });
    spread([n](std::size_t k) { return n - 1 - k; });
  }
  for (std::size_t i = 0; left_ != nullptr && i < n; ++i) {
    taken[i] = taken[i] && left_->wants(stations[i].point.place.tip);
  }
  std::size_t first = 0;  // of a closed line: begin behind a gap
  if (line.closed) {
    const auto gap = std::find(taken.begin(), taken.end(), false);
    first = gap == taken.end() ? 0 : static_cast<std::size_t>(gap - taken.begin());
  }
  bool open = false;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (first + k) % n;
    if (line.closed && first > 0 && i == n - 1) continue;  // the same place as the first
    if (taken[i]) {
      if (!open) pass.pieces.emplace_back();
      pass.pieces.back().push_back(stations[i].point);
    }
    open = taken[i];
  }
}

Result<Pass> LevelPasses::level(double z, const Squares& squares, double& down,
                                const RunContext& run) const {
  const auto all = lines(z, squares, run);
  OBVID_TRY(all);
  Pass pass;
  for (const Line& line : *all) {
    const std::size_t n = line.places.size();
    std::vector<Station> stations(n);
    OBVID_TRY(in_parallel(n, with_threads(run, threads_), [&](std::size_t i) {
      const std::size_t before = i > 0 ? i - 1 : line.closed ? n - 2 : i;
      const std::size_t after = i + 1 < n ? i + 1 : line.closed ? 1 : i;
      stations[i] = station(line.places[before], line.places[i], line.places[after], z);
    }));
    for (const Station& s : stations) {
      if (s.kept && s.steep) down = std::min(down, s.down);
    }
    append_pieces(line, stations, pass);
  }
  std::erase_if(pass.pieces, [](const auto& piece) { return piece.size() < 2; });
  return pass;
}

Result<void> LevelPasses::keep(Pass pass) {
  for (const auto& piece : pass.pieces) points_ += piece.size();
  if (points_ > most_points_) {
    return error(ErrorCode::kToleranceNotReached,
                 fmt::format("the passes need more than {} points", most_points_))
        .hint("allow a larger tolerance, scallop or step")
        .value(static_cast<double>(most_points_));
  }
  if (!pass.empty()) passes_.push_back(std::move(pass));
  return {};
}

Result<void> LevelPasses::lay(const SurfaceCells& cells, const RunContext& run) {
  const auto range = wall_heights(cells, run);
  OBVID_TRY(range);
  if (!*range) return {};
  const double high = (*range)->high, low = (*range)->low;
  if (!((high - low) / most_down_ <= kMostLevels)) {
    return error(ErrorCode::kBadOption,
                 fmt::format("that would be {:.2g} levels", (high - low) / most_down_))
        .hint("check the units of the surface, the scallop and the step down")
        .value((high - low) / most_down_);
  }
  OBVID_TRY(tell(run, "levels", 0.0));
  OBVID_TRY(measure(run));
  for (double z = high;;) {
    double down = most_down_;
    auto pass = level(z, {}, down, run);
    OBVID_TRY(pass);
    OBVID_TRY(keep(std::move(*pass)));
    at_.push_back(z);
    if (z <= low) break;
    const double next = std::max(low, z - down);
    if (!(next < z) || static_cast<double>(at_.size()) >= kMostLevels) {
      return error(ErrorCode::kBadOption,
                   fmt::format("more than {} levels would be needed", kMostLevels))
          .hint("allow a larger scallop, or take a cutter with a rounder corner")
          .value(down);
    }
    z = next;
    OBVID_TRY(tell(run, "levels", (high - z) / (high - low)));
  }
  levels_ = at_.size();
  return {};
}

Result<std::vector<Pass>> LevelPasses::add(const std::vector<HighSpot>& spots,
                                           const RunContext& run) {
  std::vector<Squares> around(at_.size());  // by the level above
  for (const HighSpot& spot : spots) {
    const bool touches = norm(spot.axis - Vec2{spot.tip.x, spot.tip.y}) <= part_.tolerance();
    const double height_there = touches ? spot.tip.z : height(spot.axis);
    const auto below =
        std::find_if(at_.begin(), at_.end(), [&](double z) { return z < height_there; });
    if (below == at_.begin() || below == at_.end()) continue;
    const auto above = below - 1;
    if (*above - *below <= kLeastStep * rule_.level()) continue;
    Squares& squares = around[static_cast<std::size_t>(above - at_.begin())];
    squares.side = kAround * 2.0 * part_.cutter().radius;
    squares.mark(spot.axis);
  }
  std::vector<Pass> out;
  std::vector<double> fresh;
  for (std::size_t k = 0; k < around.size(); ++k) {
    if (around[k].all.empty()) continue;
    double down = most_down_;
    const double z = 0.5 * (at_[k] + at_[k + 1]);
    auto pass = level(z, around[k], down, run);
    OBVID_TRY(pass);
    fresh.push_back(z);
    if (pass->empty()) continue;
    out.push_back(*pass);
    OBVID_TRY(keep(std::move(*pass)));
  }
  at_.insert(at_.end(), fresh.begin(), fresh.end());
  std::sort(at_.begin(), at_.end(), std::greater<>());
  return out;
}

Family LevelPasses::in_order() const {
  struct Piece {
    const std::vector<PassPoint>* points;
    double z;
  };
  std::vector<Piece> waiting;
  for (const Pass& pass : passes_) {
    for (const auto& piece : pass.pieces) waiting.push_back({&piece, piece.front().place.tip.z});
  }
  std::stable_sort(waiting.begin(), waiting.end(),
                   [](const Piece& a, const Piece& b) { return a.z > b.z; });
  Family out;
  std::optional<Vec3> at;
  for (std::size_t first = 0; first < waiting.size();) {
    std::size_t end = first;
    while (end < waiting.size() && waiting[end].z == waiting[first].z) ++end;
    for (; first < end; ++first) {
      std::size_t best = first, start = 0;
      double nearest = -kNothing;
      for (std::size_t k = first; at && k < end; ++k) {
        const auto& points = *waiting[k].points;
        const bool closed = points.front().place.tip == points.back().place.tip;
        for (std::size_t i = 0; i < (closed ? points.size() - 1 : 1); ++i) {
          const double far = norm(points[i].place.tip - *at);
          if (far >= nearest) continue;
          nearest = far;
          best = k;
          start = i;
        }
      }
      std::rotate(waiting.begin() + static_cast<std::ptrdiff_t>(first),
                  waiting.begin() + static_cast<std::ptrdiff_t>(best),
                  waiting.begin() + static_cast<std::ptrdiff_t>(best + 1));
      std::vector<PassPoint> points = *waiting[first].points;
      if (start > 0) {
        points.pop_back();
        std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(start),
                    points.end());
        points.push_back(points.front());
      }
      at = points.back().place.tip;
      Pass pass;
      pass.pieces.push_back(std::move(points));
      out.push_back(std::move(pass));
    }
  }
  return out;
}

}  // namespace obvid::toolpath
