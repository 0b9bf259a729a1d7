// SPDX-License-Identifier: Apache-2.0
#include "nurbs_options.h"
#include "obvid/pipeline/nurbs_job.h"

#include <fmt/format.h>

#include "commands.h"
#include "obvid/core/files.h"
#include "surface_outputs.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

constexpr int kWeightDigits = 4;

std::string nurbs_number(double value) { return significant(value, kWeightDigits); }

std::string place_text(Vec3 p, bool spatial) {
  const std::string flat = nurbs_number(p.x) + ", " + nurbs_number(p.y);
  return spatial ? flat + ", " + nurbs_number(p.z) : flat;
}

std::string curve_text(const NurbsReport& report, const SpaceCurve& curve) {
  std::string out = bold(report.table.name) + "\n";
  out += fmt::format("NURBS curve of degree {}, {}, u from {} to {}\n", curve.degree,
                     counted(curve.points.size(), "control point", "control points"),
                     nurbs_number(curve.knots.front()), nurbs_number(curve.knots.back()));
  out +=
      "B: the curve at u without the point, N: with weight 1, C: as it is; parts a, b of the "
      "way from B to P\n\n";
  Table table;
  for (const char* head : {"point", "w", "u"}) table.column(head);
  for (const char* head : {"P", "B", "N", "C"}) table.column(head, Table::Align::kLeft);
  for (const char* head : {"a", "b", "from B\nto P"}) table.column(head);
  const bool spatial = report.table.spatial;
  for (const WeightRow& row : report.rows) {
    table.row({std::to_string(row.point + 1), nurbs_number(row.weight), nurbs_number(row.u),
               place_text(curve.points[row.point], spatial), place_text(row.without, spatial),
               place_text(row.even, spatial), place_text(row.now, spatial), nurbs_number(row.a),
               nurbs_number(row.b), nurbs_number(row.swing)});
  }
  return out + table.text();
}

std::string surface_text(const NurbsReport& report, const NurbsSurface& surface) {
  return bold(report.table.name) +
         fmt::format("\nNURBS surface of degrees {} and {}, {} x {} control points\n",
                     surface.degree_u, surface.degree_v, surface.count_u(), surface.count_v());
}

Result<std::vector<std::string>> write_nurbs(const NurbsReport& report,
                                             const NurbsOptions& options) {
  if (const auto model = nurbs_surface(report, options.units.value_or(Units{}))) {
    const auto outputs = surface_outputs_of(options.outputs, {options.input});
    OBVID_TRY(outputs);
    std::vector<std::string> warnings;
    const auto written = write_surface(*model, *outputs, {}, {}, warnings);
    OBVID_TRY(written);
    warn(warnings);
    return written->files;
  }
  std::vector<Output> files;
  for (const std::string& path : options.outputs) {
    auto text = nurbs_file(report, path, options.units.value_or(Units{}), options.samples);
    OBVID_TRY(text);
    files.push_back({path, {}, std::move(*text)});
  }
  return write_files(files);
}

}  // namespace

int run(const NurbsOptions& options) {
  if (auto free = check_outputs(options.outputs, {&options.input, 1}); !free) {
    return report(free.error());
  }
  if (auto able = can_write_all(options.outputs); !able) return report(able.error());
  auto points = read_control_table(options.input);
  if (!points) return report(points.error());
  ProgressBar bar(options.progress);
  const auto made = nurbs_report(std::move(*points), options.job, bar.progress());
  bar.clear();
  if (!made) return report(made.error());
  const auto files = write_nurbs(*made, options);
  if (!files) return report(files.error());
  std::string text;
  if (options.json) {
    text = nurbs_json(*made);
  } else if (const auto* curve = std::get_if<SpaceCurve>(&made->shape)) {
    text = curve_text(*made, *curve);
  } else {
    text = surface_text(*made, std::get<NurbsSurface>(made->shape));
  }
  for (const std::string& path : *files) {
    if (!options.json) text += fmt::format("written        {}\n", path);
  }
  if (options.quiet && !options.json) return 0;
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
