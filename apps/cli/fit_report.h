// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/pipeline/fit.h"

namespace obvid {

/// Files that were written, and what their formats could not hold.
struct Written {
  std::vector<std::string> files;
  std::vector<std::string> remarks;
};

/// Table per segment, figures about the whole, and the verdict as the last line.
[[nodiscard]] std::string fit_report_text(const std::string& name, const Fit& fit,
                                          const Written& written);

/// {"report", "certificate", "warnings", "written"}, the first two as in the contour file.
[[nodiscard]] std::string fit_report_json(const Fit& fit, const Written& written);

/// The last line: what is proved, or why not.
/// Whether a contour is what its carrier promises: proved, or without gaps through its points.
[[nodiscard]] bool keeps_promise(Carrier carrier, const Certificate& certificate);

[[nodiscard]] std::string verdict_line(Carrier carrier, const Certificate& certificate);

/// Lines about joint gaps, vertices and the like that `fit` and `verify` share.
class Facts;
void add_gaps(Facts& facts, const Certificate& certificate, Carrier carrier);

}  // namespace obvid
