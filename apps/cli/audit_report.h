// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "options.h"

namespace obvid {

/// `analyse` on a drawing: what a curvature comb would show of each curve.
int audit_drawing(const AnalyseOptions& options);

}  // namespace obvid
