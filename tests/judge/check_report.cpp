// SPDX-License-Identifier: Apache-2.0
// The report: figures of each part and of the whole.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "checks.h"
#include "counts.h"

namespace judge {
namespace {

/// Lengths are told apart from what is found here only beyond this part of them.
constexpr Real kSame = 1e-9L;
/// Turns that are not told apart from half a turn, rad.
constexpr Real kNearlyHalf = 1e-6L;
/// A bound may be this much above the least one (docs/claims.md: it is not padded).
constexpr Real kPadding = 1e-3L;
/// Elements that are all needed leave no play: how near a step comes to the farthest one, and how
/// much wider than stated a region may be for it.
constexpr Real kStep = 1e-9L;
constexpr Real kWidth = 1e-6L;
/// To what part of itself the waviness is told.
constexpr double kWaviness = 1e-3;

class ReportCheck {
 public:
  ReportCheck(const Course& course, Sheet& sheet)
      : course_(course), file_(course.file), sheet_(sheet), report_(course.file.report) {}

  void run() {
    rows();
    whole();
    moves();
    lower_bound();
  }

 private:
  [[nodiscard]] std::string where(const Part& part) const {
    return fmt::format("points {}-{}", part.from_point + 1, part.to_point + 1);
  }

  void rows() {
    const Json& rows = member(report_, "segments");
    if (!rows.is_array()) return sheet_.missing("segments");
    if (!sheet_.expect(rows.size() == course_.parts.size(), "segments.count", rows.size(),
                       course_.parts.size(), "rows, one per chord")) {
      for (const char* name : {"chord", "points_only_error", "width", "deviation"}) {
        sheet_.unjudged(std::string("segments.") + name, "rows do not lead from point to point");
      }
      return;
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
      row(rows[k], course_.parts[k]);
    }
  }

  void row(const Json& row, const Part& part) {
    const Json& points = member(row, "points");
    if (points.is_array() && points.size() == 2) {
      sheet_.expect(points[0].number == static_cast<double>(part.from_point) &&
                        points[1].number == static_cast<double>(part.to_point),
                    "segments.points", fmt::format("[{},{}]", points[0].number, points[1].number),
                    fmt::format("[{},{}]", part.from_point, part.to_point), where(part));
    } else {
      sheet_.missing("segments.points", where(part));
    }
    chord(row, part);
    points_only(row, part);
    if (!file_.promises_monotone()) return nulls(row, part);
    width(row, part);
    deviation(row, part);
  }

  void chord(const Json& row, const Part& part) {
    const Figure stated = figure(row, "chord");
    if (!stated.known()) return sheet_.missing("segments.chord", where(part));
    const Real found = norm(course_.path.at(part.to) - course_.path.at(part.from));
    const Real off = std::abs(static_cast<Real>(*stated.value) - found);
    const Real slack =
        part.from == std::floor(part.from) && part.to == std::floor(part.to) ? kSame : 1e-5L;
    sheet_.expect(off <= slack * found + course_.resolution(), "segments.chord", *stated.value,
                  found, where(part));
  }

  void nulls(const Json& row, const Part& part) {
    for (const char* name : {"width", "deviation"}) {
      const Figure stated = figure(row, name);
      const std::string claim = std::string("segments.") + name;
      if (!stated.present) {
        sheet_.missing(claim, where(part));
      } else {
        sheet_.expect(stated.null(), claim, shown(stated.value.value_or(0.0)),
                      std::string("null: the carrier promises no monotone curvature"), where(part));
      }
    }
  }

  /// Points of the section around a part: i - 1 ... i + 2, as far as they are there.
  [[nodiscard]] std::optional<std::array<std::size_t, 4>> four_points(const Part& part) const {
    const std::size_t n = file_.points.size(), k = part.from_point;
    std::array<std::size_t, 4> four{};
    for (std::size_t j = 0; j < 4; ++j) {
      const std::size_t at = k + j;  // one more than the index
      if (!file_.closed && (at < 1 || at > n)) return std::nullopt;
      four[j] = (at + n - 1) % n;
    }
    for (const std::size_t inner : {four[1], four[2]}) {
      for (const FileElement& e : file_.elements) {
        if (e.parted() && e.source == inner) return std::nullopt;
      }
    }
    return four;
  }

  void points_only(const Json& row, const Part& part) {
    const char* claim = "segments.points_only_error";
    const Figure stated = figure(row, "points_only_error");
    if (!stated.present) return sheet_.missing(claim, where(part));
    if (!file_.promises_monotone()) {
      sheet_.expect(stated.null(), claim, shown(stated.value.value_or(0.0)),
                    std::string("null: the carrier promises no monotone curvature"), where(part));
      return;
    }
    // a contour that is monotone along four points of one circle is that circle
    const bool circular = file_.tolerance.empty() && on_circle(part);
    if (circular && (stated.null() || stated.value == 0.0)) return sheet_.holds(claim);
    const auto four = four_points(part);
    const bool exists = four && file_.tolerance.empty() && file_.points.size() >= 4;
    const std::optional<Lens> lens = exists ? std::optional(lens_of(*four)) : std::nullopt;
    const bool defined = lens && lens->holds() && monotone_around(part);
    const Real turning = defined ? turning_around(part) : 0.0L;
    if (stated.null()) {
      // null claims nothing, but is promised only where the figure is not defined
      const bool seam = &part == &course_.parts.front() || &part == &course_.parts.back();
      const bool joined = flag(file_.certificate, "gaps_within_bounds").value_or(true);
      const bool promised = joined && defined && !seam && turning < kStraightAngle - kNearlyHalf &&
                            lens->turning < kStraightAngle - kNearlyHalf && as_meant_around(part);
      sheet_.expect(!promised, "segments.points_only_error null", std::string("null"),
                    std::string("defined here"), where(part));
      return;
    }
    if (!defined || turning > kStraightAngle + kNearlyHalf) {
      const char* reason = !exists ? "null: four points of one section, met exactly, are needed"
                           : defined || !lens->holds()
                               ? "null: half a turn or more around this part"
                               : "null: the contour is not monotone around this part";
      return sheet_.fails(claim, shown(*stated.value), reason, where(part));
    }
    const Real found = lens->height(), slack = lens->growth() * kRoundedDirection;
    const Real seen_from_afar =
        lens->growth() * 0x1p-60L * course_.ends.coordinate / lens->shortest;
    sheet_.expect(*stated.value >= found * (1.0L - kSame) - seen_from_afar &&
                      *stated.value <= found * (1.0L + kSame) + slack + seen_from_afar,
                  claim, *stated.value, found, where(part));
  }

  [[nodiscard]] Lens lens_of(const std::array<std::size_t, 4>& four) const {
    const auto p = [&](std::size_t j) { return seen(file_.points[four[j]], course_.origin); };
    return Lens::of(p(0), p(1), p(2), p(3));
  }

  /// The parts before and behind one, around the seam of a closed contour too.
  [[nodiscard]] std::vector<const Part*> around(const Part& part) const {
    const auto own = static_cast<std::size_t>(&part - course_.parts.data());
    const std::size_t n = course_.parts.size();
    if (n < 3 || (!file_.closed && (own < 1 || own + 1 >= n))) return {&part};
    return {&course_.parts[(own + n - 1) % n], &part, &course_.parts[(own + 1) % n]};
  }
  [[nodiscard]] Real turning_around(const Part& part) const {
    Real sum = 0.0L;
    for (const Part* one : around(part)) sum += course_.turning_both_ways(one->from, one->to);
    return sum;
  }
  /// Whether the runs mean one direction, and the certificate proves the pieces to have it.
  [[nodiscard]] bool as_meant_around(const Part& part) const {
    bool rises = false, falls = false;
    for (const Part* one : around(part)) {
      for (auto i = static_cast<std::size_t>(one->from); static_cast<Real>(i) < one->to; ++i) {
        const int meant = meant_direction(i);
        rises = rises || meant > 0;
        falls = falls || meant < 0;
        if (!proved_as(i, meant)) return false;
      }
    }
    return !(rises && falls);
  }
  [[nodiscard]] int meant_direction(std::size_t piece) const {
    for (const FileRun& run : file_.runs) {
      if (run.first <= piece && piece <= run.last) return run.direction;
    }
    return 0;
  }
  [[nodiscard]] bool proved_as(std::size_t piece, int meant) const {
    const Json& proofs = member(file_.certificate, "monotone");
    if (file_.carrier == "arcs" || piece >= proofs.size()) return true;
    const std::string verdict = text_of(proofs[piece], "verdict");
    const int proved = verdict == "increasing" ? 1 : verdict == "decreasing" ? -1 : 0;
    return verdict == "constant" || (proved != 0 && proved == meant);
  }

  /// Whether four neighbouring points around the part's chord lie on one circle, within rounding,
  /// and the contour is monotone along them.
  [[nodiscard]] bool on_circle(const Part& part) const {
    const std::size_t n = file_.points.size();
    for (std::size_t back = 0; back < 3 && n >= 4; ++back) {
      if (!file_.closed && (part.from_point < back || part.from_point + 3 - back >= n)) continue;
      std::array<std::size_t, 4> four{};
      for (std::size_t j = 0; j < 4; ++j) four[j] = (part.from_point + n - back + j) % n;
      const auto p = [&](std::size_t j) { return seen(file_.points[four[j]], course_.origin); };
      const auto [k0, k1, h] = adjacent(four);
      const Real shortest = std::min({norm(p(1) - p(0)), h, norm(p(3) - p(2))});
      const Real blur = rounding_of_circles(four) / (shortest * shortest);
      const bool circle = std::abs(k1 - k0) <= blur + 1e-12L * std::abs(k0);
      if (circle && monotone_along(part, back)) return true;
    }
    return false;
  }

  [[nodiscard]] Real coordinate(const std::array<std::size_t, 4>& four) const {
    Real most = 0.0L;
    for (const std::size_t i : four) {
      most = std::max({most, std::abs(static_cast<Real>(file_.points[i].x)),
                       std::abs(static_cast<Real>(file_.points[i].y))});
    }
    return most;
  }
  /// What the rounding of the coordinates does to heights over a chord.
  [[nodiscard]] Real rounding_of_circles(const std::array<std::size_t, 4>& four) const {
    return 64.0L * 0x1p-52L * coordinate(four) + 1e-13L * course_.ends.size;
  }

  [[nodiscard]] std::array<Real, 3> adjacent(const std::array<std::size_t, 4>& four) const {
    const auto p = [&](std::size_t j) { return seen(file_.points[four[j]], course_.origin); };
    const auto kappa = [](Vec a, Vec b, Vec c) {
      return 2.0L * cross(b - a, c - b) / (norm(b - a) * norm(c - b) * norm(c - a));
    };
    return {kappa(p(0), p(1), p(2)), kappa(p(1), p(2), p(3)), norm(p(2) - p(1))};
  }

  [[nodiscard]] bool monotone_around(const Part& part) const { return monotone_along(part, 1); }
  /// Along three parts of which `back` lie before this one.
  [[nodiscard]] bool monotone_along(const Part& part, std::size_t back) const {
    const auto own = static_cast<std::size_t>(&part - course_.parts.data());
    const std::size_t n = course_.parts.size();
    if (n < 3 || (!file_.closed && (own < back || own + 2 - back >= n))) return false;
    const std::size_t k = (own + n + 1 - back) % n;  // the one in the middle
    const Part &before = course_.parts[(k + n - 1) % n], &after = course_.parts[(k + 1) % n];
    if (k > 0 && k + 1 < n) return course_.monotone(before.from, after.to);
    // over the seam: both sides, and both the same way
    if (file_.parted_at(0)) return false;
    const Real end = course_.path.end();
    const Real rise = course_.element(end, false).kappa - course_.element(before.from, true).kappa;
    const Real then = course_.element(after.to, false).kappa - course_.element(0.0L, true).kappa;
    return course_.monotone(before.from, end) && course_.monotone(0.0L, after.to) &&
           rise * then >= 0.0L;
  }

  /// Region between two orders where curvature changes one way.
  [[nodiscard]] std::optional<Region> region(Real a, Real b) const {
    const Element from = course_.element(a, true), to = course_.element(b, false);
    if (to.kappa == from.kappa) return std::nullopt;
    return Region::of(from, to, to.kappa > from.kappa ? 1 : -1);
  }
  [[nodiscard]] Real region_width(Real a, Real b) const {
    if (course_.element(a, true).kappa == course_.element(b, false).kappa) return 0.0L;  // a circle
    // of curves that turn by half a turn or more there is no region
    if (course_.turning(a, b) >= std::numbers::pi_v<Real>) return HUGE_VALL;
    const auto one = region(a, b);
    return one ? std::max(0.0L, one->width() - region_blur(a, b)) : 0.0L;
  }
  /// What rounding of long doubles makes of the joint of a boundary, where both curvatures are
  /// nearly the same: its heading is that of their difference.
  [[nodiscard]] Real region_blur(Real a, Real b) const {
    constexpr Real kRoundings = 16.0L * 0x1p-64L;
    const Element from = course_.element(a, true), to = course_.element(b, false);
    const Real h = norm(to.point - from.point);
    const Real bent = 0.5L * h * (std::abs(from.kappa) + std::abs(to.kappa));
    return kRoundings * bent * (1.0L + bent) / std::abs(to.kappa - from.kappa);
  }

  void width(const Json& row, const Part& part) {
    const Figure stated = figure(row, "width"), inserted = figure(row, "inserted");
    if (!stated.present || !inserted.known()) return sheet_.missing("segments.width", where(part));
    if (!stated.known()) return sheet_.unjudged("segments.width", "null", where(part));
    const Real limit = static_cast<Real>(*stated.value) * (1.0L + kWidth) + course_.resolution();
    const auto most = static_cast<long>(*inserted.value);
    const auto forced = needed(part, limit, most, true);
    const auto least = forced && *forced <= most ? forced : needed(part, limit, most, false);
    if (!least) {
      return sheet_.unjudged("segments.width", "too many elements to follow", where(part));
    }
    sheet_.expect(*least <= most, "segments.width",
                  fmt::format("{:.9g} with {} inserted", *stated.value, most),
                  fmt::format("needs {} or more", *least), where(part));
    unrefined(row, part);
  }

  void unrefined(const Json& row, const Part& part) {
    const char* claim = "segments.width_unrefined";
    const Figure stated = figure(row, "width_unrefined");
    if (!stated.known()) return sheet_.missing(claim, where(part));
    Real found = 0.0L;
    for (std::size_t k = 0; k + 1 < part.cuts.size(); ++k) {
      found = std::max(found, region_width(part.cuts[k], part.cuts[k + 1]));
    }
    const Real slack = course_.resolution() + joint_blur(part);
    sheet_.expect(*stated.value >= found * (1.0L - 1e-6L) - slack, claim, *stated.value, found,
                  where(part));
  }

  /// Which of the two pieces at a joint tells its heading is left open by the gap between them.
  [[nodiscard]] Real joint_blur(const Part& part) const {
    Real gaps = 0.0L;
    for (std::size_t i = 0; i < course_.joints.size(); ++i) {
      const auto order = static_cast<Real>(i);
      if (order < part.from || order > part.to) continue;
      if (!course_.joints[i].corner) gaps += course_.joints[i].heading.upper();
    }
    return gaps * norm(course_.path.at(part.to) - course_.path.at(part.from));
  }

  /// Fewest elements inside a part so that no region is wider; joints count too when `joints`.
  [[nodiscard]] std::optional<long> needed(const Part& part, Real limit, long most,
                                           bool joints) const {
    constexpr long kMostFollowed = 3000;
    if (most > kMostFollowed) return std::nullopt;
    long count = 0;
    std::vector<Real> stops = part.turns;
    if (joints) {
      for (Real j = std::floor(part.from) + 1.0L; j < part.to; j += 1.0L) stops.push_back(j);
      std::sort(stops.begin(), stops.end());
      stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
    }
    for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
      if (k > 0) ++count;
      count += steps(stops[k], stops[k + 1], limit, most - count);
      if (count > most) return count;
    }
    return count;
  }

  /// Fewest elements strictly between two orders; stops counting beyond `most`.
  [[nodiscard]] long steps(Real a, Real b, Real limit, long most) const {
    long count = 0;
    if (file_.carrier == "arcs") return joint_steps(a, b, limit);
    Real at = a, guess = b - a;
    while (region_width(at, b) > limit) {
      if (++count > most) return count;
      const Real next = farthest(at, b, guess, limit);
      if (!(next > at)) return most + 1;
      guess = next - at;
      at = next;
    }
    return count;
  }

  /// Of arcs, whose curvature leaps at the joints: fewest joints as elements.
  [[nodiscard]] long joint_steps(Real a, Real b, Real limit) const {
    long count = 0;
    for (Real at = a; region_width(at, b) > limit; ++count) {
      Real to = std::floor(at) + 1.0L;
      while (to + 1.0L < b && region_width(at, to + 1.0L) <= limit) to += 1.0L;
      if (!(to < b)) break;
      at = to;
    }
    return count;
  }

  /// Farthest order whose region with `at` is not wider than the limit. Regions are nested, and
  /// their widths grow about with the third power of the step: the cube roots are nearly linear.
  [[nodiscard]] Real farthest(Real at, Real b, Real guess, Real limit) const {
    const Real aim = std::cbrt(limit);
    Real low = at, high = b, below = -aim, above = std::cbrt(region_width(at, b)) - aim;
    Real to = std::min(at + guess, b);
    constexpr int kMost = 60;
    for (int i = 0; i < kMost && high - low > kStep * (high - at); ++i) {
      if (!(to > low && to < high)) to = low + (high - low) * -below / (above - below);
      if (!(to > low && to < high)) to = 0.5L * (low + high);
      const Real off = std::cbrt(region_width(at, to)) - aim;
      if (off <= 0.0L) {
        low = to;
        below = off;
        above *= 0.5L;  // Illinois: the other end must move too
      } else {
        high = to;
        above = off;
        below *= 0.5L;
      }
      to = at;  // a new one is interpolated
    }
    return low > at ? low : at + 1e-12L;
  }

  void deviation(const Json& row, const Part& part) {
    const char* claim = "segments.deviation";
    const Figure stated = figure(row, "deviation");
    if (!stated.present) return sheet_.missing(claim, where(part));
    if (!stated.known()) return sheet_.unjudged(claim, "null", where(part));
    Real found = 0.0L, at = part.from;
    for (std::size_t k = 0; k + 1 < part.cuts.size(); ++k) {
      const auto one = region(part.cuts[k], part.cuts[k + 1]);
      if (!one) continue;
      const Real place = farthest_place(*one, part.cuts[k], part.cuts[k + 1]);
      const Real away = one->farther(course_.path.at(place));
      if (away > found) {
        found = away;
        at = place;
      }
    }
    const Real stated_value = *stated.value;
    const std::string place = fmt::format("{} at order {:.9Lg}", where(part), at);
    // samples may miss a narrow peak; measured here, what is stated to be one counts like them
    found = std::max(found, at_stated_place(row, part).away);
    if (!sheet_.expect(stated_value >= found * (1.0L - kSame) - course_.resolution(), claim,
                       stated_value, found, place)) {
      return;
    }
    const Real tight = found * (1.0L + kPadding) + blurred(part);
    const Real whatever = whatever_the_curvatures(part) * (1.0L + kPadding);
    if (stated_value > tight && stated_value <= whatever) {
      return sheet_.holds("segments.deviation of arcs that keep one tangent each");
    }
    sheet_.expect(stated_value <= tight, "segments.deviation tight", stated_value, found, place);
    deviation_at(row, part, found);
  }

  /// Where rounding of the coordinates decides whether there is a region (ends that one biarc
  /// joins), how far the arcs that keep one tangent each lie apart (docs/claims.md).
  [[nodiscard]] Real whatever_the_curvatures(const Part& part) const {
    Real most = 0.0L;
    for (std::size_t k = 0; k + 1 < part.cuts.size(); ++k) {
      const Element from = course_.element(part.cuts[k], true),
                    to = course_.element(part.cuts[k + 1], false);
      const Vec chord = to.point - from.point;
      const Real h = norm(chord), turned = course_.resolution() / h;
      const int direction = to.kappa > from.kappa ? 1 : -1;
      bool decides = false;
      for (const Real by : {-turned, 0.0L, turned}) {
        const Element less{from.point, from.theta + by, from.kappa},
            more{to.point, to.theta + by, to.kappa};
        decides = decides || !Region::of(less, more, direction);
      }
      if (!decides) continue;
      const auto half = [&](Real theta) {
        return std::tan(0.5L * std::remainder(theta - std::atan2(chord.y, chord.x),
                                              2.0L * std::numbers::pi_v<Real>));
      };
      most = std::max(most, 0.5L * h * std::abs(half(from.theta) + half(to.theta)));
    }
    return most;
  }

  /// What deviations need not tell apart (docs/claims.md): rounding decides about regions there.
  [[nodiscard]] Real blurred(const Part& part) const {
    constexpr Real kOfChord = 1e-9L;
    const Real chord = norm(course_.path.at(part.to) - course_.path.at(part.from));
    return kOfChord * chord + 10.0L * course_.resolution();
  }

  [[nodiscard]] Real farthest_place(const Region& region, Real a, Real b) const {
    const auto away = [&](Real order) { return region.farther(course_.path.at(order)); };
    const auto pieces = static_cast<int>(std::min(64.0L, std::ceil(b - a)));
    return largest_place(away, a, b, 64 + 8 * pieces);
  }

  void deviation_at(const Json& row, const Part& part, Real found) {
    const Json& at = member(row, "deviation_at");
    if (!at.is_array() || at.size() != 2) {
      return sheet_.missing("segments.deviation_at", where(part));
    }
    if (found <= blurred(part)) return sheet_.holds("segments.deviation_at");
    const auto [away, off] = at_stated_place(row, part);
    const bool on = off <= 1e-9L * course_.ends.size + course_.resolution();
    sheet_.expect(on && away >= 0.998L * found - blurred(part), "segments.deviation_at",
                  fmt::format("[{:.9g}, {:.9g}]", at[0].number, at[1].number),
                  on ? fmt::format("{:.9Lg} there, {:.9Lg} elsewhere", away, found)
                     : fmt::format("{:.3Lg} away from the contour", off),
                  where(part));
  }

  /// How far the stated place is from the farther boundary, and how far from the contour.
  struct StatedPlace {
    Real away = 0.0L, off = 0.0L;
  };
  [[nodiscard]] StatedPlace at_stated_place(const Json& row, const Part& part) const {
    const Json& at = member(row, "deviation_at");
    if (!at.is_array() || at.size() != 2) return {};
    const Vec p = seen({at[0].number, at[1].number}, course_.origin);
    const Place place = course_.path.nearest(p, part.from, part.to);
    StatedPlace out{0.0L, place.distance};
    for (std::size_t k = 0; k + 1 < part.cuts.size(); ++k) {
      if (place.order() < part.cuts[k] || place.order() > part.cuts[k + 1]) continue;
      if (const auto one = region(part.cuts[k], part.cuts[k + 1])) {
        out.away = std::max(out.away, one->farther(course_.path.at(place.order())));
      }
    }
    return out;
  }

  void whole() {
    double widest = 0.0, inserted = 0.0;
    bool defined = false, gaps = false;
    const Json& rows = member(report_, "segments");
    if (rows.is_array()) {
      for (const Json& row : rows) {
        const Figure width = figure(row, "width");
        if (width.known()) {
          widest = std::max(widest, *width.value);
          defined = true;
        } else {
          gaps = true;
        }
        inserted += figure(row, "inserted").value.value_or(0.0);
      }
    }
    const Figure largest = figure(report_, "largest_width");
    if (!largest.present) {
      sheet_.missing("report.largest_width");
    } else if (gaps && file_.promises_monotone()) {  // one that is not known makes it unknown
      sheet_.expect(largest.null(), "report.largest_width", std::string("a number"),
                    std::string("unknown: a row is"), "");
    } else if (defined) {
      sheet_.expect(largest.value == widest, "report.largest_width", largest.value.value_or(-1.0),
                    widest, "largest of the rows");
    } else {
      sheet_.expect(largest.null() || largest.value == 0.0, "report.largest_width",
                    largest.value.value_or(0.0), 0.0, "no row has a width");
    }
    const Figure sum = figure(report_, "inserted_points");
    if (!sum.present) {
      sheet_.missing("report.inserted_points");
    } else {
      sheet_.expect(sum.value == inserted, "report.inserted_points", sum.value.value_or(-1.0),
                    inserted, "sum of the rows");
    }
    largest_deviation(rows);
    tolerance(largest);
    carrier_deviation();
    waviness();
  }

  /// Hills of the slope of curvature on a run, from nine places of each piece (docs/claims.md).
  void waviness() {
    const char* claim = "report.waviness";
    const Figure stated = figure(report_, "waviness");
    if (!stated.present) return sheet_.missing(claim);
    if (stated.null()) return sheet_.unjudged(claim, "null");
    const std::size_t n = file_.pieces.size();
    const bool loop = file_.closed && n > 0 && !file_.parted_at(0);
    std::vector<FileRun> runs = file_.runs;
    if (loop && runs.size() > 1 && runs.front().direction == runs.back().direction) {
      runs.back().last = n + runs.front().last;
      runs.erase(runs.begin());
    }
    double hills = 0.0, count = 0.0;
    for (const FileRun& run : runs) {
      if (run.direction == 0 || run.last >= 2 * n) continue;
      hills += hills_of(run, n);
      count += 1.0;
    }
    if (count == 0.0) return sheet_.fails(claim, shown(*stated.value), "no run has a slope", "");
    const double found = hills / count;
    sheet_.expect(std::abs(*stated.value - found) <= kWaviness * found, claim, *stated.value, found,
                  "");
  }

  [[nodiscard]] double hills_of(const FileRun& run, std::size_t pieces) const {
    constexpr int kSteps = 8;
    Ball variation(0.0), largest(0.0), before(0.0);
    const auto meet = [&](const Ball& slope) {
      variation += abs(slope - before);
      largest = larger(largest, abs(slope));
      before = slope;
    };
    for (std::size_t i = run.first; i <= run.last; ++i) {
      for (int k = 0; k <= kSteps; ++k) {
        meet(slope_at(file_.pieces[i % pieces], static_cast<double>(k) / kSteps));
      }
    }
    meet(Ball(0.0));
    return static_cast<double>((variation / (Ball(2.0) * largest)).middle());
  }

  void largest_deviation(const Json& rows) {
    const Figure stated = figure(report_, "largest_deviation");
    if (!stated.present || !rows.is_array()) return;  // the page does not ask for it
    double most = 0.0;
    bool known = false;
    for (const Json& row : rows) {
      const Figure one = figure(row, "deviation");
      known = known || one.known();
      most = std::max(most, one.value.value_or(0.0));
    }
    sheet_.expect(known ? stated.value == most : stated.null() || stated.value == 0.0,
                  "report.largest_deviation", stated.value.value_or(-1.0), most,
                  "largest of the rows");
  }

  void tolerance(const Figure& largest) {
    const Figure stated = figure(report_, "tolerance");
    if (!stated.present) return sheet_.missing("report.tolerance");
    sheet_.expect(stated.known() && *stated.value > 0.0, "report.tolerance",
                  stated.value.value_or(0.0), 0.0, "a positive length");
    (void)largest;  // whether it is kept is told by the exit code, which is judged with the texts
  }

  void carrier_deviation() {
    for (const char* name : {"carrier_deviation", "outside_spirals_region"}) {
      const std::string claim = std::string("report.") + name;
      const Figure stated = figure(report_, name);
      if (!stated.present) {
        if (file_.carrier != "spiral") sheet_.missing(claim);
        continue;
      }
      if (file_.carrier == "spiral") {
        sheet_.expect(stated.null(), claim, shown(stated.value.value_or(0.0)),
                      std::string("null: these are the spirals"), "");
      } else if (stated.known()) {
        sheet_.expect(*stated.value >= 0.0, claim, *stated.value, 0.0, "not negative");
      } else {
        sheet_.unjudged(claim, "null");
      }
    }
  }

  void moves() {
    const Figure largest = figure(report_, "largest_move");
    const Figure certified = figure(file_.certificate, "largest_move");
    const std::vector<Real>& away = course_.away;
    Real most = 0.0L;
    std::size_t at = 0;
    for (std::size_t i = 0; i < away.size(); ++i) {
      if (away[i] > most) {
        most = away[i];
        at = i;
      }
    }
    const std::string where = fmt::format("point {}", at + 1);
    for (const auto& [claim, stated] : {std::pair{"report.largest_move", &largest},
                                        std::pair{"certificate.largest_move", &certified}}) {
      if (!stated->present) {
        sheet_.missing(claim);
        continue;
      }
      sheet_.expect(stated->value.value_or(-1.0) >= most * (1.0L - kSame) - course_.resolution(),
                    claim, stated->value.value_or(-1.0), most, where);
    }
    const Json& list = member(report_, "moves");
    if (!list.is_array()) {
      if (!file_.tolerance.empty()) sheet_.missing("report.moves");
      return;
    }
    sheet_.expect(list.size() == away.size(), "report.moves", list.size(), away.size(),
                  "number of moves");
    for (std::size_t i = 0; i < std::min(list.size(), away.size()); ++i) {
      const double stated = list[i].is_number() ? list[i].number : -1.0;
      sheet_.expect(stated >= away[i] * (1.0L - kSame) - course_.resolution(), "report.moves",
                    stated, away[i], fmt::format("point {}", i + 1));
    }
  }

  void lower_bound() {
    const char* claim = "report.vertices_lower_bound";
    const Figure stated = figure(report_, "vertices_lower_bound");
    if (!stated.present) return sheet_.missing(claim);
    const CountRange vertices = count_vertices(course_);
    const bool proved = flag(file_.certificate, "proved").value_or(false);
    if (!proved || !vertices.known) return sheet_.unjudged(claim, "the contour is not proved");
    sheet_.expect(stated.value.value_or(0.0) <= vertices.most, claim, stated.value.value_or(-1.0),
                  vertices.most, "vertices of the proved contour itself");
  }

  const Course& course_;
  const ContourFile& file_;
  Sheet& sheet_;
  const Json& report_;
};

}  // namespace

void check_report(const Course& course, Sheet& sheet) {
  if (course.file.report.is_null()) return sheet.missing("report");
  ReportCheck(course, sheet).run();
}

}  // namespace judge
