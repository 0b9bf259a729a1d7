// SPDX-License-Identifier: Apache-2.0
#include "lines_along.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "obvid/curve/internal/basis.h"

namespace obvid {
namespace {

constexpr int kLineSamples = 8;  // in each span of a line
constexpr int kMostFeet = 20;
constexpr int kMostLineTurns = 2;   // of a closed patch, beside the first
constexpr double kOnBorder = 1e-9;  // of the domain: places nearer to a border lie on it
constexpr int kMostOntoBorder = 40;

/// Where a segment from a to b is inside a box, as shares of it.
Range share_inside(Vec2 a, Vec2 b, const Range& u, const Range& v) {
  Range out{0.0, 1.0};
  const auto clip = [&](double from, double to, const Range& r) {
    const double step = to - from;
    if (step == 0.0) {
      if (from < r.from || from > r.to) out = {1.0, 0.0};
      return;
    }
    double in = (r.from - from) / step, end = (r.to - from) / step;
    if (in > end) std::swap(in, end);
    out.from = std::max(out.from, in);
    out.to = std::min(out.to, end);
  };
  clip(a.x, b.x, u);
  clip(a.y, b.y, v);
  return out;
}

/// Cuts places along a line to a box of parameters.
class LineClip {
 public:
  LineClip(const NurbsSurface& part, const CuttingField& field)
      : part_(part), field_(field), u_(domain_u(part)), v_(domain_v(part)) {}

  /// All pieces of an open line.
  void open(const std::vector<Vec2>& places, std::vector<CutLine>& out) const {
    pieces(places, places.size(), false, out);
  }
  /// Of a closed one, whose last place is the first, by `turn` farther.
  void closed(const std::vector<Vec2>& places, Vec2 turn, std::vector<CutLine>& out) const {
    const std::size_t n = places.size() - 1;
    const bool here = std::all_of(places.begin(), places.end(), [&](Vec2 p) {
      return p.x >= u_.from && p.x <= u_.to && p.y >= v_.from && p.y <= v_.to;
    });
    if (here && std::hypot(turn.x / u_.length(), turn.y / v_.length()) < 0.5) {
      out.push_back({{places.begin(), places.end() - 1}, true});
      return;
    }
    // twice around, and of that what begins at a border in the first round
    std::vector<Vec2> twice(places.begin(), places.end() - 1);
    for (std::size_t i = 0; i < n; ++i) twice.push_back(places[i] + turn);
    twice.push_back(places.back() + turn);
    pieces(twice, n, true, out);
  }

 private:
  void pieces(const std::vector<Vec2>& places, std::size_t last_begin, bool from_border,
              std::vector<CutLine>& out) const {
    CutLine line;
    bool wanted = false;
    const auto end = [&] {
      if (wanted && is_long(line)) out.push_back(std::move(line));
      line = {};
      wanted = false;
    };
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      const Vec2 a = places[i], b = places[i + 1];
      const Range in = share_inside(a, b, u_, v_);
      if (!(in.from < in.to)) {
        end();
        continue;
      }
      if (line.places.empty()) {
        const bool crosses = in.from > 0.0 || on_border(a);
        wanted = i < last_begin && (crosses || !from_border);
        const Vec2 at = a + in.from * (b - a);
        line.places.push_back(crosses ? onto_border(at) : at);
      }
      const Vec2 at = a + in.to * (b - a);
      const bool leaves = in.to < 1.0 || on_border(b);
      line.places.push_back(leaves ? onto_border(at) : at);
      if (leaves) end();
    }
    // an open line ends where it ends; a closed one has come around before
    if (from_border) wanted = false;
    end();
  }

  /// Not within what counts as one place.
  [[nodiscard]] bool is_long(const CutLine& line) const {
    return std::any_of(line.places.begin(), line.places.end(), [&](Vec2 p) {
      return std::abs(p.x - line.places.front().x) > 2.0 * kOnBorder * u_.length() ||
             std::abs(p.y - line.places.front().y) > 2.0 * kOnBorder * v_.length();
    });
  }

  [[nodiscard]] bool on_border(Vec2 p) const {
    const double du = kOnBorder * u_.length(), dv = kOnBorder * v_.length();
    return std::abs(p.x - u_.from) <= du || std::abs(p.x - u_.to) <= du ||
           std::abs(p.y - v_.from) <= dv || std::abs(p.y - v_.to) <= dv;
  }

  /// Onto the line and the nearest border at once: in turns.
  [[nodiscard]] Vec2 onto_border(Vec2 p) const {
    const std::array<double, 4> off{
        std::abs(p.x - u_.from) / u_.length(), std::abs(p.x - u_.to) / u_.length(),
        std::abs(p.y - v_.from) / v_.length(), std::abs(p.y - v_.to) / v_.length()};
    const auto side = std::min_element(off.begin(), off.end()) - off.begin();
    const auto put = [&](Vec2 q) {
      if (side == 0) q.x = u_.from;
      if (side == 1) q.x = u_.to;
      if (side == 2) q.y = v_.from;
      if (side == 3) q.y = v_.to;
      return Vec2{std::clamp(q.x, u_.from, u_.to), std::clamp(q.y, v_.from, v_.to)};
    };
    p = put(p);
    for (int k = 0; k < kMostOntoBorder; ++k) {
      const Vec2 next = put(onto_cut(part_, field_, p));
      if (next.x == p.x && next.y == p.y) break;
      p = next;
    }
    return p;
  }

  const NurbsSurface& part_;
  const CuttingField& field_;
  Range u_, v_;
};

}  // namespace

FieldBesideLines::FieldBesideLines(const std::vector<LineAlong>& lines) : lines_(lines) {
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::vector<double> knots = distinct(lines[k].curve.knots);
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      for (int n = 0; n <= kLineSamples; ++n) {
        const double t = Range{knots[i], knots[i + 1]}.at(static_cast<double>(n) / kLineSamples);
        samples_.push_back({k, t, evaluate(lines[k].curve, t).point});
      }
    }
  }
}

FieldBesideLines::Foot FieldBesideLines::foot(Vec3 p) const {
  const auto square = [&](const Sample& s) { return dot(p - s.point, p - s.point); };
  const Sample* best = &samples_.front();
  double least = square(*best);
  for (const Sample& s : samples_) {
    const double here = square(s);
    if (here < least) {
      least = here;
      best = &s;
    }
  }
  const LineAlong& line = lines_[best->line];
  const Range all = domain(line.curve);
  double t = best->t;
  SpaceJet jet = evaluate(line.curve, t);
  for (int k = 0; k < kMostFeet; ++k) {
    const Vec3 off = p - jet.point;
    const double slope = dot(off, jet.d1), bend = dot(jet.d1, jet.d1) - dot(off, jet.d2);
    const double step = slope / (bend > 0.0 ? bend : dot(jet.d1, jet.d1));
    double next = t + step;
    if (line.closed && (next < all.from || next > all.to)) {
      next += next < all.from ? all.length() : -all.length();
    }
    next = std::clamp(next, all.from, all.to);
    if (!(std::abs(next - t) > 0.0)) break;
    t = next;
    jet = evaluate(line.curve, t);
  }
  const Vec3 along = unit(jet.d1), kept = line.kept(t);
  return {jet.point, unit(kept - dot(kept, along) * along)};
}

double FieldBesideLines::value(Vec3 p) const {
  const Foot f = foot(p);
  return dot(p - f.point, f.across);
}

Vec3 FieldBesideLines::rise(Vec3 p) const { return foot(p).across; }

Result<std::vector<CutLine>> lines_on(const NurbsSurface& part, const NurbsSurface& whole,
                                      const CuttingField& field,
                                      const std::vector<LineAlong>& lines) {
  const Range u = domain_u(whole), v = domain_v(whole);
  const LineClip clip(part, field);
  // patches that close on themselves come in parts
  const int turns_u = domain_u(part).length() < u.length() ? kMostLineTurns : 0,
            turns_v = domain_v(part).length() < v.length() ? kMostLineTurns : 0;
  std::vector<CutLine> out;
  for (const LineAlong& line : lines) {
    const Vec2 turn = line.places.back() - line.places.front();
    for (int i = -turns_u; i <= turns_u; ++i) {
      for (int k = -turns_v; k <= turns_v; ++k) {
        const Vec2 by{i * u.length(), k * v.length()};
        std::vector<Vec2> places = line.places;
        for (Vec2& p : places) p = p + by;
        if (line.closed) {
          clip.closed(places, turn, out);
        } else {
          clip.open(places, out);
        }
      }
    }
  }
  return out;
}

}  // namespace obvid
