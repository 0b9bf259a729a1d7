// SPDX-License-Identifier: Apache-2.0
#include "reach_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scallop_meter.h"

namespace obvid::toolpath {
namespace {

constexpr std::size_t kMostLooked = 40000;  // triangles: areas good to some per mille

constexpr double kLeastLooked = 4000.0;  // places: few large triangles are looked at in parts
constexpr double kMostParts = 32.0;      // of a side

/// Middles of equal parts of a triangle with `n` parts of each side, as weights of its corners.
std::vector<std::array<double, 3>> middles(int n) {
  std::vector<std::array<double, 3>> out;
  const auto add = [&](double a, double b) { out.push_back({1.0 - (a + b) / n, a / n, b / n}); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      add(i + 1.0 / 3.0, j + 1.0 / 3.0);
      if (i + j + 1 < n) add(i + 2.0 / 3.0, j + 2.0 / 3.0);
    }
  }
  return out;
}

double area_of(const Triangle& t) { return 0.5 * norm(cross(t[1] - t[0], t[2] - t[0])); }

}  // namespace

void report_reach(const Part& part, ToolpathReport& report) {
  const auto& triangles = part.field().triangles();
  const std::size_t stride = triangles.size() / kMostLooked + 1;
  double looked = 0.0, hidden = 0.0, unreached = 0.0;
  const double tolerance = part.tolerance();
  const double parts = std::sqrt(kLeastLooked / static_cast<double>(triangles.size() + 1));
  const auto places = middles(static_cast<int>(std::clamp(parts, 1.0, kMostParts)));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const double whole = area_of(triangles[i].corners);
    report.surface_area += whole;
    if (i % stride != 0) continue;
    looked += whole;
    const double area = whole / static_cast<double>(places.size());
    for (const auto& weights : places) {
      const Place q = part.on_triangle(static_cast<std::uint32_t>(i), weights);
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
  }
  if (!(looked > 0.0)) return;
  report.hidden_area = hidden / looked * report.surface_area;
  report.unreached_area = unreached / looked * report.surface_area;
}

}  // namespace obvid::toolpath
