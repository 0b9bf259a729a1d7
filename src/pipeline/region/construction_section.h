// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/pieces.h"
#include "obvid/geom/element.h"
#include "obvid/pipeline/region_table.h"

namespace obvid::pipeline_detail {

constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();

/// Rows of a part between corners or ends, one behind the other, as constructions go along them.
struct ConstructionSection {
  const RegionPart* part = nullptr;
  std::size_t first = 0, last = 0;  ///< rows; `last` is the one behind
  bool loop = false;                ///< the last point is the first one again

  [[nodiscard]] const RegionRow& row(std::size_t k) const { return part->rows[k]; }
  [[nodiscard]] const RegionPoint& point(std::size_t i) const { return part->points[i]; }
  [[nodiscard]] std::size_t first_point() const { return row(first).from; }
  [[nodiscard]] std::size_t points() const { return last - first + 1; }

  /// With the headings of the table and the curvatures that were taken.
  [[nodiscard]] Element start_of(std::size_t k) const;
  [[nodiscard]] Element end_of(std::size_t k) const;
  /// With the curvatures that bound the region of the row, which must have one.
  [[nodiscard]] std::pair<Element, Element> bounded(std::size_t k) const;

  [[nodiscard]] std::string segment(std::size_t k) const;  ///< "points 3 to 4"
  /// E401, naming the segment: it has no region.
  [[nodiscard]] Error no_region(std::size_t k) const;
};

[[nodiscard]] std::vector<ConstructionSection> sections_of(const RegionPart& part);

/// One curvature for each point of a section, between which curves go one way along every segment:
/// from point to point as `wanted` (empty: nothing is), else in the middle of what is left.
/// Error E401 where a segment has no region.
[[nodiscard]] Result<std::vector<double>> common_curvatures(
    const ConstructionSection& section, const std::vector<std::optional<double>>& wanted = {});

/// Spirals with monotone curvature from one element to the other. Errors: E401, E501.
[[nodiscard]] Result<std::vector<Piece>> spirals_between(const Element& start, const Element& end,
                                                         int direction);

/// Where the spiral between two elements has no curvature; they have curvatures of different signs,
/// or one of them has none. Errors as `spirals_between`.
[[nodiscard]] Result<Element> inflection_between(const Element& start, const Element& end,
                                                 int direction);

/// Whether a curvature is as good as none over a chord: within the rounding of coordinates.
[[nodiscard]] bool is_straight(double kappa, double chord);

void put_piece(ConstructionTable& table, std::size_t row, Piece piece);
void add_row(ConstructionTable& table, std::size_t row, std::vector<double> values,
             std::string remark);

/// Conics of [003] over the sections.
[[nodiscard]] Result<ConstructionTable> ellipse_arcs(
    const std::vector<ConstructionSection>& sections);

/// Condensed triangles of [001] over the sections; `fixation` as RegionJob has it.
[[nodiscard]] Result<ConstructionTable> condensed_triangles(
    const std::vector<ConstructionSection>& sections, std::optional<int> fixation);

}  // namespace obvid::pipeline_detail
