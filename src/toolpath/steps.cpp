// SPDX-License-Identifier: Apache-2.0
#include "steps.h"

#include <algorithm>
#include <cmath>

namespace obvid::toolpath {
namespace {

constexpr double kFloor = 0.1;       // of the level step
constexpr double kOfDiameter = 0.8;  // flat bottoms overlap
constexpr double kLeansAlike = 0.2;  // z of normals
constexpr double kWall = 1e-6;       // z of normals taken for walls

double bend_along(const Bends& bends, Vec3 direction) {
  const double c = dot(direction, bends.direction1), c2 = std::min(1.0, c * c);
  return bends.k1 * c2 + bends.k2 * (1.0 - c2);
}

/// Bend of the cutter's body where its normal leans by (sine, cosine), down the slope and level.
struct BodyBends {
  double down, level;
};

BodyBends body_bends(const CutterShape& cutter, double scallop, double sine, double cosine) {
  // sharp corners leave stairs: height = step * sine, as much as this radius would
  const double lean = 8.0 * sine * sine * cosine * cosine;
  const double like = lean > 0.0 ? scallop / lean : cutter.radius;
  const double corner = std::max(cutter.corner, std::min(like, cutter.radius));
  const double level = cutter.flat() + cutter.corner * sine;
  return {1.0 / corner, level > 0.0 ? sine / level : 1.0 / cutter.corner};
}

}  // namespace

double print_within(const ToolpathOptions& options) {
  const double share = kPrintShare * options.tolerance;
  return options.scallop ? std::min(share, kScallopPrint * *options.scallop) : share;
}

double StepForm::along(Vec2 d) const {
  return 1.0 / std::sqrt(xx * d.x * d.x + 2.0 * xy * d.x * d.y + yy * d.y * d.y);
}

StepRule::StepRule(const CutterShape& cutter, const ToolpathOptions& options) : cutter_(cutter) {
  level_ = kOfDiameter * 2.0 * cutter.radius;
  if (options.scallop) {
    scallop_ = kScallopAim * *options.scallop;
    const double h = std::min(scallop_, cutter.corner);
    const double round = 2.0 * std::sqrt(std::max(0.0, h * (2.0 * cutter.corner - h)));
    level_ = std::min(level_, kOfDiameter * 2.0 * cutter.flat() + round);
  }
  if (options.step_over) level_ = std::min(level_, *options.step_over);
  floor_ = kFloor * level_;
}

StepForm StepRule::level_form() const {
  const double one = 1.0 / (level_ * level_);
  return {one, 0.0, one};
}

/// Distance of neighbouring contacts along the surface.
double StepRule::on_surface(double cutter_bend, double bend) const {
  const double both = cutter_bend + bend;
  return both > 0.0 ? std::sqrt(8.0 * scallop_ / both) : level_;
}

/// The tip moves faster than the contact over bulges, slower in hollows.
double StepRule::tip_step(double cutter_bend, double bend) const {
  if (!(cutter_bend > 0.0)) return level_;
  return on_surface(cutter_bend, bend) * std::max(0.0, cutter_bend + bend) / cutter_bend;
}

StepForm StepRule::form(const Part& part, const Place& place) const {
  const Bends bends = part.bends(place);
  const Vec3 n = place.normal;
  const double sine = std::hypot(n.x, n.y), cosine = std::max(n.z, kWall);
  if (scallop_ <= 0.0) return level_form();
  const Vec2 down = sine > 0.0 ? Vec2{n.x / sine, n.y / sine} : Vec2{1.0, 0.0};
  const Vec3 slope{down.x * cosine, down.y * cosine, -sine}, level{-down.y, down.x, 0.0};
  const BodyBends body = body_bends(cutter_, scallop_, sine, cosine);
  const double w_down =
      std::clamp(cosine * tip_step(body.down, bend_along(bends, slope)), floor_, level_);
  const double w_level = std::clamp(tip_step(body.level, bend_along(bends, level)), floor_, level_);
  const double a = 1.0 / (w_down * w_down), b = 1.0 / (w_level * w_level);
  return {a * down.x * down.x + b * down.y * down.y, (a - b) * down.x * down.y,
          a * down.y * down.y + b * down.x * down.x};
}

double StepRule::down(const Part& part, const Place& place, double cosine) const {
  if (scallop_ <= 0.0) return level_;
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  double bend = 0.0;
  const Vec3 n = place.normal;
  if (!place.open && std::abs(n.z - cosine) < kLeansAlike) {
    const double level = std::hypot(n.x, n.y);
    const Vec3 slope{n.z * n.x / level, n.z * n.y / level, -level};
    bend = bend_along(part.bends(place), slope);
  }
  const BodyBends body = body_bends(cutter_, scallop_, sine, cosine);
  // stairs of sharp corners: steps down to the scallop itself
  return std::clamp(sine * tip_step(body.down, bend), std::min(floor_, scallop_), level_);
}

double StepRule::across(const Part& part, const Place& place, Vec3 along) const {
  if (scallop_ <= 0.0) return level_;
  const Bends bends = part.bends(place);
  const Vec3 n = place.normal, across = unit(cross(n, along));
  const double sine = std::hypot(n.x, n.y), cosine = std::max(n.z, kWall);
  const BodyBends body = body_bends(cutter_, scallop_, sine, cosine);
  const Vec3 level = sine > 0.0 ? Vec3{-n.y / sine, n.x / sine, 0.0} : across;
  const double c = dot(across, level), c2 = std::min(1.0, c * c);
  const double bend = body.level * c2 + body.down * (1.0 - c2);
  return std::clamp(on_surface(bend, bend_along(bends, across)), floor_, level_);
}

}  // namespace obvid::toolpath
