// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/nurbs.h"
#include "obvid/curve/pieces.h"
#include "obvid/exchange/drawing.h"

namespace obvid {

/// Formats that need the CAD kernel Open CASCADE.
enum class CadFormat { kStepAp214, kStepAp242, kIges, kBrep };

/// A curve to write: one NURBS curve becomes one edge; pieces become one edge each (lines, circles
/// and rational curves as such), joined in one wire. No clothoids.
struct CadCurve {
  std::string name;
  std::variant<NurbsCurve, std::vector<Piece>> geometry;
};

struct CadWriteOptions {
  CadFormat format = CadFormat::kStepAp214;
  std::string units = "mm";  ///< of the curves and of the file: um, mm, cm, m, km, in, ft. BREP
                             ///< files have no unit: numbers are written as they are
  double face_width = 0.0;  ///< units; > 0: also a face, the curve moved along z by this width, for
                            ///< systems that show no wires
};

/// The text of a file in the plane z = 0; the same curves give the same bytes.
/// Errors: E203 a unit that these formats do not know; E310 when the kernel's plugin is not there
/// (the hint says how to get it) or a piece is a clothoid; E101 when the kernel fails.
[[nodiscard]] Result<std::string> cad_text(const std::vector<CadCurve>& curves,
                                           const CadWriteOptions& options);

/// Curves of a STEP, IGES or BREP file, of edges and wires of all kinds; format by content. Lengths
/// in mm (of BREP files as they are). Curves in a plane z = const are taken as they lie; other
/// plane curves each in its own plane, which a warning names; others are left out with a warning.
/// Errors: E301, E310 as above, E306 when the kernel cannot read the file, E304 when there are no
/// curves.
[[nodiscard]] Result<Drawing> read_cad(const std::string& path);

/// Whether a file looks like one of these formats, by its first bytes.
[[nodiscard]] bool is_cad_text(std::string_view text);

}  // namespace obvid
