// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/gcode/motion_time.h"

#include <algorithm>
#include <cmath>

#include "obvid/core/internal/inch.h"

namespace obvid::exchange {
namespace {

constexpr double kUsualAcceleration = 500.0;  // mm/s^2

/// From speed `a` to speed `b`, at most `most` between them.
double seconds_along(double length, double a, double b, double most, double acceleration) {
  const double peak_square = 0.5 * (a * a + b * b) + acceleration * length;
  const double peak = std::min(most, std::sqrt(peak_square));
  const double ramps = (2.0 * peak * peak - a * a - b * b) / (2.0 * acceleration);
  return (2.0 * peak - a - b) / acceleration + std::max(0.0, length - ramps) / peak;
}

}  // namespace

double machine_acceleration(std::optional<double> given, bool inches) {
  return given.value_or(kUsualAcceleration) / (inches ? kMmPerInch : 1.0);
}

// The circle of radius r that leaves a corner of the turn 2 h free by d: r = d cos h / (1 - cos h).
double MotionTime::corner_speed(Vec3 arriving, Vec3 leaving, double most) const {
  const double sine = 0.5 * norm(leaving - arriving), cosine = 0.5 * norm(leaving + arriving);
  const double rest = sine * sine / (1.0 + cosine);  // 1 - cos h
  if (rest <= 0.0) return most;
  return std::min(most, std::sqrt(rules_.acceleration * rules_.corner * cosine / rest));
}

void MotionTime::goes_on(double length, double feed, Vec3 begin, Vec3 end) {
  if (!(length > 0.0)) return;
  const double most = feed / kSecondsOfMinute;
  const double corner =
      row_.empty() ? 0.0 : corner_speed(heading_, begin, std::min(most, row_.back().most));
  row_.push_back({length, most, corner});
  heading_ = end;
}

void MotionTime::alone(double length, double feed) {
  stop();
  if (length > 0.0)
    seconds_ += seconds_along(length, 0.0, 0.0, feed / kSecondsOfMinute, rules_.acceleration);
}

void MotionTime::waits(double seconds) {
  stop();
  seconds_ += seconds;
}

double MotionTime::seconds() {
  stop();
  return seconds_;
}

void MotionTime::stop() {
  if (row_.empty()) return;
  std::vector<double> speed(row_.size() + 1);
  const double two_a = 2.0 * rules_.acceleration;
  for (std::size_t i = 1; i < row_.size(); ++i) {
    speed[i] = std::min(row_[i].corner,
                        std::sqrt(speed[i - 1] * speed[i - 1] + two_a * row_[i - 1].length));
  }
  for (std::size_t i = row_.size(); i-- > 0;) {
    speed[i] = std::min(speed[i], std::sqrt(speed[i + 1] * speed[i + 1] + two_a * row_[i].length));
  }
  for (std::size_t i = 0; i < row_.size(); ++i) {
    seconds_ +=
        seconds_along(row_[i].length, speed[i], speed[i + 1], row_[i].most, rules_.acceleration);
  }
  row_.clear();
}

}  // namespace obvid::exchange
