// SPDX-License-Identifier: Apache-2.0
#include "fewest_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "obvid/contour/clothoids.h"
#include "obvid/curve/internal/clothoid.h"
#include "obvid/curve/internal/nearest.h"
#include "obvid/curve/pieces.h"
#include "obvid/geom/internal/angle.h"
#include "small_program.h"

namespace obvid::alignment {
namespace {

constexpr std::size_t kDirections = 12;   ///< in which a polygon is measured, at most
constexpr std::size_t kPolygons = 3;      ///< kept at a place
constexpr std::size_t kPredecessors = 6;  ///< tried for a place
constexpr double kBox =
    1e3;  ///< largest offset and slope, in tolerances and tolerances over length
constexpr double kSameState = 1e-7;  ///< offsets and slopes, likewise, that count as one
/// A clothoid of the search has to be longer than asked for by this part: joints move afterwards.
constexpr double kSpareLength = 1e-3;
constexpr double kFarOff = 0.3;  ///< rad: headings farther from those of the chords make no sense

/// A place of a joint; deviations are measured from its point and heading.
struct Place {
  double at = 0.0;
  Vec2 point;
  double theta = 0.0;
};

/// Offset and slope at a place, in units of the tolerance and of tolerance over `unit`.
struct State {
  double offset = 0.0, slope = 0.0;
};

struct Source {
  std::size_t place = 0, polygon = 0;
};

/// Convex: corners in order, and how one came there.
struct Polygon {
  std::vector<State> corners;
  Source from;
};

double area_of(const std::vector<State>& corners) {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const State a = corners[i], b = corners[(i + 1) % corners.size()];
    sum += a.offset * b.slope - b.offset * a.slope;
  }
  return 0.5 * sum;
}

class Search {
 public:
  Search(const std::vector<Vec2>& points, const std::vector<double>& tolerance,
         const AlignmentOptions& options, const Sought& sought)
      : points_(points), tolerance_(tolerance), options_(options), sought_(sought) {
    set_places();
  }

  Result<std::vector<Node>> run(const RunContext& run) {
    const std::size_t last = places_.size() - 1;
    reached_.resize(places_.size());
    reached_[0].push_back({start_polygon(), {}});
    std::size_t first = 0, end = 1;  // places reached by the last clothoid
    while (end <= last) {
      if (auto on = tell(run, "fewest elements",
                         static_cast<double>(end) / static_cast<double>(last + 1));
          !on) {
        return fail(on.error());
      }
      const auto farthest = advance(first, end, run);
      OBVID_TRY(farthest);
      if (*farthest < end) break;
      first = end;
      end = *farthest + 1;
    }
    if (end <= last || reached_[last].empty()) {
      return error(ErrorCode::kNoSpiral, sought_.plane == Plane::kMap
                                             ? "no elements within the tolerance were found"
                                             : "no grades and vertical curves within the tolerance "
                                               "were found")
          .hint(options_.least_length > 0.0 || options_.least_radius > 0.0
                    ? "allow a larger tolerance, or shorter elements and smaller radii"
                    : "allow a larger tolerance")
          .point(static_cast<std::ptrdiff_t>(places_[std::min(end, last) - 1].at));
    }
    return nodes();
  }

 private:
  void set_places() {
    const std::size_t n = points_.size();
    theta_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t a = i == 0 ? 0 : i - 1, b = std::min(i + 1, n - 1);
      theta_[i] = heading_of(points_[b] - points_[a], i > 0 ? theta_[i - 1] : 0.0);
    }
    if (n > 2) {  // of the circle through three points
      theta_[0] = 2.0 * heading_of(points_[1] - points_[0], theta_[1]) - theta_[1];
      if (sought_.plane == Plane::kMap) theta_[0] = nearest_angle(theta_[0], theta_[1]);
      theta_[n - 1] =
          2.0 * heading_of(points_[n - 1] - points_[n - 2], theta_[n - 2]) - theta_[n - 2];
    }
    for (std::size_t i = 0; i + 1 < n; ++i) {
      places_.push_back({static_cast<double>(i), points_[i], theta_[i]});
      const auto piece =
          piece_between(sought_.plane, points_[i], theta_[i], points_[i + 1], theta_[i + 1]);
      for (std::size_t k = 1; k < options_.divisions && piece; ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(options_.divisions);
        const Tangent at = tangent_of(*piece, part);
        places_.push_back(
            {static_cast<double>(i) + part, at.point, heading_of(at.direction, theta_[i])});
      }
    }
    places_.push_back({static_cast<double>(n - 1), points_[n - 1], theta_[n - 1]});
    along_ = {0.0};
    for (std::size_t k = 1; k < places_.size(); ++k) {
      along_.push_back(along_.back() + distance(places_[k - 1].point, places_[k].point));
    }
    unit_ = 0.0;
    for (std::size_t i = 1; i < n; ++i) unit_ += distance(points_[i - 1], points_[i]);
    unit_ /= static_cast<double>(n - 1);
    eps_ = *std::max_element(tolerance_.begin(), tolerance_.end());
  }

  /// Heading of a vector, next to another one.
  [[nodiscard]] double heading_of(Vec2 v, double beside) const {
    return sought_.plane == Plane::kMap ? nearest_angle(heading(v), beside) : v.y / v.x;
  }

  /// A place on a piece, and how fast it moves on: not its direction alone.
  struct Tangent {
    Vec2 point, direction;
  };
  [[nodiscard]] Tangent tangent_of(const ClothoidPiece& piece, double u) const {
    if (sought_.plane == Plane::kMap) {
      const Jet jet = evaluate(piece, u);
      return {jet.point, jet.d1};
    }
    const Element at =
        element_behind(Plane::kGraph, {piece.start, piece.theta0, piece.kappa0},
                       (piece.kappa1 - piece.kappa0) / piece.length, u * piece.length);
    return {at.point, forward(Plane::kGraph, at.theta)};
  }

  std::vector<State> start_polygon() const {
    const double farthest = sought_.plane == Plane::kMap ? kFarOff : kBox * eps_ / unit_;
    const double e = tolerance_.front() / eps_, s = farthest * unit_ / eps_;
    return {{-e, -s}, {e, -s}, {e, s}, {-e, s}};
  }

  /// What keeps a clothoid from place i to place j within the tolerances of the points between:
  /// rows in the offset and slope at i and at j. Nothing when the nominal one makes no sense.
  const std::vector<HalfSpace>* rows_between(std::size_t i, std::size_t j) {
    if (cached_i_ == i && cached_j_ == j) return valid_ ? &rows_ : nullptr;
    cached_i_ = i;
    cached_j_ = j;
    valid_ = false;
    rows_.clear();
    const Place &a = places_[i], &b = places_[j];
    const auto piece = piece_between(sought_.plane, a.point, a.theta, b.point, b.theta);
    if (!piece) return nullptr;
    const double length = piece->length;
    const auto first = static_cast<std::size_t>(std::ceil(a.at));
    const auto last = static_cast<std::size_t>(std::floor(b.at));
    double at = 0.0;
    for (std::size_t p = first; p <= last; ++p) {
      double offset = 0.0;
      double u = 0.0;
      if (static_cast<double>(p) == a.at) {
        u = 0.0;
      } else if (static_cast<double>(p) == b.at) {
        u = 1.0;
      } else {
        at += p == first ? 0.0 : distance(points_[p - 1], points_[p]) / length;
        if (p == first) at = distance(a.point, points_[p]) / length;
        u = std::clamp(at, 0.0, 1.0);
        for (int step = 0; step < 3; ++step) {
          const Tangent foot = tangent_of(*piece, u);
          const Vec2 away = points_[p] - foot.point;
          if (sought_.plane == Plane::kGraph) {
            offset = away.y;
            break;
          }
          const Vec2 t = foot.direction / norm(foot.direction);
          offset = cross(t, away);
          u = std::clamp(u + dot(t, away) / length, 0.0, 1.0);
        }
        at = u;
        if (!(std::abs(offset) < kBox * eps_)) return nullptr;
      }
      const double v = 1.0 - u;
      const double slope = length / unit_;
      // |offset of the curve - offset of the point| <= tolerance, cubic Hermite
      const Unknowns h = {v * v * (1.0 + 2.0 * u), u * v * v * slope, u * u * (3.0 - 2.0 * u),
                          -u * u * v * slope};
      Unknowns minus = h;
      for (double& x : minus) x = -x;
      rows_.push_back({h, (tolerance_[p] + offset) / eps_});
      rows_.push_back({minus, (tolerance_[p] - offset) / eps_});
    }
    if (options_.least_radius > 0.0) add_curvature_rows(*piece);
    if (sought_.constant) add_constant_rows(*piece);
    valid_ = true;
    return &rows_;
  }

  /// Neither end of the clothoid is sharper than asked for: what its offsets and slopes change of
  /// its curvature is the second derivative of Hermite's cubic.
  void add_curvature_rows(const ClothoidPiece& piece) {
    const double most = 1.0 / options_.least_radius, length = piece.length;
    const double slope = length / unit_, scale = length * length / eps_;
    const std::array<Unknowns, 2> change = {Unknowns{-6.0, -4.0 * slope, 6.0, -2.0 * slope},
                                            Unknowns{6.0, 2.0 * slope, -6.0, 4.0 * slope}};
    const std::array<double, 2> kappa = {piece.kappa0, piece.kappa1};
    for (std::size_t end = 0; end < 2; ++end) {
      Unknowns minus = change[end];
      for (double& x : minus) x = -x;
      rows_.push_back({change[end], (most - kappa[end]) * scale});
      rows_.push_back({minus, (most + kappa[end]) * scale});
    }
  }

  /// The curvature is the same at both ends.
  void add_constant_rows(const ClothoidPiece& piece) {
    const double slope = piece.length / unit_;
    const double change = (piece.kappa1 - piece.kappa0) * piece.length * piece.length / eps_;
    const double size = std::max(2.0, slope);
    const Unknowns row = {2.0 / size, slope / size, -2.0 / size, slope / size};
    Unknowns minus = row;
    for (double& x : minus) x = -x;
    const double wanted = -change / (6.0 * size);
    rows_.push_back({row, wanted + kSameState});
    rows_.push_back({minus, kSameState - wanted});
  }

  /// From one place to a later one: of points as long as their way, of heights along the station.
  [[nodiscard]] double distance(Vec2 from, Vec2 to) const {
    return sought_.plane == Plane::kMap ? norm(to - from) : to.x - from.x;
  }

  /// Whether a clothoid between two places is as long as asked for; one over all points may be
  /// shorter.
  [[nodiscard]] bool is_long_enough(std::size_t i, std::size_t j) const {
    if (options_.least_length == 0.0 || (i == 0 && j + 1 == places_.size())) return true;
    return along_[j] - along_[i] >= (1.0 + kSpareLength) * options_.least_length;
  }

  void add_polygon(const std::vector<State>& corners) {
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const State a = corners[k], b = corners[(k + 1) % corners.size()];
      const double nx = b.slope - a.slope, ny = a.offset - b.offset;
      const double size = std::max(std::abs(nx), std::abs(ny));
      if (size == 0.0) continue;
      program_.add({{nx / size, ny / size, 0.0, 0.0}, (nx * a.offset + ny * a.slope) / size});
    }
  }

  /// Makes the program of the clothoids from there to place j; false: there are none.
  bool set_program(const Source& from, std::size_t j) {
    const auto* between = rows_between(from.place, j);
    if (!between) return false;
    program_.clear();
    program_.add(*between);
    add_polygon(reached_[from.place][from.polygon].corners);
    program_.shuffle();
    return true;
  }

  bool reaches(const Source& from, std::size_t j) {
    return set_program(from, j) && program_.maximum({0.0, 0.0, 1.0, 0.0}, kBox).has_value();
  }

  /// Farthest place that a clothoid from there reaches: what it reaches it passes on the way.
  std::size_t reach_of(const Source& from, std::size_t guess) {
    std::size_t good = from.place, bad = places_.size();
    std::size_t step = std::max<std::size_t>(1, guess > good ? guess - good : 1);
    while (good + 1 < bad) {
      const std::size_t next = std::min(good + step, bad - 1);
      if (reaches(from, next)) {
        good = next;
        if (bad == places_.size()) {
          step = std::max<std::size_t>(1, step / 2 + 1);
          continue;
        }
      } else {
        bad = next;
      }
      step = std::max<std::size_t>(1, (bad - good) / 2);
    }
    return good;
  }

  /// Places behind `end` that one clothoid reaches from one in [first, end); the farthest.
  Result<std::size_t> advance(std::size_t first, std::size_t end, const RunContext& run) {
    struct Reach {
      Source from;
      std::size_t to = 0;
    };
    std::vector<Reach> reaches;
    std::size_t farthest = 0, guess = 0;
    for (std::size_t i = first; i < end; ++i) {
      OBVID_TRY(may_go_on(run));
      for (std::size_t p = 0; p < reached_[i].size(); ++p) {
        const std::size_t to = reach_of({i, p}, guess);
        guess = to;
        if (to >= end) reaches.push_back({{i, p}, to});
        farthest = std::max(farthest, to);
      }
    }
    for (std::size_t j = end; j <= farthest; ++j) {
      OBVID_TRY(may_go_on(run));
      std::vector<Source> from;
      for (const Reach& r : reaches) {
        if (r.to >= j && is_long_enough(r.from.place, j)) from.push_back(r.from);
      }
      const std::size_t stride = std::max<std::size_t>(1, from.size() / kPredecessors);
      std::vector<Polygon> found;
      for (std::size_t k = 0; k < from.size(); k += stride) {
        auto polygon = polygon_at(from[k], j);
        if (polygon) found.push_back(std::move(*polygon));
      }
      std::stable_sort(found.begin(), found.end(), [](const Polygon& a, const Polygon& b) {
        return area_of(a.corners) > area_of(b.corners);
      });
      if (found.size() > kPolygons) found.resize(kPolygons);
      reached_[j] = std::move(found);
    }
    return farthest;
  }

  std::optional<Polygon> polygon_at(const Source& from, std::size_t j) {
    if (!is_long_enough(from.place, j) || !set_program(from, j)) return std::nullopt;
    Polygon out{corners_of_set(2), from};
    // nothing goes on from the last place: there a segment will do
    const bool is_last = j + 1 == places_.size();
    if (out.corners.empty() || (!is_last && !(area_of(out.corners) > 0.0))) return std::nullopt;
    return out;
  }

  /// Corners of what the program leaves of the unknowns `first` and the one behind it, in order
  /// counterclockwise: the farthest along both axes, then those beyond the edges between them.
  /// However thin it is, its width is found that way.
  std::vector<State> corners_of_set(std::size_t first) {
    std::vector<State> out;
    std::size_t looks = 0;
    const auto farthest = [&](double by_offset, double by_slope) -> std::optional<State> {
      Unknowns goal{};
      goal[first] = by_offset;
      goal[first + 1] = by_slope;
      ++looks;
      const auto x = program_.maximum(goal, kBox);
      if (!x) return std::nullopt;
      return State{(*x)[first], (*x)[first + 1]};
    };
    for (const State axis :
         {State{1.0, 0.0}, State{0.0, 1.0}, State{-1.0, 0.0}, State{0.0, -1.0}}) {
      const auto corner = farthest(axis.offset, axis.slope);
      if (!corner) return {};
      if (out.empty() || !(is_same(out.back(), *corner) || is_same(out.front(), *corner))) {
        out.push_back(*corner);
      }
    }
    for (bool found = out.size() > 1; found && looks < kDirections;) {
      found = false;
      for (std::size_t k = 0; k < out.size() && looks < kDirections; ++k) {
        const State a = out[k], b = out[(k + 1) % out.size()];
        const double by_offset = b.slope - a.slope, by_slope = a.offset - b.offset;
        const auto beyond = farthest(by_offset, by_slope);
        if (!beyond || is_same(*beyond, a) || is_same(*beyond, b)) continue;
        const double gain =
            by_offset * (beyond->offset - a.offset) + by_slope * (beyond->slope - a.slope);
        if (!(gain > kSameState * kSameState)) continue;
        out.insert(out.begin() + static_cast<std::ptrdiff_t>(++k), *beyond);
        found = true;
      }
    }
    return out;
  }

  static bool is_same(State a, State b) {
    return std::abs(a.offset - b.offset) + std::abs(a.slope - b.slope) < kSameState;
  }

  static State middle_of(const std::vector<State>& corners) {
    State sum;
    for (const State& s : corners) {
      sum.offset += s.offset / static_cast<double>(corners.size());
      sum.slope += s.slope / static_cast<double>(corners.size());
    }
    return sum;
  }

  [[nodiscard]] Node node_at(std::size_t place, State s) const {
    const Place& p = places_[place];
    return {p.at, p.point + eps_ * s.offset * sideways(sought_.plane, p.theta),
            p.theta + eps_ / unit_ * s.slope};
  }

  Result<std::vector<Node>> nodes() {
    std::size_t place = places_.size() - 1;
    std::size_t polygon = 0;
    State state = middle_of(reached_[place][polygon].corners);
    std::vector<Node> out = {node_at(place, state)};
    while (place > 0) {
      const Source from = reached_[place][polygon].from;
      set_program(from, place);
      for (const int sign : {1, -1}) {  // from there to this very state
        for (std::size_t k = 2; k < kUnknowns; ++k) {
          HalfSpace fixed;
          fixed.a[k] = sign;
          fixed.b = sign * (k == 2 ? state.offset : state.slope) + kSameState;
          program_.add(fixed);
        }
      }
      const std::vector<State> ends = corners_of_set(0);
      place = from.place;
      polygon = from.polygon;
      state = middle_of(ends.empty() ? reached_[place][polygon].corners : ends);
      out.push_back(node_at(place, state));
    }
    std::reverse(out.begin(), out.end());
    return out;
  }

  const std::vector<Vec2>& points_;
  const std::vector<double>& tolerance_;
  const AlignmentOptions& options_;
  const Sought sought_;
  std::vector<double> theta_;
  std::vector<Place> places_;
  std::vector<double> along_;  ///< length of the chords before a place
  double unit_ = 1.0, eps_ = 1.0;
  std::vector<std::vector<Polygon>> reached_;
  std::vector<HalfSpace> rows_;
  SmallProgram program_;
  std::size_t cached_i_ = static_cast<std::size_t>(-1), cached_j_ = 0;
  bool valid_ = false;
};

}  // namespace

std::optional<ClothoidPiece> piece_between(Plane plane, Vec2 start, double theta0, Vec2 end,
                                           double theta1) {
  if (plane == Plane::kMap) return clothoid_between(start, theta0, end, theta1);
  const double length = end.x - start.x;
  if (!(length > 0.0)) return std::nullopt;
  const double slope = (end.y - start.y) / length;
  return ClothoidPiece{start,
                       end,
                       theta0,
                       (6.0 * slope - 4.0 * theta0 - 2.0 * theta1) / length,
                       (2.0 * theta0 + 4.0 * theta1 - 6.0 * slope) / length,
                       length};
}

Result<std::vector<Node>> fewest_pieces(const std::vector<Vec2>& points,
                                        const std::vector<double>& tolerance,
                                        const AlignmentOptions& options, const Sought& sought,
                                        const RunContext& run) {
  return Search(points, tolerance, options, sought).run(run);
}

}  // namespace obvid::alignment
