// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "obvid/core/units.h"
#include "pass_families.h"

namespace obvid::toolpath {

PassFrame pass_frame(const Part& part, double angle_deg) {
  PassFrame frame;
  const double turn = std::remainder(angle_deg, 360.0);
  static constexpr std::array<std::array<double, 3>, 5> kSquare = {
      {{0, 1, 0}, {90, 0, 1}, {-90, 0, -1}, {180, -1, 0}, {-180, -1, 0}}};
  const double rad = turn * kOneDegree;
  frame.along = {std::cos(rad), std::sin(rad)};
  for (const auto& [angle, x, y] : kSquare) {  // exactly, so that passes lie in planes of the axes
    if (turn != angle) continue;
    frame.along = {x, y};
    frame.plane = y == 0.0 ? PassPlane::kXz : PassPlane::kYz;
  }
  constexpr double kFar = std::numeric_limits<double>::infinity();
  frame.a0 = frame.b0 = kFar;
  frame.a1 = frame.b1 = -kFar;
  for (const FieldTriangle& t : part.field().triangles()) {
    for (const Vec3 p : t.corners) {
      const double a = dot(Vec2{p.x, p.y}, frame.along), b = dot(Vec2{p.x, p.y}, frame.across());
      frame.a0 = std::min(frame.a0, a);
      frame.a1 = std::max(frame.a1, a);
      frame.b0 = std::min(frame.b0, b);
      frame.b1 = std::max(frame.b1, b);
    }
  }
  const double out = 2.0 * part.cutter().radius + part.allowance();
  frame.a0 -= out;
  frame.a1 += out;
  frame.b0 -= out;
  frame.b1 += out;
  return frame;
}

Result<Family> zigzag(const Part& part, const ToolpathOptions& options, const StepRule& rule,
                      Walker& walker, const Leftover* left, const RunContext& run) {
  const PassFrame frame = pass_frame(part, options.angle_deg);
  Family family;
  const double flat = flat_from(options).value_or(-1.0);
  for (double b = frame.b0; b <= frame.b1;) {
    Rail rail;
    rail.axis = {frame.at(frame.a0, b), frame.at(frame.a1, b)};
    rail.plane = frame.plane;
    auto pass = walk_where_left(walker, rail, left);
    OBVID_TRY(pass);
    const double step = least_over(*pass, rule.level(), walker.threads(), [&](const PassPoint& p) {
      if (p.place.normal.z <= flat) return rule.level();
      return rule.form(part, p.place).along(frame.across());
    });
    if (options.steep_deg) keep_flat(*pass, flat, rule.level());
    if (!pass->empty()) family.push_back(std::move(*pass));
    b += step;
    const double share = (b - frame.b0) / (frame.b1 - frame.b0);
    OBVID_TRY(tell(run, "passes", share));
  }
  return family;
}

}  // namespace obvid::toolpath
