// SPDX-License-Identifier: Apache-2.0
#include "write.h"

#include <utility>

#include "faces.h"
#include "file_text.h"
#include "obvid/exchange/internal/step/letters.h"
#include "wires.h"

namespace obvid::cad {
Result<std::string> write_text(const std::vector<CadCurve>& curves,
                               const CadWriteOptions& options) {
  const auto scale = scale_of(options.format, options.units);
  OBVID_TRY(scale);
  const auto shape = shape_of(curves, *scale, options.face_width);
  OBVID_TRY(shape);
  const std::string name =
      curves.empty() || curves.front().name.empty() ? "contour" : curves.front().name;
  return text_of({*shape, on_one_line(name), {}, {}}, options.format, options.units);
}

Result<std::string> write_surfaces(const SurfaceModel& model, const CadWriteOptions& options) {
  const auto scale = scale_of(options.format, model.units.name);
  OBVID_TRY(scale);
  auto faces = faces_of(model, *scale);
  OBVID_TRY(faces);
  for (std::string& name : faces->names) name = on_one_line(std::move(name));
  return text_of({faces->shape, model.name.empty() ? "surface" : on_one_line(model.name),
                  std::move(faces->faces), std::move(faces->names)},
                 options.format, model.units.name);
}

}  // namespace obvid::cad
