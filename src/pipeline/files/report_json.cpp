// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/report_json.h"

#include <fmt/format.h>

#include <cctype>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/internal/near_name.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/io/contour_json.h"
#include "obvid/io/internal/json_list.h"
#include "obvid/pipeline/audit.h"
#include "obvid/pipeline/internal/lines_and_arcs.h"
#include "obvid/pipeline/internal/promise.h"
#include "obvid/pipeline/internal/summary.h"
#include "verify/false_claim.h"

namespace obvid {
namespace {

constexpr double kUnknownFigure = std::numeric_limits<double>::quiet_NaN();  // null in JSON
constexpr CurvatureRange kUnknownRange{kUnknownFigure, kUnknownFigure};

/// A line of its own ends it, as in the contour file.
void add_certificate(JsonText& json, const Certificate& certificate, Watch* watch = nullptr) {
  json.key("certificate").raw(certificate_to_json(certificate, watch) + "\n");
}

void add_range(JsonText& json, const std::optional<FeasibleRange>& range) {
  if (!range) {
    json.null();
    return;
  }
  const bool heading = range->datum == FeasibleRange::Datum::kHeading;
  json.begin_object().pair("index", range->point).pair("datum", heading ? "heading" : "curvature");
  json.pair("asked", range->asked).pair("least", range->least);
  json.pair("greatest", range->greatest).end_object();
}

void add_why_not(JsonText& json, const WhyNot& why) {
  json.begin_object();
  json.pair("refused", why.refused).pair("stopped", why.stopped).key("tolerance");
  if (!why.found) {
    json.null().end_object();
    return;
  }
  json.value(why.tolerance).pair("next_to_nothing", why.next_to_nothing);
  json.pair("rounding_does", why.rounding_does).pair("advised", why.advised);
  json.key("points").begin_array();
  for (const std::size_t i : why.moved) {
    const Vec2 p = why.fit.contour.points[i];
    json.begin_object().pair("index", i).pair("x", p.x).pair("y", p.y);
    json.pair("move", why.fit.report.moves[i]).end_object();
  }
  json.end_array();
  json.key("report").raw(report_to_json(why.fit.report));
  add_certificate(json, why.fit.certificate);
  json.end_object();
}

void add_row(JsonText& json, const ComparedCarrier& row) {
  json.begin_object().pair("carrier", to_string(row.carrier)).key("refusal");
  if (row.refusal) {
    json.begin_object().pair("code", code_text(*row.refusal));
    json.pair("what", row.refusal->what).pair("where", row.refusal->where).end_object();
    json.end_object();
    return;
  }
  const Certificate& certificate = row.fit.certificate;
  const FitReport& report = row.fit.report;
  json.null().pair("pieces", row.fit.contour.pieces.size()).key("control_points");
  row.control_points == 0 ? json.null() : json.value(row.control_points);
  json.pair("continuity", row.continuity).pair("follows", to_string(row.followed));
  json.pair("vertices", certificate.vertices);
  json.pair("inflections", certificate.inflections).pair("error_bound", report.largest_deviation);
  json.pair("deviation", report.carrier_deviation.value_or(kUnknownFigure));
  json.pair("outside", report.outside_spirals_region.value_or(kUnknownFigure));
  json.pair("seconds", row.seconds).pair("monotone", certificate.proved);
  json.pair("reason", certificate.reason).end_object();
}

void add_taken_over(JsonText& json, const Contour& contour) {
  const KeptPieces kept = kept_pieces(contour);
  json.key("taken_over").begin_object().pair("lines", kept.lines).pair("arcs", kept.arcs);
  json.pair("ellipse_arcs", kept.ellipses).pair("clothoids", kept.clothoids).end_object();
}

/// The rows of the table of lines and arcs.
void add_lines_and_arcs(JsonText& json, const Contour& contour) {
  json.key("lines_and_arcs").begin_array();
  for (const LineOrArc& one : lines_and_arcs(contour)) {
    const bool line = one.kappa == 0.0;
    const auto of_arc = [&](double value) { return line ? kUnknownFigure : value; };
    json.begin_object().pair("kind", line ? "line" : "arc");
    json.key("points").begin_array().value(one.from).value(one.to).end_array();
    json.pair("centre_x", of_arc(one.centre.x)).pair("centre_y", of_arc(one.centre.y));
    json.pair("radius", line ? kUnknownFigure : 1.0 / one.kappa)
        .pair("heading", principal_angle(one.theta));
    json.pair("length", one.length).pair("farthest_point", one.off).end_object();
  }
  json.end_array();
}

/// Corners that stand on no point.
void add_corners_between(JsonText& json, const Contour& contour) {
  json.key("corners_between").begin_array();
  for (const Joint& joint : contour.joints) {
    if (joint.source || !joint.after || !joint.leaving) continue;
    json.begin_object().key("points").begin_array().value(*joint.after);
    json.value((*joint.after + 1) % contour.points.size()).end_array();
    json.pair("x", joint.element.point.x).pair("y", joint.element.point.y);
    json.pair("turn", principal_angle(joint.leaving->theta - joint.element.theta)).end_object();
  }
  json.end_array();
}

}  // namespace

std::string fit_report_json(const Fit& fit, const Written& written, Watch* watch) {
  JsonText json(watch);
  json.begin_object();
  add_units(json, fit.contour.units);
  json.pair("carrier", to_string(fit.contour.carrier));
  json.pair("continuity", to_string(fit.contour.continuity));
  if (!fit.report.chain.g2_because.empty()) {
    json.pair("g2_because", fit.report.chain.g2_because);
  }
  json.pair("points", fit.contour.points.size()).pair("pieces", fit.contour.pieces.size());
  add_taken_over(json, fit.contour);
  add_lines_and_arcs(json, fit.contour);
  add_corners_between(json, fit.contour);
  json.key("report").raw(report_to_json(fit.report, watch));
  add_certificate(json, fit.certificate, watch);
  add_list(json, "warnings", fit.warnings);
  add_list(json, "written", written.files);
  add_list(json, "remarks", written.remarks);
  json.end_object();
  return json.take();
}

std::string refusal_json(const Error& error, const PointSeries& series,
                         const std::optional<WhyNot>& why,
                         const std::optional<FeasibleRange>& range,
                         const std::vector<std::string>& written) {
  JsonText json;
  json.begin_object();
  add_units(json, series.units);
  json.key("error").begin_object();
  json.pair("code", code_text(error)).pair("what", error.what);
  json.pair("where", error.where).pair("hint", error.hint).end_object();
  json.key("why_not");
  if (why) {
    add_why_not(json, *why);
  } else {
    json.null();
  }
  json.key("feasible_range");
  add_range(json, range);
  add_list(json, "warnings", series.warnings);
  add_list(json, "written", written);
  json.end_object();
  return json.take();
}

std::string comparison_json(const PointSeries& series, const Comparison& compared) {
  JsonText json;
  json.begin_object().pair("name", series.name);
  add_units(json, series.units);
  json.pair("tolerance", compared.carriers.front().fit.report.tolerance);
  add_taken_over(json, compared.carriers.front().fit.contour);
  json.key("carriers").begin_array();
  for (const ComparedCarrier& row : compared.carriers) add_row(json, row);
  return json.end_array().end_object().take();
}

namespace {

double known_or_null(const std::optional<double>& value) { return value.value_or(kUnknownFigure); }

/// Rows of a report between two questions whether it is still wanted.
constexpr std::size_t kRowsBetweenQuestions = 1000;

Result<void> may_write_row(std::size_t row, const RunContext& run) {
  if (row % kRowsBetweenQuestions != 0) return {};
  return may_go_on(run);
}

Result<void> add_region_rows(JsonText& json, const std::vector<RegionRow>& rows,
                             const RunContext& run) {
  json.key("segments").begin_array();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    OBVID_TRY(may_write_row(i, run));
    const RegionRow& row = rows[i];
    json.begin_object().pair("from", row.from).pair("to", row.to).pair("chord", row.chord);
    json.pair("heading_start", row.theta_start).pair("heading_end", row.theta_end);
    json.pair("to_apex", row.to_apex).pair("from_apex", row.from_apex);
    const auto start = row.kappa_start.value_or(kUnknownRange);
    const auto end = row.kappa_end.value_or(kUnknownRange);
    json.pair("kappa_start_low", start.low).pair("kappa_start_high", start.high);
    json.pair("kappa_end_low", end.low).pair("kappa_end_high", end.high);
    json.pair("points_only_error", known_or_null(row.points_only_error));
    json.pair("lower_height", known_or_null(row.lower_height));
    json.pair("width", known_or_null(row.width));
    json.pair("chord_apex_height", known_or_null(row.apex_height));
    json.pair("tangent_apex_height", known_or_null(row.tangent_height));
    json.pair("chord_apex_gap", known_or_null(row.apex_gap));
    json.pair("tangent_apex_gap", known_or_null(row.tangent_gap));
    json.pair("chord_convex_bound", known_or_null(row.apex_bound));
    json.pair("tangent_convex_bound", known_or_null(row.tangent_bound));
    json.pair("spline_distance", known_or_null(row.spline_distance)).end_object();
  }
  json.end_array();
  return {};
}

Result<void> add_region_points(JsonText& json, const std::vector<RegionPoint>& points,
                               const RunContext& run) {
  json.key("points").begin_array();
  for (std::size_t i = 0; i < points.size(); ++i) {
    OBVID_TRY(may_write_row(i, run));
    const RegionPoint& p = points[i];
    json.begin_object().key("point").begin_array().value(p.point.x).value(p.point.y).end_array();
    json.pair("index", p.number).pair("inserted", p.inserted);
    json.pair("heading", p.theta).pair("heading_given", p.theta_given);
    json.pair("curvature_given", p.kappa_given);
    json.pair("adjacent_kappa", known_or_null(p.adjacent_kappa));
    json.pair("heading_low", p.headings ? p.headings->low : kUnknownFigure);
    json.pair("heading_high", p.headings ? p.headings->high : kUnknownFigure);
    json.pair("heading_low_open", p.headings && p.headings->low_is_open);
    json.pair("heading_high_open", p.headings && p.headings->high_is_open);
    const auto range = p.curvatures.value_or(kUnknownRange);
    json.pair("kappa_low", range.low).pair("kappa_high", range.high).end_object();
  }
  json.end_array();
  return {};
}

void add_construction_row(JsonText& json, const ConstructionRow& row) {
  json.begin_object().pair("segment", row.segment + 1);
  add_list(json, "values", row.values).pair("remark", row.remark).end_object();
}

}  // namespace

Result<std::string> region_json(const PointSeries& series, const RegionTable& region,
                                const RunContext& run) {
  JsonText json;
  json.begin_object().pair("name", series.name);
  add_units(json, series.units);
  OBVID_TRY(add_region_rows(json, region.rows, run));
  json.key("elements").begin_array();
  for (std::size_t i = 0; i < region.elements.size(); ++i) {
    OBVID_TRY(may_write_row(i, run));
    const Element& element = region.elements[i];
    json.begin_object().key("point").begin_array().value(element.point.x).value(element.point.y);
    json.end_array().pair("heading", element.theta).pair("kappa", element.kappa).end_object();
  }
  json.end_array();
  OBVID_TRY(add_region_points(json, region.user.points, run));
  if (region.refined) {
    json.key("refined").begin_object();
    OBVID_TRY(add_region_rows(json, region.refined->rows, run));
    OBVID_TRY(add_region_points(json, region.refined->points, run));
    json.end_object();
  }
  if (region.construction) {
    const ConstructionTable& made = *region.construction;
    json.key("construction").begin_object();
    add_list(json, "columns", made.columns);
    json.key("segments").begin_array();
    for (const ConstructionRow& row : made.rows) {
      if (row.detail) continue;
      add_construction_row(json, row);
    }
    json.end_array().key("steps").begin_array();
    for (const ConstructionRow& row : made.rows) {
      if (row.detail) add_construction_row(json, row);
    }
    json.end_array();
    add_list(json, "remarks", made.remarks);
    json.end_object();
  }
  json.end_object();
  return json.take();
}

std::string verification_json(const StoredContour& stored, const Verification& found) {
  JsonText json;
  json.begin_object().pair("holds", !broken_promise(stored, found));
  pipeline_detail::add_false_claim(json, found.false_claim ? &*found.false_claim : nullptr);
  add_list(json, "not_checked", found.not_checked);
  add_certificate(json, found.certificate);
  json.end_object();
  return json.take();
}

std::string trade_off_json(const TradeOff& t, const std::vector<std::string>& warnings,
                           const std::vector<std::string>& written) {
  JsonText json;
  json.begin_object();
  add_units(json, t.units);
  json.pair("closed", t.closed).key("rows").begin_array();
  for (const TradeOffRow& row : t.rows) {
    json.begin_object().pair("tolerance", row.tolerance);
    json.pair("formed", row.formed)
        .pair("proved", row.proved)
        .pair("kept", row.kept)
        .pair("carried", row.carried);
    json.pair("refusal", row.refusal);
    if (row.formed) {
      json.pair("vertices", row.vertices).pair("vertices_lower_bound", row.vertices_lower_bound);
      json.pair("inflections", row.inflections).pair("pieces", row.pieces);
      json.pair("largest_move", row.largest_move).pair("seconds", row.seconds);
      json.pair("option", row.option);
    }
    json.end_object();
  }
  json.end_array().key("recommended");
  if (t.recommended) {
    json.value(*t.recommended);
  } else {
    json.null();
  }
  json.pair("rule", trade_off_rule(t));
  add_list(json, "warnings", warnings);
  add_list(json, "written", written);
  json.end_object();
  return json.take();
}

namespace {

void add_error_text(JsonText& json, const ErrorText& text) {
  json.begin_object();
  json.pair("code", code_text(text.code));
  json.pair("exit_code", exit_code(text.code));
  json.pair("title", text.title).pair("meaning", text.meaning).pair("remedy", text.remedy);
  json.end_object();
}

}  // namespace

Result<ErrorText> error_text_of(std::string_view typed) {
  std::string wanted(typed);
  if (!wanted.empty()) {
    if (std::isdigit(static_cast<unsigned char>(wanted[0])) != 0) wanted.insert(0, "E");
    wanted[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(wanted[0])));
  }
  std::vector<std::string> names;
  for (const ErrorText& text : error_texts()) {
    names.push_back(code_text(text.code));
    if (names.back() == wanted) return text;
  }
  return error(ErrorCode::kUsage, fmt::format("there is no error code '{}'", wanted))
      .hint(did_you_mean(wanted, names, "`obvid explain` lists all codes"));
}

std::string error_text_json(const ErrorText& text) {
  JsonText json;
  add_error_text(json, text);
  return json.take();
}

std::string error_texts_json() {
  JsonText json;
  json.begin_array();
  for (const ErrorText& text : error_texts()) add_error_text(json, text);
  json.end_array();
  return json.take();
}

}  // namespace obvid
