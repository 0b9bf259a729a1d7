// SPDX-License-Identifier: Apache-2.0
#include "nurbs_options.h"

#include <charconv>
#include <cmath>

#include "cli_app.h"
#include "obvid/pipeline/internal/job_values.h"
#include "options.h"

namespace obvid {
namespace {

struct RawNurbs {
  NurbsOptions options;
  std::string knots, knots_v;
  std::vector<std::string> weights, moves;
  std::optional<std::string> units;
  std::string format;  ///< of what -o sends to standard output
  bool csv = false;
};

void add_nurbs_options(CLI::App& app, RawNurbs& raw) {
  NurbsOptions& options = raw.options;
  app.add_option("TABLE", options.input,
                 "File with columns x and y (z, w: weights [1]), one control point a row; with "
                 "columns row and col the net of a surface; - is standard input");
  add_output(app, options.outputs, raw.format,
             "File to write. Curve: .json, .csv (samples), .step, .iges, .brep, .dxf; surface: "
             "all that `obvid surface` writes");
  app.add_option("--degree", options.job.degree, "Degree along the points, 1 to 9 [3]")
      ->type_name("N");
  app.add_option("--degree-v", options.job.degree_v, "Of a surface, from row to row, 1 to 9 [3]")
      ->type_name("N");
  app.add_option("--knots", raw.knots,
                 "Knots, ascending, with commas: points + degree + 1 of them, the first and the "
                 "last degree + 1 times [uniform]")
      ->type_name("LIST");
  app.add_option("--knots-v", raw.knots_v, "Of a surface, from row to row [uniform]")
      ->type_name("LIST");
  app.add_option("--weight-at", raw.weights, "Weight W > 0 of point I; may be repeated")
      ->type_name("I=W")
      ->allow_extra_args(false);
  app.add_option("--move", raw.moves,
                 "Weight of inner point I such that the curve goes part B of the way (between 0 "
                 "and 1) from where it runs without the point to the point; may be repeated")
      ->type_name("I=B")
      ->allow_extra_args(false);
  app.add_option("--samples", options.samples, "Rows of the .csv, equal steps of u [200]")
      ->type_name("N");
  app.add_option("--units", raw.units, "Unit of the lengths: mm, m, in, ft, ... [mm is assumed]")
      ->type_name("NAME");
  app.add_flag("--csv", raw.csv, "Samples of a curve as CSV on standard output, as -o NAME.csv");
  app.add_flag("--json", options.json, "JSON on standard output instead of the table");
  app.add_flag("-q,--quiet", options.quiet, "No table");
  app.footer(
      with_exit_codes("Examples:\n"
                      "  obvid nurbs points.csv --weight-at 4=3 -o curve.step\n"
                      "  obvid nurbs points.csv --move 4=0.8\n"
                      "  obvid nurbs net.csv --degree 3 --degree-v 2 -o surface.step"));
}

std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

Result<std::vector<double>> knot_list(const std::string& typed, const char* option) {
  std::vector<double> out;
  if (typed.empty()) return out;
  for (std::size_t from = 0; from <= typed.size();) {
    const std::size_t to = std::min(typed.find(',', from), typed.size());
    const auto value = number_of(std::string_view(typed).substr(from, to - from));
    if (!value) return fail(bad_option("the list holds what is no number", option, "0,0,1,2,2"));
    out.push_back(*value);
    from = to + 1;
  }
  return out;
}

Result<std::vector<std::pair<std::size_t, double>>> at_points(const std::vector<std::string>& typed,
                                                              const char* option) {
  std::vector<std::pair<std::size_t, double>> out;
  for (const std::string& one : typed) {
    const std::size_t sign = one.find('=');
    const auto point = number_of(std::string_view(one).substr(0, sign));
    const auto value = sign == std::string::npos
                           ? std::nullopt
                           : number_of(std::string_view(one).substr(sign + 1));
    constexpr double kMostPoints = 1e9;
    if (!point || !value || *point < 1.0 || *point > kMostPoints || *point != std::floor(*point)) {
      return fail(bad_option("'" + one + "' is no point and value", option, "as in 3=0.7"));
    }
    out.emplace_back(static_cast<std::size_t>(*point) - 1, *value);
  }
  return out;
}

Result<void> check_nurbs(RawNurbs& raw) {
  NurbsJob& job = raw.options.job;
  OBVID_TRY(settle_streams(raw.options, raw.format, raw.csv));
  if (raw.csv) raw.options.outputs.emplace_back("-.csv");
  if (raw.csv) raw.options.quiet = true;
  raw.options.input = input_or_pipe(raw.options.input);
  if (raw.options.input.empty()) {
    return fail(usage("nurbs needs a table of control points", "see obvid nurbs --help"));
  }
  for (const int degree : {job.degree, job.degree_v}) {
    if (degree < 1 || degree > kMaxNurbsDegree) {
      return fail(bad_option("degrees run from 1 to 9", "--degree", ""));
    }
  }
  constexpr std::size_t kMostNurbsRows = 10'000'000;
  if (raw.options.samples < 2 || raw.options.samples > kMostNurbsRows) {
    return fail(bad_option("between 2 and 10,000,000 rows are possible", "--samples", ""));
  }
  auto knots = knot_list(raw.knots, "--knots");
  OBVID_TRY(knots);
  auto knots_v = knot_list(raw.knots_v, "--knots-v");
  OBVID_TRY(knots_v);
  auto weights = at_points(raw.weights, "--weight-at");
  OBVID_TRY(weights);
  auto moves = at_points(raw.moves, "--move");
  OBVID_TRY(moves);
  job.knots = std::move(*knots);
  job.knots_v = std::move(*knots_v);
  job.weights = std::move(*weights);
  job.moves = std::move(*moves);
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
    return Command{ShowText{app.help()}};
  } catch (const CLI::ParseError& error) {
    return fail(from_cli(error, "nurbs"));
  }
  OBVID_TRY(check_extras(app, app.remaining(), "nurbs"));
  OBVID_TRY(check_nurbs(raw));
  return Command{raw.options};
}

}  // namespace obvid
