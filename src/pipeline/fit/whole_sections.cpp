// SPDX-License-Identifier: Apache-2.0
#include "fit/whole_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "obvid/geom/internal/circle.h"

namespace obvid::pipeline_detail {
namespace {

/// Fewer points than this, corners included, lie on any line or circle.
constexpr std::size_t kFewestOnLine = 3, kFewestOnArc = 4;
/// Steps of one fit, and its last one, in lengths of the section.
constexpr int kFitSteps = 8;
constexpr double kFitted = 1e-13;
/// Rounds of Lawson's method: each takes weight to the points that lie farthest off.
constexpr int kMostRounds = 200;
constexpr double kLeastWeight = 1e-9;  ///< of a point, of the largest one
constexpr int kMeetingSteps = 30;
constexpr double kMet = 1e-14;  ///< last step towards the place where two meet, of the coordinates
constexpr std::size_t kMostUnknowns = 3;

/// A line or circle by a point of it.
struct Shape {
  Vec2 anchor;
  double theta = 0.0, kappa = 0.0;

  [[nodiscard]] double off(Vec2 p) const {
    return distance_beside_circle(anchor, unit_at(theta), kappa, p);
  }
  /// Arc length from the anchor to the foot of a point; within half a turn.
  [[nodiscard]] double foot(Vec2 p) const {
    const Vec2 t = unit_at(theta), from = p - anchor;
    if (kappa == 0.0) return dot(from, t);
    return std::atan2(kappa * dot(from, t), 1.0 - kappa * dot(from, left_normal(t))) / kappa;
  }
  [[nodiscard]] Vec2 at(double s) const {
    const double half = 0.5 * kappa * s, chord = half == 0.0 ? s : s * std::sin(half) / half;
    return anchor + chord * unit_at(theta + half);
  }
};

/// Points of a section between its ends, and those ends that are no corners.
struct Points {
  std::vector<Vec2> at;
  std::vector<double> reach;
};

/// Solves a symmetric system of up to three unknowns by elimination. False: it is singular.
bool solve(std::array<std::array<double, kMostUnknowns>, kMostUnknowns>& a,
           std::array<double, kMostUnknowns>& b, std::size_t size) {
  for (std::size_t j = 0; j < size; ++j) {
    if (!(a[j][j] > 0.0)) return false;
    for (std::size_t i = j + 1; i < size; ++i) {
      const double part = a[i][j] / a[j][j];
      for (std::size_t k = j; k < size; ++k) a[i][k] -= part * a[j][k];
      b[i] -= part * b[j];
    }
  }
  for (std::size_t j = size; j-- > 0;) {
    for (std::size_t k = j + 1; k < size; ++k) b[j] -= a[j][k] * b[k];
    b[j] /= a[j][j];
  }
  return true;
}

/// The line or circle with the least weighted squares of distances, from one near it.
std::optional<Shape> fitted(Shape shape, const Points& points, const std::vector<double>& weight,
                            bool arc, double length) {
  const std::size_t unknowns = arc ? 3 : 2;
  for (int step = 0; step < kFitSteps; ++step) {
    std::array<std::array<double, kMostUnknowns>, kMostUnknowns> a{};
    std::array<double, kMostUnknowns> b{};
    for (std::size_t i = 0; i < points.at.size(); ++i) {
      const double s = shape.foot(points.at[i]), off = shape.off(points.at[i]);
      const double turn = shape.kappa * s, half = 0.5 * turn;
      const double sinc = half == 0.0 ? 1.0 : std::sin(half) / half;
      // how far the foot goes along its normal with the offset, the heading and the curvature
      const std::array<double, kMostUnknowns> slope = {
          std::cos(turn), s / length * (turn == 0.0 ? 1.0 : std::sin(turn) / turn),
          0.5 * (s / length) * (s / length) * sinc * sinc};
      for (std::size_t r = 0; r < unknowns; ++r) {
        b[r] += weight[i] * off / length * slope[r];
        for (std::size_t c = 0; c < unknowns; ++c) a[r][c] += weight[i] * slope[r] * slope[c];
      }
    }
    if (!solve(a, b, unknowns)) return std::nullopt;
    shape.anchor = shape.anchor + b[0] * length * left_normal(unit_at(shape.theta));
    shape.theta += b[1];
    shape.kappa += b[2] / length;
    const double largest = std::max({std::abs(b[0]), std::abs(b[1]), std::abs(b[2])});
    if (!(largest < 1.0)) return std::nullopt;  // it runs away
    if (largest < kFitted) break;
  }
  return shape;
}

/// The line through both ends, or the circle of least squares of the squared distances.
std::optional<Shape> first_guess(const Points& points, bool arc) {
  const Vec2 first = points.at.front(), last = points.at.back();
  const Vec2 middle_point = points.at[points.at.size() / 2];
  if (!arc) {
    if (first == last) return std::nullopt;
    return Shape{0.5 * (first + last), heading(last - first), 0.0};
  }
  const auto circle = circle_of_squares(points.at);
  if (!circle) return std::nullopt;
  const auto& [centre, radius] = *circle;
  double turned = 0.0;
  for (std::size_t i = 1; i < points.at.size(); ++i) {
    turned += cross(points.at[i - 1] - centre, points.at[i] - centre);
  }
  const Vec2 out = middle_point - centre;
  if (turned == 0.0 || !(norm(out) > 0.0)) return std::nullopt;
  Shape shape;
  shape.anchor = centre + (radius / norm(out)) * out;
  shape.kappa = (turned > 0.0 ? 1.0 : -1.0) / radius;
  shape.theta = heading(turned > 0.0 ? left_normal(out) : -left_normal(out));
  return shape;
}

/// Of the reaches, the most that a point is off.
double most_used(const Shape& shape, const Points& points) {
  double most = 0.0;
  for (std::size_t i = 0; i < points.at.size(); ++i) {
    most = std::max(most, std::abs(shape.off(points.at[i])) / points.reach[i]);
  }
  return most;
}

/// Whether feet follow one another as far as the reaches tell.
bool feet_follow(const Shape& shape, const Points& points) {
  double before = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.at.size(); ++i) {
    const double s = shape.foot(points.at[i]);
    if (s + 2.0 * points.reach[i] < before) return false;
    before = std::max(before, s);
  }
  return shape.foot(points.at.back()) > shape.foot(points.at.front());
}

/// The line or circle of least squares where that stays within all reaches, else one that does, by
/// Lawson's weights. The weighted root of the mean square is a lower bound of the most that any is
/// off: above 1 there is none.
std::optional<Shape> shape_within(const Points& points, bool arc) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.at.size(); ++i) {
    length += norm(points.at[i] - points.at[i - 1]);
  }
  auto shape = first_guess(points, arc);
  if (!shape || !(length > 0.0)) return std::nullopt;
  std::vector<double> weight;
  for (const double reach : points.reach) weight.push_back(1.0 / (reach * reach));
  const double unit = *std::max_element(weight.begin(), weight.end());
  for (double& w : weight) w /= unit;
  for (int round = 0; round < kMostRounds; ++round) {
    shape = fitted(*shape, points, weight, arc, length);
    if (!shape) return std::nullopt;
    if (most_used(*shape, points) <= 1.0) {
      return feet_follow(*shape, points) ? shape : std::nullopt;
    }
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < points.at.size(); ++i) {
      const double used = std::abs(shape->off(points.at[i])) / points.reach[i];
      const double part = weight[i] * points.reach[i] * points.reach[i];
      sum += part;
      squares += part * used * used;
      weight[i] *= used;
    }
    if (squares > sum) return std::nullopt;
    const double largest = *std::max_element(weight.begin(), weight.end());
    for (double& w : weight) w = std::max(w / largest, kLeastWeight);
  }
  return std::nullopt;
}

/// Where two of them meet near a place.
std::optional<Vec2> meeting(const Shape& a, const Shape& b, Vec2 near) {
  Vec2 p = near;
  for (int k = 0; k < kMeetingSteps; ++k) {
    const Vec2 na = left_normal(unit_at(a.theta + a.kappa * a.foot(p)));
    const Vec2 nb = left_normal(unit_at(b.theta + b.kappa * b.foot(p)));
    const double off_a = a.off(p), off_b = b.off(p), det = cross(na, nb);
    if (det == 0.0) return std::nullopt;
    const Vec2 step = Vec2{off_a * nb.y - off_b * na.y, off_b * na.x - off_a * nb.x} / det;
    p = p - step;
    if (norm(step) <= kMet * (std::abs(p.x) + std::abs(p.y))) return p;
  }
  return std::nullopt;
}

class Laying {
 public:
  explicit Laying(Prepared& series) : s_(series), sections_(series.split.sections.size()) {}

  void run() {
    std::vector<std::optional<Shape>> shapes;
    for (const Section& section : s_.split.sections) shapes.push_back(shape_of(section));
    if (std::none_of(shapes.begin(), shapes.end(), [](const auto& s) { return s.has_value(); })) {
      return;
    }
    s_.placed = s_.points;
    for (std::size_t k = 0; k < sections_; ++k) {
      if (k + 1 < sections_ || s_.closed) place(k, shapes[k], shapes[(k + 1) % sections_]);
    }
    for (std::size_t k = 0; k < sections_; ++k) {
      s_.whole.push_back(shapes[k] ? whole(s_.split.sections[k], *shapes[k]) : std::nullopt);
    }
  }

 private:
  [[nodiscard]] std::size_t point(std::size_t place) const { return s_.split.point_at(place); }
  [[nodiscard]] bool begins_at_corner(const Section& one) const {
    return s_.closed || one.first > 0;
  }
  [[nodiscard]] bool ends_at_corner(const Section& one) const {
    return s_.closed || one.last + 1 < s_.points.size();
  }

  /// What is fixed of a section, and points that may not move, leave it to the search.
  [[nodiscard]] std::optional<Shape> shape_of(const Section& section) const {
    Points points;
    for (std::size_t k = section.first; k <= section.last; ++k) {
      const std::size_t i = point(k);
      if (!s_.fixed.empty() && s_.fixed[i].says_how()) return std::nullopt;
      if (k == section.first && begins_at_corner(section)) continue;
      if (k == section.last && ends_at_corner(section)) continue;
      if (!(s_.reach[i] > 0.0)) return std::nullopt;
      points.at.push_back(s_.points[i]);
      points.reach.push_back(s_.reach[i]);
    }
    const std::size_t count = section.last - section.first + 1;
    return shape_among(section, points, count);
  }

  /// Of few points between corners these are a part, with the tolerances of their neighbours.
  [[nodiscard]] std::optional<Shape> shape_among(const Section& section, const Points& inner,
                                                 std::size_t count) const {
    for (const bool arc : {false, true}) {
      const std::size_t fewest = arc ? kFewestOnArc : kFewestOnLine;
      if (count < fewest || inner.at.empty()) continue;
      Points points = inner;
      if (inner.at.size() < fewest) {
        if (begins_at_corner(section)) {
          points.at.insert(points.at.begin(), s_.points[point(section.first)]);
          points.reach.insert(points.reach.begin(), inner.reach.front());
        }
        if (ends_at_corner(section)) {
          points.at.push_back(s_.points[point(section.last)]);
          points.reach.push_back(inner.reach.back());
        }
      }
      auto shape = shape_within(points, arc);
      if (shape) return shape;
    }
    return std::nullopt;
  }

  /// The corner behind section `k`: where both meet, or on the one that there is; where that is
  /// too far from its point it stays there.
  void place(std::size_t k, const std::optional<Shape>& before, const std::optional<Shape>& after) {
    if (!before && !after) return;
    const std::size_t n = s_.split.order.size();
    const std::size_t at = s_.split.sections[k].last, corner = point(at);
    double most = 0.0;
    for (const std::size_t beside : {point(at - 1), point((at + 1) % n)}) {
      most = std::max(most, s_.reach[beside]);
    }
    if (!s_.tolerance.empty()) most = std::min(most, s_.tolerance[corner]);
    const Vec2 from = s_.points[corner];
    std::optional<Vec2> to;
    if (before && after) to = sections_ > 1 ? meeting(*before, *after, from) : std::nullopt;
    if (before && !after) to = before->at(before->foot(from));
    if (after && !before) to = after->at(after->foot(from));
    if (to && norm(*to - from) <= most) s_.placed[corner] = *to;
  }

  /// From end to end, where all points lie within their reaches of it.
  [[nodiscard]] std::optional<WholePiece> whole(const Section& section, const Shape& shape) const {
    const auto end = [&](std::size_t place, bool corner) {
      const Vec2 p = s_.placed[point(place)];
      return corner ? p : shape.at(shape.foot(p));
    };
    const Vec2 first = end(section.first, begins_at_corner(section));
    const Vec2 last = end(section.last, ends_at_corner(section));
    const double half = 0.5 * shape.kappa * (shape.foot(last) - shape.foot(first));
    const Vec2 chord = last - first;
    const double direction = heading(chord);
    WholePiece out;
    out.turn = 2.0 * half;
    const double kappa = shape.kappa == 0.0 ? 0.0 : 2.0 * std::sin(half) / norm(chord);
    out.start = {first, direction - half, kappa};
    out.end = {last, direction + half, kappa};
    if (!(norm(chord) > 0.0) || half * shape.kappa < 0.0) return std::nullopt;
    if (s_.convex && kappa != 0.0 && kappa * turning_sign() < 0.0) return std::nullopt;
    const Shape laid{first, out.start.theta, kappa};
    for (std::size_t k = section.first + 1; k < section.last; ++k) {
      const std::size_t i = point(k);
      if (!(std::abs(laid.off(s_.points[i])) <= s_.reach[i])) return std::nullopt;
    }
    return out;
  }

  [[nodiscard]] double turning_sign() const {
    double turn = 0.0;
    const std::size_t n = s_.points.size();
    for (std::size_t i = 1; i + 1 < n; ++i) {
      turn += turning(s_.points[i] - s_.points[i - 1], s_.points[i + 1] - s_.points[i]);
    }
    return turn;
  }

  Prepared& s_;
  std::size_t sections_;
};

}  // namespace

void lay_whole_sections(Prepared& series) {
  series.placed.clear();
  series.whole.clear();
  const bool none = !series.primitives || series.exact() || series.split.smooth_loop ||
                    series.period || !series.kept.empty();
  if (!none) Laying(series).run();
}

}  // namespace obvid::pipeline_detail
