// SPDX-License-Identifier: Apache-2.0
#include "leftover.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "deepest.h"
#include "obvid/core/internal/parallel.h"
#include "obvid/core/internal/questions.h"

namespace obvid::toolpath {
namespace {

constexpr double kLookedAt = 0.5;  // of a square's side: how near places of a rail are looked at

}  // namespace

Result<Leftover> Leftover::find(const Part& part, const CutterShape& earlier,
                                const SurfaceCells& cells, LargeList<Nearest>& reach, double beyond,
                                std::size_t threads, const RunContext& run) {
  struct Found {
    std::vector<Vec3> tips;
    std::vector<HeldCell> cells;
    double area = 0.0;
  };
  const Part before = part.with(earlier);
  const double most = 2.0 * earlier.radius;  // farther along a normal nothing is looked for
  Leftover out;
  out.side_ = beyond;
  out.left_.assign(cells.cells().size(), 0);
  const auto& tiles = cells.tiles();
  std::vector<Found> found(tiles.size());
  OBVID_TRY(tell(run, "earlier cutter", 0.0));
  OBVID_TRY(in_parallel(
      tiles.size(), with_threads(run, threads), [&](std::size_t t, const RunContext& own) {
        Watch watch(own);
        Questions questions(&watch, kCellsBetweenQuestions);
        Found& here = found[t];
        for (std::size_t i = tiles[t].first;
             i < tiles[t].first + tiles[t].count && !questions.end(); ++i) {
          const Cell& cell = cells.cells()[i];
          if (cell.normal == Vec3{}) continue;
          const Nearest came = nearest_to(before, cell.point, cell.normal);
          if (came.reach == Reach::kReached) continue;
          out.left_[i] = 1;
          if (came.reach == Reach::kHidden) continue;
          here.area += cell.area;
          here.cells.push_back({i, came, 0.0});
          reach[i] = nearest_to(part, cell.point, cell.normal);
          const auto rest = part.drop(reach[i].axis);
          here.tips.push_back(rest ? rest->tip : part.tip(cell.point, cell.normal));
        }
      }));
  std::vector<HeldCell> left;
  for (const Found& here : found) {
    for (const Vec3 tip : here.tips) out.mark(tip);
    out.area_ += here.area;
    left.insert(left.end(), here.cells.begin(), here.cells.end());
  }
  const auto deepest = deepest_of(before, cells, std::move(left), threads, run);
  OBVID_TRY(deepest);
  if (!(deepest->came.height > 0.0)) return out;
  out.depth_ =
      deepest->came.height < most ? deepest->came.height : std::numeric_limits<double>::infinity();
  out.place_ = cells.cells()[deepest->cell].point;
  return out;
}

Leftover::Square Leftover::square(Vec2 p) const {
  return {std::lround(p.x / side_), std::lround(p.y / side_)};
}

void Leftover::mark(Vec3 tip) {
  const auto [x, y] = square({tip.x, tip.y});
  for (long j = y - 1; j <= y + 1; ++j) {
    for (long i = x - 1; i <= x + 1; ++i) {
      Heights& h = squares_.try_emplace({i, j}, Heights{tip.z, tip.z}).first->second;
      h = {std::min(h.low, tip.z), std::max(h.high, tip.z)};
    }
  }
}

bool Leftover::wants(Vec3 tip) const {
  const auto found = squares_.find(square({tip.x, tip.y}));
  return found != squares_.end() && tip.z >= found->second.low - side_ &&
         tip.z <= found->second.high + side_;
}

void Leftover::keep(Pass& pass) const {
  std::vector<std::vector<PassPoint>> pieces;
  for (const auto& piece : pass.pieces) {
    std::vector<bool> kept;
    for (const PassPoint& p : piece) {
      kept.push_back(squares_.contains(square({p.place.tip.x, p.place.tip.y})));
    }
    append_kept(piece, kept, pieces);
  }
  pass.pieces = std::move(pieces);
}

Result<Pass> Leftover::walk(Walker& walker, const Rail& rail) const {
  Pass out;
  out.rail = rail;
  double length = 0.0;
  for (std::size_t i = 1; i < rail.axis.size(); ++i) {
    length += norm(rail.axis[i] - rail.axis[i - 1]);
  }
  const double parts =
      std::ceil(std::max(1.0, (rail.to - rail.from) * length / (kLookedAt * side_)));
  const auto at = [&](double k) {
    return rail.from + (rail.to - rail.from) * std::clamp(k / parts, 0.0, 1.0);
  };
  std::optional<double> begun;
  for (double k = 0.0; k <= parts + 1.0; ++k) {
    const bool wanted = k <= parts && squares_.contains(square(rail.axis_at(at(k))));
    if (wanted && !begun) begun = at(k - 1.0);
    if (wanted || !begun) continue;
    Rail stretch = rail;
    stretch.from = *begun;
    stretch.to = at(k);
    begun.reset();
    auto pass = walker.walk(stretch);
    OBVID_TRY(pass);
    std::move(pass->pieces.begin(), pass->pieces.end(), std::back_inserter(out.pieces));
  }
  return out;
}

Result<Pass> walk_where_left(Walker& walker, const Rail& rail, const Leftover* left) {
  return left != nullptr ? left->walk(walker, rail) : walker.walk(rail);
}

std::vector<Pass> in_short_order(std::vector<Pass> passes, bool either_end) {
  struct Waiting {
    std::vector<PassPoint> points;
    Rail rail;
  };
  std::vector<Waiting> waiting;
  for (Pass& pass : passes) {
    for (auto& piece : pass.pieces) waiting.push_back({std::move(piece), pass.rail});
  }
  std::vector<Pass> out;
  std::vector<bool> taken(waiting.size(), false);
  std::size_t next = 0;
  while (out.size() < waiting.size()) {
    Waiting& one = waiting[next];
    taken[next] = true;
    Pass pass;
    pass.rail = std::move(one.rail);
    pass.pieces.push_back(std::move(one.points));
    const Vec3 at = pass.pieces.front().back().place.tip;
    out.push_back(std::move(pass));
    double nearest = std::numeric_limits<double>::infinity();
    bool backwards = false;
    for (std::size_t k = 0; k < waiting.size(); ++k) {
      if (taken[k]) continue;
      const double to_first = norm(waiting[k].points.front().place.tip - at);
      const double to_last = either_end ? norm(waiting[k].points.back().place.tip - at) : to_first;
      if (!(std::min(to_first, to_last) < nearest)) continue;
      nearest = std::min(to_first, to_last);
      backwards = to_last < to_first;
      next = k;
    }
    if (backwards) std::reverse(waiting[next].points.begin(), waiting[next].points.end());
  }
  return out;
}

}  // namespace obvid::toolpath
