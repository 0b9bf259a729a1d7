// SPDX-License-Identifier: Apache-2.0
// A contour file (docs/formats.md) as it stands.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "json_text.h"
#include "pieces.h"

namespace judge {

struct FileElement {
  Point point;
  double heading = 0.0, kappa = 0.0;
  std::optional<std::size_t> source;
  bool corner = false;
  bool step = false;  ///< a common tangent, and two curvatures
  [[nodiscard]] bool parted() const { return corner || step; }
  bool slope_step = false;  ///< of a G3 contour: G2 only
  /// Of a corner that stands on no point: the points before and behind it.
  std::optional<std::pair<std::size_t, std::size_t>> between;
  double heading_out = 0.0, kappa_out = 0.0;
};

struct FileRun {
  std::size_t first = 0, last = 0;
  int direction = 0;
};

struct FileSpline {
  int degree = 0;
  std::vector<double> knots, weights;
  std::vector<Point> points;
};

struct ContourFile {
  std::string units, carrier;
  std::string continuity;    ///< G2, G3
  std::string units_source;  ///< file, given, assumed
  bool closed = false;
  std::vector<Point> points;
  std::vector<double> tolerance;  ///< empty: points are met exactly
  std::vector<FileElement> elements;
  std::vector<Piece> pieces;
  std::vector<FileRun> runs;
  std::optional<FileSpline> spline;
  Json report, certificate;
  Json given;  ///< what the user fixed; null where the file has no such list

  /// Somebody said what a unit is.
  [[nodiscard]] bool unit_known() const { return units_source != "assumed"; }
  /// What stands behind lengths in texts.
  [[nodiscard]] std::string printed_unit() const { return unit_known() ? units : "units"; }

  /// Joint that stands between piece i - 1 and piece i; nullptr past an end.
  [[nodiscard]] const FileElement* joint(std::size_t i) const;
  [[nodiscard]] bool corner_at(std::size_t joint_index) const;
  [[nodiscard]] bool slope_step_at(std::size_t joint_index) const;
  /// A corner, or a step of the curvature.
  [[nodiscard]] bool parted_at(std::size_t joint_index) const;
  [[nodiscard]] bool promises_monotone() const {
    return carrier != "cubic" && carrier != "baseline" && carrier != "imported";
  }
  /// By its own flags and figures: what its carrier promises, and the tolerance of the width. `fit`
  /// and `verify` end with 0 if and only if it does.
  [[nodiscard]] bool keeps_promise() const;
  [[nodiscard]] bool too_wide() const;
};

struct ReadContour {
  ContourFile contour;
  std::string fault;  ///< empty: the file can be read
};
ReadContour read_contour(const std::string& text);
ReadContour read_contour(const Json& json);

}  // namespace judge
