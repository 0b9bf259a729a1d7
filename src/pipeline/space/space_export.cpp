// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "obvid/exchange/internal/dxf/space.h"
#include "obvid/pipeline/space_fit.h"

namespace obvid {
namespace {

constexpr std::size_t kSpaceSamples = 200;  // docs/cli.md: --samples
constexpr const char* kSpaceEndings =
    ".json (everything), .step, .iges, .brep, .dxf, .csv (samples), .sldcrv (points)";

Exported one_space_file(std::string text) {
  Exported out;
  out.files.push_back({"", std::move(text)});
  return out;
}

/// Whoever reads points in space draws one smooth curve through them.
Exported points_files(const SpaceChain& chain, std::size_t samples) {
  if (chain.corners.empty()) return one_space_file(space_points_text(chain.parts.front(), samples));
  Exported out;
  for (std::size_t k = 0; k < chain.parts.size(); ++k) {
    out.files.push_back({fmt::format("-{}", k + 1), space_points_text(chain.parts[k], samples)});
  }
  out.remarks.push_back(
      "the points of each part are a file: a curve through all would round corners");
  return out;
}

}  // namespace

Result<Exported> export_space(const SpaceChain& chain, const std::vector<SpaceNurbs>& nurbs,
                              const std::string& ending, const ExportOptions& options) {
  const std::size_t samples = options.samples.count.value_or(kSpaceSamples);
  if (ending == ".json") return one_space_file(space_chain_json(chain, nurbs));
  if (ending == ".csv") return one_space_file(space_samples_csv(chain, samples));
  if (ending == ".sldcrv") return points_files(chain, samples);
  if (ending == ".dxf") {
    std::vector<SpaceCurve> curves;
    for (const SpaceNurbs& one : nurbs) curves.push_back(one.curve);
    return one_space_file(space_dxf(curves, chain.points, chain.units));
  }
  CadWriteOptions write;
  write.units = chain.units.name;
  write.face_width = options.face_width;
  write.format = options.step;
  const bool step = ending == ".step" || ending == ".stp";
  const bool iges = ending == ".iges" || ending == ".igs";
  if (iges) write.format = CadFormat::kIges;
  if (ending == ".brep") write.format = CadFormat::kBrep;
  if (step || iges || ending == ".brep") {
    std::vector<CadCurve> curves;
    for (std::size_t k = 0; k < nurbs.size(); ++k) {
      const bool one = nurbs.size() == 1;
      curves.push_back({one ? "contour" : fmt::format("contour, part {}", k + 1), nurbs[k].curve});
    }
    auto text = cad_text(curves, write);
    if (!text) return fail(text.error());
    return one_space_file(std::move(*text));
  }
  return fail({ErrorCode::kUnknownFormat, "no file with this extension holds a curve in space", "",
               std::string("possible are ") + kSpaceEndings +
                   "; --flat forms the contour in the plane of x and y"});
}

}  // namespace obvid
