// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "part.h"

namespace obvid::toolpath {

/// Areas of the part: all, hidden from above, seen but out of the cutter's reach; by triangles, or
/// by evenly chosen ones of many.
void report_reach(const Part& part, ToolpathReport& report);

}  // namespace obvid::toolpath
