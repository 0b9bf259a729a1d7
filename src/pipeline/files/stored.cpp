// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/stored.h"

#include <cstddef>
#include <filesystem>
#include <utility>

#include "obvid/core/files.h"
#include "obvid/io/contour_json.h"
#include "obvid/io/internal/file_kind.h"
#include "obvid/io/read_points.h"
#include "obvid/io/space_json.h"
#include "obvid/pipeline/internal/drawn_contour.h"

namespace obvid {

Result<Stored> parse_stored(const std::string& text, const std::string& name,
                            const RunContext& run) {
  Watch watch(without_progress(run));
  if (is_space_json(text)) {
    auto chain = space_chain_from_json(text, name, &watch);
    OBVID_TRY(chain);
    return Stored(std::move(*chain));
  }
  auto contour = contour_from_json(text, name, &watch);
  if (!contour && !watch.was_cancelled() && parse_points(text, name, {.two = TwoPoints::kDo})) {
    return error(contour.error().code, "this is a list of points, not a contour")
        .where(name)
        .hint("`obvid fit` forms a contour through them, and writes all formats");
  }
  OBVID_TRY(contour);
  return Stored(std::move(*contour));
}

namespace {

/// Whether it is taken as it is drawn; of a contour file only where it goes elsewhere.
bool is_foreign(bool drawing, FileKind kind, const ConvertJob& job) {
  return drawing && (kind != FileKind::kContour || !job.import.placement.changes_nothing());
}

void take_given_units(const ConvertJob& job, TitledContour& contour) {
  if (!job.units) return;
  if (auto told = take_units(contour.stored.contour.units, *job.units)) {
    contour.warnings.push_back(std::move(*told));
  }
}

Result<Convertible> convertible_of(Result<Drawing> drawing, const std::string& name,
                                   const ConvertJob& job, const RunContext& run) {
  OBVID_TRY(drawing);
  auto drawn = drawn_contour(std::move(*drawing), job.import, name, run);
  OBVID_TRY(drawn);
  take_given_units(job, *drawn);
  return Convertible(std::move(*drawn));
}

Result<Convertible> stored_as_it_is(const std::string& text, const std::string& name,
                                    const ConvertJob& job, const RunContext& run) {
  auto stored = parse_stored(text, name, run);
  OBVID_TRY(stored);
  if (auto* chain = std::get_if<StoredSpaceChain>(&*stored)) return Convertible(std::move(*chain));
  TitledContour out;
  out.stored = std::get<StoredContour>(std::move(*stored));
  out.source = name;
  out.picture.name = std::filesystem::path(name).filename().string();
  take_given_units(job, out);
  return Convertible(std::move(out));
}

}  // namespace

Result<Convertible> read_convertible(const std::string& path, const ConvertJob& job,
                                     const RunContext& run) {
  OBVID_TRY(may_go_on(run));
  if (needs_cad(head_of_file(path, kHeadOfKind))) {
    return convertible_of(read_drawing(path, job.import.planes, run), path, job, run);
  }
  const auto text = read_file(path);
  OBVID_TRY(text);
  return parse_convertible(*text, path, job, run);
}

Result<Convertible> parse_convertible(const std::string& text, const std::string& name,
                                      const ConvertJob& job, const RunContext& run) {
  if (is_foreign(is_drawing_text(text, name), file_kind(text), job)) {
    return convertible_of(parse_drawing(text, name, job.import.planes, run), name, job, run);
  }
  return stored_as_it_is(text, name, job, run);
}

}  // namespace obvid
