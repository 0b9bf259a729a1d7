// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "door.h"
#include "handles.h"
#include "obvid/pipeline/internal/can_write.h"
#include "obvid/pipeline/internal/surface_report_json.h"
#include "obvid/pipeline/internal/surface_values.h"
#include "obvid/pipeline/surface_check_job.h"
#include "obvid/pipeline/surface_cut_job.h"
#include "obvid/pipeline/surface_export.h"
#include "obvid/pipeline/surface_job.h"
#include "obvid/pipeline/toolpath_job.h"
#include "surface_options.h"
#include "table_files.h"

namespace obvid::capi {
namespace {

constexpr SurfaceKnown kSurfaceFiles{.formats = true};
constexpr SurfaceKnown kChecking{.check = true};
constexpr SurfaceKnown kSections{.cut = true};
constexpr SurfaceKnown kMilling{.toolpath = true};
constexpr SurfaceKnown kCheckFiles{.formats = true, .check = true};

/// What the library reads surfaces from.
SurfaceInput surface_input(const obvid_input& input) {
  if (input.space) return SurfaceInput::of_points(*input.space);
  if (input.points) {
    SpaceSeries series;
    series.name = input.points->name;
    series.units = input.points->units;
    for (const Vec2 p : input.points->points) series.points.push_back({p.x, p.y, 0.0});
    return SurfaceInput::of_points(std::move(series));
  }
  if (input.is_file) return {input.name};  // beside it may lie what belongs to it
  return SurfaceInput::of_text(input.name, input.text);
}

/// Of lines drawings, as on the command line: by the file that is cut.
std::string title_of(const obvid_surface& surface) {
  const std::string file = std::filesystem::path(surface.source).stem().string();
  return file.empty() ? surface.model.name : file;
}

/// Patches take parameters of their own knots.
double at_share(const std::vector<double>& knots, int degree, double share) {
  const double from = knots[static_cast<std::size_t>(degree)];
  const double to = knots[knots.size() - 1 - static_cast<std::size_t>(degree)];
  return share <= 0.0 ? from : share >= 1.0 ? to : from + share * (to - from);
}

}  // namespace
}  // namespace obvid::capi

using namespace obvid;
using namespace obvid::capi;

extern "C" {

int obvid_surface_make(const char* kind, const obvid_input* const* inputs, size_t count,
                       const obvid_input* const* across, size_t crossing, const char* options,
                       const obvid_run* run, obvid_surface** surface, char** report,
                       obvid_error** error) {
  if (surface != nullptr) *surface = nullptr;
  if (report != nullptr) *report = nullptr;
  return guarded(error, [&]() -> Result<void> {
    const auto what = surface_kind_named(kind == nullptr ? "" : kind);
    OBVID_TRY(what);
    auto request = surface_request_of(options, {.kind = *what});
    OBVID_TRY(request);
    SurfaceJob& job = request->make;
    for (size_t i = 0; i < count; ++i) job.inputs.push_back(surface_input(*inputs[i]));
    auto* second = second_inputs(job);
    for (size_t i = 0; i < crossing && second != nullptr; ++i) {
      second->push_back(surface_input(*across[i]));
    }
    if (job.inputs.empty() || (second != nullptr && second->empty())) {
      return fail({ErrorCode::kUsage, "a surface needs inputs", std::string("kind ") + kind, ""});
    }
    auto made = make_surface(job, context_of(run));
    OBVID_TRY(made);
    if (report != nullptr) *report = text_of(surface_report_json(*made, {}));
    const auto failed = not_proved(*made);
    if (surface != nullptr) {
      auto out = std::make_unique<obvid_surface>();
      out->model = std::move(made->model);
      if (count == 1 && crossing == 0) out->source = inputs[0]->name;
      out->lines = std::move(made->lines);
      out->beside_longitudinals = std::move(made->beside_longitudinals);
      out->warnings = std::move(made->warnings);
      *surface = out.release();
    }
    if (failed) return fail(*failed);
    return {};
  });
}

int obvid_surface_check(const obvid_surface* surface, const char* options, const obvid_run* run,
                        char** report, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const auto request = surface_request_of(options, kChecking);
    OBVID_TRY(request);
    const auto check = check_surface(surface->model, request->check, context_of(run));
    OBVID_TRY(check);
    if (report != nullptr) *report = text_of(surface_check_json(surface->model, *check, {}));
    return {};
  });
}

int obvid_surface_check_file(const obvid_surface* surface, const char* options, const char* ending,
                             const obvid_run* run, obvid_files** files, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    auto request = surface_request_of(options, kCheckFiles);
    OBVID_TRY(request);
    const std::string name = ending == nullptr ? "" : ending;
    const auto format = check_format_of("surface." + name);
    if (!format) {
      return fail({ErrorCode::kUnknownFormat, "check writes pictures only", name,
                   "possible are svg and html; obvid_surface_export has other formats"});
    }
    const RunContext context = context_of(run);
    const auto checked = check_surface(surface->model, request->check, context);
    OBVID_TRY(checked);
    request->formats.lines = surface->lines;
    request->formats.beside_longitudinals = surface->beside_longitudinals;
    show_findings(*checked, request->formats);
    SurfaceExporter exporter(surface->model, request->formats, context);
    auto out = std::make_unique<obvid_files>();
    auto text = exporter.text(*format, out->remarks);
    OBVID_TRY(text);
    OBVID_TRY(may_go_on(context));
    out->files.push_back({"", std::move(*text)});
    for (const auto* more : {&checked->warnings, &exporter.warnings()}) {
      out->remarks.insert(out->remarks.end(), more->begin(), more->end());
    }
    *files = out.release();
    return {};
  });
}

int obvid_surface_export(const obvid_surface* surface, const char* ending, const char* options,
                         const obvid_run* run, obvid_files** files, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    auto request = surface_request_of(options, kSurfaceFiles);
    OBVID_TRY(request);
    const std::string name = ending == nullptr ? "" : ending;
    const auto format = surface_format_of("surface." + name);
    if (!format) {
      return fail({ErrorCode::kUnknownFormat, "no format of surfaces has this file extension", name,
                   "possible are " + known_surface_endings()});
    }
    OBVID_TRY(can_write_surfaces(*format));
    request->formats.lines = surface->lines;
    request->formats.beside_longitudinals = surface->beside_longitudinals;
    const RunContext context = context_of(run);
    OBVID_TRY(may_go_on(context));
    auto out = std::make_unique<obvid_files>();
    const bool shows = *format == FileFormat::kPicture || *format == FileFormat::kPage;
    if (request->check.against && !shows) {
      out->remarks.push_back("against: not used, only .svg and .html show distances");
    } else if (request->check.against) {
      auto measured = measured_against(surface->model, *request->check.against,
                                       request->check.check.samples, out->remarks, context);
      OBVID_TRY(measured);
      request->formats.deviation = std::move(measured->shown);
    }
    SurfaceExporter exporter(surface->model, request->formats, context);
    auto text = exporter.text(*format, out->remarks);
    OBVID_TRY(text);
    OBVID_TRY(may_go_on(context));
    out->files.push_back({"", std::move(*text)});
    out->remarks.insert(out->remarks.end(), exporter.warnings().begin(), exporter.warnings().end());
    *files = out.release();
    return {};
  });
}

int obvid_surface_toolpath(const obvid_surface* surface, const char* options, const obvid_run* run,
                           obvid_files** files, char** report, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const auto request = surface_request_of(options, kMilling);
    OBVID_TRY(request);
    const RunContext context = context_of(run);
    auto made = make_toolpath(surface->model, request->toolpath, context);
    OBVID_TRY(made);
    const auto failed = not_kept(*made);
    std::unique_ptr<obvid_files> out;
    if (files != nullptr) {
      out = std::make_unique<obvid_files>();
      SurfaceExportOptions formats = request->formats;
      formats.lines = drawn(made->path);
      SurfaceExporter exporter(made->surface, formats, context);
      auto texts = files_in_table(&pipeline_detail::FormatRow::toolpath,
                                  [&](FileFormat format) -> Result<std::string> {
                                    if (format == FileFormat::kGcode)
                                      return made->path.program.text;
                                    return exporter.text(format, out->remarks);
                                  });
      OBVID_TRY(texts);
      out->files = std::move(*texts);
      out->remarks.insert(out->remarks.begin(), made->warnings.begin(), made->warnings.end());
    }
    OBVID_TRY(may_go_on(context));
    if (report != nullptr) *report = text_of(toolpath_report_json(*made, {}));
    if (files != nullptr) *files = out.release();
    if (failed) return fail(*failed);
    return {};
  });
}

int obvid_surface_cut(const obvid_surface* surface, const char* options, const obvid_run* run,
                      obvid_files** files, char** report, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const auto request = surface_request_of(options, kSections);
    OBVID_TRY(request);
    const RunContext context = context_of(run);
    auto made = cut_surface(surface->model, request->cut, context);
    OBVID_TRY(made);
    Watch watch(context);
    std::unique_ptr<obvid_files> out;
    if (files != nullptr) {
      out = std::make_unique<obvid_files>();
      auto texts = files_in_table(&pipeline_detail::FormatRow::sections, [&](FileFormat format) {
        return sections_file(format, *made, title_of(*surface), context);
      });
      OBVID_TRY(texts);
      out->files = std::move(*texts);
      out->remarks = made->warnings;
    }
    const std::string text = report == nullptr ? "" : surface_cut_json(*made, {}, false, &watch);
    if (watch.cancelled()) return fail(cancelled_error());
    if (report != nullptr) *report = text_of(text);
    if (files != nullptr) *files = out.release();
    if (const auto failed = not_proved(*made)) return fail(*failed);
    return {};
  });
}

int obvid_surface_branches(const obvid_surface* surface, const char* options, const char* ending,
                           const obvid_run* run, obvid_files** files, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const auto request = surface_request_of(options, kSections);
    OBVID_TRY(request);
    const std::string name = ending == nullptr ? "" : ending;
    const auto format = branch_format_of("branch." + name, request->cut.fair.has_value());
    OBVID_TRY(format);
    OBVID_TRY(can_write_curves(*format));
    const RunContext context = context_of(run);
    auto made = cut_surface(surface->model, request->cut, context);
    OBVID_TRY(made);
    auto out = std::make_unique<obvid_files>();
    for (const BranchPlace& place : branches_of(*made)) {
      auto one = branch_file(*made, place, *format, context);
      OBVID_TRY(one);
      for (ExportedFile& file : one->files) {
        out->files.push_back({place.id + file.suffix, std::move(file.text)});
      }
      for (const auto* more : {&one->remarks, &one->warnings}) {
        for (const std::string& told : *more) out->remarks.push_back(place.id + ": " + told);
      }
    }
    out->remarks.insert(out->remarks.end(), made->warnings.begin(), made->warnings.end());
    OBVID_TRY(may_go_on(context));
    *files = out.release();
    if (const auto failed = not_proved(*made)) return fail(*failed);
    return {};
  });
}

size_t obvid_surface_patches(const obvid_surface* surface) { return surface->model.patches.size(); }

const char* obvid_surface_warning(const obvid_surface* surface, size_t warning) {
  return warning < surface->warnings.size() ? surface->warnings[warning].c_str() : nullptr;
}

int obvid_surface_evaluate(const obvid_surface* surface, size_t patch, const double* uv, size_t n,
                           double* xyz, double* normal, double* curvatures, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    if (patch >= surface->model.patches.size()) {
      return fail({ErrorCode::kUsage, "there is no such patch", std::to_string(patch),
                   "obvid_surface_patches counts them"});
    }
    const NurbsSurface& s = surface->model.patches[patch].surface;
    for (size_t i = 0; i < n; ++i) {
      const double u = uv[2 * i], v = uv[2 * i + 1];
      if (!(u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0)) {
        return fail({ErrorCode::kUsage, "parameters lie between 0 and 1",
                     "place " + std::to_string(i + 1), ""});
      }
      const SurfaceJet jet =
          evaluate(s, at_share(s.knots_u, s.degree_u, u), at_share(s.knots_v, s.degree_v, v));
      const auto put = [i](double* to, Vec3 p) {
        if (to == nullptr) return;
        to[3 * i] = p.x;
        to[3 * i + 1] = p.y;
        to[3 * i + 2] = p.z;
      };
      put(xyz, jet.point);
      const SurfaceCurvature found = curvature(jet);
      put(normal, found.normal);
      if (curvatures != nullptr) {
        curvatures[2 * i] = found.k1;
        curvatures[2 * i + 1] = found.k2;
      }
    }
    return {};
  });
}

void obvid_surface_free(obvid_surface* surface) { delete surface; }
}
