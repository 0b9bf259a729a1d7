// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/pipeline/surface_check_job.h"
#include "obvid/pipeline/surface_export.h"
#include "obvid/pipeline/surface_job.h"
#include "obvid/pipeline/toolpath_job.h"

namespace obvid {

// Options of surfaces and tool paths as they are typed, read alike for all front ends. Errors: E203
// with the name of the option as the command line has it.

/// Kinds of surfaces by the words of pipeline/surface_kinds.inc, nothing said of them yet. Error:
/// E201 with the nearest word.
[[nodiscard]] Result<SurfaceKind> surface_kind_named(const std::string& name);
[[nodiscard]] std::vector<std::string> surface_kind_names();

/// "NX,NY,NZ,D": all points with NX x + NY y + NZ z = D. Error: E203.
[[nodiscard]] Result<CutPlane> plane_of(const std::string& typed, const char* option);

struct SurfaceValues {
  std::optional<double> tolerance, spacing, light, fair_across, distance, angle_deg, steepest_deg;
  std::optional<long> row;
  std::string matching = "auto", spread = "chord";
  std::string direction, apex, axis = "x", axis_point, up = "best";  ///< "X,Y,Z"
  bool near = false, control = false, straight = false, smooth = false;
  bool drop_outliers = false;
  std::vector<std::string> planes;     ///< as of `SurfaceCutValues`, or "z=1.5"
  std::optional<std::string> keep;     ///< "above", "below"; "inside", "outside"
  std::optional<std::string> contour;  ///< path of a file
  std::optional<std::string> along;    ///< "x", "y", "z" [z]
  std::optional<double> radius, radius_end;
  std::string faces;           ///< "A,B": names or numbers from 1
  std::string sides = "auto";  ///< or "front,back", ...
  bool whole = false;
  std::string border, to;        ///< "A:u0": face and side
  std::string join = "G1";       ///< or "G0", "G2"
  std::optional<double> within;  ///< units, of a match
};

/// Into the job, whose kind is known: its own values, and those of all kinds.
[[nodiscard]] Result<void> set_surface(const SurfaceValues& typed, SurfaceJob& job);

/// Views of pictures by name: "iso", "front", "top", "side", "back", "bottom". Error: E203.
[[nodiscard]] Result<SurfaceView> view_named(const std::string& name);

struct SurfaceFormatValues {
  std::optional<double> chord_tolerance, mesh_angle_deg;
  std::string colour = "shaded", view = "iso", step = "ap214";
};

[[nodiscard]] Result<void> set_surface_formats(const SurfaceFormatValues& typed,
                                               SurfaceExportOptions& formats);

struct ToolpathValues {
  std::string cutter = "ball", strategy = "zigzag", controller = "grbl", motion = "arcs";
  std::string up = "z";              ///< x, y, z, -x, -y, -z
  std::string stock;                 ///< "X0,Y0,Z0,X1,Y1,Z1"
  std::optional<std::string> entry;  ///< ramp, helix
};

/// The names; numbers go into the job as they are.
[[nodiscard]] Result<void> set_toolpath(const ToolpathValues& typed, ToolpathJob& job);

struct SurfaceCheckValues {
  std::optional<long> samples;         ///< lines of each family, and points on them: 3 to 2000 [65]
  std::optional<std::string> against;  ///< path of a file
  std::optional<double> meeting;       ///< units
};

[[nodiscard]] Result<void> set_surface_check(const SurfaceCheckValues& typed, SurfaceCheckJob& job);

}  // namespace obvid
