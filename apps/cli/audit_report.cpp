// SPDX-License-Identifier: Apache-2.0
#include "audit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "element_table.h"
#include "obvid/core/internal/figures.h"
#include "obvid/core/units.h"
#include "obvid/pipeline/alignment_job.h"
#include "obvid/pipeline/analyse.h"
#include "obvid/pipeline/element_table.h"
#include "obvid/pipeline/internal/job_files.h"
#include "obvid/pipeline/internal/page_text.h"
#include "obvid/pipeline/internal/report_json.h"
#include "outputs.h"
#include "series_report.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

/// Curves that get a list of their places; a drawing with more gets the table only.
constexpr std::size_t kMostDetailed = 3;

std::string audit_continuity(int continuity) {
  return continuity < 0 ? "gaps" : "G" + std::to_string(continuity);
}

/// Least radius of a curve, "straight" where it has none.
std::string least_radius(const CurveAudit& a) {
  const bool left = std::abs(a.largest_kappa) >= std::abs(a.least_kappa);
  return radius_text(left ? a.largest_kappa : a.least_kappa);
}

std::string count_text(const CurveAudit& a, int count) {
  return a.counted ? std::to_string(count) : "-";
}

/// Why curves have no counts.
std::string uncounted_text(const std::vector<CurveAudit>& audits) {
  constexpr std::size_t kMostNamed = 8;
  std::string out;
  for (const bool unbounded : {true, false}) {
    std::string names;
    std::size_t count = 0;
    for (std::size_t i = 0; i < audits.size(); ++i) {
      if (audits[i].counted || std::isnan(audits[i].least_kappa) != unbounded) continue;
      if (++count <= kMostNamed) names += fmt::format("{}{}", count > 1 ? ", " : "", i + 1);
    }
    if (count == 0) continue;
    out += fmt::format("vertices and inflections of {} {}{} are not counted: {}\n",
                       count == 1 ? "curve" : "curves", names, and_more(count, kMostNamed),
                       unbounded ? "nothing bounds the curvature" : "none of it is proved");
  }
  return out;
}

std::string joints_table(const std::vector<CurveAudit>& audits) {
  Table table;
  table.column("curve");
  table.column("pieces");
  table.column("joints");
  table.column_if_told("vertices");
  table.column_if_told("above\n1 %");
  table.column_if_told("inflec-\ntions");
  table.column_if_told("least\nradius");
  std::vector<double> vertices;
  for (const CurveAudit& a : audits) vertices.push_back(a.vertices);
  const std::size_t shown = add_rows_worth_showing(vertices, table, [&](std::size_t i) {
    const CurveAudit& a = audits[i];
    table.row({std::to_string(i + 1), std::to_string(figures_of(a).pieces),
               audit_continuity(a.continuity), count_text(a, a.vertices),
               count_text(a, a.visible_vertices), count_text(a, a.inflections), least_radius(a)});
  });
  return table.text() + shown_note(shown, audits.size(), "least fair", "curves") +
         uncounted_text(audits);
}

std::string size_text(const AuditPlace& place, const std::string& units) {
  if (place.kind == AuditPlace::Kind::kCorner) {
    return fmt::format("{} deg", significant(place.size / kOneDegree, 4));
  }
  if (place.kind == AuditPlace::Kind::kGap) return significant(place.size, 4) + " " + units;
  return "";
}

std::string place_table(const CurveAudit& a) {
  Table table;
  table.column(a.station ? "\nstation" : "arc\nlength");
  table.column("what", Table::Align::kLeft);
  table.column("x");
  table.column("y");
  table.column("radius\nbefore");
  table.column("radius\nafter");
  table.column_if_told("size", Table::Align::kLeft);
  std::vector<double> weight;
  for (const AuditPlace& place : a.places) weight.push_back(place.size);
  const std::size_t shown = add_rows_worth_showing(weight, table, [&](std::size_t i) {
    const AuditPlace& place = a.places[i];
    table.row({coordinate(a.station.value_or(0.0) + place.s, a.length), to_string(place.kind),
               coordinate(place.point.x, a.length), coordinate(place.point.y, a.length),
               radius_text(place.kappa_before), radius_text(place.kappa_after),
               size_text(place, a.contour.units.text())});
  });
  return table.text() + shown_note(shown, a.places.size(), "largest", "places");
}

/// Every curve, then every series of points: whoever asks for one has to see its number.
std::string list_table(const Drawing& drawing, const std::vector<CurveAudit>& audits) {
  Table table;
  table.column("curve");
  table.column("name", Table::Align::kLeft);
  table.column("kind", Table::Align::kLeft);
  table.column("points");
  table.column("length");
  table.column("closed", Table::Align::kLeft);
  table.column("width");
  table.column("height");
  std::size_t number = 0;
  const auto add = [&](const std::string& name, const DrawnFigures& figures) {
    table.row({std::to_string(++number), name, figures.kind, std::to_string(figures.points),
               significant(figures.length), figures.closed ? "yes" : "no",
               significant(figures.high.x - figures.low.x),
               significant(figures.high.y - figures.low.y)});
  };
  for (const CurveAudit& a : audits) add(a.label, figures_of(a));
  for (const PointSeries& series : drawing.series) add(series.name, figures_of(series));
  return table.text();
}

/// Curves whose places are listed: the one that was asked for, all, or the first few.
std::vector<std::size_t> detailed(const std::vector<CurveAudit>& audits,
                                  const std::optional<std::size_t>& asked, bool all) {
  if (asked) return *asked < audits.size() ? std::vector{*asked} : std::vector<std::size_t>{};
  std::vector<std::size_t> out(all ? audits.size() : std::min(audits.size(), kMostDetailed));
  std::iota(out.begin(), out.end(), std::size_t{0});
  return out;
}

std::string straightened_text(const CurveAudit& a) {
  if (a.straightened == 0) return {};
  return fmt::format("straight but for rounding: {} below a curvature of {} 1/{}",
                     counted(a.straightened, "piece", "pieces"), significant(a.flat_curvature, 3),
                     a.contour.units.text());
}

/// Counts are proved; places are found on samples, where the curvature stands out of its rounding,
/// and have no row of their own at a joint that has one.
std::string unplaced_text(const CurveAudit& a) {
  const auto listed_of = [&a](AuditPlace::Kind kind) {
    return std::count_if(a.places.begin(), a.places.end(),
                         [kind](const AuditPlace& place) { return place.kind == kind; });
  };
  const auto vertices = listed_of(AuditPlace::Kind::kVertex);
  const auto inflections = listed_of(AuditPlace::Kind::kInflection);
  if (!a.counted || (vertices >= a.vertices && inflections >= a.inflections)) return {};
  const bool joints = std::any_of(a.places.begin(), a.places.end(), [](const AuditPlace& place) {
    return place.kind != AuditPlace::Kind::kVertex && place.kind != AuditPlace::Kind::kInflection;
  });
  return fmt::format(
      "{} of {} and {} of {} have a row; the others {}the curvature does not stand out of the "
      "rounding",
      vertices, counted(static_cast<std::size_t>(a.vertices), "vertex", "vertices"), inflections,
      counted(static_cast<std::size_t>(a.inflections), "inflection", "inflections"),
      joints ? "lie at a row of another kind, or where " : "lie where ");
}

constexpr const char* kJointsLegend =
    "joints: G3 continuous slope of curvature, G2 curvature, G1 tangent, G0 corners";
constexpr const char* kSeriesNote = "points are for `obvid fit FILE --curve N`";

std::string audit_text(const AnalysedDrawing& analysed, bool all) {
  const auto& [drawing, audits, points, asked] = analysed;
  std::string out = bold(drawing.name) + "\n";
  out += fmt::format("lengths in {}\n\n", drawing.units.text());
  out += list_table(drawing, audits);
  if (!audits.empty()) {
    out += fmt::format("\n{}\n\n", kJointsLegend);
    out += joints_table(audits);
  }
  if (!drawing.series.empty()) out += fmt::format("\n{}\n", kSeriesNote);
  for (const std::size_t i : detailed(audits, asked, all)) {
    const auto elements = elements_of(audits[i]);
    if (!elements && audits[i].places.empty() && audits[i].straightened == 0) continue;
    out += fmt::format("\ncurve {}, {}\n", i + 1, audits[i].label);
    if (elements) out += elements_text(*elements, audits[i].length) + "\n";
    if (audits[i].profile) out += profile_text(*audits[i].profile, audits[i].length) + "\n";
    if (const auto told = straightened_text(audits[i]); !told.empty()) out += told + "\n";
    if (audits[i].places.empty()) continue;
    out += place_table(audits[i]);
    if (const auto told = unplaced_text(audits[i]); !told.empty()) out += told + "\n";
  }
  return out;
}

DataTable place_rows(const CurveAudit& a) {
  DataTable out{heads_of(a.station ? "station,what,x,y,radius_before,radius_after,size"
                                   : "s,what,x,y,radius_before,radius_after,size")};
  for (const AuditPlace& place : a.places) {
    out.rows.push_back({a.station.value_or(0.0) + place.s, to_string(place.kind), place.point.x,
                        place.point.y, radius_text(place.kappa_before),
                        radius_text(place.kappa_after), size_text(place, a.contour.units.text())});
  }
  return out;
}

/// What `audit_text` says of curves one by one.
void add_details(const AnalyseOptions& options, const AnalysedDrawing& analysed, ReportPage& page) {
  const std::vector<CurveAudit>& audits = analysed.audits;
  for (const std::size_t i : detailed(audits, analysed.asked, options.import.curve.all)) {
    const CurveAudit& a = audits[i];
    const std::string curve = fmt::format("curve {}, {}", i + 1, a.label);
    const std::string number = std::to_string(i + 1);
    if (const auto elements = elements_of(a)) {
      page.tables.push_back(
          table_of_page("elements-" + number, "Elements of " + curve, element_rows(*elements, {})));
    }
    if (a.profile) {
      page.tables.push_back(
          table_of_page("profile-" + number, "Profile of " + curve, profile_rows(*a.profile)));
    }
    page.tables.push_back(table_of_page("places-" + number, "Places of " + curve, place_rows(a)));
    std::vector<std::string> told = {straightened_text(a)};
    if (!a.places.empty()) told.push_back(unplaced_text(a));
    for (const std::string& one : told) {
      if (!one.empty()) page.notes.push_back(curve + ": " + one);
    }
  }
}

Result<std::string> audit_page(const AnalyseOptions& options, const AnalysedDrawing& analysed) {
  const auto& [drawing, audits, points, asked] = analysed;
  ReportPage page;
  page.title = drawing.name;
  page.verdict = fmt::format("{} and {} of points", counted(audits.size(), "curve", "curves"),
                             counted(drawing.series.size(), "series", "series"));
  page.figures = {{"asked for", options.asked}, {"lengths in", drawing.units.text()}};
  page.tables.push_back(
      table_of_page("curves", "Curves and series of points", drawing_rows(drawing, audits)));
  if (!audits.empty()) {
    auto picture = analysis_file(FileFormat::kPicture, analysed, options.plots);
    OBVID_TRY(picture);
    page.pictures.push_back(std::move(*picture));
    page.figures.emplace_back("picture", pictured_curve(analysed)->label);
    page.notes.emplace_back(kJointsLegend);
    add_details(options, analysed, page);
  }
  page.warnings = drawing.warnings;
  if (!drawing.series.empty()) page.notes.emplace_back(kSeriesNote);
  if (points) {
    const Facts facts = series_facts(points->series, points->analysis);
    page.figures.insert(page.figures.end(), facts.lines().begin(), facts.lines().end());
    page.warnings.insert(page.warnings.end(), points->series.warnings.begin(),
                         points->series.warnings.end());
    page.tables.push_back(
        table_of_page("points", "Points", series_rows(points->series, points->analysis)));
  }
  return page_text(page);
}

Result<std::string> drawing_file_of(FileFormat format, const AnalyseOptions& options,
                                    const AnalysedDrawing& analysed) {
  if (format == FileFormat::kPage) return audit_page(options, analysed);
  return analysis_file(format, analysed, options.plots);
}

Result<std::vector<std::string>> write_audit_files(const AnalyseOptions& options,
                                                   const AnalysedDrawing& analysed) {
  std::vector<Output> outputs;
  for (const std::string& path : options.outputs) {
    const auto format = analysis_format_of(path);
    OBVID_TRY(format);
    outputs.push_back({path, *format, {}});
  }
  for (Output& output : outputs) {
    auto text = drawing_file_of(output.format, options, analysed);
    if (!text) return fail(of_file(text.error(), output.path));
    output.text = std::move(*text);
  }
  return write_files(outputs, options.input);
}

}  // namespace

Result<AnalysedDrawing> analysed_drawing(const AnalyseOptions& options) {
  Result<Drawing> drawing = read_drawing(options.input, options.import.planes);
  OBVID_TRY(drawing);
  if (options.units) {
    if (auto told = take_units(drawing->units, *options.units)) drawing->warnings.push_back(*told);
  }
  return analyse_drawing(std::move(*drawing), options.import, options.input);
}

int audit_drawing(const AnalyseOptions& options) {
  const auto analysed = analysed_drawing(options);
  if (!analysed) return report(analysed.error());
  const auto written = write_audit_files(options, *analysed);
  warn(analysed->drawing.warnings);
  if (!written) return report(written.error());
  const auto& [all, audits, points, asked] = *analysed;
  std::string text;
  if (options.json) {
    const auto told = analysis_file(FileFormat::kContour, *analysed);
    if (!told) return report(told.error());
    text = *told;
  } else if (options.csv) {
    text = csv_text(drawing_rows(all, audits));
  } else if (!options.quiet) {
    text = audit_text(*analysed, options.import.curve.all);
    if (points) text += "\n" + series_report_text(points->series, points->analysis);
    if (!written->empty()) text += "\nwritten  " + listed(*written) + "\n";
  }
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
