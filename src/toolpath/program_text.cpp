// SPDX-License-Identifier: Apache-2.0
#include "program_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "biarc.h"
#include "moves.h"
#include "obvid/exchange/internal/gcode/dialect.h"
#include "obvid/exchange/internal/gcode/gcode_limits.h"
#include "obvid/exchange/internal/gcode/path.h"
#include "obvid/geom/internal/chord.h"

namespace obvid::toolpath {
namespace {

using exchange::fixed;
using exchange::kLeastCentreDecimals;

constexpr double kLargestRadius = 1e4;  // machine units: beyond, centres need more digits
/// Cosine of half the turn of the flattest arcs that are told as one: less than half a turn.
constexpr double kMostLean = 0.2;
constexpr std::size_t kMostAhead = 512;  // points that one biarc stands for: bounds the search
/// Places between two points, and how far arcs may lie from them, in what they may from points:
/// that, and what passes themselves may lie beside the chords of their points.
constexpr std::array<double, 3> kOnChord = {0.25, 0.5, 0.75};
constexpr double kMostBulge = 2.0;
constexpr double kCornerCosine = 0.98;  // sharper ones end a biarc

double round_to(double value, int decimals) {
  const double places = std::pow(10.0, decimals);
  return std::round(value * places) / places;
}

}  // namespace

/// A pass in its plane: the level axis and z; directions by parabolas through three points.
struct ProgramText::Flat : Upright {
  std::vector<Vec2> points, directions;

  Flat(const std::vector<Vec3>& pass, PassPlane in)
      : Upright{in, in == PassPlane::kXz ? pass.front().y : pass.front().x} {
    for (const Vec3 p : pass) {
      const Vec2 q = flat(p);
      if (points.empty() || !(q == points.back())) points.push_back(q);
    }
    directions.resize(points.size());
    const std::size_t n = points.size();
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const Vec2 a = points[i] - points[i - 1], b = points[i + 1] - points[i];
      const double la = norm(a), lb = norm(b);
      directions[i] = unit2((lb / la) * a + (la / lb) * b);
    }
    if (n < 3) {
      for (Vec2& d : directions) d = n == 2 ? unit2(points[1] - points[0]) : Vec2{1.0, 0.0};
      return;
    }
    const auto end = [&](Vec2 chord, Vec2 next) {  // mirrored at the chord
      const Vec2 c = unit2(chord);
      return 2.0 * dot(next, c) * c - next;
    };
    directions[0] = end(points[1] - points[0], directions[1]);
    directions[n - 1] = end(points[n - 1] - points[n - 2], directions[n - 2]);
  }
  static Vec2 unit2(Vec2 a) {
    const double length = norm(a);
    return length > 0.0 ? a / length : a;
  }
};

ProgramText::ProgramText(int decimals, double within, bool arcs,
                         const exchange::MotionRules& machine)
    : decimals_(decimals),
      unit_(std::pow(10.0, -decimals)),
      within_(within),
      with_arcs_(arcs),
      time_(machine) {}

Vec3 ProgramText::printed(Vec3 p) const {
  return {round_to(p.x, decimals_), round_to(p.y, decimals_), round_to(p.z, decimals_)};
}

std::string ProgramText::words(Vec3 to) const {
  std::string out;
  if (!placed_ || to.x != at_.x) out += " X" + fixed(to.x, decimals_);
  if (!placed_ || to.y != at_.y) out += " Y" + fixed(to.y, decimals_);
  if (!placed_ || to.z != at_.z) out += " Z" + fixed(to.z, decimals_);
  return out;
}

void ProgramText::line(bool rapid, Vec3 to) {
  const Vec3 end = printed(to);
  const std::string axes = words(end);
  if (axes.empty()) return;
  text_ += (rapid ? "G0" : "G1") + axes + "\n";
  const Vec3 way = end - at_, heading = unit(way);
  length_ += norm(way);
  if (rapid) {
    time_.rapid(norm(way));
  } else {
    time_.goes_on(norm(way), feed_, heading, heading);
  }
  ++blocks_;
  at_ = end;
}

void ProgramText::feed(double value) {
  if (value == feed_) return;
  text_ += "F" + fixed(value, exchange::kLeastGcodeDecimals) + "\n";
  feed_ = value;
}

void ProgramText::plane(PassPlane wanted) {
  if (wanted == plane_) return;
  text_ += wanted == PassPlane::kNone ? "G17\n" : wanted == PassPlane::kXz ? "G18\n" : "G19\n";
  plane_ = wanted;
}

void ProgramText::level_plane() { plane(PassPlane::kNone); }

// The first place: up before sideways, the tool may stand anywhere.
void ProgramText::rapid(const std::vector<Vec3>& points) {
  if (!placed_) {
    const Vec3 first = printed(points.front());
    text_ += "G0 Z" + fixed(first.z, decimals_) + "\n";
    text_ += "G0 X" + fixed(first.x, decimals_) + " Y" + fixed(first.y, decimals_) + "\n";
    blocks_ += 2;
    at_ = first;
    placed_ = true;
  }
  for (const Vec3 p : points) line(true, p);
}

ProgramText::Way ProgramText::straight_way(const std::vector<Vec3>& points) const {
  Way out;
  for (const Vec3 p : thinned(points, within_)) out.steps.push_back({p, std::nullopt});
  return out;
}

double ProgramText::Block::turn() const {
  const Vec2 a = -to_centre, b = to - from - to_centre;
  return std::atan2((left ? 1.0 : -1.0) * cross(a, b), dot(a, b));
}

double ProgramText::Block::distance(Vec2 p) const {
  if (!arc) return distance_from_chord(p, from, to);
  const Vec2 a = -to_centre, b = to - from - to_centre, q = p - from - to_centre;
  const double side = left ? 1.0 : -1.0;
  const bool between = side * cross(a, q) >= 0.0 && side * cross(q, b) >= 0.0;
  return between ? std::abs(norm(q) - norm(a)) : std::min(norm(p - from), norm(p - to));
}

/// The arc over the printed chord with the height of the exact one: of all that can be kept it
/// moves the arc least. A line where controllers would not know it for an arc.
ProgramText::Block ProgramText::block(Vec2 from, Vec2 middle, Vec2 to) const {
  Block out;
  out.from = from;
  out.to = {round_to(to.x, decimals_), round_to(to.y, decimals_)};
  const Vec2 chord = out.to - from;
  const double length = norm(chord);
  if (length < exchange::kShortestChord * unit_) return out;
  const Vec2 across = left_normal(chord) / length;
  const double height = dot(middle - from, across);  // below the chord, turning left: negative
  if (std::abs(height) < exchange::kLowestArc * unit_) return out;
  const double radius = 0.5 * std::abs(height) + 0.125 * length * length / std::abs(height);
  if (radius < exchange::kSmallestRadius || radius > kLargestRadius) return out;
  out.arc = true;
  out.left = height < 0.0;
  const Vec2 centre = 0.5 * chord + (height + (out.left ? radius : -radius)) * across;
  out.to_centre = {round_to(centre.x, kLeastCentreDecimals),
                   round_to(centre.y, kLeastCentreDecimals)};
  return out;
}

/// Two blocks from the printed first place that stand for the points first .. last; nothing: they
/// are no arcs, or the blocks as printed lie too far from a point.
std::optional<std::array<ProgramText::Block, 2>> ProgramText::biarc(const Flat& flat,
                                                                    std::size_t first,
                                                                    std::size_t last) const {
  const Vec2 a = flat.points[first], b = flat.points[last];
  const Vec2 leaving = flat.directions[first], arriving = flat.directions[last];
  const auto joint = biarc_joint(a, leaving, b, arriving);
  if (!joint) return std::nullopt;
  const Vec2 c = *joint - a, d = b - *joint;
  if (dot(c, leaving) < kMostLean * norm(c) || dot(d, arriving) < kMostLean * norm(d)) {
    return std::nullopt;
  }
  const Vec3 stands = printed(flat.place(a));
  const Block one = block(flat.flat(stands), arc_middle(a, leaving, *joint), *joint);
  const Block two = block(one.to, arc_middle(b, -arriving, *joint), b);
  if (!one.arc && !two.arc) return std::nullopt;
  // where points lie far apart arcs through them may bulge: a way straight up ends a biarc
  const auto strays = [&](Vec2 from, Vec2 way) {
    return std::any_of(kOnChord.begin(), kOnChord.end(), [&](double part) {
      const Vec2 p = from + part * way;
      return std::min(one.distance(p), two.distance(p)) > kMostBulge * within_;
    });
  };
  for (std::size_t i = first + 1; i <= last; ++i) {
    if (strays(flat.points[i - 1], flat.points[i] - flat.points[i - 1])) return std::nullopt;
  }
  for (std::size_t i = first + 1; i < last; ++i) {
    const Vec2 way = flat.points[i] - flat.points[i - 1];
    if (dot(way, flat.directions[i]) < kCornerCosine * norm(way)) return std::nullopt;
    if (std::min(one.distance(flat.points[i]), two.distance(flat.points[i])) > within_) {
      return std::nullopt;
    }
  }
  return std::array{one, two};
}

void ProgramText::print(const Upright& in, const Block& block) {
  if (!block.arc) return line(false, in.place(block.to));
  const Vec3 end = printed(in.place(block.to));
  // G18 is the plane ZX seen from +Y: x and z have the other hand there
  const bool counter_clockwise = block.left != (in.plane == PassPlane::kXz);
  plane(in.plane);
  text_ += fmt::format("{}{} {}{} K{}\n", counter_clockwise ? "G3" : "G2", words(end),
                       in.plane == PassPlane::kXz ? "I" : "J",
                       fixed(block.to_centre.x, kLeastCentreDecimals),
                       fixed(block.to_centre.y, kLeastCentreDecimals));
  ++blocks_;
  ++arc_blocks_;
  const double turn = block.turn();
  const Vec2 from = -block.to_centre, to = block.to - block.from - block.to_centre;
  const double side = block.left ? 1.0 : -1.0;
  length_ += norm(from) * turn;
  time_.goes_on(norm(from) * turn, feed_, in.direction(side * left_normal(from)),
                in.direction(side * left_normal(to)));
  at_ = end;
}

ProgramText::Way ProgramText::way_of_pass(const std::vector<Vec3>& points, PassPlane in) const {
  if (!with_arcs_ || in == PassPlane::kNone || points.size() < 3) return straight_way(points);
  const Flat flat(points, in);
  std::vector<Vec3> places;
  for (const Vec2 p : flat.points) places.push_back(flat.place(p));
  Way out{flat, {{places.front(), std::nullopt}}};
  const std::size_t end = flat.points.size() - 1;
  for (std::size_t k = 0; k < end;) {
    const std::size_t by_arcs =
        furthest_good(k, std::min(end, k + kMostAhead),
                      [&](std::size_t last) { return biarc(flat, k, last).has_value(); });
    const std::size_t by_line = furthest_good(k, end, [&](std::size_t last) {
      return last - k <= kMostAhead && off_chord(places, k, last) <= within_;
    });
    const auto arcs = by_arcs > by_line + 1 ? biarc(flat, k, by_arcs) : std::nullopt;
    k = arcs ? by_arcs : by_line;
    out.steps.push_back({places[k], arcs});
  }
  return out;
}

void ProgramText::print(const Way& way, double at_feed) {
  feed(at_feed);
  for (const Way::Step& step : way.steps) {
    if (step.arcs) {
      for (const Block& block : *step.arcs) print(way.in, block);
    } else {
      line(false, step.to);
    }
  }
}

}  // namespace obvid::toolpath
