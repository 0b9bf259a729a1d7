// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "commands.h"
#include "json_text.h"
#include "obvid/surfacing/check.h"
#include "outputs.h"
#include "surface_outputs.h"
#include "surface_report.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

constexpr std::array kSides = {"u start", "u end", "v start", "v end"};

std::string range_text(const Extent& extent) {
  return fmt::format("{} to {}", significant(extent.least, 3), significant(extent.most, 3));
}

std::string order_text(int order) { return fmt::format("C{}", order); }

Table patch_table(const SurfaceCheck& check) {
  Table table;
  table.column("patch", Table::Align::kLeft);
  table.column("degree");
  table.column("control\npoints");
  table.column("inside\nu, v");
  table.column("area");
  table.column("Gaussian curvature");
  table.column("mean curvature");
  std::vector<double> worst;
  for (const PatchReport& p : check.patches) worst.push_back(p.k1.most - p.k2.least);
  std::size_t before = 0;
  for (const std::size_t i : rows_worth_showing(worst)) {
    if (i > before) table.gap();
    before = i + 1;
    const PatchReport& p = check.patches[i];
    table.row({p.name, fmt::format("{} x {}{}", p.degree_u, p.degree_v, p.rational ? " rat." : ""),
               fmt::format("{} x {}", p.count_u, p.count_v),
               order_text(p.order_u) + ", " + order_text(p.order_v), significant(p.area, 4),
               range_text(p.gaussian), range_text(p.mean)});
  }
  return table;
}

std::string monotone_text(const LineReport& lines) {
  return fmt::format("{} of {}", lines.monotone, lines.lines);
}

Table line_table(const SurfaceCheck& check) {
  Table table;
  table.column("patch", Table::Align::kLeft);
  table.column("lines along u\nmonotone");
  table.column("vertices\nin all");
  table.column("most on\none");
  table.column("inflec-\ntions");
  table.column("lines along v\nmonotone");
  table.column("vertices\nin all");
  table.column("most on\none");
  table.column("inflec-\ntions");
  std::vector<double> worst;
  for (const PatchReport& p : check.patches) {
    worst.push_back(static_cast<double>(p.along_u.vertices + p.along_v.vertices));
  }
  std::size_t before = 0;
  for (const std::size_t i : rows_worth_showing(worst)) {
    if (i > before) table.gap();
    before = i + 1;
    const PatchReport& p = check.patches[i];
    table.row({p.name, monotone_text(p.along_u), std::to_string(p.along_u.vertices),
               std::to_string(p.along_u.most_vertices), std::to_string(p.along_u.inflections),
               monotone_text(p.along_v), std::to_string(p.along_v.vertices),
               std::to_string(p.along_v.most_vertices), std::to_string(p.along_v.inflections)});
  }
  return table;
}

Table joint_table(const SurfaceModel& model, const SurfaceCheck& check) {
  Table table;
  table.column("border", Table::Align::kLeft);
  table.column("meets", Table::Align::kLeft);
  table.column("gap");
  table.column("angle\ndegrees");
  table.column("curvature\nstep");
  table.column("order");
  std::vector<double> worst;
  for (const JointReport& j : check.joints) worst.push_back(j.angle);
  std::size_t before = 0;
  for (const std::size_t i : rows_worth_showing(worst)) {
    if (i > before) table.gap();
    before = i + 1;
    const JointReport& j = check.joints[i];
    const auto side = [&](std::size_t k) {
      return fmt::format("{}, {}", model.patches[j.patch[k]].name,
                         kSides[static_cast<std::size_t>(j.side[k])]);
    };
    table.row({side(0), side(1), significant(j.gap, 3),
               significant(j.angle * 180.0 / std::numbers::pi, 3),
               significant(100.0 * j.curvature, 3) + " %", fmt::format("G{}", j.order)});
  }
  return table;
}

void add_extent(JsonText& json, const char* name, const Extent& extent) {
  json.key(name).begin_array().value(extent.least).value(extent.most).end_array();
}

void add_lines(JsonText& json, const char* name, const LineReport& lines) {
  json.key(name).begin_object().pair("lines", lines.lines).pair("monotone", lines.monotone);
  json.pair("vertices", lines.vertices).pair("most_vertices", lines.most_vertices);
  json.pair("inflections", lines.inflections).end_object();
}

Result<std::vector<SurfaceOutput>> pictures_of(const SurfaceCheckOptions& options) {
  auto outputs = surface_outputs_of(options.outputs, {options.input});
  if (!outputs) return outputs;
  for (const SurfaceOutput& output : *outputs) {
    const bool picture =
        output.format == SurfaceFormat::kPicture || output.format == SurfaceFormat::kPage;
    if (picture) continue;
    return fail({ErrorCode::kUnknownFormat, "check writes pictures only", output.path,
                 "give a name that ends in .svg or .html; other formats: obvid surface convert"});
  }
  return outputs;
}

/// Of all patches together, as the table has them for each.
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

}  // namespace

std::string surface_check_text(const SurfaceModel& model, const SurfaceCheck& check,
                               const SurfaceWritten& written) {
  std::string text = patch_table(check).text() + "\n" + line_table(check).text() + "\n";
  if (!check.joints.empty()) text += joint_table(model, check).text() + "\n";
  Facts facts;
  facts.add("size", significant(check.size) + " " + model.units.text());
  facts.add("borders", fmt::format("{} meet", check.joints.size()));
  for (const std::string& remark : written.remarks) facts.add("note", remark);
  if (!written.files.empty()) facts.add("written", listed(written.files));
  return text + facts.text();
}

std::string surface_check_json(const SurfaceModel& model, const SurfaceCheck& check,
                               const SurfaceWritten& written) {
  JsonText json;
  json.begin_object().pair("name", model.name);
  add_units(json, model.units);
  json.pair("size", check.size).key("patches").begin_array();
  for (const PatchReport& p : check.patches) {
    json.begin_object().pair("name", p.name).pair("degree_u", p.degree_u);
    json.pair("degree_v", p.degree_v).pair("count_u", p.count_u).pair("count_v", p.count_v);
    json.pair("order_u", p.order_u).pair("order_v", p.order_v).pair("rational", p.rational);
    json.pair("area", p.area).pair("without_normal", p.without_normal);
    add_extent(json, "gaussian", p.gaussian);
    add_extent(json, "mean", p.mean);
    add_extent(json, "k1", p.k1);
    add_extent(json, "k2", p.k2);
    add_lines(json, "along_u", p.along_u);
    add_lines(json, "along_v", p.along_v);
    json.end_object();
  }
  json.end_array().key("joints").begin_array();
  for (const JointReport& j : check.joints) {
    json.begin_object();
    json.key("patches").begin_array().value(j.patch[0]).value(j.patch[1]).end_array();
    json.key("sides").begin_array();
    for (const int side : j.side) json.value(kSides[static_cast<std::size_t>(side)]);
    json.end_array().pair("gap", j.gap).pair("angle", j.angle).pair("curvature", j.curvature);
    json.pair("order", j.order).end_object();
  }
  json.end_array().key("written").begin_array();
  for (const std::string& file : written.files) json.value(file);
  return json.end_array().end_object().take() + "\n";
}

int run(const SurfaceCheckOptions& options) {
  const auto outputs = pictures_of(options);
  if (!outputs) return report(outputs.error());
  ProgressBar bar(options.progress);
  bar.tell("reading", 0.0);
  std::vector<std::string> warnings;
  const Result<SurfaceModel> model = read_surface(options.input, warnings);
  if (!model) {
    bar.clear();
    return report(model.error());
  }
  CheckOptions how;
  how.samples = options.samples;
  const SurfaceCheck check = check_surface(*model, how, bar.progress());
  SurfaceExportOptions formats;
  formats.colouring = SurfaceColouring::kGaussian;
  if (!check.patches.empty()) formats.extremes = extremes_of(check);
  SurfaceWritten written;
  if (auto done = write_surface(*model, *outputs, formats, bar.progress(), written); !done) {
    bar.clear();
    return report(done.error());
  }
  bar.clear();
  warn(warnings);
  const std::string text = options.json ? surface_check_json(*model, check, written)
                                        : surface_check_text(*model, check, written);
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
