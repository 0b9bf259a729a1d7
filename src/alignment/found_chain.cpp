// SPDX-License-Identifier: Apache-2.0
#include "found_chain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "fewest_pieces.h"
#include "one_element.h"
#include "rounded_corners.h"
#include "simplified_chain.h"
#include "whole_circle.h"

namespace obvid::alignment {
namespace {

/// The chain through nodes, with the points' feet about where they are.
FootedChain chain_through(const std::vector<Node>& nodes, std::size_t points,
                          const Sought& sought) {
  FootedChain out;
  Chain& chain = out.chain;
  chain.plane = sought.plane;
  chain.start = nodes.front().point;
  chain.theta = nodes.front().theta;
  out.feet.assign(points, {});
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
      out.feet[i].element = k;
      out.feet[i].s = chain.length[k] * (static_cast<double>(i) - a.place) / (b.place - a.place);
    }
  }
  return out;
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

std::vector<Node> rounded_nodes(const TolerantPoints& row, const AlignmentOptions& options,
                                const Sought& sought) {
  if (sought.rounded) {
    return rounded_grades(row.points, row.tolerance, sought.plane == Plane::kMap, sought.lap.x);
  }
  return options.closed ? rounded_corners_around(row.points, row.tolerance)
                        : rounded_corners(row.points, row.tolerance);
}

/// Of a loop, whose last point is the first one again: begins with another one, and ends with it if
/// `again`.
void begin_at(std::size_t begin, TolerantPoints& row, bool again) {
  for (std::size_t i = 0; i < begin; ++i) row.points[i] = row.points[i] + row.lap;
  const auto turn = [&](auto& of_points) {
    of_points.pop_back();
    std::rotate(of_points.begin(), of_points.begin() + static_cast<std::ptrdiff_t>(begin),
                of_points.end());
    if (again) of_points.push_back(of_points.front());
  };
  turn(row.points);
  turn(row.tolerance);
  if (again) row.points.back() = row.points.back() + row.lap;
  row.first_given = begin;
}

/// Turns a loop to where this attempt begins, and the rounded chords, if these are what it is begun
/// with, to the first node's.
void turn_loop(TolerantPoints& row, const Attempt& attempt, std::vector<Node>& rounded) {
  if (!attempt.rounded) {
    const auto points = static_cast<double>(row.points.size() - 1);
    return begin_at(static_cast<std::size_t>(attempt.begin * points), row, true);
  }
  const double first = std::ceil(rounded.front().place);
  for (Node& node : rounded) node.place -= first;
  begin_at(static_cast<std::size_t>(first), row, false);
}

/// Elements from one of these searches, or of the chords with rounded corners.
Result<SimplifiedChain> searched(TolerantPoints row, const AlignmentOptions& options,
                                 const Sought& sought, const Attempt& attempt, bool others,
                                 const RunContext& run) {
  std::vector<Node> rounded;
  if (attempt.rounded) rounded = rounded_nodes(row, options, sought);
  if (options.closed) turn_loop(row, attempt, rounded);
  std::vector<double> within = row.tolerance;
  const double part =
      attempt.part * (options.without_steps && !sought.constant ? kBeforeTransitions : 1.0);
  for (double& one : within) one *= part;
  for (double& one : row.tolerance) one *= attempt.fit;
  Sought search = sought;
  if (sought.corners) search.plane = Plane::kGraph;  // for arcs likewise: they begin as parabolas
  auto nodes = attempt.rounded ? Result<std::vector<Node>>(std::move(rounded))
                               : fewest_pieces(row.points, within, options, search, run);
  OBVID_TRY(nodes);
  if (search.plane != sought.plane) {
    for (Node& node : *nodes) node.theta = std::atan(node.theta);
  }
  FootedChain begun = chain_through(*nodes, row.points.size(), sought);
  find_feet(begun.chain, row.points, begun.feet);
  SimplifiedChain out(std::move(row), std::move(begun), options, sought, {attempt.rounded, others},
                      run);
  OBVID_TRY(options.closed ? out.run_around(run) : out.run(run));
  const double largest = out.on_points().largest();
  if (!(largest <= 1.0)) {
    return fail(
        error(ErrorCode::kToleranceNotReached, "the alignment that was found leaves the tolerance")
            .hint(advice_for_others(options, sought))
            .value(largest));
  }
  if (out.on_points().winds()) {
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
  TolerantPoints row{{}, tolerance, sought.lap, 0};
  row.points.reserve(given.size() + 1);
  for (const Vec2 p : given) row.points.push_back(p - out.origin);
  if (options.closed) {
    auto circle = sought.lap == Vec2{} ? whole_circle(row.points, tolerance) : std::nullopt;
    if (circle && !(std::abs(circle->chain.kappa.front()) * options.least_radius > 1.0)) {
      circle->origin = out.origin;
      return *circle;
    }
    row.points.push_back(row.points.front() + sought.lap);
    row.tolerance.push_back(row.tolerance.front());
  }
  double best_fit = 1.0;
  const auto result_of = [&](const SimplifiedChain& found) {
    out.chain = found.on_points().chain();
    out.found_within = best_fit;
    out.has_chords = found.has_chords();
    for (std::size_t i = 0; i < given.size(); ++i) {
      out.feet.push_back(found.on_points().foot_of_given(i));
    }
    return out;
  };
  if (sought.rounded) {
    auto found = searched(row, options, sought, kRoundedChords, false, run);
    if (stopped) return fail(cancelled_error());
    OBVID_TRY(found);
    return result_of(*found);
  }
  std::optional<Error> first;
  std::optional<SimplifiedChain> best;
  const auto size_of_best = [&] { return best->on_points().size(); };
  const bool profile = sought.constant && !options.without_transitions;
  const bool again = profile || given.size() <= kMostSearchedAgain;
  double tried = 0.0;  // of open points it is all the same where they begin
  for (const Attempt& attempt : kAttempts) {
    if (!options.closed && attempt.part == tried && attempt.fit == 1.0) continue;
    tried = attempt.part;
    const bool others = (again || first) && attempt.part != kMendedPart;
    auto found = searched(row, options, sought, attempt, others, run);
    if (found) {
      const bool whole = !found->is_mended() && !found->has_more_than_open();
      if (!best || found->on_points().size() < size_of_best()) {
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
  if (!options.closed && (!best || size_of_best() > 1)) {
    // to the edge of the tolerance, where searches and least squares end before it
    const double sharpest = options.least_radius > 0.0 ? 1.0 / options.least_radius : HUGE_VAL;
    if (auto one = one_element(sought.plane, row.points, row.tolerance, sharpest)) {
      one->origin = out.origin;
      return *one;
    }
  }
  if (best) return result_of(*best);
  const bool limits = options.least_length > 0.0 || options.least_radius > 0.0;
  if (sought.plane == Plane::kMap && !sought.constant && !limits) {
    auto found = searched(row, options, sought, kRoundedChords, false, run);
    if (stopped) return fail(cancelled_error());
    if (found) return result_of(*found);
  }
  return fail(*first);
}

}  // namespace obvid::alignment
