// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "fewest_pieces.h"
#include "found_chain.h"
#include "obvid/alignment/alignment.h"

namespace obvid {
namespace alignment {
namespace {

AlignmentKind kind_of(const std::array<int, 2>& ends, Transition law) {
  if (ends[0] != ends[1]) {
    return static_cast<AlignmentKind>(static_cast<int>(AlignmentKind::kClothoid) +
                                      static_cast<int>(law));
  }
  return ends[0] == Chain::kStraight ? AlignmentKind::kLine : AlignmentKind::kArc;
}

/// The alignment begins and ends at feet of points, to which equations are solved: what they leave
/// is rounding.
double on_the_end(double station, double length) {
  constexpr double kSolved = 1e-9;  // of the length
  for (const double end : {0.0, length}) {
    if (std::abs(station - end) <= kSolved * length) return end;
  }
  return station;
}

/// Below the last digit of coordinates an offset is none: lines through points on them leave
/// 5e-156.
double beyond_rounding(double offset, double rounding) {
  return std::abs(offset) <= rounding ? 0.0 : offset;
}

Alignment alignment_of(const Chain& chain, const std::vector<Foot>& feet,
                       const std::vector<double>& tolerance, bool closed) {
  Alignment out;
  out.closed = closed;
  const std::vector<Element> joints = chain.joints();
  for (const double length : chain.length) out.length += length;
  std::vector<double> station = {0.0};
  if (closed) station[0] = -feet.front().s;  // of the first point, on the first element, it is 0
  for (std::size_t k = 0; k < chain.size(); ++k) {
    AlignmentElement e;
    e.kind = kind_of(chain.ends[k], chain.law[k]);
    e.station = station.back();
    e.start = joints[k];
    e.length = chain.length[k];
    e.kappa1 = chain.curvature(k, 1);
    const std::size_t before = k > 0 ? k - 1 : chain.size() - 1;
    e.step = (k > 0 || closed) && chain.ends[before][1] != chain.ends[k][0];
    station.push_back(station.back() + e.length);
    out.elements.push_back(e);
  }
  out.end = joints.back();
  if (closed) out.end.point = joints.front().point;
  double squares = 0.0, coordinate = 0.0;
  for (const Element& joint : joints) {
    coordinate = std::max({coordinate, std::abs(joint.point.x), std::abs(joint.point.y)});
  }
  const double rounding = std::numeric_limits<double>::epsilon() * coordinate;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const double offset = beyond_rounding(feet[i].offset, rounding);
    double at = station[feet[i].element] + feet[i].s;
    if (closed && at >= station[0] + out.length) at -= out.length;
    if (!closed) at = on_the_end(at, out.length);
    out.deviations.push_back({at, offset});
    out.largest_share = std::max(out.largest_share, std::abs(offset) / tolerance[i]);
    squares += offset * offset;
  }
  out.rms = std::sqrt(squares / static_cast<double>(feet.size()));
  return out;
}

/// The search keeps the limits to first order, the fit where it begins within them.
Result<void> keeps_limits(const Alignment& found, const AlignmentOptions& options) {
  constexpr double kLimitRounding = 1e-9;  // of the limit
  const double most =
      options.least_radius > 0.0 ? (1.0 + kLimitRounding) / options.least_radius : HUGE_VAL;
  for (const AlignmentElement& e : found.elements) {
    const bool long_enough = e.length >= (1.0 - kLimitRounding) * options.least_length;
    const bool blunt = std::max(std::abs(e.start.kappa), std::abs(e.kappa1)) <= most;
    if ((long_enough || found.elements.size() == 1) && blunt) continue;
    return fail(error(ErrorCode::kToleranceNotReached,
                      long_enough ? "an element was found with a smaller radius only"
                                  : "an element was found with a smaller length only")
                    .hint(advice_to_allow_more(options))
                    .value(long_enough ? 1.0 / std::max(std::abs(e.start.kappa), std::abs(e.kappa1))
                                       : e.length));
  }
  return {};
}

/// Of limits that nothing was found with: other ones that are searched with.
constexpr std::array kSharesOfLimits = {0.9, 0.7, 0.5, 0.0};

/// Whether smaller limits may lead to something where that is the error.
bool is_for_limits(const Error& error, const AlignmentOptions& options) {
  const bool none =
      error.code == ErrorCode::kNoSpiral || error.code == ErrorCode::kToleranceNotReached;
  return none && (options.least_length > 0.0 || options.least_radius > 0.0);
}

/// Searched and fitted with some limits; an error where that does not keep those of `kept`.
Result<Alignment> fit_within(const std::vector<Vec2>& given, const std::vector<double>& tolerance,
                             const AlignmentOptions& options, const AlignmentOptions& kept,
                             const RunContext& run) {
  Sought sought;
  sought.constant = options.without_transitions;
  const auto found = find_chain(given, tolerance, options, sought, run);
  OBVID_TRY(found);
  Alignment out = alignment_of(found->chain, found->feet, tolerance, options.closed);
  OBVID_TRY(keeps_limits(out, kept));
  out.found_within = found->found_within;
  out.has_chords = found->has_chords;
  for (AlignmentElement& e : out.elements) e.start.point = e.start.point + found->origin;
  out.end.point = out.end.point + found->origin;
  return out;
}

}  // namespace
}  // namespace alignment

Transition transition_of(AlignmentKind kind) {
  if (kind <= AlignmentKind::kClothoid || kind == AlignmentKind::kPolynomial)
    return Transition::kClothoid;
  return static_cast<Transition>(static_cast<int>(kind) -
                                 static_cast<int>(AlignmentKind::kClothoid));
}

Result<Alignment> fit_alignment(const std::vector<Vec2>& given,
                                const std::vector<double>& tolerance,
                                const AlignmentOptions& options, const RunContext& run) {
  if (options.closed && given.size() > 1 && given.back() == given.front()) {
    std::vector<double> allowed(tolerance.begin(), tolerance.end() - 1);
    allowed.front() = std::min(allowed.front(), tolerance.back());
    auto once = fit_alignment({given.begin(), given.end() - 1}, allowed, options, run);
    OBVID_TRY(once);
    once->deviations.push_back(once->deviations.front());
    return once;
  }
  auto first = alignment::fit_within(given, tolerance, options, options, run);
  if (first || !alignment::is_for_limits(first.error(), options)) return first;
  // what a smaller limit leads to may keep this one
  for (const double share : alignment::kSharesOfLimits) {
    for (const auto& [of_length, of_radius] :
         {std::pair{share, share}, std::pair{share, 1.0}, std::pair{1.0, share}}) {
      AlignmentOptions smaller = options;
      smaller.least_length *= of_length;
      smaller.least_radius *= of_radius;
      const bool both = options.least_length > 0.0 && options.least_radius > 0.0;
      if (!both && of_length != of_radius) continue;
      auto found = alignment::fit_within(given, tolerance, smaller, options, run);
      if (found || !alignment::is_for_limits(found.error(), options)) return found;
    }
  }
  return first;
}

}  // namespace obvid
