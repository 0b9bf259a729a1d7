// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/pipeline/analyse.h"
#include "obvid/pipeline/file_formats.h"
#include "options.h"

namespace obvid {

/// The drawing that `options` name, read and analysed.
[[nodiscard]] Result<AnalysedDrawing> analysed_drawing(const AnalyseOptions& options);

/// Of a file that `analyse` writes. Error: E202.
[[nodiscard]] Result<FileFormat> analysis_format_of(const std::string& path);

/// `analyse` on a drawing: what a curvature comb would show of each curve.
int audit_drawing(const AnalyseOptions& options);

}  // namespace obvid
