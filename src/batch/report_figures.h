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

struct TakenReport {
  std::vector<double> values;  ///< of the columns above
  std::vector<std::string> warnings{};
};

/// Fills in what a report says and returns the rest; values are unknown where `report` is NULL.
[[nodiscard]] TakenReport take_report(const JobKind& kind, const char* report,
                                      obvid_figures& figures);

}  // namespace obvid::batch
