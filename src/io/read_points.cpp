// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/read_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "obvid/core/files.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/io/internal/repeated_heights.h"
#include "read_points_raw.h"
#include "text_kind.h"
#include "text_lines.h"

namespace obvid {
namespace {

using std::string_view;

constexpr std::size_t kMinDistinctPoints = 3;

string_view base_name(string_view path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == string_view::npos ? path : path.substr(slash + 1);
}

/// Another value of one heading or curvature.
bool contradicts(const std::optional<double>& one, const std::optional<double>& other) {
  return one && other && *one != *other;
}

// Of two tolerances of one point the contour keeps both with the smaller one.
Result<void> fill_missing(FixedData& kept, const FixedData& other, std::string where) {
  const bool heading = contradicts(kept.theta, other.theta);
  if (heading || contradicts(kept.kappa, other.kappa)) {
    Error error;
    error.code = ErrorCode::kFixedDataContradict;
    error.what = std::string("the point repeats the one before with another ") +
                 (heading ? "heading" : "radius or curvature");
    error.where = std::move(where);
    error.hint = "give one of them";
    return fail(std::move(error));
  }
  if (!kept.theta) kept.theta = other.theta;
  if (!kept.kappa) kept.kappa = other.kappa;
  for (const auto field : {&FixedData::thetas, &FixedData::kappas}) {
    if (!(other.*field)) continue;
    kept.*field = kept.*field ? common(*(kept.*field), *(other.*field)) : *(other.*field);
    if (!(kept.*field)->empty()) continue;
    Error error;
    error.code = ErrorCode::kFixedDataContradict;
    error.what = "the point repeats the one before with a range that shares nothing with its own";
    error.where = std::move(where);
    error.hint = "give one of them";
    return fail(std::move(error));
  }
  if (other.tolerance) {
    kept.tolerance = std::min(kept.tolerance.value_or(*other.tolerance), *other.tolerance);
  }
  kept.corner = kept.corner || other.corner;
  if (!kept.height) kept.height = other.height;
  return {};
}

// Samples that we wrote hold a corner twice, with the headings before and after it. The headings
// say what the curve did there; nobody fixes them.
void mark_corners(RawPoints& raw) {
  constexpr double kCorner = 1e-6;  // rad: beyond the rounding of any heading
  std::vector<Vec2> points;
  std::vector<FixedData> fixed;
  for (std::size_t i = 0; i < raw.points.size(); ++i) {
    const bool again = i > 0 && raw.points[i] == points.back();
    if (again) fixed.back().corner = true;
    if (again) continue;
    points.push_back(raw.points[i]);
    fixed.emplace_back();
  }
  const double turn = raw.fixed.front().theta.value_or(0.0) - raw.fixed.back().theta.value_or(0.0);
  if (points.front() == points.back() && std::abs(principal_angle(turn)) > kCorner) {
    fixed.front().corner = fixed.back().corner = true;
  }
  raw.points = std::move(points);
  raw.fixed = std::move(fixed);
}

// Keeps the first of equal neighbours; data fixed at either of them hold for the one kept.
Result<void> merge_duplicates(RawPoints& raw, string_view name) {
  if (raw.our_samples) {
    mark_corners(raw);
    return {};
  }
  std::size_t merged = 0;
  RepeatedHeights repeated;
  std::uint32_t first_line = 0;
  std::size_t kept = 0;
  for (std::size_t i = 1; i < raw.points.size(); ++i) {
    if (raw.points[i] == raw.points[kept]) {
      if (!raw.fixed.empty()) {
        const auto &own = raw.fixed[kept].height, &other = raw.fixed[i].height;
        if (own && other) repeated.add(*own, *other);
        if (auto done =
                fill_missing(raw.fixed[kept], raw.fixed[i], text::position(name, raw.lines[i], 1));
            !done)
          return done;
      }
      if (merged++ == 0) first_line = raw.lines[i];
      continue;
    }
    if (++kept == i) continue;
    raw.points[kept] = raw.points[i];
    if (!raw.fixed.empty()) raw.fixed[kept] = raw.fixed[i];
  }
  if (merged == 0) return {};
  raw.points.resize(kept + 1);
  if (!raw.fixed.empty()) raw.fixed.resize(kept + 1);
  raw.warnings.push_back(
      std::to_string(merged) + (merged == 1 ? " point that repeats" : " points that repeat") +
      " the point before merged into it, first in line " + std::to_string(first_line) + ".");
  repeated.warn("", raw.warnings);
  return {};
}

void warn_about_blank_lines(RawPoints& raw) {
  if (raw.breaks.empty()) return;
  raw.warnings.push_back("Blank line inside the points, before line " +
                         std::to_string(raw.lines[raw.breaks.front()]) +
                         ": the points on both sides are one series.");
}

/// Two points are a curve when the headings at both are told.
bool has_two_with_headings(const RawPoints& raw) {
  const auto has_heading = [](const FixedData& data) { return data.theta || data.thetas; };
  return raw.points.size() == 2 && raw.fixed.size() == 2 && has_heading(raw.fixed[0]) &&
         has_heading(raw.fixed[1]);
}

bool has_enough_distinct(const std::vector<Vec2>& points) {
  // Neighbours differ, so only an endless to and fro between two points is still too few.
  for (std::size_t i = kMinDistinctPoints - 1; i < points.size(); ++i) {
    if (points[i] != points[0] && points[i] != points[1]) return true;
  }
  return false;
}

Vec2 rounding_of(RawPoints& raw) {
  for (std::size_t i = 0; i < 2; ++i) {
    if (raw.first_is_point) raw.digits[i].add(raw.first_digits[i]);
  }
  const text::HalfUnits half = text::half_units(raw.digits[0], raw.digits[1]);
  return {half.x, half.y};
}

Error too_few(const RawPoints& raw, string_view name, const char* hint_of_two) {
  Error error;
  error.code = ErrorCode::kTooFewPoints;
  error.what = "a contour needs 3 distinct points, the file holds " +
               std::to_string(std::min<std::size_t>(raw.points.size(), 2));
  error.where = std::string(name);
  if (raw.points.size() == 2) error.hint = hint_of_two;
  error.value = static_cast<double>(raw.points.size());
  return error;
}

}  // namespace

string_view behind_lines(string_view text, std::size_t lines) {
  text::LineCursor cursor(text);
  for (std::size_t i = 0; i < lines && !cursor.at_end(); ++i) cursor.skip(cursor.peek());
  return cursor.rest();
}

Result<PointSeries> parse_points(string_view text, string_view name,
                                 const PointListOptions& options) {
  constexpr string_view kUtf8Mark = "\xEF\xBB\xBF";
  if (text.substr(0, kUtf8Mark.size()) == kUtf8Mark) text.remove_prefix(kUtf8Mark.size());
  OBVID_TRY(text::check_text_kind(text, name));
  // DOS ends a text with this mark; nothing behind it counts.
  text = text.substr(0, text.find('\x1A'));
  Result<RawPoints> raw = read_rows(text, name, options);
  OBVID_TRY(raw);
  OBVID_TRY(resolve_layout(*raw, name));
  warn_about_blank_lines(*raw);
  OBVID_TRY(merge_duplicates(*raw, name));
  const bool two_do = raw->points.size() == 2 && options.two == TwoPoints::kDo;
  if (!has_enough_distinct(raw->points) && !two_do && !has_two_with_headings(*raw)) {
    return fail(too_few(*raw, name, options.hint_of_two));
  }
  PointSeries series;
  series.name = raw->title.empty() ? text::to_utf8(base_name(name)) : std::move(raw->title);
  series.units = std::move(raw->units);
  series.points = std::move(raw->points);
  series.fixed = std::move(raw->fixed);
  series.rounding = rounding_of(*raw);
  // zeros that end heights alone are no padding: one program printed all three columns
  const std::array all{raw->digits[0], raw->digits[1], raw->height_digits};
  series.height_rounding = raw->height_digits.empty() ? 0.0 : text::half_units(all)[2];
  series.warnings = std::move(raw->warnings);
  return series;
}

Result<PointSeries> read_points(const std::string& path, const PointListOptions& options) {
  const Result<std::string> text = read_file(path);
  OBVID_TRY(text);
  return parse_points(*text, path == "-" ? string_view("standard input") : string_view(path),
                      options);
}

}  // namespace obvid
