// SPDX-License-Identifier: Apache-2.0
#include "space_fit.h"

#include <fmt/format.h>

#include <utility>

#include "fit_report.h"
#include "obvid/core/files.h"
#include "obvid/core/internal/file_ending.h"
#include "obvid/core/units.h"
#include "obvid/pipeline/internal/space_values.h"
#include "obvid/pipeline/space_fit.h"
#include "outputs.h"
#include "refusal.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

constexpr int kSpaceDigits = 4;

std::string number(double value) { return significant(value, kSpaceDigits); }

std::string direction_words(Vec3 d) {
  return fmt::format("({}, {}, {})", number(d.x), number(d.y), number(d.z));
}

std::string bends_words(const Fit& part) {
  const FitReport& report = part.report;
  return fmt::format(
      "{}, {} ({}), {}", counted(part.contour.pieces.size(), "piece", "pieces"),
      counted(static_cast<std::size_t>(report.vertices), "vertex", "vertices"),
      vertex_bound_text(report.vertices_lower_bound),
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

/// `numbers`: of the points in the file, from 1.
Table table_of_points(const SpaceFit& fit, const std::vector<std::size_t>& numbers) {
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
    table.row({std::to_string(numbers[i]), coordinate(p.x, size), coordinate(p.y, size),
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

std::string written_text(const Written& written) {
  Facts facts;
  for (const std::string& one : written.remarks) facts.add("note", one);
  if (!written.files.empty()) facts.add("written", listed(written.files));
  return facts.text();
}

std::string spatial_text(const SpaceFit& fit, const std::vector<std::size_t>& numbers,
                         const Written& written) {
  const std::string unit = fit.units.text();
  std::string out = bold(fit.name) + "\n";
  out += fmt::format("a {}curve in space: heights over the projection along {}; lengths in {}\n\n",
                     fit.seam ? "closed " : "", direction_words(fit.frame.normal()), unit);
  out += table_of_points(fit, numbers).text();
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
    facts.add("", fit.seam
                      ? "--continuity G3 makes the torsion continuous but at the seam, and at "
                        "joints whose slope of curvature it says to step"
                      : "--continuity G3 makes the torsion continuous but at joints whose slope "
                        "of curvature it says to step");
  }
  if (fit.seam) facts.add("seam", seam_words(*fit.seam, fit.plan.contour));
  if (fit.largest_move > 0.0) {
    facts.add("largest move", fmt::format("at most {} {}", number(fit.largest_move), unit));
  }
  out += "\n" + facts.text() + written_text(written);
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

std::string planar_text(const SpaceFit& fit, const Written& written) {
  Facts facts;
  facts.add("plane", fmt::format("the points lie in it within {} {}; the contour below is in its x "
                                 "and y",
                                 number(fit.flatness), fit.units.text()));
  add_frame(facts, fit);
  return facts.text() + "\n" + fit_report_text(fit.name, fit.plan, written);
}

std::string corner_words(const SpaceChain& chain) {
  std::vector<std::string> out;
  for (const SpaceCorner& corner : chain.corners) {
    out.push_back(
        fmt::format("point {} ({} degrees)", corner.point + 1, number(corner.turn / kOneDegree)));
  }
  return listed(out);
}

std::vector<std::size_t> part_numbers(const SpaceChain& chain, std::size_t k) {
  std::vector<std::size_t> out;
  if (chain.corners.empty()) {
    for (std::size_t i = 0; i < chain.points.size(); ++i) out.push_back(i + 1);
    return out;
  }
  out = points_of_part(chain.corners, chain.closed, chain.points.size(), k);
  for (std::size_t& one : out) ++one;
  return out;
}

std::string space_text(const SpaceChain& chain, const Written& written) {
  const SpaceFit& first = chain.parts.front();
  if (chain.corners.empty()) {
    if (!first.unrolled) return planar_text(first, written);
    return spatial_text(first, part_numbers(chain, 0), written);
  }
  Facts facts;
  facts.add("corners", corner_words(chain));
  if (chain.largest_move > 0.0) {
    facts.add("largest move",
              fmt::format("at most {} {}", number(chain.largest_move), chain.units.text()));
  }
  std::string out =
      bold(chain.name) + "\n" +
      fmt::format("{} in space, {} {}\n\n", counted(chain.parts.size(), "curve", "curves"),
                  chain.closed ? "one behind the other all round, joined at" : "joined at",
                  counted(chain.corners.size(), "corner", "corners")) +
      facts.text();
  for (std::size_t k = 0; k < chain.parts.size(); ++k) {
    const std::vector<std::size_t> numbers = part_numbers(chain, k);
    const SpaceFit& part = chain.parts[k];
    out += fmt::format("\npart {}: points {} to {}", k + 1, numbers.front(), numbers.back());
    if (part.unrolled) {
      out += "\n" + spatial_text(part, numbers, {});
    } else {
      out += ", from 1 below\n" + planar_text(part, {});
    }
  }
  const std::string written_lines = written_text(written);
  return out + (written_lines.empty() ? "" : "\n" + written_lines);
}

/// Texts first, then files: a failure to form leaves every file as it was.
Result<Written> written_files(const SpaceChain& chain, const std::vector<std::string>& outputs,
                              const ExportOptions& formats, const std::string& input) {
  Written written;
  if (outputs.empty()) return written;
  const auto nurbs = chain_nurbs(chain, formats.tolerance);
  OBVID_TRY(nurbs);
  for (std::size_t k = 0; k < nurbs->size(); ++k) {
    const SpaceNurbs& one = (*nurbs)[k];
    if (!(one.deviation > 0.0)) continue;
    const std::string which = chain.corners.empty() ? "the curve" : fmt::format("part {}", k + 1);
    written.remarks.push_back(
        fmt::format("a C2 cubic of {} points stands for {}, at most {} {} from it",
                    one.curve.points.size(), which, number(one.deviation), chain.units.text()));
  }
  std::vector<Output> texts;
  for (const std::string& path : outputs) {
    auto made = export_space(chain, *nurbs, path, formats);
    if (!made) {
      if (made.error().where.empty()) made.error().where = path;
      return fail(made.error());
    }
    for (const ExportedFile& file : made->files) {
      const auto name = path_of_part(path, file.suffix);
      OBVID_TRY(name);
      texts.push_back({*name, FileFormat::kContour, file.text});
    }
    for (const std::string& one : made->remarks) written.remarks.push_back(one);
  }
  auto done = write_files(texts, input);
  OBVID_TRY(done);
  written.files = std::move(*done);
  return written;
}

Result<SpaceJob> space_job(const FitOptions& options, const SpaceSeries& series) {
  SpaceJob job;
  job.fit = options.job;
  job.along = options.along;
  if (options.construction || options.suggest) {
    return error(ErrorCode::kBadOption, "points in space are formed as spirals")
        .where(options.suggest ? "--suggest" : "--construction")
        .hint("--flat forms the contour in the plane of x and y");
  }
  const auto text = options.text ? Result<std::string>(*options.text) : read_file(options.input);
  OBVID_TRY(text);
  auto fixed = fixed_in_space(series, *text, options.along, options.name(), options.import);
  OBVID_TRY(fixed);
  job.fixed = std::move(*fixed);
  return job;
}

std::string verdict_of_part(const StoredContour& stored, const Verification& found) {
  return found.false_claim ? "NOT as claimed: " + found.false_claim->what
                           : verdict_line(stored.contour.carrier, found.certificate);
}

void add_verified(Facts& facts, const StoredSpace& stored, const SpaceVerification& found) {
  const std::string unit = stored.units.text();
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
}

std::string verification_in_space(const StoredSpaceChain& stored,
                                  const SpaceChainVerification& found) {
  std::string out;
  for (std::size_t k = 0; k < stored.parts.size(); ++k) {
    Facts facts;
    add_verified(facts, stored.parts[k], found.parts[k]);
    if (!stored.corners.empty()) out += fmt::format("part {}\n", k + 1);
    out += facts.text() + (stored.corners.empty() ? "" : "\n");
  }
  if (!stored.corners.empty()) {
    Facts facts;
    facts.add("corners", corner_words(space_chain_of(stored)));
    facts.add("not checked", listed(found.not_checked));
    out += facts.text();
  }
  const auto broken = broken_promise(stored, found);
  const std::string verdict = !broken ? "as claimed, and proved"
                              : broken->code == ErrorCode::kFalseClaim
                                  ? "NOT as claimed: " + broken->what
                                  : broken->what;
  return out + (broken ? bad(verdict) : good(verdict)) + "\n";
}

}  // namespace

int verify_in_space(const StoredSpaceChain& stored, const std::string& name,
                    const VerifyOptions& options) {
  const SpaceChainVerification found = verify(stored);
  std::string shown;
  std::vector<Output> files;
  if (options.csv) {
    return report({ErrorCode::kBadOption, "of curves in space there is no table of pieces", "--csv",
                   "--json has all of it"});
  }
  for (const std::string& path : options.outputs) {
    if (!has_ending(path, ".json")) {
      return report({ErrorCode::kUnknownFormat, "answers about curves in space are JSON", path,
                     "name a .json"});
    }
    files.push_back({path, {}, space_verification_json(stored, found)});
  }
  if (auto done = write_files(files); !done) return report(done.error());
  if (options.json) {
    shown = space_verification_json(stored, found);
  } else if (!options.quiet) {
    shown = verification_in_space(stored, found);
  }
  if (auto done = put(shown); !done) return report(done.error());
  if (auto error = broken_promise(stored, found)) {
    error->where = name + (error->where.empty() ? "" : ": " + error->where);
    return report(*error);
  }
  return 0;
}

int convert_in_space(const StoredSpaceChain& stored, const ConvertOptions& options) {
  SpaceChain chain = space_chain_of(stored);
  if (options.units) {
    if (auto told = take_units(chain, *options.units)) warn({*told});
  }
  const auto written = written_files(chain, options.outputs, options.formats, options.input);
  if (!written) return report(written.error());
  std::string shown;
  if (!options.quiet) {
    if (!options.profile.empty()) shown += options.profile + "\n";
    for (const std::string& remark : written->remarks) shown += remark + "\n";
    shown += "written  " + listed(written->files) + "\n";
  }
  if (auto done = put(shown); !done) return report(done.error());
  return 0;
}

std::optional<int> run_in_space(const FitOptions& options) {
  if (options.flat) return std::nullopt;
  auto series = options.text
                    ? parse_space_series(*options.text, options.name(), options.along.has_value(),
                                         options.import)
                    : space_series(options.input, options.along.has_value(), options.import);
  if (options.along && series && !*series) {
    return report(error(ErrorCode::kBadOption, "there are no points x, y, z whose z changes")
                      .where("--along")
                      .hint("it is for a list of points whose rows have all their cells"));
  }
  if (!series || !*series) return std::nullopt;  // whoever reads points says what is wrong
  if (const auto may = check_space_import(options.import); !may) return report(may.error());
  if (options.units) (*series)->units = *options.units;
  if (auto free = check_outputs(options.outputs, {&options.input, 1}); !free) {
    return report(free.error());
  }
  const auto job = space_job(options, **series);
  if (!job) return report(job.error());
  ProgressBar bar(options.progress && !options.quiet);
  auto made = fit_space_chain(**series, *job, bar.progress());
  bar.clear();
  if (!made) return report(made.error());
  const auto written = written_files(*made, options.outputs, options.formats, options.input);
  if (!written) return report(written.error());
  warn(made->warnings);
  std::string text;
  if (options.json) {
    const auto nurbs = chain_nurbs(*made, options.formats.tolerance);
    if (!nurbs) return report(nurbs.error());
    text = space_chain_json(*made, *nurbs);
  } else if (!options.quiet) {
    text = space_text(*made, *written);
  }
  if (auto done = put(text); !done) return report(done.error());
  if (auto broken = broken_promise(*made)) return report(*broken);
  return 0;
}

}  // namespace obvid
