// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <utility>

#include "files/format_writers.h"
#include "obvid/exchange/internal/dxf/space.h"
#include "obvid/pipeline/space_fit.h"

namespace obvid {
namespace pipeline_detail {
namespace {

constexpr std::size_t kSpaceSamples = 200;  // docs/cli.md: --samples

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

std::size_t samples_in_space(const SpaceExport& e) {
  return e.options.samples.count.value_or(kSpaceSamples);
}

Result<Exported> space_of_kernel(const SpaceExport& e, CadFormat format) {
  CadWriteOptions write;
  write.units = e.chain.units.name;
  write.face_width = e.options.face_width;
  write.format = format;
  std::vector<CadCurve> curves;
  for (std::size_t k = 0; k < e.nurbs.size(); ++k) {
    const bool one = e.nurbs.size() == 1;
    curves.push_back({one ? "contour" : fmt::format("contour, part {}", k + 1), e.nurbs[k].curve});
  }
  auto text = cad_text(curves, write, {{}, e.run.cancelled});
  OBVID_TRY(text);
  return one_space_file(std::move(*text));
}

}  // namespace

Result<Exported> space_as_json(const SpaceExport& e) {
  return one_space_file(space_chain_json(e.chain, e.nurbs));
}
Result<Exported> space_as_samples(const SpaceExport& e) {
  return one_space_file(space_samples_csv(e.chain, samples_in_space(e)));
}
Result<Exported> space_as_sldcrv(const SpaceExport& e) {
  return points_files(e.chain, samples_in_space(e));
}
Result<Exported> space_as_dxf(const SpaceExport& e) {
  std::vector<SpaceCurve> curves;
  for (const SpaceNurbs& one : e.nurbs) curves.push_back(one.curve);
  return one_space_file(space_dxf(curves, e.chain.points, e.chain.units));
}
Result<Exported> space_as_step(const SpaceExport& e) { return space_of_kernel(e, e.options.step); }
Result<Exported> space_as_iges(const SpaceExport& e) {
  return space_of_kernel(e, CadFormat::kIges);
}
Result<Exported> space_as_brep(const SpaceExport& e) {
  return space_of_kernel(e, CadFormat::kBrep);
}

Result<Exported> space_as_none(const SpaceExport&) { return fail(not_held_by_format()); }

SpaceWriter space_writer_of(FileFormat format) {
  constexpr std::array kWriters = {
#define OBVID_FORMAT(enumerator, endings, contours, surfaces, curves, ...) &space_as_##curves,
#include "obvid/pipeline/formats.inc"
#undef OBVID_FORMAT
  };
  return kWriters[static_cast<std::size_t>(format)];
}

}  // namespace pipeline_detail

Result<Exported> export_space(const SpaceChain& chain, const std::vector<SpaceNurbs>& nurbs,
                              const std::string& ending, const ExportOptions& options,
                              const RunContext& run) {
  const auto format = space_format_of(ending);
  if (format) return pipeline_detail::space_writer_of(*format)({chain, nurbs, options, run});
  return error(ErrorCode::kUnknownFormat, "no file with this extension holds a curve in space")
      .hint("possible are " + known_space_endings() +
            "; --flat forms the contour in the plane of x and y");
}

}  // namespace obvid
