// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/units.h"
#include "obvid/curve/pieces.h"

namespace obvid::pipeline_detail {

/// What a kind of file does with a unit (docs/formats.md, "Units").
enum class UnitRule {
  kNone,    ///< it states the one that we have, assumed or not
  kLost,    ///< it has no place for one, and readers take millimetres
  kStated,  ///< it states a unit that is known, and none otherwise
  kLength,  ///< it has true lengths: a unit that is merely assumed is worth a warning
  kRoad,    ///< it is in metres or feet of the ground: an assumed unit is refused
};

/// What is to be said of the units of a file.
struct UnitNotes {
  std::vector<std::string> remarks;
  std::vector<std::string> warnings;
};

/// `kind`: "STEP files"; `written`: the unit of the numbers in the file. Error E203 where a unit
/// without a length, or an assumed one, is refused.
[[nodiscard]] Result<UnitNotes> unit_notes(const Units& units, UnitRule rule,
                                           std::string_view kind, std::string_view written);

/// Whether a CAD kernel keeps the shape of something of this size. Error E309 with `instead`, what
/// else can be done. `plain`: the format has no unit, numbers are taken for millimetres.
[[nodiscard]] Result<void> kernel_holds(double size, const Units& units, bool plain,
                                        std::string_view instead);

/// What is to be said where single pieces are below the precision of CAD kernels.
[[nodiscard]] std::optional<std::string> below_kernels(const std::vector<Piece>& pieces,
                                                       const Units& units, bool plain);

}  // namespace obvid::pipeline_detail
