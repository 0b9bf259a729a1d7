// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <algorithm>
#include <cmath>

#include "form.h"
#include "obvid/region/refine.h"

namespace obvid::pipeline_detail {
namespace {

constexpr double kDefaultTolerance = 3e-6;  // of the diagonal of the series

/// Distance of a spiral that is carried by two arcs from the farther boundary of their region.
PieceBound bound_arc_pair(const Contour& contour, std::size_t piece, int direction) {
  PieceBound bound;
  const Element& from = contour.joints[piece].element;
  const Element& to = contour.joints[piece + 2].element;
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

/// Region between the elements at two neighbouring points of the series alone.
double width_between_points(const Contour& contour, std::size_t first, std::size_t last,
                            int direction) {
  const ChordFrame frame = chord_frame(contour.joints[first].element, contour.joints[last].element);
  const auto region = segment_region(frame, direction);
  return region ? region->width : bilens_width(frame);
}

/// The joint on the next point of the series after joint `from`.
std::size_t next_point(const Contour& contour, std::size_t from) {
  std::size_t joint = from + 1;
  while (joint + 1 < contour.joints.size() && !contour.joints[joint].source) ++joint;
  return joint;
}

void add(SegmentReport& segment, const PieceBound& bound) {
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
    if (contour.carrier != Carrier::kArcs) {
      add(row, bound_piece(contour.pieces[i], direction[i], tolerance));
      if (i > 0 && !contour.joints[i].source) ++row.inserted;
    } else if (direction[i] != 0 && i + 1 < contour.pieces.size()) {
      PieceBound bound = bound_arc_pair(contour, i, direction[i]);
      if (i > 0 && !contour.joints[i].source) {
        ++row.inserted;
      } else {
        bound.width_unrefined =
            width_between_points(contour, i, next_point(contour, i), direction[i]);
        bound.deviation = bound.width_unrefined;
      }
      add(row, bound);
      ++i;  // a pair of arcs
    }
  }
}

}  // namespace

double default_tolerance(const Analysis& analysis) { return kDefaultTolerance * analysis.size; }

FitReport measure(const Contour& contour, const Analysis& analysis, double tolerance) {
  FitReport report;
  report.tolerance = tolerance;
  report.segments.resize(analysis.chords.size());
  for (std::size_t i = 0; i < report.segments.size(); ++i) {
    report.segments[i].chord = analysis.chords[i].length;
    report.segments[i].points_only_error = analysis.points_only_error[i];
    report.segments[i].deviation_at = contour.points[i];
  }
  measure_pieces(contour, tolerance, report);
  for (const SegmentReport& s : report.segments) {
    report.largest_width = std::max(report.largest_width, s.width);
    report.inserted_points += s.inserted;
  }
  report.vertices_lower_bound = analysis.vertices_lower_bound;
  return report;
}

}  // namespace obvid::pipeline_detail
