// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/compare_curves.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "interrupt.h"
#include "obvid/core/files.h"
#include "obvid/pipeline/internal/page_text.h"
#include "outputs.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

constexpr int kCurveDigits = 5;

std::string percent(double chords, int decimals) {
  return fmt::format("{:.{}f}", 100.0 * chords, decimals);
}

/// In percent, and where it is: nowhere of what prints as 0.
std::pair<std::string, std::string> camber_of(const AirfoilFigures& f) {
  constexpr double kPrinted = 5e-6;  // chords
  if (std::abs(f.camber) < kPrinted) return {percent(0.0, 3), "-"};
  return {percent(f.camber, 3), percent(f.camber_at, 3)};
}

std::string verdict_of(const ComparedCurve& curve) {
  if (!curve.formed) return "as drawn";
  return curve.proved ? "proved" : "NOT proved";
}

std::string curves_table(const CurveComparison& compared) {
  Table table;
  table.column("curve", Table::Align::kLeft);
  table.column("points");
  table.column("length");
  table.column("vertices");
  if (compared.airfoils) {
    table.column("chord");
    table.column("thickness\n%");
    table.column("at\n%");
    table.column("camber\n%");
    table.column("at\n%");
    table.column("nose\nradius %");
    table.column("trailing\nedge %");
  }
  table.column("contour", Table::Align::kLeft);
  for (const ComparedCurve& curve : compared.curves) {
    std::vector<std::string> row = {curve.name,
                                    curve.points > 0 ? std::to_string(curve.points) : "-",
                                    significant(curve.length, kCurveDigits),
                                    curve.counted ? std::to_string(curve.vertices) : "-"};
    if (compared.airfoils) {
      const AirfoilFigures& f = *curve.airfoil;
      row.push_back(significant(f.chord, kCurveDigits));
      for (const double one : {f.thickness, f.thickness_at}) row.push_back(percent(one, 3));
      const auto [camber, at] = camber_of(f);
      row.insert(row.end(), {camber, at});
      for (const double one : {f.nose_radius, f.trailing_thickness}) {
        row.push_back(percent(one, 3));
      }
    }
    row.push_back(verdict_of(curve));
    table.row(std::move(row));
  }
  return table.text();
}

/// How much of the first curve was measured; 100.0 where nothing is left, and 0.0 where none was.
std::string measured_percent(const CurveDeviation& one) {
  constexpr double kTenths = 1000.0;
  if (one.measured > 0.0 && one.measured * kTenths < 1.0) return "<0.1";
  return percent(std::floor(one.measured * kTenths) / kTenths, 1);
}

/// Places of the first curve at which others were looked for.
std::size_t most_places(const CurveComparison& compared) {
  std::size_t most = 0;
  for (const CurveDeviation& one : compared.as_they_lie) most = std::max(most, one.places.size());
  return most;
}

/// `unit`: what deviations are multiplied by.
void add_rows(Table& table, const CurveComparison& compared,
              const std::vector<CurveDeviation>& deviations, const char* how, double unit) {
  for (const CurveDeviation& one : deviations) {
    std::vector<std::string> row = {compared.curves[one.curve].name, how};
    if (one.largest) {
      const DeviationPlace& at = *one.largest;
      row.push_back(significant(unit * *at.deviation, kCurveDigits));
      row.push_back(coordinate(at.point.x, compared.curves.front().length));
      row.push_back(coordinate(at.point.y, compared.curves.front().length));
      if (compared.airfoils) {
        row.push_back(at.upper ? "upper" : "lower");
        row.push_back(percent(at.along.value_or(0.0), 2));
      }
      row.push_back(significant(unit * one.root_mean_square, kCurveDigits));
    } else {
      row.insert(row.end(), compared.airfoils ? 6 : 4, "-");
    }
    row.push_back(measured_percent(one));
    table.row(std::move(row));
  }
}

std::string deviations_table(const CurveComparison& compared) {
  const ComparedCurve& first = compared.curves.front();
  Table table;
  table.column("deviation of", Table::Align::kLeft);
  table.column("", Table::Align::kLeft);
  table.column("largest");
  table.column("at x");
  table.column("at y");
  if (compared.airfoils) {
    table.column("side", Table::Align::kLeft);
    table.column("at %\nof chord");
  }
  table.column("root mean\nsquare");
  table.column("measured\n%");
  const std::string units = compared.units.text();
  add_rows(table, compared, compared.as_they_lie, ("as it lies, " + units).c_str(), 1.0);
  if (!compared.on_one_chord.empty()) {
    add_rows(table, compared, compared.on_one_chord, "on one chord, % of it",
             100.0 / first.airfoil->chord);
  }
  return fmt::format("from {}, along its normals at {} places, {} positive\n{}", first.name,
                     most_places(compared), compared.outward ? "outward" : "to the left",
                     table.text());
}

std::string compared_text(const CurveComparison& compared) {
  std::string out = fmt::format("lengths in {}\n", compared.units.text());
  out += curves_table(compared) + "\n" + deviations_table(compared);
  for (const std::string& note : comparison_notes(compared)) out += note + "\n";
  return out;
}

/// Of each curve, what `curves_table` says of it.
void add_curve_figures(const CurveComparison& compared, ReportPage& page) {
  for (const ComparedCurve& curve : compared.curves) {
    std::string text = curve.points > 0 ? counted(curve.points, "point", "points") + ", " : "";
    text += "length " + significant(curve.length, kCurveDigits);
    if (curve.counted) {
      text += ", " + counted(static_cast<std::size_t>(curve.vertices), "vertex", "vertices");
    }
    page.figures.emplace_back(curve.name, text + ", " + verdict_of(curve));
  }
}

/// The same figures as in `deviations_table`, a line each.
void add_deviation_figures(const CurveComparison& compared,
                           const std::vector<CurveDeviation>& deviations, const std::string& how,
                           double unit, ReportPage& page) {
  for (const CurveDeviation& one : deviations) {
    const std::string label = "deviation of " + compared.curves[one.curve].name + ", " + how;
    const std::string part = " (" + measured_percent(one) + " % of the curve measured)";
    page.figures.emplace_back(
        label + ", root mean square",
        (one.largest ? significant(unit * one.root_mean_square, kCurveDigits) : "-") + part);
    std::string largest = "-";
    if (one.largest) {
      const DeviationPlace& at = *one.largest;
      const double size = compared.curves.front().length;
      largest = fmt::format("{} at {}, {}", significant(unit * *at.deviation, kCurveDigits),
                            coordinate(at.point.x, size), coordinate(at.point.y, size));
      if (compared.airfoils) {
        largest += fmt::format(", {} side, at {} % of the chord", at.upper ? "upper" : "lower",
                               percent(at.along.value_or(0.0), 2));
      }
    }
    page.figures.emplace_back(label + ", largest", largest);
  }
}

/// Of airfoils: what `curves_table` says of each.
void add_airfoil_figures(const CurveComparison& compared, ReportPage& page) {
  if (!compared.airfoils) return;
  for (const ComparedCurve& curve : compared.curves) {
    const AirfoilFigures& f = *curve.airfoil;
    page.figures.emplace_back(
        curve.name + " as an airfoil",
        fmt::format("chord {}; in % of it: thickness {} at {}, camber {} at {}, nose radius {}, "
                    "trailing edge {}",
                    significant(f.chord, kCurveDigits), percent(f.thickness, 3),
                    percent(f.thickness_at, 3), camber_of(f).first, camber_of(f).second,
                    percent(f.nose_radius, 3), percent(f.trailing_thickness, 3)));
  }
}

using CurvesMaker =
    std::function<std::string(const CurveComparison&, const std::vector<std::string>& warnings)>;

std::string curves_page(const CurveComparison& compared, const CompareOptions& options,
                        const std::vector<std::string>& warnings) {
  ReportPage page;
  std::vector<std::string> names;
  for (const ComparedCurve& curve : compared.curves) names.push_back(curve.name);
  page.title = listed(names);
  page.verdict =
      fmt::format("deviations from {}, along its normals at {} places, {} positive", names.front(),
                  most_places(compared), compared.outward ? "outward" : "to the left");
  page.pictures.push_back(curves_svg(compared, options.enlarge));
  page.figures = {{"asked for", options.asked}, {"lengths in", compared.units.text()}};
  page.warnings = warnings;
  page.notes = comparison_notes(compared);
  add_curve_figures(compared, page);
  add_airfoil_figures(compared, page);
  add_deviation_figures(compared, compared.as_they_lie, "as it lies", 1.0, page);
  if (!compared.on_one_chord.empty()) {
    add_deviation_figures(compared, compared.on_one_chord, "on one chord, % of it",
                          100.0 / compared.curves.front().airfoil->chord, page);
  }
  page.tables.push_back(table_of_page("places", "Deviations at places", curves_rows(compared)));
  return page_text(page);
}

Result<CurvesMaker> curves_maker(const std::string& path, const CompareOptions& options) {
  using Told = std::vector<std::string>;
  const auto format = table_format_of(path, "a comparison", ".csv (every place) and .json (table)");
  OBVID_TRY(format);
  switch (*format) {
    case FileFormat::kPage:
      return CurvesMaker([options](const CurveComparison& c, const Told& warnings) {
        return curves_page(c, options, warnings);
      });
    case FileFormat::kPicture:
      return CurvesMaker([enlarge = options.enlarge](const CurveComparison& c, const Told&) {
        return curves_svg(c, enlarge);
      });
    case FileFormat::kContour:
      return CurvesMaker([](const CurveComparison& c, const Told&) { return curves_json(c); });
    default:
      return CurvesMaker(
          [](const CurveComparison& c, const Told&) { return csv_text(curves_rows(c)); });
  }
}

}  // namespace

int compare_several(const CompareOptions& options) {
  if (auto free = check_outputs(options.outputs, options.inputs); !free) {
    return report(free.error());
  }
  std::vector<CurvesMaker> makers;
  for (const std::string& path : options.outputs) {
    const auto maker = curves_maker(path, options);
    if (!maker) return report(maker.error());
    makers.push_back(*maker);
  }
  ProgressBar bar(options.progress);
  std::vector<std::string> warnings;
  const auto compared = [&]() -> Result<CurveComparison> {
    const Interrupt interrupt;
    const RunContext context(bar.progress(), [&interrupt] { return interrupt.asked(); });
    std::vector<ComparedCurve> curves;
    for (const std::string& path : options.inputs) {
      auto read = read_curve(path, {options.import, options.job, options.units}, context);
      OBVID_TRY(read);
      for (const std::string& told : read->warnings) warnings.push_back(path + ": " + told);
      curves.push_back(std::move(read->curve));
    }
    name_curves(options.inputs, curves);
    return compare_curves(std::move(curves), options.curves, context);
  }();
  bar.clear();
  if (compared) {
    for (std::string& told : comparison_warnings(*compared)) warnings.push_back(std::move(told));
  }
  warn(warnings);
  if (!compared) return report(compared.error());
  std::vector<Output> outputs;
  for (std::size_t i = 0; i < makers.size(); ++i) {
    outputs.push_back({options.outputs[i], {}, makers[i](*compared, warnings)});
  }
  const auto written = write_files(outputs, options.inputs.front());
  if (!written) return report(written.error());
  const bool for_programs = options.json || options.csv;
  if (options.quiet && !for_programs) return 0;
  std::string shown = options.json  ? curves_json(*compared)
                      : options.csv ? csv_text(curves_rows(*compared))
                                    : compared_text(*compared);
  if (!written->empty() && !for_programs) shown += "\nwritten  " + listed(*written) + "\n";
  if (auto done = put(shown); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
