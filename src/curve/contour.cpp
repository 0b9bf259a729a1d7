// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/contour.h"

namespace obvid {

const char* to_string(Carrier carrier) { return carrier == Carrier::kSpiral ? "spiral" : "arcs"; }

}  // namespace obvid
