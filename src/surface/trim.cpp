// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/internal/trim.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "obvid/curve/internal/basis.h"
#include "obvid/numeric/internal/gauss.h"
#include "obvid/numeric/internal/root.h"

namespace obvid {
namespace {

constexpr int kPlacesForTurns = 16;
constexpr double kMeets = 1e-9;  // of the domain

Result<void> check_loop(const TrimLoop& loop, const Range& u, const Range& v) {
  const auto bad = [](const char* what) { return error(ErrorCode::kBadOption, what); };
  if (loop.curves.empty()) return bad("a trim has no curves");
  const double du = kMeets * u.length(), dv = kMeets * v.length();
  for (std::size_t i = 0; i < loop.curves.size(); ++i) {
    OBVID_TRY(check(loop.curves[i]));
    // inside the hull of the control points
    for (const Vec2 p : loop.curves[i].points) {
      if (!(p.x >= u.from - du && p.x <= u.to + du && p.y >= v.from - dv && p.y <= v.to + dv)) {
        return bad("a trim leaves the domain of its patch");
      }
    }
    const Vec2 end = loop.curves[i].points.back();
    const Vec2 next = loop.curves[(i + 1) % loop.curves.size()].points.front();
    if (std::abs(end.x - next.x) > du || std::abs(end.y - next.y) > dv) {
      return bad("the curves of a trim do not meet end to end");
    }
  }
  return {};
}

}  // namespace

Result<void> check(const SurfacePatch& patch) {
  OBVID_TRY(check(patch.surface));
  for (const TrimLoop& loop : patch.trims) {
    OBVID_TRY(check_loop(loop, domain_u(patch.surface), domain_v(patch.surface)));
  }
  return {};
}

bool is_trimmed(const SurfaceModel& model) {
  return std::any_of(model.patches.begin(), model.patches.end(),
                     [](const SurfacePatch& patch) { return !patch.trims.empty(); });
}

NurbsCurve parameter_line(Vec2 a, Vec2 b) { return {1, {0.0, 0.0, 1.0, 1.0}, {a, b}, {}}; }

TrimLoop outline_of(const NurbsSurface& surface) {
  const Range u = domain_u(surface), v = domain_v(surface);
  const Vec2 a{u.from, v.from}, b{u.to, v.from}, c{u.to, v.to}, d{u.from, v.to};
  return {{parameter_line(a, b), parameter_line(b, c), parameter_line(c, d), parameter_line(d, a)}};
}

TrimRegion::TrimRegion(const SurfacePatch& patch) : patch_(patch) {
  if (patch.trims.empty()) own_ = outline_of(patch.surface).curves;
  for (const NurbsCurve& curve : own_) cut(curve);
  for (const TrimLoop& loop : patch.trims) {
    for (const NurbsCurve& curve : loop.curves) cut(curve);
  }
  make_bands();
}

void TrimRegion::cut(const NurbsCurve& curve) {
  const std::vector<double> spans = distinct(curve.knots);
  const auto slope = [&](double t) { return evaluate(curve, t).d1.y; };
  std::vector<double> turns{spans.front()};
  double before = spans.front(), slope_before = slope(before);
  for (std::size_t s = 1; s < spans.size(); ++s) {
    const Range span{spans[s - 1], spans[s]};
    for (int k = 1; k <= kPlacesForTurns; ++k) {
      const double t = span.at(static_cast<double>(k) / kPlacesForTurns);
      const double here = slope(t);
      if ((here < 0.0) != (slope_before < 0.0) && here != 0.0 && slope_before != 0.0) {
        const double turn = root_of(slope, before, t, slope_before, here);
        if (turn > turns.back()) turns.push_back(turn);
      }
      if (here != 0.0) {
        before = t;
        slope_before = here;
      }
    }
  }
  if (spans.back() > turns.back()) turns.push_back(spans.back());
  for (std::size_t i = 1; i < turns.size(); ++i) {
    Arc arc{&curve, {turns[i - 1], turns[i]}, 0.0, 0.0, true};
    const double from = evaluate(curve, arc.t.from).point.y;
    const double to = evaluate(curve, arc.t.to).point.y;
    arc.low = std::min(from, to);
    arc.high = std::max(from, to);
    arc.rises = from < to;
    if (arc.low < arc.high) arcs_.push_back(arc);
  }
}

double TrimRegion::u_at(const Arc& arc, double v) const {
  const auto off = [&](double t) { return evaluate(*arc.curve, t).point.y - v; };
  const double low = arc.low - v, high = arc.high - v;
  const bool rises = arc.rises;
  if (low >= 0.0) return evaluate(*arc.curve, rises ? arc.t.from : arc.t.to).point.x;
  if (high <= 0.0) return evaluate(*arc.curve, rises ? arc.t.to : arc.t.from).point.x;
  const double t = root_of(off, arc.t.from, arc.t.to, rises ? low : high, rises ? high : low);
  return evaluate(*arc.curve, t).point.x;
}

void TrimRegion::make_bands() {
  std::vector<double> ends;
  for (const Arc& arc : arcs_) {
    ends.push_back(arc.low);
    ends.push_back(arc.high);
  }
  std::sort(ends.begin(), ends.end());
  // ends that differ by rounding are one
  const double same = kMeets * domain_v(patch_.surface).length();
  std::vector<double> levels;
  for (const double v : ends) {
    if (levels.empty() || v - levels.back() > same) levels.push_back(v);
  }
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const Range v{levels[i - 1], levels[i]};
    const double middle = v.at(0.5);
    std::vector<std::pair<double, std::size_t>> there;
    for (std::size_t k = 0; k < arcs_.size(); ++k) {
      if (arcs_[k].low < middle && middle < arcs_[k].high) {
        there.emplace_back(u_at(arcs_[k], middle), k);
      }
    }
    std::sort(there.begin(), there.end());
    for (std::size_t k = 1; k < there.size(); k += 2) {
      bands_.push_back({v, there[k - 1].second, there[k].second});
    }
  }
  breaks_v_ = levels;
  for (const Arc& arc : arcs_) {
    for (const double t : arc.curve->knots) {
      if (t > arc.t.from && t < arc.t.to) breaks_v_.push_back(evaluate(*arc.curve, t).point.y);
    }
  }
  for (const double v : patch_.surface.knots_v) {
    if (!levels.empty() && v > levels.front() && v < levels.back()) breaks_v_.push_back(v);
  }
  std::sort(breaks_v_.begin(), breaks_v_.end());
  breaks_v_.erase(std::unique(breaks_v_.begin(), breaks_v_.end()), breaks_v_.end());
}

Range TrimRegion::across(const TrimBand& band, double v) const {
  const double left = u_at(arcs_[band.left], v), right = u_at(arcs_[band.right], v);
  return {left, std::max(left, right)};
}

bool TrimRegion::contains(double u, double v) const {
  for (const TrimBand& band : bands_) {
    if (v < band.v.from || v > band.v.to) continue;
    const Range there = across(band, v);
    if (u >= there.from && u <= there.to) return true;
  }
  return false;
}

namespace {

/// Adds up an area with what its steps changed.
class AreaOf {
 public:
  AreaOf(const SurfacePatch& patch, const RunContext& run)
      : surface_(patch.surface),
        region_(patch),
        run_(run),
        knots_(distinct(patch.surface.knots_u)) {
    const double size = size_of(surface_);
    small_ = kSmall * size * size;
  }

  Result<PatchArea> found() {
    for (const TrimBand& band : region_.bands()) {
      const std::vector<double>& breaks = region_.breaks_v();
      auto at = std::lower_bound(breaks.begin(), breaks.end(), band.v.from);
      for (; at != breaks.end() && std::next(at) != breaks.end() && *std::next(at) <= band.v.to;
           ++at) {
        OBVID_TRY(may_go_on(run_));
        const Range part{*at, *std::next(at)};
        add(band, part, rough(band, part, 0), 0);
      }
    }
    return out_;
  }

 private:
  static constexpr double kSmall = 1e-12;
  static constexpr int kMostHalvings = 24, kMostAcross = 4;

  double element(double u, double v) const {
    const SurfaceJet jet = evaluate(surface_, u, v);
    return norm(cross(jet.du, jet.dv));
  }
  double line(const TrimBand& band, double v, int halvings) const {
    const Range u = region_.across(band, v);
    const std::size_t parts = std::size_t{1} << std::min(halvings, kMostAcross);
    const auto f = [&](double at) { return element(at, v); };
    double sum = 0.0;
    const auto add_span = [&](const Range& span) {
      for (std::size_t k = 0; k < parts; ++k) {
        const auto part = [&](std::size_t i) {
          return span.at(static_cast<double>(i) / static_cast<double>(parts));
        };
        sum += gauss_integral<8>(part(k), part(k + 1), f);
      }
    };
    double from = u.from;
    for (auto k = std::upper_bound(knots_.begin(), knots_.end(), u.from);
         k != knots_.end() && *k < u.to; ++k) {
      add_span({from, *k});
      from = *k;
    }
    add_span({from, u.to});
    return sum;
  }
  double rough(const TrimBand& band, const Range& v, int halvings) const {
    return gauss_integral<8>(v.from, v.to, [&](double at) { return line(band, at, halvings); });
  }
  void add(const TrimBand& band, const Range& v, double whole, int halvings) {
    const double middle = v.at(0.5);
    const Range lower{v.from, middle}, upper{middle, v.to};
    const double low = rough(band, lower, halvings + 1), high = rough(band, upper, halvings + 1);
    const double step = std::abs(low + high - whole);
    if (step <= small_ || halvings >= kMostHalvings) {
      out_.value += low + high;
      out_.error += step;
      return;
    }
    add(band, lower, low, halvings + 1);
    add(band, upper, high, halvings + 1);
  }

  const NurbsSurface& surface_;
  TrimRegion region_;
  const RunContext& run_;
  std::vector<double> knots_;
  double small_ = 0.0;
  PatchArea out_;
};

}  // namespace

bool runs_along_side(const NurbsCurve& curve, const NurbsSurface& surface) {
  const Range u = domain_u(surface), v = domain_v(surface);
  const auto all = [&](auto coordinate, double side, double small) {
    return std::all_of(curve.points.begin(), curve.points.end(),
                       [&](Vec2 p) { return std::abs(coordinate(p) - side) <= small; });
  };
  const auto x = [](Vec2 p) { return p.x; };
  const auto y = [](Vec2 p) { return p.y; };
  const double du = kMeets * u.length(), dv = kMeets * v.length();
  return all(x, u.from, du) || all(x, u.to, du) || all(y, v.from, dv) || all(y, v.to, dv);
}

namespace {

/// Length on the surface of the trims that are no sides of the patch.
double length_of_trims(const SurfacePatch& patch) {
  const Range u = domain_u(patch.surface), v = domain_v(patch.surface);
  double sum = 0.0;
  for (const TrimLoop& loop : patch.trims) {
    for (const NurbsCurve& curve : loop.curves) {
      if (runs_along_side(curve, patch.surface)) continue;
      const auto speed = [&](double t) {
        const auto at = evaluate(curve, t);
        const SurfaceJet jet = evaluate(patch.surface, std::clamp(at.point.x, u.from, u.to),
                                        std::clamp(at.point.y, v.from, v.to));
        return norm(at.d1.x * jet.du + at.d1.y * jet.dv);
      };
      const std::vector<double> spans = distinct(curve.knots);
      for (std::size_t k = 0; k + 1 < spans.size(); ++k) {
        sum += gauss_integral<8>(spans[k], spans[k + 1], speed);
      }
    }
  }
  return sum;
}

}  // namespace

Result<PatchArea> area_of(const SurfacePatch& patch, const RunContext& run) {
  auto out = AreaOf(patch, run).found();
  OBVID_TRY(out);
  if (patch.trims_within > 0.0) out->of_trims = patch.trims_within * length_of_trims(patch);
  out->error += out->of_trims;
  return out;
}

}  // namespace obvid
