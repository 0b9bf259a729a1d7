// SPDX-License-Identifier: Apache-2.0
#include "read_faces.h"

#include <fmt/format.h>

#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <filesystem>
#include <map>
#include <utility>

#include "face_surface.h"
#include "load.h"
#include "obvid/core/internal/figures.h"

namespace obvid::cad {
namespace {

/// Faces that are looked at; a model with more is no surface to work on here.
constexpr std::size_t kMostReadFaces = 20000;

FaceSurface surface_or_reason(const TopoDS_Face& face) {
  try {
    return surface_of(face);
  } catch (const Standard_Failure& failure) {
    FaceSurface out;
    out.refused = std::string("is refused by the CAD kernel: ") + failure.GetMessageString();
    return out;
  }
}

/// Files may call all faces the same: the warnings say which one it is. Whether it was taken.
bool add_face(const TopoDS_Face& face, std::size_t number, const std::string& given,
              CadSurfaces& out) {
  FaceSurface made = surface_or_reason(face);
  const std::string plain = fmt::format("face {}", number);
  const std::string name = given.empty() ? plain : fmt::format("{} ({})", plain, given);
  if (!made.surface) {
    out.warnings.push_back(fmt::format("{} was left out: it {}", name, made.refused));
    return false;
  }
  if (made.trimmed && made.trims.empty()) {
    out.warnings.push_back(name +
                           " is trimmed in a way that is not understood: the whole box of its "
                           "parameters was taken");
  }
  if (made.deviation > 0.0) {
    out.warnings.push_back(fmt::format("{} is an offset, approximated within {} mm", name,
                                       significant_above(made.deviation, kDigitsOfBounds)));
  }
  out.model.patches.push_back({given.empty() ? plain : given, *std::move(made.surface),
                               std::move(made.trims), made.trims_within});
  return true;
}

/// Patches that share their name get the number of their face, so that reports can name each.
void tell_apart(std::vector<SurfacePatch>& patches, const std::vector<std::size_t>& numbers) {
  std::map<std::string, std::size_t> uses;
  for (const SurfacePatch& patch : patches) ++uses[patch.name];
  for (std::size_t i = 0; i < patches.size(); ++i) {
    std::string& name = patches[i].name;
    if (uses[name] > 1) name += fmt::format(", face {}", numbers[i]);
  }
}

void collect(const Loaded& loaded, CadSurfaces& out) {
  TopTools_MapOfShape seen;
  std::size_t number = 0;
  std::vector<std::size_t> taken;
  for (TopExp_Explorer e(loaded.shape, TopAbs_FACE); e.More(); e.Next()) {
    if (!seen.Add(e.Current())) continue;
    if (++number > kMostReadFaces) continue;
    const TopoDS_Face& face = TopoDS::Face(e.Current());
    if (add_face(face, number, loaded.name_of(face), out)) taken.push_back(number);
  }
  tell_apart(out.model.patches, taken);
  if (number > kMostReadFaces) {
    out.warnings.push_back(fmt::format("{} faces beyond the first {} were not looked at",
                                       number - kMostReadFaces, kMostReadFaces));
  }
}

}  // namespace

Result<CadSurfaces> read_faces(const std::string& path) {
  const auto loaded = load(path);
  OBVID_TRY(loaded);
  CadSurfaces out;
  out.model.name = std::filesystem::path(path).stem().string();
  out.model.units = loaded->units;
  if (!loaded->shape.IsNull()) collect(*loaded, out);
  if (out.model.patches.empty()) {
    std::string what = "the file holds no faces";
    if (!out.warnings.empty()) what += " that could be taken: " + out.warnings.front();
    return error(ErrorCode::kNothingThere, what).where(path).hint("export surfaces or a solid");
  }
  return out;
}

}  // namespace obvid::cad
