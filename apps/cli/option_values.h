// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/pipeline/fit.h"

namespace obvid {

/// Options whose values are more than one number or word, as they were typed.
struct TypedValues {
  std::string noise;
  std::string start_heading, end_heading;  ///< degrees, or `natural`
  std::optional<double> start_radius, end_radius;
  std::optional<double> corner_angle_deg;
  std::vector<std::string> heading_at, radius_at, kappa_at;  ///< "I=VALUE", I from 1
  std::vector<std::string> corner_at;                        ///< "I"
  bool closed = false;
  bool open = false;
  bool no_corners = false;
};

[[nodiscard]] Error bad_option(std::string what, std::string where, std::string hint);

/// Puts them into `job`. Errors: E203 with the option's name.
[[nodiscard]] Result<void> set_values(const TypedValues& typed, FitJob& job);

}  // namespace obvid
