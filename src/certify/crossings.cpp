// SPDX-License-Identifier: Apache-2.0
#include "obvid/certify/internal/crossings.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "box.h"

namespace obvid {
namespace {

constexpr double kFlatness = 1e-9;  // of the contour's size: a part this flat is its chord
constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();  // of the coordinates
constexpr int kDeepest = 60;                // halvings of a pair: beyond the digits of a double
constexpr std::size_t kWorkPerPiece = 400;  // pairs looked at, before a tangle is given up
constexpr double kLargestArcTurn = 1.0;     // rad, per conic that stands in for an arc

Vec2 control_point(const RationalBezier& b, std::size_t j) { return b.origin + b.offset[j]; }
std::size_t last(const RationalBezier& b) { return static_cast<std::size_t>(b.degree); }

/// Holds the curve when the weights are positive.
Box box_of_controls(const RationalBezier& b) {
  Box box;
  for (std::size_t j = 0; j <= last(b); ++j) box.grow(control_point(b, j));
  return box;
}

/// A Bezier curve that stands in for part of a piece.
struct Part {
  RationalBezier curve;
  Box box;

  explicit Part(const RationalBezier& b) : curve(b), box(box_of_controls(b)) {}
  [[nodiscard]] Vec2 from() const { return control_point(curve, 0); }
  [[nodiscard]] Vec2 to() const { return control_point(curve, last(curve)); }
  [[nodiscard]] double extent() const {
    return std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  }
  [[nodiscard]] std::array<Part, 2> halves() const {
    const auto half = split(curve, 0.5);
    return {Part(half[0]), Part(half[1])};
  }
};

RationalBezier segment(Vec2 from, Vec2 to) { return {from, 1, {Vec2{}, to - from}, {1.0, 1.0}}; }

/// Conic that is the arc exactly, up to rounding.
RationalBezier conic(const ArcPiece& arc, double s0, double s1) {
  const auto along = [&](double s) {
    const double half = 0.5 * arc.kappa * s;
    const double chord = half != 0.0 ? std::sin(half) / half : 1.0;
    return s * chord * unit_at(arc.theta0 + half);
  };
  const Vec2 p0 = along(s0);
  const Vec2 p2 = along(s1);
  const double half_turn = 0.5 * arc.kappa * (s1 - s0);
  const double leg = 0.5 * norm(p2 - p0) / std::cos(half_turn);
  const Vec2 p1 = p0 + leg * unit_at(arc.theta0 + arc.kappa * s0);
  return {arc.start, 2, {p0, p1, p2}, {1.0, std::cos(half_turn), 1.0}};
}

/// Septic with the point and three derivatives of the clothoid at both parameters.
RationalBezier septic(const ClothoidPiece& piece, double t0, double t1) {
  const Jet a = evaluate(piece, t0), b = evaluate(piece, t1);
  const double h = t1 - t0;
  const auto leg = [h](const Jet& j, double sign) {
    const Vec2 first = (sign * h / 7.0) * j.d1, second = (h * h / 42.0) * j.d2;
    const Vec2 third = (sign * h * h * h / 210.0) * j.d3;
    return std::array<Vec2, 3>{first, 2.0 * first + second, 3.0 * first + 3.0 * second + third};
  };
  const auto p = leg(a, 1.0), q = leg(b, -1.0);
  const Vec2 end = b.point - a.point;
  return {a.point,
          7,
          {Vec2{}, p[0], p[1], p[2], end + q[2], end + q[1], end + q[0], end},
          {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0}};
}

std::vector<Part> parts_of_clothoid(const ClothoidPiece& piece) {
  constexpr double kTurn = 0.3;  // rad; the septic is then within 1e-10 of its length
  constexpr double kMostParts =
      64.0;  // three full turns; a clothoid of a contour has less than half
  const double turn = std::max(std::abs(piece.kappa0), std::abs(piece.kappa1)) * piece.length;
  const int count = std::max(1, static_cast<int>(std::ceil(std::min(kMostParts, turn / kTurn))));
  std::vector<Part> parts;
  for (int j = 0; j < count; ++j) {
    parts.emplace_back(
        septic(piece, static_cast<double>(j) / count, static_cast<double>(j + 1) / count));
  }
  return parts;
}

/// Curves with positive weights that trace the piece.
std::vector<Part> parts_of(const Piece& piece) {
  if (const auto* clothoid = std::get_if<ClothoidPiece>(&piece))
    return parts_of_clothoid(*clothoid);
  std::vector<Part> parts;
  if (const auto* bezier = std::get_if<RationalBezier>(&piece)) {
    parts.emplace_back(*bezier);
  } else if (const auto* line = std::get_if<LinePiece>(&piece)) {
    parts.emplace_back(segment(line->start, line->end));
  } else {
    const auto& arc = std::get<ArcPiece>(piece);
    constexpr double kMostConics = 64.0;  // ten full turns; an arc of a contour has less than half
    const double turn = std::min(std::abs(arc.kappa) * arc.length / kLargestArcTurn, kMostConics);
    const int count = std::max(1, static_cast<int>(std::ceil(turn)));
    for (int j = 0; j < count; ++j) {
      parts.emplace_back(conic(arc, arc.length * j / count, arc.length * (j + 1) / count));
    }
  }
  return parts;
}

/// Both polygons lie on different sides of a line parallel to the chord of `a`.
bool chord_separates(const Part& a, const Part& b) {
  const Vec2 normal = left_normal(a.to() - a.from());
  double a_low = 0.0, a_high = 0.0, b_low = kInfinity, b_high = -kInfinity;
  for (std::size_t j = 0; j <= last(a.curve); ++j) {
    const double h = dot(control_point(a.curve, j) - a.from(), normal);
    a_low = std::min(a_low, h);
    a_high = std::max(a_high, h);
  }
  for (std::size_t j = 0; j <= last(b.curve); ++j) {
    const double h = dot(control_point(b.curve, j) - a.from(), normal);
    b_low = std::min(b_low, h);
    b_high = std::max(b_high, h);
  }
  return b_low > a_high || b_high < a_low;
}

bool is_flat(const Part& part, double tolerance) {
  const Vec2 chord = part.to() - part.from();
  const double length = norm(chord);
  if (length <= tolerance) return part.extent() <= tolerance;
  for (std::size_t j = 1; j < last(part.curve); ++j) {
    const Vec2 q = control_point(part.curve, j) - part.from();
    if (std::abs(cross(chord, q)) > tolerance * length) return false;
  }
  return true;
}

/// Half-open on both sides, so that a crossing at a cut counts once.
bool chords_cross(const Part& a, const Part& b) {
  const Vec2 d = a.to() - a.from();
  const Vec2 e = b.to() - b.from();
  const bool b_apart = (cross(d, b.from() - a.from()) > 0.0) != (cross(d, b.to() - a.from()) > 0.0);
  const bool a_apart = (cross(e, a.from() - b.from()) > 0.0) != (cross(e, a.to() - b.from()) > 0.0);
  return a_apart && b_apart;
}

/// Two ends lie on each other: the parts touch there (a contour that returns to its start point).
bool ends_touch(const Part& a, const Part& b, double tolerance) {
  const auto near = [tolerance](Vec2 p, Vec2 q) { return norm(p - q) <= tolerance; };
  return near(a.from(), b.from()) || near(a.from(), b.to()) || near(a.to(), b.from()) ||
         near(a.to(), b.to());
}

Vec2 unit(Vec2 v) { return v / norm(v); }

/// Every leg of both polygons advances along the direction at the shared end: `a` ends before `b`
/// begins, so they meet only there. (Where a leg has no length, this says no.)
bool advance_together(const Part& a, const Part& b) {
  const std::size_t n = last(a.curve);
  const Vec2 direction =
      unit(a.curve.offset[n] - a.curve.offset[n - 1]) + unit(b.curve.offset[1] - b.curve.offset[0]);
  for (const Part* part : {&a, &b}) {
    for (std::size_t j = 0; j < last(part->curve); ++j) {
      if (!(dot(part->curve.offset[j + 1] - part->curve.offset[j], direction) > 0.0)) return false;
    }
  }
  return true;
}

/// Every leg of the polygon advances along its chord: the curve does not meet itself.
bool advances(const Part& part) {
  const Vec2 chord = part.to() - part.from();
  for (std::size_t j = 0; j < last(part.curve); ++j) {
    if (!(dot(part.curve.offset[j + 1] - part.curve.offset[j], chord) > 0.0)) return false;
  }
  return true;
}

class CrossingCount {
 public:
  CrossingCount(const Contour& contour, std::span<const std::size_t> turning)
      : contour_(contour), turning_(turning) {
    const std::size_t n = contour.pieces.size();
    leaves_ = std::bit_ceil(n);
    boxes_.resize(2 * leaves_);
    run_.assign(leaves_, 0);
    for (std::size_t i = 0; i < n; ++i) {
      for (const Part& part : parts_of(contour.pieces[i])) boxes_[leaves_ + i].grow(part.box);
    }
    for (std::size_t k = leaves_ - 1; k > 0; --k) {
      boxes_[k] = boxes_[2 * k];
      boxes_[k].grow(boxes_[2 * k + 1]);
    }
    for (std::size_t r = 0; r < contour.runs.size(); ++r) {
      for (std::size_t i = contour.runs[r].first_piece; i <= contour.runs[r].last_piece && i < n;
           ++i) {
        run_[i] = r;
      }
    }
    part_runs_that_turn();
    const Vec2 low = boxes_[1].low, high = boxes_[1].high;
    const double coordinate =
        std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y)});
    tolerance_ =
        std::max(kFlatness * std::max(high.x - low.x, high.y - low.y), kRounding * coordinate);
    work_left_ = kWorkPerPiece * (n + 16);
  }

  int run() {
    within(1, 0, leaves_);
    for (const std::size_t i : turning_) {
      for (const Part& part : parts_of(contour_.pieces[i])) alone(part, kDeepest);
    }
    return count_;
  }

 private:
  /// A run of pieces that are not all monotone is none: each of its pieces stands for itself.
  void part_runs_that_turn() {
    const std::size_t n = contour_.pieces.size();
    std::vector<bool> turns(contour_.runs.size() + 1, false);
    for (const std::size_t i : turning_) turns[run_[i]] = true;
    for (std::size_t i = 0; i < n; ++i) {
      if (turns[run_[i]]) run_[i] = contour_.runs.size() + 1 + i;
    }
  }

  /// Node of the tree of boxes over pieces [first, first + width).
  struct Node {
    std::size_t id, first, width;
    [[nodiscard]] std::array<Node, 2> children() const {
      const std::size_t half = width / 2;
      return {Node{2 * id, first, half}, Node{2 * id + 1, first + half, half}};
    }
  };

  [[nodiscard]] std::size_t last_piece(const Node& node) const {
    return std::min(node.first + node.width, contour_.pieces.size()) - 1;
  }
  [[nodiscard]] bool beyond(const Node& node) const { return node.first >= contour_.pieces.size(); }

  void within(std::size_t id, std::size_t first, std::size_t width) {
    const Node node{id, first, width};
    if (width < 2 || beyond(node) || run_[first] == run_[last_piece(node)]) return;
    const auto [left, right] = node.children();
    within(left.id, left.first, left.width);
    within(right.id, right.first, right.width);
    between(left, right);
  }

  void between(const Node& a, const Node& b) {
    if (beyond(a) || beyond(b) || boxes_[a.id].misses(boxes_[b.id])) return;
    if (run_[a.first] == run_[last_piece(b)]) return;  // one run holds all from a to b
    if (work_left_ == 0) return;
    --work_left_;
    if (a.width == 1 && b.width == 1) {
      pieces(a.first, b.first);
      return;
    }
    const bool split_a = a.width >= b.width;
    for (const Node& child : (split_a ? a : b).children()) {
      split_a ? between(child, b) : between(a, child);
    }
  }

  void pieces(std::size_t i, std::size_t j) {
    const auto a = parts_of(contour_.pieces[i]);
    const auto b = parts_of(contour_.pieces[j]);
    const bool next = j == i + 1;
    const bool around = contour_.closed && i == 0 && j + 1 == contour_.pieces.size();
    for (std::size_t k = 0; k < a.size(); ++k) {
      for (std::size_t l = 0; l < b.size(); ++l) {
        if (next && k + 1 == a.size() && l == 0) {
          adjacent(a[k], b[l], kDeepest);
        } else if (around && k == 0 && l + 1 == b.size()) {
          adjacent(b[l], a[k], kDeepest);
        } else {
          apart(a[k], b[l], kDeepest);
        }
      }
    }
  }

  /// Where a piece meets itself.
  void alone(const Part& part, int depth) {
    if (work_left_ == 0 || depth == 0 || advances(part)) return;
    --work_left_;
    const auto half = part.halves();
    alone(half[0], depth - 1);
    alone(half[1], depth - 1);
    adjacent(half[0], half[1], depth - 1);
  }

  /// `a` ends where `b` begins; that joint is no crossing.
  void adjacent(const Part& a, const Part& b, int depth) {
    if (work_left_ == 0 || depth == 0 || advance_together(a, b)) return;
    --work_left_;
    const auto ha = a.halves();
    const auto hb = b.halves();
    apart(ha[0], hb[0], depth - 1);
    apart(ha[0], hb[1], depth - 1);
    apart(ha[1], hb[1], depth - 1);
    adjacent(ha[1], hb[0], depth - 1);
  }

  void apart(const Part& a, const Part& b, int depth) {
    if (work_left_ == 0 || a.box.misses(b.box)) return;
    --work_left_;
    if (chord_separates(a, b) || chord_separates(b, a)) return;
    const bool a_flat = is_flat(a, tolerance_);
    const bool b_flat = is_flat(b, tolerance_);
    if ((a_flat && b_flat) || depth == 0) {
      if (!ends_touch(a, b, tolerance_) && chords_cross(a, b)) ++count_;
      return;
    }
    if (b_flat || (!a_flat && a.extent() >= b.extent())) {
      for (const Part& half : a.halves()) apart(half, b, depth - 1);
    } else {
      for (const Part& half : b.halves()) apart(a, half, depth - 1);
    }
  }

  const Contour& contour_;
  std::span<const std::size_t> turning_;
  std::size_t leaves_ = 0;
  std::vector<Box> boxes_;
  std::vector<std::size_t> run_;
  double tolerance_ = 0.0;
  std::size_t work_left_ = 0;
  int count_ = 0;
};

}  // namespace

int count_crossings(const Contour& contour, std::span<const std::size_t> turning) {
  if (contour.pieces.empty() || (contour.pieces.size() < 2 && turning.empty())) return 0;
  return CrossingCount(contour, turning).run();
}

int count_crossings_of_chords(std::span<const Vec2> points, bool closed) {
  Contour chords;
  chords.closed = closed;
  const std::size_t n = points.size();
  const std::size_t count = n < 2 ? 0 : closed ? n : n - 1;
  for (std::size_t i = 0; i < count; ++i) {
    chords.pieces.emplace_back(LinePiece{points[i], points[(i + 1) % n]});
    chords.runs.push_back({i, i, 0});
  }
  return count_crossings(chords);
}

}  // namespace obvid
