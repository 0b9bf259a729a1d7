// SPDX-License-Identifier: Apache-2.0
#include "alignment/heights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "obvid/alignment/internal/borne_grades.h"
#include "obvid/core/files.h"
#include "obvid/core/internal/figures.h"
#include "obvid/io/read_points.h"
#include "obvid/series/internal/scatter.h"

namespace obvid {

Result<StationHeights> parse_heights(std::string_view text, std::string_view name) {
  PointListOptions list;
  list.two = TwoPoints::kDo;
  list.columns = {0, 1};
  auto series = parse_points(text, name, list);
  OBVID_TRY(series);
  StationHeights out;
  out.points = std::move(series->points);
  out.rounding = series->rounding.y;
  out.warnings = std::move(series->warnings);
  for (std::size_t i = 1; i < out.points.size(); ++i) {
    if (out.points[i].x > out.points[i - 1].x) continue;
    return error(ErrorCode::kChordReversal, "stations of a profile must ascend")
        .where(std::string(name))
        .hint("give station and height in the first two columns, sorted by station")
        .point(static_cast<std::ptrdiff_t>(i))
        .value(out.points[i].x);
  }
  return out;
}

Result<StationHeights> read_heights(const std::string& path) {
  const auto text = read_file(path);
  OBVID_TRY(text);
  return parse_heights(*text, path);
}

ImportOptions with_heights(ImportOptions import) {
  import.list.heights = true;
  import.list.hint_of_two = "an alignment needs three points";
  return import;
}

namespace pipeline_detail {
namespace {

/// Heights of the points at the stations of their feet, in their order.
Result<ProfileReport> heights_of_points(const PointSeries& series, const Alignment& alignment) {
  ProfileReport out;
  out.of_points = true;
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    if (i < series.fixed.size() && series.fixed[i].height) {
      out.heights.push_back({alignment.deviations[i].station, *series.fixed[i].height});
      continue;
    }
    return error(ErrorCode::kBadOption, "a point has no height, but others have")
        .where("z")
        .hint("fill the column, leave it out, or give heights by --profile")
        .point(static_cast<std::ptrdiff_t>(i));
  }
  return out;
}

std::string scatter_text(const Scatter& seen, const char* what, const Units& units) {
  return fmt::format(
      "{} may be {} {} off, {} times their scatter of {} about cubics through four neighbours each "
      "(median of {} points)",
      what, significant_above(seen.bound, 4), units.text(), significant(seen.bound_factor, 3),
      significant(seen.deviation, 4), seen.places);
}

/// The tolerance of the points is that of their heights, but for digits that are coarser.
double tolerance_as_points(const std::vector<Vec2>& heights, double noise, double rounding,
                           const Units& units, std::vector<std::string>& remarks) {
  if (rounding > noise) {
    remarks.push_back(
        fmt::format("heights within {} {}, half a unit of their last digit: more than --noise",
                    significant_above(rounding, 3), units.text()));
    return rounding;
  }
  std::string said =
      fmt::format("heights within {} {} as --noise", tolerance_text(noise), units.text());
  if (const auto seen = scatter_of(heights); seen && seen->bound > noise) {
    said += fmt::format("; their own scatter of {} may reach {} (--profile-noise auto)",
                        significant(seen->deviation, 3), significant_above(seen->bound, 3));
  }
  remarks.push_back(std::move(said));
  return noise;
}

/// Where no tolerance is given at all; 0: none can be told.
double tolerance_of_scatter(const std::vector<Vec2>& heights, double rounding, const Units& units,
                            std::vector<std::string>& remarks) {
  const auto seen = scatter_of(heights);
  if (seen && seen->bound > rounding) {
    remarks.push_back(
        fmt::format("without --profile-noise: {}", scatter_text(*seen, "heights", units)));
    return seen->bound;
  }
  if (rounding > 0.0) {
    remarks.push_back(fmt::format(
        "heights within {} {}, half a unit of their last digit: {}; --profile-noise says another",
        significant_above(rounding, 3), units.text(),
        seen ? "they scatter by no more" : seen.error().what));
  }
  return rounding;
}

/// How far the profile may pass heights; 0: nothing says it.
Result<double> height_tolerance(const std::vector<Vec2>& heights, double rounding, bool of_points,
                                const Units& units, const AlignmentJob& job,
                                std::vector<std::string>& remarks) {
  if (job.profile_noise_from_scatter) {
    return estimated_noise(heights, units, "--profile-noise auto", remarks);
  }
  if (job.profile_noise_of_digits) return rounding;
  if (job.profile_noise) {
    if (*job.profile_noise > 0.0 && std::isfinite(*job.profile_noise)) return *job.profile_noise;
    return error(ErrorCode::kBadOption, "the tolerance of heights must be a positive length")
        .where("--profile-noise")
        .hint("say how far it may pass the heights")
        .value(*job.profile_noise);
  }
  if (of_points && job.noise) {
    return tolerance_as_points(heights, *job.noise, rounding, units, remarks);
  }
  if (of_points && job.noise_of_digits) return rounding;
  return tolerance_of_scatter(heights, rounding, units, remarks);
}

/// Whether the last height of a loop is that of the first point again; an error where it is another
/// one.
Result<bool> repeats_first(const std::vector<Vec2>& heights, bool of_points, double lap) {
  constexpr double kSamePlace = 1e-9;  // of a lap
  const Vec2 first = heights.front(), last = heights.back();
  const double apart = std::abs(last.x - first.x);
  const bool same = heights.size() > 1 && (of_points ? apart <= kSamePlace * lap
                                                     : std::abs(apart - lap) <= kSamePlace * lap);
  if (!same || last.y == first.y) return same;
  return error(ErrorCode::kBadOption, "the first and the last height of the loop are of one place")
      .where(of_points ? "z" : "--profile")
      .hint("give one height there, or leave the loop open (--open)")
      .point(static_cast<std::ptrdiff_t>(heights.size()) - 1)
      .value(last.y - first.y);
}

/// Heights of one lap that do not come back to where they began: behind the one that was taken last
/// they rise far more steeply than anywhere else. Ascending; `last` is the number of that one,
/// `tolerance` of each.
Result<void> close_around(const std::vector<Vec2>& heights, std::size_t last, double lap,
                          double tolerance, bool of_points) {
  constexpr double kSteeper = 3.0, kMostOff = 4.0;  // of the steepest elsewhere; of a tolerance
  const std::size_t n = heights.size();
  const auto step_behind = [&](std::size_t i) {
    const Vec2 step = heights[(i + 1) % n] - heights[i];
    return i + 1 < n ? step : step + Vec2{lap, 0.0};
  };
  const auto steepness = [&](Vec2 step) {
    return std::max(0.0, std::abs(step.y) - 2.0 * tolerance) / step.x;
  };
  double steepest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (i != last) steepest = std::max(steepest, steepness(step_behind(i)));
  }
  const Vec2 seam = step_behind(last);
  const double off = std::abs(seam.y);
  if (!(steepness(seam) > kSteeper * steepest && off > kMostOff * tolerance)) return {};
  return error(ErrorCode::kToleranceNotReached, "the heights of the loop do not close")
      .where(of_points ? "z" : "--profile")
      .hint(fmt::format("they differ by {} over {} at the seam, more steeply than anywhere else: "
                        "adjust them, or leave the loop open (--open)",
                        significant(off, 4), significant(seam.x, 4)))
      .value(off);
}

/// Tells what of an alignment no height speaks of; an error where heights lie beside it. Ascending.
Result<void> cover(const std::vector<Vec2>& heights, double from, double length, bool closed,
                   const Units& units, std::vector<std::string>& remarks) {
  constexpr double kBeside = 1e-6, kLongGap = 0.05;  // of the length
  constexpr double kFarApart = 5.0;                  // of the mean distance of heights
  const double slack = kBeside * length, to = from + length;
  const double low = heights.front().x, high = heights.back().x;
  if (low > to + slack || high < from - slack ||
      (closed && (low < from - slack || high > to + slack))) {
    return error(ErrorCode::kBadOption, "stations of heights lie beside the alignment")
        .where("--profile")
        .hint(fmt::format("heights are at {} to {} {}, the alignment at {} to {}",
                          significant(low, 8), significant(high, 8), units.text(),
                          significant(from, 8), significant(to, 8)))
        .value(low);
  }
  std::vector<std::pair<double, double>> gaps;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    gaps.emplace_back(heights[i - 1].x, heights[i].x);
  }
  if (closed) {
    gaps.emplace_back(high, low + length);
  } else {
    gaps.emplace_back(from, low);
    gaps.emplace_back(high, to);
  }
  const double mean = (high - low) / static_cast<double>(heights.size() - 1);
  for (const auto& [a, b] : gaps) {
    if (!(b - a > std::max(kLongGap * length, kFarApart * mean))) continue;
    remarks.push_back(fmt::format(
        "no height between stations {} and {} {}: no measurement bears the profile there",
        significant(a, 7), significant(b, 7), units.text()));
  }
  return {};
}

constexpr int kGradeDigits = 5;  // tell grades apart that are not borne

/// Warns of a hump between heights that do not show it.
void tell_humps(const std::vector<UnborneGrade>& humps, double tolerance, bool has_least_length,
                const Units& units, std::vector<std::string>& remarks) {
  if (humps.empty()) return;
  const auto off = [](const UnborneGrade& g) {
    return std::max(g.borne.low - g.grade, g.grade - g.borne.high);
  };
  const UnborneGrade& worst = *std::max_element(
      humps.begin(), humps.end(),
      [&](const UnborneGrade& a, const UnborneGrade& b) { return off(a) < off(b); });
  remarks.push_back(fmt::format(
      "the profile has a grade of {} % at station {} {}, where the heights bear {} to {} % ({} in "
      "all): within {} {} none without was found{}; allow more (--profile-noise){}, or give "
      "heights "
      "nearer to each other there",
      significant(100.0 * worst.grade, kGradeDigits), significant(worst.station, 7), units.text(),
      significant(100.0 * worst.borne.low, kGradeDigits),
      significant(100.0 * worst.borne.high, kGradeDigits),
      counted(humps.size(), "such joint", "such joints"), tolerance_text(tolerance), units.text(),
      has_least_length ? " with elements as long as that" : "",
      has_least_length ? ", or shorter elements (--min-vertical-length)" : ""));
}

/// The profile that is drawn, at the stations of the alignment. Around a loop it would have to
/// begin elsewhere.
std::optional<ProfileReport> profile_of_file(const PointSeries& series, const Alignment& alignment,
                                             const AlignmentJob& job,
                                             std::vector<std::string>& remarks) {
  if (alignment.closed) {
    remarks.emplace_back(
        "the profile of the file is left out around a loop: --profile takes its heights");
    return std::nullopt;
  }
  ProfileReport out;
  out.of_file = true;
  out.profile = *job.road.profile;
  if (job.first_station && job.road.station) {
    const double moved = *job.first_station - *job.road.station;
    for (ProfileElement& e : out.profile.elements) e.station += moved;
    out.profile.end_station += moved;
  }
  const double longer = alignment.length - job.road.length;
  remarks.push_back(fmt::format(
      "the profile is that of the file, as it is, over the station: the alignment is {} {} {} than "
      "what is drawn",
      significant(std::abs(longer), 3), series.units.text(), longer < 0.0 ? "shorter" : "longer"));
  if (job.profile_noise || job.profile_noise_from_scatter ||
      job.profile.curves != out.profile.curves) {
    remarks.emplace_back(
        "options of profiles have nothing to do: that of the file stays as it is (--profile with "
        "heights makes another)");
  }
  return out;
}

/// The profile of the heights that there are.
Result<std::optional<ProfileReport>> profile_of_heights(const PointSeries& series,
                                                        const Alignment& alignment,
                                                        const AlignmentJob& job,
                                                        std::vector<std::string>& remarks,
                                                        const RunContext& run) {
  const bool any = std::any_of(series.fixed.begin(), series.fixed.end(),
                               [](const FixedData& f) { return f.height.has_value(); });
  if (!job.heights && !any) {
    if (job.road.profile) return profile_of_file(series, alignment, job, remarks);
    if (job.profile_noise || job.profile_noise_from_scatter) {
      remarks.emplace_back("--profile-noise has nothing to do: the points have no heights");
    }
    return std::optional<ProfileReport>();
  }
  ProfileReport out;
  double rounding = series.height_rounding;
  if (job.heights) {
    out.heights = job.heights->points;
    rounding = job.heights->rounding;
  } else {
    auto own = heights_of_points(series, alignment);
    OBVID_TRY(own);
    out = std::move(*own);
    // drawings fill a column that nobody measured
    if (std::all_of(out.heights.begin(), out.heights.end(),
                    [](const Vec2& at) { return at.y == 0.0; })) {
      remarks.emplace_back("all heights are 0: no profile (--profile makes one of them, too)");
      return std::optional<ProfileReport>();
    }
  }
  ProfileOptions options = job.profile;
  bool again = false;
  if (alignment.closed) {
    options.lap = alignment.length;
    options.begin = alignment.elements.front().station;
    const auto repeats = repeats_first(out.heights, out.of_points, options.lap);
    OBVID_TRY(repeats);
    again = *repeats;
  }
  // feet of neighbours may lie the other way round where points scatter along
  std::vector<std::size_t> order(out.heights.size() - (again ? 1 : 0));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return out.heights[a].x < out.heights[b].x;
  });
  std::vector<Vec2> ascending;
  for (const std::size_t i : order) ascending.push_back(out.heights[i]);
  const auto tolerance =
      height_tolerance(ascending, rounding, out.of_points, series.units, job, remarks);
  OBVID_TRY(tolerance);
  if (*tolerance == 0.0 && out.of_points) {
    remarks.emplace_back(
        "the points have heights, but nothing says how exact they are (the digits of receivers "
        "and maps do not): no profile (--profile-noise with a length or auto makes one)");
    return std::optional<ProfileReport>();
  }
  if (*tolerance == 0.0) {
    return error(ErrorCode::kBadOption, "a profile needs a tolerance")
        .where("--profile-noise")
        .hint("say how far it may pass the heights");
  }
  out.tolerance = *tolerance;
  if (ascending.size() > 1) {
    // those of the points before the first one lie before its station
    const double from = out.of_points ? alignment.elements.front().station
                                      : job.first_station.value_or(job.road.station.value_or(0.0));
    OBVID_TRY(cover(ascending, from, alignment.length, alignment.closed, series.units, remarks));
    if (alignment.closed) {
      const auto last = std::find(order.begin(), order.end(), order.size() - 1) - order.begin();
      OBVID_TRY(close_around(ascending, static_cast<std::size_t>(last), alignment.length,
                             *tolerance, out.of_points));
    }
  }
  const std::vector<double> of_each(ascending.size(), *tolerance);
  auto profile = fit_profile(ascending, of_each, options, run);
  OBVID_TRY(profile);
  tell_humps(unborne_grades(*profile, BorneGrades(ascending, of_each, options.lap)), *tolerance,
             options.least_length > 0.0, series.units, remarks);
  std::vector<double> offsets(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) offsets[order[k]] = profile->offsets[k];
  if (again) offsets.push_back(offsets.front());
  profile->offsets = std::move(offsets);
  out.profile = std::move(*profile);
  return std::optional(std::move(out));
}

}  // namespace

Result<double> estimated_noise(const std::vector<Vec2>& points, const Units& units,
                               const char* option, std::vector<std::string>& remarks) {
  auto seen = scatter_of(points);
  if (!seen) {
    seen.error().where = option;
    return fail(seen.error());
  }
  remarks.push_back(fmt::format("{}: {}", option, scatter_text(*seen, "points", units)));
  return seen->bound;
}

Result<std::optional<ProfileReport>> profile_report(const PointSeries& series,
                                                    const Alignment& alignment,
                                                    const AlignmentJob& job,
                                                    std::vector<std::string>& remarks,
                                                    const RunContext& run) {
  auto made = profile_of_heights(series, alignment, job, remarks, run);
  // heights of receivers and maps, of which nothing was said, refuse no alignment
  const bool said = job.heights || job.profile_noise || job.profile_noise_from_scatter ||
                    job.profile_noise_of_digits || series.height_rounding > 0.0;
  if (made || said || made.error().code == ErrorCode::kCancelled) return made;
  remarks.push_back(
      fmt::format("no profile of the heights: {} (--profile-noise with a length or "
                  "auto may make one)",
                  made.error().what));
  return std::optional<ProfileReport>();
}

}  // namespace pipeline_detail
}  // namespace obvid
