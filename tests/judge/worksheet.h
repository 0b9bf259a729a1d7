// SPDX-License-Identifier: Apache-2.0
// The worksheet of `region` as its JSON gives it, and what its points and headings say.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "input.h"
#include "json_text.h"
#include "region.h"

namespace judge {

/// Curvatures or headings between two ends; infinite where there is none.
struct Limits {
  Real low = -HUGE_VALL, high = HUGE_VALL;

  [[nodiscard]] bool empty() const { return !(low <= high); }
};

struct SheetPoint {
  Point stored;
  Vec point;  ///< seen from the first one of the table
  std::size_t index = 0, inserted = 0;
  Real heading = 0.0L;
  bool heading_given = false, curvature_given = false;
  std::optional<double> adjacent_kappa;
  std::optional<Limits> headings, kappas;  ///< none: not known
  bool low_is_open = false, high_is_open = false;

  [[nodiscard]] std::string name() const;
};

struct SheetRow {
  std::size_t from = 0, to = 0;
  std::optional<Limits> start, end;  ///< of the curvature at both points
  const Json* figures = nullptr;
};

/// Sums of two angles that rounding makes, rad.
constexpr Real kRoundedBending = 1e-13L;

/// One of the two tables.
struct SheetPart {
  std::vector<SheetPoint> points;
  std::vector<SheetRow> rows;
  std::vector<double> kappas;  ///< of the elements, of the points that were given alone
  Point origin;
  Real coordinate = 0.0L;  ///< the largest one
  bool loop = false;       ///< the last point is the first one again, without a corner

  /// From one point to the other, as exact as they are written, however far from the first one.
  [[nodiscard]] Vec chord(std::size_t from, std::size_t to) const {
    return seen(points[to].stored, points[from].stored);
  }
  [[nodiscard]] Vec chord(const SheetRow& row) const { return chord(row.from, row.to); }
  [[nodiscard]] std::string name(const SheetRow& row) const {
    return points[row.from].name() + "-" + points[row.to].name();
  }
  /// Whether a segment has a point at one end; around a loop its first and last are the same.
  [[nodiscard]] bool touches(const SheetRow& row, std::size_t i) const {
    const std::size_t last = points.size() - 1;
    const std::size_t other = !loop ? i : i == 0 ? last : i == last ? 0 : i;
    return row.from == i || row.to == i || row.from == other || row.to == other;
  }
  /// 1, -1, 0 on an arc; none where a vertex lies between the points, or nothing is known.
  [[nodiscard]] std::optional<int> direction(const SheetRow& row) const;
  [[nodiscard]] Real bending(const SheetRow& row) const;
  /// The region over a segment: its curvatures those given, else the ends of the ranges.
  [[nodiscard]] std::optional<Region> region(const SheetRow& row, const Input& input) const;
  /// With those curvatures.
  [[nodiscard]] std::array<Element, 2> bounding(const SheetRow& row, const Input& input) const;
  /// First row of the section that a row belongs to, and the one behind its last.
  [[nodiscard]] std::array<std::size_t, 2> section(std::size_t row) const;
};

struct Worksheet {
  Json json;
  SheetPart user;
  std::optional<SheetPart> refined;
  std::string fault;  ///< empty: it could be read

  [[nodiscard]] const SheetPart& last() const { return refined ? *refined : user; }
};
/// `json` must stay where it is.
void read_worksheet(const std::string& text, Worksheet& sheet);

/// Ranges of curvature that the points and headings of a table leave, by the condition for one
/// biarc from link to link, out and back (docs/methods/judge.md). None where something contradicts.
/// `ways`: directions of rows that have none in the file.
std::vector<std::optional<Limits>> curvature_ranges(const SheetPart& part, const Input& input,
                                                    Real turned,
                                                    const std::map<std::size_t, int>& ways = {});

/// The C2 cubic through points, parameter the summed chords, not-a-knot at both ends: its pieces.
std::vector<Span> cubic_through(const std::vector<Vec>& points);

}  // namespace judge
