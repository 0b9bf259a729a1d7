// SPDX-License-Identifier: Apache-2.0
// Corners of a series: where it turns at once. Reasons for each rule: docs/methods/series.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "obvid/core/units.h"
#include "obvid/series/analysis.h"
#include "obvid/series/internal/sections.h"

namespace obvid {
namespace {

/// A turn counts as explained when three times what the neighbourhood foretells reach it: sampled
/// tips of ellipses and leading edges of the public airfoils stay below two and a half.
constexpr double kExplainFactor = 3.0;
/// Curvature of a smooth series grows by no more than this from one point to the next.
constexpr double kLargestGrowth = 8.0;
/// Chords that shrink to this part (geometric mean of both sides) towards a point: whoever measured
/// expected a tight bend there, not a corner. Uniform sampling with noise stays above.
constexpr double kGradedSpacing = 0.75;
/// Above this turn a point is a corner however its neighbours are spaced: no leading edge of the
/// public airfoils turns by more than 156 degrees at one point, no closed sharp trailing edge by
/// less than 162.
constexpr double kSharpTurn = 150.0 * kOneDegree;
/// A neighbour that turns by this much, or half the wanted angle, is no calm flank.
constexpr double kRoughTurn = 15.0 * kOneDegree;
/// Two corners joined by one chord, as at a blunt trailing edge, lie between calm sides; the chord
/// is this part of those beside it at most, ...
constexpr double kCalmTurn = 3.0 * kOneDegree;
constexpr double kShortBase = 1.0 / 3.0;
/// ... or this part of the whole, and both together turn by `kSharpTurn`.
constexpr double kSmallBase = 0.02;
/// Two points that lie off by eps each turn their chord of length L by up to 2 eps/L, two such
/// chords meet under an angle that is wrong by 4 eps/L: chords of 24 eps over the angle that is
/// looked for keep that error to a sixth of it.
constexpr double kChordsPerNoise = 24.0;
/// Angle looked for, in multiples of the wanted one: sharp corners show at shorter chords.
constexpr std::array<double, 3> kAngleSteps{4.0, 2.0, 1.0};
/// Turn that the rounding of doubles gives points in line at usual spacings, rad.
constexpr double kRoundingTurn = 1e-6;
/// Chords of a drawn arc, as CAD systems give it in points, are equal but for this part, and so are
/// the turns between them: so many in a row are no accident.
constexpr double kEvenly = 0.01;
constexpr std::size_t kEvenChords = 4;
/// A chord so many times as long as theirs is an edge: on a curve that goes on, whoever put points
/// so close together would have put some there, too, ...
constexpr double kEdgeChord = 8.0;
/// ... when it turns by so much there.
constexpr double kEdgeTurn = 45.0 * kOneDegree;
/// Points that are looked at one by one before the step doubles.
constexpr std::size_t kFineSteps = 32;
constexpr std::size_t kArmChords = 4;

/// The series from one point outwards, in chords that the noise does not turn noticeably.
struct Arm {
  std::array<double, kArmChords> length{};
  std::array<double, kArmChords - 1> turn{};  ///< at the far end of each chord, left positive
  std::size_t chords = 0;
  std::size_t reach = 0;  ///< points passed by the first chord
  Vec2 first;             ///< first chord, outwards

  [[nodiscard]] bool has_turn(std::size_t k) const { return k + 1 < chords; }
};

/// What a smooth continuation of an arm does at the point.
struct Forecast {
  double turn = 0.0;     ///< foretold, left positive
  double spacing = 1.0;  ///< first chord relative to those behind it
  double unrest = 0.0;   ///< largest turn near the point
  double shortest = 0.0;
};

struct Candidate {
  std::size_t index = 0;
  double step = 0.0;  ///< of kAngleSteps
  double turn = 0.0;
  double reach = 0.0;  ///< length within which it stands for all corners
  Vec2 outwards;       ///< between both chords, away from them
};

class CornerSearch {
 public:
  CornerSearch(const std::vector<Vec2>& points, const std::vector<double>& tolerance, bool closed,
               const CornerConstraints& constraints)
      : points_(points),
        tolerance_(tolerance),
        closed_(closed),
        angle_(constraints.angle),
        exact_(constraints.exact),
        rough_(std::max(kRoughTurn, 0.5 * angle_)),
        size_(bounding_diagonal(points)) {}

  [[nodiscard]] std::vector<Candidate> candidates() const;

 private:
  [[nodiscard]] double noise_at(std::size_t i) const;
  /// Index `steps` points away, forwards or backwards.
  [[nodiscard]] std::optional<std::size_t> at(std::size_t i, std::size_t steps,
                                              bool forwards) const;
  [[nodiscard]] Arm arm(std::size_t i, bool forwards, double chord, std::size_t chords) const;
  [[nodiscard]] bool is_corner(std::size_t i, double turn, double noise, double chord) const;
  [[nodiscard]] bool ends_arc_at_edge(std::size_t i) const;
  [[nodiscard]] bool turns_here(std::size_t i) const;
  [[nodiscard]] bool is_base(const Arm& beside, const Arm& other, double total) const;
  [[nodiscard]] static bool is_edge(const Arm& beside, const Arm& other, double turn);
  [[nodiscard]] std::optional<Forecast> forecast(const Arm& arm, std::size_t skip) const;
  [[nodiscard]] bool is_bent(std::size_t i, bool forwards, const Arm& arm, double noise) const;

  const std::vector<Vec2>& points_;
  const std::vector<double>& tolerance_;
  bool closed_;
  double angle_;
  bool exact_;
  double rough_;
  double size_;
};

double CornerSearch::noise_at(std::size_t i) const {
  if (tolerance_.empty()) return 0.0;
  const std::size_t n = points_.size();
  return std::max({tolerance_[(i + n - 1) % n], tolerance_[i], tolerance_[(i + 1) % n]});
}

std::optional<std::size_t> CornerSearch::at(std::size_t i, std::size_t steps, bool forwards) const {
  const std::size_t n = points_.size();
  if (closed_) {
    if (steps >= n) return std::nullopt;
    return forwards ? (i + steps) % n : (i + n - steps) % n;
  }
  if (forwards) return i + steps < n ? std::optional(i + steps) : std::nullopt;
  return steps <= i ? std::optional(i - steps) : std::nullopt;
}

Arm CornerSearch::arm(std::size_t i, bool forwards, double chord, std::size_t chords) const {
  Arm arm;
  Vec2 from = points_[i], before;
  std::size_t steps = 0;
  while (arm.chords < chords) {
    std::size_t stride = 1, looked = 0;
    std::size_t reached = i;
    Vec2 step;
    for (;;) {
      if (looked++ == kFineSteps) {
        stride *= 2;
        looked = 1;
      }
      steps += stride;
      const auto next = at(i, steps, forwards);
      if (!next) return arm;
      reached = *next;
      step = points_[reached] - from;
      if (norm(step) >= chord) break;
    }
    const std::size_t k = arm.chords++;
    arm.length[k] = norm(step);
    // Backwards the same bend is passed the other way round.
    if (k > 0) arm.turn[k - 1] = forwards ? turning(before, step) : turning(step, before);
    if (k == 0) {
      arm.reach = steps;
      arm.first = step;
    }
    before = step;
    from = points_[reached];
  }
  return arm;
}

/// Circle through the last three points, its curvature growing on as it has grown so far.
std::optional<Forecast> CornerSearch::forecast(const Arm& arm, std::size_t skip) const {
  if (!arm.has_turn(skip)) return std::nullopt;
  const double h0 = arm.length[skip], h1 = arm.length[skip + 1], turn = arm.turn[skip];
  Forecast result{turn * h0 / (h0 + h1), 1.0, std::abs(turn), std::min(h0, h1)};
  double far = h1;
  if (arm.has_turn(skip + 1)) {
    const double h2 = arm.length[skip + 2], outer = std::abs(arm.turn[skip + 1]);
    const double here = std::abs(turn) / (h0 + h1), there = outer / (h1 + h2);
    result.turn *= std::clamp(there > 0.0 ? here / there : kLargestGrowth, 1.0, kLargestGrowth);
    result.unrest = std::max(result.unrest, outer);
    if (outer < 2.0 * rough_) far = std::max(far, h2);  // behind a corner other spacings hold
  }
  result.spacing = h0 / far;
  return result;
}

/// Whether the first chord of `beside` is the base of a blunt end, with a corner at either end.
bool CornerSearch::is_base(const Arm& beside, const Arm& other, double total) const {
  const double base = beside.length[0];
  const double unrest = std::max(std::abs(beside.turn[1]), std::abs(other.turn[0]));
  if (unrest > kCalmTurn) return false;  // the tip of a smooth shape between two points
  if (base <= kShortBase * std::min(beside.length[1], other.length[0])) return true;
  return total >= kSharpTurn && base <= kSmallBase * size_;
}

/// Whether the first chord of `beside` is an edge between two calm sides, with a corner at either
/// end that a bend which goes on along the edge does not explain.
bool CornerSearch::is_edge(const Arm& beside, const Arm& other, double turn) {
  if (std::max(std::abs(beside.turn[1]), std::abs(other.turn[0])) > kCalmTurn) return false;
  const double edge = beside.length[0];
  if (edge * kShortBase < std::max(beside.length[1], other.length[0])) return false;
  const double here = std::abs(other.turn[0]) / (other.length[0] + other.length[1]);
  const double there = std::abs(beside.turn[1]) / (beside.length[1] + beside.length[2]);
  const double foretold = edge * std::max(here, there);  // half of the turn along it, at either end
  return std::min(std::abs(turn), std::abs(beside.turn[0])) >=
         kEdgeTurn + kExplainFactor * foretold;
}

/// Whether points passed by the first chord lie off it by more than noise and its own bend: a round
/// corner that the long chord cuts off.
bool CornerSearch::is_bent(std::size_t i, bool forwards, const Arm& arm, double noise) const {
  const double length = arm.length[0];
  const double allowed = 2.0 * noise + 0.25 * length * std::abs(arm.turn[0]);
  const std::size_t stride = arm.reach / kFineSteps + 1;
  for (std::size_t steps = stride; steps < arm.reach; steps += stride) {
    const auto j = at(i, steps, forwards);
    if (j && std::abs(cross(arm.first, points_[*j] - points_[i])) > allowed * length) return true;
  }
  return false;
}

/// Curvature of the circle through three points, by the turn between both chords.
double bend(double turn, double before, double after) {
  const double across =
      std::sqrt(before * before + after * after + 2.0 * before * after * std::cos(turn));
  return across > 0.0 ? 2.0 * std::sin(turn) / across : std::numeric_limits<double>::infinity();
}

bool CornerSearch::is_corner(std::size_t i, double turn, double noise, double chord) const {
  const std::array<Arm, 2> arms{arm(i, false, chord, kArmChords), arm(i, true, chord, kArmChords)};
  std::array<bool, 2> rough{};
  for (std::size_t side = 0; side < 2; ++side) {
    if (!arms[side].has_turn(0)) return false;
    rough[side] = std::abs(arms[side].turn[0]) >= rough_;
  }
  if (rough[0] && rough[1]) return false;  // no calm side at all: scatter, or a few points
  double total = std::abs(turn), foretold = 0.0, spacing = 1.0, unrest = 0.0;
  double shortest = std::numeric_limits<double>::infinity();
  const double peak = bend(std::abs(turn), arms[0].length[0], arms[1].length[0]);
  for (std::size_t side = 0; side < 2; ++side) {
    const Arm& a = arms[side];
    std::size_t skip = 0;
    if (rough[side]) {
      if (!a.has_turn(1) || std::abs(a.turn[1]) >= rough_) return false;
      const double both = std::abs(turn) + (a.turn[0] * turn > 0.0 ? std::abs(a.turn[0]) : 0.0);
      if (is_base(a, arms[1 - side], both)) {
        skip = 1;
        total = both;
      } else if (is_edge(a, arms[1 - side], turn)) {
        continue;  // straight: it foretells no turn
      }
    }
    const auto expected = forecast(a, skip);
    if (!expected) return false;
    // a spiral bends more on one side and less on the other: at a corner the bend is a peak
    const double beside =
        std::copysign(1.0, turn) * bend(a.turn[skip], a.length[skip], a.length[skip + 1]);
    if (peak <= beside) return false;
    foretold += std::max(0.0, std::copysign(1.0, turn) * expected->turn);
    spacing *= expected->spacing;
    unrest = std::max(unrest, expected->unrest);
    shortest = std::min(shortest, expected->shortest);
  }
  if (std::abs(turn) < angle_ + kExplainFactor * foretold) return false;
  const bool graded = spacing <= kGradedSpacing * kGradedSpacing;
  const bool straight = unrest <= kRoundingTurn + 4.0 * noise / shortest;
  if (graded && !straight && total < kSharpTurn) return false;
  return !is_bent(i, false, arms[0], noise) && !is_bent(i, true, arms[1], noise);
}

/// Whether a drawn arc ends here and an edge begins that goes off at an angle. What the points say
/// elsewhere does not matter: the edge may have another corner at its other end.
bool CornerSearch::ends_arc_at_edge(std::size_t i) const {
  for (const bool forwards : {false, true}) {  // the way in which the arc lies
    const auto beyond = at(i, 1, !forwards), next = at(i, 1, forwards);
    if (!beyond || !next || !at(i, kEvenChords, forwards)) continue;
    const Vec2 edge = points_[*beyond] - points_[i];
    if (norm(edge) < kEdgeChord * norm(points_[*next] - points_[i])) continue;
    const Arm arc = arm(i, forwards, 0.0, kEvenChords);
    const double length = arc.length[0], turn = arc.turn[0];
    bool even = true;
    for (std::size_t k = 1; even && k < kEvenChords; ++k) {
      even = std::abs(arc.length[k] - length) <= kEvenly * length &&
             (k == 1 || std::abs(arc.turn[k - 1] - turn) <= kEvenly * std::abs(turn));
    }
    if (!even || turn == 0.0) continue;
    const double here = forwards ? turning(-edge, arc.first) : turning(-arc.first, edge);
    if (std::abs(here - 0.5 * turn) >= std::max(angle_, kEdgeTurn)) return true;
  }
  return false;
}

/// By the least angle, from the point before to the one behind.
bool CornerSearch::turns_here(std::size_t i) const {
  const auto before = at(i, 1, false), behind = at(i, 1, true);
  return before && behind &&
         std::abs(turning(points_[i] - points_[*before], points_[*behind] - points_[i])) >= angle_;
}

std::vector<Candidate> CornerSearch::candidates() const {
  std::vector<Candidate> found;
  const std::size_t n = points_.size();
  const std::size_t begin = closed_ ? 0 : 1, end = closed_ ? n : n - 1;
  for (std::size_t i = begin; i < end; ++i) {
    if (ends_arc_at_edge(i)) {
      found.push_back({i, kAngleSteps.front(), std::numbers::pi, 0.0, {}});
      continue;
    }
    if (exact_ && !turns_here(i)) continue;
    const double noise = noise_at(i);
    for (const double step : kAngleSteps) {
      // Without noise the next points are near enough whatever the angle.
      const double wanted = angle_ * (noise > 0.0 ? step : 1.0);
      const double chord = kChordsPerNoise * noise / wanted;
      const Arm in = arm(i, false, chord, 1), out = arm(i, true, chord, 1);
      if (in.chords == 0 || out.chords == 0) continue;
      const double turn = turning(-in.first, out.first);
      if (std::abs(turn) < wanted || !is_corner(i, turn, noise, chord)) continue;
      const Vec2 back = (1.0 / norm(in.first)) * in.first + (1.0 / norm(out.first)) * out.first;
      found.push_back({i, step, std::abs(turn), chord, -back});
      break;
    }
  }
  return found;
}

/// Near a tip whose sides nearly lie on each other long chords turn alike wherever they begin: the
/// tip is what lies outermost.
Candidate outermost(const std::vector<Vec2>& points, const std::vector<Candidate>& found,
                    const Candidate& sharpest) {
  if (sharpest.turn < kSharpTurn) return sharpest;
  Candidate best = sharpest;
  for (const Candidate& c : found) {
    const Vec2 away = points[c.index] - points[sharpest.index];
    const bool beside =
        c.step == sharpest.step && c.turn >= kSharpTurn && norm(away) < sharpest.reach;
    if (beside && dot(points[c.index] - points[best.index], sharpest.outwards) > 0.0) best = c;
  }
  return best;
}

/// Of candidates within the noise's reach of each other, the one seen at the shortest chords, and
/// of those the sharpest, stands for all; of those at a tip the outermost.
void keep_sharpest(const std::vector<Vec2>& points, std::vector<Candidate> found,
                   std::vector<Candidate>& kept) {
  std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.step != b.step ? a.step > b.step : a.turn > b.turn;
  });
  std::vector<Candidate> passed = kept;  // and those that another one stands for
  for (const Candidate& c : found) {
    const bool taken = std::any_of(passed.begin(), passed.end(), [&](const Candidate& k) {
      return norm(points[c.index] - points[k.index]) < std::max(c.reach, k.reach);
    });
    if (taken) continue;
    kept.push_back(outermost(points, found, c));
    passed.push_back(c);
    passed.push_back(kept.back());
  }
}

}  // namespace

std::vector<std::size_t> find_corners(const std::vector<Vec2>& points,
                                      const std::vector<double>& tolerance, bool closed,
                                      const std::vector<FixedData>& fixed,
                                      const CornerConstraints& constraints) {
  std::vector<Candidate> kept;
  const std::size_t n = points.size();
  if (n < 3) return {};
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    const bool end = !closed && (i == 0 || i + 1 == n);
    if (fixed[i].corner && !end) kept.push_back({i, 0.0, 0.0, 0.0, {}});
  }
  if (constraints.find) {
    std::vector<Candidate> found =
        CornerSearch(points, tolerance, closed, constraints).candidates();
    const auto marked = [&](const Candidate& c) {
      return std::any_of(kept.begin(), kept.end(),
                         [&](const Candidate& k) { return k.index == c.index; });
    };
    found.erase(std::remove_if(found.begin(), found.end(), marked), found.end());
    keep_sharpest(points, std::move(found), kept);
  }
  std::vector<std::size_t> corners;
  for (const Candidate& c : kept) corners.push_back(c.index);
  std::sort(corners.begin(), corners.end());
  return corners;
}

}  // namespace obvid
