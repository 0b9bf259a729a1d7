// SPDX-License-Identifier: Apache-2.0
#include "trim_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "obvid/curve/internal/basis.h"
#include "obvid/geom/internal/box.h"
#include "obvid/geom/internal/polygon.h"
#include "obvid/numeric/internal/root.h"
#include "obvid/surface/internal/trim.h"

namespace obvid {
namespace {

constexpr int kPlacesPerCurve = 16, kPlacesPerCrossedSpan = 8;
constexpr double kInwards = 1e-6;  // of the domain: where the sign beside a pole is asked for

Error unclear(const SurfacePatch& patch, const char* what, const Vec3& p) {
  return error(ErrorCode::kUnsupported, what)
      .where(patch.name + ", near " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
             std::to_string(p.z))
      .hint("it may touch a border or corner there; move what cuts a little");
}

/// A place at which the border of what is there changes sides.
struct Crossing {
  std::size_t loop = 0, curve = 0;
  double t = 0.0;
  Vec2 at;
  bool to_kept = false;  ///< what comes after it along the loop is kept
  bool used = false;     ///< a line ends there
};

/// A line inside of what is there, from crossing to crossing.
struct Chord {
  std::vector<Vec2> places;
  std::size_t from = 0, to = 0;
};

NurbsCurve part_of(const NurbsCurve& curve, double from, double to) {
  NurbsCurve out = curve;
  const Range all = domain(curve);
  if (to < all.to) out = split(out, to)[0];
  if (from > all.from) out = split(out, from)[1];
  return out;
}

class PatchTrimmer {
 public:
  PatchTrimmer(const SurfacePatch& patch, const CuttingField& field, bool keep_positive,
               double tolerance, double small)
      : patch_(patch),
        s_(patch.surface),
        field_(field),
        sign_(keep_positive ? 1.0 : -1.0),
        tolerance_(tolerance),
        small_(small),
        region_(patch),
        u_(domain_u(s_)),
        v_(domain_v(s_)),
        loops_(patch.trims.empty() ? std::vector<TrimLoop>{outline_of(s_)} : patch.trims) {
    for (const PatchSide side : kPatchSides) pole_[side] = pole_of(s_, side, small_).has_value();
  }

  Result<TrimmedPatch> made(const std::vector<CutLine>& lines) {
    find_crossings(lines);
    for (const CutLine& line : lines) {
      if (line.closed && patch_.trims.empty()) {
        closed_.push_back(line.places);
      } else {
        OBVID_TRY(take(line));
      }
    }
    for (const Crossing& one : crossings_) {
      if (!one.used) {
        return fail(
            unclear(patch_, "no line of the cut ends where the border crosses it", point(one.at)));
      }
    }
    OBVID_TRY(join());
    OBVID_TRY(add_closed());
    out_.there = !out_.trims.empty();
    out_.cut = !crossings_.empty() || !closed_.empty();
    if (!out_.cut) out_.trims = patch_.trims;
    return std::move(out_);
  }

 private:
  [[nodiscard]] Vec3 point(Vec2 at) const { return evaluate(s_, at.x, at.y).point; }

  /// The value on a border, of sides that are points a little inside.
  [[nodiscard]] double kept_value(Vec2 at) const {
    const double du = kInwards * u_.length(), dv = kInwards * v_.length();
    if (pole_[kUStart] && at.x < u_.from + du) at.x = u_.from + du;
    if (pole_[kUEnd] && at.x > u_.to - du) at.x = u_.to - du;
    if (pole_[kVStart] && at.y < v_.from + dv) at.y = v_.from + dv;
    if (pole_[kVEnd] && at.y > v_.to - dv) at.y = v_.to - dv;
    return sign_ * field_.value(point(at));
  }

  [[nodiscard]] std::vector<double> places_of(const NurbsCurve& curve) const {
    Box2 box;
    for (const Vec2 p : curve.points) box.add(p);
    const auto crossed = [](const std::vector<double>& knots, double from, double to) {
      std::size_t n = 0;
      for (std::size_t i = 1; i < knots.size(); ++i) {
        if (knots[i - 1] < knots[i] && knots[i] > from && knots[i - 1] < to) ++n;
      }
      return n;
    };
    const std::size_t n =
        kPlacesPerCurve + kPlacesPerCrossedSpan * (crossed(s_.knots_u, box.low.x, box.high.x) +
                                                   crossed(s_.knots_v, box.low.y, box.high.y));
    std::vector<double> out;
    const Range all = domain(curve);
    for (std::size_t i = 0; i <= n; ++i) {
      out.push_back(all.at(static_cast<double>(i) / static_cast<double>(n)));
    }
    out.insert(out.end(), curve.knots.begin(), curve.knots.end());
    std::sort(out.begin(), out.end());
    return distinct(std::move(out));
  }

  /// With a place between each two that lines of the cut meet, so that both crossings are seen
  /// however near to each other they are.
  [[nodiscard]] static std::vector<double> with_places_between(const NurbsCurve& curve,
                                                               std::vector<double> places,
                                                               const std::vector<CutLine>& lines) {
    std::vector<double> met;
    Vec2 a = evaluate(curve, places.front()).point;
    for (std::size_t i = 1; i < places.size(); ++i) {
      const Vec2 b = evaluate(curve, places[i]).point;
      for (const CutLine& line : lines) {
        for (std::size_t k = 0; k + (line.closed ? 0 : 1) < line.places.size(); ++k) {
          const auto part =
              part_met(a, b, line.places[k], line.places[(k + 1) % line.places.size()]);
          if (part) met.push_back(places[i - 1] + *part * (places[i] - places[i - 1]));
        }
      }
      a = b;
    }
    std::sort(met.begin(), met.end());
    for (std::size_t i = 1; i < met.size(); ++i) places.push_back(0.5 * (met[i - 1] + met[i]));
    std::sort(places.begin(), places.end());
    return distinct(std::move(places));
  }

  /// The part of a chord a-b at which it meets the chord p-q.
  [[nodiscard]] static std::optional<double> part_met(Vec2 a, Vec2 b, Vec2 p, Vec2 q) {
    constexpr double kBeyond = 1e-6;  // of a chord: lines that end on a border end there but for
                                      // rounding
    const Vec2 along = b - a, over = q - p;
    const double turn = cross(along, over);
    if (turn == 0.0) return std::nullopt;
    const double part = cross(p - a, over) / turn, beside = cross(p - a, along) / turn;
    if (std::abs(part - 0.5) > 0.5 + kBeyond || std::abs(beside - 0.5) > 0.5 + kBeyond) {
      return std::nullopt;
    }
    return std::clamp(part, 0.0, 1.0);
  }

  void find_crossings(const std::vector<CutLine>& lines) {
    for (std::size_t l = 0; l < loops_.size(); ++l) {
      for (std::size_t c = 0; c < loops_[l].curves.size(); ++c) {
        const NurbsCurve& curve = loops_[l].curves[c];
        const auto value = [&](double t) { return kept_value(evaluate(curve, t).point); };
        const std::vector<double> places = with_places_between(curve, places_of(curve), lines);
        double before = value(places.front());
        // between the end of one curve and the begin of the next nothing lies, but rounding may
        if (last_ && (*last_ < 0.0) != (before < 0.0)) add(l, c, places.front(), before >= 0.0);
        for (std::size_t i = 1; i < places.size(); ++i) {
          const double here = value(places[i]);
          if ((here < 0.0) != (before < 0.0)) {
            add(l, c, root_of(value, places[i - 1], places[i], before, here), here >= 0.0);
          }
          before = here;
        }
        last_ = before;
      }
      // nor before the first one
      const double first = kept_value(loops_[l].curves.front().points.front());
      if ((*last_ < 0.0) != (first < 0.0)) {
        add(l, 0, domain(loops_[l].curves.front()).from, first >= 0.0);
        const auto begin = std::find_if(crossings_.begin(), crossings_.end(),
                                        [&](const Crossing& one) { return one.loop == l; });
        std::rotate(begin, std::prev(crossings_.end()), crossings_.end());
      }
      last_.reset();
    }
  }
  void add(std::size_t loop, std::size_t curve, double t, bool to_kept) {
    crossings_.push_back(
        {loop, curve, t, evaluate(loops_[loop].curves[curve], t).point, to_kept, false});
  }

  /// The parts of a line that are inside, each from crossing to crossing.
  Result<void> take(const CutLine& line) {
    std::vector<Vec2> places = patch_.trims.empty() ? line.places : dense(line);
    std::vector<bool> inside;
    bool all = true, none = true;
    for (const Vec2 p : places) {
      inside.push_back(patch_.trims.empty() || is_inside(p));
      (inside.back() ? none : all) = false;
    }
    if (all && line.closed) {
      closed_.push_back(std::move(places));
      return {};
    }
    if (none) return {};
    if (line.closed) {  // begin outside
      const auto at = std::find(inside.begin(), inside.end(), false) - inside.begin();
      std::rotate(places.begin(), places.begin() + at, places.end());
      std::rotate(inside.begin(), inside.begin() + at, inside.end());
      places.push_back(places.front());
      inside.push_back(false);
    }
    for (std::size_t i = 0; i < places.size();) {
      if (!inside[i]) {
        ++i;
        continue;
      }
      std::size_t end = i;
      while (end + 1 < places.size() && inside[end + 1]) ++end;
      Chord chord{{places.begin() + static_cast<std::ptrdiff_t>(i),
                   places.begin() + static_cast<std::ptrdiff_t>(end) + 1},
                  0,
                  0};
      OBVID_TRY(end_at(chord, i == 0 ? places[i] : places[i - 1], false));
      OBVID_TRY(end_at(chord, end + 1 < places.size() ? places[end + 1] : places[end], true));
      chords_.push_back(std::move(chord));
      i = end + 1;
    }
    return {};
  }

  /// With more places between, so that what lies between two crossings of a trim is seen.
  [[nodiscard]] std::vector<Vec2> dense(const CutLine& line) const {
    constexpr std::size_t kPlaces = 512, kLeast = 4;
    const std::size_t n = line.places.size(), parts = kLeast + kPlaces / n;
    std::vector<Vec2> out;
    for (std::size_t i = 0; i < n; ++i) {
      out.push_back(line.places[i]);
      if (i + 1 == n && !line.closed) break;
      const Vec2 step = line.places[(i + 1) % n] - line.places[i];
      for (std::size_t k = 1; k < parts; ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(parts);
        out.push_back(onto_cut(s_, field_, line.places[i] + part * step));
      }
    }
    return out;
  }

  [[nodiscard]] bool is_inside(Vec2 p) const {
    constexpr double kBorder = 1e-9;
    const double du = kBorder * u_.length(), dv = kBorder * v_.length();
    return region_.contains(std::clamp(p.x, u_.from + du, u_.to - du),
                            std::clamp(p.y, v_.from + dv, v_.to - dv));
  }

  /// The end of a chord becomes the nearest crossing, which is one between the last place inside
  /// and the first outside.
  Result<void> end_at(Chord& chord, Vec2 beyond, bool at_end) {
    const Vec2 last = at_end ? chord.places.back() : chord.places.front();
    const Vec3 p = point(last), q = point(beyond);
    const auto apart = [&](const Crossing& one) {
      // on sides that are points places are told apart by their parameters
      const Vec2 near = one.at - 0.5 * (last + beyond);
      return std::hypot(near.x / u_.length(), near.y / v_.length());
    };
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < crossings_.size(); ++i) {
      if (!crossings_[i].used && (!best || apart(crossings_[i]) < apart(crossings_[*best]))) {
        best = i;
      }
    }
    constexpr double kReach = 2.0;
    const double reach = kReach * norm(q - p) + kRoom * small_;
    if (!best || norm(point(crossings_[*best].at) - p) > reach) {
      return fail(unclear(patch_, "a line of the cut does not end on the border", p));
    }
    Crossing& found = crossings_[*best];
    found.used = true;
    (at_end ? chord.to : chord.from) = *best;
    // a place that lies on the crossing gives way to it
    const bool same = norm(point(found.at) - p) <= kSame * tolerance_ && chord.places.size() > 1;
    if (at_end) {
      if (same) chord.places.pop_back();
      chord.places.push_back(found.at);
    } else {
      if (same) chord.places.erase(chord.places.begin());
      chord.places.insert(chord.places.begin(), found.at);
    }
    return {};
  }

  /// Kept parts of the border and chords, one after the other.
  Result<void> join() {
    std::vector<bool> done(crossings_.size(), false);
    for (std::size_t i = 0; i < crossings_.size(); ++i) {
      if (done[i] || !crossings_[i].to_kept) continue;
      TrimLoop loop;
      std::size_t at = i;
      while (!done[at]) {
        done[at] = true;
        const std::size_t end = add_border(at, loop);
        done[end] = true;
        const auto chord = std::find_if(chords_.begin(), chords_.end(), [&](const Chord& one) {
          return one.from == end || one.to == end;
        });
        if (chord == chords_.end()) {
          return fail(
              unclear(patch_, "a border that is kept ends nowhere", point(crossings_[end].at)));
        }
        OBVID_TRY(add_chord(*chord, chord->from == end, loop));
        at = chord->from == end ? chord->to : chord->from;
        if (!crossings_[at].to_kept) {
          return fail(unclear(patch_, "a line of the cut leads to the wrong side",
                              point(crossings_[at].at)));
        }
      }
      if (at != i) return fail(unclear(patch_, "a trim does not close", point(crossings_[at].at)));
      close(loop);
      if (!is_nothing(loop)) out_.trims.push_back(std::move(loop));
    }
    // loops that nothing crosses
    for (std::size_t l = 0; l < loops_.size(); ++l) {
      if (std::any_of(crossings_.begin(), crossings_.end(),
                      [&](const Crossing& one) { return one.loop == l; })) {
        continue;
      }
      double most = 0.0;
      for (const NurbsCurve& curve : loops_[l].curves) {
        for (const double t : places_of(curve)) {
          const double here = kept_value(evaluate(curve, t).point);
          if (std::abs(here) > std::abs(most)) most = here;
        }
      }
      if (most > 0.0) out_.trims.push_back(loops_[l]);
    }
    return {};
  }

  /// From a crossing along the loop to the next one.
  std::size_t add_border(std::size_t from, TrimLoop& out) const {
    const Crossing& a = crossings_[from];
    const std::vector<NurbsCurve>& curves = loops_[a.loop].curves;
    // crossings stand in the order of their loop
    std::size_t to = from;
    do {
      to = to + 1 < crossings_.size() && crossings_[to + 1].loop == a.loop ? to + 1
                                                                           : first_of(a.loop);
    } while (crossings_[to].to_kept && to != from);
    const Crossing& b = crossings_[to];
    const auto add_curve = [&](std::size_t c, bool first, bool last) {
      const Range all = domain(curves[c]);
      const double t = first ? a.t : all.from, end = last ? b.t : all.to;
      if (t < end) out.curves.push_back(part_of(curves[c], t, end));
    };
    if (to > from) {
      for (std::size_t c = a.curve; c <= b.curve; ++c) add_curve(c, c == a.curve, c == b.curve);
    } else {  // over the begin of the loop
      for (std::size_t c = a.curve; c < curves.size(); ++c) add_curve(c, c == a.curve, false);
      for (std::size_t c = 0; c <= b.curve; ++c) add_curve(c, false, c == b.curve);
    }
    return to;
  }
  [[nodiscard]] std::size_t first_of(std::size_t loop) const {
    std::size_t i = 0;
    while (crossings_[i].loop != loop) ++i;
    return i;
  }

  Result<void> add_chord(const Chord& chord, bool forwards, TrimLoop& out) {
    std::vector<Vec2> places = chord.places;
    if (!forwards) std::reverse(places.begin(), places.end());
    return add_line(places, false, out);
  }
  Result<void> add_line(const std::vector<Vec2>& places, bool closed, TrimLoop& out) {
    auto line = trim_line(s_, field_, places, closed, tolerance_);
    if (!line) {
      Error error = line.error();
      error.where = patch_.name + (error.where.empty() ? "" : ", " + error.where);
      return fail(std::move(error));
    }
    out_.deviation = std::max(out_.deviation, line->deviation);
    out.curves.insert(out.curves.end(), line->curves.begin(), line->curves.end());
    return {};
  }

  Result<void> add_closed() {
    for (std::vector<Vec2>& places : closed_) {
      // what is kept to the left
      double left = 0.0;
      for (std::size_t i = 0; i < places.size(); ++i) {
        const Vec2 step = places[(i + 1) % places.size()] - places[i];
        const CutPlace p = cut_place(s_, field_, places[i]);
        left += sign_ * cross(step, Vec2{p.slope_u, p.slope_v});
      }
      if (left < 0.0) std::reverse(places.begin(), places.end());
      TrimLoop loop;
      OBVID_TRY(add_line(places, true, loop));
      close(loop);
      out_.trims.push_back(std::move(loop));
    }
    return {};
  }

  /// Ends that are one become one to the last bit.
  static void close(TrimLoop& loop) {
    for (std::size_t i = 0; i < loop.curves.size(); ++i) {
      loop.curves[i].points.back() = loop.curves[(i + 1) % loop.curves.size()].points.front();
    }
  }

  /// Borders in the cut and the cut itself: no area between them.
  [[nodiscard]] bool is_nothing(const TrimLoop& loop) const {
    std::vector<Vec2> outline;
    for (const NurbsCurve& curve : loop.curves) {
      for (const double t : places_of(curve)) outline.push_back(evaluate(curve, t).point);
    }
    constexpr double kNothing = 1e-9;  // of the domain
    return std::abs(area_of_polygon(outline)) <= kNothing * u_.length() * v_.length();
  }

  static constexpr double kRoom = 1e3, kSame = 1e-3;

  const SurfacePatch& patch_;
  const NurbsSurface& s_;
  const CuttingField& field_;
  double sign_, tolerance_, small_;
  TrimRegion region_;
  Range u_, v_;
  std::vector<TrimLoop> loops_;
  std::array<bool, 4> pole_{};
  std::optional<double> last_;
  std::vector<Crossing> crossings_;
  std::vector<Chord> chords_;
  std::vector<std::vector<Vec2>> closed_;
  TrimmedPatch out_;
};

}  // namespace

std::optional<Vec3> pole_of(const NurbsSurface& surface, PatchSide side, double small) {
  const SpaceCurve border = border_of(surface, side);
  Box3 box;
  box.add_all(border.points);
  if (!(box.diagonal() <= small)) return std::nullopt;
  return border.points.front();
}

Result<TrimmedPatch> trimmed_patch(const SurfacePatch& patch, const CuttingField& field,
                                   const std::vector<CutLine>& lines, bool keep_positive,
                                   double tolerance, double small) {
  return PatchTrimmer(patch, field, keep_positive, tolerance, small).made(lines);
}

}  // namespace obvid
