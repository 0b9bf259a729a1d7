// SPDX-License-Identifier: Apache-2.0
#include "obvid/toolpath/toolpath.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "json_text.h"
#include "obvid/io/atomic_file.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/surface_export.h"
#include "obvid/pipeline/surface_job.h"
#include "outputs.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

enum class Kind { kProgram, kPicture, kPage };

struct ToolpathOutput {
  std::string path;
  Kind kind = Kind::kProgram;
  std::string text;
};

Result<std::vector<ToolpathOutput>> outputs_of(const ToolpathCommand& command) {
  if (auto free = check_outputs(command.outputs, {&command.input, 1}); !free) {
    return fail(free.error());
  }
  std::vector<ToolpathOutput> outputs;
  for (const std::string& path : command.outputs) {
    const auto surface = surface_format_of(path);
    if (format_of(path) == FileFormat::kGcode) {
      outputs.push_back({path, Kind::kProgram, {}});
    } else if (surface == SurfaceFormat::kPicture || surface == SurfaceFormat::kPage) {
      outputs.push_back(
          {path, surface == SurfaceFormat::kPicture ? Kind::kPicture : Kind::kPage, {}});
    } else {
      return fail({ErrorCode::kUnknownFormat, "no format of tool paths has this ending", path,
                   "possible are .nc, .ngc, .gcode, .tap, .svg, .html", -1, 0.0});
    }
  }
  return outputs;
}

/// The path as it is drawn over the surface.
std::vector<ScenePolyline> drawn(const Toolpath& path) {
  constexpr double kThinned = 4.0;  // tolerances: not seen in a picture
  std::vector<ScenePolyline> lines;
  for (auto& points : cutting_lines(path, kThinned * path.tolerance)) {
    lines.push_back({std::move(points), "toolpath"});
  }
  for (auto& points : rapid_lines(path)) lines.push_back({std::move(points), "rapid"});
  return lines;
}

struct Made {
  SurfaceModel model;
  Toolpath path;
  std::vector<std::string> remarks;
  std::vector<std::string> warnings;
};

Result<void> fill(ToolpathOutput& output, Made& made, SurfaceExporter& exporter) {
  if (output.kind == Kind::kProgram) {
    output.text = made.path.program.text;
    return {};
  }
  const bool page = output.kind == Kind::kPage;
  auto text = exporter.text(page ? SurfaceFormat::kPage : SurfaceFormat::kPicture, made.remarks);
  if (!text) return fail(text.error());
  output.text = std::move(*text);
  return {};
}

/// Distance of passes on a level place.
double level_step(const ToolpathOptions& plan) {
  if (plan.step_over) return *plan.step_over;
  if (plan.cutter.kind == CutterKind::kFlat) return plan.cutter.diameter / 2.0;
  const bool ball = plan.cutter.kind == CutterKind::kBall;
  const double r = ball ? plan.cutter.diameter / 2.0 : plan.cutter.corner_radius;
  return 2.0 * std::sqrt(2.0 * r * plan.scallop.value_or(r));
}

/// What is not typed, in the units of the surface.
ToolpathOptions options_for(const ToolpathCommand& command, const std::string& units) {
  constexpr double kDiameter = 6.0, kTolerance = 0.01;  // mm
  constexpr double kScallop = 0.01, kCorner = 0.25;     // diameters
  ToolpathOptions plan = command.plan;
  const double mm = millimetres_of(units);
  const double unit = mm > 0.0 ? mm : 1.0;  // units that machines do not know are refused
  plan.cutter.diameter = command.diameter.value_or(kDiameter / unit);
  plan.tolerance = command.tolerance.value_or(kTolerance / unit);
  if (!plan.scallop && !plan.step_over) plan.scallop = kScallop * plan.cutter.diameter;
  if (plan.cutter.kind == CutterKind::kBullNose) {
    plan.cutter.corner_radius = command.corner_radius.value_or(kCorner * plan.cutter.diameter);
  }
  return plan;
}

/// Refuses work without end: a typing error in a length, most likely.
Result<void> check_effort(const SurfaceModel& model, const ToolpathOptions& plan) {
  constexpr double kMostPasses = 20'000.0;
  const double passes = size_of(model) / level_step(plan);
  if (!(passes > kMostPasses)) return {};  // sizes that are no sizes are refused by the plan
  return fail({ErrorCode::kBadOption,
               fmt::format("that would be some {:.2g} passes over {} {}", passes,
                           significant(size_of(model), 4), model.units.text()),
               "", "check the units of the surface, --diameter, --scallop and --step-over", -1,
               passes});
}

Result<Made> made_from(const ToolpathCommand& command, std::vector<ToolpathOutput>& outputs,
                       ProgressBar& bar) {
  Made made;
  bar.tell("reading", 0.0);
  auto model = read_surface(command.input, made.warnings);
  if (!model) return fail(model.error());
  made.model = std::move(*model);
  const ToolpathOptions options = options_for(command, made.model.units.name);
  if (auto good = check_effort(made.model, options); !good) return fail(good.error());
  auto path = plan(made.model, options, bar.progress());
  if (!path) return fail(path.error());
  made.path = std::move(*path);
  if (!made.model.units.known()) {
    made.warnings.push_back("nothing says what a unit is: " + made.model.units.name +
                            " assumed; `obvid surface convert --units` states it");
  }
  made.warnings.insert(made.warnings.end(), made.path.warnings.begin(), made.path.warnings.end());
  SurfaceExportOptions formats;
  formats.view = *surface_view_named(command.view);
  formats.lines = drawn(made.path);
  SurfaceExporter exporter(made.model, formats, bar.progress());
  bar.tell("writing", 1.0);
  for (ToolpathOutput& output : outputs) {
    if (auto done = fill(output, made, exporter); !done) return fail(done.error());
  }
  return made;
}

std::string area_share(double area, double all) {
  return area > 0.0 && all > 0.0 ? fmt::format("about {} %", significant(100.0 * area / all, 3))
                                 : "none";
}

std::string toolpath_place(Vec3 p) {
  return fmt::format("{} {} {}", significant(p.x, 6), significant(p.y, 6), significant(p.z, 6));
}

std::string toolpath_text(const Made& made, const std::vector<std::string>& files) {
  const ToolpathReport& r = made.path.report;
  const std::string& unit = made.path.units;
  Facts facts;
  facts.add("passes", fmt::format("{}, {} of them between others that left too much", r.passes,
                                  r.added_passes));
  facts.add("length", fmt::format("{} {} at feed, {} {} rapid", significant(r.cutting_length, 5),
                                  unit, significant(r.rapid_length, 5), unit));
  facts.add("time", fmt::format("{} minutes at the stated feeds, without acceleration",
                                significant(r.minutes, 3)));
  const auto bound = [](const char* words, double most) {
    return std::isfinite(most) ? fmt::format(fmt::runtime(words), significant(most, 3))
                               : std::string("no bound is known");
  };
  facts.add("scallop",
            fmt::format("{} {} where the cutter reaches, at {}; {}",
                        significant(r.scallop.found, 3), unit, toolpath_place(r.scallop.place),
                        bound("{} nowhere exceeded", r.scallop.most)));
  facts.add("gouges", fmt::format("{} {} the deepest found, {}; avoided by lifting at {} points",
                                  significant(r.gouge.found, 3), unit,
                                  bound("none beyond {}", r.gouge.most), r.lifted_points));
  facts.add("not seen from above", area_share(r.hidden_area, r.surface_area));
  facts.add("not reached",
            area_share(r.unreached_area, r.surface_area) +
                (r.unreached_area > 0.0
                     ? fmt::format(", up to {} {} left at {}", significant(r.unreached_depth, 3),
                                   unit, toolpath_place(r.unreached_place))
                     : ""));
  facts.add("program", fmt::format("{} blocks, {} of them arcs; read back and simulated at places "
                                   "{} {} apart and nearer",
                                   made.path.program.blocks, made.path.program.arc_blocks,
                                   significant(r.spacing, 2), unit));
  for (const std::string& remark : made.remarks) facts.add("note", remark);
  facts.add("written", listed(files));
  return facts.text();
}

/// Found at a place, and what is nowhere exceeded.
void add_measured(JsonText& json, const char* name, const ToolpathReport::Measured& measured) {
  json.key(name).begin_object().pair("found", measured.found).pair("most", measured.most);
  json.key("place").begin_array();
  for (const double x : {measured.place.x, measured.place.y, measured.place.z}) json.value(x);
  json.end_array().end_object();
}

std::string toolpath_json(const Made& made, const std::vector<std::string>& files) {
  const ToolpathReport& r = made.path.report;
  JsonText json;
  json.begin_object().pair("units", made.path.units).pair("passes", r.passes);
  json.pair("added_passes", r.added_passes).pair("cutting_length", r.cutting_length);
  json.pair("plunge_length", r.plunge_length).pair("rapid_length", r.rapid_length);
  json.pair("minutes", r.minutes).pair("tolerance", made.path.tolerance);
  add_measured(json, "scallop", r.scallop);
  add_measured(json, "gouge", r.gouge);
  json.pair("spacing", r.spacing);
  json.pair("lifted_points", r.lifted_points).pair("surface_area", r.surface_area);
  json.pair("hidden_area", r.hidden_area).pair("unreached_area", r.unreached_area);
  json.pair("unreached_depth", r.unreached_depth).pair("safe_z", r.safe_z);
  json.pair("blocks", made.path.program.blocks).pair("arc_blocks", made.path.program.arc_blocks);
  json.key("not_kept").begin_array();
  for (const Error& error : made.path.not_kept) json.value(error.what);
  json.end_array();
  json.key("warnings").begin_array();
  for (const std::string& warning : made.warnings) json.value(warning);
  json.end_array().key("written").begin_array();
  for (const std::string& file : files) json.value(file);
  return json.end_array().end_object().take() + "\n";
}

/// Exit code 5 where something is not so that was asked for; the files are written all the same.
int judge_toolpath(const Made& made) {
  int code = 0;
  for (Error error : made.path.not_kept) {
    error.hint = "the files were written" + (error.hint.empty() ? "" : "; " + error.hint);
    code = report(error);
  }
  return code;
}

}  // namespace

int run(const ToolpathCommand& command) {
  auto outputs = outputs_of(command);
  if (!outputs) return report(outputs.error());
  ProgressBar bar(command.progress);
  const Result<Made> made = made_from(command, *outputs, bar);
  if (!made) {
    bar.clear();
    return report(made.error());
  }
  std::vector<std::string> files;
  for (const ToolpathOutput& output : *outputs) {
    if (auto done = write_file(output.path, output.text); !done) {
      bar.clear();
      return report(done.error());
    }
    files.push_back(output.path);
  }
  bar.clear();
  warn(made->warnings);
  std::string text;
  if (command.json) {
    text = toolpath_json(*made, files);
  } else if (!command.quiet) {
    text = toolpath_text(*made, files);
  }
  if (auto done = put(text); !done) return report(done.error());
  return judge_toolpath(*made);
}

}  // namespace obvid
