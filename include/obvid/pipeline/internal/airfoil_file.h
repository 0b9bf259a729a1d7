// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/pipeline/internal/summary.h"
#include "obvid/report/airfoil_figures.h"

namespace obvid {

/// What a .dat says by itself, as it is read: straight lines between its points, along the chord
/// from its farthest point to the middle of its ends. Nothing where it is no airfoil.
[[nodiscard]] std::optional<AirfoilPointFigures> figures_of_airfoil_file(const std::string& text);

/// The same of the first .dat among files that were written, for the line of one input of several;
/// empty where there is none among them.
[[nodiscard]] std::vector<SummaryCell> airfoil_cells(const std::vector<std::string>& files);

}  // namespace obvid
