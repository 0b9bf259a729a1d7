// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include <csignal>

namespace obvid {
namespace {

// the only thing that a handler of signals may write to
volatile std::sig_atomic_t interrupted = 0;

void note_interrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

Interrupt::Interrupt() {
  interrupted = 0;
  std::signal(SIGINT, note_interrupt);
}

Interrupt::~Interrupt() { std::signal(SIGINT, SIG_DFL); }

bool Interrupt::asked() const { return interrupted != 0; }

}  // namespace obvid
