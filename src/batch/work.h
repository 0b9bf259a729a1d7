// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

#include "job.h"
#include "source.h"
#include "store.h"

namespace obvid::batch {

/// How far the work is, for whoever shows it; may be read at any time.
struct Pace {
  std::atomic<std::size_t> items{0};  ///< to do, of this process
  std::atomic<std::size_t> done{0};
  std::atomic<std::size_t> failed{0};  ///< of these
};

/// Which shards are this process's: those whose number k has k mod parts == part.
struct Part {
  std::size_t part = 0, parts = 1;
};

/// Works on all shards of a part that are not there, on so many threads (0: as many as the machine
/// runs), and puts each into the store when it is whole. In memory are the items at work and the
/// rows of one shard for each thread at most. Errors: E103 stopped; E102; those of the source.
[[nodiscard]] Result<void> work(const Source& source, const Job& job, const Store& store,
                                const Part& part, std::size_t threads, Pace& pace,
                                const std::function<bool()>& stopped);

}  // namespace obvid::batch
