// SPDX-License-Identifier: Apache-2.0
#include "fit/section_chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "fit/aligned_lines.h"
#include "fit/edge_chain.h"
#include "fit/form.h"
#include "fit/given.h"
#include "fit/more_vertices.h"
#include "fit/series_ranges.h"
#include "fit/wandering.h"
#include "obvid/core/internal/figures.h"
#include "obvid/fairing/internal/fairing.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/geom/internal/circle.h"
#include "obvid/geom/internal/polygon.h"
#include "obvid/pipeline/internal/strays_text.h"
#include "obvid/series/analysis.h"
#include "obvid/series/internal/outliers.h"
#include "obvid/series/internal/scatter.h"

namespace obvid::pipeline_detail {
namespace {

/// Points of a loop that are looked at beyond its seam, on both sides.
constexpr std::size_t kOverlap = 16;
/// An arc that is a whole section comes in parts that turn by no more than this, rad.
constexpr double kMostTurnOfPart = 3.0;
/// Points taken off the ends of primitives beside which no transition fits.
constexpr int kMostTrims = 40;
/// Fewer points than this lie on one circle: there is nothing to choose.
constexpr std::size_t kFewestForFairing = 4;
/// Work of finding lines and arcs with room between them, in steps on every point, and for few
/// points.
constexpr double kPrimitiveSteps = 3000.0, kPrimitiveWork = 2e5;
/// Long chords that are named when the points leave open what happens over them.
constexpr std::size_t kMostGuesses = 3;
/// Headings that are held where the fairest chain swings out, and the work of finding them: in
/// steps on a point, beside a multiple of what the fairest chain took.
constexpr int kMostHeld = 3;
constexpr double kHoldWork = 1e6, kHoldFactor = 3.0;

/// `whole`: the numbers that the points of the analysis have in the series; a segment may be there
/// twice.
std::vector<std::string> warn(const Analysis& a, const SeriesChain& chain,
                              const std::vector<std::size_t>& whole) {
  std::vector<std::string> out;
  std::set<std::pair<std::size_t, std::size_t>> decided;  // by their points
  for (const std::size_t chord : a.rounding_decided) {
    decided.insert({whole[chord], whole[chord + 1]});
  }
  if (!decided.empty()) {
    out.push_back(fmt::format(
        "the rounding of the coordinates decides whether the curvature grows or falls on {}, first "
        "between points {} and {}; vertices there come from the rounding, not from the curve",
        counted(decided.size(), "segment", "segments"), decided.begin()->first + 1,
        decided.begin()->second + 1));
  }
  if (chain.turned_directions > 0) {
    out.push_back(
        "no curve with the vertices of the adjacent circles runs through the points: the "
        "curvature was let turn back on " +
        counted(static_cast<std::size_t>(chain.turned_directions), "piece", "pieces"));
  }
  if (chain.unforced_inflection) {
    out.push_back("the contour needs an inflection that the adjacent circles do not show");
  }
  return out;
}

/// The same error with the points that it is about numbered anew.
template <class Number>
Error renumbered(Error error, Number&& number) {
  if (error.index < 0) return error;
  const auto renumber = [&](std::ptrdiff_t i) {
    return i < 0 ? i : static_cast<std::ptrdiff_t>(number(static_cast<std::size_t>(i)));
  };
  error.index = renumber(error.index);
  error.last = renumber(error.last);
  if (error.where.starts_with("point") || error.where.starts_with("nodes ")) {
    error.where = error.last < 0 ? fmt::format("point {}", error.index + 1)
                                 : fmt::format("points {} to {}", error.index + 1, error.last + 1);
  }
  return error;
}

class SectionChooser {
 public:
  SectionChooser(const Prepared& series, const Section& section, Watch& watch)
      : series_(series), section_(section), loop_(series.split.smooth_loop), watch_(watch) {
    // a loop's first place is its last one too
    const std::size_t last = loop_ ? series.points.size() - 1 : section.last;
    for (std::size_t k = section.first; k <= last; ++k) {
      index_.push_back(series.split.point_at(k));
      points_.push_back(series.placed.empty() ? series.points[index_.back()]
                                              : series.placed[index_.back()]);
    }
    whole_ = series.whole_of(section);
    goes_on_ = series_.period && !series_.closed && points_.size() == series_.points.size();
  }

  Result<SectionChain> run() {
    const double before = watch_.spent();
    auto best = formed();
    if (!best) return best;
    Wandering found = wandering_of(best->chain);
    if (!found.senseless.empty()) {
      const Allowance allowance(watch_, kHoldWork + kHoldFactor * (watch_.spent() - before));
      for (int k = 0; k < kMostHeld && !found.senseless.empty(); ++k) {
        if (!hold_a_heading(*best, found)) break;
      }
    }
    if (!found.senseless.empty()) {
      const Error swings = swings_out(best->chain, worst_of(found));
      if (!best->at_the_edge && !turns_of_points_alone()) return fail(swings);
      best->warnings.push_back(
          fmt::format("{} ({}): it is what is given that asks for it, and no contour that does not "
                      "swing out was found",
                      swings.what, swings.where));
    }
    tell_held(*best);
    tell_guessed(*best, found);
    return best;
  }

 private:
  [[nodiscard]] Error in_whole_series(const Error& error) const {
    return renumbered(error, [this](std::size_t i) { return told(index_[i % index_.size()]); });
  }

  /// The measured point by which one is told.
  [[nodiscard]] std::size_t told(std::size_t i) const { return series_.named(i); }

  /// The fairest chain with the data that are given or held, inside their ranges: what leaves its
  /// range is held at the end that it passed, until nothing does. Where that leads nowhere, the
  /// chain in the middle of the ranges.
  Result<SectionChain> formed() {
    bounds_.clear();
    OBVID_TRY(prefer());
    auto chain = formed_once();
    std::size_t ranges = 0;
    for (const std::size_t i : index_) {
      const FixedData data = data_of(i);
      ranges += (data.thetas ? 1U : 0U) + (data.kappas ? 1U : 0U);
    }
    if (ranges == 0 || central_) return chain;
    std::size_t first = index_.front();
    const std::size_t turned = chain ? chain->chain.turned_directions : 0;
    for (std::size_t round = 0; chain && round <= ranges; ++round) {
      const auto passed = hold_at_ends(chain->chain);
      if (!passed) return chain;
      if (round == 0) first = *passed;
      chain = formed_once();
      // no vertex comes of what is held
      if (chain && chain->chain.turned_directions > turned) break;
    }
    if (!chain && bounds_.empty()) return chain;
    bounds_.clear();
    if (!moves_) {
      central_ = true;
      auto middle = formed_once();
      central_ = false;
      if (middle) return middle;
    }
    return error(ErrorCode::kFixedDataContradict,
                 "no monotone contour was found inside the ranges that are given")
        .where(fmt::format("first left at point {}", first + 1))
        .hint("widen the range there, or free others")
        .point(first);
  }

  /// What the user prefers beyond the fairest chain.
  Result<void> prefer() {
    central_ = series_.prefer == Prefer::kCentre;
    if (series_.prefer != Prefer::kLeastCurvature || cap_) return {};
    const auto analysis = analyse(points_);
    OBVID_TRY(analysis);
    const auto least = loop_ ? least_largest_curvature_of_loop(points_, constraints(), watch_)
                             : least_largest_curvature(*analysis, constraints(), watch_);
    if (!least) {
      return error(ErrorCode::kFixedDataContradict,
                   "what is given leaves no headings and curvatures with which a monotone contour "
                   "exists")
          .hint("free some of it")
          .point(index_.front());
    }
    cap_ = series_.above_least * *least;
    return {};
  }

  /// An end that a point passes, and how far: rad, or of the curvature.
  struct Passed {
    std::optional<double> end;
    double by = 0.0;
  };

  /// Holds what leaves its range at the end that it passed, of neighbours the one that passes it by
  /// most: the others may follow it. The first point where anything does; nothing when nothing
  /// does.
  std::optional<std::size_t> hold_at_ends(const SeriesChain& chain) {
    std::vector<std::size_t> points;
    std::vector<Passed> headings, kappas;
    for (std::size_t e = 0; e < chain.elements.size(); ++e) {
      if (!chain.source[e]) continue;
      const Element& here = chain.elements[e];
      const FixedData data = data_of(*chain.source[e]);
      points.push_back(*chain.source[e]);
      headings.emplace_back();
      kappas.emplace_back();
      if (data.thetas && !data.theta) {
        Passed& one = headings.back();
        one.end = passed_heading(*data.thetas, here.theta);
        if (one.end) one.by = std::abs(turn_between(*one.end, here.theta));
      }
      if (data.kappas && !data.kappa) {
        Passed& one = kappas.back();
        one.end = passed_end(*data.kappas, here.kappa);
        const double scale = one.end ? std::max(std::abs(*one.end), std::abs(here.kappa)) : 0.0;
        if (one.end) one.by = std::abs(here.kappa - *one.end) / scale;
      }
    }
    std::optional<std::size_t> first;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const bool heading = passes_most(headings, k), kappa = passes_most(kappas, k);
      if (!heading && !kappa) continue;
      FixedData& bound = bounds_[points[k]];
      if (heading) bound.theta = headings[k].end;
      if (kappa) bound.kappa = kappas[k].end;
      if (!first) first = points[k];
    }
    return first;
  }

  static bool passes_most(const std::vector<Passed>& all, std::size_t k) {
    if (!all[k].end) return false;
    const bool before = k == 0 || all[k].by >= all[k - 1].by;
    return before && (k + 1 == all.size() || all[k].by > all[k + 1].by);
  }

  Result<SectionChain> formed_once() {
    const auto points = points_;
    const auto index = index_;
    out_ = {};
    moves_ = std::any_of(index_.begin(), index_.end(),
                         [&](std::size_t i) { return series_.reach[i] > 0.0; });
    const auto whole = whole_chain();
    auto chain = whole ? Result<SeriesChain>(*whole)
                 : moves_ && points_.size() >= kFewestForFairing && !lies_on_one_circle()
                     ? within_tolerances()
                 : loop_ || (goes_on_ && !central_)
                     ? around_loop()
                     : through_points(points_, constraints(), index_);
    if (!chain) chain = fail(in_whole_series(chain.error()));
    if (chain) {
      for (auto& source : chain->source) {
        if (source) source = index_[*source % index_.size()];
      }
    }
    points_ = points;
    index_ = index;
    OBVID_TRY(chain);
    if (!chain->converged) {
      out_.warnings.emplace_back(
          "the headings and curvatures are valid but not quite the fairest: the solver stopped at "
          "its limit of steps");
    }
    out_.chain = std::move(*chain);
    return std::move(out_);
  }

  [[nodiscard]] Wandering wandering_of(const SeriesChain& chain) const {
    std::vector<double> reach;
    std::vector<bool> given;
    for (const auto& source : chain.source) {
      reach.push_back(source ? series_.reach[*source] : 0.0);
      const bool fixed = source && !series_.fixed.empty() && series_.fixed[*source].says_how();
      given.push_back(fixed);
    }
    Wandering out = find_wandering(chain, reach, given, loop_);
    const auto passes_others = [&](const WanderingPart& part) {
      return !follows(*chain.source[part.first], *chain.source[part.last]);
    };
    out.guessed.erase(std::remove_if(out.guessed.begin(), out.guessed.end(), passes_others),
                      out.guessed.end());
    return out;
  }

  /// Whether no point of the section lies between two.
  [[nodiscard]] bool follows(std::size_t before, std::size_t after) const {
    const auto at = std::find(index_.begin(), index_.end(), before);
    if (at == index_.end()) return false;
    const auto next = std::next(at);
    return (next == index_.end() ? index_.front() : *next) == after;
  }

  /// Where something is given: turns of the contour that the points have without it. Nothing where
  /// every such contour swings out, or nothing is given.
  const std::optional<ChainTurns>& turns_of_points_alone() {
    if (turns_alone_known_ || series_.fixed.empty()) return turns_alone_;
    turns_alone_known_ = true;
    Prepared free = series_;
    free.fixed.clear();
    const auto alone = SectionChooser(free, section_, watch_).run();
    if (alone) turns_alone_ = turns_of_chain(alone->chain);
    return turns_alone_;
  }

  static const WanderingPart& worst_of(const Wandering& found) {
    return *std::max_element(found.senseless.begin(), found.senseless.end(),
                             [](const auto& a, const auto& b) { return a.beyond < b.beyond; });
  }

  /// A heading that is held, and what it leads to.
  struct Held {
    std::size_t point = 0;
    double heading = 0.0;
    SectionChain formed;
    Wandering found;

    /// Nothing swings out, and no more pieces turn back than before.
    [[nodiscard]] bool mends(const SectionChain& before) const {
      return found.senseless.empty() &&
             formed.chain.turned_directions <= before.chain.turned_directions;
    }
    [[nodiscard]] bool better_than(const Held& other) const {
      return std::pair(found.senseless.size(), formed.chain.turned_directions) <
             std::pair(other.found.senseless.size(), other.formed.chain.turned_directions);
    }
  };

  /// The fairest chain swings out: a heading that does not is held at one end of the worst part.
  /// False when that mends nothing.
  bool hold_a_heading(SectionChain& best, Wandering& found) {
    std::optional<Held> calmest;
    const WanderingPart worst = worst_of(found);
    for (const std::size_t e : {worst.first, worst.last}) {
      const std::size_t i = *best.chain.source[e];
      if (free_to_hold(i)) try_headings(i, best, calmest);
    }
    if (!calmest || calmest->found.senseless.size() >= found.senseless.size()) return false;
    const ChainTurns turns = turns_of_chain(calmest->formed.chain);
    if (turns.more_than(turns_of_chain(best.chain))) {
      // what is given is met without more vertices than the points ask for: none come of what is
      // held
      const auto& alone = turns_of_points_alone();
      if (alone && turns.more_than(*alone)) return false;
    }
    held_[calmest->point] = calmest->heading;
    best = std::move(calmest->formed);
    found = std::move(calmest->found);
    return true;
  }

  void try_headings(std::size_t i, const SectionChain& before, std::optional<Held>& calmest) {
    const auto around = neighbours(i);
    if (!around) return;
    for (const double heading : calm_headings(series_.points[around->first], series_.points[i],
                                              series_.points[around->second])) {
      if ((calmest && calmest->mends(before)) || !watch_.may_go_on()) return;
      held_[i] = heading;
      auto calmer = formed();
      held_.erase(i);
      if (!calmer) continue;
      Held now{i, heading, std::move(*calmer), {}};
      now.found = wandering_of(now.formed.chain);
      if (!calmest || now.better_than(*calmest)) calmest = std::move(now);
    }
  }

  [[nodiscard]] bool free_to_hold(std::size_t i) const {
    if (held_.count(i) > 0) return false;
    return series_.fixed.empty() || !series_.fixed[i].says_how();
  }

  /// Points before and after one of the section.
  [[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> neighbours(std::size_t i) const {
    const auto at = std::find(index_.begin(), index_.end(), i);
    const std::size_t n = index_.size(), k = static_cast<std::size_t>(at - index_.begin());
    if (k >= n || (!loop_ && (k == 0 || k + 1 == n))) return std::nullopt;
    return std::pair(index_[(k + n - 1) % n], index_[(k + 1) % n]);
  }

  [[nodiscard]] std::string range(const SeriesChain& chain, const WanderingPart& part) const {
    return fmt::format("{} to {}", told(*chain.source[part.first]) + 1,
                       told(*chain.source[part.last]) + 1);
  }

  [[nodiscard]] Error swings_out(const SeriesChain& chain, const WanderingPart& worst) const {
    return error(ErrorCode::kWanders,
                 fmt::format(
                     "the contour would swing out by {:.0f} degrees more than the points ask for",
                     worst.beyond / kOneDegree))
        .where("points " + range(chain, worst))
        .hint("mark corners there, or put points between them")
        .point(told(*chain.source[worst.first]))
        .value(worst.beyond);
  }

  void tell_held(SectionChain& best) const {
    for (const auto& [point, heading] : held_) {
      best.warnings.push_back(
          fmt::format("the fairest contour would swing out beside point {}: its heading there was "
                      "held at {:.4g} "
                      "degrees; --heading-at gives another",
                      point + 1, principal_degrees(heading)));
    }
  }

  /// Where the points leave open what the contour does.
  void tell_guessed(SectionChain& best, const Wandering& found) const {
    for (std::size_t k = 0; k < std::min(found.guessed.size(), kMostGuesses); ++k) {
      best.warnings.push_back(fmt::format(
          "the points leave open what the contour does over the long chord from point {}: it "
          "turns by {:.0f} degrees there; mark corners (--corner-at) if it should be straight",
          range(best.chain, found.guessed[k]), found.guessed[k].turn / kOneDegree));
    }
  }

  /// Data of a point: as they are given, and the heading that is held.
  [[nodiscard]] FixedData data_of(std::size_t i) const {
    FixedData out = series_.fixed.empty() ? FixedData{} : series_.fixed[i];
    if (const auto held = held_.find(i); held != held_.end()) out.theta = held->second;
    if (cap_) out.kappas = common(out.kappas.value_or(ValueRange{}), ValueRange{-*cap_, *cap_});
    if (const auto bound = bounds_.find(i); bound != bounds_.end()) {
      if (bound->second.theta) out.theta = bound->second.theta;
      if (bound->second.kappa) out.kappa = bound->second.kappa;
    }
    return out;
  }
  [[nodiscard]] bool has_data() const {
    return !series_.fixed.empty() || !held_.empty() || cap_.has_value();
  }

  [[nodiscard]] ChainConstraints constraints() const {
    ChainConstraints out;
    out.convex = series_.convex;
    out.least_change = series_.prefer == Prefer::kLeastChange;
    out.central = central_;
    out.to_the_edge = (!series_.fixed.empty() || cap_) && held_.empty();
    if (!has_data()) return out;
    for (const std::size_t i : index_) out.fixed.push_back(data_of(i));
    return out;
  }

  /// `whole`: the numbers of the points in the whole series.
  Result<SeriesChain> through_points(const std::vector<Vec2>& points,
                                     const ChainConstraints& constraints,
                                     const std::vector<std::size_t>& whole) {
    const auto analysis = analyse(points);
    OBVID_TRY(analysis);
    std::vector<std::size_t> names;
    for (const std::size_t i : whole) names.push_back(told(i));
    auto chain = form_elements(points, *analysis, constraints, watch_);
    if (!moves_ && constraints.to_the_edge && !constraints.central) {
      if (auto found = at_the_edge(points, *analysis, constraints, chain)) {
        chain = std::move(*found);
        out_.at_the_edge = true;
      }
    }
    if (chain || moves_) {
      if (chain) tell(warn(*analysis, *chain, names));
      return chain;
    }
    // where the points alone have a curve, it is the given data that are in the way: more vertices
    // are not what somebody who gives a heading asks for
    if (chain.error().code == ErrorCode::kFixedDataContradict) return chain;
    auto mended = with_more_vertices(points, *analysis, constraints, watch_);
    if (!mended || bends_back(*mended)) return chain;
    tell(warn(*analysis, *mended, names));
    return mended;
  }

  void tell(std::vector<std::string> more) {
    std::move(more.begin(), more.end(), std::back_inserter(out_.warnings));
  }

  /// Near an end of what the points leave to given data: the chain that is proved there, where the
  /// one that was found is not, has more vertices or inflections than the points ask for, or where
  /// none was found. Nothing when there is none.
  std::optional<SeriesChain> at_the_edge(const std::vector<Vec2>& points, const Analysis& analysis,
                                         const ChainConstraints& constraints,
                                         const Result<SeriesChain>& found) {
    const bool proved = found && proved_as_stored(points, *found);
    if (proved && found->turned_directions == 0 && !found->unforced_inflection) return std::nullopt;
    ChainConstraints none = constraints;
    none.fixed.clear();
    none.to_the_edge = false;
    auto free = form_elements(points, analysis, none, watch_);
    if (!free) free = with_more_vertices(points, analysis, none, watch_);
    // many points of one circle or line leave nothing to given data, near no end either
    if (free && !is_few_on_one_circle(points, analysis) &&
        std::all_of(free->cone.begin(), free->cone.end(),
                    [](Cone cone) { return cone == Cone::kNone; })) {
      return std::nullopt;
    }
    if (proved && (!free || !turns_of_chain(*found).more_than(turns_of_chain(*free)))) {
      return std::nullopt;
    }
    auto edge = edge_chain(points, analysis, constraints, free ? &*free : nullptr, watch_);
    if (proved && edge && !turns_of_chain(*found).more_than(turns_of_chain(*edge))) {
      return std::nullopt;
    }
    return edge;
  }

  /// Whether a link turns by half a turn, nearly: no shape that points ask for.
  static bool bends_back(const SeriesChain& chain) {
    constexpr double kMostOfLink = 179.0 * kOneDegree;
    for (std::size_t k = 0; k + 1 < chain.elements.size(); ++k) {
      const Element &a = chain.elements[k], &b = chain.elements[k + 1];
      const Vec2 chord = b.point - a.point;
      const double turn = turning(chord, unit_at(b.theta)) - turning(chord, unit_at(a.theta));
      if (std::abs(turn) > kMostOfLink) return true;
    }
    return false;
  }

  /// Points of one turn, the last one not counted where it is the first one again.
  [[nodiscard]] std::size_t points_of_turn() const {
    return goes_on_ ? points_.size() - 1 : points_.size();
  }
  [[nodiscard]] std::size_t overlap() const { return std::min(points_of_turn(), kOverlap); }

  /// Point k of one turn and some more on both sides.
  [[nodiscard]] Vec2 unrolled_point(std::size_t k) const {
    const std::size_t n = points_of_turn(), at = k + n - overlap();
    if (!goes_on_) return points_[at % n];
    return points_[at % n] + (static_cast<double>(at / n) - 1.0) * *series_.period;
  }

  /// Place of an unrolled point in the series.
  [[nodiscard]] std::size_t place_of(std::size_t k) const {
    return goes_on_ ? k - overlap() : (k - overlap()) % points_of_turn();
  }

  /// One turn and some more as an open series; the turn from seam to seam is cut out of it and
  /// solved again with one element at both ends.
  Result<SeriesChain> around_loop() {
    const std::size_t n = points_of_turn(), overlap = this->overlap();
    std::vector<Vec2> unrolled;
    std::vector<std::size_t> whole;
    ChainConstraints all = constraints(), more;
    if (all.central) return central_turn(all);
    more.convex = all.convex;
    more.to_the_edge = all.to_the_edge;
    more.least_change = all.least_change;
    for (std::size_t k = 0; k < n + 2 * overlap + 1; ++k) {
      const std::size_t i = (k + n - overlap) % n;
      unrolled.push_back(unrolled_point(k));
      whole.push_back(index_[i]);
      if (!all.fixed.empty()) more.fixed.push_back(all.fixed[i]);
    }
    auto chain = through_points(unrolled, more, whole);
    if (!chain) {
      return fail(renumbered(chain.error(), [&](std::size_t k) { return (k + n - overlap) % n; }));
    }
    DirectedSeries turn;
    for (std::size_t e = 0; e < chain->elements.size(); ++e) {
      const auto source = chain->source[e];
      const bool seam = source && (*source == overlap || *source == overlap + n);
      if (turn.points.empty() && !seam) continue;
      turn.points.push_back(chain->elements[e].point);
      turn.start.push_back(chain->elements[e]);
      turn.source.push_back(source ? std::optional(place_of(*source)) : std::nullopt);
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
    const auto source = turn.source;
    auto closed = close_at_seam(std::move(turn));
    if (closed) return closed;
    // the point at or before a node; behind elements that the search put in, numbers run on
    Error error = renumbered(closed.error(), [&](std::size_t node) {
      node = std::min(node, source.size() - 1);
      while (!source[node] && node > 0) --node;
      return source[node].value_or(0);
    });
    return fail(std::move(error));
  }

  Result<SeriesChain> central_turn(const ChainConstraints& all) const {
    if (auto central = central_chain_of_loop(points_, all, watch_)) return std::move(*central);
    return error(ErrorCode::kFixedDataContradict,
                 "no closed monotone contour has headings and curvatures in the middle of what is "
                 "left")
        .hint("free some of what is given, or leave the choice to the program")
        .point(0);
  }

  /// Fixes the same element at both ends of one turn and solves it.
  Result<SeriesChain> close_at_seam(DirectedSeries turn) {
    out_.seam = turn.nodes.front();
    for (NodeData* end : {&turn.nodes.front(), &turn.nodes.back()}) {
      end->theta = turn.start.front().theta;
      end->kappa = turn.start.front().kappa;
    }
    return follow_directions(std::move(turn), watch_);
  }

  Result<SeriesChain> within_tolerances() {
    MeasuredSeries measured;
    measured.closed = loop_;
    measured.primitives = series_.primitives;
    measured.thin = series_.thin;
    std::vector<std::size_t> whole = index_;
    measured.points = points_;
    if (goes_on_) {
      whole.clear();
      measured.points.clear();
      const std::size_t n = points_of_turn();
      for (std::size_t k = 0; k < n + 2 * overlap() + 1; ++k) {
        whole.push_back(index_[(k + n - overlap()) % n]);
        measured.points.push_back(unrolled_point(k));
      }
    }
    for (const std::size_t i : whole) measured.reach.push_back(series_.reach[i]);
    measured.loose = loose_among(whole);
    give_nodes(measured, whole, series_.convex);
    if (auto circle = whole_circle(measured)) return std::move(*circle);
    FairedSeries faired;
    auto chain = runs_of_least_bends(measured, whole, faired);
    std::vector<MeantPiece> meant;
    if (measured.primitives && !(chain && is_all_primitives(faired))) {
      meant = keep_meant(measured, whole, chain, faired);
    }
    if (chain) {
      if (measured.primitives) tell_primitives(faired, meant);
      return std::move(*chain);
    }
    if (measured.primitives) {
      out_.lacks_some = true;
      out_.warnings.push_back(
          "no contour was found that keeps the lines and arcs among the points: it is formed "
          "without them" +
          strays_text());
    }
    const bool searched = is_node_each(faired, measured.points.size());
    measured.primitives = false;
    measured.thin = false;
    if (!searched) {
      if (auto thick = follow_runs(measured, faired)) return std::move(*thick);
    }
    if (goes_on_) return around_loop();
    out_.warnings.emplace_back(
        "the points were moved within their tolerances onto a smooth curve, but runs of monotone "
        "curvature along it were not found; the contour runs through the moved points");
    return through_moved(faired);
  }

  /// Places of points that lie on no line and no arc.
  [[nodiscard]] std::vector<std::size_t> loose_among(const std::vector<std::size_t>& whole) const {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < whole.size(); ++k) {
      if (series_.taken_back.is_loose(whole[k])) out.push_back(k);
    }
    return out;
  }

  /// `follow_runs`, with bends one way only where that takes no more runs.
  std::optional<SeriesChain> runs_of_least_bends(MeasuredSeries measured,
                                                 const std::vector<std::size_t>& whole,
                                                 FairedSeries& faired) {
    auto chain = follow_runs(measured, faired);
    if (!chain || !bends_without_need(*chain)) return chain;
    give_nodes(measured, whole, true);
    FairedSeries one_way;
    auto convex = follow_runs(measured, one_way);
    if (convex && runs_of(*convex) <= runs_of(*chain) && one_way.primitives >= faired.primitives) {
      chain = std::move(convex);
      faired = std::move(one_way);
    }
    return chain;
  }

  /// Whether there are lines and arcs, with one transition between neighbours and nothing else.
  [[nodiscard]] bool is_all_primitives(const FairedSeries& faired) const {
    const auto between = std::count_if(faired.direction.begin(), faired.direction.end(),
                                       [](int d) { return d != 0; });
    return faired.given_up == 0 && faired.primitives > 0 &&
           between <= faired.primitives - (loop_ ? 0 : 1);
  }

  /// Where the points mean lines and arcs alone and another chain has more of their points on them,
  /// that one takes the place of `chain`. What they mean.
  std::vector<MeantPiece> keep_meant(MeasuredSeries measured, const std::vector<std::size_t>& whole,
                                     std::optional<SeriesChain>& chain, FairedSeries& faired) {
    if (goes_on_ || series_.part < 1.0) return {};
    measured.loose = loose_among(whole);
    measured.meant = aligned_lines(measured, middle_deviation(series_.points), watch_);
    const std::size_t had = chain ? points_kept(faired, measured.meant) : 0;
    if (measured.meant.empty()) return {};
    FairedSeries more;
    auto other = runs_of_least_bends(measured, whole, more);
    if (other && points_kept(more, measured.meant) > had) {
      chain = std::move(other);
      faired = std::move(more);
    }
    return measured.meant;
  }

  /// The line or arc that the section is, from end to end.
  std::optional<SeriesChain> whole_chain() {
    if (!whole_) return std::nullopt;
    FairedSeries faired;
    const Element& start = whole_->start;
    const int parts =
        std::max(1, static_cast<int>(std::ceil(std::abs(whole_->turn) / kMostTurnOfPart)));
    for (int k = 0; k <= parts; ++k) {
      const double turn = whole_->turn * k / parts;
      const Vec2 chord =
          (2.0 * std::sin(0.5 * turn) / start.kappa) * unit_at(start.theta + 0.5 * turn);
      faired.elements.push_back({start.point + chord, start.theta + turn, start.kappa});
      faired.source.emplace_back();
      if (k > 0) faired.direction.push_back(0);
    }
    faired.elements.front() = start;
    faired.elements.back() = whole_->end;
    faired.source.front() = 0;
    faired.source.back() = points_.size() - 1;
    auto chain = follow(faired, {});
    return chain ? std::optional(std::move(*chain)) : std::nullopt;
  }

  /// Of a loop whose points lie within their tolerances of one circle, which has no vertex.
  std::optional<SeriesChain> whole_circle(MeasuredSeries measured) {
    if (!loop_ || has_data() || !are_near_circle_of_squares(measured.points, measured.reach)) {
      return std::nullopt;
    }
    measured.primitives = true;
    FairedSeries faired;
    auto chain = follow_runs(measured, faired);
    const bool whole =
        chain && faired.primitives == 1 &&
        std::all_of(chain->direction.begin(), chain->direction.end(), [](int d) { return d == 0; });
    if (whole) return chain;
    auto circle = follow(around_circle(*circle_of_squares(measured.points)), measured);
    return circle ? std::optional(std::move(*circle)) : std::nullopt;
  }

  /// Once around, from the place of the first point, the way the points go.
  [[nodiscard]] FairedSeries around_circle(const LeastSquaresCircle& circle) const {
    const Vec2 from = points_.front() - circle.centre;
    const double side = std::copysign(1.0, area_of_polygon(points_));
    const int parts = static_cast<int>(std::ceil(kFullTurn / kMostTurnOfPart));
    FairedSeries out;
    out.primitives = 1;
    for (int k = 0; k < parts; ++k) {
      const double angle = std::atan2(from.y, from.x) + side * kFullTurn * k / parts;
      out.elements.push_back({circle.centre + circle.radius * unit_at(angle),
                              angle + side * 0.5 * std::numbers::pi, side / circle.radius});
      out.source.emplace_back();
      out.direction.push_back(0);
    }
    out.source.front() = 0;
    return out;
  }

  void tell_primitives(const FairedSeries& faired, const std::vector<MeantPiece>& meant) {
    out_.missing = missing_pieces(faired, meant);
    out_.lacks_some = !out_.missing.empty() || !is_all_primitives(faired);
    if (!out_.missing.empty()) {
      out_.strays = strays_text();
    } else if (meant.empty() && faired.given_up > 0) {
      out_.given_up = static_cast<std::size_t>(faired.given_up);
      out_.strays = strays_text();
    } else if (faired.primitives == 0) {
      if (!series_.taken_back.loose.empty()) return;  // that is told
      out_.is_bare = series_.split.sections.size() > 1;
      if (!out_.is_bare) out_.warnings.push_back(no_primitives_text() + strays_text());
    } else if (!is_all_primitives(faired)) {
      if (const std::string strays = strays_text(); !strays.empty()) {
        out_.warnings.push_back("lines and arcs do not follow one another everywhere" + strays);
      }
    }
  }

  /// Single points that break rows of a line or an arc, and what to do about them; empty: none.
  [[nodiscard]] std::string strays_text() const {
    const auto strays = outliers_of(points_);
    if (!strays || strays->points.empty()) return {};
    std::vector<std::size_t> numbers;
    for (const Outlier& one : strays->points) numbers.push_back(told(index_[one.index]) + 1);
    return "; " + pipeline_detail::strays_text(numbers);
  }

  /// What the points mean and the contour does not have.
  [[nodiscard]] std::vector<MissingPiece> missing_pieces(
      const FairedSeries& faired, const std::vector<MeantPiece>& meant) const {
    std::vector<MissingPiece> missing;
    const std::size_t n = points_.size();
    const bool all =
        !loop_ && meant.size() == 1 && meant.front().first <= 1 && meant.front().last + 2 >= n;
    for (const MeantPiece& m : meant) {
      if (2 * points_kept(faired, {m}) > m.last - m.first || is_taken_back(m)) continue;
      missing.push_back(
          {fmt::format("{} (points {}-{})", shape_name(m), told(index_[m.first % n]) + 1,
                       told(index_[m.last % n]) + 1),
           m.last - m.first + 1,
           !all ? "no transitions beside them were found that stay within the tolerance; `obvid "
                  "alignment` has them, with steps of the curvature"
           : has_data() ? "none that has all points within their tolerances and what is given was "
                          "found"
                        : "none that has all points within their tolerances was found"});
    }
    return missing;
  }

  /// An arc that bends by less than its points may be off may as well be a line.
  [[nodiscard]] std::string shape_name(const MeantPiece& m) const {
    const double kappa = std::abs(m.middle.kappa);
    if (kappa == 0.0) return "a line";
    const std::size_t n = points_.size();
    const Vec2 chord = points_[m.last % n] - points_[m.first % n];
    double reach = 0.0;
    for (std::size_t i = m.first; i <= m.last; ++i) {
      reach = std::max(reach, series_.reach[index_[i % n]]);
    }
    if (kappa * dot(chord, chord) / 8.0 < reach) return "a nearly straight stretch";
    return fmt::format("an arc of radius {:.4g}", 1.0 / kappa);
  }

  /// Whether most of its points lie on no line and no arc: that is told elsewhere.
  [[nodiscard]] bool is_taken_back(const MeantPiece& meant) const {
    std::size_t loose = 0;
    for (std::size_t i = meant.first; i <= meant.last; ++i) {
      loose += series_.taken_back.is_loose(index_[i % index_.size()]) ? 1 : 0;
    }
    return 2 * loose > meant.last - meant.first;
  }

  /// Points of lines and arcs that are meant which lie on one of the contour.
  [[nodiscard]] std::size_t points_kept(const FairedSeries& faired,
                                        const std::vector<MeantPiece>& meant) const {
    std::size_t count = 0;
    for (const MeantPiece& m : meant) {
      for (std::size_t i = m.first; i <= m.last; ++i) {
        count += is_on_primitive(faired, i % points_.size()) ? 1 : 0;
      }
    }
    return count;
  }

  /// Whether point i lies between the first and last point of a line or arc of the contour.
  [[nodiscard]] bool is_on_primitive(const FairedSeries& faired, std::size_t i) const {
    const std::size_t n = points_.size(), elements = faired.source.size();
    std::size_t first = n;  // none
    // twice around: a run of exact pieces may begin before the first element of a loop
    for (std::size_t k = 0; k < 2 * faired.direction.size(); ++k) {
      if (faired.direction[k % faired.direction.size()] != 0) {
        first = n;
        continue;
      }
      const auto& from = faired.source[k % elements];
      const auto& to = faired.source[(k + 1) % elements];
      if (from && first == n) first = *from;
      if (!to || first == n) continue;
      const std::size_t behind = (*to + n - first) % n;
      if ((i + n - first) % n <= behind) return true;
    }
    return false;
  }

  /// Whether the points, none of which need move then, lie on one circle or line that has what is
  /// given.
  [[nodiscard]] bool lies_on_one_circle() const {
    const ChainConstraints once = constraints();
    ChainConstraints all = once;
    std::vector<Vec2> points = points_;
    if (loop_ || goes_on_) {
      points.clear();
      all.fixed.clear();
      const std::size_t n = points_of_turn();
      for (std::size_t k = 0; k < n + 2 * overlap() + 1; ++k) {
        points.push_back(unrolled_point(k));
        if (!once.fixed.empty()) all.fixed.push_back(once.fixed[(k + n - overlap()) % n]);
      }
    }
    const auto analysis = analyse(points);
    return analysis && is_one_circle(points, *analysis, all);
  }

  /// Whether every point was a node of its own, and none on a line or arc.
  static bool is_node_each(const FairedSeries& faired, std::size_t points) {
    const auto nodes = static_cast<std::size_t>(
        std::count_if(faired.source.begin(), faired.source.end(),
                      [](const auto& source) { return source.has_value(); }));
    return faired.primitives == 0 && nodes == points;
  }

  /// Nothing when no runs were found, or no chain along them.
  std::optional<SeriesChain> follow_runs(MeasuredSeries& measured, FairedSeries& faired) {
    const double most =
        watch_.spent() + kPrimitiveWork + kPrimitiveSteps * static_cast<double>(points_.size());
    std::optional<std::pair<SeriesChain, FairedSeries>> unproved;  // the first one
    for (int k = 0; k < kMostTrims && (k == 0 || watch_.spent() < most); ++k) {
      const ProgressShare share =
          ProgressShare::next_of_many(watch_, measured.primitives ? k + 1 : 0);
      faired = fair(measured, watch_);
      if (!faired.feasible) break;
      auto chain = follow(faired, measured);
      const auto end =
          chain ? unproved_end(faired, *chain)
                : nearest_primitive_end(faired, static_cast<std::size_t>(chain.error().index));
      if (chain && !end) return std::move(*chain);
      if (!end) break;
      if (chain && !unproved) unproved = {std::move(*chain), faired};
      measured.loose = faired.loose;
      measured.loose.push_back(*end);  // the transition beside the primitive needs more room
    }
    if (!unproved) return std::nullopt;
    faired = std::move(unproved->second);
    return std::move(unproved->first);
  }

  /// The end of a line or arc beside which the spirals of a chain are not proved: they exist, but
  /// so narrowly that doubles do not hold them.
  [[nodiscard]] std::optional<std::size_t> unproved_end(const FairedSeries& faired,
                                                        const SeriesChain& chain) const {
    if (faired.primitives == 0) return std::nullopt;
    const auto end = primitive_end_unproved(points_, chain);
    return end && goes_on_ ? *end + overlap() : end;
  }

  /// Whether the curvature changes its sign although all points turn one way.
  [[nodiscard]] bool bends_without_need(const SeriesChain& chain) const {
    const int sign = turning_sign();
    const auto against = [sign](const Element& e) { return sign * e.kappa < 0.0; };
    if (series_.convex || std::none_of(chain.elements.begin(), chain.elements.end(), against)) {
      return false;
    }
    const std::size_t n = points_.size();
    for (std::size_t i = loop_ ? 0 : 1; i + 1 < n || (loop_ && i < n); ++i) {
      const Vec2 before = points_[i] - points_[(i + n - 1) % n];
      if (!(sign * turning(before, points_[(i + 1) % n] - points_[i]) > 0.0)) return false;
    }
    return true;
  }

  static std::ptrdiff_t runs_of(const SeriesChain& chain) {
    std::ptrdiff_t runs = 1;
    std::int8_t last = 0;
    for (const std::int8_t d : chain.direction) {
      runs += d != 0 && last != 0 && d != last ? 1 : 0;
      if (d != 0) last = d;
    }
    return runs;
  }

  void give_nodes(MeasuredSeries& measured, const std::vector<std::size_t>& whole,
                  bool convex) const {
    measured.nodes.clear();
    if (!has_data() && !convex) return;
    const int sign = convex ? turning_sign() : 0;
    for (const std::size_t i : whole) {
      NodeData node;
      const FixedData data = data_of(i);
      node.theta = data.theta;
      node.kappa = data.kappa;
      node.curvature_sign = sign;
      measured.nodes.push_back(node);
    }
  }

  /// The way in which the section turns as a whole; where its points do not tell, that of the fixed
  /// curvatures.
  [[nodiscard]] int turning_sign() const {
    double turn = 0.0;
    for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
      turn += turning(points_[i] - points_[i - 1], points_[i + 1] - points_[i]);
    }
    for (std::size_t k = 0; turn == 0.0 && k < index_.size(); ++k) {
      turn = data_of(index_[k]).kappa.value_or(0.0);
    }
    return turn >= 0.0 ? 1 : -1;
  }

  [[nodiscard]] Result<SeriesChain> follow(const FairedSeries& faired,
                                           const MeasuredSeries& measured) {
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
    if (goes_on_) return follow_one_turn(nodes);
    return loop_ ? close_at_seam(std::move(nodes)) : follow_directions(std::move(nodes), watch_);
  }

  /// From seam to seam; both are nodes, as their points are met. Errors name nodes of the whole.
  [[nodiscard]] Result<SeriesChain> follow_one_turn(const DirectedSeries& nodes) {
    const auto seam = [&](std::size_t k) {
      return std::find(nodes.source.begin(), nodes.source.end(), std::optional(k)) -
             nodes.source.begin();
    };
    const auto first = seam(overlap()), last = seam(overlap() + points_of_turn());
    const auto part = [&](const auto& values, std::ptrdiff_t end) {
      return std::decay_t<decltype(values)>(values.begin() + first, values.begin() + end);
    };
    DirectedSeries turn;
    turn.points = part(nodes.points, last + 1);
    turn.start = part(nodes.start, last + 1);
    turn.source = part(nodes.source, last + 1);
    turn.nodes = part(nodes.nodes, last + 1);
    turn.direction = part(nodes.direction, last);
    for (auto& source : turn.source) {
      if (source) source = place_of(*source);
    }
    auto chain = close_at_seam(std::move(turn));
    if (!chain && chain.error().index >= 0) chain.error().index += first;
    return chain;
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
    return loop_ ? around_loop() : through_points(points_, constraints(), index_);
  }

  const Prepared& series_;
  const Section& section_;
  bool loop_;
  bool goes_on_ = false;  ///< beyond both ends, moved by the period
  bool moves_ = false;    ///< some point may be moved
  Watch& watch_;
  std::vector<std::size_t> index_;  // of each point in the whole series
  std::vector<Vec2> points_;
  std::map<std::size_t, double> held_;       // headings by points of the whole series, rad
  std::map<std::size_t, FixedData> bounds_;  // ends of ranges that hold, likewise
  std::optional<double> cap_;                // largest curvature at any point
  std::optional<WholePiece> whole_;          // that the section is
  bool central_ = false;
  bool turns_alone_known_ = false;
  std::optional<ChainTurns> turns_alone_;
  SectionChain out_;
};

}  // namespace

std::string no_primitives_text(const std::string& where) {
  return fmt::format(
      "no line and no arc was found{}: no stretch of 4 points or more fits one with room to spare "
      "and is far longer than a spiral that fits as well",
      where);
}

Result<SectionChain> chain_section(const Prepared& series, const Section& section, Watch& watch) {
  return SectionChooser(series, section, watch).run();
}

void FoundChains::begin_another() {
  spared_ = 0.0;
  for (Found& one : found_) one.counts = true;
}

Result<SectionChain> FoundChains::chain(const Prepared& series, const Section& section,
                                        Watch& watch) {
  using Clock = std::chrono::steady_clock;
  Asked asked{section.first,
              section.last,
              series.split.smooth_loop,
              series.thin,
              series.convex,
              series.primitives,
              series.prefer,
              series.placed.empty() ? series.points : series.placed,
              series.reach,
              series.fixed,
              series.whole_of(section),
              series.taken_back.loose};
  for (Found& one : found_) {
    if (!(one.asked == asked)) continue;
    spared_ += std::exchange(one.counts, false) ? one.seconds : 0.0;
    return one.chain;
  }
  const auto begin = Clock::now();
  auto chain = chain_section(series, section, watch);
  if (watch.may_go_on()) {  // what ended at a limit may do with more
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    found_.push_back({std::move(asked), chain, seconds, false});
  }
  return chain;
}

}  // namespace obvid::pipeline_detail
