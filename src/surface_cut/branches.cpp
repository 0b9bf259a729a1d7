// SPDX-License-Identifier: Apache-2.0
#include "branches.h"

#include <algorithm>
#include <cmath>

#include "obvid/geom/internal/chord.h"
#include "obvid/numeric/internal/halving.h"

namespace obvid {
namespace {

constexpr int kMostSteps = 12;
constexpr int kMostBisections = 60;
constexpr int kMostChordHalvings = 14;
constexpr double kNoDistance = 1e-300;  ///< units: what keeps a ratio of distances finite

/// Where a height that is monotone is 0.
template <class Height>
double zero_between(double low, double high, const Height& height_at) {
  const bool rises = height_at(high) > height_at(low);
  return end_of_condition(
             low, high, [&](double place) { return (height_at(place) < 0.0) == rises; },
             kMostBisections)
      .middle();
}

}  // namespace

SectionPoint PlaneFoot::slid(const CutPatch& patch, std::size_t number, double u, double v,
                             bool along_u) const {
  const NurbsSurface& s = *patch.surface;
  const Range range = along_u ? domain_u(s) : domain_v(s);
  SurfaceJet jet = evaluate(s, u, v);
  double far = height(jet.point);
  double& moved = along_u ? u : v;
  for (int k = 0; k < kMostSteps && std::abs(far) > small_; ++k) {
    const double slope = dot(plane_.normal, along_u ? jet.du : jet.dv);
    if (slope == 0.0) break;
    const double before = moved;
    moved = std::clamp(moved - far / slope, range.from, range.to);
    const SurfaceJet next = evaluate(s, u, v);
    const double there = height(next.point);
    if (!(std::abs(there) < std::abs(far))) {
      moved = before;
      break;
    }
    jet = next;
    far = there;
  }
  return {jet.point, number, u, v};
}

SectionPoint PlaneFoot::on_strand(const CutPatch& patch, const Strand& strand, double t,
                                  double guess) const {
  const auto at = [&](double other) {
    return strand.over_u ? slid(patch, strand.patch, t, other, false)
                         : slid(patch, strand.patch, other, t, true);
  };
  const auto other_of = [&](const SectionPoint& p) { return strand.over_u ? p.v : p.u; };
  const auto inside = [&](const SectionPoint& p) {
    constexpr double kBeside = 1e-6;  // of the cell: the plane is beside where signs were decided
    const double more = kBeside * (strand.most - strand.least);
    return other_of(p) >= strand.least - more && other_of(p) <= strand.most + more;
  };
  SectionPoint found = at(guess);
  if (inside(found) && is_there(found.point)) return found;
  // the distance is monotone across the cell
  const auto height_at = [&](double other) {
    const SurfaceJet jet =
        strand.over_u ? evaluate(*patch.surface, t, other) : evaluate(*patch.surface, other, t);
    return height(jet.point);
  };
  const SectionPoint bisected = at(zero_between(strand.least, strand.most, height_at));
  const bool better = std::abs(height(bisected.point)) <= std::abs(height(found.point));
  return better || !inside(found) ? bisected : found;
}

SectionPoint PlaneFoot::between_across(const CutPatch& patch, const Strand& strand,
                                       const SectionPoint& a, const SectionPoint& b) const {
  const auto t_of = [&](const SectionPoint& p) { return strand.over_u ? p.u : p.v; };
  const auto other_of = [&](const SectionPoint& p) { return strand.over_u ? p.v : p.u; };
  const double other = 0.5 * (other_of(a) + other_of(b));
  const auto height_at = [&](double t) {
    const SurfaceJet jet =
        strand.over_u ? evaluate(*patch.surface, t, other) : evaluate(*patch.surface, other, t);
    return height(jet.point);
  };
  const double t = zero_between(t_of(a), t_of(b), height_at);
  return strand.over_u ? slid(patch, strand.patch, t, other, true)
                       : slid(patch, strand.patch, other, t, false);
}

std::vector<SectionPoint> sampled(const PlaneFoot& foot, const CutPatch& patch,
                                  const Strand& strand, const SectionPoint& first,
                                  const SectionPoint& last, double tolerance, double& deviation) {
  const auto t_of = [&](const SectionPoint& p) { return strand.over_u ? p.u : p.v; };
  const auto other_of = [&](const SectionPoint& p) { return strand.over_u ? p.v : p.u; };
  // how much nearer to one end than to the other
  const auto uneven = [](const SectionPoint& p, const SectionPoint& a, const SectionPoint& b) {
    const double from = norm(p.point - a.point), to = norm(p.point - b.point);
    return std::max(from, to) / std::max(std::min(from, to), kNoDistance);
  };
  // a place between two others by the parameter that the strand is a function of, or by the other
  // one where it runs along that
  const auto between = [&](const SectionPoint& a, const SectionPoint& b) {
    constexpr double kUneven = 8.0;
    const SectionPoint middle =
        foot.on_strand(patch, strand, 0.5 * (t_of(a) + t_of(b)), 0.5 * (other_of(a) + other_of(b)));
    if (uneven(middle, a, b) <= kUneven) return middle;
    const SectionPoint other = foot.between_across(patch, strand, a, b);
    return uneven(other, a, b) < uneven(middle, a, b) ? other : middle;
  };
  std::vector<SectionPoint> out{first};
  const auto refine = [&](const auto& self, const SectionPoint& a, const SectionPoint& b,
                          int halvings) -> void {
    const SectionPoint middle = between(a, b);
    double far = distance_from_chord(middle.point, a.point, b.point);
    bool enough = far <= tolerance;
    for (const bool before : {true, false}) {
      if (!enough) break;
      const SectionPoint quarter = before ? between(a, middle) : between(middle, b);
      far = std::max(far, distance_from_chord(quarter.point, a.point, b.point));
      enough = far <= tolerance;
    }
    if (enough || halvings >= kMostChordHalvings) {
      deviation = std::max(deviation, far);
      return;
    }
    self(self, a, middle, halvings + 1);
    out.push_back(middle);
    self(self, middle, b, halvings + 1);
  };
  refine(refine, first, last, 0);
  out.push_back(last);
  return out;
}

}  // namespace obvid
