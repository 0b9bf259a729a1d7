// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/pipeline/nurbs_job.h"
#include "obvid/pipeline/spline_job.h"

namespace obvid {

/// Options of `obvid spline` as they were typed.
struct SplineValues {
  std::optional<long> degree;  ///< [2, of curves 4]
  std::string smooth;          ///< none, values-kept, values-free; empty: by the degree
  std::optional<double> tolerance;
};

/// Puts them into `job`, whose `curve` is set. Errors: E203 with the option's name.
[[nodiscard]] Result<void> set_spline(const SplineValues& typed, SplineJob& job);

/// Options of `obvid nurbs` as they were typed.
struct NurbsValues {
  std::optional<long> degree, degree_v;     ///< [3]
  std::string knots, knots_v;               ///< "0,0,1,2,2"; empty: uniform
  std::vector<std::string> weights, moves;  ///< "I=VALUE", I from 1
};

/// Puts them into `job`. Errors: E203 with the option's name.
[[nodiscard]] Result<void> set_nurbs(const NurbsValues& typed, NurbsJob& job);

/// Rows of a table of samples where nobody says how many.
inline constexpr long kRowsOfSamples = 200;

/// Rows of a table of samples. Error: E203 fewer than 2 or more than 10,000,000.
[[nodiscard]] Result<std::size_t> rows_of_samples(long rows);

}  // namespace obvid
