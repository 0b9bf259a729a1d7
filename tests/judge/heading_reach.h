// SPDX-License-Identifier: Apache-2.0
// Whether headings and curvatures at all points go with one heading of a table of `region`.
#pragma once

#include <cstddef>

#include "worksheet.h"

namespace judge {

/// Whether headings of the other points, and curvatures of all, were found with which spirals exist
/// over every chord while point `i` of an open section has heading `theta`: the directions, what is
/// given and the signs of the curvatures at the points are those of the table. A search: what it
/// finds exists (the condition for a spiral holds over every chord), what it does not find may.
bool found_with_heading(const SheetPart& part, const Input& input, std::size_t i, Real theta);

}  // namespace judge
