// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/picture/internal/trade_off_svg.h"
#include "obvid/pipeline/fit.h"

namespace obvid {

/// Runs the job with eight tolerances in equal ratios, from the printed rounding of the file (that
/// of doubles when there is none) to 1 % of the size. They take the place of the job's noise;
/// larger ones of single points stay, and a series that is open without them stays open.
/// Recommended is, among the rows that keep what the carrier promises (a proof where it promises to
/// be monotone), the one farthest below the straight line from the first
/// of them to the last in a chart of vertices over the logarithm of the tolerance, both scaled to
/// the same length; the smaller tolerance where two are equal. Beyond it the vertices fall more
/// slowly than on the average.
/// When the work is cancelled (E103), `finished` takes the rows that were done by then, with
/// nothing recommended. A row that takes more than twice its share of the work that is left is not
/// formed. Errors: those of `fit` that do not depend on the tolerance (exit codes 2 and 3); E203
/// for a drawing whose pieces all stay as they are.
[[nodiscard]] Result<TradeOff> trade_off(const PointSeries& series, const FitJob& job,
                                         const RunContext& run = {}, TradeOff* finished = nullptr);

/// Why no row is recommended: E501 where contours were formed that do not keep what the carrier
/// promises, E401 where none was. Whoever shows the table ends with it.
[[nodiscard]] std::optional<Error> not_kept(const TradeOff& t);

/// How the recommended row is found, in words for the user.
[[nodiscard]] std::string trade_off_rule(const TradeOff& t);

/// The row that `trade_off` recommends.
[[nodiscard]] std::optional<std::size_t> recommended_row(const std::vector<TradeOffRow>& rows);

}  // namespace obvid
