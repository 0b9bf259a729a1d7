// SPDX-License-Identifier: Apache-2.0
#include "fit/taken_back.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "obvid/geom/internal/angle.h"

namespace obvid::pipeline_detail {
namespace {

/// How many points lie between one and a line or arc, the nearer way; 0 on it.
std::size_t points_away(const LineOrArc& one, std::size_t point, std::size_t points, bool closed) {
  const std::size_t over = (one.to + points - one.from) % points;
  const std::size_t on = (point + points - one.from) % points;
  if (on <= over) return 0;
  const std::size_t behind = on - over, before = points - on;
  if (closed) return std::min(behind, before);
  return point > one.to ? point - one.to : one.from - point;
}

}  // namespace

bool take_back_corners(const Contour& contour, double angle, TakenBack& out) {
  bool any = false;
  for (const Joint& joint : contour.joints) {
    if (!joint.after || !joint.leaving || out.is_unbroken(*joint.after)) continue;
    if (std::abs(turn_between(joint.element.theta, joint.leaving->theta)) >= angle) continue;
    out.unbroken.push_back(*joint.after);
    any = true;
  }
  return any;
}

bool take_back_nearest(const std::vector<LineOrArc>& all, std::size_t point, std::size_t points,
                       bool closed, TakenBack& out) {
  const LineOrArc* nearest = nullptr;
  std::size_t least = points;
  for (const LineOrArc& one : all) {
    const std::size_t away = points_away(one, point, points, closed);
    if (out.is_loose(one.from) || away >= least) continue;
    nearest = &one;
    least = away;
  }
  if (nearest == nullptr) return false;
  for (std::size_t i = nearest->from;; i = (i + 1) % points) {
    if (!out.is_loose(i)) out.loose.push_back(i);
    if (i == nearest->to) break;
  }
  out.told.push_back(fmt::format(
      "{} (points {}-{}) is not kept: no transition beside it was proved, and its points are free",
      nearest->kappa == 0.0
          ? std::string("a line")
          : fmt::format("an arc of radius {:.4g}", std::abs(1.0 / nearest->kappa)),
      nearest->from + 1, nearest->to + 1));
  return true;
}

std::size_t point_nearest_to(std::size_t joint, const Contour& contour) {
  const Vec2 at = contour.joints[joint % contour.joints.size()].element.point;
  const auto nearest =
      std::min_element(contour.points.begin(), contour.points.end(),
                       [at](Vec2 a, Vec2 b) { return norm(a - at) < norm(b - at); });
  return static_cast<std::size_t>(nearest - contour.points.begin());
}

}  // namespace obvid::pipeline_detail
