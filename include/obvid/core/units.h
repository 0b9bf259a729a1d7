// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "obvid/core/result.h"

namespace obvid {

inline constexpr double kFullTurn = 2.0 * std::numbers::pi;   ///< rad
inline constexpr double kOneDegree = std::numbers::pi / 180;  ///< rad

/// How the unit of lengths became known.
enum class UnitSource {
  kAssumed,  ///< nobody said: millimetres, or what a hint in the file makes likely
  kFile,     ///< the file says it
  kGiven,    ///< the user says it
};

/// Name in reports and files: assumed, file, given.
[[nodiscard]] const char* to_string(UnitSource source);
/// Source of this name.
[[nodiscard]] std::optional<UnitSource> unit_source_of(std::string_view name);

/// Unit of all lengths of a series, a contour, a drawing or a surface, and how it is known. A name
/// by itself is one that is known: `contour.units = "mm"`.
struct Units {
  std::string name = "mm";
  UnitSource source = UnitSource::kAssumed;

  Units() = default;
  Units(std::string unit, UnitSource from = UnitSource::kFile)
      : name(std::move(unit)), source(from) {}
  Units(const char* unit, UnitSource from = UnitSource::kFile) : name(unit), source(from) {}

  [[nodiscard]] bool known() const { return source != UnitSource::kAssumed; }
  /// What is printed behind a length: the name, and "units" while it is merely assumed.
  [[nodiscard]] std::string text() const { return known() ? name : "units"; }

  friend bool operator==(const Units& a, const Units& b) = default;
};

/// Metres in a unit, by any of its spellings ("mm", "millimetres", "US survey foot"). Nothing for
/// names that are not known, and for units without a length in metres: chord, px, units.
[[nodiscard]] std::optional<double> metres_in(std::string_view unit);

/// Lengths in `from` times this are lengths in `to`, correctly rounded. Nothing where one of them
/// has no length in metres.
[[nodiscard]] std::optional<double> unit_ratio(std::string_view from, std::string_view to);

/// The same for a unit that must have a length, whether it is known or merely assumed. Error E203:
/// `user` ("STEP files") need a length, and the unit has none.
[[nodiscard]] Result<double> unit_ratio(const Units& from, std::string_view to,
                                        std::string_view user);

/// The one spelling under which a unit is stored and printed; nothing when it is not known. Case,
/// blanks, dots, hyphens and underscores do not matter; only NM (nautical miles?) is no nanometre.
[[nodiscard]] std::optional<std::string> canonical_unit(std::string_view spelling);

/// "nm, um, mm, ...": all that have a length, for messages.
[[nodiscard]] std::string known_units();

/// The unit in which a file of lengths in `unit` is written that can state no others than
/// `available`: itself where it is among them, else the next one of its system, which every format
/// has. Empty where there is none.
[[nodiscard]] std::string_view unit_for_file(std::string_view unit,
                                             std::span<const std::string_view> available);

/// The unit that a user states. Error E203 when it is not known; `where` names the option.
[[nodiscard]] Result<Units> given_units(std::string_view spelling, std::string_view where);

/// Takes the unit that the user states in place of the one that is there: nothing is converted. A
/// sentence for the user when the file says otherwise.
[[nodiscard]] std::optional<std::string> take_units(Units& units, const Units& given);

/// The unit of things that belong together: the one that is known, assumed when none is. Error
/// E310 when two are known and differ; `where` names the place.
[[nodiscard]] Result<Units> common_units(std::span<const Units> all, std::string_view where);

}  // namespace obvid
