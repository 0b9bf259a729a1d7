// SPDX-License-Identifier: Apache-2.0
#include "surface_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "obvid/core/internal/parallel.h"
#include "reach.h"

namespace obvid::toolpath {
namespace {

constexpr double kMostCells = 1e6;  // some 120 MB; larger parts get larger cells
constexpr double kMostTiles = 1e6;
constexpr double kCellMargin = 1.25;  // for what the derivatives in the middle do not say
constexpr std::size_t kLines = 9;     // across, that lengths are measured on
constexpr std::size_t kParts = 4;     // of a span, likewise

/// Knots inside the domain where the surface may have an edge, with the domain's ends.
std::vector<double> stretches(const std::vector<double>& knots, int degree, Range domain) {
  std::vector<double> out{domain.from};
  for (std::size_t i = 0; i < knots.size();) {
    std::size_t end = i + 1;
    while (end < knots.size() && knots[end] == knots[i]) ++end;
    const bool inside = knots[i] > domain.from && knots[i] < domain.to;
    if (inside && end - i >= static_cast<std::size_t>(degree)) out.push_back(knots[i]);
    i = end;
  }
  out.push_back(domain.to);
  return out;
}

/// Parameters within [from, to] that lie about `spacing` apart on the fastest of some lines.
void divide_stretch(const NurbsSurface& s, bool along_u, double from, double to, double spacing,
                    std::vector<double>& out) {
  const Range across = along_u ? domain_v(s) : domain_u(s);
  const std::size_t count = kParts * (along_u ? s.count_u() : s.count_v());
  std::vector<double> length(count + 1, 0.0);
  const auto at = [&](std::size_t i) {
    return from + (to - from) * static_cast<double>(i) / static_cast<double>(count);
  };
  std::vector<Vec3> last(kLines);
  for (std::size_t i = 0; i <= count; ++i) {
    double step = 0.0;
    for (std::size_t k = 0; k < kLines; ++k) {
      const double w = across.at(static_cast<double>(k) / (kLines - 1));
      const Vec3 p = evaluate(s, along_u ? at(i) : w, along_u ? w : at(i)).point;
      if (i > 0) step = std::max(step, norm(p - last[k]));
      last[k] = p;
    }
    if (i > 0) length[i] = length[i - 1] + step;
  }
  const double parts = std::max(1.0, std::ceil(length.back() / spacing));
  const auto cells = static_cast<std::size_t>(parts);
  std::size_t i = 1;
  for (std::size_t k = 1; k < cells; ++k) {
    const double aim = length.back() * static_cast<double>(k) / parts;
    while (i < count && length[i] < aim) ++i;
    const double part = (aim - length[i - 1]) / (length[i] - length[i - 1]);
    const double next = at(i - 1) + part * (at(i) - at(i - 1));
    if (next > out.back() && next < to) out.push_back(next);
  }
  out.push_back(to);
}

std::vector<double> divided(const NurbsSurface& s, bool along_u, double spacing) {
  const auto ends = along_u ? stretches(s.knots_u, s.degree_u, domain_u(s))
                            : stretches(s.knots_v, s.degree_v, domain_v(s));
  std::vector<double> out{ends.front()};
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    divide_stretch(s, along_u, ends[k], ends[k + 1], spacing, out);
  }
  return out;
}

/// To the surface that far out along its normals.
void move_out(Cell& cell, double allowance) {
  cell.point = cell.point + allowance * cell.normal;
  cell.reach += allowance * cell.turn;
  cell.rise += 0.5 * allowance * cell.turn * cell.turn;
}

}  // namespace

Cell cell_at(const SurfaceModel& model, const CellPlace& at, Vec3 side, double allowance) {
  const SurfaceJet jet = evaluate(model.patches[at.patch].surface, at.u, at.v);
  Cell cell;
  cell.point = jet.point;
  const Vec3 across = cross(jet.du, jet.dv);
  const double size = norm(across);
  cell.area = 4.0 * size * at.du * at.dv;
  if (!(size > 0.0)) return cell;
  const Vec3 n = across / size;
  cell.normal = dot(n, side) < 0.0 ? -n : n;
  const Vec3 u = at.du * jet.du, v = at.dv * jet.dv;
  const Vec3 uu = at.du * at.du * jet.duu, uv = at.du * at.dv * jet.duv,
             vv = at.dv * at.dv * jet.dvv;
  const double bend = 0.5 * (norm(uu) + 2.0 * norm(uv) + norm(vv));
  cell.reach = kCellMargin * (std::max(norm(u + v), norm(u - v)) + bend);
  cell.rise = kCellMargin * 0.5 *
              (std::abs(dot(n, uu)) + 2.0 * std::abs(dot(n, uv)) + std::abs(dot(n, vv)));
  const auto turned = [&](Vec3 d) { return norm(d - dot(n, d) * n); };
  const double cell_size = size * at.du * at.dv;
  cell.turn = kCellMargin *
              (turned(cross(uu, v) + cross(u, uv)) + turned(cross(uv, v) + cross(u, vv))) /
              cell_size;
  move_out(cell, allowance);
  return cell;
}

Result<SurfaceCells> SurfaceCells::make(const Part& part, double spacing, double tile,
                                        std::size_t threads, const RunContext& run) {
  SurfaceCells out(spacing);
  out.divide(part.model());
  OBVID_TRY(out.fill(part, tile, threads, run));
  return out;
}

void SurfaceCells::divide(const SurfaceModel& model) {
  constexpr double kMore = 1.05;  // so that one more division is enough
  for (bool good = false; !good;) {
    grids_.clear();
    double cells = 0.0;
    for (const SurfacePatch& patch : model.patches) {
      grids_.push_back(
          {divided(patch.surface, true, spacing_), divided(patch.surface, false, spacing_)});
      cells += static_cast<double>(grids_.back().cells());
    }
    const double least = static_cast<double>(grids_.size());
    good = cells <= kMostCells || cells <= 4.0 * least;
    if (!good) spacing_ *= kMore * std::sqrt(cells / kMostCells);
  }
}

CellPlace SurfaceCells::place(const Origin& at) const {
  const Grid& grid = grids_[at.patch];
  const double u0 = grid.us[at.i], u1 = grid.us[at.i + 1];
  const double v0 = grid.vs[at.j], v1 = grid.vs[at.j + 1];
  return {at.patch, 0.5 * (u0 + u1), 0.5 * (v0 + v1), 0.5 * (u1 - u0), 0.5 * (v1 - v0)};
}

CellPlace SurfaceCells::place(std::size_t cell) const { return place(origins_[cell]); }

// Twice over all places: where they lie, so that their tiles are known, then each cell at its
// number. That costs less than to put a hundred megabytes in order.
Result<void> SurfaceCells::fill(const Part& part, double tile, std::size_t threads,
                                const RunContext& run) {
  std::vector<Row> rows;
  std::size_t count = 0;
  for (std::uint32_t p = 0; p < grids_.size(); ++p) {
    grids_[p].first = count;
    for (std::uint32_t j = 0; j + 1 < grids_[p].vs.size(); ++j) {
      const std::size_t cells = grids_[p].us.size() - 1;
      rows.push_back({p, j, count, cells});
      count += cells;
    }
  }
  LargeList<Vec2> places(count);
  OBVID_TRY(in_parallel(rows.size(), with_threads(run, threads), [&](std::size_t r) {
    for (std::uint32_t i = 0; i < rows[r].count; ++i) {
      const Vec3 p = made(part, {rows[r].patch, i, rows[r].j}).point;
      places[rows[r].first + i] = {p.x, p.y};
    }
  }));
  sort_into_tiles(tile, rows, places, threads);
  cells_.resize(count);
  origins_.resize(count);
  return in_parallel(rows.size(), with_threads(run, threads), [&](std::size_t r) {
    for (std::uint32_t i = 0; i < rows[r].count; ++i) {
      const Origin origin{rows[r].patch, i, rows[r].j};
      const std::uint32_t number = number_[rows[r].first + i];
      cells_[number] = made(part, origin);
      origins_[number] = origin;
    }
  });
}

// The allowance lies on the open side, which is looked for from the surface itself.
Cell SurfaceCells::made(const Part& part, const Origin& origin) const {
  const CellPlace at = place(origin);
  Cell cell = cell_at(part.model(), at, {0.0, 0.0, 1.0}, 0.0);
  if (!part.is_there(at.patch, at.u, at.v)) {
    cell.there = false;
    cell.area = 0.0;
    cell.normal = {};
    return cell;
  }
  cell.normal = open_side(part, cell.point, cell.normal);
  move_out(cell, part.allowance());
  return cell;
}

std::size_t SurfaceCells::column(double x) const {
  return static_cast<std::size_t>(
      std::clamp((x - box_.low.x) / tile_, 0.0, static_cast<double>(nx_ - 1)));
}

std::size_t SurfaceCells::row(double y) const {
  return static_cast<std::size_t>(
      std::clamp((y - box_.low.y) / tile_, 0.0, static_cast<double>(ny_ - 1)));
}

void SurfaceCells::sort_into_tiles(double tile, const std::vector<Row>& rows,
                                   const LargeList<Vec2>& places, std::size_t threads) {
  box_ = {};
  for (const Vec2 p : places) box_.add(p);
  const auto [dx, dy] = box_.size();
  tile_ = std::max({tile, std::sqrt(dx * dy / kMostTiles), (dx + dy) / kMostTiles});
  nx_ = static_cast<std::size_t>(dx / tile_) + 1;
  ny_ = static_cast<std::size_t>(dy / tile_) + 1;
  number_.resize(places.size());
  in_parallel(rows.size(), threads, [&](std::size_t r) {
    for (std::size_t k = rows[r].first; k < rows[r].first + rows[r].count; ++k) {
      number_[k] = static_cast<std::uint32_t>(row(places[k].y) * nx_ + column(places[k].x));
    }
  });
  tiles_.assign(nx_ * ny_, {});
  for (const std::uint32_t t : number_) ++tiles_[t].count;
  std::uint32_t first = 0;
  for (Tile& t : tiles_) {
    t.first = first;
    first += t.count;
    t.count = 0;
  }
  for (std::uint32_t& number : number_) {
    Tile& t = tiles_[number];
    number = t.first + t.count++;
  }
}

}  // namespace obvid::toolpath
