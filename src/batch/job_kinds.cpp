// SPDX-License-Identifier: Apache-2.0
#include "job_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "obvid/core/internal/file_ending.h"
#include "obvid/pipeline/internal/format_table.h"

namespace obvid::batch {
namespace {

constexpr std::array<JobKind, 13> kKinds{{
    {"fit", Draws::kCurve},
    {"space", Draws::kCurve},
    {"analyse", Draws::kNothing, true},
    {"region", Draws::kNothing, true},
    {"compare", Draws::kNothing, true},
    {"compare", Draws::kTexts, true, false, true},
    {"suggest", Draws::kNothing, true},
    {"verify", Draws::kNothing, true},
    {"convert", Draws::kCurve, false, false, false, true},
    {"alignment", Draws::kCurveAndTexts, true},
    {"cut", Draws::kTexts, true},
    {"spline", Draws::kByEnding, true, true, true},
    {"nurbs", Draws::kByEnding, true, true},
}};

}  // namespace

bool is_program_file(std::string_view path) {
  return pipeline_detail::format_in_table(path, &pipeline_detail::FormatRow::cut) ==
         FileFormat::kGcode;
}

bool has_text_for(const JobKind& kind, std::string_view path) {
  if (kind.draws != Draws::kTexts) return true;
  using pipeline_detail::FormatRow;
  const auto format = pipeline_detail::format_in_table(
      path, kind.name == "cut" ? &FormatRow::cut : &FormatRow::tables);
  return format && *format != FileFormat::kPage;  // pages are the command line's
}

const JobKind* kind_named(std::string_view name, bool against) {
  const JobKind* found = nullptr;
  for (const JobKind& kind : kKinds) {
    if (kind.name != name) continue;
    if (kind.against == against) return &kind;
    if (!against) found = &kind;  // what it is held against may be left out
  }
  return found;
}

std::string known_jobs() {
  std::string out;
  std::string_view before;
  for (const JobKind& kind : kKinds) {
    if (kind.name == before) continue;
    before = kind.name;
    out += (out.empty() ? "" : ", ") + std::string(kind.name);
  }
  return out;
}

std::string table_of_points(const Item& item, const JobKind& kind, bool curve) {
  const bool function = kind.name == "spline" && !curve;
  std::string out = function ? (item.dimension == 2 ? "x,f\n" : "x,y,f\n")
                             : (item.dimension == 2 ? "x,y\n" : "x,y,z\n");
  for (std::size_t i = 0; i < item.numbers.size(); ++i) {
    out += fmt::format("{}{}", item.numbers[i], (i + 1) % item.dimension == 0 ? "\n" : ",");
  }
  return out;
}

}  // namespace obvid::batch
