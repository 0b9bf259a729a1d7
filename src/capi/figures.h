// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/certify/certificate.h"
#include "obvid/curve/contour.h"
#include "obvid/obvid.h"
#include "obvid/report/stored_contour.h"

namespace obvid::capi {

/// Nothing is known.
[[nodiscard]] obvid_figures no_figures();

/// Report and certificate may be missing.
[[nodiscard]] obvid_figures figures_of(const Contour& contour, const FitReport* report,
                                       const Certificate* certificate);

/// Counts are added, of lengths the largest stays; proved is what all are.
void add_figures(obvid_figures& sum, const obvid_figures& one);

}  // namespace obvid::capi
