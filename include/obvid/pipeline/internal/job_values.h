// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/geom/internal/value_range.h"
#include "obvid/pipeline/fit.h"

namespace obvid {

// Options as users type or write them, made into jobs: one reading of them for all front ends.
// Errors name options as the command line does, `--noise`.

/// Options whose values are more than one number or word, as they were typed.
struct TypedValues {
  std::string noise;
  std::string start_heading, end_heading;  ///< degrees, a range "40..45", or `natural`
  std::string start_radius, end_radius;    ///< a number, or a range "20..30", "20..", "..30"
  std::optional<double> corner_angle_deg;
  std::vector<std::string> heading_at, radius_at, kappa_at;  ///< "I=VALUE" or "I=LOW..HIGH",
                                                             ///< I from 1
  std::vector<std::string> corner_at;                        ///< "I"
  bool closed = false;
  bool open = false;
  bool no_corners = false;
  std::string continuity;  ///< "G2", "G3", or empty: as FitJob has it
  std::string prefer = "fair";
};

[[nodiscard]] Error bad_option(std::string what, std::string where, std::string hint);

/// E203: `typed` is none of the names that an option knows.
[[nodiscard]] Error unknown_name(const std::string& typed, const std::vector<std::string>& names,
                                 const char* option);

/// What a name stands for. Error: E203 with the nearest name.
template <class Value>
[[nodiscard]] Result<Value> value_named(const std::map<std::string, Value>& values,
                                        const std::string& typed, const char* option) {
  const auto at = values.find(typed);
  if (at != values.end()) return at->second;
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.push_back(name);
  return fail(unknown_name(typed, names, option));
}

/// The whole text as a number; nothing for anything else.
[[nodiscard]] std::optional<double> typed_number(std::string_view text);
/// Advice for a number with a decimal comma; nothing for other words.
[[nodiscard]] std::string with_point(std::string typed);

/// "20..30", "20.." or "..30"; nothing for anything else, and where no value is between.
[[nodiscard]] std::optional<ValueRange> typed_range(std::string_view text);

/// The carrier of a name. Error: E203.
[[nodiscard]] Result<Carrier> carrier_named(const std::string& typed);

/// Puts the tolerance of the region into `job`. Error: E203 when it is no positive length.
[[nodiscard]] Result<void> set_tolerance(const std::optional<double>& tolerance, FitJob& job);

/// Whether the job itself gives headings, or ranges of them, at the ends of two points.
[[nodiscard]] bool has_both_headings(const FitJob& job);

/// Puts them into `job`. Errors: E203 with the option's name.
[[nodiscard]] Result<void> set_values(const TypedValues& typed, FitJob& job);

}  // namespace obvid
