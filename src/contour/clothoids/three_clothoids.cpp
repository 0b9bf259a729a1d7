// SPDX-License-Identifier: Apache-2.0
// Three clothoids over a link (docs/methods/clothoids.md, section 4). Lengths in chords, curvature
// increasing; the other direction is the mirror image.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "obvid/contour/clothoids.h"
#include "obvid/curve/internal/clothoid.h"

namespace obvid {
namespace {

constexpr std::size_t kCells = 3;
using Cells = std::array<double, kCells>;

/// A cell's sharpness is at least this part of the mean one.
constexpr double kLeastSharpness = 1e-6;
/// At least this much of the mean on every cell of equal length, or unequal ones are tried first.
constexpr double kEvenSharpness = 0.2;
constexpr int kMostTripleSteps = 12;  // four or five do it
constexpr double kRounding = 4e-16;   // of the chord and of a radian: no step betters this
constexpr double kClose = 1e-14;      // what counts as met

struct Link {
  double alpha, beta;  ///< headings against the chord
  double kappa;        ///< at the start, times the chord
  double rise;         ///< of the curvature over the whole link, times the chord
  double shift;        ///< 2 (A + B): moment of the rise about the middle of the chord
  double sines;        ///< 2 sin(sigma/2): moment of the rise that is away from both ends
  double half_turn;
};

Link mirrored(const LinkState& link, int direction, double kappa_start) {
  const double d = direction;
  const double A = d * link.A, B = d * link.B;
  const double sines = 2.0 * std::sin(0.5 * d * link.sigma);
  const double half_turn = 0.5 * d * (link.beta - link.alpha);
  return {d * link.alpha,
          d * link.beta,
          d * kappa_start * link.h,
          2.0 * (B - A + sines * std::cos(half_turn)),
          2.0 * (A + B),
          sines,
          half_turn};
}

/// Where the cells end, as fractions of the length, and how much curvature rises on each.
struct Profile {
  Cells width{};
  Cells rise{};
  double length = 0.0;
};

/// Solves two equations for the rises of the outer cells; the middle one takes the rest.
struct TwoByTwo {
  double a11, a12, a21, a22;
  [[nodiscard]] std::optional<Vec2> solve(double b1, double b2) const {
    const double det = a11 * a22 - a12 * a21;
    if (det == 0.0 || !std::isfinite(det)) return std::nullopt;
    return Vec2{(b1 * a22 - b2 * a12) / det, (a11 * b2 - a21 * b1) / det};
  }
};

/// What a rise at fraction f of a circle arc counts in both moments.
class ArcWeights {
 public:
  explicit ArcWeights(double half_turn)
      : half_turn_(half_turn),
        sine_(std::sin(half_turn)),
        straight_(std::abs(half_turn) < kStraight) {}

  [[nodiscard]] double shift(double f) const { return ratio(2.0 * f - 1.0); }
  [[nodiscard]] double sines(double f) const { return ratio(f) * ratio(1.0 - f); }
  [[nodiscard]] double length() const { return straight_ ? 1.0 : half_turn_ / sine_; }

 private:
  static constexpr double kStraight = 1e-6;  // rad: fractions are as good as sines

  [[nodiscard]] double ratio(double f) const {
    return straight_ ? f : std::sin(half_turn_ * f) / sine_;
  }

  double half_turn_, sine_;
  bool straight_;
};

/// The rises whose moments are the link's, as if the link were a circle arc: exact up to the part
/// that curvature changes, with all digits of that small part.
std::optional<Profile> first_profile(const Link& link, const Cells& width) {
  const ArcWeights weights(link.half_turn);
  Cells shift{}, sines{};
  double from = 0.0;
  for (std::size_t j = 0; j < kCells; ++j) {  // means over the cell by Simpson's rule
    const double to = from + width[j], middle = from + 0.5 * width[j];
    shift[j] = (weights.shift(from) + 4.0 * weights.shift(middle) + weights.shift(to)) / 6.0;
    sines[j] = (weights.sines(from) + 4.0 * weights.sines(middle) + weights.sines(to)) / 6.0;
    from = to;
  }
  const TwoByTwo system = {shift[0] - shift[1], shift[2] - shift[1], sines[0] - sines[1],
                           sines[2] - sines[1]};
  const auto outer =
      system.solve(link.shift - shift[1] * link.rise, link.sines - sines[1] * link.rise);
  if (!outer) return std::nullopt;
  return Profile{width, {outer->x, link.rise - outer->x - outer->y, outer->y}, weights.length()};
}

bool positive(const Profile& p, double rise, double least) {
  for (std::size_t j = 0; j < kCells; ++j) {
    if (!(p.rise[j] >= least * p.width[j] * rise)) return false;
  }
  return true;
}

/// The curve of a profile at the ends of its cells, in the frame of the chord.
struct Trace {
  std::array<Vec2, kCells + 1> point{};
  std::array<Vec2, kCells + 1> tangent{};
  std::array<double, kCells + 1> theta{};
  std::array<double, kCells + 1> kappa{};
};

Trace trace(const Link& link, const Profile& p) {
  Trace t;
  t.theta[0] = link.alpha;
  t.kappa[0] = link.kappa;
  t.tangent[0] = unit_at(link.alpha);
  for (std::size_t j = 0; j < kCells; ++j) {
    const double s = p.length * p.width[j];
    t.kappa[j + 1] = t.kappa[j] + p.rise[j];
    t.theta[j + 1] = t.theta[j] + 0.5 * (t.kappa[j] + t.kappa[j + 1]) * s;
    t.point[j + 1] = t.point[j] + clothoid_step(t.theta[j], t.kappa[j], t.kappa[j + 1], s);
    t.tangent[j + 1] = unit_at(t.theta[j + 1]);
  }
  return t;
}

/// What is left to the end, integrated over a cell; and weighted with a ramp from 0 to 1 on it.
/// Cubics stand in for the clothoids.
struct CellIntegrals {
  Vec2 whole, ramp;
};

CellIntegrals left_to_end(const Trace& t, const Profile& p, std::size_t j) {
  const double s = p.length * p.width[j];
  const Vec2 a = t.point[kCells] - t.point[j], b = t.point[kCells] - t.point[j + 1];
  const Vec2 da = -s * t.tangent[j], db = -s * t.tangent[j + 1];
  return {s * (0.5 * (a + b) + (1.0 / 12.0) * (da - db)),
          s * (0.15 * a + 0.35 * b + (1.0 / 30.0) * da - 0.05 * db)};
}

/// How the end's place and heading answer to one number of the profile.
struct Answer {
  Vec2 point;
  double turn = 0.0;

  friend Answer operator-(const Answer& a, const Answer& b) {
    return {a.point - b.point, a.turn - b.turn};
  }
};

struct Answers {
  std::array<Answer, kCells> rise;
  Answer length;
};

/// A curvature that is larger by one from s on turns what is left of the curve by what is left of
/// its length; a longer curve is scaled, and turned by its own curvature.
Answers answers(const Trace& t, const Profile& p) {
  Answers out;
  Vec2 behind, by_length = t.point[kCells];
  double length_behind = 0.0;
  for (std::size_t j = kCells; j-- > 0;) {
    const CellIntegrals left = left_to_end(t, p, j);
    const double s = p.length * p.width[j];
    out.rise[j] = {left_normal(left.ramp + behind), 0.5 * s + length_behind};
    by_length = by_length + left_normal(t.kappa[j] * left.whole + p.rise[j] * left.ramp);
    behind = behind + left.whole;
    length_behind += s;
  }
  out.length = {by_length / p.length, (t.theta[kCells] - t.theta[0]) / p.length};
  return out;
}

double determinant(const Answer& a, const Answer& b, const Answer& c) {
  return a.turn * cross(b.point, c.point) + b.turn * cross(c.point, a.point) +
         c.turn * cross(a.point, b.point);
}

/// One Newton step for the rises of the outer cells and the length; the middle cell takes the rest.
bool improve(const Trace& t, const Link& link, Profile& p) {
  const Answers by = answers(t, p);
  const Answer first = by.rise[0] - by.rise[1], last = by.rise[2] - by.rise[1];
  const Answer miss = {Vec2{1.0, 0.0} - t.point[kCells], link.beta - t.theta[kCells]};
  const double whole = determinant(first, last, by.length);
  if (whole == 0.0 || !std::isfinite(whole)) return false;
  const double more_first = determinant(miss, last, by.length) / whole;
  const double more_last = determinant(first, miss, by.length) / whole;
  p.rise[0] += more_first;
  p.rise[1] -= more_first + more_last;
  p.rise[2] += more_last;
  p.length += determinant(first, last, miss) / whole;
  return p.length > 0.0;
}

double largest_miss(const Trace& t, const Link& link) {
  const Vec2 miss = Vec2{1.0, 0.0} - t.point[kCells];
  return std::max({std::abs(miss.x), std::abs(miss.y), std::abs(link.beta - t.theta[kCells])});
}

/// Newton's method until the end is met as well as rounding lets it.
std::optional<Trace> meet_end(const Link& link, Profile& p) {
  std::optional<Trace> best;
  Profile best_profile = p;
  double best_miss = HUGE_VAL;
  for (int i = 0; i < kMostTripleSteps; ++i) {
    const Trace t = trace(link, p);
    const double miss = largest_miss(t, link);
    if (!(miss < best_miss) && best_miss <= kClose) break;
    if (miss < best_miss) {
      best = t;
      best_profile = p;
      best_miss = miss;
    }
    if (miss <= kRounding || !improve(t, link, p)) break;
  }
  p = best_profile;
  const bool met = best_miss <= kClose * (1.0 + std::abs(link.alpha) + std::abs(link.beta));
  return met ? best : std::nullopt;
}

/// Where the curvature rises: mean and mean square of the place, with the link from -1 to 1 and as
/// if it were an arc.
struct Place {
  double mean, square;
};

Place place_of_rise(const Link& link) {
  constexpr double kHardlyTurns = 1e-3;  // rad: squares say as much as cosines, with more digits
  const double shift = link.shift / link.rise, sines = link.sines / link.rise;
  const double half = link.half_turn;
  if (std::abs(half) < kHardlyTurns) return {shift, 1.0 - 4.0 * sines};
  // mean of e^{i angle}, the angle from the arc's middle: its heading and how much it lacks of 1
  const double sine = std::sin(half);
  const Vec2 mean = {std::cos(half) + 2.0 * sines * sine * sine, shift * sine};
  const double angle = heading(mean) / half;
  return {angle, angle * angle + 2.0 * (1.0 - norm(mean)) / (half * half)};
}

/// The same from rises on three even cells, of any sign: it holds however far the link turns.
Place place_of_rise(const Profile& even, double rise) {
  const double outer = (even.rise[0] + even.rise[2]) / rise;
  return {2.0 / 3.0 * (even.rise[2] - even.rise[0]) / rise, 4.0 / 9.0 * outer + 1.0 / 27.0};
}

/// A middle cell around the mean, so narrow that its even rise alone would spread too little.
Cells cells_about_mean(const Place& place) {
  constexpr double kRoom = 0.9;    // of the room to the nearer end
  constexpr double kNarrow = 0.6;  // of the half width with the whole rise in the middle cell
  const double spread = std::max(0.0, place.square - place.mean * place.mean);
  const double half =
      std::min(kNarrow * std::sqrt(3.0 * spread), kRoom * (1.0 - std::abs(place.mean)));
  return {0.5 * (1.0 + place.mean - half), half, 0.5 * (1.0 - place.mean - half)};
}

/// Cells at both ends, so narrow that even rises on them alone would spread too far: their mean
/// square is 1 - e + e^2/3 with e their width.
Cells cells_at_ends(const Place& place) {
  const double width = 0.25 * (1.0 - place.square);
  return {width, 1.0 - 2.0 * width, width};
}

/// Newton from `first`; the profile comes back in `p`.
std::optional<Trace> solve_from(const Link& link, const std::optional<Profile>& first, double least,
                                Profile& p) {
  if (!first || !(*std::min_element(first->width.begin(), first->width.end()) > 0.0)) {
    return std::nullopt;
  }
  p = *first;
  const auto t = meet_end(link, p);
  return t && positive(p, link.rise, least) ? t : std::nullopt;
}

/// Pieces that turn farther are cut: the proof and every CAD kernel want less than half a turn.
constexpr double kLargestTurn = 2.4;
constexpr double kMostParts = 64.0;  // far beyond what two headings allow

/// The clothoid in equal lengths, none of which turns far.
void append_parts(const Element& from, const Element& to, double length,
                  std::vector<ClothoidPiece>& pieces) {
  const double turn = 0.5 * (std::abs(from.kappa) + std::abs(to.kappa)) * length;
  const int count = 1 + static_cast<int>(std::min(kMostParts, turn / kLargestTurn));
  const double sharpness = (to.kappa - from.kappa) / length;
  Element here = from;
  for (int j = 1; j <= count; ++j) {
    const Element next = j == count ? to : clothoid_at(from, sharpness, j * length / count);
    pieces.push_back({here.point, next.point, here.theta, here.kappa, next.kappa, length / count});
    here = next;
  }
}

/// Even cells where they do, else cells that suit where the curvature rises.
std::optional<Trace> three_cells(const Link& link, Profile& p) {
  constexpr Cells kEven = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
  if (auto t = solve_from(link, first_profile(link, kEven), kEvenSharpness, p)) return t;
  const Profile even = p;
  for (const Place& place : {place_of_rise(link), place_of_rise(even, link.rise)}) {
    for (const Cells& cells : {cells_about_mean(place), cells_at_ends(place)}) {
      if (auto t = solve_from(link, first_profile(link, cells), kLeastSharpness, p)) return t;
    }
  }
  return std::nullopt;
}

}  // namespace

bool append_clothoids(const LinkState& link, int direction, const Element& start,
                      const Element& end, std::vector<ClothoidPiece>& pieces) {
  const Link own = mirrored(link, direction, start.kappa);
  if (!(own.rise > 0.0 && own.sines > 0.0 && std::abs(own.shift) < own.rise)) return false;
  Profile p;
  const auto t = three_cells(own, p);
  if (!t) return false;
  const double d = direction;
  const Vec2 chord = end.point - start.point;
  const auto inner = [&](std::size_t j, double kappa) -> Element {
    const Vec2 z = t->point[j];
    return {start.point + complex_product({z.x, d * z.y}, chord),
            start.theta + d * (t->theta[j] - own.alpha), kappa};
  };
  const std::array<Element, kCells + 1> joint = {start,
                                                 inner(1, start.kappa + d * p.rise[0] / link.h),
                                                 inner(2, end.kappa - d * p.rise[2] / link.h), end};
  for (std::size_t j = 0; j < kCells; ++j) {
    append_parts(joint[j], joint[j + 1], p.length * p.width[j] * link.h, pieces);
  }
  return true;
}

}  // namespace obvid
