// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/core/run_context.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/internal/titled_contour.h"

namespace obvid {

/// The curve of a drawing that `options` choose, as it is drawn, with what can be proved about it.
/// Errors: those of `chosen_curve`; E310 where that is a series of points and its edges were not
/// asked for; E103. `where` stands in errors and remarks.
[[nodiscard]] Result<TitledContour> drawn_contour(Drawing drawing, const ImportOptions& options,
                                                  const std::string& where,
                                                  const RunContext& run = {});

}  // namespace obvid
