// SPDX-License-Identifier: Apache-2.0
// Text behind the points. Airfoil files often end with remarks. They are passed over, with a
// warning, only where the points make a whole airfoil, the line does not look like a damaged row,
// and no row follows.
#include <algorithm>

#include "read_points_reader.h"

namespace obvid {

using std::string_view;
using text::NumberKind;
using text::Separator;

namespace {

// An airfoil's ends lie this close to its largest x, relative to its chord. Open trailing edges
// of the public sets lie within 0.06.
constexpr double kTrailingEdgePart = 0.1;

// Fewest points of an airfoil behind which free text may stand.
constexpr std::size_t kMinAirfoilPoints = 10;

}  // namespace

bool RowReader::is_trailer(const Error& error, string_view line) const {
  if (error.code != ErrorCode::kBadNumber || raw_.named || separator_ != Separator::kWhite) {
    return false;
  }
  const string_view body = text::trim(line);
  if (!blank_before_ && starts_like_number(body)) return false;
  text::Fields fields;
  text::split(body, Separator::kWhite, fields);
  const bool row_like = fields.count > 1 &&
                        text::parse_number(fields.cell[0], true).kind != NumberKind::kNotNumber &&
                        starts_like_number(fields.cell[1]);
  return !row_like && is_airfoil_loop() && !number_row_follows();
}

bool RowReader::is_airfoil_loop() const {
  if (raw_.points.size() < kMinAirfoilPoints) return false;
  const auto [least, most] = std::minmax_element(raw_.points.begin(), raw_.points.end(),
                                                 [](Vec2 a, Vec2 b) { return a.x < b.x; });
  const double edge = most->x - kTrailingEdgePart * (most->x - least->x);
  return raw_.points.front().x >= edge && raw_.points.back().x >= edge && least->x < edge;
}

bool RowReader::number_row_follows() const {
  text::LineCursor ahead(cursor_.rest());
  text::Fields fields;
  while (!ahead.at_end()) {
    const string_view line = ahead.peek();
    ahead.skip(line);
    text::split(line, Separator::kWhite, fields);
    const auto end = fields.cell.begin() + static_cast<std::ptrdiff_t>(fields.count);
    const bool row =
        fields.count >= 2 && std::all_of(fields.cell.begin(), end, [](string_view cell) {
          return text::parse_number(cell, true).kind != NumberKind::kNotNumber;
        });
    if (row) return true;
  }
  return false;
}

void RowReader::warn_about_trailer() {
  const std::size_t first = cursor_.line_number();
  raw_.warnings.push_back("Text behind the points is passed over, from line " +
                          std::to_string(first) + " on.");
}

}  // namespace obvid
