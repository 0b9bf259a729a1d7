// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/surface_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "files/file_units.h"
#include "files/format_writers.h"
#include "obvid/core/internal/figures.h"
#include "obvid/core/units.h"
#include "obvid/exchange/internal/mesh/files.h"
#include "obvid/io/surface_json.h"
#include "obvid/pipeline/internal/surface_report_json.h"
#include "surface/longitudinals.h"

namespace obvid {
namespace pipeline_detail {
namespace {

constexpr double kDefaultChordTolerance = 1e-3;  ///< of the size: not seen on a screen
constexpr double kDefaultAngle = 15.0 * kOneDegree;

/// What is written, with what is to be said of its units: where they are refused, nothing is.
template <class Make>
Result<std::string> surface_in_units(SurfaceExport& e, std::vector<std::string>& remarks,
                                     FileFormat format, const Make& make) {
  auto notes = unit_notes(e.model.units, format);
  OBVID_TRY(notes);
  Result<std::string> text = make();
  if (!text) return text;
  for (std::string& one : notes->remarks) remarks.push_back(std::move(one));
  for (std::string& one : notes->warnings) e.warnings.push_back(std::move(one));
  return text;
}

/// How the model is shown, in pictures as on pages.
template <class Looks>
Looks looks_of(SurfaceExport& e) {
  Looks out;
  out.colouring = e.options.colouring;
  out.view = e.options.view;
  out.lines = e.options.lines;
  out.deviation = e.options.deviation;
  out.extremes = e.options.extremes;
  return out;
}

Result<std::string> surface_of_kernel(const SurfaceExport& e, CadFormat format) {
  const auto held = kernel_holds(size_of(e.model), e.model.units, format == CadFormat::kBrep,
                                 "write .json, .obj, .glb or .ply");
  OBVID_TRY(held);
  CadWriteOptions cad;
  cad.units = e.model.units.name;
  cad.format = format;
  return cad_surface_text(e.model, cad, {{}, e.run.cancelled});
}

/// A file made of triangles: `make` is called when they are there, with who is asked meanwhile.
template <class Make>
Result<std::string> of_triangles(SurfaceExport& e, std::vector<std::string>& remarks,
                                 const Make& make) {
  OBVID_TRY(e.tessellate_once(remarks));
  Watch watch(without_progress(e.run));
  return make(watch);
}

}  // namespace

}  // namespace pipeline_detail

Result<void> can_write_surfaces(FileFormat format) {
  const bool of_kernel =
      format == FileFormat::kStep || format == FileFormat::kIges || format == FileFormat::kBrep;
  return of_kernel ? check_cad() : Result<void>{};
}

namespace pipeline_detail {

Result<void> SurfaceExport::find_extremes_once() {
  if (options.extremes || model.patches.empty()) return {};
  auto found = extremes_of(model, run);
  OBVID_TRY(found);
  options.extremes = *found;
  return {};
}

Result<void> SurfaceExport::tessellate_once(std::vector<std::string>& remarks) {
  if (!meshes.empty()) return {};
  TessellationOptions how;
  how.chord_tolerance = options.chord_tolerance.value_or(kDefaultChordTolerance * size_of(model));
  how.angle = options.angle > 0.0 ? options.angle : kDefaultAngle;
  auto made = tessellate(model, how, run);
  OBVID_TRY(made);
  meshes = std::move(*made);
  std::size_t triangles = 0;
  double deviation = 0.0;
  for (const Mesh& mesh : meshes) {
    triangles += mesh.triangles.size();
    deviation = std::max(deviation, mesh.deviation);
  }
  remarks.push_back(fmt::format("{} triangles, at most {} {} off the surface where measured",
                                triangles, significant_above(deviation, kDigitsOfBounds),
                                model.units.text()));
  return {};
}

Result<std::string> surface_as_json(SurfaceExport& e, std::vector<std::string>&) {
  return surface_json(e.model);
}

Result<std::string> surface_as_step(SurfaceExport& e, std::vector<std::string>& remarks) {
  return surface_in_units(e, remarks, FileFormat::kStep,
                          [&] { return surface_of_kernel(e, e.options.step); });
}

Result<std::string> surface_as_iges(SurfaceExport& e, std::vector<std::string>& remarks) {
  return surface_in_units(e, remarks, FileFormat::kIges,
                          [&] { return surface_of_kernel(e, CadFormat::kIges); });
}

Result<std::string> surface_as_brep(SurfaceExport& e, std::vector<std::string>& remarks) {
  return surface_in_units(e, remarks, FileFormat::kBrep,
                          [&] { return surface_of_kernel(e, CadFormat::kBrep); });
}

Result<std::string> surface_as_stl(SurfaceExport& e, std::vector<std::string>& remarks) {
  return surface_in_units(e, remarks, FileFormat::kStl, [&] {
    return of_triangles(e, remarks, [&](Watch& watch) -> Result<std::string> {
      remarks.push_back(fmt::format("STL holds single precision: another {} {}",
                                    significant_above(single_precision_loss(e.meshes), 2),
                                    e.model.units.text()));
      return stl_text(e.model, e.meshes, &watch);
    });
  });
}

Result<std::string> surface_as_obj(SurfaceExport& e, std::vector<std::string>& remarks) {
  return surface_in_units(e, remarks, FileFormat::kObj, [&] {
    return of_triangles(e, remarks,
                        [&](Watch& watch) { return obj_mesh_text(e.model, e.meshes, &watch); });
  });
}

Result<std::string> surface_as_glb(SurfaceExport& e, std::vector<std::string>& remarks) {
  return surface_in_units(e, remarks, FileFormat::kGlb, [&] {
    return of_triangles(e, remarks,
                        [&](Watch& watch) { return glb_text(e.model, e.meshes, &watch); });
  });
}

Result<std::string> surface_as_ply(SurfaceExport& e, std::vector<std::string>& remarks) {
  return surface_in_units(e, remarks, FileFormat::kPly, [&] {
    return of_triangles(e, remarks,
                        [&](Watch& watch) { return ply_text(e.model, e.meshes, &watch); });
  });
}

Result<std::string> surface_as_page(SurfaceExport& e, std::vector<std::string>& remarks) {
  return of_triangles(e, remarks, [&](Watch&) -> Result<std::string> {
    OBVID_TRY(e.find_extremes_once());
    return surface_page(e.model, e.meshes, looks_of<PageOptions>(e), e.run);
  });
}

Result<std::string> surface_as_svg(SurfaceExport& e, std::vector<std::string>&) {
  if (e.options.longitudinals) {
    return longitudinals_of(e.model, e.options.beside_longitudinals, e.run)
        .map([](const LongitudinalsPicture& picture) { return longitudinals_svg(picture); });
  }
  if (is_curvature(e.options.colouring)) OBVID_TRY(e.find_extremes_once());
  return surface_svg(e.model, looks_of<SurfacePictureOptions>(e), e.run);
}

Result<std::string> surface_as_none(SurfaceExport&, std::vector<std::string>&) {
  return fail(not_held_by_format());
}

SurfaceWriter surface_writer_of(FileFormat format) {
  constexpr std::array kWriters = {
#define OBVID_FORMAT(enumerator, endings, contours, surfaces, ...) &surface_as_##surfaces,
#include "obvid/pipeline/formats.inc"
#undef OBVID_FORMAT
  };
  return kWriters[static_cast<std::size_t>(format)];
}

}  // namespace pipeline_detail

SurfaceExporter::SurfaceExporter(const SurfaceModel& model, const SurfaceExportOptions& options,
                                 RunContext run)
    : parts_(new pipeline_detail::SurfaceExport{model, options, std::move(run)}) {}
SurfaceExporter::~SurfaceExporter() = default;

const std::vector<std::string>& SurfaceExporter::warnings() const { return parts_->warnings; }

Result<std::string> SurfaceExporter::text(FileFormat format, std::vector<std::string>& remarks) {
  return pipeline_detail::surface_writer_of(format)(*parts_, remarks);
}

}  // namespace obvid
