// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <exception>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/obvid.h"

namespace obvid::capi {

/// A text for the caller, freed by `obvid_free`.
[[nodiscard]] char* text_of(const std::string& text);

/// Hands an error out and returns its code. `points`: those it is about, beside its own.
int hand_out(const Error& error, obvid_error** out, std::vector<std::size_t> points = {});

/// What the callbacks of a run are to the library; asked no more often than it takes to be in time.
[[nodiscard]] RunContext context_of(const obvid_run* run);

/// No exception leaves the library: the library itself throws none, lack of memory does.
template <class Work>
int guarded(obvid_error** error, Work&& work) noexcept {
  if (error != nullptr) *error = nullptr;
  try {
    try {
      if (const Result<void> done = work(); !done) return hand_out(done.error(), error);
      return 0;
    } catch (const std::bad_alloc&) {
      return hand_out({ErrorCode::kInternal, "out of memory", "", "try with fewer points"}, error);
    } catch (const std::exception& thrown) {
      return hand_out({ErrorCode::kInternal, thrown.what(), "", "please report this"}, error);
    }
  } catch (...) {  // not even room for the error
    return static_cast<int>(ErrorCode::kInternal);
  }
}

}  // namespace obvid::capi
