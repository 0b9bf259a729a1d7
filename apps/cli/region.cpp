// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands.h"
#include "json_text.h"
#include "obvid/io/read_points.h"
#include "obvid/pipeline/region_table.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

/// Least and greatest radius of a range of signed curvatures, each with its sign.
struct RadiusRange {
  std::string least;
  std::string greatest;
};

RadiusRange radius_range(double kappa_low, double kappa_high) {
  const bool low_is_larger = std::fabs(kappa_low) > std::fabs(kappa_high);
  const double larger = low_is_larger ? kappa_low : kappa_high;
  const double smaller = low_is_larger ? kappa_high : kappa_low;
  const bool crosses = kappa_low < 0.0 && kappa_high > 0.0;
  return {std::isinf(larger) ? "0" : radius_text(larger),
          crosses ? "straight" : radius_text(smaller)};
}

Table region_segments(const RegionTable& region) {
  Table table;
  table.column("points");
  table.column("chord");
  table.column("|i,T|");
  table.column("|T,i+1|");
  table.column("least\nradius at i");
  table.column("greatest\nradius at i");
  table.column("least\nradius at i+1");
  table.column("greatest\nradius at i+1");
  table.column("height\nh");
  table.column("width\ndelta");
  std::vector<double> width;
  for (const RegionRow& row : region.rows) width.push_back(row.width);
  std::size_t before = 0;
  for (const std::size_t i : rows_worth_showing(width)) {
    if (i > before) table.gap();
    before = i + 1;
    const RegionRow& row = region.rows[i];
    const RadiusRange start = radius_range(row.kappa_start_low, row.kappa_start_high);
    const RadiusRange end = radius_range(row.kappa_end_low, row.kappa_end_high);
    table.row({fmt::format("{}-{}", i + 1, i + 2), significant(row.chord), significant(row.to_apex),
               significant(row.from_apex), start.least, start.greatest, end.least, end.greatest,
               significant(row.lower_height, 4), significant(row.width, 4)});
  }
  return table;
}

std::string region_text(const PointSeries& series, const RegionTable& region) {
  std::vector<double> width;
  double largest = 0.0;
  for (const RegionRow& row : region.rows) {
    width.push_back(row.width);
    if (row.width > largest) largest = row.width;
  }
  std::string out = series.name.empty() ? "" : bold(series.name) + "\n";
  out += fmt::format(
      "lengths in {}; radius positive where the contour turns left\n"
      "T: where the tangents at points i and i+1 meet; h: height of the lower boundary above the\n"
      "chord, delta: width of the region, both over the middle of the chord\n\n",
      series.units.text());
  out += region_segments(region).text();
  out += shown_note(rows_worth_showing(width).size(), width.size(), "widest", "segments");
  return out + fmt::format("\nlargest delta  {} {}\n", significant(largest, 4), series.units.text());
}

std::string region_json(const PointSeries& series, const RegionTable& region) {
  JsonText json;
  json.begin_object().pair("name", series.name);
  add_units(json, series.units);
  json.key("segments").begin_array();
  for (const RegionRow& row : region.rows) {
    json.begin_object().pair("chord", row.chord);
    json.pair("heading_start", row.theta_start).pair("heading_end", row.theta_end);
    json.pair("to_apex", row.to_apex).pair("from_apex", row.from_apex);
    json.pair("kappa_start_low", row.kappa_start_low);
    json.pair("kappa_start_high", row.kappa_start_high);
    json.pair("kappa_end_low", row.kappa_end_low).pair("kappa_end_high", row.kappa_end_high);
    json.pair("lower_height", row.lower_height).pair("width", row.width).end_object();
  }
  json.end_array().key("elements").begin_array();
  for (const Element& element : region.elements) {
    json.begin_object().key("point").begin_array().value(element.point.x).value(element.point.y);
    json.end_array().pair("heading", element.theta).pair("kappa", element.kappa).end_object();
  }
  json.end_array().end_object();
  return json.take();
}

}  // namespace

int run(const RegionOptions& options) {
  Result<PointSeries> series = read_points(options.input);
  if (!series) return report(series.error());
  if (options.units) take_units(*series, *options.units);
  warn(series->warnings);
  const Result<RegionTable> region = region_table(*series);
  if (!region) return report(region.error());
  const std::string text =
      options.json ? region_json(*series, *region) : region_text(*series, *region);
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
