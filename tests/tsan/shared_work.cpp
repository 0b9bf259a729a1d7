// SPDX-License-Identifier: Apache-2.0
// What all work on several threads goes through, under the thread sanitizer: numbers handed out,
// stops and exceptions passed between threads. `tools/check_threads` does the same for every job,
// which takes some ten minutes to build.
#include <atomic>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "obvid/core/internal/parallel.h"

int main() {
  using obvid::in_parallel;
  using obvid::RunContext;
  std::size_t faults = 0;
  for (int round = 0; round < 50; ++round) {
    std::vector<int> done(64, 0);
    in_parallel(done.size(), 4, [&](std::size_t i) { ++done[i]; });
    for (const int one : done) faults += one == 1 ? 0 : 1;

    int asked = 0;  // by the calling thread alone: a race if others asked, too
    const RunContext run{obvid::Progress{}, [&] { return ++asked > round; }};
    std::vector<int> begun(64, 0);
    const auto ended = in_parallel(begun.size(), with_threads(run, 4), [&](std::size_t i, const RunContext& own) {
      ++begun[i];
      while (round < 8 && may_go_on(own)) {
      }
    });
    faults += round < 8 && ended ? 1 : 0;  // work that only ends when it is asked to

    bool thrown = false;
    try {
      (void)in_parallel(64, with_threads(RunContext{obvid::Progress{}, [] { return false; }}, 4),
                        [](std::size_t i) {
                          if (i % 7 == 3) throw std::runtime_error("stop");
                        });
    } catch (const std::runtime_error&) {
      thrown = true;
    }
    faults += thrown ? 0 : 1;
  }
  std::printf("%zu faults\n", faults);
  return faults == 0 ? 0 : 1;
}
