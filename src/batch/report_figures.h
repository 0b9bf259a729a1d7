// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "columns.h"
#include "job_kinds.h"
#include "obvid/obvid.h"

namespace obvid::batch {

[[nodiscard]] obvid_figures unknown_figures();

/// Columns that only this job has, between those of all and `seconds`.
[[nodiscard]] std::vector<Column> report_columns(const JobKind& kind);

/// Fills in what a report says and returns the values of the columns above; unknown where `report`
/// is NULL.
[[nodiscard]] std::vector<double> take_report(const JobKind& kind, const char* report,
                                              obvid_figures& figures);

/// The warnings of a report that is at hand in any case; none where `report` is NULL.
[[nodiscard]] std::vector<std::string> reported_warnings(const JobKind& kind, const char* report);

}  // namespace obvid::batch
