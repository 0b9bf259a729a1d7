// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <string>
#include <string_view>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/report/stored_contour.h"

namespace obvid {

/// The contour file of docs/formats.md. Every number reads back to the same double. Under watch, a
/// text that was cancelled is worth nothing.
[[nodiscard]] std::string contour_to_json(const StoredContour& stored, Watch* watch = nullptr);

/// The values of its fields "report" and "certificate", as they stand in the file.
[[nodiscard]] std::string report_to_json(const FitReport& report, Watch* watch = nullptr);
[[nodiscard]] std::string certificate_to_json(const Certificate& certificate,
                                              Watch* watch = nullptr);

/// Reads a contour file. `name` stands in errors. Errors: E308 with line and column or the path of
/// the field, E309 for numbers beyond what `fit` forms (`out_of_range`), E310 for a version or
/// piece type that this program does not know, E103. Never throws on any input.
[[nodiscard]] Result<StoredContour> contour_from_json(std::string_view text, std::string_view name,
                                                      Watch* watch = nullptr);

}  // namespace obvid
