// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/io/internal/json_text.h"
#include "obvid/pipeline/alignment_job.h"

namespace obvid::pipeline_detail {

/// End and elements of a profile, within an object.
void add_profile_elements(JsonText& json, const VerticalProfile& profile);

/// The profile of a report as an object.
void add_profile(JsonText& json, const ProfileReport& report);

}  // namespace obvid::pipeline_detail
