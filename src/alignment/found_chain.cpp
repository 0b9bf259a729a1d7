// SPDX-License-Identifier: Apache-2.0
#include "found_chain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "fewest_pieces.h"
#include "mended.h"
#include "obvid/alignment/internal/borne_grades.h"
#include "obvid/alignment/internal/transition_law.h"
#include "one_element.h"
#include "rounded_corners.h"
#include "whole_circle.h"
#include "winding.h"

namespace obvid::alignment {
namespace {

constexpr std::size_t kBeside = 3;   ///< elements to both sides that move with one that is changed
constexpr std::size_t kBridged = 3;  ///< elements that one vertical curve takes the place of
constexpr std::size_t kWindow = 12;  ///< elements that are fitted at once
constexpr double kLeastLength = 0.25;  ///< of the mean distance of points: elements get no shorter
constexpr double kOfShortest =
    0.5;  ///< of the shortest element where corners are rounded: likewise
/// Standard deviations of the scatter of points: what is off by more is shown by them.
constexpr double kShown = 4.0;
constexpr std::size_t kNumbersOfElement = 3;  ///< length and two curvatures
constexpr double kHopeless = 4.0;             ///< estimated squares over the most that there can be
/// Largest offset over its tolerance after least squares from which no higher power comes back.
constexpr double kHopelessOffset = 3.0;
constexpr int kPasses = 12;      ///< over all conditions
constexpr int kPassesAlike = 4;  ///< where the points show none to be wrong
/// Of the length of all elements: where a bend moves nothing by more it is rounding, and straight.
constexpr double kStraightWithin = 1e-9;
constexpr double kOfToleranceAtMost = 1e-3;  ///< that this may take; scatter that is none
constexpr double kSlow = 0.25;     ///< of a run's change of curvature: what may be an arc beside it
constexpr double kSlowRate = 0.1;  ///< of the fastest change of curvature: what may be an arc
constexpr std::size_t kLongestRun = 9;   ///< elements that one transition takes the place of
constexpr int kPolishes = 3;             ///< over the whole alignment, where an offset is too large
constexpr std::size_t kLeastAround = 4;  ///< elements that a loop begins with
/// Of the tolerances, before transitions are put between elements with a step of the curvature.
constexpr double kBeforeTransitions = 0.9;
/// Intervals of points beside those that are passed otherwise than they may be that become chords
/// with them, one number after the other until that does.
constexpr std::array<std::size_t, 4> kMendedBeside = {0, 1, 3, 7};
/// Of the intervals: where more are passed otherwise than they may be, another search does better.
constexpr double kMostMended = 0.1;
constexpr int kMoreAtSeam = 2;  ///< elements that may be added to close a loop

class Simplifier {
 public:
  /// Of a closed alignment the last point is the first one again, a lap on; `close` leaves it out.
  /// What is rounded goes around as it is, and has no such point.
  /// `first_given`: number, as given, of the first point. `others`: other searches are to come.
  Simplifier(std::vector<Vec2> points, std::vector<double> tolerance,
             const AlignmentOptions& options, const Sought& sought, Chain chain,
             std::vector<Foot> feet, std::size_t first_given, bool rounded, bool others,
             const RunContext& run)
      : points_(std::move(points)),
        tolerance_(std::move(tolerance)),
        transitions_(options.transitions),
        without_steps_(options.without_steps && !sought.constant),
        constant_(sought.constant),
        lap_(sought.lap),
        first_given_(first_given),
        rounded_(rounded),
        others_(others),
        cancelled_(run.cancelled),
        chain_(std::move(chain)),
        begun_with_(chain_.size()),
        feet_(std::move(feet)) {
    double length = 0.0;
    for (std::size_t i = 1; i < points_.size(); ++i) {
      const Vec2 chord = points_[i] - points_[i - 1];
      length += chain_.plane == Plane::kMap ? norm(chord) : chord.x;
    }
    double least = kLeastLength * length / static_cast<double>(points_.size() - 1);
    if (sought.rounded) {
      borne_ = BorneGrades(points_, tolerance_, sought.lap.x);
    } else if (sought.corners) {
      borne_ = grades_borne_by(points_, tolerance_, sought);
    }
    if (sought.corners || rounded) {
      // what rounds a corner is as short as the tolerance makes it
      const double shortest = *std::min_element(chain_.length.begin(), chain_.length.end());
      least = std::min(least, kOfShortest * shortest);
    }
    least_length_ = std::max(least, options.least_length);
    limited_length_ = options.least_length > 0.0;
    if (options.least_radius > 0.0) largest_curvature_ = 1.0 / options.least_radius;
    if (without_steps_) {
      for (double& one : tolerance_) one *= kBeforeTransitions;
    }
  }

  Result<void> run(const RunContext& run) {
    const std::vector<Element> joints = chain_.joints();  // of the search: the points are there
    for (double& kappa : chain_.kappa) {
      kappa = std::clamp(kappa, -largest_curvature_, largest_curvature_);
    }
    if (!rounded_) OBVID_TRY(polish(run, &joints));  // what is rounded passes the points already
    if (others_) OBVID_TRY(polish_to_tolerance(run));
    const auto goes_on = may_lead_within(1.0, run);
    OBVID_TRY(goes_on);
    if (!*goes_on) return {};
    OBVID_TRY(simplify(run));
    OBVID_TRY(simplify_mended(run));
    straighten();
    if (!without_steps_) return {};
    give_room();
    return take_steps_away(run);
  }

  /// The same around a loop: the ends of what was found are joined, and everything is tried once
  /// with the seam where the points begin and once with it half way around, where it is no other
  /// joint than the rest. At last the chain begins with the element of the first point.
  Result<void> run_around(const RunContext& run) {
    const std::vector<Element> joints = chain_.joints();
    for (double& kappa : chain_.kappa) {
      kappa = std::clamp(kappa, -largest_curvature_, largest_curvature_);
    }
    if (rounded_) {
      closed_ = true;  // these go around already
    } else {
      OBVID_TRY(polish(run, &joints));
      auto goes_on = may_lead_within(kHopelessOffset, run);
      OBVID_TRY(goes_on);
      if (!*goes_on) return {};
      OBVID_TRY(close(run));
      if (others_) OBVID_TRY(polish_to_tolerance(run));
      goes_on = may_lead_within(1.0, run);
      OBVID_TRY(goes_on);
      if (!*goes_on) return {};
    }
    for (int turn = 0; turn < 2; ++turn) {
      OBVID_TRY(simplify(run));
      turn_to(chain_.size() / 2);
    }
    OBVID_TRY(merge_at_each_seam(run));
    OBVID_TRY(simplify_mended(run));
    OBVID_TRY(merge_all(run));
    turn_to_first_given();
    if (largest() > 1.0) OBVID_TRY(polish(run));
    straighten();
    if (!without_steps_) return {};
    give_room();
    // once more with the joint between end and start inside
    OBVID_TRY(take_steps_away(run));
    turn_to(chain_.size() / 2);
    OBVID_TRY(take_steps_away(run));
    turn_to_first_given();
    return {};
  }

  /// Foot of a point, as points were given.
  [[nodiscard]] const Foot& foot_of_given(std::size_t i) const {
    return feet_[(i + feet_.size() - first_given_) % feet_.size()];
  }

  [[nodiscard]] const Chain& chain() const { return chain_; }
  /// Whether there are more elements around a loop than the open search had: with one more, at the
  /// most, where the points begin, it has as many as the loop.
  [[nodiscard]] bool has_more_than_open() const { return closed_ && chain_.size() > begun_with_; }
  /// Whether stretches of it are no elements of the search.
  [[nodiscard]] bool is_mended() const { return mended_; }
  /// Whether it was begun as no search's.
  [[nodiscard]] bool is_rounded() const { return rounded_; }
  /// Whether it turns between neighbouring points as they do not show.
  [[nodiscard]] bool winds() const {
    const PointRow points = row();
    return windings(chain_, points, feet_, 0, points.intervals(), kRefoundTurn) > 0;
  }
  [[nodiscard]] double largest() {
    find_feet(chain_, points_, feet_);
    double out = 0.0;
    for (std::size_t i = 0; i < feet_.size(); ++i) {
      out = std::max(out, std::abs(feet_[i].offset) / tolerance_[i]);
    }
    return out;
  }

 private:
  /// Which intervals of points are not passed as they may be: a point left, or wound through. Finds
  /// the feet.
  [[nodiscard]] std::vector<bool> bad_intervals() {
    find_feet(chain_, points_, feet_);
    const PointRow points = row();
    std::vector<bool> out =
        wound_through(chain_, points, feet_, 0, points.intervals(), kRefoundTurn);
    const std::size_t intervals = out.size();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (std::abs(feet_[i].offset) <= tolerance_[i]) continue;
      if (i < intervals) out[i] = true;
      if (i > 0 || closed_) out[(i + intervals - 1) % intervals] = true;
    }
    return out;
  }

  [[nodiscard]] static std::size_t number_of(const std::vector<bool>& bad) {
    return static_cast<std::size_t>(std::count(bad.begin(), bad.end(), true));
  }

  [[nodiscard]] bool is_good() { return number_of(bad_intervals()) == 0; }

  /// Whether to go on with what was fitted. Where there are other searches, not with what leaves
  /// the points by more than so many tolerances and cannot be mended: fewer elements come no
  /// nearer.
  Result<bool> may_lead_within(double most, const RunContext& run) {
    if (!others_ || largest() <= most) return true;
    return mend(run);
  }

  /// Mends what fewer elements and simpler kinds made bad, and makes that fewer.
  Result<void> simplify_mended(const RunContext& run) {
    if (is_good()) return {};
    const auto mended = mend(run);
    OBVID_TRY(mended);
    return *mended ? simplify(run) : Result<void>();
  }

  /// Stretches whose points are left, or that are wound through, become their chords with rounded
  /// corners; what lies beside stays. False where not all can, or, with other searches to come,
  /// where they are many.
  Result<bool> mend(const RunContext& run) {
    const bool limits = std::isfinite(largest_curvature_) || limited_length_;
    if (chain_.plane != Plane::kMap || constant_ || without_steps_ || limits) return false;
    std::vector<bool> bad = bad_intervals();
    const auto intervals = static_cast<double>(bad.size());
    if (others_ && static_cast<double>(number_of(bad)) > kMostMended * intervals) return false;
    while (number_of(bad) > 0) {
      const auto first = std::find(bad.begin(), bad.end(), true);
      const auto last = std::find(first, bad.end(), false) - 1;
      const auto mended = mend({static_cast<std::size_t>(first - bad.begin()),
                                static_cast<std::size_t>(last - bad.begin())},
                               number_of(bad), run);
      OBVID_TRY(mended);
      if (!*mended) return false;
      bad = bad_intervals();
    }
    const double shortest = *std::min_element(chain_.length.begin(), chain_.length.end());
    least_length_ = std::min(least_length_, kOfShortest * shortest);
    mended_ = true;
    return true;
  }

  /// Bad intervals, and as many beside them as it takes that there are fewer than `before`.
  Result<bool> mend(const PointStretch& intervals, std::size_t before, const RunContext& run) {
    for (const std::size_t more : kMendedBeside) {
      OBVID_TRY(may_go_on(run));
      const PointStretch stretch{intervals.first - std::min(intervals.first, more),
                                 std::min(intervals.last + 1 + more, points_.size() - 1)};
      if (closed_ && (stretch.first == 0 || stretch.last + 1 == points_.size())) return false;
      auto mended = with_rounded_chords(chain_, feet_, row(), stretch);
      if (!mended) continue;
      std::swap(chain_, mended->chain);
      std::swap(feet_, mended->feet);
      if (number_of(bad_intervals()) < before) return true;
      std::swap(chain_, mended->chain);
      std::swap(feet_, mended->feet);
    }
    return false;
  }

  /// Begins the chain with the element of the first point.
  void turn_to_first_given() {
    const std::size_t first = (points_.size() - first_given_) % points_.size();
    turn_to(feet_[first].element);
  }

  /// Gives points the part of their tolerance that transitions in joints need.
  void give_room() {
    for (double& one : tolerance_) one /= kBeforeTransitions;
  }

  /// Puts a transition into each joint with a step of the curvature.
  Result<void> take_steps_away(const RunContext& run) {
    for (std::size_t k = 1; k < chain_.size(); ++k) {
      OBVID_TRY(may_go_on(run));
      if (chain_.ends[k - 1][1] == chain_.ends[k][0]) continue;
      if (take_step_away(k)) continue;
      return fail(error(ErrorCode::kToleranceNotReached,
                        "a step of the curvature remains: no transition has room there")
                      .where("--joints")
                      .hint("allow a larger tolerance, or a smaller --min-length")
                      .value(std::abs(chain_.curvature(k, 0) - chain_.curvature(k - 1, 1))));
    }
    return {};
  }

  /// Between elements k - 1 and k: clothoids that begin or end otherwise, else the longest
  /// transition that is found, else arcs that become clothoids.
  bool take_step_away(std::size_t k) {
    if (bends(k) && share_curvature(k, k, 0)) return true;
    if (bends(k - 1) && share_curvature(k, k - 1, 1)) return true;
    if (put_longest_between(k)) return true;
    return share_curvature(k, k, 0) || share_curvature(k, k - 1, 1);
  }

  /// Gives one of the elements at joint k the curvature that the other one has there.
  bool share_curvature(std::size_t k, std::size_t element, std::size_t end) {
    Chain next = chain_;
    next.ends[element][end] = end == 0 ? chain_.ends[k - 1][1] : chain_.ends[k][0];
    const std::size_t first = k - std::min(k, kBeside);
    const std::size_t last = std::min(k + kBeside, next.size());
    Window window = cut(next, first, last);
    return accept(std::move(next), feet_, std::move(window));
  }

  bool put_longest_between(std::size_t k) {
    const bool between_constants = !bends(k - 1) && !bends(k);
    const double half = 0.5 * std::min(chain_.length[k - 1], chain_.length[k]);
    for (double length = std::max(half, least_length_);;
         length = std::max(0.5 * length, least_length_)) {
      if (between_constants && transitions_ != Transition::kClothoid &&
          put_between(k, length, transitions_)) {
        return true;
      }
      if (put_between(k, length, Transition::kClothoid)) return true;
      if (length <= least_length_) return false;
    }
  }

  bool put_between(std::size_t k, double length, Transition law) {
    const std::vector<Element> joints = chain_.joints();
    Chain next = chain_;
    std::vector<Foot> feet = feet_;
    const double half = 0.5 * length;
    next.length[k - 1] -= half;
    next.length[k] -= half;
    if (std::min(next.length[k - 1], next.length[k]) < least_length_) return false;
    const auto at = static_cast<std::ptrdiff_t>(k);
    next.length.insert(next.length.begin() + at, length);
    next.ends.insert(next.ends.begin() + at, {chain_.ends[k - 1][1], chain_.ends[k][0]});
    next.law.insert(next.law.begin() + at, law);
    for (Foot& foot : feet) {
      if (foot.element == k - 1 && foot.s > next.length[k - 1]) {
        foot.s -= next.length[k - 1];
        foot.element = k;
      } else if (foot.element == k && foot.s < half) {
        foot.s += half;
      } else if (foot.element == k) {
        foot.s -= half;
        foot.element = k + 1;
      } else if (foot.element > k) {
        ++foot.element;
      }
    }
    const std::size_t first = k - std::min(k, kBeside);
    const std::size_t last = std::min(k + 1 + kBeside, next.size());
    Window window = cut(next, feet, first, last, joints, last - 1);
    return accept(std::move(next), std::move(feet), std::move(window));
  }

  /// Curvatures that are rounding become those of lines: as they are they have signs, and radii,
  /// that no point shows.
  void straighten() {
    if (chain_.plane != Plane::kMap) return;
    double whole = 0.0;
    for (const double length : chain_.length) whole += length;
    const double most =
        std::min(kStraightWithin * whole,
                 kOfToleranceAtMost * *std::min_element(tolerance_.begin(), tolerance_.end()));
    std::vector<double> longest(chain_.kappa.size(), 0.0);
    for (std::size_t k = 0; k < chain_.size(); ++k) {
      for (const int number : chain_.ends[k]) {
        if (number == Chain::kStraight) continue;
        double& own = longest[static_cast<std::size_t>(number)];
        own = std::max(own, chain_.length[k]);
      }
    }
    for (auto& ends : chain_.ends) {
      for (int& number : ends) {
        if (number == Chain::kStraight) continue;
        const auto n = static_cast<std::size_t>(number);
        // what lies beyond is turned by it: all of the length is its lever
        if (std::abs(chain_.kappa[n]) * longest[n] * whole <= most) number = Chain::kStraight;
      }
    }
  }

  /// Fewer elements and simpler kinds. What passes all points as it may does so afterwards.
  Result<void> simplify(const RunContext& run) {
    std::optional<std::pair<Chain, std::vector<Foot>>> good;
    const auto remember = [&] {
      if (is_good()) good = {chain_, feet_};
    };
    remember();
    OBVID_TRY(merge_all(run));
    remember();
    const int passes = std::isfinite(scatter()) ? kPasses : kPassesAlike;
    for (int pass = 0; pass < passes; ++pass) {
      const auto taken = take_conditions(run);
      OBVID_TRY(taken);
      if (!*taken) break;
      remember();
    }
    OBVID_TRY(merge_all(run));
    if (transitions_ != Transition::kClothoid && !constant_) {
      // where clothoids lie beside transitions of another kind, lines are arcs and ends are off
      for (int pass = 0; pass < passes; ++pass) {
        remember();
        const std::size_t before = chain_.size();
        OBVID_TRY(take_transitions(run));
        const auto taken = take_conditions(run);
        OBVID_TRY(taken);
        OBVID_TRY(merge_all(run));
        if (!*taken && chain_.size() == before) break;
      }
    }
    OBVID_TRY(polish_to_tolerance(run));
    if (good && !is_good()) std::tie(chain_, feet_) = std::move(*good);
    return {};
  }

  Result<void> polish_to_tolerance(const RunContext& run) {
    for (int i = 0; i < kPolishes && largest() > 1.0; ++i) {
      OBVID_TRY(polish(run));
    }
    return {};
  }

  /// Some elements with their points, cut out.
  struct Window {
    std::size_t first = 0;             ///< element
    std::vector<std::size_t> numbers;  ///< of its points: where points are nearer than their
                                       ///< tolerances, feet need not be in their order
    Chain chain;
    std::vector<Vec2> points;
    std::vector<double> tolerance;
    std::vector<Foot> feet;
    std::vector<int> number;  ///< in the whole chain, of each curvature
    Held held;
  };

  [[nodiscard]] Window cut(const Chain& chain, std::size_t first, std::size_t last) const {
    return cut(chain, feet_, first, last, chain_.joints(), last);
  }

  /// What lies beside stays: joints `first` and `end` of those that are.
  [[nodiscard]] Window cut(const Chain& chain, const std::vector<Foot>& feet, std::size_t first,
                           std::size_t last, const std::vector<Element>& joints,
                           std::size_t end) const {
    Window out;
    out.first = first;
    out.chain.plane = chain.plane;
    out.chain.start = joints[first].point;
    out.chain.theta = joints[first].theta;
    out.held.start = first > 0 || closed_;
    out.held.least_length = least_length_;
    out.held.largest_curvature = largest_curvature_;
    out.held.cancelled = cancelled_;
    if (last < chain.size()) {
      out.held.end = joints[end];
    } else if (closed_) {
      out.held.end = a_lap_on(joints.front());
    }
    for (std::size_t k = first; k < last; ++k) {
      out.chain.length.push_back(chain.length[k]);
      out.chain.law.push_back(chain.law[k]);
      std::array<int, 2> ends{};
      for (std::size_t e = 0; e < 2; ++e) ends[e] = own_number(chain, chain.ends[k][e], out);
      out.chain.ends.push_back(ends);
    }
    for (std::size_t k = 0; k < out.number.size(); ++k) {
      // a curvature that an element outside has too stays as it is
      if (is_used_outside(chain, out.number[k], first, last)) {
        out.held.kappa.push_back(static_cast<int>(k));
      }
    }
    for (std::size_t i = 0; i < feet.size(); ++i) {
      if (feet[i].element < first || feet[i].element >= last) continue;
      out.numbers.push_back(i);
      out.points.push_back(points_[i]);
      out.tolerance.push_back(tolerance_[i]);
      Foot foot = feet[i];
      foot.element -= first;
      out.feet.push_back(foot);
    }
    return out;
  }

  static int own_number(const Chain& chain, int number, Window& window) {
    if (number == Chain::kStraight) return number;
    const auto found = std::find(window.number.begin(), window.number.end(), number);
    const auto own = found - window.number.begin();
    if (found == window.number.end()) {
      window.number.push_back(number);
      window.chain.kappa.push_back(chain.kappa[static_cast<std::size_t>(number)]);
    }
    return static_cast<int>(own);
  }

  /// Whether its elements, fitted, pass its points.
  bool fits(Window& window) const { return fit(window).largest <= 1.0; }

  /// The same with what is left; infinite where there are no such elements.
  Fitted fit(Window& window) const {
    Fitted out{std::numeric_limits<double>::infinity(), 0.0};
    if (window.points.empty()) return out;
    out = fit_chain(window.chain, window.points, window.tolerance, window.feet, window.held);
    if (!transitions_exist(window.chain) || !is_borne(window.chain)) {
      out.largest = std::numeric_limits<double>::infinity();
    }
    return out;
  }

  static bool passes_as_it_is(const Window& window) {
    std::vector<Foot> feet = window.feet;
    find_feet(window.chain, window.points, feet);
    for (std::size_t i = 0; i < feet.size(); ++i) {
      if (!(std::abs(feet[i].offset) <= window.tolerance[i])) return false;
    }
    return true;
  }

  /// Whether the points bear the grades at all joints of a profile.
  [[nodiscard]] bool is_borne(const Chain& chain) const {
    if (!borne_) return true;
    for (const Element& joint : chain.joints()) {
      const double grade = chain.plane == Plane::kMap ? std::tan(joint.theta) : joint.theta;
      const ValueRange borne = borne_->at(joint.point.x);
      if (!(borne.low <= grade && grade <= borne.high)) return false;
    }
    return true;
  }

  [[nodiscard]] static bool transitions_exist(const Chain& chain) {
    for (std::size_t k = 0; k < chain.size(); ++k) {
      if (chain.law[k] == Transition::kClothoid) continue;
      const TransitionLaw law(chain.law[k], chain.curvature(k, 0), chain.curvature(k, 1),
                              chain.length[k]);
      if (!law.exists()) return false;
    }
    return true;
  }

  /// Makes `next` with what was fitted of its window the chain; false, and nothing, where more
  /// intervals of points are wound through than before, or points left that the window passes.
  bool commit(Chain next, std::vector<Foot> feet, const Window& window) {
    if (window.first == 0) {
      next.start = window.chain.start;
      next.theta = window.chain.theta;
    }
    for (std::size_t k = 0; k < window.chain.size(); ++k) {
      next.length[window.first + k] = window.chain.length[k];
    }
    for (std::size_t k = 0; k < window.number.size(); ++k) {
      next.kappa[static_cast<std::size_t>(window.number[k])] = window.chain.kappa[k];
    }
    for (std::size_t i = 0; i < window.feet.size(); ++i) {
      Foot foot = window.feet[i];
      foot.element += window.first;
      feet[window.numbers[i]] = foot;
    }
    if (loses_points(next, feet, window) || winds_more(next, feet, window)) return false;
    chain_ = std::move(next);
    feet_ = std::move(feet);
    return true;
  }

  /// Whether points that the window passes beyond its ends are not passed by what lies there. Sets
  /// their feet.
  [[nodiscard]] bool loses_points(const Chain& next, std::vector<Foot>& feet,
                                  const Window& window) const {
    std::vector<std::size_t> beyond;
    std::vector<Vec2> points;
    std::vector<Foot> there;
    for (std::size_t i = 0; i < window.feet.size(); ++i) {
      const Foot& foot = window.feet[i];
      const bool before = foot.s < 0.0 && window.first + foot.element > 0;
      const bool behind = foot.s > window.chain.length[foot.element] &&
                          window.first + foot.element + 1 < next.size();
      if (!before && !behind) continue;
      beyond.push_back(i);
      points.push_back(window.points[i]);
      there.push_back(feet[window.numbers[i]]);
    }
    if (beyond.empty()) return false;
    find_feet(next, points, there);
    for (std::size_t k = 0; k < beyond.size(); ++k) {
      const std::size_t i = beyond[k];
      const bool within = std::abs(window.feet[i].offset) <= window.tolerance[i];
      if (within && !(std::abs(there[k].offset) <= window.tolerance[i])) return true;
      feet[window.numbers[i]] = there[k];
    }
    return false;
  }

  [[nodiscard]] bool winds_more(const Chain& next, const std::vector<Foot>& feet,
                                const Window& window) const {
    if (window.numbers.empty()) return false;
    const std::size_t first_point = window.numbers.front();
    const std::size_t first = first_point - std::min<std::size_t>(first_point, 1);
    const std::size_t end = window.numbers.back() + 1;
    const PointRow points = row();
    const std::size_t intervals = points.intervals(), last = std::min(end, intervals);
    const auto number = [&](const Chain& chain, const std::vector<Foot>& own, double rounded) {
      std::size_t out = windings(chain, points, own, first, last, rounded);
      if (closed_ && first_point == 0 && last < intervals) {
        out += windings(chain, points, own, intervals - 1, intervals, rounded);
      }
      return out;
    };
    for (const double rounded : {kRoundedTurn, kRefoundTurn}) {
      const std::size_t after = number(next, feet, rounded);
      if (after == 0) return false;
      if (after > number(chain_, feet_, rounded)) return true;
    }
    return false;
  }

  [[nodiscard]] PointRow row() const { return {points_, tolerance_, closed_, lap_}; }

  /// Windows end at joints of the chain as it is, or where it is meant to pass.
  Result<void> polish(const RunContext& run, const std::vector<Element>* meant = nullptr) {
    for (std::size_t first = 0; first < chain_.size(); first += kWindow / 2) {
      if (auto on =
              tell(run, "fitting", static_cast<double>(first) / static_cast<double>(chain_.size()));
          !on)
        return on;
      const std::size_t last = std::min(first + kWindow, chain_.size());
      Window window = cut(chain_, first, last);
      if (meant != nullptr && last < chain_.size()) window.held.end = (*meant)[last];
      if (window.points.empty()) continue;
      const bool was_good = borne_ && is_borne(window.chain) && passes_as_it_is(window);
      const Fitted fitted =
          fit_chain(window.chain, window.points, window.tolerance, window.feet, window.held);
      if (std::isfinite(fitted.largest) && transitions_exist(window.chain) &&
          (!was_good || is_borne(window.chain))) {
        (void)commit(chain_, feet_, window);
      }
      if (last == chain_.size()) break;
    }
    find_feet(chain_, points_, feet_);
    return {};
  }

  /// Windows of a loop of few elements reach from its seam to its seam, whose joint they hold where
  /// it came to lie: with each joint as the seam once, each of the others moves. What has no fewer
  /// elements then stays as it was.
  Result<void> merge_at_each_seam(const RunContext& run) {
    constexpr std::size_t kFew = 2 * kBeside + 2;
    const std::size_t had = chain_.size();
    const auto whole = std::tuple(points_, tolerance_, first_given_, chain_, feet_);
    for (std::size_t turn = 1; had <= kFew && turn < had; ++turn) {
      turn_to(1);
      const auto before = std::pair(chain_, feet_);
      const bool was_good = is_good();
      OBVID_TRY(polish(run));
      if (was_good && !is_good()) std::tie(chain_, feet_) = before;
      OBVID_TRY(merge_all(run));
      if (chain_.size() == had) continue;
      OBVID_TRY(simplify(run));
      return merge_at_each_seam(run);
    }
    std::tie(points_, tolerance_, first_given_, chain_, feet_) = whole;
    return {};
  }

  /// Neighbours become one wherever that passes the points: the search keeps some of the ways to a
  /// place only, and its joints are at places.
  Result<void> merge_all(const RunContext& run) {
    for (std::size_t k = 0; k + 1 < chain_.size();) {
      const double done = static_cast<double>(k) / static_cast<double>(chain_.size());
      OBVID_TRY(tell(run, "fewer elements", done));
      if (!merge(k) && !leave_out(k) && !(borne_ && bridge(k))) ++k;
    }
    return {};
  }

  /// Element k and the next one, or the next two, of a profile as one curve between the tangents
  /// before and behind, about where they meet: as one of the two it would begin too far off.
  bool bridge(std::size_t k) {
    for (std::size_t count = 2; count <= kBridged; ++count) {
      if (k > 0 && k + count < chain_.size() && bridge(k, count)) return true;
    }
    return false;
  }

  bool bridge(std::size_t k, std::size_t count) {
    const std::vector<Element> joints = chain_.joints();
    const Element &a = joints[k], &b = joints[k + count];
    const Vec2 before = forward(chain_.plane, a.theta), behind = forward(chain_.plane, b.theta);
    const Vec2 chord = b.point - a.point;
    const double to_corner = cross(chord, behind) / cross(before, behind);
    const double from_corner = cross(before, chord) / cross(before, behind);
    if (!(to_corner > 0.0 && from_corner > 0.0)) return false;
    // the points decide; it has to begin at a length from which the fit finds its own
    for (const double half : {std::min(to_corner, from_corner), std::sqrt(to_corner * from_corner),
                              0.5 * (to_corner + from_corner)}) {
      if (put_curve(k, count, to_corner - half, from_corner - half, 2.0 * half)) return true;
    }
    return false;
  }

  /// One curve in the place of `count` elements: those beside them grow, or shrink.
  bool put_curve(std::size_t k, std::size_t count, double before, double behind, double length) {
    const std::vector<Element> joints = chain_.joints();
    Chain next = chain_;
    const auto at = static_cast<std::ptrdiff_t>(k);
    const auto last = at + static_cast<std::ptrdiff_t>(count);
    next.length[k - 1] += before;
    next.length[k + count] += behind;
    if (std::min(next.length[k - 1], next.length[k + count]) < least_length_) return false;
    next.length[k] = length;
    next.length.erase(next.length.begin() + at + 1, next.length.begin() + last);
    const int number = static_cast<int>(next.kappa.size());
    next.kappa.push_back(turn_between(chain_.plane, joints[k].theta, joints[k + count].theta) /
                         length);
    next.ends[k] = {number, number};
    next.ends.erase(next.ends.begin() + at + 1, next.ends.begin() + last);
    next.law.erase(next.law.begin() + at + 1, next.law.begin() + last);
    std::vector<Foot> feet = feet_;
    for (Foot& foot : feet) {
      if (foot.element <= k) continue;
      foot.element = std::max(k, foot.element - std::min(foot.element, count - 1));
    }
    const std::size_t first = k - std::min(k, kBeside);
    const std::size_t end = std::min(k + kBeside + 1, next.size());
    Window window = cut(next, feet, first, end, joints, end + count - 1);
    return accept(std::move(next), std::move(feet), std::move(window));
  }

  /// Leaves out element k where no more points lie on it than it has numbers: those beside it grow
  /// to where they turn as it did, as one of the two alone would begin too far off.
  bool leave_out(std::size_t k) {
    if (constant_ || k == 0 || k + 1 >= chain_.size()) return false;
    const auto on_it = std::count_if(feet_.begin(), feet_.end(),
                                     [k](const Foot& foot) { return foot.element == k; });
    if (on_it > static_cast<std::ptrdiff_t>(kNumbersOfElement) + 1) return false;
    const std::vector<Element> joints = chain_.joints();
    const double whole = chain_.length[k];
    const double turn = turn_between(chain_.plane, joints[k].theta, joints[k + 1].theta);
    const double before = chain_.curvature(k - 1, 1), behind = chain_.curvature(k + 1, 0);
    const double share = (turn / whole - behind) / (before - behind);
    if (!(share >= 0.0 && share <= 1.0)) return false;
    const double own = share * whole;
    Chain next = chain_;
    std::vector<Foot> feet = feet_;
    for (Foot& foot : feet) {
      if (foot.element < k) continue;
      if (foot.element == k && foot.s <= own) {
        foot.element = k - 1;
        foot.s += chain_.length[k - 1];
        continue;
      }
      foot.s += foot.element == k ? -own : foot.element == k + 1 ? whole - own : 0.0;
      if (foot.element > k) --foot.element;
    }
    next.length[k - 1] += own;
    next.length[k + 1] += whole - own;
    const auto at = static_cast<std::ptrdiff_t>(k);
    next.length.erase(next.length.begin() + at);
    next.ends.erase(next.ends.begin() + at);
    next.law.erase(next.law.begin() + at);
    const std::size_t first = k - std::min(k, kBeside);
    const std::size_t last = std::min(k + kBeside, next.size());
    Window window = cut(next, feet, first, last, joints, last + 1);
    return accept(std::move(next), std::move(feet), std::move(window));
  }

  /// Element k and the next one as one: begun as the longer one, or from end to end.
  bool merge(std::size_t k) {
    const std::array<int, 2> a = chain_.ends[k], b = chain_.ends[k + 1];
    const bool longer = chain_.length[k] < chain_.length[k + 1];
    if (merge(k, longer ? b : a)) return true;
    return constant_ ? merge(k, longer ? a : b) : merge(k, {a[0], b[1]});
  }

  [[nodiscard]] bool bends(std::size_t k) const { return chain_.ends[k][0] != chain_.ends[k][1]; }

  /// Runs of elements between constant curvatures become one transition of the wanted kind: as many
  /// at once as the points allow, because where a search with clothoids needs several, and short
  /// arcs between them, one of another kind may do.
  Result<void> take_transitions(const RunContext& run) {
    for (std::size_t first = 0; first < chain_.size(); first += kWindow / 2) {
      OBVID_TRY(may_go_on(run));
      (void)restructure(first, std::min(first + kWindow, chain_.size()));
    }
    for (std::size_t k = 0; k < chain_.size(); ++k) {
      if (auto on =
              tell(run, "transitions", static_cast<double>(k) / static_cast<double>(chain_.size()));
          !on) {
        return on;
      }
      if (k > 0 && bends(k - 1)) continue;  // what begins beside a clothoid is none of these
      if (!take_longest(k, false)) (void)take_longest(k, true);
    }
    return {};
  }

  /// Neighbours that belong together: of one curvature, or one transition.
  struct Group {
    std::size_t begin = 0, end = 0;
    bool constant = false;
  };

  /// Elements of a range that bend slowly, beside others, count as arcs.
  [[nodiscard]] std::vector<Group> groups_of(std::size_t first, std::size_t last) const {
    const auto rate = [&](std::size_t k) {
      return std::abs(chain_.curvature(k, 1) - chain_.curvature(k, 0)) / chain_.length[k];
    };
    double fastest = 0.0;
    for (std::size_t k = first; k < last; ++k) fastest = std::max(fastest, rate(k));
    std::vector<Group> out;
    for (std::size_t k = first; k < last; ++k) {
      const bool constant = rate(k) <= kSlowRate * fastest;
      if (out.empty() || out.back().constant != constant) out.push_back({k, k, constant});
      out.back().end = k + 1;
    }
    return out;
  }

  /// All of a range at once, as lines and arcs with transitions between them: one by one they may
  /// not fit, where clothoids beside them make good what those of the search cannot follow.
  bool restructure(std::size_t first, std::size_t last) {
    const std::vector<Group> groups = groups_of(first, last);
    const bool any = std::any_of(groups.begin(), groups.end(), [&](const Group& g) {
      return !g.constant && (g.end > g.begin + 1 || chain_.law[g.begin] != transitions_);
    });
    if (!any) return false;
    std::vector<int> number;  // of constant groups
    Chain next = chain_;
    for (const Group& g : groups) {
      std::size_t longest = g.begin;
      for (std::size_t k = g.begin; k < g.end; ++k) {
        if (chain_.length[k] > chain_.length[longest]) longest = k;
      }
      number.push_back(chain_.ends[longest][0]);
      if (!g.constant || number.back() == Chain::kStraight) continue;
      next.kappa[static_cast<std::size_t>(number.back())] =
          0.5 * (chain_.curvature(longest, 0) + chain_.curvature(longest, 1));
    }
    const auto from = static_cast<std::ptrdiff_t>(first), to = static_cast<std::ptrdiff_t>(last);
    next.length.erase(next.length.begin() + from, next.length.begin() + to);
    next.ends.erase(next.ends.begin() + from, next.ends.begin() + to);
    next.law.erase(next.law.begin() + from, next.law.begin() + to);
    std::vector<Foot> feet = feet_;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const Group& group = groups[g];
      std::array<int, 2> ends = {number[g], number[g]};
      if (!group.constant) {
        ends = {g > 0 ? number[g - 1] : chain_.ends[group.begin][0],
                g + 1 < groups.size() ? number[g + 1] : chain_.ends[group.end - 1][1]};
        if (ends[0] == ends[1]) return false;
      }
      double length = 0.0;
      for (std::size_t i = 0; i < feet.size(); ++i) {
        const std::size_t element = feet_[i].element;
        if (element < group.begin || element >= group.end) continue;
        feet[i].element = first + g;
        for (std::size_t e = group.begin; e < element; ++e) feet[i].s += chain_.length[e];
      }
      for (std::size_t e = group.begin; e < group.end; ++e) length += chain_.length[e];
      const auto at = from + static_cast<std::ptrdiff_t>(g);
      next.length.insert(next.length.begin() + at, length);
      next.ends.insert(next.ends.begin() + at, ends);
      next.law.insert(next.law.begin() + at, group.constant ? Transition::kClothoid : transitions_);
    }
    for (std::size_t i = 0; i < feet.size(); ++i) {
      if (feet_[i].element >= last)
        feet[i].element = feet_[i].element - last + first + groups.size();
    }
    const std::size_t begin = first - std::min(first, kBeside);
    const std::size_t behind = std::min(first + groups.size() + kBeside, next.size());
    const std::vector<Element> joints = chain_.joints();
    Window window = cut(next, feet, begin, behind, joints, behind + (chain_.size() - next.size()));
    return accept(std::move(next), std::move(feet), std::move(window));
  }

  /// The longest run from element k on. `slow`: up to a clothoid that bends so little that it may
  /// be an arc.
  bool take_longest(std::size_t k, bool slow) {
    for (std::size_t count = std::min(kLongestRun, chain_.size() - k); count > 0; --count) {
      const std::size_t behind = k + count;
      const bool open = behind < chain_.size() && bends(behind);
      if (open != slow || (count == 1 && !bends(k))) continue;
      if (open && !bends_less(behind, k, count)) continue;
      if (take_transition(k, count)) return true;
    }
    return false;
  }

  [[nodiscard]] bool bends_less(std::size_t element, std::size_t k, std::size_t count) const {
    const double own = chain_.curvature(element, 1) - chain_.curvature(element, 0);
    const double run = chain_.curvature(k + count - 1, 1) - chain_.curvature(k, 0);
    return std::abs(own) <= kSlow * std::abs(run);
  }

  /// Elements [k, k + count) as one, without steps where it joins the others, or with the
  /// curvatures that the first and the last have there.
  bool take_transition(std::size_t k, std::size_t count) {
    const std::size_t last = k + count - 1;
    std::array<int, 2> ends = {chain_.ends[k][0], chain_.ends[last][1]};
    std::array<int, 2> joined = ends;
    if (k > 0) joined[0] = chain_.ends[k - 1][1];
    if (last + 1 < chain_.size()) joined[1] = chain_.ends[last + 1][0];
    for (const auto& one : {joined, ends}) {
      if (one[0] != one[1] && replace(k, count, one, transitions_)) return true;
      if (joined == ends) break;
    }
    return false;
  }

  bool replace(std::size_t k, std::size_t count, const std::array<int, 2>& ends, Transition law) {
    const std::vector<Element> joints = chain_.joints();
    Chain next = chain_;
    std::vector<Foot> feet = feet_;
    for (Foot& foot : feet) {
      if (foot.element <= k) continue;
      if (foot.element >= k + count) {
        foot.element -= count - 1;
        continue;
      }
      for (std::size_t e = k; e < foot.element; ++e) foot.s += chain_.length[e];
      foot.element = k;
    }
    for (std::size_t e = k + 1; e < k + count; ++e) next.length[k] += next.length[e];
    next.ends[k] = ends;
    next.law[k] = law;
    if (k + count < chain_.size()) {  // what it leads to is an arc
      auto& behind = next.ends[k + count];
      behind[1] = behind[0];
    }
    const auto from = static_cast<std::ptrdiff_t>(k) + 1;
    const auto to = static_cast<std::ptrdiff_t>(k + count);
    next.length.erase(next.length.begin() + from, next.length.begin() + to);
    next.ends.erase(next.ends.begin() + from, next.ends.begin() + to);
    next.law.erase(next.law.begin() + from, next.law.begin() + to);
    const std::size_t first = k - std::min(k, kBeside);
    const std::size_t last = std::min(k + kBeside + 1, next.size());
    Window window = cut(next, feet, first, last, joints, last + count - 1);
    return accept(std::move(next), std::move(feet), std::move(window));
  }

  /// Another chain in the place of this one, where its window can be fitted.
  bool accept(Chain next, std::vector<Foot> feet, Window window) {
    window.held.hopeless = kHopelessOffset;
    return fits(window) && commit(std::move(next), std::move(feet), window);
  }

  bool merge(std::size_t k, const std::array<int, 2>& ends) {
    const std::vector<Element> joints = chain_.joints();
    Chain next = chain_;
    std::vector<Foot> feet = feet_;
    const auto behind = static_cast<std::ptrdiff_t>(k) + 1;
    for (Foot& foot : feet) {
      if (foot.element <= k) continue;
      if (foot.element == k + 1) foot.s += chain_.length[k];
      --foot.element;
    }
    next.length[k] += next.length[k + 1];
    next.ends[k] = ends;
    next.law[k] = ends == chain_.ends[k]       ? chain_.law[k]
                  : ends == chain_.ends[k + 1] ? chain_.law[k + 1]
                                               : std::max(chain_.law[k], chain_.law[k + 1]);
    next.length.erase(next.length.begin() + behind);
    next.ends.erase(next.ends.begin() + behind);
    next.law.erase(next.law.begin() + behind);
    const std::size_t first = k - std::min(k, kBeside);
    const std::size_t last = std::min(k + kBeside + 1, next.size());
    Window window = cut(next, feet, first, last, joints, last + 1);
    return accept(std::move(next), std::move(feet), std::move(window));
  }

  /// A condition at an element or at the joint before the next one.
  struct Candidate {
    std::size_t element = 0;
    int a = 0, b = Chain::kStraight;
    double growth = 0.0;
    double room = 0.0;  ///< the most that squares within the tolerances can be
    bool of_joint = false;
  };

  [[nodiscard]] std::pair<std::size_t, std::size_t> around(std::size_t element) const {
    return {element - std::min(element, kBeside), std::min(element + kBeside + 2, chain_.size())};
  }

  void add_candidates(std::size_t k, std::vector<Candidate>& out) const {
    const auto add = [&](int a, int b, bool of_joint = false) {
      if (a == b) return;
      if (a == Chain::kStraight) std::swap(a, b);
      out.push_back({k, a, b, 0.0, 0.0, of_joint});
    };
    const auto [k0, k1] = chain_.ends[k];
    add(k0, k1);
    if (k0 == k1 && k0 != Chain::kStraight) add(k0, Chain::kStraight);
    if (k0 != k1 && !constant_) add_straight_ends(k, add);
    // arcs without a step between them are one: merging tries that
    if (k + 1 < chain_.size() && !constant_) add(k1, chain_.ends[k + 1][0], true);
  }

  /// An end behind an inflection that is nearer to it than elements are long: LandXML would have a
  /// spiral of its own there.
  template <class Add>
  void add_straight_ends(std::size_t k, const Add& add) const {
    const double k0 = chain_.curvature(k, 0), k1 = chain_.curvature(k, 1);
    if (!(k0 * k1 < 0.0)) return;
    const double before = k0 / (k0 - k1) * chain_.length[k];
    if (before < least_length_) add(chain_.ends[k][0], Chain::kStraight);
    if (chain_.length[k] - before < least_length_) add(chain_.ends[k][1], Chain::kStraight);
  }

  Result<void> estimate(std::vector<Candidate>& candidates, const RunContext& run) const {
    for (Candidate& c : candidates) {
      OBVID_TRY(may_go_on(run));
      const auto [first, last] = around(c.element);
      Window window = cut(chain_, first, last);
      c.room = static_cast<double>(window.points.size());
      c.growth = std::numeric_limits<double>::infinity();
      if (window.points.empty()) continue;
      const auto own = [&](int number) {
        return number == Chain::kStraight
                   ? number
                   : static_cast<int>(
                         std::find(window.number.begin(), window.number.end(), number) -
                         window.number.begin());
      };
      c.growth = growth_of(window.chain, window.points, window.tolerance, window.feet, window.held,
                           own(c.a), own(c.b));
    }
    return {};
  }

  /// With squares that grow by no more than `most`; otherwise by how much it would be is noted.
  bool take(Candidate& c, double most = std::numeric_limits<double>::infinity()) {
    if (!is_used(c.a) || (c.b != Chain::kStraight && !is_used(c.b))) return false;
    const auto [first, last] = around(c.element);
    if (is_used_outside(chain_, c.a, first, last)) return false;
    Chain next = chain_;
    if (c.b != Chain::kStraight && !is_used_outside(chain_, c.b, first, last)) {
      const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);
      next.kappa[b] = 0.5 * (next.kappa[a] + next.kappa[b]);
    }
    for (auto& ends : next.ends) {
      for (int& number : ends) {
        if (number == c.a) number = c.b;
      }
    }
    Window window = cut(next, first, last);
    window.held.hopeless = kHopelessOffset;
    const double before = squares_of(window);
    const Fitted fitted = fit(window);
    if (fitted.squares - before > most) {
      c.growth = std::max(c.growth, fitted.squares - before);
      return false;
    }
    return fitted.largest <= 1.0 && commit(std::move(next), feet_, window);
  }

  /// Sum of squared offsets over tolerances, as the chain is.
  [[nodiscard]] double squares_of(const Window& window) const {
    double out = 0.0;
    for (const std::size_t i : window.numbers) {
      const double share = feet_[i].offset / tolerance_[i];
      out += share * share;
    }
    return out;
  }

  /// Elements that share a curvature follow one another: those beside the window tell.
  [[nodiscard]] bool is_used_outside(const Chain& chain, int number, std::size_t first,
                                     std::size_t last) const {
    const auto uses = [&](std::size_t element) {
      return chain.ends[element][0] == number || chain.ends[element][1] == number;
    };
    const bool before = first > 0, behind = last < chain.size();
    return (before && uses(first - 1)) || (behind && uses(last)) ||
           (closed_ && behind && !before && uses(chain.size() - 1)) ||
           (closed_ && before && !behind && uses(0));
  }

  [[nodiscard]] Element a_lap_on(Element at) const {
    at.point = at.point + lap_;
    return at;
  }

  /// Begins the chain, and the points, with element m.
  void turn_to(std::size_t m) {
    const std::vector<Element> joints = chain_.joints();
    chain_.start = joints[m].point;
    chain_.theta = joints[m].theta;
    const auto turn = [m](auto& of_elements) {
      std::rotate(of_elements.begin(), of_elements.begin() + static_cast<std::ptrdiff_t>(m),
                  of_elements.end());
    };
    turn(chain_.length);
    turn(chain_.ends);
    turn(chain_.law);
    const auto first = std::find_if(feet_.begin(), feet_.end(),
                                    [m](const Foot& foot) { return foot.element >= m; }) -
                       feet_.begin();
    for (Foot& foot : feet_) foot.element = (foot.element + chain_.size() - m) % chain_.size();
    std::rotate(feet_.begin(), feet_.begin() + first, feet_.end());
    for (auto i = points_.begin(); i < points_.begin() + first; ++i) *i = *i + lap_;
    std::rotate(points_.begin(), points_.begin() + first, points_.end());
    std::rotate(tolerance_.begin(), tolerance_.begin() + first, tolerance_.end());
    first_given_ = (first_given_ + static_cast<std::size_t>(first)) % points_.size();
  }

  /// Element k as two, which bend as they like.
  void halve(std::size_t k) {
    const double middle = 0.5 * (chain_.curvature(k, 0) + chain_.curvature(k, 1));
    const auto [k0, k1] = chain_.ends[k];
    const auto at = static_cast<std::ptrdiff_t>(k);
    const int number = static_cast<int>(chain_.kappa.size());
    chain_.kappa.insert(chain_.kappa.end(), {middle, middle});
    if (constant_) {
      chain_.ends[k] = {number, number};
      chain_.ends.insert(chain_.ends.begin() + at, {k0, k0});
    } else {
      chain_.ends[k] = {number + 1, k1};
      chain_.ends.insert(chain_.ends.begin() + at, {k0, number});
    }
    chain_.length[k] *= 0.5;
    chain_.length.insert(chain_.length.begin() + at, chain_.length[k]);
    chain_.law.insert(chain_.law.begin() + at, chain_.law[k]);
    for (Foot& foot : feet_) {
      if (foot.element < k || (foot.element == k && foot.s <= chain_.length[k])) continue;
      if (foot.element == k) foot.s -= chain_.length[k];
      ++foot.element;
    }
  }

  /// Joins the end to the start: elements around the seam, few of them and then more, are fitted
  /// between the poses of those beside them; where none will do, with one element more.
  Result<void> close(const RunContext& run) {
    points_.pop_back();
    tolerance_.pop_back();
    feet_.pop_back();
    while (chain_.size() < kLeastAround) halve(chain_.size() - 1);
    const std::vector<Element> open = chain_.joints();
    const std::size_t half = chain_.size() / 2;
    std::size_t seam = chain_.size() - half;
    turn_to(half);
    closed_ = true;
    for (int more = 0; more <= kMoreAtSeam; ++more) {
      for (std::size_t beside = kBeside; beside <= kWindow; beside *= 2) {
        OBVID_TRY(may_go_on(run));
        const std::size_t first = seam - std::min(seam, beside);
        const std::size_t last = std::min(seam + beside, chain_.size());
        Window window = cut(chain_, first, last);
        if (last < chain_.size()) window.held.end = a_lap_on(open[last - seam]);
        if (fits(window) && commit(chain_, feet_, window)) return {};
        if (first == 0 && last == chain_.size()) break;
      }
      halve(seam - 1);
      ++seam;
    }
    return fail(error(ErrorCode::kNoSpiral, "the ends of what was found could not be joined")
                    .hint("allow a larger tolerance, or leave the loop open (--open)"));
  }

  [[nodiscard]] bool is_used(int number) const {
    return std::any_of(chain_.ends.begin(), chain_.ends.end(), [&](const std::array<int, 2>& ends) {
      return ends[0] == number || ends[1] == number;
    });
  }

  /// Mean square of the offsets over the tolerances, of what the elements leave open; infinite
  /// where that is less than half of what the points tell. What is a thousandth of the tolerance
  /// counts as that.
  [[nodiscard]] double scatter() const {
    double squares = 0.0;
    for (std::size_t i = 0; i < feet_.size(); ++i) {
      const double share = feet_[i].offset / tolerance_[i];
      squares += share * share;
    }
    const std::size_t taken = kNumbersOfElement * chain_.size();
    if (feet_.size() < 2 * taken) return std::numeric_limits<double>::infinity();
    return std::max(squares / static_cast<double>(feet_.size() - taken),
                    kOfToleranceAtMost * kOfToleranceAtMost);
  }

  static Result<void> tell_kinds(const Candidate& c, const std::vector<Candidate>& all,
                                 const RunContext& run) {
    const auto done = static_cast<double>(&c - all.data());
    return tell(run, "kinds", done / static_cast<double>(all.size()));
  }

  /// Whether one was taken.
  Result<bool> take_conditions(const RunContext& run) {
    std::vector<Candidate> candidates;
    for (std::size_t k = 0; k < chain_.size(); ++k) add_candidates(k, candidates);
    OBVID_TRY(estimate(candidates, run));
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) {
                       return std::tie(a.of_joint, a.growth) < std::tie(b.of_joint, b.growth);
                     });
    // What the scatter of the points leaves open goes first, and there an element that is an arc or
    // a line before a joint without a step: where both are possible, but not together, the step is
    // what was built. What the points show not to be so, though the tolerance allows it, goes by
    // what it costs: a transition is no arc because it may be one.
    const double shown = kShown * kShown * scatter();
    bool taken = false;
    for (Candidate& c : candidates) {
      OBVID_TRY(tell_kinds(c, candidates, run));
      if (c.growth <= std::min(shown, kHopeless * c.room)) taken = take(c, shown) || taken;
    }
    if (taken || !std::isfinite(shown)) return taken;
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.growth < b.growth; });
    for (Candidate& c : candidates) {
      OBVID_TRY(tell_kinds(c, candidates, run));
      if (c.growth <= kHopeless * c.room) taken = take(c) || taken;
    }
    return taken;
  }

  std::vector<Vec2> points_;
  std::vector<double> tolerance_;
  Transition transitions_ = Transition::kClothoid;
  bool without_steps_ = false;
  bool constant_ = false;             ///< curvature of each element
  std::optional<BorneGrades> borne_;  ///< what grades have to be
  bool closed_ = false;               ///< the pose at the end is that at the start, and stays
  Vec2 lap_;                          ///< from the start to the end
  std::size_t first_given_ = 0;       ///< number, as given, of the first point
  bool mended_ = false;               ///< stretches are chords with rounded corners
  bool rounded_ = false;              ///< begun with chords whose corners are rounded
  bool others_ = false;               ///< there are other searches
  std::function<bool()> cancelled_;   ///< that fits ask
  Chain chain_;
  std::size_t begun_with_ = 0;  ///< elements
  std::vector<Foot> feet_;
  double least_length_ = 0.0;
  bool limited_length_ = false;  ///< as was asked for
  double largest_curvature_ = std::numeric_limits<double>::infinity();
};

/// The chain through nodes, with the points' feet about where they are.
void set_chain(const std::vector<Node>& nodes, std::size_t points, const Sought& sought,
               Chain& chain, std::vector<Foot>& feet) {
  chain.plane = sought.plane;
  chain.start = nodes.front().point;
  chain.theta = nodes.front().theta;
  feet.assign(points, {});
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    const Node &a = nodes[k], &b = nodes[k + 1];
    const auto piece = piece_between(sought.plane, a.point, a.theta, b.point, b.theta);
    const int next = static_cast<int>(chain.kappa.size());
    const bool grade = sought.rounded && a.theta == b.theta;
    const double k0 = piece ? piece->kappa0 : 0.0, k1 = piece ? piece->kappa1 : 0.0;
    chain.law.push_back(Transition::kClothoid);
    if (grade) {
      chain.ends.push_back({Chain::kStraight, Chain::kStraight});
    } else {
      chain.ends.push_back({next, sought.constant ? next : next + 1});
      chain.kappa.push_back(sought.constant ? 0.5 * (k0 + k1) : k0);
      if (!sought.constant) chain.kappa.push_back(k1);
    }
    chain.length.push_back(piece ? piece->length : norm(b.point - a.point));
    for (auto i = static_cast<std::size_t>(std::ceil(a.place)); static_cast<double>(i) <= b.place;
         ++i) {
      feet[i].element = k;
      feet[i].s = chain.length[k] * (static_cast<double>(i) - a.place) / (b.place - a.place);
    }
  }
}

/// What a search or a fit cannot begin with.
Result<void> check_points(const std::vector<Vec2>& points, const AlignmentOptions& options) {
  const std::size_t least = options.closed ? 3 : 2;
  if (points.size() < least) {
    return error(ErrorCode::kTooFewPoints, options.closed
                                               ? "a closed alignment needs at least three points"
                                               : "an alignment needs at least two points")
        .value(static_cast<double>(points.size()));
  }
  for (const double limit : {options.least_length, options.least_radius}) {
    if (limit >= 0.0 && std::isfinite(limit)) continue;
    return fail(
        error(ErrorCode::kBadOption, "a least length or radius must be 0 or more").value(limit));
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i] != points[i - 1]) continue;
    return error(ErrorCode::kChordReversal, "two neighbouring points coincide").point(i);
  }
  return {};
}

/// Searches, one after the other until one leads to elements within the tolerances: within a part
/// of them, as the search sees deviations to first order, and with a chord of half a kilometre
/// beside one of ten metres that is not enough; around a loop begun elsewhere, where its ends may
/// join.
///
/// Where none of these leads to elements that need no mending, what is found within smaller
/// tolerances is within the given ones: the fit has no more than that part then.
struct Attempt {
  double part;           ///< of the tolerances: the search's
  double begin;          ///< of the points
  double fit = 1.0;      ///< part of the tolerances that the fit has
  bool rounded = false;  ///< no search: the chords with rounded corners
};
constexpr std::array kAttempts = {
    Attempt{1.0, 0.0},          Attempt{1.0, 0.5},           Attempt{0.5, 0.0},
    Attempt{0.5, 0.25},         Attempt{0.25, 0.0},          Attempt{0.25, 0.75},
    Attempt{0.1, 0.5},          Attempt{0.5, 0.0, 0.5},      Attempt{0.25, 0.0, 0.25},
    Attempt{0.125, 0.0, 0.125}, Attempt{0.0625, 0.0, 0.0625}};
/// That which is mended however much of it has to be: no other has all of the tolerances.
constexpr double kMendedPart = 0.1;

/// Points beyond which the first elements that are found are taken, and those of a search are made
/// fewer even where they leave the tolerance: another search takes some seconds, and chords are
/// short. Not of profiles: that of as many heights is faster.
constexpr std::size_t kMostSearchedAgain = 400;

/// Other elements than those that left the tolerance: less is asked of them, or more of what no
/// limit was given for.
std::string advice_for_others(const AlignmentOptions& options, const Sought& sought) {
  std::string out = advice_to_allow_more(options);
  // profiles have no least radius
  const bool radii = !sought.constant || options.without_transitions;
  if (options.least_length == 0.0 && (options.least_radius == 0.0 && radii)) {
    return out + ", or set a least length or radius: other elements may do";
  }
  if (options.least_length == 0.0) return out + ", or set a least length: other elements may do";
  if (options.least_radius == 0.0 && radii) {
    return out + ", or set a least radius: other elements may do";
  }
  return out;
}

/// What is begun with where no search came to elements: on a map, where no limits are given.
constexpr Attempt kRoundedChords = {1.0, 0.0, 1.0, true};

std::vector<Node> rounded_nodes(const std::vector<Vec2>& points,
                                const std::vector<double>& tolerance,
                                const AlignmentOptions& options, const Sought& sought) {
  if (sought.rounded) {
    return rounded_grades(points, tolerance, sought.plane == Plane::kMap, sought.lap.x);
  }
  return options.closed ? rounded_corners_around(points, tolerance)
                        : rounded_corners(points, tolerance);
}

/// Of a loop: leaves out the last point, the first one again, and begins with the one behind the
/// first node. Its number is returned; places of nodes count from it then.
std::size_t begin_at_first_behind(std::vector<Node>& nodes, Vec2 lap, std::vector<Vec2>& points,
                                  std::vector<double>& tolerance) {
  const double first = std::ceil(nodes.front().place);
  const auto begin = static_cast<std::size_t>(first);
  for (Node& node : nodes) node.place -= first;
  for (std::size_t i = 0; i < begin; ++i) points[i] = points[i] + lap;
  points.pop_back();
  tolerance.pop_back();
  const auto turn = [begin](auto& of_points) {
    std::rotate(of_points.begin(), of_points.begin() + static_cast<std::ptrdiff_t>(begin),
                of_points.end());
  };
  turn(points);
  turn(tolerance);
  return begin;
}

/// Elements from one of these searches, or of the chords with rounded corners.
Result<Simplifier> searched(std::vector<Vec2> points, std::vector<double> tolerance,
                            const AlignmentOptions& options, const Sought& sought,
                            const Attempt& attempt, bool others, const RunContext& run) {
  std::vector<Node> rounded;
  if (attempt.rounded) {
    rounded = rounded_nodes(points, tolerance, options, sought);
  }
  std::size_t begin = 0;
  if (options.closed && attempt.rounded) {
    begin = begin_at_first_behind(rounded, sought.lap, points, tolerance);
  } else if (options.closed) {  // the last point is the first one again
    const std::size_t n = points.size() - 1;
    begin = static_cast<std::size_t>(attempt.begin * static_cast<double>(n));
    for (std::size_t i = 0; i < begin; ++i) points[i] = points[i] + sought.lap;
    const auto turn = [begin](auto& of_points) {
      of_points.pop_back();
      std::rotate(of_points.begin(), of_points.begin() + static_cast<std::ptrdiff_t>(begin),
                  of_points.end());
      of_points.push_back(of_points.front());
    };
    turn(points);
    points.back() = points.back() + sought.lap;
    turn(tolerance);
  }
  std::vector<double> within = tolerance;
  const double part =
      attempt.part * (options.without_steps && !sought.constant ? kBeforeTransitions : 1.0);
  for (double& one : within) one *= part;
  for (double& one : tolerance) one *= attempt.fit;
  Sought search = sought;
  if (sought.corners) search.plane = Plane::kGraph;  // for arcs likewise: they begin as parabolas
  auto nodes = attempt.rounded ? Result<std::vector<Node>>(std::move(rounded))
                               : fewest_pieces(points, within, options, search, run);
  OBVID_TRY(nodes);
  if (search.plane != sought.plane) {
    for (Node& node : *nodes) node.theta = std::atan(node.theta);
  }
  Chain chain;
  std::vector<Foot> feet;
  set_chain(*nodes, points.size(), sought, chain, feet);
  find_feet(chain, points, feet);
  Simplifier out(std::move(points), std::move(tolerance), options, sought, std::move(chain),
                 std::move(feet), begin, attempt.rounded, others, run);
  OBVID_TRY(options.closed ? out.run_around(run) : out.run(run));
  const double largest = out.largest();
  if (!(largest <= 1.0)) {
    return fail(
        error(ErrorCode::kToleranceNotReached, "the alignment that was found leaves the tolerance")
            .hint(advice_for_others(options, sought))
            .value(largest));
  }
  if (out.winds()) {
    return fail(error(ErrorCode::kToleranceNotReached,
                      "the alignment that was found winds between neighbouring points")
                    .hint(advice_for_others(options, sought)));
  }
  return out;
}

}  // namespace

Result<FoundChain> find_chain(const std::vector<Vec2>& given, const std::vector<double>& tolerance,
                              const AlignmentOptions& options, const Sought& sought,
                              const RunContext& asked) {
  OBVID_TRY(check_points(given, options));
  // loops within loops ask; who started it is not asked again once it said so
  bool stopped = false;
  RunContext run = asked;
  if (asked.cancelled) run.cancelled = [&] { return stopped = stopped || asked.cancelled(); };
  FoundChain out;
  // coordinates of maps are far from their origin
  out.origin = given.front();
  std::vector<Vec2> points;
  points.reserve(given.size() + 1);
  for (const Vec2 p : given) points.push_back(p - out.origin);
  std::vector<double> allowed = tolerance;
  if (options.closed) {
    auto circle = sought.lap == Vec2{} ? whole_circle(points, tolerance) : std::nullopt;
    if (circle) {
      if (!(std::abs(circle->chain.kappa.front()) * options.least_radius > 1.0)) {
        circle->origin = out.origin;
        return *circle;
      }
    }
    points.push_back(points.front() + sought.lap);
    allowed.push_back(allowed.front());
  }
  double best_fit = 1.0;
  const auto result_of = [&](const Simplifier& found) {
    out.chain = found.chain();
    out.found_within = best_fit;
    out.has_chords = found.is_mended() || found.is_rounded();
    for (std::size_t i = 0; i < given.size(); ++i) out.feet.push_back(found.foot_of_given(i));
    return out;
  };
  if (sought.rounded) {
    auto found = searched(points, allowed, options, sought, kRoundedChords, false, run);
    if (stopped) return fail(cancelled_error());
    OBVID_TRY(found);
    return result_of(*found);
  }
  std::optional<Error> first;
  std::optional<Simplifier> best;
  const bool profile = sought.constant && !options.without_transitions;
  const bool again = profile || given.size() <= kMostSearchedAgain;
  double tried = 0.0;  // of open points it is all the same where they begin
  for (const Attempt& attempt : kAttempts) {
    if (!options.closed && attempt.part == tried && attempt.fit == 1.0) continue;
    tried = attempt.part;
    const bool others = (again || first) && attempt.part != kMendedPart;
    auto found = searched(points, allowed, options, sought, attempt, others, run);
    if (found) {
      const bool whole = !found->is_mended() && !found->has_more_than_open();
      if (!best || found->chain().size() < best->chain().size()) {
        best = std::move(*found);
        best_fit = attempt.fit;
      }
      if (whole || !again) break;
      continue;
    }
    const ErrorCode code = found.error().code;
    const bool by_search = code == ErrorCode::kNoSpiral || code == ErrorCode::kToleranceNotReached;
    if (!by_search) return fail(found.error());
    if (!first) first = found.error();
  }
  if (stopped) return fail(cancelled_error());
  if (!options.closed && (!best || best->chain().size() > 1)) {
    // to the edge of the tolerance, where searches and least squares end before it
    const double sharpest = options.least_radius > 0.0 ? 1.0 / options.least_radius : HUGE_VAL;
    if (auto one = one_element(sought.plane, points, allowed, sharpest)) {
      one->origin = out.origin;
      return *one;
    }
  }
  if (best) return result_of(*best);
  const bool limits = options.least_length > 0.0 || options.least_radius > 0.0;
  if (sought.plane == Plane::kMap && !sought.constant && !limits) {
    auto found = searched(points, allowed, options, sought, kRoundedChords, false, run);
    if (stopped) return fail(cancelled_error());
    if (found) return result_of(*found);
  }
  return fail(*first);
}

}  // namespace obvid::alignment
