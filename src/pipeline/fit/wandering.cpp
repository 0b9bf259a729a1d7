// SPDX-License-Identifier: Apache-2.0
#include "fit/wandering.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "obvid/geom/internal/angle.h"
#include "obvid/geom/vec2.h"

namespace obvid::pipeline_detail {
namespace {

constexpr double kRightAngle = 0.5 * std::numbers::pi;
/// A part is senseless when it leaves the circles' headings by more than they differ among each
/// other and half a right angle: it then stands a fifth of its chord away from all of them. Circles
/// that differ by more than a right angle say nothing about what is farther off. No contour of the
/// public data leaves them by more than they differ and 32 degrees.
constexpr double kFarBeyond = 0.5 * kRightAngle;
constexpr double kMostDoubt = kRightAngle;
/// Moves of the points turn a circle's tangent by a few times reach over chord.
constexpr double kTurnPerReach = 4.0;
/// A chord this many times as long as those beside it stands alone.
constexpr double kAlone = 3.0;

class Parts {
 public:
  Parts(const SeriesChain& chain, const std::vector<double>& reach, const std::vector<bool>& given,
        bool loop)
      : chain_(chain), reach_(reach), given_(given), loop_(loop) {
    for (std::size_t e = 0; e < chain.elements.size(); ++e) {
      if (chain.source[e]) station_.push_back(e);
    }
  }

  Wandering run() {
    Wandering out;
    for (std::size_t k = 0; k + 1 < station_.size(); ++k) {
      if (given_[station_[k]] || given_[station_[k + 1]]) continue;
      const AngleRange asked = circles_over(k), taken = headings_over(k);
      if (asked.empty()) continue;
      WanderingPart part{station_[k], station_[k + 1], 0.0, taken.width()};
      part.beyond = std::max({0.0, asked.low - taken.low, taken.high - asked.high});
      if (part.beyond > std::min(asked.width(), kMostDoubt) + blur(k) + kFarBeyond) {
        out.senseless.push_back(part);
      } else if (part.turn > kRightAngle && stands_alone(k)) {
        out.guessed.push_back(part);
      }
    }
    return out;
  }

 private:
  /// Station `k` counted on beyond the ends of a loop; nothing beyond those of an open chain.
  [[nodiscard]] const Vec2* at(std::ptrdiff_t k) const {
    const auto turn = static_cast<std::ptrdiff_t>(station_.size()) - 1;
    if (loop_ && turn > 0) k = (k % turn + turn) % turn;
    if (k < 0 || k > turn) return nullptr;
    return &chain_.elements[station_[static_cast<std::size_t>(k)]].point;
  }

  [[nodiscard]] double chord(std::ptrdiff_t k) const {
    const Vec2 *a = at(k), *b = at(k + 1);
    return a != nullptr && b != nullptr ? norm(*b - *a) : std::numeric_limits<double>::infinity();
  }

  /// Headings at both ends of the chord of all circles through three neighbouring points that pass
  /// them, against the chord.
  [[nodiscard]] AngleRange circles_over(std::size_t part) const {
    const auto k = static_cast<std::ptrdiff_t>(part);
    const Vec2 *z = at(k - 2), *a = at(k - 1), *b = at(k), *c = at(k + 1), *d = at(k + 2),
               *e = at(k + 3);
    const Vec2 over = *c - *b;
    AngleRange out;
    const auto both_ways = [&](double inscribed) {
      out.take(inscribed);
      out.take(-inscribed);
    };
    if (a != nullptr && z != nullptr) {
      out.take(turning(over, *b - *a) + turning(*a - *z, *b - *z));
    }
    if (a != nullptr) both_ways(turning(*b - *a, *c - *a));
    if (d != nullptr) both_ways(turning(*d - *b, *d - *c));
    if (d != nullptr && e != nullptr) {
      out.take(turning(over, *d - *c) - turning(*e - *c, *e - *d));
    }
    return out;
  }

  /// Headings of the elements over a part, against its chord; a link turns by beta - alpha.
  [[nodiscard]] AngleRange headings_over(std::size_t part) const {
    const std::size_t first = station_[part], last = station_[part + 1];
    const Element& begin = chain_.elements[first];
    double heading = turning(chain_.elements[last].point - begin.point, unit_at(begin.theta));
    AngleRange out;
    out.take(heading);
    for (std::size_t i = first; i < last; ++i) {
      heading += chain_.links[i].beta - chain_.links[i].alpha;
      out.take(heading);
    }
    return out;
  }

  [[nodiscard]] double blur(std::size_t part) const {
    const auto k = static_cast<std::ptrdiff_t>(part);
    const double reach = std::max(reach_[station_[part]], reach_[station_[part + 1]]);
    return kTurnPerReach * reach / std::min({chord(k - 1), chord(k), chord(k + 1)});
  }

  /// A whole circle has one station, and no chord.
  [[nodiscard]] bool stands_alone(std::size_t part) const {
    const auto k = static_cast<std::ptrdiff_t>(part);
    return chord(k) > 0.0 && chord(k) >= kAlone * std::max(chord(k - 1), chord(k + 1));
  }

  const SeriesChain& chain_;
  const std::vector<double>& reach_;
  const std::vector<bool>& given_;
  bool loop_;
  std::vector<std::size_t> station_;
};

}  // namespace

Wandering find_wandering(const SeriesChain& chain, const std::vector<double>& reach,
                         const std::vector<bool>& given, bool loop) {
  return Parts(chain, reach, given, loop).run();
}

std::vector<double> calm_headings(Vec2 before, Vec2 at, Vec2 after) {
  const double in = std::atan2((at - before).y, (at - before).x);
  const double whole = turning(at - before, after - at);
  const double circle = turning(before - after, at - after);  // half of the arc before
  std::vector<double> out = {in + circle};
  for (const double part : {0.5, 0.25}) {
    out.push_back(in + part * circle);
    out.push_back(in + whole - part * (whole - circle));
  }
  return out;
}

}  // namespace obvid::pipeline_detail
