// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "obvid/core/run_context.h"

namespace obvid {

/// That this process may run on at a time: the machine's, unless it is bound to some of them.
[[nodiscard]] std::size_t processors();

/// work(i) once for each i in [0, count), in no order, on up to `threads` threads (0: as many as
/// the machine runs at a time). Calls that share nothing they write give the same results for any
/// number of threads. Rethrows what the first of failing calls throws, when all have ended.
void in_parallel(std::size_t count, std::size_t threads,
                 const std::function<void(std::size_t)>& work);

/// work(from, to) for lots [from, to) of so many neighbours of [0, count), the last of them
/// shorter: where one alone is too little to be shared out.
void in_lots(std::size_t count, std::size_t together, std::size_t threads,
             const std::function<void(std::size_t, std::size_t)>& work);

/// `in_parallel` for work that whoever waits may stop, on the threads of `run`: the calling thread,
/// which works too, asks after each of its numbers, and every few milliseconds while it waits for
/// others. Error: E103; some numbers are left out then.
[[nodiscard]] Result<void> in_parallel(std::size_t count, const RunContext& run,
                                       const std::function<void(std::size_t)>& work);

/// The same for work that takes long itself: it gets a context that it asks in between, with its
/// share of the threads. On the calling thread that asks `run`, on others whether it said to stop;
/// it tells no progress.
[[nodiscard]] Result<void> in_parallel(
    std::size_t count, const RunContext& run,
    const std::function<void(std::size_t, const RunContext&)>& work);

/// `in_lots` for work that whoever waits may stop. Error: E103.
[[nodiscard]] Result<void> in_lots(std::size_t count, std::size_t together, const RunContext& run,
                                   const std::function<void(std::size_t, std::size_t)>& work);

/// `run` with so many threads; 0: those that it has.
[[nodiscard]] RunContext with_threads(RunContext run, std::size_t threads);

}  // namespace obvid
