// SPDX-License-Identifier: Apache-2.0
#include "cells.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace obvid {
namespace {

constexpr std::size_t kCellsBetweenQuestions = 4096;  ///< asked for cancellation: some ms

struct Signs {
  bool positive = false, negative = false;
  void add(double x, double noise = 0.0) {
    positive = positive || x > noise;
    negative = negative || x < -noise;
  }
};

class Divider {
 public:
  Divider(const CutPatch& patch, std::span<const double> heights, double noise)
      : patch_(patch),
        heights_(heights),
        noise_(noise),
        n_(static_cast<std::size_t>(patch.u.degree) + 1),
        m_(static_cast<std::size_t>(patch.v.degree) + 1) {}

  /// Whether all control points of a span lie on one side.
  [[nodiscard]] CellKind kind_of_span(std::size_t su, std::size_t sv) const {
    // the last row of a span has its first control point where the span's own begin
    const std::size_t i0 = patch_.u.rows[su * (n_ - 1) + 1].first;
    const std::size_t j0 = patch_.v.rows[sv * (m_ - 1) + 1].first;
    bool above = true, below = true;
    for (std::size_t j = j0; j < j0 + m_; ++j) {
      const double* row = heights_.data() + j * patch_.surface->count_u();
      for (std::size_t i = i0; i < i0 + n_; ++i) {
        (row[i] < 0.0 ? above : below) = false;
      }
      if (!above && !below) return CellKind::kUndecided;
    }
    return above ? CellKind::kAbove : CellKind::kBelow;
  }

  [[nodiscard]] SectionCell cell_of_span(std::size_t su, std::size_t sv) const {
    SectionCell cell;
    cell.span_u = su;
    cell.span_v = sv;
    for (std::size_t l = 0; l < m_; ++l) {
      const BezierRow& b = patch_.v.rows[sv * (m_ - 1) + l];
      for (std::size_t k = 0; k < n_; ++k) {
        const BezierRow& a = patch_.u.rows[su * (n_ - 1) + k];
        double sum = 0.0;
        for (std::size_t j = 0; j < m_; ++j) {
          const double* row = heights_.data() + (b.first + j) * patch_.surface->count_u() + a.first;
          double along = 0.0;
          for (std::size_t i = 0; i < n_; ++i) along += a.weight[i] * row[i];
          sum += b.weight[j] * along;
        }
        cell.c[l * n_ + k] = sum;
      }
    }
    return cell;
  }

  [[nodiscard]] CellKind kind_of(const SectionCell& cell) const {
    bool above = true, below = true;
    for (std::size_t i = 0; i < n_ * m_; ++i) (cell.c[i] < 0.0 ? above : below) = false;
    if (above) return CellKind::kAbove;
    if (below) return CellKind::kBelow;
    Signs along_u, along_v;
    bool sure_u = true, sure_v = true;
    double steep_u = 0.0, steep_v = 0.0;
    for (std::size_t l = 0; l < m_; ++l) {
      for (std::size_t k = 0; k < n_; ++k) {
        const double here = cell.c[l * n_ + k];
        if (k + 1 < n_) {
          const double step = cell.c[l * n_ + k + 1] - here;
          sure_u = sure_u && std::abs(step) > noise_;
          along_u.add(step);
          steep_u += std::abs(step) * static_cast<double>(n_ - 1) / static_cast<double>(m_);
        }
        if (l + 1 < m_) {
          const double step = cell.c[(l + 1) * n_ + k] - here;
          sure_v = sure_v && std::abs(step) > noise_;
          along_v.add(step);
          steep_v += std::abs(step) * static_cast<double>(m_ - 1) / static_cast<double>(n_);
        }
      }
    }
    const bool u = sure_u && along_u.positive != along_u.negative;
    const bool v = sure_v && along_v.positive != along_v.negative;
    if (u && v) return steep_v >= steep_u ? CellKind::kOverU : CellKind::kOverV;
    return v ? CellKind::kOverU : u ? CellKind::kOverV : CellKind::kUndecided;
  }

  /// The four quarters; what they share has the same bits in all of them.
  [[nodiscard]] std::array<SectionCell, 4> quarters(const SectionCell& cell) const {
    std::array<SectionCell, 2> halves{cell, cell};
    for (std::size_t l = 0; l < m_; ++l) halve(halves, l * n_, 1, n_);
    std::array<SectionCell, 4> out{halves[0], halves[1], halves[0], halves[1]};
    for (std::size_t side = 0; side < 2; ++side) {
      std::array<SectionCell, 2> both{halves[side], halves[side]};
      for (std::size_t k = 0; k < n_; ++k) halve(both, k, n_, m_);
      out[side] = both[0];
      out[side + 2] = both[1];
    }
    for (std::uint32_t k = 0; k < 4; ++k) {
      out[k].halvings = cell.halvings + 1;
      out[k].at_u = 2 * cell.at_u + k % 2;
      out[k].at_v = 2 * cell.at_v + k / 2;
    }
    return out;
  }

 private:
  /// De Casteljau at the middle of one line of coefficients, the same in both cells before.
  static void halve(std::array<SectionCell, 2>& cells, std::size_t first, std::size_t step,
                    std::size_t count) {
    std::array<double, kMaxNurbsDegree + 1> line{};
    for (std::size_t i = 0; i < count; ++i) line[i] = cells[0].c[first + i * step];
    for (std::size_t r = 0; r < count; ++r) {
      cells[0].c[first + r * step] = line[0];
      cells[1].c[first + (count - 1 - r) * step] = line[count - 1 - r];
      for (std::size_t i = 0; i + 1 < count - r; ++i) line[i] = 0.5 * (line[i] + line[i + 1]);
    }
  }

  const CutPatch& patch_;
  std::span<const double> heights_;
  double noise_;
  std::size_t n_, m_;
};

/// Coefficients of both halves.
std::array<std::vector<double>, 2> halves_of(std::vector<double> line) {
  const std::size_t count = line.size();
  std::array<std::vector<double>, 2> out{line, line};
  for (std::size_t r = 0; r < count; ++r) {
    out[0][r] = line[0];
    out[1][count - 1 - r] = line[count - 1 - r];
    for (std::size_t i = 0; i + 1 < count - r; ++i) line[i] = 0.5 * (line[i] + line[i + 1]);
  }
  return out;
}

double value_at(std::vector<double> line, double t) {
  for (std::size_t count = line.size(); count > 1; --count) {
    for (std::size_t i = 0; i + 1 < count; ++i) line[i] = (1.0 - t) * line[i] + t * line[i + 1];
  }
  return line[0];
}

std::size_t variations(const std::vector<double>& line) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < line.size(); ++i) count += (line[i] < 0.0) != (line[i - 1] < 0.0);
  return count;
}

/// The only root, by halving: as exact as doubles are, whatever the slope.
double only_root(const std::vector<double>& line) {
  const bool falls = line.back() < 0.0;
  constexpr double kLeastOfParameter = 1e-17;  // beside 1 nothing: roots near 0 need no more digits
  double low = 0.0, high = 1.0;
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high) || high - low < kLeastOfParameter) return middle;
    ((value_at(line, middle) < 0.0) == falls ? high : low) = middle;
  }
}

constexpr int kMostRootHalvings = 40;  ///< 1e-12 of the line

void add_roots(const std::vector<double>& line, double from, double length, int depth,
               std::vector<double>& roots) {
  const std::size_t changes = variations(line);
  if (changes == 0) return;
  if (changes == 1) {
    roots.push_back(from + length * only_root(line));
    return;
  }
  if (depth >= kMostRootHalvings) {
    if ((line.front() < 0.0) != (line.back() < 0.0)) roots.push_back(from + 0.5 * length);
    return;
  }
  const auto [low, high] = halves_of(line);
  add_roots(low, from, 0.5 * length, depth + 1, roots);
  add_roots(high, from + 0.5 * length, 0.5 * length, depth + 1, roots);
}

}  // namespace

CutPatch cut_patch(const NurbsSurface& surface) {
  return {&surface, bezier_rows(surface.degree_u, surface.knots_u),
          bezier_rows(surface.degree_v, surface.knots_v)};
}

std::vector<double> heights_of(const NurbsSurface& surface, const CutPlane& plane) {
  std::vector<double> heights(surface.points.size());
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double distance = dot(plane.normal, surface.points[i]) - plane.offset;
    heights[i] = surface.weights.empty() ? distance : surface.weights[i] * distance;
  }
  return heights;
}

Result<void> divide(const CutPatch& patch, std::span<const double> heights, double noise,
                    const RunContext& run,
                    const std::function<void(const SectionCell&, CellKind)>& take) {
  const Divider divider(patch, heights, noise);
  std::vector<SectionCell> open, next;
  const auto sort_out = [&](const SectionCell& cell) {
    const CellKind kind = divider.kind_of(cell);
    if (kind == CellKind::kUndecided) {
      next.push_back(cell);
    } else {
      take(cell, kind);
    }
  };
  for (std::size_t sv = 0; sv < patch.v.spans(); ++sv) {
    OBVID_TRY(may_go_on(run));
    for (std::size_t su = 0; su < patch.u.spans(); ++su) {
      const CellKind kind = divider.kind_of_span(su, sv);
      if (kind == CellKind::kUndecided) {
        sort_out(divider.cell_of_span(su, sv));
      } else if (kind == CellKind::kBelow) {
        SectionCell cell;
        cell.span_u = su;
        cell.span_v = sv;
        take(cell, kind);
      }
    }
  }
  while (!next.empty()) {
    open = std::exchange(next, {});
    const int halvings = open.front().halvings;
    const bool enough = halvings >= kMostHalvings ||
                        (halvings >= kHalvingsAlongLines && open.size() > kMostCellsAtOnce);
    std::size_t asked = 0;
    for (const SectionCell& cell : open) {
      if (enough) {
        take(cell, CellKind::kUndecided);
        continue;
      }
      for (const SectionCell& quarter : divider.quarters(cell)) sort_out(quarter);
      if (++asked % kCellsBetweenQuestions == 0) OBVID_TRY(may_go_on(run));
    }
  }
  return {};
}

std::vector<double> side_of(const SectionCell& cell, int degree_u, int degree_v, std::size_t side) {
  const auto n = static_cast<std::size_t>(degree_u) + 1, m = static_cast<std::size_t>(degree_v) + 1;
  std::vector<double> line;
  if (side < 2) {
    for (std::size_t l = 0; l < m; ++l) line.push_back(cell.c[l * n + (side == 1 ? n - 1 : 0)]);
  } else {
    for (std::size_t k = 0; k < n; ++k) line.push_back(cell.c[(side == 3 ? m - 1 : 0) * n + k]);
  }
  return line;
}

std::vector<double> sign_changes(const std::vector<double>& coefficients) {
  std::vector<double> roots;
  add_roots(coefficients, 0.0, 1.0, 0, roots);
  return roots;
}

}  // namespace obvid
