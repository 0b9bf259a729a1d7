// SPDX-License-Identifier: Apache-2.0
#include "audit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "json_text.h"
#include "obvid/geom/angle.h"
#include "obvid/io/picture_svg.h"
#include "obvid/pipeline/audit.h"
#include "obvid/series/analysis.h"
#include "outputs.h"
#include "series_report.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

/// Curves that get a list of their places; a drawing with more gets the table only.
constexpr std::size_t kMostDetailed = 3;

std::string audit_continuity(int continuity) {
  return continuity < 0 ? "gaps" : "G" + std::to_string(continuity);
}

/// Least radius of a curve, "straight" where it has none.
std::string least_radius(const CurveAudit& a) {
  const bool left = std::abs(a.largest_kappa) >= std::abs(a.least_kappa);
  return radius_text(left ? a.largest_kappa : a.least_kappa);
}

std::string count_text(const CurveAudit& a, int count) {
  return a.counted ? std::to_string(count) : "-";
}

std::string curve_table(const std::vector<CurveAudit>& audits) {
  Table table;
  table.column("curve");
  table.column("what", Table::Align::kLeft);
  table.column("pieces");
  table.column("length");
  table.column("joints");
  table.column("vertices");
  table.column("above\n1 %");
  table.column("inflec-\ntions");
  table.column("least\nradius");
  std::vector<double> vertices;
  for (const CurveAudit& a : audits) vertices.push_back(a.vertices);
  std::size_t before = 0;
  const std::vector<std::size_t> shown = rows_worth_showing(vertices);
  for (const std::size_t i : shown) {
    if (i > before) table.gap();
    before = i + 1;
    const CurveAudit& a = audits[i];
    table.row({std::to_string(i + 1), a.label, std::to_string(a.contour.pieces.size()),
               significant(a.length), audit_continuity(a.continuity), count_text(a, a.vertices),
               count_text(a, a.visible_vertices), count_text(a, a.inflections), least_radius(a)});
  }
  return table.text() + shown_note(shown.size(), audits.size(), "least fair", "curves");
}

std::string size_text(const AuditPlace& place, const std::string& units) {
  if (place.kind == AuditPlace::Kind::kCorner) {
    return fmt::format("{} deg", significant(place.size / kOneDegree, 4));
  }
  if (place.kind == AuditPlace::Kind::kGap) return significant(place.size, 4) + " " + units;
  return "";
}

std::string place_table(const CurveAudit& a) {
  Table table;
  table.column("arc\nlength");
  table.column("what", Table::Align::kLeft);
  table.column("x");
  table.column("y");
  table.column("radius\nbefore");
  table.column("radius\nafter");
  table.column("size", Table::Align::kLeft);
  std::vector<double> weight;
  for (const AuditPlace& place : a.places) weight.push_back(place.size);
  const std::vector<std::size_t> shown = rows_worth_showing(weight);
  std::size_t before = 0;
  for (const std::size_t i : shown) {
    if (i > before) table.gap();
    before = i + 1;
    const AuditPlace& place = a.places[i];
    table.row({coordinate(place.s, a.length), to_string(place.kind),
               coordinate(place.point.x, a.length), coordinate(place.point.y, a.length),
               radius_text(place.kappa_before), radius_text(place.kappa_after),
               size_text(place, a.contour.units.text())});
  }
  return table.text() + shown_note(shown.size(), a.places.size(), "largest", "places");
}

double length_of(const std::vector<Vec2>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += norm(points[i] - points[i - 1]);
  return length;
}

Vec2 box_of(const std::vector<Vec2>& points) {
  Vec2 low = points.front(), high = low;
  for (const Vec2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return high - low;
}

const char* kind_text(const PointSeries& series) {
  constexpr const char* kSeriesKinds[] = {"points", "route", "single points", "waypoints"};
  return kSeriesKinds[static_cast<int>(series.kind)];
}

/// Series of points go on counting where the curves end.
std::string series_table(const Drawing& drawing) {
  Table table;
  table.column("curve");
  table.column("what", Table::Align::kLeft);
  table.column("points");
  table.column("length");
  table.column("closed", Table::Align::kLeft);
  table.column("width");
  table.column("height");
  std::vector<double> length;
  for (const PointSeries& series : drawing.series) length.push_back(length_of(series.points));
  const std::vector<std::size_t> shown = rows_worth_showing(length);
  std::size_t before = 0;
  for (const std::size_t i : shown) {
    if (i > before) table.gap();
    before = i + 1;
    const PointSeries& series = drawing.series[i];
    const Vec2 box = box_of(series.points);
    const bool closed = series.points.size() > 2 && series.points.front() == series.points.back();
    table.row({std::to_string(drawing.curves.size() + i + 1),
               fmt::format("{} ({})", series.name, kind_text(series)),
               std::to_string(series.points.size()), significant(length[i]), closed ? "yes" : "no",
               significant(box.x), significant(box.y)});
  }
  return table.text() + shown_note(shown.size(), drawing.series.size(), "longest", "series");
}

/// Curves whose places are listed: the one that was asked for, or the first few.
std::vector<std::size_t> detailed(const std::vector<CurveAudit>& audits,
                                  const std::optional<std::size_t>& asked) {
  if (asked) return *asked < audits.size() ? std::vector{*asked} : std::vector<std::size_t>{};
  std::vector<std::size_t> out(std::min(audits.size(), kMostDetailed));
  std::iota(out.begin(), out.end(), std::size_t{0});
  return out;
}

void add_straightened(const CurveAudit& a, std::string& out) {
  if (a.straightened == 0) return;
  out += fmt::format("straight but for rounding: {} below a curvature of {} 1/{}\n",
                     counted(a.straightened, "piece", "pieces"), significant(a.flat_curvature, 3),
                     a.contour.units.text());
}

/// Counts are proved; places are found on samples, where the curvature stands out of its rounding.
std::string unplaced_text(const CurveAudit& a) {
  const auto listed_of = [&a](AuditPlace::Kind kind) {
    return std::count_if(a.places.begin(), a.places.end(),
                         [kind](const AuditPlace& place) { return place.kind == kind; });
  };
  const auto vertices = listed_of(AuditPlace::Kind::kVertex);
  const auto inflections = listed_of(AuditPlace::Kind::kInflection);
  if (!a.counted || (vertices >= a.vertices && inflections >= a.inflections)) return {};
  return fmt::format(
      "{} of {} and {} of {} have a place; at the others the curvature does not stand out of the "
      "rounding\n",
      vertices, counted(static_cast<std::size_t>(a.vertices), "vertex", "vertices"), inflections,
      counted(static_cast<std::size_t>(a.inflections), "inflection", "inflections"));
}

std::string audit_text(const Drawing& drawing, const std::vector<CurveAudit>& audits,
                       const std::optional<std::size_t>& asked) {
  std::string out = bold(drawing.name) + "\n";
  out += fmt::format("lengths in {}", drawing.units.text());
  if (!audits.empty()) {
    out += "; joints: G2 continuous curvature, G1 common tangent, G0 corners\n\n";
    out += curve_table(audits);
  } else {
    out += "\n";
  }
  if (!drawing.series.empty()) {
    out += "\n" + series_table(drawing);
    out += "\npoints are for `obvid fit FILE --curve N`\n";
  }
  for (const std::size_t i : detailed(audits, asked)) {
    if (audits[i].places.empty() && audits[i].straightened == 0) continue;
    out += fmt::format("\ncurve {}, {}\n", i + 1, audits[i].label);
    add_straightened(audits[i], out);
    if (audits[i].places.empty()) continue;
    out += place_table(audits[i]) + unplaced_text(audits[i]);
  }
  return out;
}

void add_series(JsonText& json, const Drawing& drawing) {
  json.key("series").begin_array();
  for (const PointSeries& series : drawing.series) {
    const Vec2 box = box_of(series.points);
    json.begin_object().pair("label", series.name).pair("kind", kind_text(series));
    json.pair("points", series.points.size()).pair("length", length_of(series.points));
    json.pair("closed", series.points.size() > 2 && series.points.front() == series.points.back());
    json.pair("width", box.x).pair("height", box.y).end_object();
  }
  json.end_array();
}

void add_places(JsonText& json, const CurveAudit& a) {
  json.key("places").begin_array();
  for (const AuditPlace& place : a.places) {
    json.begin_object().pair("kind", to_string(place.kind)).pair("s", place.s);
    json.pair("x", place.point.x).pair("y", place.point.y);
    json.pair("kappa_before", place.kappa_before).pair("kappa_after", place.kappa_after);
    json.pair("size", place.size).end_object();
  }
  json.end_array();
}

std::string audit_json(const Drawing& drawing, const std::vector<CurveAudit>& audits,
                       const std::string& points) {
  JsonText json;
  json.begin_object().pair("name", drawing.name);
  add_units(json, drawing.units);
  json.key("curves").begin_array();
  for (const CurveAudit& a : audits) {
    json.begin_object().pair("label", a.label).pair("pieces", a.contour.pieces.size());
    json.pair("length", a.length).pair("continuity", a.continuity);
    json.pair("closed", a.contour.closed);
    for (const auto& [name, count] :
         {std::pair{"vertices", a.vertices}, std::pair{"visible_vertices", a.visible_vertices},
          std::pair{"inflections", a.inflections}}) {
      json.key(name);
      a.counted ? json.value(count) : json.null();
    }
    json.pair("least_kappa", a.least_kappa).pair("largest_kappa", a.largest_kappa);
    json.pair("straightened", a.straightened).pair("flat_curvature", a.flat_curvature);
    add_places(json, a);
    json.end_object();
  }
  json.end_array();
  add_series(json, drawing);
  if (!points.empty()) json.key("points").raw(points);
  json.key("warnings").begin_array();
  for (const std::string& warning : drawing.warnings) json.value(warning);
  return json.end_array().end_object().take();
}

/// The picture is of one curve: the one that was asked for, else the longest.
const CurveAudit& pictured(const std::vector<CurveAudit>& audits, const ImportOptions& options) {
  if (options.curve && *options.curve < audits.size()) return audits[*options.curve];
  return *std::max_element(
      audits.begin(), audits.end(),
      [](const CurveAudit& a, const CurveAudit& b) { return a.length < b.length; });
}

Result<std::vector<std::string>> write_audit_pictures(const AnalyseOptions& options,
                                                      const std::string& name,
                                                      const std::vector<CurveAudit>& audits) {
  Result<std::vector<Output>> outputs = outputs_of(options.outputs, options.input);
  if (!outputs) return fail(outputs.error());
  for (Output& output : *outputs) {
    if (output.format != FileFormat::kPicture || audits.empty()) {
      return fail({ErrorCode::kBadOption, "analyse writes a picture of a curve, nothing else",
                   output.path, "name an .svg"});
    }
    const CurveAudit& a = pictured(audits, options.import);
    output.text =
        picture_svg({a.contour, std::nullopt, a.certificate}, {name + ": " + a.label, as_drawn(a)});
  }
  return write_files(*outputs, options.input);
}

/// What the points of the chosen series say; a warning instead where they say nothing.
std::string points_report(Drawing& drawing, std::size_t number, bool json) {
  PointSeries series = drawing.series[number];
  series.units = drawing.units;
  const auto analysis = analyse(series.points);
  if (!analysis) {
    drawing.warnings.push_back(fmt::format("{}: {}", series.name, analysis.error().what));
    return {};
  }
  add_rounding_warning(series, *analysis);
  drawing.warnings.insert(drawing.warnings.end(), series.warnings.begin(), series.warnings.end());
  return json ? series_report_json(series, *analysis) : series_report_text(series, *analysis);
}

}  // namespace

int audit_drawing(const AnalyseOptions& options) {
  Result<Drawing> drawing = read_drawing(options.input);
  if (!drawing) return report(drawing.error());
  if (options.units) {
    if (auto told = take_units(drawing->units, *options.units)) drawing->warnings.push_back(*told);
  }
  const auto chosen = chosen_curve(*drawing, options.import.curve, options.input);
  if (!chosen && options.import.curve) return report(chosen.error());
  std::vector<CurveAudit> audits;
  for (const DrawnCurve& curve : drawing->curves) audits.push_back(audit(curve, drawing->units));
  const auto written = write_audit_pictures(options, drawing->name, audits);
  if (!written) {
    warn(drawing->warnings);
    return report(written.error());
  }
  std::string points;
  if (chosen && *chosen >= audits.size()) {
    points = points_report(*drawing, *chosen - audits.size(), options.json);
  }
  warn(drawing->warnings);
  std::string text = options.json ? audit_json(*drawing, audits, points)
                                  : audit_text(*drawing, audits, options.import.curve) +
                                        (points.empty() ? "" : "\n" + points);
  if (!written->empty() && !options.json) text += "\nwritten  " + listed(*written) + "\n";
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
