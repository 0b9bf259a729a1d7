// SPDX-License-Identifier: Apache-2.0
#include "space_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "fit_report.h"
#include "obvid/cad/cad.h"
#include "obvid/exchange/space_dxf.h"
#include "obvid/io/atomic_file.h"
#include "obvid/io/read_points.h"
#include "obvid/io/verdict.h"
#include "obvid/pipeline/space_fit.h"
#include "outputs.h"
#include "refusal.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

constexpr int kSpaceDigits = 4;
constexpr std::size_t kDefaultSamples = 200;
constexpr double kSpaceTolerance = 1e-6;  ///< of the size
constexpr const char* kSpaceEndings =
    ".json (everything), .step, .iges, .brep, .dxf, .csv (samples), .sldcrv (points)";

std::string number(double value) { return significant(value, kSpaceDigits); }

std::string direction_words(Vec3 d) {
  return fmt::format("({}, {}, {})", number(d.x), number(d.y), number(d.z));
}

std::string bends_words(const Fit& part) {
  const FitReport& report = part.report;
  return fmt::format(
      "{}, {} (the points force at least {}), {}",
      counted(part.contour.pieces.size(), "piece", "pieces"),
      counted(static_cast<std::size_t>(report.vertices), "vertex", "vertices"),
      report.vertices_lower_bound,
      counted(static_cast<std::size_t>(report.inflections), "inflection", "inflections"));
}

/// `projection`: the seam is where it begins.
std::string seam_words(const SpaceSeam& seam, const Contour& projection) {
  return fmt::format(
      "at point {}: the heights meet there within {} of the length, {} rad and {} of the curvature",
      projection.joints.front().source.value_or(0) + 1, number(seam.position), number(seam.heading),
      number(seam.curvature));
}

std::string torsion_cell(const SpacePoint& point) {
  if (!point.torsion || !point.torsion_after) return "-";
  const std::string before = number(*point.torsion), after = number(*point.torsion_after);
  return before == after ? before : before + " | " + after;
}

Table table_of_points(const SpaceFit& fit) {
  Table table;
  for (const char* head :
       {"point", "x", "y", "z", "length of\nprojection", "height", "curvature"}) {
    table.column(head);
  }
  table.column("torsion\nbefore | after", Table::Align::kLeft);
  const double size = size_of(fit);
  for (std::size_t i = 0; i < fit.at_points.size() && i < fit.points.size(); ++i) {
    const SpacePoint& at = fit.at_points[i];
    const Vec3& p = fit.points[i];
    table.row({std::to_string(i + 1), coordinate(p.x, size), coordinate(p.y, size),
               coordinate(p.z, size), coordinate(at.plan_length, size), coordinate(at.height, size),
               number(at.curvature), torsion_cell(at)});
  }
  return table;
}

void add_frame(Facts& facts, const SpaceFit& fit) {
  facts.add("frame", fmt::format("x {}, y {}, normal {}, origin {}", direction_words(fit.frame.x),
                                 direction_words(fit.frame.y), direction_words(fit.frame.normal()),
                                 direction_words(fit.frame.origin)));
}

std::string spatial_text(const SpaceFit& fit, const std::vector<std::string>& remarks,
                         const std::vector<std::string>& files) {
  const std::string unit = fit.units.text();
  std::string out = bold(fit.name) + "\n";
  out += fmt::format("a {}curve in space: heights over the projection along {}; lengths in {}\n\n",
                     fit.seam ? "closed " : "", direction_words(fit.frame.normal()), unit);
  out += table_of_points(fit).text();
  Facts facts;
  add_frame(facts, fit);
  facts.add("projection", bends_words(fit.plan));
  facts.add("heights", bends_words(*fit.unrolled) + ", over the arc length of the projection" +
                           (fit.seam ? ", not counting one at the seam" : ""));
  facts.add("curvature",
            fmt::format("between {} and {} 1/{} everywhere, continuous",
                        number(fit.least_curvature), number(fit.largest_curvature), unit));
  facts.add("torsion", fmt::format("{} to {} 1/{} at {} places (not bounded between them); steps "
                                   "by up to {} at joints",
                                   number(fit.least_torsion), number(fit.largest_torsion), unit,
                                   fit.torsion_places, number(fit.torsion_step)));
  if (fit.plan.contour.continuity == Continuity::kG2) {
    facts.add("", fit.seam ? "--continuity G3 makes the torsion continuous but at the seam"
                           : "--continuity G3 makes the torsion continuous");
  }
  if (fit.seam) facts.add("seam", seam_words(*fit.seam, fit.plan.contour));
  if (fit.largest_move > 0.0) {
    facts.add("largest move", fmt::format("at most {} {}", number(fit.largest_move), unit));
  }
  for (const std::string& one : remarks) facts.add("note", one);
  if (!files.empty()) facts.add("written", listed(files));
  out += "\n" + facts.text();
  const bool proved = fit.plan.certificate.proved && fit.unrolled->certificate.proved;
  if (proved) {
    return out +
           good(
               "proved: projection and heights have monotone curvature on every run and G2 "
               "joints; the curvature of the space curve is continuous, not promised to be "
               "monotone") +
           "\n";
  }
  const Fit& part = fit.plan.certificate.proved ? *fit.unrolled : fit.plan;
  return out + bad(verdict_line(part.contour.carrier, part.certificate)) + "\n";
}

std::string planar_text(const SpaceFit& fit, const std::vector<std::string>& remarks,
                        const std::vector<std::string>& files) {
  Facts facts;
  facts.add("plane", fmt::format("the points lie in it within {} {}; the contour below is in its x "
                                 "and y",
                                 number(fit.flatness), fit.units.text()));
  add_frame(facts, fit);
  Written written;
  written.remarks = remarks;
  written.files = files;
  return facts.text() + "\n" + fit_report_text(fit.name, fit.plan, written);
}

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// One output of a space curve.
Result<std::string> space_file(const std::string& path, const SpaceFit& fit,
                               const SpaceNurbs& nurbs, const ExportOptions& formats) {
  const std::string ending = ending_of(path);
  const std::size_t samples = formats.samples.count.value_or(kDefaultSamples);
  if (ending == ".json") return space_fit_json(fit, nurbs);
  if (ending == ".dxf") return space_dxf({nurbs.curve}, fit.points, fit.units);
  if (ending == ".csv") return space_samples_csv(fit, samples);
  if (ending == ".sldcrv") return space_points_text(fit, samples);
  CadWriteOptions write;
  write.units = fit.units.name;
  write.face_width = formats.face_width;
  write.format = formats.step;
  const bool step = ending == ".step" || ending == ".stp";
  const bool iges = ending == ".iges" || ending == ".igs";
  if (iges) write.format = CadFormat::kIges;
  if (ending == ".brep") write.format = CadFormat::kBrep;
  if (step || iges || ending == ".brep") return cad_text({{"contour", nurbs.curve}}, write);
  return fail({ErrorCode::kUnknownFormat, "no file with this extension holds a curve in space",
               path,
               std::string("possible are ") + kSpaceEndings +
                   "; --flat forms the contour in the plane of x and y"});
}

Result<std::vector<std::string>> written_files(const SpaceFit& fit,
                                               const std::vector<std::string>& outputs,
                                               const ExportOptions& formats,
                                               std::vector<std::string>& remarks) {
  if (outputs.empty()) return outputs;
  const double tolerance = formats.tolerance.value_or(kSpaceTolerance * size_of(fit));
  const auto nurbs = space_nurbs(fit, tolerance);
  if (!nurbs) return fail(nurbs.error());
  if (nurbs->deviation > 0.0) {
    remarks.push_back(
        fmt::format("a C2 cubic of {} points stands for the curve, at most {} {} "
                    "from it",
                    nurbs->curve.points.size(), number(nurbs->deviation), fit.units.text()));
  }
  std::vector<std::string> texts;
  for (const std::string& path : outputs) {
    auto text = space_file(path, fit, *nurbs, formats);
    if (!text) return fail(text.error());
    texts.push_back(std::move(*text));
  }
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (auto done = write_file(outputs[i], texts[i]); !done) return fail(done.error());
  }
  return outputs;
}

Result<SpaceJob> space_job(const FitOptions& options, const SpaceSeries& series) {
  SpaceJob job;
  job.fit = options.job;
  job.along = options.along;
  if (options.construction || options.suggest) {
    return fail({ErrorCode::kBadOption, "points in space are formed as spirals",
                 options.suggest ? "--suggest" : "--construction",
                 "--flat forms the contour in the plane of x and y"});
  }
  const auto plane = options.text ? parse_points(*options.text, options.name(), TwoPoints::kDo)
                                  : read_points(options.input, TwoPoints::kDo);
  if (!plane || plane->fixed.empty()) return job;
  if (plane->points.size() != series.points.size()) {
    return fail({ErrorCode::kBadOption,
                 "headings and radii of points that lie above each other have no projection",
                 options.name(), "--flat forms the contour in the plane of x and y"});
  }
  job.fixed = plane->fixed;
  const bool plan_view = options.along && options.along->x == 0.0 && options.along->y == 0.0;
  if (plan_view) return job;
  return fail({ErrorCode::kBadOption,
               "the file fixes headings, radii or tolerances of points in space", options.name(),
               "--along Z takes them as seen in the plane of x and y, --flat forms the contour in "
               "that plane alone"});
}

std::string verdict_of_part(const StoredContour& stored, const Verification& found) {
  return found.false_claim ? "NOT as claimed: " + found.false_claim->what
                           : verdict_line(stored.contour.carrier, found.certificate);
}

std::string verification_in_space(const StoredSpace& stored, const SpaceVerification& found) {
  const std::string unit = stored.units.text();
  Facts facts;
  facts.add(stored.heights ? "projection" : "contour", verdict_of_part(stored.plan, found.plan));
  if (stored.heights) facts.add("heights", verdict_of_part(*stored.heights, *found.heights));
  facts.add("file claims", "below, compared with what follows from frame, points and contours");
  facts.add("flatness", fmt::format("{} {}", number(stored.flatness), unit));
  facts.add("largest move", fmt::format("at most {} {}", number(stored.largest_move), unit));
  if (stored.heights) {
    const SpaceFigures& f = stored.figures;
    facts.add("curvature", fmt::format("between {} and {} 1/{}", number(f.least_curvature),
                                       number(f.largest_curvature), unit));
    facts.add("torsion", fmt::format("{} to {} 1/{} at {} places, steps by up to {} at joints",
                                     number(f.least_torsion), number(f.largest_torsion), unit,
                                     f.torsion_places, number(f.torsion_step)));
    if (stored.seam) facts.add("seam", seam_words(*stored.seam, stored.plan.contour));
  }
  facts.add("NURBS curve", stored.deviation > 0.0 ? fmt::format("at most {} {} from the curve",
                                                                number(stored.deviation), unit)
                                                  : std::string("the contour itself"));
  facts.add("not checked", listed(found.not_checked));
  const auto broken = broken_promise(stored, found);
  const std::string verdict = !broken ? "as claimed, and proved"
                              : broken->code == ErrorCode::kFalseClaim
                                  ? "NOT as claimed: " + broken->what
                                  : broken->what;
  return facts.text() + (broken ? bad(verdict) : good(verdict)) + "\n";
}

}  // namespace

int verify_in_space(const std::string& text, const std::string& name,
                    const VerifyOptions& options) {
  const Result<StoredSpace> stored = space_from_json(text, name);
  if (!stored) return report(stored.error());
  const SpaceVerification found = verify(*stored);
  std::string shown;
  if (options.json) {
    shown = space_verification_json(*stored, found) + "\n";
  } else if (!options.quiet) {
    shown = verification_in_space(*stored, found);
  }
  if (auto done = put(shown); !done) return report(done.error());
  if (auto error = broken_promise(*stored, found)) {
    error->where = name + (error->where.empty() ? "" : ": " + error->where);
    return report(*error);
  }
  return 0;
}

int convert_in_space(const std::string& text, const std::string& name,
                     const ConvertOptions& options) {
  const Result<StoredSpace> stored = space_from_json(text, name);
  if (!stored) return report(stored.error());
  SpaceFit fit = space_fit_of(*stored);
  if (options.units) {
    if (auto told = take_units(fit.units, *options.units)) warn({*told});
    fit.plan.contour.units = fit.units;
    if (fit.unrolled) fit.unrolled->contour.units = fit.units;
  }
  std::vector<std::string> remarks;
  const auto files = written_files(fit, options.outputs, options.formats, remarks);
  if (!files) return report(files.error());
  std::string shown;
  if (!options.quiet) {
    if (!options.profile.empty()) shown += options.profile + "\n";
    for (const std::string& remark : remarks) shown += remark + "\n";
    shown += "written  " + listed(*files) + "\n";
  }
  if (auto done = put(shown); !done) return report(done.error());
  return 0;
}

std::optional<int> run_in_space(const FitOptions& options) {
  if (options.flat) return std::nullopt;
  auto series = options.text
                    ? parse_space_series(*options.text, options.name(), options.along.has_value())
                    : space_series(options.input, options.along.has_value());
  if (options.along && series && !*series) {
    return report({ErrorCode::kBadOption, "there are no points x, y, z whose z changes", "--along",
                   "it is for a list of points whose rows have all their cells", -1, 0.0});
  }
  if (!series || !*series) return std::nullopt;  // whoever reads points says what is wrong
  if (options.units) (*series)->units = *options.units;
  if (auto free = check_outputs(options.outputs, {&options.input, 1}); !free) {
    return report(free.error());
  }
  const auto job = space_job(options, **series);
  if (!job) return report(job.error());
  ProgressBar bar(options.progress && !options.quiet);
  auto made = fit_space(**series, *job, bar.progress());
  bar.clear();
  if (!made) return report(made.error());
  std::vector<std::string> remarks;
  const auto files = written_files(*made, options.outputs, options.formats, remarks);
  if (!files) return report(files.error());
  warn(made->warnings);
  std::string text;
  if (options.json) {
    const auto nurbs =
        space_nurbs(*made, options.formats.tolerance.value_or(kSpaceTolerance * size_of(*made)));
    if (!nurbs) return report(nurbs.error());
    text = space_fit_json(*made, *nurbs);
  } else if (!options.quiet) {
    text =
        made->unrolled ? spatial_text(*made, remarks, *files) : planar_text(*made, remarks, *files);
  }
  if (auto done = put(text); !done) return report(done.error());
  for (const Fit* part : {&made->plan, made->unrolled ? &*made->unrolled : nullptr}) {
    if (part == nullptr) continue;
    if (auto broken = broken_promise(*part)) return report(*broken);
  }
  return 0;
}

}  // namespace obvid
