// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <string>
#include <vector>

#include "obvid/cad/internal/cad.h"

namespace obvid::cad {

/// What a file is made of.
struct FileContent {
  TopoDS_Shape shape;              ///< lengths in mm; in BREP files as they are
  std::string name;                ///< of the product
  std::vector<TopoDS_Face> faces;  ///< of the shape, those that have names
  std::vector<std::string> names;
};

/// The text of a file, the same bytes for the same content. `unit` is written (not in BREP files).
[[nodiscard]] Result<std::string> text_of(const FileContent& content, CadFormat format,
                                          const std::string& unit);

/// Factor from a unit to what the shape has to be in; E203 when the format does not know the unit.
[[nodiscard]] Result<double> scale_of(CadFormat format, const std::string& unit);

}  // namespace obvid::cad
