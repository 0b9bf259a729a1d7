// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/chain/internal/series_chain.h"
#include "obvid/core/result.h"
#include "obvid/core/internal/watch.h"
#include "obvid/curve/contour.h"

namespace obvid::contour_detail {

/// A section in its carrier, and what is to be said about it. Runs are those that its carrier
/// promises; of one that promises none they are for others to find.
struct Carried {
  Contour contour;
  std::vector<std::string> warnings{};
};

/// What a section is formed with. Lengths in units of its points, headings in rad.
struct CarryOptions {
  const std::vector<Vec2>& points;  ///< of the whole series
  const SeriesChain& chain;         ///< elements over the section (`CarrierNeeds::kElements`)
  const std::vector<GivenDatum>& given;
  double tolerance = 0.0;  ///< of regions, and of the distance from the spirals
  bool loop = false;       ///< the end is the start
  std::optional<double> start_heading{}, end_heading{};  ///< given (`CarrierNeeds::kPoints`)
  Watch& watch;
};

/// Forms a section. `spirals`: by `CarrierInfo::needs` those over the same elements; joints alone,
/// of which points and sources count; or nothing.
using Carry = Result<Carried> (*)(const Contour& spirals, const CarryOptions& options);

#define OBVID_CARRIER(enumerator, name, ...) \
  Result<Carried> carry_##name(const Contour& spirals, const CarryOptions& options);
#define OBVID_CARRIER_AS_DRAWN(...)
#include "obvid/curve/carriers.inc"
#undef OBVID_CARRIER
#undef OBVID_CARRIER_AS_DRAWN

/// Builders in the order of their carriers; none of what only drawings have.
inline constexpr std::array<Carry, kCarriers.size()> kBuilders = {
#define OBVID_CARRIER(enumerator, name, ...) &carry_##name,
#define OBVID_CARRIER_AS_DRAWN(...) nullptr,
#include "obvid/curve/carriers.inc"
#undef OBVID_CARRIER
#undef OBVID_CARRIER_AS_DRAWN
};

[[nodiscard]] constexpr Carry builder_of(Carrier carrier) {
  return kBuilders[static_cast<std::size_t>(carrier)];
}

}  // namespace obvid::contour_detail
