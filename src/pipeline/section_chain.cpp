// SPDX-License-Identifier: Apache-2.0
#include "section_chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "form.h"
#include "more_vertices.h"
#include "obvid/fairing/fairing.h"
#include "obvid/series/analysis.h"
#include "wandering.h"

namespace obvid::pipeline_detail {
namespace {

/// Points of a loop that are looked at beyond its seam, on both sides.
constexpr std::size_t kOverlap = 16;
/// Points taken off the ends of primitives beside which no transition fits.
constexpr int kMostTrims = 40;
/// Fewer points than this lie on one circle: there is nothing to choose.
constexpr std::size_t kFewestForFairing = 4;
/// Work of finding lines and arcs with room between them, in steps on every point, and for few
/// points.
constexpr double kPrimitiveSteps = 3000.0, kPrimitiveWork = 2e5;
/// Long chords that are named when the points leave open what happens over them.
constexpr std::size_t kMostGuesses = 3;
constexpr double kDegrees = 180.0 / std::numbers::pi;

std::vector<std::string> warn(const Analysis& a, const SeriesChain& chain) {
  std::vector<std::string> out;
  if (a.rounding_decided > 0) {
    out.push_back(
        "the rounding of the coordinates decides whether the curvature grows or falls on " +
        std::to_string(a.rounding_decided) + " segments, first between points " +
        std::to_string(a.first_rounding_decided + 1) + " and " +
        std::to_string(a.first_rounding_decided + 2) +
        "; vertices there come from the rounding, not from the curve");
  }
  if (chain.turned_directions > 0) {
    out.push_back(
        "no curve with the vertices of the adjacent circles runs through the points: the "
        "curvature was let turn back on " +
        std::to_string(chain.turned_directions) + " segments");
  }
  if (chain.unforced_inflection) {
    out.push_back("the contour needs an inflection that the adjacent circles do not show");
  }
  return out;
}

class SectionChooser {
 public:
  SectionChooser(const Prepared& series, const Section& section, Watch& watch)
      : series_(series), loop_(series.split.smooth_loop), watch_(watch) {
    // a loop's first place is its last one too
    const std::size_t last = loop_ ? series.points.size() - 1 : section.last;
    for (std::size_t k = section.first; k <= last; ++k) {
      index_.push_back(series.split.point_at(k));
      points_.push_back(series.points[index_.back()]);
    }
  }

  Result<SectionChain> run() {
    moves_ = std::any_of(index_.begin(), index_.end(),
                         [&](std::size_t i) { return series_.reach[i] > 0.0; });
    auto chain = moves_ && points_.size() >= kFewestForFairing ? within_tolerances()
                 : loop_                                      ? around_loop()
                                                              : through_points(points_, wishes());
    if (!chain) return fail(in_whole_series(chain.error()));
    if (!chain->converged) {
      out_.warnings.emplace_back(
          "the headings and curvatures are valid but not quite the fairest: the solver stopped at "
          "its limit of steps");
    }
    for (auto& source : chain->source) {
      if (source) source = index_[*source % index_.size()];
    }
    out_.chain = std::move(*chain);
    if (const auto sensible = judge_sense(); !sensible) return fail(sensible.error());
    return std::move(out_);
  }

 private:
  [[nodiscard]] Error in_whole_series(Error error) const {
    if (error.index >= 0 && static_cast<std::size_t>(error.index) < index_.size()) {
      error.index = static_cast<std::ptrdiff_t>(index_[static_cast<std::size_t>(error.index)]);
    }
    return error;
  }

  /// Refuses a chain that swings out between points; warns where the points leave it open.
  Result<void> judge_sense() {
    std::vector<double> reach;
    std::vector<bool> given;
    for (const auto& source : out_.chain.source) {
      reach.push_back(source ? series_.reach[*source] : 0.0);
      const bool fixed = source && !series_.fixed.empty() &&
                         (series_.fixed[*source].theta || series_.fixed[*source].kappa);
      given.push_back(fixed);
    }
    const Wandering found = find_wandering(out_.chain, reach, given, loop_);
    const auto range = [&](const WanderingPart& part) {
      return fmt::format("points {} to {}", *out_.chain.source[part.first] + 1,
                         *out_.chain.source[part.last] + 1);
    };
    if (!found.senseless.empty()) {
      const WanderingPart& worst =
          *std::max_element(found.senseless.begin(), found.senseless.end(),
                            [](const auto& a, const auto& b) { return a.beyond < b.beyond; });
      const auto index = static_cast<std::ptrdiff_t>(*out_.chain.source[worst.first]);
      return fail({ErrorCode::kWanders,
                   fmt::format("the contour would swing out by {:.0f} degrees more than the points "
                               "ask for",
                               worst.beyond * kDegrees),
                   range(worst), "mark corners there, or put points between them", index,
                   worst.beyond});
    }
    for (std::size_t k = 0; k < std::min(found.guessed.size(), kMostGuesses); ++k) {
      out_.warnings.push_back(fmt::format(
          "the points leave open what the contour does over the long chord from point {} to {}: it "
          "turns by {:.0f} degrees there; mark corners (--corner-at) if it should be straight",
          *out_.chain.source[found.guessed[k].first] + 1,
          *out_.chain.source[found.guessed[k].last] + 1, found.guessed[k].turn * kDegrees));
    }
    return {};
  }

  [[nodiscard]] ChainWishes wishes() const {
    ChainWishes out;
    out.convex = series_.convex;
    if (series_.fixed.empty()) return out;
    for (const std::size_t i : index_) out.fixed.push_back(series_.fixed[i]);
    return out;
  }

  Result<SeriesChain> through_points(const std::vector<Vec2>& points, const ChainWishes& wishes) {
    const auto analysis = analyse(points);
    if (!analysis) return tl::unexpected(analysis.error());
    auto chain = form_elements(points, *analysis, wishes, watch_);
    if (chain || moves_) {
      if (chain) out_.warnings = warn(*analysis, *chain);
      return chain;
    }
    // where the points alone have a curve, it is the given data that are in the way: more vertices
    // are not what somebody who gives a heading asks for
    if (chain.error().code == ErrorCode::kFixedDataContradict) return chain;
    auto mended = with_more_vertices(points, *analysis, wishes, watch_);
    if (!mended || bends_back(*mended)) return chain;
    out_.warnings = warn(*analysis, *mended);
    return mended;
  }

  /// Whether a link turns by half a turn, nearly: no shape that points ask for.
  static bool bends_back(const SeriesChain& chain) {
    constexpr double kMostOfLink = 179.0 / kDegrees;
    for (std::size_t k = 0; k + 1 < chain.elements.size(); ++k) {
      const Element &a = chain.elements[k], &b = chain.elements[k + 1];
      const Vec2 chord = b.point - a.point;
      const double turn = turning(chord, unit_at(b.theta)) - turning(chord, unit_at(a.theta));
      if (std::abs(turn) > kMostOfLink) return true;
    }
    return false;
  }

  /// One turn and some more as an open series; the turn from seam to seam is cut out of it and
  /// solved again with one element at both ends.
  Result<SeriesChain> around_loop() {
    const std::size_t n = points_.size(), overlap = std::min(n, kOverlap);
    std::vector<Vec2> unrolled;
    ChainWishes all = wishes(), more;
    more.convex = all.convex;
    for (std::size_t k = 0; k < n + 2 * overlap + 1; ++k) {
      const std::size_t i = (k + n - overlap) % n;
      unrolled.push_back(points_[i]);
      if (!all.fixed.empty()) more.fixed.push_back(all.fixed[i]);
    }
    auto chain = through_points(unrolled, more);
    if (!chain) return chain;
    DirectedSeries turn;
    for (std::size_t e = 0; e < chain->elements.size(); ++e) {
      const auto source = chain->source[e];
      const bool seam = source && (*source == overlap || *source == overlap + n);
      if (turn.points.empty() && !seam) continue;
      turn.points.push_back(chain->elements[e].point);
      turn.start.push_back(chain->elements[e]);
      turn.source.push_back(source ? std::optional((*source - overlap) % n) : std::nullopt);
      turn.nodes.emplace_back();
      if (source && !more.fixed.empty()) {
        turn.nodes.back().theta = more.fixed[*source].theta;
        turn.nodes.back().kappa = more.fixed[*source].kappa;
      }
      const bool arc_before = e > 0 && chain->cone[e - 1] == Cone::kNone;
      const bool arc_after = e < chain->cone.size() && chain->cone[e] == Cone::kNone;
      if (arc_before || arc_after) {
        turn.nodes.back().theta = chain->elements[e].theta;
        turn.nodes.back().kappa = chain->elements[e].kappa;
      }
      if (seam && turn.points.size() > 1) break;
      turn.direction.push_back(chain->cone[e] == Cone::kNone ? std::int8_t{0}
                                                             : chain->direction[e]);
    }
    return close_at_seam(std::move(turn));
  }

  /// Fixes the same element at both ends of one turn and solves it.
  Result<SeriesChain> close_at_seam(DirectedSeries turn) const {
    for (NodeData* end : {&turn.nodes.front(), &turn.nodes.back()}) {
      end->theta = turn.start.front().theta;
      end->kappa = turn.start.front().kappa;
    }
    return follow_directions(std::move(turn), watch_);
  }

  Result<SeriesChain> within_tolerances() {
    MeasuredSeries measured;
    measured.points = points_;
    measured.closed = loop_;
    measured.primitives = series_.primitives;
    measured.thin = series_.thin;
    for (const std::size_t i : index_) measured.reach.push_back(series_.reach[i]);
    give_nodes(measured);
    FairedSeries faired;
    if (auto chain = follow_runs(measured, faired)) return std::move(*chain);
    if (measured.primitives) {
      out_.warnings.emplace_back(
          "no contour was found that keeps the lines and arcs among the points: it is formed "
          "without "
          "them");
    }
    measured.primitives = false;
    measured.thin = false;
    if (auto chain = follow_runs(measured, faired)) return std::move(*chain);
    out_.warnings.emplace_back(
        "the points were moved within their tolerances onto a smooth curve, but runs of monotone "
        "curvature along it were not found; the contour runs through the moved points");
    return through_moved(faired);
  }

  /// Nothing when no runs were found, or no chain along them.
  std::optional<SeriesChain> follow_runs(MeasuredSeries& measured, FairedSeries& faired) {
    const double most =
        watch_.spent() + kPrimitiveWork + kPrimitiveSteps * static_cast<double>(points_.size());
    for (int k = 0; k < kMostTrims && (k == 0 || watch_.spent() < most); ++k) {
      const Stretch stretch = Stretch::next_of_many(watch_, measured.primitives ? k + 1 : 0);
      faired = fair(measured, watch_);
      if (!faired.feasible) return std::nullopt;
      auto chain = follow(faired, measured);
      if (chain) return std::move(*chain);
      const auto end = nearest_primitive_end(faired, static_cast<std::size_t>(chain.error().index));
      if (!end) return std::nullopt;
      measured.loose = faired.loose;
      measured.loose.push_back(*end);  // the transition beside the primitive needs more room
    }
    return std::nullopt;
  }

  void give_nodes(MeasuredSeries& measured) const {
    if (series_.fixed.empty() && !series_.convex) return;
    const int sign = series_.convex ? turning_sign() : 0;
    for (const std::size_t i : index_) {
      NodeData node;
      if (!series_.fixed.empty()) {
        node.theta = series_.fixed[i].theta;
        node.kappa = series_.fixed[i].kappa;
      }
      node.curvature_sign = sign;
      measured.nodes.push_back(node);
    }
  }

  /// The way in which the section turns as a whole.
  [[nodiscard]] int turning_sign() const {
    double turn = 0.0;
    for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
      turn += turning(points_[i] - points_[i - 1], points_[i + 1] - points_[i]);
    }
    return turn >= 0.0 ? 1 : -1;
  }

  [[nodiscard]] Result<SeriesChain> follow(const FairedSeries& faired,
                                           const MeasuredSeries& measured) const {
    DirectedSeries nodes;
    nodes.direction = faired.direction;
    nodes.start = faired.elements;
    nodes.source = faired.source;
    if (loop_) {
      nodes.start.push_back(faired.elements.front());
      nodes.source.push_back(faired.source.front());
    }
    for (std::size_t k = 0; k < nodes.start.size(); ++k) {
      nodes.points.push_back(nodes.start[k].point);
      const auto source = nodes.source[k];
      nodes.nodes.push_back(source && !measured.nodes.empty() ? measured.nodes[*source]
                                                              : NodeData{});
      const bool arc_before = k > 0 && nodes.direction[k - 1] == 0;
      const bool arc_after = k < nodes.direction.size() && nodes.direction[k] == 0;
      if (!arc_before && !arc_after) continue;
      nodes.nodes.back().theta = nodes.start[k].theta;
      nodes.nodes.back().kappa = nodes.start[k].kappa;
    }
    return loop_ ? close_at_seam(std::move(nodes)) : follow_directions(std::move(nodes), watch_);
  }

  /// Interpolates the moved points, each of which is within its tolerance.
  Result<SeriesChain> through_moved(const FairedSeries& faired) {
    std::vector<std::size_t> kept;
    std::vector<Vec2> moved;
    for (std::size_t k = 0; k < faired.elements.size(); ++k) {
      if (!faired.source[k]) continue;
      kept.push_back(*faired.source[k]);
      moved.push_back(faired.elements[k].point);
    }
    std::swap(points_, moved);
    const std::vector<std::size_t> whole = index_;
    std::vector<std::size_t> original;
    for (const std::size_t k : kept) original.push_back(whole[k]);
    index_ = original;
    return loop_ ? around_loop() : through_points(points_, wishes());
  }

  const Prepared& series_;
  bool loop_;
  bool moves_ = false;  ///< some point may be moved
  Watch& watch_;
  std::vector<std::size_t> index_;  // of each point in the whole series
  std::vector<Vec2> points_;
  SectionChain out_;
};

}  // namespace

Result<SectionChain> chain_section(const Prepared& series, const Section& section, Watch& watch) {
  return SectionChooser(series, section, watch).run();
}

}  // namespace obvid::pipeline_detail
