// SPDX-License-Identifier: Apache-2.0
#include "audit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "json_text.h"
#include "obvid/geom/angle.h"
#include "obvid/io/picture_svg.h"
#include "obvid/pipeline/audit.h"
#include "outputs.h"
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
               significant(a.length), audit_continuity(a.continuity), std::to_string(a.vertices),
               std::to_string(a.visible_vertices), std::to_string(a.inflections), least_radius(a)});
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
    table.row({significant(place.s), to_string(place.kind), significant(place.point.x),
               significant(place.point.y), radius_text(place.kappa_before),
               radius_text(place.kappa_after), size_text(place, a.contour.units)});
  }
  return table.text() + shown_note(shown.size(), a.places.size(), "largest", "places");
}

std::string audit_text(const Drawing& drawing, const std::vector<CurveAudit>& audits) {
  std::string out = bold(drawing.name) + "\n";
  out += fmt::format(
      "lengths in {}; joints: G2 continuous curvature, G1 common tangent, G0 corners\n\n",
      drawing.units);
  out += curve_table(audits);
  for (std::size_t i = 0; i < std::min(audits.size(), kMostDetailed); ++i) {
    if (audits[i].places.empty()) continue;
    out += fmt::format("\ncurve {}, {}\n", i + 1, audits[i].label) + place_table(audits[i]);
  }
  if (!drawing.series.empty()) {
    out += fmt::format("\n{} of points: `obvid fit` takes them\n",
                       counted(drawing.series.size(), "series", "series"));
  }
  return out;
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

std::string audit_json(const Drawing& drawing, const std::vector<CurveAudit>& audits) {
  JsonText json;
  json.begin_object().pair("name", drawing.name).pair("units", drawing.units);
  json.key("curves").begin_array();
  for (const CurveAudit& a : audits) {
    json.begin_object().pair("label", a.label).pair("pieces", a.contour.pieces.size());
    json.pair("length", a.length).pair("continuity", a.continuity);
    json.pair("closed", a.contour.closed).pair("vertices", a.vertices);
    json.pair("visible_vertices", a.visible_vertices).pair("inflections", a.inflections);
    json.pair("least_kappa", a.least_kappa).pair("largest_kappa", a.largest_kappa);
    add_places(json, a);
    json.end_object();
  }
  json.end_array().pair("series", drawing.series.size()).key("warnings").begin_array();
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
                                                      const std::vector<CurveAudit>& audits) {
  Result<std::vector<Output>> outputs = outputs_of(options.outputs, options.input);
  if (!outputs) return fail(outputs.error());
  for (Output& output : *outputs) {
    if (output.format != FileFormat::kPicture || audits.empty()) {
      return fail({ErrorCode::kBadOption, "analyse writes a picture of a curve, nothing else",
                   output.path, "name an .svg"});
    }
    const CurveAudit& a = pictured(audits, options.import);
    output.text = picture_svg({a.contour, std::nullopt, a.certificate});
  }
  return write_files(*outputs, options.input);
}

}  // namespace

int audit_drawing(const AnalyseOptions& options) {
  Result<Drawing> drawing = read_drawing(options.input);
  if (!drawing) return report(drawing.error());
  if (options.units) drawing->units = *options.units;
  std::vector<CurveAudit> audits;
  for (const DrawnCurve& curve : drawing->curves) audits.push_back(audit(curve, drawing->units));
  const auto written = write_audit_pictures(options, audits);
  warn(drawing->warnings);
  if (!written) return report(written.error());
  std::string text = options.json ? audit_json(*drawing, audits) : audit_text(*drawing, audits);
  if (!written->empty() && !options.json) text += "\nwritten  " + listed(*written) + "\n";
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
