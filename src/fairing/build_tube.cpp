// SPDX-License-Identifier: Apache-2.0
#include "build_tube.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "find_primitives.h"
#include "heading_ranges.h"
#include "node_ends.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/series/analysis.h"
#include "tube_ends.h"
#include "tube_solver.h"

namespace obvid::fairing_detail {
namespace {

/// Nodes lie at least this many tolerances apart: their offsets then turn a chord by at most
/// 2 / kSpacing rad.
constexpr double kSpacing = 8.0;
/// And so far that the height of the curve over its chord is at least this many tolerances: closer
/// nodes could not tell its curvature.
constexpr double kSagitta = 1.5;
constexpr double kLargestLinkTurn = 0.5;  ///< rad over a link between thinned nodes
constexpr double kGrading = 1.5;          ///< largest ratio of neighbouring thinned links
constexpr std::size_t kFewestLinks = 24;  ///< thinning leaves at least so many
/// Shorter series are fast enough with all their nodes, which leave the runs more room: thinned, 14
/// of 1,169 public airfoils had more vertices and none had fewer.
constexpr std::size_t kFewestToThin = 500;  ///< points
constexpr std::size_t kFewestOnLoop = 3;    ///< nodes of a closed tube

/// Points between nodes keep this part of their reach: the rest is for what the model of the link
/// does not know of the finished curve.
constexpr double kModelShare = 0.995;
/// Where many points with noise up to their reach lie between nodes, no curve keeps that much room.
constexpr double kTightShare = 0.998;

/// Of the tolerance: how much farther than from the circle of least squares points may be from one
/// that is meant. Two that touch are moved apart by a fifth.
constexpr double kRoomOfMeant = 0.2;

/// Size that the tolerance can hide, over (tolerance / chord).
constexpr double kHiddenSize = 0.05;
/// Links on each side over which the rate of curvature is averaged.
constexpr std::size_t kRateReach = 3;

/// int kappa'^2 of the quintic Hermite curve (docs/methods/fairing.md), and its weight against the
/// tube's barrier.
constexpr LinkEnergy kRateEnergy{24.0, 1.5, 30.0, 12.0};
constexpr double kSmoothing = 0.3;
constexpr int kPasses = 4;
constexpr int kMostPasses = 12;
constexpr int kStepsPerPass = 5;
constexpr double kSmoothEnough = 1e-2;  ///< Newton's decrement

class Builder {
 public:
  Builder(const MeasuredSeries& series, const std::vector<std::size_t>& loose, Watch& watch,
          Seam seam)
      : series_(series), loose_(loose), watch_(watch), seam_(seam) {
    tube_.closed = series.closed;
    tube_.origin = series.points.front();
  }

  SmoothTube run() {
    double spacing = series_.thin ? kSpacing : 0.0;
    source_ = spaced_points(spacing);
    while (!smooth()) {
      spacing *= 0.5;
      source_ = spaced_points(spacing);
    }
    const bool thin = series_.thin && series_.points.size() >= kFewestToThin;
    const std::vector<std::size_t> thinned = thin ? thinned_points() : source_;
    constexpr double kWorthwhile = 0.8;
    if (static_cast<double>(thinned.size()) < kWorthwhile * static_cast<double>(source_.size())) {
      const std::vector<std::size_t> all = source_;
      source_ = thinned;
      if (!smooth()) {
        source_ = all;
        smooth();
      }
    }
    if (series_.closed) begin_in_a_run();
    if (series_.primitives) set_primitives();
    if (knots_.size() > 1 && inside_) {
      set_sizes(tube_, x_);
      set_heading_ranges(tube_, x_);
    }
    SmoothTube out{std::move(tube_), std::move(x_), {}, {}, steps_, inside_, trouble_};
    for (const Knot& k : knots_) {
      out.source.push_back(k.first);
      out.last_source.push_back(k.last);
    }
    return out;
  }

 private:
  [[nodiscard]] Vec2 local(std::size_t i) const { return series_.points[i] - tube_.origin; }
  [[nodiscard]] bool given(std::size_t i) const {
    if (series_.reach[i] == 0.0) return true;
    if (series_.nodes.empty()) return false;
    return series_.nodes[i].theta || series_.nodes[i].kappa;
  }

  /// Points at least `least` (per point) apart, first and last (when open) and given ones included.
  template <class Least>
  std::vector<std::size_t> pick(const std::vector<std::size_t>& from, const Least& least) const {
    std::vector<std::size_t> out = {from.front()};
    for (std::size_t k = 1; k < from.size(); ++k) {
      const std::size_t i = from[k];
      const bool last = k + 1 == from.size() && !series_.closed;
      const double gap = norm(local(i) - local(out.back()));
      const bool far = gap >= std::max(least(out.back()), least(i));
      if (last && !far && out.size() > 1 && !given(out.back())) out.pop_back();
      if (far || last || given(i)) out.push_back(i);
    }
    const auto too_close = [&] {
      return norm(local(out.back()) - local(out.front())) < least(out.front()) &&
             !given(out.back());
    };
    while (series_.closed && out.size() > kFewestOnLoop && too_close()) out.pop_back();
    if (!series_.closed || out.size() >= kFewestOnLoop) return out;
    // the tolerances reach around the whole loop: three of its points all the same
    for (std::size_t k = 1; k < kFewestOnLoop; ++k) {
      out.push_back(from[k * from.size() / kFewestOnLoop]);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  std::vector<std::size_t> spaced_points(double spacing) const {
    std::vector<std::size_t> all(series_.points.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    return pick(all, [&](std::size_t i) { return spacing * series_.reach[i]; });
  }

  /// Nodes that the smoothed curvature says are enough.
  std::vector<std::size_t> thinned_points() const {
    const std::size_t n = tube_.nodes.size();
    std::vector<double> spacing(n, 0.0);
    double total = 0.0;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      total += norm(tube_.nodes[i + 1].point - tube_.nodes[i].point);
    }
    const auto kappa = [&](std::size_t i) {
      return std::abs(tube_.nodes[i].kappa + x_[kPerNode * i + 2] / tube_.nodes[i].length);
    };
    for (std::size_t i = 0; i < n; ++i) {
      double k = 0.0;
      for (std::size_t j = i > 2 ? i - 2 : 0; j < std::min(n, i + 3); ++j)
        k = std::max(k, kappa(j));
      const double by_sagitta = std::sqrt(8.0 * kSagitta * tube_.nodes[i].reach / k);
      spacing[i] = std::min({by_sagitta, kLargestLinkTurn / k, total / kFewestLinks});
      if (!(tube_.nodes[i].reach > 0.0)) spacing[i] = 0.0;
    }
    // neighbouring links of similar length: spacing grows no faster than the grading allows
    const double slope = 1.0 - 1.0 / kGrading;
    for (std::size_t i = 1; i < n; ++i) {
      const double gap = norm(tube_.nodes[i].point - tube_.nodes[i - 1].point);
      spacing[i] = std::min(spacing[i], spacing[i - 1] + slope * gap);
    }
    for (std::size_t i = n; i-- > 1;) {
      const double gap = norm(tube_.nodes[i].point - tube_.nodes[i - 1].point);
      spacing[i - 1] = std::min(spacing[i - 1], spacing[i] + slope * gap);
    }
    std::vector<double> at_point(series_.points.size(), 0.0);
    for (std::size_t i = 0; i < n; ++i) at_point[source_[i]] = spacing[i];
    return pick(source_, [&](std::size_t i) { return at_point[i]; });
  }

  /// A closed series is cut where its curvature changes fastest: far from any vertex.
  void begin_in_a_run() {
    const std::size_t n = source_.size();
    const auto kappa = [&](std::size_t i) {
      return tube_.nodes[i % n].kappa + x_[kPerNode * (i % n) + 2] / tube_.nodes[i % n].length;
    };
    const auto steepest = [&](std::size_t first, std::size_t last) {
      std::size_t best = first;
      for (std::size_t i = first + 1; i < last; ++i) {
        if (std::abs(kappa(i + 1) - kappa(i)) > std::abs(kappa(best + 1) - kappa(best))) best = i;
      }
      return best;
    };
    std::size_t best = steepest(0, n);
    if (seam_ == Seam::kElsewhere) best = steepest(best + n / 4, best + n - n / 4) % n;
    std::rotate(source_.begin(), source_.begin() + static_cast<std::ptrdiff_t>(best),
                source_.end());
    smooth();
  }

  /// A node to be: one point, or all points of a primitive.
  struct Knot {
    std::size_t first = 0, last = 0;  ///< indices into the series
    std::optional<Primitive> primitive;
  };

  /// Lines and arcs that the points mean become nodes; the points between stay as they are.
  void set_primitives() {
    std::vector<std::size_t> order = points_in_order();
    SmoothPoints smooth = smooth_points(order);
    std::vector<Primitive> found = series_.meant.empty()
                                       ? find_primitives(smooth, watch_)
                                       : fitted_primitives(smooth, meant_primitives(), watch_);
    if (found.empty()) return;
    if (series_.closed && found.front().first == 0 && found.front().last + 1 == order.size()) {
      const double turn =
          std::abs(found.front().kappa) * (found.front().before + found.front().after);
      if (turn < std::numbers::pi) return;  // a line, or a circle that would swing out to close
      // from the first of its points all round
      found.front().after = kFullTurn / std::abs(found.front().kappa) - found.front().before;
      knots_ = {{order.front(), order.back(), found.front()}};
      lay_nodes();
      return;
    }
    begin_at(found, order);
    std::vector<bool> is_node(series_.points.size(), false);
    for (const std::size_t i : source_) is_node[i] = true;
    knots_.clear();
    auto next = found.begin();
    bool joined = series_.closed && found.back().joined;  // the last one before: with the next
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (next != found.end() && next->first == k) {
        knots_.push_back({order[next->first], order[next->last], *next});
        k = next->last;
        joined = next->joined;
        ++next;
      } else if (is_node[order[k]] && (!joined || given(order[k]))) {
        knots_.push_back({order[k], order[k], std::nullopt});
      }
    }
    if (knots_.size() == 1) {
      lay_nodes();
      return;
    }
    inside_ = smooth_knots();
    if (!inside_) trouble_ = farthest_outside();
  }

  /// What is meant, by places in the order, which begins at the first node.
  [[nodiscard]] std::vector<Primitive> meant_primitives() const {
    const std::size_t n = series_.points.size();
    std::vector<Primitive> out;
    for (const MeantPiece& m : series_.meant) {
      Primitive p;
      p.first = (m.first + n - source_.front()) % n;
      p.last = p.first + (m.last - m.first);
      p.anchor = m.middle.point - tube_.origin;
      p.theta = m.middle.theta;
      p.kappa = m.middle.kappa;
      out.push_back(p);
    }
    std::sort(out.begin(), out.end(),
              [](const Primitive& a, const Primitive& b) { return a.first < b.first; });
    return out;
  }

  /// Rotates the order so that it begins with the first primitive, where that has points from over
  /// the seam, or its last one.
  static void begin_at(std::vector<Primitive>& found, std::vector<std::size_t>& order) {
    const std::size_t n = order.size(), begin = found.front().first % n;
    const bool over = found.front().last >= n || found.back().last >= n;
    if (!over) return;
    std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(begin), order.end());
    for (Primitive& p : found) {
      p.first = (p.first + n - begin) % n;
      p.last = (p.last + n - begin) % n;
    }
  }

  /// Node whose points, or those behind it, lie farthest from the curve, in their reaches.
  [[nodiscard]] std::size_t farthest_outside() {
    const std::vector<std::int8_t> no_direction(tube_.links(), 1);
    TubeModel model(tube_, no_direction, Cone::kClosedForm, kRateEnergy);
    const std::vector<double> use = model.node_uses(x_);
    return static_cast<std::size_t>(std::max_element(use.begin(), use.end()) - use.begin());
  }

  [[nodiscard]] std::vector<std::size_t> points_in_order() const {
    std::vector<std::size_t> order(series_.points.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      order[k] = (source_.front() + k) % order.size();
    }
    return order;
  }

  /// Points with the arc length and curvature of the smooth curve, linear between its nodes.
  [[nodiscard]] SmoothPoints smooth_points(const std::vector<std::size_t>& order) const {
    SmoothPoints out;
    out.closed = series_.closed;
    std::vector<std::size_t> node_of(series_.points.size(), series_.points.size());
    for (std::size_t i = 0; i < source_.size(); ++i) node_of[source_[i]] = i;
    std::size_t node = 0;
    for (const std::size_t i : order) {
      const Vec2 p = local(i);
      if (node_of[i] < source_.size()) node = node_of[i];
      const TubeNode& n = tube_.nodes[node];
      out.at.push_back(out.points.empty() ? 0.0 : out.at.back() + norm(p - out.points.back()));
      out.points.push_back(p);
      out.reach.push_back(series_.reach[i]);
      out.kappa.push_back(n.kappa + x_[kPerNode * node + 2] / n.length);
      out.free.push_back(!given(i) && std::find(loose_.begin(), loose_.end(), i) == loose_.end());
    }
    return out;
  }

  void lay_nodes() {
    if (knots_.size() == 1) {  // one circle or line through everything
      tube_.on_primitives.clear();
      tube_.nodes = {primitive_node(knots_.front())};
      tube_.rows.clear();
      tube_.first_row = {0};
      x_.assign(kPerNode, 0.0);
      return;
    }
    std::vector<Vec2> points;
    std::vector<std::size_t> place_of;  // of each knot, its first point
    if (series_.closed) points.push_back(local(knots_.back().last));
    for (const Knot& k : knots_) {
      place_of.push_back(points.size());
      points.push_back(local(k.first));
      if (k.primitive) points.push_back(local(k.last));
    }
    if (series_.closed) points.push_back(local(knots_.front().first));
    const std::vector<Chord> chords = measure_chords(points);
    const std::vector<AdjacentCircle> circles = measure_circles(points, chords);
    tube_.nodes.assign(knots_.size(), {});
    tube_.on_primitives.clear();
    for (std::size_t i = 0; i < knots_.size(); ++i) {
      if (knots_[i].primitive) {
        tube_.nodes[i] = primitive_node(knots_[i]);
        continue;
      }
      const std::size_t k = place_of[i];
      const bool last = k >= chords.size();
      TubeNode& node = tube_.nodes[i];
      node.point = points[k];
      node.theta =
          last ? chords[k - 1].omega + circles[k].eta_in : chords[k].omega - circles[k].eta_out;
      node.kappa = circles[k].kappa;
      node.length = 0.5 * (chords[k > 0 ? k - 1 : 0].length + chords[last ? k - 1 : k].length);
      give(node, knots_[i].first);
    }
    x_.assign(kPerNode * knots_.size(), 0.0);
  }

  TubeNode primitive_node(const Knot& knot) {
    const Primitive& p = *knot.primitive;
    TubeNode node;
    node.point = p.anchor;
    node.theta = p.theta;
    node.kappa = p.kappa;
    node.fix_kappa = p.kappa == 0.0;
    node.before = p.before;
    node.after = p.after;
    node.lead = p.lead;
    node.trail = p.trail;
    node.length = p.before + p.after;
    node.normal = left_normal(unit_at(node.theta));
    node.first_on = tube_.on_primitives.size();
    const std::size_t n = series_.points.size();
    const std::size_t to = knot.last >= knot.first ? knot.last : knot.last + n;
    const Vec3 none{};
    const PlacedNode fitted = place(node, none.data());
    for (std::size_t i = knot.first; i <= to; ++i) {
      double reach = series_.reach[i % n];
      node.reach = std::max(node.reach, reach);
      if (!series_.meant.empty()) {  // near the least squares
        const double off = circle_distance(node, fitted, local(i % n)).value;
        reach = std::min(reach, std::abs(off) + kRoomOfMeant * reach);
      }
      tube_.on_primitives.push_back({local(i % n), reach});
    }
    node.last_on = tube_.on_primitives.size();
    return node;
  }

  void give(TubeNode& node, std::size_t i) const {
    if (!series_.nodes.empty()) {
      const NodeData& d = series_.nodes[i];
      node.sign = d.curvature_sign;
      node.fix_theta = d.theta.has_value();
      node.fix_kappa = d.kappa.has_value();
      if (d.theta) node.theta = nearest_angle(*d.theta, node.theta);
      if (d.kappa) node.kappa = *d.kappa;
    }
    node.normal = left_normal(unit_at(node.theta));
    node.reach = series_.reach[i];
  }

  void lay_rows() {
    tube_.rows.clear();
    tube_.first_row.clear();
    const std::size_t links = tube_.links(), n = series_.points.size();
    for (std::size_t i = 0; i < links; ++i) {
      tube_.first_row.push_back(tube_.rows.size());
      const std::size_t from = knots_[i].last, next = knots_[(i + 1) % knots_.size()].first;
      const std::size_t to = next > from ? next : next + n;
      for (std::size_t k = from + 1; k < to; ++k) {
        tube_.rows.push_back({local(k % n), share_ * series_.reach[k % n]});
      }
    }
    tube_.first_row.push_back(tube_.rows.size());
  }

  /// The reference becomes the curve at x; offsets are measured along its normals.
  void relinearise() {
    std::vector<Vec2> at(tube_.nodes.size());
    for (std::size_t i = 0; i < tube_.nodes.size(); ++i) {
      TubeNode& node = tube_.nodes[i];
      double* x = &x_[kPerNode * i];
      at[i] = node.point + x[0] * node.reach * node.normal;
      node.theta += x[1];
      node.kappa += x[2] / node.length;
      x[1] = x[2] = 0.0;
      node.normal = left_normal(unit_at(node.theta));
      if (node.is_primitive()) continue;
      node.point = local(knots_[i].first);
      node.reach = series_.reach[knots_[i].first];
    }
    lay_rows();
    make_room_at_ends(tube_);
    for (std::size_t i = 0; i < tube_.nodes.size(); ++i) {
      const TubeNode& node = tube_.nodes[i];
      if (!(node.reach > 0.0)) continue;
      constexpr double kInside = 0.99;  // a turned normal may leave the circle by a hair
      const double offset = dot(at[i] - node.point, node.normal) / node.reach;
      x_[kPerNode * i] = std::clamp(offset, -kInside, kInside);
    }
  }

  /// Lays the tube and a smooth curve in it. False when the curve would not go through it.
  bool smooth() {
    knots_.clear();
    for (const std::size_t i : source_) knots_.push_back({i, i, std::nullopt});
    return smooth_knots();
  }

  /// Into the tube, which is made wider when that is not possible.
  bool enter(TubeModel& model, TubeSolver& solver) {
    if (solver.enter_tube(x_, kSmoothing)) return true;
    if (share_ == kTightShare) return false;
    share_ = kTightShare;
    for (TubeRow& row : tube_.rows) row.reach *= kTightShare / kModelShare;
    return model.tube_use(x_) < 1.0 || solver.enter_tube(x_, kSmoothing);
  }

  bool smooth_knots() {
    share_ = kModelShare;
    lay_nodes();
    lay_rows();
    const std::vector<std::int8_t> no_direction(tube_.links(), 1);
    for (int pass = 0; pass < kMostPasses; ++pass) {
      set_sizes(tube_, x_);
      TubeModel model(tube_, no_direction, Cone::kClosedForm, kRateEnergy);
      TubeSolver solver(model, watch_);
      bool inside = model.tube_use(x_) < 1.0;
      if (inside && pass >= kPasses) return true;
      if (inside) {
        solver.descend(x_, {kSmoothing, 0.0, 1.0}, kSmoothEnough, kStepsPerPass);
      } else {
        inside = enter(model, solver);
      }
      steps_ += solver.steps();
      if (!inside) return false;
      relinearise();
    }
    return tube_.rows.empty();
  }

  const MeasuredSeries& series_;
  Tube tube_;
  State x_;
  const std::vector<std::size_t>& loose_;
  Watch& watch_;
  Seam seam_;
  std::vector<std::size_t> source_;
  std::vector<Knot> knots_;
  double share_ = kModelShare;  ///< of their reach that points between nodes may use
  int steps_ = 0;
  bool inside_ = true;
  std::size_t trouble_ = 0;
};

}  // namespace

SmoothTube build_tube(const MeasuredSeries& series, const std::vector<std::size_t>& loose,
                      Watch& watch, Seam seam) {
  return Builder(series, loose, watch, seam).run();
}

void set_sizes(Tube& tube, const State& x) {
  const std::size_t n = tube.nodes.size(), links = tube.links();
  std::vector<double> at(links + 1, 0.0), kappa(links + 1);  // length of the links, curvature
  std::vector<double> gap(links);
  for (std::size_t i = 0; i <= links; ++i) {
    const std::size_t k = i % n;
    kappa[i] = tube.nodes[k].kappa + x[kPerNode * k + 2] / tube.nodes[k].length;
    if (i == links) break;
    const std::size_t next = (i + 1) % n;
    gap[i] = norm(place(tube.nodes[next], &x[kPerNode * next]).in.position -
                  place(tube.nodes[k], &x[kPerNode * k]).out.position);
    at[i + 1] = at[i] + gap[i];
  }
  tube.size.assign(links, 0.0);
  const auto rate = [&](std::size_t a, std::size_t b) {
    return std::abs((kappa[b] - kappa[a]) / (at[b] - at[a]));
  };
  for (std::size_t i = 0; i < links; ++i) {
    const std::size_t before = i > kRateReach ? i - kRateReach : 0;
    const std::size_t after = std::min(links, i + 1 + kRateReach);
    const double typical = std::max({rate(before, i + 1), rate(i, after), rate(before, after)});
    const TubeNode& a = tube.nodes[i];
    const TubeNode& b = tube.nodes[(i + 1) % n];
    const double hidden = kHiddenSize * std::max(a.reach, b.reach) / gap[i];
    constexpr double kSmallestSize = 1e-12;  // of a link in an exact straight or circular series
    tube.size[i] = std::max({typical * gap[i] * gap[i] / 3.0, hidden, kSmallestSize});
  }
}

}  // namespace obvid::fairing_detail
