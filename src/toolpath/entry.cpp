// SPDX-License-Identifier: Apache-2.0
#include "entry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "obvid/core/units.h"
#include "passes.h"

namespace obvid::toolpath {
namespace {

constexpr double kRampDeg = 5.0;
constexpr double kMostTurns = 100.0;                          // of a helix
constexpr double kLeastCorners = 16.0, kMostCorners = 720.0;  // of a circle

/// Ways one after the other with what is over them, which falls evenly to 0.
class Way {
 public:
  Way(const Descent& descent, double length) : descent_(descent), length_(length) {}

  void go(Vec3 p) {
    if (!points_.empty()) gone_ += level_distance(last_, p);
    last_ = p;
    const double z = p.z + descent_.height * std::max(0.0, 1.0 - gone_ / length_);
    if (!points_.empty() && (z > descent_.ceiling) != (full_ > descent_.ceiling)) {
      const double part = (descent_.ceiling - full_) / (z - full_);
      points_.push_back(points_.back() + part * (Vec3{p.x, p.y, z} - points_.back()));
      points_.back().z = descent_.ceiling;
    }
    full_ = z;
    points_.push_back({p.x, p.y, std::min(z, descent_.ceiling)});
  }
  [[nodiscard]] std::vector<Vec3> down_to(Vec3 end) {
    points_.back() = end;  // but for rounding it is that
    return std::move(points_);
  }

 private:
  Descent descent_;
  double length_, gone_ = 0.0;
  double full_ = 0.0;  ///< height of the last place without a ceiling
  Vec3 last_;
  std::vector<Vec3> points_;
};

/// Length seen from above.
double length_from_above(const std::vector<Vec3>& way) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += level_distance(way[i - 1], way[i]);
  return length;
}

}  // namespace

std::optional<double> fall_of(const ToolpathOptions& options) {
  const double deg = asked_deg(options);
  if (!(deg > 0.0)) return std::nullopt;
  return std::tan(deg * kOneDegree);
}

double asked_deg(const ToolpathOptions& options) {
  const bool rough = options.strategy == ToolpathStrategy::kRough;
  if (!rough && !options.entry && !options.ramp_deg) return 0.0;
  return options.ramp_deg.value_or(kRampDeg);
}

Steepest steepest_of(const std::vector<Vec3>& way) {
  Steepest out;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double level = level_distance(way[i - 1], way[i]);
    const double fall = level > 0.0 ? (way[i - 1].z - way[i].z) / level : 0.0;
    if (fall > out.fall) out = {fall, way[i - 1]};
  }
  return out;
}

std::optional<double> legs_of_ramp(double length, double height, double fall) {
  const double legs = 2.0 * std::max(1.0, std::ceil(height / fall / (2.0 * length)));
  return legs <= kMostLegs ? std::optional(legs) : std::nullopt;
}

std::optional<std::vector<Vec3>> ramp_over(const std::vector<Vec3>& pass, const Descent& descent) {
  const double length = length_from_above(pass);
  const double total = descent.height / descent.fall;
  const auto legs = legs_of_ramp(length, descent.height, descent.fall);
  if (!legs) return std::nullopt;
  const double leg = std::min(length, total / *legs);
  std::vector<Vec3> there{pass.front()};
  double at = 0.0;
  for (std::size_t i = 1; i < pass.size() && at < leg; ++i) {
    const double step = level_distance(pass[i - 1], pass[i]);
    const double part = step > 0.0 ? std::min(1.0, (leg - at) / step) : 1.0;
    there.push_back(part < 1.0 ? pass[i - 1] + part * (pass[i] - pass[i - 1]) : pass[i]);
    at += step;
  }
  Way way(descent, total);
  for (double k = 0.0; k < *legs; k += 2.0) {
    for (const Vec3 p : there) way.go(p);
    for (std::size_t i = there.size() - 1; i-- > 1;) way.go(there[i]);
  }
  way.go(pass.front());
  return way.down_to(pass.front());
}

std::optional<std::vector<Vec3>> flattest_ramp_over(const std::vector<Vec3>& pass,
                                                    Descent descent) {
  constexpr double kRounding = 1e-12;  // so that the flattest has no two ways more
  const double length = length_from_above(pass);
  if (!(length > 0.0)) return std::nullopt;
  descent.fall = std::max(descent.fall, (1.0 + kRounding) * descent.height / (kMostLegs * length));
  return ramp_over(pass, descent);
}

std::optional<Helix> helix_over(const std::vector<Vec3>& ring, const Descent& descent,
                                double least_turns) {
  const double length = length_from_above(ring);
  const double turns = std::max(least_turns, std::ceil(descent.height / (descent.fall * length)));
  if (!(turns <= kMostTurns)) return std::nullopt;
  Way way(descent, turns * length);
  for (double k = 0.0; k < turns; ++k) {
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) way.go(ring[i]);
  }
  way.go(ring.front());
  return Helix{way.down_to(ring.front()), turns};
}

std::vector<Vec2> circle_from(Vec2 start, Vec2 along, double side, double radius, double within) {
  const double half = std::acos(std::max(0.0, 1.0 - within / radius));  // of a chord
  const double corners =
      std::clamp(std::ceil(std::numbers::pi / half), kLeastCorners, kMostCorners);
  const Vec2 out = -side * left_normal(along);  // from the centre to the start
  const Vec2 centre = start - radius * out;
  std::vector<Vec2> ring{start};
  for (double k = 1.0; k < corners; ++k) {
    const double turn = kFullTurn * k / corners;
    ring.push_back(centre + radius * (std::cos(turn) * out + std::sin(turn) * along));
  }
  ring.push_back(start);
  return ring;
}

}  // namespace obvid::toolpath
