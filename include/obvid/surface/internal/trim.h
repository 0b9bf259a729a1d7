// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// A part of a patch between two arcs of its loops: for each v of the range all u between them.
struct TrimBand {
  Range v;
  std::size_t left = 0, right = 0;  ///< arcs
};

/// What of a patch is there, as bands one above the other: the loops cut into arcs along which v
/// rises or falls, the ranges of v between the ends of arcs, and in each range every second gap
/// between the arcs that cross it. A patch without loops is one band.
///
/// Where v turns back along a curve is looked for at 16 places of each of its spans: what turns
/// twice between two of them goes on as if it did not. Loops that cross themselves or each other
/// have bands, but not those that anybody means. Keeps a reference to the patch. Reentrant.
class TrimRegion {
 public:
  explicit TrimRegion(const SurfacePatch& patch);

  [[nodiscard]] const std::vector<TrimBand>& bands() const { return bands_; }
  /// From the left to the right end at a v of the band.
  [[nodiscard]] Range across(const TrimBand& band, double v) const;
  /// Whether the parameters are there; on loops either.
  [[nodiscard]] bool contains(double u, double v) const;
  /// Everything between a least and a greatest v, without gaps: ends of bands, inner knots of the
  /// patch and of the curves; ascending. Between them bands have smooth ends.
  [[nodiscard]] const std::vector<double>& breaks_v() const { return breaks_v_; }

 private:
  struct Arc {
    const NurbsCurve* curve = nullptr;
    Range t;                       ///< v rises from one end to the other, or falls
    double low = 0.0, high = 0.0;  ///< v
    bool rises = true;
  };
  void cut(const NurbsCurve& curve);
  void make_bands();
  [[nodiscard]] double u_at(const Arc& arc, double v) const;

  const SurfacePatch& patch_;
  std::vector<NurbsCurve> own_;  ///< sides of a patch without loops
  std::vector<Arc> arcs_;
  std::vector<TrimBand> bands_;
  std::vector<double> breaks_v_;
};

/// The four sides of a patch as a loop.
[[nodiscard]] TrimLoop outline_of(const NurbsSurface& surface);
/// The straight line from a to b over [0, 1].
[[nodiscard]] NurbsCurve parameter_line(Vec2 a, Vec2 b);

/// Whether a curve in the plane of the parameters runs along a side of the patch, within 1e-9 of
/// its ranges.
[[nodiscard]] bool runs_along_side(const NurbsCurve& curve, const NurbsSurface& surface);

/// An area, and how far it may be off: what the last step of its quadrature changed, which is
/// measured and not proved, and what lies between the trims and what they stand for.
struct PatchArea {
  double value = 0.0;     ///< units^2
  double error = 0.0;     ///< of both together
  double of_trims = 0.0;  ///< of that, the length of the trims times `SurfacePatch::trims_within`;
                          ///< stretches along the border of the patch have none
};

/// Area of what of a patch is there: Gauss's rule with 8 points in each direction over the parts of
/// the bands between knots, halved in both where the halves differ from the whole by more than
/// 1e-12 of the size squared: along v up to 24 times, across up to 4. Error: E103.
[[nodiscard]] Result<PatchArea> area_of(const SurfacePatch& patch, const RunContext& run = {});

}  // namespace obvid
