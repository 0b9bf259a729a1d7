// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "advice/uniform_tolerance.h"
#include "files/file_units.h"
#include "obvid/contour/bsplines/nurbs_of.h"
#include "obvid/exchange/internal/points/solidworks.h"
#include "obvid/exchange/internal/road/landxml.h"
#include "obvid/exchange/internal/road/opendrive.h"
#include "obvid/exchange/internal/svg/drawing.h"
#include "obvid/io/contour_json.h"
#include "obvid/picture/picture_svg.h"
#include "obvid/series/analysis.h"
#include "verify/report.h"

namespace obvid {
namespace {

/// A bound as it is printed: three digits, and never less than it is.
double at_most(double bound) { return pipeline_detail::printable(bound); }

struct Ending {
  const char* ending;
  FileFormat format;
  const char* what;  ///< empty for a second ending of the format before
};

constexpr std::array kEndings = {
    Ending{".json", FileFormat::kContour, "contour"},
    Ending{".svg", FileFormat::kPicture, "picture"},
    Ending{".step", FileFormat::kStep, "STEP"},
    Ending{".stp", FileFormat::kStep, ""},
    Ending{".iges", FileFormat::kIges, "IGES"},
    Ending{".igs", FileFormat::kIges, ""},
    Ending{".brep", FileFormat::kBrep, "BREP"},
    Ending{".dxf", FileFormat::kDxf, "DXF"},
    Ending{".nc", FileFormat::kGcode, "G-code"},
    Ending{".ngc", FileFormat::kGcode, ""},
    Ending{".gcode", FileFormat::kGcode, ""},
    Ending{".tap", FileFormat::kGcode, ""},
    Ending{".xodr", FileFormat::kOpenDrive, "OpenDRIVE"},
    Ending{".xml", FileFormat::kLandXml, "LandXML"},
    Ending{".csv", FileFormat::kSamples, "samples"},
    Ending{".sldcrv", FileFormat::kSldcrv, "SolidWorks points"},
    Ending{".swb", FileFormat::kMacro, "SolidWorks macro"},
    Ending{".bas", FileFormat::kMacro, ""},
    Ending{".obj", FileFormat::kObj, "OBJ polyline"},
    Ending{".ply", FileFormat::kPly, "PLY polyline"},
};

/// Tolerance of curves that a format cannot hold, of the size.
constexpr double kExportTolerance = 1e-6;
constexpr double kDefaultForArcs = 2e-5;
constexpr double kLeastForGcode = 2e-3;  // mm: what the printed digits keep well

Exported one_file(std::string text) { return {{{"", std::move(text)}}, {}, {}}; }

std::vector<Vec2> places_of(const Contour& contour) {
  std::vector<Vec2> out = contour.points;
  for (const Piece& piece : contour.pieces) {
    for (const double t : {0.0, 0.5, 1.0}) out.push_back(evaluate(piece, t).point);
  }
  return out;
}

class Exporter {
 public:
  Exporter(const StoredContour& stored, const ExportOptions& options)
      : stored_(stored), contour_(stored.contour), options_(options) {
    size_ = bounding_diagonal(places_of(contour_));
    tolerance_ = options.tolerance.value_or(kExportTolerance * size_);
    arc_tolerance_ = options.tolerance.value_or(kDefaultForArcs * size_);
  }

  Result<Exported> run(FileFormat format) {
    auto notes = notes_of(format);
    if (!notes) return fail(notes.error());
    auto out = made(format);
    if (!out) return out;
    for (std::string& one : notes->remarks) out->remarks.push_back(std::move(one));
    out->warnings = std::move(notes->warnings);
    return out;
  }

 private:
  [[nodiscard]] Result<pipeline_detail::UnitNotes> notes_of(FileFormat format) const {
    using pipeline_detail::UnitRule;
    const std::string& name = contour_.units.name;
    const auto notes = [&](UnitRule rule, const char* kind, std::string_view written) {
      return pipeline_detail::unit_notes(contour_.units, rule, kind, written);
    };
    switch (format) {
      case FileFormat::kStep:
        return notes(UnitRule::kLength, "STEP files", cad_unit(name));
      case FileFormat::kIges:
        return notes(UnitRule::kLength, "IGES files", cad_unit(name));
      case FileFormat::kDxf:
        return notes(UnitRule::kStated, "the DXF file", dxf_unit(contour_.units));
      case FileFormat::kGcode:
        return notes(UnitRule::kLength, "machines", name == "in" ? "in" : "mm");
      case FileFormat::kOpenDrive:
        return notes(UnitRule::kRoad, "OpenDRIVE files", "m");
      case FileFormat::kLandXml:
        return notes(UnitRule::kRoad, "LandXML files", landxml_unit(name));
      case FileFormat::kMacro:
        return notes(UnitRule::kLength, "macros of SolidWorks", "m");
      case FileFormat::kPicture:
        if (options_.drawing) return notes(UnitRule::kLength, "drawings in true scale", name);
        break;
      default:
        break;
    }
    return notes(UnitRule::kNone, "", name);
  }

  Result<Exported> made(FileFormat format) {
    switch (format) {
      case FileFormat::kContour:
        return one_file(contour_to_json(stored_));
      case FileFormat::kPicture:
        return options_.drawing ? drawing()
                                : Result<Exported>(one_file(
                                      picture_svg(stored_, options_.picture, options_.plots)));
      case FileFormat::kStep:
        return cad(options_.step);
      case FileFormat::kIges:
        return cad(CadFormat::kIges);
      case FileFormat::kBrep:
        return cad(CadFormat::kBrep);
      case FileFormat::kDxf:
        return dxf();
      case FileFormat::kGcode:
        return gcode();
      case FileFormat::kOpenDrive:
        return text(opendrive_text(contour_, opendrive_options()));
      case FileFormat::kLandXml:
        return text(landxml_text(contour_, landxml_options()));
      case FileFormat::kSamples:
        return text(samples_csv(contour_, samples()));
      case FileFormat::kSldcrv:
        return sldcrv();
      case FileFormat::kMacro:
        return text(solidworks_macro(contour_, samples()));
      case FileFormat::kObj:
        return text(obj_text(contour_, samples()));
      case FileFormat::kPly:
        return text(ply_text(contour_, samples()));
    }
    return fail({ErrorCode::kInternal, "unknown format", "", "", -1, 0.0});
  }

  [[nodiscard]] bool only_lines_and_arcs() const {
    return std::all_of(contour_.pieces.begin(), contour_.pieces.end(), [](const Piece& piece) {
      return std::holds_alternative<LinePiece>(piece) || std::holds_alternative<ArcPiece>(piece);
    });
  }

  Result<NurbsCurve> one_curve(Exported& out) {
    auto made = nurbs_of(contour_, {true, tolerance_});
    if (!made) return fail(made.error());
    if (made->deviation > 0.0) {
      out.remarks.push_back(
          fmt::format("clothoids are no NURBS curves: a C2 cubic follows them within {:.3g} {}",
                      at_most(made->deviation), contour_.units.text()));
    }
    return std::move(made->curve);
  }

  Result<Exported> cad(CadFormat format) {
    const auto held = pipeline_detail::kernel_holds(size_, contour_.units,
                                                    format == CadFormat::kBrep, "write .dxf");
    if (!held) return fail(held.error());
    Exported out;
    CadCurve curve{options_.name, NurbsCurve{}};
    if (only_lines_and_arcs()) {
      curve.geometry = contour_.pieces;
    } else {
      auto joined = one_curve(out);
      if (joined) {
        out.remarks.push_back(fmt::format("one NURBS curve of degree {}, {} control points",
                                          joined->degree, joined->points.size()));
        curve.geometry = std::move(*joined);
      } else if (joined.error().code == ErrorCode::kNotProved) {
        out.remarks.push_back(
            fmt::format("no one NURBS curve, as {}: written piece by piece", joined.error().what));
        curve.geometry = contour_.pieces;
      } else {
        return tl::unexpected(joined.error());
      }
    }
    if (std::holds_alternative<std::vector<Piece>>(curve.geometry)) {
      if (auto remark = pipeline_detail::below_kernels(contour_.pieces, contour_.units,
                                                       format == CadFormat::kBrep)) {
        out.remarks.push_back(std::move(*remark));
      }
    }
    CadWriteOptions write;
    write.format = format;
    write.units = contour_.units.name;
    write.face_width = options_.face_width;
    auto text = cad_text({curve}, write);
    if (!text) return tl::unexpected(text.error());
    out.files.push_back({"", std::move(*text)});
    return out;
  }

  Result<Exported> dxf() {
    DxfOptions write;
    write.profile = options_.dxf;
    const bool arcs = write.profile == DxfProfile::kArcs || write.profile == DxfProfile::kArcsR12;
    write.tolerance = arcs ? arc_tolerance_ : tolerance_;
    auto made = dxf_text(contour_, write);
    if (!made) return tl::unexpected(made.error());
    Exported out = one_file(std::move(made->text));
    const std::string entities =
        fmt::format("{} {}", made->entities, made->entities == 1 ? "entity" : "entities");
    out.remarks.push_back(made->deviation > 0.0
                              ? fmt::format("{}, at most {:.3g} {} from the contour", entities,
                                            at_most(made->deviation), contour_.units.text())
                              : entities + ", exact");
    return out;
  }

  /// In units of the contour.
  [[nodiscard]] double gcode_tolerance() const {
    // 0: refused when it is written
    const double mm = unit_ratio(contour_.units.name, "mm").value_or(0.0);
    return mm > 0.0 ? std::max(arc_tolerance_, kLeastForGcode / mm) : arc_tolerance_;
  }

  Result<Exported> gcode() {
    GcodeOptions write;
    write.motion = options_.motion;
    write.controller = options_.controller;
    write.feed = options_.feed;
    write.name = options_.name;
    write.tolerance = options_.tolerance ? *options_.tolerance : gcode_tolerance();
    auto made = gcode_text(contour_, write);
    if (!made) return tl::unexpected(made.error());
    Exported out = one_file(std::move(made->text));
    out.remarks.push_back(
        fmt::format("{} blocks, {} of them arcs, at most {:.3g} {} from the contour", made->blocks,
                    made->arc_blocks, at_most(made->deviation), contour_.units.text()));
    return out;
  }

  Result<Exported> drawing() {
    SvgDrawingOptions write;
    write.tolerance = arc_tolerance_;
    auto made = svg_drawing(contour_, write);
    if (!made) return tl::unexpected(made.error());
    Exported out = one_file(std::move(made->text));
    out.remarks.push_back(fmt::format("true scale, at most {:.3g} {} from the contour",
                                      at_most(made->deviation), contour_.units.text()));
    return out;
  }

  static Result<Exported> text(Result<std::string> made) {
    if (!made) return tl::unexpected(made.error());
    return one_file(std::move(*made));
  }

  [[nodiscard]] OpenDriveOptions opendrive_options() const {
    OpenDriveOptions out;
    out.name = options_.name;
    return out;
  }
  [[nodiscard]] LandXmlOptions landxml_options() const {
    LandXmlOptions out;
    out.name = options_.name;
    return out;
  }

  [[nodiscard]] SampleOptions samples() const {
    SampleOptions out = options_.samples;
    if (!out.count && !out.step && !out.chord_tolerance) out.chord_tolerance = arc_tolerance_;
    return out;
  }

  Result<Exported> sldcrv() {
    auto made = sldcrv_files(contour_, samples());
    if (!made) return tl::unexpected(made.error());
    Exported out;
    for (SldcrvFile& file : *made) {
      out.files.push_back({std::move(file.suffix), std::move(file.text)});
    }
    if (out.files.size() > 1) {
      out.remarks.push_back(fmt::format("{} files, one per run: insert each as a curve of its own",
                                        out.files.size()));
    }
    return out;
  }

  const StoredContour& stored_;
  const Contour& contour_;
  const ExportOptions& options_;
  double size_ = 0.0, tolerance_ = 0.0, arc_tolerance_ = 0.0;
};

}  // namespace

std::optional<FileFormat> format_of(std::string_view path) {
  std::string lower(path);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Ending& one : kEndings) {
    if (lower.ends_with(one.ending)) return one.format;
  }
  return std::nullopt;
}

std::string known_endings() {
  std::string out;
  for (const Ending& one : kEndings) {
    if (*one.what == '\0') continue;
    out += fmt::format("{}{} ({})", out.empty() ? "" : ", ", one.ending, one.what);
  }
  return out;
}

Result<Exported> export_contour(const StoredContour& stored, FileFormat format,
                                const ExportOptions& options) {
  return Exporter(stored, options).run(format);
}

}  // namespace obvid
