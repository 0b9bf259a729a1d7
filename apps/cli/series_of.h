// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/units.h"
#include "obvid/pipeline/import.h"

namespace obvid {

/// The points that a command is about, in the unit that the user states. Errors: those of reading.
template <class Options>
[[nodiscard]] Result<PointSeries> series_of(const Options& options) {
  const ImportOptions import = in_units(options.import, options.units);
  if constexpr (requires { options.text.has_value(); }) {
    if (options.text) return parse_series(*options.text, options.name(), import);
  }
  return read_series(options.input, import);
}

}  // namespace obvid
