// SPDX-License-Identifier: Apache-2.0
#include "spline_options.h"

#include "cli_app.h"
#include "commands.h"
#include "obvid/pipeline/internal/spline_values.h"
#include "options.h"

namespace obvid {
namespace {

struct RawSpline {
  SplineOptions options;
  SplineValues values;
  long samples = kRowsOfSamples;
  std::string format;  ///< of what -o sends to standard output
  bool csv = false;
  bool no_progress = false;
};

void add_options(CLI::App& app, RawSpline& raw) {
  SplineOptions& options = raw.options;
  app.add_option("TABLE", options.input,
                 "File with columns x and f (and integral over the cell that a row begins, slope, "
                 "second: the second derivative); x, y and f are a function of two variables "
                 "(integral over the cell, integral_x and integral_y along the lines that a place "
                 "begins); with --curve points x, y (and z); - is standard input");
  add_output(app, options.outputs, raw.format,
             "File to write: .csv values, derivatives and integrals; .json everything; .svg and "
             ".dxf the drawing; of two variables .csv, .json and the graph as .step, .stl, ...");
  app.add_flag("--curve", options.job.curve,
               "The table holds points of a curve in the plane or in space: one spline per "
               "coordinate over the summed chords");
  app.add_option("--degree", raw.values.degree, "2, 4 or 6 [2; 4 with --curve]")->type_name("N");
  app.add_option("--smooth", raw.values.smooth,
                 "none (all data kept, C0, C1, C2), values-kept (inner derivatives give way, C2, "
                 "C4; from degree 4 on) or values-free (inner values too, C1, C3, C5) [none; "
                 "values-kept with --curve]")
      ->type_name("NAME");
  app.add_option("--against", options.finer,
                 "File with more of the same function, or of the same curve: errors are measured "
                 "against it")
      ->type_name("FILE");
  app.add_flag("--compare", options.job.compare,
               "Beside it the other degrees, the local and both global cubic splines");
  app.add_option("--tolerance", raw.values.tolerance,
                 "Of straight moves along the spline on a machine, units [1e-4 of the size]")
      ->type_name("T");
  app.add_option("--samples", raw.samples, "Rows of the .csv, equal steps [200]")->type_name("N");
  app.add_flag("--csv", raw.csv, "CSV on standard output instead of the table, as -o NAME.csv");
  app.add_flag("--json", options.json, "JSON on standard output instead of the table");
  app.add_flag("-q,--quiet", options.quiet, "No table and no progress bar");
  app.add_flag("--no-progress", raw.no_progress, "No progress bar");
  app.footer(with_exit_codes(
      "Examples:\n"
      "  obvid spline profile.csv -o profile.svg\n"
      "  obvid spline means.csv --degree 4 --smooth values-free --against fine.csv --compare\n"
      "  obvid spline rail.csv --curve --degree 6 -o rail.json"));
}

Result<void> check(RawSpline& raw) {
  SplineOptions& options = raw.options;
  OBVID_TRY(settle_streams(options, raw.format, raw.csv));
  if (raw.csv) options.outputs.emplace_back("-.csv");
  if (raw.csv) options.quiet = true;
  options.progress = !raw.no_progress && !options.quiet && !options.json;
  options.input = input_or_pipe(options.input);
  if (options.input.empty()) {
    return fail(usage("spline needs a table", "see obvid spline --help"));
  }
  OBVID_TRY(set_spline(raw.values, options.job));
  const auto samples = rows_of_samples(raw.samples);
  OBVID_TRY(samples);
  options.samples = *samples;
  return {};
}

}  // namespace

Result<Command> parse_spline(int argc, const char* const* argv) {
  CLI::App app(
      "Splines of even degree that keep values, derivatives and the integral over every cell",
      "obvid spline");
  shape_help(app, kHelpColumn, argc, argv);
  app.allow_extras();
  RawSpline raw;
  add_options(app, raw);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return command_of(ShowText{app.help()});
  } catch (const CLI::ParseError& error) {
    return fail(from_cli(error, "spline"));
  }
  OBVID_TRY(check_extras(app, app.remaining(), "spline"));
  OBVID_TRY(check(raw));
  return command_of(raw.options);
}

}  // namespace obvid
