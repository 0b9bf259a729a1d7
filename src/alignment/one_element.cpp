// SPDX-License-Identifier: Apache-2.0
#include "one_element.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "small_program.h"
#include "winding.h"

namespace obvid::alignment {
namespace {

constexpr int kPrograms = 12;          ///< one after the other, at most
constexpr double kNoGain = 1e-9;       ///< of the tolerance: less ends them
constexpr double kFarthestMove = 1e3;  ///< of an unknown in one of them, in tolerances
constexpr double kLooked = 2.0;        ///< tolerances off after least squares: no minimax is near
constexpr double kNearlyStraight = 1e-6;  ///< rad of turn, below which series are exact

/// How a place at `s` of an element moves across it as its start moves across, turns, and its
/// curvature changes by 1.
struct Sways {
  double moved, turned, bent;
};

Sways sways_at(Plane plane, double kappa, double s) {
  const double turn = kappa * s;
  if (plane == Plane::kGraph || std::abs(turn) < kNearlyStraight) return {1.0, s, 0.5 * s * s};
  const double half = std::sin(0.5 * turn);
  return {std::cos(turn), std::sin(turn) / kappa, 2.0 * half * half / (kappa * kappa)};
}

/// An element that is moved until its largest offset over its tolerance is least.
class Evened {
 public:
  Evened(Plane plane, const std::vector<Vec2>& points, const std::vector<double>& tolerance,
         bool bends)
      : points_(points), tolerance_(tolerance), bends_(bends) {
    chain_.plane = plane;
    chain_.start = points.front();
    const Vec2 chord = points.back() - points.front();
    chain_.theta = plane == Plane::kMap ? heading(chord) : chord.y / chord.x;
    double s = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0) {
        const Vec2 step = points[i] - points[i - 1];
        s += plane == Plane::kMap ? norm(step) : step.x;
      }
      feet_.push_back({0, s, 0.0, 0.0});
    }
    chain_.length = {s};
    chain_.law = {Transition::kClothoid};
    chain_.ends = {{Chain::kStraight, Chain::kStraight}};
    if (bends) {
      chain_.ends = {{0, 0}};
      chain_.kappa = {0.0};
      begin_as_arc();
    }
  }

  /// The largest offset over its tolerance that is left.
  double run() {
    double least = fit_chain(chain_, points_, tolerance_, feet_, {}).largest;
    for (int k = 0; k < kPrograms && least < kLooked; ++k) {
      const auto before = std::pair(chain_, feet_);
      if (!move()) break;
      find_feet(chain_, points_, feet_);
      const double now = largest();
      if (now < least) {
        const double gain = least - now;
        least = now;
        if (gain > kNoGain) continue;
        break;
      }
      std::tie(chain_, feet_) = before;
      break;
    }
    return least;
  }

  /// From the foot of the first point to that of the last one; nothing where there is no way.
  std::optional<FoundChain> found() {
    const double before = feet_.front().s, length = feet_.back().s - before;
    if (!(length > 0.0)) return std::nullopt;
    const double kappa = chain_.curvature(0, 0);
    chain_.start = chain_.start + step_along(chain_.plane, chain_.theta, kappa, kappa, before);
    chain_.theta += kappa * before;
    chain_.length = {length};
    for (Foot& foot : feet_) foot.s -= before;
    FoundChain out;
    out.chain = chain_;
    out.feet = feet_;
    return out;
  }

 private:
  /// Through the first point, the last one and one half way.
  void begin_as_arc() {
    const Vec2 a = points_.front(), b = points_.back();
    const auto middle =
        std::min_element(feet_.begin(), feet_.end(), [&](const Foot& p, const Foot& q) {
          const double half = 0.5 * chain_.length.front();
          return std::abs(p.s - half) < std::abs(q.s - half);
        });
    const Vec2 c = points_[static_cast<std::size_t>(middle - feet_.begin())];
    if (chain_.plane == Plane::kGraph) {
      const double g = (c.y - a.y) / (c.x - a.x), h = (b.y - a.y) / (b.x - a.x);
      const double kappa = 2.0 * (h - g) / (b.x - c.x);
      if (!std::isfinite(kappa)) return;
      chain_.kappa = {kappa};
      chain_.theta = h - 0.5 * kappa * (b.x - a.x);
      return;
    }
    const double sides = norm(c - a) * norm(b - c) * norm(b - a);
    const double kappa = 2.0 * cross(c - a, b - c) / sides;
    if (!std::isfinite(kappa)) return;
    chain_.kappa = {kappa};
    chain_.theta -= 0.5 * kappa * chain_.length.front();
  }

  [[nodiscard]] double largest() const {
    double out = 0.0;
    for (std::size_t i = 0; i < feet_.size(); ++i) {
      out = std::max(out, std::abs(feet_[i].offset) / tolerance_[i]);
    }
    return out;
  }

  /// To where the largest offset is least to first order; false: nowhere.
  bool move() {
    const double unit = *std::max_element(tolerance_.begin(), tolerance_.end());
    const double length = chain_.length.front(), kappa = chain_.curvature(0, 0);
    program_.clear();
    for (std::size_t i = 0; i < feet_.size(); ++i) {
      const Sways at = sways_at(chain_.plane, kappa, feet_[i].s);
      const double by = unit / tolerance_[i];
      for (const double sign : {1.0, -1.0}) {
        HalfSpace row;
        row.a = {-sign * by * at.moved, -sign * by * at.turned / length,
                 bends_ ? -sign * by * at.bent / (length * length) : 0.0, -1.0};
        row.b = -sign * feet_[i].offset / tolerance_[i];
        double size = 1.0;
        for (const double a : row.a) size = std::max(size, std::abs(a));
        for (double& a : row.a) a /= size;
        row.b /= size;
        program_.add(row);
      }
    }
    program_.shuffle();
    const auto x = program_.maximum({0.0, 0.0, 0.0, -1.0}, kFarthestMove);
    if (!x) return false;
    chain_.start = chain_.start + unit * (*x)[0] * sideways(chain_.plane, chain_.theta);
    chain_.theta += unit * (*x)[1] / length;
    if (bends_) chain_.kappa.front() += unit * (*x)[2] / (length * length);
    return true;
  }

  const std::vector<Vec2>& points_;
  const std::vector<double>& tolerance_;
  bool bends_ = false;
  Chain chain_;
  std::vector<Foot> feet_;
  SmallProgram program_;
};

}  // namespace

std::optional<FoundChain> one_element(Plane plane, const std::vector<Vec2>& points,
                                      const std::vector<double>& tolerance,
                                      double largest_curvature) {
  for (const bool bends : {false, true}) {
    if (points.size() < (bends ? 4 : 2)) continue;
    Evened element(plane, points, tolerance, bends);
    if (!(element.run() <= 1.0)) continue;
    auto out = element.found();
    if (!out || std::abs(out->chain.curvature(0, 0)) > largest_curvature) continue;
    const PointRow row{points, tolerance};
    const bool winds = plane == Plane::kMap &&
                       windings(out->chain, row, out->feet, 0, row.intervals(), kRefoundTurn) > 0;
    if (!winds) return out;
  }
  return std::nullopt;
}

}  // namespace obvid::alignment
