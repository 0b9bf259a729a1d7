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
constexpr Real kPanelTurn = 0.5L;   // rad: ten points are exact to 1e-20 up to here
constexpr Real kMostPanels = 2e4L;  // beyond 1e4 rad nothing is followed

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

void lay_panels(SpiralForm& s) {
  if (s.kappa0 == s.kappa1) return;
  const Real turn = std::max(std::abs(s.kappa0), std::abs(s.kappa1)) * std::abs(s.length);
  const int panels = 1 + static_cast<int>(std::min(kMostPanels, turn / kPanelTurn));
  const Real rate = (s.kappa1 - s.kappa0) / s.length, step = s.length / panels;
  const auto heading = [&](Real u) { return s.theta0 + u * (s.kappa0 + 0.5L * rate * u); };
  s.panel.assign(1, {});
  for (int i = 0; i < panels; ++i) {
    s.panel.push_back(s.panel.back() + gauss(heading, step * i, step * (i + 1)));
  }
}

Jet at_spiral(const SpiralForm& s, Real t) {
  const Real u = t * s.length;
  Jet out;
  Real kappa = s.kappa0, heading = s.theta0 + s.kappa0 * u;
  if (s.panel.empty()) {
    const Real half = 0.5L * s.kappa0 * u;
    const Real sinc = std::abs(half) > 1e-10L ? std::sin(half) / half : 1.0L - half * half / 6.0L;
    out.p = s.start + (u * sinc) * unit_at(s.theta0 + half);
  } else {
    const Real rate = (s.kappa1 - s.kappa0) / s.length;
    const auto at = [&](Real v) { return s.theta0 + v * (s.kappa0 + 0.5L * rate * v); };
    const auto panels = static_cast<Real>(s.panel.size() - 1);
    const auto i = static_cast<std::size_t>(std::clamp(std::floor(t * panels), 0.0L, panels - 1));
    out.p = s.start + s.panel[i] + gauss(at, s.length * static_cast<Real>(i) / panels, u);
    kappa = s.kappa0 + rate * u;
    heading = at(u);
  }
  const Vec tangent = unit_at(heading);
  out.d = s.length * tangent;
  out.dd = (kappa * s.length * s.length) * left_of(tangent);
  return out;
}

Jet at_rational(const RationalForm& r, Real t) {
  // derivatives of the homogeneous polynomials: sums over t^j (1-t)^(n-j)
  const std::size_t n = r.weight.size() - 1;
  constexpr std::size_t kMost = 26;
  std::array<Real, kMost> power{}, rest{};
  power[0] = rest[0] = 1.0L;
  for (std::size_t j = 1; j <= n; ++j) {
    power[j] = power[j - 1] * t;
    rest[j] = rest[j - 1] * (1.0L - t);
  }
  Vec a, a1, a2;
  Real w = 0.0L, w1 = 0.0L, w2 = 0.0L;
  for (std::size_t j = 0; j <= n; ++j) {
    const auto m = static_cast<Real>(n), k = static_cast<Real>(j);
    const Real b = power[j] * rest[n - j];
    Real b1 = 0.0L, b2 = 0.0L;
    if (j > 0) b1 += k * power[j - 1] * rest[n - j];
    if (j < n) b1 -= (m - k) * power[j] * rest[n - j - 1];
    if (j > 1) b2 += k * (k - 1.0L) * power[j - 2] * rest[n - j];
    if (j > 0 && j < n) b2 -= 2.0L * k * (m - k) * power[j - 1] * rest[n - j - 1];
    if (j + 1 < n) b2 += (m - k) * (m - k - 1.0L) * power[j] * rest[n - j - 2];
    a = a + b * r.numerator[j];
    a1 = a1 + b1 * r.numerator[j];
    a2 = a2 + b2 * r.numerator[j];
    w += b * r.weight[j];
    w1 += b1 * r.weight[j];
    w2 += b2 * r.weight[j];
  }
  Jet out;
  out.p = (1.0L / w) * a;
  out.d = (1.0L / w) * (a1 - w1 * out.p);
  out.dd = (1.0L / w) * (a2 - (2.0L * w1) * out.d - w2 * out.p);
  return out;
}

}  // namespace

Span::Span(std::vector<Vec> points, std::vector<Real> weights) {
  RationalForm out;
  const std::size_t n = points.size() - 1;
  for (std::size_t j = 0; j <= n; ++j) {
    const Real w = binomial(n, j) * weights[j];
    out.weight.push_back(w);
    out.numerator.push_back(w * points[j]);
  }
  form_ = std::move(out);
}

Span::Span(Vec start, Real theta0, Real kappa, Real length) {
  SpiralForm out{start, theta0, kappa, kappa, length, {}};
  lay_panels(out);
  form_ = std::move(out);
}

Span::Span(const Piece& piece, Point origin) {
  if (const auto* bezier = std::get_if<Bezier>(&piece)) {
    std::vector<Vec> points;
    std::vector<Real> weights(bezier->weight.begin(), bezier->weight.end());
    for (const Point p : bezier->offset) {
      points.push_back(seen(bezier->origin, origin) + Vec{p.x, p.y});
    }
    *this = Span(std::move(points), std::move(weights));
    return;
  }
  SpiralForm out;
  if (const auto* line = std::get_if<Line>(&piece)) {
    const Vec chord = seen(line->end, line->start);
    out = {seen(line->start, origin), std::atan2(chord.y, chord.x), 0.0L, 0.0L, norm(chord), {}};
  } else if (const auto* arc = std::get_if<Arc>(&piece)) {
    out = {seen(arc->start, origin), arc->theta0, arc->kappa, arc->kappa, arc->length, {}};
  } else {
    const auto& one = std::get<Clothoid>(piece);
    out = {seen(one.start, origin), one.theta0, one.kappa0, one.kappa1, one.length, {}};
  }
  lay_panels(out);
  form_ = std::move(out);
}

Jet Span::at(Real t) const {
  if (const auto* spiral = std::get_if<SpiralForm>(&form_)) return at_spiral(*spiral, t);
  return at_rational(std::get<RationalForm>(form_), t);
}

Real Span::turning(Real from, Real to) const {
  if (const auto* s = std::get_if<SpiralForm>(&form_)) {
    const Real middle = s->kappa0 + 0.5L * (from + to) * (s->kappa1 - s->kappa0);
    return middle * (to - from) * s->length;
  }
  constexpr int kSteps = 32;
  Real sum = 0.0L;
  Vec before = at(from).d;
  for (int i = 1; i <= kSteps; ++i) {
    const Vec now = at(from + (to - from) * static_cast<Real>(i) / kSteps).d;
    sum += std::atan2(cross(before, now), dot(before, now));
    before = now;
  }
  return sum;
}

Real Span::turning_both_ways() const {
  if (const auto* s = std::get_if<SpiralForm>(&form_)) {
    const Real a = std::abs(s->kappa0), b = std::abs(s->kappa1);
    // over an inflection there are two triangles of curvature
    const bool both = (s->kappa0 < 0.0L) != (s->kappa1 < 0.0L) && a + b > 0.0L;
    return 0.5L * s->length * (both ? (a * a + b * b) / (a + b) : a + b);
  }
  constexpr int kSteps = 32;
  Real sum = 0.0L;
  for (int i = 0; i < kSteps; ++i) {
    sum += std::abs(turning(static_cast<Real>(i) / kSteps, static_cast<Real>(i + 1) / kSteps));
  }
  return sum;
}

Path::Path(std::vector<Span> spans, int places_per_span)
    : spans_(std::move(spans)), per_span_(places_per_span) {
  for (const Span& span : spans_) {
    for (int k = 0; k < per_span_; ++k) {
      places_.push_back(span.point(static_cast<Real>(k) / per_span_));
    }
  }
  if (!spans_.empty()) places_.push_back(spans_.back().point(1.0L));
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
    const Real f = slope(jet), df = dot(jet.d, jet.d) + dot(jet.p - p, jet.dd);
    (f < 0.0L ? low : high) = t;
    Real next = df > 0.0L ? t - f / df : 0.5L * (low + high);
    if (!(next > low && next < high)) next = 0.5L * (low + high);
    if (std::abs(next - t) <= 1e-18L) break;
    t = next;
  }
  const Real d = norm(curve.point(t) - p);
  return d < best.distance ? Place{span, t, d} : best;
}

Place Path::nearest(Vec p, Real from, Real to) const {
  if (spans_.empty()) return {0, 0.0L, std::numeric_limits<Real>::max()};
  const Real per = per_span_;
  const auto count = static_cast<Real>(places_.size() - 1);
  auto first = static_cast<std::size_t>(std::clamp(std::floor(from * per), 0.0L, count));
  auto last = static_cast<std::size_t>(std::clamp(std::ceil(to * per), 0.0L, count));
  // intervals whose chord, bulge allowed, comes near enough
  Real bound = std::numeric_limits<Real>::max();
  std::vector<Real> away(last - first + 1);
  for (std::size_t k = first; k <= last; ++k) {
    away[k - first] = norm(places_[k] - p);
    const Real order = static_cast<Real>(k) / per;
    if (order >= from && order <= to) bound = std::min(bound, away[k - first]);
  }
  Place best{0, 0.0L, std::numeric_limits<Real>::max()};
  for (std::size_t k = first; k < last; ++k) {
    const Real chord = norm(places_[k + 1] - places_[k]);
    // an arc of less than half a turn stays within its chord's length of the chord's ends
    if (std::min(away[k - first], away[k - first + 1]) > std::min(bound, best.distance) + chord) {
      continue;
    }
    const Place here = refined(p, std::max(from, static_cast<Real>(k) / per),
                               std::min(to, static_cast<Real>(k + 1) / per));
    if (here.distance < best.distance) best = here;
  }
  return best;
}

}  // namespace judge
