// SPDX-License-Identifier: Apache-2.0
#include "alignment_options.h"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "cli_app.h"
#include "commands.h"
#include "obvid/core/internal/file_ending.h"
#include "obvid/pipeline/internal/alignment_values.h"
#include "obvid/pipeline/internal/format_values.h"
#include "obvid/pipeline/internal/job_values.h"
#include "options.h"
#include "several.h"

namespace obvid {
namespace {

struct RawAlignment {
  AlignmentCommand command;
  std::optional<std::string> units;
  std::optional<std::string> least_length, least_radius, first_station, acceleration,
      least_vertical;
  AlignmentValues typed;
  std::string format;  ///< of what -o sends to standard output
  bool no_progress = false;
  FormatValues reading;
};

struct NumberOption {
  const char* name;
  const char* value;  ///< in the help
  std::optional<std::string> RawAlignment::*text;
  bool positive;
  const char* what;  ///< is wrong with others
  const char* hint;
  const char* help;
};

constexpr const char* kPositive = "it must be a positive number";
constexpr const char* kInUnits = "in the units of the points, without their name";
constexpr std::array kNumberOptions = {
    NumberOption{"--min-length", "L", &RawAlignment::least_length, true, kPositive, kInUnits,
                 "Least length of an element, input units [a quarter of the mean distance of "
                 "points]"},
    NumberOption{"--min-radius", "R", &RawAlignment::least_radius, true, kPositive, kInUnits,
                 "Least radius anywhere, input units [any]"},
    NumberOption{"--station", "S", &RawAlignment::first_station, false, "a station is a number",
                 kInUnits,
                 "Station of the first point, input units; around a loop the element that it lies "
                 "on is the first [that of the file, or 0]"},
    NumberOption{"--lateral-acceleration", "A", &RawAlignment::acceleration, true, kPositive,
                 "in m/s^2, without the unit",
                 "Acceleration to the side, m/s^2: the table tells the speed at which the sharpest "
                 "end of each element has it, the picture along the way [none]"},
    NumberOption{"--min-vertical-length", "L", &RawAlignment::least_vertical, true, kPositive,
                 kInUnits,
                 "Least length of a grade or vertical curve, input units [a quarter of the mean "
                 "distance of heights; shorter at sharp kinks of these]"}};

void add_alignment_options(CLI::App& app, RawAlignment& raw) {
  AlignmentCommand& command = raw.command;
  app.add_option("POINTS", command.inputs,
                 "File with x and y per line, or a drawing or map with a list of points; a column "
                 "tol gives tolerances of single points; - is standard input; of several files a "
                 "line each")
      ->type_name("");
  add_output(app, command.outputs, raw.format,
             "File to write: .xml LandXML, .xodr OpenDRIVE, .dxf, .json contour, .step, .svg "
             "and every other ending of obvid convert; .csv is the table of elements, .svg shows "
             "curvature, speed and heights over the station, .html is a page with both; of several "
             "inputs 'NAME{id}.xml', {id} being the name of each");
  app.add_option(
         "--noise", raw.typed.noise,
         "How far the alignment may pass the points, input units, or rounding: as far as half "
         "a unit of the last printed digit in x and in y together, or auto: estimated from "
         "their scatter [rounding]")
      ->type_name("EPS");
  app.add_flag("--closed", raw.typed.closed,
               "Around a loop: behind the last point comes the first one, and the alignment has no "
               "joint of its own there [where the last point is the first one, within their "
               "tolerances]");
  app.add_flag("--open", raw.typed.open, "It ends at the last point, wherever that lies");
  for (const NumberOption& option : kNumberOptions) {
    app.add_option(option.name, raw.*option.text, option.help)->type_name(option.value);
  }
  app.add_option("--joints", raw.typed.joints,
                 "G2: no steps of the curvature, with as many elements more as that takes; G1: "
                 "steps where they save elements [G1]")
      ->type_name("G1|G2");
  app.add_option("--transitions", raw.typed.transitions,
                 "Kind of the transitions between lines and arcs: clothoid, bloss, sine, cosine, "
                 "helmert or cubic (parabola); none: lines and arcs alone, as of pipes [clothoid]")
      ->type_name("KIND");
  app.add_option(
         "--deviations", command.deviations,
         "File to write: .csv of station, offset (left positive) and coordinates of each point, "
         "and of heights")
      ->type_name("OUT");
  app.add_option("--profile", command.heights,
                 "File of station and height per line, input units: heights of the profile [the "
                 "column z of the points]")
      ->type_name("FILE");
  app.add_option(
         "--profile-noise", raw.typed.profile_noise,
         "How far the profile may pass the heights, input units, or rounding or auto (their "
         "own scatter) [--noise of heights in a column z, else auto where it can be told]")
      ->type_name("EPS");
  app.add_option("--profile-curves", raw.typed.profile_curves,
                 "Vertical curves: parabolas or arcs [parabolas]")
      ->type_name("KIND");
  app.add_option("--profile-table", command.profile_table,
                 "File to write: .csv of grades and vertical curves")
      ->type_name("OUT");
  app.add_option("--units", raw.units, "Unit of the input: m, ft, usft, km, ... [as the file says]")
      ->type_name("NAME");
  add_import(app, raw.reading);
  app.add_flag("--csv", command.csv, "Table of elements as CSV on standard output, as -o NAME.csv");
  app.add_flag("--json", command.json, "JSON on standard output instead of the table");
  app.add_flag("-q,--quiet", command.quiet, "Print nothing but errors and warnings");
  app.add_flag("--no-progress", raw.no_progress, "No progress bar");
  app.footer(with_exit_codes(
      "Elements join with common tangents; curvature steps only where the points ask for it.\n"
      "Examples:\n"
      "  obvid alignment survey.csv --noise 0.02 --units m -o road.xml\n"
      "  obvid alignment roads/*.csv --noise 0.05 -o 'out/{id}.xml'\n"
      "  obvid alignment track.geojson --closed --noise 0.5 -o road.xodr -o elements.csv\n"
      "  obvid alignment survey.csv --noise 0.02 --profile levels.csv --profile-noise 0.01 -o "
      "road.xml"));
}

/// The number that was typed; nothing was: nothing.
Result<std::optional<double>> given_number(const std::optional<std::string>& text,
                                           const char* option, bool positive, const char* what,
                                           const char* hint) {
  if (!text) return std::optional<double>();
  const auto number = typed_number(*text);
  if (!number || !std::isfinite(*number) || (positive && !(*number > 0.0))) {
    return fail(bad_option(what, option, with_point(*text) + hint));
  }
  return number;
}

Result<void> check_alignment(RawAlignment& raw) {
  AlignmentCommand& command = raw.command;
  OBVID_TRY(set_import(raw.reading, command.import));
  OBVID_TRY(settle_streams(command, raw.format, command.csv));
  command.progress = !raw.no_progress && !command.quiet && !command.json && !command.csv;
  command.inputs = inputs_or_pipe(std::move(command.inputs));
  if (command.inputs.empty()) {
    return fail(usage("alignment needs a file of points", "see obvid alignment --help"));
  }
  if (command.inputs.size() == 1) {
    command.input = command.inputs.front();
    command.inputs.clear();
  }
  if (!command.heights.empty() && are_several(command.inputs, command.import.curve)) {
    return fail(bad_option("a file of heights is of one alignment", "--profile",
                           "give one input, or heights in a column z"));
  }
  if (raw.units) {
    auto units = given_units(*raw.units, "--units");
    OBVID_TRY(units);
    command.units = std::move(*units);
  }
  std::array<std::optional<double>, kNumberOptions.size()> numbers;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const NumberOption& option = kNumberOptions[k];
    const auto number =
        given_number(raw.*option.text, option.name, option.positive, option.what, option.hint);
    OBVID_TRY(number);
    numbers[k] = *number;
  }
  command.job.least_length = numbers[0].value_or(0.0);
  command.job.least_radius = numbers[1].value_or(0.0);
  command.job.first_station = numbers[2];
  command.job.acceleration = numbers[3];
  command.job.profile.least_length = numbers[4].value_or(0.0);
  if (!command.deviations.empty() && !has_ending(command.deviations, ".csv")) {
    return fail(bad_option("deviations are a table", "--deviations", "name a .csv"));
  }
  if (!command.profile_table.empty() && !has_ending(command.profile_table, ".csv")) {
    return fail(bad_option("a profile is written as a table", "--profile-table", "name a .csv"));
  }
  return set_alignment(raw.typed, command.job);
}

}  // namespace

Result<Command> parse_alignment(int argc, const char* const* argv) {
  CLI::App app("Few lines, arcs and clothoids that pass within a tolerance of the points",
               "obvid alignment");
  shape_help(app, kHelpColumn, argc, argv);
  app.allow_extras();
  RawAlignment raw;
  add_alignment_options(app, raw);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return command_of(ShowText{app.help()});
  } catch (const CLI::ParseError& error) {
    return fail(from_cli(error, "alignment"));
  }
  OBVID_TRY(check_extras(app, app.remaining(), "alignment"));
  OBVID_TRY(check_alignment(raw));
  raw.command.asked = asked_for(app, "obvid alignment");
  return command_of(raw.command);
}

}  // namespace obvid
