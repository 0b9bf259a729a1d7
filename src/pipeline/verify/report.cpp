// SPDX-License-Identifier: Apache-2.0
#include "verify/report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "fit/form.h"
#include "fit/given.h"
#include "fit/parts.h"
#include "obvid/certify/certify.h"
#include "obvid/curve/internal/end_curvatures.h"
#include "obvid/curve/internal/runs.h"
#include "obvid/region/internal/farther_boundary.h"
#include "obvid/region/internal/refine.h"
#include "obvid/series/analysis.h"
#include "obvid/series/internal/forced_vertices.h"

namespace obvid::pipeline_detail {
namespace {

constexpr double kRegionTolerance = 3e-6;  // of the diagonal of the series

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
/// Points beyond the seam of a loop that the errors of its chords ask for.
constexpr std::ptrdiff_t kAroundSeam = 3;
/// A part whose curvature rises and falls; runs have -1, 0, +1.
constexpr int kNotMonotone = 2;

/// Element with which piece `i` begins: at a corner the one after it.
const Element& start_element(const Contour& contour, std::size_t i) {
  const Joint& joint = contour.joints[i % contour.joints.size()];
  return joint.leaving ? *joint.leaving : joint.element;
}

/// Element with which piece `i` ends.
const Element& end_element(const Contour& contour, std::size_t i) {
  return contour.joints[(i + 1) % contour.joints.size()].element;
}

/// Common direction of two neighbours; a constant one goes with either.
int common_direction(int a, int b) {
  if (a == 0 || a == b) return b;
  return b == 0 ? a : kNotMonotone;
}

/// Whether the input drew a piece.
bool is_kept(const Contour& contour, std::size_t piece) {
  return std::binary_search(contour.kept.begin(), contour.kept.end(), piece);
}

/// Points at which a piece begins that the input drew.
std::vector<bool> begins_kept(const Contour& contour) {
  std::vector<bool> begins(contour.points.size(), false);
  for (const std::size_t i : contour.kept) {
    const auto source = contour.joints[i].source;
    if (source && *source < begins.size()) begins[*source] = true;
  }
  return begins;
}

/// A piece seen from a place. Its control points are seen from its own start: differences of
/// coordinates that were rounded once more would be other curvatures.
Piece seen_from(const Piece& piece, Vec2 place) {
  const auto* bezier = std::get_if<RationalBezier>(&piece);
  if (bezier == nullptr || !(bezier->origin == Vec2{})) return moved(piece, -place);
  RationalBezier local = *bezier;
  const Vec2 start = local.offset[0];
  local.origin = start - place;
  for (std::size_t j = 0; j <= static_cast<std::size_t>(local.degree); ++j) {
    local.offset[j] = local.offset[j] - start;
  }
  return local;
}

/// What a contour leaves open between its stations (docs/claims.md).
class PartMeasure {
 public:
  PartMeasure(const Contour& contour, double tolerance)
      : contour_(contour), tolerance_(tolerance), direction_(piece_directions(contour)) {}

  SegmentReport operator()(const Part& part) {
    see_from_near(part);
    SegmentReport row;
    row.from = part.from;
    row.to = part.to;
    row.points_only_error = kUnknown;
    const Vec2 start = place(part.first_piece, part.t0);
    row.deviation_at = start + reference_;
    row.chord = norm(place(part.last_piece, part.t1) - start);
    const bool kept = is_kept(contour_, part.first_piece);
    if (!kept && !promises_monotone(contour_.carrier)) {
      row.width = row.width_unrefined = row.deviation = kUnknown;
      return row;
    }
    bound_between_stations(part, row);
    const bool pairs = !kept && steps_at_joints(contour_.carrier);
    pairs ? bound_arcs(part, row) : bound_pieces(part, row);
    return row;
  }

  /// Direction of a part, or `kNotMonotone`.
  [[nodiscard]] int direction_of(const Part& part) const {
    int common = 0;
    for (std::size_t k = part.first_piece; k <= part.last_piece && common != kNotMonotone; ++k) {
      common = common_direction(common, direction_[k]);
    }
    return common;
  }

  /// How far a part turns, to both sides together, rad.
  [[nodiscard]] double turning_of(const Part& part) const {
    double turn = 0.0;
    for (std::size_t k = part.first_piece; k <= part.last_piece; ++k) {
      const double a = k == part.first_piece ? part.t0 : 0.0;
      const double b = k == part.last_piece ? part.t1 : 1.0;
      turn += turning_both_ways(contour_.pieces[k], a, b);
    }
    return turn;
  }

 private:
  /// Copies the pieces of a part to where their coordinates are small: rounded ones blur what is
  /// measured.
  void see_from_near(const Part& part) {
    const auto* bezier = std::get_if<RationalBezier>(&contour_.pieces[part.first_piece]);
    const bool own_origin = bezier != nullptr && !(bezier->origin == Vec2{});
    reference_ = own_origin ? bezier->origin : start_point(contour_.pieces[part.first_piece]);
    first_ = part.first_piece;
    local_.clear();
    for (std::size_t k = part.first_piece; k <= part.last_piece; ++k) {
      local_.push_back(seen_from(contour_.pieces[k], reference_));
    }
  }

  [[nodiscard]] const Piece& local(std::size_t piece) const { return local_[piece - first_]; }
  [[nodiscard]] Vec2 place(std::size_t piece, double t) const {
    return evaluate(local(piece), t).point;
  }

  void bound_pieces(const Part& part, SegmentReport& row) const {
    if (part.first_piece == part.last_piece) {
      const PieceBound bound =
          bound_piece(local_.front(), part.t0, part.t1, direction_[part.first_piece], tolerance_,
                      row.width_unrefined);
      row.width = bound.width;
      row.inserted = bound.inserted;
      return;
    }
    for (std::size_t k = part.first_piece; k <= part.last_piece; ++k) {
      const double a = k == part.first_piece ? part.t0 : 0.0;
      const double b = k == part.last_piece ? part.t1 : 1.0;
      const PieceBound bound = bound_piece(local(k), a, b, direction_[k], tolerance_);
      row.width = std::max(row.width, bound.width);
      row.inserted += bound.inserted + (k > part.first_piece ? 1 : 0);
    }
  }

  /// Arcs come in pairs between elements of the spirals; both ends of a pair are elements.
  void bound_arcs(const Part& part, SegmentReport& row) const {
    std::size_t last_element = part.first_piece;  // joint with the last element that was counted
    const auto insert_at = [&](std::size_t joint) {
      if (joint == last_element || joint > part.last_piece) return;
      ++row.inserted;
      last_element = joint;
    };
    for (std::size_t k = part.first_piece; k <= part.last_piece; ++k) {
      if (direction_[k] == 0 || k == part.last_piece) continue;
      insert_at(k);
      const double turn = turning_both_ways(contour_.pieces[k], 0.0, 1.0) +
                          turning_both_ways(contour_.pieces[k + 1], 0.0, 1.0);
      if (turn < std::numbers::pi) {
        row.width = std::max(row.width, arc_pair_width(k));
      } else {  // the joint is an element too: an arc is its own region
        insert_at(k + 1);
      }
      insert_at(k + 2);
      ++k;
    }
  }

  [[nodiscard]] double arc_pair_width(std::size_t piece) const {
    const int direction = direction_[piece];
    const auto kappa_of = [&](std::size_t k) {
      const auto* arc = std::get_if<ArcPiece>(&contour_.pieces[k]);
      return arc != nullptr ? arc->kappa : 0.0;
    };
    const Stretch pair{piece, piece + 1, 0.0, 1.0};
    ChordFrame frame = frame_of(pair, ends_of(pair));
    // the arcs' own curvatures bound every other pair between them
    frame.kappa_start =
        direction * std::min(direction * frame.kappa_start, direction * kappa_of(piece));
    frame.kappa_end =
        direction * std::max(direction * frame.kappa_end, direction * kappa_of(piece + 1));
    const auto region = segment_region(frame, direction);
    return region ? region->width : bilens_width(frame);
  }

  /// Consecutive pieces with one direction.
  struct Stretch {
    std::size_t first, last;
    double t0, t1;
  };

  /// Cuts the part at vertices, and at all joints where it turns too far for one region.
  void bound_between_stations(const Part& part, SegmentReport& row) const {
    Stretch stretch{part.first_piece, part.first_piece, part.t0, 1.0};
    int common = direction_[stretch.first];
    // regions are those of curves that turn by less than half a turn, to both sides together
    const bool far = part.first_piece != part.last_piece && !(turning_of(part) < std::numbers::pi);
    for (std::size_t k = part.first_piece + 1; k <= part.last_piece; ++k) {
      const int next = common_direction(common, direction_[k]);
      const bool cut = far || next == kNotMonotone;
      if (cut) {
        bound_stretch(stretch, common, row);
        stretch = {k, k, 0.0, 1.0};
      }
      stretch.last = k;
      common = cut ? direction_[k] : next;
    }
    stretch.t1 = part.t1;
    bound_stretch(stretch, common, row);
  }

  void bound_stretch(const Stretch& stretch, int direction, SegmentReport& row) const {
    if (direction == 0) return;
    const Ends ends = ends_of(stretch);
    const ChordFrame frame = frame_of(stretch, ends);
    const auto region = segment_region(frame, direction);
    if (!region) {  // hidden by rounding: the bilens holds whatever the curvatures are
      const double width = bilens_width(frame);
      row.width_unrefined = std::max(row.width_unrefined, width);
      row.deviation = std::max(row.deviation, width);
      return;
    }
    row.width_unrefined = std::max(row.width_unrefined, region->width);
    const Vec2 along = (ends.end.point - ends.start.point) / frame.h;
    const std::span<const Piece> pieces(&local(stretch.first), stretch.last - stretch.first + 1);
    const FartherBoundary farther = farther_boundary({pieces, stretch.t0, stretch.t1},
                                                     {frame, *region, ends.start.point, along});
    if (!(farther.distance > row.deviation)) return;
    row.deviation = farther.distance;
    row.deviation_at = farther.at + reference_;
  }

  struct Ends {
    Jet start, end;
  };
  [[nodiscard]] Ends ends_of(const Stretch& s) const {
    return {evaluate(local(s.first), s.t0), evaluate(local(s.last), s.t1)};
  }

  /// Both ends as the pieces have them, directions and curvatures with their own digits (a short
  /// piece that is seen from far has lost some); arcs leave a joint's curvature to its element.
  [[nodiscard]] ChordFrame frame_of(const Stretch& s, const Ends& e) const {
    const bool arcs = steps_at_joints(contour_.carrier);
    const Piece &first = contour_.pieces[s.first], &last = contour_.pieces[s.last];
    const Jet from = evaluate(first, s.t0), to = evaluate(last, s.t1);
    const double start =
        arcs ? start_element(contour_, s.first).kappa : accurate_curvature(first, s.t0, from);
    const double end =
        arcs ? end_element(contour_, s.last).kappa : accurate_curvature(last, s.t1, to);
    return chord_frame(e.start.point, from.d1, start, e.end.point, to.d1, end);
  }

  const Contour& contour_;
  double tolerance_;
  std::vector<int> direction_;
  std::vector<Piece> local_;  // of the part at hand
  std::size_t first_ = 0;     // its first piece
  Vec2 reference_;            // where they are seen from
};

/// Says nothing about points around which the contour itself is not monotone, or turns by half a
/// turn: it is none of the curves of which the figure speaks. By rows.
void forget_around(const std::vector<int>& direction, const std::vector<double>& turn, bool closed,
                   FitReport& report) {
  const std::size_t n = direction.size();
  for (std::size_t k = 0; k < n; ++k) {
    double& error = report.segments[k].points_only_error;
    const bool inner = k > 0 && k + 1 < n;
    if (!inner && !closed) continue;
    const std::size_t before = (k + n - 1) % n, after = (k + 1) % n;
    const int common =
        common_direction(common_direction(direction[before], direction[k]), direction[after]);
    const bool turns_far = !(turn[before] + turn[k] + turn[after] < std::numbers::pi);
    const bool circular = error == 0.0;  // so is the contour, however far it turns
    if (common == kNotMonotone || (turns_far && !circular)) error = kUnknown;
  }
}

/// Points from one corner or end to the next, by their indices; a loop without corners repeats its
/// first one.
std::vector<std::vector<std::size_t>> sections_of(const Contour& contour) {
  const std::size_t n = contour.points.size();
  std::vector<std::size_t> cuts;
  std::vector<bool> between(n, false);  // behind these
  for (const Joint& joint : contour.joints) {
    if (joint.leaving && is_station(joint)) cuts.push_back(joint.source.value_or(*joint.after));
    if (!joint.source && joint.after) between[*joint.after] = true;
  }
  for (const std::size_t i : contour.kept) {  // both ends
    for (const std::size_t j : {i, (i + 1) % contour.joints.size()}) {
      if (contour.joints[j].source) cuts.push_back(*contour.joints[j].source);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
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
    const std::size_t first = cuts[k] + (between[cuts[k] % n] ? 1 : 0);
    for (std::size_t i = first; i <= cuts[k + 1]; ++i) out.back().push_back(i % n);
  }
  return out;
}

/// Errors of chords; `direction` is that of the contour beside each of them. Points of one circle
/// leave nothing open where the contour is monotone along all of them: it is that circle.
std::vector<double> errors_of(const Analysis& analysis, const std::vector<int>& direction) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < analysis.chords.size(); ++i) {
    const double error = four_point_error(analysis, i);
    errors.push_back(error > 0.0 ? error : kUnknown);  // on one circle: below
  }
  for (const CircularStretch& s : analysis.stretches) {
    int common = 0;
    for (std::size_t i = s.first; i < s.last && common != kNotMonotone; ++i) {
      common = common_direction(common, direction[i]);
    }
    for (std::size_t i = s.first; i < s.last && common != kNotMonotone; ++i) {
      if (analysis.points_only_error[i] == 0.0) errors[i] = 0.0;
    }
  }
  return errors;
}

/// Errors of the chords that the points of one section alone determine, where the contour meets
/// them exactly. `direction`: of the contour, row by row.
Result<void> say_points(const Contour& contour, std::vector<std::size_t> section, bool loop,
                        const std::vector<int>& direction, FitReport& report,
                        std::size_t first_row) {
  if (!promises_monotone(contour.carrier)) return {};
  if (loop) section.pop_back();  // its first point again
  std::vector<Vec2> points;
  for (const std::size_t i : section) points.push_back(contour.points[i]);
  const auto analysis = analyse(points);
  OBVID_TRY(analysis);
  const auto rows_from = [&](std::size_t row, std::size_t count) {
    std::vector<int> out;
    for (std::size_t i = 0; i < count; ++i) out.push_back(direction[(row + i) % direction.size()]);
    return out;
  };
  std::vector<double> errors = errors_of(*analysis, rows_from(first_row, section.size()));
  if (loop &&
      points.size() > kAroundSeam) {  // every chord has neighbours: once around and some more
    std::vector<Vec2> around = points;
    around.insert(around.begin(), points.end() - kAroundSeam, points.end());
    around.insert(around.end(), points.begin(), points.begin() + kAroundSeam + 1);
    const auto more = analyse(around);
    OBVID_TRY(more);
    const std::size_t before = points.size() - kAroundSeam;  // the row with which `around` begins
    const std::vector<double> all = errors_of(*more, rows_from(before, around.size()));
    errors.assign(all.begin() + kAroundSeam, all.end() - kAroundSeam);
  }
  const std::size_t rows = report.segments.size();
  for (std::size_t i = 0; i < std::min(errors.size(), rows); ++i) {
    if (!contour.closed && first_row + i >= rows) break;
    report.segments[(first_row + i) % rows].points_only_error = errors[i];
  }
  return {};
}

int forced(const Contour& contour, const std::vector<std::size_t>& section, bool loop,
           Watch& watch) {
  std::vector<Vec2> points;
  std::vector<double> reach;
  for (std::size_t k = 0; k + (loop ? 1 : 0) < section.size(); ++k) {
    points.push_back(contour.points[section[k]]);
    if (!contour.point_tolerance.empty()) reach.push_back(contour.point_tolerance[section[k]]);
  }
  return forced_vertices(points, reach, loop, watch);
}

}  // namespace

int direction_of(Verdict verdict) {
  return verdict == Verdict::kIncreasing ? 1 : (verdict == Verdict::kDecreasing ? -1 : 0);
}

Result<std::vector<int>> proved_directions(const std::vector<Piece>& pieces, Watch& watch) {
  std::vector<int> out;
  out.reserve(pieces.size());
  for (const Piece& piece : pieces) {
    if (watch.cancelled()) return fail(cancelled_error());
    out.push_back(direction_of(prove_piece(piece).verdict));
  }
  return out;
}

double default_tolerance(const std::vector<Vec2>& points) {
  return kRegionTolerance * bounding_diagonal(points);
}

Result<FitReport> measure(const Contour& contour, double tolerance, Watch& watch) {
  FitReport report;
  report.tolerance = tolerance;
  report.given = measure_given(contour);
  if (watch.cancelled()) return fail(cancelled_error());
  report.largest_deviation = promises_monotone(contour.carrier) ? 0.0 : kUnknown;
  PartMeasure measure_part(contour, tolerance);
  std::vector<int> direction;
  std::vector<double> turn;
  for (const Part& part : parts_of(contour)) {
    if (watch.cancelled()) return fail(cancelled_error());
    const SegmentReport& s = report.segments.emplace_back(measure_part(part));
    direction.push_back(measure_part.direction_of(part));
    turn.push_back(measure_part.turning_of(part));
    report.largest_width = std::isnan(s.width) ? s.width : std::max(report.largest_width, s.width);
    if (s.deviation > report.largest_deviation) report.largest_deviation = s.deviation;
    report.inserted_points += s.inserted;
  }
  const auto sections = sections_of(contour);
  const bool parted = !contour.kept.empty() ||
                      std::any_of(contour.joints.begin(), contour.joints.end(),
                                  [](const Joint& joint) { return joint.leaving.has_value(); });
  const bool loop = contour.closed && !parted;
  const std::vector<bool> begins = begins_kept(contour);
  // rows begin at the first joint, sections of a closed contour where it is parted
  const auto begins_section = [&sections](const SegmentReport& s) {
    return s.from == sections.front().front();
  };
  const auto first = std::find_if(report.segments.begin(), report.segments.end(), begins_section);
  std::size_t row = first == report.segments.end()
                        ? 0
                        : static_cast<std::size_t>(first - report.segments.begin());
  for (const auto& section : sections) {
    if (begins[section.front()]) {  // nothing is left open: the piece is what it is
      ++row;
      continue;
    }
    if (contour.point_tolerance.empty()) {
      const auto said = say_points(contour, section, loop, direction, report, row);
      OBVID_TRY(said);
    }
    if (watch.cancelled()) return fail(cancelled_error());
    report.vertices_lower_bound += forced(contour, section, loop, watch);
    row += section.size() - 1;
  }
  forget_around(direction, turn, contour.closed, report);
  // around a closed contour the curvature returns to where it began, leaps at corners included
  if (contour.closed) report.vertices_lower_bound += report.vertices_lower_bound % 2;
  return report;
}

namespace {

/// A figure of a part speaks of curves that are monotone as its pieces were meant to be, across
/// their joints too. Where the proof found them otherwise it speaks of nothing.
void forget_unproved(const Certificate& certificate, const Contour& contour, FitReport& report) {
  if (certificate.proved || !promises_monotone(contour.carrier)) return;
  if (!certificate.gaps_within_bounds) {  // a kink is no part of a curve of monotone curvature
    for (SegmentReport& row : report.segments) row.points_only_error = kUnknown;
  }
  if (steps_at_joints(contour.carrier)) return;  // every piece is an arc: nothing to prove
  const std::vector<int> direction = piece_directions(contour);
  const std::vector<Part> parts = parts_of(contour);
  const std::size_t rows = std::min(parts.size(), report.segments.size());
  for (std::size_t r = 0; r < rows; ++r) {
    bool as_meant = true;
    for (std::size_t k = parts[r].first_piece; k <= parts[r].last_piece; ++k) {
      if (is_kept(contour, k) || k >= certificate.pieces.size()) continue;
      const Verdict verdict = certificate.pieces[k].verdict;
      const int found = direction_of(verdict);
      as_meant = as_meant && certificate.pieces[k].turns_below_half &&
                 (verdict == Verdict::kConstant || (found != 0 && found == direction[k]));
    }
    const bool joined =
        certificate.gaps_within_bounds || parts[r].first_piece == parts[r].last_piece;
    if (as_meant && joined) continue;
    SegmentReport& row = report.segments[r];
    row.width = row.width_unrefined = row.deviation = kUnknown;
    report.largest_width = kUnknown;
    if (as_meant) continue;
    // the points speak of curves that are monotone along the neighbouring parts too
    for (const std::size_t around : {(r + rows - 1) % rows, r, (r + 1) % rows}) {
      report.segments[around].points_only_error = kUnknown;
    }
  }
  report.largest_deviation = kUnknown;
  for (const SegmentReport& row : report.segments) {
    report.largest_deviation = std::fmax(report.largest_deviation, row.deviation);
  }
}

}  // namespace

void settle_with(const Certificate& certificate, const Contour& contour, FitReport& report,
                 Watch& watch) {
  forget_unproved(certificate, contour, report);
  report.vertices = certificate.vertices;
  report.inflections = certificate.inflections;
  report.largest_move = certificate.largest_move;
  if (!contour.point_tolerance.empty()) report.moves = point_distances(contour, watch);
  // a contour may turn more between its points than the curves of which the bound speaks: what it
  // does with fewer vertices no longer bounds anything
  if (certificate.proved) {
    report.vertices_lower_bound = std::min(report.vertices_lower_bound, certificate.vertices);
  }
}

}  // namespace obvid::pipeline_detail
