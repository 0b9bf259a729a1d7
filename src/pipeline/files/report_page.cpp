// SPDX-License-Identifier: Apache-2.0
// A contour as one page for a report: verdict, picture, figures, segments.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "files/format_writers.h"
#include "obvid/core/internal/data_table.h"
#include "obvid/core/internal/figures.h"
#include "obvid/core/units.h"
#include "obvid/exchange/internal/points/airfoil.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/pipeline/internal/airfoil_file.h"
#include "obvid/pipeline/internal/fit_figures.h"
#include "obvid/pipeline/internal/lines_and_arcs.h"
#include "obvid/pipeline/internal/page_text.h"
#include "obvid/pipeline/internal/promise.h"

namespace obvid::pipeline_detail {
namespace {

constexpr std::size_t kMostSegments = 1000;  // rows of the table

using Figures = ReportPage::Figures;

/// Of a contour without a report: what is seen in it.
Figures seen_figures(const StoredContour& stored) {
  const Contour& contour = stored.contour;
  Figures out = {{"contour", fmt::format("{} through {} in {}",
                                         counted(contour.pieces.size(), "piece", "pieces"),
                                         counted(contour.points.size(), "point", "points"),
                                         counted(contour.runs.size(), "run", "runs"))}};
  if (!stored.certificate) return out;
  const Certificate& certificate = *stored.certificate;
  if (certificate.corners > 0) out.emplace_back("corners", std::to_string(certificate.corners));
  if (certificate.self_intersections > 0) {
    out.emplace_back("self-intersections", std::to_string(certificate.self_intersections));
  }
  out.emplace_back("joint gaps", gaps_text(contour.carrier, certificate));
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
        significant(one.heading_deg()), significant(one.length), significant(one.off, 4));
  }
  return out + "</tbody></table>\n";
}

/// Of an airfoil: the contour beside straight lines between the points that it was formed through.
std::string airfoil_table(const Contour& contour) {
  // what is thicker, in chords, or ends nearly as thick, is a loop that runs there and back
  constexpr double kThickest = 0.7, kThickestEnd = 0.8;
  const auto f = airfoil_figures(contour);
  if (!f || f->thickness > kThickest) return {};
  if (f->trailing_thickness > kThickestEnd * f->thickness) return {};
  const auto input = airfoil_point_figures(airfoil_points_around(contour, *f), *f);
  DataTable out{{"% of the chord", "contour", "points", "difference"}};
  const auto add = [&](const char* name, double made, std::optional<double> given) {
    DataRow row{name, fmt::format("{:.3f}", 100.0 * made)};
    if (given) {
      row.emplace_back(fmt::format("{:.3f}", 100.0 * *given));
      row.emplace_back(fmt::format("{:.3f}", 100.0 * (made - *given)));
    }
    out.rows.push_back(std::move(row));
  };
  const auto of_points = [&](double AirfoilPointFigures::*figure) {
    return input ? std::optional((*input).*figure) : std::nullopt;
  };
  using Points = AirfoilPointFigures;
  add("thickness", f->thickness, of_points(&Points::thickness));
  add("thickness, at", f->thickness_at, of_points(&Points::thickness_at));
  add("camber", f->camber, of_points(&Points::camber));
  add("camber, at", f->camber_at, of_points(&Points::camber_at));
  add("leading edge radius", f->nose_radius, of_points(&Points::nose_radius));
  add(f->trailing_round ? "trailing edge, diameter" : "trailing edge", f->trailing_thickness,
      of_points(&Points::trailing_thickness));
  return table_of_page("airfoil",
                       fmt::format("Airfoil, chord {:.6g} {}; points: straight lines between them, "
                                   "circle through the three at the nose",
                                   f->chord, contour.units.text()),
                       out);
}

Figures figures_of_stored(const StoredContour& stored, const std::string& asked) {
  Figures out;
  if (!asked.empty()) out.emplace_back("asked for", asked);
  out.emplace_back("carrier", to_string(stored.contour.carrier));
  out.emplace_back("closed", stored.contour.closed ? "yes" : "no");
  out.emplace_back("lengths in", stored.contour.units.text());
  const bool formed = stored.report && stored.certificate;
  const Figures more = formed ? fit_figures(stored.contour, *stored.report, *stored.certificate)
                              : seen_figures(stored);
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

void set_verdict(const StoredContour& stored, const std::string& neutral, ReportPage& page) {
  page.verdict = neutral;
  if (!neutral.empty()) return;
  if (!stored.certificate) {
    page.verdict = "no certificate stands in the file";
    return;
  }
  page.verdict = verdict_line(stored.contour.carrier, *stored.certificate);
  page.kind =
      stored.certificate->proved ? ReportPage::Verdict::kKept : ReportPage::Verdict::kBroken;
}

std::string report_page(const ContourExport& e, const std::string& picture, const Exported& notes) {
  const PictureTitles& titles = e.options.picture;
  ReportPage page;
  page.title = titles.name.empty() ? e.options.name : titles.name;
  set_verdict(e.stored, titles.verdict, page);
  page.pictures.push_back(picture);
  page.figures = figures_of_stored(e.stored, e.options.asked);
  page.warnings = e.options.told.warnings;
  page.warnings.insert(page.warnings.end(), notes.warnings.begin(), notes.warnings.end());
  page.notes = e.options.told.remarks;
  page.notes.insert(page.notes.end(), notes.remarks.begin(), notes.remarks.end());
  page.tables.push_back(airfoil_table(e.stored.contour));
  page.tables.push_back(lines_and_arcs_table(e.stored.contour));
  if (e.stored.report) page.tables.push_back(segments_table(*e.stored.report));
  return page_text(page);
}

}  // namespace

Result<Exported> contour_as_report(const ContourExport& e) {
  OBVID_TRY(can_plot(e));
  const auto picture = picture_svg(e.stored, e.options.picture, e.options.plots, e.watch);
  Exported out;
  out.files.push_back({"", report_page(e, picture, out)});
  return out;
}

}  // namespace obvid::pipeline_detail
