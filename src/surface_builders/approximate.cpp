// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/approximate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "approximate_line.h"
#include "network_curves.h"
#include "obvid/surface_builders/internal/grid.h"

namespace obvid {
namespace {

/// Largest error of each row and of each column.
struct Errors {
  std::vector<double> of_row, of_column;
  double worst = 0.0;
  std::size_t worst_at = 0;
};

Errors errors_between(const Rows& a, const Rows& b) {
  Errors errors{std::vector<double>(a.count(), 0.0), std::vector<double>(a.width, 0.0), 0.0, 0};
  for (std::size_t j = 0; j < a.count(); ++j) {
    for (std::size_t i = 0; i < a.width; ++i) {
      const double error = norm(a.row(j)[i] - b.row(j)[i]);
      errors.of_row[j] = std::max(errors.of_row[j], error);
      errors.of_column[i] = std::max(errors.of_column[i], error);
      if (error > errors.worst) {
        errors.worst = error;
        errors.worst_at = j * a.width + i;
      }
    }
  }
  return errors;
}

/// What has to stay exactly at the first and the last row: a pole, a seam.
struct KeptEnds {
  bool first = false, last = false;
};

KeptEnds kept_ends(const Rows& rows) {
  const Vec3 *first = rows.row(0), *last = rows.row(rows.count() - 1);
  const auto one_point = [&](const Vec3* row) {
    return std::all_of(row, row + rows.width, [&](Vec3 p) { return p == row[0]; });
  };
  const bool closed = std::equal(first, first + rows.width, last);
  return {closed || one_point(first), closed || one_point(last)};
}

/// Rows of the data that stay, as far as they are to.
LineEnds ends_of(const Rows& rows, KeptEnds kept) {
  const auto row = [&](std::size_t k) {
    return Rows{rows.width, std::vector<Vec3>(rows.row(k), rows.row(k) + rows.width)};
  };
  LineEnds ends;
  if (kept.first) ends.first = row(0);
  if (kept.last) ends.last = row(rows.count() - 1);
  return ends;
}

/// Distances of a point from the surface: at its parameters, and nearby.
struct Distance {
  double parametric = 0.0, nearest = 0.0;
};

/// Steps of Gauss and Newton from (u, v), taken only when they come nearer: an upper bound of the
/// distance, and the distance in all but contrived cases.
Distance distance_near(const NurbsSurface& surface, double u, double v, Vec3 point) {
  constexpr int kMostSteps = 8;
  constexpr double kSettled = 1e-3;  // part of the distance that a step has to gain
  SurfaceJet jet = evaluate(surface, u, v);
  Distance distance;
  distance.parametric = distance.nearest = norm(jet.point - point);
  for (int step = 0; step < kMostSteps && distance.nearest > 0.0; ++step) {
    const Vec3 gap = point - jet.point;
    const double a = dot(jet.du, jet.du), b = dot(jet.du, jet.dv), c = dot(jet.dv, jet.dv);
    const double det = a * c - b * b, gu = dot(gap, jet.du), gv = dot(gap, jet.dv);
    if (!(det > 0.0)) break;
    u = std::clamp(u + (c * gu - b * gv) / det, 0.0, 1.0);
    v = std::clamp(v + (a * gv - b * gu) / det, 0.0, 1.0);
    jet = evaluate(surface, u, v);
    const double next = norm(jet.point - point);
    const bool settled = !(next < distance.nearest * (1.0 - kSettled));
    distance.nearest = std::min(distance.nearest, next);
    if (settled) break;
  }
  return distance;
}

class Approximation {
 public:
  Approximation(const PointGrid& grid, std::vector<double> u, std::vector<double> v)
      : data_{grid.count_u, grid.points},
        turned_(transposed(data_)),
        along_u_(std::move(u)),
        along_v_(std::move(v)),
        ends_u_(kept_ends(turned_)),
        ends_v_(kept_ends(data_)) {}

  /// Splits and fits until within the tolerance; false when the data cannot carry it.
  bool fitted(double tolerance, const RunContext& run) {
    if (!fit_u() || !fit_v() || !fit_both()) return false;
    while (!within(tolerance)) {
      cancelled_ = !tell(run, "approximating surface", part_used());
      if (cancelled_) return false;
      const bool refined = refine(tolerance);
      if (!refined) saturate();
      if (!fit_again() || (!refined && !within(tolerance))) return false;
    }
    return thin_out(tolerance);
  }

  [[nodiscard]] ApproximatedSurface measured(NurbsSurface surface) const {
    ApproximatedSurface result{std::move(surface), 0.0, 0.0, 0.0};
    double squares = 0.0;
    for (std::size_t k = 0; k < data_.points.size(); ++k) {
      const Distance distance = distance_near(result.surface, u_of(k), v_of(k), data_.points[k]);
      result.parametric_deviation = std::max(result.parametric_deviation, distance.parametric);
      result.deviation = std::max(result.deviation, distance.nearest);
      squares += distance.nearest * distance.nearest;
    }
    result.root_mean_square = std::sqrt(squares / static_cast<double>(data_.points.size()));
    return result;
  }

  [[nodiscard]] bool was_cancelled() const { return cancelled_; }
  [[nodiscard]] NurbsSurface take() { return std::move(surface_); }

 private:
  [[nodiscard]] double u_of(std::size_t k) const { return along_u_.parameters()[k % data_.width]; }
  [[nodiscard]] double v_of(std::size_t k) const { return along_v_.parameters()[k / data_.width]; }
  [[nodiscard]] double part_used() const {
    return static_cast<double>(along_u_.coefficients() + along_v_.coefficients()) /
           static_cast<double>(data_.width + data_.count());
  }

  bool fit_u() {
    if (!along_u_.fit(turned_, ends_of(turned_, ends_u_), rows_fitted_)) return false;
    from_u_ = errors_between(turned_, along_u_.values(rows_fitted_));
    return true;
  }
  bool fit_v() {
    if (!along_v_.fit(data_, ends_of(data_, ends_v_), columns_fitted_)) return false;
    from_v_ = errors_between(data_, along_v_.values(columns_fitted_));
    return true;
  }

  bool fit_both() {
    Rows net;
    const Rows rows = transposed(rows_fitted_);
    if (!along_v_.fit(rows, ends_of(rows, ends_v_), net)) return false;
    shape_ = transposed(along_u_.values(transposed(along_v_.values(net))));
    all_ = errors_between(data_, shape_);
    surface_ = {along_u_.degree(), along_v_.degree(),     along_u_.knots(),
                along_v_.knots(),  std::move(net.points), {}};
    return true;
  }

  [[nodiscard]] bool within(double tolerance) const {
    if (all_.worst <= tolerance) return true;
    const auto near_enough = [&](std::size_t k) {
      if (norm(shape_.points[k] - data_.points[k]) <= tolerance) return true;
      return distance_near(surface_, u_of(k), v_of(k), data_.points[k]).nearest <= tolerance;
    };
    if (!near_enough(all_.worst_at)) return false;  // decides nearly always, for one point's cost
    for (std::size_t k = 0; k < data_.points.size(); ++k) {
      if (!near_enough(k)) return false;
    }
    return true;
  }

  /// The error is that of the rows' fits plus the fitted error of the columns' fits: knots go where
  /// the direction with the larger share has its largest errors.
  bool refine(double tolerance) {
    const double limit_u = threshold(from_u_.worst, tolerance);
    const double limit_v = threshold(from_v_.worst, tolerance);
    const bool u_first = from_u_.worst >= from_v_.worst;
    // where the worst spans have no more points, smaller errors beside them can still give way
    return u_first ? split_u(limit_u) || split_v(limit_v) || split_u(0.0) || split_v(0.0)
                   : split_v(limit_v) || split_u(limit_u) || split_v(0.0) || split_u(0.0);
  }
  bool split_u(double limit) { return along_u_.split(from_u_.of_row, limit) > 0; }
  bool split_v(double limit) { return along_v_.split(from_v_.of_row, limit) > 0; }
  void saturate() {
    along_u_.saturate();
    along_v_.saturate();
  }

  /// Takes away knots that the tolerance does not need: those that matter least, as many at once as
  /// go well, half as many where they do not.
  bool thin_out(double tolerance) {
    std::size_t batch = (inner(along_u_) + inner(along_v_)) / 2;
    const double most_u = std::max(kMostSwing, along_u_.swing());
    const double most_v = std::max(kMostSwing, along_v_.swing());
    while (batch > 0) {
      const SplineLine old_u = along_u_, old_v = along_v_;
      if (!remove_least(batch)) return true;
      const bool tame = along_u_.swing() <= most_u && along_v_.swing() <= most_v;
      if (tame && fit_again() && within(tolerance)) continue;
      along_u_ = old_u;
      along_v_ = old_v;
      if (!fit_again()) return false;
      batch /= 2;
    }
    return true;
  }

  bool fit_again() { return fit_u() && fit_v() && fit_both(); }

  static std::size_t inner(const SplineLine& line) {
    return line.coefficients() - static_cast<std::size_t>(line.degree()) - 1;
  }

  /// False when there is nothing to remove.
  bool remove_least(std::size_t batch) {
    const auto least =
        least_needed({along_u_.needs(rows_fitted_), along_v_.needs(columns_fitted_)}, batch);
    along_u_.remove(least[0]);
    along_v_.remove(least[1]);
    return !least[0].empty() || !least[1].empty();
  }

  static double threshold(double worst, double tolerance) {
    // halving a span takes a cubic's error to 1/16: spans beyond 1/4 of the worst are halved too,
    // as otherwise they were the worst in the next step
    constexpr double kAlso = 0.25;
    constexpr double kNearlyWorst = 0.9;  // within the tolerance only the worst ones are halved
    return std::min(kNearlyWorst * worst, std::max(tolerance, kAlso * worst));
  }

  Rows data_;    // rows along u, one for each v
  Rows turned_;  // the same, rows along v
  SplineLine along_u_, along_v_;
  KeptEnds ends_u_, ends_v_;
  Rows rows_fitted_;     // coefficients along u of each row, turned
  Rows columns_fitted_;  // coefficients along v of each column
  Errors from_u_, from_v_, all_;
  Rows shape_;  // points of the surface at the parameters
  NurbsSurface surface_;
  bool cancelled_ = false;
};

}  // namespace

Result<ApproximatedSurface> approximated(const PointGrid& grid, double tolerance,
                                         const RunContext& run) {
  OBVID_TRY(check_tolerance(tolerance));
  auto u = grid_parameters(grid, true, Spread::kChord);
  OBVID_TRY(u);
  auto v = grid_parameters(grid, false, Spread::kChord);
  OBVID_TRY(v);
  Approximation work(grid, std::move(*u), std::move(*v));
  NurbsSurface surface;
  const bool near = work.fitted(tolerance, run);
  if (work.was_cancelled()) return fail(cancelled_error());
  if (near) {
    surface = work.take();
  } else {
    Result<NurbsSurface> through = interpolated(grid, Spread::kChord);
    OBVID_TRY(through);
    surface = std::move(*through);
  }
  ApproximatedSurface result = work.measured(std::move(surface));
  OBVID_TRY(tell(run, "approximating surface", 1.0));
  if (result.deviation <= tolerance) return result;
  return error(ErrorCode::kToleranceNotReached,
               fmt::format("a surface comes no nearer to all points than {:g}, the tolerance is "
                           "{:g}",
                           result.deviation, tolerance))
      .hint("give a tolerance above the rounding of the coordinates")
      .value(result.deviation);
}

}  // namespace obvid
