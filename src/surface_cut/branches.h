// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "obvid/surface_cut/internal/plane_section.h"
#include "strands.h"

namespace obvid {

/// Points of a patch moved into the plane along lines of constant parameters.
class PlaneFoot {
 public:
  PlaneFoot(const CutPlane& plane, double small) : plane_(plane), small_(small) {}

  [[nodiscard]] double height(Vec3 p) const { return dot(plane_.normal, p) - plane_.offset; }
  [[nodiscard]] bool is_there(Vec3 p) const { return std::abs(height(p)) <= 4.0 * small_; }
  /// From (u, v) along one parameter; the best place found, inside the domain.
  [[nodiscard]] SectionPoint slid(const CutPatch& patch, std::size_t number, double u, double v,
                                  bool along_u) const;
  /// On a piece, where the parameter that it is a function of has the value `t`; `guess` is the
  /// other one.
  [[nodiscard]] SectionPoint on_strand(const CutPatch& patch, const Strand& strand, double t,
                                       double guess) const;

  /// Between two places of a strand, where the other parameter has the mean of theirs.
  [[nodiscard]] SectionPoint between_across(const CutPatch& patch, const Strand& strand,
                                            const SectionPoint& a, const SectionPoint& b) const;

 private:
  const CutPlane& plane_;
  double small_;  ///< units: a rounding of a distance; nothing smaller is mended
};

/// The places of a piece from its first to its last end, so many that chords between neighbours are
/// within the tolerance at the middle and near the quarters of each; `deviation` gets the largest
/// distance that was measured where nothing was inserted.
[[nodiscard]] std::vector<SectionPoint> sampled(const PlaneFoot& foot, const CutPatch& patch,
                                                const Strand& strand, const SectionPoint& first,
                                                const SectionPoint& last, double tolerance,
                                                double& deviation);

}  // namespace obvid
