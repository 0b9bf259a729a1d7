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
  if (!raw.noise || *raw.noise == "rounding") return {};
  char* end = nullptr;
  const double noise = std::strtod(raw.noise->c_str(), &end);
  if (raw.noise->empty() || end != raw.noise->c_str() + raw.noise->size() || !(noise > 0.0) ||
      !std::isfinite(noise)) {
    return fail(bad_option("the tolerance must be a positive length or rounding", "--noise",
                           "give it in the units of the points"));
  }
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
