// SPDX-License-Identifier: Apache-2.0
// DXF into a drawing: docs/methods/dxf.md.
#include "obvid/exchange/internal/dxf/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "dxf/drawing.h"

namespace obvid {
namespace {

dxf::Affine in_units(const dxf::Document& document, Drawing& drawing) {
  if (const auto ours = canonical_unit(document.units_remark); document.units == 0 && ours) {
    drawing.units = *ours;
    return {};
  }
  const dxf::Unit unit = dxf::unit_of(document.units);
  drawing.units = unit.name;
  if (!unit.known) {
    // imperial or metric is all that $MEASUREMENT says
    const bool imperial = document.measurement == 0;
    drawing.units = Units(imperial ? "in" : "mm", UnitSource::kAssumed);
    drawing.warnings.push_back(fmt::format(
        "the file states no known unit ($INSUNITS), $MEASUREMENT says {}: --units says what it is",
        !document.measurement ? "nothing"
        : imperial            ? "imperial"
                              : "metric"));
  }
  if (unit.factor == 1.0) return {};
  drawing.warnings.push_back(fmt::format("lengths were converted to {} (unit {} of $INSUNITS)",
                                         unit.name, document.units));
  return dxf::scaling({unit.factor, unit.factor, unit.factor});
}

Error nothing(const std::vector<std::string>& warnings, std::string_view name) {
  std::string why;
  for (const std::string& warning : warnings) why += (why.empty() ? "" : "; ") + warning;
  if (why.empty()) why = "save curves in model space as LINE, ARC, SPLINE, LWPOLYLINE, ...";
  return error(ErrorCode::kNothingThere, "the DXF file draws no curve and no points")
      .where(std::string(name))
      .hint(why);
}

}  // namespace

Result<Drawing> parse_dxf(std::string_view bytes, std::string_view name) {
  auto document = dxf::read_document(bytes, name);
  OBVID_TRY(document);
  Drawing drawing;
  drawing.name = std::string(name);
  dxf::DrawingBuilder builder(*document, drawing, dxf::TagReader(bytes, name).binary());
  const dxf::Affine map = in_units(*document, drawing);
  std::vector<std::string> units = std::move(drawing.warnings);
  drawing.warnings = std::move(document->warnings);
  builder.run(map);
  if (drawing.curves.empty() && drawing.series.empty()) {
    return fail(nothing(drawing.warnings, name));
  }
  drawing.warnings.insert(drawing.warnings.begin(), units.begin(), units.end());
  return drawing;
}

}  // namespace obvid
