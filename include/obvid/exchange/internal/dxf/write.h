// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// How a contour is drawn in a DXF file.
enum class DxfProfile {
  kExact,    ///< R2000: SPLINE (rational), ELLIPSE where a conic is one, LINE and ARC
  kArcs,     ///< R2000: one LWPOLYLINE with bulges, within the tolerance
  kCubic,    ///< R2000: SPLINE of degree 3 without weights, within the tolerance
  kArcsR12,  ///< R12: one POLYLINE with bulges, within the tolerance
};

struct DxfOptions {
  DxfProfile profile = DxfProfile::kExact;
  double tolerance = 0.01;        ///< units; of profiles that are not exact, and of clothoids
  std::string layer = "CONTOUR";  ///< letters, digits, - and _ ; others become _
};

/// A DXF file and how far it is from the contour.
struct DxfText {
  std::string text;
  std::size_t entities = 0;
  double deviation = 0.0;  ///< units, as measured; 0: exact to rounding
  std::size_t layers = 0;
  std::size_t renamed = 0;  ///< layers whose names DXF does not take as they are
};

/// One of several curves of a file.
struct DxfCurve {
  const Contour& contour;
  std::string layer;        ///< its name, UTF-8
  double tolerance = 0.01;  ///< as in `DxfOptions`
};

/// The unit that a DXF file states for lengths in `units`: none (empty) when it is merely assumed,
/// and where it has no length in metres.
[[nodiscard]] std::string dxf_unit(const Units& units);

/// ASCII DXF in the plane z = 0, unit in the header ($INSUNITS) as `dxf_unit` says; R12 has no
/// place for it but a comment that `parse_dxf` understands. Corners cut an exact or cubic contour
/// into several splines. What numbers of an ARC or ELLIPSE would not hold to 1e-10 of the size
/// becomes an LWPOLYLINE or a SPLINE (docs/methods/dxf.md, section 1). Errors: E203 a tolerance
/// that is not greater than 0; E303 a coordinate that is not finite; E311 no pieces; those of
/// `arcs_along`, `cubic_along`, `nurbs_of`; E103 where `watch` ends it.
[[nodiscard]] Result<DxfText> dxf_text(const Contour& contour, const DxfOptions& options = {},
                                       Watch* watch = nullptr);

/// The same of several curves, each on its layer. Lines and arcs of one curve are one entity (LINE,
/// ARC, CIRCLE, else an LWPOLYLINE with bulges), so that curves which touch stay apart. Layers keep
/// their names but for what DXF forbids in them, which becomes _ ; R12 has letters, digits, - and _
/// alone. Two layers do not become one: _2, _3 are put behind. Errors: as above; E203 curves of
/// different units.
[[nodiscard]] Result<DxfText> dxf_text(const std::vector<DxfCurve>& curves, DxfProfile profile,
                                       Watch* watch = nullptr);

}  // namespace obvid
