// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS_Shape.hxx>
#include <string>
#include <vector>

#include "obvid/core/result.h"

namespace obvid::cad {

/// All that a file holds, and what its faces are called there.
struct Loaded {
  TopoDS_Shape shape;
  std::vector<std::string> names;
  TopTools_DataMapOfShapeInteger number_of_name;

  /// Empty when the file has no name for it.
  [[nodiscard]] std::string name_of(const TopoDS_Shape& face) const {
    const int* found = number_of_name.Seek(face);
    return found != nullptr ? names[static_cast<std::size_t>(*found)] : std::string{};
  }
};

/// A STEP, IGES or BREP file, by its first bytes. Errors: E301, E306.
[[nodiscard]] Result<Loaded> load(const std::string& path);

}  // namespace obvid::cad
