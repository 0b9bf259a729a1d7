// SPDX-License-Identifier: Apache-2.0
#include "trim_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace obvid {
namespace {

constexpr int kLineMeasured = 9;
constexpr int kMostLineHalvings = 12;
constexpr double kLineNudge = 1e-7;   // of the chord: beside a knot or a pole
constexpr double kLineCorner = 1e-5;  // rad
constexpr double kMostTurn = 0.6;     // cosine between direction and chord, at least
constexpr double kMostLonger = 1.3;   // of the chord: how long the places of one span are
constexpr double kLineShare = 0.5;    // of the tolerance

/// Inverse of the first fundamental form on the slopes: the step along the surface by which the
/// value changes by its slope squared.
Vec2 climb_of(const CutPlace& p, double& square) {
  const double e = dot(p.jet.du, p.jet.du), f = dot(p.jet.du, p.jet.dv),
               g = dot(p.jet.dv, p.jet.dv);
  const double det = e * g - f * f;
  square = 0.0;
  if (!(det > 0.0)) return {};
  const Vec2 step{(g * p.slope_u - f * p.slope_v) / det, (e * p.slope_v - f * p.slope_u) / det};
  square = step.x * p.slope_u + step.y * p.slope_v;
  return step;
}

Vec2 clamped(const NurbsSurface& s, Vec2 at) {
  const Range u = domain_u(s), v = domain_v(s);
  return {std::clamp(at.x, u.from, u.to), std::clamp(at.y, v.from, v.to)};
}

/// A cubic from end to end over [0, length].
struct Span {
  std::array<Vec2, 4> b{};
  double length = 0.0;

  [[nodiscard]] Vec2 at(double part) const {
    const double q = 1.0 - part;
    return q * q * q * b[0] + 3.0 * q * q * part * b[1] + 3.0 * q * part * part * b[2] +
           part * part * part * b[3];
  }
};

class LineFitter {
 public:
  LineFitter(const NurbsSurface& surface, const CuttingField& field, double tolerance)
      : s_(surface), field_(field), tolerance_(tolerance) {}

  Result<TrimLine> made(std::vector<Vec2> places, bool closed) {
    places = apart(places);
    if (closed) places = from_corner(std::move(places));
    places_ = std::move(places);
    find_directions(closed);
    std::size_t from = 0;
    for (std::size_t i = 1; i < places_.size(); ++i) {
      if (i + 1 < places_.size() && !corner_[i]) continue;
      spans_.clear();
      OBVID_TRY(fit(from, i));
      out_.curves.push_back(joined());
      from = i;
    }
    return std::move(out_);
  }

 private:
  struct End {
    Vec2 at;
    Vec2 direction;  ///< of the parameters by the length along the cut
  };

  /// Without places that lie on the one before, but for the last.
  [[nodiscard]] std::vector<Vec2> apart(const std::vector<Vec2>& places) const {
    constexpr double kOnOther = 1e-3;  // of the tolerance
    std::vector<Vec2> out;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool last = i + 1 == places.size();
      const bool same = !out.empty() && chord_of(out.back(), places[i]) <= kOnOther * tolerance_;
      if (same && last && out.size() > 1) out.back() = places[i];
      if (!same || (last && out.size() == 1)) out.push_back(places[i]);
    }
    return out;
  }

  /// The first place again at the end; it is a corner where there is one.
  std::vector<Vec2> from_corner(std::vector<Vec2> places) {
    const std::size_t n = places.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 back = direction(places[i], places[(i + n - 1) % n], true);
      const Vec2 on = direction(places[i], places[(i + 1) % n], true);
      if (!turns(places[i], -back, on)) continue;
      std::rotate(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(i), places.end());
      break;
    }
    places.push_back(places.front());
    return places;
  }

  [[nodiscard]] Vec3 in_space(Vec2 at, Vec2 direction) const {
    const SurfaceJet jet = evaluate(s_, at.x, at.y);
    return direction.x * jet.du + direction.y * jet.dv;
  }
  [[nodiscard]] bool turns(Vec2 at, Vec2 before, Vec2 after) const {
    return norm(in_space(at, before) - in_space(at, after)) > kLineCorner;
  }

  /// Along the cut towards another place, of length 1 in space; `beside`: a little that way.
  [[nodiscard]] Vec2 direction(Vec2 at, Vec2 towards, bool beside) const {
    const Vec2 step = towards - at;
    const Vec2 here = beside ? at + kLineNudge * step : at;
    const CutPlace p = cut_place(s_, field_, here);
    Vec2 along{p.slope_v, -p.slope_u};
    Vec3 way = along.x * p.jet.du + along.y * p.jet.dv;
    double length = norm(way);
    if (!(length > 0.0)) {
      along = step;
      way = along.x * p.jet.du + along.y * p.jet.dv;
      length = norm(way);
      if (!(length > 0.0)) return {};
    }
    const Vec3 chord = evaluate(s_, towards.x, towards.y).point - evaluate(s_, at.x, at.y).point;
    return (dot(way, chord) < 0.0 ? -1.0 : 1.0) / length * along;
  }

  void find_directions(bool closed) {
    const std::size_t n = places_.size();
    corner_.assign(n, false);
    before_.assign(n, {});
    after_.assign(n, {});
    for (std::size_t i = 0; i < n; ++i) {
      const bool has_before = i > 0 || closed, has_after = i + 1 < n || closed;
      const Vec2 previous = places_[i > 0 ? i - 1 : n - 2], next = places_[i + 1 < n ? i + 1 : 1];
      if (has_before) before_[i] = -direction(places_[i], previous, true);
      if (has_after) after_[i] = direction(places_[i], next, true);
      if (!has_before) before_[i] = after_[i];
      if (!has_after) after_[i] = before_[i];
      if (!has_before || !has_after) continue;
      corner_[i] = turns(places_[i], before_[i], after_[i]);
      if (!corner_[i]) before_[i] = after_[i] = 0.5 * (before_[i] + after_[i]);
    }
  }

  [[nodiscard]] Span between(const End& a, const End& b) const {
    const double chord =
        norm(evaluate(s_, b.at.x, b.at.y).point - evaluate(s_, a.at.x, a.at.y).point);
    const double bend = std::acos(
        std::clamp(dot(in_space(a.at, a.direction), in_space(b.at, b.direction)), -1.0, 1.0));
    const double half = 0.5 * bend;
    Span span;
    span.length = half > 0.0 ? chord * half / std::sin(half) : chord;
    const double third = span.length / 3.0;
    span.b = {a.at, clamped(s_, a.at + third * a.direction),
              clamped(s_, b.at - third * b.direction), b.at};
    return span;
  }

  /// Largest distance from the cut, infinite where the curve may not be it at all.
  [[nodiscard]] double off(const Span& span, const End& a, const End& b) const {
    const Vec3 from = evaluate(s_, a.at.x, a.at.y).point, to = evaluate(s_, b.at.x, b.at.y).point;
    const Vec3 chord = to - from;
    const double length = norm(chord);
    if (dot(in_space(a.at, a.direction), chord) < kMostTurn * length ||
        dot(in_space(b.at, b.direction), chord) < kMostTurn * length) {
      return HUGE_VAL;
    }
    double most = 0.0;
    for (int k = 1; k <= kLineMeasured; ++k) {
      const Vec2 at = span.at(static_cast<double>(k) / (kLineMeasured + 1));
      most = std::max(most, cut_place(s_, field_, at).off());
    }
    return most;
  }

  Result<void> fit(std::size_t from, std::size_t to) {
    const End a{places_[from], after_[from]}, b{places_[to], before_[to]};
    double along = 0.0;
    for (std::size_t i = from; i < to; ++i) along += chord_of(places_[i], places_[i + 1]);
    const bool straight = along <= kMostLonger * chord_of(a.at, b.at);
    if (to == from + 1) return halved(a, b, 0);
    if (straight) {
      const Span span = between(a, b);
      const double found = off(span, a, b);
      if (found <= kLineShare * tolerance_) return take(span, found);
    }
    const std::size_t middle = from + (to - from) / 2;
    OBVID_TRY(fit(from, middle));
    return fit(middle, to);
  }

  Result<void> halved(const End& a, const End& b, int halvings) {
    const Span span = between(a, b);
    const double found = off(span, a, b);
    if (found <= kLineShare * tolerance_) return take(span, found);
    if (halvings >= kMostLineHalvings) {
      const Vec3 p = evaluate(s_, a.at.x, a.at.y).point;
      if (found <= tolerance_) return take(span, found);
      return error(ErrorCode::kToleranceNotReached,
                   "the line of a cut does not come within the tolerance of it")
          .where("near " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
                 std::to_string(p.z))
          .hint("the surface nearly touches what cuts it there; move it a little, or allow more");
    }
    const Vec2 middle = onto_cut(s_, field_, span.at(0.5));
    End m{middle, direction(middle, b.at, false)};
    OBVID_TRY(halved(a, m, halvings + 1));
    return halved(m, b, halvings + 1);
  }

  Result<void> take(const Span& span, double found) {
    out_.deviation = std::max(out_.deviation, found);
    spans_.push_back(span);
    return {};
  }

  [[nodiscard]] double chord_of(Vec2 a, Vec2 b) const {
    return norm(evaluate(s_, a.x, a.y).point - evaluate(s_, b.x, b.y).point);
  }

  /// The spans as one curve with knots twice: C1, because neighbours have the same direction.
  [[nodiscard]] NurbsCurve joined() const {
    NurbsCurve curve;
    curve.degree = 3;
    double at = 0.0;
    curve.knots.assign(4, at);
    curve.points.push_back(spans_.front().b[0]);
    for (std::size_t i = 0; i < spans_.size(); ++i) {
      const bool last = i + 1 == spans_.size();
      curve.points.push_back(spans_[i].b[1]);
      curve.points.push_back(spans_[i].b[2]);
      at += spans_[i].length;
      // a clamped control point breaks the direction: the place itself is kept then
      const Vec2 mean =
          last
              ? Vec2{}
              : (1.0 / (spans_[i].length + spans_[i + 1].length)) *
                    (spans_[i + 1].length * spans_[i].b[2] + spans_[i].length * spans_[i + 1].b[1]);
      const bool smooth = !last && norm(mean - spans_[i].b[3]) <=
                                       kRounding * (norm(spans_[i].b[3] - spans_[i].b[0]));
      const std::size_t times = last ? 4 : smooth ? 2 : 3;
      if (last || !smooth) curve.points.push_back(spans_[i].b[3]);
      curve.knots.insert(curve.knots.end(), times, at);
    }
    return curve;
  }
  static constexpr double kRounding = 1e-9;  // of a span

  const NurbsSurface& s_;
  const CuttingField& field_;
  double tolerance_;
  std::vector<Vec2> places_, before_, after_;
  std::vector<bool> corner_;
  std::vector<Span> spans_;
  TrimLine out_;
};

}  // namespace

CutPlace cut_place(const NurbsSurface& surface, const CuttingField& field, Vec2 at) {
  CutPlace out;
  out.jet = evaluate(surface, at.x, at.y);
  out.value = field.value(out.jet.point);
  const Vec3 rise = field.rise(out.jet.point);
  out.slope_u = dot(rise, out.jet.du);
  out.slope_v = dot(rise, out.jet.dv);
  return out;
}

Vec2 onto_cut(const NurbsSurface& surface, const CuttingField& field, Vec2 at) {
  constexpr int kMostNewton = 12;
  double before = HUGE_VAL;
  for (int k = 0; k < kMostNewton; ++k) {
    const CutPlace p = cut_place(surface, field, at);
    double square = 0.0;
    const Vec2 step = climb_of(p, square);
    if (!(square > 0.0) || !(std::abs(p.value) < before)) break;
    before = std::abs(p.value);
    at = clamped(surface, at - (p.value / square) * step);
  }
  return at;
}

double CutPlace::off() const {
  double square = 0.0;
  climb_of(*this, square);
  return square > 0.0 ? std::abs(value) / std::sqrt(square) : std::abs(value);
}

Result<TrimLine> trim_line(const NurbsSurface& surface, const CuttingField& field,
                           const std::vector<Vec2>& places, bool closed, double tolerance) {
  return LineFitter(surface, field, tolerance).made(places, closed);
}

}  // namespace obvid
