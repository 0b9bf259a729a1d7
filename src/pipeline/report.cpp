// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "form.h"
#include "obvid/region/refine.h"
#include "obvid/series/analysis.h"
#include "obvid/series/forced_vertices.h"

namespace obvid::pipeline_detail {
namespace {

constexpr double kRegionTolerance = 3e-6;  // of the diagonal of the series
constexpr double kLeastTolerance = 1e-12;  // of it: some thousand roundings of a coordinate

/// Element with which piece `i` begins: at a corner the one after it.
const Element& start_element(const Contour& contour, std::size_t i) {
  const Joint& joint = contour.joints[i % contour.joints.size()];
  return joint.leaving ? *joint.leaving : joint.element;
}

/// Element with which piece `i` ends.
const Element& end_element(const Contour& contour, std::size_t i) {
  return contour.joints[(i + 1) % contour.joints.size()].element;
}

/// Distance of a spiral that is carried by two arcs from the farther boundary of their region.
PieceBound bound_arc_pair(const Contour& contour, std::size_t piece, int direction) {
  PieceBound bound;
  const Element& from = start_element(contour, piece);
  const Element& to = end_element(contour, piece + 1);
  const auto* first = std::get_if<ArcPiece>(&contour.pieces[piece]);
  const auto* second = std::get_if<ArcPiece>(&contour.pieces[piece + 1]);
  ChordFrame frame = chord_frame(from, to);
  // the arcs' own curvatures bound every other pair between them
  frame.kappa_start = direction * std::min(direction * frame.kappa_start,
                                           direction * (first != nullptr ? first->kappa : 0.0));
  frame.kappa_end = direction * std::max(direction * frame.kappa_end,
                                         direction * (second != nullptr ? second->kappa : 0.0));
  const auto region = segment_region(frame, direction);
  bound.width = region ? region->width : bilens_width(frame);
  bound.deviation_at = end_point(contour.pieces[piece]);
  return bound;
}

/// Region between the elements at two neighbouring points of the series alone: pieces first to
/// last.
double width_between_points(const Contour& contour, std::size_t first, std::size_t last,
                            int direction) {
  const ChordFrame frame = chord_frame(start_element(contour, first), end_element(contour, last));
  const auto region = segment_region(frame, direction);
  return region ? region->width : bilens_width(frame);
}

/// The last piece before the next point of the series after piece `from` begins.
std::size_t last_before_point(const Contour& contour, std::size_t from) {
  std::size_t piece = from;
  while (piece + 1 < contour.pieces.size() && !contour.joints[piece + 1].source) ++piece;
  return piece;
}

void add_bound(SegmentReport& segment, const PieceBound& bound) {
  segment.width = std::max(segment.width, bound.width);
  segment.width_unrefined = std::max(segment.width_unrefined, bound.width_unrefined);
  if (bound.deviation > segment.deviation) {
    segment.deviation = bound.deviation;
    segment.deviation_at = bound.deviation_at;
  }
  segment.inserted += bound.inserted;
}

void measure_pieces(const Contour& contour, double tolerance, FitReport& report) {
  const std::vector<int> direction = piece_directions(contour);
  std::size_t segment = 0;
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    if (i > 0 && contour.joints[i].source) ++segment;
    if (segment >= report.segments.size()) return;
    SegmentReport& row = report.segments[segment];
    if (!promises_monotone(contour.carrier)) {
      row.width = row.width_unrefined = row.deviation = std::numeric_limits<double>::quiet_NaN();
    } else if (contour.carrier != Carrier::kArcs) {
      add_bound(row, bound_piece(contour.pieces[i], direction[i], tolerance));
      if (i > 0 && !contour.joints[i].source) ++row.inserted;
    } else if (direction[i] != 0 && i + 1 < contour.pieces.size()) {
      PieceBound bound = bound_arc_pair(contour, i, direction[i]);
      if (i > 0 && !contour.joints[i].source) {
        ++row.inserted;
      } else {
        bound.width_unrefined =
            width_between_points(contour, i, last_before_point(contour, i), direction[i]);
        bound.deviation = bound.width_unrefined;
      }
      add_bound(row, bound);
      ++i;  // a pair of arcs
    }
  }
}

/// One row for every part between two neighbouring points that the contour has as joints.
void lay_rows(const Contour& contour, FitReport& report) {
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    if (i > 0 && !contour.joints[i].source) continue;
    const Vec2 from = start_element(contour, i).point;
    SegmentReport row;
    row.chord = norm(end_element(contour, last_before_point(contour, i)).point - from);
    row.points_only_error = std::numeric_limits<double>::quiet_NaN();
    row.deviation_at = from;
    report.segments.push_back(row);
  }
}

/// Points from one corner or end to the next, by their indices; a loop without corners repeats its
/// first one.
std::vector<std::vector<std::size_t>> sections_of(const Contour& contour) {
  const std::size_t n = contour.points.size();
  std::vector<std::size_t> cuts;
  for (const Joint& joint : contour.joints) {
    if (joint.leaving && joint.source) cuts.push_back(*joint.source);
  }
  std::sort(cuts.begin(), cuts.end());
  if (!contour.closed) {
    if (cuts.empty() || cuts.front() != 0) cuts.insert(cuts.begin(), 0);
    if (cuts.back() != n - 1) cuts.push_back(n - 1);
  } else {
    if (cuts.empty()) cuts.push_back(0);
    cuts.push_back(cuts.front() + n);
  }
  std::vector<std::vector<std::size_t>> out;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    out.emplace_back();
    for (std::size_t i = cuts[k]; i <= cuts[k + 1]; ++i) out.back().push_back(i % n);
  }
  return out;
}

/// Errors of the chords that the points of one section alone determine, where the contour meets
/// them exactly.
Result<void> say_points(const Contour& contour, const std::vector<std::size_t>& section,
                        FitReport& report, std::size_t first_row) {
  std::vector<Vec2> points;
  for (const std::size_t i : section) points.push_back(contour.points[i]);
  if (points.size() > 2 && points.front() == points.back()) points.pop_back();
  const auto analysis = analyse(points);
  if (!analysis) return tl::unexpected(analysis.error());
  for (std::size_t i = 0; i < analysis->chords.size(); ++i) {
    if (first_row + i >= report.segments.size()) break;
    report.segments[first_row + i].points_only_error = analysis->points_only_error[i];
  }
  return {};
}

int forced(const Contour& contour, const std::vector<std::size_t>& section, bool loop) {
  std::vector<Vec2> points;
  std::vector<double> reach;
  for (std::size_t k = 0; k + (loop ? 1 : 0) < section.size(); ++k) {
    points.push_back(contour.points[section[k]]);
    if (!contour.point_tolerance.empty()) reach.push_back(contour.point_tolerance[section[k]]);
  }
  return forced_vertices(points, reach, loop);
}

}  // namespace

double size_of(const std::vector<Vec2>& points) {
  if (points.empty()) return 0.0;
  Vec2 low = points.front(), high = low;
  for (const Vec2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return norm(high - low);
}

double default_tolerance(const std::vector<Vec2>& points) {
  return kRegionTolerance * size_of(points);
}

double least_tolerance(const std::vector<Vec2>& points) {
  return kLeastTolerance * size_of(points);
}

Result<FitReport> measure(const Contour& contour, const Certificate& certificate,
                          double tolerance) {
  FitReport report;
  report.tolerance = tolerance;
  lay_rows(contour, report);
  measure_pieces(contour, tolerance, report);
  for (const SegmentReport& s : report.segments) {
    report.largest_width = std::isnan(s.width) ? s.width : std::max(report.largest_width, s.width);
    report.inserted_points += s.inserted;
  }
  const auto sections = sections_of(contour);
  const bool loop =
      contour.closed && sections.size() == 1 && !(contour.joints.front().leaving.has_value());
  std::size_t row = 0;
  for (const auto& section : sections) {
    if (contour.point_tolerance.empty()) {
      const auto said = say_points(contour, section, report, row);
      if (!said) return tl::unexpected(said.error());
    }
    report.vertices_lower_bound += forced(contour, section, loop);
    row += section.size() - 1;
  }
  // around a closed contour the curvature returns to where it began, leaps at corners included
  if (contour.closed) report.vertices_lower_bound += report.vertices_lower_bound % 2;
  // a contour may turn more between its points than the curves of which the bound speaks: what it
  // does with fewer vertices no longer bounds anything
  if (certificate.proved) {
    report.vertices_lower_bound = std::min(report.vertices_lower_bound, certificate.vertices);
  }
  return report;
}

}  // namespace obvid::pipeline_detail
