// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace obvid {

/// Keeps what the program was started with, standard input among it where the arguments name it and
/// it can be read only once.
void keep_start(char** argv);

/// Goes on in the whole program, started as this one was; the launcher builds it when it is not there.
/// Only without the launcher it returns from here: it ends with E310.
[[noreturn]] void go_on_in_the_whole_program();

}  // namespace obvid
