// SPDX-License-Identifier: Apache-2.0
#include "reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "obvid/core/units.h"
#include "sweep.h"

namespace obvid::toolpath {
namespace {

/// Heights are good to the triangles' share of the tolerance where the contact is no inner point of
/// a patch: what comes that near is taken for reached.
constexpr double kReached = 1.0 + kTriangleShare;
constexpr double kFirstStep = 0.5, kLastStep = 0.02;  // of the radius
constexpr double kNextStep = 0.125;                   // likewise, beside a place that is known
constexpr double kFinestStep = 1e-4;                  // likewise, where the height is told
constexpr double kLevel = 1e-6;   // size of x and y of normals: any place of a flat bottom touches
constexpr double kBottom = 0.99;  // of a flat bottom's radius: the farthest such place
constexpr int kDirections = 8;
constexpr double kSteep = 0.5;   // z of normals: a little to the side is not higher by as much
constexpr double kBeside = 0.5;  // of the tolerance: more than the triangles' share
constexpr double kUprightCell = 1e-3;  // z of normals of walls: which side is open is looked up

class Search {
 public:
  Search(const Part& part, Vec3 point, Vec3 normal)
      : part_(part), point_(point), normal_(normal), most_(2.0 * part.cutter().radius) {}

  Nearest run(std::optional<Vec2> first) {
    const CutterShape& cutter = part_.cutter();
    const Vec3 tip = cutter.tip(point_, normal_);
    best_ = {Reach::kHeld, most_, {tip.x, tip.y}};
    if ((first && look(*first)) || look({tip.x, tip.y})) return best_;
    // beside a wall what stands over the place may hold the cutter up that passes it by a hair
    const double aside = part_.tolerance();
    const Vec3 clear = cutter.tip(point_ + aside * normal_, normal_);
    if (normal_.z < kSteep && look({clear.x, clear.y})) return best_;
    const bool level = std::hypot(normal_.x, normal_.y) < kLevel && cutter.flat() > 0.0;
    if (level && around({tip.x, tip.y}, kBottom * cutter.flat())) return best_;
    descend(first ? kNextStep : kFirstStep, kLastStep);
    return best_;
  }

  Nearest closer(const Nearest& known) {
    best_ = known;
    descend(kLastStep, kFinestStep);
    return best_;
  }

 private:
  void descend(double step, double last) {
    while (step >= last) {
      const double before = best_.height;
      if (around(best_.axis, step * part_.cutter().radius)) return;
      if (!(best_.height < before)) step *= 0.5;
    }
  }

  /// True: reached.
  bool look(Vec2 axis) {
    const auto rest = part_.drop(axis);
    // nothing there: it goes down as far as it likes
    Vec3 tip = rest ? rest->tip : Vec3{axis.x, axis.y, point_.z - part_.cutter().radius};
    if (rest && rest->open && !part_.surface_over(axis)) {  // passes do not go down there
      const Vec2 away = axis - Vec2{rest->contact.x, rest->contact.y};
      const double far = norm(away);
      const Vec2 out = rest->outwards == Vec2{} && far > 0.0 ? away / far : rest->outwards;
      const double beyond = part_.beyond_border(*rest, out);
      if (beyond > 0.0) tip.z = part_.kept_up(*rest, out, beyond);
    }
    const SweepEntry entry = entry_into(part_.cutter(), {tip, tip}, point_, normal_, best_.height);
    if (entry.height < best_.height) {
      best_.height = entry.height;
      best_.axis = axis;
    }
    if (best_.height <= kReached * part_.tolerance()) best_.reach = Reach::kReached;
    return best_.reach == Reach::kReached;
  }

  bool around(Vec2 middle, double radius) {
    for (int k = 0; k < kDirections; ++k) {
      const double angle = kFullTurn * k / kDirections;
      if (look(middle + radius * Vec2{std::cos(angle), std::sin(angle)})) return true;
    }
    return false;
  }

  const Part& part_;
  Vec3 point_, normal_;
  double most_;
  Nearest best_;
};

}  // namespace

namespace {

/// Straight over the place, not beside it, the part goes on: at thin edges, where a place beside
/// the lower side lies over the upper one already, and by a hair on the outline of a body. Farther
/// over it than triangles of its own may lie.
bool lies_under(const Part& part, Vec3 point, Vec3 normal) {
  const double tolerance = part.tolerance();
  const bool upright = !(normal.z > kUprightCell);
  // beside an upright wall, farther than its own triangles lie beside it
  const Vec3 place = upright ? point + kBeside * tolerance * normal : point;
  const double own = upright ? 2.0 * tolerance : tolerance * (1.0 + kTriangleShare / normal.z);
  const auto over = part.surface_over({place.x, place.y});
  return over && over->contact.z > point.z + own;
}

}  // namespace

Vec3 open_side(const Part& part, Vec3 point, Vec3 normal) {
  if (std::abs(normal.z) > kUprightCell) return normal;
  return hidden(part, point, normal) && !hidden(part, point, -normal) ? -normal : normal;
}

bool hidden(const Part& part, Vec3 point, Vec3 normal) {
  const double tolerance = part.tolerance();
  const Vec3 beside = point + tolerance * normal;  // walls do not hide themselves
  const auto over = part.surface_over({beside.x, beside.y});
  return over && over->contact.z > beside.z + tolerance;
}

Nearest nearest_to(const Part& part, Vec3 point, Vec3 normal, std::optional<Vec2> first) {
  if (hidden(part, point, normal) || lies_under(part, point, normal)) {
    return {Reach::kHidden, 0.0, {}};
  }
  return Search(part, point, normal).run(first);
}

Nearest closer_to(const Part& part, Vec3 point, Vec3 normal, const Nearest& known) {
  return Search(part, point, normal).closer(known);
}

}  // namespace obvid::toolpath
