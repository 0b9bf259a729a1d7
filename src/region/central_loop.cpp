// SPDX-License-Identifier: Apache-2.0
// Data in the middle of their ranges around a closed series: docs/methods/region.md.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/region/internal/feasible_data.h"
#include "range_middle.h"

namespace obvid {
namespace {

/// Headings that are tried when that in the middle of the range does not close.
constexpr int kHeadingTrials = 32;
constexpr int kEndHalvings = 30;
constexpr int kSharper = 60;  // doublings

using Wanted = std::vector<std::optional<double>>;
using Nodes = std::optional<std::vector<RangeNode>>;

/// One turn of the series as an open one, from the seam to the seam.
class LoopTurn {
 public:
  LoopTurn(const std::vector<RangeLink>& links, const std::vector<RangeNode>& nodes,
           const Wanted& wanted, Watch* watch)
      : n_(links.size()), all_links_(links), all_nodes_(nodes), all_wanted_(wanted), watch_(watch) {
    double turn = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      turn += turn_between(links[i].omega, links[(i + 1) % n_].omega);
    }
    turn_ = kFullTurn * std::round(turn / kFullTurn);
  }

  Nodes run() {
    if (n_ < 2 || !find_seam()) return std::nullopt;
    unroll();
    if (beside_arc(seam_) || open_behind()) return in_order(closed_by_itself());
    if (!choose_heading() || !choose_curvature()) return std::nullopt;
    return in_order(central());
  }

  bool closes_at_all() {
    if (n_ < 2 || !find_seam()) return false;
    unroll();
    if (beside_arc(seam_) || open_behind()) return central().has_value();
    const std::optional<double> kappa = sharpest();
    return some_heading_closes(kappa) && (kappa || choose_curvature());
  }

 private:
  [[nodiscard]] const RangeLink& before(std::size_t i) const {
    return all_links_[(i + n_ - 1) % n_];
  }
  [[nodiscard]] bool beside_arc(std::size_t i) const {
    return before(i).direction == 0 || all_links_[i].direction == 0;
  }
  [[nodiscard]] bool open_behind() const { return !before(seam_).direction; }

  /// Where one turn can be cut: data that are known, or a vertex.
  bool find_seam() {
    const auto first = [this](auto&& fits) {
      for (seam_ = 0; seam_ < n_ && !fits(seam_); ++seam_) {
      }
      return seam_ < n_;
    };
    return first([this](std::size_t i) { return beside_arc(i); }) ||
           first([this](std::size_t i) { return !before(i).direction; }) ||
           first([this](std::size_t i) { return before(i).direction != all_links_[i].direction; });
  }

  void unroll() {
    for (std::size_t k = 0; k <= n_; ++k) {
      const std::size_t i = (seam_ + k) % n_;
      const double turned = seam_ + k >= n_ ? turn_ : 0.0;
      if (k < n_) {
        links_.push_back(all_links_[i]);
        links_.back().omega += turned;
      }
      RangeNode node = all_nodes_[i];
      if (node.theta) *node.theta += turned;
      if (node.thetas)
        node.thetas = ValueRange{node.thetas->low + turned, node.thetas->high + turned};
      nodes_.push_back(node);
      if (!all_wanted_.empty()) wanted_.push_back(all_wanted_[i]);
    }
    // the node at the seam came a turn later at the end
    if (nodes_.front().theta) nodes_.back().theta = *nodes_.front().theta + turn_;
  }

  /// The seam has its data, or the link before it takes any.
  Nodes closed_by_itself() {
    auto made = central();
    if (made && open_behind()) {
      made->back() = made->front();
      if (made->back().theta) *made->back().theta += turn_;
    }
    return made;
  }

  [[nodiscard]] Nodes central() const {
    return central_data(links_, nodes_, wanted_, ChoiceOrder::kAlong, SharpCurvature::kMiddle,
                        watch_);
  }

  void fix(double theta, std::optional<double> kappa) {
    nodes_.front().theta = theta;
    nodes_.back().theta = theta + turn_;
    nodes_.front().kappa = nodes_.back().kappa = kappa;
  }
  bool closes(double theta, std::optional<double> kappa) {
    fix(theta, kappa);
    return central().has_value();
  }

  /// +1 where the curvature is greatest at the seam, -1 where it is least.
  [[nodiscard]] int peak() const { return before(seam_).direction.value_or(0); }

  /// The sharpest curvature that the seam may have, where that is finite.
  [[nodiscard]] std::optional<double> sharpest() const {
    const RangeNode& node = all_nodes_[seam_];
    if (node.kappa) return node.kappa;
    double limit = std::numeric_limits<double>::infinity();
    if (node.curvature_sign == -peak()) limit = 0.0;
    if (node.kappas) limit = std::min(limit, peak() > 0 ? node.kappas->high : -node.kappas->low);
    if (std::isinf(limit)) return std::nullopt;
    return peak() * limit;
  }

  /// Headings at the seam that the points on either side leave.
  [[nodiscard]] std::optional<ValueRange> headings_at_seam() const {
    const auto ranges = feasible_data(links_, nodes_, watch_);
    if (!ranges.front().heading || !ranges.back().heading) return std::nullopt;
    const double low = std::max(ranges.front().heading->low, ranges.back().heading->low - turn_);
    const double high = std::min(ranges.front().heading->high, ranges.back().heading->high - turn_);
    if (!(low < high)) return std::nullopt;
    return ValueRange{low, high};
  }

  std::optional<double> heading_that_closes(ValueRange among, std::optional<double> kappa) {
    const auto [low, high] = among;
    for (int k = 0; k < kHeadingTrials; ++k) {
      const double part = (k + 0.5) / kHeadingTrials;  // the first one: the middle
      const double theta = k == 0 ? 0.5 * (low + high) : low + part * (high - low);
      if (closes(theta, kappa)) return theta;
    }
    return std::nullopt;
  }

  /// A heading with which one turn closes stays fixed, with this curvature.
  bool some_heading_closes(std::optional<double> kappa) {
    if (const auto given = all_nodes_[seam_].theta) return closes(*given, kappa);
    const auto range = headings_at_seam();
    return range && heading_that_closes(*range, kappa);
  }

  bool choose_heading() {
    const std::optional<double> kappa = sharpest();
    if (const auto given = all_nodes_[seam_].theta) return closes(*given, kappa);
    const auto range = headings_at_seam();
    if (!range) return false;
    const auto found = heading_that_closes(*range, kappa);
    if (!found) return false;
    const double least = last_that_closes(*found, range->low, kappa);
    const double greatest = last_that_closes(*found, range->high, kappa);
    const double middle = 0.5 * (least + greatest);
    return closes(middle, kappa) || closes(*found, kappa);
  }

  double last_that_closes(double does, double end, std::optional<double> kappa) {
    for (int k = 0; k < kEndHalvings; ++k) {
      const double middle = 0.5 * (does + end);
      (closes(middle, kappa) ? does : end) = middle;
    }
    return does;
  }

  /// With the heading that was chosen: beyond the bluntest curvature every sharper one closes.
  bool choose_curvature() {
    const double theta = *nodes_.front().theta;
    if (all_nodes_[seam_].kappa) return closes(theta, all_nodes_[seam_].kappa);
    fix(theta, std::nullopt);
    const auto ranges = feasible_data(links_, nodes_, watch_);
    if (!ranges.front().kappa || !ranges.back().kappa) return false;
    const CurvatureRange both{std::max(ranges.front().kappa->low, ranges.back().kappa->low),
                              std::min(ranges.front().kappa->high, ranges.back().kappa->high)};
    if (!(both.low < both.high)) return false;
    auto bluntest = peak() > 0 ? both.low : both.high;
    double does = region_detail::middle_curvature(both);
    if (!closes(theta, does)) {
      const double limit = peak() > 0 ? both.high : both.low;
      for (int k = 0; k < kSharper && !closes(theta, does); ++k) {
        does = std::isinf(limit) ? bluntest + 2.0 * (does - bluntest) : 0.5 * (does + limit);
      }
      if (!closes(theta, does)) return false;
      double not_yet = region_detail::middle_curvature(both);
      for (int k = 0; k < kEndHalvings; ++k) {
        const double middle = 0.5 * (does + not_yet);
        (closes(theta, middle) ? does : not_yet) = middle;
      }
      bluntest = does;
    }
    CurvatureRange left = both;
    (peak() > 0 ? left.low : left.high) = bluntest;
    return closes(theta, region_detail::chosen_curvature(
                             left, wanted_.empty() ? std::nullopt : wanted_.front()));
  }

  [[nodiscard]] Nodes in_order(const Nodes& made) const {
    if (!made) return std::nullopt;
    std::vector<RangeNode> out(n_ + 1);
    for (std::size_t k = 0; k < n_; ++k) {
      RangeNode node = (*made)[k];
      const std::size_t i = (seam_ + k) % n_;
      if (seam_ + k >= n_ && node.theta) *node.theta -= turn_;
      out[i] = node;
    }
    out[n_] = out[0];
    if (out[n_].theta) *out[n_].theta += turn_;
    return out;
  }

  std::size_t n_;
  const std::vector<RangeLink>& all_links_;
  const std::vector<RangeNode>& all_nodes_;
  const Wanted& all_wanted_;
  Watch* watch_;
  double turn_ = 0.0;
  std::size_t seam_ = 0;
  std::vector<RangeLink> links_;
  std::vector<RangeNode> nodes_;
  Wanted wanted_;
};

}  // namespace

std::optional<std::vector<RangeNode>> central_loop(const std::vector<RangeLink>& links,
                                                   const std::vector<RangeNode>& nodes,
                                                   const Wanted& wanted, Watch* watch) {
  return LoopTurn(links, nodes, wanted, watch).run();
}

bool loop_closes(const std::vector<RangeLink>& links, const std::vector<RangeNode>& nodes,
                 Watch* watch) {
  return LoopTurn(links, nodes, {}, watch).closes_at_all();
}

}  // namespace obvid
