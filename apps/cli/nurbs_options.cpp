// SPDX-License-Identifier: Apache-2.0
#include "nurbs_options.h"

#include "cli_app.h"
#include "commands.h"
#include "obvid/pipeline/internal/spline_values.h"
#include "options.h"

namespace obvid {
namespace {

struct RawNurbs {
  NurbsOptions options;
  NurbsValues values;
  long samples = kRowsOfSamples;
  std::optional<std::string> units;
  std::string format;  ///< of what -o sends to standard output
  bool csv = false;
  bool no_progress = false;
};

void add_nurbs_options(CLI::App& app, RawNurbs& raw) {
  NurbsOptions& options = raw.options;
  app.add_option("TABLE", options.input,
                 "File with columns x and y (z, w: weights [1]), one control point a row; with "
                 "columns row and col the net of a surface; - is standard input");
  add_output(app, options.outputs, raw.format,
             "File to write. Curve: .json, .csv (samples), .step, .iges, .brep, .dxf; surface: "
             "all that `obvid surface` writes");
  app.add_option("--degree", raw.values.degree, "Degree along the points, 1 to 9 [3]")
      ->type_name("N");
  app.add_option("--degree-v", raw.values.degree_v, "Of a surface, from row to row, 1 to 9 [3]")
      ->type_name("N");
  app.add_option("--knots", raw.values.knots,
                 "Knots, ascending, with commas: points + degree + 1 of them, the first and the "
                 "last degree + 1 times [uniform]")
      ->type_name("LIST");
  app.add_option("--knots-v", raw.values.knots_v, "Of a surface, from row to row [uniform]")
      ->type_name("LIST");
  app.add_option("--weight-at", raw.values.weights, "Weight W > 0 of point I; may be repeated")
      ->type_name("I=W")
      ->allow_extra_args(false);
  app.add_option("--move", raw.values.moves,
                 "Weight of inner point I such that the curve goes part B of the way (between 0 "
                 "and 1) from where it runs without the point to the point; may be repeated")
      ->type_name("I=B")
      ->allow_extra_args(false);
  app.add_option("--samples", raw.samples, "Rows of the .csv, equal steps of u [200]")
      ->type_name("N");
  app.add_option("--units", raw.units, "Unit of the lengths: mm, m, in, ft, ... [mm is assumed]")
      ->type_name("NAME");
  app.add_flag("--csv", raw.csv, "Samples of a curve as CSV on standard output, as -o NAME.csv");
  app.add_flag("--json", options.json, "JSON on standard output instead of the table");
  app.add_flag("-q,--quiet", options.quiet, "No table and no progress bar");
  app.add_flag("--no-progress", raw.no_progress, "No progress bar");
  app.footer(
      with_exit_codes("Examples:\n"
                      "  obvid nurbs points.csv --weight-at 4=3 -o curve.step\n"
                      "  obvid nurbs points.csv --move 4=0.8\n"
                      "  obvid nurbs net.csv --degree 3 --degree-v 2 -o surface.step"));
}

Result<void> check_nurbs(RawNurbs& raw) {
  OBVID_TRY(settle_streams(raw.options, raw.format, raw.csv));
  if (raw.csv) raw.options.outputs.emplace_back("-.csv");
  if (raw.csv) raw.options.quiet = true;
  raw.options.progress = !raw.no_progress && !raw.options.quiet && !raw.options.json;
  raw.options.input = input_or_pipe(raw.options.input);
  if (raw.options.input.empty()) {
    return fail(usage("nurbs needs a table of control points", "see obvid nurbs --help"));
  }
  OBVID_TRY(set_nurbs(raw.values, raw.options.job));
  const auto samples = rows_of_samples(raw.samples);
  OBVID_TRY(samples);
  raw.options.samples = *samples;
  if (raw.units) {
    auto given = given_units(*raw.units, "--units");
    OBVID_TRY(given);
    raw.options.units = std::move(*given);
  }
  return {};
}

}  // namespace

Result<Command> parse_nurbs(int argc, const char* const* argv) {
  CLI::App app("NURBS curves and surfaces of control points, weights and knots", "obvid nurbs");
  shape_help(app, kHelpColumn, argc, argv);
  app.allow_extras();
  RawNurbs raw;
  add_nurbs_options(app, raw);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return command_of(ShowText{app.help()});
  } catch (const CLI::ParseError& error) {
    return fail(from_cli(error, "nurbs"));
  }
  OBVID_TRY(check_extras(app, app.remaining(), "nurbs"));
  OBVID_TRY(check_nurbs(raw));
  return command_of(raw.options);
}

}  // namespace obvid
