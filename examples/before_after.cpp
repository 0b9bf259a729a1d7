// SPDX-License-Identifier: Apache-2.0
// What noise does to curvature: fits a series exactly and within a tolerance, and draws both.
// usage: before_after [POINTS [TOLERANCE|rounding [PICTURE.svg]]]   (default: series10.csv, 0.2)
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "obvid/io/read_points.h"
#include "obvid/picture/picture_svg.h"
#include "obvid/pipeline/fit.h"

int main(int argc, char** argv) {
  const std::string path = argc > 1 ? argv[1] : "series10.csv";
  const std::string noise = argc > 2 ? argv[2] : "0.2";
  const auto series = obvid::read_points(path);
  if (!series) {
    std::fprintf(stderr, "%s\n", obvid::to_line(series.error()).c_str());
    return 1;
  }
  obvid::FitJob job;
  const auto before = obvid::fit(*series, job);
  if (noise == "rounding") {
    job.noise_from_rounding = true;
  } else {
    job.noise = std::atof(noise.c_str());
  }
  const auto after = obvid::fit(*series, job);
  for (const auto* fit : {&before, &after}) {
    if (*fit) continue;
    std::fprintf(stderr, "%s\n", obvid::to_line(fit->error()).c_str());
    return 1;
  }
  std::printf("through the points: %d vertices; within %s: %d, at least %d\n",
              before->certificate.vertices, noise.c_str(), after->certificate.vertices,
              after->report.vertices_lower_bound);
  if (argc > 3) {
    const std::string what = noise == "rounding" ? "half a unit of the last digit" : noise;
    std::ofstream(argv[3]) << obvid::comparison_svg(
        before->contour, after->contour,
        {series->name.substr(0, series->name.find_first_of("|(")), "through the points as printed",
         "within " + what});
  }
  return before->certificate.proved && after->certificate.proved ? 0 : 1;
}
