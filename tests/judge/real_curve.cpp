// SPDX-License-Identifier: Apache-2.0
#include "real_curve.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

namespace judge {
namespace {

// Gauss-Legendre on [-1, 1], 10 points (Abramowitz and Stegun, table 25.4).
constexpr std::array<Real, 5> kNode = {
    0.14887433898163121088482600112971998461756L, 0.43339539412924719079926594316578416220007L,
    0.67940956829902440623432736511487357576930L, 0.86506336668898451073209668842349304852754L,
    0.97390652851717172007796401208445205342827L};
constexpr std::array<Real, 5> kWeight = {
    0.29552422471475287017389299465133832941110L, 0.26926671930999635509122692156946935285975L,
    0.21908636251598204399553493422816319245877L, 0.14945134915058059314586339765769733240255L,
    0.06667134430868813759356880989333179285786L};
constexpr Real kPanelTurn = 0.5L;      // rad: ten points are exact to 1e-20 up to here
constexpr int kMostTurnHalvings = 10;  // of a step whose turning is summed
constexpr Real kMostPanels = 2e4L;     // beyond 1e4 rad nothing is followed

Real binomial(std::size_t n, std::size_t k) {
  Real out = 1.0L;
  for (std::size_t i = 0; i < k; ++i) {
    out = out * static_cast<Real>(n - i) / static_cast<Real>(i + 1);
  }
  return out;
}

/// Integral of exp(i theta(s)) over [from, to] of a heading quadratic in s.
template <class Heading>
Vec gauss(const Heading& heading, Real from, Real to) {
  const Real middle = 0.5L * (from + to), half = 0.5L * (to - from);
  Vec sum;
  for (std::size_t j = 0; j < kNode.size(); ++j) {
    sum = sum + kWeight[j] * (unit_at(heading(middle - half * kNode[j])) +
                              unit_at(heading(middle + half * kNode[j])));
  }
  return half * sum;
}

Vec turned_by(Vec v, Vec unit) {
  return {v.x * unit.x - v.y * unit.y, v.x * unit.y + v.y * unit.x};
}

/// Heading along a panel less that at its start: small angles need no reduction by turns.
struct PanelHeading {
  Real kappa = 0.0L, half_rate = 0.0L;

  Real operator()(Real v) const { return v * (kappa + half_rate * v); }
};

PanelHeading panel_heading(const SpiralForm& s, std::size_t i) {
  const Real rate = (s.kappa1 - s.kappa0) / s.length;
  const Real from = s.length * static_cast<Real>(i) / static_cast<Real>(s.panel.size() - 1);
  return {s.kappa0 + rate * from, 0.5L * rate};
}

void lay_panels(SpiralForm& s) {
  s.ahead.assign(1, unit_at(s.theta0));
  if (s.kappa0 == s.kappa1) return;
  const Real turn = std::max(std::abs(s.kappa0), std::abs(s.kappa1)) * std::abs(s.length);
  const auto panels = 1 + static_cast<std::size_t>(std::min(kMostPanels, turn / kPanelTurn));
  const Real rate = (s.kappa1 - s.kappa0) / s.length;
  const Real step = s.length / static_cast<Real>(panels);
  s.panel.assign(panels + 1, {});
  s.ahead.clear();
  for (std::size_t i = 0; i < panels; ++i) {
    const Real u = step * static_cast<Real>(i);
    s.ahead.push_back(unit_at(s.theta0 + u * (s.kappa0 + 0.5L * rate * u)));
    s.panel[i + 1] = s.panel[i] + turned_by(gauss(panel_heading(s, i), 0.0L, step), s.ahead.back());
  }
}

Jet at_spiral(const SpiralForm& s, Real t, bool point_alone = false) {
  const Real u = t * s.length;
  Jet out;
  Real kappa = s.kappa0;
  Vec tangent;
  if (s.panel.empty()) {
    const Real half = 0.5L * s.kappa0 * u;
    const Real sinc = std::abs(half) > 1e-10L ? std::sin(half) / half : 1.0L - half * half / 6.0L;
    const Vec halfway = unit_at(half);
    out.p = s.start + (u * sinc) * turned_by(halfway, s.ahead[0]);
    tangent = turned_by(turned_by(halfway, halfway), s.ahead[0]);
  } else {
    const auto panels = static_cast<Real>(s.panel.size() - 1);
    const auto i = static_cast<std::size_t>(std::clamp(std::floor(t * panels), 0.0L, panels - 1));
    const PanelHeading heading = panel_heading(s, i);
    const Real v = u - s.length * static_cast<Real>(i) / panels;
    out.p = s.start + s.panel[i] + turned_by(gauss(heading, 0.0L, v), s.ahead[i]);
    if (point_alone) return out;
    kappa = heading.kappa + 2.0L * heading.half_rate * v;
    tangent = turned_by(unit_at(heading(v)), s.ahead[i]);
  }
  out.d = s.length * tangent;
  out.dd = (kappa * s.length * s.length) * left_of(tangent);
  return out;
}

/// Coefficients of the derivative, binomials included.
std::vector<Homogeneous> derivative_of(const std::vector<Homogeneous>& c) {
  std::vector<Homogeneous> out;
  // d/dt of t^j s^(m-j), s = 1 - t: j t^(j-1) s^(m-j) - (m-j) t^j s^(m-j-1)
  for (std::size_t j = 0; j + 1 < c.size(); ++j) {
    const auto up = static_cast<Real>(j + 1), down = static_cast<Real>(c.size() - 1 - j);
    out.push_back({up * c[j + 1].p - down * c[j].p, up * c[j + 1].w - down * c[j].w});
  }
  return out;
}

/// Sum of c_j t^j (1-t)^(m-j), by Horner's rule in the smaller of t/(1-t) and its reciprocal.
Homogeneous sum_of(const std::vector<Homogeneous>& c, Real t) {
  if (c.empty()) return {};
  const Real s = 1.0L - t;
  const bool early = t < s;
  const Real ratio = early ? t / s : s / t, whole = early ? s : t;
  const std::size_t m = c.size() - 1;
  Homogeneous out = early ? c[m] : c[0];
  Real scale = 1.0L;
  for (std::size_t i = 1; i <= m; ++i) {
    const Homogeneous& next = early ? c[m - i] : c[i];
    out.p = ratio * out.p + next.p;
    out.w = ratio * out.w + next.w;
    scale *= whole;
  }
  return {scale * out.p, scale * out.w};
}

/// Its point as seen from the base of the form.
Jet at_rational(const RationalForm& r, Real t) {
  const Homogeneous a = sum_of(r.point, t), a1 = sum_of(r.first, t), a2 = sum_of(r.second, t);
  Jet out;
  out.p = (1.0L / a.w) * a.p;
  out.d = (1.0L / a.w) * (a1.p - a1.w * out.p);
  out.dd = (1.0L / a.w) * (a2.p - (2.0L * a1.w) * out.d - a2.w * out.p);
  return out;
}

}  // namespace

Span::Span(std::vector<Vec> points, std::vector<Real> weights, Vec base) {
  RationalForm out;
  out.base = base;
  const std::size_t n = points.size() - 1;
  for (std::size_t j = 0; j <= n; ++j) {
    const Real w = binomial(n, j) * weights[j];
    out.point.push_back({w * points[j], w});
  }
  out.first = derivative_of(out.point);
  out.second = derivative_of(out.first);
  form_ = std::move(out);
}

Span::Span(Vec start, Real theta0, Real kappa, Real length) {
  SpiralForm out{start, theta0, kappa, kappa, length, {}, {}};
  lay_panels(out);
  form_ = std::move(out);
}

Span::Span(const Piece& piece, Point origin) {
  if (const auto* bezier = std::get_if<Bezier>(&piece)) {
    std::vector<Vec> points;
    std::vector<Real> weights(bezier->weight.begin(), bezier->weight.end());
    const Point start = bezier->offset.front();
    for (const Point p : bezier->offset) points.push_back(seen(p, start));
    *this = Span(std::move(points), std::move(weights),
                 seen(bezier->origin, origin) + Vec{start.x, start.y});
    return;
  }
  SpiralForm out;
  if (const auto* line = std::get_if<Line>(&piece)) {
    const Vec chord = seen(line->end, line->start);
    out = {
        seen(line->start, origin), std::atan2(chord.y, chord.x), 0.0L, 0.0L, norm(chord), {}, {}};
  } else if (const auto* arc = std::get_if<Arc>(&piece)) {
    out = {seen(arc->start, origin), arc->theta0, arc->kappa, arc->kappa, arc->length, {}, {}};
  } else {
    const auto& one = std::get<Clothoid>(piece);
    out = {seen(one.start, origin), one.theta0, one.kappa0, one.kappa1, one.length, {}, {}};
  }
  lay_panels(out);
  form_ = std::move(out);
}

Jet Span::at(Real t) const {
  if (const auto* spiral = std::get_if<SpiralForm>(&form_)) return at_spiral(*spiral, t);
  const auto& rational = std::get<RationalForm>(form_);
  Jet out = at_rational(rational, t);
  out.p = rational.base + out.p;
  return out;
}

Vec Span::point(Real t) const {
  if (const auto* spiral = std::get_if<SpiralForm>(&form_)) return at_spiral(*spiral, t, true).p;
  const auto& rational = std::get<RationalForm>(form_);
  const Homogeneous a = sum_of(rational.point, t);
  return rational.base + (1.0L / a.w) * a.p;
}

Vec Span::third(Real t) const {
  if (const auto* s = std::get_if<SpiralForm>(&form_)) {
    const Jet jet = at(t);
    const Real kappa = s->kappa0 + t * (s->kappa1 - s->kappa0), turn = kappa * s->length;
    return (s->length * (s->kappa1 - s->kappa0)) * left_of(jet.d) - (turn * turn) * jet.d;
  }
  const auto& r = std::get<RationalForm>(form_);
  const Jet jet = at_rational(r, t);
  const Homogeneous a = sum_of(r.point, t), a1 = sum_of(r.first, t), a2 = sum_of(r.second, t),
                    a3 = sum_of(derivative_of(r.second), t);
  return (1.0L / a.w) * (a3.p - (3.0L * a1.w) * jet.dd - (3.0L * a2.w) * jet.d - a3.w * jet.p);
}

Real Span::turning(Real from, Real to) const {
  if (const auto* s = std::get_if<SpiralForm>(&form_)) {
    const Real middle = s->kappa0 + 0.5L * (from + to) * (s->kappa1 - s->kappa0);
    return middle * (to - from) * s->length;
  }
  constexpr int kSteps = 8;
  Real sum = 0.0L;
  Vec before = at(from).d;
  for (int i = 1; i <= kSteps; ++i) {
    const Real a = from + (to - from) * (i - 1) / kSteps, b = from + (to - from) * i / kSteps;
    const Vec now = at(b).d;
    sum += turning_between(a, before, b, now, kMostTurnHalvings);
    before = now;
  }
  return sum;
}

Real Span::turning_between(Real from, Vec start, Real to, Vec end, int halvings) const {
  constexpr Real kFarTurn = 0.5L;  // rad: below that a chord of directions is no loop
  const Real middle = 0.5L * (from + to);
  const Vec half = at(middle).d;
  const auto angle = [](Vec a, Vec b) { return std::atan2(cross(a, b), dot(a, b)); };
  const Real one = angle(start, half), other = angle(half, end);
  if (halvings == 0 || std::max(std::abs(one), std::abs(other)) < kFarTurn) return one + other;
  return turning_between(from, start, middle, half, halvings - 1) +
         turning_between(middle, half, to, end, halvings - 1);
}

Real Span::turning_both_ways(Real from, Real to) const {
  if (const auto* s = std::get_if<SpiralForm>(&form_)) {
    const auto kappa_at = [s](Real t) { return s->kappa0 + t * (s->kappa1 - s->kappa0); };
    const Real a = std::abs(kappa_at(from)), b = std::abs(kappa_at(to));
    // over an inflection there are two triangles of curvature
    const bool both = (kappa_at(from) < 0.0L) != (kappa_at(to) < 0.0L) && a + b > 0.0L;
    return 0.5L * (to - from) * s->length * (both ? (a * a + b * b) / (a + b) : a + b);
  }
  constexpr int kSteps = 32, kHalvings = 60;
  const auto turn = [this](Real a, const Jet& start, Real b, const Jet& end) {
    return std::abs(turning_between(a, start.d, b, end.d, kMostTurnHalvings));
  };
  Real sum = 0.0L;
  Jet before = at(from);
  for (int i = 0; i < kSteps; ++i) {
    const Real a = from + (to - from) * i / kSteps, b = from + (to - from) * (i + 1) / kSteps;
    const Jet now = at(b);
    const bool left = before.kappa() > 0.0L;
    if (left == (now.kappa() > 0.0L)) {
      sum += turn(a, before, b, now);
    } else {
      Real low = a, high = b;  // of the step with an inflection both sides
      for (int k = 0; k < kHalvings; ++k) {
        const Real middle = 0.5L * (low + high);
        ((at(middle).kappa() > 0.0L) == left ? low : high) = middle;
      }
      const Jet inflection = at(low);
      sum += turn(a, before, low, inflection) + turn(low, inflection, b, now);
    }
    before = now;
  }
  return sum;
}

Path::Path(std::vector<Span> spans, int places_per_span)
    : spans_(std::move(spans)), per_span_(places_per_span) {
  for (const Span& span : spans_) {
    for (int k = 0; k < per_span_; ++k) {
      const Real t = static_cast<Real>(k) / per_span_;
      const Jet jet = span.at(t);
      places_.push_back(jet.p);
      legs_.push_back(std::max(norm(jet.d), norm(span.at(t + 1.0L / per_span_).d)) / per_span_);
    }
  }
  if (!spans_.empty()) places_.push_back(spans_.back().point(1.0L));
  // an arc of less than half a turn stays within its chord's length of the chord's ends, and a
  // hairpin within the length of its legs
  for (std::size_t k = 0; k < legs_.size(); ++k) {
    reach_.push_back(std::max(norm(places_[k + 1] - places_[k]), legs_[k]));
  }
  for (std::size_t from = 0; from < legs_.size(); from += kBlock) {
    const std::size_t to = std::min(from + kBlock, legs_.size());
    Block block{places_[(from + to) / 2], 0.0L};
    for (std::size_t k = from; k < to; ++k) {
      const Real away =
          std::max(norm(places_[k] - block.middle), norm(places_[k + 1] - block.middle));
      block.radius = std::max(block.radius, away + reach_[k]);
    }
    blocks_.push_back(block);
  }
}

Vec Path::at(Real order) const {
  const auto last = static_cast<Real>(spans_.size() - 1);
  const Real i = std::clamp(std::floor(order), 0.0L, last);
  return spans_[static_cast<std::size_t>(i)].point(order - i);
}

/// Golden section between two orders, inside one span.
Place Path::refined(Vec p, Real from, Real to) const {
  const auto span = static_cast<std::size_t>(
      std::clamp(std::floor(0.5L * (from + to)), 0.0L, static_cast<Real>(spans_.size() - 1)));
  const auto base = static_cast<Real>(span);
  const Span& curve = spans_[span];
  Real low = std::max(0.0L, from - base), high = std::min(1.0L, to - base);
  Real t = 0.5L * (low + high);
  // Newton on the derivative of the squared distance, kept inside a shrinking bracket
  const auto slope = [&](const Jet& jet) { return dot(jet.p - p, jet.d); };
  const Jet a = curve.at(low), b = curve.at(high);
  // round a hairpin there is more than one nearest place: each leg by itself, and the tip
  constexpr Real kLeastPart = 0x1p-24L;
  const Vec middle = curve.at(t).d;
  if (high - low > kLeastPart && (dot(a.d, middle) < 0.0L || dot(middle, b.d) < 0.0L)) {
    const Place one = refined(p, base + low, base + t), other = refined(p, base + t, base + high);
    return one.distance <= other.distance ? one : other;
  }
  Place best{span, low, norm(a.p - p)};
  if (const Real other = norm(b.p - p); other < best.distance) best = {span, high, other};
  if (!(slope(a) < 0.0L && slope(b) > 0.0L)) {
    const auto nearness = [&](Real u) { return -norm(curve.point(u) - p); };
    const Real u = largest_place(nearness, low, high, 4);
    const Real d = -nearness(u);
    if (d < best.distance) best = {span, u, d};
    return best;
  }
  constexpr int kMost = 60;
  for (int i = 0; i < kMost && high - low > 0.0L; ++i) {
    const Jet jet = curve.at(t);
    if (const Real d = norm(jet.p - p); d < best.distance) best = {span, t, d};
    const Real f = slope(jet), df = dot(jet.d, jet.d) + dot(jet.p - p, jet.dd);
    (f < 0.0L ? low : high) = t;
    Real next = df > 0.0L ? t - f / df : 0.5L * (low + high);
    if (std::abs(next - t) <= 1e-18L) break;  // before the rounding of f sends it away again
    if (!(next > low && next < high)) next = 0.5L * (low + high);
    t = next;
  }
  // near the least distance all distances are the same to their last digit: the slope knows more
  constexpr Real kRoundings = 16.0L * std::numeric_limits<Real>::epsilon();
  const Vec here = curve.point(t);
  const Real d = norm(here - p);
  if (d <= best.distance + kRoundings * (norm(here) + norm(p))) best = {span, t, d};
  return best;
}

Place Path::nearest(Vec p, Real from, Real to) const {
  if (spans_.empty()) return {0, 0.0L, std::numeric_limits<Real>::max()};
  const Real per = per_span_;
  const auto count = static_cast<Real>(legs_.size());
  const auto first = static_cast<std::size_t>(std::clamp(std::floor(from * per), 0.0L, count));
  const auto last = static_cast<std::size_t>(std::clamp(std::ceil(to * per), 0.0L, count));
  const std::size_t blocks = (last + kBlock - 1) / kBlock;
  Real bound = std::numeric_limits<Real>::max();
  for (std::size_t b = first / kBlock; b < blocks; ++b) {
    const std::size_t k = std::clamp(b * kBlock, first, last);
    const Real order = static_cast<Real>(k) / per;
    if (order >= from && order <= to) bound = std::min(bound, norm(places_[k] - p));
  }
  const auto may_hold = [&](std::size_t b, Real within) {
    return norm(blocks_[b].middle - p) - blocks_[b].radius <= within;
  };
  // first all ends of legs that matter, so that few legs are refined
  for (std::size_t b = first / kBlock; b < blocks; ++b) {
    if (!may_hold(b, bound)) continue;
    const std::size_t end = std::min((b + 1) * kBlock, last);
    for (std::size_t k = std::max(b * kBlock, first); k < end; ++k) {
      const Real order = static_cast<Real>(k) / per;
      if (order >= from && order <= to) bound = std::min(bound, norm(places_[k] - p));
    }
  }
  Place best{0, 0.0L, std::numeric_limits<Real>::max()};
  for (std::size_t b = first / kBlock; b < blocks; ++b) {
    if (!may_hold(b, std::min(bound, best.distance))) continue;
    const std::size_t end = std::min((b + 1) * kBlock, last);
    for (std::size_t k = std::max(b * kBlock, first); k < end; ++k) {
      const Real away = norm(places_[k] - p), beyond = norm(places_[k + 1] - p);
      if (std::min(away, beyond) > std::min(bound, best.distance) + reach_[k]) continue;
      const Place here = refined(p, std::max(from, static_cast<Real>(k) / per),
                                 std::min(to, static_cast<Real>(k + 1) / per));
      if (here.distance < best.distance) best = here;
    }
  }
  return best;
}

}  // namespace judge
