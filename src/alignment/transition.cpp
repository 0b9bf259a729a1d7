// SPDX-License-Identifier: Apache-2.0
#include "obvid/alignment/transition.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "obvid/alignment/internal/transition_law.h"
#include "obvid/curve/internal/clothoid.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/numeric/internal/gauss.h"
#include "obvid/numeric/internal/small_system.h"

namespace obvid {
namespace {

constexpr double kPi = std::numbers::pi;
/// Rad that a part of Gauss's rule turns, and parts of the length that it covers, at the most.
constexpr double kPartTurn = 0.5;
constexpr double kPartShare = 0.125;  // the middle, where Helmert's law has a corner, is a joint
constexpr double kLeastPartShare = 1.0 / 2048.0;  // of a turn of `kMostTransitionTurn`
constexpr int kMostClothoids = 1024;
constexpr int kLooks = 8;  ///< places of a clothoid that are compared

// The cubic parabola y = x^3/3: slope x^2, curvature 2 G(x), arc length S(x) from its inflection.
// All others are larger or smaller ones.

/// Of an arc length: a step of Newton's method behind which rounding is left.
constexpr double kSettledArc = 1e-12;

/// Where its curvature is greatest: x^4 = 1/5.
constexpr double kFarthest = 0.66874030497642202;

double half_curvature(double x) {
  const double v = 1.0 + x * x * x * x;
  return x / (v * std::sqrt(v));
}

/// Binomial coefficients of sqrt(1 + w) over 4 k + 1: up to w = 1/5 what is left is 1e-19.
constexpr auto kArcSeries = [] {
  std::array<double, 22> out{};
  double term = 1.0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const auto n = static_cast<double>(k);
    if (k > 0) term *= (1.5 - n) / n;
    out[k] = term / (4.0 * n + 1.0);
  }
  return out;
}();

/// The integral of sqrt(1 + x^4) from 0; x^4 <= 1/5.
double length_to(double x) {
  const double w = x * x * x * x;
  double sum = 0.0;
  for (std::size_t k = kArcSeries.size(); k-- > 0;) sum = sum * w + kArcSeries[k];
  return x * sum;
}

/// The inverse over arc length: x = S (c0 + c1 w + ...), w = S^4, which is 0.2161 at the farthest
/// place. The polynomial that meets it at Chebyshev's places of [0, 0.2188], computed with 60
/// digits: what is left is 6e-19.
constexpr std::array kPlaceAlong = {
    1.0,
    -0.099999999999998176,
    0.063888888888344828,
    -0.059252136687982033,
    0.064937747419472826,
    -0.078281074026425545,
    0.10036628722344849,
    -0.13431664710988725,
    0.18505924109762893,
    -0.25737637146451643,
    0.34518428830632761,
    -0.40531539842222356,
    0.3508199097167561,
    -0.15873956372582959,
};

/// The abscissa at an arc length from 0.
double place_at(double length) {
  const double square = length * length, w = square * square, pair = w * w;
  double even = 0.0, odd = 0.0;  // two sums, neither of which waits for the other
  for (std::size_t k = kPlaceAlong.size(); k > 0; k -= 2) {
    odd = odd * pair + kPlaceAlong[k - 1];
    even = even * pair + kPlaceAlong[k - 2];
  }
  return length * (even + w * odd);
}

double arc_rate(double x) { return std::sqrt(1.0 + x * x * x * x); }

double curvature_rate(double x) {
  const double w = x * x * x * x, v = 1.0 + w;
  return (1.0 - 5.0 * w) / (v * v * std::sqrt(v));
}

/// Abscissa with half the curvature `g`, or the farthest. Newton's steps from below: G is concave.
double place_with(double g) {
  constexpr int kMost = 64;
  const double goal = std::abs(g);
  if (goal >= half_curvature(kFarthest)) return std::copysign(kFarthest, g);
  double x = goal;
  for (int i = 0; i < kMost; ++i) {
    const double next = std::min(
        kFarthest, x + (goal - half_curvature(x)) / curvature_rate(std::min(x, kFarthest)));
    if (!(next > x)) break;
    x = next;
  }
  return std::copysign(x, g);
}

/// Arc length between the places where the curvature times it is `turn0` and `turn1` > `turn0`; one
/// or both of them the farthest place where there is none.
double arc_between(double turn0, double turn1) {
  constexpr int kMost = 100;
  struct Ends {
    double x0, x1, excess;  ///< of arc length between them
  };
  const auto ends_with = [&](double arc) {
    const double x0 = place_with(0.5 * turn0 / arc), x1 = place_with(0.5 * turn1 / arc);
    return Ends{x0, x1, length_to(x1) - length_to(x0) - arc};
  };
  const double least = 0.5 * std::max(std::abs(turn0), std::abs(turn1)) / half_curvature(kFarthest);
  if (!(ends_with(least).excess > 0.0)) return least;
  double low = least, high = 2.0 * length_to(kFarthest);
  double arc = std::clamp(std::sqrt(0.5 * (turn1 - turn0)), low, high);
  for (int i = 0; i < kMost; ++i) {
    const auto [x0, x1, excess] = ends_with(arc);
    (excess > 0.0 ? low : high) = arc;
    const double rate =
        (turn0 * arc_rate(x0) / curvature_rate(x0) - turn1 * arc_rate(x1) / curvature_rate(x1)) /
            (2.0 * arc * arc) -
        1.0;
    double next = arc - excess / rate;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const bool settled = std::abs(next - arc) <= kSettledArc * arc;
    arc = next;
    if (settled) break;
  }
  return arc;
}

double plain_share(Transition kind, double u) {
  switch (kind) {
    case Transition::kClothoid:
    case Transition::kCubic:
      break;
    case Transition::kBloss:
      return u * u * (3.0 - 2.0 * u);
    case Transition::kSine:
      return u - std::sin(2.0 * kPi * u) / (2.0 * kPi);
    case Transition::kCosine:
      return 0.5 * (1.0 - std::cos(kPi * u));
    case Transition::kHelmert:
      return u < 0.5 ? 2.0 * u * u : 1.0 - 2.0 * (1.0 - u) * (1.0 - u);
  }
  return u;
}

double plain_turn(Transition kind, double u) {
  switch (kind) {
    case Transition::kClothoid:
    case Transition::kCubic:
      break;
    case Transition::kBloss:
      return u * u * u * (1.0 - 0.5 * u);
    case Transition::kSine: {
      const double sine = std::sin(kPi * u);  // cos(2 pi u) - 1 = -2 sin^2(pi u)
      return 0.5 * u * u - 0.5 * sine * sine / (kPi * kPi);
    }
    case Transition::kCosine:
      return 0.5 * u - 0.5 * std::sin(kPi * u) / kPi;
    case Transition::kHelmert: {
      const double v = 1.0 - u;
      return u < 0.5 ? 2.0 / 3.0 * u * u * u : u - 0.5 + 2.0 / 3.0 * v * v * v;
    }
  }
  return 0.5 * u * u;
}

}  // namespace

std::size_t elements_in(std::size_t pieces, const std::vector<PlacedTransition>& transitions) {
  for (const PlacedTransition& one : transitions) pieces -= one.pieces - 1;
  return pieces;
}

std::optional<Transition> transition_named(std::string_view name) {
  const auto at = std::find(kTransitionNames.begin(), kTransitionNames.end(), name);
  if (at == kTransitionNames.end()) return std::nullopt;
  return static_cast<Transition>(at - kTransitionNames.begin());
}

TransitionLaw::TransitionLaw(Transition kind, double kappa0, double kappa1, double length)
    : kind_(kappa0 == kappa1 ? Transition::kClothoid : kind) {
  if (kind_ != Transition::kCubic) return;
  const double side = kappa1 > kappa0 ? 1.0 : -1.0;
  const double turn0 = side * kappa0 * length, turn1 = side * kappa1 * length;
  const double arc = arc_between(turn0, turn1);
  from_ = place_with(0.5 * turn0 / arc);
  to_ = place_with(0.5 * turn1 / arc);
  before_ = length_to(from_);
  along_ = length_to(to_) - before_;
  bent_ = half_curvature(from_);
  bends_ = half_curvature(to_) - bent_;
  scale_ = length / along_;
  side_ = side;
  constexpr double kSameArc = 1e-12;  // of the farthest place
  exists_ = along_ >= arc - kSameArc;
  if (bends_ > 0.0) return;
  kind_ = Transition::kClothoid;  // both are the farthest
  exists_ = false;
}

std::optional<double> TransitionLaw::inflection() const {
  if (kind_ != Transition::kCubic || !exists_ || !(from_ < 0.0 && to_ > 0.0)) return std::nullopt;
  return -before_ / along_;
}

double TransitionLaw::bends_back() const {
  if (kind_ == Transition::kClothoid) return 1.0;
  if (kind_ != Transition::kCubic) return 0.5;
  return from_ < 0.0 && to_ > 0.0 ? -before_ / along_ : 1.0;
}

TransitionLaw::Place TransitionLaw::at(double u) const {
  if (kind_ != Transition::kCubic) return {plain_share(kind_, u), plain_turn(kind_, u), {}};
  const double x = place_at(before_ + u * along_), d = x - from_, slope = from_ * from_;
  Place out;
  out.share = (half_curvature(x) - bent_) / bends_;
  // atan x^2 - atan from^2, the heading, without cancellation
  const double turned = std::atan2(d * (x + from_), 1.0 + x * x * slope);
  out.turn = (turned / (2.0 * along_) - bent_ * u) / bends_;
  if (!exists_) return out;
  const Vec2 chord{d, d * (x * x + x * from_ + slope) / 3.0};
  const double cosine = 1.0 / std::sqrt(1.0 + slope * slope);
  const Vec2 tangent{cosine, slope * cosine};
  out.step = scale_ * Vec2{dot(tangent, chord), side_ * cross(tangent, chord)};
  return out;
}

double TransitionLaw::share(double u) const { return at(u).share; }

double TransitionLaw::turn(double u) const { return at(u).turn; }

Element transition_at(const TransitionLaw& law, const Element& start, double kappa1, double length,
                      double s) {
  const double change = kappa1 - start.kappa;
  if (law.is_linear()) {
    return clothoid_at(start, change / length, s);
  }
  if (s < 0.0) return clothoid_at(start, 0.0, s);
  if (s > length) {
    return clothoid_at(transition_at(law, start, kappa1, length, length), 0.0, s - length);
  }
  const auto theta_at = [&](double u) {
    return start.theta + start.kappa * length * u + change * length * law.turn(u);
  };
  const double whole = s / length;
  const TransitionLaw::Place end = law.at(whole);
  const double theta = start.theta + (start.kappa * whole + change * end.turn) * length;
  const double kappa = start.kappa + change * end.share;
  if (end.step)
    return {start.point + complex_product(unit_at(start.theta), *end.step), theta, kappa};
  const double turn = (std::abs(start.kappa) + std::abs(change)) * length;
  const double share =
      std::clamp(std::exp2(std::floor(std::log2(kPartTurn / turn))), kLeastPartShare, kPartShare);
  Vec2 step;
  for (double from = 0.0; from < whole; from += share) {  // powers of two: exact
    const double to = std::min(from + share, whole);
    const double middle = 0.5 * (from + to), width = to - from;
    for (std::size_t i = 0; i < 8; ++i) {
      const double node = GaussRule<8>::kNode[i / 2] * (i % 2 == 0 ? 0.5 : -0.5);
      const double weight = 0.5 * width * length * GaussRule<8>::kWeight[i / 2];
      step = step + weight * unit_at(theta_at(middle + node * width));
    }
  }
  return {start.point + step, theta_at(whole), start.kappa + change * law.share(whole)};
}

Element transition_at(Transition kind, const Element& start, double kappa1, double length,
                      double s) {
  return transition_at(TransitionLaw(kind, start.kappa, kappa1, length), start, kappa1, length, s);
}

namespace {

/// Two clothoids between two elements of a transition between which its curvature bends to one
/// side: it grows or falls along both, is that of the elements at their ends, and the way and the
/// turning between them are the transition's.
class ClothoidPair {
 public:
  ClothoidPair(const Element& from, const Element& to, double length) : from_(from), to_(to) {
    const double change = to.kappa - from.kappa;
    below_ = from.kappa + to.kappa - 2.0 * (to.theta - from.theta) / length;
    straight_ = !(std::abs(below_) > kStraightLaw * std::abs(change) &&
                  std::abs(below_) * length > kStraightTurn);
    unknown_ = {0.5, below_, length};
  }

  /// False where there are none.
  bool solve() {
    constexpr int kMost = 40;
    constexpr double kMet = 4.0 * 0x1p-53;  // of the length, and rad
    if (straight_) return true;
    double before = HUGE_VAL;
    for (int k = 0; k < kMost; ++k) {
      const Miss now = miss(unknown_);
      const double far = std::max({std::abs(now[0]), std::abs(now[1]), std::abs(now[2])});
      if (far <= kMet || (far <= kSettledPair && !(far < before))) return grows_one_way();
      before = far;
      if (!step(now)) return false;
    }
    return false;
  }

  void add_to(std::vector<ClothoidPiece>& out) const {
    const double length = unknown_[2], first = unknown_[0] * length;
    if (straight_) {
      out.push_back({from_.point, to_.point, from_.theta, from_.kappa, to_.kappa, length});
      return;
    }
    const double kappa = middle_curvature(unknown_);
    const Element middle = clothoid_at(from_, (kappa - from_.kappa) / first, first);
    out.push_back({from_.point, middle.point, from_.theta, from_.kappa, kappa, first});
    out.push_back({middle.point, to_.point, middle.theta, kappa, to_.kappa, length - first});
  }

 private:
  /// Share of the length where the two meet, how far the curvature there is below the chord of
  /// curvatures (1/unit), and the length.
  using Unknown = std::array<double, 3>;
  using Miss = std::array<double, 3>;  ///< way along and beside, of the length, and turning

  /// Of the change of the curvature: a law that leaves its chord by less is straight.
  static constexpr double kStraightLaw = 1e-12;
  /// Rad: likewise, what turns by so much less than along the chord; where two straight parts of it
  /// would meet is lost in the rounding of places.
  static constexpr double kStraightTurn = 1e-12;
  // Of the share of the length and of what the middle lies below; of the length: steps of secants.
  static constexpr double kSecantShare = 0.05;
  static constexpr double kSecantLength = 1e-3;
  /// Where steps lead no nearer, this is near enough: of the length, and rad.
  static constexpr double kSettledPair = 1e-13;

  [[nodiscard]] double middle_curvature(const Unknown& x) const {
    return from_.kappa + x[0] * (to_.kappa - from_.kappa) - x[1];
  }

  [[nodiscard]] bool grows_one_way() const {
    const double kappa = middle_curvature(unknown_);
    return unknown_[0] > 0.0 && unknown_[0] < 1.0 && unknown_[2] > 0.0 &&
           (kappa - from_.kappa) * (to_.kappa - kappa) >= 0.0;
  }

  [[nodiscard]] Miss miss(const Unknown& x) const {
    const double kappa = middle_curvature(x), first = x[0] * x[2], second = x[2] - first;
    const double theta = from_.theta + 0.5 * (from_.kappa + kappa) * first;
    const Vec2 way = clothoid_step(from_.theta, from_.kappa, kappa, first) +
                     clothoid_step(theta, kappa, to_.kappa, second);
    const Vec2 off = complex_product(way - (to_.point - from_.point), unit_at(-from_.theta));
    return {off.x / x[2], off.y / x[2], theta + 0.5 * (kappa + to_.kappa) * second - to_.theta};
  }

  /// A step of Newton's method, with secants so long that their rounding is none: to first order
  /// all three are linear.
  bool step(const Miss& now) {
    const Unknown by = {kSecantShare, kSecantShare * below_, kSecantLength * unknown_[2]};
    std::array<Miss, 3> change;
    for (std::size_t j = 0; j < 3; ++j) {
      Unknown moved = unknown_;
      moved[j] += by[j];
      const Miss there = miss(moved);
      for (std::size_t i = 0; i < 3; ++i) change[i][j] = there[i] - now[i];
    }
    Miss share = now;
    if (!solve_small(change, share)) return false;
    for (std::size_t j = 0; j < 3; ++j) unknown_[j] -= share[j] * by[j];
    return std::isfinite(unknown_[0] + unknown_[1] + unknown_[2]);
  }

  Element from_, to_;
  double below_ = 0.0;
  bool straight_ = false;
  Unknown unknown_{};
};

/// How far pieces are beside a transition, units; looked at between their ends.
double farthest_beside(const std::vector<ClothoidPiece>& pieces, const TransitionLaw& law,
                       const Element& start, double kappa1, double length) {
  double largest = 0.0, from = 0.0;
  for (const ClothoidPiece& piece : pieces) {
    for (int look = 1; look < kLooks; ++look) {
      const double part = static_cast<double>(look) / kLooks;
      const Element there = transition_at(law, start, kappa1, length, from + part * piece.length);
      const Vec2 away = evaluate(piece, part).point - there.point;
      largest = std::max(largest, std::abs(cross(unit_at(there.theta), away)));
    }
    from += piece.length;
  }
  return largest;
}

}  // namespace

Result<std::vector<ClothoidPiece>> clothoids_along(Transition kind, const Element& start,
                                                   double kappa1, double length, double tolerance) {
  const TransitionLaw law(kind, start.kappa, kappa1, length);
  const double middle = law.bends_back();
  const double turn = 0.5 * std::abs(start.kappa + kappa1) * length;
  const auto none_found = [&] {
    return error(ErrorCode::kUnsupported,
                 fmt::format("no clothoids are found along a transition of kind {} that turns by "
                             "{:.3g} deg",
                             name_of(kind), turn / kOneDegree));
  };
  if (turns_too_far(start.kappa, kappa1, length)) return none_found();
  for (int count = 1;; count *= 2) {
    std::vector<ClothoidPiece> out;
    Element from = start;
    double share = 0.0;
    bool found = true;
    for (int k = 0; k < 2 * count && found; ++k) {
      const double part = static_cast<double>(k % count + 1) / count;
      const double next = k < count ? part * middle : middle + part * (1.0 - middle);
      if (!(next > share)) continue;
      Element to = transition_at(law, start, kappa1, length, next * length);
      if (next == 1.0) to.kappa = kappa1;
      ClothoidPair pair(from, to, (next - share) * length);
      found = pair.solve();
      if (found) pair.add_to(out);
      from = to;
      share = next;
    }
    const bool last = 2 * count >= kMostClothoids;
    const double beside = found ? farthest_beside(out, law, start, kappa1, length)
                                : std::numeric_limits<double>::infinity();
    if (beside <= tolerance) return out;
    if (last && found) {
      return error(ErrorCode::kUnsupported,
                   fmt::format("{} clothoids along a transition of kind {} are still {:.3g} beside "
                               "it, where {:.3g} is asked for",
                               out.size(), name_of(kind), beside, tolerance));
    }
    if (last) return none_found();
  }
}

}  // namespace obvid
