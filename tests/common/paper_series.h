// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "obvid/geom/element.h"
#include "obvid/region/internal/convex_triangle.h"
#include "obvid/region/internal/curvature_chains.h"
#include "obvid/region/internal/segment_region.h"
#include "obvid/series/analysis.h"

namespace obvid::paper {

/// Columns of a table of numbers in tests/data/paper; "nan" where nothing is printed.
inline std::vector<std::vector<double>> read_columns(const std::string& name) {
  std::ifstream file(std::string(OBVID_TEST_DATA) + "/paper/" + name);
  std::vector<std::vector<double>> columns;
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream fields(line);
    std::string field;
    for (std::size_t c = 0; fields >> field; ++c) {
      if (columns.size() <= c) columns.emplace_back();
      columns[c].push_back(std::stod(field));
    }
  }
  EXPECT_FALSE(columns.empty()) << name;
  return columns;
}

inline std::vector<Vec2> read_point_columns(const std::string& name) {
  const auto columns = read_columns(name);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < columns.at(0).size(); ++i) {
    points.push_back({columns[0][i], columns.at(1)[i]});
  }
  return points;
}

/// What the tables print of one segment, by the library.
struct Segment {
  double chord = 0.0;
  double to_apex = 0.0;
  double from_apex = 0.0;
  double lower_middle = 0.0;    ///< lower boundary above the middle of the chord
  double upper_middle = 0.0;    ///< upper boundary there
  double lower_parallel = 0.0;  ///< line parallel to the chord that touches the lower boundary
  double width_parallel = 0.0;  ///< between both such lines
  ChordFrame frame;             ///< with the end circles of the region
};

/// Height of a boundary above the middle of the chord. A first circle of radius 0 leaves the second
/// arc alone, which then spans the whole chord.
inline double above_middle(const ChordFrame& frame, const Boundary& b) {
  if (std::isinf(b.kappa_first)) return std::abs(sagitta(b.kappa_second, frame.h));
  return std::abs(boundary_ordinate(frame, b, 0.5 * frame.h).value_or(std::nan("")));
}

/// Regions of the tangents alone along a convex series whose radii grow while it turns right, as
/// all series of the papers do: signed curvature increases from minus infinity to zero.
inline std::vector<Segment> segments_of(const std::vector<Element>& elements) {
  const auto ranges = curvature_chains(elements, 1, true, -1);
  std::vector<Segment> segments;
  for (std::size_t i = 0; i + 1 < elements.size(); ++i) {
    Element a = elements[i], b = elements[i + 1];
    a.kappa = ranges[i].low;
    b.kappa = ranges[i + 1].high;
    Segment s;
    s.frame = chord_frame(a, b);
    s.chord = s.frame.h;
    if (const auto t = tangent_triangle(a.point, unit_at(a.theta), b.point, unit_at(b.theta))) {
      s.to_apex = t->to_apex;
      s.from_apex = t->from_apex;
    }
    if (const auto region = segment_region(s.frame, 1)) {
      s.lower_middle = above_middle(s.frame, region->from_start);
      s.upper_middle = above_middle(s.frame, region->to_end);
      s.lower_parallel = region->lower_height;
      s.width_parallel = region->parallel_width;
    }
    segments.push_back(s);
  }
  return segments;
}

/// Headings from the printed sides of the triangles; the two that meet at a point are averaged.
inline std::vector<double> headings_from_sides(const std::vector<Vec2>& points,
                                               const std::vector<double>& to_apex,
                                               const std::vector<double>& from_apex) {
  const auto chords = measure_chords(points);
  const std::size_t n = points.size();
  std::vector<double> sum(n), count(n);
  const auto corner = [](double next, double other, double opposite) {
    return std::acos((next * next + other * other - opposite * opposite) / (2.0 * next * other));
  };
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double h = chords[i].length, p = to_apex[i], q = from_apex[i];
    sum[i] += chords[i].omega + corner(h, p, q);
    sum[i + 1] += chords[i].omega - corner(h, q, p);
    count[i] += 1.0;
    count[i + 1] += 1.0;
  }
  for (std::size_t i = 0; i < n; ++i) sum[i] /= count[i];
  return sum;
}

}  // namespace obvid::paper
