// SPDX-License-Identifier: Apache-2.0
#include "obvid/alignment/internal/borne_grades.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace obvid {

BorneGrades::BorneGrades(std::vector<Vec2> heights, std::vector<double> tolerance, double lap)
    : heights_(std::move(heights)), tolerance_(std::move(tolerance)), lap_(lap) {
  if (lap == 0.0) return;
  const std::vector<Vec2> once = std::exchange(heights_, {});
  const std::vector<double> of_once = std::exchange(tolerance_, {});
  for (const double shift : {-lap, 0.0, lap}) {
    for (const Vec2 at : once) heights_.push_back({at.x + shift, at.y});
    tolerance_.insert(tolerance_.end(), of_once.begin(), of_once.end());
  }
}

ValueRange BorneGrades::at(double station) const {
  constexpr std::size_t kChordsBeside = 2;  // chords on either side
  if (lap_ > 0.0) {                         // in the middle one
    const double begin = heights_.front().x + lap_;
    station -= lap_ * std::floor((station - begin) / lap_);
  }
  const auto next = std::upper_bound(heights_.begin(), heights_.end(), station,
                                     [](double s, const Vec2& at) { return s < at.x; });
  const auto behind = static_cast<std::size_t>(next - heights_.begin());
  const std::size_t first = behind > kChordsBeside ? behind - 1 - kChordsBeside : 0;
  const std::size_t last = std::min(behind + kChordsBeside, heights_.size() - 1);
  ValueRange out{HUGE_VAL, -HUGE_VAL};
  for (std::size_t k = first; k < last; ++k) {
    const Vec2 chord = heights_[k + 1] - heights_[k];
    const double moved = tolerance_[k] + tolerance_[k + 1];
    out.low = std::min(out.low, (chord.y - moved) / chord.x);
    out.high = std::max(out.high, (chord.y + moved) / chord.x);
  }
  return out;
}

std::vector<UnborneGrade> unborne_grades(const VerticalProfile& profile, const BorneGrades& borne) {
  constexpr double kOfGrades = 1e-4;  // of the range of grades, and of a grade: as five digits tell
  std::vector<UnborneGrade> out;
  const auto look = [&](double station, double grade) {
    const ValueRange there = borne.at(station);
    const double slack = kOfGrades * (there.high - there.low + std::abs(grade));
    if (grade < there.low - slack || grade > there.high + slack) {
      out.push_back({station, grade, there});
    }
  };
  for (const ProfileElement& e : profile.elements) look(e.station, e.grade0);
  look(profile.end_station, profile.elements.back().grade1);
  return out;
}

}  // namespace obvid
