// SPDX-License-Identifier: Apache-2.0
#include "obvid/region/internal/feasible_data.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "obvid/numeric/internal/golden.h"
#include "range_middle.h"

namespace obvid {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUnbounded = std::numeric_limits<double>::infinity();
/// Headings at which a new part of a curve is kept.
constexpr double kReachWork = 3.0;  // steps of a solver on a point that take as long as a link
constexpr int kPartSamples = 96;
/// Curves with more are thinned: what one part had at first lies ever closer later on.
constexpr std::size_t kMostSamples = 1500;
constexpr int kRootHalvings = 60;
constexpr double kExtremumFoundTo = 3e-11;  // of the places beside an extremum

/// Least curvature at a point with one heading, and its slope. Two samples of one heading are a
/// corner: the slopes before and after it.
struct LowSample {
  double theta = 0.0, low = 0.0, slope = 0.0;
};

/// The element before a chord where it is the only one: what follows from it needs no samples.
struct OneBefore {
  double h = 0.0, omega = 0.0, theta = 0.0, low = 0.0;

  /// Least curvature after the chord: that of one biarc.
  [[nodiscard]] double low_after(double theta_after) const {
    const double alpha = theta - omega, beta = theta_after - omega;
    const double half = std::sin(0.5 * (alpha + beta)), a = 0.5 * low * h + std::sin(alpha);
    return 2.0 / h * (std::sin(beta) + (std::isinf(low) ? 0.0 : half * half / -a));
  }
};

/// Elements of a point that can be reached from one side, in the mirror image where curvature
/// grows: the headings between `first` and `last`, and above each of them every curvature beyond
/// `low`.
struct Reached {
  bool any = false;
  double first = 0.0, last = 0.0;
  /// Nothing but the half turn up to which curves are looked at ends the headings there.
  bool first_is_open = false, last_is_open = false;
  std::vector<LowSample> samples;  ///< none: every curvature at every heading
  std::optional<OneBefore> from;   ///< the samples are those of this one

  [[nodiscard]] bool holds(double theta) const { return any && theta >= first && theta <= last; }
};

double hermite(const LowSample& a, const LowSample& b, double theta) {
  const double w = b.theta - a.theta;
  if (!(w > 0.0)) return a.low;
  const double t = (theta - a.theta) / w, s = 1.0 - t;
  return s * s * (1.0 + 2.0 * t) * a.low + t * t * (1.0 + 2.0 * s) * b.low +
         w * t * s * (s * a.slope - t * b.slope);
}

double hermite_slope(const LowSample& a, const LowSample& b, double theta) {
  const double w = b.theta - a.theta;
  if (!(w > 0.0)) return a.slope;
  const double t = (theta - a.theta) / w, s = 1.0 - t;
  return 6.0 * t * s * (b.low - a.low) / w + s * (s - 2.0 * t) * a.slope +
         t * (t - 2.0 * s) * b.slope;
}

LowSample sample_between(const LowSample& a, const LowSample& b, double theta) {
  return {theta, hermite(a, b, theta), hermite_slope(a, b, theta)};
}

/// Least curvature with a heading of the range.
double low_at(const Reached& r, double theta) {
  if (r.samples.empty()) return -kUnbounded;
  if (r.from) return r.from->low_after(theta);
  const auto after = std::upper_bound(r.samples.begin(), r.samples.end(), theta,
                                      [](double t, const LowSample& s) { return t < s.theta; });
  if (after == r.samples.begin()) return r.samples.front().low;
  if (after == r.samples.end()) return r.samples.back().low;
  return hermite(*(after - 1), *after, theta);
}

/// The heading between two samples where f changes its sign.
template <class F>
double root_between(double positive, double negative, const F& f) {
  for (int k = 0; k < kRootHalvings; ++k) {
    const double middle = 0.5 * (positive + negative);
    if (middle == positive || middle == negative) break;
    (f(middle) > 0.0 ? positive : negative) = middle;
  }
  return negative;
}

/// The part of a curve where f(theta, low) < 0, with its ends found between the samples.
template <class F>
std::vector<LowSample> part_below(const std::vector<LowSample>& all, const F& f, bool& cut_first,
                                  bool& cut_last) {
  const auto value = [&](const LowSample& s) { return f(s.theta, s.low); };
  std::vector<LowSample> out;
  cut_first = cut_last = false;
  std::size_t k = 0;
  while (k < all.size() && !(value(all[k]) < 0.0)) ++k;
  if (k == all.size()) {  // the curve may dip below between two samples
    std::size_t least = 0;
    for (std::size_t i = 1; i < all.size(); ++i) {
      if (value(all[i]) < value(all[least])) least = i;
    }
    for (std::size_t i = least > 0 ? least - 1 : 0; i <= least && i + 1 < all.size(); ++i) {
      const double low = all[i].theta, high = all[i + 1].theta;
      const auto at = [&](double t) { return f(t, hermite(all[i], all[i + 1], t)); };
      const double middle = lowest_place(low, high, at, kExtremumFoundTo * (high - low));
      if (!(at(middle) < 0.0)) continue;
      for (const double end : {all[i].theta, all[i + 1].theta}) {
        const double root = root_between(end, middle, at);
        out.push_back(sample_between(all[i], all[i + 1], root));
        if (end == all[i].theta) out.push_back(sample_between(all[i], all[i + 1], middle));
      }
      cut_first = cut_last = true;
      return out;
    }
    return out;
  }
  const auto root = [&](const LowSample& positive, const LowSample& negative) {
    const bool ascending = positive.theta <= negative.theta;
    const LowSample &a = ascending ? positive : negative, &b = ascending ? negative : positive;
    const double at = root_between(positive.theta, negative.theta,
                                   [&](double t) { return f(t, hermite(a, b, t)); });
    return sample_between(a, b, at);
  };
  if (k > 0) {
    cut_first = true;
    out.push_back(root(all[k - 1], all[k]));
  }
  for (; k < all.size() && value(all[k]) < 0.0; ++k) out.push_back(all[k]);
  if (k < all.size()) {
    cut_last = true;
    out.push_back(root(all[k], all[k - 1]));
  }
  return out;
}

void thin(std::vector<LowSample>& samples) {
  if (samples.size() <= kMostSamples) return;
  std::vector<LowSample> out{samples.front()};
  bool kept = true;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    const bool corner =
        samples[i].theta == samples[i - 1].theta || samples[i].theta == samples[i + 1].theta;
    kept = corner || !kept;
    if (kept) out.push_back(samples[i]);
  }
  out.push_back(samples.back());
  samples = std::move(out);
}

/// The next point's curve, from that of the point before, over a chord.
class Step {
 public:
  Step(double h, double omega) : h_(h), omega_(omega) {}

  Reached operator()(const Reached& from) {
    if (!from.any) return {};
    const bool one = from.first == from.last;
    if (one) most_sigma_ = 2.0 * kPi;
    if (from.samples.empty()) {
      Reached out = over_circles(from.first, from.last);
      out.first_is_open = from.last_is_open || from.last >= omega_ + kPi;
      if (one) out.from = OneBefore{h_, omega_, from.first, -kUnbounded};
      return out;
    }
    if (one && !leads_on(from.samples.front())) return {};
    bool root_first = false, root_last = false;
    const std::vector<LowSample> part = part_below(
        within_half_turn(from.samples), [this](double theta, double low) { return A(theta, low); },
        root_first, root_last);
    if (part.empty()) return {};
    add_circles(part.front().theta, part.back().theta);
    follow(part, root_first, root_last);
    Reached out = finished();
    out.first_is_open = !root_last && (from.last_is_open || part.back().theta >= omega_ + kPi);
    if (one) out.from = OneBefore{h_, omega_, from.first, part.front().low};
    return out;
  }

 private:
  [[nodiscard]] double A(double theta, double low) const {
    return 0.5 * low * h_ + std::sin(theta - omega_);
  }
  /// Whether A is negative beyond the rounding of its two terms.
  [[nodiscard]] bool leads_on(const LowSample& s) const {
    constexpr double kRoundings = 8.0 * 0x1p-53;
    const double bent = 0.5 * s.low * h_, sine = std::sin(s.theta - omega_);
    return bent + sine < -kRoundings * (std::abs(bent) + std::abs(sine));
  }
  [[nodiscard]] double A_slope(const LowSample& s) const {
    return 0.5 * s.slope * h_ + std::cos(s.theta - omega_);
  }

  [[nodiscard]] std::vector<LowSample> within_half_turn(const std::vector<LowSample>& all) const {
    std::vector<LowSample> out;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool inside = std::abs(all[i].theta - omega_) < kPi;
      if (i > 0) {
        for (const double limit : {omega_ - kPi, omega_ + kPi}) {
          if (all[i - 1].theta < limit && limit < all[i].theta) {
            out.push_back(sample_between(all[i - 1], all[i], limit));
          }
        }
      }
      if (inside) out.push_back(all[i]);
    }
    return out;
  }

  /// Any curvature before: the circle through both points is the least one after.
  Reached over_circles(double first, double last) {
    const double from = std::max(first, omega_ - kPi), to = std::min(last, omega_ + kPi);
    if (!(from <= to)) return {};
    add_circles(omega_ - kPi, to);
    return finished();
  }

  /// A circle that the point before allows goes on with its curvature.
  void add_circles(double first, double last) {
    const double from = std::max(omega_ - last, -kPi), to = std::min(omega_ - first, kPi);
    if (!(to > from)) return;
    for (int k = 0; k <= kPartSamples; ++k) {
      const double beta = from + (to - from) * k / kPartSamples;
      put({omega_ + beta, 2.0 / h_ * std::sin(beta), 2.0 / h_ * std::cos(beta)});
    }
  }

  /// sigma at which the best heading before has this slope of A.
  static double sigma_of(double A, double slope) {
    return slope < 0.0 ? 2.0 * std::atan2(-A, -slope) : kPi;
  }

  void follow(const std::vector<LowSample>& part, bool root_first, bool root_last) {
    const LowSample& first = part.front();
    if (root_first) {  // A = 0: sigma begins with 0, and the slope has a corner
      const double slope = A_slope(first);
      const double beta = omega_ - first.theta;
      if (!(slope < 0.0)) return;
      put({omega_ + beta, 2.0 / h_ * std::sin(beta), 2.0 / h_ * (std::cos(beta) - 1.0 / slope)});
    } else if (!pins(first, 0.0, sigma_of(A(first.theta, first.low), A_slope(first)))) {
      return;
    }
    for (std::size_t k = 1; k < part.size(); ++k) {
      const LowSample &before = part[k - 1], &s = part[k];
      const bool last_root = root_last && k + 1 == part.size();
      if (s.theta == before.theta) {
        const double A0 = A(s.theta, s.low);
        if (!pins(s, sigma_of(A0, A_slope(before)), sigma_of(A0, A_slope(s)))) return;
        continue;
      }
      if (A_slope(s) >= 0.0 || last_root) {  // sigma reaches half a turn on the way
        for (int j = 1; j <= kPartSamples; ++j) {
          const double theta = before.theta + (s.theta - before.theta) * j / kPartSamples;
          if (!stationary(sample_between(before, s, theta))) return;
        }
        return;
      }
      if (!stationary(s)) return;
    }
    const LowSample& last = part.back();
    if (!root_last) pins(last, sigma_of(A(last.theta, last.low), A_slope(last)), most_sigma_);
  }

  bool stationary(const LowSample& s) {
    const double a = A(s.theta, s.low), slope = A_slope(s);
    if (!(a < 0.0) || !(slope < 0.0)) return false;
    return pin(s.theta, a, sigma_of(a, slope));
  }

  /// One heading before for a range of sigma. False when no more is looked at.
  bool pins(const LowSample& s, double from, double to) {
    const double a = A(s.theta, s.low);
    for (int k = 0; k <= kPartSamples; ++k) {
      if (!pin(s.theta, a, from + (to - from) * k / kPartSamples)) return false;
    }
    return to < most_sigma_;
  }

  bool pin(double theta, double a, double sigma) {
    const double beta = sigma - (theta - omega_);
    if (!(beta < kPi) || !(sigma < most_sigma_) || !(a < 0.0)) return false;
    const double half = std::sin(0.5 * sigma);
    put({omega_ + beta, 2.0 / h_ * (std::sin(beta) + half * half / -a),
         2.0 / h_ * (std::cos(beta) + 0.5 * std::sin(sigma) / -a)});
    return true;
  }

  void put(const LowSample& s) {
    auto& all = out_.samples;
    if (!all.empty() && s.theta <= all.back().theta) {
      // a corner keeps both slopes; what rounding set back is no new heading
      if (all.size() > 1 && all[all.size() - 2].theta == all.back().theta) all.pop_back();
      if (s.slope == all.back().slope) return;
      all.push_back({all.back().theta, all.back().low, s.slope});
      return;
    }
    all.push_back(s);
  }

  Reached finished() {
    if (out_.samples.empty()) return {};
    thin(out_.samples);
    out_.any = true;
    out_.first = out_.samples.front().theta;
    out_.last = out_.samples.back().theta;
    out_.last_is_open = true;
    return std::move(out_);
  }

  double h_, omega_;
  /// Of several headings before the best one is known up to half a turn, the only one is.
  double most_sigma_ = kPi;
  Reached out_;
};

Reached of_samples(std::vector<LowSample> samples) {
  Reached out;
  if (samples.empty()) return out;
  out.any = true;
  out.first = samples.front().theta;
  out.last = samples.back().theta;
  out.samples = std::move(samples);
  return out;
}

/// A part of what is reached: where it keeps an end of the whole, that is as open as it was.
Reached part_of(const Reached& whole, std::vector<LowSample> samples) {
  Reached out = of_samples(std::move(samples));
  out.first_is_open = out.any && whole.first_is_open && out.first == whole.first;
  out.last_is_open = out.any && whole.last_is_open && out.last == whole.last;
  return out;
}

/// The same curvature at every heading of a range.
Reached constant(const Reached& r, double kappa) {
  if (r.first == r.last) return part_of(r, {{r.first, kappa, 0.0}});
  std::vector<LowSample> samples;
  for (int k = 0; k < kPartSamples; ++k) {
    samples.push_back({r.first + (r.last - r.first) * k / kPartSamples, kappa, 0.0});
  }
  samples.push_back({r.last, kappa, 0.0});
  return part_of(r, std::move(samples));
}

Reached below(const Reached& r, double kappa) {
  if (!r.any || r.samples.empty()) return r;
  bool first = false, last = false;
  return part_of(r, part_below(
                        r.samples, [&](double, double low) { return low - kappa; }, first, last));
}

/// max(low, kappa).
Reached at_least(const Reached& r, double kappa) {
  if (!r.any) return r;
  if (r.samples.empty()) return constant(r, kappa);
  std::vector<LowSample> out;
  for (std::size_t k = 0; k < r.samples.size(); ++k) {
    const LowSample& s = r.samples[k];
    if (k > 0) {
      const LowSample& before = r.samples[k - 1];
      if ((before.low < kappa) != (s.low < kappa) && before.theta < s.theta) {
        const bool falls = s.low < kappa;
        const double at =
            root_between(falls ? before.theta : s.theta, falls ? s.theta : before.theta,
                         [&](double t) { return hermite(before, s, t) - kappa; });
        const double slope = hermite_slope(before, s, at);
        out.push_back({at, kappa, falls ? slope : 0.0});
        out.push_back({at, kappa, falls ? 0.0 : slope});
      }
    }
    out.push_back(s.low < kappa ? LowSample{s.theta, kappa, 0.0} : s);
  }
  return part_of(r, std::move(out));
}

/// The part between two headings.
Reached between(Reached r, double from, double to) {
  if (!r.any || from > r.last || to < r.first) return {};
  from = std::max(from, r.first);
  to = std::min(to, r.last);
  if (r.samples.empty()) {
    r.first_is_open = r.first_is_open && r.first == from;
    r.last_is_open = r.last_is_open && r.last == to;
    r.first = from;
    r.last = to;
    return r;
  }
  std::vector<LowSample> out;
  for (std::size_t k = 0; k < r.samples.size(); ++k) {
    const LowSample& s = r.samples[k];
    for (const double end : {from, to}) {
      if (k == 0 || !(r.samples[k - 1].theta < end && end < s.theta)) continue;
      out.push_back(sample_between(r.samples[k - 1], s, end));
    }
    if (s.theta >= from && s.theta <= to) out.push_back(s);
  }
  return part_of(r, std::move(out));
}

/// A range of curvatures in a mirror image.
ValueRange mirrored(const ValueRange& range, int e) {
  return e > 0 ? range : ValueRange{-range.high, -range.low};
}

Reached within(Reached r, const ValueRange& kappas) {
  if (kappas.high < kUnbounded) r = below(r, kappas.high);
  if (kappas.low > -kUnbounded) r = at_least(r, kappas.low);
  return r;
}

/// Which of the given data hold.
struct Held {
  bool theta = true, kappa = true;
};

/// A point's own data, in a mirror image: `d` for headings, `e` for curvatures.
Reached with_node(Reached r, const RangeNode& node, int d, int e, Held held) {
  if (!r.any) return r;
  if (r.any && held.theta && node.theta) {
    const double theta = d * *node.theta;
    if (!r.holds(theta)) return {};
    if (r.samples.empty()) {
      r.first = r.last = theta;
      r.first_is_open = r.last_is_open = false;
    } else {
      r = of_samples({{theta, low_at(r, theta), 0.0}});
    }
  }
  if (node.curvature_sign != 0 && !(held.kappa && node.kappa)) {
    r = e * node.curvature_sign < 0 ? below(r, 0.0) : at_least(r, 0.0);
  }
  if (held.kappa && node.kappas && !node.kappa) r = within(std::move(r), mirrored(*node.kappas, e));
  if (held.kappa && node.kappa) {
    r = below(r, e * *node.kappa);
    if (r.any) r = constant(r, e * *node.kappa);
  }
  if (r.any && held.theta && node.thetas && !node.theta) {
    const ValueRange thetas = mirrored(*node.thetas, d);
    r = between(std::move(r), thetas.low, thetas.high);
  }
  return r;
}

/// Everything: all headings within half a turn of a chord.
Reached everything(double omega) {
  Reached out;
  out.any = true;
  out.first = omega - kPi;
  out.last = omega + kPi;
  out.first_is_open = out.last_is_open = true;
  return out;
}

/// What reaches a point from one side, with the mirror images in which it is told.
struct Side {
  Reached reached;
  int d = 1;  ///< of headings
  int e = 1;  ///< of curvatures: -d from behind
};

/// Before anything is known: all headings within half a turn of the chord that follows.
Side at_first(const RangeLink& link, int order) {
  Side out;
  out.d = link.direction.value_or(1) < 0 ? -1 : 1;
  out.e = order * out.d;
  out.reached = everything(out.d * link.omega);
  return out;
}

/// Over the next chord; `order` +1, or -1 for the way back.
Side advance(const Side& from, const RangeNode& node, const RangeLink& over, int order) {
  Side to;
  const int d = over.direction.value_or(0);
  if (d == 0) {  // an arc that stays fixes its end; a vertex inside leaves everything open
    to.e = order;
    to.reached = everything(over.omega);
    return to;
  }
  to.d = d;
  to.e = order * d;
  Reached start = with_node(from.reached, node, from.d, from.e, {});
  if (start.any && d != from.d) {
    Reached turned;
    turned.any = true;
    turned.first = -start.last;
    turned.last = -start.first;
    turned.first_is_open = start.last_is_open;
    turned.last_is_open = start.first_is_open;
    start = with_node(turned, node, d, to.e, {});
  }
  to.reached = Step(over.h, d * over.omega)(start);
  return to;
}

/// From the first point on; `order` +1, or -1 from the last one back. Empty when it is to end.
std::vector<Side> reach_all(const std::vector<RangeLink>& links,
                            const std::vector<RangeNode>& nodes, int order, Watch* watch) {
  const std::size_t n = nodes.size();
  std::vector<Side> out(n);
  const auto place = [&](std::size_t k) { return order > 0 ? k : n - 1 - k; };
  const auto link = [&](std::size_t k) { return links[order > 0 ? k : n - 2 - k]; };
  out[place(0)] = at_first(link(0), order);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    if (is_to_end(watch)) return {};
    if (watch != nullptr) watch->spend(kReachWork);
    out[place(k + 1)] = advance(out[place(k)], nodes[place(k)], link(k), order);
  }
  return out;
}

/// Both sides of a point at one heading, as a range of curvatures.
class Both {
 public:
  Both(const Side& left, const Side& right, const RangeNode& node, Held held)
      : left_{with_node(left.reached, node, left.d, left.e, held), left.d, left.e},
        right_{with_node(right.reached, node, right.d, right.e, held), right.d, right.e},
        kappa_given_(held.kappa && node.kappa) {
    if (held.kappa && node.kappas) kappas_ = *node.kappas;
    if (!left_.reached.any || !right_.reached.any) return;
    first_ = std::max(from(left_), from(right_));
    last_ = std::min(to(left_), to(right_));
    for (const Side* side : {&left_, &right_}) {
      const bool ahead = side->d > 0;
      const Reached& r = side->reached;
      first_is_open_ |= from(*side) == first_ && (ahead ? r.first_is_open : r.last_is_open);
      last_is_open_ |= to(*side) == last_ && (ahead ? r.last_is_open : r.first_is_open);
    }
    any_ = first_ <= last_;
  }

  [[nodiscard]] CurvatureRange at(double theta) const {
    CurvatureRange out{kappas_.low, kappas_.high};
    for (const Side* side : {&left_, &right_}) {
      const double low = low_at(side->reached, side->d * theta);
      if (side->e > 0) out.low = std::max(out.low, low);
      if (side->e < 0) out.high = std::min(out.high, -low);
    }
    return out;
  }

  /// Positive inside.
  [[nodiscard]] double room(double theta) const {
    const CurvatureRange range = at(theta);
    if (kappa_given_ || std::isinf(range.low) || std::isinf(range.high)) return 1.0;
    return range.high - range.low;
  }

  /// The headings at which there is room, as far as they are connected with the most roomy one.
  [[nodiscard]] std::optional<HeadingRange> headings() const {
    if (!any_) return std::nullopt;
    const std::vector<double> grid = all_headings();
    std::size_t best = 0;
    std::vector<double> room_at;
    for (const double theta : grid) room_at.push_back(room(theta));
    for (std::size_t k = 0; k < grid.size(); ++k) {
      if (room_at[k] > room_at[best]) best = k;
    }
    double middle = grid[best];
    if (!(room_at[best] > 0.0)) {
      middle = roomiest(grid, best);
      if (!(room(middle) > 0.0)) return std::nullopt;
    }
    HeadingRange out{first_, last_, first_is_open_, last_is_open_};
    const auto none = [this](double theta) { return -room(theta); };
    for (std::size_t k = best; k-- > 0;) {
      if (room_at[k] > 0.0) continue;
      out.low =
          root_between(grid[k], k + 1 <= best && room_at[k + 1] > 0.0 ? grid[k + 1] : middle, none);
      out.low_is_open = false;
      break;
    }
    for (std::size_t k = best + 1; k < grid.size(); ++k) {
      if (room_at[k] > 0.0) continue;
      out.high = root_between(grid[k], room_at[k - 1] > 0.0 ? grid[k - 1] : middle, none);
      out.high_is_open = false;
      break;
    }
    if (!(room_at[best] > 0.0)) {
      out.low = root_between(grid[best > 0 ? best - 1 : 0], middle, none);
      out.high = root_between(grid[std::min(best + 1, grid.size() - 1)], middle, none);
      out.low_is_open = out.high_is_open = false;
    }
    return out;
  }

  [[nodiscard]] std::optional<CurvatureRange> curvatures(const RangeNode& node) const {
    const auto range = headings();
    if (!range) return std::nullopt;
    std::vector<double> grid;
    for (const double theta : all_headings()) {
      if (theta >= range->low && theta <= range->high) grid.push_back(theta);
    }
    grid.push_back(range->low);
    grid.push_back(range->high);
    std::sort(grid.begin(), grid.end());
    CurvatureRange out{least(grid, [this](double t) { return at(t).low; }),
                       -least(grid, [this](double t) { return -at(t).high; })};
    if (node.curvature_sign > 0) out.low = std::max(out.low, 0.0);
    if (node.curvature_sign < 0) out.high = std::min(out.high, 0.0);
    return out;
  }

 private:
  static double from(const Side& s) { return s.d > 0 ? s.reached.first : -s.reached.last; }
  static double to(const Side& s) { return s.d > 0 ? s.reached.last : -s.reached.first; }

  [[nodiscard]] std::vector<double> all_headings() const {
    std::vector<double> out{first_, last_};
    for (const Side* side : {&left_, &right_}) {
      for (const LowSample& s : side->reached.samples) {
        const double theta = side->d * s.theta;
        if (theta > first_ && theta < last_) out.push_back(theta);
      }
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  /// A place of most room beside one of the grid.
  [[nodiscard]] double roomiest(const std::vector<double>& grid, std::size_t k) const {
    const double low = grid[k > 0 ? k - 1 : 0], high = grid[std::min(k + 1, grid.size() - 1)];
    return highest_place(
        low, high, [this](double theta) { return room(theta); }, kExtremumFoundTo * (high - low));
  }

  template <class F>
  static double least(const std::vector<double>& grid, const F& f) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < grid.size(); ++k) {
      if (f(grid[k]) < f(grid[best])) best = k;
    }
    const double low = grid[best > 0 ? best - 1 : 0],
                 high = grid[std::min(best + 1, grid.size() - 1)];
    if (!std::isfinite(f(grid[best]))) return std::min(f(grid[best]), f(0.5 * (low + high)));
    return std::min(f(grid[best]), f(lowest_place(low, high, f, kExtremumFoundTo * (high - low))));
  }

  Side left_, right_;
  ValueRange kappas_;  // that the point itself allows
  bool kappa_given_;
  bool any_ = false;
  double first_ = 0.0, last_ = 0.0;
  bool first_is_open_ = false, last_is_open_ = false;
};

bool beside_an_arc(const std::vector<RangeLink>& links, std::size_t i) {
  const auto arc = [](const RangeLink& l) { return l.direction && *l.direction == 0; };
  return (i > 0 && arc(links[i - 1])) || (i < links.size() && arc(links[i]));
}

/// At the two ends of a series nothing but convention keeps a curve from turning on before its
/// first point: headings there are looked at up to a right angle from the chord, as far as the
/// range comes nearer than that.
void end_open(HeadingRange& range, double omega) {
  const double low = omega - 0.5 * kPi, high = omega + 0.5 * kPi;
  if (range.high <= low || range.low >= high) return;
  range.low_is_open = range.low_is_open || range.low < low;
  range.high_is_open = range.high_is_open || range.high > high;
  range.low = std::max(range.low, low);
  range.high = std::min(range.high, high);
}

/// Gives a heading, or else a curvature, at the first point of a way and at every so many after it.
template <class Choose>
bool give_in_turn(const std::vector<RangeLink>& links, std::vector<RangeNode>& nodes,
                  std::size_t first, std::size_t every, const Choose& choose, Watch* watch) {
  const std::vector<Side> right = reach_all(links, nodes, -1, watch);
  if (right.empty()) return false;
  Side left = at_first(links.front(), 1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (is_to_end(watch)) return false;
    if (watch != nullptr) watch->spend(kReachWork);
    if (i > 0) left = advance(left, nodes[i - 1], links[i - 1], 1);
    const bool now = i >= first && (i - first) % every == 0;
    if (now && !beside_an_arc(links, i) && !choose(i, left, right[i])) return false;
  }
  return true;
}

template <class Choose>
bool give(const std::vector<RangeLink>& links, std::vector<RangeNode>& nodes, ChoiceOrder order,
          const Choose& choose, Watch* watch) {
  if (order == ChoiceOrder::kHalves) {
    std::size_t step = 1;
    while (2 * step < nodes.size()) step *= 2;
    for (; step > 0; step /= 2) {
      if (!give_in_turn(links, nodes, step, 2 * step, choose, watch)) return false;
    }
  }
  // where halves begin, the first point is left
  const std::size_t every = order == ChoiceOrder::kHalves ? nodes.size() : 1;
  return give_in_turn(links, nodes, 0, every, choose, watch);
}

/// At a vertex or an end of the series a sharper curvature leaves the chords beside it more. The
/// curvature as far beyond the bluntest one that neither A nor B of a chord there is less than
/// twice what it is with that, and sigma; no farther than to the middle of the range. Headings are
/// given. Nothing elsewhere.
std::optional<double> calm_curvature(const std::vector<RangeLink>& links,
                                     const std::vector<RangeNode>& nodes, std::size_t i,
                                     const CurvatureRange& range) {
  const int before = i > 0 ? links[i - 1].direction.value_or(0) : 0;
  const int behind = i < links.size() ? links[i].direction.value_or(0) : 0;
  if (before == behind || before * behind > 0) return std::nullopt;
  const bool sharp_is_high = before > 0 || behind < 0;
  const double end = sharp_is_high ? range.low : range.high;
  const double other = sharp_is_high ? range.high : range.low;
  if (std::isinf(end)) return std::nullopt;
  double beyond = 0.0;
  for (std::size_t k = i > 0 ? i - 1 : 0; k < std::min(i + 1, links.size()); ++k) {
    const int d = links[k].direction.value_or(0);
    if (d == 0 || !nodes[k].theta || !nodes[k + 1].theta) continue;
    const double alpha = d * (*nodes[k].theta - links[k].omega);
    const double beta = d * (*nodes[k + 1].theta - links[k].omega);
    const double bent = 0.5 * d * end * links[k].h;
    const double there = k == i ? -(bent + std::sin(alpha)) : bent - std::sin(beta);
    beyond = std::max(beyond, 2.0 / links[k].h * (std::max(there, 0.0) + std::abs(alpha + beta)));
  }
  if (!(beyond > 0.0)) return std::nullopt;
  beyond = std::min(beyond, 0.5 * std::abs(other - end));
  return sharp_is_high ? end + beyond : end - beyond;
}

}  // namespace

std::optional<std::vector<RangeNode>> central_data(const std::vector<RangeLink>& links,
                                                   std::vector<RangeNode> nodes,
                                                   const std::vector<std::optional<double>>& wanted,
                                                   ChoiceOrder order, SharpCurvature sharp,
                                                   Watch* watch) {
  if (nodes.size() < 2) return std::nullopt;
  const auto heading = [&](std::size_t i, const Side& left, const Side& right) {
    auto range = Both(left, right, nodes[i], {true, true}).headings();
    if (!range) return false;
    if (nodes[i].theta) return true;
    if (i == 0) end_open(*range, links.front().omega);
    if (i + 1 == nodes.size()) end_open(*range, links.back().omega);
    nodes[i].theta = 0.5 * (range->low + range->high);
    return true;
  };
  const auto curvature = [&](std::size_t i, const Side& left, const Side& right) {
    if (nodes[i].kappa) return true;
    const auto range = Both(left, right, nodes[i], {true, true}).curvatures(nodes[i]);
    if (!range || !(range->low < range->high)) return false;
    if (sharp == SharpCurvature::kCalm) nodes[i].kappa = calm_curvature(links, nodes, i, *range);
    if (!nodes[i].kappa) {
      nodes[i].kappa =
          region_detail::chosen_curvature(*range, wanted.empty() ? std::nullopt : wanted[i]);
    }
    return true;
  };
  if (!give(links, nodes, order, heading, watch) || !give(links, nodes, order, curvature, watch)) {
    return std::nullopt;
  }
  return nodes;
}

std::vector<FeasibleData> feasible_data(const std::vector<RangeLink>& links,
                                        const std::vector<RangeNode>& nodes, Watch* watch) {
  std::vector<FeasibleData> out(nodes.size());
  if (nodes.size() < 2) return out;
  const std::vector<Side> left = reach_all(links, nodes, 1, watch);
  const std::vector<Side> right = reach_all(links, nodes, -1, watch);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (is_to_end(watch)) return std::vector<FeasibleData>(nodes.size());
    const RangeNode& node = nodes[i];
    if (beside_an_arc(links, i)) {
      if (node.theta) out[i].heading = HeadingRange{*node.theta, *node.theta};
      if (node.kappa) out[i].kappa = CurvatureRange{*node.kappa, *node.kappa};
      continue;
    }
    out[i].heading = Both(left[i], right[i], node, {false, true}).headings();
    if (out[i].heading && i == 0) end_open(*out[i].heading, links.front().omega);
    if (out[i].heading && i + 1 == nodes.size()) end_open(*out[i].heading, links.back().omega);
    out[i].kappa = Both(left[i], right[i], node, {true, false}).curvatures(node);
  }
  return out;
}

}  // namespace obvid
