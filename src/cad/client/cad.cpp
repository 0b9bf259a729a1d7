// SPDX-License-Identifier: Apache-2.0
// Asks the helper: a program linked to the kernel itself would take 50 ms to start, and what the
// kernel does to its process would be done to ours.
#include "obvid/cad/internal/cad.h"

#include <fmt/format.h>

#include <cstring>
#include <string>
#include <utility>

#include "helper_file.h"
#include "helper_message.h"
#include "helper_process.h"
#include "obvid/core/internal/watch.h"
#include "obvid/exchange/internal/step/write.h"

namespace obvid {
namespace {

using End = cad::Answer::End;

/// Why there is no answer, or, where bytes came, what they mean if they are none.
Error failure(const cad::Answer& answer, const std::string& path, const CadRun& run) {
  const bool reading = !path.empty();
  Error error;
  error.code = reading ? ErrorCode::kDamaged : ErrorCode::kInternal;
  error.where = path;
  error.hint = reading ? "the file may be damaged; export it again"
                       : "look at the geometry with `obvid verify` or `obvid surface check`";
  switch (answer.end) {
    case End::kNotStarted:
      error.code = ErrorCode::kUnsupported;
      error.what = std::string("the helper for STEP, IGES and BREP does not start: ") +
                   std::strerror(answer.reason);
      error.hint = "build or install the program and its helper together";
      break;
    case End::kCancelled:
      error.code = ErrorCode::kCancelled;
      error.what = "cancelled while the CAD kernel worked";
      error.hint = "";
      break;
    case End::kTooLong:
      error.what = fmt::format("the CAD kernel is not done after {} s", run.seconds.value_or(0.0));
      break;
    case End::kTooMuchWork:
      error.what = fmt::format("the CAD kernel is not done after {} s of processor time",
                               cad::kMostProcessorSeconds);
      break;
    case End::kTooLarge:
      error.what =
          fmt::format("the CAD kernel makes more than {} GiB of this", cad::kMostBytes >> 30);
      break;
    case End::kAnswered:
      error.what = reading ? "the CAD kernel broke down over this file"
                           : "the CAD kernel broke down over this geometry";
  }
  return error;
}

/// Sends the job and takes the answer apart. `path`: of the file that is read, if one is.
template <class Value>
Result<Value> asked(const cad::Job& job, const std::string& path, const CadRun& run,
                    Result<Value> (*unpacked)(std::string_view, const Error&)) {
  const auto helper = cad::helper_file();
  OBVID_TRY(helper);
  const cad::Answer answer = cad::ask_helper(helper->string(), cad::packed(job), run);
  const Error error = failure(answer, path, run);
  if (answer.end != End::kAnswered) return fail(error);
  return unpacked(answer.bytes, error);
}

CadRun for_reading(CadRun run) {
  run.seconds = run.seconds.value_or(cad::kMostReadingSeconds);
  return run;
}

}  // namespace

Result<std::string> cad_text(const std::vector<CadCurve>& curves, const CadWriteOptions& options,
                             const CadRun& run) {
  if (options.format == CadFormat::kStepAp214 || options.format == CadFormat::kStepAp242) {
    const bool ap242 = options.format == CadFormat::kStepAp242;
    Watch watch(RunContext{{}, run.cancelled});
    return step_text(
        curves,
        {ap242 ? StepSchema::kAp242 : StepSchema::kAp214, options.units, options.face_width},
        &watch);
  }
  return asked(cad::WriteCurves{curves, options}, "", run, &cad::unpacked_text);
}

Result<void> check_cad() {
  const auto helper = cad::helper_file();
  OBVID_TRY(helper);
  return {};
}

Result<Drawing> read_cad(const std::string& path, const CadRun& run) {
  return asked(cad::ReadCurves{path}, path, for_reading(run), &cad::unpacked_drawing);
}

Result<std::string> cad_surface_text(const SurfaceModel& model, const CadWriteOptions& options,
                                     const CadRun& run) {
  return asked(cad::WriteFaces{model, options}, "", run, &cad::unpacked_text);
}

Result<CadSurfaces> read_cad_surfaces(const std::string& path, const CadRun& run) {
  return asked(cad::ReadFaces{path}, path, for_reading(run), &cad::unpacked_surfaces);
}

}  // namespace obvid
