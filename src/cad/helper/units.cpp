// SPDX-License-Identifier: Apache-2.0
#include "units.h"

#include <array>

#include "obvid/cad/internal/cad.h"
#include "obvid/core/units.h"

namespace obvid::cad {
namespace {

/// The kernel's names of `kCadUnits`, in the same order.
constexpr std::array<const char*, kCadUnits.size()> kKernelNames = {"UM",  "MM",   "CM", "M", "KM",
                                                                    "MIL", "INCH", "FT", "MI"};

}  // namespace

Result<Unit> unit_of(const std::string& name) {
  const auto millimetres = unit_ratio(Units(name), "mm", "STEP and IGES files");
  if (!millimetres) return fail(millimetres.error());
  const std::string_view written = cad_unit(name);
  Unit unit{"MM", *millimetres};
  for (std::size_t i = 0; i < kCadUnits.size(); ++i) {
    if (kCadUnits[i] == written) unit.kernel = kKernelNames[i];
  }
  return unit;
}

}  // namespace obvid::cad
