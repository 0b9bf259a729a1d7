// SPDX-License-Identifier: Apache-2.0
#include "surface_options.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <variant>

#include "cli_app.h"
#include "commands.h"
#include "obvid/pipeline/internal/format_values.h"
#include "obvid/pipeline/internal/job_values.h"
#include "obvid/pipeline/internal/surface_values.h"
#include "options.h"

namespace obvid {
namespace {

/// What the command line said, before it is checked.
struct RawSurface {
  SurfaceOptions make;
  std::vector<std::string> inputs, across;
  SurfaceCheckOptions check;
  SurfaceCutOptions cut;
  SurfaceCutValues cut_values;
  TypedValues typed;
  SurfaceValues values;
  SurfaceFormatValues formats;
  bool no_progress = false;
  std::string format;  ///< of what -o sends to standard output
  SurfaceCheckValues check_values;
  std::optional<std::string> colour;  ///< of a check
  std::optional<std::string> units;
};

struct KindText {
  const char* name;
  const char* help;
  const char* inputs;
  const char* example;
};

constexpr KindText kKinds[] = {
#define OBVID_SURFACE_KIND(kind, name, help, inputs, example) {name, help, inputs, example},
#include "obvid/pipeline/surface_kinds.inc"
#undef OBVID_SURFACE_KIND
};

SurfaceKind kind_of(const KindText& text) { return *surface_kind_named(text.name); }
template <class Kind>
bool is_kind(const KindText& text) {
  return std::holds_alternative<Kind>(kind_of(text));
}

constexpr std::size_t kSurfaceHelpColumn = 47;  // where it says what commands do
constexpr const char* kSurfaceHelp =
    R"(obvid surface: surfaces over fair contours

  obvid surface skin SECTIONS... -o OUT        through section contours
  obvid surface ruled A B -o OUT               between two curves
  obvid surface revolve PROFILE -o OUT         about an axis
  obvid surface coons A B C D -o OUT           between four borders
  obvid surface gordon A... --across B... -o OUT
                                               through a net of curves
  obvid surface grid GRID -o OUT               through, near or controlled by points
  obvid surface id GRID -o OUT                 integro-differential spline
  obvid surface scatter POINTS --tolerance T -o OUT
                                               near points in any order
  obvid surface offset SURFACE --distance D -o OUT
  obvid surface trim SURFACE --plane z=1.8 --keep below -o OUT
                                               a part of it
  obvid surface fillet SURFACE --faces A,B --radius R -o OUT
                                               a rolling ball's blend
  obvid surface match SURFACE --border A:u1 --to B:u0 -o OUT
                                               A goes on from B
  obvid surface convert SURFACE -o OUT         another format
  obvid surface check SURFACE                  curvature, joints, monotone sections
  obvid surface cut SURFACE -o OUT             sections by planes, lines drawing

`obvid surface KIND --help` shows options, units and defaults.
)";

const char* const kLengthHelp = "input units";

constexpr const char* kViewText =
    "iso, front, top, side, back, bottom, or longitudinals: graphs of the curvature along ten "
    "lines u = const, of a picture alone [iso]";

void add_pictures(CLI::App& app, RawSurface& raw) {
  const char* group = "Triangles, pages and pictures";
  app.add_option("--chord-tolerance", raw.formats.chord_tolerance,
                 "Largest distance of triangles from the surface, units [1e-3 of its size]")
      ->type_name("T")
      ->group(group);
  app.add_option("--mesh-angle", raw.formats.mesh_angle_deg,
                 "Largest angle between normals along an edge of a triangle, degrees [15]")
      ->type_name("DEG")
      ->group(group);
  app.add_option(
         "--colour", raw.formats.colour,
         "shaded, isolines, gaussian, mean, k1, k2, zebra, isophotes or reflection [shaded]")
      ->type_name("NAME")
      ->group(group);
  app.add_option("--view", raw.formats.view, kViewText)->type_name("NAME")->group(group);
}

/// Options of contours through points, where points are read.
void add_contours(CLI::App& app, RawSurface& raw) {
  const char* group = "Contours through points";
  app.add_option("--noise", raw.typed.noise,
                 "How far each point may move, input units, or the word rounding: half a unit of "
                 "the last printed digit [0]")
      ->type_name("EPS|rounding")
      ->group(group);
  app.add_flag("--closed", raw.typed.closed, "Contours return to their first points")->group(group);
  app.add_flag("--open", raw.typed.open, "They do not, even if the last point is the first again")
      ->group(group);
  app.add_option("--corner-angle", raw.typed.corner_angle_deg, kCornerAngleHelp)
      ->type_name("DEG")
      ->group(group);
  app.add_flag("--no-corners", raw.typed.no_corners, "Search no corners")->group(group);
  app.add_option("--continuity", raw.typed.continuity,
                 "The curvature is continuous (G2), or its slope too, where a contour has one (G3) "
                 "[G2]")
      ->type_name("NAME")
      ->group(group);
  app.add_flag("--plain", raw.make.job.curves.plain_when_refused,
               "Sections without a fair contour take the C2 cubic through their points, which is "
               "said [refused]")
      ->group(group);
}

void add_surface_tolerance(CLI::App& app, RawSurface& raw, const char* what) {
  app.add_option("--tolerance", raw.values.tolerance,
                 std::string(what) + ", " + kLengthHelp + " [1e-5 of the size]")
      ->type_name("T");
}

void add_skin_options(CLI::App& app, RawSurface& raw) {
  add_surface_tolerance(app, raw, "Largest distance of the surface from the section contours");
  app.add_option(
         "--match", raw.values.matching,
         "What belongs together in the sections: points, length, angle (half of it arc length), "
         "optimised (lines across bend little) or auto (points when all sections have "
         "equally many; with --fair-across the one that forces the fewest changes, if runs "
         "of curvature are kept) [auto]")
      ->type_name("NAME");
  app.add_option("--spacing", raw.values.spacing,
                 "Distance of sections whose files have no z, input units [1]")
      ->type_name("D");
  add_contours(app, raw);
}

/// Options that only one kind of surface has.
struct KindOptions {
  CLI::App& app;
  RawSurface& raw;

  void operator()(const SkinKind&) const {
    add_skin_options(app, raw);
    app.add_flag("--straight", raw.values.straight, "Ruled strips between sections [C2 across]");
    app.add_option(
           "--light", raw.values.light,
           "Few control points: no point of the skin farther than this from where the exact "
           "skin has it, input units; runs of curvature may be lost, which the table says "
           "[exact]")
        ->type_name("EPS");
    app.add_option("--fair-across", raw.values.fair_across,
                   "Each section may move by this, input units, where lines across then change "
                   "their bending less often; curvature along goes against its run by no more than "
                   "0.1 % of the section's largest (where the exact section has lost more, by "
                   "as much as that, and by 0.1 % against its own run); with --light, which is "
                   "less, sections move by this all in all [sections stay]")
        ->type_name("EPS");
  }
  void operator()(const RuledKind&) const {
    add_skin_options(app, raw);
    vector("--direction", raw.values.direction, "From one curve by this vector, input units");
    vector("--apex", raw.values.apex, "From one curve to this point, input units");
  }
  void operator()(const RevolveKind&) const {
    app.add_option("--axis", raw.values.axis, "Axis: x, y, z or a direction X,Y,Z [x]")
        ->type_name("AXIS");
    vector("--axis-point", raw.values.axis_point, "A point of the axis, input units [0,0,0]");
    app.add_option("--angle", raw.values.angle_deg, "Degrees, right-hand rule [360]")
        ->type_name("DEG");
    add_contours(app, raw);
  }
  void operator()(const CoonsKind&) const {
    add_surface_tolerance(app, raw,
                          "How near curves have to meet, and of what NURBS do not hold exactly");
    add_contours(app, raw);
  }
  void operator()(const GordonKind&) const {
    app.add_option("--across", raw.across, "Curves that cross the others")->type_name("CURVES");
    (*this)(CoonsKind{});
  }
  void operator()(const GridKind&) const {
    app.add_flag("--near", raw.values.near,
                 "As few knots as the tolerance allows [through all points]");
    app.add_flag("--control", raw.values.control, "The points are control points");
    add_surface_tolerance(app, raw, "With --near: largest distance of the points");
    grid();
  }
  void operator()(const IdKind&) const {
    grid();
    app.add_flag("--smooth", raw.values.smooth,
                 "C1: integrals are kept, values give way [values kept]");
  }
  void operator()(const OffsetKind&) const {
    app.add_option("--distance", raw.values.distance,
                   "Along the normals, input units; negative: against")
        ->type_name("D");
    add_surface_tolerance(app, raw, "Largest distance from the exact offset");
  }
  void operator()(const ScatterKind&) const {
    app.add_option("--tolerance", raw.values.tolerance,
                   "Largest distance of the points along the heights, input units")
        ->type_name("T");
    app.add_option("--up", raw.values.up,
                   "Direction of the heights: x, y, z, a direction X,Y,Z, or best: normal of the "
                   "best plane [best]")
        ->type_name("AXIS");
    app.add_option("--steepest", raw.values.steepest_deg,
                   "Neighbours that force a steeper slope are refused, degrees [85]")
        ->type_name("DEG");
    app.add_flag("--drop-outliers", raw.values.drop_outliers,
                 "Leave out points that their neighbours pass by [named alone]");
  }
  void operator()(const TrimKind&) const {
    app.add_option("--plane", raw.values.planes,
                   "x=X, y=Y, z=Z, or NX,NY,NZ,D: all points with NX x + NY y + NZ z = D, input "
                   "units; with several what is on the kept side of all stays")
        ->type_name("PLANE");
    app.add_option("--contour", raw.values.contour,
                   "Closed contour, projected along --along: contour, curve of a drawing, points")
        ->type_name("FILE");
    app.add_option("--along", raw.values.along, "Direction of the projection: x, y or z [z]")
        ->type_name("AXIS");
    app.add_option("--keep", raw.values.keep,
                   "above or below planes (above: where the normal points to); inside or outside a "
                   "contour")
        ->type_name("SIDE");
    app.add_option("--tolerance", raw.values.tolerance,
                   "Largest distance of trims from the exact cut, input units [1e-6 of the size]")
        ->type_name("T");
    add_contours(app, raw);
  }
  void operator()(const FilletKind&) const {
    app.add_option("--faces", raw.values.faces, "The two faces: names, or numbers from 1")
        ->type_name("A,B");
    app.add_option("--radius", raw.values.radius, "Radius of the ball, input units")
        ->type_name("R");
    app.add_option("--radius-end", raw.values.radius_end,
                   "Radius at the end of the spine, linear along its length; with --faces B,A the "
                   "spine runs the other way [the same]")
        ->type_name("R");
    app.add_option("--sides", raw.values.sides,
                   "On which side of each face the ball is: front (where du x dv points to) or "
                   "back, or auto where they share a border [auto]")
        ->type_name("A,B");
    app.add_flag("--whole", raw.values.whole, "Leave the faces as they are [trimmed]");
    app.add_option("--tolerance", raw.values.tolerance,
                   "Largest distance of the blend from the ball's and of trims from its borders, "
                   "input units [5e-8 of the size]")
        ->type_name("T");
  }
  void operator()(const MatchKind&) const {
    app.add_option("--border", raw.values.border,
                   "The border that changes: face (name, or number from 1) and side u0, u1, v0 or "
                   "v1")
        ->type_name("FACE:SIDE");
    app.add_option("--to", raw.values.to, "The border that it becomes, likewise")
        ->type_name("FACE:SIDE");
    app.add_option("--join", raw.values.join,
                   "G0 position, G1 tangent planes, or G2 curvature [G1]")
        ->type_name("NAME");
    app.add_option("--within", raw.values.within,
                   "Refuse where the patch would move farther than this, input units, by a bound "
                   "[no limit]")
        ->type_name("D");
    app.add_option("--tolerance", raw.values.tolerance,
                   "Largest gap that may be left, input units [1e-7 of the size]")
        ->type_name("T");
  }
  void operator()(const ConvertKind&) const {}

 private:
  void vector(const char* name, std::string& into, const char* help) const {
    app.add_option(name, into, help)->type_name("X,Y,Z");
  }
  void grid() const {
    app.add_option("--spread", raw.values.spread,
                   "Parameters by chord, centripetal or uniform [chord]")
        ->type_name("NAME");
    app.add_option("--row", raw.values.row,
                   "How many points of a list x y z are in a row [blank lines, counts or scan "
                   "lines tell]")
        ->type_name("N");
    app.add_option("--spacing", raw.values.spacing, "Distance of rows and columns of heights [1]")
        ->type_name("D");
  }
};

CLI::App& add_maker(CLI::App& app, RawSurface& raw, const KindText& text) {
  CLI::App& kind = *app.add_subcommand(text.name, text.help);
  kind.add_option("INPUT", raw.inputs, text.inputs);
  add_output(kind, raw.make.outputs, raw.format,
             "File to write, format by file extension: " + known_surface_endings());
  std::visit(KindOptions{kind, raw}, kind_of(text));
  kind.add_option("--units", raw.units,
                  "Unit of the lengths: mm, m, in, ft, ...; nothing is converted [as the files "
                  "say; else mm is assumed, with a warning where it matters]")
      ->type_name("NAME");
  kind.add_option("--step", raw.formats.step, "Schema of STEP files: ap214 or ap242 [ap214]")
      ->type_name("NAME");
  add_pictures(kind, raw);
  kind.add_flag("--json", raw.make.json, "Report as JSON on standard output");
  kind.add_flag("-q,--quiet", raw.make.quiet, "No report and no progress bar");
  kind.add_flag("--no-progress", raw.no_progress, "No progress bar");
  kind.footer(with_exit_codes(std::string("Example: ") + text.example));
  return kind;
}

void add_check(CLI::App& app, RawSurface& raw) {
  CLI::App& check = *app.add_subcommand("check", "Curvature, joints of patches, monotone sections");
  check
      .add_option("INPUT", raw.inputs,
                  "Surface (.json, STEP, IGES, BREP, control points); of several files a line each")
      ->type_name("");
  add_output(check, raw.check.outputs, raw.format, "File to write: .html (page), .svg (picture)",
             "svg");
  check
      .add_option("--samples", raw.check_values.samples,
                  "Lines of each family, and points on them [65]")
      ->type_name("N");
  check
      .add_option("--against", raw.check_values.against,
                  "Points (x y z rows, STL, PLY, OBJ) or another surface: how far they are off")
      ->type_name("FILE");
  check
      .add_option("--meeting", raw.check_values.meeting,
                  "Borders of patches nearer than this meet, input units [1e-5 of the size]")
      ->type_name("T");
  check
      .add_option("--colour", raw.colour,
                  "Of pictures and pages: deviation, gaussian, mean, k1, k2, zebra, isophotes, "
                  "reflection, shaded or isolines [deviation with --against, else gaussian]")
      ->type_name("NAME");
  check.add_option("--view", raw.formats.view, kViewText)->type_name("NAME");
  check.add_flag("--csv", raw.check.csv, "Table of patches as CSV on standard output");
  check.add_flag("--json", raw.check.json, "JSON on standard output instead of the tables");
  check.add_flag("-q,--quiet", raw.check.quiet, "No tables and no progress bar");
  check.add_flag("--no-progress", raw.no_progress, "No progress bar");
  check.footer(with_exit_codes("Example: obvid surface check hull.step -o hull.svg"));
}

void add_cut(CLI::App& app, RawSurface& raw) {
  CLI::App& cut = *app.add_subcommand(
      "cut", "Sections by planes: stations, waterlines, buttocks; lines drawing");
  cut.add_option("INPUT", raw.cut.input, "Surface (.json, STEP, IGES, BREP, control points)");
  add_output(
      cut, raw.cut.outputs, raw.format,
      "File to write: .json, .csv (points), .svg, .dxf (lines drawing); with {id} in its name "
      "a file for each branch: .csv, or with --fair a contour in any format",
      "csv");
  cut.add_option("--plane", raw.cut_values.planes,
                 "All points with NX x + NY y + NZ z = D; may repeat")
      ->type_name("NX,NY,NZ,D");
  const char* places = "X,...|every:D|count:N";
  cut.add_option("--stations", raw.cut_values.stations,
                 "Sections x = const: places, multiples of D, or N between the ends, input units")
      ->type_name(places);
  cut.add_option("--waterlines", raw.cut_values.waterlines, "Sections z = const, likewise")
      ->type_name(places);
  cut.add_option("--buttocks", raw.cut_values.buttocks, "Sections y = const, likewise")
      ->type_name(places);
  cut.add_option("--tolerance", raw.cut_values.tolerance,
                 "Largest distance of chords between neighbouring points from the section, input "
                 "units [1e-5 of the size]")
      ->type_name("T");
  cut.add_option("--fair", raw.cut_values.fair,
                 "Each branch becomes a contour within this distance of its points, proved as by "
                 "obvid fit, input units [points alone]")
      ->type_name("EPS");
  const char* group = "What floats";
  cut.add_option("--draught", raw.cut_values.draught,
                 "Height z of the waterplane, input units: volume, centres and areas below it")
      ->type_name("Z")
      ->group(group);
  cut.add_flag("--half", raw.cut_values.half,
               "The surface is one half of a body that is symmetric to y = 0")
      ->group(group);
  cut.add_option("--density", raw.cut_values.density,
                 "Mass of water in a cubic input unit: the displacement is told too")
      ->type_name("RHO")
      ->group(group);
  cut.add_flag("--csv", raw.cut.csv, "Points as CSV on standard output, as -o NAME.csv");
  cut.add_flag("--json", raw.cut.json, "JSON on standard output instead of the table");
  cut.add_flag("-q,--quiet", raw.cut.quiet, "No table and no progress bar");
  cut.add_flag("--no-progress", raw.no_progress, "No progress bar");
  cut.footer(
      with_exit_codes("Example: obvid surface cut hull.json --waterlines count:20 --stations "
                      "every:1 -o lines.svg"));
}

Result<void> check_needs(const RawSurface& raw, const KindText& text) {
  const std::string name = std::string("surface ") + text.name;
  const std::string see = "see obvid " + name + " --help";
  if (raw.inputs.empty()) return fail(usage(name + " needs input files", see));
  if (is_kind<GordonKind>(text) && raw.across.empty()) {
    return fail(usage("surface gordon needs the crossing curves after --across", see));
  }
  if (is_kind<OffsetKind>(text) && !raw.values.distance) {
    return fail(usage("surface offset needs --distance", see));
  }
  if (is_kind<ScatterKind>(text) && !raw.values.tolerance) {
    return fail(usage("surface scatter needs --tolerance", see));
  }
  return {};
}

Result<Command> checked_maker(RawSurface& raw, const KindText& text) {
  SurfaceOptions& make = raw.make;
  make.command = text.name;
  make.job.kind = kind_of(text);
  raw.inputs = inputs_or_pipe(std::move(raw.inputs));
  make.job.inputs.assign(raw.inputs.begin(), raw.inputs.end());
  if (auto* second = second_inputs(make.job)) second->assign(raw.across.begin(), raw.across.end());
  OBVID_TRY(settle_streams(make, raw.format));
  make.progress = !raw.no_progress && !make.quiet && !make.json;
  const Result<void> done =
      check_needs(raw, text)
          .and_then([&] { return set_surface(raw.values, make.job); })
          .and_then([&] { return set_surface_formats(raw.formats, make.formats); })
          .and_then([&] { return set_values(raw.typed, make.job.curves.sections); })
          .and_then([&]() -> Result<void> {
            if (!raw.units) return {};
            return given_units(*raw.units, "--units").map([&](Units given) {
              make.job.units = std::move(given);
            });
          });
  OBVID_TRY(done);
  return command_of(make);
}

Result<Command> checked_check(RawSurface& raw) {
  raw.inputs = inputs_or_pipe(std::move(raw.inputs));
  if (raw.inputs.empty()) {
    return fail(usage("surface check needs a surface", "see obvid surface check --help"));
  }
  if (raw.inputs.size() == 1) {
    raw.check.input = raw.inputs.front();
  } else {
    raw.check.inputs = raw.inputs;
  }
  OBVID_TRY(set_surface_check(raw.check_values, raw.check.job));
  raw.formats.colour = raw.colour.value_or(raw.check.job.against ? "deviation" : "gaussian");
  OBVID_TRY(set_surface_formats(raw.formats, raw.check.formats));
  OBVID_TRY(settle_streams(raw.check, raw.format, raw.check.csv, "svg"));
  raw.check.progress = !raw.no_progress && !raw.check.json && !raw.check.csv && !raw.check.quiet;
  return command_of(raw.check);
}

Result<Command> checked_sections(RawSurface& raw) {
  raw.cut.input = input_or_pipe(raw.cut.input);
  if (raw.cut.input.empty()) {
    return fail(usage("surface cut needs a surface", "see obvid surface cut --help"));
  }
  OBVID_TRY(set_surface_cut(raw.cut_values, raw.cut.job));
  OBVID_TRY(settle_streams(raw.cut, raw.format, raw.cut.csv, "csv"));
  raw.cut.progress = !raw.no_progress && !raw.cut.json && !raw.cut.csv && !raw.cut.quiet;
  return command_of(raw.cut);
}

Result<Command> checked_surface(const CLI::App& app, RawSurface& raw) {
  std::vector<std::string> extras = app.remaining();
  if (app.get_subcommands().empty()) {
    std::vector<std::string> names = {"check", "cut"};
    for (const KindText& text : kKinds) names.emplace_back(text.name);
    return fail(usage(
        "unknown kind of surface '" + (extras.empty() ? "" : extras.front()) + "'",
        did_you_mean(extras.empty() ? "" : extras.front(), names, "see obvid surface --help")));
  }
  const CLI::App& kind = *app.get_subcommands().front();
  const std::vector<std::string> left = kind.remaining();
  extras.insert(extras.end(), left.begin(), left.end());
  OBVID_TRY(check_extras(kind, extras, "surface " + kind.get_name()));
  for (const KindText& text : kKinds) {
    if (kind.get_name() == text.name) return checked_maker(raw, text);
  }
  return kind.get_name() == "cut" ? checked_sections(raw) : checked_check(raw);
}

}  // namespace

Result<Command> parse_surface(int argc, const char* const* argv) {
  const bool bare = argc < 2 || std::string_view(argv[1]) == "--help";
  if (bare && !help_as_lines()) {
    return command_of(ShowText{wrapped_help(kSurfaceHelp, kSurfaceHelpColumn, help_width())});
  }
  CLI::App app("Surfaces over fair contours", "obvid surface");
  app.require_subcommand(0, 1);
  shape_help(app, kHelpColumn, argc, argv);
  app.allow_extras();
  RawSurface raw;
  for (const KindText& text : kKinds) add_maker(app, raw, text).allow_extras();
  add_check(app, raw);
  add_cut(app, raw);
  for (CLI::App* kind : app.get_subcommands(nullptr)) kind->allow_extras();
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return command_of(ShowText{app.help()});
  } catch (const CLI::ParseError& error) {
    return fail(from_cli(error, "surface KIND"));
  }
  return checked_surface(app, raw);
}

}  // namespace obvid
