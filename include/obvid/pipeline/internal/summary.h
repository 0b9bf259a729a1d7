// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/error.h"
#include "obvid/pipeline/alignment_job.h"
#include "obvid/pipeline/analyse.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/region_table.h"

namespace obvid {

// One line about one of several inputs.

/// A figure of a summary: as a person reads it, and as programs do.
struct SummaryCell {
  const char* name;
  std::string text;   ///< "12 points"; empty: not for the eye
  std::string value;  ///< "12"; empty: unknown
};

struct Summary {
  std::vector<SummaryCell> cells;
  std::string verdict;         ///< "proved", ...
  std::optional<Error> error;  ///< what kept it from being done, or the promise that is not kept
  std::vector<std::string> warnings;
};

/// "E401"
[[nodiscard]] std::string code_text(ErrorCode code);
[[nodiscard]] std::string code_text(const Error& error);

/// Names of the columns, and the line of one input below them.
[[nodiscard]] std::string summary_csv_head(const std::vector<SummaryCell>& cells);
[[nodiscard]] std::string summary_csv(const std::string& name, const Summary& summary);
/// One object in one line; `curve` counts from 0.
[[nodiscard]] std::string summary_json(const std::string& input,
                                       const std::optional<std::size_t>& curve,
                                       const Summary& summary);

/// Figures of a formed contour, of what points say, and of a drawing.
[[nodiscard]] std::vector<SummaryCell> summary_cells(const Fit& fit);
[[nodiscard]] std::vector<SummaryCell> summary_cells(const PointSeries& series,
                                                     const Analysis& analysis);
[[nodiscard]] std::vector<SummaryCell> summary_cells(const AnalysedDrawing& drawing);
[[nodiscard]] std::vector<SummaryCell> summary_cells(const Contour& contour,
                                                     const Certificate& certificate);
[[nodiscard]] std::vector<SummaryCell> summary_cells(const AlignmentReport& made);
[[nodiscard]] std::vector<SummaryCell> summary_cells(const PointSeries& series,
                                                     const RegionTable& region);

}  // namespace obvid
