// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/refusal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "obvid/core/internal/figures.h"
#include "obvid/geom/internal/angle.h"

namespace obvid {

const char* what_option_does(const Fit& fit) {
  const bool any = fit.report.vertices > 0 || fit.report.inflections > 0;
  return any ? "allows them" : "forms it";
}

std::string counts_of_fit(const Fit& fit) {
  const auto count = [](int n) { return static_cast<std::size_t>(std::max(n, 0)); };
  return counted(count(fit.report.vertices), "vertex", "vertices") + " and " +
         counted(count(fit.report.inflections), "inflection", "inflections");
}

namespace {

/// Series whose ends meet within the tolerance are closed unless told otherwise.
std::string open_option(double tolerance, bool closed, const PointSeries& series) {
  const std::vector<Vec2>& points = series.points;
  const bool returns = points.size() > 2 && norm(points.back() - points.front()) <= 2.0 * tolerance;
  return returns && !closed ? " --open" : "";
}

/// Where one run meets the next: ", with vertices at point 5 and at points 6-7"; empty where no two
/// do, and where runs are no more than what was aimed at.
std::string places_of_vertices(const Contour& contour) {
  if (!promises_monotone(contour.carrier)) return "";
  constexpr std::size_t kMostPlaces = 4;
  const std::size_t n = contour.joints.size();
  std::vector<std::string> places;
  for (std::size_t r = 1; r < contour.runs.size(); ++r) {
    const std::size_t joint = contour.runs[r].first_piece;
    std::size_t before = joint, after = joint;
    while (before > 0 && !contour.joints[before].source) --before;
    while (after + 1 < n && !contour.joints[after].source) ++after;
    const auto from = contour.joints[before].source, to = contour.joints[after].source;
    if (!from || !to) continue;
    places.push_back(*from == *to ? fmt::format("at point {}", *from + 1)
                                  : fmt::format("at points {}-{}", *from + 1, *to + 1));
  }
  if (places.empty()) return "";
  std::string text = places.size() == 1 ? ", with its vertex " : ", with vertices ";
  for (std::size_t k = 0; k < std::min(places.size(), kMostPlaces); ++k) {
    const bool last = k + 1 == places.size();
    text += (k == 0 ? "" : last ? " and " : ", ") + places[k];
  }
  return text + and_more(places.size(), kMostPlaces);
}

Error with_tolerance(Error error, const std::optional<WhyNot>& why, const PointSeries& series) {
  const std::string units = series.units.text();
  if (!error.hint.empty()) error.hint += "; ";
  if (!why) {
    error.hint += fmt::format(
        "none was found either within a tolerance of {} {} for every point, a tenth of the size",
        significant(largest_tolerance_tried(series), kAdvisedDigits), units);
  } else if (why->found && why->next_to_nothing) {
    error.hint += "no point is in the way: with " + counts_of_fit(why->fit) + " there is one" +
                  places_of_vertices(why->fit.contour) + ": " + advised_option(*why, series) + " " +
                  what_option_does(why->fit);
  } else if (why->found) {
    error.hint +=
        "within " + room_within(*why, units) + " there is one: " + advised_option(*why, series);
  } else {
    error.hint += "the search for a larger tolerance that does ended at its limit";
    if (why->refused > 0.0) {
      error.hint += fmt::format(": within {} {} none was found",
                                significant(why->refused, kAdvisedDigits), units);
    } else {
      error.hint += " before one was tried to its end; --suggest tries eight";
    }
  }
  return error;
}

/// " (radius 20 to 30 mm)", " (radius at least 20 mm)" up to a line; nothing where the range holds
/// one inside.
std::string radii_text(const FeasibleRange& range, const std::string& units) {
  if (range.least == 0.0 && range.greatest > 0.0) {
    return fmt::format(" (radius at least {} {})", significant(1.0 / range.greatest, 5), units);
  }
  if (range.greatest == 0.0 && range.least < 0.0) {
    return fmt::format(" (radius at most {} {})", significant(1.0 / range.least, 5), units);
  }
  if (!(range.least * range.greatest > 0.0)) return "";
  const double one = 1.0 / range.least, other = 1.0 / range.greatest;
  const bool first = std::abs(one) < std::abs(other);
  return fmt::format(" (radius {} to {} {})", significant(first ? one : other, 5),
                     significant(first ? other : one, 5), units);
}

/// The shortest number of a unit that means this value: ends of a range are short decimal
/// fractions.
std::string typed_number(double value, double unit) {
  constexpr int kFew = 6, kAll = 17;  // digits
  for (int digits = kFew; digits < kAll; ++digits) {
    std::string text = fmt::format("{:.{}g}", value / unit, digits);
    if (std::strtod(text.c_str(), nullptr) * unit == value) return text;
  }
  return fmt::format("{:.{}g}", value / unit, kAll);
}

/// "heading between 41.2 and 52.9 deg at point 3"; where only the two were tried: "heading of 41.2
/// or 52.9 deg at point 3".
std::string feasible_text(const FeasibleRange& range, const std::string& units) {
  const bool heading = range.datum == FeasibleRange::Datum::kHeading;
  const double unit = heading ? kOneDegree : 1.0;
  const std::string least = typed_number(range.least, unit);
  const std::string kind = heading ? "heading" : "curvature";
  const std::string of = heading ? "deg" : fmt::format("1/{}", units);
  if (range.least == range.greatest) {
    return fmt::format("{} of {} {} at point {}", kind, least, of, range.point + 1);
  }
  return fmt::format("{} {} {} {} {} {} at point {}{}", kind, range.exact ? "between" : "of", least,
                     range.exact ? "and" : "or", typed_number(range.greatest, unit), of,
                     range.point + 1, heading ? "" : radii_text(range, units));
}

Error with_range(Error error, const std::optional<FeasibleRange>& range, const std::string& units) {
  if (!range) return error;
  if (!error.hint.empty()) error.hint += "; ";
  error.hint += "with a " + feasible_text(*range, units) + " there is one";
  return error;
}

}  // namespace

std::string room_within(const WhyNot& why, const std::string& units) {
  if (why.rounding_does) return "the rounding of the file's digits";
  return fmt::format("a tolerance of {} {}", significant(why.advised, kAdvisedDigits), units);
}

std::string advised_option(const WhyNot& why, const PointSeries& series) {
  const bool closed = why.fit.contour.closed;
  return why.rounding_does ? rounding_option(closed, series)
                           : noise_option(why.advised, closed, series);
}

std::string noise_option(double tolerance, bool closed, const PointSeries& series) {
  constexpr int kDigits = 3;  // of tolerances that the library names
  const bool narrower = std::any_of(
      series.fixed.begin(), series.fixed.end(),
      [&](const FixedData& data) { return data.tolerance && *data.tolerance < tolerance; });
  return "--noise " + significant(tolerance, kDigits) + open_option(tolerance, closed, series) +
         (narrower ? " and no smaller tolerance of a point" : "");
}

std::string rounding_option(bool closed, const PointSeries& series) {
  return "--noise rounding" +
         open_option(std::max(series.rounding.x, series.rounding.y), closed, series);
}

Result<Refusal> explain_refusal(const PointSeries& series, const FitJob& job, const Error& refusal,
                                const RunContext& run) {
  bool cancelled = false;  // once said, it holds for both searches
  RunContext once = run;
  once.cancelled = [&] {
    cancelled = cancelled || (run.cancelled && run.cancelled());
    return cancelled;
  };
  Refusal out{refusal, {}, {}};
  // tolerances of points do not help a carrier that cannot keep what was given
  // and where a long series has given data in the way, these are it: the search would take minutes
  constexpr std::size_t kTooLongToMove = 1000;
  const bool by_points =
      refusal.code != ErrorCode::kCarrierCannotKeep &&
      !(refusal.code == ErrorCode::kFixedDataContradict && series.points.size() >= kTooLongToMove);
  if (by_points) out.why = why_not(series, job, refusal, once);
  out.range = feasible_range(series, job, refusal, once);
  if (cancelled) return fail(cancelled_error());
  if (by_points) out.error = with_tolerance(refusal, out.why, series);
  out.error = with_range(std::move(out.error), out.range, series.units.text());
  return out;
}

}  // namespace obvid
