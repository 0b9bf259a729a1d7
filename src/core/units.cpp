// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace obvid {
namespace {

/// A unit as an exact fraction of a metre; 0: it has no length in metres.
struct Row {
  std::string_view name;
  double metres = 0.0;      ///< numerator
  double divisor = 1.0;     ///< denominator
  std::string_view also{};  ///< other spellings, `plain`, between blanks
};

// Lengths by definition: inch, foot, yard and mile of 1959 (an inch is 25.4 mm exactly), US survey
// foot of 1893 (1200/3937 m).
constexpr std::array kUnits = {
    Row{"nm", 1.0, 1e9, "nanometre nanometer nanometres nanometers"},
    Row{"um", 1.0, 1e6,
        "\xC2\xB5m \xCE\xBCm micron microns micrometre micrometer micrometres micrometers"},
    Row{"mm", 1.0, 1e3, "millimetre millimeter millimetres millimeters"},
    Row{"cm", 1.0, 1e2, "centimetre centimeter centimetres centimeters"},
    Row{"dm", 1.0, 1e1, "decimetre decimeter decimetres decimeters"},
    Row{"m", 1.0, 1.0, "metre meter metres meters"},
    Row{"km", 1e3, 1.0, "kilometre kilometer kilometres kilometers"},
    Row{"mil", 254.0, 1e7, "mils thou thous"},
    Row{"in", 254.0, 1e4, "inch inches \" \xE2\x80\xB3"},
    Row{"ft", 3048.0, 1e4, "foot feet ift internationalfoot internationalfeet ' \xE2\x80\xB2"},
    Row{"usft", 1200.0, 3937.0,
        "ussurveyfoot ussurveyfeet surveyfoot surveyfeet usfoot usfeet sft ftus"},
    Row{"yd", 9144.0, 1e4, "yard yards"},
    Row{"mi", 1609344.0, 1e3, "mile miles"},
    Row{"chord", 0.0, 1.0, "chords chordlength"},
    Row{"px", 0.0, 1.0, "pixel pixels"},
    Row{"units", 0.0, 1.0, "unit none unitless"},
};

/// Lower case, without blanks, dots, hyphens and underscores.
std::string plain(std::string_view spelling) {
  std::string out;
  for (const char c : spelling) {
    if (c == ' ' || c == '\t' || c == '.' || c == '-' || c == '_') continue;
    out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return out;
}

bool stands_in(std::string_view word, std::string_view list) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(' '), list.size());
    if (list.substr(0, end) == word) return true;
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return false;
}

const Row* row_of(std::string_view spelling) {
  const std::string word = plain(spelling);
  if (spelling == "NM") return nullptr;  // nautical miles, for all that anybody knows
  for (const Row& row : kUnits) {
    if (row.name == word || stands_in(word, row.also)) return &row;
  }
  return nullptr;
}

std::string names(bool with_length) {
  std::string out;
  for (const Row& row : kUnits) {
    if ((row.metres > 0.0) != with_length) continue;
    out += (out.empty() ? "" : ", ") + std::string(row.name);
  }
  return out;
}

/// What stands in for a unit that a format cannot state. No circles.
constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kInstead = {
    {{"nm", "um"},
     {"um", "mm"},
     {"mm", "m"},
     {"cm", "m"},
     {"dm", "cm"},
     {"km", "m"},
     {"mil", "in"},
     {"in", "ft"},
     {"yd", "ft"},
     {"mi", "ft"},
     {"ft", "m"},
     {"usft", "m"}}};

constexpr std::array kSources = {"assumed", "file", "given"};

}  // namespace

const char* to_string(UnitSource source) { return kSources[static_cast<std::size_t>(source)]; }

std::optional<UnitSource> unit_source_of(std::string_view name) {
  for (std::size_t i = 0; i < kSources.size(); ++i) {
    if (name == kSources[i]) return static_cast<UnitSource>(i);
  }
  return std::nullopt;
}

std::optional<double> metres_in(std::string_view unit) { return unit_ratio(unit, "m"); }

std::optional<double> unit_ratio(std::string_view from, std::string_view to) {
  const Row *a = row_of(from), *b = row_of(to);
  if (a == nullptr || b == nullptr || !(a->metres > 0.0) || !(b->metres > 0.0)) return std::nullopt;
  // whole numbers below 2^53: one rounding
  return (a->metres * b->divisor) / (a->divisor * b->metres);
}

Result<double> unit_ratio(const Units& from, std::string_view to, std::string_view user) {
  if (const auto ratio = unit_ratio(from.name, to)) return *ratio;
  const bool known = row_of(from.name) != nullptr;
  return error(ErrorCode::kBadOption, std::string(user) + " need a unit of length, and " +
                                          (known ? "'" + from.name + "' has no length in metres"
                                                 : "the unit '" + from.name + "' is not known"))
      .where("--units")
      .hint("say what a unit is with --units: one of " + known_units());
}

std::optional<std::string> canonical_unit(std::string_view spelling) {
  const Row* row = row_of(spelling);
  return row == nullptr ? std::nullopt : std::optional(std::string(row->name));
}

std::string known_units() { return names(true); }

std::string_view unit_for_file(std::string_view unit, std::span<const std::string_view> available) {
  const Row* row = row_of(unit);
  if (row == nullptr) return {};
  std::string_view name = row->name;
  for (;;) {
    if (std::find(available.begin(), available.end(), name) != available.end()) return name;
    const auto* next = std::find_if(kInstead.begin(), kInstead.end(),
                                    [&](const auto& pair) { return pair.first == name; });
    if (next == kInstead.end()) return {};
    name = next->second;
  }
}

Result<Units> given_units(std::string_view spelling, std::string_view where) {
  if (auto name = canonical_unit(spelling)) return Units(std::move(*name), UnitSource::kGiven);
  return error(ErrorCode::kBadOption, "the unit '" + std::string(spelling) + "' is not known")
      .where(std::string(where))
      .hint("known are " + known_units() + "; and without a length in metres " + names(false));
}

Result<Units> common_units(std::span<const Units> all, std::string_view where) {
  Units out;
  for (const Units& one : all) {
    if (!one.known()) continue;
    if (out.known() && one.name != out.name) {
      return error(ErrorCode::kUnsupported,
                   "lengths are in different units: " + out.name + " and " + one.name)
          .where(std::string(where))
          .hint("write all of them in one unit");
    }
    out = one;
  }
  if (!out.known() && !all.empty()) out = all.front();
  return out;
}

std::optional<std::string> take_units(Units& units, const Units& given) {
  const Units before = std::exchange(units, given);
  if (!before.known() || before.name == given.name) return std::nullopt;
  return "the file says that lengths are in " + before.name + "; --units " + given.name +
         " is taken in its place, and nothing is converted";
}

}  // namespace obvid
