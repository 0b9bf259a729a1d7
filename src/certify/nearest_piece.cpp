// SPDX-License-Identifier: Apache-2.0
#include "nearest_piece.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "double_double.h"
#include "end_data.h"

namespace obvid {
namespace {

/// Places on a piece from which the nearest point is refined, and steps of the refinement.
constexpr int kPlaces = 8;
constexpr int kSteps = 16;
/// Nodes looked at on the average, for each query, before a tangle is given up. Near a contour a
/// point needs some twenty.
constexpr std::size_t kWorkPerQuery = 256;

// Roundings, in units of 2^-53 (docs/methods/certify.md, section 5).
constexpr double kSums = 8.0;       // of a point from its parts, and of its distance
constexpr double kPerDegree = 6.0;  // de Casteljau: three of numerator, three of weight
constexpr double kQuotient = 4.0;   // control points seen from an end, weighted, divided
constexpr double kAngle = 8.0;      // sine and cosine of a rounded angle
constexpr double kSpiral = 64.0;    // the same of a clothoid, by its series

double sum_of_coordinates(Vec2 v) { return std::abs(v.x) + std::abs(v.y); }

double rounding_of_sums(Vec2 a, Vec2 b) {
  return kSums * kUnitRoundoff * (sum_of_coordinates(a) + sum_of_coordinates(b));
}

struct Evaluation {
  double rounding = 0.0;   ///< units, of a point of the piece
  bool ends_only = false;  ///< weights of both signs: only the ends are known well
};

Evaluation evaluation_of(const RationalBezier& b) {
  Box box;
  Evaluation out;
  for (std::size_t j = 0; j <= static_cast<std::size_t>(b.degree); ++j) {
    box.grow(b.offset[j]);
    out.ends_only = out.ends_only || !(b.weight[j] > 0.0);
  }
  out.rounding = kUnitRoundoff *
                 ((kPerDegree * b.degree + kQuotient) * sum_of_coordinates(box.high - box.low) +
                  kSums * sum_of_coordinates(b.origin));
  return out;
}

double turned(double roundings, double length, double theta, double turn) {
  return kUnitRoundoff * roundings * std::abs(length) * (1.0 + std::abs(theta) + std::abs(turn));
}

/// A piece's points beyond its middle are measured from its stored end, which may be this far from
/// where its other numbers lead.
double misclosure(const Piece& piece) {
  const EndData end = ends_of(piece).end;
  return norm(end.point - end_point(piece)) + end.point_error;
}

Evaluation evaluation_of(const Piece& piece) {
  if (const auto* bezier = std::get_if<RationalBezier>(&piece)) return evaluation_of(*bezier);
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) {
    return {turned(kAngle, arc->length, arc->theta0, arc->kappa * arc->length)};
  }
  if (const auto* clothoid = std::get_if<ClothoidPiece>(&piece)) {
    const double kappa = std::max(std::abs(clothoid->kappa0), std::abs(clothoid->kappa1));
    return {turned(kSpiral, clothoid->length, clothoid->theta0, kappa * clothoid->length)};
  }
  return {};
}

bool has_stored_end(const Piece& piece) {
  return std::holds_alternative<ArcPiece>(piece) || std::holds_alternative<ClothoidPiece>(piece);
}

/// The nearest of the points looked at so far.
struct Foot {
  double t = 0.0;
  Vec2 point;
  double distance = kInfinity;

  void offer(double at, Vec2 there, Vec2 p) {
    const double d = norm(there - p);
    if (d < distance) *this = {at, there, d};
  }
};

/// Newton's method for the foot of the perpendicular between the neighbouring places; where it
/// leaves what is left of them, which pieces of very uneven speed make it do, the middle instead.
/// Every step is a point of the piece too.
void refine(const Piece& piece, Vec2 p, double from, Foot& foot) {
  double t = foot.t;
  double low = std::max(from, t - 1.0 / kPlaces), high = std::min(1.0, t + 1.0 / kPlaces);
  for (int k = 0; k < kSteps; ++k) {
    const Jet jet = evaluate(piece, t);
    foot.offer(t, jet.point, p);
    const Vec2 away = jet.point - p;
    const double speed = dot(jet.d1, jet.d1), slope = dot(away, jet.d1);
    (slope > 0.0 ? high : low) = t;
    const double bend = speed + dot(away, jet.d2);
    const double newton = t - slope / (bend > 0.0 ? bend : speed);
    const double next = newton >= low && newton <= high ? newton : 0.5 * (low + high);
    if (next == t || is_nan(newton)) return;
    t = next;
  }
}

/// Holds the piece: a curve of length L stays within L/2 of the middle of its ends.
Box box_of_piece(const Piece& piece) {
  Box box;
  if (const auto* b = std::get_if<RationalBezier>(&piece)) {
    for (std::size_t j = 0; j <= static_cast<std::size_t>(b->degree); ++j) {
      box.grow(b->origin + b->offset[j]);
    }
    return box;
  }
  const Vec2 middle = 0.5 * (start_point(piece) + end_point(piece));
  const double reach = 0.5 * std::abs(arc_length(piece, 0.0));  // closed forms: nothing to refine
  box.grow(middle - Vec2{reach, reach});
  box.grow(middle + Vec2{reach, reach});
  return box;
}

}  // namespace

double distance_bound(Vec2 a, Vec2 b) {
  return a == b ? 0.0 : norm(a - b) + rounding_of_sums(a, b);
}

double distance_at(const Piece& piece, double t, Vec2 p) {
  const Evaluation evaluation = evaluation_of(piece);
  const Vec2 there = evaluate(piece, t).point;
  double bound = norm(there - p) + rounding_of_sums(there, p) + evaluation.rounding;
  if (t > 0.5 && has_stored_end(piece)) bound += misclosure(piece);
  const bool known = !evaluation.ends_only || t == 0.0 || t == 1.0;
  return known && bound >= 0.0 ? bound : kInfinity;
}

Nearest nearest_on(const Piece& piece, Vec2 p, double from) {
  const Evaluation evaluation = evaluation_of(piece);
  Foot foot;
  const int step = evaluation.ends_only ? kPlaces : 1;
  for (int k = 0; k <= kPlaces; k += step) {
    const double t = std::max(from, static_cast<double>(k) / kPlaces);
    foot.offer(t, evaluate(piece, t).point, p);
  }
  if (!evaluation.ends_only) refine(piece, p, from, foot);
  double bound = foot.distance + rounding_of_sums(foot.point, p) + evaluation.rounding;
  if (foot.t > 0.5 && has_stored_end(piece)) bound += misclosure(piece);
  return {bound >= 0.0 ? bound : kInfinity, 0, foot.t};
}

PieceTree::PieceTree(const std::vector<Piece>& pieces)
    : pieces_(pieces), leaves_(std::bit_ceil(pieces.size())), boxes_(2 * leaves_) {
  for (std::size_t i = 0; i < pieces.size(); ++i) boxes_[leaves_ + i] = box_of_piece(pieces[i]);
  for (std::size_t k = leaves_ - 1; k > 0; --k) {
    boxes_[k] = boxes_[2 * k];
    boxes_[k].grow(boxes_[2 * k + 1]);
  }
}

void PieceTree::improve(Vec2 p, std::size_t first, std::size_t last, Nearest& best) {
  work_left_ += kWorkPerQuery;  // what easy points leave is there for others
  visit({1, 0, leaves_}, {p, first, last, best});
}

/// The nearer half first, so that the other one is mostly too far.
void PieceTree::visit(const Node& node, const Query& query) {
  const bool outside = node.first > query.last || node.first + node.width <= query.first;
  if (outside || work_left_ == 0) return;
  if (!(boxes_[node.id].distance(query.p) < query.best.distance)) return;
  --work_left_;
  if (node.width == 1) {
    Nearest here = nearest_on(pieces_[node.first], query.p);
    here.piece = node.first;
    if (here.distance < query.best.distance) query.best = here;
    return;
  }
  const std::size_t half = node.width / 2;
  std::array<Node, 2> child = {Node{2 * node.id, node.first, half},
                               Node{2 * node.id + 1, node.first + half, half}};
  if (boxes_[child[1].id].distance(query.p) < boxes_[child[0].id].distance(query.p)) {
    std::swap(child[0], child[1]);
  }
  for (const Node& next : child) visit(next, query);
}

}  // namespace obvid
