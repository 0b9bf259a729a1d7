// SPDX-License-Identifier: Apache-2.0
#include "cut_time.h"

#include <algorithm>
#include <cmath>

namespace obvid::cutting {
namespace {

/// A stretch that is run at one speed at most.
struct Stretch {
  double length = 0.0, most = 0.0;  ///< most: length/s
  double begin = 0.0, end = 0.0;    ///< headings, rad
};

/// From speed `a` to speed `b`, at most `most` between them.
double seconds_along(double length, double a, double b, double most, double acceleration) {
  const double peak_square = 0.5 * (a * a + b * b) + acceleration * length;
  const double peak = std::min(most, std::sqrt(peak_square));
  const double ramps = (2.0 * peak * peak - a * a - b * b) / (2.0 * acceleration);
  return (2.0 * peak - a - b) / acceleration + std::max(0.0, length - ramps) / peak;
}

class Estimate {
 public:
  explicit Estimate(const TimeRules& rules) : rules_(rules) {}

  double run(const std::vector<CutBlock>& blocks) {
    Vec2 at{};
    double z = 0.0;
    for (const CutBlock& block : blocks) {
      using enum CutBlock::Kind;
      if (block.kind != kCut) finish();
      switch (block.kind) {
        case kRapidAcross:
          alone(norm(block.to - at), rules_.rapid_feed);
          at = block.to;
          break;
        case kRapidLevel:
          alone(std::abs(block.z - z), rules_.rapid_feed);
          z = block.z;
          break;
        case kDown:
          alone(std::abs(block.z - z), block.feed);
          z = block.z;
          break;
        case kDwell:
          seconds_ += rules_.pierce_seconds;
          break;
        case kOn:
        case kOff:
          break;
        case kCut:
          row_.push_back({std::hypot(length_of(block.piece), block.z - z), block.feed / kMinute,
                          heading_at_start(block.piece), heading_at_end(block.piece)});
          at = end_point(block.piece);
          z = block.z;
      }
    }
    finish();
    return seconds_;
  }

 private:
  static constexpr double kMinute = 60.0;

  void alone(double length, double feed) {
    if (length > 0.0) {
      seconds_ += seconds_along(length, 0.0, 0.0, feed / kMinute, rules_.acceleration);
    }
  }

  [[nodiscard]] double corner_speed(const Stretch& a, const Stretch& b) const {
    const double half = 0.5 * std::abs(std::remainder(b.begin - a.end, 2.0 * std::acos(-1.0)));
    const double most = std::min(a.most, b.most);
    // the circle of radius r that leaves a corner of the turn 2 h free by d: r = d cos h / (1 - cos
    // h)
    const double rest = 1.0 - std::cos(half);
    if (rest <= 0.0) return most;
    return std::min(most, std::sqrt(rules_.acceleration * rules_.corner * std::cos(half) / rest));
  }

  void finish() {
    if (row_.empty()) return;
    std::vector<double> speed(row_.size() + 1);
    const double two_a = 2.0 * rules_.acceleration;
    for (std::size_t i = 1; i < row_.size(); ++i) {
      speed[i] = std::min(corner_speed(row_[i - 1], row_[i]),
                          std::sqrt(speed[i - 1] * speed[i - 1] + two_a * row_[i - 1].length));
    }
    for (std::size_t i = row_.size(); i-- > 0;) {
      speed[i] =
          std::min(speed[i], std::sqrt(speed[i + 1] * speed[i + 1] + two_a * row_[i].length));
    }
    for (std::size_t i = 0; i < row_.size(); ++i) {
      if (!(row_[i].length > 0.0)) continue;
      seconds_ +=
          seconds_along(row_[i].length, speed[i], speed[i + 1], row_[i].most, rules_.acceleration);
    }
    row_.clear();
  }

  const TimeRules& rules_;
  double seconds_ = 0.0;
  std::vector<Stretch> row_;
};

}  // namespace

double seconds_of(const std::vector<CutBlock>& blocks, const TimeRules& rules) {
  return Estimate(rules).run(blocks);
}

}  // namespace obvid::cutting
