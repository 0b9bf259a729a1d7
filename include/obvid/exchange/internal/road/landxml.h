// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/alignment/profile.h"
#include "obvid/alignment/transition.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/exchange/drawing.h"

namespace obvid {

/// The CoordGeom of alignments, parcels and plan features of a LandXML file (1.0 to 2.0), one curve
/// each, with its name and first station: Line, Curve and clothoid Spiral exactly, x east and y
/// north (the file has northing first); IrregularLine as lines and as a series of points. Units are
/// those of the file; metres are assumed, with a warning, where it names none.
///
/// A Curve has the stated radius and is placed by its start and end (from 1 rad on, by its centre);
/// a Spiral has the stated length and radii and points where start and end want it. Where they end
/// elsewhere than stated, a warning gives the largest distance. Spirals of type bloss, sinusoid,
/// cosine and biquadratic are clothoids within 1e-7 of their length, and named in `transitions`.
/// Elements that are left out (spirals of other kinds, radii <= 0, unreadable coordinates, missing
/// parts) are named, and a new curve begins behind them. The first profile is read (PVI, ParaCurve,
/// UnsymParaCurve, CircCurve); cant is said to be not used; surfaces and pipes are not used.
///
/// Linear time. Errors: E308 XML that is not well-formed (truncated files), E310 another kind of
/// XML, E311 no CoordGeom with a curve. Never throws on any input. `name` stands in errors. Source:
/// LandXML 1.2 schema; docs/methods/road_formats.md, section 3.
[[nodiscard]] Result<Drawing> parse_landxml(std::string_view text, std::string_view name);

struct LandXmlOptions {
  std::string name = "contour";
  std::string date = "1970-01-01";  ///< the format wants one; the same input gives the same bytes
  std::string time = "00:00:00";
  double first_station = 0.0;  ///< of the start, units of the contour
  std::optional<VerticalProfile>
      profile{};  ///< of heights, stations as from `first_station`, units of the
                  ///< contour: a ProfAlign of PVI, ParaCurve and CircCurve
  std::vector<PlacedTransition> transitions{};  ///< written as a Spiral of their kind each, but for
                                                ///< those through an inflection: as clothoids,
                                                ///< cubic parabolas as two of their kind
};

/// The unit of a LandXML file for lengths in `unit`: itself where the format knows it (mm, cm, m,
/// km, in, ft, usft, mi), else the next one of its system. Empty for units without a length.
[[nodiscard]] std::string_view landxml_unit(std::string_view unit);

/// A LandXML 1.2 file with the contour as one Alignment in its unit, or in the next one that the
/// format knows: Line, Curve and clothoid Spiral elements. Exactly; spirals through an inflection
/// and those that turn by more than a right angle are cut into parts, because the format has one
/// direction of rotation for each, and tangents that must meet; so are arcs of more than half a
/// turn. Errors: those of `road_lines`
/// (other pieces than lines, arcs and clothoids: E310).
[[nodiscard]] Result<std::string> landxml_text(const Contour& contour,
                                               const LandXmlOptions& options = {});

}  // namespace obvid
