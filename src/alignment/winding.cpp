// SPDX-License-Identifier: Apache-2.0
#include "winding.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "obvid/alignment/internal/transition_law.h"
#include "obvid/geom/internal/angle.h"

namespace obvid::alignment {
namespace {

constexpr double kHalfTurn = std::numbers::pi;
/// Of an element whose law is not linear: places at which its heading is looked at.
constexpr int kHeadingLooks = 16;
/// rad: by how much more than the chords beside it a curve may leave a chord.
constexpr double kSwing = std::numbers::pi / 12.0;

HeadingRange both(HeadingRange a, HeadingRange b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

HeadingRange headings_on(const Chain& chain, std::size_t k, double theta, double s0, double s1) {
  const double k0 = chain.curvature(k, 0), k1 = chain.curvature(k, 1), length = chain.length[k];
  if (chain.law[k] == Transition::kClothoid) return headings_along(theta, k0, k1, length, s0, s1);
  const TransitionLaw law(chain.law[k], k0, k1, length);
  HeadingRange out;
  for (int i = 0; i <= kHeadingLooks; ++i) {
    const double s = s0 + (s1 - s0) * i / kHeadingLooks;
    const double at = theta + k0 * s + (k1 - k0) * length * law.at(s / length).turn;
    out = i == 0 ? HeadingRange{at, at} : both(out, {at, at});
  }
  return out;
}

/// Headings from one foot to another one behind it.
HeadingRange headings_between(const Chain& chain, const std::vector<double>& joints, Foot from,
                              Foot to) {
  if (std::pair(to.element, to.s) < std::pair(from.element, from.s)) std::swap(from, to);
  HeadingRange out;
  for (std::size_t k = from.element; k <= to.element; ++k) {
    const HeadingRange own = headings_on(chain, k, joints[k], k == from.element ? from.s : 0.0,
                                         k == to.element ? to.s : chain.length[k]);
    out = k == from.element ? own : both(out, own);
  }
  return out;
}

Vec2 chord_of(const PointRow& row, std::size_t i) {
  return i + 1 < row.points.size() ? row.points[i + 1] - row.points[i]
                                   : row.points.front() + row.lap - row.points[i];
}

/// How far a chord may be turned as its ends move; nothing where to any side.
std::optional<double> loose(const PointRow& row, std::size_t i, std::size_t j, Vec2 chord) {
  const double allowed = row.tolerance[i] + row.tolerance[j], length = norm(chord);
  if (length <= allowed) return std::nullopt;
  return std::asin(allowed / length);
}

}  // namespace

Passage passage_of(const PointRow& row, std::size_t i) {
  constexpr double kQuarter = 0.5 * kHalfTurn;
  const std::size_t n = row.points.size();
  const auto loose_of = [&](std::size_t k) {
    return loose(row, k, k + 1 < n ? k + 1 : 0, chord_of(row, k));
  };
  const Vec2 chord = chord_of(row, i);
  const auto own = loose_of(i);
  Passage out{heading(chord), 0.0, !own};
  if (!own) return out;
  double most = 0.0;
  for (const bool behind : {false, true}) {
    const bool is_last = behind ? i + 1 == row.intervals() : i == 0;
    if (is_last && !row.closed) {
      most = kQuarter;
      continue;
    }
    const std::size_t other =
        behind ? (i + 1) % row.intervals() : (i + row.intervals() - 1) % row.intervals();
    const auto turned_by = loose_of(other);
    const Vec2 beside = chord_of(row, other);
    const double turn = std::abs(turning(chord, beside));
    most = std::max(most, turned_by ? turn + *turned_by : kQuarter);
  }
  out.most = std::min(most + kSwing, kQuarter) + *own;
  return out;
}

bool allows(const Passage& passage, HeadingRange headings, double rounded) {
  const double half = 0.5 * (headings.high - headings.low);
  if (half > 0.5 * kHalfTurn + rounded) return false;
  if (passage.any) return true;
  const double middle = 0.5 * (headings.low + headings.high);
  const double off = obvid::turn_between(passage.heading, middle);
  return std::abs(off) + half <= passage.most + rounded;
}

HeadingRange headings_along(double theta, double kappa0, double kappa1, double length, double s0,
                            double s1) {
  const double rate = (kappa1 - kappa0) / length;
  const auto at = [&](double s) { return theta + s * (kappa0 + 0.5 * s * rate); };
  HeadingRange out = both({at(s0), at(s0)}, {at(s1), at(s1)});
  const double straight = -kappa0 / rate;  // where it bends to neither side
  if (straight > s0 && straight < s1) out = both(out, {at(straight), at(straight)});
  return out;
}

namespace {

bool may_run(const PointRow& row, std::size_t i, HeadingRange headings, double rounded) {
  // what every passage allows: its neighbours need not be looked at
  if (allows({heading(chord_of(row, i)), kSwing, false}, headings)) return true;
  return allows(passage_of(row, i), headings, rounded);
}

}  // namespace

std::vector<bool> wound_through(const Chain& chain, const PointRow& row,
                                const std::vector<Foot>& feet, std::size_t first, std::size_t last,
                                double rounded) {
  std::vector<bool> out(last - first, false);
  if (chain.plane != Plane::kMap) return out;
  const std::vector<double> joints = chain.headings();
  for (std::size_t i = first; i < last; ++i) {
    HeadingRange headings;
    if (i + 1 < row.points.size()) {
      headings = headings_between(chain, joints, feet[i], feet[i + 1]);
    } else {
      const std::size_t end = chain.size() - 1;
      headings = headings_between(chain, joints, feet[i], {end, chain.length[end]});
      const double lap = joints.back() - joints.front();
      const HeadingRange begun = headings_between(chain, joints, {}, feet.front());
      headings = both(headings, {begun.low + lap, begun.high + lap});
    }
    const bool allowed = row.passages != nullptr ? allows((*row.passages)[i], headings, rounded)
                                                 : may_run(row, i, headings, rounded);
    out[i - first] = !allowed;
  }
  return out;
}

std::size_t windings(const Chain& chain, const PointRow& row, const std::vector<Foot>& feet,
                     std::size_t first, std::size_t last, double rounded) {
  const std::vector<bool> wound = wound_through(chain, row, feet, first, last, rounded);
  return static_cast<std::size_t>(std::count(wound.begin(), wound.end(), true));
}

}  // namespace obvid::alignment
