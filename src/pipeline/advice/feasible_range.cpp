// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/feasible_range.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "advice/uniform_tolerance.h"
#include "fit/form.h"
#include "fit/prepare.h"
#include "fit/series_ranges.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/pipeline/internal/promise.h"
#include "obvid/series/analysis.h"

namespace obvid {
namespace {

using namespace pipeline_detail;
using Datum = FeasibleRange::Datum;

constexpr double kRangeAccuracy = 0.01;  // of the range, to which its ends are sought and rounded
constexpr int kMostDoublings = 24;       // of a step away from a value that does
constexpr int kMostHalvings = 40;
constexpr double kFirstStep = 1e-3;  // of the way from what does to what was asked
constexpr std::size_t kMostCandidates = 8;
/// Narrower ranges are left to rounding: rad, and of the curvature. As much as joints may differ.
constexpr double kNarrowest = 1e-6;
/// Of a value that is kept as nearly as joints may differ there is a range of twice that width.
constexpr double kKeptOnBothSides = 3.0 * kNarrowest;
/// In closed form narrower ones are told too: their ends are tried.
constexpr double kNarrowestExact = 1e-10;
/// A hundredth of these is what `feasible_data` knows.
constexpr double kToldExactly = 1e-5;
/// Series of so many points have their ranges in closed form, or none.
constexpr std::size_t kTooLongForTrials = 1000;
/// The trials end when so many steps on every point, and some more, were spent.
constexpr double kRangeSteps = 5000.0, kSpareRange = 2e6;
/// A piece is formed, proved and measured in the time of so many steps.
constexpr double kStepsOfPiece = 30.0;

/// Where a datum was given: in the series, as a constraint of the job, or for an end.
struct Given {
  std::size_t point;
  Datum datum;
  double value;
};

/// In the middle of a range, or at its one end.
double some_value(const ValueRange& range) {
  if (std::isinf(range.low)) return range.high;
  return std::isinf(range.high) ? range.low : 0.5 * (range.low + range.high);
}

double in_first_turn(double angle) { return angle - kFullTurn * std::floor(angle / kFullTurn); }

/// To a power of ten that is at most `place`.
double rounded_to_place(double value, double place) {
  const double power = std::pow(10.0, std::ceil(-std::log10(place)));
  return std::round(value * power) / power;
}

class RangeSearch {
 public:
  RangeSearch(const PointSeries& series, const FitJob& job, const RunContext& run)
      : series_(series),
        job_(with_closing(series, job)),
        watch_(run),
        most_(kSpareRange + kRangeSteps * static_cast<double>(series.points.size())) {
    gather();
  }

  std::optional<FeasibleRange> run(std::size_t near) {
    const auto away = [near](const Given& g) {
      return g.point > near ? g.point - near : near - g.point;
    };
    std::stable_sort(given_.begin(), given_.end(),
                     [&](const Given& a, const Given& b) { return away(a) < away(b); });
    if (const auto exact = closed_form()) return exact;
    // every trial forms the whole series
    if (series_.points.size() >= kTooLongForTrials) return std::nullopt;
    if (given_.size() > kMostCandidates) given_.resize(kMostCandidates);
    for (const Given& one : given_) {
      if (auto found = range_of(one)) return found;
    }
    return std::nullopt;
  }

 private:
  void gather() {
    const std::size_t n = series_.points.size();
    std::vector<FixedData> all = series_.fixed;
    all.resize(n);
    for (const PointConstraint& constraint : job_.constraints) {
      if (constraint.index >= n) continue;
      if (constraint.theta) all[constraint.index].theta = constraint.theta;
      if (constraint.kappa) all[constraint.index].kappa = constraint.kappa;
      if (constraint.thetas) all[constraint.index].thetas = constraint.thetas;
      if (constraint.kappas) all[constraint.index].kappas = constraint.kappas;
    }
    if (n == 0) return;
    if (job_.start_heading) all.front().theta = job_.start_heading;
    if (job_.start_kappa) all.front().kappa = job_.start_kappa;
    if (job_.end_heading) all.back().theta = job_.end_heading;
    if (job_.end_kappa) all.back().kappa = job_.end_kappa;
    if (job_.start_thetas) all.front().thetas = job_.start_thetas;
    if (job_.start_kappas) all.front().kappas = job_.start_kappas;
    if (job_.end_thetas) all.back().thetas = job_.end_thetas;
    if (job_.end_kappas) all.back().kappas = job_.end_kappas;
    for (std::size_t i = 0; i < n; ++i) {
      if (all[i].theta) given_.push_back({i, Datum::kHeading, *all[i].theta});
      if (all[i].kappa) given_.push_back({i, Datum::kCurvature, *all[i].kappa});
      if (all[i].thetas && !all[i].theta) {
        given_.push_back({i, Datum::kHeading, some_value(*all[i].thetas)});
      }
      if (all[i].kappas && !all[i].kappa) {
        given_.push_back({i, Datum::kCurvature, some_value(*all[i].kappas)});
      }
    }
  }

  /// The contour with one datum freed, or set to a value.
  std::optional<Fit> with(const Given& given, std::optional<double> value) {
    if (watch_.spent() >= most_ || watch_.cancelled()) return std::nullopt;
    PointSeries series = series_;
    FitJob job = job_;
    job.measure_against_spirals = false;  // asked for is whether there is one
    if (job.continuity != Continuity::kG3) job.continuity = Continuity::kG2;  // gives way to it
    const bool heading = given.datum == Datum::kHeading;
    const auto drop = [heading](auto& data) {
      (heading ? data.theta : data.kappa).reset();
      (heading ? data.thetas : data.kappas).reset();
    };
    if (given.point < series.fixed.size()) drop(series.fixed[given.point]);
    for (PointConstraint& constraint : job.constraints) {
      if (constraint.index == given.point) drop(constraint);
    }
    if (given.point == 0) {
      (heading ? job.start_heading : job.start_kappa).reset();
      (heading ? job.start_thetas : job.start_kappas).reset();
    }
    if (given.point + 1 == series.points.size()) {
      (heading ? job.end_heading : job.end_kappa).reset();
      (heading ? job.end_thetas : job.end_kappas).reset();
    }
    if (value) {
      series.fixed.resize(series.points.size());
      (heading ? series.fixed[given.point].theta : series.fixed[given.point].kappa) = value;
    }
    const Allowance allowance(watch_, most_ - watch_.spent());
    auto made = fit(series, job, watch_);
    if (!watch_.may_go_on()) return std::nullopt;  // it may find another answer with more
    if (made) watch_.spend(kStepsOfPiece * static_cast<double>(made->contour.pieces.size()));
    if (!made || broken_promise(*made)) return std::nullopt;
    return std::move(*made);
  }

  bool does(const Given& given, double value) { return with(given, value).has_value(); }

  /// What a contour has there that is free to choose.
  std::optional<double> free_value(const Given& given) {
    const auto made = with(given, std::nullopt);
    if (!made) return std::nullopt;
    const auto& joints = made->contour.joints;
    const Vec2 p = series_.points[given.point];
    const auto stands = [&](const Joint& j) {
      return j.source && made->contour.points[*j.source] == p;
    };
    const auto at = std::find_if(joints.begin(), joints.end(), stands);
    if (at == joints.end() || at->leaving) return std::nullopt;
    if (given.datum == Datum::kCurvature) return at->element.kappa;
    return in_first_turn(at->element.theta);
  }

  /// The last value that does between one that does and one that does not.
  double bisected(const Given& given, double good, double bad) {
    const double from = good;
    for (int k = 0; k < kMostHalvings; ++k) {
      if (std::abs(bad - good) <= kRangeAccuracy * std::abs(good - from)) break;
      const double middle = 0.5 * (good + bad);
      if (middle == good || middle == bad) break;
      (does(given, middle) ? good : bad) = middle;
    }
    return good;
  }

  /// The last value that does, going from `good` with longer and longer steps.
  double outward(const Given& given, double good, double step) {
    const double from = good, way = given.value - good;
    for (int k = 0; k < kMostDoublings; ++k, step *= 2.0) {
      // what was asked is known not to do
      if (step * way > 0.0 && std::abs(step) >= std::abs(way)) {
        return bisected(given, good, given.value);
      }
      const double next = from + step;
      const bool too_far =
          given.datum == Datum::kHeading && std::abs(next - given.value) > std::numbers::pi;
      if (too_far) return good;
      if (!does(given, next)) return bisected(given, good, next);
      good = next;
    }
    return good;
  }

  /// Rounded towards `inside` to a place of which the range has hundreds, and tried.
  std::optional<double> printed(const Given& given, double end, double inside, double width) {
    const double unit = given.datum == Datum::kHeading ? kOneDegree : 1.0;
    const double place = std::pow(10.0, std::floor(std::log10(kRangeAccuracy * width / unit)));
    if (!(place > 0.0) || !std::isfinite(place)) return std::nullopt;
    const double towards = inside > end ? 1.0 : -1.0;
    double steps = towards > 0.0 ? std::ceil(end / unit / place) : std::floor(end / unit / place);
    for (int k = 0; k < 3; ++k, steps += towards) {
      // divided by a whole number the decimal fraction is the double that its digits mean
      const double value = place < 1.0 ? steps / std::round(1.0 / place) : steps * place;
      if (does(given, value * unit)) return value * unit;
    }
    return std::nullopt;
  }

  /// The series as its ranges are told in closed form: points that are met, open, without corners.
  std::optional<std::vector<FeasibleData>> closed_form_ranges(
      const pipeline_detail::Prepared& series) const {
    const bool one = series.split.sections.size() == 1 && !series.closed && series.kept.empty();
    if (!one || !series.exact() || series.points.size() != series_.points.size()) {
      return std::nullopt;
    }
    const auto analysis = analyse(series.points);
    if (!analysis) return std::nullopt;
    const ChainConstraints constraints{series.fixed, series.convex};
    if (is_few_on_one_circle(series.points, *analysis))
      return ranges_of_few(*analysis, constraints);
    auto ranges = series_ranges(*analysis, constraints);
    if (!ranges) return std::nullopt;
    return std::move(*ranges);
  }

  /// Two or three points do not say whether the curvature grows or falls: the way in which
  /// something that is given has a range.
  [[nodiscard]] std::optional<std::vector<FeasibleData>> ranges_of_few(
      Analysis analysis, const ChainConstraints& constraints) const {
    analysis.stretches.clear();
    for (const std::int8_t direction : {std::int8_t{1}, std::int8_t{-1}}) {
      analysis.direction.assign(analysis.direction.size(), direction);
      auto ranges = series_ranges(analysis, constraints);
      if (!ranges) continue;
      const bool any = std::any_of(given_.begin(), given_.end(), [&](const Given& given) {
        const FeasibleData& here = (*ranges)[given.point];
        return given.datum == Datum::kHeading ? here.heading.has_value() : here.kappa.has_value();
      });
      if (any) return std::move(*ranges);
    }
    return std::nullopt;
  }

  /// The nearest datum that has a range which leaves all others alone; `fit` tries both its ends.
  std::optional<FeasibleRange> closed_form() {
    const auto series = prepare(series_, job_);
    if (!series) return std::nullopt;
    const auto ranges = closed_form_ranges(*series);
    if (!ranges) return std::nullopt;
    for (const Given& given : given_) {
      const FeasibleData& here = (*ranges)[given.point];
      const bool heading = given.datum == Datum::kHeading;
      if (heading ? !here.heading : !here.kappa) continue;
      double low = heading ? here.heading->low : here.kappa->low;
      double high = heading ? here.heading->high : here.kappa->high;
      if (std::isinf(low) && std::isinf(high)) continue;
      // an end that is none is told as far away as the other one is large
      if (std::isinf(low)) low = high - std::max(std::abs(high), kNarrowest);
      if (std::isinf(high)) high = low + std::max(std::abs(low), kNarrowest);
      const double size = heading ? 1.0 : std::max(std::abs(low), std::abs(high));
      if (!(high - low > kNarrowestExact * size)) continue;
      if (heading) {
        const double turns = in_first_turn(0.5 * (low + high)) - 0.5 * (low + high);
        low += turns;
        high += turns;
      }
      const auto least = printed(given, low, high, high - low);
      const auto greatest = printed(given, high, low, high - low);
      // between points that lie close together rounding decides, beside the ends and inside
      const bool told =
          least && greatest && *least <= *greatest && does(given, 0.5 * (*least + *greatest));
      if (!told) {
        const auto middle = printed(given, 0.5 * (low + high), high, high - low);
        if (!middle) continue;
        return FeasibleRange{given.point, given.datum, given.value, *middle, *middle, false};
      }
      return FeasibleRange{given.point, given.datum, given.value,
                           *least,      *greatest,   high - low > kToldExactly * size};
    }
    return std::nullopt;
  }

  std::optional<FeasibleRange> range_of(Given given) {
    const auto free = free_value(given);
    if (!free) return std::nullopt;
    const double asked = given.value;
    if (given.datum == Datum::kHeading) {
      given.value = nearest_angle(asked, *free);
    }
    const double way = given.value - *free;
    if (!does(given, *free)) return std::nullopt;
    const double step = kFirstStep * std::abs(way);
    const double low = outward(given, *free, -step), high = outward(given, *free, step);
    const double width = high - low;
    const double size =
        given.datum == Datum::kHeading ? 1.0 : std::max(std::abs(low), std::abs(high));
    if (!(width > kNarrowest * size)) return std::nullopt;
    if (width < kKeptOnBothSides * size) {
      const double unit = given.datum == Datum::kHeading ? kOneDegree : 1.0;
      const double only = rounded_to_place(*free / unit, kRangeAccuracy * width / unit) * unit;
      if (!does(given, only)) return std::nullopt;
      return FeasibleRange{given.point, given.datum, asked, only, only, false};
    }
    const auto least = printed(given, low, high, width);
    const auto greatest = printed(given, high, low, width);
    if (!least || !greatest || *least > *greatest) return std::nullopt;
    if (!does(given, 0.5 * (*least + *greatest))) return std::nullopt;
    return FeasibleRange{given.point, given.datum, asked, *least, *greatest};
  }

  const PointSeries& series_;
  const FitJob job_;
  std::vector<Given> given_;
  Watch watch_;
  double most_;
};

}  // namespace

std::optional<FeasibleRange> feasible_range(const PointSeries& series, const FitJob& job,
                                            const Error& refusal, const RunContext& run) {
  if (refusal.code != ErrorCode::kFixedDataContradict) return std::nullopt;
  const auto near = refusal.index < 0 ? std::size_t{0} : static_cast<std::size_t>(refusal.index);
  return RangeSearch(series, job, run).run(near);
}

}  // namespace obvid
