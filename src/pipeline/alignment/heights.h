// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/pipeline/alignment_job.h"

namespace obvid::pipeline_detail {

/// How far an alignment may pass all points without a tolerance of their own, units; a remark where
/// it is estimated. Errors: E302, E304 where it cannot be, `where` names the option.
[[nodiscard]] Result<double> estimated_noise(const std::vector<Vec2>& points, const Units& units,
                                             const char* option, std::vector<std::string>& remarks);

/// The profile of the heights of a file or of the points, with which `stations` they have; nothing
/// where there are none. Errors: those of `fit_profile`, E203 a tolerance that is none.
[[nodiscard]] Result<std::optional<ProfileReport>> profile_report(const PointSeries& series,
                                                                  const Alignment& alignment,
                                                                  const AlignmentJob& job,
                                                                  std::vector<std::string>& remarks,
                                                                  const RunContext& run);

}  // namespace obvid::pipeline_detail
