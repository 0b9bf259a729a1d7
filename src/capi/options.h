// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "obvid/core/result.h"
#include "obvid/core/units.h"
#include "obvid/geom/vec3.h"
#include "obvid/pipeline/alignment_job.h"
#include "obvid/pipeline/compare_curves.h"
#include "obvid/pipeline/cut_job.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/region_table.h"

namespace obvid::capi {

/// What the options of a call ask for.
struct Request {
  FitJob job;
  RegionJob worksheet;        ///< the job with what is asked of tangents and constructions
  std::optional<Vec3> along;  ///< of points in space
  ImportOptions import;
  ExportOptions formats;
  std::string profile;  ///< what "for" chose, in words
  CutJob cut;
  AlignmentJob alignment;
  CurvesJob curves;
  std::optional<double> enlarge;  ///< of the picture of several curves
  std::optional<Units> units;
};

/// Which options a job knows.
struct Known {
  bool fit = false;           ///< carrier, tolerance, fixed data, ...
  bool construction = false;  ///< of the papers, over the points
  bool worksheet = false;     ///< `prefer` is that of region, which inserts points too
  bool space = false;         ///< direction of the projection
  bool import = false;        ///< curve, drawing, chord-tolerance, and those of `points`
  bool formats = false;       ///< of files
  bool plots = false;         ///< of pictures of a curve
  bool shown = false;         ///< of pictures: curvature-range
  bool points = false;        ///< columns, skip, scale, rotate, move, mirror
  bool cut = false;           ///< of `obvid cut`
  bool alignment = false;     ///< of `obvid alignment`
  bool curves = false;        ///< align, enlarge
};

/// Reads a JSON object with the names of the command line; NULL and "" are no options. Errors: E308
/// no JSON object; E201 a name that the job does not know; E203 a value that is not possible.
[[nodiscard]] Result<Request> request_of(const char* options, const Known& known);

/// Of contours and reports, by a file extension without its dot. Error: E202.
[[nodiscard]] Result<FileFormat> format_of_ending(const char* ending);

}  // namespace obvid::capi
