// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/construction_values.h"

#include "obvid/pipeline/internal/job_values.h"
#include "obvid/pipeline/internal/refusal.h"

namespace obvid {
namespace {

struct TangentChoice {
  TangentRule rule;
  Prefer prefer;
};

Result<TangentChoice> tangents_named(const std::string& typed) {
  return value_named<TangentChoice>(
      {{"fair", {TangentRule::kFair, Prefer::kFair}},
       {"centre", {TangentRule::kCentral, Prefer::kFair}},
       {"neighbours", {TangentRule::kNeighbours, Prefer::kFair}},
       {"least-change", {TangentRule::kFair, Prefer::kLeastChange}},
       {"least-curvature", {TangentRule::kFair, Prefer::kLeastCurvature}}},
      typed, "--prefer");
}

Result<Construction> construction_named(const std::string& typed) {
  return value_named<Construction>({{"arcs", Construction::kArcs},
                                    {"ellipses", Construction::kEllipses},
                                    {"clothoids", Construction::kClothoids},
                                    {"spline", Construction::kSpline},
                                    {"parabolas", Construction::kParabolas}},
                                   typed, "--construction");
}

/// Orders are those of parabolas.
Result<void> check_fixation(const TypedConstruction& typed) {
  if (!typed.fixation) return {};
  if (*typed.fixation == 0) {
    return fail(bad_option("order 0 leaves tangents and radii free", "--fixation",
                           "`fit --carrier beziers` forms such chains"));
  }
  if (*typed.fixation != 1 && *typed.fixation != 2) {
    return fail(bad_option("the order is 1 (tangents) or 2 (radii too)", "--fixation", ""));
  }
  if (typed.name == "parabolas") return {};
  return fail(
      bad_option("an order belongs to parabolas", "--fixation", "add --construction parabolas"));
}

}  // namespace

Result<RegionJob> construction_values(const TypedConstruction& typed) {
  if (auto done = check_fixation(typed); !done) return fail(done.error());
  RegionJob job;
  if (!typed.name.empty()) {
    const auto made = construction_named(typed.name);
    if (!made) return fail(made.error());
    job.construction = *made;
    if (typed.fixation) job.fixation = static_cast<int>(*typed.fixation);
  }
  const auto choice = tangents_named(typed.prefer);
  if (!choice) return fail(choice.error());
  job.rule = choice->rule;
  job.job.prefer = choice->prefer;
  for (const long segment : typed.insert) {
    if (segment < 1) return fail(bad_option("segments count from 1", "--insert", ""));
    job.insert.push_back(static_cast<std::size_t>(segment - 1));
  }
  return job;
}

RegionJob with_job(RegionJob construction, const FitJob& job) {
  const Prefer prefer = construction.job.prefer;
  construction.job = job;
  construction.job.prefer = prefer;
  return construction;
}

Error explained(const PointSeries& series, const RegionJob& job, const Error& error,
                const RunContext& run) {
  if (error.code != ErrorCode::kFixedDataContradict) return error;
  const auto range = explain_refusal(series, job.job, error, run);
  return range ? range->error : error;
}

}  // namespace obvid
