// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <functional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "obvid/core/error.h"
#include "obvid/core/internal/progress.h"
#include "obvid/core/result.h"

namespace obvid {

/// What long work asks of whoever started it, and may use. Both functions are called by the thread
/// that called, between steps that take some milliseconds, of surfaces up to some hundred
/// (docs/methods/pipeline.md has the figures), so they have to be quick themselves.
struct RunContext {
  Progress progress;                ///< told how far the work is; empty: nobody listens
  std::function<bool()> cancelled;  ///< true: stop, there shall be no result (E103); empty: never.
                                    ///< Not asked again once it said so
  std::size_t threads = 0;  ///< at work at a time, at most; 0: as many as the process may run
                            ///< at once. The result does not depend on it

  RunContext() = default;
  RunContext(Progress told, std::function<bool()> asked)
      : progress(std::move(told)), cancelled(std::move(asked)) {}
  /// Progress alone.
  template <class Told>
  requires std::is_invocable_v<Told&, std::string_view, double> RunContext(Told told)
      : progress(std::move(told)) {}  // NOLINT: implicit on purpose
};

/// The same for a part of the work whose progress nobody is told.
[[nodiscard]] inline RunContext without_progress(RunContext run) {
  run.progress = {};
  return run;
}

/// What cancelled work returns.
[[nodiscard]] inline Error cancelled_error() {
  return {ErrorCode::kCancelled, "the work was cancelled", "", ""};
}

/// Whether the work goes on; asks. Error: E103.
[[nodiscard]] inline Result<void> may_go_on(const RunContext& run) {
  if (run.cancelled && run.cancelled()) return fail(cancelled_error());
  return {};
}

/// Tells how far the work is, then asks likewise.
[[nodiscard]] inline Result<void> tell(const RunContext& run, std::string_view stage,
                                       double fraction) {
  if (run.progress) run.progress(stage, fraction);
  return may_go_on(run);
}

}  // namespace obvid
