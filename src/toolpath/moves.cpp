// SPDX-License-Identifier: Apache-2.0
#include "moves.h"

#include <algorithm>
#include <cmath>

#include "machine_units.h"

namespace obvid::toolpath {
namespace {

constexpr double kLinkSteps = 3.0;   // level steps seen from above: farther, the cutter is lifted
constexpr double kLinkDetour = 3.0;  // a link up and down is not longer than this times straight

double length_of(const std::vector<Vec3>& points) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += norm(points[i] - points[i - 1]);
  return sum;
}

class Layer {
 public:
  Layer(const ToolpathOptions& options, double level_step, Walker& walker, Toolpath& out)
      : options_(options), level_step_(level_step), walker_(walker), out_(out) {}

  void cut(std::vector<Vec3> points, PassPlane plane) {
    if (!begun_) {
      enter(points.front());
    } else if (!linked(points.front())) {
      leave();
      enter(points.front());
    }
    at_ = points.back();
    begun_ = true;
    ++out_.report.passes;
    out_.report.cutting_length += length_of(points);
    out_.moves.push_back({ToolMove::kPass, plane, std::move(points)});
  }

  void leave() {
    if (!begun_) return;
    add(ToolMove::kRapid, {at_, {at_.x, at_.y, safe()}});
  }

  [[nodiscard]] Vec3 at() const { return at_; }
  [[nodiscard]] bool begun() const { return begun_; }

 private:
  [[nodiscard]] double safe() const { return out_.report.safe_z; }

  void add(ToolMove kind, std::vector<Vec3> points) {
    at_ = points.back();
    const double length = length_of(points);
    (kind == ToolMove::kRapid    ? out_.report.rapid_length
     : kind == ToolMove::kPlunge ? out_.report.plunge_length
                                 : out_.report.cutting_length) += length;
    out_.moves.push_back({kind, PassPlane::kNone, std::move(points)});
  }

  void enter(Vec3 start) {
    const Vec3 above{start.x, start.y, safe()};
    add(ToolMove::kRapid, begun_ ? std::vector<Vec3>{at_, above} : std::vector<Vec3>{above});
    add(ToolMove::kPlunge, {above, start});
  }

  bool linked(Vec3 start) {
    const double level = std::hypot(start.x - at_.x, start.y - at_.y);
    if (options_.one_way || level > kLinkSteps * level_step_) return false;
    auto way = walker_.link(at_, start);
    if (!way || length_of(*way) > kLinkDetour * (norm(start - at_) + level_step_)) return false;
    add(ToolMove::kLink, std::move(*way));
    return true;
  }

  const ToolpathOptions& options_;
  double level_step_;
  Walker& walker_;
  Toolpath& out_;
  Vec3 at_;
  bool begun_ = false;
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
  ToolpathReport& report = out.report;
  report.minutes = machine_scale(out.units) * (report.cutting_length / out.feeds.pass +
                                               report.plunge_length / out.feeds.plunge +
                                               report.rapid_length / out.feeds.rapid);
}

}  // namespace obvid::toolpath
