// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>
#include <vector>

#include "obvid/alignment/profile.h"
#include "obvid/alignment/transition.h"
#include "obvid/cad/internal/cad.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/exchange/internal/dxf/write.h"
#include "obvid/exchange/internal/gcode/gcode.h"
#include "obvid/exchange/internal/points/airfoil.h"
#include "obvid/exchange/internal/points/samples.h"
#include "obvid/picture/picture_svg.h"
#include "obvid/pipeline/file_formats.h"
#include "obvid/report/stored_contour.h"

namespace obvid {

/// What was said while a contour was made: .html pages say it too.
struct ToldBeside {
  std::vector<std::string> remarks;
  std::vector<std::string> warnings;
};

/// Choices of the formats. Lengths in units of the contour.
struct ExportOptions {
  std::string name = "contour";  ///< of the curve, where a format has a place for it
  double first_station = 0.0;    ///< of the start, units of the contour; of LandXML
  std::optional<VerticalProfile>
      profile{};  ///< of heights, stations as from there; of LandXML, OpenDRIVE
  std::vector<PlacedTransition> transitions{};  ///< what clothoids stand for; of LandXML
  PictureTitles picture{};                      ///< of .svg pictures
  PicturePlots plots{};                         ///< that .svg pictures have on request
  std::string asked{};  ///< what .html pages say was asked for; empty: nothing
  ToldBeside told{};
  std::optional<double> tolerance;  ///< of curves that a format cannot hold exactly [1e-6 of the
                                    ///< size; of arcs, G-code and SVG drawings 2e-5, of G-code at
                                    ///< least 0.002 mm]
  CadFormat step = CadFormat::kStepAp214;
  bool drawing = false;  ///< .svg: a drawing in true scale in place of the picture
  DxfProfile dxf = DxfProfile::kExact;
  GcodeMotion motion = GcodeMotion::kArcs;
  GcodeController controller = GcodeController::kGrbl;
  SampleOptions
      samples;  ///< of points; unset: by the chord tolerance `tolerance` [2e-5 of the size]
  AirfoilOptions airfoil{};       ///< of .dat; its name and number of points are those above
  std::optional<double> feed{};   ///< of G-code, mm/min (in/min for inches) [default_feed]
  std::optional<int> decimals{};  ///< of places of G-code, 1 to 6 [as `GcodeOptions` says]
  double face_width = 0.0;        ///< STEP, IGES, BREP: > 0 also a face of this width along z
};

/// A text to write; `suffix` goes before the ending when a contour needs several files.
struct ExportedFile {
  std::string suffix;
  std::string text;
};

struct Exported {
  std::vector<ExportedFile> files;
  std::vector<std::string> remarks;   ///< what the user should know: deviations, units, sizes
  std::vector<std::string> warnings;  ///< what may be wrong: a unit that is merely assumed
};

/// The contour in a format of another system. CAD formats get one NURBS curve, joined as
/// `nurbs_of` says; contours of lines and arcs alone stay lines and arcs; clothoids are
/// followed by a C2 cubic within the tolerance, which the remarks tell. Errors: those of the
/// formats; E103 where it was cancelled, asked before and while curves are followed that a format
/// does not hold.
[[nodiscard]] Result<Exported> export_contour(const StoredContour& stored, FileFormat format,
                                              const ExportOptions& options = {},
                                              const RunContext& run = {});

}  // namespace obvid
