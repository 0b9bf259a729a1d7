// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/internal/promise.h"
#include "obvid/pipeline/internal/report_json.h"

namespace obvid {

/// Table per segment, figures about the whole, and the verdict as the last line.
[[nodiscard]] std::string fit_report_text(const std::string& name, const Fit& fit,
                                          const Written& written);

/// The table per segment with all digits: lengths in the unit of the input, curvatures in its
/// inverse; empty where they are unknown.
[[nodiscard]] std::string fit_report_csv(const Fit& fit);

/// Lines about joint gaps, vertices and the like that `fit` and `verify` share.
class Facts;
void add_gaps(Facts& facts, const Certificate& certificate, Carrier carrier);

}  // namespace obvid
