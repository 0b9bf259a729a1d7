// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/error.h"
#include "options.h"
#include "terminal.h"

namespace obvid {

/// Tells that the asked contour does not exist, and what is missing: the error line with the
/// tolerance within which it would, the points that would have to move, and the picture of that
/// contour beside every picture that was asked for. Returns the exit code.
int tell_refusal(const FitOptions& options, const PointSeries& series, const Error& refusal,
                 ProgressBar& bar);

}  // namespace obvid
