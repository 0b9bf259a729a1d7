// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "biarc_along.h"
#include "fewer_arcs.h"
#include "obvid/contour/arcs/arcs_along.h"
#include "obvid/curve/internal/path_distance.h"

namespace obvid {
namespace {

using arcs::Node;
using arcs::PairCurvatures;
using arcs::SmoothPart;
using arcs::Track;

/// An arc of length l that meets a curve at its ends and its middle leaves it by r l^3 / kBest
/// where the curvature changes at the rate r: 216/sqrt(3), docs/methods/gcode.md.
constexpr double kBest = 124.707658144959;
/// Parts of the best heading's angle that are tried at each node. With more than 0.93 of it the
/// lengths that are near enough are no longer one interval; 0.8 costs 6 % of the length.
constexpr std::array kParts = {0.8, 0.4, 0.0};
constexpr double kManyArcs = 1000.0;      // from here on only the first of them
constexpr double kOfArcTolerance = 0.99;  // what sampling may miss
constexpr double kSpanAccuracy = 0.01;    // of a pair: how exactly its end is found
constexpr double kShortestArc = 1e-12;    // of a contour: arcs of that length are rounding
/// Of a stretch: where the search for the length of arcs begins. Curvatures at the ends and in the
/// middle of a whole symmetric contour are equal, as if it were a circle.
constexpr double kFirstPeriod = 1.0 / 64.0;
constexpr double kMostLean = 0.2;  // rad, between a node's heading and the contour's
constexpr std::size_t kMostArcs = 1000000;
constexpr std::size_t kEvened = 20;      // pairs before the end of a stretch that are made alike
constexpr int kEvenings = 5;             // bisections for that
constexpr std::size_t kMostFitted = 80;  // pairs of a stretch that are fitted together
constexpr std::size_t kWindow = 60;      // pairs of longer ones that are
constexpr std::size_t kMostInWindows = 2000;

/// Pairs in a row: the node before each, and the last one.
using Chain = std::vector<Node>;

/// Pairs of arcs along a part of a contour without corners, lines and arcs.
class StretchArcs {
 public:
  StretchArcs(const Track& track, const SmoothPart& stretch, double tolerance, std::size_t parts,
              bool fitted, Watch* watch)
      : track_(track),
        closed_(stretch.closed),
        from_(track.start_of(stretch.first)),
        to_(track.start_of(stretch.end)),
        vertices_(track.vertices(stretch)),
        tolerance_(tolerance),
        parts_(parts),
        fitted_(fitted),
        watch_(watch),
        period_(kFirstPeriod * (to_ - from_)) {
    if (closed_) seam_lean_ = kParts.front() * lean(from_, tolerance_);
  }

  /// Nothing when no pair is near enough, however short, more than `most` arcs are needed, or the
  /// watch ends it.
  std::optional<Chain> run(std::size_t most) {
    auto chain = fewest(node(from_, tolerance_, 0.0), tolerance_, most / 2);
    if (!chain) return std::nullopt;
    if (auto fewer = fewer_than(*chain)) return fewer;
    even_out(*chain);
    return chain;
  }

 private:
  /// Curvature; of a closed contour also beyond its ends.
  [[nodiscard]] double kappa(double s) const {
    if (closed_ && s < from_) s += to_ - from_;
    if (closed_ && s > to_) s -= to_ - from_;
    return curvature(track_.jet(s, s >= to_));
  }

  /// How the curvature changes around a place: at length `l`, and up and down together.
  struct Change {
    double signed_change, variation;
  };
  [[nodiscard]] Change change(double s, double l) const {
    const double low = closed_ ? s - 0.5 * l : std::max(from_, s - 0.5 * l);
    const double high = closed_ ? s + 0.5 * l : std::min(to_, s + 0.5 * l);
    const double k0 = kappa(low), k = kappa(s), k1 = kappa(high), scale = l / (high - low);
    return {(k1 - k0) * scale, (std::abs(k1 - k) + std::abs(k - k0)) * scale};
  }

  /// Length of the arcs around a place in the best approximation.
  double period(double s, double tolerance) const {
    const double most = to_ - from_, least = kShortestArc * most;
    const auto too_long = [&](double l) {
      return change(s, l).variation * l * l > kBest * tolerance;
    };
    double l = std::clamp(period_, least, most);
    const bool shrink = too_long(l);
    double other = l;
    while (too_long(l) == shrink) {
      other = l;
      l = shrink ? 0.5 * l : 2.0 * l;
      if (l >= most || l <= least) break;
    }
    double good = std::clamp(shrink ? l : other, least, most);
    double bad = std::min(shrink ? other : l, most);
    constexpr int kHalvings = 5;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = std::sqrt(good * bad);
      (too_long(middle) ? bad : good) = middle;
    }
    period_ = good;
    return good;
  }

  /// Angle from the contour's heading to that of the best approximation, at one of its nodes.
  double lean(double s, double tolerance) const {
    const double l = period(s, tolerance);
    const Change c = change(s, l);
    const double evenness = c.variation > 0.0 ? c.signed_change / c.variation : 0.0;
    return -evenness * std::min(kMostLean, kBest / 12.0 * tolerance / l);
  }

  /// The node at a place, its heading off the contour's by a part of the lean there. At the ends of
  /// the stretch the heading is the contour's.
  [[nodiscard]] Node node(double s, double tolerance, double part) const {
    const Jet jet = track_.jet(s, s >= to_);
    const bool end = s <= from_ || s >= to_;
    const double off = end ? seam_lean_ : part == 0.0 ? 0.0 : part * lean(s, tolerance);
    return {s, jet.point, heading(jet.d1) + off};
  }

  struct Step {
    Node node;
    PairCurvatures kappa;
  };

  /// The longest pair from a node that ends with a part of the lean.
  std::optional<Step> longest(const Node& start, double tolerance, double guess,
                              double part) const {
    std::optional<Step> good;
    double bad = to_, span = guess;
    bool was_bad = false;
    const double room = to_ - start.s, least = kShortestArc * (to_ - from_);
    const auto attempt = [&](double s) {
      const Node b = node(s, tolerance, part);
      const auto pair = arcs::pair_along(track_, start, b, tolerance);
      if (pair) good = {b, *pair};
      if (!pair) {
        bad = s;
        was_bad = true;
      }
      return pair.has_value();
    };
    constexpr double kGrow = 1.4;
    while (!good) {
      if (span < least) return std::nullopt;
      if (attempt(span < room ? start.s + span : to_)) break;
      span = std::min(span, room) / kGrow;
    }
    while (!was_bad && good->node.s < to_) {
      const double next = start.s + kGrow * (good->node.s - start.s);
      if (!attempt(std::min(to_, next))) break;
    }
    while (was_bad && bad - good->node.s > kSpanAccuracy * (bad - start.s)) {
      attempt(0.5 * (bad + good->node.s));
    }
    return good;
  }

  /// A chain's last pair, for one part of the lean at its end.
  struct State {
    Step step;
    Node start;
    std::size_t before = 0;  ///< state of the level before
    bool monotone = true;    ///< the arcs' curvatures change as the contour's
  };
  using Level = std::array<std::optional<State>, kParts.size()>;

  /// Whether the curvatures of a pair, and of the arc before it, change the way the contour's do.
  [[nodiscard]] bool is_monotone(const State& last, const Step& step) const {
    if (turns_inside(last.start.s, step.node.s)) return true;
    const double k0 = step.kappa.first, k1 = step.kappa.second;
    const double change = kappa(step.node.s) - kappa(last.start.s);
    const bool first = last.start.s == last.step.node.s;
    const double before = first ? k0 : last.step.kappa.second;
    return change > 0.0 ? before <= k0 && k0 <= k1 : before >= k0 && k0 >= k1;
  }

  /// From the states of one level the farthest ones of the next; monotone ones come first.
  Level advance(const Level& level, double tolerance) const {
    Level next;
    for (std::size_t i = 0; i < parts_; ++i) {
      if (!level[i]) continue;
      const Node& start = level[i]->step.node;
      double guess = 2.0 * period(start.s, tolerance);
      for (std::size_t j = 0; j < parts_; ++j) {
        const auto step = longest(start, tolerance, guess, kParts[j]);
        if (!step) continue;
        guess = step->node.s - start.s;
        const bool monotone = level[i]->monotone && is_monotone(*level[i], *step);
        if (!next[j] || std::pair(monotone, step->node.s) >
                            std::pair(next[j]->monotone, next[j]->step.node.s)) {
          next[j] = {*step, start, i, monotone};
        }
      }
    }
    return next;
  }

  [[nodiscard]] bool turns_inside(double from, double to) const {
    const auto first = std::upper_bound(vertices_.begin(), vertices_.end(), from);
    return first != vertices_.end() && *first < to;
  }

  /// Fewest pairs from a node to the end of the stretch, at most `most`.
  std::optional<Chain> fewest(const Node& start, double tolerance, std::size_t most) const {
    std::vector<Level> levels(1);
    levels[0][0] = State{{start, {}}, start};
    for (std::size_t n = 1; n <= most && !is_to_end(watch_); ++n) {
      levels.push_back(advance(levels.back(), tolerance));
      std::optional<std::size_t> done;
      bool any = false;
      for (std::size_t j = 0; j < parts_; ++j) {
        const auto& state = levels.back()[j];
        any = any || state.has_value();
        const bool better = !done || (state && state->monotone && !levels.back()[*done]->monotone);
        if (state && state->step.node.s >= to_ && better) done = j;
      }
      if (done) return chain_to(levels, *done);
      if (!any) return std::nullopt;
    }
    return std::nullopt;
  }

  [[nodiscard]] static Chain chain_to(const std::vector<Level>& levels, std::size_t state) {
    Chain chain = {levels.back()[state]->step.node};
    for (std::size_t n = levels.size() - 1; n > 0; --n) {
      chain.push_back(levels[n][state]->start);
      state = levels[n][state]->before;
    }
    std::reverse(chain.begin(), chain.end());
    return chain;
  }

  /// Fewer pairs whose nodes may lie anywhere, as few as are found; nothing where there are none.
  [[nodiscard]] std::optional<Chain> fewer_than(const Chain& chain) const {
    const std::size_t had = chain.size() - 1;
    if (!fitted_ || had < 2 || had > kMostInWindows) return std::nullopt;
    const bool was_monotone = is_monotone(chain);
    if (had <= kMostFitted) {
      return fewest_fitted({track_, from_, to_, closed_, tolerance_}, had - 1, was_monotone);
    }
    return fewer_in_windows(chain, was_monotone);
  }

  /// The node about there beside which the curvature goes one way: at an extremum of it arcs that
  /// have the contour's heading there would not.
  [[nodiscard]] std::size_t window_end(const Chain& chain, std::size_t about) const {
    constexpr std::size_t kBeside = 3, kFarthest = kWindow / 4;
    for (std::size_t away = 0; away < kFarthest; ++away) {
      for (const std::size_t i : {about - away, about + away}) {
        const std::size_t last = std::min(i + kBeside, chain.size() - 1);
        if (!turns_inside(chain[i - kBeside].s, chain[last].s)) return i;
      }
    }
    return about;
  }

  /// The same of a long chain: of windows one after another, which meet at places of the contour
  /// with its headings.
  [[nodiscard]] std::optional<Chain> fewer_in_windows(const Chain& chain, bool monotone) const {
    const std::size_t had = chain.size() - 1, windows = (had + kWindow - 1) / kWindow;
    Chain out;
    for (std::size_t w = 0; w < windows; ++w) {
      const std::size_t first = w == 0 ? 0 : window_end(chain, w * had / windows);
      const std::size_t last = w + 1 == windows ? had : window_end(chain, (w + 1) * had / windows);
      const arcs::PairsAlong along{track_, chain[first].s, chain[last].s, false, tolerance_};
      const auto found = fewest_fitted(along, last - first, monotone);
      if (!found) return std::nullopt;
      // a node tells the legs of the pair before it: where windows meet it is the first one's
      out.insert(out.end(), found->begin() + (out.empty() ? 0 : 1), found->end());
    }
    const bool better = out.size() < chain.size() && (!monotone || is_monotone(out));
    return better ? std::optional(std::move(out)) : std::nullopt;
  }

  /// At most so many pairs between two places, as few as are found.
  [[nodiscard]] std::optional<Chain> fewest_fitted(const arcs::PairsAlong& along, std::size_t most,
                                                   bool monotone) const {
    const auto best = static_cast<std::size_t>(0.5 * arcs::best_number_of_arcs(along));
    const auto fitted = [&](std::size_t pairs) {
      auto out = arcs::fitted_pairs(along, pairs, watch_);
      if (out && monotone && !is_monotone(*out)) out.reset();
      return out;
    };
    std::size_t pairs = std::clamp<std::size_t>(best + 1, 1, most);
    std::optional<Chain> found = fitted(pairs);
    while (!found && ++pairs <= most && !is_to_end(watch_)) found = fitted(pairs);
    for (; found && pairs > 1 && !is_to_end(watch_); --pairs) {
      auto next = fitted(pairs - 1);
      if (!next) break;
      found = std::move(next);
    }
    return found;
  }

  /// Whether the curvatures of arcs change as the contour's do.
  [[nodiscard]] bool is_monotone(const Chain& chain) const {
    struct Arc {
      double from, to, kappa;
    };
    std::vector<Arc> all;
    for (std::size_t i = 1; i < chain.size(); ++i) {
      const auto pair = arcs::circles_between(chain[i - 1], chain[i]);
      const double a = chain[i - 1].s, b = chain[i].s, middle = 0.5 * (a + b);
      all.push_back({a, middle, pair.first.kappa});
      all.push_back({middle, b, pair.second.kappa});
    }
    for (std::size_t i = 1; i < all.size(); ++i) {
      if (turns_inside(all[i - 1].from, all[i].to)) continue;
      const double change = kappa(all[i].to) - kappa(all[i - 1].from);
      if ((all[i].kappa - all[i - 1].kappa) * change < 0.0) return false;
    }
    return true;
  }

  /// The same number of pairs with a smaller tolerance, so that the last one is as long as others.
  void even_out(Chain& chain) const {
    const std::size_t n = std::min(chain.size() - 1, kEvened), kept = chain.size() - 1 - n;
    if (n < 2) return;
    const double fewer = 1.0 - 1.0 / static_cast<double>(n);
    double low = 0.5 * fewer * fewer * fewer, high = 1.0;
    for (int i = 0; i < kEvenings; ++i) {
      const double middle = 0.5 * (low + high);
      const auto other = fewest(chain[kept], middle * tolerance_, n);
      (other ? high : low) = middle;
      if (!other) continue;
      chain.resize(kept);
      chain.insert(chain.end(), other->begin(), other->end());
    }
  }

  const Track& track_;
  bool closed_;
  double from_, to_;
  std::vector<double> vertices_;
  double tolerance_;
  std::size_t parts_;  ///< how many of kParts are tried
  bool fitted_;        ///< whether fewer are looked for
  Watch* watch_;
  mutable double period_;  ///< the last one found: where to look for the next
  double seam_lean_ = 0.0;
};

Error not_reached(const char* what, double deviation) {
  return error(ErrorCode::kToleranceNotReached, what)
      .hint("allow a larger tolerance")
      .value(deviation);
}

/// Arcs that the best approximation takes, roughly.
double expected_arcs(const Contour& contour, double tolerance) {
  constexpr int kPlaces = 4;  // of a piece
  double sum = 0.0;
  for (const Piece& piece : contour.pieces) {
    if (arcs::is_circular(piece)) continue;
    for (int k = 0; k < kPlaces; ++k) {
      const Jet jet = evaluate(piece, (k + 0.5) / kPlaces);
      sum += norm(jet.d1) / kPlaces * std::cbrt(std::abs(curvature_rate(jet)) / tolerance / kBest);
    }
  }
  return sum;
}

Result<std::vector<Piece>> all_arcs(const Track& track, double tolerance, double expected,
                                    bool fitted, Watch* watch) {
  const std::size_t parts = expected > kManyArcs ? 1 : kParts.size();
  std::vector<Piece> out;
  for (const SmoothPart& stretch : track.stretches()) {
    if (stretch.exact) {
      out.push_back(arcs::as_circular(track.piece(stretch.first)));
      continue;
    }
    const auto chain = StretchArcs(track, stretch, tolerance, parts, fitted, watch).run(kMostArcs);
    if (is_to_end(watch)) return fail(cancelled_error());
    if (!chain || out.size() + 2 * chain->size() > kMostArcs) {
      return fail(not_reached("no million arcs are near enough to the contour", tolerance));
    }
    for (std::size_t i = 1; i < chain->size(); ++i) {
      const auto pair = arcs::arcs_between((*chain)[i - 1], (*chain)[i]);
      out.insert(out.end(), pair.begin(), pair.end());
    }
  }
  return out;
}

}  // namespace

Result<ArcsAlong> arcs_along(const Contour& contour, double tolerance, Watch* watch) {
  if (!(tolerance > 0.0)) {
    return error(ErrorCode::kBadOption, "the tolerance must be greater than 0").value(tolerance);
  }
  if (contour.pieces.empty()) {
    return error(ErrorCode::kNothingThere, "the contour has no pieces");
  }
  constexpr double kRough = 2.0;  // the estimate against the limit
  const double expected = expected_arcs(contour, tolerance);
  if (!(expected <= kRough * static_cast<double>(kMostArcs))) {
    return fail(not_reached("more than a million arcs would be needed", expected));
  }
  const Track track(contour);
  if (std::all_of(contour.pieces.begin(), contour.pieces.end(), arcs::is_circular)) {
    auto same = all_arcs(track, tolerance, expected, false, watch);
    OBVID_TRY(same);
    return ArcsAlong{std::move(*same), 0.0};
  }
  constexpr int kTrials = 5;
  constexpr double kSampledBadly = 1.05;  // of the tolerance, by what was found with samples
  constexpr double kNearerOnce = 0.7;     // of the tolerance: what is tried then
  double within = kOfArcTolerance * tolerance;
  bool fitted = true;
  ArcsAlong out;
  for (int trial = 0; trial < kTrials; ++trial) {
    auto pieces = all_arcs(track, within, expected, fitted, watch);
    OBVID_TRY(pieces);
    out.pieces = std::move(*pieces);
    out.deviation = path_distance(contour.pieces, out.pieces, watch);
    if (is_to_end(watch)) return fail(cancelled_error());
    if (out.deviation <= tolerance) return out;
    const double share = kOfArcTolerance * tolerance / out.deviation;
    const bool badly = fitted && out.deviation > kSampledBadly * tolerance;
    if (badly && trial > 0) {
      fitted = false;
      within = kOfArcTolerance * tolerance;
      continue;
    }
    within *= badly ? std::max(share, kNearerOnce) : share;
  }
  return fail(not_reached("the arcs do not come near enough to the contour", out.deviation));
}

}  // namespace obvid
