// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace obvid::studio {

/// Answers a request of the page through the C interface: one JSON object in, one out. The page in
/// the browser and the program on this machine talk to the engine by these and nothing else.
///
/// A request holds the input, `points` ([[x, y], ...]) or `text` with its `name`, and `options`
/// with the names of the command line. Kinds and what their answers hold beside `error`:
///   series    `report`: the points and what is given at them
///   fit       `report`, `contour` (text of the contour file; not where `file` is false), `curve`: `samples` places of every
///             piece with t, x, y, heading (rad), kappa (1/unit), slope (1/unit^2); `warnings`
///   drawn     `curve`: of a contour file or of a drawing, as it stands there
///   region, analyse, compare, suggest, why_not    `report`
///   verify    `report`; the request holds `contour`
///   worksheet `files`, `remarks`: the tables and drawings of region; the request holds `format`
///   export    `files` ([{suffix, text}]), `remarks`; the request holds `contour` and `format`
/// `error` is null or {code, category, message, where, advice, points}; `fit` may have both a
/// contour and an error: it was formed and does not keep its promise.
/// `cancelled` is asked every few milliseconds. Reentrant; throws nothing but std::bad_alloc.
[[nodiscard]] std::string answer(std::string_view kind, const std::string& request,
                                 const std::function<bool()>& cancelled);

}  // namespace obvid::studio
