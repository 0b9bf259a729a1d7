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
  std::optional<ToolpathGcode> program;
  std::vector<std::string> remarks;
  std::vector<std::string> warnings;
};

Result<void> fill(ToolpathOutput& output, const ToolpathCommand& command, Made& made,
                  SurfaceExporter& exporter) {
  if (output.kind == Kind::kProgram) {
    if (!made.program) {
      auto program = toolpath_gcode(made.path, command.gcode);
      if (!program) return fail(program.error());
      made.program = std::move(*program);
    }
    output.text = made.program->text;
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
  if (auto good = check_effort(made.model, command.plan); !good) return fail(good.error());
  auto path = plan(made.model, command.plan, bar.progress());
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
    if (auto done = fill(output, command, made, exporter); !done) return fail(done.error());
  }
  return made;
}

std::string share_text(double area, double all) {
  return area > 0.0 && all > 0.0 ? fmt::format("{} %", significant(100.0 * area / all, 3)) : "none";
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
  facts.add("scallop",
            fmt::format("{} {} at most where the cutter reaches", significant(r.scallop, 3), unit));
  facts.add("gouges", fmt::format("none beyond {} {}; avoided by lifting at {} points",
                                  significant(made.path.tolerance, 3), unit, r.lifted_points));
  facts.add("not seen from above", share_text(r.hidden_area, r.surface_area));
  facts.add("not reached",
            share_text(r.unreached_area, r.surface_area) +
                (r.unreached_area > 0.0
                     ? fmt::format(", up to {} {} left", significant(r.unreached_depth, 3), unit)
                     : ""));
  if (made.program) {
    facts.add("program", fmt::format("{} blocks, {} of them arcs", made.program->blocks,
                                     made.program->arc_blocks));
  }
  for (const std::string& remark : made.remarks) facts.add("note", remark);
  facts.add("written", listed(files));
  return facts.text();
}

std::string toolpath_json(const Made& made, const std::vector<std::string>& files) {
  const ToolpathReport& r = made.path.report;
  JsonText json;
  json.begin_object().pair("units", made.path.units).pair("passes", r.passes);
  json.pair("added_passes", r.added_passes).pair("cutting_length", r.cutting_length);
  json.pair("plunge_length", r.plunge_length).pair("rapid_length", r.rapid_length);
  json.pair("minutes", r.minutes).pair("scallop", r.scallop).pair("tolerance", made.path.tolerance);
  json.pair("lifted_points", r.lifted_points).pair("surface_area", r.surface_area);
  json.pair("hidden_area", r.hidden_area).pair("unreached_area", r.unreached_area);
  json.pair("unreached_depth", r.unreached_depth).pair("safe_z", r.safe_z);
  if (made.program) {
    json.pair("blocks", made.program->blocks).pair("arc_blocks", made.program->arc_blocks);
  }
  json.key("warnings").begin_array();
  for (const std::string& warning : made.warnings) json.value(warning);
  json.end_array().key("written").begin_array();
  for (const std::string& file : files) json.value(file);
  return json.end_array().end_object().take() + "\n";
}

/// Exit code 5 where more is left than was asked for.
int judge_toolpath(const ToolpathCommand& command, const Made& made) {
  constexpr double kMeasured = 1.05;  // what is measured is good to some percent
  const double left = made.path.report.scallop;
  if (!command.plan.scallop || left <= kMeasured * *command.plan.scallop) return 0;
  return report(
      {ErrorCode::kToleranceNotReached,
       fmt::format("{} {} is left between passes where {} were asked for", significant(left, 3),
                   made.path.units, significant(*command.plan.scallop, 3)),
       "", "the files were written; a ball cutter or a smaller --step-over leaves less", -1, left});
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
  return judge_toolpath(command, *made);
}

}  // namespace obvid
