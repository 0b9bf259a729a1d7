// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/certify/certificate.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// What a certificate says of the joints, in the words of report, `verify` and picture: "G2 joints
/// between 4 corners but for 8 that are G1 with a step of the curvature". Gaps of heading and
/// curvature are named where either is above 1e-9; arcs claim nothing of their curvature.
[[nodiscard]] std::string joints_claim(Carrier carrier, const Certificate& certificate);

/// Vertices or inflections that the points force, and on which curves, in a few words; reports say
/// more (`bound_text`, docs/claims.md: `vertices_lower_bound`).
[[nodiscard]] std::string short_bound_text(int bound);

}  // namespace obvid
