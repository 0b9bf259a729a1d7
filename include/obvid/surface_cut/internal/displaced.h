// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// A figure with what its quadrature may be off: measured, not proved.
struct MeasuredFigure {
  double value = 0.0;
  double error = 0.0;
};

/// What a body displaces that floats with its water at a height z.
struct Displaced {
  MeasuredFigure volume;                        ///< units^3
  MeasuredFigure wetted;                        ///< units^2, of the surfaces that are there
  MeasuredFigure waterplane;                    ///< units^2; 0 where it is rounding only
  MeasuredFigure centre_x, centre_y, centre_z;  ///< of the volume, units
  MeasuredFigure plane_x, plane_y;              ///< centre of the waterplane, units
  MeasuredFigure
      inertia_x;          ///< units^4: of the waterplane about its axis along x through its centre
  std::size_t parts = 0;  ///< of surfaces joined at their borders; each counts as positive
  std::size_t twisted = 0;    ///< borders whose patches cannot be turned to one side
  std::size_t undecided = 0;  ///< cells that touch the water along a line, left out
  bool trimmed = false;       ///< errors hold what lies between trims and what they stand for, too
  double open_volume = 0.0;   ///< units^3, about: what closing open borders level changes
  double open_width = 0.0;    ///< units: how far that would be, at the most
  Vec3 open_at;               ///< a place where they are
};

struct DisplacedOptions {
  double water = 0.0;   ///< z of the waterplane, units
  bool mirror = false;  ///< the other half, across y = 0, counts too
};

/// Volume, areas and centres below the waterplane by the divergence theorem with fields along z
/// that vanish at the waterplane: so the waterplane itself, vertical planes (a centre plane, a flat
/// transom) and whatever lies above the water may be missing. Borders of one patch alone
/// below the water are closed upright; `open_volume` tells by about how much the volume would be
/// another if level lines closed them, to y = 0 (`mirror`), to a plane of constant y, or to another
/// border, whichever is nearer.
///
/// Each span below the water is integrated by 8 x 8 Gauss points, spans that it cuts up to the
/// roots of their distance along u or v, where the parts of `ModelCutter` begin and end, so that
/// the rule meets smooth functions only. Where 4 and 8 points differ by more than 1e-13 of size^3
/// (^2, ^4) a part is halved both ways, up to 10 times. `error` sums the differences between the
/// last two steps.
///
/// Of trimmed patches what lies inside the trims counts, by Green's theorem along trims and
/// waterline; `error` adds the length of the trims times `SurfacePatch::trims_within` times what is
/// integrated there. In a model with trims boundaries meet where they are within 1e-6 of the size,
/// and what the trims are known within, of each other, whole sides or not; a waterplane within its
/// error of 0 is 0.
///
/// Centres of what is not above 8 of its errors are NaN. Errors: E303 water that is
/// not finite; E304 no size; E103.
[[nodiscard]] Result<Displaced> displaced(const SurfaceModel& model,
                                          const DisplacedOptions& options,
                                          const RunContext& run = {});

}  // namespace obvid
