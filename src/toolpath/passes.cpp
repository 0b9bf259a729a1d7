// SPDX-License-Identifier: Apache-2.0
#include "passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "obvid/core/internal/parallel.h"
#include "obvid/core/units.h"
#include "reach.h"

namespace obvid::toolpath {
namespace {

constexpr double kStationOfRadius = 0.5;  // looked at before refinement
constexpr int kMostHalvings = 40;         // halvings between stations
constexpr double kEnd = 1e-4;           // of the share: walls at a border rise that fast before it
constexpr double kMeasured = 0.25;      // radii: longer ways are not judged by three places alone
constexpr double kMeasuredBend = 0.25;  // of the share: how far these may lie off the chord
/// Shorter rails, such as links, are walked on the calling thread: others take longer to start.
constexpr std::size_t kStationsShared = 16;
/// Of a pass, for the thread that takes them, which looks at their first station once more: a
/// part of those that are left, so that threads end at about the same time.
constexpr std::size_t kStretchesTogether = 8, kPartOfLeft = 4;
constexpr std::size_t kRailsTogether = 64;   // walked before their points are counted
constexpr std::size_t kPointsTogether = 64;  // of a pass, for the thread that takes them
constexpr std::size_t kIsoSteps = 64;        // to guess the length of a line of parameters
/// Contacts that move so much faster than the cutter, to places that lean otherwise (change of the
/// unit normal): it changes from one side of a valley to the other.
constexpr double kJump = 10.0;
constexpr double kLeansOtherwise = 0.05;

/// Distance of a point from the line through a and b.
double off_line(Vec3 a, Vec3 b, Vec3 p) {
  const Vec3 way = b - a;
  const double length = norm(way);
  return length > 0.0 ? norm(cross(way, p - a)) / length : norm(p - a);
}

Vec2 direction_of(Vec2 way) {
  const double size = norm(way);
  return size > 0.0 ? way / size : Vec2{};
}

bool changes_sides(const PassPoint& a, const PassPoint& b) {
  const double contact = norm(a.place.contact - b.place.contact);
  return !a.place.open && !b.place.open && contact > kJump * norm(a.place.tip - b.place.tip) &&
         norm(a.place.normal - b.place.normal) > kLeansOtherwise;
}

}  // namespace

double level_distance(Vec3 a, Vec3 b) {
  const double dx = a.x - b.x, dy = a.y - b.y;
  return std::sqrt(dx * dx + dy * dy);
}

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

double least_over(const Pass& pass, double most, std::size_t threads,
                  const std::function<double(const PassPoint&)>& of) {
  std::vector<const PassPoint*> all;
  for (const auto& piece : pass.pieces) {
    for (const PassPoint& p : piece) all.push_back(&p);
  }
  std::vector<double> least((all.size() + kPointsTogether - 1) / kPointsTogether, most);
  in_parallel(least.size(), threads, [&](std::size_t k) {
    const std::size_t end = std::min(all.size(), (k + 1) * kPointsTogether);
    for (std::size_t i = k * kPointsTogether; i < end; ++i) {
      least[k] = std::min(least[k], of(*all[i]));
    }
  });
  return least.empty() ? most : *std::min_element(least.begin(), least.end());
}

void append_kept(const std::vector<PassPoint>& piece, const std::vector<bool>& kept,
                 std::vector<std::vector<PassPoint>>& out) {
  bool open = false;
  for (std::size_t k = 0; k < piece.size(); ++k) {
    if (kept[k]) {
      if (!open) out.emplace_back();
      out.back().push_back(piece[k]);
    }
    open = kept[k];
  }
  std::erase_if(out, [](const auto& one) { return one.size() < 2; });
}

void keep_flat(Pass& pass, double flat_from, double beyond) {
  std::vector<std::vector<PassPoint>> pieces;
  for (const auto& piece : pass.pieces) {
    const std::size_t n = piece.size();
    std::vector<bool> kept(n);
    const auto spread = [&](auto number) {
      double left = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        const PassPoint& p = piece[number(k)];
        if (p.place.normal.z > flat_from) {
          left = beyond;
        } else if (k > 0) {
          left -= norm(p.place.tip - piece[number(k - 1)].place.tip);
        }
        if (left > 0.0) kept[number(k)] = true;
      }
    };
    spread([](std::size_t k) { return k; });
    spread([n](std::size_t k) { return n - 1 - k; });
    append_kept(piece, kept, pieces);
  }
  pass.pieces = std::move(pieces);
}

// From the nearest place of the part that is found beside the axis; where that is far, from the
// corner that holds the cutter.
Vec2 Walker::out_of_part(const Place& place) const {
  constexpr int kWaysOut = 16;
  constexpr double kNoDirection = 1e-6;  // of unit vectors on all sides
  const Vec2 axis{place.tip.x, place.tip.y};
  for (const double part : {0.05, 0.25, 0.5, 1.0}) {
    Vec2 sum;
    for (int k = 0; k < kWaysOut; ++k) {
      const double angle = kFullTurn * k / kWaysOut;
      const Vec2 out{std::cos(angle), std::sin(angle)};
      if (part_.surface_over(axis - part * overrun_ * out)) sum = sum + out;
    }
    if (norm(sum) > kNoDirection) return direction_of(sum);
  }
  return direction_of(axis - Vec2{place.contact.x, place.contact.y});
}

// Beyond an open border a resting cutter would roll down over it. It goes out as far as it touches
// the surface there with its side; beyond that only along the border, a part of a step far, and no
// lower. True: the pass ends before.
bool Walker::ends_at_border(const Rail& rail, double t, Place& place) const {
  if (place.outwards == Vec2{}) place.outwards = out_of_part(place);
  const double beyond = part_.beyond_border(place, place.outwards);
  if (!(beyond > 0.0)) return false;
  constexpr double kAside = 1e-3;  // of the rail
  const Vec2 way = direction_of(rail.axis_at(t + kAside) - rail.axis_at(t - kAside));
  const double along = rail.across ? 1.0 : std::abs(cross(way, place.outwards));
  if (beyond > along * overrun_ + part_.tolerance()) return true;
  place.tip.z = part_.kept_up(place, place.outwards, beyond);
  return false;
}

Walker::Station Walker::resting(const Rail& rail, double t) const {
  const Vec2 axis = rail.axis_at(t);
  auto place = part_.drop(axis);
  if (!place) return std::nullopt;
  if (place->open && !part_.surface_over(axis) && ends_at_border(rail, t, *place)) {
    return std::nullopt;
  }
  return PassPoint{t, *place, false};
}

// Where the cutter is to touch the patch; held up where it would cut into something else.
Walker::Station Walker::touching(const Rail& rail, double t) const {
  const NurbsSurface& surface = part_.model().patches[rail.patch].surface;
  const double along = (rail.along_v ? domain_v(surface) : domain_u(surface)).at(t);
  PassPoint out;
  out.t = t;
  Place& place = out.place;
  place.patch = static_cast<std::uint32_t>(rail.patch);
  place.u = rail.along_v ? rail.fixed : along;
  place.v = rail.along_v ? along : rail.fixed;
  if (!part_.is_there(rail.patch, place.u, place.v)) return std::nullopt;
  const SurfaceJet jet = evaluate(surface, place.u, place.v);
  const Vec3 n = unit(cross(jet.du, jet.dv));
  if (n == Vec3{}) return std::nullopt;
  place.normal = open_side(part_, jet.point, n.z < 0.0 ? -n : n);
  place.contact = jet.point;
  const double tolerance = part_.tolerance();
  if (hidden(part_, jet.point, place.normal)) return std::nullopt;
  place.tip = part_.tip(place.contact, place.normal);
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

Walker::Station Walker::no_lower(Vec2 axis, double t, double floor) const {
  const auto rest = part_.drop(axis);
  PassPoint out{t, rest.value_or(Place{}), false};
  out.place.tip = {axis.x, axis.y, rest ? std::max(rest->tip.z, floor) : floor};
  return out;
}

Walker::Station Walker::at(const Rail& rail, double t) const {
  if (rail.floor) return no_lower(rail.axis_at(t), t, *rail.floor);
  return rail.of_parameters() ? touching(rail, t) : resting(rail, t);
}

/// Derivations: docs/methods/toolpath.md. Round bodies: no part can hide between two that are so
/// near; discs: they leave no more than a sliver open, and rise by no more than that.
bool Walker::round_enough(Vec3 a, Vec3 b) const {
  const CutterShape& cutter = part_.cutter();
  const double share = kStepShare * part_.tolerance(), level = level_distance(a, b);
  const Vec3 way = b - a;
  if (level <= share || dot(way, way) <= 8.0 * cutter.corner * share) return true;
  return std::abs(way.z) <= 0.5 * share && level * level <= 4.0 * cutter.flat() * share;
}

/// The part bulges so little under the cutter that it cannot stand out between two places.
bool Walker::flat_enough(const Rail& rail, Vec3 a, Vec3 b) const {
  const double level = level_distance(a, b);
  if (rail.across || level > bulges_.longest()) return false;
  const double bulge = bulges_.at({0.5 * (a.x + b.x), 0.5 * (a.y + b.y)});
  return level * level * bulge <= 8.0 * kStepShare * part_.tolerance();
}

/// At borders and edges of the part: a short way whose inner places lie where a straight one has
/// them.
bool Walker::measured_enough(const std::array<Vec3, 5>& p) const {
  if (level_distance(p[0], p[4]) > kMeasured * part_.cutter().radius) return false;
  const double most = kMeasuredBend * kStepShare * part_.tolerance();
  for (std::size_t k = 1; k < 4; ++k) {
    if (off_line(p[0], p[4], p[k]) > most) return false;
  }
  return true;
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
void Walker::fill(const Rail& rail, const Station& a, double ta, const Station& b, double tb,
                  int depth, Stretch& out) const {
  if ((!a && !b) || out.points.size() > out.most) return;
  const double share = kStepShare * part_.tolerance();
  bool done = depth >= kMostHalvings;
  if (a && b) {
    done = done || round_enough(a->place.tip, b->place.tip);
  } else {
    const double parts = static_cast<double>(std::size_t{1} << std::min(depth, kMostHalvings));
    done = done || kStationOfRadius * part_.cutter().radius / parts <= kEnd * share;
  }
  if (done) {
    out.points.push_back(b);
  } else {
    fill_both(rail, a, ta, b, tb, depth, out);
  }
}

void Walker::fill_both(const Rail& rail, const Station& a, double ta, const Station& b, double tb,
                       int depth, Stretch& out) const {
  const double t = 0.5 * (ta + tb);
  const Station m = at(rail, t);
  if (a && b && m) {
    const Vec3 from = a->place.tip, middle = m->place.tip, to = b->place.tip;
    const double off = off_line(from, to, middle), share = kStepShare * part_.tolerance();
    if (off <= share && flat_enough(rail, from, to)) {
      out.points.push_back(m);
      out.points.push_back(b);
      return;
    }
    if (off <= kMeasuredBend * share &&
        level_distance(from, to) <= kMeasured * part_.cutter().radius) {
      const Station q1 = at(rail, 0.5 * (ta + t)), q3 = at(rail, 0.5 * (t + tb));
      if (q1 && q3 && measured_enough({from, q1->place.tip, middle, q3->place.tip, to})) {
        out.points.insert(out.points.end(), {q1, m, q3, b});
        return;
      }
    }
  }
  fill(rail, a, ta, m, t, depth + 1, out);
  fill(rail, m, t, b, tb, depth + 1, out);
}

/// Neighbouring stretches that one thread walks.
struct Walker::Lot {
  std::size_t walk, first, end;
};

// Stretches between stations know nothing of each other: they are walked side by side.
struct Walker::Walk {
  const Rail* rail = nullptr;
  std::vector<double> ts;
  Station front;
  std::vector<Stretch> stretches;
  std::size_t count = 0;  ///< points
};

std::vector<Walker::Lot> Walker::lots_of(const std::vector<Walk>& walks) {
  std::size_t left = 0;
  for (const Walk& walk : walks) left += walk.stretches.size();
  std::vector<Lot> out;
  for (std::size_t w = 0; w < walks.size(); ++w) {
    const std::size_t count = walks[w].stretches.size();
    for (std::size_t first = 0; first < count;) {
      const std::size_t some = std::clamp<std::size_t>(left / kPartOfLeft, 1, kStretchesTogether);
      const std::size_t end = std::min(count, first + some);
      out.push_back({w, first, end});
      left -= end - first;
      first = end;
    }
  }
  return out;
}

void Walker::walk_lot(Walk& walk, const Lot& lot) const {
  const Rail& rail = *walk.rail;
  const auto& ts = walk.ts;
  Station from = at(rail, ts[lot.first]);
  if (lot.first == 0) walk.front = from;
  for (std::size_t i = lot.first; i < lot.end; ++i) {
    const Station to = at(rail, ts[i + 1]);
    walk.stretches[i].most = most_points_ - std::min(most_points_, points_);
    fill(rail, from, ts[i], to, ts[i + 1], 0, walk.stretches[i]);
    from = to;
  }
}

Pass Walker::pass_of(Walk& walk) {
  Pass pass;
  pass.rail = *walk.rail;
  bool open = false;
  const auto append = [&](const Station& p) {
    if (p) {
      if (!open) pass.pieces.emplace_back();
      auto& piece = pass.pieces.back();
      piece.push_back(*p);
      ++walk.count;
      if (piece.size() > 1 && changes_sides(piece[piece.size() - 2], *p))
        piece.back().lifted = true;
    }
    open = p.has_value();
  };
  append(walk.front);
  for (const Stretch& stretch : walk.stretches) {
    for (const Station& p : stretch.points) append(p);
  }
  std::erase_if(pass.pieces, [](const auto& piece) { return piece.size() < 2; });
  return pass;
}

Result<void> Walker::count(const std::vector<Walk>& walks) {
  for (const Walk& walk : walks) points_ += walk.count;
  if (points_ <= most_points_) return {};
  return error(ErrorCode::kToleranceNotReached,
               fmt::format("the passes need more than {} points", most_points_))
      .hint("allow a larger tolerance, scallop or step")
      .value(static_cast<double>(most_points_));
}

Result<Pass> Walker::walk(const Rail& rail) {
  std::vector<Walk> walks(1);
  Walk& one = walks.front();
  one.rail = &rail;
  one.ts = stations(rail);
  one.stretches.resize(one.ts.size() - 1);
  const std::size_t threads = one.ts.size() < kStationsShared ? 1 : threads_;
  const auto lots = lots_of(walks);
  in_parallel(lots.size(), threads, [&](std::size_t k) { walk_lot(one, lots[k]); });
  Pass pass = pass_of(one);
  OBVID_TRY(count(walks));
  return pass;
}

Result<std::vector<Pass>> Walker::walk(const std::vector<Rail>& rails, const RunContext& run) {
  const RunContext shared = with_threads(run, threads_);
  std::vector<Pass> out(rails.size());
  for (std::size_t first = 0; first < rails.size(); first += kRailsTogether) {
    std::vector<Walk> walks(std::min(kRailsTogether, rails.size() - first));
    OBVID_TRY(in_parallel(walks.size(), shared, [&](std::size_t k) {
      walks[k].rail = &rails[first + k];
      walks[k].ts = stations(rails[first + k]);
      walks[k].stretches.resize(walks[k].ts.size() - 1);
    }));
    const auto lots = lots_of(walks);
    OBVID_TRY(in_parallel(lots.size(), shared,
                          [&](std::size_t k) { walk_lot(walks[lots[k].walk], lots[k]); }));
    OBVID_TRY(in_parallel(walks.size(), shared,
                          [&](std::size_t k) { out[first + k] = pass_of(walks[k]); }));
    OBVID_TRY(count(walks));
  }
  return out;
}

std::optional<std::vector<Vec3>> Walker::tips_of(const Rail& rail) {
  const auto pass = walk(rail);
  if (!pass || pass->pieces.size() != 1) return std::nullopt;
  const auto& piece = pass->pieces.front();
  if (piece.front().t > 0.0 || piece.back().t < 1.0) return std::nullopt;
  std::vector<Vec3> out;
  for (const PassPoint& p : piece) out.push_back(p.place.tip);
  return out;
}

std::optional<std::vector<Vec3>> Walker::link(Vec3 from, Vec3 to) {
  Rail rail;
  rail.axis = {{from.x, from.y}, {to.x, to.y}};
  rail.across = true;
  auto way = tips_of(rail);
  if (!way) return std::nullopt;
  way->insert(way->begin(), from);
  way->push_back(to);
  return way;
}

// The contact lies where the part rises.
std::optional<Vec2> Walker::downhill(Vec2 axis) const {
  const auto rest = part_.drop(axis);
  if (!rest) return std::nullopt;
  const Vec2 away = axis - Vec2{rest->contact.x, rest->contact.y};
  const double size = norm(away);
  return size > 0.0 ? std::optional(away / size) : std::nullopt;
}

std::optional<std::vector<Vec3>> Walker::over(const std::vector<Vec2>& axis, double floor) {
  Rail rail;
  rail.axis = axis;
  rail.across = true;
  rail.floor = floor;
  return tips_of(rail);
}

}  // namespace obvid::toolpath
