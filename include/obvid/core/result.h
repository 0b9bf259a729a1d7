// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <tl/expected.hpp>
#include <utility>

#include "obvid/core/error.h"

namespace obvid {

/// A value, or the error that says why there is none. The library neither throws nor prints.
template <class T>
using Result = tl::expected<T, Error>;

[[nodiscard]] inline tl::unexpected<Error> fail(Error error) {
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace obvid
