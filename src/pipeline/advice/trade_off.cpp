// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/trade_off.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "advice/uniform_tolerance.h"
#include "fit/prepare.h"
#include "obvid/pipeline/internal/promise.h"
#include "obvid/pipeline/internal/refusal.h"
#include "obvid/series/analysis.h"
#include "verify/report.h"

namespace obvid {
namespace {

using namespace pipeline_detail;

constexpr int kRows = 8;
constexpr double kLargest = 0.01;  // of the size
/// All trials end when so many steps on every point, and some more where there are few, were spent;
/// one of them when it took so many times its share of what was left.
constexpr double kTrialSteps = 5e3, kSpareTrials = 2e6;
constexpr double kMostShares = 2.0;
constexpr const char* kNotTried = "not tried to the end: the search has a limit of work";
constexpr double kLeastSpan = 10.0;  // where the file is printed coarsely: largest / smallest

std::vector<double> tolerances_for(const PointSeries& series) {
  const double printed = std::max(series.rounding.x, series.rounding.y);
  const double low = std::max(printed, coordinate_rounding(series));
  const double high = std::max(kLargest * bounding_diagonal(series.points), kLeastSpan * low);
  std::vector<double> out;
  for (int k = 0; k < kRows; ++k) {
    out.push_back(printable(low * std::pow(high / low, static_cast<double>(k) / (kRows - 1))));
  }
  return out;
}

TradeOffRow row_of(double tolerance, const Fit& made) {
  TradeOffRow row;
  row.tolerance = tolerance;
  row.formed = true;
  const auto broken = broken_promise(made);
  row.kept = !broken;
  row.proved = row.kept && made.certificate.proved;
  if (broken) {
    row.refusal = made.certificate.proved ? "the region is wider than asked" : broken->what;
  } else if (!row.proved) {
    row.refusal = made.certificate.reason;
  }
  row.vertices = made.report.vertices;
  row.vertices_lower_bound = made.report.vertices_lower_bound;
  row.inflections = made.report.inflections;
  row.pieces = made.contour.pieces.size();
  row.largest_move = made.report.largest_move;
  row.seconds = made.report.seconds;
  return row;
}

TradeOffRow row_of(double tolerance, const Error& refusal) {
  TradeOffRow row;
  row.tolerance = tolerance;
  row.refusal = refusal.what;
  return row;
}

/// A contour within smaller tolerances is one within larger ones; only the points force less then.
/// `option`: what it is formed with.
void carry_on(Fit& best, const std::string& option, double tolerance, Watch& watch,
              TradeOffRow& row) {
  for (double& own : best.contour.point_tolerance) own = std::max(own, tolerance);
  auto measured = measure(best.contour, best.report.tolerance, watch);
  if (!measured) return;
  settle_with(best.certificate, best.contour, *measured, watch);
  best.report.vertices_lower_bound = measured->vertices_lower_bound;
  const double seconds = row.seconds;
  row = row_of(tolerance, best);
  row.option = option;
  row.carried = true;
  row.seconds = seconds;
}

/// Nothing that `fit`, which has more time, might find otherwise.
Result<Fit> fit_in(double work, const PointSeries& series, const FitJob& job, double tolerance,
                   Watch& watch) {
  const Allowance allowance(watch, work);
  auto made = fit_within(series, job, tolerance, watch);
  if (watch.may_go_on() || watch.was_cancelled()) return made;
  return error(ErrorCode::kNoSpiral, kNotTried);
}

/// Whether all pieces are those of a drawing that stay as they are.
bool stays_as_drawn(const PointSeries& series, const FitJob& job) {
  const auto prepared = prepare(series, job);
  if (!prepared || prepared->kept.empty()) return false;
  const SplitSeries& split = prepared->split;
  return std::all_of(split.sections.begin(), split.sections.end(), [&](const Section& section) {
    return prepared->kept[split.point_at(section.first)].has_value();
  });
}

}  // namespace

std::optional<Error> not_kept(const TradeOff& t) {
  if (t.recommended) return std::nullopt;
  const bool formed =
      std::any_of(t.rows.begin(), t.rows.end(), [](const auto& row) { return row.formed; });
  return error(formed ? ErrorCode::kNotProved : ErrorCode::kNoSpiral,
               fmt::format("no tolerance up to 1 % of the size gives a {}", kept_contour(t)))
      .hint(t.rows.empty() ? "" : "at the largest: " + t.rows.back().refusal);
}

std::string trade_off_rule(const TradeOff& t) {
  return fmt::format(
      "of the {} the one farthest below the straight line from the first to the last, in a chart "
      "of "
      "vertices over the logarithm of the tolerance; beyond it the vertices fall more slowly than "
      "on average",
      t.promised ? "proved rows" : "rows that keep what the carrier promises");
}

std::optional<std::size_t> recommended_row(const std::vector<TradeOffRow>& rows) {
  std::vector<std::size_t> kept;
  int most = 0, fewest = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].kept) continue;
    most = kept.empty() ? rows[i].vertices : std::max(most, rows[i].vertices);
    fewest = kept.empty() ? rows[i].vertices : std::min(fewest, rows[i].vertices);
    kept.push_back(i);
  }
  if (kept.empty()) return std::nullopt;
  if (most == fewest) return kept.front();
  const TradeOffRow &first = rows[kept.front()], &last = rows[kept.back()];
  const double width = std::log(last.tolerance / first.tolerance);
  const double height = most - fewest;
  const double slope = (last.vertices - first.vertices) / height;
  constexpr double kSame = 1e-9;  // of the chart: the rounding of this sum
  double farthest = 0.0;
  std::size_t best = kept.front();
  for (const std::size_t i : kept) {
    const double x = width > 0.0 ? std::log(rows[i].tolerance / first.tolerance) / width : 0.0;
    const double below = slope * x - (rows[i].vertices - first.vertices) / height;
    if (below <= farthest + kSame) continue;
    farthest = below;
    best = i;
  }
  return best;
}

Result<TradeOff> trade_off(const PointSeries& series, const FitJob& job, const RunContext& run,
                           TradeOff* finished) {
  TradeOff out;
  out.name = series.name;
  out.units = series.units;
  if (stays_as_drawn(series, job)) {
    return error(ErrorCode::kBadOption,
                 "all pieces of the drawing stay as they are drawn: no tolerance changes them")
        .where("--suggest")
        .hint("--drawing points takes points of them instead");
  }
  const FitJob kept = with_closing(series, job);
  out.closed = kept.closing == Closing::kClosed;
  out.promised = promises_monotone(kept.carrier);
  Watch watch(run);
  const double most = kSpareTrials + kTrialSteps * static_cast<double>(series.points.size());
  std::optional<Fit> best;  // what larger tolerances allow as well
  std::string option;       // that it is formed with
  for (const double tolerance : tolerances_for(series)) {
    const auto row = static_cast<double>(out.rows.size());
    const ProgressShare told(watch, row / kRows, (row + 1.0) / kRows);
    const double share = kMostShares * (most - watch.spent()) / (kRows - row);
    Result<Fit> made = fit_in(share, series, kept, tolerance, watch);
    if (watch.was_cancelled()) break;  // whatever it made do with
    if (!made && category(made.error().code) != ErrorCategory::kNoContour) {
      return fail(made.error());
    }
    out.rows.push_back(made ? row_of(tolerance, *made) : row_of(tolerance, made.error()));
    TradeOffRow& now = out.rows.back();
    if (now.formed) now.option = noise_option(tolerance, out.closed, series);
    if (best && (!now.kept || now.vertices > best->report.vertices)) {
      carry_on(*best, option, tolerance, watch, now);
    } else if (now.kept) {
      best = std::move(*made);
      option = now.option;
    }
  }
  if (watch.was_cancelled()) {
    if (finished != nullptr) *finished = std::move(out);
    return fail(cancelled_error());
  }
  out.recommended = recommended_row(out.rows);
  return out;
}

}  // namespace obvid
