// SPDX-License-Identifier: Apache-2.0
// A contour as one page for a report: verdict, picture, figures, segments.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

#include "files/file_units.h"
#include "files/format_writers.h"
#include "obvid/core/internal/figures.h"
#include "obvid/core/internal/shown_text.h"
#include "obvid/core/units.h"
#include "obvid/core/version.h"
#include "obvid/pipeline/internal/lines_and_arcs.h"
#include "obvid/pipeline/internal/promise.h"

namespace obvid::pipeline_detail {
namespace {

constexpr std::size_t kMostSegments = 1000;  // rows of the table

constexpr const char* kPageStyle = R"(<style>
:root { color-scheme: light dark; --ink: #1c2733; --faint: #5b6773; --paper: #fff; --line: #d5dbe1; --good: #1a7f37; --bad: #c62828; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6eaee; --faint: #9aa6b2; --paper: #14191f; --line: #39434f; --good: #57d27a; --bad: #ff7b72; } }
body { margin: 2em auto; max-width: 1000px; padding: 0 1em; background: var(--paper); color: var(--ink); font: 15px/1.5 system-ui, sans-serif; }
svg { display: block; width: 100%; height: auto; margin: 1em 0; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; font-size: 1.15em; padding: 1em 0 .3em; }
th, td { text-align: left; padding: .2em 1.5em .2em 0; border-bottom: 1px solid var(--line); vertical-align: top; font-weight: normal; }
th { color: var(--faint); }
.numbers th, .numbers td { text-align: right; }
#verdict { font-weight: 600; }
#verdict.kept { color: var(--good); }
#verdict.broken { color: var(--bad); }
footer { color: var(--faint); margin-top: 2em; }
@media print { body { margin: 0; } thead { display: table-header-group; } tr, svg { break-inside: avoid; } }
</style>)";

std::string figure_row(const std::string& label, const std::string& value) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escaped_xml(label),
                     escaped_xml(value));
}

std::string length_text(double value, const Contour& contour) {
  return std::isnan(value) ? "unknown" : significant(value, 4) + " " + contour.units.text();
}

std::string contour_rows(const Contour& contour) {
  std::string out = figure_row(
      "contour", fmt::format("{}, {} through {} in {}", contour.closed ? "closed" : "open",
                             counted(contour.pieces.size(), "piece", "pieces"),
                             counted(contour.points.size(), "point", "points"),
                             counted(contour.runs.size(), "run", "runs")));
  out += figure_row("carrier", to_string(contour.carrier));
  return out + figure_row("lengths in", contour.units.text());
}

std::string gap_rows(const Contour& contour, const Certificate& certificate) {
  std::string out = figure_row("joint gaps", gaps_text(contour.carrier, certificate.gaps));
  if (certificate.corners > 0) out += figure_row("corners", std::to_string(certificate.corners));
  if (certificate.self_intersections > 0) {
    out += figure_row("self-intersections", std::to_string(certificate.self_intersections));
  }
  return out;
}

std::string fairness_rows(const FitReport& report) {
  std::string out = figure_row(
      "vertices",
      fmt::format("{} ({})", report.vertices, vertex_bound_text(report.vertices_lower_bound)));
  out += figure_row("inflections", std::to_string(report.inflections));
  if (report.waviness) {
    out += figure_row("waviness", fmt::format("{} hills of the slope of curvature on a run",
                                              significant(*report.waviness, 4)));
  }
  return out;
}

std::string accuracy_rows(const Contour& contour, const FitReport& report) {
  std::string out;
  if (report.largest_move > 0.0) {
    out += figure_row("largest move of a point", length_text(report.largest_move, contour));
  }
  if (promises_monotone(contour.carrier)) {
    out += figure_row("largest width of the region",
                      fmt::format("{} (tolerance {})", length_text(report.largest_width, contour),
                                  significant(report.tolerance, 4)));
    out += figure_row("largest error with these tangents and curvatures",
                      length_text(report.largest_deviation, contour));
    out += figure_row("bound needed",
                      counted(report.inserted_points, "inserted element", "inserted elements"));
  }
  if (report.carrier_deviation) {
    out += figure_row("from the spirals, as measured",
                      length_text(*report.carrier_deviation, contour));
  }
  return out;
}

std::string given_rows(const GivenReport& given) {
  std::string out;
  if (given.headings + given.heading_ranges > 0) {
    out += figure_row("given headings met",
                      fmt::format("{}; largest miss {} rad", given.headings + given.heading_ranges,
                                  significant(given.heading_miss, 2)));
  }
  if (given.curvatures + given.curvature_ranges > 0) {
    out += figure_row("given radii met", fmt::format("{}; largest miss {} of the curvature",
                                                     given.curvatures + given.curvature_ranges,
                                                     significant(given.curvature_miss, 2)));
  }
  if (given.corners > 0) out += figure_row("given corners met", std::to_string(given.corners));
  return out;
}

/// Those that are shown: all, or the widest, in their order.
std::vector<std::size_t> segments_of_page(const std::vector<SegmentReport>& segments) {
  std::vector<std::size_t> shown(segments.size());
  std::iota(shown.begin(), shown.end(), std::size_t{0});
  if (shown.size() <= kMostSegments) return shown;
  std::stable_sort(shown.begin(), shown.end(), [&](std::size_t a, std::size_t b) {
    return segments[a].width > segments[b].width;
  });
  shown.resize(kMostSegments);
  std::sort(shown.begin(), shown.end());
  return shown;
}

std::string segments_table(const FitReport& report) {
  const std::vector<std::size_t> shown = segments_of_page(report.segments);
  if (shown.empty()) return {};
  std::string out = "<table id=\"segments\" class=\"numbers\"><caption>Segments";
  if (shown.size() < report.segments.size()) {
    out += fmt::format(", the {} widest of {}", shown.size(), report.segments.size());
  }
  out +=
      "</caption>\n<thead><tr><th>points</th><th>chord</th><th>points-only error</th>"
      "<th>region width</th><th>largest error</th><th>inserted "
      "elements</th></tr></thead>\n<tbody>\n";
  for (const std::size_t i : shown) {
    const SegmentReport& s = report.segments[i];
    out += fmt::format(
        "<tr><td>{}-{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        s.from.value_or(0) + 1, s.to.value_or(0) + 1, significant(s.chord),
        significant(s.points_only_error, 4), significant(s.width, 4), significant(s.deviation, 4),
        s.inserted);
  }
  return out + "</tbody></table>\n";
}

std::string lines_and_arcs_table(const Contour& contour) {
  const std::vector<LineOrArc> all = lines_and_arcs(contour);
  if (all.empty()) return {};
  std::string out =
      "<table id=\"lines\" class=\"numbers\"><caption>Lines and arcs</caption>\n<thead><tr>"
      "<th>points</th><th>radius</th><th>centre x</th><th>centre y</th><th>heading at start</th>"
      "<th>length</th><th>farthest point</th></tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < std::min(all.size(), kMostSegments); ++i) {
    const LineOrArc& one = all[i];
    const bool line = one.kappa == 0.0;
    out += fmt::format(
        "<tr><td>{}-{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}°</td><td>{}</td><td>{}</td>"
        "</tr>\n",
        one.from + 1, one.to + 1, line ? "straight" : significant(1.0 / one.kappa),
        line ? "-" : significant(one.centre.x), line ? "-" : significant(one.centre.y),
        significant(std::remainder(one.theta, kFullTurn) / kOneDegree), significant(one.length),
        significant(one.off, 4));
  }
  return out + "</tbody></table>\n";
}

std::string figures_table(const StoredContour& stored, const std::string& asked) {
  std::string rows = contour_rows(stored.contour);
  if (!asked.empty()) rows += figure_row("asked for", asked);
  if (stored.report) {
    rows += fairness_rows(*stored.report);
    rows += accuracy_rows(stored.contour, *stored.report);
    rows += given_rows(stored.report->given);
  }
  if (stored.certificate) rows += gap_rows(stored.contour, *stored.certificate);
  return "<table id=\"figures\"><caption>Figures</caption>\n<tbody>\n" + rows +
         "</tbody></table>\n";
}

std::string verdict_paragraph(const StoredContour& stored, const std::string& neutral) {
  if (!neutral.empty()) return fmt::format("<p id=\"verdict\">{}</p>\n", escaped_xml(neutral));
  if (!stored.certificate) return "<p id=\"verdict\">no certificate stands in the file</p>\n";
  return fmt::format("<p id=\"verdict\" class=\"{}\">{}</p>\n",
                     stored.certificate->proved ? "kept" : "broken",
                     escaped_xml(verdict_line(stored.contour.carrier, *stored.certificate)));
}

std::string report_page(const ContourExport& e, const std::string& picture) {
  const PictureTitles& titles = e.options.picture;
  const std::string name = escaped_xml(titles.name.empty() ? e.options.name : titles.name);
  std::string out = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  out += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  out +=
      fmt::format("<title>{}</title>\n{}\n</head>\n<body>\n<h1>{}</h1>\n", name, kPageStyle, name);
  out += verdict_paragraph(e.stored, titles.verdict);
  out += picture;
  out += figures_table(e.stored, e.options.asked);
  out += lines_and_arcs_table(e.stored.contour);
  if (e.stored.report) out += segments_table(*e.stored.report);
  return out + fmt::format("<footer>Obvid {}</footer>\n</body>\n</html>\n", kVersion);
}

}  // namespace

Result<Exported> contour_as_report(const ContourExport& e) {
  const auto notes = unit_notes(e.contour.units, UnitRule::kNone, "", e.contour.units.name);
  OBVID_TRY(notes);
  OBVID_TRY(can_plot(e));
  const auto picture = picture_svg(e.stored, e.options.picture, e.options.plots, e.watch);
  Exported out;
  out.files.push_back({"", report_page(e, picture)});
  out.remarks = notes->remarks;
  out.warnings = notes->warnings;
  return out;
}

}  // namespace obvid::pipeline_detail
