// SPDX-License-Identifier: Apache-2.0
#include "section_curve.h"

#include <algorithm>
#include <cmath>

#include "obvid/numeric/internal/halving.h"

namespace obvid {
namespace {

/// Slopes at the marks for which the pieces of degree 5 with second derivatives 0 are monotone: the
/// Bernstein coefficients of a piece's derivative are d0, d0, 5 D - 2 d0 - 2 d1, d1, d1 with the
/// mean slope D, so d0, d1 <= 5/4 D suffices. Harmonic means inside, as Fritsch and Butland (1984).
/// The same at both ends where the curve is a loop.
std::vector<double> monotone_slopes(const std::vector<double>& u, const std::vector<double>& s,
                                    bool loop) {
  constexpr double kLargest = 1.25;
  const std::size_t n = u.size();
  std::vector<double> mean(n - 1), slope(n);
  for (std::size_t i = 0; i + 1 < n; ++i) mean[i] = (s[i + 1] - s[i]) / (u[i + 1] - u[i]);
  const auto between = [&](std::size_t i, std::size_t j) {  // cells
    const double a = mean[i], b = mean[j];
    if (!(a > 0.0) || !(b > 0.0)) return 0.0;
    const double before = u[i + 1] - u[i], after = u[j + 1] - u[j];
    const double wa = (2.0 * after + before) / (3.0 * (before + after)), wb = 1.0 - wa;
    return std::min(1.0 / (wa / a + wb / b), kLargest * std::min(a, b));
  };
  slope.front() = loop ? between(n - 2, 0) : mean.front();
  slope.back() = loop ? slope.front() : mean.back();
  for (std::size_t i = 1; i + 1 < n; ++i) slope[i] = between(i - 1, i);
  return slope;
}

/// Whether a section goes on smoothly from its end to its start.
bool closes_smoothly(const MeasuredSection& section) {
  const Contour& contour = section.section->contour;
  return contour.closed && !contour.joints.empty() && !contour.joints.front().leaving;
}

double largest_coordinate_of(const MeasuredSection& section) {
  double largest = norm(section.section->frame.origin);
  for (const Vec3& p : section.section->points) largest = std::max(largest, norm(p));
  return largest;
}

/// Between which arc lengths of its own a section goes on smoothly around a stretch: its corners
/// and ends. Beyond the start of one that closes smoothly they are less than 0, or more than its
/// length.
Range smooth_around(const MeasuredSection& section, double from, double to) {
  const double length = section.path->length(), middle = 0.5 * (from + to);
  std::vector<double> fences = corners_of(section);
  if (!closes_smoothly(section)) {
    fences.push_back(0.0);
    fences.push_back(length);
  } else {
    const std::vector<double> own = fences;
    for (const double s : own) fences.insert(fences.end(), {s - length, s + length});
  }
  Range out{-length, 2.0 * length};
  for (const double s : fences) {
    if (s <= middle) out.from = std::max(out.from, s);
    if (s > middle) out.to = std::min(out.to, s);
  }
  // a corner between two points has its fence at one of them
  return {std::min(out.from, from), std::max(out.to, to)};
}

/// Heights of the section's points over the plane of its contour, between two arc lengths: one
/// spline for all that goes on smoothly there. Empty where they are nothing but rounding.
Result<ScalarCubic> heights(const MeasuredSection& section, double from, double to) {
  const SkinSection& data = *section.section;
  const double length = section.path->length();
  const bool loop = closes_smoothly(section), periodic = loop && corners_of(section).empty();
  const Range all = periodic ? Range{0.0, length} : smooth_around(section, from, to);
  std::vector<double> nodes, values;
  double largest = 0.0;
  for (const int turn : {-1, 0, 1}) {  // around a loop whose start is no corner
    if (turn != 0 && (periodic || !loop)) continue;
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      const double s = section.point_at[i] + turn * length;
      if (s < all.from || s > all.to || (!nodes.empty() && s <= nodes.back())) continue;
      nodes.push_back(s);
      values.push_back(data.frame.height(data.points[i]));
      largest = std::max(largest, std::abs(values.back()));
    }
  }
  constexpr double kRounding = 4e-16;  // of the coordinates, when they are turned into the plane
  if (largest <= kRounding * largest_coordinate_of(section) || nodes.empty()) return ScalarCubic{};
  if (nodes.size() == 1) {  // one height for a stretch without another point: constant
    nodes.push_back(nodes.front() + length);
    values.push_back(values.front());
  }
  return periodic ? periodic_cubic(std::move(nodes), std::move(values))
                  : global_cubic_by_slopes(std::move(nodes), std::move(values));
}

}  // namespace

Result<SectionCurve> SectionCurve::make(const MeasuredSection& section,
                                        const std::vector<double>& marks,
                                        const std::vector<double>& at) {
  SectionCurve curve;
  curve.frame_ = section.section->frame;
  if (!section.path) {
    curve.point_ = section.section->points.front();
    return curve;
  }
  curve.path_ = &*section.path;
  curve.u_ = at;
  curve.s_ = marks;
  const bool whole = marks.front() == 0.0 && marks.back() == section.path->length();
  curve.slope_ = monotone_slopes(at, marks, whole && closes_smoothly(section));
  curve.largest_coordinate_ = largest_coordinate_of(section);
  auto height = heights(section, marks.front(), marks.back());
  OBVID_TRY(height);
  curve.height_ = std::move(*height);
  return curve;
}

SectionCurve::Length SectionCurve::length_at(double u) const {
  const auto above = std::upper_bound(u_.begin() + 1, u_.end() - 1, u);
  const auto i = static_cast<std::size_t>(above - u_.begin()) - 1;
  const double h = u_[i + 1] - u_[i];
  const HermiteOf<double> from{s_[i], slope_[i], 0.0}, to{s_[i + 1], slope_[i + 1], 0.0};
  const HermiteOf<double> here = evaluate(quintic(from, to, h), (u - u_[i]) / h, h);
  return {here.point, here.d1, here.d2};
}

double SectionCurve::parameter_of(double s) const {
  const auto mark = std::lower_bound(s_.begin(), s_.end(), s);
  if (mark == s_.end()) return u_.back();
  const auto i = static_cast<std::size_t>(mark - s_.begin());
  if (*mark == s || i == 0) return u_[i];
  return end_of_condition(u_[i - 1], u_[i], [&](double u) { return length_at(u).s < s; }).fails;
}

Hermite SectionCurve::at(double u) const {
  if (path_ == nullptr) return {point_, {}, {}};
  const Length length = length_at(u);
  const ContourPath::Place place = path_->at(length.s, u >= u_.back());
  Hermite result;
  result.point = frame_.at(place.point);
  result.d1 = length.ds * frame_.direction(place.tangent);
  result.d2 = frame_.direction(place.kappa * length.ds * length.ds * left_normal(place.tangent) +
                               length.dds * place.tangent);
  if (!height_.nodes.empty()) {
    const ScalarJet h = evaluate(height_, length.s);
    const Vec3 up = frame_.normal();
    result.point = result.point + h.value * up;
    result.d1 = result.d1 + h.d1 * length.ds * up;
    result.d2 = result.d2 + (h.d2 * length.ds * length.ds + h.d1 * length.dds) * up;
  }
  return result;
}

}  // namespace obvid
