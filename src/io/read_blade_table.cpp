// SPDX-License-Identifier: Apache-2.0
#include "read_blade_table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "number_rows.h"
#include "obvid/core/units.h"
#include "text_digits.h"
#include "text_lines.h"
#include "text_number.h"

namespace obvid {
namespace {

using std::string_view;

constexpr std::array<string_view, 6> kColumns = {"BlSpn",   "BlCrvAC", "BlSwpAC",
                                                 "BlTwist", "BlChord", "BlAFID"};

std::optional<double> number_in(string_view cell) {
  const text::ParsedNumber number = text::parse_number(cell, false);
  if (number.kind != text::NumberKind::kNumber) return std::nullopt;
  return number.value;
}

/// Column of each of `kColumns`; empty when one is missing.
std::vector<std::size_t> columns_in(const text::Fields& fields) {
  std::vector<std::size_t> columns;
  for (const string_view name : kColumns) {
    for (std::size_t i = 0; i < fields.count; ++i) {
      if (fields.cell[i] == name) columns.push_back(i);
    }
  }
  return columns.size() == kColumns.size() ? columns : std::vector<std::size_t>{};
}

std::optional<BladeStation> station_in(const text::Fields& fields,
                                       const std::vector<std::size_t>& columns) {
  std::array<double, kColumns.size()> value{};
  for (std::size_t k = 0; k < value.size(); ++k) {
    if (columns[k] >= fields.count) return std::nullopt;
    const auto number = number_in(fields.cell[columns[k]]);
    if (!number) return std::nullopt;
    value[k] = *number;
  }
  constexpr double kMostAirfoils = 1e6;
  const bool counted = value[5] >= 1.0 && value[5] <= kMostAirfoils;
  return BladeStation{value[0], value[1],
                      value[2], value[3] * kOneDegree,
                      value[4], counted ? static_cast<int>(value[5]) : 0};
}

}  // namespace

bool is_blade_table(string_view text) {
  return text.find("BlSpn") != string_view::npos && text.find("BlAFID") != string_view::npos;
}

Result<std::vector<BladeStation>> parse_blade_table(string_view text, string_view name) {
  std::vector<BladeStation> stations;
  std::vector<std::size_t> columns;
  std::optional<double> count;
  text::Fields fields;
  for (text::LineCursor cursor(text); !cursor.at_end();) {
    const string_view line = cursor.peek();
    const std::size_t number = cursor.line_number();
    cursor.skip(line);
    text::split(text::trim(line), text::Separator::kWhite, fields);
    if (columns.empty()) {
      if (fields.count >= 2 && fields.cell[1] == "NumBlNds") count = number_in(fields.cell[0]);
      columns = columns_in(fields);
      continue;
    }
    if (fields.count == 0 || (stations.empty() && fields.cell[0].starts_with("("))) continue;
    const auto station = station_in(fields, columns);
    if (station) {
      stations.push_back(*station);
    } else if (!stations.empty()) {
      break;  // the next block of the file
    } else {
      return fail(error_at(ErrorCode::kBadNumber, "this line of the blade table cannot be read",
                           name, number));
    }
  }
  const auto size = static_cast<double>(stations.size());
  if (count && *count != size && !stations.empty()) {
    return error(ErrorCode::kBadCount,
                 fmt::format("{:g} stations can be read, NumBlNds says {:g}", size, *count))
        .where(std::string(name))
        .hint("look at the line after the last one that can be read")
        .value(size);
  }
  if (!stations.empty()) return stations;
  return error(ErrorCode::kNothingThere, "the blade table has no stations")
      .where(std::string(name))
      .hint("its columns are BlSpn BlCrvAC BlSwpAC BlTwist BlChord BlAFID");
}

bool is_airfoil_of_blade(string_view text) { return text.find("NumCoords") != string_view::npos; }

Result<BladeAirfoil> parse_airfoil_of_blade(string_view text, string_view name) {
  std::vector<Vec2> points;
  text::ColumnDigits x_digits, y_digits;
  std::optional<double> count;
  text::Fields fields;
  for (text::LineCursor cursor(text); !cursor.at_end();) {
    const string_view line = cursor.peek();
    const std::size_t number = cursor.line_number();
    cursor.skip(line);
    const string_view bare = text::trim(line);
    if (bare.empty() || text::is_comment(bare)) continue;
    text::split(text::trim(text::without_comment(bare)), text::Separator::kWhite, fields);
    if (!count) {
      count = fields.count > 0 ? number_in(fields.cell[0]) : std::nullopt;
      if (count) continue;
    }
    const auto x = fields.count >= 2 ? number_in(fields.cell[0]) : std::nullopt;
    const auto y = fields.count >= 2 ? number_in(fields.cell[1]) : std::nullopt;
    if (!x || !y) {
      return fail(error_at(ErrorCode::kBadNumber, "x and y are expected here", name, number));
    }
    points.push_back({*x, *y});
    x_digits.add(text::digits_of(fields.cell[0]));
    y_digits.add(text::digits_of(fields.cell[1]));
  }
  const auto size = static_cast<double>(points.size());
  if (!count || *count != size || points.size() < 4) {
    return error(ErrorCode::kBadCount, fmt::format("{} points were found, the file says {:g}",
                                                   points.size(), count.value_or(0.0)))
        .where(std::string(name))
        .hint("NumCoords counts the reference point too")
        .value(size);
  }
  BladeAirfoil airfoil;
  airfoil.reference = points.front();
  airfoil.points.assign(points.begin() + 1, points.end());
  const text::HalfUnits half = text::half_units(x_digits, y_digits);
  airfoil.rounding = {half.x, half.y};
  return airfoil;
}

SpaceSeries placed(const BladeAirfoil& airfoil, const BladeStation& station, std::string name) {
  const double c = std::cos(station.twist), s = std::sin(station.twist);
  SpaceSeries section{std::move(name), {}};
  for (const Vec2 p : airfoil.points) {
    const double along = station.chord * (p.x - airfoil.reference.x);
    const double thick = station.chord * (p.y - airfoil.reference.y);
    section.points.push_back({station.out_of_plane + c * thick - s * along,
                              station.in_plane + s * thick + c * along, station.span});
  }
  // that of the table places whole sections: their shapes do not know of it
  const Vec2 half = station.chord * airfoil.rounding;
  section.rounding = {std::abs(c) * half.y + std::abs(s) * half.x,
                      std::abs(s) * half.y + std::abs(c) * half.x, 0.0};
  return section;
}

}  // namespace obvid
