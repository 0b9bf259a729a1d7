// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "obvid/io/internal/json_text.h"
#include "obvid/picture/internal/overlay_svg.h"
#include "obvid/pipeline/compare_curves.h"

namespace obvid {
namespace {

const char* side_name(const DeviationPlace& place) { return place.upper ? "upper" : "lower"; }

void add_airfoil(JsonText& json, const ComparedCurve& curve) {
  json.key("airfoil");
  if (!curve.airfoil) {
    json.null().pair("no_airfoil", curve.no_airfoil);
    return;
  }
  const AirfoilFigures& f = *curve.airfoil;
  json.begin_object().pair("chord", f.chord).pair("turn", f.turn);
  json.pair("leading_edge_x", f.leading_edge.x).pair("leading_edge_y", f.leading_edge.y);
  json.pair("thickness", f.thickness).pair("thickness_at", f.thickness_at);
  json.pair("camber", f.camber).pair("camber_at", f.camber_at);
  json.pair("leading_edge_radius", f.nose_radius);
  json.pair("nose_corner", f.nose_corner).pair("nose_turns", f.nose_turns);
  json.pair("trailing_edge_thickness", f.trailing_thickness);
  json.pair("trailing_edge_angle", f.trailing_angle).end_object();
}

void add_curve(JsonText& json, const ComparedCurve& curve) {
  json.begin_object().pair("name", curve.name).pair("formed", curve.formed);
  json.key("proved");
  curve.formed ? json.value(curve.proved) : json.null();
  json.key("points");
  curve.points > 0 ? json.value(curve.points) : json.null();
  json.pair("length", curve.length).key("vertices");
  curve.counted ? json.value(curve.vertices) : json.null();
  add_airfoil(json, curve);
  json.end_object();
}

void add_deviations(JsonText& json, const char* key, const std::vector<CurveDeviation>& all,
                    const CurveComparison& compared) {
  json.key(key).begin_array();
  for (const CurveDeviation& one : all) {
    json.begin_object().pair("curve", compared.curves[one.curve].name);
    json.pair("measured", one.measured).key("largest");
    if (one.largest) {
      const DeviationPlace& at = *one.largest;
      json.begin_object().pair("deviation", *at.deviation).pair("s", at.s);
      json.pair("x", at.point.x).pair("y", at.point.y);
      if (at.along) json.pair("along_chord", *at.along).pair("side", side_name(at));
      json.end_object().pair("root_mean_square", one.root_mean_square);
    } else {
      json.null().key("root_mean_square").null();
    }
    json.end_object();
  }
  json.end_array();
}

}  // namespace

DataTable curves_rows(const CurveComparison& compared) {
  DataTable out{heads_of("s,x,y,normal_x,normal_y")};
  if (compared.airfoils) out.heads.insert(out.heads.end(), {"side", "along_chord"});
  for (std::size_t k = 1; k < compared.curves.size(); ++k) {
    out.heads.push_back("deviation of " + compared.curves[k].name);
  }
  for (std::size_t k = 1; !compared.on_one_chord.empty() && k < compared.curves.size(); ++k) {
    out.heads.push_back("on one chord of " + compared.curves[k].name);
  }
  const auto& places = compared.as_they_lie.front().places;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const DeviationPlace& at = places[i];
    DataRow& row =
        out.rows.emplace_back(DataRow{at.s, at.point.x, at.point.y, at.normal.x, at.normal.y});
    if (compared.airfoils) {
      row.emplace_back(side_name(at));
      row.emplace_back(at.along.value_or(0.0));
    }
    for (const auto* all : {&compared.as_they_lie, &compared.on_one_chord}) {
      for (const CurveDeviation& one : *all) row.emplace_back(one.places[i].deviation);
    }
  }
  return out;
}

std::string curves_json(const CurveComparison& compared) {
  JsonText json;
  json.begin_object();
  add_units(json, compared.units);
  json.pair("positive", compared.outward ? "outward" : "left");
  json.key("curves").begin_array();
  for (const ComparedCurve& curve : compared.curves) add_curve(json, curve);
  json.end_array();
  add_deviations(json, "as_they_lie", compared.as_they_lie, compared);
  add_deviations(json, "on_one_chord", compared.on_one_chord, compared);
  return json.end_object().take();
}

std::string curves_svg(const CurveComparison& compared, std::optional<double> enlarge) {
  return overlay_svg(compared, enlarge);
}

}  // namespace obvid
