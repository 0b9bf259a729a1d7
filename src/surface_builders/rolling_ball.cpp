// SPDX-License-Identifier: Apache-2.0
#include "rolling_ball.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "obvid/core/units.h"
#include "obvid/geom/internal/directions.h"
#include "obvid/surface/internal/topology.h"

namespace obvid {
namespace {

constexpr double kMostBallTurn = 0.1, kLittleBallTurn = 0.04;  // rad in a step
constexpr double kFirstBallStep = 0.1;                         // of the radius
constexpr double kMostBallStep = 1.0 / 16.0;  // of the size, and of a face's domain
constexpr double kLeastBallStep = 1e-6;       // of the radius
constexpr double kMostOnOneFace = 8.0;     // of the radius: how far the ball goes on one face alone
constexpr double kLeastBallRadius = 1e-9;  // of the radius at the start: less is none
constexpr std::size_t kMostBallSteps = 100'000;
constexpr std::size_t kFewestBallSteps = 6;  // steps of a closed way
constexpr int kBallHalvings = 60;

/// The combination of two vectors that is nearest to a vector.
std::optional<Vec2> shares_in_plane(Vec3 target, Vec3 a, Vec3 b) {
  constexpr double kParallel = 1e-20;  // sine squared
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b);
  const double det = aa * bb - ab * ab;
  if (!(det > kParallel * aa * bb)) return std::nullopt;
  const double ta = dot(target, a), tb = dot(target, b);
  return Vec2{(bb * ta - ab * tb) / det, (aa * tb - ab * ta) / det};
}

}  // namespace

std::string near_text(Vec3 p) { return fmt::format("near {:.6g} {:.6g} {:.6g}", p.x, p.y, p.z); }

BallFace::BallFace(const SurfacePatch& patch, double side, double size)
    : patch_(patch),
      side_(side),
      bending_(patch.surface),
      u_(domain_u(patch.surface)),
      v_(domain_v(patch.surface)) {
  if (!patch.trims.empty()) {
    region_.emplace(patch);
    return;
  }
  const Topology topology = topology_of({&patch.surface}, kSameBorder * size);
  const auto closed = [&](PatchSide one) {
    const std::size_t edge = topology.edge_of[0][one];
    return edge == topology.edge_of[0][opposite(one)] && !topology.edges[edge].point;
  };
  closed_u_ = closed(kUStart);
  closed_v_ = closed(kVStart);
}

Vec2 BallFace::into_domain(Vec2 at) const {
  const auto turned = [](double t, const Range& r) {
    const double turns = std::floor((t - r.from) / r.length());
    return std::clamp(t - turns * r.length(), r.from, r.to);
  };
  return {closed_u_ ? turned(at.x, u_) : at.x, closed_v_ ? turned(at.y, v_) : at.y};
}

SurfaceJet BallFace::jet(Vec2 at) const {
  const Vec2 p = into_domain(at);
  return evaluate(patch_.surface, p.x, p.y);
}

double BallFace::bend(Vec2 at) const {
  const Vec2 p = into_domain(at);
  return bending_.at(p.x, p.y, side_ > 0.0 ? 1 : -1);
}

bool BallFace::inside(Vec2 at) const {
  const Vec2 p = into_domain(at);
  // borders belong to the face, rounding does not decide
  constexpr double kBorder = 1e-12;
  const double du = kBorder * u_.length(), dv = kBorder * v_.length();
  if (!(p.x >= u_.from - du && p.x <= u_.to + du && p.y >= v_.from - dv && p.y <= v_.to + dv)) {
    return false;
  }
  return !region_ ||
         region_->contains(std::clamp(p.x, u_.from, u_.to), std::clamp(p.y, v_.from, v_.to));
}

struct RollingBall::Offset {
  Vec3 point, inwards;
  Vec3 centre;  ///< of a ball that touches there
  Vec3 inwards_u, inwards_v;
  Vec3 centre_u, centre_v;
};

std::optional<RollingBall::Offset> RollingBall::offset(std::size_t face, Vec2 at,
                                                       double radius) const {
  const SurfaceJet jet = faces_[face]->jet(at);
  const Vec3 normal = cross(jet.du, jet.dv);
  const double length = norm(normal);
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  const double side = faces_[face]->side();
  Offset out;
  out.point = jet.point;
  out.inwards = (side / length) * normal;
  out.centre = jet.point + radius * out.inwards;
  const auto turning = [&](Vec3 slope) {
    return (side / length) * slope - (dot((side / length) * slope, out.inwards)) * out.inwards;
  };
  out.inwards_u = turning(cross(jet.duu, jet.dv) + cross(jet.du, jet.duv));
  out.inwards_v = turning(cross(jet.duv, jet.dv) + cross(jet.du, jet.dvv));
  out.centre_u = jet.du + radius * out.inwards_u;
  out.centre_v = jet.dv + radius * out.inwards_v;
  return out;
}

std::optional<RollingBall::Motion> RollingBall::motion(const std::array<Vec2, 2>& at,
                                                       double s) const {
  const double radius = radius_at(s);
  const auto a = offset(0, at[0], radius), b = offset(1, at[1], radius);
  if (!a || !b) return std::nullopt;
  const Vec3 axis = cross(a->inwards, b->inwards);
  const double sine = norm(axis);
  if (!(sine > 0.0)) return std::nullopt;
  // the centre leaves both faces as fast as the radius grows, and has speed 1
  const double both = 1.0 + dot(a->inwards, b->inwards);
  const double left = 1.0 - 2.0 * slope_ * slope_ / both;
  if (!(left > 0.0)) return std::nullopt;
  Motion out;
  out.along = (slope_ / both) * (a->inwards + b->inwards) + (std::sqrt(left) / sine) * axis;
  for (std::size_t i = 0; i < 2; ++i) {
    const Offset& o = i == 0 ? *a : *b;
    const auto by = shares_in_plane(out.along - slope_ * o.inwards, o.centre_u, o.centre_v);
    if (!by) return std::nullopt;
    out.by[i] = *by;
  }
  return out;
}

std::optional<BallPlace> RollingBall::in_plane(std::array<Vec2, 2> near, double s, Vec3 point,
                                               Vec3 normal) const {
  constexpr int kMostNewton = 30;
  constexpr double kReached = 1e-10;  // of the size and the coordinates
  const double radius = radius_at(s);
  if (!(radius > 0.0)) return std::nullopt;
  double before = HUGE_VAL;
  std::optional<BallPlace> best;
  for (int k = 0; k < kMostNewton; ++k) {
    const auto a = offset(0, near[0], radius), b = offset(1, near[1], radius);
    if (!a || !b) break;
    const Vec3 middle = 0.5 * (a->centre + b->centre);
    const double off = norm(a->centre - b->centre) + std::abs(dot(normal, middle - point));
    if (!(off < before)) break;
    before = off;
    BallPlace place{s, radius, middle, {}, {}};
    place.touch[0] = {near[0], a->point, a->inwards};
    place.touch[1] = {near[1], b->point, b->inwards};
    best = place;
    // where both offsets and the plane would cross if all were flat
    const Vec3 ab = cross(a->inwards, b->inwards), bn = cross(b->inwards, normal),
               na = cross(normal, a->inwards);
    const double det = dot(a->inwards, bn);
    if (det == 0.0) break;
    const Vec3 to =
        middle + (dot(a->inwards, a->centre - middle) * bn +
                  dot(b->inwards, b->centre - middle) * na + dot(normal, point - middle) * ab) /
                     det;
    const auto by_a = shares_in_plane(to - a->centre, a->centre_u, a->centre_v);
    const auto by_b = shares_in_plane(to - b->centre, b->centre_u, b->centre_v);
    if (!by_a || !by_b) break;
    near[0] = near[0] + *by_a;
    near[1] = near[1] + *by_b;
  }
  if (!best) return std::nullopt;
  const Vec3 c = best->centre;
  const double scale = size_ + std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  if (!(before <= kReached * scale)) return std::nullopt;
  const auto moves = motion({best->touch[0].at, best->touch[1].at}, s);
  if (!moves) return std::nullopt;
  best->along = moves->along;
  return best;
}

std::optional<BallPlace> RollingBall::stepped(const BallPlace& from, double h) const {
  const std::array<Vec2, 2> at{from.touch[0].at, from.touch[1].at};
  const auto moved = [&](const Motion& by, double part) {
    return std::array<Vec2, 2>{at[0] + part * by.by[0], at[1] + part * by.by[1]};
  };
  const auto k1 = motion(at, from.s);
  if (!k1) return std::nullopt;
  const auto k2 = motion(moved(*k1, 0.5 * h), from.s + 0.5 * h);
  if (!k2) return std::nullopt;
  const auto k3 = motion(moved(*k2, 0.5 * h), from.s + 0.5 * h);
  if (!k3) return std::nullopt;
  const auto k4 = motion(moved(*k3, h), from.s + h);
  if (!k4) return std::nullopt;
  const auto mean = [&](auto a, auto b, auto c, auto d) {
    return (1.0 / 6.0) * (a + 2.0 * b + 2.0 * c + d);
  };
  const Vec3 centre = from.centre + h * mean(k1->along, k2->along, k3->along, k4->along);
  std::array<Vec2, 2> near{};
  for (std::size_t i = 0; i < 2; ++i) {
    near[i] = at[i] + h * mean(k1->by[i], k2->by[i], k3->by[i], k4->by[i]);
  }
  return in_plane(near, from.s + h, centre, unit(k4->along));
}

namespace {

/// Follows the ball in one direction.
class BallWalker {
 public:
  BallWalker(const RollingBall& ball, const BallPlace& start, double direction,
             const RunContext& run)
      : ball_(ball), run_(run), start_(start), direction_(direction), at_(start) {}

  struct Walked {
    std::vector<BallPlace> places;  ///< without the start
    std::array<double, 2> left{};   ///< s at which each face ends
    bool closed = false;
  };

  Result<Walked> walked() {
    step_ = kFirstBallStep * start_.radius;
    OBVID_TRY(fits(start_));
    while (!(left_[0] && left_[1])) {
      if (out_.places.size() >= kMostBallSteps)
        return fail(stuck("the ball does not come to an end"));
      OBVID_TRY(may_go_on(run_));
      const auto next = next_place();
      if (!next) return fail(stuck("the ball cannot go on between the faces"));
      if (next->radius < kLeastBallRadius * start_.radius) return fail(run_out());
      OBVID_TRY(fits(*next));
      if (closes(*next)) return std::move(out_);
      for (std::size_t i = 0; i < 2; ++i) {
        const bool inside = ball_.face(i).inside(next->touch[i].at);
        if (inside && (left_[i] || jumps_a_gap(i, *next))) return fail(gap_on_the_way(i, *next));
        if (!left_[i] && !inside) left_[i] = leaves(i, *next);
      }
      if (left_[0] && left_[1]) break;
      for (std::size_t i = 0; i < 2; ++i) {
        if (left_[i] && std::abs(next->s - *left_[i]) > kMostOnOneFace * next->radius) {
          return fail(alone(i, *next));
        }
      }
      at_ = *next;
      out_.places.push_back(at_);
    }
    out_.left = {*left_[0], *left_[1]};
    const double end =
        direction_ > 0.0 ? std::max(*left_[0], *left_[1]) : std::min(*left_[0], *left_[1]);
    if (end != at_.s) {
      const auto last = ball_.stepped(at_, end - at_.s);
      if (!last) return fail(stuck("the ball cannot go on between the faces"));
      out_.places.push_back(*last);
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] Error stuck(const char* what) const {
    constexpr double kNearly = 0.9;  // of the ball's curvature
    for (std::size_t i = 0; i < 2; ++i) {
      const double bend = ball_.face(i).bend(at_.touch[i].at);
      if (bend * at_.radius < kNearly) continue;
      return error(ErrorCode::kSurfaceFolds,
                   fmt::format("a ball of radius {:g} does not go on along {}, whose radius comes "
                               "down to {:.4g}",
                               at_.radius, ball_.face(i).patch().name, 1.0 / bend))
          .where(near_text(at_.touch[i].point))
          .hint("take a smaller radius, or the other side")
          .value(1.0 / bend);
    }
    // where both normals become one the ball touches both faces in one point, whatever its radius
    constexpr double kNearlyTangent = 0.4;
    const double apart = norm(at_.touch[0].inwards - at_.touch[1].inwards);
    if (apart < kNearlyTangent) {
      return error(ErrorCode::kSurfaceFolds, what)
          .where(near_text(at_.centre))
          .hint(fmt::format(
              "the faces differ there by an angle of {:.3g} degrees only; where that comes down to "
              "0 "
              "they touch each other, and no radius goes on: cut the faces before that place",
              angle_between(at_.touch[0].inwards, at_.touch[1].inwards) / kOneDegree))
          .value(at_.radius);
    }
    return error(ErrorCode::kSurfaceFolds, what)
        .where(near_text(at_.centre))
        .hint("the faces are nearly parallel there or bend more than the ball; take another radius")
        .value(at_.radius);
  }
  [[nodiscard]] Error run_out() const {
    return error(ErrorCode::kSurfaceFolds, "the radius comes down to 0 before the faces end")
        .where(near_text(at_.centre))
        .hint("take radii that differ less")
        .value(at_.radius);
  }
  /// The ball must bend more than both faces do towards it; looked at where it touches.
  [[nodiscard]] Result<void> fits(const BallPlace& place) const {
    for (std::size_t i = 0; i < 2; ++i) {
      const double bend = ball_.face(i).bend(place.touch[i].at);
      if (bend * place.radius < 1.0) continue;
      return error(ErrorCode::kSurfaceFolds,
                   fmt::format("a ball of radius {:g} does not fit into {}, whose radius is {:.6g}",
                               place.radius, ball_.face(i).patch().name, 1.0 / bend))
          .where(near_text(place.touch[i].point))
          .hint("take a smaller radius, or the other side")
          .value(1.0 / bend);
    }
    return {};
  }
  /// Whether a part that was trimmed away lies between two places that are both on the face: looked
  /// for at 31 places, so narrower ones may be missed.
  [[nodiscard]] bool jumps_a_gap(std::size_t i, const BallPlace& next) const {
    if (!ball_.face(i).is_trimmed()) return false;
    constexpr int kParts = 32;
    for (int k = 1; k < kParts; ++k) {
      const double t = static_cast<double>(k) / kParts;
      if (!ball_.face(i).inside((1.0 - t) * at_.touch[i].at + t * next.touch[i].at)) return true;
    }
    return false;
  }

  [[nodiscard]] Error gap_on_the_way(std::size_t i, const BallPlace& place) const {
    return error(ErrorCode::kUnsupported,
                 fmt::format("a hole or notch of {} lies in the way of the ball",
                             ball_.face(i).patch().name))
        .where(near_text(place.touch[i].point))
        .hint("make the blend before the hole, or take a radius whose contact passes beside it");
  }

  [[nodiscard]] Error alone(std::size_t i, const BallPlace& place) const {
    return error(ErrorCode::kUnsupported,
                 fmt::format("the ball leaves {} long before it leaves {}",
                             ball_.face(i).patch().name, ball_.face(1 - i).patch().name))
        .where(near_text(place.touch[i].point))
        .hint("trim the longer face there first, or make the shorter one longer");
  }

  [[nodiscard]] bool is_short(const BallPlace& next) const {
    for (std::size_t i = 0; i < 2; ++i) {
      if (angle_between(at_.touch[i].inwards, next.touch[i].inwards) > kMostBallTurn) return false;
      const Vec2 by = next.touch[i].at - at_.touch[i].at, all = ball_.face(i).sizes();
      if (std::abs(by.x) > kMostBallStep * all.x || std::abs(by.y) > kMostBallStep * all.y)
        return false;
    }
    return angle_between(at_.along, next.along) <= kMostBallTurn;
  }

  std::optional<BallPlace> next_place() {
    step_ = std::min(step_, kMostBallStep * ball_.size());
    while (step_ >= kLeastBallStep * at_.radius) {
      const auto next = ball_.stepped(at_, direction_ * step_);
      if (next && is_short(*next)) {
        double turn = angle_between(at_.along, next->along);
        for (std::size_t i = 0; i < 2; ++i) {
          turn = std::max(turn, angle_between(at_.touch[i].inwards, next->touch[i].inwards));
        }
        if (turn < kLittleBallTurn) step_ *= 1.5;
        return next;
      }
      step_ *= 0.5;
    }
    return std::nullopt;
  }

  /// Where the ball leaves a face between the last place and the next one.
  [[nodiscard]] double leaves(std::size_t i, const BallPlace& next) const {
    double in = at_.s, out = next.s;
    for (int k = 0; k < kBallHalvings; ++k) {
      const double middle = 0.5 * (in + out);
      if (middle == in || middle == out) break;
      const auto place = ball_.stepped(at_, middle - at_.s);
      (place && ball_.face(i).inside(place->touch[i].at) ? in : out) = middle;
    }
    return in;
  }

  /// Whether the way comes back to its begin; then it ends there.
  bool closes(const BallPlace& next) {
    if (ball_.slope() != 0.0 || out_.places.size() < kFewestBallSteps) return false;
    const double here = dot(start_.along, at_.centre - start_.centre);
    const double there = dot(start_.along, next.centre - start_.centre);
    if (!(here * direction_ < 0.0 && there * direction_ >= 0.0)) return false;
    const double step = norm(next.centre - at_.centre);
    if (norm(next.centre - start_.centre) > 2.0 * step) return false;
    auto last =
        ball_.in_plane({next.touch[0].at, next.touch[1].at}, next.s, start_.centre, start_.along);
    if (!last) return false;
    // its arc length: the step that ends in the plane
    double in = 0.0, out = next.s - at_.s;
    for (int k = 0; k < kBallHalvings; ++k) {
      const double middle = 0.5 * (in + out);
      if (middle == in || middle == out) break;
      const auto place = ball_.stepped(at_, middle);
      if (!place) return false;
      (dot(start_.along, place->centre - start_.centre) * direction_ < 0.0 ? in : out) = middle;
    }
    last->s = at_.s + in;
    out_.places.push_back(*last);
    out_.closed = true;
    return true;
  }

  const RollingBall& ball_;
  const RunContext& run_;
  BallPlace start_;
  double direction_;
  BallPlace at_;
  double step_ = 0.0;
  std::array<std::optional<double>, 2> left_;
  Walked out_;
};

}  // namespace

Result<BallWay> way_of(const RollingBall& ball, const BallPlace& start, const RunContext& run) {
  auto on = BallWalker(ball, start, 1.0, run).walked();
  OBVID_TRY(on);
  BallWay way;
  way.places.push_back(start);
  way.places.insert(way.places.end(), on->places.begin(), on->places.end());
  way.closed = on->closed;
  const double begin = start.s, end = way.places.back().s;
  way.on = {Range{begin, way.closed ? end : on->left[0]}, {begin, way.closed ? end : on->left[1]}};
  if (way.closed) return way;
  auto back = BallWalker(ball, start, -1.0, run).walked();
  OBVID_TRY(back);
  way.places.insert(way.places.begin(), back->places.rbegin(), back->places.rend());
  for (std::size_t i = 0; i < 2; ++i) way.on[i].from = back->left[i];
  return way;
}

std::optional<BallPlace> place_at(const RollingBall& ball, const BallWay& way, double s) {
  const auto after = std::upper_bound(way.places.begin(), way.places.end(), s,
                                      [](double t, const BallPlace& p) { return t < p.s; });
  const BallPlace& from = after == way.places.begin() ? *after : *std::prev(after);
  return from.s == s ? std::optional(from) : ball.stepped(from, s - from.s);
}

}  // namespace obvid
