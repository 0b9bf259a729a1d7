// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "door.h"
#include "handles.h"
#include "obvid/pipeline/alignment_job.h"
#include "obvid/pipeline/analyse.h"
#include "obvid/pipeline/compare_curves.h"
#include "obvid/pipeline/construction_fit.h"
#include "obvid/pipeline/cut_job.h"
#include "obvid/pipeline/internal/construction_values.h"
#include "obvid/pipeline/internal/job_files.h"
#include "obvid/pipeline/internal/promise.h"
#include "obvid/pipeline/internal/refusal.h"
#include "obvid/pipeline/internal/region_files.h"
#include "obvid/pipeline/internal/report_json.h"
#include "obvid/pipeline/stored.h"
#include "options.h"
#include "table_files.h"

namespace obvid::capi {
namespace {

constexpr Known kForming{.fit = true, .construction = true, .import = true};
constexpr Known kWorksheet{.fit = true, .construction = true, .worksheet = true, .import = true};
constexpr Known kFitting{.fit = true, .import = true};
constexpr Known kComparing{.fit = true, .import = true, .shown = true};
constexpr Known kPicturing{.import = true, .plots = true};
constexpr Known kOverlaying{.fit = true, .import = true, .curves = true};
constexpr Known kImporting{.import = true};
constexpr Known kCutting{.import = true, .cut = true};
constexpr Known kAligning{.import = true, .alignment = true};

Result<PointSeries> series_of(const obvid_input& input, const Request& request, bool drawings,
                              const RunContext& run) {
  if (input.space) {
    return fail({ErrorCode::kBadOption, "points in space are formed by obvid_fit_space", "", ""});
  }
  const ImportOptions import = in_units(request.import, request.units);
  if (input.points) {
    PointSeries given = *input.points;
    place(import.placement, given);
    if (import.units) take_units(given, *import.units);
    return given;
  }
  if (!drawings) return parse_point_list(input.text, input.name, import);
  return input.by_path ? read_series(input.name, import, run)
                       : parse_series(input.text, input.name, import, run);
}

/// The same with what a drawing says of an alignment.
Result<RoadSeries> road_of(const obvid_input& input, const Request& request,
                           const RunContext& run) {
  if (input.space || input.points) {
    auto series = series_of(input, request, true, run);
    OBVID_TRY(series);
    return RoadSeries{std::move(*series), {}};
  }
  const ImportOptions import = in_units(request.import, request.units);
  return input.by_path ? read_road(input.name, import, run)
                       : parse_road(input.text, input.name, import, run);
}

/// Stations and heights: of points x and y.
Result<StationHeights> heights_of(const obvid_input& input) {
  if (!input.points) return parse_heights(input.text, input.name);
  StationHeights out;
  out.points = input.points->points;
  return out;
}

Result<Drawing> drawing_of(const obvid_input& input, const Request& request,
                           const RunContext& run) {
  const std::vector<PlaneRow>& planes = request.import.planes;
  return input.by_path ? read_drawing(input.name, planes, run)
                       : parse_drawing(input.text, input.name, planes, run);
}

/// One of several curves that are laid over each other.
Result<CurveInput> curve_of(const obvid_input& input, const Request& request,
                            const RunContext& run) {
  const ReadCurveOptions how{request.import, request.job, request.units};
  if (input.points || input.space) {
    const Result<PointSeries> series = series_of(input, request, true, run);
    OBVID_TRY(series);
    return formed_curve(*series, request.job, run);
  }
  return input.by_path ? read_curve(input.name, how, run)
                       : parse_curve(input.text, input.name, how, run);
}

void hand_out_text(const std::string& text, char** out) {
  if (out != nullptr) *out = text_of(text);
}

/// One file; `remark`, unless empty, is to be said of it.
void hand_out_file(std::string text, std::string remark, obvid_files** files) {
  auto out = std::make_unique<obvid_files>();
  out->files.push_back({"", std::move(text)});
  if (!remark.empty()) out->remarks.push_back(std::move(remark));
  *files = out.release();
}

/// A job on a series of points: what is made of them is the report.
template <class Make>
int report_on_points(const obvid_input* input, const char* options, const Known& known,
                     const obvid_run* run, char** report, obvid_error** error, Make&& make) {
  return guarded(error, [&]() -> Result<void> {
    const Result<Request> request = request_of(options, known);
    OBVID_TRY(request);
    const RunContext context = context_of(run);
    Result<PointSeries> series = series_of(*input, *request, known.import, context);
    OBVID_TRY(series);
    const Result<std::string> text = make(*series, *request, context);
    OBVID_TRY(text);
    hand_out_text(*text, report);
    return {};
  });
}

Result<AnalysedDrawing> analysed_drawing(const obvid_input& input, const Request& request,
                                         const RunContext& run) {
  Result<Drawing> drawing = drawing_of(input, request, run);
  OBVID_TRY(drawing);
  if (request.units) {
    if (auto told = take_units(drawing->units, *request.units)) drawing->warnings.push_back(*told);
  }
  return analyse_drawing(std::move(*drawing), request.import, input.name, run);
}

Result<AnalysedSeries> analysed_points(const obvid_input& input, const Request& request,
                                       const RunContext& run) {
  Result<PointSeries> series = series_of(input, request, false, run);
  OBVID_TRY(series);
  OBVID_TRY(may_go_on(run));
  Result<Analysis> analysis = analyse(series->points);
  OBVID_TRY(analysis);
  add_rounding_warning(*series, *analysis);
  return AnalysedSeries{std::move(*series), std::move(*analysis)};
}

/// What `analyse` finds, as a file: of the report its JSON.
Result<std::string> analysed(FileFormat format, const obvid_input& input, const Request& request,
                             const RunContext& run) {
  OBVID_TRY(may_go_on(run));
  const bool drawing = input.by_path || (!input.points && is_drawing_text(input.text, input.name));
  if (drawing) {
    const auto found = analysed_drawing(input, request, run);
    OBVID_TRY(found);
    return analysis_file(format, *found, request.formats.plots, run);
  }
  const auto found = analysed_points(input, request, run);
  OBVID_TRY(found);
  return analysis_file(format, *found, run);
}

/// A job on a series of points as one file: `make` gives its text.
template <class Make>
int file_of_points(const obvid_input* input, const char* options, const Known& known,
                   const char* ending, const obvid_run* run, obvid_files** files,
                   obvid_error** error, Make&& make) {
  return guarded(error, [&]() -> Result<void> {
    const Result<Request> request = request_of(options, known);
    OBVID_TRY(request);
    const auto format = format_of_ending(ending);
    OBVID_TRY(format);
    const RunContext context = context_of(run);
    const Result<PointSeries> series = series_of(*input, *request, true, context);
    OBVID_TRY(series);
    Result<std::string> text = make(*format, *series, *request, context);
    OBVID_TRY(text);
    hand_out_file(std::move(*text), {}, files);
    return {};
  });
}

Result<TitledContour> stored_of(const obvid_input& input, const Request& request,
                                const RunContext& run) {
  const ConvertJob job{request.import, request.units};
  auto read = input.by_path ? read_convertible(input.name, job, run)
                            : parse_convertible(input.text, input.name, job, run);
  OBVID_TRY(read);
  if (auto* contour = std::get_if<TitledContour>(&*read)) return std::move(*contour);
  return error(ErrorCode::kUnsupported, "these are curves in space")
      .where(input.name)
      .hint("obvid_stored_space reads them");
}

Result<Fit> formed(const PointSeries& series, const Request& request, const RunContext& run) {
  if (!request.worksheet.construction) return fit(series, request.job, run);
  auto made = fit_construction(series, request.worksheet, run);
  if (!made) return fail(explained(series, request.worksheet, made.error(), run));
  return made;
}

/// Why `fit` finds no contour; nothing where it finds one.
Result<std::optional<Refusal>> refused(const PointSeries& series, const Request& request,
                                       const RunContext& run) {
  const Result<Fit> made = fit(series, request.job, without_progress(run));
  if (made) return std::nullopt;
  if (category(made.error().code) != ErrorCategory::kNoContour) return fail(made.error());
  auto found = explain_refusal(series, request.job, made.error(), run);
  OBVID_TRY(found);
  return std::move(*found);
}

/// The points that would have to move, else those that the refusal names.
std::vector<std::size_t> points_in_the_way(const Refusal& refusal) {
  return refusal.why && refusal.why->found ? refusal.why->moved : std::vector<std::size_t>{};
}

}  // namespace
}  // namespace obvid::capi

using namespace obvid;
using namespace obvid::capi;

extern "C" {

int obvid_fit(const obvid_input* input, const char* options, const obvid_run* run,
              obvid_contour** contour, char** report, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const Result<Request> request = request_of(options, kForming);
    OBVID_TRY(request);
    const RunContext context = context_of(run);
    const Result<PointSeries> series = series_of(*input, *request, true, context);
    OBVID_TRY(series);
    Result<Fit> made = formed(*series, *request, context);
    OBVID_TRY(made);
    Watch watch(context);
    const std::string told = report == nullptr ? "" : fit_report_json(*made, {}, &watch);
    if (watch.cancelled()) return fail(cancelled_error());
    // a construction promises nothing: its certificate says what it is
    const bool promises = !request->worksheet.construction;
    const std::optional<Error> broken = promises ? broken_promise(*made) : std::nullopt;
    auto out =
        std::make_unique<obvid_contour>(titled_contour(std::move(*made), *series, input->name));
    char* const text = report == nullptr ? nullptr : text_of(told);
    if (report != nullptr) *report = text;
    if (contour != nullptr) *contour = out.release();
    if (broken) return fail(*broken);
    return {};
  });
}

int obvid_why_not(const obvid_input* input, const char* options, const obvid_run* run,
                  char** report, obvid_error** error) {
  int code = 0;
  const int failed = guarded(error, [&]() -> Result<void> {
    const Result<Request> request = request_of(options, kFitting);
    OBVID_TRY(request);
    const RunContext context = context_of(run);
    const Result<PointSeries> series = series_of(*input, *request, true, context);
    OBVID_TRY(series);
    if (report != nullptr) *report = nullptr;
    const auto refusal = refused(*series, *request, context);
    OBVID_TRY(refusal);
    if (!*refusal) return {};
    const Refusal& found = **refusal;
    hand_out_text(refusal_json(found.error, *series, found.why, found.range, {}), report);
    code = hand_out(found.error, error, points_in_the_way(found));
    return {};
  });
  return failed != 0 ? failed : code;
}

int obvid_suggest(const obvid_input* input, const char* options, const obvid_run* run,
                  char** report, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const Result<Request> request = request_of(options, kFitting);
    OBVID_TRY(request);
    const RunContext context = context_of(run);
    const Result<PointSeries> series = series_of(*input, *request, true, context);
    OBVID_TRY(series);
    const Result<TradeOff> found = trade_off(*series, request->job, context);
    OBVID_TRY(found);
    hand_out_text(trade_off_json(*found, series->warnings, {}), report);
    if (const auto failed = not_kept(*found)) return fail(*failed);
    return {};
  });
}

int obvid_series(const obvid_input* input, const char* options, const obvid_run* run, char** report,
                 obvid_error** error) {
  return report_on_points(input, options, kImporting, run, report, error,
                          [&](PointSeries& series, const Request& /*request*/,
                              const RunContext& context) -> Result<std::string> {
                            OBVID_TRY(may_go_on(context));  // it takes no longer than reading
                            return series_json(series);
                          });
}

int obvid_analyse(const obvid_input* input, const char* options, const obvid_run* run,
                  char** report, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const Result<Request> request = request_of(options, kImporting);
    OBVID_TRY(request);
    const RunContext context = context_of(run);
    const auto text = analysed(FileFormat::kContour, *input, *request, context);
    OBVID_TRY(text);
    hand_out_text(*text, report);
    return {};
  });
}

int obvid_analyse_file(const obvid_input* input, const char* options, const char* ending,
                       const obvid_run* run, obvid_files** files, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const Result<Request> request = request_of(options, kPicturing);
    OBVID_TRY(request);
    const auto format = format_of_ending(ending);
    OBVID_TRY(format);
    auto text = analysed(*format, *input, *request, context_of(run));
    OBVID_TRY(text);
    hand_out_file(std::move(*text), {}, files);
    return {};
  });
}

int obvid_compare_file(const obvid_input* input, const char* options, const char* ending,
                       const obvid_run* run, obvid_files** files, obvid_error** error) {
  return file_of_points(input, options, kComparing, ending, run, files, error,
                        [](FileFormat format, const PointSeries& series, const Request& request,
                           const RunContext& context) -> Result<std::string> {
                          const auto found = compare_carriers(series, request.job, context);
                          OBVID_TRY(found);
                          return comparison_file(format, series, *found,
                                                 request.formats.plots.curvatures);
                        });
}

int obvid_suggest_file(const obvid_input* input, const char* options, const char* ending,
                       const obvid_run* run, obvid_files** files, obvid_error** error) {
  return file_of_points(input, options, kFitting, ending, run, files, error,
                        [](FileFormat format, const PointSeries& series, const Request& request,
                           const RunContext& context) -> Result<std::string> {
                          const auto found = trade_off(series, request.job, context);
                          OBVID_TRY(found);
                          return suggestion_file(format, *found, series.warnings);
                        });
}

int obvid_why_not_file(const obvid_input* input, const char* options, const char* ending,
                       const obvid_run* run, obvid_files** files, obvid_error** error) {
  return file_of_points(input, options, kFitting, ending, run, files, error,
                        [](FileFormat format, const PointSeries& series, const Request& request,
                           const RunContext& context) -> Result<std::string> {
                          const auto refusal = refused(series, request, context);
                          OBVID_TRY(refusal);
                          if (!*refusal) {
                            return obvid::error(ErrorCode::kBadOption,
                                                "there is a contour: nothing is in its way");
                          }
                          return refusal_file(format, **refusal, series.name, context);
                        });
}

int obvid_explain(const char* code, char** text, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    if (code == nullptr) {
      hand_out_text(error_texts_json(), text);
      return {};
    }
    const auto found = error_text_of(code);
    OBVID_TRY(found);
    hand_out_text(error_text_json(*found), text);
    return {};
  });
}

int obvid_region(const obvid_input* input, const char* options, const obvid_run* run, char** report,
                 obvid_error** error) {
  return report_on_points(
      input, options, kWorksheet, run, report, error,
      [&](PointSeries& series, const Request& request,
          const RunContext& context) -> Result<std::string> {
        const auto found = region_table(series, request.worksheet, context);
        if (!found) {
          return fail(explained(series, request.worksheet, found.error(), context));
        }
        if (const auto going = may_go_on(context); !going) return fail(going.error());
        return region_json(series, *found, context);
      });
}

int obvid_cut(const obvid_input* const* inputs, size_t count, const char* options,
              const obvid_run* run, obvid_files** files, char** report, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const Result<Request> request = request_of(options, kCutting);
    OBVID_TRY(request);
    const RunContext context = context_of(run);
    std::vector<Drawing> drawings;
    for (size_t i = 0; i < count; ++i) {
      if (inputs[i] == nullptr) {
        return fail({ErrorCode::kUsage, "an input is NULL", std::to_string(i), ""});
      }
      Result<Drawing> drawing = drawing_of(*inputs[i], *request, context);
      OBVID_TRY(drawing);
      drawings.push_back(std::move(*drawing));
    }
    CutJob job = request->cut;
    job.units = request->units;
    if (count > 0) {
      job.plan.name = std::filesystem::path(inputs[0]->name).filename().string();
    }
    auto made = make_cut(std::move(drawings), request->import, job, context);
    OBVID_TRY(made);
    std::unique_ptr<obvid_files> out;
    if (files != nullptr) {
      out = std::make_unique<obvid_files>();
      auto made_files = files_in_table(&pipeline_detail::FormatRow::cut, [&](FileFormat format) {
        return cut_file(format, *made, job, context);
      });
      OBVID_TRY(made_files);
      out->files = std::move(*made_files);
      out->remarks = made->warnings;
    }
    hand_out_text(cut_json(*made), report);
    if (files != nullptr) *files = out.release();
    return {};
  });
}

int obvid_alignment(const obvid_input* input, const obvid_input* heights, const char* options,
                    const obvid_run* run, obvid_contour** contour, obvid_files** files,
                    char** report, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    Result<Request> request = request_of(options, kAligning);
    OBVID_TRY(request);
    request->import = with_heights(request->import);
    const RunContext context = context_of(run);
    auto read_points = road_of(*input, *request, context);
    OBVID_TRY(read_points);
    const PointSeries& series = read_points->points;
    AlignmentJob& job = request->alignment;
    job.road = std::move(read_points->road);
    if (heights != nullptr) {
      auto read = heights_of(*heights);
      OBVID_TRY(read);
      job.heights = std::move(*read);
    }
    const auto made = alignment_report(series, job, context);
    OBVID_TRY(made);
    auto out = std::make_unique<obvid_contour>(titled_contour(*made, series, job, input->name));
    auto tables = std::make_unique<obvid_files>();
    tables->files.push_back({".csv", *alignment_file(FileFormat::kSamples, *made)});
    tables->files.push_back({".deviations.csv", csv_text(deviation_rows(*made))});
    if (made->profile) {
      tables->files.push_back({".profile.csv", csv_text(profile_rows(made->profile->profile))});
    }
    tables->files.push_back({".svg", *alignment_file(FileFormat::kPicture, *made)});
    tables->remarks = made->remarks;
    hand_out_text(alignment_json(*made), report);
    if (contour != nullptr) *contour = out.release();
    if (files != nullptr) *files = tables.release();
    return {};
  });
}

int obvid_worksheet(const obvid_input* input, const char* options, const char* ending,
                    const obvid_run* run, obvid_files** files, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const Result<Request> request = request_of(options, kWorksheet);
    OBVID_TRY(request);
    const RunContext context = context_of(run);
    const Result<PointSeries> series = series_of(*input, *request, true, context);
    OBVID_TRY(series);
    const auto found = region_table(*series, request->worksheet, context);
    if (!found) return fail(explained(*series, request->worksheet, found.error(), context));
    auto made = region_file(ending == nullptr ? "" : ending, *series, *found, context);
    OBVID_TRY(made);
    hand_out_file(std::move(made->text), std::move(made->remark), files);
    return {};
  });
}

int obvid_compare(const obvid_input* input, const char* options, const obvid_run* run,
                  char** report, obvid_error** error) {
  return report_on_points(
      input, options, kFitting, run, report, error,
      [&](PointSeries& series, const Request& request, const RunContext& context) {
        return compare_carriers(series, request.job, context).map([&](const Comparison& found) {
          return comparison_json(series, found);
        });
      });
}

int obvid_compare_curves(const obvid_input* const* inputs, size_t count, const char* options,
                         const obvid_run* run, obvid_files** files, char** report,
                         obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const Result<Request> request = request_of(options, kOverlaying);
    OBVID_TRY(request);
    std::vector<ComparedCurve> curves;
    std::vector<std::string> names;
    std::vector<std::vector<std::string>> warnings;
    for (size_t i = 0; i < count; ++i) {
      if (inputs[i] == nullptr) {
        return fail({ErrorCode::kUsage, "an input is NULL", std::to_string(i), ""});
      }
      auto one = curve_of(*inputs[i], *request, context_of(run));
      OBVID_TRY(one);
      names.push_back(inputs[i]->name);
      warnings.push_back(std::move(one->warnings));
      curves.push_back(std::move(one->curve));
    }
    name_curves(names, curves);
    const auto made = compare_curves(std::move(curves), request->curves, context_of(run));
    OBVID_TRY(made);
    const std::string told = curves_json(*made);
    std::unique_ptr<obvid_files> out;
    if (files != nullptr) {
      out = std::make_unique<obvid_files>();
      out->files.push_back({".svg", curves_svg(*made, request->enlarge)});
      out->files.push_back({".csv", csv_text(curves_rows(*made))});
      out->files.push_back({".json", told});
      for (size_t i = 0; i < count; ++i) {
        const std::string& of = names[i].empty() ? made->curves[i].name : names[i];
        for (const std::string& one : warnings[i]) out->remarks.push_back(of + ": " + one);
      }
      for (std::string& one : comparison_warnings(*made)) out->remarks.push_back(std::move(one));
      for (std::string& note : comparison_notes(*made)) out->remarks.push_back(std::move(note));
    }
    hand_out_text(told, report);
    if (files != nullptr) *files = out.release();
    return {};
  });
}

int obvid_stored(const obvid_input* input, const char* options, const obvid_run* run,
                 obvid_contour** contour, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const Result<Request> request = request_of(options, kImporting);
    OBVID_TRY(request);
    const RunContext context = context_of(run);
    OBVID_TRY(may_go_on(context));
    auto out = stored_of(*input, *request, context);
    OBVID_TRY(out);
    *contour = std::make_unique<obvid_contour>(std::move(*out)).release();
    return {};
  });
}

int obvid_verify(const obvid_contour* contour, const obvid_run* run, char** report,
                 obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const Result<Verification> found = verify(contour->stored, context_of(run));
    OBVID_TRY(found);
    hand_out_text(verification_json(contour->stored, *found), report);
    if (const auto broken = broken_promise(contour->stored, *found)) return fail(*broken);
    return {};
  });
}

int obvid_verify_file(const obvid_contour* contour, const char* ending, const obvid_run* run,
                      obvid_files** files, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const std::string name = std::string("answer.") + (ending == nullptr ? "" : ending);
    const auto format = proof_format_of(name);
    if (!format) return fail(no_such_answer());
    const RunContext context = context_of(run);
    const Result<Verification> found = verify(contour->stored, context);
    OBVID_TRY(found);
    auto text = verification_file(*format, contour->stored, *found, {contour->source}, context);
    OBVID_TRY(text);
    hand_out_file(std::move(*text), {}, files);
    if (const auto broken = broken_promise(contour->stored, *found)) return fail(*broken);
    return {};
  });
}
}
