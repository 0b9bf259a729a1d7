// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "commands.h"
#include "obvid/core/files.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/internal/surface_report_json.h"
#include "obvid/pipeline/surface_export.h"
#include "obvid/pipeline/surface_job.h"
#include "obvid/pipeline/toolpath_job.h"
#include "outputs.h"
#include "terminal.h"
#include "text.h"
#include "toolpath_options.h"

namespace obvid {
namespace {

Result<std::vector<Output>> outputs_of(const ToolpathCommand& command) {
  OBVID_TRY(check_outputs(command.outputs, {&command.input, 1}));
  std::vector<Output> outputs;
  for (const std::string& path : command.outputs) {
    const auto format = toolpath_format_of(path);
    if (!format) {
      return error(ErrorCode::kUnknownFormat, "no format of tool paths has this file extension")
          .where(path)
          .hint("possible are " + known_toolpath_endings());
    }
    outputs.push_back({path, *format, {}});
  }
  return outputs;
}

struct Made {
  MadeToolpath job;
  std::vector<std::string> remarks;
  std::vector<std::string> warnings;
};

Result<void> fill(Output& output, Made& made, SurfaceExporter& exporter) {
  if (output.format == FileFormat::kGcode) {
    output.text = made.job.path.program.text;
    return {};
  }
  auto text = exporter.text(output.format, made.remarks);
  OBVID_TRY(text);
  output.text = std::move(*text);
  return {};
}

Result<Made> made_from(const ToolpathCommand& command, std::vector<Output>& outputs,
                       ProgressBar& bar) {
  Made made;
  bar.tell("reading", 0.0);
  auto model = read_surface(command.input, made.warnings);
  OBVID_TRY(model);
  auto path = make_toolpath(*model, command.job, bar.progress());
  OBVID_TRY(path);
  made.job = std::move(*path);
  made.warnings.insert(made.warnings.end(), made.job.warnings.begin(), made.job.warnings.end());
  SurfaceExportOptions formats;
  formats.view = command.view;
  formats.lines = drawn(made.job.path);
  SurfaceExporter exporter(made.job.surface, formats, bar.progress());
  bar.tell("writing", 1.0);
  for (Output& output : outputs) {
    OBVID_TRY(fill(output, made, exporter));
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

void add_rough_facts(const ToolpathReport& r, const std::string& unit, Facts& facts) {
  facts.add(
      "left",
      fmt::format("up to {} {} over part and allowance, measured along normals, at {}",
                  significant_above(r.scallop.found, 3), unit, toolpath_place(r.scallop.place)));
  if (r.narrow_stretches > 0) {
    facts.add("left out", fmt::format("{} stretches too short to go down", r.narrow_stretches));
  }
}

std::string entries_text(const ToolpathEntries& e, bool rough) {
  const std::string steepest =
      e.helical + e.ramped > 0
          ? fmt::format(" (both at most {} degrees against the level as planned, at {})",
                        significant_above(e.steepest_deg, 3), toolpath_place(e.steepest_place))
          : "";
  return fmt::format("{} helical and {} on ramps{}, {} straight down{}", e.helical, e.ramped,
                     steepest, e.straight, rough ? " beside the stock" : "");
}

std::string rest_text(const ToolpathReport& r, const std::string& unit) {
  const std::string share = area_share(r.leftover_area, r.surface_area);
  if (!(r.leftover_area > 0.0)) return share;
  return fmt::format("{} of the surface, {} left there by the earlier cutter at {}", share,
                     std::isfinite(r.leftover_depth)
                         ? fmt::format("up to {} {}", significant_above(r.leftover_depth, 3), unit)
                         : std::string("more than its diameter"),
                     toolpath_place(r.leftover_place));
}

std::string bound_text(const char* words, double most) {
  return std::isfinite(most) ? fmt::format(fmt::runtime(words), significant_above(most, 3))
                             : std::string("no bound is known");
}

/// Of the places that were looked at, which are not all of the surface.
std::string scallop_text(const ToolpathReport& r, const std::string& unit, bool earlier) {
  if (earlier && !(r.leftover_area > 0.0))
    return "none is looked at: nothing is left by the earlier cutter";
  std::string where = "where the cutter reaches";
  if (earlier) where += " and the earlier one left too much";
  if (r.flat_left > 0.0) where += " and levels are meant for";
  if (!(r.scallop.found > 0.0)) return "none found " + where;
  return fmt::format("{} {}, at {}; {}",
                     std::isfinite(r.scallop.found)
                         ? fmt::format("{} {}", significant(r.scallop.found, 3), unit)
                         : std::string("unbounded"),
                     where, toolpath_place(r.scallop.place),
                     bound_text("{} exceeded nowhere there", r.scallop.most));
}

std::string toolpath_text(const Made& made, const std::vector<std::string>& files, bool earlier) {
  const ToolpathReport& r = made.job.path.report;
  const std::string unit = made.job.path.units.text();
  Facts facts;
  const bool rough = std::isnan(r.hidden_area);
  facts.add("passes",
            rough ? fmt::format("{} on {} levels", r.passes, r.levels)
                  : fmt::format("{}{}, {} of them between others that left too much", r.passes,
                                r.levels > 0 ? fmt::format(", {} levels", r.levels) : "",
                                r.added_passes));
  facts.add("length",
            fmt::format("{} {} passes and links, {} {} ways down to them, {} {} rapid",
                        significant(r.cutting_length, 5), unit, significant(r.plunge_length, 5),
                        unit, significant(r.rapid_length, 5), unit));
  facts.add("entries", entries_text(r.entries, rough));
  facts.add("time", fmt::format("about {} minutes, with acceleration", significant(r.minutes, 3)));
  if (rough) {
    add_rough_facts(r, unit, facts);
  } else {
    facts.add("scallop", scallop_text(r, unit, earlier));
  }
  if (earlier) facts.add("rest", rest_text(r, unit));
  if (r.flat_left > 0.0) {
    facts.add("flatter",
              fmt::format("more than the scallop on {} of the surface, where levels are not meant "
                          "for; {} at {}",
                          area_share(r.flat_area, r.surface_area),
                          std::isfinite(r.flat_left)
                              ? fmt::format("up to {} {}", significant_above(r.flat_left, 3), unit)
                              : std::string("no pass comes"),
                          toolpath_place(r.flat_place)));
  }
  facts.add("gouges", fmt::format("{} {} the deepest found, {}; avoided by lifting at {} points",
                                  significant(r.gouge.found, 3), unit,
                                  bound_text("none beyond {}", r.gouge.most), r.lifted_points));
  if (!rough) {
    facts.add(
        "not seen from above",
        area_share(r.hidden_area, r.surface_area) +
            (r.hidden_area > 0.0 ? fmt::format(" ({}): undersides and undercuts, the lowest at {}",
                                               counted(r.hidden_places, "place", "places"),
                                               toolpath_place(r.hidden_place))
                                 : ""));
    facts.add("not reached",
              area_share(r.unreached_area, r.surface_area) +
                  (r.unreached_area > 0.0
                       ? fmt::format(" ({}): narrower than the cutter, up to {} {} left at {}",
                                     counted(r.unreached_places, "place", "places"),
                                     significant_above(r.unreached_depth, 3), unit,
                                     toolpath_place(r.unreached_place))
                       : ""));
  }
  if (made.job.up != UpAxis::kZ) {
    facts.add("turned", fmt::format("{} of the surface is Z here", to_string(made.job.up)));
  }
  facts.add("program", fmt::format("{} blocks, {} of them arcs; read back and simulated at places "
                                   "{} {} apart and nearer",
                                   made.job.path.program.blocks, made.job.path.program.arc_blocks,
                                   significant(r.spacing, 2), unit));
  for (const std::string& remark : made.remarks) facts.add("note", remark);
  facts.add("written", listed(files));
  return facts.text();
}

/// Exit code 5 where something is not so that was asked for; the files are written all the same.
int judge_toolpath(const Made& made) {
  auto error = not_kept(made.job);
  if (!error) return 0;
  error->hint = "the files were written" + (error->hint.empty() ? "" : "; " + error->hint);
  return report(*error);
}

}  // namespace

int run(const ToolpathCommand& command) {
  auto outputs = outputs_of(command);
  if (!outputs) return report(outputs.error());
  ProgressBar bar(command.progress);
  Result<Made> made = made_from(command, *outputs, bar);
  if (!made) {
    bar.clear();
    return report(made.error());
  }
  const auto files = write_files(*outputs);
  bar.clear();
  if (!files) return report(files.error());
  warn(made->warnings);
  std::string text;
  if (command.json) {
    made->job.warnings = made->warnings;
    text = toolpath_report_json(made->job, {*files, made->remarks});
  } else if (!command.quiet) {
    text = toolpath_text(*made, *files, command.job.rest_of.has_value());
  }
  if (auto done = put(text); !done) return report(done.error());
  return judge_toolpath(*made);
}

}  // namespace obvid
