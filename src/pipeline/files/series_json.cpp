// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <limits>
#include <string>
#include <vector>

#include "obvid/io/internal/json_list.h"
#include "obvid/pipeline/analyse.h"
#include "obvid/pipeline/element_table.h"
#include "obvid/pipeline/internal/report_json.h"

namespace obvid {
namespace {

constexpr double kNoDirection = std::numeric_limits<double>::quiet_NaN();  // null in JSON

void add_points(JsonText& json, const Analysis& analysis) {
  json.key("points").begin_array();
  for (std::size_t i = 0; i < analysis.circles.size(); ++i) {
    json.begin_object().pair("kappa", analysis.circles[i].kappa);
    json.pair("kappa_rounding", analysis.circles[i].rounding);
    json.pair("turning", turning_at(analysis, i)).end_object();
  }
  json.end_array().key("segments").begin_array();
  for (std::size_t i = 0; i < analysis.chords.size(); ++i) {
    json.begin_object().pair("chord", analysis.chords[i].length);
    json.pair("heading", analysis.chords[i].omega);
    json.pair("direction",
              analysis.change[i] ? static_cast<double>(*analysis.change[i]) : kNoDirection);
    json.pair("points_only_error", analysis.points_only_error[i]).end_object();
  }
  json.end_array();
}

void add_box(JsonText& json, const DrawnFigures& figures) {
  json.key("box").begin_array().value(figures.low.x).value(figures.low.y);
  json.value(figures.high.x).value(figures.high.y).end_array();
}

void add_series(JsonText& json, const Drawing& drawing) {
  json.key("series").begin_array();
  for (const PointSeries& series : drawing.series) {
    const DrawnFigures figures = figures_of(series);
    json.begin_object().pair("label", series.name).pair("layer", series.layer);
    json.pair("kind", figures.kind);
    json.pair("points", figures.points).pair("length", figures.length);
    json.pair("closed", figures.closed);
    json.pair("width", figures.high.x - figures.low.x);
    json.pair("height", figures.high.y - figures.low.y);
    add_box(json, figures);
    json.end_object();
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

void add_given_range(JsonText& json, const char* name, const std::optional<ValueRange>& range) {
  if (!range) return;
  json.key(name).begin_array();
  json.value(range->low).value(range->high).end_array();
}

void add_given(JsonText& json, const PointSeries& series) {
  json.key("given").begin_array();
  for (std::size_t i = 0; i < series.fixed.size(); ++i) {
    const FixedData& data = series.fixed[i];
    if (!data.says_how() && !data.corner && !data.tolerance) continue;
    json.begin_object().pair("point", i);
    if (data.theta) json.pair("heading", *data.theta);
    if (data.kappa) json.pair("kappa", *data.kappa);
    add_given_range(json, "headings", data.thetas);
    add_given_range(json, "kappas", data.kappas);
    if (data.corner) json.pair("corner", true);
    if (data.tolerance) json.pair("tolerance", *data.tolerance);
    json.end_object();
  }
  json.end_array();
}

DataRow drawn_row(std::size_t number, const std::string& label, const std::string& layer,
                  const DrawnFigures& f) {
  return {number,  label,   layer,    f.kind,  f.points, f.length, f.closed ? "yes" : "no",
          f.low.x, f.low.y, f.high.x, f.high.y};
}

}  // namespace

DataTable drawing_rows(const Drawing& drawing, const std::vector<CurveAudit>& audits) {
  DataTable out{
      heads_of("curve,name,layer,kind,points,length,closed,x_min,y_min,x_max,y_max,continuity,"
               "vertices,visible_vertices,inflections,least_kappa,largest_kappa")};
  for (const CurveAudit& a : audits) {
    DataRow& row =
        out.rows.emplace_back(drawn_row(out.rows.size() + 1, a.label, a.layer, figures_of(a)));
    row.emplace_back(a.continuity);
    for (const int count : {a.vertices, a.visible_vertices, a.inflections}) {
      row.emplace_back(a.counted ? DataCell(count) : DataCell());
    }
    row.push_back(finite_cell(a.least_kappa));
    row.push_back(finite_cell(a.largest_kappa));
  }
  for (const PointSeries& series : drawing.series) {
    out.rows.push_back(
        drawn_row(out.rows.size() + 1, series.name, series.layer, figures_of(series)));
  }
  return out;
}

DataTable series_rows(const PointSeries& series, const Analysis& analysis) {
  DataTable out{heads_of(
      "point,x,y,adjacent_kappa,turning_deg,chord,heading_deg,direction,points_only_error")};
  for (std::size_t i = 0; i < analysis.circles.size(); ++i) {
    const bool end = i == 0 || i + 1 == analysis.circles.size();
    DataRow& row =
        out.rows.emplace_back(DataRow{i + 1, series.points[i].x, series.points[i].y,
                                      end ? DataCell() : finite_cell(analysis.circles[i].kappa),
                                      turning_at(analysis, i) / kOneDegree});
    if (i >= analysis.chords.size()) continue;
    row.emplace_back(analysis.chords[i].length);
    row.emplace_back(analysis.chords[i].omega / kOneDegree);
    row.emplace_back(analysis.change[i] ? DataCell(*analysis.change[i]) : DataCell());
    row.push_back(finite_cell(analysis.points_only_error[i]));
  }
  return out;
}

std::string series_json(const PointSeries& series) {
  JsonText json;
  json.begin_object().pair("name", series.name).pair("label", series.label);
  add_units(json, series.units);
  json.key("rounding").begin_array().value(series.rounding.x).value(series.rounding.y).end_array();
  json.key("points").begin_array();
  for (const Vec2 p : series.points) json.begin_array().value(p.x).value(p.y).end_array();
  json.end_array();
  add_given(json, series);
  json.pair("pieces_as_drawn", series.kept.size());
  add_list(json, "warnings", series.warnings).end_object();
  return json.take();
}

std::string series_report_json(const PointSeries& series, const Analysis& analysis, Watch* watch) {
  JsonText json(watch);
  json.begin_object().pair("name", series.name);
  add_units(json, series.units);
  json.pair("size", analysis.size);
  add_points(json, analysis);
  json.key("runs").begin_array();
  for (const SeriesRun& run : analysis.runs) {
    json.begin_object().pair("first_point", run.first_chord).pair("last_point", run.last_chord + 1);
    json.pair("direction", run.direction).end_object();
  }
  json.end_array().key("circular").begin_array();
  for (const CircularStretch& stretch : analysis.stretches) {
    json.begin_object().pair("first_point", stretch.first).pair("last_point", stretch.last);
    json.pair("kappa", stretch.kappa).end_object();
  }
  json.end_array();
  json.pair("vertices", analysis.vertices);
  json.pair("vertices_lower_bound", analysis.vertices_lower_bound);
  json.pair("inflections", analysis.inflections);
  json.pair("inflections_lower_bound", analysis.inflections_lower_bound);
  json.pair("rounding_decided", analysis.rounding_decided.size());
  json.pair("largest_turning", analysis.largest_turning);
  add_list(json, "warnings", series.warnings).end_object();
  return json.take();
}

std::string audit_json(const Drawing& drawing, const std::vector<CurveAudit>& audits,
                       const std::string& points) {
  JsonText json;
  json.begin_object().pair("name", drawing.name);
  add_units(json, drawing.units);
  json.key("curves").begin_array();
  for (const CurveAudit& a : audits) {
    const DrawnFigures figures = figures_of(a);
    json.begin_object().pair("label", a.label).pair("layer", a.layer).pair("kind", figures.kind);
    json.pair("pieces", figures.pieces).pair("points", figures.points);
    add_box(json, figures);
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
    if (const auto elements = elements_of(a)) {
      json.key("elements");
      add_elements(json, *elements);
    }
    if (a.profile) {
      json.key("profile");
      add_profile(json, *a.profile);
    }
    json.end_object();
  }
  json.end_array();
  add_series(json, drawing);
  if (!points.empty()) json.key("points").raw(points);
  return add_list(json, "warnings", drawing.warnings).end_object().take();
}

}  // namespace obvid
