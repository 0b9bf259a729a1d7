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

Result<void> kernel_holds(double size, const Units& units, bool plain, std::string_view instead) {
  // kernels take points nearer than 1e-7 mm for one: a thousand times that is the least that keeps
  // its shape, and doubles of 1e8 the largest with steps below it
  constexpr double kLeast = 1e-4, kMost = 1e8;
  const double held = plain ? size : size * unit_ratio(units.name, "mm").value_or(1.0);
  if (held >= kLeast && held <= kMost) return {};
  return fail({ErrorCode::kSizeOutOfRange,
               fmt::format("{:.3g} {} across: CAD kernels hold {:g} to {:g}", held,
                           plain ? "units" : "mm", kLeast, kMost),
               "", fmt::format("choose another unit, or {}", instead), -1, held});
}

}  // namespace obvid::pipeline_detail
