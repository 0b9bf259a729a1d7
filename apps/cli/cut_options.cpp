// SPDX-License-Identifier: Apache-2.0
#include "cut_options.h"

#include <filesystem>

#include "cli_app.h"
#include "commands.h"
#include "obvid/pipeline/internal/format_values.h"
#include "options.h"

namespace obvid {
namespace {

struct RawCut {
  CutCommand command;
  CutValues values;
  FormatValues reading;
  std::string units, format;  ///< format: of what -o sends to standard output
  bool csv = false, no_progress = false;
};

constexpr const char* kCutOutputHelp =
    "File to write: .nc, .ngc, .gcode, .tap (G-code), .svg (picture), .dxf (drawing of the paths), "
    ".csv (table), .html (page with both)";

/// Options that are one number each.
class Numbers {
 public:
  Numbers(CLI::App& app, const char* group) : app_(app), group_(group) {}
  template <class Value>
  Numbers& add(const char* name, Value& value, const char* type, const char* help) {
    app_.add_option(name, value, help)->type_name(type)->group(group_);
    return *this;
  }

 private:
  CLI::App& app_;
  const char* group_;
};

void add_tool(CLI::App& app, RawCut& raw) {
  CutOptions& plan = raw.command.job.plan;
  Numbers(app, "Tool")
      .add("--diameter", plan.diameter, "D",
           "Of the cutter, or width of the kerf, units of the drawing; 0: along the outlines [0]")
      .add("--side", raw.values.side, "NAME",
           "auto (around parts, inside of holes), outside, inside, or on the outlines [auto]")
      .add("--direction", raw.values.direction, "NAME",
           "climb (what stays lies to the right of the tool) or conventional [climb]")
      .add("--spindle", plan.spindle, "S", "Revolutions a minute [none: no M3]")
      .add("--laser", raw.values.laser, "S",
           "A laser of this power (the word S) in place of a mill")
      .add("--plasma", raw.values.plasma, "SECONDS",
           "A torch that waits so long before it moves, in place of a mill");
}

void add_depth(CLI::App& app, RawCut& raw) {
  CutOptions& plan = raw.command.job.plan;
  Numbers(app, "Depth")
      .add("--depth", plan.depth, "Z", "How deep a mill cuts below Z0, units")
      .add("--pass-depth", plan.pass_depth, "Z", "Most a pass goes down, units [the whole depth]")
      .add("--passes", raw.values.passes, "N", "Of a laser or torch, one over the other [1]")
      .add("--ramp", plan.ramp_deg, "DEG",
           "Go down along the outline at this angle [straight down]")
      .add("--safe-z", plan.safe_z, "Z", "Height of rapid moves, units [5 mm; inches: 0.2]")
      .add("--tabs", raw.values.tabs, "N", "Bridges that hold the part, on each closed outline [0]")
      .add("--tab-width", plan.tabs.width, "W", "Width of a bridge, units")
      .add("--tab-height", plan.tabs.height, "H", "Its height above the bottom, units");
}

void add_ways(CLI::App& app, RawCut& raw) {
  CutOptions& plan = raw.command.job.plan;
  Numbers(app, "Ways")
      .add("--lead-in", plan.lead_in, "R",
           "Radius of the quarter circles that lead to an outline and away, units [none]")
      .add(
          "--start", raw.values.start, "X,Y",
          "Closed outlines begin at their place nearest to this one [to where the tool comes from]")
      .add("--tolerance", raw.command.job.tolerance, "T",
           "Farthest that the printed program may be from the outlines, units [0.01 mm]");
}

void add_cut_program(CLI::App& app, RawCut& raw) {
  CutOptions& plan = raw.command.job.plan;
  Numbers(app, "Program")
      .add("--feed", plan.feed, "F", "Feed along outlines [1000 mm/min; inches: 40 in/min]")
      .add("--plunge-feed", plan.plunge_feed, "F", "Feed straight down [300; inches: 12]")
      .add("--rapid-feed", plan.rapid_feed, "F",
           "Speed of rapid moves, for the estimate of time [3000; inches: 120]")
      .add("--centripetal", plan.centripetal, "A",
           "Most acceleration across the way, mm/s^2: small radii are cut more slowly [no limit]")
      .add("--acceleration", plan.acceleration, "A",
           "Along the way, mm/s^2, for the estimate of time [500]")
      .add("--controller", raw.values.controller, "NAME", "grbl, linuxcnc, fanuc or marlin [grbl]")
      .add("--motion", raw.values.motion, "NAME",
           "arcs (G2, G3), or splines where they save blocks (G5, linuxcnc) [arcs]")
      .add("--decimals", raw.values.decimals, "N",
           "Of places, 1 to 6 [the fewest, at least 3, that cost no more than a tenth of the "
           "tolerance]");
}

Result<Command> checked_cut(const CLI::App& app, RawCut& raw) {
  CutCommand& command = raw.command;
  OBVID_TRY(check_extras(app, app.remaining(), "cut"));
  if (raw.reading.curve == "all") raw.reading.curve.reset();  // which is what is done
  OBVID_TRY(set_import(raw.reading, command.import));
  OBVID_TRY(set_cut(raw.values, command.job));
  command.inputs = inputs_or_pipe(std::move(command.inputs));
  if (command.inputs.empty()) return fail(usage("cut needs a drawing", "see obvid cut --help"));
  OBVID_TRY(settle_streams(command, raw.format, raw.csv, "nc"));
  if (raw.csv) command.outputs.emplace_back("-.csv");
  if (raw.csv) command.quiet = true;
  if (!raw.units.empty()) {
    auto units = given_units(raw.units, "--units");
    OBVID_TRY(units);
    command.job.units = std::move(*units);
  }
  const std::string& first = command.inputs.front();
  command.job.plan.name =
      first == "-" ? "standard input" : std::filesystem::path(first).filename().string();
  command.progress = !raw.no_progress && !command.quiet && !command.json;
  return command_of(command);
}

}  // namespace

Result<Command> parse_cut(int argc, const char* const* argv) {
  CLI::App app("All outlines of drawings in one program for a mill, a laser or a plasma torch",
               "obvid cut");
  shape_help(app, kHelpColumn, argc, argv);
  app.allow_extras();
  RawCut raw;
  app.add_option("INPUT", raw.command.inputs,
                 "Drawings (DXF, SVG, STEP, ...) and contour files (.json): every curve is cut");
  add_output(app, raw.command.outputs, raw.format, kCutOutputHelp, "nc");
  add_tool(app, raw);
  add_depth(app, raw);
  add_ways(app, raw);
  add_cut_program(app, raw);
  Numbers(app, kReadingGroup)
      .add(
          "--curve", raw.reading.curve, "LIST|all",
          "Which curves are cut, separated by commas: numbers from 1, names, layers, or words of a "
          "name that no other has; the others still say what lies in what [all]")
      .add("--drawing", raw.reading.drawing, "NAME",
           "auto, or exact: polylines of many vertices are meant as drawn, points are joined "
           "[auto]");
  add_planes(app, raw.reading, kReadingGroup);
  add_placement(app, raw.reading);
  app.add_option("--units", raw.units, "Unit of the drawing [as the file says; else mm]")
      ->type_name("NAME");
  app.add_flag("--csv", raw.csv, "Table of outlines as CSV on standard output, as -o NAME.csv");
  app.add_flag("--json", raw.command.json, "Report as JSON on standard output");
  app.add_flag("-q,--quiet", raw.command.quiet, "No report and no progress bar");
  app.add_flag("--no-progress", raw.no_progress, "No progress bar");
  app.footer(with_exit_codes(
      "Outlines inside others are cut before them. The path of the tool is the exact parallel of "
      "the\n"
      "outlines; where the tool does not fit the program is refused. Read it before you run it: "
      "it\n"
      "knows neither clamps nor stock.\n"
      "Examples:\n"
      "  obvid cut plate.dxf --diameter 3 --depth 6 --pass-depth 2 --tabs 3 --tab-width 4\n"
      "            --tab-height 1 -o plate.nc -o plate.svg\n"
      "  obvid cut sign.svg --laser 800 --feed 2400 --diameter 0.1 -o sign.nc"));
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return command_of(ShowText{app.help()});
  } catch (const CLI::ParseError& error) {
    return fail(from_cli(error, "cut"));
  }
  raw.command.asked = asked_for(app, "obvid cut");
  return checked_cut(app, raw);
}

}  // namespace obvid
