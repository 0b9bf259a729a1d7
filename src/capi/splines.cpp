// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "door.h"
#include "handles.h"
#include "obvid/core/units.h"
#include "obvid/pipeline/internal/spline_values.h"
#include "obvid/pipeline/table_spline.h"
#include "setters.h"

namespace obvid::capi {
namespace {

struct SplineRequest {
  SplineJob job;
  std::size_t samples = 0;
};

struct NurbsRequest {
  NurbsJob job;
  std::optional<Units> units;
  std::size_t samples = 0;
};

Result<std::size_t> samples_of(std::optional<long> typed) {
  return rows_of_samples(typed.value_or(kRowsOfSamples));
}

Result<SplineRequest> spline_request(const char* options) {
  SplineRequest out;
  SplineValues values;
  std::optional<long> samples;
  const auto object = options_in(options);
  OBVID_TRY(object);
  OBVID_TRY(take(*object, {{"curve", flag(out.job.curve)},
                           {"compare", flag(out.job.compare)},
                           {"degree", count(values.degree)},
                           {"smooth", text(values.smooth)},
                           {"tolerance", number(values.tolerance)},
                           {"samples", count(samples)}}));
  OBVID_TRY(set_spline(values, out.job));
  const auto rows = samples_of(samples);
  OBVID_TRY(rows);
  out.samples = *rows;
  return out;
}

Result<NurbsRequest> nurbs_request(const char* options) {
  NurbsRequest out;
  NurbsValues values;
  std::optional<long> samples;
  std::optional<std::string> units;
  const auto object = options_in(options);
  OBVID_TRY(object);
  OBVID_TRY(take(*object, {{"degree", count(values.degree)},
                           {"degree-v", count(values.degree_v)},
                           {"knots", text(values.knots)},
                           {"knots-v", text(values.knots_v)},
                           {"weight-at", at_points(values.weights)},
                           {"move", at_points(values.moves)},
                           {"units", text(units)},
                           {"samples", count(samples)}}));
  OBVID_TRY(set_nurbs(values, out.job));
  const auto rows = samples_of(samples);
  OBVID_TRY(rows);
  out.samples = *rows;
  if (!units) return out;
  auto given = given_units(*units, "units");
  OBVID_TRY(given);
  out.units = std::move(*given);
  return out;
}

/// Arrays have lost points that repeat, and names of columns.
Result<NamedTable> table_of(const obvid_input* input) {
  if (input == nullptr) return fail({ErrorCode::kUsage, "the table is NULL", "", ""});
  if (input->points || input->space || input->by_path) {
    return fail({ErrorCode::kUsage, "a table with columns is expected", input->name,
                 "give it with obvid_read_text or obvid_read_file"});
  }
  return parse_table(input->text, input->name);
}

std::unique_ptr<obvid_surface> surface_of(std::optional<SurfaceModel> model) {
  if (!model) return nullptr;
  auto out = std::make_unique<obvid_surface>();
  out->model = std::move(*model);
  return out;
}

/// One file, where one is wanted: `make` has its path.
template <class Make>
Result<std::unique_ptr<obvid_files>> file_of(const char* ending, obvid_files** wanted,
                                             const Make& make) {
  if (ending == nullptr || wanted == nullptr) return std::unique_ptr<obvid_files>();
  auto text = make(std::string("curve.") + ending);
  OBVID_TRY(text);
  auto out = std::make_unique<obvid_files>();
  out->files.push_back({"", std::move(*text)});
  return out;
}

/// Results leave together, or none does.
template <class Handle>
void hand_over(std::unique_ptr<Handle> made, Handle** to) {
  if (to != nullptr) *to = made.release();
}

}  // namespace
}  // namespace obvid::capi

using namespace obvid;
using namespace obvid::capi;

extern "C" {

int obvid_spline(const obvid_input* table, const obvid_input* against, const char* options,
                 const char* ending, const obvid_run* run, obvid_surface** graph,
                 obvid_files** files, char** report, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const auto request = spline_request(options);
    OBVID_TRY(request);
    const auto read = table_of(table);
    OBVID_TRY(read);
    std::optional<NamedTable> finer;
    if (against != nullptr) {
      auto more = table_of(against);
      OBVID_TRY(more);
      finer = std::move(*more);
    }
    const RunContext context = context_of(run);
    const auto made = spline_of_table(*read, finer, request->job, context);
    OBVID_TRY(made);
    auto file = file_of(ending, files, [&](const std::string& path) {
      return table_spline_file(*made, path, request->samples);
    });
    OBVID_TRY(file);
    auto model = table_spline_graph(*made);
    OBVID_TRY(model);
    auto surface = surface_of(std::move(*model));
    OBVID_TRY(may_go_on(context));
    if (report != nullptr) *report = text_of(table_spline_json(*made));
    hand_over(std::move(surface), graph);
    hand_over(std::move(*file), files);
    return {};
  });
}

int obvid_nurbs_make(const obvid_input* table, const char* options, const char* ending,
                     const obvid_run* run, obvid_surface** surface, obvid_files** files,
                     char** report, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const auto request = nurbs_request(options);
    OBVID_TRY(request);
    const auto read = table_of(table);
    OBVID_TRY(read);
    auto points = control_table(read->table, read->name);
    OBVID_TRY(points);
    const RunContext context = context_of(run);
    const auto made = nurbs_report(std::move(*points), request->job, context);
    OBVID_TRY(made);
    const Units units = request->units.value_or(Units{});
    auto file = file_of(ending, files, [&](const std::string& path) {
      return nurbs_file(*made, path, units, request->samples, context);
    });
    OBVID_TRY(file);
    auto patch = surface_of(nurbs_surface(*made, units));
    OBVID_TRY(may_go_on(context));
    if (report != nullptr) *report = text_of(nurbs_json(*made));
    hand_over(std::move(patch), surface);
    hand_over(std::move(*file), files);
    return {};
  });
}
}
