// SPDX-License-Identifier: Apache-2.0
// A surface through section contours, and what it promises of them.
#include <fmt/format.h>

#include "obvid/core/files.h"
#include "obvid/io/read_sections.h"
#include "obvid/io/surface_json.h"
#include "obvid/pipeline/skin_sections.h"

int main() {
  const auto sections = obvid::read_sections({"surfaces/wigley_stations.csv"});
  if (!sections) {
    fmt::print("{}\n", obvid::to_line(sections.error()));
    return obvid::exit_code(sections.error().code);
  }
  obvid::SkinJob job;
  job.units = "m";
  const auto made = obvid::fit_skin(*sections, job);
  if (!made) {
    fmt::print("{}\n", obvid::to_line(made.error()));
    return obvid::exit_code(made.error().code);
  }
  for (const obvid::SkinSectionReport& section : made->skin.sections) {
    fmt::print("{:<10} {:.2g} m from its contour, {} against its run\n", section.name,
               section.deviation,
               section.ripple > 0.0 ? fmt::format("{:.2g}", section.ripple) : "nothing");
  }
  const obvid::NurbsSurface& hull = made->skin.patches.front().surface;
  const obvid::SurfaceCurvature k = obvid::curvature(obvid::evaluate(hull, 0.5, 0.5));
  fmt::print("amidships: Gaussian curvature {:.4f} 1/m^2, mean {:.4f} 1/m\n", k.gaussian, k.mean);
  // every contour has to be proved for this example to end well
  return made->proved == sections->size() ? 0 : 1;
}
