// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace obvid {

/// Everything that can go wrong, as the number that users see (`E###`).
/// The hundreds digit is the exit code of the command line.
enum class ErrorCode : int {
  kInternal = 101,
  kWriteFailed = 102,
  kCancelled = 103,
  kUsage = 201,
  kUnknownFormat = 202,
  kBadOption = 203,
  kCannotOpen = 301,
  kBadNumber = 302,
  kNotFinite = 303,
  kTooFewPoints = 304,
  kTooFewColumns = 305,
  kNotText = 306,
  kBadCount = 307,
  kBadJson = 308,
  kSizeOutOfRange = 309,
  kUnsupported = 310,
  kNothingThere = 311,
  kTooFewCurves = 312,
  kOutOfOrder = 313,
  kDamaged = 314,
  kNoSpiral = 401,
  kChordReversal = 402,
  kFixedDataContradict = 403,
  kNoRoomForTransition = 404,
  kRoundingDecides = 405,
  kCarrierCannotKeep = 406,
  kWanders = 407,
  kSurfaceFolds = 408,
  kToolTooLarge = 409,
  kNotProved = 501,
  kToleranceNotReached = 502,
  kFalseClaim = 503,
  kNotAllCut = 504,
};

/// Why something was refused: what, where, and what the user can do about it.
struct Error {
  ErrorCode code = ErrorCode::kInternal;
  std::string what;           ///< one sentence without a full stop
  std::string where;          ///< "file.csv:12:7", "points 3 to 7", ...; may be empty
  std::string hint;           ///< what to do next; may be empty
  std::ptrdiff_t index = -1;  ///< first point (zero based) the error is about, or -1
  double value = 0.0;         ///< the figure that decided, in the unit that `what` names
  std::ptrdiff_t last = -1;   ///< last of the points, where they are a range; else -1
};

/// Whose the fault is, and what a caller can do about it.
enum class ErrorCategory : int {
  kProgram = 1,    ///< ours, the machine's, or cancelled
  kUsage = 2,      ///< an option or a call that is not possible
  kInput = 3,      ///< the input cannot be read
  kNoContour = 4,  ///< no such contour or surface exists
  kNotKept = 5,    ///< formed, but it does not keep its promise
};

[[nodiscard]] constexpr ErrorCategory category(ErrorCode code) {
  return static_cast<ErrorCategory>(static_cast<int>(code) / 100);
}

/// Exit code of the command line for this error (formats: 1, 2, 3, 4 or 5).
[[nodiscard]] constexpr int exit_code(ErrorCode code) { return static_cast<int>(category(code)); }

/// The line printed on stderr: `obvid: error E302: what (where); hint`.
[[nodiscard]] std::string to_line(const Error& error);

/// Long text of one code for `obvid explain`.
struct ErrorText {
  ErrorCode code;
  std::string_view title;
  std::string_view meaning;  ///< what it means, in whole sentences
  std::string_view remedy;   ///< what to do, in whole sentences
};

/// All codes in ascending order.
[[nodiscard]] std::span<const ErrorText> error_texts();

}  // namespace obvid
