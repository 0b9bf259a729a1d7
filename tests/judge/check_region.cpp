// SPDX-License-Identifier: Apache-2.0
// The worksheet of `region`: every figure again, from points and headings alone.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "region_checks.h"

namespace judge {
namespace {

constexpr Real kSameAsStated = 1e-9L;
/// Ranges of curvature: of the larger end, and over the chords.
constexpr Real kSameRange = 1e-9L;
/// Rounding of an angle between a chord and a heading in doubles, rad.
constexpr Real kAngleRounding = 1e-15L;
/// Places found are not the farthest ones but for this.
constexpr Real kFarthestPlace = 1e-3L;
/// Given headings are met to this, rad.
constexpr Real kGivenIsMet = 1e-6L;
constexpr Real kCircleTurn = 2.0L * std::numbers::pi_v<Real>;

/// Two lines through the ends of a chord: where they meet.
struct Meeting {
  Real to = 0.0L,
       from = 0.0L;    ///< along both tangents; negative behind the start, ahead of the end
  Real height = 0.0L;  ///< over the chord
  Real sine = 0.0L;    ///< of the smallest angle between the lines and the chord
  Vec apex;
  int side = 1;  ///< 1: left of the chord

  static Meeting of(Vec a, Vec u, Vec chord, Vec v) {
    Meeting out;
    u = (1.0L / norm(u)) * u;
    v = (1.0L / norm(v)) * v;
    const Real turn = cross(u, v);
    out.to = cross(chord, v) / turn;
    out.from = cross(u, chord) / turn;
    out.apex = a + out.to * u;
    const Real sine = cross(chord, u) / norm(chord);
    out.height = std::abs(out.to * sine);
    out.side = sine > 0.0L ? 1 : -1;
    const Real other = cross(chord, v) / norm(chord);
    out.sine = std::min({std::abs(sine), std::abs(other), std::abs(turn)});
    return out;
  }
  [[nodiscard]] bool is_triangle() const {
    return std::isfinite(to) && std::isfinite(from) && to > 0.0L && from > 0.0L;
  }
};

/// Figures of a region; NaN: there is none.
struct RegionFigures {
  Real lower = NAN, width = NAN;
  bool graphs = false;
  Real chord_gap = NAN, chord_bound = NAN, tangent_gap = NAN, tangent_bound = NAN;
};

class RegionCheck {
 public:
  RegionCheck(const SheetPart& part, const Input& input, Sheet& sheet)
      : p_(part), input_(input), sheet_(sheet) {}

  void run() {
    points();
    few_points();
    ranges();
    for (std::size_t k = 0; k < p_.rows.size(); ++k) row(k);
    for (std::size_t k = 0; k < p_.rows.size(); k = p_.section(k)[1]) spline(k);
  }

 private:
  [[nodiscard]] std::string where(const SheetRow& row) const { return "points " + p_.name(row); }

  void near(const std::string& claim, const Figure& stated, Real found, Real slack,
            const std::string& where) {
    if (!stated.present) return sheet_.missing(claim, where);
    if (!std::isfinite(found)) {
      sheet_.expect(stated.null(), claim, stated.value.value_or(NAN), found, where);
      return;
    }
    sheet_.expect(stated.known() && std::abs(*stated.value - found) <= slack, claim,
                  stated.value.value_or(NAN), found, where);
  }

  // points

  void points() {
    for (std::size_t i = 0; i < p_.points.size(); ++i) {
      const SheetPoint& p = p_.points[i];
      const std::string at = "point " + p.name();
      if (p.inserted == 0) given(p, at);
      adjacent(i, at);
      if (!p.headings || p.headings->empty() || p_.loop) continue;
      // a heading that the user has is the user's
      if (p.heading_given || input_.points.at(p.index).heading) continue;
      chosen_inside(p, at);
    }
  }

  /// Two or three points lie on one circle whatever the curve is: parabolas, conics, clothoids
  /// through them have other headings. So no range of one heading is told, and no width of 0.
  void few_points() {
    if (p_.loop) return;
    for (std::size_t k = 0; k < p_.rows.size(); k = p_.section(k)[1]) {
      const auto [first, behind] = p_.section(k);
      if (behind - first + 1 > 3) continue;
      bool all_given = true;
      for (std::size_t i = p_.rows[first].from; i <= p_.rows[behind - 1].to; ++i) {
        const SheetPoint& p = p_.points[i];
        all_given = all_given && input_.points.at(p.index).heading.has_value();
      }
      if (all_given || by_neighbours) continue;
      for (std::size_t i = p_.rows[first].from; i <= p_.rows[behind - 1].to; ++i) {
        const SheetPoint& p = p_.points[i];
        if (!p.headings || input_.points.at(p.index).heading || ranged(p)) continue;
        sheet_.expect(p.headings->high > p.headings->low, "region.range of few points",
                      p.headings->low, p.headings->high, "point " + p.name());
      }
      for (std::size_t j = first; j < behind; ++j) {
        const Figure width = figure(*p_.rows[j].figures, "width");
        sheet_.expect(!(width.known() && *width.value == 0.0), "region.width of few points", 0.0L,
                      NAN, where(p_.rows[j]));
      }
    }
  }
  [[nodiscard]] bool ranged(const SheetPoint& p) const {
    return input_.points.at(p.index).headings.has_value();
  }

  void given(const SheetPoint& p, const std::string& at) {
    if (!sheet_.expect(p.index < input_.points.size(), "region.index", static_cast<Real>(p.index),
                       static_cast<Real>(input_.points.size()), at)) {
      return;
    }
    const GivenPoint& g = input_.points[p.index];
    const Vec place = seen(g.point, p_.origin);
    sheet_.expect(norm(place - p.point) == 0.0L, "region.point", norm(p.point), norm(place), at);
    sheet_.expect(p.heading_given == g.heading.has_value(), "region.heading_given",
                  std::string(p.heading_given ? "given" : "chosen"),
                  std::string(g.heading ? "given" : "chosen"), at);
    sheet_.expect(p.curvature_given == g.kappa.has_value(), "region.curvature_given",
                  std::string(p.curvature_given ? "given" : "not"),
                  std::string(g.kappa ? "given" : "not"), at);
    if (g.heading) {
      const Real off = std::remainder(p.heading - *g.heading, kCircleTurn);
      sheet_.expect(std::abs(off) <= kSameAsStated, "region.heading", p.heading, *g.heading, at);
    }
  }

  /// Ranges of headings are known to some 1e-6 rad.
  void chosen_inside(const SheetPoint& p, const std::string& at) {
    constexpr Real kKnownTo = 2e-6L;
    if (by_neighbours) return;
    const bool below = !p.low_is_open && p.heading < p.headings->low - kKnownTo;
    const bool above = !p.high_is_open && p.heading > p.headings->high + kKnownTo;
    sheet_.expect(!below && !above, "region.heading in its range", p.heading,
                  below ? p.headings->low : p.headings->high, at);
  }

  void adjacent(std::size_t i, const std::string& at) {
    const std::size_t n = p_.points.size();
    std::size_t before = i - 1, after = i + 1;
    const bool seam = p_.loop && (i == 0 || i + 1 == n);
    if (seam) {
      before = n - 2;
      after = 1;
    } else if (ends_section(i) || starts_section(i)) {
      return;
    }
    const Figure stated{true, p_.points[i].adjacent_kappa};
    const Vec a = p_.chord(before, i), b = p_.chord(i, after);
    const Real shortest = std::min({norm(a), norm(b), norm(a + b)});
    const Real kappa = 2.0L * cross(a, b) / (norm(a) * norm(b) * norm(a + b));
    near("region.adjacent_kappa", stated, kappa,
         kSameAsStated * std::abs(kappa) +
             16.0L * 0x1p-53L * (norm(a) + norm(b)) / (shortest * shortest),
         at);
  }
  [[nodiscard]] bool starts_section(std::size_t i) const {
    return std::none_of(p_.rows.begin(), p_.rows.end(),
                        [i](const SheetRow& row) { return row.to == i; });
  }
  [[nodiscard]] bool ends_section(std::size_t i) const {
    return std::none_of(p_.rows.begin(), p_.rows.end(),
                        [i](const SheetRow& row) { return row.from == i; });
  }

  // ranges of curvature

  void ranges() {
    const auto found = curvature_ranges(p_, input_, 0.0L);
    const auto more = curvature_ranges(p_, input_, kAngleRounding),
               less = curvature_ranges(p_, input_, -kAngleRounding);
    for (std::size_t i = 0; i < p_.points.size(); ++i) {
      const SheetPoint& p = p_.points[i];
      if (!p.kappas) continue;
      const std::string at = "point " + p.name();
      const char* claim = "region.range of curvature";
      if (beside_an_arc(i)) {  // one value, judged with the arc
        sheet_.expect(p.kappas->low == p.kappas->high, "region.arc curvature", p.kappas->low,
                      p.kappas->high, at);
        continue;
      }
      if (!found[i] || !more[i] || !less[i]) {
        const bool thin = p.kappas->high - p.kappas->low <= kSameRange * range_scale(i);
        if (found[i] || more[i] || less[i] || thin) {
          sheet_.unjudged(claim, "rounding decides", at);
        } else {
          sheet_.fails(claim, fmt::format("{} to {}", shown(p.kappas->low), shown(p.kappas->high)),
                       "none", at);
        }
        continue;
      }
      const Real scale = range_scale(i);
      if (beside_no_curve(i)) {
        sheet_.expect(some_way_gives(i), "region.range of curvature beside no curve",
                      fmt::format("{} to {}", shown(p.kappas->low), shown(p.kappas->high)),
                      fmt::format("{} to {} and less", shown(found[i]->low), shown(found[i]->high)),
                      at);
        continue;
      }
      const auto end = [&](Real stated, Real sought, Real one, Real other, const char* which) {
        if (std::isinf(sought) || std::isinf(stated)) {
          sheet_.expect(sought == stated, claim, stated, sought, at + which);
          return;
        }
        const Real slack = 8.0L * std::abs(one - other) + kSameRange * scale;
        sheet_.expect(std::abs(stated - sought) <= slack, claim, stated, sought, at + which);
      };
      end(p.kappas->low, found[i]->low, more[i]->low, less[i]->low, ", least");
      end(p.kappas->high, found[i]->high, more[i]->high, less[i]->high, ", greatest");
      const auto apart = [](Real one, Real other) {
        return std::isfinite(one - other) ? std::abs(one - other) : 0.0L;
      };
      const Real rounding =
          8.0L * std::max(apart(more[i]->low, less[i]->low), apart(more[i]->high, less[i]->high));
      if (i < p_.kappas.size()) {
        element_inside(i, 1e-6L * scale + rounding + beside_given_on_arc(i), at);
      }
    }
    for (const SheetRow& row : p_.rows) {
      const auto same = [&](const std::optional<Limits>& range, std::size_t i) {
        if (!range) return;
        const std::optional<Limits>& of_point = p_.points[i].kappas;
        const bool ok = of_point && range->low == of_point->low && range->high == of_point->high;
        sheet_.expect(ok, "region.range of a segment", range->low, of_point ? of_point->low : NAN,
                      where(row));
      };
      same(row.start, row.from);
      same(row.end, row.to);
    }
  }

  [[nodiscard]] bool beside_no_curve(std::size_t i) const {
    return std::any_of(p_.rows.begin(), p_.rows.end(), [&](const SheetRow& row) {
      return p_.touches(row, i) && !p_.direction(row);
    });
  }
  /// A segment without a curve has no direction in the file: the range beside it is that of one of
  /// the ways in which the curvature may go over such segments, a vertex inside being one.
  [[nodiscard]] bool some_way_gives(std::size_t i) const {
    std::vector<std::size_t> unknown;
    for (std::size_t k = 0; k < p_.rows.size(); ++k) {
      if (p_.touches(p_.rows[k], i) && !p_.direction(p_.rows[k])) unknown.push_back(k);
    }
    std::vector<std::map<std::size_t, int>> ways{{}};
    for (const std::size_t k : unknown) {
      const std::size_t before = ways.size();
      for (std::size_t w = 0; w < before; ++w) {
        for (const int d : {1, -1}) {
          ways.push_back(ways[w]);
          ways.back()[k] = d;
        }
      }
    }
    return std::any_of(ways.begin(), ways.end(), [&](const std::map<std::size_t, int>& way) {
      const auto found = curvature_ranges(p_, input_, 0.0L, way)[i],
                 more = curvature_ranges(p_, input_, kAngleRounding, way)[i],
                 less = curvature_ranges(p_, input_, -kAngleRounding, way)[i];
      if (!found || !more || !less) return false;
      const auto alike = [&](Real stated, Real sought, Real one, Real other) {
        if (std::isinf(sought) || std::isinf(stated)) return sought == stated;
        return std::abs(stated - sought) <=
               8.0L * std::abs(one - other) + kSameRange * range_scale(i);
      };
      return alike(p_.points[i].kappas->low, found->low, more->low, less->low) &&
             alike(p_.points[i].kappas->high, found->high, more->high, less->high);
    });
  }
  [[nodiscard]] bool beside_an_arc(std::size_t i) const {
    return std::any_of(p_.rows.begin(), p_.rows.end(), [&](const SheetRow& row) {
      return p_.touches(row, i) && p_.direction(row) == 0;
    });
  }

  /// What a heading that is given beside an arc, which has its own, may change of a curvature.
  [[nodiscard]] Real beside_given_on_arc(std::size_t i) const {
    Real out = 0.0L;
    for (const SheetRow& row : p_.rows) {
      if (!p_.touches(row, i)) continue;
      const std::size_t other = row.from == i ? row.to : row.from;
      if (!p_.points[other].heading_given || !beside_an_arc(other)) continue;
      out += 4.0L * kGivenIsMet / norm(p_.chord(row));
    }
    return out;
  }

  [[nodiscard]] Real range_scale(std::size_t i) const {
    Real scale = 0.0L;
    for (const Real end : {p_.points[i].kappas->low, p_.points[i].kappas->high}) {
      if (std::isfinite(end)) scale = std::max(scale, std::abs(end));
    }
    for (const SheetRow& row : p_.rows) {
      if (row.from != i && row.to != i) continue;
      const Vec chord = p_.chord(row);
      const Real turn = p_.points[row.to].heading - p_.points[row.from].heading;
      scale = std::max(scale, std::abs(std::remainder(turn, kCircleTurn)) / norm(chord));
    }
    return scale;
  }

  /// The curve that was taken has curvatures of its ranges, and where one ends with the sign that
  /// is kept, that sign.
  void element_inside(std::size_t i, Real slack, const std::string& at) {
    const Limits& range = *p_.points[i].kappas;
    const Real kappa = p_.kappas[i];
    sheet_.expect(kappa >= range.low - slack && kappa <= range.high + slack,
                  "region.curvature in its range", kappa,
                  kappa < range.low ? range.low : range.high, at);
  }

  // segments

  void row(std::size_t k) {
    const SheetRow& row = p_.rows[k];
    const Json& f = *row.figures;
    const SheetPoint &a = p_.points[row.from], &b = p_.points[row.to];
    const Vec chord = p_.chord(row);
    const Real h = norm(chord);
    near("region.chord", figure(f, "chord"), h, kSameAsStated * h, where(row));
    headings(row);
    const Meeting t = Meeting::of(a.point, unit_at(a.heading), chord, unit_at(b.heading));
    // the sine of the angle at the apex is that of a difference of headings
    const Real sine = std::abs(cross(unit_at(a.heading), unit_at(b.heading)));
    const Real slack = kSameAsStated + 8.0L * kAngleRounding / sine;
    if (slack < 1e-3L) {
      const Real own = 8.0L * kAngleRounding * h / sine;
      near("region.to_apex", figure(f, "to_apex"), t.to, slack * std::abs(t.to) + own, where(row));
      near("region.from_apex", figure(f, "from_apex"), t.from, slack * std::abs(t.from) + own,
           where(row));
    } else {
      sheet_.unjudged("region.to_apex", "tangents are parallel within rounding", where(row));
    }
    points_only(k);
    const std::optional<Meeting> c = chords(k);
    height("region.tangent_apex_height", figure(f, "tangent_apex_height"), t, h,
           64.0L * kAngleRounding, where(row));
    const Real blur = chords_blur(k);
    if (c) {
      height("region.chord_apex_height", figure(f, "chord_apex_height"), *c, h, blur, where(row));
    }
    if (!c) {
      sheet_.expect(figure(f, "chord_apex_height").null(), "region.chord_apex_height",
                    std::string("a height"), std::string("null: no neighbour"), where(row));
    }
    region(k, t, c);
  }

  void headings(const SheetRow& row) {
    const auto same = [&](const char* name, Real heading) {
      const Figure stated = figure(*row.figures, name);
      const Real off = stated.known() ? std::remainder(*stated.value - heading, kCircleTurn) : NAN;
      sheet_.expect(std::abs(off) <= kSameAsStated, fmt::format("region.{}", name),
                    stated.value.value_or(NAN), heading, where(row));
    };
    same("heading_start", p_.points[row.from].heading);
    same("heading_end", p_.points[row.to].heading);
  }

  /// Rounding decides whether lines that nearly keep the chord's direction make a triangle.
  void height(const char* claim, const Figure& stated, const Meeting& t, Real h, Real blur,
              const std::string& where) {
    const Real least = std::min(std::abs(t.to), std::abs(t.from)) / h;
    const Real most = std::max(std::abs(t.to), std::abs(t.from)) / h;
    if (!(least > 1e-9L && most < 1e9L) || std::abs(t.sine) <= blur) {
      return sheet_.unjudged(claim, "no angle there", where);
    }
    const Real found = t.is_triangle() ? t.height : NAN;
    near(claim, stated, found, kSameAsStated * t.height + 64.0L * kAngleRounding * h * most * most,
         where);
  }

  [[nodiscard]] std::optional<Meeting> chords(std::size_t k) const {
    const SheetRow& row = p_.rows[k];
    const auto [first, behind] = p_.section(k);
    const Vec chord = p_.chord(row);
    std::optional<Vec> before, after;
    const std::size_t n = p_.points.size();
    if (k > first) before = p_.chord(row.from - 1, row.from);
    if (k + 1 < behind) after = p_.chord(row.to, row.to + 1);
    if (p_.loop && k == first) before = p_.chord(n - 2, row.from);
    if (p_.loop && k + 1 == behind) after = p_.chord(row.to, 1);
    if (!before && !after) return std::nullopt;
    // the same angle on the other side: the mirror image in the chord, its sine changed
    const auto alike = [&](Vec v) {
      const Vec u = (1.0L / norm(chord)) * chord;
      return dot(u, v) * u - cross(u, v) * left_of(u);
    };
    if (!before) before = alike(*after);
    if (!after) after = alike(*before);
    return Meeting::of(p_.points[row.from].point, *before, chord, *after);
  }

  /// What rounding makes of the directions of the chords around, rad.
  [[nodiscard]] Real chords_blur(std::size_t k) const {
    Real shortest = HUGE_VALL;
    const auto [first, behind] = p_.section(k);
    for (std::size_t j = k > first ? k - 1 : k; j <= std::min(k + 1, behind - 1); ++j) {
      const SheetRow& row = p_.rows[j];
      shortest = std::min(shortest, norm(p_.chord(row)));
    }
    return 64.0L * kAngleRounding + 256.0L * 0x1p-53L * p_.coordinate / shortest;
  }

  /// Of the points of the section alone, as `analyse` has it.
  void points_only(std::size_t k) {
    const char* claim = "region.points_only_error";
    const SheetRow& row = p_.rows[k];
    const Figure stated = figure(*row.figures, "points_only_error");
    const auto [first, behind] = p_.section(k);
    if (k == first || k + 1 == behind) {
      if (stated.value == 0.0) return sheet_.unjudged(claim, "0 on a circle", where(row));
      sheet_.expect(stated.null(), "region.points_only_error null", stated.value.value_or(0.0), NAN,
                    where(row));
      return;
    }
    const auto at = [&](std::size_t i) { return p_.points[i].point; };
    const std::size_t i = row.from;
    const Lens lens = Lens::of(at(i - 1), at(i), at(i + 1), at(i + 2));
    if (!stated.known()) return nothing_known(k, lens);
    if (*stated.value == 0.0) {
      sheet_.expect(on_circle(k), "region.points_only_error 0", 0.0L, lens.height(), where(row));
      return;
    }
    if (!lens.holds() && lens.turning > kStraightAngle + kRoundedDirection) {
      return sheet_.fails(claim, shown(*stated.value), "null: the points turn by half a turn",
                          where(row));
    }
    const Real afar = lens.growth() * 0x1p-60L * p_.coordinate / lens.shortest;
    const Real found = lens.height(), slack = lens.growth() * kRoundedDirection;
    sheet_.expect(*stated.value >= found * (1.0L - kSameAsStated) - afar &&
                      *stated.value <= found * (1.0L + kSameAsStated) + slack + afar,
                  claim, *stated.value, found, where(row));
  }

  /// Whether four neighbouring points around a chord lie on one circle, within rounding.
  [[nodiscard]] bool on_circle(std::size_t k) const {
    const auto [first, behind] = p_.section(k);
    for (std::size_t j = std::max(first + 1, k - std::min<std::size_t>(k, 1)); j <= k + 1; ++j) {
      if (j + 1 >= behind) break;
      const auto [a, blur_a] = circle(p_.rows[j].from);
      const auto [b, blur_b] = circle(p_.rows[j].to);
      if (std::abs(a - b) <= 4.0L * (blur_a + blur_b)) return true;
    }
    return false;
  }

  /// Where the circles of all points around go one way, and far enough, the figure is known.
  void nothing_known(std::size_t k, const Lens& lens) {
    const auto [first, behind] = p_.section(k);
    const std::size_t from = std::max(first + 1, k - 1), to = std::min(behind - 2, k + 1);
    if (!(lens.turning < kStraightAngle - 1e-6L)) return;
    int all = 0;
    bool one_way = true;
    for (std::size_t j = from; j <= to; ++j) {  // chord j lies between the circles of its points
      const std::size_t i = p_.rows[j].from;
      const auto [a, blur_a] = circle(i);
      const auto [b, blur_b] = circle(i + 1);
      const int way = b - a > 4.0L * (blur_a + blur_b)   ? 1
                      : a - b > 4.0L * (blur_a + blur_b) ? -1
                                                         : 0;
      one_way = one_way && way != 0 && (all == 0 || way == all);
      all = way;
    }
    if (!one_way) return;
    sheet_.fails("region.points_only_error null", "null", shown(lens.height()),
                 where(p_.rows[k]) + ": the circles around go one way");
  }
  [[nodiscard]] std::pair<Real, Real> circle(std::size_t i) const {
    const Vec a = p_.chord(i - 1, i), b = p_.chord(i, i + 1);
    const Real shortest = std::min({norm(a), norm(b), norm(a + b)});
    const Real kappa = 2.0L * cross(a, b) / (norm(a) * norm(b) * norm(a + b));
    return {kappa, 64.0L * 0x1p-53L * p_.coordinate / (shortest * shortest) +
                       kSameAsStated * std::abs(kappa)};
  }

  // the region of a segment

  [[nodiscard]] RegionFigures figures(const std::array<Element, 2>& ends, int d, const Meeting& t,
                                      const std::optional<Meeting>& c) const {
    RegionFigures out;
    const auto region = Region::of(ends[0], ends[1], d);
    if (!region || region->turns_half()) return out;
    const auto [first, second] = region->extents();
    if (const auto y = region->over_middle()) {
      out.graphs = true;
      out.lower = std::min(std::abs((*y)[0]), std::abs((*y)[1]));
      out.width = std::abs((*y)[0] - (*y)[1]);
    } else {
      out.width = std::max(std::abs(first.high - second.high), std::abs(first.low - second.low));
      const bool above = first.high + second.high >= -first.low - second.low;
      out.lower = above ? std::min(first.high, second.high) : std::min(-first.low, -second.low);
    }
    const auto convex = [&](const Meeting& m, Real& gap, Real& bound) {
      if (!m.is_triangle()) return;
      const Real one = m.side > 0 ? first.high : -first.low,
                 other = m.side > 0 ? second.high : -second.low;
      gap = m.height - std::min(one, other);
      bound = std::max(std::max(one, other), region->distance(m.apex, one <= other ? 0 : 1));
    };
    convex(t, out.tangent_gap, out.tangent_bound);
    if (c) convex(*c, out.chord_gap, out.chord_bound);
    return out;
  }

  void region(std::size_t k, const Meeting& t, const std::optional<Meeting>& c) {
    const SheetRow& row = p_.rows[k];
    const Json& f = *row.figures;
    const std::optional<int> d = p_.direction(row);
    if (!d || std::abs(p_.bending(row)) >= kStraightAngle) {
      for (const char* name : {"lower_height", "width", "chord_apex_gap", "tangent_apex_gap",
                               "chord_convex_bound", "tangent_convex_bound", "spline_distance"}) {
        sheet_.expect(figure(f, name).null(), fmt::format("region.{} null", name),
                      figure(f, name).value.value_or(0.0), NAN, where(row));
      }
      return;
    }
    if (*d == 0) return arc(row);
    if (std::abs(p_.bending(row)) <= kRoundedBending) {
      return sheet_.unjudged("region.width", "a circle fits both headings", where(row));
    }
    const std::array<Element, 2> ends = p_.bounding(row, input_);
    const Real h = norm(ends[1].point - ends[0].point);
    const RegionFigures here = figures(ends, *d, t, c);
    std::vector<RegionFigures> around;
    for (int which = 0; which < 4; ++which) {
      std::array<Element, 2> other = ends;
      Element& e = other[static_cast<std::size_t>(which % 2)];
      if (which < 2) {
        e.theta += kAngleRounding;
      } else {
        e.kappa *= 1.0L + 0x1p-52L;
      }
      around.push_back(figures(other, *d, t, c));
    }
    const auto told = [&](const char* name, Real RegionFigures::*member) {
      // places of an apex are rounded like the coordinates
      Real slack = kSameAsStated * std::abs(here.*member) + 16.0L * 0x1p-53L * (h + p_.coordinate);
      for (const RegionFigures& other : around) {
        slack += 8.0L * std::abs(other.*member - here.*member);
        if (other.graphs != here.graphs || std::isnan(other.*member) != std::isnan(here.*member)) {
          return sheet_.unjudged(fmt::format("region.{}", name), "rounding decides", where(row));
        }
      }
      near(fmt::format("region.{}", name), figure(f, name), here.*member, slack, where(row));
    };
    told("lower_height", &RegionFigures::lower);
    told("width", &RegionFigures::width);
    if (c && std::abs(c->sine) <= chords_blur(k)) {
      sheet_.unjudged("region.chord_apex_gap", "no angle there", where(row));
    } else {
      told("chord_apex_gap", &RegionFigures::chord_gap);
      told("chord_convex_bound", &RegionFigures::chord_bound);
    }
    if (std::abs(t.sine) <= 64.0L * kAngleRounding) {
      return sheet_.unjudged("region.tangent_apex_gap", "no angle there", where(row));
    }
    told("tangent_apex_gap", &RegionFigures::tangent_gap);
    told("tangent_convex_bound", &RegionFigures::tangent_bound);
  }

  /// Shortest of the chords whose ends the headings of a segment on a circle come from: those of
  /// the inscribed angles of its points, beside the end of the circle of the next ones inside.
  [[nodiscard]] Real shortest_on_circle(const SheetRow& row) const {
    constexpr std::size_t kAround = 2;
    const auto k = static_cast<std::size_t>(&row - p_.rows.data());
    const auto [first, behind] = p_.section(k);
    Real shortest = HUGE_VALL;
    for (std::size_t j = std::max(first + kAround, k) - kAround;
         j <= std::min(k + kAround, behind - 1); ++j) {
      const SheetRow& one = p_.rows[j];
      if (p_.direction(one) != 0) continue;
      shortest = std::min(shortest, norm(p_.chord(one)));
    }
    return shortest;
  }

  /// On an arc there is one curve: the height over its chord, and no width.
  void arc(const SheetRow& row) {
    const SheetPoint &a = p_.points[row.from], &b = p_.points[row.to];
    const Vec chord = p_.chord(row);
    const Real h = norm(chord);
    const Real omega = std::atan2(chord.y, chord.x);
    const Real sigma = std::remainder(a.heading - omega, kCircleTurn) +
                       std::remainder(b.heading - omega, kCircleTurn);
    // a given heading counts as the circle's own as far as it would count as met
    const Real given = a.heading_given || b.heading_given ? kGivenIsMet : 0.0L;
    const Real blur =
        kSameAsStated + given + 64.0L * 0x1p-53L * p_.coordinate / shortest_on_circle(row);
    sheet_.expect(std::abs(sigma) <= blur, "region.arc", 0.0L, sigma, where(row));
    const Real beta = std::remainder(b.heading - omega, kCircleTurn), turn = 2.0L * beta;
    const Real kappa = 2.0L * std::sin(beta) / h;
    sheet_.expect(std::abs(row.start->low - kappa) <= 4.0L * blur / h + 1e-6L * std::abs(kappa),
                  "region.arc curvature", row.start->low, kappa, where(row));
    near("region.lower_height", figure(*row.figures, "lower_height"),
         0.5L * h * std::abs(std::tan(0.25L * turn)), 1e-6L * h * std::abs(turn) + h * blur,
         where(row));
    near("region.width", figure(*row.figures, "width"), 0.0L, 0.0L, where(row));
  }

  // f

  void spline(std::size_t k) {
    const auto [first, behind] = p_.section(k);
    const std::size_t n = behind - first + 1;
    std::vector<Vec> points;
    for (std::size_t i = 0; i < n; ++i) points.push_back(p_.points[p_.rows[first].from + i].point);
    const bool drawn = n >= 4 && !p_.loop;
    std::vector<Span> spans, rounded;
    if (drawn) {
      spans = cubic_through(points);
      for (std::size_t i = 0; i < n; ++i) {  // other last digits
        const Real ulp = 0x1p-52L * p_.coordinate * (i % 2 == 0 ? 1.0L : -1.0L);
        points[i] = points[i] + Vec{ulp, i % 3 == 0 ? ulp : -ulp};
      }
      rounded = cubic_through(points);
    }
    for (std::size_t j = first; j < behind; ++j) {
      const SheetRow& row = p_.rows[j];
      const Figure stated = figure(*row.figures, "spline_distance");
      const auto region = p_.region(row, input_);
      if (!drawn || !region) {
        if (p_.direction(row).value_or(0) == 0 || !drawn) {
          sheet_.expect(stated.null(), "region.spline_distance null", stated.value.value_or(0.0),
                        NAN, where(row));
        }
        continue;
      }
      const auto farthest = [&](const Span& span) {
        const auto away = [&](Real t) { return region->farther(span.point(t)); };
        return away(largest_place(away, 0.0L, 1.0L, 96));
      };
      const Real found = farthest(spans[j - first]);
      const Real blur = 8.0L * std::abs(farthest(rounded[j - first]) - found);
      const Real h = norm(points[j - first + 1] - points[j - first]);
      near("region.spline_distance", stated, found,
           kFarthestPlace * found + blur + 1e-12L * h + 64.0L * 0x1p-53L * p_.coordinate,
           where(row));
    }
  }

  const SheetPart& p_;
  const Input& input_;
  Sheet& sheet_;

 public:
  bool by_neighbours = false;  ///< headings that no range was asked about
};

/// A point inserted into a segment of the user's: on the bisector, in the middle of the region.
void one_inserted(const Worksheet& w, const Input& input, Sheet& sheet) {
  const SheetPart &user = w.user, &finer = *w.refined;
  if (finer.points.size() != user.points.size() + 1) return;
  for (std::size_t i = 1; i + 1 < finer.points.size(); ++i) {
    const SheetPoint& p = finer.points[i];
    if (p.inserted == 0) continue;
    const auto row = std::find_if(user.rows.begin(), user.rows.end(), [&](const SheetRow& r) {
      return user.points[r.from].index == p.index;
    });
    if (row == user.rows.end()) return sheet.fails("region.inserted", p.name(), "no segment", "");
    const auto region = user.region(*row, input);
    const auto y = region ? region->over_middle() : std::nullopt;
    if (!y) return sheet.unjudged("region.inserted", "nothing over the middle", p.name());
    const Vec a = user.points[row->from].point, b = user.points[row->to].point, chord = b - a;
    const Vec middle =
        a + 0.5L * chord + (0.5L * ((*y)[0] + (*y)[1]) / norm(chord)) * left_of(chord);
    const Vec found = p.point;  // the first points of both tables are the same
    const Real slack = 1e-6L * std::abs((*y)[0] - (*y)[1]) + 1e-12L * norm(chord) +
                       8.0L * 0x1p-53L * user.coordinate;
    sheet.expect(norm(found - middle) <= slack, "region.inserted", norm(found), norm(middle),
                 p.name());
    if (!p.headings || p.headings->empty()) continue;
    const Real centre = 0.5L * (p.headings->low + p.headings->high);
    sheet.expect(
        std::abs(p.heading - centre) <= 2e-6L + 1e-3L * (p.headings->high - p.headings->low),
        "region.inserted heading", p.heading, centre, p.name());
  }
}

}  // namespace

void check_worksheet(const Worksheet& worksheet, const Input& input, bool by_neighbours,
                     Sheet& sheet) {
  RegionCheck user(worksheet.user, input, sheet);
  user.by_neighbours = by_neighbours;
  user.run();
  if (!worksheet.refined) return;
  RegionCheck finer(*worksheet.refined, input, sheet);
  finer.by_neighbours = by_neighbours;
  finer.run();
  one_inserted(worksheet, input, sheet);
  if (!input.tolerance) return;
  for (const SheetRow& row : worksheet.refined->rows) {
    const Figure width = figure(*row.figures, "width");
    if (!width.known()) continue;
    sheet.expect(*width.value <= *input.tolerance, "region.tolerance", *width.value,
                 *input.tolerance, worksheet.refined->name(row));
  }
}

}  // namespace judge
