// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/why_not.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "advice/uniform_tolerance.h"
#include "obvid/numeric/internal/median.h"
#include "obvid/pipeline/internal/promise.h"
#include "obvid/series/analysis.h"
#include "verify/report.h"

namespace obvid {
namespace {

using namespace pipeline_detail;

constexpr double kBracketStep = 10.0;  // of the search for a bracket
// Where a trial takes seconds, those within the noise minutes: longer steps, from above.
constexpr double kLongStep = 1000.0;
constexpr double kLongGuess = 0.01;  // of the size
constexpr std::size_t kLongSeries = 2000;
constexpr double kAccuracy = 1.02;     // largest / smallest end of the final bracket
constexpr double kLeastAdvice = 1e-9;  // of the size: nobody measures less
constexpr double kLargestMove = 0.1;   // of the size: beyond, it is another shape
constexpr double kUsualGuess = 1e-5;   // of the size, where nothing says more
constexpr double kUsualTrials = 14.0;  // for the progress bar
/// The search ends when so many steps on every point, and some more where there are few, were
/// spent, or a single trial has taken so much of them.
constexpr double kSearchSteps = 2500.0, kSpareSearch = 1e6, kTrialShare = 0.4;
constexpr double kNoMove = 1e-6;  // of the tolerance: the rounding of a distance

bool says_no_contour(ErrorCode code) { return category(code) == ErrorCategory::kNoContour; }

FitJob unmeasured(FitJob job) {
  job.measure_against_spirals = false;
  return job;
}

class Search {
 public:
  Search(const PointSeries& series, const FitJob& job, const Error& refusal, const RunContext& run)
      : series_(series),
        job_(unmeasured(with_closing(series, job))),
        measured_(job.measure_against_spirals),
        progress_(run.progress),
        watch_(without_progress(run)),
        most_(kSpareSearch + kSearchSteps * static_cast<double>(series.points.size())) {
    out_.refusal = refusal;
  }

  std::optional<WhyNot> run() {
    set_limits();
    if (!(highest_ > lowest_)) return std::nullopt;
    if (bracket()) {
      bisect();
      out_.next_to_nothing = out_.found && exact() && out_.tolerance <= lowest_ * kAccuracy;
      advise();
      measure();
      rank();
    }
    if (watch_.was_cancelled() || (!out_.found && !out_.stopped)) return std::nullopt;
    return std::move(out_);
  }

 private:
  void set_limits() {
    lowest_ =
        std::max(coordinate_rounding(series_), kLeastAdvice * bounding_diagonal(series_.points));
    if (job_.noise) lowest_ = std::max(lowest_, *job_.noise);
    if (job_.noise_from_rounding) {
      lowest_ = std::max(lowest_, std::min(series_.rounding.x, series_.rounding.y));
    }
    lowest_ = printable(lowest_);
    highest_ = largest_tolerance_tried(series_);
  }

  /// Whether the job leaves every point where it is, and so allows no vertices but those of points.
  [[nodiscard]] bool exact() const {
    const bool asked =
        job_.noise_from_rounding || job_.noise_from_scatter || (job_.noise && *job_.noise > 0.0);
    return !asked && std::none_of(series_.fixed.begin(), series_.fixed.end(),
                                  [](const auto& fixed) { return fixed.tolerance.has_value(); });
  }

  /// Whether the refusal says how far the points would have to move.
  [[nodiscard]] bool told() const {
    return out_.refusal.value > 0.0 && std::isfinite(out_.refusal.value) &&
           out_.refusal.code == ErrorCode::kNoSpiral;
  }

  /// A tolerance to begin with: what the refusal says, what the file's digits say, or the usual.
  [[nodiscard]] double guess() const {
    const double size = bounding_diagonal(series_.points);
    if (long_series()) return std::clamp(printable(kLongGuess * size), lowest_, highest_);
    const double printed = std::max(series_.rounding.x, series_.rounding.y);
    double first = kUsualGuess * size;
    if (printed > 0.0) first = printed;
    if (told()) first = out_.refusal.value;
    return std::clamp(printable(first), lowest_, highest_);
  }

  /// Points that move so far at most seldom pass each other: the usual distance of neighbours.
  [[nodiscard]] double within_order() const {
    std::vector<double> chords;
    for (std::size_t i = 1; i < series_.points.size(); ++i) {
      chords.push_back(norm(series_.points[i] - series_.points[i - 1]));
    }
    return std::clamp(printable(median_of(std::move(chords))), lowest_, highest_);
  }

  [[nodiscard]] bool long_series() const { return series_.points.size() > kLongSeries; }
  [[nodiscard]] double step() const { return long_series() ? kLongStep : kBracketStep; }

  /// Whether another trial may begin.
  bool may_go_on() {
    if (watch_.spent() >= most_ || watch_.cancelled()) out_.stopped = true;
    return !out_.stopped;
  }

  /// Whether a trial would do again what the job was refused for.
  [[nodiscard]] bool is_what_was_refused(double tolerance) const {
    const bool own =
        std::any_of(series_.fixed.begin(), series_.fixed.end(),
                    [](const FixedData& fixed) { return fixed.tolerance.has_value(); });
    return !own && !job_.noise_from_rounding && job_.noise == tolerance;
  }

  bool possible(double tolerance) {
    if (progress_) {
      progress_("searching the tolerance", std::min(trials_ / kUsualTrials, 1.0));
    }
    trials_ += 1.0;
    if (is_what_was_refused(tolerance)) {
      out_.refused = tolerance;
      return false;
    }
    const Allowance allowance(watch_, std::min(kTrialShare * most_, most_ - watch_.spent()));
    auto made = fit_within(series_, job_, tolerance, watch_);
    if (!watch_.may_go_on()) {  // `fit` has more time, and may find another answer
      out_.stopped = true;
      return false;
    }
    if (!made || broken_promise(*made)) {
      out_.refused = tolerance;
      return false;
    }
    out_.found = true;
    out_.tolerance = tolerance;
    out_.fit = std::move(*made);
    return true;
  }

  /// Steps down from one that does, until one does not or there is none smaller.
  void go_down() {
    double t = out_.tolerance;
    while (t > lowest_ && may_go_on()) {
      t = std::max(printable(t / step()), lowest_);
      if (!possible(t)) return;
    }
  }

  /// Steps up from one that does not to `last` at most. False when none does.
  bool go_up(double t, double last) {
    while (t < last && may_go_on()) {
      t = std::min(printable(t * step()), last);
      if (possible(t)) return true;
    }
    return false;
  }

  /// Leaves a tolerance that does, and where there is one a smaller one that does not. False when
  /// nothing does. A trial that finds a contour is short, one that finds none is long: where
  /// nothing says how far the points are off, the search begins with as much as leaves them in
  /// their order.
  bool bracket() {
    const bool guided = told() || long_series();
    const double first = guided ? guess() : within_order();
    if (possible(first)) {
      go_down();
      return true;
    }
    if (go_up(first, highest_)) return true;
    if (guided || !may_go_on()) return false;
    const double last = printable(first / kBracketStep);
    out_.refused = 0.0;
    const double small = guess();
    return small < last && (possible(small) || go_up(small, last));
  }

  void bisect() {
    while (out_.refused > 0.0 && out_.refused < out_.tolerance / kAccuracy && may_go_on()) {
      const double middle = printable(std::sqrt(out_.refused) * std::sqrt(out_.tolerance));
      if (middle <= out_.refused || middle >= out_.tolerance) return;
      possible(middle);
    }
  }

  /// What the user can type. Tolerances far below the digits of the file are true, and nobody's.
  void advise() {
    if (!out_.found) return;
    out_.advised = out_.tolerance;
    const double printed = std::min(series_.rounding.x, series_.rounding.y);
    if (!job_.noise_from_rounding && out_.tolerance < printed) {
      FitJob job = job_;
      job.noise.reset();
      job.noise_from_rounding = true;
      job.noise_from_scatter = false;
      auto made = fit(series_, job, watch_);
      out_.rounding_does = made && !broken_promise(*made);
      if (out_.rounding_does) out_.fit = std::move(*made);
    }
    if (out_.rounding_does || !out_.next_to_nothing) return;
    const double least = out_.tolerance;
    for (double t = printable(out_.fit.report.tolerance); t > least && may_go_on();
         t = printable(t / kBracketStep)) {
      auto made = fit_within(series_, job_, t, watch_);
      if (!made || broken_promise(*made)) continue;
      out_.advised = t;
      out_.fit = std::move(*made);
      return;
    }
  }

  /// The trials did without what only the answer is asked for.
  void measure() {
    if (!out_.found || !measured_ || !follows_spirals(job_.carrier)) return;
    FitJob job = job_;
    job.measure_against_spirals = true;
    if (out_.rounding_does) {
      job.noise.reset();
      job.noise_from_rounding = true;
      job.noise_from_scatter = false;
    }
    auto made = out_.rounding_does ? fit(series_, job, watch_)
                                   : fit_within(series_, job, out_.advised, watch_);
    if (made) out_.fit = std::move(*made);
  }

  void rank() {
    const std::vector<double>& moves = out_.fit.report.moves;
    for (std::size_t i = 0; i < moves.size(); ++i) {
      if (moves[i] > kNoMove * out_.advised) out_.moved.push_back(i);
    }
    std::stable_sort(out_.moved.begin(), out_.moved.end(),
                     [&](std::size_t a, std::size_t b) { return moves[a] > moves[b]; });
  }

  const PointSeries& series_;
  const FitJob job_;
  const bool measured_;
  const Progress& progress_;
  double lowest_ = 0.0, highest_ = 0.0;
  double trials_ = 0.0;
  Watch watch_;  // counts; the bar shows trials
  double most_;
  WhyNot out_;
};

}  // namespace

double largest_tolerance_tried(const PointSeries& series) {
  return printable(kLargestMove * bounding_diagonal(series.points));
}

std::optional<WhyNot> why_not(const PointSeries& series, const FitJob& job, const Error& refusal,
                              const RunContext& run) {
  if (!says_no_contour(refusal.code)) return std::nullopt;
  return Search(series, job, refusal, run).run();
}

std::optional<WhyNot> why_not(const PointSeries& series, const FitJob& job, const RunContext& run) {
  const auto asked = fit(series, job, without_progress(run));
  if (asked) return std::nullopt;
  return why_not(series, job, asked.error(), run);
}

}  // namespace obvid
