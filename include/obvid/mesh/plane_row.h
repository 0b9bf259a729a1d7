// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <string>

#include "obvid/core/result.h"
#include "obvid/geom/vec3.h"

namespace obvid {

/// Parallel planes across an axis: x, y or z = from, from + step, ... up to `to`.
struct PlaneRow {
  char axis = 'z';
  double from = 0.0, step = 1.0, to = 0.0;

  [[nodiscard]] std::size_t count() const;
  [[nodiscard]] double at(std::size_t i) const { return from + step * static_cast<double>(i); }
};

/// "z=0:0.5:100", or "z=12" for one plane. Error: E203.
[[nodiscard]] Result<PlaneRow> plane_row_named(const std::string& text);

/// "z=12": how sections are called.
[[nodiscard]] std::string plane_name(char axis, double at);

/// The plane's own coordinates, right-handed: x = c has (y, z), y = c has (z, x), z = c has (x, y).
[[nodiscard]] Frame plane_across(char axis, double at);

}  // namespace obvid
