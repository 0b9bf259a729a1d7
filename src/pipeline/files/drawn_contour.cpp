// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/drawn_contour.h"

#include <utility>

#include "obvid/pipeline/audit.h"

namespace obvid {

Result<TitledContour> drawn_contour(Drawing drawing, const ImportOptions& options,
                                    const std::string& where, const RunContext& run) {
  place(options.placement, drawing);
  const auto chosen = chosen_curve(drawing, options.curve, where);
  OBVID_TRY(chosen);
  const std::size_t curves = drawing.curves.size();
  if (*chosen >= curves && options.use != DrawnUse::kExact) {
    return error(ErrorCode::kUnsupported, "this is a series of points, not a curve")
        .where(where)
        .hint("use `obvid fit`, --drawing exact for its edges, or --curve N for another one");
  }
  TitledContour out;
  out.source = where;
  out.warnings = drawing.warnings;
  (is_guessed(drawing, options.curve) ? out.warnings : out.remarks)
      .push_back(where + ": " + chosen_text(drawing, *chosen, options.curve.asked()));
  auto made =
      audit(*chosen < curves ? drawing.curves[*chosen] : edges_of(drawing.series[*chosen - curves]),
            drawing.units, run);
  OBVID_TRY(made);
  CurveAudit& audited = *made;
  out.name = audited.name.empty() ? audited.label : audited.name;
  const bool drawn = *chosen < curves;
  out.id = drawn ? drawing.curves[*chosen].id : drawing.series[*chosen - curves].id;
  out.layer = drawn ? drawing.curves[*chosen].layer : drawing.series[*chosen - curves].layer;
  out.first_station = audited.station.value_or(0.0);
  out.transitions = std::move(audited.transitions);
  out.profile = std::move(audited.profile);
  out.picture = {drawing.name + ": " + audited.label, as_drawn(audited)};
  out.stored = {std::move(audited.contour), std::nullopt, std::move(audited.certificate)};
  return out;
}

}  // namespace obvid
