// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/pipeline/analyse.h"
#include "options.h"

namespace obvid {

/// The drawing that `options` name, read and analysed.
[[nodiscard]] Result<AnalysedDrawing> analysed_drawing(const AnalyseOptions& options);

/// `analyse` on a drawing: what a curvature comb would show of each curve.
int audit_drawing(const AnalyseOptions& options);

}  // namespace obvid
