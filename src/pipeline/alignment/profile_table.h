// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/io/internal/json_text.h"
#include "obvid/pipeline/alignment_job.h"

namespace obvid::pipeline_detail {

/// The profile of a report as an object.
void add_profile(JsonText& json, const ProfileReport& report);

}  // namespace obvid::pipeline_detail
