// SPDX-License-Identifier: Apache-2.0
#include "fit/pass_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "obvid/chain/internal/chain.h"
#include "obvid/curve/internal/nearest.h"
#include "obvid/geom/internal/angle.h"

namespace obvid::pipeline_detail {
namespace {

/// Elements closer to each other, in parameters of a piece, leave no room for a link.
constexpr double kLeastStep = 0.02;

}  // namespace

std::vector<std::size_t> places_of(const std::vector<std::size_t>& order) {
  std::vector<std::size_t> out(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) out[order[k]] = k;
  return out;
}

PassingChain::PassingChain(const SeriesChain& chain, const Contour& spirals,
                           const std::vector<Vec2>& points, const std::vector<std::size_t>& order)
    : chain_(chain),
      spirals_(spirals),
      points_(points),
      order_(order),
      place_(places_of(order)),
      places_(chain.links.size()) {
  std::size_t piece = 0;
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    while (piece < spirals.pieces.size() &&
           !(spirals.joints[piece].element.point == chain.elements[i].point)) {
      ++piece;
    }
    first_piece_.push_back(piece);
  }
  first_piece_.push_back(spirals.pieces.size());
}

bool PassingChain::pass(const std::vector<double>& excess) {
  const std::size_t n = points_.size();
  bool any = false;
  std::size_t begun = 0;  // the first link behind a point
  for (std::size_t k = 1; k < chain_.elements.size(); ++k) {
    if (!chain_.source[k]) continue;
    const std::size_t from = place_[*chain_.source[begun]],
                      over = (place_[*chain_.source[k]] + n - from) % n;
    std::size_t worst = n;
    for (std::size_t i = 1; i < (over > 0 ? over : n); ++i) {
      const std::size_t at = order_[(from + i) % n];
      if (excess[at] > 0.0 && (worst == n || excess[at] > excess[worst])) worst = at;
    }
    for (std::size_t link = begun; worst < n && link < k; ++link) {
      any = put(link, points_[worst]) || any;
    }
    begun = k;
  }
  return any;
}

/// Only where the place nearest to the point is inside the link.
bool PassingChain::put(std::size_t link, Vec2 p) {
  if (chain_.cone[link] == Cone::kNone) return false;
  Place best;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t piece = first_piece_[link]; piece < first_piece_[link + 1]; ++piece) {
    const double t = nearest_parameter(spirals_.pieces[piece], p);
    const double distance = norm(evaluate(spirals_.pieces[piece], t).point - p);
    if (!(distance < nearest)) continue;
    nearest = distance;
    best = {piece, t, {}};
  }
  const auto apart = [&](std::size_t piece, double t) {
    const auto order = [](std::size_t i, double u) { return static_cast<double>(i) + u; };
    return std::abs(order(best.piece, best.t) - order(piece, t)) >= kLeastStep;
  };
  std::vector<Place>& places = places_[link];
  if (!apart(first_piece_[link], 0.0) || !apart(first_piece_[link + 1] - 1, 1.0) ||
      std::any_of(places.begin(), places.end(),
                  [&](const Place& other) { return !apart(other.piece, other.t); })) {
    return false;
  }
  best.element = element_at(spirals_.pieces[best.piece], best.t);
  best.element.theta = nearest_angle(best.element.theta, chain_.elements[link].theta);
  places.push_back(best);
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return std::pair(a.piece, a.t) < std::pair(b.piece, b.t);
  });
  return true;
}

std::vector<bool> PassingChain::in_links(const std::vector<bool>& given) const {
  std::vector<bool> out;
  for (std::size_t i = 0; i < given.size(); ++i) {
    out.resize(out.size() + places_[i].size() + 1, given[i]);
  }
  return out;
}

SeriesChain PassingChain::chain() const {
  SeriesChain out = chain_;
  out.elements.clear();
  out.source.clear();
  out.nodes.clear();
  out.direction.clear();
  out.cone.clear();
  const std::vector<NodeData> nodes =
      chain_.nodes.empty() ? std::vector<NodeData>(chain_.elements.size()) : chain_.nodes;
  const auto add = [&](const Element& element, std::optional<std::size_t> source,
                       const NodeData& data) {
    out.elements.push_back(element);
    out.source.push_back(source);
    out.nodes.push_back(data);
  };
  for (std::size_t i = 0; i < chain_.elements.size(); ++i) {
    add(chain_.elements[i], chain_.source[i], nodes[i]);
    if (i == chain_.links.size()) break;
    for (const Place& place : places_[i]) add(place.element, std::nullopt, {});
    out.direction.insert(out.direction.end(), places_[i].size() + 1, chain_.direction[i]);
    out.cone.insert(out.cone.end(), places_[i].size() + 1, chain_.cone[i]);
  }
  std::vector<Vec2> at;
  for (const Element& e : out.elements) at.push_back(e.point);
  ChainProblem problem;
  problem.chords = measure_chords(at);
  problem.circles = measure_circles(at, problem.chords);
  problem.direction = out.direction;
  problem.cone = out.cone;
  problem.nodes = out.nodes;
  out.links = judge_chain(at, problem, out.elements).links;
  return out;
}

}  // namespace obvid::pipeline_detail
