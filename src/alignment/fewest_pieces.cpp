// SPDX-License-Identifier: Apache-2.0
#include "fewest_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "obvid/contour/clothoids.h"
#include "obvid/curve/internal/clothoid.h"
#include "obvid/curve/internal/nearest.h"
#include "obvid/curve/pieces.h"
#include "obvid/geom/internal/angle.h"
#include "small_program.h"
#include "winding.h"

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
/// Of the way to the joints beside a corner: what rounds it takes no more on either side.
constexpr double kRounded = 0.4;
constexpr int kHalvings = 12;  ///< of that way, until what rounds a corner passes the points

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

/// How one comes from a place to another.
enum class Way {
  kElement,
  kCorner,    ///< from a point to the next one by two grades that meet between them, below ...
  kCornerUp,  ///< ... or above
};

/// Convex: corners in order, and how one came there.
struct Polygon {
  std::vector<State> corners;
  Source from;
  Way way = Way::kElement;
};

/// What as many elements lead to.
struct Layer {
  std::vector<Source> sources;
  std::size_t end = 0;  ///< places before this one are reached
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
         const AlignmentOptions& options, const Sought& sought, const RunContext& run)
      : run_(run),
        points_(points),
        tolerance_(tolerance),
        options_(options),
        sought_(sought),
        borne_(grades_borne_by(points, tolerance, sought)) {
    const PointRow row{points, tolerance};
    for (std::size_t i = 0; i < row.intervals() && sought.plane == Plane::kMap; ++i) {
      passages_.push_back(passage_of(row, i));
    }
    set_places();
  }

  Result<std::vector<Node>> run() {
    const std::size_t last = places_.size() - 1;
    reached_.resize(places_.size());
    reached_[0].push_back({start_polygon(), {}});
    Layer layer{{{0, 0}}, 1};
    while (layer.end <= last) {
      if (auto on = tell(run_, "fewest elements",
                         static_cast<double>(layer.end) / static_cast<double>(last + 1));
          !on) {
        return fail(on.error());
      }
      auto next = advance(layer);
      OBVID_TRY(next);
      layer = std::move(*next);
      if (layer.sources.empty()) break;
    }
    const auto goal = std::find_if(layer.sources.begin(), layer.sources.end(),
                                   [&](const Source& s) { return s.place == last; });
    if (goal == layer.sources.end()) {
      return error(ErrorCode::kNoSpiral, sought_.plane == Plane::kMap
                                             ? "no elements within the tolerance were found"
                                             : "no grades and vertical curves within the tolerance "
                                               "were found")
          .hint(advice_to_allow_more(options_))
          .point(static_cast<std::ptrdiff_t>(places_[std::min(layer.end, last) - 1].at));
    }
    return nodes(*goal);
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
    if (sought_.plane == Plane::kMap) allow_headings();
    for (std::size_t i = 0; i + 1 < n; ++i) {
      place_of_.push_back(places_.size());
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
    place_of_.push_back(places_.size());
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

  /// Where a long chord and a short one meet in a sharp turn, the direction from end to end goes
  /// back along the short one: headings are moved to where both chords allow them.
  void allow_headings() {
    for (std::size_t i = 0; i < theta_.size(); ++i) {
      for (const std::size_t k : {i, i + 1}) {  // the interval behind the point, and before it
        if (k == 0 || k > passages_.size() || passages_[k - 1].any) continue;
        const double middle = nearest_angle(passages_[k - 1].heading, theta_[i]);
        const double most = std::min(passages_[k - 1].most, 0.5 * std::numbers::pi);
        theta_[i] = std::clamp(theta_[i], middle - most, middle + most);
      }
    }
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
    ValueRange slopes{-s, s};
    if (sought_.corners) slopes = common(slopes, borne_slopes(0));
    return {{-e, slopes.low}, {e, slopes.low}, {e, slopes.high}, {-e, slopes.high}};
  }

  /// Slopes at a place that the heights bear.
  [[nodiscard]] ValueRange borne_slopes(std::size_t place) const {
    const Place& at = places_[place];
    const ValueRange grades = borne_.at(at.point.x);
    return {(grades.low - at.theta) * unit_ / eps_, (grades.high - at.theta) * unit_ / eps_};
  }

  /// Without them what passes a corner swings beyond it, where a few tolerances are room for that.
  void add_borne_slopes(std::size_t place) {
    const ValueRange slopes = borne_slopes(place);
    const double size = std::max({1.0, std::abs(slopes.low), std::abs(slopes.high)});
    rows_.push_back({{0.0, 0.0, 0.0, 1.0 / size}, slopes.high / size});
    rows_.push_back({{0.0, 0.0, 0.0, -1.0 / size}, -slopes.low / size});
  }

  /// Two grades that meet between points i and j = i + 1: rows in their heights and slopes there.
  void set_rows_of_corner(std::size_t i, std::size_t j, Way way) {
    cached_i_ = static_cast<std::size_t>(-1);
    rows_.clear();
    const Place &a = places_[i], &b = places_[j];
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      const Place& at = side == 0 ? a : b;
      const double most = tolerance_[static_cast<std::size_t>(at.at)] / eps_;
      for (const double sign : {1.0, -1.0}) {
        HalfSpace row;
        row.a[2 * side] = sign;
        row.b = most;
        rows_.push_back(row);
      }
    }
    const double length = b.point.x - a.point.x, slope = length / unit_;
    const double size = std::max(1.0, slope), below = way == Way::kCorner ? 1.0 : -1.0;
    // in a valley the first grade is the higher one at its own point, the second one at its
    const double rise = b.point.y - a.point.y;
    rows_.push_back({{-below / size, 0.0, below / size, -below * slope / size},
                     below * (length * b.theta - rise) / (eps_ * size)});
    rows_.push_back({{below / size, below * slope / size, -below / size, 0.0},
                     below * (rise - length * a.theta) / (eps_ * size)});
    add_borne_slopes(j);
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
    std::vector<double> feet;  // of these points, of the length
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
      feet.push_back(u);
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
    if (sought_.corners) add_borne_slopes(j);
    if (sought_.plane == Plane::kMap) {
      if (b.at > std::floor(a.at) + 1.0 && nominal_winds(*piece, a.at, b.at, feet)) return nullptr;
      add_heading_rows(j);
    }
    valid_ = true;
    return &rows_;
  }

  /// Whether the nominal clothoid turns between neighbouring points as no curve through them has
  /// to.
  [[nodiscard]] bool nominal_winds(const ClothoidPiece& piece, double from, double to,
                                   const std::vector<double>& feet) const {
    const auto winds = [&](std::size_t interval, double u0, double u1) {
      const HeadingRange headings =
          headings_along(piece.theta0, piece.kappa0, piece.kappa1, piece.length, u0 * piece.length,
                         u1 * piece.length);
      return !allows(passages_[interval], headings);
    };
    const auto first = static_cast<std::size_t>(std::ceil(from));
    double before = 0.0;
    for (std::size_t k = 0; k < feet.size(); ++k) {
      const double u = std::max(before, feet[k]);
      if (first + k > 0 && u > 0.0 && winds(first + k - 1, before, u)) return true;
      before = u;
    }
    const auto last = static_cast<std::size_t>(std::floor(to));
    return last + 1 < points_.size() && before < 1.0 && winds(last, before, 1.0);
  }

  /// The heading at a place is none that goes back along the chords beside it.
  void add_heading_rows(std::size_t place) {
    const Place& at = places_[place];
    const auto next = static_cast<std::size_t>(std::ceil(at.at));
    const auto before = static_cast<std::size_t>(std::floor(at.at));
    if (next > 0) add_heading_rows(at, next - 1);
    if (before + 1 < points_.size() && (next == 0 || before != next - 1)) {
      add_heading_rows(at, before);
    }
  }

  void add_heading_rows(const Place& at, std::size_t interval) {
    const Passage& passage = passages_[interval];
    if (passage.any) return;
    const double middle = nearest_angle(passage.heading, at.theta) - at.theta;
    const double most = passage.most;
    const double size = unit_ / eps_, scale = std::max(1.0, (most + std::abs(middle)) * size);
    rows_.push_back({{0.0, 0.0, 0.0, 1.0 / scale}, (middle + most) * size / scale});
    rows_.push_back({{0.0, 0.0, 0.0, -1.0 / scale}, (most - middle) * size / scale});
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
  bool set_program(const Source& from, std::size_t j, Way way = Way::kElement) {
    if (way == Way::kElement) {
      if (rows_between(from.place, j) == nullptr) return false;
    } else {
      set_rows_of_corner(from.place, j, way);
    }
    program_.clear();
    program_.add(rows_);
    add_polygon(reached_[from.place][from.polygon].corners);
    program_.shuffle();
    return true;
  }

  bool reaches(const Source& from, std::size_t j) {
    return set_program(from, j) && program_.maximum({0.0, 0.0, 1.0, 0.0}, kBox).has_value();
  }

  /// Farthest place that a clothoid from there reaches: what it reaches it passes on the way.
  Result<std::size_t> reach_of(const Source& from, std::size_t guess) {
    std::size_t good = from.place, bad = places_.size();
    std::size_t step = std::max<std::size_t>(1, guess > good ? guess - good : 1);
    while (good + 1 < bad) {
      OBVID_TRY(may_go_on(run_));
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

  struct Reach {
    Source from;
    std::size_t to = 0;
  };

  /// Places behind those of a layer that one clothoid reaches from there, and corners beside them.
  Result<Layer> advance(const Layer& layer) {
    std::vector<Reach> reaches;
    std::size_t farthest = 0, guess = 0;
    for (const Source& from : layer.sources) {
      const auto to = reach_of(from, guess);
      OBVID_TRY(to);
      guess = *to;
      if (*to >= layer.end) reaches.push_back({from, *to});
      farthest = std::max(farthest, *to);
    }
    Layer out;
    out.end = std::max(layer.end, farthest + 1);
    for (std::size_t j = layer.end; j <= farthest; ++j) {
      std::vector<Polygon> found;
      for (const bool behind_corner : {false, true}) {
        OBVID_TRY(add_elements(reaches, j, behind_corner, found));
      }
      std::stable_sort(found.begin(), found.end(), [](const Polygon& a, const Polygon& b) {
        return area_of(a.corners) > area_of(b.corners);
      });
      if (found.size() > kPolygons) found.resize(kPolygons);
      for (Polygon& polygon : found) keep(j, std::move(polygon), out);
    }
    if (sought_.corners) OBVID_TRY(add_corners(layer, out));
    return out;
  }

  void keep(std::size_t place, Polygon polygon, Layer& layer) {
    layer.sources.push_back({place, reached_[place].size()});
    reached_[place].push_back(std::move(polygon));
  }

  [[nodiscard]] const Polygon& polygon_of(const Source& source) const {
    return reached_[source.place][source.polygon];
  }

  /// What elements from some of the places lead to at place j.
  Result<void> add_elements(const std::vector<Reach>& reaches, std::size_t j, bool behind_corner,
                            std::vector<Polygon>& found) {
    std::vector<Source> from;
    for (const Reach& r : reaches) {
      if ((polygon_of(r.from).way != Way::kElement) != behind_corner) continue;
      if (r.to >= j && is_long_enough(r.from.place, j)) from.push_back(r.from);
    }
    const std::size_t stride = std::max<std::size_t>(1, from.size() / kPredecessors);
    for (std::size_t k = 0; k < from.size(); k += stride) {
      OBVID_TRY(may_go_on(run_));
      auto polygon = polygon_at(from[k], j);
      if (polygon) found.push_back(std::move(*polygon));
    }
    return {};
  }

  /// Corners behind elements of a layer: to the next point, which is behind none of its own. The
  /// widest above and below. None at the ends: there a grade more would say nothing.
  Result<void> add_corners(const Layer& layer, Layer& next) {
    for (auto from = layer.sources.begin(); from != layer.sources.end();) {
      OBVID_TRY(may_go_on(run_));
      const std::size_t place = from->place;
      const auto point = static_cast<std::size_t>(places_[place].at);
      std::array<std::optional<Polygon>, 2> widest;
      for (; from != layer.sources.end() && from->place == place; ++from) {
        const bool inside = place > 0 && point + 2 < points_.size() && place_of_[point] == place;
        if (!inside || polygon_of(*from).way != Way::kElement) continue;
        for (std::size_t k = 0; k < widest.size(); ++k) {
          const Way way = k == 0 ? Way::kCorner : Way::kCornerUp;
          auto found = polygon_at(*from, place_of_[point + 1], way);
          if (!found) continue;
          if (!widest[k] || area_of(found->corners) > area_of(widest[k]->corners)) {
            widest[k] = std::move(found);
          }
        }
      }
      for (auto& one : widest) {
        if (one) keep(place_of_[point + 1], std::move(*one), next);
      }
    }
    return {};
  }

  std::optional<Polygon> polygon_at(const Source& from, std::size_t j, Way way = Way::kElement) {
    if (way == Way::kElement && !is_long_enough(from.place, j)) return std::nullopt;
    if (!set_program(from, j, way)) return std::nullopt;
    Polygon out{corners_of_set(2), from, way};
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

  std::vector<Node> nodes(const Source& goal) {
    std::size_t place = goal.place;
    std::size_t polygon = goal.polygon;
    State state = middle_of(reached_[place][polygon].corners);
    std::vector<Node> out = {node_at(place, state)};
    std::vector<std::size_t> corners;  // nodes, from the end on, behind a corner
    while (place > 0) {
      const Source from = reached_[place][polygon].from;
      const Way way = reached_[place][polygon].way;
      if (way != Way::kElement) corners.push_back(out.size() - 1);
      set_program(from, place, way);
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
    const std::vector<Node> sharp = out;
    for (const std::size_t k : corners) round_corner(sharp, out.size() - 2 - k, out);
    return out;
  }

  /// Rounds the corner between the grades of nodes k and k + 1, of those as they were, by a
  /// parabola that passes the points.
  void round_corner(const std::vector<Node>& sharp, std::size_t k, std::vector<Node>& out) const {
    const Node &a = sharp[k], &b = sharp[k + 1];
    const double bend = b.theta - a.theta;
    const double length = b.point.x - a.point.x;
    const double from_a = (b.theta * length - (b.point.y - a.point.y)) / bend;
    const double x = a.point.x + (bend == 0.0 ? 0.5 * length : std::clamp(from_a, 0.0, length));
    const Vec2 corner{x, a.point.y + a.theta * (x - a.point.x)};
    double half = kRounded * std::min(x - sharp[k - 1].point.x, sharp[k + 2].point.x - x);
    for (int i = 0; i < kHalvings && !passes(corner, a.theta, b.theta, half); ++i) half *= 0.5;
    half = std::max(half, (0.5 + kSpareLength) * options_.least_length);
    const auto node = [&](double way, double theta) {
      const Vec2 at = corner + way * Vec2{1.0, theta};
      return Node{place_at(at.x), at, theta};
    };
    out[k] = node(-half, a.theta);
    out[k + 1] = node(half, b.theta);
  }

  /// Whether the parabola that leaves grade `theta0` by `half` before a corner passes the points.
  [[nodiscard]] bool passes(Vec2 corner, double theta0, double theta1, double half) const {
    const auto before = [](const Vec2& p, double x) { return p.x < x; };
    auto p = std::lower_bound(points_.begin(), points_.end(), corner.x - half, before);
    for (; p != points_.end() && p->x <= corner.x + half; ++p) {
      const double way = p->x - corner.x, along = half + way;
      const double height =
          corner.y + theta0 * way + (theta1 - theta0) * along * along / (4.0 * half);
      if (std::abs(p->y - height) > tolerance_[static_cast<std::size_t>(p - points_.begin())]) {
        return false;
      }
    }
    return true;
  }

  /// The place at a station, in intervals of the points.
  [[nodiscard]] double place_at(double station) const {
    const auto behind = std::upper_bound(points_.begin() + 1, points_.end() - 1, station,
                                         [](double x, const Vec2& p) { return x < p.x; });
    const Vec2 a = *std::prev(behind), b = *behind;
    return static_cast<double>(behind - points_.begin() - 1) + (station - a.x) / (b.x - a.x);
  }

  const RunContext& run_;
  const std::vector<Vec2>& points_;
  const std::vector<double>& tolerance_;
  const AlignmentOptions& options_;
  const Sought sought_;
  const BorneGrades borne_;
  std::vector<double> theta_;
  std::vector<Place> places_;
  std::vector<std::size_t> place_of_;  ///< each point
  std::vector<double> along_;          ///< length of the chords before a place
  std::vector<Passage> passages_;      ///< between points, on a map
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

std::string advice_to_allow_more(const AlignmentOptions& options) {
  std::string out = "allow a larger tolerance";
  if (options.least_length > 0.0) out += ", or shorter elements";
  if (options.least_radius > 0.0) out += ", or smaller radii";
  return out;
}

BorneGrades grades_borne_by(std::vector<Vec2> points, std::vector<double> tolerance,
                            const Sought& sought) {
  if (sought.lap.x > 0.0) {
    points.pop_back();
    tolerance.pop_back();
  }
  return {std::move(points), std::move(tolerance), sought.lap.x};
}

Result<std::vector<Node>> fewest_pieces(const std::vector<Vec2>& points,
                                        const std::vector<double>& tolerance,
                                        const AlignmentOptions& options, const Sought& sought,
                                        const RunContext& run) {
  return Search(points, tolerance, options, sought, run).run();
}

}  // namespace obvid::alignment
