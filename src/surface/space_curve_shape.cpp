// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iterator>

#include "knots.h"
#include "obvid/surface/space_curve.h"
#include "snap.h"

namespace obvid {
namespace {

Line line_of(const SpaceCurve& curve) {
  return {curve.degree, curve.knots, lifted(curve.points, curve.weights)};
}

SpaceCurve curve_of(const Line& line, bool rational) {
  SpaceCurve curve{line.degree, line.knots, {}, {}};
  curve.points.reserve(line.points.size());
  for (const Vec4& p : line.points) {
    curve.points.push_back(rational ? dropped(p) : numerator(p));
    if (rational) curve.weights.push_back(p.w);
  }
  return curve;
}

/// Knots of all curves as one list, those that differ by rounding made one.
std::vector<double> common_knots(const std::vector<SpaceCurve>& curves) {
  std::vector<double> all;
  for (const SpaceCurve& c : curves) all.insert(all.end(), c.knots.begin(), c.knots.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::vector<double> kept;
  for (const double u : all) {
    if (kept.empty() || u - kept.back() > kSameKnot) kept.push_back(u);
  }
  kept.back() = 1.0;
  return kept;
}

}  // namespace

SpaceCurve reversed(const SpaceCurve& curve) {
  SpaceCurve out = curve;
  const double sum = curve.knots.front() + curve.knots.back();
  std::transform(curve.knots.rbegin(), curve.knots.rend(), out.knots.begin(),
                 [&](double u) { return sum - u; });
  // the ends without rounding
  const auto ends = static_cast<std::ptrdiff_t>(curve.degree) + 1;
  std::fill(out.knots.begin(), out.knots.begin() + ends, curve.knots.front());
  std::fill(out.knots.end() - ends, out.knots.end(), curve.knots.back());
  std::reverse(out.points.begin(), out.points.end());
  std::reverse(out.weights.begin(), out.weights.end());
  return out;
}

SpaceCurve with_domain(const SpaceCurve& curve, Range range) {
  SpaceCurve out = curve;
  out.knots = mapped(curve.knots, range.from, range.to);
  return out;
}

SpaceCurve with_knots(const SpaceCurve& curve, const std::vector<double>& new_knots) {
  return curve_of(inserted(line_of(curve), new_knots), !curve.weights.empty());
}

SpaceCurve with_degree(const SpaceCurve& curve, int degree) {
  if (degree <= curve.degree) return curve;
  Line line = line_of(curve);
  while (line.degree < degree) line = raised(line);
  return curve_of(line, !curve.weights.empty());
}

std::array<SpaceCurve, 2> split(const SpaceCurve& curve, double u) {
  const auto p = static_cast<std::size_t>(curve.degree);
  const std::vector<double> added(p - std::min(p, multiplicity(curve.knots, u)), u);
  const SpaceCurve cut = with_knots(curve, added);
  const auto first = std::lower_bound(cut.knots.begin(), cut.knots.end(), u) - cut.knots.begin();
  const auto joint = first - 1;  // control point that lies on the curve at u
  const auto degree = static_cast<std::ptrdiff_t>(p);
  SpaceCurve before{curve.degree,
                    {cut.knots.begin(), cut.knots.begin() + first + degree},
                    {cut.points.begin(), cut.points.begin() + joint + 1},
                    {}};
  before.knots.push_back(u);
  SpaceCurve after{curve.degree, {u}, {cut.points.begin() + joint, cut.points.end()}, {}};
  after.knots.insert(after.knots.end(), cut.knots.begin() + first, cut.knots.end());
  if (!cut.weights.empty()) {
    before.weights.assign(cut.weights.begin(), cut.weights.begin() + joint + 1);
    after.weights.assign(cut.weights.begin() + joint, cut.weights.end());
  }
  return {before, after};
}

std::vector<SpaceCurve> compatible(std::vector<SpaceCurve> curves) {
  if (curves.empty()) return curves;
  int degree = 1;
  bool rational = false;
  for (const SpaceCurve& c : curves) {
    degree = std::max(degree, c.degree);
    rational = rational || !c.weights.empty();
  }
  for (SpaceCurve& c : curves) c = with_degree(with_domain(c, {0.0, 1.0}), degree);
  const std::vector<double> distinct = common_knots(curves);
  for (SpaceCurve& c : curves) snap(c.knots, distinct);
  for (SpaceCurve& c : curves) {
    std::vector<double> added;
    for (const double u : distinct) {
      std::size_t most = 0;
      for (const SpaceCurve& other : curves) most = std::max(most, multiplicity(other.knots, u));
      added.insert(added.end(), most - multiplicity(c.knots, u), u);
    }
    // the curves already done keep the larger numbers, so later ones see the same maxima
    c = with_knots(c, added);
    if (rational && c.weights.empty()) c.weights.assign(c.points.size(), 1.0);
  }
  return curves;
}

}  // namespace obvid
