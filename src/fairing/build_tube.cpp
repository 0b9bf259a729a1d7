// SPDX-License-Identifier: Apache-2.0
#include "build_tube.h"

#include <algorithm>
#include <cmath>

#include "obvid/series/analysis.h"
#include "tube_solver.h"

namespace obvid::fairing_detail {
namespace {

/// Nodes lie at least this many tolerances apart: their offsets then turn a chord by at most
/// 2 / kSpacing rad.
constexpr double kSpacing = 8.0;
/// And so far that the height of the curve over its chord is at least this many tolerances: closer
/// nodes could not tell its curvature.
constexpr double kSagitta = 1.5;
constexpr double kLargestTurn = 0.5;      ///< rad over a link between thinned nodes
constexpr double kGrading = 1.5;          ///< largest ratio of neighbouring thinned links
constexpr std::size_t kFewestLinks = 24;  ///< thinning leaves at least so many

/// Size that the tolerance can hide, over (tolerance / chord).
constexpr double kHiddenSize = 0.05;
/// Links on each side over which the rate of curvature is averaged.
constexpr std::size_t kRateReach = 3;

/// int kappa'^2 of the quintic Hermite curve (docs/methods/fairing.md), and its weight against the
/// tube's barrier.
constexpr LinkEnergy kRateEnergy{24.0, -72.0, 84.0, 12.0};
constexpr double kSmoothing = 0.3;
constexpr int kPasses = 4;
constexpr int kMostPasses = 12;
constexpr int kStepsPerPass = 5;
constexpr double kSmoothEnough = 1e-2;  ///< Newton's decrement
constexpr double kRoom = 1.15;          ///< of a widened tube around its contents

class Builder {
 public:
  explicit Builder(const MeasuredSeries& series) : series_(series) {
    tube_.closed = series.closed;
    tube_.origin = series.points.front();
  }

  SmoothTube run() {
    double spacing = kSpacing;
    source_ = spaced_points(spacing);
    while (!smooth()) {
      spacing *= 0.5;
      source_ = spaced_points(spacing);
    }
    const std::vector<std::size_t> thinned = thinned_points();
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
    set_sizes(tube_, x_);
    return {std::move(tube_), std::move(x_), std::move(source_), steps_};
  }

 private:
  [[nodiscard]] Vec2 local(std::size_t i) const { return series_.points[i] - tube_.origin; }
  [[nodiscard]] bool given(std::size_t i) const {
    if (series_.nodes.empty()) return false;
    const NodeData& d = series_.nodes[i];
    return d.theta || d.kappa || series_.reach[i] == 0.0;
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
    while (series_.closed && out.size() > 3 && too_close()) out.pop_back();
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
      spacing[i] = std::min({by_sagitta, kLargestTurn / k, total / kFewestLinks});
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
    std::size_t best = 0;
    for (std::size_t i = 1; i < n; ++i) {
      if (std::abs(kappa(i + 1) - kappa(i)) > std::abs(kappa(best + 1) - kappa(best))) best = i;
    }
    std::rotate(source_.begin(), source_.begin() + static_cast<std::ptrdiff_t>(best),
                source_.end());
    smooth();
  }

  void lay_nodes() {
    const std::size_t n = source_.size();
    std::vector<Vec2> points;
    if (series_.closed) points.push_back(local(source_.back()));
    for (const std::size_t i : source_) points.push_back(local(i));
    if (series_.closed) points.push_back(local(source_.front()));
    const std::vector<Chord> chords = measure_chords(points);
    const std::vector<AdjacentCircle> circles = measure_circles(points, chords);
    const std::size_t shift = series_.closed ? 1 : 0;
    tube_.nodes.assign(n, {});
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t k = i + shift;
      const bool last = k >= chords.size();
      TubeNode& node = tube_.nodes[i];
      node.point = points[k];
      node.theta =
          last ? chords[k - 1].omega + circles[k].eta_in : chords[k].omega - circles[k].eta_out;
      node.kappa = circles[k].kappa;
      node.length = 0.5 * (chords[k > 0 ? k - 1 : 0].length + chords[last ? k - 1 : k].length);
      give(node, source_[i]);
    }
    x_.assign(kPerNode * n, 0.0);
  }

  void give(TubeNode& node, std::size_t i) const {
    if (!series_.nodes.empty()) {
      const NodeData& d = series_.nodes[i];
      node.sign = d.curvature_sign;
      node.fix_theta = d.theta.has_value();
      node.fix_kappa = d.kappa.has_value();
      if (d.theta) node.theta += std::remainder(*d.theta - node.theta, 2.0 * M_PI);
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
      const std::size_t next = source_[(i + 1) % source_.size()];
      const std::size_t to = next > source_[i] ? next : next + n;
      for (std::size_t k = source_[i] + 1; k < to; ++k) {
        tube_.rows.push_back({local(k % n), series_.reach[k % n]});
      }
    }
    tube_.first_row.push_back(tube_.rows.size());
  }

  /// The reference becomes the curve at x; offsets are measured along its normals.
  void relinearise() {
    for (std::size_t i = 0; i < tube_.nodes.size(); ++i) {
      TubeNode& node = tube_.nodes[i];
      double* x = &x_[kPerNode * i];
      const Vec2 moved = x[0] * node.reach * node.normal;
      node.theta += x[1];
      node.kappa += x[2] / node.length;
      x[1] = x[2] = 0.0;
      node.normal = left_normal(unit_at(node.theta));
      node.reach = series_.reach[source_[i]];
      if (node.reach > 0.0) {
        constexpr double kInside = 0.99;  // a turned normal may leave the circle by a hair
        x[0] = std::clamp(dot(moved, node.normal) / node.reach, -kInside, kInside);
      }
    }
  }

  /// Lays the tube and a smooth curve in it. False when the curve would not go through it.
  bool smooth() {
    lay_nodes();
    lay_rows();
    const std::vector<std::int8_t> no_direction(tube_.links(), 1);
    for (int pass = 0; pass < kMostPasses; ++pass) {
      set_sizes(tube_, x_);
      TubeModel model(tube_, no_direction, Cone::kClosedForm, kRateEnergy);
      const double use = model.tube_use(x_);
      const double scale = use < 1.0 ? 1.0 : kRoom * use;
      if (scale == 1.0 && pass >= kPasses) return true;
      model.set_reach_scale(scale);
      TubeSolver solver(model);
      solver.descend(x_, {kSmoothing, 0.0, 1.0}, kSmoothEnough, kStepsPerPass);
      steps_ += solver.steps();
      relinearise();
    }
    return tube_.rows.empty();
  }

  const MeasuredSeries& series_;
  Tube tube_;
  State x_;
  std::vector<std::size_t> source_;
  int steps_ = 0;
};

}  // namespace

SmoothTube build_tube(const MeasuredSeries& series) { return Builder(series).run(); }

void set_sizes(Tube& tube, const State& x) {
  const std::size_t n = tube.nodes.size(), links = tube.links();
  const auto position = [&](std::size_t i) {
    const TubeNode& node = tube.nodes[i];
    return node.point + x[kPerNode * i] * node.reach * node.normal;
  };
  std::vector<double> at(links + 1, 0.0), kappa(links + 1);  // arc length by chords, curvature
  std::vector<double> gap(links);
  for (std::size_t i = 0; i <= links; ++i) {
    const std::size_t k = i % n;
    kappa[i] = tube.nodes[k].kappa + x[kPerNode * k + 2] / tube.nodes[k].length;
    if (i == links) break;
    gap[i] = norm(position((i + 1) % n) - position(k));
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
