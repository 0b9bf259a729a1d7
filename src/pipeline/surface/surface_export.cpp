// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/surface_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <numbers>
#include <utility>

#include "files/file_units.h"
#include "obvid/exchange/internal/mesh/files.h"
#include "obvid/io/surface_json.h"
#include "obvid/pipeline/internal/surface_report_json.h"

namespace obvid {
namespace {

struct SurfaceEnding {
  const char* ending;
  SurfaceFormat format;
  const char* what;  ///< empty for a second ending of the format before
};

constexpr std::array kSurfaceEndings = {
    SurfaceEnding{".json", SurfaceFormat::kSurface, "surface"},
    SurfaceEnding{".step", SurfaceFormat::kStep, "STEP"},
    SurfaceEnding{".stp", SurfaceFormat::kStep, ""},
    SurfaceEnding{".iges", SurfaceFormat::kIges, "IGES"},
    SurfaceEnding{".igs", SurfaceFormat::kIges, ""},
    SurfaceEnding{".brep", SurfaceFormat::kBrep, "BREP"},
    SurfaceEnding{".stl", SurfaceFormat::kStl, "STL triangles"},
    SurfaceEnding{".obj", SurfaceFormat::kObj, "OBJ triangles"},
    SurfaceEnding{".glb", SurfaceFormat::kGlb, "glTF"},
    SurfaceEnding{".ply", SurfaceFormat::kPly, "PLY triangles"},
    SurfaceEnding{".html", SurfaceFormat::kPage, "page for browsers"},
    SurfaceEnding{".svg", SurfaceFormat::kPicture, "picture"},
};

constexpr double kDefaultChordTolerance = 1e-3;  ///< of the size: not seen on a screen
constexpr double kDefaultAngle = 15.0 * std::numbers::pi / 180.0;

}  // namespace

std::optional<SurfaceFormat> surface_format_of(std::string_view path) {
  std::string lower(path);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const SurfaceEnding& ending : kSurfaceEndings) {
    if (lower.ends_with(ending.ending)) return ending.format;
  }
  return std::nullopt;
}

std::string known_surface_endings() {
  std::string all;
  for (const SurfaceEnding& ending : kSurfaceEndings) {
    if (*ending.what == '\0') continue;
    all += fmt::format("{}{} ({})", all.empty() ? "" : ", ", ending.ending, ending.what);
  }
  return all;
}

SurfaceExporter::SurfaceExporter(const SurfaceModel& model, const SurfaceExportOptions& options,
                                 RunContext run)
    : model_(model), options_(options), run_(std::move(run)) {}

const std::optional<CurvatureExtremes>& SurfaceExporter::extremes() {
  if (!options_.extremes && !model_.patches.empty()) options_.extremes = extremes_of(model_);
  return options_.extremes;
}

Result<void> SurfaceExporter::tessellated(std::vector<std::string>& remarks) {
  if (!meshes_.empty()) return {};
  TessellationOptions options;
  options.chord_tolerance =
      options_.chord_tolerance.value_or(kDefaultChordTolerance * size_of(model_));
  options.angle = options_.angle > 0.0 ? options_.angle : kDefaultAngle;
  auto made = tessellate(model_, options, run_);
  if (!made) return fail(made.error());
  meshes_ = std::move(*made);
  std::size_t triangles = 0;
  double deviation = 0.0;
  for (const Mesh& mesh : meshes_) {
    triangles += mesh.triangles.size();
    deviation = std::max(deviation, mesh.deviation);
  }
  remarks.push_back(fmt::format("{} triangles within {:.3g} {} of the surface", triangles,
                                deviation, model_.units.text()));
  return {};
}

Result<std::string> SurfaceExporter::text(SurfaceFormat format, std::vector<std::string>& remarks) {
  const bool step = format == SurfaceFormat::kStep, glb = format == SurfaceFormat::kGlb;
  const bool length = step || glb || format == SurfaceFormat::kIges;
  auto notes = pipeline_detail::unit_notes(
      model_.units, length ? pipeline_detail::UnitRule::kLength : pipeline_detail::UnitRule::kNone,
      step  ? "STEP files"
      : glb ? "glTF files"
            : "IGES files",
      glb ? "m" : cad_unit(model_.units.name));
  if (!notes) return fail(notes.error());
  auto text = made(format, remarks);
  if (!text) return text;
  for (std::string& one : notes->remarks) remarks.push_back(std::move(one));
  for (std::string& one : notes->warnings) warnings_.push_back(std::move(one));
  return text;
}

Result<std::string> SurfaceExporter::made(SurfaceFormat format, std::vector<std::string>& remarks) {
  const bool kernel = format == SurfaceFormat::kStep || format == SurfaceFormat::kIges ||
                      format == SurfaceFormat::kBrep;
  const bool brep = format == SurfaceFormat::kBrep;
  if (kernel) {
    const auto held = pipeline_detail::kernel_holds(size_of(model_), model_.units, brep,
                                                    "write .json, .obj, .glb or .ply");
    if (!held) return fail(held.error());
  }
  const bool triangles = format == SurfaceFormat::kStl || format == SurfaceFormat::kObj ||
                         format == SurfaceFormat::kGlb || format == SurfaceFormat::kPly ||
                         format == SurfaceFormat::kPage;
  if (triangles) {
    if (auto done = tessellated(remarks); !done) return fail(done.error());
  }
  CadWriteOptions cad;
  cad.units = model_.units.name;
  switch (format) {
    case SurfaceFormat::kSurface:
      return surface_json(model_);
    case SurfaceFormat::kStep:
      cad.format = options_.step;
      return cad_surface_text(model_, cad);
    case SurfaceFormat::kIges:
      cad.format = CadFormat::kIges;
      return cad_surface_text(model_, cad);
    case SurfaceFormat::kBrep:
      cad.format = CadFormat::kBrep;
      return cad_surface_text(model_, cad);
    case SurfaceFormat::kStl:
      remarks.push_back(fmt::format("STL holds single precision: another {:.2g} {}",
                                    single_precision_loss(meshes_), model_.units.text()));
      return stl_text(model_, meshes_);
    case SurfaceFormat::kObj:
      return obj_mesh_text(model_, meshes_);
    case SurfaceFormat::kGlb:
      return glb_text(model_, meshes_);
    case SurfaceFormat::kPly:
      return ply_text(model_, meshes_);
    case SurfaceFormat::kPage: {
      PageOptions page;
      page.colouring = options_.colouring;
      page.view = options_.view;
      page.lines = options_.lines;
      page.extremes = extremes();
      return surface_page(model_, meshes_, page, run_);
    }
    case SurfaceFormat::kPicture: {
      SurfacePictureOptions picture;
      picture.colouring = options_.colouring;
      picture.view = options_.view;
      picture.lines = options_.lines;
      picture.extremes = extremes();
      return surface_svg(model_, picture);
    }
  }
  return fail({ErrorCode::kInternal, "unknown format", "", "", -1, 0.0});
}

}  // namespace obvid
