// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/cut_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "obvid/core/internal/figures.h"
#include "obvid/curve/internal/flatten.h"
#include "obvid/cutting/internal/edge_of_cut.h"
#include "obvid/exchange/internal/gcode/dialect.h"
#include "obvid/exchange/internal/whole_arcs.h"
#include "obvid/io/internal/json_list.h"
#include "obvid/pipeline/internal/drawn_contour.h"
#include "obvid/pipeline/internal/job_values.h"
#include "obvid/pipeline/internal/through_points.h"

namespace obvid {
namespace {

constexpr double kDefaultTolerance = 0.01;  // mm
constexpr long kMostCount = 1000;           // of passes, tabs

/// All curves of a drawing; those that are not asked for only say what lies in what.
class Taken {
 public:
  Taken(const ImportOptions& options, bool several, MadeCut& made, const RunContext& run)
      : options_(options), several_(several), made_(made), run_(run) {}

  Result<void> add(const Drawing& drawing) {
    std::set<std::size_t> chosen;
    if (options_.curve.asked()) {
      const auto numbers = chosen_curves(drawing, options_.curve, drawing.name);
      OBVID_TRY(numbers);
      chosen.insert(numbers->begin(), numbers->end());
    }
    made_.warnings.insert(made_.warnings.end(), drawing.warnings.begin(), drawing.warnings.end());
    if (chosen.empty()) made_.left_out += drawing.left_out;
    const std::size_t curves = drawing.curves.size(), all = curves + drawing.series.size();
    for (std::size_t number = 0; number < all; ++number) {
      const bool asked = chosen.contains(number);
      if (number >= curves && !asked && is_no_outline(drawing.series[number - curves])) {
        if (chosen.empty()) no_outlines_.add(drawing, number);
        continue;
      }
      OBVID_TRY(add(drawing, number, chosen.empty() || asked));
    }
    tell(drawing);
    return {};
  }

 private:
  /// Curves of one kind, for a sentence.
  struct Named {
    static constexpr std::size_t kMostNamed = 8;  // the others are counted
    std::string names;
    std::size_t count = 0;

    void add(const Drawing& drawing, std::size_t number) {
      if (++count > kMostNamed) return;
      const PointSeries& one = drawing.series[number - drawing.curves.size()];
      const std::string& name = one.spline ? one.spline->label : one.name;
      if (!names.empty()) names += ", ";
      names += name.empty() ? fmt::format("curve {}", number + 1)
                            : fmt::format("{} (curve {})", name, number + 1);
    }
    [[nodiscard]] std::string text() const { return names + and_more(count, kMostNamed); }
  };

  /// Places that nobody joined by a line.
  [[nodiscard]] bool is_no_outline(const PointSeries& series) const {
    const bool loose = series.kind == SeriesKind::kLoose || series.kind == SeriesKind::kWaypoints;
    return loose && options_.use != DrawnUse::kExact;
  }

  void tell(const Drawing& drawing) {
    if (no_outlines_.count > 0) {
      made_.warnings.push_back(fmt::format("{}: points are no outline and not cut: {}",
                                           drawing.name, no_outlines_.text()));
    }
    if (edges_.count > 0 && options_.use != DrawnUse::kExact) {
      made_.warnings.push_back(fmt::format(
          "{}: cut as drawn, along straight edges, with arcs in place of several where they are "
          "within the tolerance of them, where the vertices look like points of a curve: {}; "
          "`obvid fit {} --curve N -o outline.json` forms a curve of one, --drawing exact says "
          "that the edges are meant",
          drawing.name, edges_.text(), drawing.name));
    }
    if (splines_.count > 0) {
      made_.warnings.push_back(fmt::format(
          "{}: drawn by points alone, cut along the cubic spline through them (by the chords; "
          "where "
          "the last point is the first one smooth over it, else with curvature 0 at ends without a "
          "direction; CAD systems may draw another): {}",
          drawing.name, splines_.text()));
    }
    no_outlines_ = edges_ = splines_ = {};
  }

  Result<DrawnCurve> curve_of(const Drawing& drawing, std::size_t number, bool is_cut) {
    if (number < drawing.curves.size()) return drawing.curves[number];
    const PointSeries& series = drawing.series[number - drawing.curves.size()];
    if (is_no_outline(series)) {
      return error(ErrorCode::kUnsupported, "these are points, not a curve")
          .where(fmt::format("{}, {}", drawing.name, series.name))
          .hint("use `obvid fit`, or --drawing exact to join them in their order");
    }
    if (!series.spline) {
      if (is_cut) edges_.add(drawing, number);
      return edges_of(series);
    }
    auto spline = spline_through(series);
    if (!spline) {
      Error error = std::move(spline.error());
      error.where =
          fmt::format("{}, {} (curve {})", drawing.name, series.spline->label, number + 1);
      if (error.hint.empty()) error.hint = "leave it out: --curve with the numbers of the others";
      return fail(std::move(error));
    }
    if (is_cut) splines_.add(drawing, number);
    return spline;
  }

  Result<void> add(const Drawing& drawing, std::size_t number, bool is_cut) {
    auto curve = curve_of(drawing, number, is_cut);
    OBVID_TRY(curve);
    if (curve->pieces.empty()) return {};  // all of its points are one
    ImportOptions one = options_;
    one.curve = {std::size_t{0}, {}, false, {}};
    Drawing alone;
    alone.name = drawing.name;
    alone.units = drawing.units;
    alone.curves.push_back(std::move(*curve));
    auto drawn = drawn_contour(std::move(alone), one, drawing.name, run_);
    OBVID_TRY(drawn);
    std::string name = drawn->name.empty() ? fmt::format("curve {}", number + 1) : drawn->name;
    if (several_) name = drawing.name + ": " + name;
    const bool chords = number >= drawing.curves.size() &&
                        !drawing.series[number - drawing.curves.size()].spline &&
                        options_.use != DrawnUse::kExact;
    made_.outlines.push_back({std::move(name), std::move(drawn->stored.contour), is_cut, chords});
    made_.curves.push_back(number);
    return {};
  }

  const ImportOptions& options_;
  bool several_;
  MadeCut& made_;
  const RunContext& run_;
  Named no_outlines_, edges_, splines_;
};

constexpr int kFewestChords = 8;
constexpr int kMostChords = 4096;

void add_polyline(SketchLayer& layer, const Piece& piece, double tolerance) {
  if (std::holds_alternative<LinePiece>(piece) || std::holds_alternative<ArcPiece>(piece)) {
    layer.pieces.push_back(piece);
    return;
  }
  const int chords = chord_steps(piece, tolerance, kFewestChords, kMostChords);
  std::vector<Vec2> points;
  for (int k = 0; k <= chords; ++k) {
    points.push_back(evaluate(piece, static_cast<double>(k) / chords).point);
  }
  layer.polylines.push_back(std::move(points));
}

/// Outlines of one name, such as those of a block that is placed several times, get the numbers of
/// their curves.
void tell_apart(MadeCut& made) {
  std::map<std::string, std::size_t> count;
  for (const CutOutline& one : made.outlines) ++count[one.name];
  for (std::size_t i = 0; i < made.outlines.size(); ++i) {
    std::string& name = made.outlines[i].name;
    if (count[name] > 1) name += fmt::format(" (curve {})", made.curves[i] + 1);
  }
}

/// Once, where reading told already that no unit is stated.
void tell_assumed_unit(MadeCut& made) {
  const std::string asks = ": --units says what it is", assumed = ": " + made.units.name;
  bool told = false;
  for (std::string& warning : made.warnings) {
    if (!warning.ends_with(asks)) continue;
    warning.resize(warning.size() - asks.size());
    warning += assumed + " is assumed; --units says what it is";
    told = true;
  }
  if (told) return;
  made.warnings.push_back("the drawing does not say its unit" + assumed +
                          " is assumed; --units says what a unit is");
}

}  // namespace

std::string unit_of_program(const MadeCut& made) {
  return made.units.known() ? made.units.text() : made.units.name;
}

Result<MadeCut> make_cut(std::vector<Drawing> drawings, const ImportOptions& options,
                         const CutJob& job, const RunContext& run) {
  MadeCut made;
  std::vector<Units> units;
  const RunContext asked = without_progress(run);  // its progress is that of the program
  for (Drawing& drawing : drawings) {
    if (job.units) {
      if (auto told = take_units(drawing.units, *job.units)) made.warnings.push_back(*told);
    }
    units.push_back(drawing.units);
    OBVID_TRY(Taken(options, drawings.size() > 1, made, asked).add(drawing));
  }
  const auto common = common_units(units, "");
  OBVID_TRY(common);
  made.units = *common;
  if (made.outlines.empty()) {
    return error(ErrorCode::kNothingThere, "there is no curve to cut")
        .hint("`obvid fit` forms a curve of points");
  }
  for (CutOutline& one : made.outlines) one.contour.units = made.units;
  tell_apart(made);
  CutOptions plan = job.plan;
  const auto millimetre = unit_ratio(made.units.name, "mm");
  plan.tolerance = job.tolerance.value_or(kDefaultTolerance / millimetre.value_or(1.0));
  made.tolerance = plan.tolerance;
  auto program = cut(made.outlines, plan, run);
  OBVID_TRY(program);
  made.program = std::move(*program);
  if (!made.units.known()) tell_assumed_unit(made);
  auto& warnings = made.program.warnings;
  made.warnings.insert(made.warnings.end(), warnings.begin(), warnings.end());
  return made;
}

std::optional<Error> not_cut(const MadeCut& made) {
  if (made.left_out == 0) return std::nullopt;
  return error(ErrorCode::kNotAllCut,
               fmt::format("{} of the drawing could not be read as drawn and {} not cut so",
                           counted(made.left_out, "entity", "entities"),
                           made.left_out == 1 ? "is" : "are"))
      .hint(
          "the warnings name the first of each kind; --curve with the numbers of the others says "
          "that they are not wanted")
      .value(static_cast<double>(made.left_out));
}

Sketch cut_sketch(const MadeCut& made, const CutJob& job) {
  Sketch out;
  out.title = job.plan.name;
  out.units = made.units;
  const CutReport& report = made.program.report;
  out.remarks.push_back(fmt::format("{}, {} {} along the cut, {} {} rapid, about {} min",
                                    counted(made.program.steps.size(), "outline", "outlines"),
                                    significant(report.cut_length, 4), unit_of_program(made),
                                    significant(report.rapid_length, 4), unit_of_program(made),
                                    significant(report.minutes, 3)));
  SketchLayer outlines = sketch_layer("OUTLINES", "outline", "#1c2733", 7, 1.6);
  SketchLayer axis = sketch_layer("TOOL", "way of the tool's axis", "#cf5a12", 30, 1.0);
  SketchLayer edge = sketch_layer("CUT", "edge of the cut", "#e9b48f", 40, 0.7);
  SketchLayer rapid = sketch_layer("RAPID", "rapid move", "#1b6ec2", 5, 0.8);
  rapid.dashed = true;
  SketchLayer tabs = sketch_layer("TABS", "tab: stays below the tool", "#1a7f37", 3, 2.4);
  SketchLayer starts = sketch_layer("STARTS", "begins here, in this order", "#a3209b", 6, 1.0);
  for (const CutOutline& one : made.outlines) {
    for (const Piece& piece : exchange::whole_arcs(one.contour.pieces)) {
      add_polyline(outlines, piece, made.tolerance);
    }
  }
  for (const CutMove& move : made.program.moves) {
    SketchLayer& layer = move.kind == CutMoveKind::kRapid ? rapid
                         : move.kind == CutMoveKind::kTab ? tabs
                                                          : axis;
    add_polyline(layer, move.piece, made.tolerance);
  }
  edge.pieces = edge_of_cut(made.program.moves, 0.5 * job.plan.diameter, made.tolerance);
  for (std::size_t k = 0; k < made.program.steps.size(); ++k) {
    starts.points.push_back(made.program.steps[k].start);
    out.words.push_back({made.program.steps[k].start, std::to_string(k + 1)});
  }
  out.layers = {std::move(edge), std::move(outlines), std::move(axis), std::move(rapid)};
  const bool any = !tabs.pieces.empty() || !tabs.polylines.empty();
  if (any) out.layers.push_back(std::move(tabs));
  out.layers.push_back(std::move(starts));
  return out;
}

std::string cut_json(const MadeCut& made) {
  JsonText json;
  const CutReport& r = made.program.report;
  json.begin_object();
  add_units(json, made.units);
  json.key("outlines").begin_array();
  for (const CutStep& step : made.program.steps) {
    json.begin_object().pair("name", step.name);
    json.pair("curve", made.curves[step.outline])
        .pair("closed", step.closed)
        .pair("around", step.around);
    json.pair("side", to_string(step.side))
        .key("start")
        .begin_array()
        .value(step.start.x)
        .value(step.start.y);
    json.end_array().pair("length", step.length).pair("left_in_corners", step.left_in_corners);
    json.end_object();
  }
  json.end_array().key("report").begin_object();
  json.pair("levels", r.levels).pair("blocks", r.blocks).pair("arc_blocks", r.arc_blocks);
  json.pair("spline_blocks", r.spline_blocks);
  json.pair("cut_length", r.cut_length)
      .pair("rapid_length", r.rapid_length)
      .pair("minutes", r.minutes);
  json.pair("beyond", r.beyond)
      .pair("short_of", r.short_of)
      .pair("spacing", r.spacing)
      .pair("blending", r.blending)
      .pair("left_in_corners", r.left_in_corners);
  json.end_object();
  json.pair("left_out", made.left_out);
  add_list(json, "warnings", made.warnings).end_object();
  return json.take();
}

DataTable cut_rows(const MadeCut& made) {
  DataTable out{heads_of("order,curve,outline,tool,closed,start_x,start_y,length,left_in_corners")};
  for (const CutStep& step : made.program.steps) {
    out.rows.push_back({out.rows.size() + 1, made.curves[step.outline] + 1, step.name,
                        to_string(step.side), step.closed ? "yes" : "no", step.start.x,
                        step.start.y, step.length, step.left_in_corners});
  }
  return out;
}

Result<void> set_cut(const CutValues& typed, CutJob& job) {
  CutOptions& plan = job.plan;
  const auto pick = [](const auto& names, const std::optional<std::string>& name,
                       const char* option, auto& into) -> Result<void> {
    if (!name) return {};
    const auto value = value_named(names, *name, option);
    OBVID_TRY(value);
    into = *value;
    return {};
  };
  OBVID_TRY(pick(std::map<std::string, CutSide>{{"auto", CutSide::kAuto},
                                                {"outside", CutSide::kOutside},
                                                {"inside", CutSide::kInside},
                                                {"on", CutSide::kOn}},
                 typed.side, "--side", plan.side));
  OBVID_TRY(pick(std::map<std::string, CutDirection>{{"climb", CutDirection::kClimb},
                                                     {"conventional", CutDirection::kConventional}},
                 typed.direction, "--direction", plan.direction));
  const auto& controllers = exchange::kGcodeControllers;
  OBVID_TRY(pick(std::map<std::string, GcodeController>{controllers.begin(), controllers.end()},
                 typed.controller, "--controller", plan.controller));
  OBVID_TRY(pick(std::map<std::string, GcodeMotion>{{"arcs", GcodeMotion::kArcs},
                                                    {"splines", GcodeMotion::kSplines}},
                 typed.motion, "--motion", plan.motion));
  if (typed.laser && typed.plasma) {
    return fail(bad_option("a laser is no plasma torch", "--laser", "leave one of them out"));
  }
  if (typed.laser) {
    plan.process = CutProcess::kLaser;
    plan.spindle = *typed.laser;
  }
  if (typed.plasma) {
    plan.process = CutProcess::kPlasma;
    plan.pierce_seconds = *typed.plasma;
  }
  const auto count = [](std::optional<long> number, const char* option,
                        auto& into) -> Result<void> {
    if (!number) return {};
    if (*number > kMostCount) {
      return fail(bad_option("that is too many", option, fmt::format("at most {}", kMostCount)));
    }
    into = static_cast<int>(std::max(*number, -1L));  // which `cut` refuses
    return {};
  };
  OBVID_TRY(count(typed.passes, "--passes", plan.passes));
  OBVID_TRY(count(typed.tabs, "--tabs", plan.tabs.count));
  OBVID_TRY(count(typed.decimals, "--decimals", plan.decimals));
  if (typed.start) {
    const auto comma = typed.start->find(',');
    const auto x = typed_number(typed.start->substr(0, comma)),
               y = comma == std::string::npos ? std::nullopt
                                              : typed_number(typed.start->substr(comma + 1));
    if (!x || !y) return fail(bad_option("a place is X,Y", "--start", "for example --start 0,0"));
    plan.start = Vec2{*x, *y};
  }
  return {};
}

}  // namespace obvid
