// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/region_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "fit/form.h"
#include "fit/parabola_room.h"
#include "fit/prepare.h"
#include "fit/section_chain.h"
#include "fit/series_ranges.h"
#include "obvid/contour/clothoids.h"
#include "obvid/contour/common/internal/carry.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/geom/internal/value_range.h"
#include "obvid/region/internal/boundary_distance.h"
#include "obvid/region/internal/convex_triangle.h"
#include "obvid/series/analysis.h"
#include "region/region_constructions.h"

namespace obvid {
namespace {

using namespace pipeline_detail;

constexpr std::size_t kMostInserted = 1000;
/// Fewer points lie on one circle.
constexpr std::size_t kFewestThatTell = 4;
/// Points of a loop that are looked at beyond its seam, on both sides.
constexpr std::size_t kSeamOverlap = 16;

/// A section of the series on its way to the table: points, what is given at them, and how the
/// curvature goes between them.
struct Worksheet {
  std::vector<Vec2> points;
  std::vector<std::size_t> number, inserted;
  std::vector<FixedData> given;
  std::vector<bool> kept;  ///< its heading was chosen before points were inserted; empty: none was
  std::vector<double> theta;  ///< chosen or given, unwrapped
  std::vector<double> kappa;
  std::vector<std::optional<int>> direction;  ///< of each segment; nothing: a vertex lies inside
  std::vector<int> sign;                      ///< that the curvature keeps; 0: none
  bool loop = false;                          ///< the last point is the first one again

  [[nodiscard]] Element element(std::size_t i) const { return {points[i], theta[i], kappa[i]}; }
};

/// Sign of the curvature at the points between two changes of direction, where it is one and the
/// same at all of them.
std::vector<int> signs_of_spans(const std::vector<double>& kappa,
                                const std::vector<std::optional<int>>& direction) {
  std::vector<int> out(kappa.size(), 0);
  for (std::size_t i = 0; i < direction.size();) {
    std::size_t last = i + 1;
    while (direction[i] && last < direction.size() && direction[last] == direction[i]) ++last;
    const double first_kappa = kappa[i], last_kappa = kappa[last];
    if (first_kappa * last_kappa > 0.0) {
      for (std::size_t k = i; k <= last; ++k) out[k] = first_kappa > 0.0 ? 1 : -1;
    }
    i = last;
  }
  return out;
}

/// Ordinate over the middle of the chord, where [000] measures (docs/methods/region.md).
std::optional<double> middle_ordinate(const ChordFrame& frame, const Boundary& boundary) {
  return ordinate_over_chord(frame, boundary, 0.5 * frame.h);
}

/// Whether a boundary is one arc, its other circle unknown, that turns by half a turn or more.
bool turns_half(const ChordFrame& frame, const Boundary& boundary) {
  return (std::isinf(boundary.kappa_first) && frame.end_tangent.x <= 0.0) ||
         (std::isinf(boundary.kappa_second) && frame.start_tangent.x <= 0.0);
}

/// What the tangents at both points say, whatever lies between them.
RegionRow bare_row(const Element& a, const Element& b) {
  RegionRow row;
  const Vec2 chord = b.point - a.point;
  row.chord = norm(chord);
  row.theta_start = a.theta;
  row.theta_end = b.theta;
  const double alpha = turning(chord, unit_at(a.theta)), beta = turning(chord, unit_at(b.theta));
  const double apex = std::sin(beta - alpha);
  row.to_apex = row.chord * std::sin(beta) / apex;
  row.from_apex = -row.chord * std::sin(alpha) / apex;
  return row;
}

/// Links and nodes of a worksheet for `feasible_data`; headings all given when `fixed`.
class Ranges {
 public:
  Ranges(const Worksheet& sheet, Watch& watch)
      : sheet_(sheet), chords_(measure_chords(sheet.points)), watch_(watch) {}

  [[nodiscard]] std::vector<FeasibleData> operator()(bool all_headings) const {
    const std::size_t n = sheet_.points.size();
    if (!sheet_.loop) return feasible_data(links(0, n), nodes(0, n, all_headings), &watch_);
    // once around and some more, so that the seam has neighbours on both sides
    const std::size_t turn = n - 1, overlap = std::min(turn, kSeamOverlap);
    const auto all = feasible_data(links(turn - overlap, n + 2 * overlap),
                                   nodes(turn - overlap, n + 2 * overlap, all_headings), &watch_);
    return {all.begin() + static_cast<std::ptrdiff_t>(overlap),
            all.begin() + static_cast<std::ptrdiff_t>(overlap + n)};
  }

  [[nodiscard]] std::vector<RangeLink> links(std::size_t first, std::size_t count) const {
    std::vector<RangeLink> out;
    for (std::size_t k = 0; k + 1 < count; ++k) {
      const std::size_t i = (first + k) % chords_.size();
      out.push_back({chords_[i].length, chords_[i].omega, sheet_.direction[i]});
      if (k == 0) continue;
      out.back().omega = nearest_angle(out.back().omega, out[k - 1].omega);
    }
    return out;
  }

  [[nodiscard]] std::vector<RangeNode> nodes(std::size_t first, std::size_t count,
                                             bool all_headings) const {
    const std::vector<RangeLink> along = links(first, count);
    std::vector<RangeNode> out;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = sheet_.loop ? (first + k) % chords_.size() : k;
      RangeNode node{sheet_.given[i].theta, sheet_.given[i].kappa, sheet_.sign[i]};
      const std::size_t n = sheet_.direction.size();
      const bool has_before = i > 0 || sheet_.loop;
      const bool arc = (has_before && sheet_.direction[(i + n - 1) % n] == 0) ||
                       (i < n && sheet_.direction[i] == 0);
      node.thetas = sheet_.given[i].thetas;
      node.kappas = sheet_.given[i].kappas;
      if (all_headings || arc) node.theta = sheet_.theta[i];
      if (arc) node.kappa = sheet_.kappa[i];
      const double before = along[k > 0 ? k - 1 : 0].omega;
      const double after = nearest_angle(along[std::min(k, along.size() - 1)].omega, before);
      const double near = 0.5 * (before + after);
      if (node.theta) node.theta = nearest_angle(*node.theta, near);
      if (node.thetas) node.thetas = turned_near(*node.thetas, near);
      out.push_back(node);
    }
    return out;
  }

 private:
  const Worksheet& sheet_;
  std::vector<Chord> chords_;
  Watch& watch_;
};

/// Curvature for a point whose range alone is known.
double some_curvature(const std::optional<CurvatureRange>& range) {
  if (!range) return 0.0;
  if (std::isinf(range->low) && std::isinf(range->high)) return 0.0;
  if (std::isinf(range->low)) return range->high - std::abs(range->high);
  if (std::isinf(range->high)) return range->low + std::abs(range->low);
  return 0.5 * (range->low + range->high);
}

/// Points and rows of one worksheet; without meaning when the watch ended it.
class PartMaker {
 public:
  PartMaker(const Worksheet& sheet, const Analysis* analysis, Watch& watch)
      : s_(sheet), analysis_(analysis), watch_(watch), tells_(tells_ranges()) {}

  RegionPart run() {
    const Ranges ranges(s_, watch_);
    const auto headings = ranges(false), curvatures = ranges(true);
    for (std::size_t i = 0; i < s_.points.size(); ++i) {
      RegionPoint p;
      p.point = s_.points[i];
      p.number = s_.number[i];
      p.inserted = s_.inserted[i];
      p.theta = s_.theta[i];
      p.kappa = s_.kappa[i];
      p.theta_given = s_.given[i].theta.has_value() && (s_.kept.empty() || !s_.kept[i]);
      p.kappa_given = s_.given[i].kappa.has_value();
      if (tells_) p.headings = headings[i].heading;
      if (p.headings) turn_to(p.theta, *p.headings);
      if (tells_) p.curvatures = curvatures[i].kappa;
      const bool inner = i > 0 && i + 1 < s_.points.size();
      if (analysis_ != nullptr && inner) p.adjacent_kappa = analysis_->circles[i].kappa;
      if (analysis_ != nullptr && !inner && s_.loop) p.adjacent_kappa = seam_circle();
      out_.points.push_back(p);
    }
    for (std::size_t i = 0; i + 1 < s_.points.size() && !watch_.cancelled(); ++i) {
      out_.rows.push_back(row(i));
    }
    if (watch_.was_cancelled()) return std::move(out_);
    forget_beside_nothing();
    forget_beside_unknown(headings);
    if (analysis_ != nullptr) add_spline();
    out_.loop = s_.loop;
    return std::move(out_);
  }

 private:
  /// Two or three points lie on one circle whatever the curve is: that the one which was taken is
  /// that circle says nothing of the others.
  [[nodiscard]] bool tells_ranges() const {
    if (s_.loop || s_.points.size() >= kFewestThatTell) return true;
    const bool circle = std::any_of(s_.direction.begin(), s_.direction.end(),
                                    [](const std::optional<int>& d) { return d == 0; });
    bool all_given = true;  // by the user, not kept while points were inserted
    for (std::size_t i = 0; i < s_.points.size(); ++i) {
      all_given = all_given && s_.given[i].theta && (s_.kept.empty() || !s_.kept[i]);
    }
    return !circle || all_given;
  }

  /// A point whose segments all leave no curve has no radii either.
  void forget_beside_nothing() {
    std::vector<bool> none(out_.points.size(), false), some = none;
    for (const RegionRow& row : out_.rows) {
      for (const std::size_t i : {row.from, row.to}) {
        none[i] = none[i] || (row.direction && !row.kappa_start);
        some[i] = some[i] || row.kappa_start;
      }
    }
    for (std::size_t i = 0; i < out_.points.size(); ++i) {
      if (none[i] && !some[i]) out_.points[i].curvatures = std::nullopt;
    }
  }

  /// Where rounding leaves a point no range, nothing is known of what lies beyond it: what its
  /// neighbours along monotone segments may do is not known either.
  void forget_beside_unknown(const std::vector<FeasibleData>& headings) {
    for (const RegionRow& row : out_.rows) {
      if (row.direction.value_or(0) == 0) continue;
      if (headings[row.from].heading.has_value() == headings[row.to].heading.has_value()) continue;
      out_.points[row.from].headings.reset();
      out_.points[row.to].headings.reset();
    }
  }

  /// Ranges of a loop count turns from another point than its headings do.
  static void turn_to(double theta, HeadingRange& range) {
    const double middle = 0.5 * (range.low + range.high);
    const double turns = nearest_angle(middle, theta) - middle;
    range.low += turns;
    range.high += turns;
  }

  /// Circle through the first point of a loop and both its neighbours.
  [[nodiscard]] double seam_circle() const {
    const std::vector<Vec2> around{s_.points[s_.points.size() - 2], s_.points[0], s_.points[1]};
    return measure_circles(around, measure_chords(around))[1].kappa;
  }

  RegionRow row(std::size_t i) {
    RegionRow row = bare_row(s_.element(i), s_.element(i + 1));
    row.from = i;
    row.to = i + 1;
    row.direction = s_.direction[i];
    if (analysis_ != nullptr && std::isfinite(analysis_->points_only_error[i])) {
      row.points_only_error = analysis_->points_only_error[i];
    }
    if (const auto t = tangents(i)) row.tangent_height = t->height;
    if (const auto t = chords(i)) row.apex_height = t->height;
    if (row.direction) {
      row.kappa_start = out_.points[i].curvatures;
      row.kappa_end = out_.points[i + 1].curvatures;
      if (!row.kappa_start || !row.kappa_end) {
        row.kappa_start = row.kappa_end = std::nullopt;
      } else {
        add_region(row, i);
      }
    }
    return row;
  }

  /// Curvatures that bound the region of a segment: those given, else the ends of their ranges.
  [[nodiscard]] std::pair<double, double> bounding(const RegionRow& row, std::size_t i) const {
    const bool grows = *row.direction > 0;
    const double start = grows ? row.kappa_start->low : row.kappa_start->high;
    const double end = grows ? row.kappa_end->high : row.kappa_end->low;
    return {s_.given[i].kappa.value_or(start), s_.given[i + 1].kappa.value_or(end)};
  }

  void add_region(RegionRow& row, std::size_t i) {
    Element a = s_.element(i), b = s_.element(i + 1);
    if (*row.direction == 0) {
      const double height = std::abs(sagitta(a.kappa, row.chord));
      const bool over_half = dot(b.point - a.point, unit_at(a.theta)) < 0.0;
      row.lower_height = over_half ? 2.0 / std::abs(a.kappa) - height : height;
      row.width = 0.0;
      return;
    }
    const double alpha = turning(b.point - a.point, unit_at(a.theta));
    const double beta = turning(b.point - a.point, unit_at(b.theta));
    if (!(std::abs(alpha + beta) < std::numbers::pi))
      return;  // nothing bounds what turns on so far
    std::tie(a.kappa, b.kappa) = bounding(row, i);
    const ChordFrame frame = chord_frame(a, b);
    const auto region = segment_region(frame, *row.direction);
    if (!region) return;
    row.region = PlacedBoundaries{frame, *region, a.point, (b.point - a.point) / row.chord};
    if (turns_half(frame, region->from_start) || turns_half(frame, region->to_end)) return;
    const auto start = middle_ordinate(frame, region->from_start);
    const auto end = middle_ordinate(frame, region->to_end);
    if (start && end) {
      row.lower_height = std::min(std::abs(*start), std::abs(*end));
      row.width = std::abs(*start - *end);
    } else {  // a heading a right angle or more from the chord: nothing stands over its middle
      row.lower_height = region->lower_height;
      row.width = region->parallel_width;
    }
    add_convex(row, a, b, i);
  }

  void add_convex(RegionRow& row, const Element& a, const Element& b, std::size_t i) const {
    if (const auto t = chords(i)) {
      if (const auto e = convex_errors(a, b, *row.direction, *t)) {
        row.apex_gap = e->apex_gap;
        row.apex_bound = e->bound;
      }
    }
    if (const auto t = tangents(i)) {
      if (const auto e = convex_errors(a, b, *row.direction, *t)) {
        row.tangent_gap = e->apex_gap;
        row.tangent_bound = e->bound;
      }
    }
  }

  [[nodiscard]] std::optional<ConvexTriangle> tangents(std::size_t i) const {
    return tangent_triangle(s_.points[i], unit_at(s_.theta[i]), s_.points[i + 1],
                            unit_at(s_.theta[i + 1]));
  }

  /// Over the neighbouring chords; at an end of the series both angles are that of the inner one.
  [[nodiscard]] std::optional<ConvexTriangle> chords(std::size_t i) const {
    const std::size_t n = s_.points.size();
    const Vec2 start = s_.points[i], end = s_.points[i + 1], chord = end - start;
    std::optional<Vec2> before, after;
    if (i > 0) before = start - s_.points[i - 1];
    if (i + 2 < n) after = s_.points[i + 2] - end;
    if (s_.loop && i == 0) before = start - s_.points[n - 2];
    if (s_.loop && i + 2 == n) after = s_.points[1] - end;
    if (!before && !after) return std::nullopt;
    const auto mirrored =
        [&](Vec2 v) {  // in the perpendicular bisector of the chord, run backwards
          const Vec2 u = chord / norm(chord);
          return 2.0 * dot(u, v) * u - v;
        };
    if (!before) before = mirrored(*after);
    if (!after) after = mirrored(*before);
    return tangent_triangle(start, *before, end, *after);
  }

  /// The spline of CAD systems has one piece to a segment.
  void add_spline() {
    if (s_.loop || s_.points.size() < 4) return;
    Contour joints;
    for (std::size_t i = 0; i < s_.points.size(); ++i) {
      joints.joints.push_back({{s_.points[i], 0.0, 0.0}, i});
    }
    const SeriesChain none;
    const std::vector<GivenDatum> no_data;
    const auto spline = contour_detail::carry_baseline(
        joints, {.points = s_.points, .chain = none, .given = no_data, .watch = watch_});
    if (!spline || spline->contour.pieces.size() + 1 != s_.points.size()) return;
    for (RegionRow& row : out_.rows) {
      if (watch_.cancelled()) return;
      if (!row.region || row.direction == 0) continue;
      Element a = s_.element(row.from), b = s_.element(row.to);
      std::tie(a.kappa, b.kappa) = bounding(row, row.from);
      const auto placed = place_in_region(spline->contour.pieces[row.from], a, b, *row.direction);
      if (placed) row.spline_distance = placed->farther;
    }
  }

  const Worksheet& s_;
  const Analysis* analysis_;
  Watch& watch_;
  bool tells_;  ///< whether ranges are known
  RegionPart out_;
};

/// Inserts points until every segment is narrow enough.
class Inserter {
 public:
  Inserter(Worksheet sheet, Watch& watch) : s_(std::move(sheet)), watch_(watch) {}

  Result<Worksheet> run(std::optional<double> tolerance, const std::vector<std::size_t>& segments) {
    // those between the inserted points keep what was chosen
    for (std::size_t i = 0; i < s_.points.size(); ++i) {
      s_.kept.push_back(!s_.given[i].theta);
      s_.given[i].theta = s_.theta[i];
    }
    for (const std::size_t segment : segments) {
      OBVID_TRY(insert_into(widest(PartMaker(s_, nullptr, watch_).run(), segment)));
    }
    while (tolerance && !watch_.cancelled()) {
      const RegionPart part = PartMaker(s_, nullptr, watch_).run();
      const auto row = widest(part, std::nullopt);
      if (!row || *part.rows[*row].width <= *tolerance) break;
      if (s_.points.size() > kMostInserted) {
        return error(ErrorCode::kToleranceNotReached,
                     "the width asked for needs more than a thousand points")
            .hint("choose a larger --tolerance")
            .value(*tolerance);
      }
      OBVID_TRY(insert_into(row));
    }
    return std::move(s_);
  }

 private:
  /// The widest segment with a region, of the whole series or of one segment of the user's.
  [[nodiscard]] std::optional<std::size_t> widest(const RegionPart& part,
                                                  std::optional<std::size_t> of) const {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < part.rows.size(); ++i) {
      if (of && s_.number[i] != *of) continue;
      const RegionRow& row = part.rows[i];
      if (!row.width || !row.region || row.direction == 0) continue;
      if (!best || *row.width > *part.rows[*best].width) best = i;
    }
    return best;
  }

  Result<void> insert_into(std::optional<std::size_t> at) {
    const auto nowhere = [](std::size_t point) {
      return error(ErrorCode::kRoundingDecides,
                   "no point can be inserted there: the region has no width that coordinates tell")
          .where(fmt::format("segment {}", point + 1))
          .hint("choose a larger --tolerance")
          .point(point);
    };
    if (watch_.was_cancelled()) return fail(cancelled_error());
    if (!at) return nowhere(0);
    const std::size_t i = *at;
    const RegionPart part = PartMaker(s_, nullptr, watch_).run();
    if (watch_.was_cancelled()) return fail(cancelled_error());
    const PlacedBoundaries& placed = *part.rows[i].region;
    const auto low = middle_ordinate(placed.frame, placed.region.from_start);
    const auto high = middle_ordinate(placed.frame, placed.region.to_end);
    if (!low || !high) return nowhere(s_.number[i]);
    const Vec2 middle = placed.start + 0.5 * placed.frame.h * placed.along +
                        0.5 * (*low + *high) * left_normal(placed.along);
    put(i, middle);
    const auto range = Ranges(s_, watch_)(false)[i + 1].heading;
    if (!range) return nowhere(s_.number[i]);
    s_.theta[i + 1] = 0.5 * (range->low + range->high);
    s_.given[i + 1].theta = s_.theta[i + 1];
    return {};
  }

  void put(std::size_t i, Vec2 point) {
    const auto after = static_cast<std::ptrdiff_t>(i) + 1;
    s_.points.insert(s_.points.begin() + after, point);
    s_.number.insert(s_.number.begin() + after, s_.number[i]);
    s_.inserted.insert(s_.inserted.begin() + after, 0);
    s_.given.insert(s_.given.begin() + after, FixedData{});
    s_.kept.insert(s_.kept.begin() + after, true);
    s_.theta.insert(s_.theta.begin() + after, 0.5 * (s_.theta[i] + s_.theta[i + 1]));
    s_.kappa.insert(s_.kappa.begin() + after, 0.5 * (s_.kappa[i] + s_.kappa[i + 1]));
    s_.direction.insert(s_.direction.begin() + after, s_.direction[i]);
    s_.sign.insert(s_.sign.begin() + after, s_.sign[i] == s_.sign[i + 1] ? s_.sign[i] : 0);
    std::size_t count = 0;
    for (std::size_t k = 0; k < s_.points.size(); ++k) {
      const bool same = k > 0 && s_.number[k] == s_.number[k - 1];
      count = same ? count + 1 : 0;
      s_.inserted[k] = count;
    }
  }

  Worksheet s_;
  Watch& watch_;
};

/// One section of the series as a worksheet.
class SheetMaker {
 public:
  SheetMaker(const Prepared& series, const Section& section, TangentRule rule, Watch& watch)
      : series_(series),
        section_(section),
        rule_(rule),
        watch_(watch),
        loop_(series.split.smooth_loop) {}

  Result<Worksheet> run(std::vector<std::string>& warnings) {
    const std::size_t last = loop_ ? series_.points.size() : section_.last;
    bool all_given = series_.exact();
    for (std::size_t k = section_.first; k <= last; ++k) {
      const std::size_t i = series_.split.point_at(k) % series_.points.size();
      sheet_.points.push_back(series_.points[i]);
      sheet_.number.push_back(i);
      sheet_.given.push_back(series_.fixed.empty() ? FixedData{} : series_.fixed[i]);
      all_given = all_given && sheet_.given.back().theta.has_value();
    }
    sheet_.loop = loop_;
    const bool central = rule_ == TangentRule::kCentral;
    if (!all_given && rule_ == TangentRule::kNeighbours) {
      take_neighbour_headings();
      all_given = true;
    }
    if (!all_given && !central) return follow_chain(warnings);
    ChainConstraints constraints;
    constraints.convex = series_.convex;
    for (const FixedData& f : sheet_.given) {
      constraints.fixed.push_back(all_given ? FixedData{} : f);
    }
    OBVID_TRY(loop_ ? start_loop(std::move(constraints)) : start_open(constraints));
    if (central && !all_given) {
      OBVID_TRY(take_centres());
    }
    unwrap();
    if (all_given && sheet_.points.size() < kFewestThatTell) follow_headings();
    if (all_given) leave_circles();
    if (!central || all_given) take_curvatures();
    sheet_.inserted.assign(sheet_.points.size(), 0);
    return std::move(sheet_);
  }

 private:
  Result<void> start_open(const ChainConstraints& constraints) {
    const auto analysis = analyse(sheet_.points);
    OBVID_TRY(analysis);
    const auto problem = chain_problem(*analysis, constraints);
    OBVID_TRY(problem);
    for (const std::int8_t d : analysis->direction) sheet_.direction.emplace_back(d);
    for (std::size_t i = 0; i < sheet_.points.size(); ++i) {
      start_at(i, problem->nodes[i], analysis->circles[i].kappa);
    }
    return {};
  }

  Result<void> start_loop(ChainConstraints constraints) {
    const std::size_t n = sheet_.points.size() - 1;
    constraints.fixed.resize(n);
    const std::vector<Vec2> once(sheet_.points.begin(), sheet_.points.end() - 1);
    const auto problem = loop_problem(once, constraints);
    OBVID_TRY(problem);
    for (const std::int8_t d : problem->direction) sheet_.direction.emplace_back(d);
    for (std::size_t i = 0; i <= n; ++i) {
      start_at(i, problem->nodes[i % n], problem->adjacent_kappa[i % n]);
    }
    return {};
  }

  /// Before anything is chosen: what is given, what the rule says, what an arc has.
  void start_at(std::size_t i, const NodeData& node, double adjacent_kappa) {
    const double theta = neighbour_.empty() ? node.theta.value_or(0.0) : neighbour_[i];
    sheet_.sign.push_back(node.curvature_sign);
    sheet_.theta.push_back(sheet_.given[i].theta.value_or(theta));
    sheet_.kappa.push_back(sheet_.given[i].kappa.value_or(node.kappa.value_or(adjacent_kappa)));
  }

  Result<void> take_centres() {
    const Ranges ranges(sheet_, watch_);
    const std::size_t n = sheet_.points.size();
    const auto links = ranges.links(0, n);
    const auto nodes = ranges.nodes(0, loop_ ? n - 1 : n, false);
    const auto central = loop_ ? central_loop(links, nodes, {}, &watch_)
                               : central_data(links, nodes, {}, ChoiceOrder::kAlong,
                                              SharpCurvature::kMiddle, &watch_);
    if (watch_.was_cancelled()) return fail(cancelled_error());
    if (!central) {
      return error(ErrorCode::kFixedDataContradict,
                   "what is given leaves no headings with which a monotone curve exists")
          .hint("free some of the given data; see the ranges of `obvid region` without them");
    }
    for (std::size_t i = 0; i < n; ++i) {
      sheet_.theta[i] = *(*central)[i].theta;
      sheet_.kappa[i] = *(*central)[i].kappa;
    }
    return {};
  }

  /// [002]: a heading that is not given is that of the chord between both neighbours.
  void take_neighbour_headings() {
    const std::size_t n = sheet_.points.size();
    std::vector<Vec2> around = sheet_.points;
    EndHeadings ends{sheet_.given.front().theta, sheet_.given.back().theta};
    if (loop_) {
      const double seam = heading(sheet_.points[1] - sheet_.points[n - 2]);
      ends = {ends.start.value_or(seam), ends.end.value_or(seam)};
    }
    neighbour_ = neighbour_headings(around, ends);
  }

  /// Given headings count modulo a full turn: as they go along with the chords.
  void unwrap() {
    const std::vector<Chord> chords = measure_chords(sheet_.points);
    for (std::size_t i = 0; i < sheet_.theta.size(); ++i) {
      const double before = chords[i > 0 ? i - 1 : 0].omega;
      const double after = chords[std::min(i, chords.size() - 1)].omega;
      sheet_.theta[i] = nearest_angle(sheet_.theta[i], 0.5 * (before + after));
    }
  }

  /// Two or three points lie on one circle: their headings alone say how the curvature goes. It
  /// keeps its sign where they let it.
  void follow_headings() {
    for (std::size_t i = 0; i + 1 < sheet_.points.size(); ++i) {
      const Vec2 chord = sheet_.points[i + 1] - sheet_.points[i];
      const double alpha = turning(chord, unit_at(sheet_.theta[i]));
      const double beta = turning(chord, unit_at(sheet_.theta[i + 1]));
      const double sigma = alpha + beta;
      sheet_.direction[i] = sigma > 0.0 ? 1 : sigma < 0.0 ? -1 : 0;
      const int turn = alpha > 0.0 && beta < 0.0 ? -1 : alpha < 0.0 && beta > 0.0 ? 1 : 0;
      sheet_.sign[i] = i > 0 && sheet_.sign[i] != turn ? 0 : turn;
      sheet_.sign[i + 1] = turn;
    }
  }

  /// Points lie on a circle that their headings do not keep: no arc of it stands there.
  void leave_circles() {
    constexpr double kTyped = 1e-10;               // rad, of headings typed in degrees
    constexpr double kRoundings = 64.0 * 0x1p-53;  // of directions between coordinates
    for (std::size_t i = 0; i + 1 < sheet_.points.size(); ++i) {
      if (sheet_.direction[i] != 0) continue;
      const Vec2 start = sheet_.points[i], chord = sheet_.points[i + 1] - start;
      const double coordinate = std::abs(start.x) + std::abs(start.y) + norm(chord);
      const double kept = kTyped + kRoundings * coordinate / norm(chord);
      const double alpha = turning(chord, unit_at(sheet_.theta[i]));
      const double beta = turning(chord, unit_at(sheet_.theta[i + 1])), sigma = alpha + beta;
      const auto off = [&](double kappa) {
        return std::abs(2.0 * std::sin(beta) - kappa * norm(chord)) > kept;
      };
      const bool bends = std::abs(sigma) > kept;
      if (!bends && !off(sheet_.kappa[i]) && !off(sheet_.kappa[i + 1])) continue;
      sheet_.direction[i] = bends ? std::optional(sigma > 0.0 ? 1 : -1) : std::nullopt;
    }
  }

  /// In the middle of their ranges, where nothing else is known.
  void take_curvatures() {
    const auto ranges = Ranges(sheet_, watch_)(true);
    for (std::size_t i = 0; i < sheet_.kappa.size(); ++i) {
      if (!sheet_.given[i].kappa && ranges[i].kappa)
        sheet_.kappa[i] = some_curvature(ranges[i].kappa);
    }
  }

  /// Elements that a chain has between points carry its freedom; the region of points and tangents
  /// does not know them.
  Result<Worksheet> follow_chain(std::vector<std::string>& warnings) {
    const auto found = chain_section(series_, section_, watch_);
    if (watch_.was_cancelled()) return fail(cancelled_error());
    OBVID_TRY(found);
    warnings.insert(warnings.end(), found->warnings.begin(), found->warnings.end());
    const SeriesChain& chain = found->chain;
    Worksheet out;
    out.loop = loop_;
    for (std::size_t e = 0; e < chain.elements.size(); ++e) {
      if (chain.source[e]) {
        const std::size_t i = *chain.source[e] % series_.points.size();
        out.points.push_back(chain.elements[e].point);
        out.number.push_back(i);
        out.inserted.push_back(0);
        out.given.push_back(series_.fixed.empty() ? FixedData{} : series_.fixed[i]);
        const double theta = chain.elements[e].theta;
        const std::optional<double> given = out.given.back().theta;
        out.theta.push_back(given ? nearest_angle(*given, theta) : theta);
        out.kappa.push_back(chain.elements[e].kappa);
        if (e < chain.direction.size()) out.direction.emplace_back(chain.direction[e]);
      } else if (out.direction.back() && *out.direction.back() != chain.direction[e]) {
        out.direction.back() = std::nullopt;
      }
    }
    out.sign = signs_of_spans(out.kappa, out.direction);
    return out;
  }

  const Prepared& series_;
  const Section& section_;
  TangentRule rule_;
  Watch& watch_;
  bool loop_;
  Worksheet sheet_;
  std::vector<double> neighbour_;  // headings by the neighbours' rule; empty: not asked for
};

void append(RegionPart part, RegionPart& to) {
  const std::size_t before = to.points.size();
  for (RegionRow& row : part.rows) {
    row.from += before;
    row.to += before;
    to.rows.push_back(std::move(row));
  }
  to.points.insert(to.points.end(), part.points.begin(), part.points.end());
  to.loop = part.loop;  // a loop is the only part
}

Result<RegionTable> table_as_asked(const PointSeries& series, const RegionJob& job, Watch& watch) {
  const auto prepared = prepare(series, job.job);
  OBVID_TRY(prepared);
  RegionTable table;
  table.warnings = prepared->warnings;
  table.closed = prepared->closed;
  for (const std::size_t segment : job.insert) {
    if (segment + (prepared->closed ? 0 : 1) < prepared->points.size()) continue;
    return error(ErrorCode::kBadOption, "there is no such segment")
        .where(fmt::format("segment {}", segment + 1))
        .point(segment);
  }
  const bool inserts = job.job.tolerance.has_value() || !job.insert.empty();
  if (inserts) table.refined.emplace();
  for (const Section& section : prepared->split.sections) {
    auto sheet = SheetMaker(*prepared, section, job.rule, watch).run(table.warnings);
    OBVID_TRY(sheet);
    const auto analysis = analyse(sheet->points);
    append(PartMaker(*sheet, analysis ? &*analysis : nullptr, watch).run(), table.user);
    if (watch.was_cancelled()) return fail(cancelled_error());
    if (!inserts) continue;
    std::vector<std::size_t> here;
    for (const std::size_t segment : job.insert) {
      if (std::find(sheet->number.begin(), sheet->number.end(), segment) != sheet->number.end()) {
        here.push_back(segment);
      }
    }
    auto finer = Inserter(*sheet, watch).run(job.job.tolerance, here);
    OBVID_TRY(finer);
    const auto finer_analysis = measure_series(finer->points);
    append(PartMaker(*finer, finer_analysis ? &*finer_analysis : nullptr, watch).run(),
           *table.refined);
    if (watch.was_cancelled()) return fail(cancelled_error());
  }
  if (job.construction) {
    auto made = construct(table.last(), *job.construction, job.fixation);
    OBVID_TRY(made);
    table.construction = std::move(*made);
  }
  table.rows = table.user.rows;
  for (const RegionPoint& p : table.user.points) {
    table.elements.push_back({p.point, p.theta, p.kappa});
  }
  return table;
}

}  // namespace

Result<RegionTable> region_table(const PointSeries& series, const RegionJob& job,
                                 const RunContext& run) {
  Watch watch(run);
  auto made = table_as_asked(series, job, watch);
  const bool parabolas = job.construction == Construction::kParabolas;
  if (watch.was_cancelled()) return fail(cancelled_error());
  if (made || !parabolas || !pipeline_detail::wants_room(job.job, made.error())) return made;
  made = pipeline_detail::with_room(job.job, "the tangents are those of one", std::move(made),
                                    [&](const FitJob& wider) {
                                      RegionJob other = job;
                                      other.job = wider;
                                      return table_as_asked(series, other, watch);
                                    });
  if (watch.was_cancelled()) return fail(cancelled_error());
  return made;
}

}  // namespace obvid
