// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace obvid {

/// While it lives, Ctrl-C asks the work to stop, so that what is finished can be shown; pressed
/// again, it ends the program at once. One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;
  [[nodiscard]] bool asked() const;
};

}  // namespace obvid
