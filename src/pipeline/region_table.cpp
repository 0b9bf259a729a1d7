// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/region_table.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "form.h"
#include "obvid/region/curvature_chains.h"
#include "obvid/region/segment_region.h"
#include "obvid/series/analysis.h"

namespace obvid {
namespace {

struct Span {
  std::size_t first, last;  // elements
  int direction;
};

std::vector<Span> spans_of(const SeriesChain& chain) {
  std::vector<Span> spans;
  for (std::size_t i = 0; i < chain.direction.size(); ++i) {
    if (!spans.empty() && spans.back().direction == chain.direction[i]) {
      spans.back().last = i + 1;
    } else {
      spans.push_back({i, i + 1, chain.direction[i]});
    }
  }
  return spans;
}

/// Ordinate over the middle of the chord, where 000_... measures (docs/methods/region.md).
std::optional<double> middle_ordinate(const ChordFrame& frame, const Boundary& boundary) {
  // an infinite curvature shrinks its arc to a point: the other one spans the whole chord
  if (std::isinf(boundary.kappa_first)) return -sagitta(boundary.kappa_second, frame.h);
  if (std::isinf(boundary.kappa_second)) return -sagitta(boundary.kappa_first, frame.h);
  return boundary_ordinate(frame, boundary, 0.5 * frame.h);
}

RegionRow make_row(const Element& a, const Element& b, CurvatureRange ka, CurvatureRange kb,
                   int direction) {
  RegionRow row;
  const Vec2 chord = b.point - a.point;
  row.chord = norm(chord);
  row.theta_start = a.theta;
  row.theta_end = b.theta;
  const double alpha = turning(chord, unit_at(a.theta)), beta = turning(chord, unit_at(b.theta));
  const double apex = std::sin(beta - alpha);
  row.to_apex = row.chord * std::sin(beta) / apex;
  row.from_apex = -row.chord * std::sin(alpha) / apex;
  row.kappa_start_low = ka.low;
  row.kappa_start_high = ka.high;
  row.kappa_end_low = kb.low;
  row.kappa_end_high = kb.high;
  if (direction == 0) return row;
  // tangents alone: the extreme circle of either chain bounds the region
  ChordFrame frame = chord_frame(a, b);
  frame.kappa_start = direction > 0 ? ka.low : ka.high;
  frame.kappa_end = direction > 0 ? kb.high : kb.low;
  const auto region = segment_region(frame, direction);
  if (!region) return row;
  const auto start = middle_ordinate(frame, region->from_start);
  const auto end = middle_ordinate(frame, region->to_end);
  if (start && end) {
    row.lower_height = std::min(std::abs(*start), std::abs(*end));
    row.width = std::abs(*start - *end);
  } else {  // a heading a right angle or more from the chord: nothing stands over its middle
    row.lower_height = region->lower_height;
    row.width = region->parallel_width;
  }
  return row;
}

}  // namespace

Result<RegionTable> region_table(const PointSeries& series) {
  const auto analysis = analyse(series.points);
  if (!analysis) return tl::unexpected(analysis.error());
  Watch nobody;
  const auto chain =
      pipeline_detail::form_elements(series.points, *analysis, {series.fixed, false}, nobody);
  if (!chain) return tl::unexpected(chain.error());
  RegionTable table;
  table.elements = chain->elements;
  for (const Span& span : spans_of(*chain)) {
    const std::vector<Element> part(
        table.elements.begin() + static_cast<std::ptrdiff_t>(span.first),
        table.elements.begin() + static_cast<std::ptrdiff_t>(span.last) + 1);
    const double first = part.front().kappa, last = part.back().kappa;
    const bool convex = first * last > 0.0;
    const auto ranges = curvature_chains(part, span.direction == 0 ? 1 : span.direction, convex,
                                         first > 0.0 ? 1 : -1);
    for (std::size_t i = 0; i + 1 < part.size(); ++i) {
      table.rows.push_back(
          make_row(part[i], part[i + 1], ranges[i], ranges[i + 1], span.direction));
    }
  }
  return table;
}

}  // namespace obvid
