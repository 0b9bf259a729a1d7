// SPDX-License-Identifier: Apache-2.0
// What `obvid spline` says of functions of two variables. A cell is the biquadratic polynomial with
// the values of its corners, the integrals along its edges and the one over itself: nine data.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "command_checks.h"

namespace judge {
namespace {

/// Parabola on [0, h] with the values at its ends and the mean between them.
struct Parabola {
  Real first = 0.0L, last = 0.0L, mean = 0.0L, h = 1.0L;

  [[nodiscard]] Real bend() const { return 6.0L * mean - 3.0L * (first + last); }
  [[nodiscard]] Real at(Real v) const {
    const Real t = v / h;
    return first * (1.0L - t) + last * t + bend() * t * (1.0L - t);
  }
  [[nodiscard]] Real slope(Real v) const {
    return (last - first + bend() * (1.0L - 2.0L * v / h)) / h;
  }
};

/// Integral from 0 to h of the parabola through (-a, p), (0, q), (h, r), and likewise with the
/// third point behind: by Newton's form.
Real behind(Real a, Real h, Real p, Real q, Real r) {
  const Real one = (q - p) / a, two = ((r - q) / h - one) / (h + a);
  // the parabola is q + s one + s (s + a) two
  return q * h + one * h * h / 2.0L + two * (h * h * h / 3.0L + a * h * h / 2.0L);
}

/// Integrals between nodes from values alone (docs/methods/idspline.md, 2).
std::vector<Real> integrals_of(const std::vector<Real>& x, const std::vector<Real>& f) {
  std::vector<Real> out;
  const std::size_t n = x.size();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Real h = x[i + 1] - x[i];
    Real sum = 0.0L;
    int count = 0;
    if (i > 0) {
      sum += behind(x[i] - x[i - 1], h, f[i - 1], f[i], f[i + 1]);
      ++count;
    }
    if (i + 2 < n) {
      sum += behind(x[i + 2] - x[i + 1], h, f[i + 2], f[i + 1], f[i]);
      ++count;
    }
    out.push_back(count > 0 ? sum / count : 0.5L * h * (f[0] + f[1]));
  }
  return out;
}

struct GridSpline {
  std::vector<Real> x, y, values, along_x, along_y, cells;

  [[nodiscard]] std::size_t nx() const { return x.size(); }
  [[nodiscard]] std::size_t ny() const { return y.size(); }

  struct Value {
    Real f = 0.0L, dx = 0.0L, dy = 0.0L;
  };
  [[nodiscard]] Value in_cell(std::size_t i, std::size_t j, Real u, Real v) const {
    const Real h = x[i + 1] - x[i], k = y[j + 1] - y[j];
    const std::size_t n = nx(), at = j * n + i;
    const Parabola low{values[at], values[at + 1], along_x[j * (n - 1) + i] / h, h},
        high{values[at + n], values[at + n + 1], along_x[(j + 1) * (n - 1) + i] / h, h},
        mean{along_y[at] / k, along_y[at + 1] / k, cells[j * (n - 1) + i] / (h * k), h};
    const Real s = u - x[i], t = v - y[j];
    const Parabola up{low.at(s), high.at(s), mean.at(s), k};
    const Parabola rate{low.slope(s), high.slope(s), mean.slope(s), k};
    return {up.at(t), rate.at(t), up.slope(t)};
  }
  static std::size_t cell_of(const std::vector<Real>& nodes, Real at, bool before) {
    std::size_t k = 0;
    const Real near = 1e-13L * (std::abs(nodes.front()) + std::abs(nodes.back()));
    const Real side = before ? at - near : at + near;
    while (k + 2 < nodes.size() && nodes[k + 1] <= side) ++k;
    return k;
  }
  [[nodiscard]] Value at(Real u, Real v, bool before_x = false, bool before_y = false) const {
    return in_cell(cell_of(x, u, before_x), cell_of(y, v, before_y), u, v);
  }
};

std::vector<Real> longs(const Json& json) {
  const std::vector<double> all = json.reals();
  return {all.begin(), all.end()};
}

GridSpline grid_spline_of(const Json& json) {
  return {longs(json.at("x")),           longs(json.at("y")),
          longs(json.at("values")),      longs(json.at("integrals_x")),
          longs(json.at("integrals_y")), longs(json.at("integrals"))};
}

class GridCheck {
 public:
  GridCheck(const Json& json, const GridInput& input, Sheet& sheet)
      : json_(json), in_(input), sheet_(sheet), s_(grid_spline_of(json)) {}

  void run() {
    sheet_.expect(
        text_of(json_, "format") == "obvid-spline" && figure(json_, "variables").value == 2.0,
        "spline.format", text_of(json_, "format"), "obvid-spline", "");
    if (!nodes()) return;
    for (const Real f : s_.values) scale_ = std::max(scale_, std::abs(f));
    for (const GridInput::Place& p : in_.places) scale_ = std::max(scale_, std::abs(p.f));
    data();
    const Json& rows = json_.at("rows");
    sheet_.expect(rows.size() == 2, "spline.rows", static_cast<Real>(rows.size()), 2.0L, "");
    const char* name = in_.smooth ? "C1, values free" : "values kept";
    sheet_.expect(text_of(rows[0], "spline") == name, "spline.rows", text_of(rows[0], "spline"),
                  name, "the first");
    row(rows[0]);
  }

 private:
  [[nodiscard]] const GridInput::Place& place(std::size_t i, std::size_t j) const {
    return grid_[j * s_.nx() + i];
  }

  bool nodes() {
    std::vector<Real> x, y;
    for (const GridInput::Place& p : in_.places) {
      x.push_back(p.x);
      y.push_back(p.y);
    }
    for (std::vector<Real>* all : {&x, &y}) {
      std::sort(all->begin(), all->end());
      all->erase(std::unique(all->begin(), all->end()), all->end());
    }
    const bool same = x == s_.x && y == s_.y;
    sheet_.expect(same, "spline.nodes", "those of the table", same ? "the same" : "others", "");
    const std::size_t nx = x.size(), ny = y.size();
    const bool sizes = s_.values.size() == nx * ny && s_.along_x.size() == (nx - 1) * ny &&
                       s_.along_y.size() == nx * (ny - 1) && s_.cells.size() == (nx - 1) * (ny - 1);
    sheet_.expect(sizes, "spline.lists", "one per place, edge and cell", sizes ? "so" : "others",
                  "");
    if (!same || !sizes) return false;
    grid_.resize(nx * ny);
    for (const GridInput::Place& p : in_.places) {
      const auto i =
          static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), p.x) - x.begin());
      const auto j =
          static_cast<std::size_t>(std::lower_bound(y.begin(), y.end(), p.y) - y.begin());
      grid_[j * nx + i] = p;
    }
    return true;
  }

  /// Values, integrals along edges and over cells before any smoothing.
  [[nodiscard]] GridSpline kept() const {
    GridSpline out{s_.x, s_.y, {}, {}, {}, {}};
    const std::size_t nx = s_.nx(), ny = s_.ny();
    for (const GridInput::Place& p : grid_) out.values.push_back(p.f);
    std::vector<Real> rows, columns(nx * (ny - 1));
    for (std::size_t j = 0; j < ny; ++j) {
      std::vector<Real> f;
      for (std::size_t i = 0; i < nx; ++i) f.push_back(place(i, j).f);
      for (const Real one : integrals_of(s_.x, f)) rows.push_back(one);
    }
    for (std::size_t i = 0; i < nx; ++i) {
      std::vector<Real> f;
      for (std::size_t j = 0; j < ny; ++j) f.push_back(place(i, j).f);
      const std::vector<Real> one = integrals_of(s_.y, f);
      for (std::size_t j = 0; j + 1 < ny; ++j) columns[j * nx + i] = one[j];
    }
    std::vector<Real> cells((nx - 1) * (ny - 1));
    for (std::size_t i = 0; i + 1 < nx; ++i) {
      std::vector<Real> f;
      for (std::size_t j = 0; j < ny; ++j) f.push_back(rows[j * (nx - 1) + i]);
      const std::vector<Real> one = integrals_of(s_.y, f);
      for (std::size_t j = 0; j + 1 < ny; ++j) cells[j * (nx - 1) + i] = one[j];
    }
    for (std::size_t j = 0; j < ny; ++j) {
      for (std::size_t i = 0; i + 1 < nx; ++i) {
        if (in_.lines) rows[j * (nx - 1) + i] = place(i, j).along_x;
        if (in_.lines && j + 1 < ny) columns[j * nx + i] = place(i, j).along_y;
        if (in_.cells && j + 1 < ny) cells[j * (nx - 1) + i] = place(i, j).cell;
      }
      if (in_.lines && j + 1 < ny) columns[j * nx + nx - 1] = place(nx - 1, j).along_y;
    }
    out.along_x = std::move(rows);
    out.along_y = std::move(columns);
    out.cells = std::move(cells);
    return out;
  }

  void same(const char* claim, Real stated, Real found, Real scale, std::size_t at) {
    sheet_.expect(std::abs(stated - found) <= 1e-11L * scale, claim, stated, found,
                  fmt::format("entry {}", at + 1));
  }

  void data() {
    const GridSpline before = kept();
    const std::size_t nx = s_.nx(), ny = s_.ny();
    const Real wide = s_.x.back() - s_.x.front(), deep = s_.y.back() - s_.y.front();
    for (std::size_t k = 0; k < s_.values.size(); ++k) {
      const std::size_t i = k % nx, j = k / nx;
      const bool corner = (i == 0 || i + 1 == nx) && (j == 0 || j + 1 == ny);
      if (!in_.smooth || corner) same("spline.values", s_.values[k], before.values[k], scale_, k);
    }
    for (std::size_t k = 0; k < s_.along_x.size(); ++k) {
      const std::size_t j = k / (nx - 1);
      if (in_.smooth && j > 0 && j + 1 < ny) continue;
      same("spline.integrals_x", s_.along_x[k], before.along_x[k], scale_ * wide, k);
    }
    for (std::size_t k = 0; k < s_.along_y.size(); ++k) {
      const std::size_t i = k % nx;
      if (in_.smooth && i > 0 && i + 1 < nx) continue;
      same("spline.integrals_y", s_.along_y[k], before.along_y[k], scale_ * deep, k);
    }
    for (std::size_t k = 0; k < s_.cells.size(); ++k) {
      same("spline.integrals", s_.cells[k], before.cells[k], scale_ * wide * deep, k);
    }
    if (in_.smooth) smooth();
  }

  /// Slopes across every inner edge, at three places: biquadratic cells have no more freedom.
  void smooth() {
    const std::size_t nx = s_.nx(), ny = s_.ny();
    Real steep = scale_ / std::min(s_.x.back() - s_.x.front(), s_.y.back() - s_.y.front()),
         worst = 0.0L;
    for (std::size_t j = 0; j + 1 < ny; ++j) {
      for (std::size_t i = 0; i + 1 < nx; ++i) {
        for (const Real part : {0.0L, 0.5L, 1.0L}) {
          const Real u = s_.x[i] + part * (s_.x[i + 1] - s_.x[i]),
                     v = s_.y[j] + part * (s_.y[j + 1] - s_.y[j]);
          if (i + 2 < nx) {
            const Real a = s_.in_cell(i, j, s_.x[i + 1], v).dx,
                       b = s_.in_cell(i + 1, j, s_.x[i + 1], v).dx;
            worst = std::max(worst, std::abs(a - b));
            steep = std::max(steep, std::abs(a));
          }
          if (j + 2 < ny) {
            const Real a = s_.in_cell(i, j, u, s_.y[j + 1]).dy,
                       b = s_.in_cell(i, j + 1, u, s_.y[j + 1]).dy;
            worst = std::max(worst, std::abs(a - b));
            steep = std::max(steep, std::abs(a));
          }
        }
      }
    }
    sheet_.expect(worst <= 1e-10L * steep, "spline.continuous slopes", 0.0L, worst, "inner edges");
  }

  void expect(const Json& row, const char* name, Real wanted, Real scale, const char* where = "") {
    const Figure f = figure(row, name);
    const std::string claim = fmt::format("spline.rows.{}", name);
    if (!f.known()) return sheet_.fails(claim, "a figure", "none", where);
    sheet_.expect(std::abs(*f.value - wanted) <= 1e-11L * scale, claim, *f.value, wanted, where);
  }

  void row(const Json& row) {
    Real moved = 0.0L, all = 0.0L, cell = 0.0L;
    for (std::size_t k = 0; k < s_.values.size(); ++k) {
      moved = std::max(moved, std::abs(s_.values[k] - grid_[k].f));
    }
    const std::size_t nx = s_.nx();
    for (std::size_t k = 0; k < s_.cells.size(); ++k) {
      all += s_.cells[k];
      const Real given = grid_[k / (nx - 1) * nx + k % (nx - 1)].cell;
      cell = std::max(cell, std::abs(s_.cells[k] - given));
    }
    const Real area = (s_.x.back() - s_.x.front()) * (s_.y.back() - s_.y.front());
    expect(row, "largest_move", moved, scale_);
    expect(row, "integral", all, scale_ * area);
    if (in_.cells) {
      expect(row, "integral_error", cell, scale_ * area);
    } else {
      none(row, "integral_error");
    }
    if (in_.finer.empty()) {
      for (const char* name : {"largest_error", "largest_x", "largest_y", "rms_error"}) {
        none(row, name);
      }
      return;
    }
    Real largest = 0.0L, squares = 0.0L, scale = scale_;
    for (const GridInput::Place& p : in_.finer) {
      const Real error = std::abs(s_.at(p.x, p.y).f - p.f);
      largest = std::max(largest, error);
      squares += error * error;
      scale = std::max({scale, std::abs(p.f), error});
    }
    expect(row, "largest_error", largest, scale);
    expect(row, "rms_error", std::sqrt(squares / static_cast<Real>(in_.finer.size())), scale);
    const Real x = figure(row, "largest_x").value.value_or(0.0),
               y = figure(row, "largest_y").value.value_or(0.0);
    const auto there =
        std::find_if(in_.finer.begin(), in_.finer.end(),
                     [&](const GridInput::Place& p) { return p.x == x && p.y == y; });
    if (there == in_.finer.end()) {
      return sheet_.fails("spline.rows.largest_x", "a place of the finer data", "none", "");
    }
    const Real error = std::abs(s_.at(x, y).f - there->f);
    sheet_.expect(error >= largest - 1e-11L * scale, "spline.rows.largest_x", largest, error, "");
  }

  void none(const Json& row, const char* name) {
    const Figure f = figure(row, name);
    sheet_.expect(f.null(), fmt::format("spline.rows.{}", name), f.value.value_or(0.0), 0.0L,
                  "nothing is known of it");
  }

  const Json& json_;
  const GridInput& in_;
  Sheet& sheet_;
  GridSpline s_;
  std::vector<GridInput::Place> grid_;
  Real scale_ = 0.0L;
};

}  // namespace

void check_grid_spline(const Json& json, const GridInput& input, Sheet& sheet) {
  try {
    GridCheck(json, input, sheet).run();
  } catch (const std::exception& error) {
    sheet.fails("spline", "the fields of docs/formats.md", error.what(), "");
  }
}

void check_grid_samples(const Json& json, const std::string& text, std::size_t count,
                        Sheet& sheet) {
  const GridSpline s = grid_spline_of(json);
  std::string names;
  const auto rows = csv_rows(text, names);
  sheet.expect(names == "x,y,f,f_x,f_y", "spline samples", names, "", "names");
  const auto side = static_cast<std::size_t>(std::floor(std::sqrt(static_cast<Real>(count))));
  sheet.expect(rows.size() == side * side, "spline samples", static_cast<Real>(rows.size()),
               static_cast<Real>(side * side), "rows");
  Real scale = 0.0L;
  for (const Real f : s.values) scale = std::max(scale, std::abs(f));
  Real narrow = s.x[1] - s.x[0];
  for (const std::vector<Real>* nodes : {&s.x, &s.y}) {
    for (std::size_t i = 1; i < nodes->size(); ++i) {
      narrow = std::min(narrow, (*nodes)[i] - (*nodes)[i - 1]);
    }
  }
  const auto place = [&](const std::vector<Real>& nodes, std::size_t k) {
    return nodes.front() +
           (nodes.back() - nodes.front()) * static_cast<Real>(k) / static_cast<Real>(side - 1);
  };
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto& row = rows[k];
    const std::string where = fmt::format("row {}", k + 1);
    if (row.size() != 5 || !row[0] || !row[1] || !row[2] || !row[3] || !row[4]) {
      sheet.fails("spline samples", "5 cells", std::to_string(row.size()), where);
      continue;
    }
    const Real x = *row[0], y = *row[1];
    const Real off =
        std::max(std::abs(x - place(s.x, k % side)), std::abs(y - place(s.y, k / side)));
    sheet.expect(off <= 1e-14L * (std::abs(s.x.front()) + std::abs(s.x.back()) +
                                  std::abs(s.y.front()) + std::abs(s.y.back())),
                 "spline samples.places", 0.0L, off, where);
    // at an edge between cells there may be two slopes
    bool f = false, dx = false, dy = false;
    for (const bool left : {false, true}) {
      for (const bool low : {false, true}) {
        const GridSpline::Value v = s.at(x, y, left, low);
        f = f || std::abs(v.f - *row[2]) <= 1e-11L * scale;
        dx = dx || std::abs(v.dx - *row[3]) <= 1e-10L * scale / narrow;
        dy = dy || std::abs(v.dy - *row[4]) <= 1e-10L * scale / narrow;
      }
    }
    const GridSpline::Value v = s.at(x, y);
    sheet.expect(f, "spline samples.f", *row[2], v.f, where);
    sheet.expect(dx, "spline samples.f_x", *row[3], v.dx, where);
    sheet.expect(dy, "spline samples.f_y", *row[4], v.dy, where);
  }
}

}  // namespace judge
