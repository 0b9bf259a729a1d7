// SPDX-License-Identifier: Apache-2.0
// Forms and proves a contour with nothing but the installed package.
#include <cstdio>

#include "obvid/core/version.h"
#include "obvid/io/read_points.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/import.h"

int main() {
  const auto series = obvid::parse_points("0 0\n1 0\n2 0.2\n3 0.7\n4 1.6\n", "inline");
  if (!series) {
    std::puts(obvid::to_line(series.error()).c_str());
    return 1;
  }
  const auto fit = obvid::fit(*series, {});
  if (!fit) {
    std::puts(obvid::to_line(fit.error()).c_str());
    return 1;
  }
  // formats of other systems link too
  const auto drawing = obvid::export_contour({fit->contour, {}, {}}, obvid::FileFormat::kDxf);
  if (!drawing || obvid::is_drawing("no such file")) return 1;
  std::printf("obvid %s: %zu pieces, %s\n", obvid::kVersion, fit->contour.pieces.size(),
              fit->certificate.proved ? "proved" : fit->certificate.reason.c_str());
  return fit->certificate.proved ? 0 : 1;
}
