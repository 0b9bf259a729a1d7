// SPDX-License-Identifier: Apache-2.0
#include "alignment_options.h"

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include "cli_app.h"
#include "obvid/pipeline/internal/format_values.h"
#include "options.h"

namespace obvid {
namespace {

struct RawAlignment {
  AlignmentCommand command;
  std::optional<std::string> noise, units;
  std::optional<std::string> least_length, least_radius, first_station, acceleration;
  std::string format;  ///< of what -o sends to standard output
  bool csv = false;
  FormatValues reading;
};

void add_alignment_options(CLI::App& app, RawAlignment& raw) {
  AlignmentCommand& command = raw.command;
  app.add_option("POINTS", command.input,
                 "File with x and y per line, or a drawing or map with a list of points; a column "
                 "tol gives tolerances of single points; - is standard input");
  add_output(app, command.outputs, raw.format,
             "File to write: .xml LandXML, .xodr OpenDRIVE, .dxf, .json contour, .step, .svg "
             "and every other ending of obvid convert; .csv is the table of elements");
  app.add_option("--noise", raw.noise,
                 "How far the alignment may pass the points, input units, or rounding: half a unit "
                 "of the last printed digit [rounding]")
      ->type_name("EPS");
  app.add_option("--min-length", raw.least_length,
                 "Least length of an element, input units [a quarter of the mean distance of points]")
      ->type_name("L");
  app.add_option("--min-radius", raw.least_radius, "Least radius anywhere, input units [any]")
      ->type_name("R");
  app.add_option("--station", raw.first_station,
                 "Station of the first point, input units: where stations are counted from [0]")
      ->type_name("S");
  app.add_option("--lateral-acceleration", raw.acceleration,
                 "Acceleration to the side, m/s^2: the table tells the speed at which the sharpest end "
                 "of each element has it [none]")
      ->type_name("A");
  app.add_option("--deviations", command.deviations,
                 "File to write: .csv of station, offset (left positive) and coordinates of each point")
      ->type_name("OUT");
  app.add_option("--units", raw.units, "Unit of the input: m, ft, usft, km, ... [as the file says]")
      ->type_name("NAME");
  add_import(app, raw.reading);
  app.add_flag("--csv", raw.csv, "Table of elements as CSV on standard output, as -o NAME.csv");
  app.add_flag("--json", command.json, "JSON on standard output instead of the table");
  app.add_flag("-q,--quiet", command.quiet, "Print nothing but errors and warnings");
  app.footer(
      "Elements join with common tangents; curvature steps only where the points ask for it.\n"
      "Examples:\n"
      "  obvid alignment survey.csv --noise 0.02 --units m -o road.xml\n"
      "  obvid alignment track.geojson --noise 0.5 -o road.xodr -o elements.csv");
}

enum class Least { kAny, kMoreThanNothing };

/// The number of an option that was given, which otherwise stays as it is.
Result<void> take_number(const std::optional<std::string>& text, const char* option, Least least,
                         double& out) {
  if (!text) return {};
  char* end = nullptr;
  const double number = std::strtod(text->c_str(), &end);
  const bool whole = !text->empty() && end == text->c_str() + text->size();
  if (!whole || !std::isfinite(number) || (least == Least::kMoreThanNothing && !(number > 0.0))) {
    return fail(bad_option(least == Least::kAny ? "a station is a number" : "it must be a positive number",
                           option, "a length in the units of the points, an acceleration in m/s^2; without the unit"));
  }
  out = number;
  return {};
}

Result<void> check_alignment(RawAlignment& raw) {
  AlignmentCommand& command = raw.command;
  OBVID_TRY(set_import(raw.reading, command.import));
  OBVID_TRY(settle_streams(command, raw.format, raw.csv));
  if (raw.csv) command.outputs.emplace_back("-.csv");
  if (raw.csv) command.quiet = true;
  command.input = input_or_pipe(command.input);
  if (command.input.empty()) {
    return fail(usage("alignment needs a file of points", "see obvid alignment --help"));
  }
  if (raw.units) {
    auto units = given_units(*raw.units, "--units");
    if (!units) return fail(units.error());
    command.units = std::move(*units);
  }
  OBVID_TRY(take_number(raw.least_length, "--min-length", Least::kMoreThanNothing,
                        command.job.least_length));
  OBVID_TRY(take_number(raw.least_radius, "--min-radius", Least::kMoreThanNothing,
                        command.job.least_radius));
  OBVID_TRY(take_number(raw.first_station, "--station", Least::kAny, command.job.first_station));
  if (raw.acceleration) {
    command.job.acceleration = 0.0;
    OBVID_TRY(take_number(raw.acceleration, "--lateral-acceleration", Least::kMoreThanNothing,
                          *command.job.acceleration));
  }
  if (!command.deviations.empty() && !command.deviations.ends_with(".csv")) {
    return fail(bad_option("deviations are a table", "--deviations", "name a .csv"));
  }
  if (!raw.noise || *raw.noise == "rounding") return {};
  double noise = 0.0;
  OBVID_TRY(take_number(raw.noise, "--noise", Least::kMoreThanNothing, noise));
  command.job.noise = noise;
  return {};
}

}  // namespace

Result<Command> parse_alignment(int argc, const char* const* argv) {
  CLI::App app("The fewest lines, arcs and clothoids that pass within a tolerance of the points",
               "obvid alignment");
  shape_help(app, kHelpColumn, argc, argv);
  app.allow_extras();
  RawAlignment raw;
  add_alignment_options(app, raw);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return Command{ShowText{app.help()}};
  } catch (const CLI::ParseError& error) {
    return fail(from_cli(error, "alignment"));
  }
  if (auto done = check_extras(app, app.remaining(), "alignment"); !done) return fail(done.error());
  if (auto done = check_alignment(raw); !done) return fail(done.error());
  return Command{raw.command};
}

}  // namespace obvid
