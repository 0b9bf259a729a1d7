// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/exchange/drawing.h"
#include "obvid/exchange/internal/cad_curve.h"
#include "obvid/surface/surface.h"

namespace obvid {

// Formats that need the CAD kernel Open CASCADE, all but STEP files of curves. The kernel runs in a
// helper program of its own, `obvid-cad`, one process for each call, and never in the process that
// calls: its crashes, its global settings and its memory stay there. Every function below may be
// called from several threads at once, in a process that uses the kernel itself, too.
//
// The helper is looked for in the folder that $OBVID_PLUGINS names, in the folder of the program
// (or shared library) that holds this code, and in ../libexec/obvid seen from there; nowhere else.
// Before it is started it must be a plain file that not everybody may write to, belong to root, to
// the user or to the owner of the program, and hold the mark of this very build. What is found
// first decides. Where none fits, the command $OBVID_CAD_BUILDER, if set, is run to build it, as
// the launcher of a source folder has it. E310 says what is wrong, or that there is none.
//
// Reading is limited: 4 GiB of memory, 20 s of processor time (E314 says which), and the time on
// the clock below. The helper gets no environment but the settings of the dynamic linker, writes no
// files, and ends when the process that started it does.

/// How long a call may take, and how it is stopped.
struct CadRun {
  std::optional<double> seconds;    ///< on the clock, then E314 (writing: E101); nothing: 120 s for
                                    ///< reading, six times its processor time, none for writing
  std::function<bool()> cancelled;  ///< asked some 20 times a second, by the thread that called;
                                    ///< true ends the helper at once and gives E103
};

/// Whether the helper is there and may be started. Error: E310, as everything below has it.
[[nodiscard]] Result<void> check_cad();

/// Formats of files.
enum class CadFormat { kStepAp214, kStepAp242, kIges, kBrep };

struct CadWriteOptions {
  CadFormat format = CadFormat::kStepAp214;
  std::string units = "mm";  ///< of the curves, and of the file as `cad_unit` says. BREP files have
                             ///< no unit: numbers are written as they are
  double face_width = 0.0;  ///< units; > 0: also a face, the curve moved along z by this width, for
                            ///< systems that show no wires
};

/// The text of a file in the plane z = 0; the same curves give the same bytes. STEP is written
/// without the kernel and its helper, as `step_text` says.
/// Errors: those of `step_text`; of IGES and BREP: E203 a unit that these formats do not know; E310
/// when the kernel's helper is not there (the hint says how to get it) or a piece is a clothoid;
/// E101 when the kernel fails; E103.
[[nodiscard]] Result<std::string> cad_text(const std::vector<CadCurve>& curves,
                                           const CadWriteOptions& options, const CadRun& run = {});

/// Curves of a STEP, IGES or BREP file, of edges and wires of all kinds; format by content. Lengths
/// in mm (of BREP files as they are, the unit assumed). Curves in a plane z = const are taken as
/// they lie; other plane curves each in its own plane, which a warning names; others are left out
/// with a warning. Errors: E301, E310 as above, E314 when the kernel cannot read the file, E311
/// when there are no curves, E103.
[[nodiscard]] Result<Drawing> read_cad(const std::string& path, const CadRun& run = {});

/// The text of a file of faces: each patch one face on its own B-spline surface (degrees, knots,
/// points and weights as given) with its name; IGES labels keep 8 characters of it, BREP none.
/// Corners and borders nearer than 1e-8 of the size of the model are one: patches that meet hang
/// together in a shell (neighbours whose normals differ in side are turned to that of the first),
/// and are a solid, normals outwards, when no border is free. Borders meet when they have the same
/// points at the same parts of their parameters; T-joints stay open. Seams and poles are edges as
/// kernels want them. A patch is cut into "NAME, part 1 of 2", ... where its normal jumps at an
/// inner knot of full multiplicity, because kernels cut there. Lengths in `model.units`, which the
/// file has too (`options.units` and `face_width` are for curves). The same model gives the same
/// bytes. Patches of one shell stand together in the file. Errors: E203 a unit that these formats
/// do not know, E311 no patches, E309 all points are one or beyond 1e100 mm, E310 no helper, or
/// more than 20,000 faces by creases; what `check` finds of a patch (`where`: its name); E101 when
/// the kernel refuses; E103.
[[nodiscard]] Result<std::string> cad_surface_text(const SurfaceModel& model,
                                                   const CadWriteOptions& options,
                                                   const CadRun& run = {});

/// Faces of a file as patches.
struct CadSurfaces {
  SurfaceModel model;                 ///< named as in the file, else "face 1", ...; in mm
  std::vector<std::string> warnings;  ///< what is not as in the file, in sentences
};

/// All faces of a STEP, IGES or BREP file, normals as the file has them; format by content. Planes,
/// cylinders, cones, spheres, tori, extrusions, revolutions and B-splines exactly; offsets within
/// 1e-6 of the model's size, which a warning says. Trimmed faces have their boundary as loops of
/// parameters (within 1e-7 of their size where the kernel has other parameters than we); where that
/// is not understood they are the whole box of their parameters, with a warning that names it;
/// faces of degree above 9 or without limits are left out with a warning. Lengths in mm (of BREP
/// files as they are). Errors: E301, E310 no helper, E314 when the kernel cannot read the file,
/// E311 when it has no faces that could be taken, E103.
[[nodiscard]] Result<CadSurfaces> read_cad_surfaces(const std::string& path,
                                                    const CadRun& run = {});

}  // namespace obvid
