// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fit/prepare.h"

namespace obvid::pipeline_detail {

/// Sets `placed` and `whole`: sections between corners and ends whose points all lie within their
/// reaches of one line, or else of one arc, and the places where such neighbours meet, as far as
/// these are within the tolerances of the corners, or between the points beside
/// (docs/methods/fairing.md, "Whole sections").
void lay_whole_sections(Prepared& series);

}  // namespace obvid::pipeline_detail
