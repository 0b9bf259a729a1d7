// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/geom/element.h"

namespace obvid {

/// Range of the signed curvature at one point, ends excluded; may be infinite.
struct CurvatureRange {
  double low = 0.0;
  double high = 0.0;
};

/// Chains of least and greatest curvature along one run of a spiral with given points and headings
/// ([000], equations (9), (10) and the two schemes after them; [Kurnosenko 2013] in closed form).
/// `elements` give points and headings, their curvatures are not used. `direction` +1: signed
/// curvature increases. `convex`: curvature keeps its sign, so it is zero at most (the seeds'
/// infinite radius at the flat end); otherwise both ends are unbounded.
/// `turning` is the sign of the run's curvature, used when `convex`.
[[nodiscard]] std::vector<CurvatureRange> curvature_chains(const std::vector<Element>& elements,
                                                           int direction, bool convex, int turning);

}  // namespace obvid
