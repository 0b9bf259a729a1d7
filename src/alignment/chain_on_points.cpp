// SPDX-License-Identifier: Apache-2.0
#include "chain_on_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "obvid/alignment/internal/transition_law.h"

namespace obvid::alignment {
namespace {

constexpr std::size_t kWindow = 12;  ///< elements that are fitted at once
constexpr int kPolishes = 3;         ///< over the whole alignment, where an offset is too large
/// Of the length of all elements: where a bend moves nothing by more it is rounding, and straight.
constexpr double kStraightWithin = 1e-9;
constexpr double kOfToleranceAtMost = 1e-3;  ///< that this may take; scatter that is none

int own_number(const Chain& chain, int number, ChainWindow& window) {
  if (number == Chain::kStraight) return number;
  const auto found = std::find(window.number.begin(), window.number.end(), number);
  const auto own = found - window.number.begin();
  if (found == window.number.end()) {
    window.number.push_back(number);
    window.own.chain.kappa.push_back(chain.kappa[static_cast<std::size_t>(number)]);
  }
  return static_cast<int>(own);
}

bool passes_as_it_is(const ChainWindow& window) {
  std::vector<Foot> feet = window.own.feet;
  find_feet(window.own.chain, window.points, feet);
  for (std::size_t i = 0; i < feet.size(); ++i) {
    if (!(std::abs(feet[i].offset) <= window.tolerance[i])) return false;
  }
  return true;
}

bool transitions_exist(const Chain& chain) {
  for (std::size_t k = 0; k < chain.size(); ++k) {
    if (chain.law[k] == Transition::kClothoid) continue;
    const TransitionLaw law(chain.law[k], chain.curvature(k, 0), chain.curvature(k, 1),
                            chain.length[k]);
    if (!law.exists()) return false;
  }
  return true;
}

}  // namespace

ChainOnPoints::ChainOnPoints(TolerantPoints points, FootedChain begun, bool closed,
                             ElementLimits limits, std::function<bool()> cancelled)
    : row_(std::move(points)),
      now_(std::move(begun)),
      closed_(closed),
      limits_(std::move(limits)),
      cancelled_(std::move(cancelled)) {}

const Foot& ChainOnPoints::foot_of_given(std::size_t i) const {
  const std::size_t n = now_.feet.size();
  return now_.feet[(i + n - row_.first_given) % n];
}

void ChainOnPoints::allow_length(double least) {
  limits_.least_length = std::min(limits_.least_length, least);
}

void ChainOnPoints::narrow_tolerances(double part) {
  for (double& one : row_.tolerance) one *= part;
}

void ChainOnPoints::widen_tolerances(double part) {
  for (double& one : row_.tolerance) one /= part;
}

void ChainOnPoints::limit_curvatures() {
  for (double& kappa : now_.chain.kappa) {
    kappa = std::clamp(kappa, -limits_.largest_curvature, limits_.largest_curvature);
  }
}

void ChainOnPoints::straighten() {
  Chain& chain = now_.chain;
  if (chain.plane != Plane::kMap) return;
  double whole = 0.0;
  for (const double length : chain.length) whole += length;
  const double finest = *std::min_element(row_.tolerance.begin(), row_.tolerance.end());
  const double most = std::min(kStraightWithin * whole, kOfToleranceAtMost * finest);
  std::vector<double> longest(chain.kappa.size(), 0.0);
  for (std::size_t k = 0; k < chain.size(); ++k) {
    for (const int number : chain.ends[k]) {
      if (number == Chain::kStraight) continue;
      double& own = longest[static_cast<std::size_t>(number)];
      own = std::max(own, chain.length[k]);
    }
  }
  for (auto& ends : chain.ends) {
    for (int& number : ends) {
      if (number == Chain::kStraight) continue;
      const auto n = static_cast<std::size_t>(number);
      // what lies beyond is turned by it: all of the length is its lever
      if (std::abs(chain.kappa[n]) * longest[n] * whole <= most) number = Chain::kStraight;
    }
  }
}

void ChainOnPoints::turn_to(std::size_t m) {
  Chain& chain = now_.chain;
  const std::vector<Element> joints = chain.joints();
  chain.start = joints[m].point;
  chain.theta = joints[m].theta;
  const auto turn = [](auto& row, std::size_t by) {
    std::rotate(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(by), row.end());
  };
  turn(chain.length, m);
  turn(chain.ends, m);
  turn(chain.law, m);
  const auto first =
      static_cast<std::size_t>(std::find_if(now_.feet.begin(), now_.feet.end(),
                                            [m](const Foot& foot) { return foot.element >= m; }) -
                               now_.feet.begin());
  for (Foot& foot : now_.feet) foot.element = (foot.element + chain.size() - m) % chain.size();
  for (std::size_t i = 0; i < first; ++i) row_.points[i] = row_.points[i] + row_.lap;
  turn(now_.feet, first);
  turn(row_.points, first);
  turn(row_.tolerance, first);
  row_.first_given = (row_.first_given + first) % row_.points.size();
}

void ChainOnPoints::turn_to_first_given() {
  const std::size_t n = row_.points.size();
  turn_to(now_.feet[(n - row_.first_given) % n].element);
}

void ChainOnPoints::close_at(std::size_t m) {
  row_.points.pop_back();
  row_.tolerance.pop_back();
  now_.feet.pop_back();
  turn_to(m);
  closed_ = true;
}

ChainWindow ChainOnPoints::cut(std::size_t first, std::size_t last) const {
  return cut(now_, first, last, now_.chain.joints(), last);
}

ChainWindow ChainOnPoints::cut(const FootedChain& from, std::size_t first, std::size_t last,
                               const std::vector<Element>& joints, std::size_t end) const {
  const Chain& chain = from.chain;
  ChainWindow out;
  out.first = first;
  out.own.chain.plane = chain.plane;
  out.own.chain.start = joints[first].point;
  out.own.chain.theta = joints[first].theta;
  out.held.start = first > 0 || closed_;
  out.held.least_length = limits_.least_length;
  out.held.largest_curvature = limits_.largest_curvature;
  out.held.cancelled = cancelled_;
  if (last < chain.size()) {
    out.held.end = joints[end];
  } else if (closed_) {
    out.held.end = a_lap_on(joints.front());
  }
  for (std::size_t k = first; k < last; ++k) {
    out.own.chain.length.push_back(chain.length[k]);
    out.own.chain.law.push_back(chain.law[k]);
    std::array<int, 2> ends{};
    for (std::size_t e = 0; e < 2; ++e) ends[e] = own_number(chain, chain.ends[k][e], out);
    out.own.chain.ends.push_back(ends);
  }
  for (std::size_t k = 0; k < out.number.size(); ++k) {
    // a curvature that an element outside has too stays as it is
    if (is_used_outside(chain, out.number[k], first, last)) {
      out.held.kappa.push_back(static_cast<int>(k));
    }
  }
  for (std::size_t i = 0; i < from.feet.size(); ++i) {
    if (from.feet[i].element < first || from.feet[i].element >= last) continue;
    out.numbers.push_back(i);
    out.points.push_back(row_.points[i]);
    out.tolerance.push_back(row_.tolerance[i]);
    Foot foot = from.feet[i];
    foot.element -= first;
    out.own.feet.push_back(foot);
  }
  return out;
}

Fitted ChainOnPoints::fit(ChainWindow& window) const {
  Fitted out{std::numeric_limits<double>::infinity(), 0.0};
  if (window.points.empty()) return out;
  out = fit_chain(window.own.chain, window.points, window.tolerance, window.own.feet, window.held);
  if (!keeps_limits(window.own.chain)) out.largest = std::numeric_limits<double>::infinity();
  return out;
}

bool ChainOnPoints::keeps_limits(const Chain& chain) const {
  return transitions_exist(chain) && is_borne(chain);
}

/// Whether the points bear the grades at all joints of a profile.
bool ChainOnPoints::is_borne(const Chain& chain) const {
  if (!limits_.grades) return true;
  for (const Element& joint : chain.joints()) {
    const double grade = chain.plane == Plane::kMap ? std::tan(joint.theta) : joint.theta;
    const ValueRange borne = limits_.grades->at(joint.point.x);
    if (!(borne.low <= grade && grade <= borne.high)) return false;
  }
  return true;
}

bool ChainOnPoints::commit(FootedChain next, const ChainWindow& window) {
  const Chain& fitted = window.own.chain;
  if (window.first == 0) {
    next.chain.start = fitted.start;
    next.chain.theta = fitted.theta;
  }
  for (std::size_t k = 0; k < fitted.size(); ++k) {
    next.chain.length[window.first + k] = fitted.length[k];
  }
  for (std::size_t k = 0; k < window.number.size(); ++k) {
    next.chain.kappa[static_cast<std::size_t>(window.number[k])] = fitted.kappa[k];
  }
  for (std::size_t i = 0; i < window.own.feet.size(); ++i) {
    Foot foot = window.own.feet[i];
    foot.element += window.first;
    next.feet[window.numbers[i]] = foot;
  }
  if (loses_points(next, window) || winds_more(next, window)) return false;
  now_ = std::move(next);
  return true;
}

/// Whether points that the window passes beyond its ends are not passed by what lies there. Sets
/// their feet.
bool ChainOnPoints::loses_points(FootedChain& next, const ChainWindow& window) const {
  std::vector<std::size_t> beyond;
  std::vector<Vec2> points;
  std::vector<Foot> there;
  const std::vector<Foot>& feet = window.own.feet;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const bool before = feet[i].s < 0.0 && window.first + feet[i].element > 0;
    const bool behind = feet[i].s > window.own.chain.length[feet[i].element] &&
                        window.first + feet[i].element + 1 < next.chain.size();
    if (!before && !behind) continue;
    beyond.push_back(i);
    points.push_back(window.points[i]);
    there.push_back(next.feet[window.numbers[i]]);
  }
  if (beyond.empty()) return false;
  find_feet(next.chain, points, there);
  for (std::size_t k = 0; k < beyond.size(); ++k) {
    const std::size_t i = beyond[k];
    const bool within = std::abs(feet[i].offset) <= window.tolerance[i];
    if (within && !(std::abs(there[k].offset) <= window.tolerance[i])) return true;
    next.feet[window.numbers[i]] = there[k];
  }
  return false;
}

bool ChainOnPoints::winds_more(const FootedChain& next, const ChainWindow& window) const {
  if (window.numbers.empty()) return false;
  const std::size_t first_point = window.numbers.front();
  const std::size_t first = first_point - std::min<std::size_t>(first_point, 1);
  const std::size_t end = window.numbers.back() + 1;
  const PointRow points = row();
  const std::size_t intervals = points.intervals(), last = std::min(end, intervals);
  const auto number = [&](const FootedChain& of, double rounded) {
    std::size_t out = windings(of.chain, points, of.feet, first, last, rounded);
    if (closed_ && first_point == 0 && last < intervals) {
      out += windings(of.chain, points, of.feet, intervals - 1, intervals, rounded);
    }
    return out;
  };
  for (const double rounded : {kRoundedTurn, kRefoundTurn}) {
    const std::size_t after = number(next, rounded);
    if (after == 0) return false;
    if (after > number(now_, rounded)) return true;
  }
  return false;
}

bool ChainOnPoints::take(Edit edit) {
  const std::vector<Element> joints = now_.chain.joints();
  const std::size_t end = edit.last + now_.chain.size() - edit.next.chain.size();
  ChainWindow window = cut(edit.next, edit.first, edit.last, joints, end);
  window.held.hopeless = kNoWayBack;
  return fit(window).largest <= 1.0 && commit(std::move(edit.next), window);
}

Result<void> ChainOnPoints::polish(const RunContext& run, const std::vector<Element>* meant) {
  for (std::size_t first = 0; first < size(); first += kWindow / 2) {
    OBVID_TRY(tell(run, "fitting", static_cast<double>(first) / static_cast<double>(size())));
    const std::size_t last = std::min(first + kWindow, size());
    ChainWindow window = cut(first, last);
    if (meant != nullptr && last < size()) window.held.end = (*meant)[last];
    if (window.points.empty()) continue;
    Chain& own = window.own.chain;
    const bool was_good = limits_.grades && is_borne(own) && passes_as_it_is(window);
    const Fitted fitted =
        fit_chain(own, window.points, window.tolerance, window.own.feet, window.held);
    if (std::isfinite(fitted.largest) && transitions_exist(own) && (!was_good || is_borne(own))) {
      (void)commit(now_, window);
    }
    if (last == size()) break;
  }
  find_feet(now_.chain, row_.points, now_.feet);
  return {};
}

Result<void> ChainOnPoints::polish_to_tolerance(const RunContext& run) {
  for (int i = 0; i < kPolishes && largest() > 1.0; ++i) {
    OBVID_TRY(polish(run));
  }
  return {};
}

std::vector<bool> ChainOnPoints::bad_intervals() {
  find_feet(now_.chain, row_.points, now_.feet);
  const PointRow points = row();
  std::vector<bool> out =
      wound_through(now_.chain, points, now_.feet, 0, points.intervals(), kRefoundTurn);
  const std::size_t intervals = out.size();
  for (std::size_t i = 0; i < row_.points.size(); ++i) {
    if (std::abs(now_.feet[i].offset) <= row_.tolerance[i]) continue;
    if (i < intervals) out[i] = true;
    if (i > 0 || closed_) out[(i + intervals - 1) % intervals] = true;
  }
  return out;
}

bool ChainOnPoints::is_good() {
  const std::vector<bool> bad = bad_intervals();
  return std::find(bad.begin(), bad.end(), true) == bad.end();
}

double ChainOnPoints::largest() {
  find_feet(now_.chain, row_.points, now_.feet);
  double out = 0.0;
  for (std::size_t i = 0; i < now_.feet.size(); ++i) {
    out = std::max(out, std::abs(now_.feet[i].offset) / row_.tolerance[i]);
  }
  return out;
}

bool ChainOnPoints::winds() const {
  const PointRow points = row();
  return windings(now_.chain, points, now_.feet, 0, points.intervals(), kRefoundTurn) > 0;
}

double ChainOnPoints::scatter() const {
  constexpr std::size_t kNumbersOfElement = 3;  // length and two curvatures
  double squares = 0.0;
  for (std::size_t i = 0; i < now_.feet.size(); ++i) {
    const double share = now_.feet[i].offset / row_.tolerance[i];
    squares += share * share;
  }
  const std::size_t taken = kNumbersOfElement * size();
  if (now_.feet.size() < 2 * taken) return std::numeric_limits<double>::infinity();
  return std::max(squares / static_cast<double>(now_.feet.size() - taken),
                  kOfToleranceAtMost * kOfToleranceAtMost);
}

bool ChainOnPoints::is_used_outside(const Chain& chain, int number, std::size_t first,
                                    std::size_t last) const {
  const auto uses = [&](std::size_t element) {
    return chain.ends[element][0] == number || chain.ends[element][1] == number;
  };
  const bool before = first > 0, behind = last < chain.size();
  return (before && uses(first - 1)) || (behind && uses(last)) ||
         (closed_ && behind && !before && uses(chain.size() - 1)) ||
         (closed_ && before && !behind && uses(0));
}

Element ChainOnPoints::a_lap_on(Element at) const {
  at.point = at.point + row_.lap;
  return at;
}

}  // namespace obvid::alignment
