// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "read_points_raw.h"
#include "text_lines.h"

namespace obvid {
namespace {

// Each side of an airfoil begins and ends this close to the least and largest x, relative to the
// chord.
constexpr double kEdgePart = 0.1;

// Fewest points that a Lednicer side has; smaller counts are coordinates.
constexpr double kMinSideCount = 3.0;

struct Side {
  std::size_t begin = 0;
  std::size_t end = 0;
};

Error bad_count(const RawPoints& raw, std::string_view name, std::size_t line, std::string what) {
  Error error;
  error.code = ErrorCode::kBadCount;
  error.what = std::move(what);
  error.where = text::position(name, line, 1);
  error.hint = "correct the count or the points";
  error.value = static_cast<double>(raw.points.size());
  return error;
}

std::string says(std::size_t stated, std::size_t found) {
  return "the file states " + std::to_string(stated) + " points and holds " + std::to_string(found);
}

// Upper side from its trailing edge to the leading edge, then the lower side. A leading edge that
// stands on both sides is taken once: the format repeats it by design.
void join_sides(RawPoints& raw, Side upper, Side lower, bool mirror) {
  std::vector<Vec2> points;
  std::vector<std::uint32_t> lines;
  for (std::size_t i = upper.end; i-- > upper.begin;) {
    points.push_back(raw.points[i]);
    lines.push_back(raw.lines[i]);
  }
  for (std::size_t i = lower.begin; i < lower.end; ++i) {
    const Vec2 p = raw.points[i];
    const Vec2 q = mirror ? Vec2{p.x, 0.0 - p.y} : p;
    if (i == lower.begin && !points.empty() && points.back() == q) continue;
    points.push_back(q);
    lines.push_back(raw.lines[i]);
  }
  raw.points = std::move(points);
  raw.lines = std::move(lines);
  raw.breaks.clear();
}

Result<void> resolve_vsp(RawPoints& raw, std::string_view name) {
  const VspHead head = *raw.vsp;
  const std::size_t upper = head.upper.value_or(0);
  const std::size_t lower = head.symmetric ? 0 : head.lower.value_or(0);
  if (upper + lower != raw.points.size()) {
    return fail(bad_count(raw, name, raw.stated_line, says(upper + lower, raw.points.size())));
  }
  const Side first{0, upper};
  join_sides(raw, first, head.symmetric ? first : Side{upper, upper + lower}, head.symmetric);
  return {};
}

Result<void> resolve_count(RawPoints& raw, std::string_view name) {
  if (*raw.stated_count != raw.points.size()) {
    return fail(bad_count(raw, name, raw.stated_line, says(*raw.stated_count, raw.points.size())));
  }
  if (raw.reference_first && !raw.points.empty()) {
    raw.points.erase(raw.points.begin());
    raw.first_is_point = false;
    raw.lines.erase(raw.lines.begin());
    raw.breaks.clear();
  }
  return {};
}

// Whether the points run from the leading to the trailing edge.
bool runs_back(const RawPoints& raw, Side side) {
  if (side.end - side.begin < 2) return false;
  const auto [least, most] = std::minmax_element(raw.points.begin() + 1, raw.points.end(),
                                                 [](Vec2 a, Vec2 b) { return a.x < b.x; });
  const double margin = kEdgePart * (most->x - least->x);
  return raw.points[side.begin].x <= least->x + margin &&
         raw.points[side.end - 1].x >= most->x - margin;
}

bool is_side_count(double value, std::size_t rows) {
  return value >= kMinSideCount && value < static_cast<double>(rows) && value == std::floor(value);
}

// Lednicer: a row with the two counts, then both sides from the leading edge, mostly with blank
// lines between. The sides' direction tells the counts from a point.
Result<void> resolve_lednicer(RawPoints& raw, std::string_view name) {
  const std::size_t n = raw.points.size();
  if (raw.named || !raw.white || raw.columns != 2 ||
      n < 2 * static_cast<std::size_t>(kMinSideCount))
    return {};
  const bool spaced = raw.breaks.size() == 2 && raw.breaks[0] == 1;
  const bool dense = raw.breaks.empty() && !raw.title.empty();
  const Vec2 counts = raw.points[0];
  if ((!spaced && !dense) || !is_side_count(counts.x, 2 * n) || !is_side_count(counts.y, 2 * n))
    return {};
  const auto upper = static_cast<std::size_t>(counts.x);
  const auto lower = static_cast<std::size_t>(counts.y);
  const std::size_t middle = spaced ? raw.breaks[1] : 1 + upper;
  if (middle >= n || !runs_back(raw, {1, middle}) || !runs_back(raw, {middle, n})) return {};
  if (middle != 1 + upper || n != middle + lower) {
    const std::string found = std::to_string(middle - 1) + " and " + std::to_string(n - middle);
    return fail(bad_count(raw, name, raw.lines[0],
                          "the file states sides of " + std::to_string(upper) + " and " +
                              std::to_string(lower) + " points and holds " + found));
  }
  raw.first_is_point = false;
  join_sides(raw, {1, middle}, {middle, n}, false);
  return {};
}

}  // namespace

Result<void> resolve_layout(RawPoints& raw, std::string_view name) {
  if (raw.vsp) return resolve_vsp(raw, name);
  if (raw.stated_count) return resolve_count(raw, name);
  return resolve_lednicer(raw, name);
}

}  // namespace obvid
