// SPDX-License-Identifier: Apache-2.0
#include "moves.h"

#include <algorithm>
#include <cmath>

#include "move_list.h"

namespace obvid::toolpath {
namespace {

constexpr double kLinkSteps = 3.0;   // level steps seen from above: farther, the cutter is lifted
constexpr double kLinkDetour = 3.0;  // a link up and down is not longer than this times straight

class Layer {
 public:
  Layer(const ToolpathOptions& options, double level_step, Walker& walker, Toolpath& out)
      : options_(options), level_step_(level_step), walker_(walker), list_(out) {}

  void cut(std::vector<Vec3> points, PassPlane plane) {
    if (!list_.begun()) {
      list_.enter(points.front());
    } else if (!linked(points.front())) {
      list_.leave();
      list_.enter(points.front());
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

  const ToolpathOptions& options_;
  double level_step_;
  Walker& walker_;
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
  const Vec3 a = points[first], way = points[last] - a;
  const double length2 = dot(way, way);
  double worst = 0.0;
  for (std::size_t i = first + 1; i < last; ++i) {
    const Vec3 to = points[i] - a;
    const double part = length2 > 0.0 ? std::clamp(dot(to, way) / length2, 0.0, 1.0) : 0.0;
    worst = std::max(worst, norm(to - part * way));
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
