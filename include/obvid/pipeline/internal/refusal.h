// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "obvid/core/run_context.h"
#include "obvid/pipeline/feasible_range.h"
#include "obvid/pipeline/why_not.h"

namespace obvid {

/// A refused job, with what would do in its place.
struct Refusal {
  Error error;  ///< the refusal, what would do in its hint
  std::optional<WhyNot> why;
  std::optional<FeasibleRange> range;
};

/// What `why_not` and `feasible_range` find for a job that `fit` refused. Error: E103.
[[nodiscard]] Result<Refusal> explain_refusal(const PointSeries& series, const FitJob& job,
                                              const Error& refusal, const RunContext& run);

/// Digits of tolerances that are advised, so that they can be typed again.
inline constexpr int kAdvisedDigits = 3;

/// What the points would have to move within: "a tolerance of 0.01 mm".
[[nodiscard]] std::string room_within(const WhyNot& why, const std::string& units);

/// "3 vertices and 1 inflection"
[[nodiscard]] std::string counts_of_fit(const Fit& fit);
/// "allows them", of an option and those vertices and inflections; "forms it" where there are none.
[[nodiscard]] const char* what_option_does(const Fit& fit);

/// The option that the advice is.
[[nodiscard]] std::string advised_option(const WhyNot& why, const PointSeries& series);

/// "--noise 0.01", as it was tried: with " --open" where the ends would meet within it, and with a
/// word where points have a smaller tolerance of their own, which `--noise` does not widen.
[[nodiscard]] std::string noise_option(double tolerance, bool closed, const PointSeries& series);
/// The same for the rounding of the file's digits.
[[nodiscard]] std::string rounding_option(bool closed, const PointSeries& series);

}  // namespace obvid
