// SPDX-License-Identifier: Apache-2.0
#include "obvid/series/analysis.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "obvid/core/units.h"
#include "obvid/geom/internal/box.h"
#include "obvid/series/internal/forced_vertices.h"
#include "obvid/series/internal/order.h"

namespace obvid {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;
/// Neighbouring chords that turn by more than this say nothing about the curve between them.
constexpr double kLargestTurning = 170.0 * kOneDegree;
/// Points that a program computed lie on their circle within some four roundings: those of a
/// cosine, of its product with the radius, and of the sum with the centre. Their adjacent
/// curvatures miss it by as many, and a circle through three of them misses the others by four
/// times that (the interpolation factors of a quadratic through uneven points), and by their own.
constexpr double kFewRoundings = 4.0;
constexpr double kStretchRoundings = 20.0;
/// Where so many roundings are more than this, of the chord, coordinates are too coarse to be
/// generous: points stand on their circle as nearly as one rounding lets them.
constexpr double kCoarse = 1e-6;
constexpr double kStretchOfCoarse = 4.0;
/// Roundings by which two points beside a chord can be moved across it, with those of computing.
constexpr double kPointsApart = 16.0;
/// Curves that differ by less than this, of the chord, are told to be one (docs/claims.md).
constexpr double kNothingOpen = 1e-9;

/// Chords of the shortest stretch that a curve of monotone curvature cannot leave.
constexpr std::size_t kFewestThatTell = 3;

/// How far the rounding of its coordinates can have moved a point.
double point_rounding(Vec2 p) { return kUnitRoundoff * (std::abs(p.x) + std::abs(p.y)); }

AdjacentCircle circle_through(Vec2 p, Vec2 q, Vec2 r, double pq, double qr) {
  const Vec2 a = q - p, b = r - q, c = r - p;
  const double pr = norm(c);
  const double k = 2.0 * cross(a, b) / (pq * qr * pr);
  const double ep = point_rounding(p), eq = point_rounding(q), er = point_rounding(r);
  // first-order effect of moving each point across the circle, and along it, and of computing
  const double across = 2.0 * (eq / (pq * qr) + er / (qr * pr) + ep / (pq * pr));
  const double along = std::abs(k) * ((ep + eq) / pq + (eq + er) / qr + (ep + er) / pr);
  const double computing = kUnitRoundoff * (6.0 / pr + 8.0 * std::abs(k));
  return {k, turning(c, b), turning(a, c), across + along + computing};
}

/// Largest distance of the points first..last from the circle (or line) through the first and two
/// others, the middle and the last one unless these close a full turn.
double distance_from_circle(const std::vector<Vec2>& points, std::size_t first, std::size_t last) {
  const Vec2 p = points[first];
  Vec2 q = points[(first + last) / 2], r = points[last];
  const std::size_t third = (last - first) / 3;
  const Vec2 q3 = points[first + third], r3 = points[last - third];
  if (std::abs(cross(q3 - p, r3 - p)) > std::abs(cross(q - p, r - p))) {
    q = q3;
    r = r3;
  }
  const Vec2 a = q - p, c = r - p;
  const double scale = norm(a) * norm(r - q) * norm(c);
  const double kappa = 2.0 * cross(a, r - q) / scale;
  // tangent at p: the chord turned back by the inscribed angle over it; then the power of a point
  const Vec2 tangent = unit_at(heading(a) - turning(c, r - q));
  double worst = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    const Vec2 v = points[i] - p;
    const double miss = cross(tangent, v) - 0.5 * kappa * dot(v, v);
    worst = std::max(worst, std::abs(miss));
  }
  return worst;
}

/// How far three points, a chord apart, may miss a circle that they lie on: in roundings.
struct Generosity {
  double kappa, distance;
};
Generosity generosity(double rounding, double chord) {
  const bool coarse = kStretchRoundings * rounding > kCoarse * chord;
  return coarse ? Generosity{1.0, kStretchOfCoarse} : Generosity{kFewRoundings, kStretchRoundings};
}

/// Longest stretches of at least four points whose adjacent circles agree within rounding.
std::vector<CircularStretch> find_stretches(const std::vector<Vec2>& points,
                                            const std::vector<AdjacentCircle>& circles) {
  const std::size_t n = points.size();
  std::vector<CircularStretch> stretches;
  if (n == 2) return {{0, 1, 0.0}};
  if (n == 3) return {{0, 2, circles[1].kappa}};
  for (std::size_t i = 1; i + 2 < n;) {
    double rounding = std::max(point_rounding(points[i - 1]), point_rounding(points[i]));
    const double chord = std::min(norm(points[i] - points[i - 1]), norm(points[i + 1] - points[i]));
    const Generosity of = generosity(rounding, chord);
    double low = circles[i].kappa - of.kappa * circles[i].rounding;
    double high = circles[i].kappa + of.kappa * circles[i].rounding;
    std::size_t j = i;
    while (j + 2 < n) {
      const AdjacentCircle& next = circles[j + 1];
      const double l = std::max(low, next.kappa - of.kappa * next.rounding);
      const double h = std::min(high, next.kappa + of.kappa * next.rounding);
      if (l > h) break;
      low = l;
      high = h;
      ++j;
    }
    for (std::size_t k = i; k <= j + 1; ++k)
      rounding = std::max(rounding, point_rounding(points[k]));
    // a point has one heading and one curvature: stretches do not share it
    const bool apart = stretches.empty() || i - 1 > stretches.back().last;
    const bool fits =
        apart && j > i && distance_from_circle(points, i - 1, j + 1) <= of.distance * rounding;
    if (fits) {
      const double kappa = low <= 0.0 && high >= 0.0 ? 0.0 : 0.5 * (low + high);
      stretches.push_back({i - 1, j + 1, kappa});
      i = j + 1;
    } else {
      ++i;
    }
  }
  return stretches;
}

std::int8_t sign_of(double value) { return value >= 0.0 ? std::int8_t{1} : std::int8_t{-1}; }

/// The curve must arrive at, and leave, a stretch with the curvature of the stretch. Where rounding
/// hides how that differs from the circle at its end, the adjacent circles have decided.
void direct_beside(const Analysis& a, std::size_t stretch, std::vector<std::int8_t>& direction) {
  const CircularStretch& s = a.stretches[stretch];
  const auto surely = [](const AdjacentCircle& c, double kappa) {
    return std::abs(c.kappa - kappa) > c.rounding;
  };
  const bool touches = stretch > 0 && a.stretches[stretch - 1].last + 1 == s.first;
  if (touches && s.kappa != a.stretches[stretch - 1].kappa) {
    direction[s.first - 1] = sign_of(s.kappa - a.stretches[stretch - 1].kappa);
  } else if (s.first > 0 && surely(a.circles[s.first], s.kappa)) {
    direction[s.first - 1] = sign_of(s.kappa - a.circles[s.first].kappa);
  }
  if (s.last < a.chords.size() && surely(a.circles[s.last], s.kappa)) {
    direction[s.last] = sign_of(a.circles[s.last].kappa - s.kappa);
  }
}

/// Circles that are equal to the last bit, and no stretch: the way of the next chords that have
/// one, or of the curvature beside them.
void direct_equal_circles(const Analysis& a, std::vector<std::int8_t>& direction) {
  std::vector<bool> inside(direction.size(), false);
  for (const CircularStretch& s : a.stretches) {
    std::fill(inside.begin() + static_cast<std::ptrdiff_t>(s.first),
              inside.begin() + static_cast<std::ptrdiff_t>(s.last), true);
  }
  std::int8_t after = 1;
  for (std::size_t i = direction.size(); i-- > 0;) {
    if (inside[i]) {
      const bool beside = i > 0 && !inside[i - 1];
      if (beside) after = sign_of(a.circles[i + 1].kappa - a.circles[i].kappa);
      continue;
    }
    if (direction[i] == 0) direction[i] = after;
    after = direction[i];
  }
}

/// +1, -1 or 0 for every chord, 0 in stretches alone; chords without two circles of their own take
/// the neighbour's.
std::vector<std::int8_t> choose_directions(const Analysis& a) {
  const std::size_t m = a.chords.size();
  std::vector<std::int8_t> direction(m, 0);
  std::int8_t before = 0;
  for (std::size_t i = 1; i + 1 < m; ++i) {
    const double change = a.circles[i + 1].kappa - a.circles[i].kappa;
    direction[i] = change > 0.0 ? std::int8_t{1} : change < 0.0 ? std::int8_t{-1} : before;
    before = direction[i];
  }
  if (m >= 3) {
    direction[0] = direction[1];
    direction[m - 1] = direction[m - 2];
  }
  for (const CircularStretch& s : a.stretches) {
    for (std::size_t i = s.first; i < s.last; ++i) direction[i] = 0;
  }
  for (std::size_t k = 0; k < a.stretches.size(); ++k) direct_beside(a, k, direction);
  direct_equal_circles(a, direction);
  return direction;
}

bool direction_is_certain(const Analysis& a, std::size_t chord) {
  if (chord == 0 || chord + 1 >= a.chords.size()) return false;
  const AdjacentCircle& p = a.circles[chord];
  const AdjacentCircle& q = a.circles[chord + 1];
  return std::abs(q.kappa - p.kappa) > p.rounding + q.rounding;
}

void count_undecided(Analysis& a) {
  for (std::size_t i = 1; i + 1 < a.chords.size(); ++i) {
    if (a.direction[i] == 0 || direction_is_certain(a, i)) continue;
    a.rounding_decided.push_back(i);
  }
}

/// What the adjacent circles say beyond rounding. The first and the last chord have one circle
/// alone: they go with their neighbours.
void compare_circles_along(Analysis& a) {
  const std::size_t m = a.chords.size();
  std::vector<bool> circular(m, false);
  for (const CircularStretch& s : a.stretches) {
    for (std::size_t i = s.first; i < s.last; ++i) circular[i] = true;
  }
  a.change.assign(m, std::nullopt);
  for (std::size_t i = 0; i < m; ++i) {
    if (direction_is_certain(a, i)) {
      a.change[i] = a.circles[i + 1].kappa > a.circles[i].kappa ? 1 : -1;
    } else if (circular[i]) {
      a.change[i] = 0;
    }
  }
  if (m < kFewestThatTell) return;
  if (!a.change.front()) a.change.front() = a.change[1];
  if (!a.change.back()) a.change.back() = a.change[m - 2];
}

void collect_runs(Analysis& a) {
  for (std::size_t i = 0; i < a.change.size(); ++i) {
    const std::optional<int> d = a.change[i];
    if (!a.runs.empty() && (!d || a.runs.back().direction == *d)) {
      a.runs.back().last_chord = i;
    } else if (d) {
      a.runs.push_back({a.runs.empty() ? 0 : i, i, *d});
    }
  }
  int before = 0;
  for (const SeriesRun& run : a.runs) {
    if (run.direction == 0) continue;
    if (before != 0 && run.direction != before) ++a.vertices;
    before = run.direction;
  }
}

/// Changes of sign among the adjacent curvatures whose sign rounding cannot change, at points where
/// the chords turn by less than a right angle: inflections of every curve through the points whose
/// heading keeps within a half turn over any three of them (docs/methods/series.md).
int forced_inflections(const std::vector<Vec2>& points, const Analysis& a) {
  int changes = 0, before = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const AdjacentCircle& c = a.circles[i];
    if (std::abs(c.kappa) <= c.rounding) continue;
    if (!(dot(points[i] - points[i - 1], points[i + 1] - points[i]) > 0.0)) continue;
    const int sign = c.kappa > 0.0 ? 1 : -1;
    if (before != 0 && sign != before) ++changes;
    before = sign;
  }
  return changes;
}

void bound_singular_points(const std::vector<Vec2>& points, Analysis& a) {
  const std::size_t n = a.circles.size();
  if (n < 4) return;
  a.vertices_lower_bound = forced_vertices(points, {}, false);
  // wide windows may show what rounding hides between neighbours
  a.vertices = std::max(a.vertices, a.vertices_lower_bound);
  a.inflections_lower_bound = forced_inflections(points, a);
  int before = 0;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double k = a.circles[i].kappa;
    if (std::abs(k) <= a.circles[i].rounding) continue;
    const int s = k > 0.0 ? 1 : -1;
    if (before != 0 && s != before) ++a.inflections;
    before = s;
  }
}

/// Whether rounding of the points turns curves through them by so little that points of one circle
/// leave nothing open on this chord: close neighbours far from the origin leave much.
bool tells_circle(const std::vector<Vec2>& points, const Analysis& a, std::size_t chord) {
  const double sag_before = std::tan(0.5 * a.circles[chord].eta_out);
  const double sag_after = std::tan(0.5 * a.circles[chord + 1].eta_in);
  const double shortest =
      std::min({a.chords[chord - 1].length, a.chords[chord].length, a.chords[chord + 1].length});
  double rounding = 0.0;
  for (std::size_t k = chord - 1; k <= chord + 2; ++k) {
    rounding = std::max(rounding, point_rounding(points[k]));
  }
  const double turned =
      (2.0 + sag_before * sag_before + sag_after * sag_after) * kPointsApart * rounding / shortest;
  return turned <= kNothingOpen;
}

void bound_error(const std::vector<Vec2>& points, Analysis& a) {
  a.points_only_error.assign(a.chords.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 1; i + 1 < a.chords.size(); ++i) {
    // both circles reach over three points: they bound a curve that is monotone over three chords
    const int d = a.change[i].value_or(0);
    const auto against = [d](const std::optional<int>& beside) {
      return d * beside.value_or(0) < 0;
    };
    if (against(a.change[i - 1]) || against(a.change[i + 1])) continue;
    a.points_only_error[i] = four_point_error(a, i);
  }
  for (const CircularStretch& s : a.stretches) {
    // two or three points lie on a circle whatever the curve; four say that it is the curve
    if (s.last - s.first < kFewestThatTell) continue;
    for (std::size_t i = s.first; i < s.last; ++i) {
      // beside the ends the nearest four points of the circle tell
      const std::size_t inner = std::clamp(i, s.first + 1, s.last - 2);
      if (tells_circle(points, a, inner)) a.points_only_error[i] = 0.0;
    }
  }
}

Result<void> check_turning(const Analysis& a, const std::vector<Vec2>& points) {
  if (a.largest_turning < kLargestTurning) return {};
  for (std::size_t i = 1; i < a.chords.size(); ++i) {
    const double turn = std::abs(a.chords[i].omega - a.chords[i - 1].omega);
    if (turn < kLargestTurning) continue;
    return error(ErrorCode::kChordReversal, "the series turns back on itself")
        .where("point " + std::to_string(i + 1))
        .hint(no_order_hint(points).value_or(
            "add points around the bend, or remove the point that steps back"))
        .point(i)
        .value(turn);
  }
  return {};
}

Result<Analysis> measured_chords(const std::vector<Vec2>& points) {
  if (points.size() < 2) {
    return error(ErrorCode::kTooFewPoints, "a contour needs at least two distinct points")
        .value(static_cast<double>(points.size()));
  }
  Analysis a;
  a.size = bounding_diagonal(points);
  if (!(a.size >= kSmallestSeries && a.size <= kLargestSeries)) {
    return error(ErrorCode::kSizeOutOfRange, "the size of the series is outside 1e-100 to 1e100")
        .hint("choose another unit")
        .value(a.size);
  }
  a.chords = measure_chords(points);
  for (std::size_t i = 1; i < a.chords.size(); ++i) {
    a.largest_turning =
        std::max(a.largest_turning, std::abs(a.chords[i].omega - a.chords[i - 1].omega));
  }
  return a;
}

Analysis measured_circles(const std::vector<Vec2>& points, Analysis a) {
  a.circles = measure_circles(points, a.chords);
  a.stretches = find_stretches(points, a.circles);
  a.direction = choose_directions(a);
  count_undecided(a);
  compare_circles_along(a);
  collect_runs(a);
  bound_singular_points(points, a);
  bound_error(points, a);
  return a;
}

}  // namespace

double four_point_error(const Analysis& a, std::size_t chord) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  /// Rounding of an inscribed angle from two rounded differences, rad, and of what follows.
  constexpr double kAngle = 16.0 * kUnitRoundoff;
  if (chord == 0 || chord + 1 >= a.chords.size()) return kNone;
  const AdjacentCircle &before = a.circles[chord], &after = a.circles[chord + 1];
  // whatever turns by less than half a turn through four points turns no less than their chords do
  const double turn =
      std::abs(before.eta_in + before.eta_out) + std::abs(after.eta_in + after.eta_out);
  if (!(turn < std::numbers::pi)) return kNone;
  const double sag_before = std::tan(0.5 * before.eta_out);
  const double sag_after = std::tan(0.5 * after.eta_in);
  const double rounding = kAngle * (1.0 + 0.5 * (sag_before * sag_before + sag_after * sag_after));
  return 0.5 * a.chords[chord].length * (std::abs(sag_after - sag_before) + rounding);
}

std::vector<Chord> measure_chords(const std::vector<Vec2>& points) {
  std::vector<Chord> chords(points.size() - 1);
  Vec2 before{};
  for (std::size_t i = 0; i < chords.size(); ++i) {
    const Vec2 e = points[i + 1] - points[i];
    const double principal = heading(e);
    double omega = principal;
    if (i > 0) {
      const double expected = chords[i - 1].omega + turning(before, e);
      const double turns = std::round((expected - principal) / (kFullTurn));
      omega = principal + turns * kFullTurn;
    }
    chords[i] = {norm(e), omega};
    before = e;
  }
  return chords;
}

std::vector<AdjacentCircle> measure_circles(const std::vector<Vec2>& points,
                                            const std::vector<Chord>& chords) {
  const std::size_t n = points.size();
  std::vector<AdjacentCircle> circles(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    circles[i] = circle_through(points[i - 1], points[i], points[i + 1], chords[i - 1].length,
                                chords[i].length);
  }
  if (n < 3) return circles;
  circles[0] = circles[1];
  circles[0].eta_out = circles[0].eta_in;  // the same chord of the same circle
  circles[n - 1] = circles[n - 2];
  circles[n - 1].eta_in = circles[n - 1].eta_out;
  return circles;
}

double bounding_diagonal(const std::vector<Vec2>& points) {
  if (points.empty()) return 0.0;
  Box2 box;
  for (const Vec2 p : points) box.add(p);
  return std::hypot(box.high.x - box.low.x, box.high.y - box.low.y);
}

double sagitta(double kappa, double h) {
  const double x = 0.5 * kappa * h;
  return 0.5 * x * h / (1.0 + std::sqrt(std::max(0.0, 1.0 - x * x)));
}

Result<Analysis> measure_series(const std::vector<Vec2>& points) {
  auto begun = measured_chords(points);
  if (!begun) return begun;
  return measured_circles(points, std::move(*begun));
}

Result<Analysis> analyse(const std::vector<Vec2>& points) {
  auto begun = measured_chords(points);
  if (!begun) return begun;
  OBVID_TRY(check_turning(*begun, points));
  return measured_circles(points, std::move(*begun));
}

double turning_at(const Analysis& analysis, std::size_t point) {
  if (point == 0 || point >= analysis.chords.size())
    return std::numeric_limits<double>::quiet_NaN();
  return analysis.chords[point].omega - analysis.chords[point - 1].omega;
}

}  // namespace obvid
