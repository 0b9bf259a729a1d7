// SPDX-License-Identifier: Apache-2.0
// Entities as pieces in the plane: docs/methods/dxf.md, section 3.
#include "dxf/entity_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "dxf/arcs.h"
#include "obvid/curve/internal/drawn_spans.h"
#include "obvid/curve/nurbs.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/geom/internal/box.h"

namespace obvid::dxf {
namespace {

/// Out of a level plane by less than this part of the length: rounding of the file's digits.
constexpr double kLevelWithin = 1e-6;
constexpr double kLargest = 1e100;  // coordinates and curvatures whose squares are still numbers

constexpr const char* kTilted = "it lies in a plane that is tilted against xy";
constexpr const char* kNothing = "it is a single point, seen from above";

Vec2 flat(Point3 p) { return {p.x, p.y}; }

/// Linear part of a map, for directions.
Point3 turned(const Affine& map, Point3 v) {
  Affine linear = map;
  linear.shift = {};
  return apply(linear, v);
}

bool is_level(Point3 direction) {
  return std::abs(direction.z) <= kLevelWithin * std::hypot(direction.x, direction.y);
}

class Shaper {
 public:
  Shaper(const Entity& entity, const Affine& map) : e_(entity), space_(map) {}

  Shape run() {
    shape_.fault = e_.fault;
    if (shape_.fault.reason == nullptr) shape();
    if (shape_.fault.reason == nullptr) check();
    if (shape_.fault.reason != nullptr) {
      shape_.pieces.clear();
      shape_.points.clear();
    }
    return std::move(shape_);
  }

 private:
  void refuse(const char* reason, std::string detail = {}) {
    shape_.fault = {reason, std::move(detail)};
  }

  void shape() {
    switch (e_.kind) {
      case Kind::kLine:
        return line();
      case Kind::kCircle:
        return arc(0.0, 360.0);
      case Kind::kArc:
        return arc(e_.from, e_.to);
      case Kind::kEllipse:
        return ellipse();
      case Kind::kSpline:
        return spline();
      case Kind::kPolyline:
        return polyline();
      case Kind::kPoint:
        shape_.points = {place(space_, e_.at)};
        return;
      default:
        return;
    }
  }

  /// Where a point lies in the plane; its height is noted.
  Vec2 place(const Affine& map, Point3 p) {
    const Point3 q = apply(map, p);
    shape_.low = first_ ? q.z : std::min(shape_.low, q.z);
    shape_.high = first_ ? q.z : std::max(shape_.high, q.z);
    first_ = false;
    return flat(q);
  }

  /// From the coordinates of a plane entity to space.
  [[nodiscard]] Affine from_plane() const {
    return std::hypot(e_.normal.x, e_.normal.y, e_.normal.z) > 0.0
               ? space_ * plane_to_space(e_.normal)
               : space_;
  }

  void line() {
    const Vec2 a = place(space_, e_.at), b = place(space_, e_.second);
    if (a == b) return refuse(kNothing);
    shape_.pieces.emplace_back(LinePiece{a, b});
  }

  void arc(double from, double to) {
    if (!(e_.size > 0.0))
      return refuse("its radius is not positive", fmt::format("{:.6g}", e_.size));
    const Affine map = from_plane();
    const Point3 p = turned(map, {e_.size, 0, 0}), q = turned(map, {0, e_.size, 0});
    if (!is_level(p) || !is_level(q)) return refuse(kTilted);
    const double sweep = sweep_of(from, to, 360.0);
    add_elliptic({place(map, e_.at), flat(p), flat(q)}, std::fmod(from, 360.0) * kOneDegree,
                 sweep == 360.0 ? kFullTurn : sweep * kOneDegree);
  }

  void ellipse() {
    if (!(e_.size > 0.0)) {
      return refuse("the ratio of its axes is not positive", fmt::format("{:.6g}", e_.size));
    }
    const double length = std::hypot(e_.normal.x, e_.normal.y, e_.normal.z);
    if (!(length > 0.0)) return refuse("its plane has no normal");
    const Point3 n = {e_.normal.x / length, e_.normal.y / length, e_.normal.z / length};
    const Point3& m = e_.second;
    const Point3 minor = {e_.size * (n.y * m.z - n.z * m.y), e_.size * (n.z * m.x - n.x * m.z),
                          e_.size * (n.x * m.y - n.y * m.x)};
    const Point3 p = turned(space_, m), q = turned(space_, minor);
    if (!is_level(p) || !is_level(q)) return refuse(kTilted);
    add_elliptic({place(space_, e_.at), flat(p), flat(q)}, std::fmod(e_.from, kFullTurn),
                 sweep_of(e_.from, e_.to, kFullTurn));
  }

  void add_elliptic(const EllipseFrame& frame, double from, double sweep) {
    if (cross(frame.p, frame.q) == 0.0) return refuse(kNothing);
    const std::size_t before = shape_.pieces.size();
    append_elliptic(frame, from, sweep, shape_.pieces);
    if (is_circular(frame)) shape_.arcs_more += shape_.pieces.size() - before - 1;
    shape_.closed = sweep == kFullTurn;
    const bool point = start_point(shape_.pieces.front()) == end_point(shape_.pieces.back());
    if (point && !shape_.closed) refuse(kNothing);
  }

  void polyline() {
    if ((e_.flags & kMeshFlags) != 0 && e_.type == "POLYLINE") return refuse("it is a mesh");
    const bool in_space = e_.type == "POLYLINE" && (e_.flags & kPolyline3dFlag) != 0;
    const Affine map = in_space ? space_ : from_plane();
    const Point3 x = turned(map, {1, 0, 0}), y = turned(map, {0, 1, 0});
    if (!in_space && !(is_level(x) && is_level(y))) return refuse(kTilted);
    const double determinant = cross(flat(x), flat(y));
    const double size = farthest_from_first(
        e_.points, [](Point3 p, Point3 first) { return std::hypot(p.x - first.x, p.y - first.y); });
    shape_.polygon = true;
    shape_.closed = (e_.flags & kClosedFlag) != 0;
    const std::size_t count = e_.points.size();
    for (std::size_t i = 0; i + (shape_.closed ? 0 : 1) < count; ++i) {
      Point3 a = e_.points[i], b = e_.points[(i + 1) % count];
      if (!in_space) a.z = b.z = e_.at.z;  // their own heights do not count
      const double bulge = i < e_.bulges.size() && !in_space ? e_.bulges[i] : 0.0;
      segment(map, a, b, bulge, determinant, size);
    }
    if (shape_.pieces.empty()) refuse("it has fewer than two different points");
  }

  void segment(const Affine& map, Point3 a, Point3 b, double bulge, double determinant,
               double size) {
    const Vec2 from = place(map, a), to = place(map, b);
    if (from == to) return;
    // An arc that rises less than rounding of the coordinates is a line.
    constexpr double kRounding = 1e-16;
    const double chord = std::hypot(b.x - a.x, b.y - a.y);
    if (std::abs(bulge) * chord <= kRounding * size) {
      shape_.pieces.emplace_back(LinePiece{from, to});
      return;
    }
    shape_.polygon = false;
    const EllipseFrame unit{{}, flat(turned(map, {1, 0, 0})), flat(turned(map, {0, 1, 0}))};
    if (is_circular(unit)) {
      const std::size_t before = shape_.pieces.size();
      append_bulge(from, to, determinant > 0.0 ? bulge : -bulge, shape_.pieces);
      shape_.arcs_more += shape_.pieces.size() - before - 1;
      return;
    }
    const double sweep = 4.0 * std::atan(bulge);
    const Vec2 middle = 0.5 * (flat(a) + flat(b)), half = 0.5 * (flat(b) - flat(a));
    const Vec2 centre = middle + left_normal(half) * ((1.0 - bulge * bulge) / (2.0 * bulge));
    const Vec2 out = flat(a) - centre;
    const double radius = norm(out);
    const Vec2 at = flat(apply(map, {centre.x, centre.y, a.z}));
    append_elliptic({at, radius * unit.p, radius * unit.q}, heading(out), sweep, shape_.pieces);
  }

  void spline() {
    if (e_.points.empty() && e_.fit.size() > 1) {
      for (const Point3& p : e_.fit) shape_.points.push_back(place(space_, p));
      shape_.closed = (e_.flags & kClosedFlag) != 0;
      shape_.start = direction(e_.start);
      shape_.end = direction(e_.end);
      return;
    }
    if (!spline_is_sound()) return;
    NurbsCurve curve;
    curve.degree = e_.degree;
    curve.knots = e_.knots;
    curve.weights = e_.weights;
    if (curve.weights.empty()) curve.weights.assign(e_.points.size(), 1.0);
    for (const Point3& p : e_.points) curve.points.push_back(place(space_, p));
    shape_.pieces = drawn_spans(curve);
    if (shape_.pieces.empty()) refuse(kNothing);
  }

  /// Of a spline's end, seen from above; a length of 0 says nothing.
  [[nodiscard]] std::optional<Vec2> direction(const std::optional<Point3>& given) const {
    if (!given) return std::nullopt;
    const Vec2 out = flat(turned(space_, *given));
    const double length = norm(out);
    if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
    return out / length;
  }

  bool spline_is_sound() {
    const std::size_t points = e_.points.size(), knots = e_.knots.size();
    if (e_.degree < 1 || e_.degree > kMaxBezierDegree) {
      refuse("its degree is not from 1 to 7", std::to_string(e_.degree));
      return false;
    }
    const auto p = static_cast<std::size_t>(e_.degree);
    if (points <= p || knots != points + p + 1 ||
        (!e_.weights.empty() && e_.weights.size() != points)) {
      refuse("its counts contradict its lists",
             fmt::format("degree {}, {} points, {} knots, {} weights", e_.degree, points, knots,
                         e_.weights.size()));
      return false;
    }
    const bool ascending = std::is_sorted(e_.knots.begin(), e_.knots.end());
    // bezier_spans takes neighbours for connected
    bool broken = false;
    for (std::size_t k = p + 1; k + p < points; ++k) {
      const double knot = e_.knots[k];
      const bool inside = knot > e_.knots[p] && knot < e_.knots[points];
      broken = broken || (inside && knot == e_.knots[k + p]);
    }
    const bool weights =
        std::all_of(e_.weights.begin(), e_.weights.end(), [](double w) { return w > 0.0; });
    if (!ascending) refuse("its knots do not ascend");
    if (ascending && broken)
      refuse("it has a gap, at a knot whose multiplicity exceeds the degree");
    if (ascending && !broken && !weights) refuse("one of its weights is not positive");
    return shape_.fault.reason == nullptr;
  }

  /// Numbers that go on to others must not overflow there.
  void check() {
    bool sound = true;
    const auto see = [&](Vec2 p) {
      sound = sound && std::abs(p.x) <= kLargest && std::abs(p.y) <= kLargest;
    };
    for (const Vec2 p : shape_.points) see(p);
    for (const Piece& piece : shape_.pieces) {
      see(start_point(piece));
      see(end_point(piece));
      if (const auto* arc = std::get_if<ArcPiece>(&piece)) see({arc->kappa, arc->length});
      if (const auto* bezier = std::get_if<RationalBezier>(&piece)) {
        for (int j = 0; j <= bezier->degree; ++j) {
          const auto k = static_cast<std::size_t>(j);
          see(bezier->offset[k]);
          see({bezier->weight[k], 1.0 / bezier->weight[k]});
        }
      }
    }
    if (!sound) refuse("its size is out of range");
  }

  const Entity& e_;
  const Affine& space_;
  Shape shape_;
  bool first_ = true;
};

}  // namespace

Shape shape_of(const Entity& entity, const Affine& map) { return Shaper(entity, map).run(); }

}  // namespace obvid::dxf
