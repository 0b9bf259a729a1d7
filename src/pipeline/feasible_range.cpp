// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/feasible_range.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "uniform_tolerance.h"

namespace obvid {
namespace {

using namespace pipeline_detail;
using Datum = FeasibleRange::Datum;

constexpr double kDegreeStep = std::numbers::pi / 180.0;
constexpr double kRangeAccuracy = 0.01;  // of the range, to which its ends are sought and rounded
constexpr int kMostDoublings = 24;       // of a step away from a value that does
constexpr int kMostHalvings = 40;
constexpr double kFirstStep = 1e-3;  // of the way from what does to what was asked
constexpr std::size_t kMostCandidates = 8;
/// Narrower ranges are left to rounding: rad, and of the curvature. As much as joints may differ.
constexpr double kNarrowest = 1e-6;
/// No further trial begins when so many steps on every point, and some more, were spent.
constexpr double kRangeSteps = 5000.0, kSpareRange = 2e6;

/// Where a datum was given: in the series, as a wish of the job, or for an end.
struct Given {
  std::size_t point;
  Datum datum;
  double value;
};

double in_first_turn(double angle) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return angle - kTurn * std::floor(angle / kTurn);
}

class RangeSearch {
 public:
  RangeSearch(const PointSeries& series, const FitJob& job, const Progress& progress)
      : series_(series),
        job_(with_closing(series, job)),
        most_(kSpareRange + kRangeSteps * static_cast<double>(series.points.size())) {
    if (progress) watch_ = Watch(progress);
    gather();
  }

  std::optional<FeasibleRange> run(std::size_t near) {
    const auto away = [near](const Given& g) {
      return g.point > near ? g.point - near : near - g.point;
    };
    std::stable_sort(given_.begin(), given_.end(),
                     [&](const Given& a, const Given& b) { return away(a) < away(b); });
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
    for (const PointWish& wish : job_.wishes) {
      if (wish.index >= n) continue;
      if (wish.theta) all[wish.index].theta = wish.theta;
      if (wish.kappa) all[wish.index].kappa = wish.kappa;
    }
    if (n == 0) return;
    if (job_.start_heading) all.front().theta = job_.start_heading;
    if (job_.start_kappa) all.front().kappa = job_.start_kappa;
    if (job_.end_heading) all.back().theta = job_.end_heading;
    if (job_.end_kappa) all.back().kappa = job_.end_kappa;
    for (std::size_t i = 0; i < n; ++i) {
      if (all[i].theta) given_.push_back({i, Datum::kHeading, *all[i].theta});
      if (all[i].kappa) given_.push_back({i, Datum::kCurvature, *all[i].kappa});
    }
  }

  /// The contour with one datum freed, or set to a value.
  std::optional<Fit> with(const Given& given, std::optional<double> value) {
    if (watch_.spent() >= most_) return std::nullopt;
    PointSeries series = series_;
    FitJob job = job_;
    const bool heading = given.datum == Datum::kHeading;
    const auto drop = [heading](FixedData& data) { (heading ? data.theta : data.kappa).reset(); };
    if (given.point < series.fixed.size()) drop(series.fixed[given.point]);
    for (PointWish& wish : job.wishes) {
      if (wish.index == given.point) (heading ? wish.theta : wish.kappa).reset();
    }
    if (given.point == 0) (heading ? job.start_heading : job.start_kappa).reset();
    if (given.point + 1 == series.points.size())
      (heading ? job.end_heading : job.end_kappa).reset();
    if (value) {
      series.fixed.resize(series.points.size());
      (heading ? series.fixed[given.point].theta : series.fixed[given.point].kappa) = value;
    }
    auto made = fit(series, job, watch_);
    if (!made || !keeps_promises(*made)) return std::nullopt;
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
    const double unit = given.datum == Datum::kHeading ? kDegreeStep : 1.0;
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

  std::optional<FeasibleRange> range_of(Given given) {
    const auto free = free_value(given);
    if (!free) return std::nullopt;
    const double asked = given.value;
    if (given.datum == Datum::kHeading) {
      given.value = *free + std::remainder(asked - *free, 2.0 * std::numbers::pi);
    }
    const double way = given.value - *free;
    if (!does(given, *free)) return std::nullopt;
    const double step = kFirstStep * std::abs(way);
    const double low = outward(given, *free, -step), high = outward(given, *free, step);
    const double width = high - low;
    const double size =
        given.datum == Datum::kHeading ? 1.0 : std::max(std::abs(low), std::abs(high));
    if (!(width > kNarrowest * size)) return std::nullopt;
    const auto least = printed(given, low, high, width);
    const auto greatest = printed(given, high, low, width);
    if (!least || !greatest || *least > *greatest) return std::nullopt;
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
                                            const Error& refusal, const Progress& progress) {
  if (refusal.code != ErrorCode::kFixedDataContradict) return std::nullopt;
  const auto near = refusal.index < 0 ? std::size_t{0} : static_cast<std::size_t>(refusal.index);
  return RangeSearch(series, job, progress).run(near);
}

}  // namespace obvid
