// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/pieces.h"
#include "obvid/geom/element.h"
#include "obvid/pipeline/fit.h"
#include "obvid/region/internal/curvature_chains.h"
#include "obvid/region/internal/feasible_data.h"
#include "obvid/region/internal/segment_region.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// One segment of the region in which every monotone curve with the given tangents lies
/// (the tables of [000] and [003]). Lengths in units, radii signed like the curvature.
struct RegionRow {
  std::size_t from = 0, to = 0;  ///< its points in `RegionPart::points`
  double chord = 0.0;
  double theta_start = 0.0;  ///< heading at the first point, rad
  double theta_end = 0.0;
  double to_apex = 0.0;          ///< |i,T|: from point i to the meeting of both tangents
  double from_apex = 0.0;        ///< |T,i+1|
  std::optional<int> direction;  ///< +1 curvature grows, -1 falls, 0 constant; nothing: a vertex
  /// Ranges of the curvature at both points; nothing where a vertex lies between them.
  std::optional<CurvatureRange> kappa_start, kappa_end;
  /// Of the lower boundary above the middle of the chord, and between both boundaries there;
  /// nothing where a vertex lies between the points, or where they have no region that is bounded.
  std::optional<double> lower_height, width;
  std::optional<double> points_only_error;  ///< between the adjacent circles of both points
  std::optional<double> apex_height;      ///< H: of the triangle of the neighbouring chords; at the
                                          ///< ends of the series of that with equal angles
  std::optional<double> tangent_height;   ///< Ht: of the triangle of the tangents
  std::optional<double> apex_gap;         ///< Delta as [003] prints it: H above the lower boundary
  std::optional<double> tangent_gap;      ///< Delta t: the same of Ht
  std::optional<double> apex_bound;       ///< what convex and monotone curves can differ by at most
  std::optional<double> tangent_bound;    ///< the same with the tangents
  std::optional<double> spline_distance;  ///< f: of the cubic spline that CAD systems draw through
                                          ///< the points, from the farther boundary
  std::optional<PlacedBoundaries> region;  ///< where the boundaries lie; for drawings
};

/// A point of the worksheet.
struct RegionPoint {
  Vec2 point;
  std::size_t number = 0;    ///< index of the user's point; of the one before an inserted point
  std::size_t inserted = 0;  ///< 1, 2, ... of those inserted behind the user's point; 0: the user's
  double theta = 0.0;        ///< heading, rad
  double kappa = 0.0;        ///< of the curve that was taken; in the middle of its range
  bool theta_given = false;
  bool kappa_given = false;
  std::optional<double> adjacent_kappa;  ///< of the adjacent circle; not at the ends
  /// What the point may have when everything else that is given stays, headings by themselves.
  std::optional<HeadingRange> headings;
  /// The same of the curvature, at the headings of the table.
  std::optional<CurvatureRange> curvatures;
};

/// Points and segments of a whole series.
struct RegionPart {
  std::vector<RegionPoint> points;
  std::vector<RegionRow> rows;
  bool loop = false;  ///< closed without corners: the last point is the first one again
};

/// The largest width of a table, of the segments that have one.
struct WidestRow {
  std::optional<double> width;  ///< nothing where no segment has one
  std::size_t unknown = 0;      ///< segments without
};
[[nodiscard]] inline WidestRow widest_row(const RegionPart& part) {
  WidestRow out;
  for (const RegionRow& row : part.rows) {
    if (row.width) out.width = std::max(out.width.value_or(0.0), *row.width);
    out.unknown += row.width ? 0 : 1;
  }
  return out;
}

/// How tangents that are not given are chosen.
enum class TangentRule {
  kFair,        ///< as `fit` does: the fairest chain
  kCentral,     ///< each in the middle of what is left to it ([003])
  kNeighbours,  ///< along the chord between both neighbours; ends as the circle leads there
                ///< ([002])
};

/// Curves of the papers over the segments of the table, at its tangents.
enum class Construction {
  kArcs,       ///< two arcs per segment, through the middle of its region ([000], Table 4)
  kEllipses,   ///< one conic per segment, the first through K, the others by its curvature ([003])
  kClothoids,  ///< one clothoid per segment, common tangents, curvature steps ([002])
  kSpline,     ///< cubic B-spline through points and tangents ([000], figure 9; [003])
  kParabolas,  ///< condensed triangles: four parabolas per segment, or per part of it ([001])
};

/// What a construction has over one segment; lengths in units, radii signed.
struct ConstructionRow {
  std::size_t segment = 0;     ///< row of the part
  bool detail = false;         ///< of a step, or of a part of the segment, behind its own row
  std::vector<double> values;  ///< one per column; NaN where nothing is known
  std::string remark;          ///< "monotone", "vertex inside", ...
};

struct ConstructionTable {
  Construction construction = Construction::kArcs;
  std::vector<std::string> columns;    ///< short names: R, R', H, ...
  std::vector<ConstructionRow> rows;   ///< of a segment one, behind it those of its steps
  std::vector<Piece> pieces;           ///< in order
  std::vector<std::size_t> piece_row;  ///< row of the part that each of them belongs to
  std::vector<std::string> remarks;    ///< sentences about the whole
};

/// What the worksheet is asked for. Of the job count what is given at points, closing, corners and
/// tolerances of points; `job.tolerance` is the width to which points are inserted.
struct RegionJob {
  FitJob job;
  TangentRule rule = TangentRule::kFair;
  std::vector<std::size_t> insert;  ///< segments of the user's points, from 0, each of which gets a
                                    ///< point at its middle; one that is named twice gets it twice
  std::optional<Construction> construction;  ///< over the segments of the last series of the table
  std::optional<int> fixation{};  ///< order of parabolas: 1 points and tangents are met, radii are
                                  ///< the means of the triangles', or inside their ranges where no
                                  ///< monotone curve has those; 2 radii too. Nothing: 1 where all
                                  ///< means do, else 2 ([001])
};

/// Region per segment between neighbouring points, with the tangents that are given and those that
/// the engine assigns.
struct RegionTable {
  std::vector<RegionRow> rows;        ///< one per segment of the user's points
  std::vector<Element> elements;      ///< one per point
  RegionPart user;                    ///< the same with all that is known of the points
  std::optional<RegionPart> refined;  ///< with the inserted points, when any were asked for
  std::optional<ConstructionTable> construction;
  std::vector<std::string> warnings;
  bool closed = false;

  /// With the inserted points where there are any.
  [[nodiscard]] const RegionPart& last() const { return refined ? *refined : user; }
};

/// The worksheet of [000] and [003]: analysis, tangents, ranges, region. Where all headings are
/// given nothing is chosen. A point is inserted on the perpendicular bisector of its chord in the
/// middle of the region, with its heading in the middle of the range that is left to it.
/// Errors: those of `fit` for the data; E403, naming the points, when the given data leave nothing;
/// E502 when the width asked for needs more than a thousand points; E103 cancelled.
[[nodiscard]] Result<RegionTable> region_table(const PointSeries& series, const RegionJob& job = {},
                                               const RunContext& run = {});

}  // namespace obvid
