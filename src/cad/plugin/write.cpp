// SPDX-License-Identifier: Apache-2.0
#include "write.h"

#include <mutex>

#include "faces.h"
#include "shapes.h"
#include "texts.h"

namespace obvid::cad {
namespace {

std::mutex one_at_a_time;  // the kernel keeps its settings in global variables

}  // namespace

Result<std::string> write_text(const std::vector<CadCurve>& curves,
                               const CadWriteOptions& options) {
  const std::lock_guard lock(one_at_a_time);
  const auto scale = scale_of(options.format, options.units);
  if (!scale) return fail(scale.error());
  const auto shape = shape_of(curves, *scale, options.face_width);
  if (!shape) return fail(shape.error());
  const std::string name =
      curves.empty() || curves.front().name.empty() ? "contour" : curves.front().name;
  return text_of({*shape, name, {}, {}}, options.format, options.units);
}

Result<std::string> write_surfaces(const SurfaceModel& model, const CadWriteOptions& options) {
  const std::lock_guard lock(one_at_a_time);
  const auto scale = scale_of(options.format, model.units);
  if (!scale) return fail(scale.error());
  auto faces = faces_of(model, *scale);
  if (!faces) return fail(faces.error());
  return text_of({faces->shape, model.name.empty() ? "surface" : model.name,
                  std::move(faces->faces), std::move(faces->names)},
                 options.format, model.units);
}

}  // namespace obvid::cad
