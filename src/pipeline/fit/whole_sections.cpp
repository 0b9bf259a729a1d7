// SPDX-License-Identifier: Apache-2.0
#include "fit/whole_sections.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "fit/corners_between.h"
#include "fit/shape.h"

namespace obvid::pipeline_detail {
namespace {

/// Fewer points than this, corners included, lie on any line or circle.
constexpr std::size_t kFewestOnLine = 3, kFewestOnArc = 4;

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
    ShapePoints points;
    for (std::size_t k = section.first; k <= section.last; ++k) {
      const std::size_t i = point(k);
      if (!s_.fixed.empty() && s_.fixed[i].says_how()) return std::nullopt;
      if (k == section.first && begins_at_corner(section)) continue;
      if (k == section.last && ends_at_corner(section)) continue;
      if (!(s_.reach[i] > 0.0) || s_.taken_back.is_loose(i)) return std::nullopt;
      points.at.push_back(s_.points[i]);
      points.reach.push_back(s_.reach[i]);
    }
    const std::size_t count = section.last - section.first + 1;
    return shape_among(section, points, count);
  }

  /// Of few points between corners these are a part, with the tolerances of their neighbours.
  [[nodiscard]] std::optional<Shape> shape_among(const Section& section, const ShapePoints& inner,
                                                 std::size_t count) const {
    for (const bool arc : {false, true}) {
      const std::size_t fewest = arc ? kFewestOnArc : kFewestOnLine;
      if (count < fewest || inner.at.empty()) continue;
      ShapePoints points = inner;
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
    if (!to) return;
    if (s_.is_between(corner) && before && after) {
      const std::size_t p = point(at - 1), q = point((at + 1) % n);
      const PointsBeside beside{s_.points[p], s_.points[q], s_.reach[p], s_.reach[q]};
      if (lies_between(*before, *after, beside, *to)) s_.placed[corner] = *to;
      return;
    }
    if (norm(*to - from) <= most) s_.placed[corner] = *to;
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
    const std::size_t n = s_.measured();
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
