// SPDX-License-Identifier: Apache-2.0
#include "reach_report.h"

#include <algorithm>
#include <cmath>

#include "scallop_meter.h"

namespace obvid::toolpath {
namespace {

constexpr std::size_t kMostLooked = 40000;  // triangles: areas good to some per mille

double area_of(const Triangle& t) { return 0.5 * norm(cross(t[1] - t[0], t[2] - t[0])); }

}  // namespace

void report_reach(const Part& part, ToolpathReport& report) {
  const auto& triangles = part.field().triangles();
  const std::size_t stride = triangles.size() / kMostLooked + 1;
  double looked = 0.0, hidden = 0.0, unreached = 0.0;
  const double tolerance = part.tolerance();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const double area = area_of(triangles[i].corners);
    report.surface_area += area;
    if (i % stride != 0) continue;
    looked += area;
    const Place q = part.on_triangle(static_cast<std::uint32_t>(i), {1.0 / 3, 1.0 / 3, 1.0 / 3});
    const Vec3 beside = q.contact + tolerance * q.normal;
    const auto over = part.surface_over({beside.x, beside.y});
    if (over && over->contact.z > beside.z + tolerance) {
      hidden += area;
      continue;
    }
    const double held = held_up(part, q);
    if (held <= tolerance) continue;
    unreached += area;
    report.unreached_depth = std::max(report.unreached_depth, held);
  }
  if (!(looked > 0.0)) return;
  report.hidden_area = hidden / looked * report.surface_area;
  report.unreached_area = unreached / looked * report.surface_area;
}

}  // namespace obvid::toolpath
