// SPDX-License-Identifier: Apache-2.0
// Fewer knots within a tolerance, one direction after the other: docs/methods/skin.md.
#include "obvid/surface_builders/internal/lighten.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "approximate_line.h"
#include "network_curves.h"
#include "obvid/core/internal/watch.h"
#include "obvid/curve/internal/basis.h"
#include "obvid/surface_builders/internal/grid.h"

namespace obvid {
namespace {

constexpr std::size_t kSamplesPerSpan = 4;
/// What the first direction may take; the second has what is left.
constexpr double kShareAlong = 0.75;
/// The samples see nearly all of the largest difference: where the bound exceeds the tolerance, the
/// aim is lowered by as much, and a little more.
constexpr int kTrials = 6;
constexpr double kLower = 0.95;
/// Of the largest coordinate: rounding of the difference and of its control points.
constexpr double kHullRounding = 512.0 * std::numeric_limits<double>::epsilon();
constexpr std::size_t kMostOrder = kMostLineDegree + 1;

/// A spline with rows of coefficients: one for each B-spline.
struct Spline {
  int degree = 0;
  std::vector<double> knots;
  Rows coefficients;

  void add(double t, double factor, int derivative, std::vector<Vec3>& sum) const {
    const BasisValues basis = basis_at(degree, knots, t, derivative);
    for (std::size_t k = 0; k <= static_cast<std::size_t>(degree); ++k) {
      const double share = factor * basis.value[static_cast<std::size_t>(derivative)][k];
      if (share == 0.0) continue;
      const Vec3* row = coefficients.row(basis.first + k);
      for (std::size_t j = 0; j < sum.size(); ++j) sum[j] = sum[j] + share * row[j];
    }
  }
};

std::vector<double> samples_of(const std::vector<double>& knots) {
  const std::vector<double> breaks = distinct(knots);
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    for (std::size_t k = 0; k < kSamplesPerSpan; ++k) {
      const double part = static_cast<double>(k) / kSamplesPerSpan;
      out.push_back(breaks[i] + part * (breaks[i + 1] - breaks[i]));
    }
  }
  out.push_back(breaks.back());
  return distinct(std::move(out));
}

Rows values_of(const Spline& spline, const std::vector<double>& at) {
  Rows out{spline.coefficients.width, {}};
  std::vector<Vec3> row(out.width);
  for (const double t : at) {
    std::fill(row.begin(), row.end(), Vec3{});
    spline.add(t, 1.0, 0, row);
    out.points.insert(out.points.end(), row.begin(), row.end());
  }
  return out;
}

/// Point and the first derivatives at a parameter.
Rows jet_of(const Spline& spline, double at, int derivatives) {
  Rows out{spline.coefficients.width, {}};
  std::vector<Vec3> row(out.width);
  for (int d = 0; d <= derivatives; ++d) {
    std::fill(row.begin(), row.end(), Vec3{});
    spline.add(at, 1.0, d, row);
    out.points.insert(out.points.end(), row.begin(), row.end());
  }
  return out;
}

/// Control points of a polynomial over [0, 1] from its values at equal steps: the inverse of the
/// matrix of Bernstein polynomials there.
class FromValues {
 public:
  explicit FromValues(std::size_t order) : order_(order) {
    std::array<std::array<double, 2 * kMostOrder>, kMostOrder> a{};
    for (std::size_t i = 0; i < order; ++i) {
      const double x = place(i);
      double binomial = 1.0;
      for (std::size_t k = 0; k < order; ++k) {
        const auto up = static_cast<double>(k), down = static_cast<double>(order - 1 - k);
        a[i][k] = binomial * std::pow(x, up) * std::pow(1.0 - x, down);
        binomial *= down / (up + 1.0);
      }
      a[i][order + i] = 1.0;
    }
    for (std::size_t k = 0; k < order; ++k) {  // totally positive: no pivots are needed
      const double pivot = a[k][k];
      for (std::size_t c = 0; c < 2 * order; ++c) a[k][c] /= pivot;
      for (std::size_t i = 0; i < order; ++i) {
        const double factor = i == k ? 0.0 : a[i][k];
        for (std::size_t c = 0; c < 2 * order; ++c) a[i][c] -= factor * a[k][c];
      }
    }
    for (std::size_t i = 0; i < order; ++i) {
      for (std::size_t k = 0; k < order; ++k) inverse_[i][k] = a[i][order + k];
    }
  }

  [[nodiscard]] double place(std::size_t i) const {
    return order_ == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(order_ - 1);
  }
  [[nodiscard]] double share(std::size_t control_point, std::size_t value) const {
    return inverse_[control_point][value];
  }

 private:
  std::size_t order_;
  std::array<std::array<double, kMostOrder>, kMostOrder> inverse_{};
};

/// Bound of the distance of two splines over the same parameters, largest of all rows: between
/// their knots the difference is a polynomial, which lies in the hull of its control points.
double bound_between(const Spline& a, const Spline& b) {
  std::vector<double> knots(a.knots.size() + b.knots.size());
  std::merge(a.knots.begin(), a.knots.end(), b.knots.begin(), b.knots.end(), knots.begin());
  const std::vector<double> breaks = distinct(std::move(knots));
  const std::size_t order = static_cast<std::size_t>(std::max(a.degree, b.degree)) + 1;
  const FromValues from(order);
  const std::size_t width = a.coefficients.width;
  std::vector<std::vector<Vec3>> values(order, std::vector<Vec3>(width));
  double most = 0.0, largest = 0.0;
  for (const Vec3& p : a.coefficients.points) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    for (std::size_t k = 0; k < order; ++k) {
      const double t = breaks[i] + from.place(k) * (breaks[i + 1] - breaks[i]);
      std::fill(values[k].begin(), values[k].end(), Vec3{});
      a.add(t, 1.0, 0, values[k]);
      b.add(t, -1.0, 0, values[k]);
    }
    for (std::size_t j = 0; j < width; ++j) {
      for (std::size_t c = 0; c < order; ++c) {
        Vec3 point;
        for (std::size_t k = 0; k < order; ++k) point = point + from.share(c, k) * values[k][j];
        most = std::max(most, norm(point));
      }
    }
  }
  return most + kHullRounding * largest;
}

struct Lighter {
  Spline spline;
  double moved = 0.0;
};

/// One direction of a spline that lives as long: few knots such that samples lie within an aim.
class FewKnots {
 public:
  FewKnots(const Spline& given, int kept_derivatives)
      : given_(given), at_(samples_of(given.knots)), data_(values_of(given, at_)) {
    kept_ = {jet_of(given, at_.front(), kept_derivatives),
             jet_of(given, at_.back(), kept_derivatives)};
  }

  /// Nothing where the given spline stays, and when it is to end.
  [[nodiscard]] std::optional<Lighter> within(double tolerance, Watch& watch) const {
    double aim = tolerance;
    for (int trial = 0; trial < kTrials; ++trial) {
      SplineLine line(at_, given_.degree, std::numeric_limits<double>::infinity());
      Rows found;
      if (!refined(line, aim, found, watch) || !thinned(line, aim, found, watch)) {
        return std::nullopt;
      }
      if (line.coefficients() >= given_.coefficients.count()) return std::nullopt;
      Lighter out{{line.degree(), line.knots(), std::move(found)}, 0.0};
      out.moved = bound_between(given_, out.spline);
      if (out.moved <= tolerance) return out;
      aim *= kLower * tolerance / out.moved;
    }
    return std::nullopt;
  }

 private:
  /// Largest error of all rows at each sample.
  [[nodiscard]] std::vector<double> errors_of(const SplineLine& line, const Rows& found) const {
    const Rows made = line.values(found);
    std::vector<double> out(at_.size(), 0.0);
    for (std::size_t i = 0; i < at_.size(); ++i) {
      for (std::size_t j = 0; j < made.width; ++j) {
        out[i] = std::max(out[i], norm(made.row(i)[j] - data_.row(i)[j]));
      }
    }
    return out;
  }
  [[nodiscard]] bool near(const SplineLine& line, const Rows& found, double aim) const {
    const std::vector<double> errors = errors_of(line, found);
    return *std::max_element(errors.begin(), errors.end()) <= aim;
  }

  bool refined(SplineLine& line, double aim, Rows& found, Watch& watch) const {
    while (!watch.cancelled()) {
      if (!line.fit(data_, kept_, found)) {
        // too few coefficients for what is kept: halves everywhere
        if (line.split(std::vector<double>(at_.size(), 1.0), 0.0) == 0) return false;
        continue;
      }
      const std::vector<double> errors = errors_of(line, found);
      const double worst = *std::max_element(errors.begin(), errors.end());
      if (worst <= aim) return true;
      // where the worst spans have no more samples, those beside them may still give way
      constexpr double kAlso = 0.25;  // of the worst
      if (line.split(errors, std::max(aim, kAlso * worst)) == 0 && line.split(errors, 0.0) == 0) {
        return false;
      }
    }
    return false;
  }

  /// Takes away the knots that matter least, as many at once as go well, half as many where they
  /// do not.
  bool thinned(SplineLine& line, double aim, Rows& found, Watch& watch) const {
    for (std::size_t batch = line.needs(found).size() / 2; batch > 0;) {
      if (watch.cancelled()) return false;
      const SplineLine before = line;
      const Rows found_before = found;
      line.remove(least_needed({line.needs(found)}, batch).front());
      if (line.coefficients() < before.coefficients() && line.fit(data_, kept_, found) &&
          near(line, found, aim)) {
        continue;
      }
      line = before;
      found = found_before;
      batch /= 2;
    }
    return true;
  }

  const Spline& given_;
  std::vector<double> at_;
  Rows data_;
  LineEnds kept_;
};

Result<void> check_given(const std::vector<NurbsSurface>& given, double tolerance) {
  OBVID_TRY(check_tolerance(tolerance));
  for (const NurbsSurface& s : given) {
    const bool alike = s.degree_v == given.front().degree_v && s.knots_v == given.front().knots_v;
    if (s.weights.empty() && alike && std::max(s.degree_u, s.degree_v) <= kMostLineDegree) continue;
    return error(ErrorCode::kBadOption,
                 "light surfaces are polynomial and have the same knots across");
  }
  return {};
}

/// The rows across of all surfaces side by side.
Spline across_all(const std::vector<NurbsSurface>& surfaces) {
  const NurbsSurface& first = surfaces.front();
  Spline out{first.degree_v, first.knots_v, {}};
  for (const NurbsSurface& s : surfaces) out.coefficients.width += s.count_u();
  for (std::size_t j = 0; j < first.count_v(); ++j) {
    for (const NurbsSurface& s : surfaces) {
      const auto row = s.points.begin() + static_cast<std::ptrdiff_t>(j * s.count_u());
      out.coefficients.points.insert(out.coefficients.points.end(), row,
                                     row + static_cast<std::ptrdiff_t>(s.count_u()));
    }
  }
  return out;
}

void take_across(const Spline& across, std::vector<NurbsSurface>& surfaces) {
  std::size_t at = 0;
  for (NurbsSurface& s : surfaces) {
    const std::size_t width = s.count_u();
    s.degree_v = across.degree;
    s.knots_v = across.knots;
    s.points.clear();
    for (std::size_t j = 0; j < across.coefficients.count(); ++j) {
      const Vec3* row = across.coefficients.row(j) + at;
      s.points.insert(s.points.end(), row, row + width);
    }
    at += width;
  }
}

}  // namespace

Result<LightSurfaces> lightened(const std::vector<NurbsSurface>& given, double tolerance,
                                const RunContext& run, LightWhere where) {
  OBVID_TRY(check_given(given, tolerance));
  Watch watch(run);
  const auto told = [&watch](double part) -> Result<void> {
    watch.tell("lightening", part);
    if (watch.cancelled()) return fail(cancelled_error());
    return {};
  };
  constexpr int kKeptAlong = 2, kKeptAcross = 0;  // derivatives at the ends
  constexpr int kLeastDegree = 3;                 // strips of straight lines have corners to keep
  LightSurfaces out{given, 0.0};
  const double parts = static_cast<double>(given.size() + 1);
  std::vector<Spline> rows;
  std::vector<FewKnots> along;
  rows.reserve(given.size());
  for (const NurbsSurface& s : given) {
    rows.push_back({s.degree_u, s.knots_u, transposed(Rows{s.count_u(), s.points})});
    along.emplace_back(rows.back(), kKeptAlong);
  }
  // along first, with a share of the tolerance; with all of it where across nothing is lighter
  for (const double share : {kShareAlong, 1.0}) {
    if (where == LightWhere::kAlong && share != 1.0) continue;
    out = {given, 0.0};
    for (std::size_t k = 0; k < given.size(); ++k) {
      OBVID_TRY(told(static_cast<double>(k) / parts));
      NurbsSurface& s = out.surfaces[k];
      if (s.degree_u < kLeastDegree) continue;
      const auto light = along[k].within(share * tolerance, watch);
      if (!light) continue;
      out.moved = std::max(out.moved, light->moved);
      s.knots_u = light->spline.knots;
      s.points = transposed(light->spline.coefficients).points;
    }
    OBVID_TRY(told((parts - 1.0) / parts));
    if (share == 1.0 || given.empty() || given.front().degree_v < kLeastDegree) continue;
    const Spline across = across_all(out.surfaces);
    const auto light = FewKnots(across, kKeptAcross).within(tolerance - out.moved, watch);
    if (!light) continue;
    out.moved += light->moved;
    take_across(light->spline, out.surfaces);
    break;
  }
  OBVID_TRY(told(1.0));
  return out;
}

}  // namespace obvid
