// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "obvid/core/internal/data_table.h"
#include "obvid/core/units.h"
#include "obvid/pipeline/internal/summary.h"
#include "obvid/pipeline/internal/surface_report_json.h"
#include "outputs.h"
#include "several.h"
#include "surface_options.h"
#include "surface_outputs.h"
#include "surface_report.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

std::string end_text(double end) {
  return std::isfinite(end) ? significant(end, 3) : std::string("no bound");
}

std::string range_text(const Extent& extent) {
  return fmt::format("{} to {}", end_text(extent.least), end_text(extent.most));
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
  add_rows_worth_showing(worst, table, [&](std::size_t i) {
    const PatchReport& p = check.patches[i];
    table.row({p.name, fmt::format("{} x {}{}", p.degree_u, p.degree_v, p.rational ? " rat." : ""),
               fmt::format("{} x {}", p.count_u, p.count_v),
               order_text(p.order_u) + ", " + order_text(p.order_v),
               significant(p.area, p.trims > 0 ? 8 : 4), range_text(p.gaussian),
               range_text(p.mean)});
  });
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
  add_rows_worth_showing(worst, table, [&](std::size_t i) {
    const PatchReport& p = check.patches[i];
    table.row({p.name, monotone_text(p.along_u), std::to_string(p.along_u.vertices),
               std::to_string(p.along_u.most_vertices), std::to_string(p.along_u.inflections),
               monotone_text(p.along_v), std::to_string(p.along_v.vertices),
               std::to_string(p.along_v.most_vertices), std::to_string(p.along_v.inflections)});
  });
  return table;
}

std::string coordinates_text(Vec3 p) {
  constexpr double kTold = 1e-6;  // of the largest coordinate: less is rounding of the place
  const double least = kTold * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const auto text = [least](double c) { return significant(std::abs(c) < least ? 0.0 : c, 5); };
  p = p + Vec3{};  // -0 becomes 0
  return fmt::format("{}, {}, {}", text(p.x), text(p.y), text(p.z));
}

/// Extremes of curvature over all patches, and where they are.
Table extreme_table(const SurfaceCheck& check) {
  Table table;
  table.column("curvature", Table::Align::kLeft);
  table.column("least");
  table.column("at x, y, z", Table::Align::kLeft);
  table.column("on", Table::Align::kLeft);
  table.column("greatest");
  table.column("at x, y, z", Table::Align::kLeft);
  table.column("on", Table::Align::kLeft);
  const auto row = [&](const char* name, Extent PatchReport::*quantity) {
    const auto end = [&](bool least) {
      return *std::max_element(check.patches.begin(), check.patches.end(),
                               [&](const PatchReport& a, const PatchReport& b) {
                                 return least ? (a.*quantity).least > (b.*quantity).least
                                              : (a.*quantity).most < (b.*quantity).most;
                               });
    };
    const PatchReport low = end(true), high = end(false);
    table.row({name, end_text((low.*quantity).least),
               coordinates_text((low.*quantity).least_at.point), low.name,
               end_text((high.*quantity).most), coordinates_text((high.*quantity).most_at.point),
               high.name});
  };
  row("Gaussian", &PatchReport::gaussian);
  row("mean", &PatchReport::mean);
  row("k1", &PatchReport::k1);
  row("k2", &PatchReport::k2);
  return table;
}

/// "0.31 at (1, 2, 3) (point 12)".
std::string measured_text(const MeasuredPlace& place, bool points) {
  std::string text =
      fmt::format("{} at ({})", significant(place.off, 4), coordinates_text(place.point));
  if (points) text += fmt::format(" (point {})", place.number + 1);
  return text;
}

void add_deviation(Facts& facts, const std::string& name, const Deviation& found, bool points,
                   const std::string& units) {
  facts.add(name, fmt::format("{} to {}", measured_text(found.least, points),
                              measured_text(found.most, points)));
  std::string rest =
      fmt::format("root mean square {} {}, mean {}", significant(found.root_mean_square, 4), units,
                  significant(found.mean, 4));
  if (found.beside > 0.0) {
    rest += fmt::format("; {} % of the {} beside, nearest to a border",
                        significant(100.0 * found.beside, 3), points ? "points lie" : "area lies");
  }
  facts.add("", rest);
}

Table joint_table(const SurfaceModel& model, const SurfaceCheck& check) {
  Table table;
  table.column("border", Table::Align::kLeft);
  table.column("meets", Table::Align::kLeft);
  table.column("gap");
  table.column("angle\ndegrees");
  table.column("curvature\nstep");
  table.column("order");
  table.column("angle largest\nat x, y, z", Table::Align::kLeft);
  std::vector<double> worst;
  for (const JointReport& j : check.joints) worst.push_back(j.angle);
  add_rows_worth_showing(worst, table, [&](std::size_t i) {
    const JointReport& j = check.joints[i];
    const auto side = [&](std::size_t k) {
      return fmt::format("{}, {}", model.patches[j.patch[k]].name, border_name(j.side[k]));
    };
    table.row({side(0), side(1), significant(j.gap, 3), significant(j.angle / kOneDegree, 3),
               significant(100.0 * j.curvature, 3) + " %", fmt::format("G{}", j.order),
               coordinates_text(j.angle_at)});
  });
  return table;
}

/// Faces beside trimmed ones.
Table trim_table(const SurfaceModel& model, const SurfaceCheck& check) {
  Table table;
  table.column("face", Table::Align::kLeft);
  table.column("along", Table::Align::kLeft);
  table.column("length");
  table.column("gap");
  table.column("angle\ndegrees");
  table.column("order");
  table.column("gap largest\nat x, y, z", Table::Align::kLeft);
  table.column("angle largest\nat x, y, z", Table::Align::kLeft);
  std::vector<double> worst;
  for (const TrimJointReport& j : check.trim_joints) worst.push_back(j.angle);
  add_rows_worth_showing(worst, table, [&](std::size_t i) {
    const TrimJointReport& j = check.trim_joints[i];
    table.row({model.patches[j.patch[0]].name,
               j.patch[0] == j.patch[1] ? "its own seam" : model.patches[j.patch[1]].name,
               significant(j.length, 4), significant(j.gap, 3),
               significant(j.angle / kOneDegree, 3), j.order > 0 ? "G1" : "G0",
               coordinates_text(j.gap_at), coordinates_text(j.angle_at)});
  });
  return table;
}

/// "36 mm, 12 mm of them free, most around (1, 2, 3)".
std::string trimmed_borders_text(const TrimmedBorders& borders, const std::string& units) {
  std::string text = fmt::format("{} {}", significant(borders.length, 4), units);
  text += borders.free > 0.0
              ? fmt::format(", {} {} of them along no other face (longest stretch around {})",
                            significant(borders.free, 4), units, coordinates_text(borders.free_at))
              : std::string(", all along other faces");
  return text + ", as sampled";
}

Result<std::vector<Output>> pictures_of(const SurfaceCheckOptions& options) {
  std::vector<std::string> inputs{options.input};
  if (options.job.against) inputs.push_back(options.job.against->name);
  auto outputs = surface_outputs_of(options.outputs, inputs);
  if (!outputs) return outputs;
  for (const Output& output : *outputs) {
    if (check_format_of(output.path)) continue;
    return error(ErrorCode::kUnknownFormat, "check writes pictures only")
        .where(output.path)
        .hint("give a name that ends in .svg or .html; other formats: obvid surface convert");
  }
  return outputs;
}

/// "12 meet, 4 of them too far apart to be joined in meshes and CAD files, 2 are free".
std::string borders_text(const SurfaceCheck& check) {
  std::string text = fmt::format("{} meet", check.met_borders);
  if (check.apart_borders > 0) {
    text += fmt::format(", {} of them too far apart to be joined in meshes and CAD files",
                        check.apart_borders);
  }
  return text + fmt::format(", {} free", check.free_borders);
}

}  // namespace

std::string surface_check_text(const SurfaceModel& model, const CheckedSurface& checked,
                               const Written& written) {
  const SurfaceCheck& check = checked.check;
  std::string text = patch_table(check).text() + "\n" + extreme_table(check).text() + "\n" +
                     line_table(check).text() + "\n";
  if (!check.joints.empty()) text += joint_table(model, check).text() + "\n";
  if (!check.trim_joints.empty()) text += trim_table(model, check).text() + "\n";
  Facts facts;
  facts.add("size", significant(check.size) + " " + model.units.text());
  facts.add("borders", borders_text(check));
  if (is_trimmed(model)) {
    facts.add("of trims", trimmed_borders_text(check.trimmed_borders, model.units.text()));
  }
  if (const auto& deviation = checked.deviation) {
    const std::string units = model.units.text();
    facts.add("against", fmt::format("{}: {}", deviation->against,
                                     deviation->points
                                         ? counted(deviation->found.places, "point", "points")
                                         : counted(deviation->found.places, "place of this surface",
                                                   "places of this surface")));
    add_deviation(facts, deviation->points ? "points off" : "this off", deviation->found,
                  deviation->points, units);
    if (deviation->back) add_deviation(facts, "it off this", *deviation->back, false, units);
  }
  for (const std::string& remark : written.remarks) facts.add("note", remark);
  if (!written.files.empty()) facts.add("written", listed(written.files));
  return text + facts.text();
}

namespace {

/// What was read, measured and written.
struct CheckDone {
  SurfaceModel model;
  CheckedSurface checked;
  Written written;
};

Result<CheckDone> check_done(const SurfaceCheckOptions& options, ProgressBar& bar) {
  const auto outputs = pictures_of(options);
  OBVID_TRY(outputs);
  bar.tell("reading", 0.0);
  std::vector<std::string> warnings;
  Result<SurfaceModel> model = read_surface(options.input, warnings);
  OBVID_TRY(model);
  auto checked = check_surface(*model, options.job, bar.progress());
  OBVID_TRY(checked);
  warnings.insert(warnings.end(), checked->warnings.begin(), checked->warnings.end());
  SurfaceExportOptions formats = options.formats;
  show_findings(*checked, formats);
  auto written = write_surface(*model, *outputs, formats, bar.progress(), warnings);
  OBVID_TRY(written);
  checked->warnings = std::move(warnings);  // those of reading and writing, too
  return CheckDone{std::move(*model), std::move(*checked), std::move(*written)};
}

DataTable patch_rows(const SurfaceCheck& check) {
  DataTable out{
      heads_of("patch,degree_u,degree_v,control_points_u,control_points_v,inside_u,inside_v,trims,"
               "area,gaussian_least,gaussian_most,mean_least,mean_most,least_curvature,"
               "largest_curvature,vertices_along_u,vertices_along_v")};
  for (const PatchReport& p : check.patches) {
    out.rows.push_back({p.name, p.degree_u, p.degree_v, p.count_u, p.count_v, p.order_u, p.order_v,
                        p.trims, p.area, p.gaussian.least, p.gaussian.most, p.mean.least,
                        p.mean.most, p.k2.least, p.k1.most, p.along_u.vertices,
                        p.along_v.vertices});
  }
  return out;
}

/// Least and greatest of all patches.
Extent over_patches(const SurfaceCheck& check, const Extent PatchReport::*which) {
  Extent out;
  out.least = HUGE_VAL;
  out.most = -HUGE_VAL;
  for (const PatchReport& p : check.patches) {
    out.least = std::min(out.least, (p.*which).least);
    out.most = std::max(out.most, (p.*which).most);
  }
  return out;
}

std::vector<SummaryCell> cells_of(const CheckDone& done) {
  const SurfaceCheck& check = done.checked.check;
  const std::string units = done.model.units.text();
  const Extent gaussian = over_patches(check, &PatchReport::gaussian);
  const Extent mean = over_patches(check, &PatchReport::mean);
  std::vector<SummaryCell> out{
      {"patches", counted(check.patches.size(), "patch", "patches"),
       std::to_string(check.patches.size())},
      {"size", fmt::format("size {} {}", significant(check.size), units), csv_cell(check.size)},
      {"gaussian_least", "", csv_cell(gaussian.least)},
      {"gaussian_most", "Gaussian " + range_text(gaussian), csv_cell(gaussian.most)},
      {"mean_least", "", csv_cell(mean.least)},
      {"mean_most", "mean " + range_text(mean), csv_cell(mean.most)},
      {"joints", "borders " + borders_text(check), std::to_string(check.joints.size())}};
  if (const auto& deviation = done.checked.deviation) {
    const double off = deviation->found.farthest().off;
    out.push_back(
        {"farthest", fmt::format("{} {} off", significant(off, 3), units), csv_cell(off)});
  }
  return out;
}

Summary summary_of_check(const SurfaceCheckOptions& all, const OneOf& one,
                         const std::vector<std::string>& outputs) {
  Summary out;
  const SurfaceCheckOptions options = options_of_one(all, one, outputs);
  ProgressBar none(false);
  auto done = check_done(options, none);
  if (!done) {
    out.error = done.error();
    return out;
  }
  out.warnings = done->checked.warnings;
  out.cells = cells_of(*done);
  out.verdict = "measured";
  return out;
}

int check_several(const SurfaceCheckOptions& options) {
  return run_each(options, {}, false, options.outputs,
                  [&](const OneOf& one, const std::vector<std::string>& outputs) {
                    return summary_of_check(options, one, outputs);
                  });
}

}  // namespace

int run(const SurfaceCheckOptions& options) {
  if (!options.inputs.empty()) return check_several(options);
  ProgressBar bar(options.progress);
  const auto done = check_done(options, bar);
  bar.clear();
  if (!done) return report(done.error());
  const auto& [model, checked, written] = *done;
  warn(checked.warnings);
  std::string text;
  if (options.json) {
    text = surface_check_json(model, checked, written);
  } else if (options.csv) {
    text = csv_text(patch_rows(checked.check));
  } else if (!options.quiet) {
    text = surface_check_text(model, checked, written);
  }
  if (auto shown = put(text); !shown) return report(shown.error());
  return 0;
}

}  // namespace obvid
