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
std::vector<double> monotone_slopes(const std::vector<double>& u, const std::vector<double>& s) {
  constexpr double kLargest = 1.25;
  const std::size_t n = u.size();
  std::vector<double> mean(n - 1), slope(n);
  for (std::size_t i = 0; i + 1 < n; ++i) mean[i] = (s[i + 1] - s[i]) / (u[i + 1] - u[i]);
  slope.front() = mean.front();
  slope.back() = mean.back();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double a = mean[i - 1], b = mean[i];
    if (!(a > 0.0) || !(b > 0.0)) continue;
    const double before = u[i] - u[i - 1], after = u[i + 1] - u[i];
    const double wa = (2.0 * after + before) / (3.0 * (before + after)), wb = 1.0 - wa;
    slope[i] = std::min(1.0 / (wa / a + wb / b), kLargest * std::min(a, b));
  }
  return slope;
}

/// Heights of the section's points over the plane of its contour, between two arc lengths. Empty
/// where they are nothing but rounding.
Result<ScalarCubic> heights(const MeasuredSection& section, double from, double to) {
  std::vector<double> nodes, values;
  const SkinSection& data = *section.section;
  double largest = 0.0, coordinate = norm(data.frame.origin);
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const double s = section.point_at[i];
    if (s < from || s > to || (!nodes.empty() && s <= nodes.back())) continue;
    nodes.push_back(s);
    values.push_back(data.frame.height(data.points[i]));
    largest = std::max(largest, std::abs(values.back()));
    coordinate = std::max(coordinate, norm(data.points[i]));
  }
  constexpr double kRounding = 4e-16;  // of the coordinates, when they are turned into the plane
  if (largest <= kRounding * coordinate || nodes.empty()) return ScalarCubic{};
  if (nodes.size() == 1) {  // one height for a stretch without another point: constant
    nodes.push_back(nodes.front() + section.path->length());
    values.push_back(values.front());
  }
  return global_cubic_by_slopes(std::move(nodes), std::move(values));
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
  curve.slope_ = monotone_slopes(at, marks);
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
