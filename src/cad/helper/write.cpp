// SPDX-License-Identifier: Apache-2.0
#include "write.h"

#include <algorithm>
#include <utility>

#include "faces.h"
#include "shapes.h"
#include "texts.h"

namespace obvid::cad {
namespace {

/// Names of files have no line ends and other signs of control.
std::string on_one_line(std::string name) {
  const auto is_control = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7F;
  };
  std::replace_if(name.begin(), name.end(), is_control, ' ');
  return name;
}

}  // namespace

Result<std::string> write_text(const std::vector<CadCurve>& curves,
                               const CadWriteOptions& options) {
  const auto scale = scale_of(options.format, options.units);
  if (!scale) return fail(scale.error());
  const auto shape = shape_of(curves, *scale, options.face_width);
  if (!shape) return fail(shape.error());
  const std::string name =
      curves.empty() || curves.front().name.empty() ? "contour" : curves.front().name;
  return text_of({*shape, on_one_line(name), {}, {}}, options.format, options.units);
}

Result<std::string> write_surfaces(const SurfaceModel& model, const CadWriteOptions& options) {
  const auto scale = scale_of(options.format, model.units.name);
  if (!scale) return fail(scale.error());
  auto faces = faces_of(model, *scale);
  if (!faces) return fail(faces.error());
  for (std::string& name : faces->names) name = on_one_line(std::move(name));
  return text_of({faces->shape, model.name.empty() ? "surface" : on_one_line(model.name),
                  std::move(faces->faces), std::move(faces->names)},
                 options.format, model.units.name);
}

}  // namespace obvid::cad
