// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "contour_json_names.h"
#include "contour_json_values.h"
#include "obvid/alignment/internal/profile_figures.h"
#include "obvid/certify/internal/limits.h"
#include "obvid/contour/bsplines/nurbs_of.h"
#include "obvid/io/contour_json.h"
#include "obvid/region/internal/refine.h"
#include "text_lines.h"

namespace obvid {
namespace {

/// A figure that the contract does not ask for and the file does not give.
constexpr double kNoClaim = std::numeric_limits<double>::quiet_NaN();

using nlohmann::json;
using std::string_view;

/// Turns the parsed values into a contour.
class ContourReader : private JsonValues {
 public:
  using JsonValues::JsonValues;

  Result<StoredContour> read(const json& document);

 private:
  void one_nurbs(const Node& node);
  void read_head(const Node& root);
  void read_contour(const Node& root);
  std::vector<double> point_tolerance(const Node& node);
  Joint joint(const Node& node);
  void kept(const Node& node);
  void corner(const Node& node, Joint& joint);
  void between(const Node& node, Joint& joint);
  void check_ends(const Node& elements);
  void check_range();
  Piece piece(const Node& node);
  ArcPiece arc(const Node& node);
  ClothoidPiece clothoid(const Node& node);
  RationalBezier bezier(const Node& node);
  void exact_points(const Node& exact, const Node& points, RationalBezier& bezier);
  Run run(const Node& node);
  StoredAlignment alignment(const Node& node);
  PlacedTransition transition(const Node& node, std::size_t from);
  VerticalProfile profile(const Node& node);
  [[nodiscard]] bool rows_fit(std::size_t rows) const;
  std::vector<double> moves(const Node& node);
  GivenDatum given(const Node& node);
  ValueRange range(const Node& node);
  ActiveRange active(const Node& node);
  GivenReport given_report(const Node& node);
  FitReport report(const Node& node);
  SegmentReport segment(const Node& node);
  Certificate certificate(const Node& node);
  PieceProof proof(const Node& node, std::size_t expected);

  StoredContour stored_;
};

// ---- contour ---------------------------------------------------------------------------------

void ContourReader::read_head(const Node& root) {
  const Node format = field(root, "format");
  if (word(format) != contour_json::kFormat) refuse(format, "this is no contour file");
  const Node version = field(root, "version");
  if (integer(version, 1, kMaxInt) != contour_json::kVersion) {
    refuse(version, ErrorCode::kUnsupported, "this program reads version 1 only");
  }
  Contour& contour = stored_.contour;
  contour.units = word(field(root, "units"));
  unit_source(root, stored_.contour.units);
  contour.closed = flag(field(root, "closed"));
  const Node carrier = field(root, "carrier");
  const std::string kind = word(carrier);
  if (const auto one = carrier_of(kind)) {
    contour.carrier = *one;
  } else {
    refuse(carrier, ErrorCode::kUnsupported, "carrier " + text::shown(kind) + " is not known");
  }
  if (const auto node = optional_field(root, "continuity")) {
    const std::string name = word(*node);
    const auto continuity = continuity_of(name);
    if (!continuity) refuse(*node, text::shown(name) + " is no continuity: G2 or G3");
    contour.continuity = continuity.value_or(Continuity::kG2);
  }
}

void ContourReader::read_contour(const Node& root) {
  Contour& contour = stored_.contour;
  each(field(root, "points"), [&](const Node& node) { contour.points.push_back(point(node)); });
  if (const auto node = optional_field(root, "point_tolerance")) {
    contour.point_tolerance = point_tolerance(*node);
  }
  if (const auto list = optional_field(root, "given")) {
    each(*list, [&](const Node& node) { contour.given.push_back(given(node)); });
  }
  const Node elements = field(root, "elements");
  each(elements, [&](const Node& node) { contour.joints.push_back(joint(node)); });
  const Node pieces = field(root, "pieces");
  each(pieces, [&](const Node& node) { contour.pieces.push_back(piece(node)); });
  if (contour.pieces.empty()) refuse(pieces, "a contour has at least one piece");
  const std::size_t joints = contour.joints.size();
  const std::size_t around = contour.pieces.size();
  const bool fits = joints == around + 1 || (contour.closed && joints == around);
  if (!fits) {
    refuse(elements,
           std::to_string(joints) + " elements do not fit " + std::to_string(around) + " pieces");
  }
  check_ends(elements);
  check_range();
  if (const auto node = optional_field(root, "bspline")) one_nurbs(*node);
  each(field(root, "runs"), [&](const Node& node) { contour.runs.push_back(run(node)); });
  if (const auto node = optional_field(root, "kept")) kept(*node);
}

/// Numbers of pieces, ascending.
void ContourReader::kept(const Node& node) {
  Contour& contour = stored_.contour;
  each(node, [&](const Node& one) {
    contour.kept.push_back(index(one, contour.pieces.size(), "pieces"));
    const std::size_t count = contour.kept.size();
    if (count > 1 && contour.kept[count - 2] >= contour.kept[count - 1]) {
      refuse(one, "numbers of pieces ascend");
    }
  });
}

/// One for each point, or none at all.
std::vector<double> ContourReader::point_tolerance(const Node& node) {
  std::vector<double> tolerance;
  each(node, [&](const Node& one) {
    tolerance.push_back(number(one));
    if (tolerance.back() < 0.0) refuse(one, "a tolerance is not negative");
  });
  const std::size_t points = stored_.contour.points.size();
  if (!tolerance.empty() && tolerance.size() != points) {
    refuse(node, std::to_string(tolerance.size()) + " tolerances do not fit " +
                     std::to_string(points) + " points");
  }
  return tolerance;
}

Joint ContourReader::joint(const Node& node) {
  Joint joint;
  joint.element.point = point(field(node, "point"));
  joint.element.theta = number(field(node, "heading"));
  joint.element.kappa = number_or_nan(field(node, "kappa"));
  const auto source = optional_field(node, "source");
  if (source && !source->value->is_null()) {
    joint.source = index(*source, stored_.contour.points.size(), "points");
  }
  corner(node, joint);
  joint.slope_step = optional_flag(node, "slope_step", false);
  between(node, joint);
  return joint;
}

/// The points on both sides of a corner that stands on none.
void ContourReader::between(const Node& node, Joint& joint) {
  const auto both = optional_field(node, "between");
  if (!both) return;
  const std::size_t count = stored_.contour.points.size();
  std::vector<std::size_t> points;
  each(*both, [&](const Node& one) { points.push_back(index(one, count, "points")); });
  if (failed()) return;
  if (joint.source || !joint.leaving) {
    refuse(*both, "the field stands at corners that stand on no point only");
  } else if (points.size() != 2 || points[1] != (points[0] + 1) % count) {
    refuse(*both, "a corner lies between two neighbouring points");
  } else {
    joint.after = points[0];
  }
}

/// Heading and curvature behind a corner stand there and nowhere else: where the mark is taken
/// away, what is left must not look like a smooth joint.
void ContourReader::corner(const Node& node, Joint& joint) {
  if (optional_flag(node, "corner", false) || optional_flag(node, "curvature_step", false)) {
    joint.leaving = Element{joint.element.point, number(field(node, "heading_out")),
                            number_or_nan(field(node, "kappa_out"))};
    return;
  }
  for (const string_view key : {"heading_out", "kappa_out"}) {
    if (const auto given = optional_field(node, key)) {
      refuse(*given, "the field stands at corners and steps of the curvature only");
    }
  }
}

/// Nothing leaves the end of an open contour and nothing arrives at its start.
void ContourReader::check_ends(const Node& elements) {
  const std::vector<Joint>& joints = stored_.contour.joints;
  if (failed() || stored_.contour.closed) return;
  for (const std::size_t i : {std::size_t{0}, joints.size() - 1}) {
    if (!joints[i].leaving) continue;
    refuse({&(*elements.value)[i], &elements, {}, i},
           "an open contour has no corner and no step at its ends");
  }
}

/// What `fit` would not form is not proved either; said here, it has its place.
void ContourReader::check_range() {
  if (failed()) return;
  const auto number = out_of_range(stored_.contour);
  if (!number) return;
  const json nothing;
  const Node root{&nothing, nullptr, {}, 0}, list{&nothing, &root, number->list};
  refuse(number->list.empty() ? root : Node{&nothing, &list, {}, number->index}, number->code,
         number->what);
}

Piece ContourReader::piece(const Node& node) {
  const Node type = field(node, "type");
  const std::string kind = word(type);
  if (kind == "bezier") return bezier(node);
  if (kind == "arc") return arc(node);
  if (kind == "clothoid") return clothoid(node);
  LinePiece line;
  if (kind == "line") {
    line.start = point(field(node, "start"));
    line.end = point(field(node, "end"));
  } else {
    refuse(type, ErrorCode::kUnsupported,
           "pieces of type " + text::shown(kind) + " are not supported yet");
  }
  return line;
}

ArcPiece ContourReader::arc(const Node& node) {
  ArcPiece arc;
  arc.start = point(field(node, "start"));
  arc.end = point(field(node, "end"));
  arc.theta0 = number(field(node, "theta0"));
  const Node kappa = field(node, "kappa");
  arc.kappa = number(kappa);
  if (arc.kappa == 0.0) refuse(kappa, "the curvature of an arc is not 0");
  const Node length = field(node, "length");
  arc.length = number(length);
  if (!(arc.length > 0.0)) refuse(length, "the length of an arc is above 0");
  return arc;
}

ClothoidPiece ContourReader::clothoid(const Node& node) {
  ClothoidPiece clothoid;
  clothoid.start = point(field(node, "start"));
  clothoid.end = point(field(node, "end"));
  clothoid.theta0 = number(field(node, "theta0"));
  clothoid.kappa0 = number(field(node, "kappa0"));
  clothoid.kappa1 = number(field(node, "kappa1"));
  const Node length = field(node, "length");
  clothoid.length = number(length);
  if (!(clothoid.length > 0.0)) refuse(length, "the length of a clothoid is above 0");
  return clothoid;
}

RationalBezier ContourReader::bezier(const Node& node) {
  RationalBezier bezier;
  const Node points = field(node, "points");
  const std::size_t size = !failed() && points.value->is_array() ? points.value->size() : 0;
  if (size < 2 || size > bezier.offset.size()) {
    refuse(points, "a piece has 2 to " + std::to_string(bezier.offset.size()) + " points");
    return bezier;
  }
  bezier.degree = static_cast<int>(size) - 1;
  each(points, [&](const Node& one) { bezier.offset[one.index] = point(one); });
  std::fill_n(bezier.weight.begin(), size, 1.0);
  if (const auto weights = optional_field(node, "weights")) {
    if (!weights->value->is_array() || weights->value->size() != size) {
      refuse(*weights, "one weight for each point is expected");
      return bezier;
    }
    each(*weights, [&](const Node& one) {
      bezier.weight[one.index] = number(one);
      if (!(bezier.weight[one.index] > 0.0)) refuse(one, "a weight is above 0");
    });
  }
  if (const auto exact = optional_field(node, "exact")) exact_points(*exact, points, bezier);
  return bezier;
}

// "exact" holds the points without rounding; "points" must be what they round to, so that both
// readers of one and of the other see the same curve.
void ContourReader::exact_points(const Node& exact, const Node& points, RationalBezier& bezier) {
  bezier.origin = point(field(exact, "origin"));
  const Node offsets = field(exact, "offsets");
  if (failed()) return;
  const auto size = static_cast<std::size_t>(bezier.degree) + 1;
  if (!offsets.value->is_array() || offsets.value->size() != size) {
    return refuse(offsets, "one offset for each point is expected");
  }
  each(offsets, [&](const Node& one) {
    const Vec2 offset = point(one);
    const bool same = bezier.origin + offset == bezier.offset[one.index];
    if (!failed() && !same) {
      refuse({&(*points.value)[one.index], &points, {}, one.index},
             "the point is not the rounded sum of origin and offset in \"exact\"");
    }
    bezier.offset[one.index] = offset;
  });
}

/// The one curve must be the one that the pieces make: nothing else would prove it.
void ContourReader::one_nurbs(const Node& node) {
  NurbsCurve curve;
  curve.degree = static_cast<int>(integer(field(node, "degree"), 1, kMaxBezierDegree));
  each(field(node, "knots"), [&](const Node& one) { curve.knots.push_back(number(one)); });
  each(field(node, "points"), [&](const Node& one) { curve.points.push_back(point(one)); });
  const auto weights = optional_field(node, "weights");
  if (weights) {
    each(*weights, [&](const Node& one) { curve.weights.push_back(number(one)); });
  } else {
    curve.weights.assign(curve.points.size(), 1.0);
  }
  if (failed()) return;
  const auto own = nurbs_of(stored_.contour, {false});
  if (!own || own->curve != curve) {
    refuse(node, "the bspline is not the curve of the pieces, piece by piece");
  }
}

Run ContourReader::run(const Node& node) {
  const std::size_t pieces = stored_.contour.pieces.size();
  Run run;
  const Node last = field(node, "last_piece");
  run.first_piece = index(field(node, "first_piece"), pieces, "pieces");
  run.last_piece = index(last, pieces, "pieces");
  if (!failed() && run.last_piece < run.first_piece) refuse(last, "the run ends before it begins");
  run.direction = static_cast<int>(integer(field(node, "direction"), -1, 1));
  return run;
}

// ---- alignments ------------------------------------------------------------------------------

StoredAlignment ContourReader::alignment(const Node& node) {
  StoredAlignment out;
  out.first_station = number(field(node, "first_station"));
  if (const auto list = optional_field(node, "transitions")) {
    std::size_t from = 0;
    each(*list, [&](const Node& one) {
      out.transitions.push_back(transition(one, from));
      from = out.transitions.back().first_piece + out.transitions.back().pieces;
    });
  }
  if (const auto heights = optional_field(node, "profile")) out.profile = profile(*heights);
  return out;
}

/// Clothoids alone stand for one, each for one at most: `from` is the first that may.
PlacedTransition ContourReader::transition(const Node& node, std::size_t from) {
  PlacedTransition out;
  const std::vector<Piece>& pieces = stored_.contour.pieces;
  const Node first = field(node, "first_piece"), kind = field(node, "kind");
  out.first_piece = index(first, pieces.size(), "pieces");
  out.pieces = static_cast<std::size_t>(
      integer(field(node, "pieces"), 1, static_cast<long long>(pieces.size())));
  const auto named = transition_named(word(kind));
  out.kappa0 = number(field(node, "kappa_start"));
  out.kappa1 = number(field(node, "kappa_end"));
  const Node length = field(node, "length");
  out.length = number(length);
  if (failed()) return out;
  if (!named) {
    refuse(kind, "this is no kind of transitions");
    return out;
  }
  out.kind = *named;
  if (!(out.length > 0.0)) refuse(length, "the length of a transition is above 0");
  if (turns_too_far(out.kappa0, out.kappa1, out.length)) {
    refuse(length, "a transition turns by a hundred turns at most");
  }
  const std::size_t end = out.first_piece + out.pieces;
  bool fits = out.first_piece >= from && end <= pieces.size();
  for (std::size_t i = out.first_piece; fits && i < end; ++i) {
    fits = std::holds_alternative<ClothoidPiece>(pieces[i]);
  }
  if (!fits) refuse(first, "clothoids stand for a transition, one after the other");
  return out;
}

/// Whether an element ends at the station and height where the next one begins.
bool goes_on(const ProfileElement& e, const ProfileElement& next, ProfileCurves curves) {
  constexpr double kSamePlace = 1e-6;  // of a length, and of the numbers themselves
  const double slack =
      kSamePlace * (e.length + std::abs(next.station) + std::abs(next.height) + std::abs(e.height));
  return std::abs(e.station + e.length - next.station) <= slack &&
         std::abs(end_height(e, curves) - next.height) <= slack;
}

VerticalProfile ContourReader::profile(const Node& node) {
  VerticalProfile out;
  const auto pick = [&](const Node& name, const auto& names) {
    const auto found = std::find(names.begin(), names.end(), word(name));
    if (!failed() && found == names.end()) refuse(name, "this word is not known here");
    return failed() ? std::size_t{0} : static_cast<std::size_t>(found - names.begin());
  };
  out.curves = static_cast<ProfileCurves>(pick(field(node, "curves"), kProfileCurveNames));
  const Node elements = field(node, "elements");
  each(elements, [&](const Node& one) {
    ProfileElement e;
    e.kind = static_cast<ProfileKind>(pick(field(one, "kind"), kProfileKindNames));
    e.station = number(field(one, "station"));
    const Node length = field(one, "length");
    e.length = number(length);
    if (!(e.length > 0.0)) refuse(length, "the length of an element is above 0");
    e.height = number(field(one, "height"));
    e.grade0 = number(field(one, "grade_start"));
    e.grade1 = number(field(one, "grade_end"));
    e.radius = number(field(one, "radius"));
    if (!failed() && !out.elements.empty() && !goes_on(out.elements.back(), e, out.curves)) {
      refuse(one, "an element begins where the one before it ends");
    }
    out.elements.push_back(e);
  });
  if (out.elements.empty()) refuse(elements, "a profile has at least one element");
  ProfileElement end;
  const Node last = field(node, "end_station");
  end.station = out.end_station = number(last);
  end.height = out.end_height = number(field(node, "end_height"));
  if (!failed() && !goes_on(out.elements.back(), end, out.curves)) {
    refuse(last, "a profile ends where its last element does");
  }
  return out;
}

// ---- claims ----------------------------------------------------------------------------------

SegmentReport ContourReader::segment(const Node& node) {
  SegmentReport row;
  if (const auto points = optional_field(node, "points")) {
    std::vector<std::size_t> ends;
    const std::size_t n = stored_.contour.points.size();
    each(*points, [&](const Node& one) { ends.push_back(index(one, n, "points")); });
    if (ends.size() != 2) {
      refuse(*points, "the two points of the segment are expected");
    } else {
      row.from = ends[0];
      row.to = ends[1];
    }
  }
  row.chord = figure(node, "chord");
  row.points_only_error = figure(node, "points_only_error");
  row.width = figure(node, "width");
  row.width_unrefined = kNoClaim;
  if (const auto width = optional_field(node, "width_unrefined")) {
    row.width_unrefined = number(*width);
  }
  row.deviation = figure(node, "deviation");
  row.deviation_at = {kNoClaim, kNoClaim};
  if (const auto place = optional_field(node, "deviation_at")) row.deviation_at = point(*place);
  row.inserted = optional_count(node, "inserted");
  return row;
}

/// One row for each chord of the points. Points with tolerances need not be joints: rows are then
/// the parts between two joints that stand for points.
bool ContourReader::rows_fit(std::size_t rows) const {
  const Contour& contour = stored_.contour;
  const std::size_t points = contour.points.size();
  const std::size_t chords = contour.closed || points == 0 ? points : points - 1;
  // A closed series may repeat its first point at the end or not.
  if (rows == chords || (contour.closed && rows + 1 == chords)) return true;
  if (contour.point_tolerance.empty()) return false;
  std::size_t parts = 1;
  for (std::size_t i = 1; i < contour.pieces.size(); ++i) {
    if (is_station(contour.joints[i])) ++parts;
  }
  // points between joints have a row each where the contour passes them in order
  const bool between = info_of(contour.carrier).between_joints;
  const auto cuts = static_cast<std::size_t>(  // chords that are two rows
      std::count_if(contour.joints.begin(), contour.joints.end(),
                    [](const Joint& joint) { return !joint.source && joint.after; }));
  return between ? rows >= parts && rows <= chords + cuts : rows == parts;
}

std::vector<double> ContourReader::moves(const Node& node) {
  std::vector<double> moves;
  each(node, [&](const Node& one) { moves.push_back(number_or_nan(one)); });
  const std::size_t points = stored_.contour.points.size();
  if (!moves.empty() && moves.size() != points) {
    refuse(node, std::to_string(moves.size()) + " moves do not fit " + std::to_string(points) +
                     " points");
  }
  return moves;
}

GivenDatum ContourReader::given(const Node& node) {
  GivenDatum one;
  one.point = index(field(node, "point"), stored_.contour.points.size(), "points");
  if (const auto theta = optional_field(node, "heading")) one.theta = number(*theta);
  if (const auto kappa = optional_field(node, "kappa")) one.kappa = number(*kappa);
  if (const auto thetas = optional_field(node, "heading_range")) one.thetas = range(*thetas);
  if (const auto kappas = optional_field(node, "kappa_range")) one.kappas = range(*kappas);
  one.corner = optional_flag(node, "corner", false);
  const std::vector<GivenDatum>& before = stored_.contour.given;
  if (!before.empty() && !failed() && one.point <= before.back().point) {
    refuse(node, "given data stand in the order of their points");
  }
  return one;
}

/// Two ends, null where there is none.
ValueRange ContourReader::range(const Node& node) {
  std::vector<double> ends;
  each(node, [&](const Node& end) { ends.push_back(number_or_nan(end)); });
  ValueRange out;
  if (failed()) return out;
  if (ends.size() != 2) {
    refuse(node, "a range has two ends");
    return out;
  }
  if (!std::isnan(ends[0])) out.low = ends[0];
  if (!std::isnan(ends[1])) out.high = ends[1];
  if (out.empty()) refuse(node, "the least value of a range is larger than the greatest");
  return out;
}

ActiveRange ContourReader::active(const Node& node) {
  ActiveRange out;
  out.point = index(field(node, "point"), stored_.contour.points.size(), "points");
  const Node datum = field(node, "datum"), end = field(node, "end");
  const std::string what = word(datum), which = word(end);
  if (failed()) return out;
  if (what != "heading" && what != "curvature") refuse(datum, "heading or curvature is expected");
  if (which != "least" && which != "greatest") refuse(end, "least or greatest is expected");
  out.heading = what == "heading";
  out.high = which == "greatest";
  return out;
}

GivenReport ContourReader::given_report(const Node& node) {
  GivenReport out;
  out.headings = optional_count(node, "headings");
  out.curvatures = optional_count(node, "curvatures");
  out.corners = optional_count(node, "corners");
  out.heading_miss = optional_figure(node, "heading_miss", 0.0);
  out.curvature_miss = optional_figure(node, "curvature_miss", 0.0);
  out.heading_ranges = optional_count(node, "heading_ranges");
  out.curvature_ranges = optional_count(node, "curvature_ranges");
  if (const auto list = optional_field(node, "active")) {
    each(*list, [&](const Node& one) { out.active.push_back(active(one)); });
  }
  return out;
}

/// What the rows imply for a file that does not claim it.
double largest_deviation(Carrier carrier, const std::vector<SegmentReport>& rows) {
  double most = promises_monotone(carrier) ? 0.0 : kNoClaim;
  for (const SegmentReport& row : rows) {
    if (row.deviation > most) most = row.deviation;
  }
  return most;
}

FitReport ContourReader::report(const Node& node) {
  FitReport report;
  const Node segments = field(node, "segments");
  each(segments, [&](const Node& one) { report.segments.push_back(segment(one)); });
  if (!failed() && !rows_fit(report.segments.size())) {
    refuse(segments, std::to_string(report.segments.size()) + " segments do not fit " +
                         std::to_string(stored_.contour.points.size()) + " points");
  }
  const Node tolerance = field(node, "tolerance");
  report.tolerance = number(tolerance);
  if (!(report.tolerance >= least_tolerance(stored_.contour.points))) {
    refuse(tolerance, "the tolerance is below 1e-12 of the size or the rounding of coordinates");
  }
  report.largest_width = figure(node, "largest_width");
  report.largest_deviation = optional_figure(
      node, "largest_deviation", largest_deviation(stored_.contour.carrier, report.segments));
  report.largest_move = figure(node, "largest_move");
  if (const auto list = optional_field(node, "moves")) report.moves = moves(*list);
  report.vertices = small_count(node, "vertices");
  report.vertices_lower_bound = small_count(node, "vertices_lower_bound");
  report.inflections = small_count(node, "inflections");
  report.inserted_points =
      static_cast<std::size_t>(integer(field(node, "inserted_points"), 0, kMaxInteger));
  const auto measured_in = [&](const Node& in, string_view key) -> std::optional<double> {
    const auto found = optional_field(in, key);
    if (!found || found->value->is_null()) return std::nullopt;
    return number(*found);
  };
  const auto measured = [&](string_view key) { return measured_in(node, key); };
  // null says that it is not known (NaN); a file without the field says nothing
  if (optional_field(node, "waviness")) report.waviness = figure(node, "waviness");
  report.carrier_deviation = measured("carrier_deviation");
  report.outside_spirals_region = measured("outside_spirals_region");
  if (const auto given = optional_field(node, "given")) report.given = given_report(*given);
  report.seconds = figure(node, "seconds");
  if (const auto chain = optional_field(node, "chain")) {
    report.chain.newton_steps = small_count(*chain, "newton_steps");
    report.chain.smallest_margin = figure(*chain, "smallest_margin");
    report.chain.free_elements = optional_count(*chain, "free_elements");
    if (optional_field(*chain, "slope_step_g2")) {
      report.chain.slope_step_g2 = figure(*chain, "slope_step_g2");
      report.chain.waviness_g2 = measured_in(*chain, "waviness_g2");
    }
  }
  return report;
}

PieceProof ContourReader::proof(const Node& node, std::size_t expected) {
  PieceProof proof;
  const Node piece = field(node, "piece");
  if (index(piece, stored_.contour.pieces.size(), "pieces") != expected) {
    refuse(piece, "the verdicts stand in the order of the pieces");
  }
  const Node verdict = field(node, "verdict");
  const std::string said = word(verdict);
  bool known = false;
  for (const Verdict one : {Verdict::kIncreasing, Verdict::kDecreasing, Verdict::kConstant,
                            Verdict::kHasVertex, Verdict::kUndecided}) {
    if (said != to_string(one)) continue;
    proof.verdict = one;
    known = true;
  }
  if (!known) refuse(verdict, text::shown(said) + " is no verdict");
  proof.exact_arithmetic = optional_flag(node, "exact_arithmetic", false);
  proof.t0 = optional_figure(node, "t0", proof.t0);
  proof.t1 = optional_figure(node, "t1", proof.t1);
  return proof;
}

// Fields that other programs may leave out stand for what "proved" and the report imply.
Certificate ContourReader::certificate(const Node& node) {
  Certificate claims;
  const Node monotone = field(node, "monotone");
  each(monotone, [&](const Node& one) { claims.pieces.push_back(proof(one, one.index)); });
  if (claims.pieces.size() != stored_.contour.pieces.size()) {
    refuse(monotone, "one verdict for each piece is expected");
  }
  const Node gaps = field(node, "joint_gaps");
  claims.gaps.position = figure(gaps, "position");
  claims.gaps.heading = figure(gaps, "heading");
  claims.gaps.curvature = figure(gaps, "curvature");
  if (optional_field(gaps, "slope")) claims.gaps.slope = figure(gaps, "slope");
  claims.inside_region = flag(field(node, "inside_region"));
  claims.proved = flag(field(node, "proved"));
  claims.gaps_within_bounds = optional_flag(node, "gaps_within_bounds", claims.proved);
  claims.through_points = optional_flag(node, "through_points", claims.proved);
  const bool exact = stored_.contour.point_tolerance.empty();
  const double move = stored_.report ? stored_.report->largest_move : exact ? 0.0 : kNoClaim;
  claims.largest_move = optional_figure(node, "largest_move", move);
  const auto count = [&](string_view key, int otherwise) {
    return optional_field(node, key) ? small_count(node, key) : otherwise;
  };
  const std::vector<Joint>& joints = stored_.contour.joints;
  const auto corners = std::count_if(joints.begin(), joints.end(), is_corner);
  const auto parted = std::count_if(joints.begin(), joints.end(),
                                    [](const Joint& joint) { return joint.leaving.has_value(); });
  const std::size_t n = stored_.contour.pieces.size();
  claims.joints = static_cast<int>(stored_.contour.closed || n == 0 ? n : n - 1);
  claims.corners = count("corners", static_cast<int>(corners));
  claims.curvature_steps = count("curvature_steps", static_cast<int>(parted - corners));
  const auto slope_steps = std::count_if(joints.begin(), joints.end(),
                                         [](const Joint& joint) { return joint.slope_step; });
  claims.slope_steps = count("slope_steps", static_cast<int>(slope_steps));
  claims.vertices = count("vertices", stored_.report ? stored_.report->vertices : 0);
  claims.inflections = count("inflections", stored_.report ? stored_.report->inflections : 0);
  claims.self_intersections = count("self_intersections", 0);
  if (const auto reason = optional_field(node, "reason")) claims.reason = word(*reason);
  return claims;
}

Result<StoredContour> ContourReader::read(const json& document) {
  const Node root{&document, nullptr, {}, 0};
  read_head(root);
  read_contour(root);
  if (const auto node = optional_field(root, "name")) stored_.name = word(*node);
  if (const auto node = optional_field(root, "alignment")) stored_.alignment = alignment(*node);
  if (const auto node = optional_field(root, "report")) stored_.report = report(*node);
  if (const auto node = optional_field(root, "certificate")) {
    stored_.certificate = certificate(*node);
  }
  if (error_) return fail(std::move(*error_));
  stored_.unread = unread_fields(document);
  if (has_ended(watch_)) return fail(cancelled_error());
  return std::move(stored_);
}

}  // namespace

Result<StoredContour> contour_from_json(std::string_view text, std::string_view name,
                                        Watch* watch) {
  const Result<json> document = parse_json(text, name, watch);
  OBVID_TRY(document);
  return ContourReader(name, watch).read(*document);
}

}  // namespace obvid
