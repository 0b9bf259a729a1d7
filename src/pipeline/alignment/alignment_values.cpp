// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/alignment_values.h"

#include <cmath>
#include <optional>

#include "obvid/pipeline/internal/job_values.h"

namespace obvid {
namespace {

Result<void> take_tolerance(const std::string& typed, const char* option, const char* hint,
                            std::optional<double>& length, bool& from_scatter, bool& of_digits) {
  if (typed.empty()) return {};
  if (typed == "rounding") {
    of_digits = true;
    return {};
  }
  if (typed == "auto") {
    from_scatter = true;
    return {};
  }
  const auto number = typed_number(typed);
  if (!number || !std::isfinite(*number) || !(*number > 0.0)) {
    return fail(
        bad_option("the tolerance must be a positive length, rounding or auto, not " + typed,
                   option, with_point(typed) + hint));
  }
  length = number;
  return {};
}

}  // namespace

Result<void> set_alignment(const AlignmentValues& typed, AlignmentJob& job) {
  OBVID_TRY(take_tolerance(typed.noise, "--noise", "give it in the units of the points", job.noise,
                           job.noise_from_scatter, job.noise_of_digits));
  OBVID_TRY(take_tolerance(typed.profile_noise, "--profile-noise",
                           "give it in the units of the points", job.profile_noise,
                           job.profile_noise_from_scatter, job.profile_noise_of_digits));
  if (typed.closed && typed.open) {
    return fail(bad_option("--closed and --open contradict each other", "", "give one of them"));
  }
  if (typed.closed) job.closing = Closing::kClosed;
  if (typed.open) job.closing = Closing::kOpen;
  job.without_transitions = typed.transitions == "none";
  if (!typed.transitions.empty() && !job.without_transitions) {
    const auto kind = transition_named(typed.transitions);
    if (!kind) {
      return fail(bad_option("transitions are of another kind than " + typed.transitions,
                             "--transitions",
                             "name clothoid, bloss, sine, cosine, helmert, cubic or none"));
    }
    job.transitions = *kind;
  }
  if (!typed.joints.empty() && typed.joints != "G1" && typed.joints != "G2") {
    return fail(bad_option("joints are G1 or G2, not " + typed.joints, "--joints",
                           "G2 has no steps of the curvature"));
  }
  job.without_steps = typed.joints == "G2";
  if (job.without_steps && job.without_transitions) {
    return fail(bad_option("lines and arcs alone have steps of the curvature", "--joints",
                           "leave G2 out, or --transitions none"));
  }
  if (typed.profile_curves.empty() || typed.profile_curves == "parabolas") return {};
  if (typed.profile_curves != "arcs") {
    return fail(bad_option("vertical curves are parabolas or arcs", "--profile-curves",
                           "name one of them"));
  }
  job.profile.curves = ProfileCurves::kArcs;
  return {};
}

}  // namespace obvid
