// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <pugixml.hpp>

#include "obvid/alignment/profile.h"
#include "xml_text.h"

namespace obvid::exchange {

/// The profile of an Alignment of LandXML: its first ProfAlign with grades between PVIs, and
/// ParaCurve, UnsymParaCurve or CircCurve where they meet; a corner has none. Stations and heights
/// as stated. Nothing, with a warning, where curves overlap or arcs and parabolas are mixed.
[[nodiscard]] std::optional<VerticalProfile> landxml_profile(pugi::xml_node alignment,
                                                             XmlWarnings& warnings);

/// The elevations of a road of OpenDRIVE: grades and parabolas; with cubics among them grades and
/// arcs of circles, where all follow such arcs, and a warning says within what. Corners stay.
/// Nothing where all are 0, and, with a warning, where a cubic is neither or the height jumps. What
/// lies beyond the end of the road is left out, with a warning.
[[nodiscard]] std::optional<VerticalProfile> opendrive_profile(pugi::xml_node road,
                                                               XmlWarnings& warnings);

}  // namespace obvid::exchange
