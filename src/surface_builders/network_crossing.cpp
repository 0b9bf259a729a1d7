// SPDX-License-Identifier: Apache-2.0
#include "network_crossing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace obvid {
namespace {

/// Ends of pieces: spans divided so that the curve has a few dozen at least.
std::vector<double> piece_ends(const std::vector<double>& knots) {
  constexpr std::size_t kPieces = 48;  // of the whole curve
  constexpr std::size_t kFewest = 4;   // of each span: nearly straight then
  std::vector<double> ends;
  std::unique_copy(knots.begin(), knots.end(), std::back_inserter(ends));
  const std::size_t spans = ends.size() - 1;
  const std::size_t parts = std::max(kFewest, kPieces / std::max<std::size_t>(spans, 1));
  std::vector<double> all;
  for (std::size_t k = 0; k < spans; ++k) {
    const Range span{ends[k], ends[k + 1]};
    for (std::size_t i = 0; i < parts; ++i) {
      const double u = span.at(static_cast<double>(i) / static_cast<double>(parts));
      if (all.empty() || u > all.back()) all.push_back(u);
    }
  }
  all.push_back(ends.back());
  return all;
}

/// A point on each curve, and how the square of their distance changes.
struct Pair {
  double s = 0.0, t = 0.0;
  SpaceJet a, b;
  double distance = 0.0;
};

Pair pair_at(const SpaceCurve& a, const SpaceCurve& b, double s, double t) {
  Pair pair{s, t, evaluate(a, s), evaluate(b, t), 0.0};
  pair.distance = norm(pair.a.point - pair.b.point);
  return pair;
}

/// A parameter at the end of its range that would have to leave it stays.
bool held(double value, const Range& range, double slope) {
  return (value <= range.from && slope > 0.0) || (value >= range.to && slope < 0.0);
}

std::array<double, 2> step_from(const Pair& pair, bool hold_s, bool hold_t) {
  const Vec3 gap = pair.a.point - pair.b.point;
  const double gs = dot(gap, pair.a.d1), gt = -dot(gap, pair.b.d1);
  const double gauss_s = dot(pair.a.d1, pair.a.d1), gauss_t = dot(pair.b.d1, pair.b.d1);
  const double hst = -dot(pair.a.d1, pair.b.d1);
  double hss = gauss_s + dot(gap, pair.a.d2), htt = gauss_t - dot(gap, pair.b.d2);
  // where a curve stands still (poles, cusps) its parameter moves nothing
  hold_s = hold_s || !(gauss_s > 0.0);
  hold_t = hold_t || !(gauss_t > 0.0);
  if (hold_s || hold_t) {
    const auto alone = [](double g, double h, double gauss) {
      const double slope = h > 0.0 ? h : gauss;
      return slope > 0.0 ? -g / slope : 0.0;
    };
    return {hold_s ? 0.0 : alone(gs, hss, gauss_s), hold_t ? 0.0 : alone(gt, htt, gauss_t)};
  }
  constexpr double kSingular = 1e-12;  // parallel curves: any point is as near
  if (!(hss > 0.0 && hss * htt - hst * hst > kSingular * hss * htt)) {
    hss = gauss_s;  // not convex here: without second derivatives it goes down all the same
    htt = gauss_t;
  }
  double det = hss * htt - hst * hst;
  if (!(det > kSingular * hss * htt)) {
    hss *= 2.0;
    htt *= 2.0;
    det = hss * htt - hst * hst;
    if (!(det > 0.0)) return {0.0, 0.0};
  }
  return {(-gs * htt + gt * hst) / det, (-gt * hss + gs * hst) / det};
}

Crossing descended(const SpaceCurve& a, const SpaceCurve& b, double s, double t) {
  constexpr int kMostSteps = 60, kMostHalvings = 12;
  const Range in_a = domain(a), in_b = domain(b);
  Pair now = pair_at(a, b, s, t);
  for (int step = 0; step < kMostSteps && now.distance > 0.0; ++step) {
    const Vec3 gap = now.a.point - now.b.point;
    const bool hold_s = held(now.s, in_a, dot(gap, now.a.d1));
    const bool hold_t = held(now.t, in_b, -dot(gap, now.b.d1));
    const auto [ds, dt] = step_from(now, hold_s, hold_t);
    double part = 1.0;
    bool nearer = false;
    for (int halving = 0; halving < kMostHalvings && !nearer; ++halving, part /= 2.0) {
      const Pair next = pair_at(a, b, std::clamp(now.s + part * ds, in_a.from, in_a.to),
                                std::clamp(now.t + part * dt, in_b.from, in_b.to));
      nearer = next.distance < now.distance;
      if (nearer) now = next;
    }
    if (!nearer) break;
  }
  return {now.s, now.t, now.distance};
}

class Search {
 public:
  Search(const BoxedCurve& a, const BoxedCurve& b) : a_(a), b_(b) {
    best_.distance = std::numeric_limits<double>::infinity();
  }

  Crossing run() {
    std::vector<std::array<std::size_t, 2>> open{{a_.root(), b_.root()}};
    while (!open.empty() && tries_ < kMostTries) {
      const auto [i, j] = open.back();
      open.pop_back();
      const BoxedCurve::Node &p = a_.node(i), &q = b_.node(j);
      if (!(distance_between(p.box, q.box) < best_.distance)) continue;
      const bool single_p = p.end - p.begin == 1, single_q = q.end - q.begin == 1;
      if (single_p && single_q) {
        try_from(a_.middle(p.begin), b_.middle(q.begin));
      } else if (!single_p && (single_q || p.box.diagonal() >= q.box.diagonal())) {
        push_nearer_last(open, {p.left, j}, {p.right, j});
      } else {
        push_nearer_last(open, {i, q.left}, {i, q.right});
      }
    }
    return best_;
  }

 private:
  using Nodes = std::array<std::size_t, 2>;
  // curves that run along each other everywhere would try all pairs of pieces
  static constexpr std::size_t kMostTries = 20'000;

  void try_from(double s, double t) {
    ++tries_;
    const Crossing found = descended(a_.curve(), b_.curve(), s, t);
    if (found.distance < best_.distance) best_ = found;
  }
  [[nodiscard]] double apart(const Nodes& n) const {
    return distance_between(a_.node(n[0]).box, b_.node(n[1]).box);
  }
  void push_nearer_last(std::vector<Nodes>& open, const Nodes& x, const Nodes& y) const {
    const bool x_nearer = apart(x) <= apart(y);
    open.push_back(x_nearer ? y : x);
    open.push_back(x_nearer ? x : y);
  }

  const BoxedCurve &a_, &b_;
  Crossing best_;
  std::size_t tries_ = 0;
};

}  // namespace

double distance_between(const Box3& a, const Box3& b) {
  const auto gap = [](double low_a, double high_a, double low_b, double high_b) {
    return std::max({0.0, low_a - high_b, low_b - high_a});
  };
  return norm({gap(a.low.x, a.high.x, b.low.x, b.high.x), gap(a.low.y, a.high.y, b.low.y, b.high.y),
               gap(a.low.z, a.high.z, b.low.z, b.high.z)});
}

BoxedCurve::BoxedCurve(const SpaceCurve& curve) : curve_(curve), ends_(piece_ends(curve.knots)) {
  // with every end standing `degree` times the control points are those of Bezier pieces
  const auto p = static_cast<std::size_t>(curve.degree);
  std::vector<double> added;
  for (std::size_t k = 1; k + 1 < ends_.size(); ++k) {
    const auto [from, to] = std::equal_range(curve.knots.begin(), curve.knots.end(), ends_[k]);
    added.insert(added.end(), p - std::min(p, static_cast<std::size_t>(to - from)), ends_[k]);
  }
  const SpaceCurve cut = with_knots(curve, added);
  std::vector<Box3> boxes;
  for (std::size_t k = 0; k + 1 < ends_.size(); ++k) {
    Box3& box = boxes.emplace_back();
    for (std::size_t i = 0; i <= p; ++i) box.add(cut.points[k * p + i]);
  }
  nodes_.reserve(2 * boxes.size());
  build(boxes, 0, boxes.size());
}

std::size_t BoxedCurve::build(const std::vector<Box3>& boxes, std::size_t begin,
                              std::size_t end) {
  Node node{boxes[begin], begin, end, 0, 0};
  if (end - begin > 1) {  // halves: as deep as the logarithm of the pieces
    const std::size_t middle = begin + (end - begin) / 2;
    node.left = build(boxes, begin, middle);
    node.right = build(boxes, middle, end);
    node.box = nodes_[node.left].box;
    node.box.add_box(nodes_[node.right].box);
  }
  nodes_.push_back(node);
  return nodes_.size() - 1;
}

Crossing nearest_points(const BoxedCurve& a, const BoxedCurve& b) { return Search(a, b).run(); }

}  // namespace obvid
