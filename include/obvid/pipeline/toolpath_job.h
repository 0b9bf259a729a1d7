// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/picture/surface_svg.h"
#include "obvid/toolpath/toolpath.h"

namespace obvid {

/// Which axis of the surface points to the spindle.
enum class UpAxis { kX, kY, kZ, kMinusX, kMinusY, kMinusZ };

/// "x", "-z", ...
[[nodiscard]] const char* to_string(UpAxis up);

/// The surface with that axis along Z, turned by a quarter or half turn about one of its axes:
/// about Y for X, about X for Y and for Z downwards. Coordinates change signs and places, exactly.
[[nodiscard]] SurfaceModel turned_up(SurfaceModel model, UpAxis up);

/// A tool path as it is asked for. Lengths in units of the surface; what is not given is so many
/// millimetres of it.
struct ToolpathJob {
  ToolpathOptions plan;                 ///< but for what follows; a scallop of 0.01 diameters when
                                        ///< neither scallop nor step-over is given; roughing: a
                                        ///< step-over of 0.4 diameters
  std::optional<double> diameter;       ///< [6 mm]
  std::optional<double> corner_radius;  ///< of bull noses [a quarter of the diameter]
  std::optional<double> tolerance;      ///< [0.01 mm]
  std::optional<double> rest_of;        ///< diameter of an earlier cutter [none]
  /// Rounding of its corner, up to half its diameter (a ball) [of this one's kind]
  std::optional<double> rest_corner;
  UpAxis up = UpAxis::kZ;  ///< lengths and places of the job are those behind the turn
};

struct MadeToolpath {
  Toolpath path;
  SurfaceModel surface;               ///< as it lies under the spindle
  UpAxis up = UpAxis::kZ;             ///< which of its axes that was
  std::vector<std::string> warnings;  ///< those of the path, and a unit that is merely assumed
};

/// The tool path of a surface. Errors: those of `plan`; E203 where it would take more than 20,000
/// passes: a typing error in a length, most likely (`value`: the passes). A surface in a unit
/// without a length in metres is refused by `plan`. Reentrant; uses as many threads as
/// `plan.threads` says.
[[nodiscard]] Result<MadeToolpath> make_toolpath(const SurfaceModel& model, const ToolpathJob& job,
                                                 const RunContext& run = {});

/// What of the path is not as it was asked for, all of it in one error (E502): gouges, more left
/// than the scallop, places that the cutter does not reach.
[[nodiscard]] std::optional<Error> not_kept(const MadeToolpath& made);

/// The path as it is drawn over the surface: thinned out within four tolerances.
[[nodiscard]] std::vector<ScenePolyline> drawn(const Toolpath& path);

}  // namespace obvid
