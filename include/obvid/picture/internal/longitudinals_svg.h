// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace obvid {

/// Normal curvature along a line of a surface.
struct LineCurvature {
  std::vector<double> s;    ///< arc length from where the line begins, units; ascending
  std::vector<double> k;    ///< 1/unit
  std::size_t changes = 0;  ///< of the sign
};

/// A line u = const of a patch, across its sections.
struct Longitudinal {
  std::string name;
  LineCurvature now;
  std::optional<LineCurvature> before{};  ///< of the exact skin, where there is another
  std::vector<double> sections{};         ///< where the line crosses them, units of arc length
};

struct LongitudinalsPicture {
  std::string title;
  std::string units;
  bool of_sections = false;  ///< ticks are sections; else knots
  std::vector<Longitudinal> lines;
};

/// A plot for each line, one below the other, as one self-contained SVG file in the viewer's light
/// or dark scheme.
[[nodiscard]] std::string longitudinals_svg(const LongitudinalsPicture& picture);

}  // namespace obvid
