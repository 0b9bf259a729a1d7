// SPDX-License-Identifier: Apache-2.0
// Forms and proves a contour through points, prints what is known about it, and writes its picture.
// usage: fit_points [POINTS [PICTURE.svg]]
#include <cstdio>

#include "obvid/core/files.h"
#include "obvid/io/read_points.h"
#include "obvid/picture/picture_svg.h"
#include "obvid/pipeline/fit.h"

namespace {

int refuse(const obvid::Error& error) {
  std::fprintf(stderr, "%s\n", obvid::to_line(error).c_str());
  return 1;
}

void print(const obvid::Fit& fit) {
  for (std::size_t i = 0; i < fit.report.segments.size(); ++i) {
    const obvid::SegmentReport& s = fit.report.segments[i];
    std::printf("points %zu-%zu: chord %.4g, points-only error %.3g, region width %.2g\n", i + 1,
                i + 2, s.chord, s.points_only_error, s.width);
  }
  std::printf("%zu pieces, %d vertices (at least %d), %d inflections: %s\n",
              fit.contour.pieces.size(), fit.report.vertices, fit.report.vertices_lower_bound,
              fit.report.inflections,
              fit.certificate.proved ? "proved" : fit.certificate.reason.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const auto series = obvid::read_points(argc > 1 ? argv[1] : "series10.csv");
  if (!series) return refuse(series.error());

  obvid::FitJob job;      // every field has a default
  job.tolerance = 0.001;  // largest region width, in the units of the points
  const auto fit = obvid::fit(*series, job);
  if (!fit) return refuse(fit.error());
  print(*fit);

  if (argc > 2) {
    const obvid::StoredContour stored{fit->contour, fit->report, fit->certificate};
    if (const auto written = obvid::write_file(argv[2], obvid::picture_svg(stored)); !written) {
      return refuse(written.error());
    }
  }
  return fit->certificate.proved ? 0 : 1;
}
