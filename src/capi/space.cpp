// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "door.h"
#include "handles.h"
#include "obvid/io/read_points.h"
#include "obvid/pipeline/internal/can_write.h"
#include "obvid/pipeline/internal/space_values.h"
#include "options.h"

namespace obvid::capi {
namespace {

constexpr Known kSpace{.fit = true, .space = true, .points = true};
constexpr Known kSpaceFiles{.formats = true};

/// Points of an array, of equal neighbours one.
Result<SpaceSeries> for_a_curve(SpaceSeries series) {
  constexpr std::size_t kFewest = 3;
  auto& points = series.points;
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() >= kFewest) return series;
  return fail({ErrorCode::kTooFewPoints, "a curve in space needs 3 distinct points", "", ""});
}

Result<SpaceSeries> space_series_of(const obvid_input& input, const Request& request) {
  OBVID_TRY(check_space_import(request.import));
  if (input.space) {
    SpaceSeries given = *input.space;
    place(request.import.placement, given);
    return for_a_curve(std::move(given));
  }
  if (!input.points && !input.by_path) {
    auto found =
        parse_space_series(input.text, input.name, request.along.has_value(), request.import);
    OBVID_TRY(found);
    if (*found) return std::move(**found);
  }
  return fail({ErrorCode::kBadOption, "there are no points x, y, z whose z changes", input.name,
               "obvid_fit forms contours of the plane"});
}

Result<SpaceJob> space_job_of(const obvid_input& input, const SpaceSeries& series,
                              const Request& request) {
  SpaceJob job;
  job.fit = request.job;
  job.along = request.along;
  if (input.space) return job;
  auto fixed = fixed_in_space(series, input.text, request.along, input.name, request.import);
  OBVID_TRY(fixed);
  job.fixed = std::move(*fixed);
  return job;
}

/// What a file of the curves would say of them.
Result<StoredSpaceChain> as_stored(const obvid_space& space, const RunContext& run) {
  if (space.stored) return *space.stored;
  const auto nurbs = chain_nurbs(space.chain, std::nullopt, run);
  OBVID_TRY(nurbs);
  return space_chain_from_json(space_chain_json(space.chain, *nurbs), "curve");
}

}  // namespace
}  // namespace obvid::capi

using namespace obvid;
using namespace obvid::capi;

extern "C" {

int obvid_fit_space(const obvid_input* input, const char* options, const obvid_run* run,
                    obvid_space** space, char** report, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const Result<Request> request = request_of(options, kSpace);
    OBVID_TRY(request);
    Result<SpaceSeries> series = space_series_of(*input, *request);
    OBVID_TRY(series);
    if (request->units) series->units = *request->units;
    const Result<SpaceJob> job = space_job_of(*input, *series, *request);
    OBVID_TRY(job);
    const RunContext context = context_of(run);
    Result<SpaceChain> made = fit_space_chain(*series, *job, context);
    OBVID_TRY(made);
    const std::optional<Error> broken = broken_promise(*made);
    std::string text;
    if (report != nullptr) {
      const auto nurbs = chain_nurbs(*made, std::nullopt, context);
      OBVID_TRY(nurbs);
      text = space_chain_json(*made, *nurbs);
    }
    auto out = std::make_unique<obvid_space>();
    out->chain = std::move(*made);
    if (report != nullptr) *report = text_of(text);
    if (space != nullptr) *space = out.release();
    if (broken) return fail(*broken);
    return {};
  });
}

int obvid_stored_space(const obvid_input* input, obvid_space** space, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    auto stored = space_chain_from_json(input->text, input->name);
    OBVID_TRY(stored);
    auto out = std::make_unique<obvid_space>();
    out->chain = space_chain_of(*stored);
    out->stored = std::move(*stored);
    *space = out.release();
    return {};
  });
}

int obvid_verify_space(const obvid_space* space, const obvid_run* run, char** report,
                       obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const RunContext context = context_of(run);
    const auto stored = as_stored(*space, context);
    OBVID_TRY(stored);
    const Result<SpaceChainVerification> found = verify(*stored, context);
    OBVID_TRY(found);
    if (report != nullptr) *report = text_of(space_verification_json(*stored, *found));
    if (const auto broken = broken_promise(*stored, *found)) return fail(*broken);
    return {};
  });
}

size_t obvid_space_parts(const obvid_space* space) { return space->chain.parts.size(); }

int obvid_space_closed(const obvid_space* space) {
  const SpaceChain& chain = space->chain;
  const bool one = chain.corners.empty() && chain.parts.front().plan.contour.closed;
  return chain.closed || one ? 1 : 0;
}

double obvid_space_length(const obvid_space* space, size_t part) {
  double length = 0.0;
  (void)guarded(nullptr, [&]() -> Result<void> {
    if (part < space->chain.parts.size()) length = length_of(space->chain.parts[part]);
    return {};
  });
  return length;
}

const char* obvid_space_warning(const obvid_space* space, size_t warning) {
  const auto& warnings = space->chain.warnings;
  return warning < warnings.size() ? warnings[warning].c_str() : nullptr;
}

int obvid_space_evaluate(const obvid_space* space, size_t part, const double* at, size_t n,
                         double* xyz, double* tangent, double* curvature, double* torsion,
                         obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    if (part >= space->chain.parts.size()) {
      return obvid::error(ErrorCode::kBadOption, "there is no such part")
          .where("part")
          .value(static_cast<double>(part));
    }
    const auto found = sample_space(space->chain.parts[part], {at, n});
    OBVID_TRY(found);
    const auto put = [](double* to, std::size_t i, Vec3 v) {
      if (to == nullptr) return;
      to[3 * i] = v.x;
      to[3 * i + 1] = v.y;
      to[3 * i + 2] = v.z;
    };
    for (std::size_t i = 0; i < n; ++i) {
      const SpaceSample& one = (*found)[i];
      put(xyz, i, one.point);
      put(tangent, i, one.tangent);
      if (curvature != nullptr) curvature[i] = one.curvature;
      if (torsion != nullptr) {
        torsion[i] = one.torsion.value_or(std::numeric_limits<double>::quiet_NaN());
      }
    }
    return {};
  });
}

int obvid_space_export(const obvid_space* space, const char* ending, const char* options,
                       const obvid_run* run, obvid_files** files, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const Result<Request> request = request_of(options, kSpaceFiles);
    OBVID_TRY(request);
    SpaceChain chain = space->chain;
    if (request->units) (void)take_units(chain, *request->units);
    const RunContext context = context_of(run);
    OBVID_TRY(can_write_curves(space_format_of("." + std::string(ending))));
    const auto nurbs = chain_nurbs(chain, request->formats.tolerance, context);
    OBVID_TRY(nurbs);
    Result<Exported> made =
        export_space(chain, *nurbs, "." + std::string(ending), request->formats, context);
    OBVID_TRY(made);
    auto out = std::make_unique<obvid_files>();
    out->files = std::move(made->files);
    out->remarks = std::move(made->remarks);
    *files = out.release();
    return {};
  });
}

void obvid_space_free(obvid_space* space) { delete space; }
}
