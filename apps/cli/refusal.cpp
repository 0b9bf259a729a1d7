// SPDX-License-Identifier: Apache-2.0
#include "refusal.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "json_text.h"
#include "obvid/io/contour_json.h"
#include "obvid/io/picture_svg.h"
#include "obvid/pipeline/feasible_range.h"
#include "obvid/pipeline/why_not.h"
#include "outputs.h"
#include "table.h"
#include "text.h"

namespace obvid {
namespace {

constexpr std::size_t kMostRows = 12;
constexpr int kToleranceDigits = 3;  // those of `WhyNot::tolerance`, so that it can be typed again

std::string tolerance_text(const WhyNot& why, const std::string& units) {
  return fmt::format("tolerance of {} {}", significant(why.tolerance, kToleranceDigits), units);
}

std::string counts_of_fit(const Fit& fit) {
  const auto count = [](int n) { return static_cast<std::size_t>(std::max(n, 0)); };
  return counted(count(fit.report.vertices), "vertex", "vertices") + " and " +
         counted(count(fit.report.inflections), "inflection", "inflections");
}

Error with_tolerance(Error error, const std::optional<WhyNot>& why, const PointSeries& series) {
  const std::string units = series.units.text();
  if (!error.hint.empty()) error.hint += "; ";
  if (!why) {
    error.hint += "moving every point by up to a tenth of the size does not help";
  } else if (why->found && why->next_to_nothing) {
    error.hint += "no point is in the way: with " + counts_of_fit(why->fit) + " there is one: " +
                  noise_option(why->tolerance, why->fit.contour.closed, series) + " allows them";
  } else if (why->found) {
    error.hint += "within a " + tolerance_text(*why, units) +
                  " there is one: " + noise_option(why->tolerance, why->fit.contour.closed, series);
  } else {
    error.hint += fmt::format(
        "the search for a tolerance that would do ended at its limit: up to {} {} none was found",
        significant(why->refused, kToleranceDigits), units);
  }
  return error;
}

/// "heading of 41.2 or 52.9 deg at point 3".
std::string feasible_text(const FeasibleRange& range, const std::string& units) {
  const bool heading = range.datum == FeasibleRange::Datum::kHeading;
  const double unit = heading ? std::numbers::pi / 180.0 : 1.0;
  // the ends of a range are short decimal fractions
  return fmt::format("{} of {:.12g} or {:.12g} {} at point {}", heading ? "heading" : "curvature",
                     range.least / unit, range.greatest / unit,
                     heading ? "deg" : fmt::format("1/{}", units), range.point + 1);
}

Error with_range(Error error, const std::optional<FeasibleRange>& range, const std::string& units) {
  if (!range) return error;
  if (!error.hint.empty()) error.hint += "; ";
  error.hint += "with a " + feasible_text(*range, units) + " there is one";
  return error;
}

void add_range(JsonText& json, const std::optional<FeasibleRange>& range) {
  if (!range) {
    json.null();
    return;
  }
  const bool heading = range->datum == FeasibleRange::Datum::kHeading;
  json.begin_object().pair("index", range->point).pair("datum", heading ? "heading" : "curvature");
  json.pair("asked", range->asked).pair("least", range->least);
  json.pair("greatest", range->greatest).end_object();
}

std::string moves_table(const WhyNot& why) {
  Table table;
  table.column("point");
  table.column("x");
  table.column("y");
  table.column("move");
  const std::size_t shown = std::min(why.moved.size(), kMostRows);
  for (std::size_t k = 0; k < shown; ++k) {
    const std::size_t i = why.moved[k];
    const Vec2 p = why.fit.contour.points[i];
    table.row({std::to_string(i + 1), significant(p.x), significant(p.y),
               significant(why.fit.report.moves[i], 4)});
  }
  std::string text = table.text();
  if (why.moved.size() > shown) text += fmt::format("... {} more\n", why.moved.size() - shown);
  return text;
}

std::string points_in_the_way_text(const PointSeries& series, const WhyNot& why) {
  std::string text = fmt::format(
      "points that would have to move, the farthest first; lengths in {}\n\n", series.units.text());
  text += moves_table(why);
  text += fmt::format("\nWithin a {} for every point such a contour exists and is proved: {}.\n",
                      tolerance_text(why, series.units.text()),
                      noise_option(why.tolerance, why.fit.contour.closed, series));
  if (why.refused > 0.0) {
    text += fmt::format("Within {} {} none was found.\n",
                        significant(why.refused, kToleranceDigits), series.units.text());
  }
  return text;
}

std::string refusal_text(const PointSeries& series, const WhyNot& why,
                         const std::vector<std::string>& written) {
  std::string text;
  if (!series.name.empty()) text += bold(series.name) + "\n";
  if (why.next_to_nothing) {
    text += fmt::format(
        "No point is in the way. A contour with {} exists and is proved: {} allows them.\n",
        counts_of_fit(why.fit), noise_option(why.tolerance, why.fit.contour.closed, series));
  } else {
    text += points_in_the_way_text(series, why);
  }
  if (why.stopped) {
    text += "The search ended at its limit of work: a tolerance between them may do as well.\n";
  }
  if (!written.empty()) {
    text +=
        fmt::format("picture of that contour: {}; no other file was written\n", listed(written));
  }
  return text;
}

void add_why_not(JsonText& json, const WhyNot& why) {
  StoredContour bare;  // the writer of the contour file decides how report and certificate look
  bare.contour.units = why.fit.contour.units;
  bare.contour.carrier = why.fit.contour.carrier;
  bare.report = why.fit.report;
  bare.certificate = why.fit.certificate;
  const std::string stored = contour_to_json(bare);
  json.begin_object();
  json.pair("refused", why.refused).pair("stopped", why.stopped).key("tolerance");
  if (!why.found) {
    json.null().end_object();
    return;
  }
  json.value(why.tolerance).pair("next_to_nothing", why.next_to_nothing);
  json.key("points").begin_array();
  for (const std::size_t i : why.moved) {
    const Vec2 p = why.fit.contour.points[i];
    json.begin_object().pair("index", i).pair("x", p.x).pair("y", p.y);
    json.pair("move", why.fit.report.moves[i]).end_object();
  }
  json.end_array();
  json.key("report").raw(top_level_value(stored, "report"));
  json.key("certificate").raw(top_level_value(stored, "certificate"));
  json.end_object();
}

std::string refusal_json(const Error& error, const PointSeries& series,
                         const std::optional<WhyNot>& why,
                         const std::optional<FeasibleRange>& range,
                         const std::vector<std::string>& written) {
  JsonText json;
  json.begin_object();
  add_units(json, series.units);
  json.key("error").begin_object();
  json.pair("code", fmt::format("E{}", static_cast<int>(error.code))).pair("what", error.what);
  json.pair("where", error.where).pair("hint", error.hint).end_object();
  json.key("why_not");
  if (why) {
    add_why_not(json, *why);
  } else {
    json.null();
  }
  json.key("feasible_range");
  add_range(json, range);
  json.key("warnings").begin_array();
  for (const std::string& warning : series.warnings) json.value(warning);
  json.end_array().key("written").begin_array();
  for (const std::string& file : written) json.value(file);
  json.end_array().end_object();
  return json.take();
}

/// NAME.why-not.svg for each picture: what failed must not look like a success.
Result<std::vector<std::string>> write_refusal_pictures(const FitOptions& options,
                                                        const std::string& name,
                                                        const WhyNot& why) {
  const Result<std::vector<Output>> asked = outputs_of(options.outputs, options.input);
  if (!asked) return fail(asked.error());
  std::vector<Output> pictures;
  for (const Output& output : *asked) {
    if (output.format != FileFormat::kPicture) continue;
    const auto path = std::filesystem::path(output.path).replace_extension(".why-not.svg");
    Result<Output> picture = output_of(path.string());
    if (!picture) return fail(picture.error());
    picture->text = picture_svg({why.fit.contour, why.fit.report, why.fit.certificate}, {name, ""});
    pictures.push_back(std::move(*picture));
  }
  return write_files(pictures, options.input);
}

}  // namespace

int tell_refusal(const FitOptions& options, const PointSeries& series, const Error& refusal,
                 ProgressBar& bar) {
  // tolerances of points do not help a carrier that cannot keep what was given
  const bool by_points = refusal.code != ErrorCode::kCarrierCannotKeep;
  const std::optional<WhyNot> why =
      by_points ? why_not(series, options.job, refusal, bar.progress()) : std::nullopt;
  const std::optional<FeasibleRange> range =
      feasible_range(series, options.job, refusal, bar.progress());
  Result<std::vector<std::string>> written;
  if (why && why->found) written = write_refusal_pictures(options, series.name, *why);
  bar.clear();
  warn(series.warnings);  // a formed contour carries them itself
  const Error told = with_range(by_points ? with_tolerance(refusal, why, series) : refusal, range,
                                series.units.text());
  const int code = report(told);
  const std::vector<std::string> names = written ? *written : std::vector<std::string>{};
  if (!written) warn({written.error().what + " (" + written.error().where + ")"});
  std::string text;
  if (options.json) {
    text = refusal_json(told, series, why, range, names);
  } else if (why && why->found && !options.quiet) {
    text = refusal_text(series, *why, names);
  }
  if (auto done = put(text); !done) warn({done.error().what});
  return code;
}

}  // namespace obvid
