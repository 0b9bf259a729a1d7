// SPDX-License-Identifier: Apache-2.0
#include "trimmed_integrals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "obvid/curve/internal/basis.h"
#include "obvid/numeric/internal/halving.h"
#include "obvid/numeric/internal/root.h"

namespace obvid::afloat {
namespace {

constexpr int kPlacesOfChanges = 16;
constexpr int kHalvingsToChanges = 50;
/// Of the range of the parameter: a boundary that is open by less is open by rounding.
constexpr double kClosed = 1e-13;

}  // namespace

TrimmedIntegrals::TrimmedIntegrals(const SurfacePatch& patch, const std::vector<TrimLoop>& oriented,
                                   const CutPatch& cut, const PlaneFoot& foot,
                                   const CutPlane& decided, Vec3 origin, double size)
    : patch_(patch),
      loops_(oriented),
      cut_(cut),
      foot_(foot),
      decided_(decided),
      origin_(origin),
      small_(small_integrals(size)),
      region_(patch),
      inner_u_(cut.u.spans() <= cut.v.spans()),
      inner_knots_(distinct(inner_u_ ? patch.surface.knots_u : patch.surface.knots_v)),
      outer_knots_(distinct(inner_u_ ? patch.surface.knots_v : patch.surface.knots_u)) {
  inner_from_ = inner_knots_.back();
  for (const TrimLoop& loop : loops_) {
    for (const NurbsCurve& curve : loop.curves) {
      for (const Vec2 p : curve.points) inner_from_ = std::min(inner_from_, inner_u_ ? p.x : p.y);
    }
  }
  for (const TrimLoop& loop : loops_) {
    for (const NurbsCurve& curve : loop.curves) along_trim(curve);
  }
}

bool TrimmedIntegrals::is_wet(Vec2 p) const {
  return dot(decided_.normal, evaluate(patch_.surface, p.x, p.y).point) < decided_.offset;
}

void TrimmedIntegrals::along_trim(const NurbsCurve& curve) {
  const auto height = [&](double t) {
    const Vec2 p = evaluate(curve, t).point;
    return dot(decided_.normal, evaluate(patch_.surface, p.x, p.y).point) - decided_.offset;
  };
  const std::vector<double> spans = distinct(curve.knots);
  std::vector<double> ends = spans;
  const auto add_root = [&](const auto& f, const Range& part) {
    const double a = f(part.from), b = f(part.to);
    if ((a < 0.0) != (b < 0.0)) ends.push_back(root_of(f, part.from, part.to, a, b));
  };
  const auto add_water = [&](const Range& part) {
    if ((height(part.from) < 0.0) == (height(part.to) < 0.0)) return;
    // told beside the water, but it ends at it
    const auto at_water = [&](double t) {
      const Vec2 p = evaluate(curve, t).point;
      return foot_.height(evaluate(patch_.surface, p.x, p.y).point);
    };
    if ((at_water(part.from) < 0.0) != (at_water(part.to) < 0.0)) {
      add_root(at_water, part);
    } else {
      add_root(height, part);
    }
  };
  for (std::size_t s = 1; s < spans.size(); ++s) {
    const Range span{spans[s - 1], spans[s]};
    for (int k = 0; k < kPlacesOfChanges; ++k) {
      const Range part{span.at(static_cast<double>(k) / kPlacesOfChanges),
                       span.at(static_cast<double>(k + 1) / kPlacesOfChanges)};
      add_water(part);
      const Vec2 a = evaluate(curve, part.from).point, b = evaluate(curve, part.to).point;
      const auto at_knots = [&](const std::vector<double>& knots, const auto& coordinate) {
        const auto [low, high] = std::minmax(coordinate(a), coordinate(b));
        for (auto knot = std::upper_bound(knots.begin(), knots.end(), low);
             knot != knots.end() && *knot < high; ++knot) {
          add_root([&](double t) { return coordinate(evaluate(curve, t).point) - *knot; }, part);
        }
      };
      at_knots(inner_u_ ? inner_knots_ : outer_knots_, [](Vec2 p) { return p.x; });
      at_knots(inner_u_ ? outer_knots_ : inner_knots_, [](Vec2 p) { return p.y; });
    }
  }
  const Path path = [&](double t) {
    const auto at = evaluate(curve, t);
    return Foot{at.point, at.d1};
  };
  std::sort(ends.begin(), ends.end());
  for (std::size_t k = 1; k < ends.size(); ++k) {
    const Range part{ends[k - 1], ends[k]};
    if (!(height(part.at(0.5)) < 0.0)) continue;
    along(path, part, 1.0);
    add_error_of(curve, part);
  }
}

/// What lies between the trim and what it stands for.
void TrimmedIntegrals::add_error_of(const NurbsCurve& curve, Range part) {
  if (!(patch_.trims_within > 0.0) || runs_along_side(curve, patch_.surface)) return;
  for (std::size_t i = 0; i < 8; ++i) {
    const auto at = evaluate(curve, nodes<8>(part)[i]);
    const SurfaceJet jet = evaluate(patch_.surface, at.point.x, at.point.y);
    const Integrals here = integrands({jet.point, jet.du, jet.dv}, origin_);
    if (!(here[kArea] > 0.0)) continue;
    const double way = norm(at.d1.x * jet.du + at.d1.y * jet.dv);
    const double w = 0.5 * part.length() * weight<8>(i) * way * patch_.trims_within / here[kArea];
    for (std::size_t k = 0; k < kIntegrals; ++k) sum.error[k] += w * std::abs(here[k]);
  }
}

void TrimmedIntegrals::take(const SectionCell& cell, CellKind kind) {
  if (kind == CellKind::kAbove || kind == CellKind::kBelow) return;
  const Range u{cut_.u.at(cell.span_u, cell.shares_u().from),
                cut_.u.at(cell.span_u, cell.shares_u().to)};
  const Range v{cut_.v.at(cell.span_v, cell.shares_v().from),
                cut_.v.at(cell.span_v, cell.shares_v().to)};
  if (kind == CellKind::kUndecided) {
    ++undecided;
    around(u, v);
    return;
  }
  along_waterline(cell, kind == CellKind::kOverU, u, v);
}

/// A cell that is left out: it lies to the right of its sides.
void TrimmedIntegrals::around(Range u, Range v) {
  const auto side = [&](Vec2 a, Vec2 b) {
    where(
        [=](double t) {
          return Foot{a + t * (b - a), b - a};
        },
        {0.0, 1.0}, 1.0, [&](Vec2 p) { return is_wet(p) && region_.contains(p.x, p.y); });
  };
  side({u.from, v.from}, {u.from, v.to});
  side({u.from, v.to}, {u.to, v.to});
  side({u.to, v.to}, {u.to, v.from});
  side({u.to, v.from}, {u.from, v.from});
}

void TrimmedIntegrals::along_waterline(const SectionCell& cell, bool over_u, Range u, Range v) {
  const Range range = over_u ? u : v, other = over_u ? v : u;
  const StrandOfCell found = strand_of_cell(cell, cut_.u.degree, cut_.v.degree, over_u, other);
  const Strand& strand = found.strand;
  const std::vector<double>& ends = found.cuts;
  const auto place = [&](double t, double at) { return over_u ? Vec2{t, at} : Vec2{at, t}; };
  const Path path = [&](double t) {
    const SectionPoint root = foot_.on_strand(cut_, strand, t, 0.5 * (strand.least + strand.most));
    const Vec2 at = place(t, std::clamp(over_u ? root.v : root.u, strand.least, strand.most));
    const SurfaceJet jet = evaluate(patch_.surface, at.x, at.y);
    const double by = over_u ? jet.du.z : jet.dv.z, by_other = over_u ? jet.dv.z : jet.du.z;
    return Foot{at, place(1.0, by_other != 0.0 ? -by / by_other : 0.0)};
  };
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const Range part{range.at(ends[i - 1]), range.at(ends[i])};
    if (!(part.length() > 0.0)) continue;
    const bool low = is_wet(place(part.at(0.5), other.from));
    if (low == is_wet(place(part.at(0.5), other.to))) continue;
    // with what is wet on the left
    where(path, part, low == over_u ? -1.0 : 1.0,
          [&](Vec2 p) { return region_.contains(p.x, p.y); });
  }
}

void TrimmedIntegrals::where(const Path& path, Range t, double direction,
                             const std::function<bool(Vec2)>& state) {
  std::vector<double> ends{t.from};
  const auto at = [&](double place) { return state(path(place).at); };
  const auto change_between = [&](double from, double to) {
    const bool there = at(from);
    return end_of_condition(
               from, to, [&](double place) { return at(place) == there; }, kHalvingsToChanges)
        .middle();
  };
  // at places off the ends, where borders make it a matter of rounding
  double before = t.at(0.5 / kPlacesOfChanges);
  const bool first = at(before);
  bool holds = first;
  for (int k = 1; k < kPlacesOfChanges; ++k) {
    const double here = t.at((k + 0.5) / kPlacesOfChanges);
    if (at(here) != holds) {
      ends.push_back(change_between(before, here));
      holds = !holds;
    }
    before = here;
  }
  const auto end_of = [&](double end, double inside) {  // where it changes beside an end
    if (at(end) == at(inside)) return end;
    return change_between(inside, end);
  };
  ends.push_back(t.to);
  bool now = first;
  for (std::size_t k = 1; k < ends.size(); ++k, now = !now) {
    Range part{ends[k - 1], ends[k]};
    if (k == 1) {
      const double end = end_of(t.from, t.at(0.5 / kPlacesOfChanges));
      if (end > t.from && !now) along(path, {t.from, end}, direction);
      if (end > t.from && now) part.from = end;
    }
    if (k + 1 == ends.size()) {
      const double end = end_of(t.to, t.at(1.0 - 0.5 / kPlacesOfChanges));
      if (end < t.to && !now) along(path, {end, t.to}, direction);
      if (end < t.to && now) part.to = end;
    }
    if (now) along(path, part, direction);
  }
}

template <std::size_t N>
Integrals TrimmedIntegrals::across(double inner, double outer, int halvings, Rule<N>) const {
  // all places of the line at once
  places_.clear();
  weights_.clear();
  double from = inner_from_;
  const auto add = [&](double to) {
    if (!(to > from)) return;
    over_panels({from, to}, halvings, [&](Range some) {
      const auto here = nodes<N>(some);
      for (std::size_t i = 0; i < N; ++i) {
        places_.push_back(here[i]);
        weights_.push_back(0.5 * some.length() * weight<N>(i));
      }
      return Integrals{};
    });
    from = to;
  };
  for (auto k = std::upper_bound(inner_knots_.begin(), inner_knots_.end(), from);
       k != inner_knots_.end() && *k < inner; ++k) {
    add(*k);
  }
  add(inner);
  points_.resize(places_.size());
  const std::array<double, 1> fixed = {outer};
  if (inner_u_) {
    evaluate_raster(patch_.surface, places_, fixed, points_);
  } else {
    evaluate_raster(patch_.surface, fixed, places_, points_);
  }
  Integrals out{};
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Integrals here = integrands(points_[i], origin_);
    for (std::size_t k = 0; k < kIntegrals; ++k) out[k] += weights_[i] * here[k];
  }
  for (std::size_t k = 0; k < kIntegrals; ++k) {
    largest_[k] = std::max(largest_[k], std::abs(out[k]));
  }
  return out;
}

void TrimmedIntegrals::along(const Path& path, Range t, double direction) {
  if (!(t.length() > 0.0)) return;
  const auto outer = [&](Vec2 p) { return inner_u_ ? p.y : p.x; };
  left_open_ += direction * (outer(path(t.to).at) - outer(path(t.from).at));
  const double sign = inner_u_ ? direction : -direction;
  sum.add(refined(t, small_, [&](Range part, auto rule, int halvings) {
    constexpr std::size_t n = decltype(rule)::value;
    Integrals out{};
    const auto ts = nodes<n>(part);
    for (std::size_t i = 0; i < n; ++i) {
      const Foot foot = path(ts[i]);
      const double w = sign * 0.5 * part.length() * weight<n>(i) * outer(foot.d1);
      if (w == 0.0) continue;
      const Integrals line =
          across(inner_u_ ? foot.at.x : foot.at.y, outer(foot.at), halvings, rule);
      for (std::size_t k = 0; k < kIntegrals; ++k) out[k] += w * line[k];
    }
    return out;
  }));
}

void TrimmedIntegrals::finish() {
  const double range = outer_knots_.back() - outer_knots_.front();
  if (std::abs(left_open_) <= kClosed * range) return;
  for (std::size_t k = 0; k < kIntegrals; ++k) {
    sum.error[k] += std::abs(left_open_) * largest_[k];
  }
}

}  // namespace obvid::afloat
