// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/alignment_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "alignment/drawn_points.h"
#include "alignment/heights.h"
#include "alignment/profile_table.h"
#include "fit/closing_hint.h"
#include "obvid/alignment/internal/transition_law.h"
#include "obvid/certify/internal/crossings.h"
#include "obvid/core/internal/figures.h"
#include "obvid/curve/internal/clothoid.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/io/internal/json_text.h"
#include "obvid/numeric/internal/median.h"
#include "obvid/picture/internal/alignment_svg.h"
#include "obvid/pipeline/audit.h"
#include "obvid/pipeline/element_table.h"
#include "obvid/pipeline/internal/strays_text.h"
#include "obvid/series/internal/order.h"
#include "obvid/series/internal/outliers.h"
#include "obvid/series/internal/scatter.h"
#include "obvid/series/internal/sections.h"

namespace obvid {
namespace {

Result<std::vector<double>> tolerances_of(const PointSeries& series, const AlignmentJob& job,
                                          std::vector<std::string>& remarks) {
  if (job.noise && !(*job.noise > 0.0 && std::isfinite(*job.noise))) {
    return fail({ErrorCode::kBadOption, "the tolerance must be a positive length", "noise",
                 "give it in the units of the points"});
  }
  // what was printed lies anywhere in the cell of its digits: its corners are the farthest, and a
  // line that passes the points askew needs them
  double all = job.noise.value_or(norm(series.rounding));
  if (job.noise_from_scatter) {
    const auto seen =
        pipeline_detail::estimated_noise(series.points, series.units, "--noise auto", remarks);
    OBVID_TRY(seen);
    all = *seen;
  }
  std::vector<double> out(series.points.size(), all);
  for (std::size_t i = 0; i < series.fixed.size(); ++i) {
    if (series.fixed[i].tolerance) out[i] = *series.fixed[i].tolerance;
  }
  const auto bad = std::find_if(out.begin(), out.end(), [](double t) { return !(t > 0.0); });
  if (bad != out.end()) {
    return error(ErrorCode::kBadOption, "an alignment needs a tolerance")
        .where("noise")
        .hint("say how far it may pass the points")
        .point(bad - out.begin())
        .value(*bad);
  }
  return out;
}

Piece piece_of(const AlignmentElement& e, Vec2 end) {
  const Element& a = e.start;
  switch (e.kind) {
    case AlignmentKind::kLine:
      return LinePiece{a.point, end};
    case AlignmentKind::kArc:
      return ArcPiece{a.point, end, a.theta, a.kappa, e.length};
    default:
      break;
  }
  return ClothoidPiece{a.point, end, a.theta, a.kappa, e.kappa1, e.length};
}

/// An arc as pieces that turn by less than half a turn, which is what can be proved of one.
void add_arc_pieces(const AlignmentElement& e, Vec2 end, DrawnCurve& curve) {
  const double turn = std::abs(e.start.kappa) * e.length;
  const int parts = 1 + static_cast<int>(turn / std::numbers::pi);
  AlignmentElement part = e;
  part.length = e.length / parts;
  for (int k = 1; k <= parts; ++k) {
    const Element behind = clothoid_at(part.start, 0.0, part.length);
    const Vec2 to = k == parts ? end : behind.point;
    curve.pieces.emplace_back(piece_of(part, to));
    part.start = {to, behind.theta, e.start.kappa};
  }
}

constexpr int kDrawnSteps = 32;  ///< of a curvature that is not linear

/// Of a tolerance: how near clothoids stay to a transition of another kind.
constexpr double kNearTransition = 1e-3;

/// An element that is no piece, as clothoids.
Result<void> add_transition(const AlignmentElement& e, Vec2 end, double tolerance,
                            DrawnCurve& curve) {
  const Transition kind = transition_of(e.kind);
  auto pieces = clothoids_along(kind, e.start, e.kappa1, e.length, tolerance);
  OBVID_TRY(pieces);
  pieces->back().end = end;
  curve.transitions.push_back(
      {curve.pieces.size(), pieces->size(), kind, e.start.kappa, e.kappa1, e.length});
  curve.pieces.insert(curve.pieces.end(), pieces->begin(), pieces->end());
  return {};
}

Result<DrawnCurve> curve_of(const Alignment& alignment, const std::string& name, double tolerance) {
  DrawnCurve out;
  out.label = name;
  out.closed = alignment.closed;
  for (std::size_t k = 0; k < alignment.elements.size(); ++k) {
    const bool last = k + 1 == alignment.elements.size();
    const AlignmentElement& e = alignment.elements[k];
    const Vec2 end = (last ? alignment.end : alignment.elements[k + 1].start).point;
    if (e.kind == AlignmentKind::kArc) {
      add_arc_pieces(e, end, out);
    } else if (transition_of(e.kind) == Transition::kClothoid) {
      out.pieces.push_back(piece_of(e, end));
    } else {
      OBVID_TRY(add_transition(e, end, tolerance, out));
    }
  }
  return out;
}

/// What was asked for and is not there, and what files without such curves have.
void tell_transitions(const Alignment& alignment, Transition wanted, double near,
                      const Units& units, std::vector<std::string>& remarks) {
  if (wanted == Transition::kClothoid) return;
  std::size_t kept = 0, placed = 0;
  for (const AlignmentElement& e : alignment.elements) {
    if (e.kind == AlignmentKind::kClothoid) ++kept;
    if (transition_of(e.kind) == wanted) ++placed;
  }
  if (kept > 0) {
    remarks.push_back(fmt::format(
        "{} still: no transition of kind {} takes the place within the tolerance",
        kept == 1 ? "one is a clothoid" : fmt::format("{} are clothoids", kept), name_of(wanted)));
  }
  if (placed > 0) {
    remarks.push_back(fmt::format(
        "transitions of kind {} are clothoids within {} {} of them in pictures and files but "
        "LandXML{}",
        name_of(wanted), significant(near, 3), units.text(),
        wanted == Transition::kCubic ? "" : ", and there where they pass an inflection"));
  }
}

/// Of the chords: an alignment that is longer by more, and by more than the tolerances may have
/// shortened them, bows out between points.
constexpr double kDetour = 0.05;

void add_doubts(const std::vector<Vec2>& points, const std::vector<double>& tolerance,
                AlignmentReport& report) {
  const bool closed = report.alignment.closed;
  const int crossings =
      report.stored.certificate ? report.stored.certificate->self_intersections : 0;
  if (crossings > count_crossings_of_chords(points, closed)) {
    report.warnings.push_back(
        fmt::format("the alignment crosses itself {}, more often than the chords between its "
                    "points: points in between or a smaller tolerance say what is meant",
                    crossings == 1 ? "once" : fmt::format("{} times", crossings)));
  }
  double chords = 0.0, room = 0.0;
  for (std::size_t i = closed ? 0 : 1; i < points.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : points.size() - 1;
    chords += norm(points[i] - points[before]);
    room += tolerance[i] + tolerance[before];
  }
  const double longer = report.alignment.length - chords;
  if (longer > kDetour * chords && longer > room) {
    constexpr double kPercent = 100.0;
    report.warnings.push_back(
        fmt::format("the alignment is {} % longer than the chords between its points: it bows out "
                    "where they are far apart",
                    significant(kPercent * longer / chords, 2)));
  }
}

/// Measured points of which some are no points of the curve, or whose tolerance is less than what
/// they scatter by: elements follow what is not meant.
void tell_scatter(const PointSeries& series, const std::vector<double>& tolerance,
                  const AlignmentJob& job, AlignmentReport& report) {
  if (!series.kept.empty()) return;
  std::vector<std::size_t> numbers;
  if (const auto strays = outliers_of(series.points)) {
    for (const Outlier& one : strays->points) {
      if (one.off > tolerance[one.index]) numbers.push_back(one.index + 1);
    }
  }
  if (!numbers.empty()) report.warnings.push_back(pipeline_detail::strays_text(numbers));
  if (job.noise_from_scatter) return;
  const auto seen = scatter_of(series.points);
  const double most = *std::max_element(tolerance.begin(), tolerance.end());
  if (!seen || seen->bound <= most) return;
  report.remarks.push_back(fmt::format(
      "the points scatter by {} {}, which may reach {}: more than the tolerance (--noise auto)",
      significant(seen->deviation, 3), series.units.text(), significant_above(seen->bound, 3)));
}

/// Where elements are not those of a search within all of the tolerance.
void tell_fewer(const Alignment& alignment, std::vector<std::string>& warnings) {
  if (alignment.found_within < 1.0) {
    warnings.push_back(fmt::format(
        "there may be fewer elements: these keep to {} of the tolerance, as searches within all of "
        "it came to none, or to more",
        significant(alignment.found_within, 4)));
  }
  if (alignment.has_chords) {
    warnings.emplace_back(
        "there may be fewer elements: some began as chords between points with rounded corners, "
        "where no search came to others");
  }
}

Result<std::optional<SpeedLimit>> speed_limit(const Units& units,
                                              const std::optional<double>& acceleration) {
  if (!acceleration) return std::optional<SpeedLimit>();
  if (!(*acceleration > 0.0 && std::isfinite(*acceleration))) {
    return fail({ErrorCode::kBadOption, "the acceleration must be positive", "acceleration",
                 "give it in m/s^2"});
  }
  const auto metres = unit_ratio(units, "m", "speeds");
  OBVID_TRY(metres);
  return std::optional(SpeedLimit{*acceleration, *metres});
}

/// How a series without --closed or --open is taken.
enum class Ends {
  kApart,     ///< they do not meet
  kTouching,  ///< they lie within their tolerances, which makes no loop of it
  kMeeting,   ///< a loop
  kRepeated,  ///< a loop, whose last point is the first one
};

/// Whether chords that are longer than what tolerances move their ends by go on from the end of a
/// series to its start.
bool goes_on(const std::vector<Vec2>& points, double reach) {
  constexpr double kFar = 4.0;  // reaches: chords from there show where a curve goes
  constexpr double kTurnWhereItCloses = std::numbers::pi / 3;
  const auto far_from = [&](Vec2 end, bool forwards) {
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n / 2; ++i) {
      const Vec2 p = points[forwards ? i : n - 1 - i];
      if (norm(p - end) > kFar * reach) return p;
    }
    return points[n / 2];
  };
  const Vec2 in = points.back() - far_from(points.back(), false);
  const Vec2 out = far_from(points.front(), true) - points.front();
  return std::abs(turning(in, out)) <= kTurnWhereItCloses;
}

/// Ends that meet as those of fits, where a loop makes sense: their gap is like those of neighbours
/// or small against the length, the tolerances are too, and the curve goes on there.
Ends how_ends_meet(const std::vector<Vec2>& points, const std::vector<double>& tolerance) {
  constexpr double kNeighbours = 2.0;    // middle chords
  constexpr double kOfLength = 0.025;    // of the whole
  constexpr double kLeastLength = 10.0;  // of the whole, in tolerances of both ends
  if (!returns_to_start(points, tolerance.front(), tolerance.back())) return Ends::kApart;
  if (points.front() == points.back()) return Ends::kRepeated;
  std::vector<double> chords;
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    chords.push_back(norm(points[i] - points[i - 1]));
    length += chords.back();
  }
  const double gap = norm(points.back() - points.front());
  const double reach = tolerance.front() + tolerance.back();
  const bool near = gap <= std::max(kNeighbours * median_of(chords), kOfLength * length);
  if (near && length >= kLeastLength * reach && goes_on(points, reach)) return Ends::kMeeting;
  return Ends::kTouching;
}

/// A last point within its tolerance of the first one becomes one with it, as in fits; one that is
/// the first one exactly stays, for its deviation is told.
double join_ends(PointSeries& series, std::vector<double>& tolerance) {
  std::vector<Vec2>& points = series.points;
  const JoinedPoint joined =
      join_points(points.front(), tolerance.front(), points.back(), tolerance.back());
  const double away =
      std::max(norm(joined.point - points.front()), norm(joined.point - points.back()));
  points.front() = joined.point;
  tolerance.front() = joined.tolerance;
  points.pop_back();
  tolerance.pop_back();
  if (!series.fixed.empty()) series.fixed.pop_back();
  return away;
}

/// What makes an alignment that is taken as a loop, but was not asked to be, doubtful.
bool is_doubtful(const Alignment& loop) { return loop.has_chords || loop.found_within < 1.0; }

/// A loop that was not asked for is no better than the open curve.
bool is_no_better(const Alignment& loop, const Alignment& open) {
  return is_doubtful(open) ? loop.elements.size() > open.elements.size() + 1 : true;
}

/// Finds the alignment of a series that is closed or not as the job says, or as its ends say; the
/// points and tolerances are those that it was found of then.
Result<Alignment> found_alignment(PointSeries& series, std::vector<double>& tolerance,
                                  AlignmentOptions limits, const AlignmentJob& job, bool drawn,
                                  AlignmentReport& report, const RunContext& run) {
  if (job.closing != Closing::kAutomatic) {
    limits.closed = job.closing == Closing::kClosed;
    return fit_alignment(series.points, tolerance, limits, run);
  }
  const Ends ends = how_ends_meet(series.points, tolerance);
  limits.closed = false;
  if (ends == Ends::kApart) {
    auto hint = pipeline_detail::hint_at_closing(series.points, series.units);
    if (hint && !drawn) report.warnings.push_back(std::move(*hint));
    return fit_alignment(series.points, tolerance, limits, run);
  }
  if (ends == Ends::kTouching) {
    report.remarks.emplace_back(
        "the ends lie within their tolerances of each other, but nothing else says that it goes "
        "around: taken as open (--closed closes it)");
    return fit_alignment(series.points, tolerance, limits, run);
  }
  PointSeries around = series;
  std::vector<double> tolerance_around = tolerance;
  const double away = ends == Ends::kRepeated ? 0.0 : join_ends(around, tolerance_around);
  limits.closed = true;
  auto loop = fit_alignment(around.points, tolerance_around, limits, run);
  if (!loop && loop.error().code == ErrorCode::kCancelled) return loop;
  if (!loop || (ends == Ends::kMeeting && is_doubtful(*loop))) {
    limits.closed = false;
    auto open = fit_alignment(series.points, tolerance, limits, run);
    if (!open && (!loop || open.error().code == ErrorCode::kCancelled)) return open;
    if (open && (!loop || is_no_better(*loop, *open))) {
      report.warnings.push_back(fmt::format(
          "the ends meet within their tolerances, but as a loop {}: taken as open (--closed asks "
          "for the loop)",
          loop ? "there are no better elements" : "there are no elements"));
      return open;
    }
  }
  series = std::move(around);
  tolerance = std::move(tolerance_around);
  if (ends == Ends::kRepeated) {
    report.remarks.emplace_back("the last point is the first one: closed (--open leaves it open)");
  } else {
    const Vec2 joined = series.points.front();
    report.warnings.push_back(fmt::format(
        "taken as a loop: the last point lies within its tolerance of the first one, and both "
        "became one at {}, {}, up to {} from them; --open keeps both",
        significant(joined.x, 9), significant(joined.y, 9), significant_above(away, 4)));
  }
  return loop;
}

/// Down to so many digits: a limit that is told is one that is kept.
std::string rounded_down(double value) {
  constexpr int kDigits = 4;
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - kDigits + 1);
  return significant(std::floor(value / unit) * unit, kDigits);
}

/// Names the limits that nothing was found with, and what elements without them keep.
void tell_limits(const PointSeries& series, const std::vector<double>& tolerance,
                 AlignmentOptions limits, bool closed, Error& error, const RunContext& run) {
  const bool by_search =
      error.code == ErrorCode::kNoSpiral || error.code == ErrorCode::kToleranceNotReached;
  const bool lengths = limits.least_length > 0.0, radii = limits.least_radius > 0.0;
  if (!by_search || (!lengths && !radii) || limits.without_steps) return;
  const char* named = lengths && radii ? "smaller --min-length and --min-radius"
                      : lengths        ? "a smaller --min-length"
                                       : "a smaller --min-radius";
  const std::size_t others = error.hint.find(", or set ");  // that there are not yet
  const std::string rest = others == std::string::npos ? "" : error.hint.substr(others);
  const std::string advice = fmt::format("allow a larger --noise, or {}", named);
  error.hint = advice + rest;
  limits.least_length = limits.least_radius = 0.0;
  limits.closed = closed;
  const auto free = fit_alignment(series.points, tolerance, limits, without_progress(run));
  if (!free) return;
  double shortest = HUGE_VAL, sharpest = 0.0;
  for (const AlignmentElement& e : free->elements) {
    shortest = std::min(shortest, e.length);
    sharpest = std::max({sharpest, std::abs(e.start.kappa), std::abs(e.kappa1)});
  }
  std::string kept;
  if (lengths) kept = "--min-length " + rounded_down(shortest);
  if (radii && sharpest > 0.0) {
    kept += (kept.empty() ? "" : " with ") + ("--min-radius " + rounded_down(1.0 / sharpest));
  }
  if (!kept.empty()) error.hint = fmt::format("{} ({} was found to do){}", advice, kept, rest);
}

double first_station(const AlignmentJob& job, const Units& units,
                     std::vector<std::string>& remarks) {
  if (job.first_station) return *job.first_station;
  const double out = job.road.station.value_or(0.0);
  if (out != 0.0) {
    remarks.push_back(fmt::format(
        "stations begin at {:.10g} {}, as in the file; --station says another", out, units.text()));
  }
  return out;
}

}  // namespace

Result<AlignmentReport> alignment_report(const PointSeries& given, const AlignmentJob& job,
                                         const RunContext& run) {
  AlignmentReport out;
  OBVID_TRY(pipeline_detail::drawn_curve_has_tolerance(given, job.noise.has_value()));
  PointSeries series =
      pipeline_detail::with_drawn_points(given, job.noise.value_or(0.0), out.remarks, out.warnings);
  auto tolerance = tolerances_of(series, job, out.remarks);
  OBVID_TRY(tolerance);
  const auto limit = speed_limit(series.units, job.acceleration);
  OBVID_TRY(limit);
  AlignmentOptions limits;
  limits.least_length = job.least_length;
  limits.least_radius = job.least_radius;
  limits.transitions = job.transitions;
  limits.without_transitions = job.without_transitions;
  limits.without_steps = job.without_steps;
  auto alignment = found_alignment(series, *tolerance, limits, job, !given.kept.empty(), out, run);
  if (!alignment) {
    tell_limits(series, *tolerance, limits, job.closing == Closing::kClosed, alignment.error(),
                run);
  }
  if (auto hint = no_order_hint(series.points)) {
    if (alignment) {
      out.warnings.push_back(std::move(*hint));
    } else if (alignment.error().code != ErrorCode::kCancelled) {
      alignment.error().hint = std::move(*hint);
    }
  }
  OBVID_TRY(alignment);
  const double first = first_station(job, series.units, out.remarks);
  for (AlignmentElement& e : alignment->elements) e.station += first;
  for (AlignmentDeviation& d : alignment->deviations) d.station += first;
  auto profile = pipeline_detail::profile_report(series, *alignment, job, out.remarks, run);
  OBVID_TRY(profile);
  out.profile = std::move(*profile);
  out.name = series.label.empty() ? series.name : series.label;
  out.units = series.units;
  out.tolerance = *std::max_element(tolerance->begin(), tolerance->end());
  const double near = kNearTransition * *std::min_element(tolerance->begin(), tolerance->end());
  const auto drawn = curve_of(*alignment, series.name, near);
  OBVID_TRY(drawn);
  auto audited = audit(*drawn, series.units, without_progress(run));
  OBVID_TRY(audited);
  out.transitions = std::move(audited->transitions);
  tell_transitions(*alignment, job.transitions, near, series.units, out.remarks);
  out.stored = {std::move(audited->contour), std::nullopt, std::move(audited->certificate)};
  out.alignment = std::move(*alignment);
  add_doubts(series.points, *tolerance, out);
  tell_scatter(series, *tolerance, job, out);
  tell_fewer(out.alignment, out.warnings);
  out.points = series.points;
  out.limit = *limit;
  return out;
}

std::string kinds_text(const Alignment& alignment) {
  std::array<std::size_t, kAlignmentKinds> count{};
  for (const auto& e : alignment.elements) ++count[static_cast<std::size_t>(e.kind)];
  std::string out =
      fmt::format("{}, {}, {}", counted(count[0], "line", "lines"),
                  counted(count[1], "arc", "arcs"), counted(count[2], "clothoid", "clothoids"));
  for (std::size_t k = 3; k < count.size(); ++k) {
    if (count[k] == 0) continue;
    out += fmt::format(", {} {}", count[k], to_string(static_cast<AlignmentKind>(k)));
  }
  return out;
}

std::string alignment_verdict(const AlignmentReport& report) {
  return fmt::format("{}; all points within {} {}", kinds_text(report.alignment),
                     tolerance_text(report.tolerance), report.units.text());
}

std::string alignment_picture(const AlignmentReport& report) {
  AlignmentDiagram diagram;
  for (const AlignmentElement& e : report.alignment.elements) {
    AlignmentDiagram::Part part{e.station, e.length, "", {}};
    const Transition law = transition_of(e.kind);
    const int steps = law == Transition::kClothoid ? 1 : kDrawnSteps;
    const TransitionLaw along(law, e.start.kappa, e.kappa1, e.length);
    for (int k = 0; k <= steps; ++k) {
      const double share = along.share(static_cast<double>(k) / steps);
      part.curvatures.push_back(e.start.kappa + (e.kappa1 - e.start.kappa) * share);
    }
    const double parameter = clothoid_parameter(e);
    if (e.kind == AlignmentKind::kArc) {
      part.label = "R " + significant(1.0 / e.start.kappa, 4);
    } else if (parameter > 0.0) {
      part.label = "A " + significant(parameter, 4);
    } else if (law != Transition::kClothoid) {
      part.label = name_of(law);
    }
    diagram.parts.push_back(std::move(part));
  }
  if (report.limit) {
    constexpr double kKmhPerMs = 3.6;
    diagram.speed_scale = kKmhPerMs * std::sqrt(report.limit->acceleration * report.limit->metres);
  }
  if (report.profile) {
    diagram.profile = report.profile->profile;
    diagram.heights = report.profile->heights;
  }
  return alignment_svg(report.stored, {report.name, alignment_verdict(report)}, diagram);
}

DataTable deviation_rows(const AlignmentReport& report) {
  const std::vector<Vec2>& points = report.points;
  const bool has_heights = report.profile && !report.profile->of_file;
  DataTable out{
      heads_of(has_heights ? "station,offset,x,y,height,height_offset" : "station,offset,x,y")};
  const bool beside = has_heights && report.profile->of_points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const AlignmentDeviation& d = report.alignment.deviations[i];
    out.rows.push_back({d.station, d.offset, points[i].x, points[i].y});
    if (!beside) continue;
    out.rows.back().emplace_back(report.profile->heights[i].y);
    out.rows.back().emplace_back(report.profile->profile.offsets[i]);
  }
  if (!has_heights || beside) return out;
  for (std::size_t i = 0; i < report.profile->heights.size(); ++i) {
    const Vec2 at = report.profile->heights[i];
    out.rows.push_back({at.x, {}, {}, {}, at.y, report.profile->profile.offsets[i]});
  }
  return out;
}

std::string alignment_json(const AlignmentReport& report) {
  const Alignment& alignment = report.alignment;
  JsonText json;
  json.begin_object().pair("format", "obvid-alignment").pair("version", 1);
  json.pair("name", report.name).pair("units", report.units.text());
  json.pair("tolerance", report.tolerance).pair("length", alignment.length);
  json.pair("closed", alignment.closed);
  json.pair("largest_share", alignment.largest_share).pair("rms", alignment.rms);
  json.pair("curvature_steps", curvature_steps(alignment.elements));
  json.key("elements");
  add_elements(json, alignment.elements, report.limit);
  json.key("deviations").begin_array();
  for (const AlignmentDeviation& d : alignment.deviations) {
    json.begin_object().pair("station", d.station).pair("offset", d.offset).end_object();
  }
  json.end_array();
  if (report.profile) {
    json.key("profile");
    pipeline_detail::add_profile(json, *report.profile);
  }
  const auto add_sentences = [&](const char* key, const std::vector<std::string>& sentences) {
    if (sentences.empty()) return;
    json.key(key).begin_array();
    for (const std::string& sentence : sentences) json.value(sentence);
    json.end_array();
  };
  add_sentences("remarks", report.remarks);
  add_sentences("warnings", report.warnings);
  json.end_object();
  return json.take();
}

std::vector<std::string> warnings_of_reading(const PointSeries& series, const AlignmentJob& job) {
  std::vector<std::string> out;
  if (job.heights) out = job.heights->warnings;
  out.insert(out.end(), series.warnings.begin(), series.warnings.end());
  return out;
}

TitledContour titled_contour(const AlignmentReport& made, const PointSeries& series,
                             const AlignmentJob& job, const std::string& input) {
  TitledContour out;
  out.stored = made.stored;
  out.name = made.name;
  out.source = input;
  out.first_station = made.alignment.elements.front().station;
  out.transitions = made.transitions;
  if (made.profile) out.profile = made.profile->profile;
  out.picture = {series.name, alignment_verdict(made)};
  out.warnings = warnings_of_reading(series, job);
  out.warnings.insert(out.warnings.end(), made.warnings.begin(), made.warnings.end());
  return out;
}

std::optional<std::string> alignment_file(FileFormat format, const AlignmentReport& made) {
  if (format == FileFormat::kPicture) return alignment_picture(made);
  if (format != FileFormat::kSamples) return std::nullopt;
  return csv_text(element_rows(made.alignment.elements, made.limit));
}

}  // namespace obvid
