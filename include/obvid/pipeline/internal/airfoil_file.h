// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/curve/contour.h"
#include "obvid/pipeline/internal/summary.h"
#include "obvid/report/airfoil_figures.h"

namespace obvid {

/// What a .dat says by itself, as it is read: straight lines between its points, along the chord
/// from its farthest point to the middle of its ends. Nothing where it is no airfoil.
[[nodiscard]] std::optional<AirfoilPointFigures> figures_of_airfoil_file(const std::string& text);

/// The same of the first .dat among files that were written, for the line of one input of several;
/// empty where there is none among them.
[[nodiscard]] std::vector<SummaryCell> airfoil_cells(const std::vector<std::string>& files);

/// "one side ends 5.127 % of the chord before the other one, as where a file lacks its last point";
/// empty where both sides end beside each other. `side` says which one, `gap` how far, chords.
[[nodiscard]] std::string side_ends_text(const std::string& side, double gap);

/// Points of an airfoil from trailing edge to trailing edge: where a closed contour begins there,
/// its first point ends the list, too.
[[nodiscard]] std::vector<Vec2> airfoil_points_around(const Contour& contour,
                                                      const AirfoilFigures& figures);

}  // namespace obvid
