// SPDX-License-Identifier: Apache-2.0
#include "passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obvid::toolpath {
namespace {

constexpr double kStationOfRadius = 0.25;  // looked at before refinement
constexpr int kMostHalvings = 40;          // halvings between stations
constexpr double kStraightRise = 1.5;      // shares of the tolerance, of steps with a known middle
constexpr double kStraightBend = 0.25;     // of the share
constexpr std::size_t kIsoSteps = 64;      // to guess the length of a line of parameters
/// Contacts that move so much faster than the cutter, to places that lean otherwise (change of the
/// unit normal): it changes from one side of a valley to the other.
constexpr double kJump = 10.0;
constexpr double kLeansOtherwise = 0.05;

double level_distance(Vec3 a, Vec3 b) { return std::hypot(a.x - b.x, a.y - b.y); }

bool changes_sides(const PassPoint& a, const PassPoint& b) {
  const double contact = norm(a.place.contact - b.place.contact);
  return !a.place.open && !b.place.open && contact > kJump * norm(a.place.tip - b.place.tip) &&
         norm(a.place.normal - b.place.normal) > kLeansOtherwise;
}

}  // namespace

Vec2 Rail::axis_at(double t) const {
  const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(axis.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(place), axis.size() - 2);
  const double part = place - static_cast<double>(k);
  return axis[k] + part * (axis[k + 1] - axis[k]);
}

Rail between(const Rail& a, const Rail& b) {
  Rail out = a;
  out.fixed = 0.5 * (a.fixed + b.fixed);
  for (std::size_t i = 0; i < a.axis.size(); ++i) out.axis[i] = 0.5 * (a.axis[i] + b.axis[i]);
  return out;
}

struct Walker::Step {
  const Rail& rail;
  Pass& pass;
  bool open = false;  ///< the last piece goes on
};

std::optional<PassPoint> Walker::resting(Vec2 axis, double t) const {
  const auto place = part_.drop(axis);
  if (!place) return std::nullopt;
  if (place->open) {
    const double allowed = norm(part_.cutter().offset(place->normal)) + overrun_;
    const Vec2 away = axis - Vec2{place->contact.x, place->contact.y};
    if (norm(away) > allowed && !part_.surface_over(axis)) return std::nullopt;
  }
  return PassPoint{t, *place, false};
}

// Where the cutter is to touch the patch; held up where it would cut into something else.
std::optional<PassPoint> Walker::touching(const Rail& rail, double t) const {
  const NurbsSurface& surface = part_.model().patches[rail.patch].surface;
  const double along = (rail.along_v ? domain_v(surface) : domain_u(surface)).at(t);
  PassPoint out;
  out.t = t;
  Place& place = out.place;
  place.patch = static_cast<std::uint32_t>(rail.patch);
  place.u = rail.along_v ? rail.fixed : along;
  place.v = rail.along_v ? along : rail.fixed;
  const SurfaceJet jet = evaluate(surface, place.u, place.v);
  const Vec3 n = unit(cross(jet.du, jet.dv));
  if (n == Vec3{}) return std::nullopt;
  place.normal = n.z < 0.0 ? -n : n;
  place.contact = jet.point;
  const double tolerance = part_.tolerance();
  const Vec3 beside = jet.point + tolerance * place.normal;  // walls do not hide themselves
  const auto over = part_.surface_over({beside.x, beside.y});
  if (over && over->contact.z > beside.z + tolerance) return std::nullopt;
  place.tip = part_.cutter().tip(place.contact, place.normal);
  const auto rest = part_.drop({place.tip.x, place.tip.y});
  if (!rest) return out;  // a wall that the cutter just touches
  out.lifted = (rest->tip.z - place.tip.z) * std::max(place.normal.z, rest->normal.z) > tolerance;
  if (out.lifted) {
    place = *rest;
  } else {
    place.tip.z = std::max(place.tip.z, rest->tip.z);
  }
  return out;
}

std::optional<PassPoint> Walker::at(const Rail& rail, double t) const {
  return rail.of_parameters() ? touching(rail, t) : resting(rail.axis_at(t), t);
}

/// Derivation: docs/methods/toolpath.md.
bool Walker::near_enough(Vec3 a, Vec3 b) const {
  const CutterShape& cutter = part_.cutter();
  const double share = kStepShare * part_.tolerance(), level = level_distance(a, b);
  const Vec3 way = b - a;
  if (level <= share || dot(way, way) <= 8.0 * cutter.corner * share) return true;
  return std::abs(way.z) <= 0.5 * share && level * level <= 4.0 * cutter.flat() * share;
}

// Sharp corners: a short rise whose middle is where a straight line has it.
bool Walker::straight(Vec3 a, Vec3 middle, Vec3 b) const {
  const double share = kStepShare * part_.tolerance(), flat = part_.cutter().flat();
  const double level = level_distance(a, b);
  if (std::abs(b.z - a.z) > kStraightRise * share || level * level > 4.0 * flat * share)
    return false;
  return std::abs(middle.z - 0.5 * (a.z + b.z)) <= kStraightBend * share;
}

std::vector<double> Walker::stations(const Rail& rail) const {
  double length = 0.0;
  if (rail.of_parameters()) {
    const NurbsSurface& surface = part_.model().patches[rail.patch].surface;
    const Range range = rail.along_v ? domain_v(surface) : domain_u(surface);
    const std::size_t spans = (rail.along_v ? surface.count_v() : surface.count_u()) + kIsoSteps;
    Vec3 last;
    for (std::size_t i = 0; i <= spans; ++i) {
      const double w = range.at(static_cast<double>(i) / static_cast<double>(spans));
      const Vec3 p =
          evaluate(surface, rail.along_v ? rail.fixed : w, rail.along_v ? w : rail.fixed).point;
      if (i > 0) length += norm(p - last);
      last = p;
    }
  } else {
    for (std::size_t i = 1; i < rail.axis.size(); ++i)
      length += norm(rail.axis[i] - rail.axis[i - 1]);
  }
  const double parts =
      std::ceil((rail.to - rail.from) * length / (kStationOfRadius * part_.cutter().radius));
  const auto count =
      static_cast<std::size_t>(std::clamp(parts, 2.0, static_cast<double>(most_points_)));
  std::vector<double> out(count + 1);
  for (std::size_t i = 0; i <= count; ++i) {
    out[i] =
        rail.from + (rail.to - rail.from) * static_cast<double>(i) / static_cast<double>(count);
  }
  return out;
}

// Appends what lies behind `a`, up to and with `b`.
void Walker::fill(Step& step, const std::optional<PassPoint>& a, double ta,
                  const std::optional<PassPoint>& b, double tb, int depth) {
  if ((!a && !b) || points_ > most_points_) return;
  bool done = depth >= kMostHalvings;
  if (a && b) {
    done = done || near_enough(a->place.tip, b->place.tip);
  } else {
    const double share = kStepShare * part_.tolerance();
    const double parts = static_cast<double>(std::size_t{1} << std::min(depth, kMostHalvings));
    done = done || kStationOfRadius * part_.cutter().radius / parts <= share;
  }
  if (!done) {
    const double middle = 0.5 * (ta + tb);
    const auto m = at(step.rail, middle);
    if (a && b && m && straight(a->place.tip, m->place.tip, b->place.tip)) {
      append(step, *m);
      append(step, *b);
      return;
    }
    fill(step, a, ta, m, middle, depth + 1);
    fill(step, m, middle, b, tb, depth + 1);
    return;
  }
  if (!b) {
    step.open = false;
    return;
  }
  append(step, *b);
}

void Walker::append(Step& step, const PassPoint& p) {
  if (!step.open) step.pass.pieces.emplace_back();
  step.open = true;
  auto& piece = step.pass.pieces.back();
  piece.push_back(p);
  ++points_;
  if (piece.size() > 1 && changes_sides(piece[piece.size() - 2], p)) piece.back().lifted = true;
}

Result<Pass> Walker::walk(const Rail& rail) {
  Pass pass;
  pass.rail = rail;
  Step step{rail, pass};
  const auto ts = stations(rail);
  std::optional<PassPoint> last;
  for (std::size_t i = 0; i < ts.size(); ++i) {
    const auto next = at(rail, ts[i]);
    if (i > 0) {
      fill(step, last, ts[i - 1], next, ts[i], 0);
    } else if (next) {
      pass.pieces.push_back({*next});
      step.open = true;
    }
    last = next;
  }
  if (points_ > most_points_) {
    return fail({ErrorCode::kToleranceNotReached,
                 fmt::format("the passes need more than {} points", most_points_), "",
                 "allow a larger tolerance, scallop or step", -1,
                 static_cast<double>(most_points_)});
  }
  std::erase_if(pass.pieces, [](const auto& piece) { return piece.size() < 2; });
  return pass;
}

std::optional<std::vector<Vec3>> Walker::link(Vec3 from, Vec3 to) {
  Rail rail;
  rail.axis = {{from.x, from.y}, {to.x, to.y}};
  const auto pass = walk(rail);
  if (!pass || pass->pieces.size() != 1) return std::nullopt;
  const auto& piece = pass->pieces.front();
  if (piece.front().t > 0.0 || piece.back().t < 1.0) return std::nullopt;
  std::vector<Vec3> out{from};
  for (const PassPoint& p : piece) out.push_back(p.place.tip);
  out.push_back(to);
  return out;
}

}  // namespace obvid::toolpath
