// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant, an object is used by one thread at a time: docs/threads.md

#include <concepts>
#include <cstddef>
#include <string>
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

/// An error that is told field by field, to be returned where a `Result` or an `Error` is due:
/// `return error(ErrorCode::kBadOption, "the step is 0").hint("give a greater one").value(step);`
class ErrorBuilder {
 public:
  ErrorBuilder(ErrorCode code, std::string what) : made_{code, std::move(what), "", ""} {}

  ErrorBuilder&& where(std::string place) && {
    made_.where = std::move(place);
    return std::move(*this);
  }
  ErrorBuilder&& hint(std::string what_to_do) && {
    made_.hint = std::move(what_to_do);
    return std::move(*this);
  }
  /// The point, piece, node or curve that it is about, from 0.
  template <std::integral Index>
  ErrorBuilder&& point(Index index) && {
    made_.index = static_cast<std::ptrdiff_t>(index);
    return std::move(*this);
  }
  template <std::integral First, std::integral Last>
  ErrorBuilder&& points(First first, Last last) && {
    made_.last = static_cast<std::ptrdiff_t>(last);
    return std::move(*this).point(first);
  }
  /// The figure that decided.
  ErrorBuilder&& value(double figure) && {
    made_.value = figure;
    return std::move(*this);
  }

  operator Error() && { return std::move(made_); }
  operator tl::unexpected<Error>() && { return fail(std::move(made_)); }
  template <class T>
  operator tl::expected<T, Error>() && {
    return fail(std::move(made_));
  }

 private:
  Error made_;
};

[[nodiscard]] inline ErrorBuilder error(ErrorCode code, std::string what) {
  return {code, std::move(what)};
}

}  // namespace obvid

/// Leaves the function with the error of an expression of type `Result`, if it has one. Where its
/// value is needed: `auto x = f(); OBVID_TRY(x);` and `*x`.
#define OBVID_TRY(...)                                                                \
  do {                                                                                \
    if (auto&& obvid_tried = (__VA_ARGS__); !obvid_tried) {                           \
      return ::obvid::fail(std::forward<decltype(obvid_tried)>(obvid_tried).error()); \
    }                                                                                 \
  } while (false)
