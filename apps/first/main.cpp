// SPDX-License-Identifier: Apache-2.0
#include "commands.h"
#include "start.h"

int main(int argc, char** argv) {
  obvid::keep_start(argv);
  return obvid::run_guarded(argc, argv);
}
