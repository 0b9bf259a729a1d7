// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>
#include <variant>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/core/units.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/internal/titled_contour.h"
#include "obvid/report/stored_contour.h"
#include "obvid/report/stored_space.h"

namespace obvid {

/// What a contour file holds: a contour of the plane, or curves in space.
using Stored = std::variant<StoredContour, StoredSpaceChain>;

/// Reads a contour file (docs/formats.md) from its text. `name` stands in errors.
/// Errors: E103, E308, E309, E310 as `contour_from_json` and `space_chain_from_json` say.
[[nodiscard]] Result<Stored> parse_stored(const std::string& text, const std::string& name,
                                          const RunContext& run = {});

/// How a file becomes what other formats are written of.
struct ConvertJob {
  ImportOptions import{};
  std::optional<Units> units{};  ///< in place of what it says
};

/// A contour, or curves in space.
using Convertible = std::variant<TitledContour, StoredSpaceChain>;

/// What a file holds, to be written in other formats: a contour file with its report and
/// certificate as they are; files of others, meshes, and contours that are placed anew, whose
/// claims spoke of another place, as `drawn_contour` takes them. What it is the contents say, not
/// the name. Errors: those of `parse_stored`, of reading, and of `drawn_contour`; E103.
[[nodiscard]] Result<Convertible> read_convertible(const std::string& path, const ConvertJob& job,
                                                   const RunContext& run = {});
/// The same of a text in memory; `name` stands in errors.
[[nodiscard]] Result<Convertible> parse_convertible(const std::string& text,
                                                    const std::string& name, const ConvertJob& job,
                                                    const RunContext& run = {});

}  // namespace obvid
