// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/curve/internal/contour_path.h"
#include "obvid/surface_builders/internal/skin.h"

namespace obvid {

/// A stretch of all sections between two matched corners: arc lengths of matched places.
struct MatchedStretch {
  /// [section][mark], ascending (not always strictly); empty for sections that are a point.
  std::vector<std::vector<double>> marks;
  /// Common parameters of the marks, 0 to 1: the mean of the sections' shares of arc length.
  std::vector<double> at;
};

struct Matched {
  std::vector<MatchedStretch> stretches;
  SkinMatching matching = SkinMatching::kByPoints;
  std::vector<std::string> warnings;
};

/// A section with its contour by arc length; no path where the section is a point.
struct MeasuredSection {
  const SkinSection* section = nullptr;
  std::optional<ContourPath> path;
  std::vector<double> point_at;  ///< arc length of each point of the section
};

/// E402 where the contour has a cusp.
[[nodiscard]] Result<MeasuredSection> measured(const SkinSection& section);

/// Arc lengths of the corners inside a section, which is no point.
[[nodiscard]] std::vector<double> corners_of(const MeasuredSection& section);

[[nodiscard]] Result<Matched> matched(const std::vector<MeasuredSection>& sections,
                                      SkinMatching matching, const RunContext& run);

}  // namespace obvid
