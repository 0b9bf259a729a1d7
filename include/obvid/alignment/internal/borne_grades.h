// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <vector>

#include "obvid/alignment/profile.h"
#include "obvid/geom/internal/value_range.h"
#include "obvid/geom/vec2.h"

namespace obvid {

/// What heights say of grades: those at a station are the chord there and two on either side, each
/// end of them moved by its tolerance.
class BorneGrades {
 public:
  /// Ascending stations, at least two; one tolerance each. `lap`: length of a loop, around which
  /// the heights go once; 0: not closed.
  BorneGrades(std::vector<Vec2> heights, std::vector<double> tolerance, double lap);

  [[nodiscard]] ValueRange at(double station) const;

 private:
  std::vector<Vec2> heights_;  ///< of a loop three laps
  std::vector<double> tolerance_;
  double lap_ = 0.0;
};

/// A grade of a profile that no height bears, and what those there bear.
struct UnborneGrade {
  double station = 0.0, grade = 0.0;
  ValueRange borne;
};

/// Joints and ends where a profile is steeper than the heights there bear: humps between heights
/// that do not show them. Grades between joints lie between those of the joints.
[[nodiscard]] std::vector<UnborneGrade> unborne_grades(const VerticalProfile& profile,
                                                       const BorneGrades& borne);

}  // namespace obvid
