// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "columns.h"
#include "obvid/obvid.h"

namespace obvid::batch {

[[nodiscard]] obvid_figures unknown_figures();

/// Columns that only this job has, between those of all and `seconds`.
[[nodiscard]] std::vector<Column> report_columns(const std::string& job);

/// Fills in what a report says and returns the values of the columns above; unknown where `report`
/// is NULL.
[[nodiscard]] std::vector<double> take_report(const std::string& job, const char* report,
                                              obvid_figures& figures);

}  // namespace obvid::batch
