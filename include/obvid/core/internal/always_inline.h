// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Before a function: its body stands wherever it is called, whatever the compiler's options.
#if defined(_MSC_VER) && !defined(__clang__)
#define OBVID_ALWAYS_INLINE [[msvc::forceinline]]
#else
#define OBVID_ALWAYS_INLINE [[gnu::always_inline]]
#endif
