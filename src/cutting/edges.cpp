// SPDX-License-Identifier: Apache-2.0
#include "edges.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <iterator>
#include <limits>

namespace obvid::cutting {
namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using TreePoint = bg::model::point<double, 2, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;
using TreeValue = std::pair<TreeBox, std::size_t>;

TreeBox tree_box(const Piece& piece) {
  const Box2 box = box_of(piece);
  return {{box.low.x, box.low.y}, {box.high.x, box.high.y}};
}

Vec2 left_at(double theta) { return left_normal(unit_at(theta)); }

}  // namespace

struct Edges::Tree {
  bgi::rtree<TreeValue, bgi::quadratic<16>> boxes;
};

Edges::Edges() = default;
Edges::~Edges() = default;
Edges::Edges(Edges&&) noexcept = default;
Edges& Edges::operator=(Edges&&) noexcept = default;

void Edges::add(const ArcPath& path, std::size_t name) {
  const std::size_t n = path.pieces.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Piece& piece = path.pieces[i];
    const Piece& before =
        path.pieces[path.closed ? (i + n - 1) % n : std::max<std::size_t>(i, 1) - 1];
    const Piece& behind = path.pieces[path.closed ? (i + 1) % n : std::min(i + 1, n - 1)];
    const Vec2 first = left_at(heading_at_start(piece)), last = left_at(heading_at_end(piece));
    edges_.push_back({piece, first + left_at(heading_at_end(before)),
                      last + left_at(heading_at_start(behind)), name});
    if (!path.closed && i == 0) edges_.back().normal_before = first;
    if (!path.closed && i + 1 == n) edges_.back().normal_behind = last;
  }
}

void Edges::finish() {
  std::vector<TreeValue> values;
  for (std::size_t i = 0; i < edges_.size(); ++i) values.emplace_back(tree_box(edges_[i].piece), i);
  tree_ = std::make_unique<Tree>();
  tree_->boxes = decltype(tree_->boxes)(values.begin(), values.end());
}

Edges::Nearest Edges::nearest(Vec2 point) const {
  Nearest out;
  out.distance = out.room = std::numeric_limits<double>::infinity();
  const Edge* best = nullptr;
  const auto look = [&](const TreeValue& value) {
    const Edge& edge = edges_[value.second];
    const double distance = distance_from(edge.piece, point);
    if (!(distance < out.distance)) return;
    out.distance = distance;
    best = &edge;
  };
  const TreePoint at{point.x, point.y};
  std::vector<TreeValue> found;
  tree_->boxes.query(bgi::nearest(at, 1), std::back_inserter(found));
  for (const TreeValue& value : found) look(value);
  // what is nearer has a box that comes so near
  const double d = out.distance;
  const TreeBox around{{point.x - d, point.y - d}, {point.x + d, point.y + d}};
  if (best != nullptr) {
    for (auto it = tree_->boxes.qbegin(bgi::intersects(around)); it != tree_->boxes.qend(); ++it)
      look(*it);
  }
  if (best == nullptr) return out;
  out.name = best->name;
  out.room = room_beside(*best, point, out.distance);
  return out;
}

double Edges::room_beside(const Edge& edge, Vec2 point, double distance) const {
  const double to_start = norm(point - start_point(edge.piece)),
               to_end = norm(point - end_point(edge.piece));
  constexpr double kAtEnd = 1e-12;  // of the distance
  if (to_start <= distance * (1.0 + kAtEnd)) {
    return dot(point - start_point(edge.piece), edge.normal_before) >= 0.0 ? distance : -distance;
  }
  if (to_end <= distance * (1.0 + kAtEnd)) {
    return dot(point - end_point(edge.piece), edge.normal_behind) >= 0.0 ? distance : -distance;
  }
  // inside of a piece: beside its chord, or inside of its circle
  const Vec2 from = point - start_point(edge.piece), left = left_at(heading_at_start(edge.piece));
  return 2.0 * dot(from, left) - curvature_of(edge.piece) * dot(from, from) >= 0.0 ? distance
                                                                                   : -distance;
}

std::vector<Edges::Named> Edges::near_to(const Piece& piece, double within) const {
  const Box2 box = box_of(piece);
  const TreeBox around{{box.low.x - within, box.low.y - within},
                       {box.high.x + within, box.high.y + within}};
  std::vector<Named> out;
  for (auto it = tree_->boxes.qbegin(bgi::intersects(around)); it != tree_->boxes.qend(); ++it) {
    out.push_back({&edges_[it->second].piece, edges_[it->second].name});
  }
  return out;
}

std::optional<std::size_t> Edges::met_by(const Piece& piece, std::optional<std::size_t> but) const {
  const TreeBox box = tree_box(piece);
  for (auto it = tree_->boxes.qbegin(bgi::intersects(box)); it != tree_->boxes.qend(); ++it) {
    const Edge& edge = edges_[it->second];
    if (edge.name != but && meeting_of(piece, edge.piece)) return edge.name;
  }
  return std::nullopt;
}

}  // namespace obvid::cutting
