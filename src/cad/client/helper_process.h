// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "obvid/cad/internal/cad.h"

namespace obvid::cad {

/// Descriptor of the helper's socket: the request comes in, its length in 8 bytes before it; the
/// answer goes out up to the end. When nobody holds the other side any more, the work is in vain.
inline constexpr int kHelperSocket = 3;

/// Limits of reading. Exceeding the processor time is SIGXCPU.
inline constexpr unsigned kMostProcessorSeconds = 20;
inline constexpr double kMostReadingSeconds = 120.0;
inline constexpr unsigned long long kMostBytes = 4ULL << 30;  ///< damaged counts ask for any amount

/// How a helper ended.
struct Answer {
  enum class End {
    kAnswered,    ///< `bytes` is what it sent; nothing or a part of it where it broke down
    kNotStarted,  ///< `reason` is an errno
    kCancelled,
    kTooLong,      ///< on the clock
    kTooMuchWork,  ///< processor time
    kTooLarge,     ///< more bytes than `kMostBytes`
  };
  End end = End::kAnswered;
  int reason = 0;
  std::string bytes;
};

/// Starts the program, sends the request and waits for the answer; `run.seconds` <= 0 or nothing:
/// no limit. Whatever happens, no process, no zombie and no descriptor is left. Signals, threads
/// and limits of the calling process play no part.
[[nodiscard]] Answer ask_helper(const std::string& program, std::string_view request,
                                const CadRun& run);

}  // namespace obvid::cad
