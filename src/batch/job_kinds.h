// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "item.h"

namespace obvid::batch {

/// What the files of --each are.
enum class Draws {
  kNothing,        ///< there are none
  kCurve,          ///< exports of a contour or of curves in space
  kTexts,          ///< texts that the job makes, by the end of their names
  kCurveAndTexts,  ///< texts where one of them has this end, else exports
  kByEnding,       ///< a text made for its file extension, or exports of a surface
};

/// One row of the table of jobs.
struct JobKind {
  std::string_view name;
  Draws draws = Draws::kNothing;
  bool reports = false;     ///< its figures are those of its report
  bool table = false;       ///< items are tables with columns
  bool against = false;     ///< --against: one more file that every item is held against
  bool needs_each = false;  ///< nothing comes of it but files
};

/// NULL: there is no such job. `compare` with --against lays curves over one and draws, without it
/// it compares families.
[[nodiscard]] const JobKind* kind_named(std::string_view name, bool against);
/// "fit, space, ..."
[[nodiscard]] std::string known_jobs();

/// Whether a file of this name holds a program of a machine (.nc, ...).
[[nodiscard]] bool is_program_file(std::string_view path);
/// Whether a job of texts makes one for a file of this name; true of other jobs.
[[nodiscard]] bool has_text_for(const JobKind& kind, std::string_view path);

/// Points of an item as the text of a table with the columns that this job needs.
[[nodiscard]] std::string table_of_points(const Item& item, const JobKind& kind, bool curve);

}  // namespace obvid::batch
