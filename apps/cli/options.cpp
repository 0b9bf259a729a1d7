// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "cli_app.h"
#include "commands.h"
#include "obvid/core/version.h"
#include "obvid/pipeline/internal/construction_values.h"
#include "obvid/pipeline/internal/format_values.h"
#include "obvid/pipeline/internal/job_values.h"
#include "obvid/pipeline/internal/space_values.h"

namespace obvid {
namespace {

constexpr const char* kShortHelp =
    R"(obvid: points in, a curvature-continuous, monotone and proved contour out

  obvid studio POINTS                                drag points in the browser, see, prove
  obvid fit POINTS -o contour.svg -o contour.json    form and prove a contour
  obvid analyse POINTS                               what the points alone say
  obvid region POINTS                                where every such contour must lie
  obvid compare POINTS                               all curve families side by side
  obvid batch FOLDER -o out.h5                       one job for a million inputs
  obvid surface skin SECTIONS... -o hull.step        surfaces: skin, revolve, ruled, grid, ...
  obvid alignment POINTS --noise 0.05 -o road.xml    few lines, arcs and clothoids
  obvid spline TABLE -o spline.csv                   splines that keep given integrals
  obvid nurbs TABLE --weight-at 4=3 -o curve.step    control points, weights and knots
  obvid toolpath hull.json -o hull.nc                milling with three axes, without gouges
  obvid cut plate.dxf --depth 5 -o plate.nc          every outline of a drawing in one program
  obvid convert contour.json -o OUT                  another format: STEP, IGES, DXF, G-code, ...
  obvid verify contour.json                          prove a stored contour again
  obvid explain E401                                 what an error means, what to do

`obvid COMMAND -h` is a page of help, `obvid help COMMAND` all of it with units and defaults. POINTS
is a text file with x and y per line, an airfoil file, a drawing, ... or comes through a pipe.
)";

constexpr std::size_t kShortHelpColumn = 53;  // where it says what commands do

/// What the command line said, before it is checked.
struct Raw {
  FitOptions fit;
  AnalyseOptions analyse;
  RegionOptions region;
  CompareOptions compare;
  ConvertOptions convert;
  FormatValues formats;
  VerifyOptions verify;
  ExplainOptions explain;
  std::string carrier = "spiral";
  std::string align;
  TypedValues typed;
  bool no_progress = false;
  TypedConstruction construction;  ///< its `prefer` is that of region
  std::string along;
  std::optional<double> tolerance;
  std::optional<std::string> units;
  std::string format;  ///< of what -o sends to standard output
  std::vector<std::string> inputs;
  std::string asked;  ///< the command with its options, as far as they shape the result
};

/// "arcs (G1), conics, ...": those that promise monotone curvature, or those that do not.
std::string carriers_listed(bool monotone, const char* between) {
  std::string out;
  for (const Carrier carrier : kAllCarriers) {
    const CarrierInfo& info = info_of(carrier);
    if (info.monotone != monotone) continue;
    out += (out.empty() ? "" : between) + std::string(info.name);
    if (*info.about != '\0') out += " (" + std::string(info.about) + ")";
  }
  return out;
}

constexpr const char* kInputHelp =
    "File with the points, or - for standard input, which is read also where there is no name";
constexpr const char* kInputsHelp =
    "File with the points, or - for standard input, which is read also where there is no name; of "
    "several files a line each";
constexpr const char* kNoBarHelp = "Taken as everywhere: this command has no progress bar";
constexpr const char* kUnitsHelp =
    "Unit of the lengths: mm, m, in, ft, ...; what files are written in, nothing is converted "
    "[as the file says; else mm is assumed, with a warning where it matters]";

void add_fixed_data(CLI::App& fit, TypedValues& typed) {
  const char* group = "Fixed data";
  const auto add = [&](const char* name, auto& value, const char* type, const char* help) {
    return fit.add_option(name, value, help)->type_name(type)->group(group);
  };
  add("--start-heading", typed.start_heading, "DEG",
      "Heading at the first point, degrees counter-clockwise from +x, or a range 40..45, or "
      "natural "
      "[natural: free]");
  add("--end-heading", typed.end_heading, "DEG", "Heading at the last point, likewise [natural]");
  add("--start-radius", typed.start_radius, "R",
      "Radius at the first point, input units, positive turning left, inf straight, or a range "
      "20..30, 20.. or ..30 [free]");
  add("--end-radius", typed.end_radius, "R", "Radius at the last point, likewise [free]");
  const auto add_at = [&](const char* name, auto& value, const char* type, const char* help) {
    add(name, value, type, help)->allow_extra_args(false);
  };
  add_at("--heading-at", typed.heading_at, "I=DEG",
         "Heading at point I, degrees, or a range 40..45; points count from 1; may be repeated");
  add_at("--radius-at", typed.radius_at, "I=R", "Radius at point I, or a range 20..30, likewise");
  add_at("--kappa-at", typed.kappa_at, "I=K",
         "Curvature at point I, 1/input unit, positive turning left, or a range, likewise");
  add_at("--corner-at", typed.corner_at, "I", "Corner at point I; may be repeated");
}

void add_suggest(CLI::App& fit, Raw& raw) {
  fit.add_flag("--suggest", raw.fit.suggest,
               "Table of tolerances and the vertices that each of them needs")
      ->group("Measured points");
}

void add_real_points(CLI::App& fit, Raw& raw) {
  const char* group = "Measured points";
  fit.add_option("--noise", raw.typed.noise,
                 "How far each point may move, input units, or rounding: half a unit of the last "
                 "printed digit, or auto: estimated from their scatter [0: points are met]")
      ->type_name("EPS")
      ->group(group);
  fit.add_flag("--primitives", raw.fit.job.primitives,
               "Exact lines and arcs where the points allow them")
      ->group(group);
  fit.add_flag("--closed", raw.typed.closed,
               "The contour returns to its first point [when the last point is the first again]")
      ->group(group);
  fit.add_flag("--open", raw.typed.open, "It does not, even if the last point is the first again")
      ->group(group);
  fit.add_option("--corner-angle", raw.typed.corner_angle_deg, kCornerAngleHelp)
      ->type_name("DEG")
      ->group(group);
  fit.add_flag("--no-corners", raw.typed.no_corners,
               "Search no corners; marked ones stay (--corner-at, column corner)")
      ->group(group);
}

void add_space(CLI::App& fit, Raw& raw) {
  const char* group = "Points in space (x, y, z)";
  fit.add_option("--along", raw.along,
                 "Direction of the projection in which the curve is fair: X, Y, Z or three numbers "
                 "1,0,0.5 [points of a plane: that plane; else the best of its normal, Z, Y, X]")
      ->type_name("D")
      ->group(group);
  fit.add_flag("--flat", raw.fit.flat, "Heights are not used: the contour in the plane of x and y")
      ->group(group);
}

void add_fixation(CLI::App& command, Raw& raw) {
  command
      .add_option("--fixation", raw.construction.fixation,
                  "Order of --construction parabolas: 1 points and tangents are met, 2 radii too "
                  "[1 where every segment has curves with it, else 2]")
      ->type_name("N");
}

void add_tolerance(CLI::App& fit, Raw& raw) {
  fit.add_option("--tolerance", raw.tolerance,
                 "Largest width of the region, input units; carriers bspline and cubic follow the "
                 "spirals within it [3e-6 of the size]")
      ->type_name("T");
}

CLI::Option* add_shown(CLI::App& command, FormatValues& values) {
  return command
      .add_option("--curvature-range", values.curvature_range,
                  "Curvatures that pictures show, 1/unit: LOW..HIGH; all; auto: without those of a "
                  "small part of the length (a nose) that are far larger, which the picture says "
                  "[auto]")
      ->type_name("LOW..HIGH");
}

void add_plot(CLI::App& command, FormatValues& values, const std::string& group) {
  command
      .add_option(
          "--plot", values.plot,
          "What a picture shows over arc length beside the radius: curvature; slope: "
          "d kappa/ds too; deviations: how far measured points are off, in three colours, in "
          "place of the comb, with the largest and the root mean square; deviations:LENGTH: held "
          "against this length in place of their tolerances [curvature]")
      ->type_name("NAME")
      ->group(group);
  add_shown(command, values)->group(group);
}

void add_formats(CLI::App& command, FormatValues& values) {
  const char* group = "Output formats";
  command
      .add_option(
          "--output-tolerance", values.tolerance,
          "Of curves that a format cannot hold exactly, units of the contour [1e-6 of its "
          "size; arcs, G-code, SVG drawings and samples 2e-5, G-code no less than 0.002 mm]")
      ->type_name("T")
      ->group(group);
  command
      .add_option(
          "--for", values.profile,
          "Choices that are known to work in solidworks, freecad, fusion, rhino, autocad, "
          "grbl, linuxcnc, fanuc, marlin or opendrive; printed; options beside it go before")
      ->type_name("NAME")
      ->group(group);
  command
      .add_option("--controller", values.controller,
                  "G-code for grbl, linuxcnc, fanuc or marlin [grbl]")
      ->type_name("NAME")
      ->group(group);
  command
      .add_option("--motion", values.motion,
                  "G-code of arcs (G2, G3), lines (G1) or splines (G5, linuxcnc) [arcs]")
      ->type_name("NAME")
      ->group(group);
  command
      .add_option("--feed", values.feed,
                  "Feed of G-code [1000 mm/min; contours in inches: 40 in/min]")
      ->type_name("F")
      ->group(group);
  command
      .add_option("--decimals", values.decimals,
                  "Of places in G-code, 1 to 6 [the fewest, at least 3, that cost no more than a "
                  "tenth of the tolerance; inches: at least 4]")
      ->type_name("N")
      ->group(group);
  command
      .add_option(
          "--samples", values.samples,
          "Number of points in .csv, .sldcrv, .obj, .ply [by --output-tolerance], around an "
          "airfoil .dat [161]")
      ->type_name("N")
      ->group(group);
  command
      .add_option("--sample-step", values.sample_step,
                  "Arc length from one of these points to the next, units of the contour")
      ->type_name("S")
      ->group(group);
  command.add_option("--airfoil", values.airfoil, "Layout of .dat: selig or lednicer [selig]")
      ->type_name("NAME")
      ->group(group);
  command
      .add_option("--spacing", values.spacing,
                  "Points of .dat on each side: cosine (in x along the chord), curvature (half "
                  "evenly, half as its square root) or uniform (in arc length) [cosine]")
      ->type_name("NAME")
      ->group(group);
  command
      .add_option("--trailing-edge", values.trailing_edge,
                  "Its thickness in .dat, chords; 0 closes it [as the contour has it]")
      ->type_name("T")
      ->group(group);
  command
      .add_option("--trailing-edge-form", values.trailing_form,
                  "A thick trailing edge in .dat is blunt, or round: an arc of that diameter which "
                  "touches both sides [blunt]")
      ->type_name("NAME")
      ->group(group);
  command
      .add_flag("--unit-chord", values.unit_chord,
                ".dat with the leading edge at 0, 0 and the trailing edge at 1, 0; how to undo it "
                "is printed")
      ->group(group);
  command
      .add_option("--thickness", values.thickness,
                  ".dat with this thickness, 12% or 0.12 chords: the distance of both sides is "
                  "scaled [as the contour has it]")
      ->type_name("T")
      ->group(group);
  command
      .add_option(
          "--camber", values.camber,
          ".dat with this camber, 2% or 0.02 chords: the height of the middle is scaled [as "
          "the contour has it]")
      ->type_name("C")
      ->group(group);
  command
      .add_option("--svg", values.svg,
                  "What an .svg is: picture for a report, or drawing in true scale for cutters and "
                  "plotters [picture]")
      ->type_name("NAME")
      ->group(group);
  add_plot(command, values, group);
  command.add_option("--step", values.step, "Schema of STEP files: ap214 or ap242 [ap214]")
      ->type_name("NAME")
      ->group(group);
  command
      .add_option(
          "--dxf", values.dxf,
          "DXF with exact splines (exact), arcs, cubic splines (cubic), or arcs for R12 (r12) "
          "[exact]")
      ->type_name("NAME")
      ->group(group);
  command
      .add_option("--face", values.face_width,
                  "STEP, IGES, BREP: also a face of this width, units, for systems that show no "
                  "wires [none]")
      ->type_name("W")
      ->group(group);
}

void add_fit(CLI::App& app, Raw& raw) {
  CLI::App& fit = *app.add_subcommand("fit", "Form a contour through points and prove it");
  fit.add_option("INPUT", raw.inputs, kInputsHelp)->type_name("");
  add_output(fit, raw.fit.outputs, raw.format,
             "File to write, format by file extension: " + known_endings() +
                 "; of several inputs 'NAME{id}.svg', {id} being the name of each, or one file of "
                 "all: .dxf, .svg, .step, .iges, .brep");
  fit.add_option("--carrier", raw.carrier,
                 "Curve family: " + carriers_listed(true, ", ") + ", all monotone; " +
                     carriers_listed(false, " and ") + ", not promised to be monotone [spiral]")
      ->type_name("NAME");
  fit.add_option("--continuity", raw.typed.continuity,
                 "Of spirals: the curvature is continuous (G2), or its slope too: no kinks in its "
                 "plot (G3) [G3 wherever it costs no vertex; G3 given: joints where it would are "
                 "named]")
      ->type_name("NAME");
  fit.add_option("--prefer", raw.typed.prefer,
                 "What decides where the data leave a choice: fair (curvature changes as the "
                 "points show), centre (each heading and radius in the middle of what is left to "
                 "it), least-change (least integral of the squared change of curvature), "
                 "least-curvature (least largest curvature) [fair]")
      ->type_name("NAME");
  fit.add_option(
         "--construction", raw.construction.name,
         "Instead of a carrier a construction of the papers at the tangents that are given, or "
         "chosen by --prefer (which then knows neighbours too): arcs (two per segment), "
         "ellipses (the first through K, equal curvatures), clothoids (one per segment), "
         "spline (cubic, through points and tangents), parabolas (condensed triangles); its "
         "table is that of region; --tolerance inserts points [none]")
      ->type_name("NAME");
  add_fixation(fit, raw);
  add_tolerance(fit, raw);
  fit.add_flag("--convex", raw.fit.job.convex, "Refuse a contour with inflections");
  add_real_points(fit, raw);
  add_suggest(fit, raw);
  add_fixed_data(fit, raw.typed);
  add_space(fit, raw);
  add_import(fit, raw.formats);
  add_formats(fit, raw.formats);
  fit.add_option("--units", raw.units, kUnitsHelp)->type_name("NAME");
  fit.add_flag("--csv", raw.fit.csv, "Table of the segments as CSV on standard output");
  fit.add_flag("--json", raw.fit.json, "Report and certificate as JSON on standard output");
  fit.add_flag("-q,--quiet", raw.fit.quiet, "No table and no progress bar");
  fit.add_flag("--no-progress", raw.no_progress, "No progress bar");
  fit.footer(
      with_exit_codes("Examples:\n"
                      "  obvid fit points.csv -o contour.svg -o contour.json\n"
                      "  obvid fit points.csv --tolerance 0.01 --carrier arcs -o arcs.json\n"
                      "  obvid fit airfoil.dat --noise rounding -o airfoil.json\n"
                      "  obvid fit outline.csv --closed --noise 0.5 --heading-at 1=90\n"
                      "  obvid fit *.dat --noise rounding -o 'fair/{id}.step'\n"
                      "  cat points.txt | obvid fit --start-heading 90 -o - > contour.json"));
}

void add_readers(CLI::App& app, Raw& raw) {
  CLI::App& analyse = *app.add_subcommand(
      "analyse",
      "What the points force: circles, runs, vertices; or the curvature of a drawn curve");
  analyse
      .add_option("INPUT", raw.inputs,
                  "File with the points, - for standard input, or a drawing: STEP, IGES, BREP, "
                  "DXF, contour .json, ...; of several files a line each")
      ->type_name("");
  add_output(analyse, raw.analyse.outputs, raw.format,
             "File to write: .svg picture of the curvature of a drawn curve, .csv the list of "
             "curves or the table of points, .json the report, .html a page with both");
  add_import(analyse, raw.formats);
  analyse.add_option("--units", raw.units, kUnitsHelp)->type_name("NAME");
  add_plot(analyse, raw.formats, "Pictures");
  analyse.add_flag("--csv", raw.analyse.csv,
                   "CSV on standard output instead of the table: curves of a drawing, or points");
  analyse.add_flag("--json", raw.analyse.json, "JSON on standard output instead of the table");
  analyse.add_flag("-q,--quiet", raw.analyse.quiet, "No table");
  analyse.add_flag("--no-progress", raw.no_progress, kNoBarHelp);
}

void add_region(CLI::App& app, Raw& raw) {
  CLI::App& region = *app.add_subcommand(
      "region",
      "Worksheet of points and tangents: ranges of headings and radii, heights and widths");
  region.add_option("INPUT", raw.inputs, kInputsHelp)->type_name("");
  add_output(region, raw.region.outputs, raw.format,
             "File to write: .csv, .tex or .json the tables; .svg or .dxf the limiting arcs, "
             "adjacent circles, tangents and triangles; .html a page with both; of several inputs "
             "'NAME{id}.svg', {id} being the name of each");
  region
      .add_option("--prefer", raw.construction.prefer,
                  "Tangents that are not given: fair (as fit chooses them) or centre (each in the "
                  "middle of what is left to it, point after point) or neighbours (along the chord "
                  "between both neighbours) or least-change (least integral of the squared change "
                  "of curvature) or least-curvature (least largest curvature) [fair]")
      ->type_name("NAME");
  region
      .add_option(
          "--construction", raw.construction.name,
          "Also a table (and drawing) of the papers' curves at these tangents: arcs (two per "
          "segment), ellipses (the first through K, equal curvatures), clothoids (one per "
          "segment), spline (cubic, through points and tangents), parabolas (condensed triangles) "
          "[none]")
      ->type_name("NAME");
  add_fixation(region, raw);
  region
      .add_option("--tolerance", raw.tolerance,
                  "Insert points until no delta is larger, input units [none inserted]")
      ->type_name("T");
  region
      .add_option("--insert", raw.construction.insert,
                  "Insert a point in the middle of segment I, which begins at point I; may be "
                  "repeated")
      ->type_name("I")
      ->allow_extra_args(false);
  add_real_points(region, raw);
  add_fixed_data(region, raw.typed);
  add_import(region, raw.formats);
  region.add_option("--units", raw.units, kUnitsHelp)->type_name("NAME");
  region.add_flag("--csv", raw.region.csv, "CSV on standard output instead of the tables");
  region.add_flag("--json", raw.region.json, "JSON on standard output instead of the tables");
  region.add_flag("-q,--quiet", raw.region.quiet, "No tables");
  region.add_flag("--no-progress", raw.no_progress, kNoBarHelp);
  region.footer(
      with_exit_codes("Examples:\n"
                      "  obvid region points.csv -o region.svg -o region.csv\n"
                      "  obvid region points.csv --heading-at 5=80 --end-radius=-500\n"
                      "  obvid region points.csv --prefer centre --insert 9"));
}

void add_compare(CLI::App& app, Raw& raw) {
  CLI::App& compare = *app.add_subcommand(
      "compare",
      "All curve families side by side: pieces, errors, vertices, continuity, time; or several "
      "curves over each other: how far they are apart");
  compare
      .add_option("INPUT", raw.inputs,
                  "File with the points, or - for standard input, which is read also where there "
                  "is no name; several files (points, drawings, contours) are laid over each other "
                  "and measured from the first")
      ->type_name("");
  add_output(compare, raw.compare.outputs, raw.format,
             "File to write: .svg stacked curvature plots, .csv or .json the table, .html a page "
             "with both; of several files the curves with their deviations enlarged, .csv the "
             "deviation at every place");
  compare
      .add_option("--align", raw.align,
                  "Of several airfoils: chord: measure them also after each has the chord of the "
                  "first [none: as they lie]")
      ->type_name("NAME");
  compare
      .add_option("--enlarge", raw.compare.enlarge,
                  "Of several files: deviations in the picture so many times as large [a round "
                  "number that shows them]")
      ->type_name("F");
  compare
      .add_option(
          "--continuity", raw.typed.continuity,
          "Of the spirals: the curvature is continuous (G2), or its slope too (G3); the other "
          "carriers follow them where they can [G3 for the spirals wherever it costs no vertex, "
          "G2 spirals for the others to follow]")
      ->type_name("NAME");
  add_tolerance(compare, raw);
  add_real_points(compare, raw);
  add_fixed_data(compare, raw.typed);
  add_import(compare, raw.formats);
  add_shown(compare, raw.formats);
  compare.add_option("--units", raw.units, kUnitsHelp)->type_name("NAME");
  compare.add_flag("--csv", raw.compare.csv, "Table as CSV on standard output");
  compare.add_flag("--json", raw.compare.json, "Table as JSON on standard output");
  compare.add_flag("-q,--quiet", raw.compare.quiet, "No table and no progress bar");
  compare.add_flag("--no-progress", raw.no_progress, "No progress bar");
  compare.footer(with_exit_codes(
      "Examples:\n"
      "  obvid compare points.csv -o carriers.svg\n"
      "  obvid compare old.dat new.dat --noise rounding --align chord -o deviation.svg\n\n"
      "Of one file the first row, spiral, is what the others are measured against."));
}

void add_convert(CLI::App& app, Raw& raw) {
  CLI::App& convert =
      *app.add_subcommand("convert", "Write a stored contour in the format of another system");
  convert
      .add_option(
          "CONTOUR", raw.inputs,
          "Contour file (.json), - for standard input, or a drawing (STEP, DXF, SVG, ...); several "
          "with -o 'NAME{id}.dxf', or -o NAME.dxf for one file of all")
      ->type_name("");
  add_output(convert, raw.convert.outputs, raw.format,
             "File to write, format by file extension: " + known_endings());
  convert
      .add_option("--curve", raw.formats.curve,
                  "Which curve of a drawing: its number from 1, its name, or a word of it; all: "
                  "each in a file of its own, -o 'NAME{id}.json', or in one, -o NAME.dxf [the "
                  "longest]")
      ->type_name("N|NAME|all");
  convert
      .add_option("--drawing", raw.formats.drawing,
                  "exact: polylines whose vertices look like points of a curve, too [auto]")
      ->type_name("NAME");
  add_planes(convert, raw.formats, kReadingGroup);
  add_reading(convert, raw.formats);
  add_formats(convert, raw.formats);
  convert.add_option("--units", raw.units, kUnitsHelp)->type_name("NAME");
  convert.add_flag("--csv", raw.convert.csv, "Samples as CSV on standard output, as -o NAME.csv");
  convert.add_flag("--json", raw.convert.json,
                   "Contour as JSON on standard output, as -o NAME.json");
  convert.add_flag("-q,--quiet", raw.convert.quiet, "Print nothing");
  convert.add_flag("--no-progress", raw.no_progress, kNoBarHelp);
  convert.footer(with_exit_codes("Example: obvid convert contour.json -o contour.step"));
}

void add_checkers(CLI::App& app, Raw& raw) {
  CLI::App& verify =
      *app.add_subcommand("verify", "Prove a stored contour again, from its file alone");
  verify
      .add_option("CONTOUR", raw.inputs,
                  "Contour file (.json), or - for standard input; of several files a line each")
      ->type_name("");
  add_output(verify, raw.verify.outputs, raw.format,
             "File to write: .json the answer, .html a page with it, .csv the pieces");
  verify.add_flag("--csv", raw.verify.csv,
                  "Table of the pieces as CSV on standard output; of several files a line each");
  verify.add_flag("--json", raw.verify.json, "JSON on standard output instead of the table");
  verify.add_flag("-q,--quiet", raw.verify.quiet, "Exit code only");
  verify.add_flag("--no-progress", raw.no_progress, kNoBarHelp);
  verify.footer(with_exit_codes(""));
  CLI::App& explain =
      *app.add_subcommand("explain", "What an error code means and what to do; all without a code");
  explain.add_option("CODE", raw.explain.code, "For example E401 or 401");
  explain.add_flag("--csv", raw.explain.csv, "CSV on standard output");
  explain.add_flag("--json", raw.explain.json, "JSON on standard output");
  explain.add_flag("-q,--quiet", raw.explain.quiet,
                   "Exit code only: whether there is such an error");
}

Result<void> check_command(const CLI::App& app) {
  if (!app.get_subcommands().empty()) return {};
  const std::vector<std::string> extras = app.remaining();
  const std::string typed = extras.empty() ? "" : extras.front();
  std::vector<std::string> names = option_names(app);
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  const std::string kind = typed.starts_with("-") ? "option" : "command";
  return fail(usage("unknown " + kind + " '" + typed + "'",
                    did_you_mean(typed, names, "see obvid --help")));
}

Result<void> check_all_extras(const CLI::App& app) {
  const CLI::App& command = *app.get_subcommands().front();
  std::vector<std::string> extras = command.remaining();
  for (const std::string& extra : app.remaining()) extras.push_back(extra);
  return check_extras(command, extras, command.get_name());
}

Result<void> need(std::string& input, const char* command, const char* what) {
  input = input_or_pipe(input);
  if (!input.empty()) return {};
  return fail(usage(std::string(command) + " needs " + what + ", or - for standard input",
                    std::string("see obvid ") + command + " --help"));
}

/// One input, or several.
template <class Options>
Result<void> set_inputs(const Raw& raw, Options& options, const char* command, const char* what) {
  if (raw.inputs.size() > 1) {
    options.inputs = raw.inputs;
    return {};
  }
  if (!raw.inputs.empty()) options.input = raw.inputs.front();
  return need(options.input, command, what);
}

Result<void> set_units(const std::optional<std::string>& typed, std::optional<Units>& units) {
  if (!typed) return {};
  auto given = given_units(*typed, "--units");
  OBVID_TRY(given);
  units = std::move(*given);
  return {};
}

Result<void> set_carrier(Raw& raw) {
  return carrier_named(raw.carrier).map([&](Carrier carrier) { raw.fit.job.carrier = carrier; });
}

Result<void> set_job(Raw& raw) {
  return set_tolerance(raw.tolerance, raw.fit.job).and_then([&] {
    return set_values(raw.typed, raw.fit.job);
  });
}

/// Two points are a curve when the options give headings at both.
void allow_two_points(const FitJob& job, ImportOptions& import) {
  if (has_both_headings(job)) import.list.two = TwoPoints::kDo;
}

/// The job of a construction; nothing without one. `--prefer` then knows the worksheet's names.
Result<void> set_construction(Raw& raw) {
  TypedConstruction typed = raw.construction;
  if (typed.name.empty() && !typed.fixation) return {};
  typed.prefer = raw.typed.prefer;
  const auto made = construction_values(typed);
  OBVID_TRY(made);
  if (raw.carrier != "spiral") {
    return fail(bad_option("a construction is its own carrier", "--carrier",
                           "leave --carrier out, or --construction"));
  }
  raw.typed.prefer = "fair";
  raw.fit.construction = *made;
  return {};
}

Result<Command> checked_fit(Raw& raw) {
  raw.fit.progress = !raw.no_progress;
  const auto along = direction_named(raw.along);
  OBVID_TRY(along);
  raw.fit.along = *along;
  const Result<void> done =
      set_construction(raw)
          .and_then([&] { return set_job(raw); })
          .and_then([&] { return set_carrier(raw); })
          .and_then([&] { return set_formats(raw.formats, raw.fit.formats, raw.fit.profile); })
          .and_then([&] { return set_import(raw.formats, raw.fit.import); })
          .and_then([&] { return set_units(raw.units, raw.fit.units); })
          .and_then([&] { return settle_streams(raw.fit, raw.format, raw.fit.csv); })
          .and_then([&] { return set_inputs(raw, raw.fit, "fit", "a file with points"); });
  OBVID_TRY(done);
  allow_two_points(raw.fit.job, raw.fit.import);
  raw.fit.formats.asked = raw.asked;
  raw.fit.idle = idle_options(raw.formats, raw.fit.outputs);
  if (raw.fit.construction) {
    raw.fit.construction = with_job(*raw.fit.construction, raw.fit.job);
    if (raw.fit.suggest) {
      return fail(bad_option("a construction has no tolerances to suggest", "--suggest", ""));
    }
  }
  if (raw.fit.suggest && (raw.fit.csv || !raw.fit.inputs.empty())) {
    return fail(bad_option("the table of tolerances is of one input, and no CSV", "--suggest",
                           "give one file, and --json for programs"));
  }
  return command_of(raw.fit);
}

/// What of the options is for several inputs, and what is for one.
Result<void> set_curves(Raw& raw) {
  CompareOptions& options = raw.compare;
  if (options.inputs.empty() && !raw.align.empty()) {
    return fail(bad_option("one input has nothing to be aligned with", "--align",
                           "name another file, or leave it out"));
  }
  if (options.inputs.empty() && options.enlarge) {
    return fail(bad_option("one input has no deviations from another", "--enlarge",
                           "name another file, or leave it out"));
  }
  if (!options.inputs.empty() && raw.formats.curvature_range) {
    return fail(bad_option("the picture of several inputs has no curvatures", "--curvature-range",
                           "name one file, or leave it out"));
  }
  const auto job = curves_job(raw.align);
  OBVID_TRY(job);
  options.curves = *job;
  return check_enlarge(options.enlarge);
}

Result<Command> checked_compare(Raw& raw) {
  const Result<void> done =
      set_job(raw)
          .and_then([&] { return set_import(raw.formats, raw.compare.import); })
          .and_then([&] { return set_shown(raw.formats, raw.compare.shown); })
          .and_then([&] { return set_units(raw.units, raw.compare.units); })
          .and_then([&] { return settle_streams(raw.compare, raw.format, raw.compare.csv); })
          .and_then([&] { return set_inputs(raw, raw.compare, "compare", "a file with points"); })
          .and_then([&] { return set_curves(raw); });
  OBVID_TRY(done);
  raw.compare.job = raw.fit.job;
  allow_two_points(raw.fit.job, raw.compare.import);
  raw.compare.progress =
      !raw.no_progress && !raw.compare.json && !raw.compare.csv && !raw.compare.quiet;
  raw.compare.asked = raw.asked;
  return command_of(raw.compare);
}

Result<Command> checked_convert(Raw& raw) {
  ConvertOptions& options = raw.convert;
  if (options.csv) options.outputs.emplace_back("-.csv");
  if (options.json) options.outputs.emplace_back("-.json");
  const auto streamed = take_standard_output(options.outputs, raw.format, nullptr);
  OBVID_TRY(streamed);
  options.quiet = options.quiet || *streamed || options.csv || options.json;
  OBVID_TRY(set_inputs(raw, options, "convert", "a contour file"));
  OBVID_TRY(set_formats(raw.formats, options.formats, options.profile));
  options.formats.asked = raw.asked;
  options.idle = idle_options(raw.formats, options.outputs);
  OBVID_TRY(set_units(raw.units, raw.convert.units));
  OBVID_TRY(set_import(raw.formats, raw.convert.import));
  if (raw.convert.outputs.empty()) {
    return fail(usage("convert needs a file to write",
                      "add -o NAME; possible file extensions are " + known_endings()));
  }
  return command_of(raw.convert);
}

Result<Command> checked_analyse(Raw& raw) {
  OBVID_TRY(set_import(raw.formats, raw.analyse.import));
  raw.analyse.import.list.hint_of_two = "two do when both have a heading, in a column heading_deg";
  OBVID_TRY(set_plots(raw.formats, raw.analyse.plots));
  OBVID_TRY(set_units(raw.units, raw.analyse.units));
  OBVID_TRY(settle_streams(raw.analyse, raw.format, raw.analyse.csv));
  raw.analyse.asked = raw.asked;
  OBVID_TRY(set_inputs(raw, raw.analyse, "analyse", "a file with points"));
  return command_of(raw.analyse);
}

Result<Command> checked_region(Raw& raw) {
  const auto made = construction_values(raw.construction);
  OBVID_TRY(made);
  OBVID_TRY(set_job(raw));
  OBVID_TRY(set_import(raw.formats, raw.region.import));
  raw.region.job = with_job(*made, raw.fit.job);
  allow_two_points(raw.fit.job, raw.region.import);
  OBVID_TRY(set_units(raw.units, raw.region.units));
  OBVID_TRY(settle_streams(raw.region, raw.format, raw.region.csv));
  raw.region.asked = raw.asked;
  OBVID_TRY(set_inputs(raw, raw.region, "region", "a file with points"));
  return command_of(raw.region);
}

Result<Command> checked(const CLI::App& app, Raw& raw) {
  OBVID_TRY(check_command(app));
  OBVID_TRY(check_all_extras(app));
  const std::string& name = app.get_subcommands().front()->get_name();
  raw.asked = asked_for(*app.get_subcommands().front(), "obvid " + name);
  if (name == "fit") return checked_fit(raw);
  if (name == "analyse") return checked_analyse(raw);
  if (name == "convert") return checked_convert(raw);
  if (name == "region") return checked_region(raw);
  if (name == "compare") return checked_compare(raw);
  if (name == "explain") {
    if (raw.explain.csv && raw.explain.json) {
      return fail(
          bad_option("standard output cannot hold two things", "--csv", "leave it or --json out"));
    }
    return command_of(raw.explain);
  }
  OBVID_TRY(settle_streams(raw.verify, raw.format, raw.verify.csv));
  raw.verify.asked = raw.asked;
  OBVID_TRY(set_inputs(raw, raw.verify, "verify", "a contour file"));
  return command_of(raw.verify);
}

void allow_extras(CLI::App& app) {
  // They are reported by this program, with a guess at what was meant.
  app.allow_extras();
  for (CLI::App* command : app.get_subcommands(nullptr)) command->allow_extras();
}

/// `obvid help fit`, `obvid help surface skin`: what `--help` behind these words says.
Result<Command> help_of(int argc, const char* const* argv) {
  if (argc == 2)
    return command_of(ShowText{wrapped_help(kShortHelp, kShortHelpColumn, help_width())});
  std::vector<const char*> words{argv[0]};
  words.insert(words.end(), argv + 2, argv + argc);
  words.push_back("--help");
  return parse_command_line(static_cast<int>(words.size()), words.data());
}

}  // namespace

Result<Command> parse_command_line(int argc, const char* const* argv) {
  if (argc < 2)
    return command_of(ShowText{wrapped_help(kShortHelp, kShortHelpColumn, help_width())});
  if (std::string_view(argv[1]) == "help") return help_of(argc, argv);
  const bool quiet = argv[1] == std::string_view("-q") || argv[1] == std::string_view("--quiet");
  if (quiet && argc > 2 && *argv[2] != '-') {  // before the command it means the same
    std::vector<const char*> turned(argv, argv + argc);
    std::swap(turned[1], turned[2]);
    return parse_command_line(argc, turned.data());
  }
  try {
    if (std::string_view(argv[1]) == "surface") return parse_surface(argc - 1, argv + 1);
    if (std::string_view(argv[1]) == "spline") return parse_spline(argc - 1, argv + 1);
    if (std::string_view(argv[1]) == "nurbs") return parse_nurbs(argc - 1, argv + 1);
    if (std::string_view(argv[1]) == "alignment") return parse_alignment(argc - 1, argv + 1);
    if (std::string_view(argv[1]) == "studio") {
      return command_of(StudioOptions{{argv + 2, argv + argc}});
    }
    if (std::string_view(argv[1]) == "batch") {
      return command_of(BatchOptions{{argv + 2, argv + argc}});
    }
    if (std::string_view(argv[1]) == "toolpath") return parse_toolpath(argc - 1, argv + 1);
    if (std::string_view(argv[1]) == "cut") return parse_cut(argc - 1, argv + 1);
    CLI::App app("Points in, a curvature-continuous, monotone and proved contour out", "obvid");
    app.set_version_flag("-V,--version", std::string("obvid ") + kVersion);
    app.require_subcommand(0, 1);
    shape_help(app, kHelpColumn, argc, argv);
    app.footer(with_exit_codes(""));
    Raw raw;
    add_fit(app, raw);
    add_readers(app, raw);
    add_region(app, raw);
    add_compare(app, raw);
    add_convert(app, raw);
    add_checkers(app, raw);
    // understood apart, listed here
    app.add_subcommand("surface",
                       "Surfaces: skin, ruled, revolve, coons, gordon, grid, offset, check, ...");
    app.add_subcommand("spline", "Integro-differential splines of one variable, and along points");
    app.add_subcommand("nurbs", "Curves and surfaces of control points, weights and knots");
    app.add_subcommand("alignment", "Roads and rails: few lines, arcs and clothoids");
    app.add_subcommand("toolpath", "Three-axis milling of a surface as G-code");
    app.add_subcommand("cut", "All outlines of a drawing for a mill, a laser or a plasma torch");
    app.add_subcommand("batch", "One job for many inputs on all processors, results as a table");
    app.add_subcommand("studio", "A page in the browser: drag points, see what is possible, prove");
    allow_extras(app);
    try {
      app.parse(argc, argv);
    } catch (const CLI::CallForVersion& version) {
      return command_of(ShowText{std::string(version.what()) + "\n"});
    } catch (const CLI::CallForHelp&) {
      const auto is_named = [&](CLI::App* command) { return command->get_name() == argv[1]; };
      const bool known = *argv[1] == '-' || !app.get_subcommands(is_named).empty();
      if (!known) return parse_command_line(2, argv);  // the word alone, which is an error
      return command_of(ShowText{app.help()});
    } catch (const CLI::ParseError& error) {
      return fail(from_cli(error, "COMMAND"));
    }
    return checked(app, raw);
  } catch (const CLI::Error& error) {
    return obvid::error(ErrorCode::kInternal, error.what()).where("command line");
  }
}

}  // namespace obvid
