// SPDX-License-Identifier: Apache-2.0
#include "file_units.h"

#include <fmt/format.h>

namespace obvid::pipeline_detail {
namespace {

Error assumed(const Units& units, std::string_view kind) {
  return {ErrorCode::kBadOption,
          fmt::format("{} have true lengths, and nothing says what a unit is", kind),
          "--units",
          fmt::format("say it with --units m, or another of {}", known_units()),
          -1,
          metres_in(units.name).value_or(0.0)};
}

}  // namespace

Result<UnitNotes> unit_notes(const Units& units, UnitRule rule, std::string_view kind,
                             std::string_view written) {
  UnitNotes notes;
  if (rule == UnitRule::kNone) return notes;
  if (rule == UnitRule::kStated) {
    if (written.empty()) notes.remarks.push_back(fmt::format("no unit is stated in {}", kind));
    return notes;
  }
  if (auto length = unit_ratio(units, "m", kind); !length) return fail(length.error());
  if (!units.known() && rule == UnitRule::kRoad) return fail(assumed(units, kind));
  if (!units.known()) {
    notes.warnings.push_back(
        fmt::format("nothing says what a unit is: {} assumed, as {} need one; --units says it",
                    units.name, kind));
  }
  if (written != units.name) {
    notes.remarks.push_back(fmt::format("lengths were converted from {} to {}", units.name, written));
  }
  return notes;
}

}  // namespace obvid::pipeline_detail
