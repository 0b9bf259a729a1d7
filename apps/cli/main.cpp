// SPDX-License-Identifier: Apache-2.0
#include "commands.h"

void obvid::keep_standard_input() {}  // nobody comes after this program

int main(int argc, char** argv) { return obvid::run_guarded(argc, argv); }
