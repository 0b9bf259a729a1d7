// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/exchange/drawing.h"
#include "obvid/exchange/internal/geo/projection.h"

namespace obvid::exchange {

/// Places in the order of a file, not projected yet.
struct GeoSeries {
  std::string name;
  std::vector<GeoPoint> places;
  std::vector<std::string> warnings;
  SeriesKind kind = SeriesKind::kLine;
  std::vector<double> heights{};  ///< of the places, m: one each, or none
};

/// All series in one plane: metres around the middle of them all. Consecutive repetitions are
/// merged with a warning; series of one place are left out with one. Heights become those of the
/// points (`FixedData::height`), without a rounding: who measured them knows better. `drawing` gets
/// series and warnings. Errors: E304 when nothing is left, E309 when the places lie too far apart
/// for one plane.
Result<void> project_series(std::vector<GeoSeries> all, std::string_view name, Drawing& drawing);

/// Points of a file, in its own plane: half a unit of the last digit, repetitions merged.
[[nodiscard]] PointSeries plane_series(std::string name, Units units,
                                       const std::vector<Vec2>& points);

/// Half a unit of the last decimal of numbers as they read back shortest.
class LastDigit {
 public:
  void add(double value);
  [[nodiscard]] double half_unit() const;

 private:
  int decimals_ = 0;
};

}  // namespace obvid::exchange
