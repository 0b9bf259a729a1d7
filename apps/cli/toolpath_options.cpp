// SPDX-License-Identifier: Apache-2.0
#include "toolpath_options.h"

#include <cmath>
#include <map>

#include "cli_app.h"
#include "commands.h"
#include "obvid/pipeline/internal/job_values.h"
#include "obvid/pipeline/internal/surface_values.h"
#include "options.h"

namespace obvid {
namespace {

struct RawToolpath {
  ToolpathCommand command;
  ToolpathValues values;
  std::string view = "iso";
  bool no_progress = false;
  std::string format;  ///< of what -o sends to standard output
};

constexpr const char* kOutputHelp =
    "File to write: .nc, .ngc, .gcode, .tap (G-code), .svg (picture), .html (page for browsers); "
    "may be repeated";

void add_cutter(CLI::App& app, RawToolpath& raw) {
  const char* group = "Cutter";
  ToolpathCommand& command = raw.command;
  app.add_option("--cutter", raw.values.cutter, "ball, flat or bull (rounded corners) [ball]")
      ->type_name("NAME")
      ->group(group);
  app.add_option("--diameter", command.job.diameter, "Diameter, units of the surface [6 mm]")
      ->type_name("D")
      ->group(group);
  app.add_option("--corner-radius", command.job.corner_radius,
                 "Of a bull-nose cutter, units [a quarter of the diameter]")
      ->type_name("R")
      ->group(group);
}

void add_earlier(CLI::App& app, ToolpathCommand& command) {
  const char* group = "Rest material";
  app.add_option("--rest-of", command.job.rest_of,
                 "Passes only where an earlier cutter of this diameter left more than the "
                 "tolerance, units [everywhere]")
      ->type_name("D")
      ->group(group);
  app.add_option("--rest-corner", command.job.rest_corner,
                 "Corner radius of the earlier cutter, units; 0: flat, half its diameter: a ball "
                 "[of this cutter's kind]")
      ->type_name("R")
      ->group(group);
}

void add_passes(CLI::App& app, RawToolpath& raw) {
  const char* group = "Passes";
  ToolpathOptions& plan = raw.command.job.plan;
  app.add_option("--up", raw.values.up,
                 "Which axis of the surface points to the spindle: x, y, z, -x, -y or -z; the "
                 "program has Z there [z]")
      ->type_name("AXIS")
      ->group(group);
  app.add_option("--strategy", raw.values.strategy,
                 "zigzag (parallel planes), isoparametric (along the patches' parameters), "
                 "scallop (constant height between passes), z-level (around walls at constant "
                 "height) or rough (a box of stock, level by level) [zigzag]")
      ->type_name("NAME")
      ->group(group);
  app.add_option("--scallop", plan.scallop,
                 "Greatest residual scallop height between passes, units [0.01 diameters]")
      ->type_name("H")
      ->group(group);
  app.add_option("--step-over", plan.step_over,
                 "Greatest distance of passes, units [by scallop; roughing: 0.4 diameters]")
      ->type_name("S")
      ->group(group);
  app.add_option("--angle", plan.angle_deg, "Of the passes against X, degrees [0]")
      ->type_name("DEG")
      ->group(group);
  app.add_option("--steep-angle", plan.steep_deg,
                 "Zigzag: walls that lean more are cut by levels [none]; z-level: leaning of walls "
                 "for which the scallop is kept [45]")
      ->type_name("DEG")
      ->group(group);
  app.add_flag("--along-v", plan.along_v, "Isoparametric passes along v [along u]")->group(group);
  app.add_flag("--one-way", plan.one_way, "All passes in the same direction")->group(group);
  app.add_option("--tolerance", raw.command.job.tolerance,
                 "Deepest gouge of the printed program, units [0.01 mm]")
      ->type_name("T")
      ->group(group);
  app.add_option("--allowance", plan.allowance, "What stays for later passes, units [0]")
      ->type_name("A")
      ->group(group);
  app.add_option("--safe-z", plan.safe_z,
                 "Height of rapid moves, units [half a diameter above part and stock]")
      ->type_name("Z")
      ->group(group);
}

void add_roughing(CLI::App& app, RawToolpath& raw) {
  const char* group = "Roughing";
  ToolpathOptions& plan = raw.command.job.plan;
  app.add_option("--step-down", plan.step_down,
                 "Most of a level, units [half a diameter; z-level: by scallop]")
      ->type_name("Z")
      ->group(group);
  app.add_option("--stock", raw.values.stock,
                 "Lowest and highest corner of the stock, units [box of part and allowance]")
      ->type_name("X0,Y0,Z0,X1,Y1,Z1")
      ->group(group);
}

void add_entries(CLI::App& app, RawToolpath& raw) {
  const char* group = "Entries";
  ToolpathOptions& plan = raw.command.job.plan;
  app.add_option("--entry", raw.values.entry,
                 "How the tip goes down to a pass: ramp (back and forth over it) or helix (else on "
                 "a ramp) [roughing: ramp; else straight down, a ramp with --ramp]")
      ->type_name("NAME")
      ->group(group);
  app.add_option("--ramp", plan.ramp_deg,
                 "How steeply ramps and helices go down over the pass at most, degrees [5]")
      ->type_name("DEG")
      ->group(group);
  app.add_option("--ramp-height", plan.ramp_height,
                 "Not roughing: how far over the pass they begin, units [half a diameter]")
      ->type_name("H")
      ->group(group);
}

void add_program(CLI::App& app, RawToolpath& raw) {
  const char* group = "Program";
  ToolpathOptions& plan = raw.command.job.plan;
  app.add_option("--feed", plan.feed, "Feed along passes [1000 mm/min; inches: 40 in/min]")
      ->type_name("F")
      ->group(group);
  app.add_option("--plunge-feed", plan.plunge_feed,
                 "Feed straight down and on ramps [300 mm/min; inches: 12 in/min]")
      ->type_name("F")
      ->group(group);
  app.add_option("--rapid-feed", plan.rapid_feed,
                 "Of rapid moves, for the time [5000 mm/min; inches: 200 in/min]")
      ->type_name("F")
      ->group(group);
  app.add_option("--acceleration", plan.acceleration,
                 "Along the way, mm/s^2, for the estimate of time [500]")
      ->type_name("A")
      ->group(group);
  app.add_option("--spindle", plan.spindle, "Revolutions a minute: M3, M5 [none]")
      ->type_name("S")
      ->group(group);
  app.add_option("--controller", raw.values.controller, "grbl, linuxcnc, fanuc or marlin [grbl]")
      ->type_name("NAME")
      ->group(group);
  app.add_option("--motion", raw.values.motion,
                 "arcs (G2, G3 in passes along X or Y) or lines (G1 only) [arcs]")
      ->type_name("NAME")
      ->group(group);
}

Result<Command> checked_toolpath(const CLI::App& app, RawToolpath& raw) {
  ToolpathCommand& command = raw.command;
  OBVID_TRY(check_extras(app, app.remaining(), "toolpath"));
  OBVID_TRY(set_toolpath(raw.values, command.job));
  command.input = input_or_pipe(command.input);
  if (command.input.empty()) {
    return fail(usage("toolpath needs a surface", "see obvid toolpath --help"));
  }
  if (command.outputs.empty()) {
    return fail(usage("toolpath needs a file to write", "add -o part.nc"));
  }
  const auto view = view_named(raw.view);
  OBVID_TRY(view);
  command.view = *view;
  OBVID_TRY(settle_streams(command, raw.format, false, "nc"));
  command.progress = !raw.no_progress && !command.quiet && !command.json;
  return command_of(command);
}

}  // namespace

Result<Command> parse_toolpath(int argc, const char* const* argv) {
  CLI::App app("Three-axis milling of a surface: G-code without gouges, within a stated scallop",
               "obvid toolpath");
  shape_help(app, kHelpColumn, argc, argv);
  app.allow_extras();
  RawToolpath raw;
  app.add_option("INPUT", raw.command.input, "Surface (.json, STEP, IGES, BREP, control points)");
  add_output(app, raw.command.outputs, raw.format, kOutputHelp, "nc");
  add_cutter(app, raw);
  add_earlier(app, raw.command);
  add_passes(app, raw);
  add_roughing(app, raw);
  add_entries(app, raw);
  add_program(app, raw);
  app.add_option("--view", raw.view, "Of the picture: iso, front, top, side, back or bottom [iso]")
      ->type_name("NAME");
  app.add_flag("--json", raw.command.json, "Report as JSON on standard output");
  app.add_flag("-q,--quiet", raw.command.quiet, "No report and no progress bar");
  app.add_flag("--no-progress", raw.no_progress, "No progress bar");
  app.footer(with_exit_codes(
      "Example: obvid toolpath hull.json --cutter ball --diameter 6 --scallop 0.02 -o hull.nc\n\n"
      "The part lies as the surface says, Z upwards; the tip of the cutter is programmed. Read "
      "the\n"
      "program before you run it: it knows no clamps, and of stock only what roughing is told."));
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return command_of(ShowText{app.help()});
  } catch (const CLI::ParseError& error) {
    return fail(from_cli(error, "toolpath"));
  }
  return checked_toolpath(app, raw);
}

}  // namespace obvid
