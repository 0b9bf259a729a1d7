// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/internal/read_cloud.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "number_rows.h"

namespace obvid {
namespace {

/// Whole numbers, each greater than the one before.
bool counts_rows(const NumberRows& rows) {
  double before = -HUGE_VAL;
  return std::all_of(rows.rows.begin(), rows.rows.end(), [&](const NumberRow& row) {
    const double value = row.values.empty() ? NAN : row.values.front();
    return value == std::floor(value) && value > std::exchange(before, value);
  });
}

struct CloudColumns {
  std::array<int, 3> of{};
  std::string assumed;
};

Result<CloudColumns> cloud_columns(const NumberRows& rows, std::string_view name) {
  CloudColumns out;
  out.of = {column_named(rows, "x"), column_named(rows, "y"), column_named(rows, "z")};
  const auto named = std::count_if(out.of.begin(), out.of.end(), [](int k) { return k >= 0; });
  if (named == 3) return out;
  if (named > 0) {
    return error(ErrorCode::kTooFewColumns, "not all of the columns x, y and z are there")
        .where(std::string(name))
        .hint("name all three, or none: then the first three columns are taken");
  }
  const std::size_t width = rows.rows.front().values.size();
  const int first = width > 3 && rows.rows.size() > 1 && counts_rows(rows) ? 1 : 0;
  out.of = {first, first + 1, first + 2};
  if (width > 3) {
    out.assumed =
        fmt::format("columns {}, {} and {} of {} are taken as x, y and z{}", first + 1, first + 2,
                    first + 3, width, first > 0 ? ", the first one numbers the points" : "");
  }
  return out;
}

}  // namespace

Result<PointCloud> parse_cloud(std::string_view text, std::string_view name) {
  const auto rows = number_rows(text, name);
  OBVID_TRY(rows);
  const auto columns = cloud_columns(*rows, name);
  OBVID_TRY(columns);
  auto units = units_of_columns(*rows, name);
  OBVID_TRY(units);
  PointCloud out;
  out.assumed = columns->assumed;
  out.points.name = std::filesystem::path(name).stem().string();
  out.points.units = std::move(*units);
  const std::vector<double> half = rows->rounding(columns->of);
  out.points.rounding = {half[0], half[1], half[2]};
  std::array<std::size_t, 3> at{};
  std::copy(columns->of.begin(), columns->of.end(), at.begin());
  const std::size_t widest = *std::max_element(at.begin(), at.end());
  for (const NumberRow& row : rows->rows) {
    if (row.values.size() <= widest) {
      return fail(error_at(ErrorCode::kTooFewColumns,
                           fmt::format("{} numbers where x y z are needed", row.values.size()),
                           name, row.line));
    }
    out.points.points.push_back({row.values[at[0]], row.values[at[1]], row.values[at[2]]});
  }
  return out;
}

}  // namespace obvid
