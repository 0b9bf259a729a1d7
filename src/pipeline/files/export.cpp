// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "advice/uniform_tolerance.h"
#include "files/file_units.h"
#include "files/format_writers.h"
#include "obvid/contour/bsplines/nurbs_of.h"
#include "obvid/core/internal/figures.h"
#include "obvid/core/units.h"
#include "obvid/exchange/internal/points/solidworks.h"
#include "obvid/exchange/internal/road/landxml.h"
#include "obvid/exchange/internal/road/opendrive.h"
#include "obvid/exchange/internal/svg/drawing.h"
#include "obvid/exchange/internal/whole_arcs.h"
#include "obvid/io/contour_json.h"
#include "obvid/picture/picture_svg.h"
#include "obvid/pipeline/internal/airfoil_file.h"
#include "obvid/pipeline/internal/can_write.h"
#include "obvid/series/analysis.h"
#include "verify/report.h"

namespace obvid {
namespace pipeline_detail {
namespace {

/// A bound as it is printed: three digits, and never less than it is.
double at_most(double bound) { return printable(bound); }

/// Tolerance of curves that a format cannot hold, of the size.
constexpr double kExportTolerance = 1e-6;
constexpr double kDefaultForArcs = 2e-5;  // the same for arcs, which need more blocks
constexpr double kFairNose = 1e-4;        // chords: a tolerance that is advised for noses
constexpr double kLeastForGcode = 2e-3;   // mm: what the printed digits keep well

Exported one_file(std::string text) { return {{{"", std::move(text)}}, {}, {}}; }

std::vector<Vec2> places_of(const Contour& contour) {
  std::vector<Vec2> out = contour.points;
  for (const Piece& piece : contour.pieces) {
    for (const double t : {0.0, 0.5, 1.0}) out.push_back(evaluate(piece, t).point);
  }
  return out;
}

Result<Exported> one_text(Result<std::string> made) {
  OBVID_TRY(made);
  return one_file(std::move(*made));
}

/// What is written, with what is to be said of its units: where they are refused, nothing is.
template <class Make>
Result<Exported> with_units(const ContourExport& e, FileFormat format, const Make& make) {
  auto notes = unit_notes(e.contour.units, format);
  OBVID_TRY(notes);
  Result<Exported> out = make();
  if (!out) return out;
  for (std::string& one : notes->remarks) out->remarks.push_back(std::move(one));
  out->warnings.insert(out->warnings.end(), notes->warnings.begin(), notes->warnings.end());
  return out;
}

bool only_lines_and_arcs(const ContourExport& e) {
  return std::all_of(e.contour.pieces.begin(), e.contour.pieces.end(), [](const Piece& piece) {
    return std::holds_alternative<LinePiece>(piece) || std::holds_alternative<ArcPiece>(piece);
  });
}

Result<Exported> cad_file(const ContourExport& e, CadFormat format) {
  const auto held = kernel_holds(e.size, e.contour.units, format == CadFormat::kBrep, "write .dxf");
  OBVID_TRY(held);
  Exported out;
  auto made = cad_curve(e);
  OBVID_TRY(made);
  CadCurve& curve = made->curve;
  if (made->deviation > 0.0) {
    out.remarks.push_back(
        fmt::format("clothoids are no NURBS curves: a C2 cubic follows them within {:.3g} {}",
                    at_most(made->deviation), e.contour.units.text()));
  }
  if (const auto* joined = std::get_if<NurbsCurve>(&curve.geometry)) {
    out.remarks.push_back(fmt::format("one NURBS curve of degree {}, {} control points",
                                      joined->degree, joined->points.size()));
  } else if (!made->in_pieces.empty()) {
    out.remarks.push_back(
        fmt::format("no one NURBS curve, as {}: written piece by piece", made->in_pieces));
  }
  if (std::holds_alternative<std::vector<Piece>>(curve.geometry)) {
    if (auto remark =
            below_kernels(e.contour.pieces, e.contour.units, format == CadFormat::kBrep)) {
      out.remarks.push_back(std::move(*remark));
    }
  }
  CadWriteOptions write;
  write.format = format;
  write.units = e.contour.units.name;
  write.face_width = e.options.face_width;
  auto text = cad_text({curve}, write, {{}, [&e] { return is_to_end(e.watch); }});
  OBVID_TRY(text);
  out.files.push_back({"", std::move(*text)});
  return out;
}

Result<Exported> dxf_file(const ContourExport& e) {
  DxfOptions write;
  write.profile = e.options.dxf;
  const bool arcs = write.profile == DxfProfile::kArcs || write.profile == DxfProfile::kArcsR12;
  write.tolerance = arcs ? e.arc_tolerance : e.tolerance;
  auto made = dxf_text(e.contour, write, e.watch);
  OBVID_TRY(made);
  Exported out = one_file(std::move(made->text));
  const std::string entities =
      fmt::format("{} {}", made->entities, made->entities == 1 ? "entity" : "entities");
  out.remarks.push_back(made->deviation > 0.0
                            ? fmt::format("{}, at most {:.3g} {} from the contour", entities,
                                          at_most(made->deviation), e.contour.units.text())
                            : entities + ", exact");
  return out;
}

/// In units of the contour.
double gcode_tolerance(const ContourExport& e) {
  // 0: refused when it is written
  const double mm = unit_ratio(e.contour.units.name, "mm").value_or(0.0);
  return mm > 0.0 ? std::max(e.arc_tolerance, kLeastForGcode / mm) : e.arc_tolerance;
}

Result<Exported> gcode_file(const ContourExport& e) {
  GcodeOptions write;
  write.motion = e.options.motion;
  write.controller = e.options.controller;
  write.feed = e.options.feed;
  write.decimals = e.options.decimals;
  write.name = e.options.name;
  write.tolerance = e.options.tolerance ? *e.options.tolerance : gcode_tolerance(e);
  auto made = gcode_text(e.contour, write, e.watch);
  OBVID_TRY(made);
  Exported out = one_file(std::move(made->text));
  out.remarks.push_back(
      fmt::format("{} blocks, {} of them arcs, at most {:.3g} {} from the contour", made->blocks,
                  made->arc_blocks, at_most(made->deviation), e.contour.units.text()));
  return out;
}

Result<Exported> drawing(const ContourExport& e) {
  SvgDrawingOptions write;
  write.tolerance = e.arc_tolerance;
  auto made = svg_drawing(e.contour, write, e.watch);
  OBVID_TRY(made);
  Exported out = one_file(std::move(made->text));
  out.remarks.push_back(fmt::format("true scale, at most {:.3g} {} from the contour",
                                    at_most(made->deviation), e.contour.units.text()));
  return out;
}

SampleOptions samples_of(const ContourExport& e) {
  SampleOptions out = e.options.samples;
  if (!out.count && !out.step && !out.chord_tolerance) out.chord_tolerance = e.arc_tolerance;
  return out;
}

Result<Exported> sldcrv_file(const ContourExport& e) {
  auto made = sldcrv_files(e.contour, samples_of(e), e.watch);
  OBVID_TRY(made);
  Exported out;
  for (SldcrvFile& file : *made) {
    out.files.push_back({std::move(file.suffix), std::move(file.text)});
  }
  if (out.files.size() > 1) {
    out.remarks.push_back(
        fmt::format("{} files, one per run: insert each as a curve of its own", out.files.size()));
  }
  return out;
}

/// What was done to the points, and how it is undone.
std::string unit_chord_remark(const AirfoilFigures& f, const std::optional<RoundedEdge>& edge) {
  const double turn = (f.turn + (edge ? edge->turn : 0.0)) / kOneDegree;
  return fmt::format(
      "scaled to unit chord, turned by {:.6f} degrees; undone by --scale {} --rotate {} --move "
      "{},{}",
      0.0 - turn, f.chord, turn, f.leading_edge.x, f.leading_edge.y);
}

constexpr double kPrintedChords = 5e-6;  ///< what is less prints as 0.000 %

template <class Figures>
std::string camber_text(const Figures& f) {
  if (std::abs(f.camber) < kPrintedChords) return "camber 0.000 %";
  return fmt::format("camber {:.3f} % at {:.2f} %", 100.0 * f.camber, 100.0 * f.camber_at);
}

template <class Figures>
std::string edge_text(const Figures& f) {
  const double percent = 100.0 * f.trailing_thickness;
  return f.trailing_round ? fmt::format("trailing edge round, {:.3f} % in diameter", percent)
                          : fmt::format("trailing edge {:.3f} % thick", percent);
}

std::string rounded_text(const RoundedEdge& edge) {
  return fmt::format(
      "trailing edge of the file round: an arc of diameter {:.4f} chords to the end of the chord "
      "touches the upper side at {:.3f} % and the lower one at {:.3f} %, {} on it; the "
      "sides were moved apart for it by an amount times (x/chord)^2",
      edge.diameter, 100.0 * edge.upper_from, 100.0 * edge.lower_from,
      counted(edge.points, "point", "points"));
}

/// What a fair nose has not; empty for one.
std::string nose_text(const AirfoilFigures& f) {
  if (f.nose_corner > 0.0) {
    return fmt::format(
        "the nose has a corner of {:.2f} degrees; `obvid fit` with --open --no-corners rounds it",
        f.nose_corner / kOneDegree);
  }
  if (f.nose_turns < 2) return "";
  return fmt::format(
      "the nose is wavy: the curvature turns back {} times within 1 % of the chord; `obvid fit` "
      "with a larger --noise, such as {:.2g}, may make it fair",
      f.nose_turns, kFairNose * f.chord);
}

/// What a trailing edge has whose sides do not end beside each other; empty for others.
std::string trailing_text(const AirfoilText& made, const std::optional<double>& wanted) {
  const double gap = made.closed ? made.closed->gap : made.figures.trailing_gap;
  const char* const side = !made.closed ? "one" : made.closed->upper ? "the upper" : "the lower";
  std::string out = side_ends_text(side, gap);
  if (out.empty()) return out;
  out += ": ";
  if (made.closed && made.closed->left_open.empty()) {
    return out + fmt::format("it goes on straight by {:.3f} %", 100.0 * made.closed->gone_on);
  }
  out += wanted ? "the trailing edge of the file is as far open along the chord"
                : "the thickness of the trailing edge is across the chord alone";
  if (made.closed) out += ", for that side does not go on straight: " + made.closed->left_open;
  return out + "; add that point";
}

/// How a closed trailing edge became one.
std::string closed_text(const ClosedEdge& edge) {
  return fmt::format(
      "trailing edge of the file closed: both sides end at one point, each end moved {:.5f} chords "
      "to it, and what lies before it by that times (x/chord)^2",
      edge.moved);
}

/// What the input says without a curve, beside the figures of the contour.
std::string points_text(const AirfoilPointFigures& f) {
  return fmt::format(
      "input, straight lines between its points, same chord: thickness {:.3f} % at {:.2f} %, {}, "
      "{}; circle through the three points at the nose, up to {:.3f} % apart: radius {:.3f} %",
      100.0 * f.thickness, 100.0 * f.thickness_at, camber_text(f), edge_text(f), 100.0 * f.nose_gap,
      100.0 * f.nose_radius);
}

/// What scaling made of thickness and camber; empty where none was asked for.
std::string scaled_text(const AirfoilText& made, const AirfoilOptions& asked) {
  const AirfoilFigures& f = made.figures;
  std::string what, undo, lost;
  const auto add = [&](const char* name, const char* option, double from, double scale) {
    what += fmt::format("{}{} {:.3f} % -> {:.3f} %", what.empty() ? "" : ", ", name, 100.0 * from,
                        100.0 * scale * from);
    if (scale != 0.0) {
      undo += fmt::format(" {} {}", option, from);
    } else if (from != 0.0) {
      lost += fmt::format("{}{}", lost.empty() ? "" : " and ", name);
    }
  };
  if (asked.thickness) add("thickness", "--thickness", f.thickness, made.thickness_scale);
  if (asked.camber) add("camber", "--camber", f.camber, made.camber_scale);
  if (what.empty()) return {};
  std::string out =
      "scaled normal to the chord, the distance of both sides or their middle at each place by one "
      "factor: " +
      what;
  if (asked.thickness) {
    out += fmt::format("; leading edge radius {:.3f} % -> {:.3f} %", 100.0 * f.nose_radius,
                       100.0 * made.thickness_scale * made.thickness_scale * f.nose_radius);
  }
  if (!undo.empty()) out += (lost.empty() ? "; undone by" : "; the thickness is undone by") + undo;
  if (!lost.empty()) out += "; " + lost + " cannot be undone: of 0 no factor brings it back";
  return out;
}

Result<Exported> airfoil_file(const ContourExport& e) {
  AirfoilOptions write = e.options.airfoil;
  write.name = e.options.picture.name.empty() ? e.options.name : e.options.picture.name;
  if (!e.stored.name.empty()) write.name = e.stored.name;  // the file has it, not its own name
  if (e.options.samples.count) write.count = *e.options.samples.count;
  auto made = airfoil_text(e.contour, write);
  OBVID_TRY(made);
  Exported out = one_file(std::move(made->text));
  const AirfoilFigures& f = made->figures;
  out.remarks.push_back(fmt::format("{} points, {} on the upper and {} on the lower side",
                                    write.count, made->upper, made->lower));
  if (write.unit_chord) out.remarks.push_back(unit_chord_remark(f, made->rounded));
  if (auto told = scaled_text(*made, write); !told.empty()) out.remarks.push_back(std::move(told));
  if (made->rounded) {
    out.remarks.push_back(rounded_text(*made->rounded));
  } else if (made->closed && made->closed->left_open.empty()) {
    out.remarks.push_back(closed_text(*made->closed));
  } else if (write.trailing_thickness) {
    out.remarks.push_back(
        fmt::format("trailing edge of the file {:.4f} chords thick: sides moved apart by the "
                    "difference times (x/chord)^2",
                    *write.trailing_thickness));
  }
  if (auto file = figures_of_airfoil_file(out.files.front().text)) {
    if (made->rounded) {  // as few as its points may be
      file->trailing_round = true;
      file->trailing_thickness = made->rounded->diameter;
    }
    out.remarks.push_back(fmt::format(
        "the file, straight lines between its points: thickness {:.3f} % at {:.2f} %, {}, {}",
        100.0 * file->thickness, 100.0 * file->thickness_at, camber_text(*file), edge_text(*file)));
  }
  const bool longer = made->closed && made->closed->gone_on > kPrintedChords;
  const char* measured = longer ? "contour with the side that goes on" : "contour";
  out.remarks.push_back(fmt::format("{}, normal to its chord: thickness {:.3f} % at {:.2f} %, {}",
                                    measured, 100.0 * f.thickness, 100.0 * f.thickness_at,
                                    camber_text(f)));
  out.remarks.push_back(fmt::format(
      "{}: leading edge radius {:.3f} %, {}{}; % of the chord {:.6g} {}", measured,
      100.0 * f.nose_radius, edge_text(f),
      f.trailing_round ? "" : fmt::format(", {:.2f} degrees", f.trailing_angle / kOneDegree),
      f.chord, e.contour.units.text()));
  if (const std::string told = nose_text(f); !told.empty()) out.warnings.push_back(told);
  if (auto told = trailing_text(*made, write.trailing_thickness); !told.empty()) {
    out.warnings.push_back(std::move(told));
  }
  if (const auto input = airfoil_point_figures(airfoil_points_around(e.contour, f), f)) {
    out.remarks.push_back(points_text(*input));
  }
  return out;
}

/// Whether a name was given.
bool is_named(const ExportOptions& options) { return options.name != ExportOptions{}.name; }

/// Whether there is anything that a file of the curve alone would not say.
bool is_said(const StoredAlignment& one) {
  return one.first_station != 0.0 || !one.transitions.empty() || one.profile;
}

/// What the file of the contour says where nothing else was asked for.
ExportOptions with_stored(const ExportOptions& asked, const StoredContour& stored) {
  ExportOptions out = asked;
  if (!is_named(out) && !stored.name.empty()) out.name = stored.name;
  if (!stored.alignment || is_said({out.first_station, out.transitions, out.profile})) return out;
  out.first_station = stored.alignment->first_station;
  out.transitions = stored.alignment->transitions;
  out.profile = stored.alignment->profile;
  return out;
}

/// Elements that LandXML has in parts.
void tell_of_parts(const ContourExport& e, std::string_view text,
                   std::vector<std::string>& remarks) {
  const std::size_t elements =
      elements_in(exchange::whole_arcs(e.contour.pieces).size(), e.options.transitions);
  std::size_t written = 0;
  for (const std::string_view tag : {"<Line ", "<Curve ", "<Spiral "}) {
    for (auto at = text.find(tag); at != text.npos; at = text.find(tag, at + 1)) ++written;
  }
  if (written <= elements) return;
  remarks.push_back(
      fmt::format("{} for {} of the curve: arcs of more than half a turn, and spirals that turn by "
                  "more than 150 "
                  "degrees or pass an inflection, are in parts there",
                  counted(written, "element", "elements"), elements));
}

/// What is written flat.
std::string without_profile(const VerticalProfile& profile) {
  double low = profile.end_height, high = profile.end_height;
  for (const ProfileElement& one : profile.elements) {
    low = std::min(low, one.height);
    high = std::max(high, one.height);
  }
  return fmt::format(
      "flat: the profile of {} ({:.6g} to {:.6g} high at its joints and ends) is in "
      ".xml, .xodr and .json alone",
      counted(profile.elements.size(), "element", "elements"), low, high);
}

/// The curve's name, else that of the file that it was formed from.
std::string name_of_road(const ExportOptions& options) {
  const std::string file = std::filesystem::path(options.picture.name).stem().string();
  return !is_named(options) && !file.empty() ? file : options.name;
}

}  // namespace

Result<void> can_plot(const ContourExport& e) {
  const std::vector<double>& tolerance = e.contour.point_tolerance;
  const bool any =
      std::any_of(tolerance.begin(), tolerance.end(), [](double t) { return t > 0.0; });
  if (!e.options.plots.deviations || e.options.plots.allowed > 0.0 || any) return {};
  return error(ErrorCode::kBadOption, "no point has a tolerance that it could deviate by")
      .where("--plot")
      .hint(
          "measured points have one with --noise; for others take --plot curvature, or say what "
          "they may deviate by: --plot deviations:LENGTH");
}

Result<MadeCadCurve> cad_curve(const ContourExport& e) {
  MadeCadCurve out{{e.options.name, e.contour.pieces}};
  if (only_lines_and_arcs(e)) return out;
  auto made = nurbs_of(e.contour, {true, e.tolerance}, e.watch);
  if (!made && made.error().code == ErrorCode::kNotProved) {
    out.in_pieces = made.error().what;
    return out;
  }
  OBVID_TRY(made);
  out.deviation = made->deviation;
  out.curve.geometry = std::move(made->curve);
  return out;
}

ContourExport contour_export(const StoredContour& stored, const ExportOptions& options,
                             Watch* watch) {
  const double size = bounding_diagonal(places_of(stored.contour));
  return {stored,
          stored.contour,
          options,
          size,
          options.tolerance.value_or(kExportTolerance * size),
          options.tolerance.value_or(kDefaultForArcs * size),
          watch};
}

Result<Exported> contour_as_json(const ContourExport& e) {
  StoredContour stored = e.stored;
  if (is_named(e.options)) stored.name = e.options.name;
  StoredAlignment own{e.options.first_station, e.options.transitions, e.options.profile};
  stored.alignment.reset();
  if (is_said(own)) stored.alignment = std::move(own);
  return one_text(contour_to_json(stored, e.watch));
}

/// A picture for a report, or a drawing in true scale.
Result<Exported> contour_as_svg(const ContourExport& e) {
  if (!e.options.drawing) {
    OBVID_TRY(can_plot(e));
    return one_text(picture_svg(e.stored, e.options.picture, e.options.plots, e.watch));
  }
  return with_units(e, FileFormat::kPicture, [&] { return drawing(e); });
}

Result<Exported> contour_as_step(const ContourExport& e) {
  return with_units(e, FileFormat::kStep, [&] { return cad_file(e, e.options.step); });
}

Result<Exported> contour_as_iges(const ContourExport& e) {
  return with_units(e, FileFormat::kIges, [&] { return cad_file(e, CadFormat::kIges); });
}

Result<Exported> contour_as_brep(const ContourExport& e) {
  return with_units(e, FileFormat::kBrep, [&] { return cad_file(e, CadFormat::kBrep); });
}

Result<Exported> contour_as_dxf(const ContourExport& e) {
  return with_units(e, FileFormat::kDxf, [&] { return dxf_file(e); });
}

Result<Exported> contour_as_gcode(const ContourExport& e) {
  return with_units(e, FileFormat::kGcode, [&] { return gcode_file(e); });
}

Result<Exported> contour_as_opendrive(const ContourExport& e) {
  OpenDriveOptions road;
  road.name = name_of_road(e.options);
  road.first_station = e.options.first_station;
  road.profile = e.options.profile;
  road.tolerance = e.tolerance;
  auto out = with_units(e, FileFormat::kOpenDrive,
                        [&] { return one_text(opendrive_text(e.contour, road)); });
  if (out && road.first_station != 0.0) {
    const double metres = road.first_station * metres_in(e.contour.units.name).value_or(1.0);
    out->remarks.push_back(
        fmt::format("stations in OpenDRIVE begin at 0: {:.10g} m has to be added to them", metres));
  }
  return out;
}

Result<Exported> contour_as_landxml(const ContourExport& e) {
  LandXmlOptions road;
  road.name = name_of_road(e.options);
  road.profile = e.options.profile;
  road.transitions = e.options.transitions;
  road.first_station = e.options.first_station;
  auto out =
      with_units(e, FileFormat::kLandXml, [&] { return one_text(landxml_text(e.contour, road)); });
  if (out) tell_of_parts(e, out->files.front().text, out->remarks);
  return out;
}

Result<Exported> contour_as_samples(const ContourExport& e) {
  return one_text(samples_csv(e.contour, samples_of(e), e.watch));
}

Result<Exported> contour_as_airfoil(const ContourExport& e) { return airfoil_file(e); }

Result<Exported> contour_as_sldcrv(const ContourExport& e) {
  return with_units(e, FileFormat::kSldcrv, [&] { return sldcrv_file(e); });
}

Result<Exported> contour_as_macro(const ContourExport& e) {
  return with_units(e, FileFormat::kMacro,
                    [&] { return one_text(solidworks_macro(e.contour, samples_of(e), e.watch)); });
}

Result<Exported> contour_as_obj(const ContourExport& e) {
  return with_units(e, FileFormat::kObj,
                    [&] { return one_text(obj_text(e.contour, samples_of(e), e.watch)); });
}

Result<Exported> contour_as_ply(const ContourExport& e) {
  return with_units(e, FileFormat::kPly,
                    [&] { return one_text(ply_text(e.contour, samples_of(e), e.watch)); });
}

Result<Exported> contour_as_none(const ContourExport&) { return fail(not_held_by_format()); }

ContourWriter contour_writer_of(FileFormat format) {
  constexpr std::array kWriters = {
#define OBVID_FORMAT(enumerator, endings, contours, ...) &contour_as_##contours,
#include "obvid/pipeline/formats.inc"
#undef OBVID_FORMAT
  };
  return kWriters[static_cast<std::size_t>(format)];
}

}  // namespace pipeline_detail

Result<void> can_write_curves(std::optional<FileFormat> format) {
  const bool of_kernel = format == FileFormat::kIges || format == FileFormat::kBrep;
  return of_kernel ? check_cad() : Result<void>{};
}

Result<Exported> export_contour(const StoredContour& stored, FileFormat format,
                                const ExportOptions& asked, const RunContext& run) {
  using namespace pipeline_detail;
  OBVID_TRY(may_go_on(run));
  OBVID_TRY(can_write_curves(format));
  Watch watch(run);
  const ExportOptions options = with_stored(asked, stored);
  auto made = contour_writer_of(format)(contour_export(stored, options, &watch));
  if (watch.was_cancelled()) return fail(cancelled_error());
  const bool has_heights = format == FileFormat::kLandXml || format == FileFormat::kOpenDrive ||
                           format == FileFormat::kContour;
  if (made && options.profile && !has_heights) {
    made->remarks.push_back(without_profile(*options.profile));
  }
  return made;
}

}  // namespace obvid
