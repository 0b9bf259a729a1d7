// SPDX-License-Identifier: Apache-2.0
// Checks of `region`: its tables in JSON, CSV and text, and its constructions.
#pragma once

#include <string>

#include "course.h"
#include "sheet.h"
#include "worksheet.h"

namespace judge {

/// Every figure of both tables. `by_neighbours`: headings follow from the neighbours alone and may
/// lie outside of what is left to them.
void check_worksheet(const Worksheet& worksheet, const Input& input, bool by_neighbours,
                     Sheet& sheet);
/// The printed tables and those of the `.csv` file against the JSON.
void check_region_text(const Worksheet& worksheet, const std::string& text, Sheet& sheet);
void check_region_csv(const Worksheet& worksheet, const std::string& csv, Sheet& sheet);
/// The tables in LaTeX.
void check_region_tex(const Worksheet& worksheet, const std::string& tex, Sheet& sheet);
/// Both drawings, of the last table.
void check_region_drawings(const Worksheet& worksheet, const Input& input, const std::string& dxf,
                           const std::string& svg, const std::string& unit, Sheet& sheet);

/// The table of a construction, "arcs" to "parabolas", over the segments of the last table.
void check_construction(const Worksheet& worksheet, const Input& input, const std::string& name,
                        Sheet& sheet);
/// The same against the contour that `fit --construction` made.
void check_constructed(const Worksheet& worksheet, const Input& input, const std::string& name,
                       const Course& contour, Sheet& sheet);
/// The table printed and as `.csv`.
void check_construction_csv(const Worksheet& worksheet, const std::string& csv, Sheet& sheet);
void check_construction_text(const Worksheet& worksheet, const std::string& text, Sheet& sheet);

}  // namespace judge
