// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/surface_report_json.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "obvid/io/internal/json_text.h"

namespace obvid {
namespace {

JsonText& add_list(JsonText& json, const char* name, const std::vector<std::string>& list) {
  json.key(name).begin_array();
  for (const std::string& one : list) json.value(one);
  return json.end_array();
}

void add_patches(const SurfaceModel& model, JsonText& json) {
  json.key("patches").begin_array();
  for (const SurfacePatch& patch : model.patches) {
    json.begin_object().pair("name", patch.name);
    json.pair("degree_u", patch.surface.degree_u).pair("degree_v", patch.surface.degree_v);
    json.pair("count_u", patch.surface.count_u()).pair("count_v", patch.surface.count_v());
    json.pair("rational", !patch.surface.weights.empty()).end_object();
  }
  json.end_array();
}

void add_across(JsonText& json, const char* name, const AcrossReport& across) {
  json.key(name).begin_object().pair("tolerance", across.tolerance);
  json.pair("isolines", across.isolines).pair("found", across.found);
  json.pair("forced", across.forced).pair("proved", across.proved);
  json.pair("beyond", across.beyond).pair("worst", across.worst);
  json.pair("fine", across.fine).pair("all", across.all);
  json.pair("all_beyond", across.all_beyond).end_object();
}

const char* matching_name(SkinMatching matching) {
  switch (matching) {
    case SkinMatching::kByPoints:
      return "points";
    case SkinMatching::kByAngle:
      return "angle";
    case SkinMatching::kOptimised:
      return "optimised";
    default:
      return "length";
  }
}

void add_skin_report(const FittedSkin& fitted, JsonText& json) {
  json.key("skin").begin_object();
  json.pair("proved", fitted.proved)
      .pair("g3", fitted.smooth)
      .pair("plain", fitted.plain)
      .pair("points", fitted.points);
  json.pair("tolerance", fitted.tolerance);
  json.pair("matched_by", matching_name(fitted.skin.matching));
  if (const auto& light = fitted.skin.light) {
    json.key("light").begin_object().pair("tolerance", light->tolerance);
    json.pair("moved", light->moved).pair("knots_alone", light->knots_alone);
    json.pair("control_points", light->points);
    json.pair("control_points_before", light->points_before).end_object();
  }
  if (const auto& fair = fitted.skin.fair) {
    json.key("fair_across").begin_object().pair("tolerance", fair->tolerance);
    json.pair("moved", fair->moved);
    json.pair("enough", fair->enough);
    if (fair->reach) {
      json.pair("reach", *fair->reach);
    } else {
      json.key("reach").null();
    }
    json.key("tried").begin_array();
    for (const MatchingTrial& trial : fair->tried) {
      json.begin_object().pair("matched_by", matching_name(trial.matching));
      json.pair("isolines", trial.isolines).pair("forced", trial.forced);
      const auto looked_for = [&](const char* name, const std::optional<double>& value) {
        if (value) {
          json.pair(name, *value);
        } else {
          json.key(name).null();
        }
      };
      looked_for("ripple", trial.ripple);
      looked_for("heavier", trial.heavier);
      json.end_object();
    }
    json.end_array();
    add_across(json, "before", fair->before);
    json.end_object();
  }
  json.key("sections").begin_array();
  for (const SkinSectionReport& s : fitted.skin.sections) {
    json.begin_object().pair("name", s.name).pair("v", s.parameter).pair("deviation", s.deviation);
    json.pair("from_points", s.from_points).pair("runs", s.runs).pair("ripple", s.ripple);
    json.end_object();
  }
  json.end_array();
  add_across(json, "across", fitted.skin.across);
  json.end_object();
}

JsonText& add_coordinates(JsonText& json, const char* name, Vec3 v) {
  json.key(name).begin_array();
  for (const double x : {v.x, v.y, v.z}) json.value(x);
  return json.end_array();
}

void add_scatter_report(const ScatteredSurface& made, JsonText& json) {
  json.key("scatter").begin_object().pair("points", made.used);
  json.pair("deviation", made.deviation).pair("root_mean_square", made.root_mean_square);
  json.pair("farthest", made.farthest + 1);
  add_coordinates(json, "up", made.plane.normal());
  json.pair("width", made.width).pair("depth", made.depth);
  json.pair("bending", made.bending).pair("weight", made.weight);
  json.key("outliers").begin_array();
  for (const ScatterOutlier& one : made.outliers) {
    json.begin_object().pair("point", one.point + 1).pair("off", one.off).end_object();
  }
  json.end_array().key("without_data").begin_object();
  json.pair("share", made.empty.share).pair("reach", made.empty.reach);
  json.pair("farthest", made.empty.farthest).pair("raster", made.empty.raster);
  add_coordinates(json, "place", made.empty.where).end_object().end_object();
}

void add_extent(JsonText& json, const char* name, const Extent& extent) {
  json.key(name).begin_array().value(extent.least).value(extent.most).end_array();
}

void add_lines(JsonText& json, const char* name, const LineReport& lines) {
  json.key(name).begin_object().pair("lines", lines.lines).pair("monotone", lines.monotone);
  json.pair("vertices", lines.vertices).pair("most_vertices", lines.most_vertices);
  json.pair("inflections", lines.inflections).end_object();
}

/// Where the smallest and the greatest value are.
void add_extent_places(JsonText& json, const char* name, const Extent& extent) {
  json.key(name).begin_array();
  for (const SurfacePlace* place : {&extent.least_at, &extent.most_at}) {
    json.begin_object().pair("u", place->u).pair("v", place->v);
    add_coordinates(json, "place", place->point).end_object();
  }
  json.end_array();
}

void add_measured_place(JsonText& json, const char* name, const MeasuredPlace& place, bool points) {
  json.key(name).begin_object().pair("off", place.off);
  json.pair(points ? "point" : "patch", points ? place.number + 1 : place.number);
  add_coordinates(json, "place", place.point);
  add_coordinates(json, "nearest", place.nearest.point);
  json.pair("beside", place.nearest.beside).end_object();
}

void add_deviation(JsonText& json, const char* name, const Deviation& found, bool points) {
  json.key(name).begin_object().pair("places", found.places);
  json.pair("largest", std::abs(found.farthest().off));
  json.pair("root_mean_square", found.root_mean_square).pair("mean", found.mean);
  json.pair("beside", found.beside);
  add_measured_place(json, "least", found.least, points);
  add_measured_place(json, "most", found.most, points);
  json.end_object();
}

/// What lies along borders of trimmed patches; how much of these is free, where there are any.
void add_trim_joints(const SurfaceModel& model, const SurfaceCheck& check, JsonText& json) {
  json.key("trim_joints").begin_array();
  for (const TrimJointReport& j : check.trim_joints) {
    json.begin_object();
    json.key("patches").begin_array().value(j.patch[0]).value(j.patch[1]).end_array();
    json.pair("gap", j.gap).pair("angle", j.angle).pair("order", j.order);
    json.pair("length", j.length).pair("places", j.places);
    add_coordinates(json, "gap_at", j.gap_at);
    add_coordinates(json, "angle_at", j.angle_at).end_object();
  }
  json.end_array();
  if (!is_trimmed(model)) return;
  const TrimmedBorders& borders = check.trimmed_borders;
  json.key("trimmed_borders").begin_object().pair("length", borders.length);
  json.pair("free", borders.free).pair("longest_free", borders.longest_free);
  if (borders.free > 0.0) {
    add_coordinates(json, "free_at", borders.free_at);
  } else {
    json.key("free_at").null();
  }
  json.end_object();
}

/// Found at a place, and what is nowhere exceeded; where nothing was found there is no place.
void add_measured(JsonText& json, const char* name, const ToolpathReport::Measured& measured) {
  json.key(name).begin_object().pair("found", measured.found).pair("most", measured.most);
  if (measured.found > 0.0) {
    add_coordinates(json, "place", measured.place);
  } else {
    json.key("place").null();
  }
  json.end_object();
}

}  // namespace

const char* border_name(PatchSide side) {
  constexpr std::array kNames = {"u start", "u end", "v start", "v end"};
  return kNames[side];
}

std::string surface_report_json(const MadeSurface& made, const Written& written) {
  JsonText json;
  json.begin_object().pair("kind", made.kind).pair("name", made.model.name);
  add_units(json, made.model.units);
  json.pair("size", size_of(made.model));
  json.pair("deviation", made.deviation);
  for (const auto& [name, value] : made.facts) json.pair(name, value);
  add_patches(made.model, json);
  if (made.skin) add_skin_report(*made.skin, json);
  if (made.scatter) add_scatter_report(*made.scatter, json);
  add_list(json, "warnings", made.warnings);
  add_list(json, "remarks", written.remarks);
  add_list(json, "written", written.files);
  return json.end_object().take() + "\n";
}

std::string surface_check_json(const SurfaceModel& model, const CheckedSurface& checked,
                               const Written& written) {
  const SurfaceCheck& check = checked.check;
  JsonText json;
  json.begin_object().pair("name", model.name);
  add_units(json, model.units);
  json.pair("size", check.size).key("patches").begin_array();
  for (const PatchReport& p : check.patches) {
    json.begin_object().pair("name", p.name).pair("degree_u", p.degree_u);
    json.pair("degree_v", p.degree_v).pair("count_u", p.count_u).pair("count_v", p.count_v);
    json.pair("order_u", p.order_u).pair("order_v", p.order_v).pair("rational", p.rational);
    json.pair("trims", p.trims).pair("area", p.area).pair("area_error", p.area_error);
    json.pair("without_normal", p.without_normal);
    add_extent(json, "gaussian", p.gaussian);
    add_extent(json, "mean", p.mean);
    add_extent(json, "k1", p.k1);
    add_extent(json, "k2", p.k2);
    json.key("places").begin_object();
    add_extent_places(json, "gaussian", p.gaussian);
    add_extent_places(json, "mean", p.mean);
    add_extent_places(json, "k1", p.k1);
    add_extent_places(json, "k2", p.k2);
    json.end_object();
    add_lines(json, "along_u", p.along_u);
    add_lines(json, "along_v", p.along_v);
    json.end_object();
  }
  json.end_array().key("joints").begin_array();
  for (const JointReport& j : check.joints) {
    json.begin_object();
    json.key("patches").begin_array().value(j.patch[0]).value(j.patch[1]).end_array();
    json.key("sides").begin_array();
    for (const PatchSide side : j.side) json.value(border_name(side));
    json.end_array().pair("gap", j.gap).pair("angle", j.angle).pair("curvature", j.curvature);
    json.pair("order", j.order).pair("shared", j.shared);
    add_coordinates(json, "gap_at", j.gap_at);
    add_coordinates(json, "angle_at", j.angle_at);
    add_coordinates(json, "curvature_at", j.curvature_at).end_object();
  }
  json.end_array();
  add_trim_joints(model, check, json);
  json.pair("free_borders", check.free_borders);
  if (const auto& deviation = checked.deviation) {
    json.key("deviation").begin_object().pair("against", deviation->against);
    json.pair("of", deviation->points ? "points" : "surface");
    add_deviation(json, "found", deviation->found, deviation->points);
    if (deviation->back) add_deviation(json, "back", *deviation->back, false);
    json.end_object();
  }
  add_list(json, "warnings", checked.warnings);
  json.key("written").begin_array();
  for (const std::string& file : written.files) json.value(file);
  return json.end_array().end_object().take() + "\n";
}

CurvatureExtremes extremes_of(const SurfaceCheck& check) {
  const auto over_all = [&check](Extent PatchReport::*quantity) {
    Range all{HUGE_VAL, -HUGE_VAL};
    for (const PatchReport& p : check.patches) {
      all = {std::min(all.from, (p.*quantity).least), std::max(all.to, (p.*quantity).most)};
    }
    return all;
  };
  return {over_all(&PatchReport::gaussian), over_all(&PatchReport::mean),
          over_all(&PatchReport::k1), over_all(&PatchReport::k2)};
}

Result<CurvatureExtremes> extremes_of(const SurfaceModel& model, const RunContext& run) {
  SurfaceCheck check;
  for (const SurfacePatch& patch : model.patches) {
    const auto found = curvature_extents(patch, run);
    OBVID_TRY(found);
    PatchReport& report = check.patches.emplace_back();
    report.gaussian = found->gaussian;
    report.mean = found->mean;
    report.k1 = found->k1;
    report.k2 = found->k2;
  }
  return extremes_of(check);
}

std::string toolpath_report_json(const MadeToolpath& made, const Written& written) {
  const ToolpathReport& r = made.path.report;
  JsonText json;
  json.begin_object();
  add_units(json, made.path.units);
  json.pair("up", to_string(made.up)).pair("passes", r.passes);
  json.pair("added_passes", r.added_passes).pair("cutting_length", r.cutting_length);
  json.pair("plunge_length", r.plunge_length).pair("rapid_length", r.rapid_length);
  json.pair("minutes", r.minutes).pair("tolerance", made.path.tolerance);
  add_measured(json, "scallop", r.scallop);
  add_measured(json, "gouge", r.gouge);
  json.pair("spacing", r.spacing);
  json.pair("lifted_points", r.lifted_points).pair("surface_area", r.surface_area);
  json.pair("hidden_area", r.hidden_area).pair("hidden_places", r.hidden_places);
  if (r.hidden_places > 0) {
    add_coordinates(json, "hidden_place", r.hidden_place);
  } else {
    json.key("hidden_place").null();
  }
  json.pair("unreached_area", r.unreached_area).pair("unreached_places", r.unreached_places);
  json.pair("unreached_depth", r.unreached_depth);
  json.pair("leftover_area", r.leftover_area).pair("leftover_depth", r.leftover_depth);
  json.pair("flat_area", r.flat_area).pair("flat_left", r.flat_left).pair("safe_z", r.safe_z);
  json.key("entries").begin_object().pair("helical", r.entries.helical);
  json.pair("ramped", r.entries.ramped).pair("straight", r.entries.straight);
  json.pair("asked", r.entries.asked_deg).pair("steepest", r.entries.steepest_deg);
  if (r.entries.steepest_deg > 0.0) {
    add_coordinates(json, "steepest_place", r.entries.steepest_place);
  } else {
    json.key("steepest_place").null();
  }
  json.end_object();
  json.pair("levels", r.levels).pair("narrow_stretches", r.narrow_stretches);
  json.pair("blocks", made.path.program.blocks).pair("arc_blocks", made.path.program.arc_blocks);
  json.key("not_kept").begin_array();
  for (const Error& error : made.path.not_kept) json.value(error.what);
  json.end_array();
  json.key("warnings").begin_array();
  for (const std::string& warning : made.warnings) json.value(warning);
  json.end_array().key("written").begin_array();
  for (const std::string& file : written.files) json.value(file);
  return json.end_array().end_object().take() + "\n";
}

}  // namespace obvid
