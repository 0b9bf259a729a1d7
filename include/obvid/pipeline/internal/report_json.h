// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/error.h"
#include "obvid/core/internal/data_table.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/exchange/drawing.h"
#include "obvid/pipeline/audit.h"
#include "obvid/pipeline/compare.h"
#include "obvid/pipeline/feasible_range.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/region_table.h"
#include "obvid/pipeline/trade_off.h"
#include "obvid/pipeline/why_not.h"
#include "obvid/series/analysis.h"

namespace obvid {

// What each job found, as one JSON object and a line feed: the same for every front end
// (docs/formats.md). Figures that are not known are null. Under watch, a text that was cancelled is
// worth nothing.

/// Files that were written, and what their formats could not hold.
struct Written {
  std::vector<std::string> files;
  std::vector<std::string> remarks;
};

/// {"report", "certificate", "warnings", "written", ...}, the first two as in the contour file.
[[nodiscard]] std::string fit_report_json(const Fit& fit, const Written& written,
                                          Watch* watch = nullptr);

/// Why there is no contour, and what would do. `error` as it is told to the user.
[[nodiscard]] std::string refusal_json(const Error& error, const PointSeries& series,
                                       const std::optional<WhyNot>& why,
                                       const std::optional<FeasibleRange>& range,
                                       const std::vector<std::string>& written);

/// All carriers side by side.
[[nodiscard]] std::string comparison_json(const PointSeries& series, const Comparison& compared);

/// Tangents, ranges of curvature, heights and widths of the region. Error: E103.
[[nodiscard]] Result<std::string> region_json(const PointSeries& series, const RegionTable& region,
                                              const RunContext& run);

/// The new proof of a stored contour, and what of its claims does not hold.
[[nodiscard]] std::string verification_json(const StoredContour& stored, const Verification& found);

/// How many vertices which tolerance would need.
[[nodiscard]] std::string trade_off_json(const TradeOff& t,
                                         const std::vector<std::string>& warnings,
                                         const std::vector<std::string>& written);

/// What the points of a series alone say.
[[nodiscard]] std::string series_report_json(const PointSeries& series, const Analysis& analysis,
                                             Watch* watch = nullptr);

/// The series itself: its points and what is given at them.
[[nodiscard]] std::string series_json(const PointSeries& series);

/// That of a code as it is typed: "E401", "e401", "401". Error: E201 where there is none, with the
/// one that is like it.
[[nodiscard]] Result<ErrorText> error_text_of(std::string_view typed);
/// What an error code means and what helps, and all of them as an array.
[[nodiscard]] std::string error_text_json(const ErrorText& text);
[[nodiscard]] std::string error_texts_json();

/// What a curvature comb would show of each curve of a drawing. `points`: what `series_report_json`
/// says of the series that was asked for, if one was.
/// Every curve and series of a drawing in a row with its figures, full digits, lengths in its
/// units; curvatures and counts of curves alone.
[[nodiscard]] DataTable drawing_rows(const Drawing& drawing, const std::vector<CurveAudit>& audits);
/// Every point of a series in a row with its adjacent circle and the chord behind it.
[[nodiscard]] DataTable series_rows(const PointSeries& series, const Analysis& analysis);
[[nodiscard]] std::string audit_json(const Drawing& drawing, const std::vector<CurveAudit>& audits,
                                     const std::string& points);

}  // namespace obvid
