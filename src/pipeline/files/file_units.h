// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/units.h"
#include "obvid/curve/pieces.h"
#include "obvid/pipeline/file_formats.h"

namespace obvid::pipeline_detail {

/// What is to be said of the units of a file.
struct UnitNotes {
  std::vector<std::string> remarks;
  std::vector<std::string> warnings;
};

/// By the rule of the format (formats.inc); for pictures that are drawings in true scale. Error
/// E203 where a unit without a length, or an assumed one, is refused.
[[nodiscard]] Result<UnitNotes> unit_notes(const Units& units, FileFormat format);

/// Whether a CAD kernel keeps the shape of something of this size. Error E309 with `instead`, what
/// else can be done. `plain`: the format has no unit, numbers are taken for millimetres.
[[nodiscard]] Result<void> kernel_holds(double size, const Units& units, bool plain,
                                        std::string_view instead);

/// What is to be said where single pieces are below the precision of CAD kernels.
[[nodiscard]] std::optional<std::string> below_kernels(const std::vector<Piece>& pieces,
                                                       const Units& units, bool plain);

}  // namespace obvid::pipeline_detail
