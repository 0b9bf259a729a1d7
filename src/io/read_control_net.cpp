// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/internal/read_control_net.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "number_rows.h"
#include "obvid/core/files.h"
#include "text_lines.h"
#include "text_number.h"

namespace obvid {
namespace {

using std::string_view;

std::vector<double> clamped(std::size_t count, std::size_t degree, std::size_t times) {
  std::vector<double> knots(degree + 1, 0.0);
  const std::size_t inner = (count - degree - 1) / times;
  for (std::size_t i = 1; i <= inner; ++i) {
    knots.insert(knots.end(), times, static_cast<double>(i) / static_cast<double>(inner + 1));
  }
  knots.insert(knots.end(), degree + 1, 1.0);
  return knots;
}

Result<SurfacePatch> checked(SurfacePatch patch, string_view name) {
  if (auto good = check(patch.surface); !good) {
    Error error = good.error();
    error.where = fmt::format("{}, {}", name, patch.name);
    return fail(error);
  }
  return patch;
}

// ---- columns patch, row, col, x, y, z ---------------------------------------------------------

using Net = std::map<double, std::map<double, Vec3>>;  ///< by row, then by column

Result<SurfacePatch> bezier_patch(const Net& net, const std::string& patch, string_view name) {
  NurbsSurface s;
  const std::size_t nu = net.begin()->second.size(), nv = net.size();
  for (const auto& [row, line] : net) {
    if (line.size() != nu) {
      return error(ErrorCode::kBadCount, fmt::format("{} has rows of different length", patch))
          .where(std::string(name))
          .value(static_cast<double>(line.size()));
    }
    for (const auto& [column, point] : line) s.points.push_back(point);
    const auto& first = net.begin()->second;
    if (std::equal(line.begin(), line.end(), first.begin(),
                   [](const auto& a, const auto& b) { return a.first == b.first; })) {
      continue;
    }
    return error(ErrorCode::kBadCount,
                 fmt::format("row {:g} of {} has not the columns of its first row", row, patch))
        .where(std::string(name))
        .hint("every place of the net needs a point")
        .value(row);
  }
  if (nu < 2 || nv < 2) {
    return error(ErrorCode::kTooFewPoints,
                 fmt::format("{} has {} rows of {} points", patch, nv, nu))
        .where(std::string(name));
  }
  s.degree_u = static_cast<int>(nu) - 1;
  s.degree_v = static_cast<int>(nv) - 1;
  s.knots_u = clamped(nu, nu - 1, 1);
  s.knots_v = clamped(nv, nv - 1, 1);
  return checked({patch, std::move(s)}, name);
}

Result<SurfaceModel> bezier_patches(const NumberRows& rows, string_view name) {
  std::vector<std::size_t> column;
  std::size_t widest = 0;
  for (const char* wanted : {"patch", "row", "col", "x", "y", "z"}) {
    const int at = column_named(rows, wanted);
    if (at < 0) {
      return error(ErrorCode::kTooFewColumns, fmt::format("there is no column {}", wanted))
          .where(std::string(name))
          .hint("the columns are patch, row, col, x, y, z");
    }
    column.push_back(static_cast<std::size_t>(at));
    widest = std::max(widest, column.back() + 1);
  }
  std::map<double, Net> nets;
  for (const NumberRow& row : rows.rows) {
    if (row.values.size() < widest) {
      return fail(
          error_at(ErrorCode::kTooFewColumns, "the row has too few columns", name, row.line));
    }
    const auto at = [&](std::size_t k) { return row.values[column[k]]; };
    if (nets[at(0)][at(1)].emplace(at(2), Vec3{at(3), at(4), at(5)}).second) continue;
    return fail(
        error_at(ErrorCode::kBadCount, "this control point is given twice", name, row.line));
  }
  SurfaceModel model;
  for (const auto& [number, net] : nets) {
    auto patch = bezier_patch(net, fmt::format("patch {:g}", number), name);
    OBVID_TRY(patch);
    model.patches.push_back(std::move(*patch));
  }
  return model;
}

// ---- "x,y,z;x,y,z;..." ------------------------------------------------------------------------

struct NetRow {
  std::size_t line = 0;
  std::vector<std::vector<double>> points;
};

std::vector<string_view> parts_of(string_view text, char mark) {
  std::vector<string_view> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(mark, start), text.size());
    const string_view part = text::trim(text.substr(start, end - start));
    if (!part.empty()) parts.push_back(part);
    start = end + 1;
  }
  return parts;
}

Result<NetRow> row_of(string_view line, std::size_t number, string_view name) {
  NetRow row{number, {}};
  for (const string_view point : parts_of(line, ';')) {
    row.points.emplace_back();
    for (const string_view field : parts_of(point, ',')) {
      const text::ParsedNumber parsed = text::parse_number(field, false);
      if (parsed.kind != text::NumberKind::kNumber) {
        return fail(error_at(parsed.kind == text::NumberKind::kNotFinite ? ErrorCode::kNotFinite
                                                                         : ErrorCode::kBadNumber,
                             text::shown(field) + " is not a number", name, number,
                             "points are x,y,z;x,y,z;... or wx,wy,wz,w;..."));
      }
      row.points.back().push_back(parsed.value);
    }
  }
  return row;
}

/// Weights 1, w, 1, w, ..., 1 on every line of one direction: arcs.
bool is_of_arcs(const NurbsSurface& s, std::size_t count, std::size_t stride, std::size_t lines,
                std::size_t next_line) {
  if (s.weights.empty() || count < 3 || count % 2 == 0) return false;
  bool varies = false;
  for (std::size_t k = 0; k < lines; ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      const double w = s.weights[k * next_line + i * stride];
      if (i % 2 == 0 && w != 1.0) return false;
      varies = varies || w != 1.0;
    }
  }
  return varies;
}

void set_knots(bool arcs, std::size_t count, int& degree, std::vector<double>& knots) {
  constexpr std::size_t kCubic = 3;
  const std::size_t p = arcs ? 2 : std::min(kCubic, count - 1);
  degree = static_cast<int>(p);
  knots = clamped(count, p, arcs ? 2 : 1);
}

Result<SurfacePatch> net_patch(const std::vector<NetRow>& rows, string_view name) {
  NurbsSurface s;
  const std::size_t nu = rows.front().points.size(), nv = rows.size();
  const std::size_t width = rows.front().points.front().size();
  for (const NetRow& row : rows) {
    if (row.points.size() != nu) {
      return fail(
          error_at(ErrorCode::kBadCount,
                   fmt::format("{} points where the first line has {}", row.points.size(), nu),
                   name, row.line));
    }
    for (const std::vector<double>& p : row.points) {
      if (p.size() != width || width < 3 || width > 4) {
        return fail(
            error_at(ErrorCode::kTooFewColumns,
                     fmt::format("a point of {} numbers, not x,y,z or wx,wy,wz,w", p.size()), name,
                     row.line));
      }
      const double w = width == 4 ? p[3] : 1.0;
      if (!(w > 0.0)) {
        return fail(error_at(ErrorCode::kBadNumber, fmt::format("the weight {:g} is not > 0", w),
                             name, row.line, "points are wx,wy,wz,w with w > 0"));
      }
      s.points.push_back({p[0] / w, p[1] / w, p[2] / w});
      if (width == 4) s.weights.push_back(w);
    }
  }
  if (nu < 2 || nv < 2) {
    return error(ErrorCode::kTooFewPoints, fmt::format("{} lines of {} points are no net", nv, nu))
        .where(std::string(name))
        .hint("a surface needs at least 2 x 2 control points");
  }
  set_knots(is_of_arcs(s, nu, 1, nv, nu), nu, s.degree_u, s.knots_u);
  set_knots(is_of_arcs(s, nv, nu, nu, 1), nv, s.degree_v, s.knots_v);
  return checked({"net", std::move(s)}, name);
}

}  // namespace

Result<SurfaceModel> parse_control_net(string_view text, string_view name) {
  if (text.starts_with("patch,") || text.find("\npatch,") != string_view::npos) {
    const auto rows = number_rows(text, name);
    OBVID_TRY(rows);
    return bezier_patches(*rows, name);
  }
  std::vector<NetRow> rows;
  for (text::LineCursor cursor(text); !cursor.at_end();) {
    const string_view line = cursor.peek();
    const std::size_t number = cursor.line_number();
    cursor.skip(line);
    const string_view bare = text::trim(line);
    if (bare.empty() || bare.front() == '#') continue;
    auto row = row_of(bare, number, name);
    OBVID_TRY(row);
    if (!row->points.empty()) rows.push_back(std::move(*row));
  }
  if (rows.empty()) {
    return error(ErrorCode::kNothingThere, "the file holds no control points")
        .where(std::string(name));
  }
  auto patch = net_patch(rows, name);
  OBVID_TRY(patch);
  SurfaceModel model;
  model.patches.push_back(std::move(*patch));
  return model;
}

Result<SurfaceModel> read_control_net(const std::string& path) {
  const auto text = read_file(path);
  OBVID_TRY(text);
  auto model = parse_control_net(*text, path);
  if (model) model->name = std::filesystem::path(path).stem().string();
  return model;
}

}  // namespace obvid
