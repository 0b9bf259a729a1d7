// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/chain/series_chain.h"
#include "obvid/core/watch.h"
#include "prepare.h"

namespace obvid::pipeline_detail {

/// Elements of one section; `chain.source` counts the points of the whole series. A smooth loop
/// ends with its first element again.
struct SectionChain {
  SeriesChain chain;
  std::vector<std::string> warnings;
};

/// Headings and curvatures for a section: through its points, or within their tolerances with few
/// vertices. Errors: E401, E402, E403, E404, E405, naming points of the whole series.
[[nodiscard]] Result<SectionChain> chain_section(const Prepared& series, const Section& section,
                                                 Watch& watch);

}  // namespace obvid::pipeline_detail
