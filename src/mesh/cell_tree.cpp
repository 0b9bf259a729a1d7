// SPDX-License-Identifier: Apache-2.0
#include "cell_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace obvid::mesh {
namespace {

/// Cells are not cut narrower than 2^-20 of a span: normals of singular points never settle.
constexpr Line kNarrowest = kSpan >> 20;

/// Where to cut in one direction: between spans, then in the middle of the span.
std::optional<Line> middle_of(Line from, Line to) {
  const std::size_t spans = spans_between(from, to);
  if (spans > 1) return ((from >> kFractionBits) + (spans + 1) / 2) << kFractionBits;
  if (to - from < 2 * kNarrowest) return std::nullopt;
  return from + (to - from) / 2;
}

std::optional<std::array<Cell, 2>> halves(const Cell& cell, bool cut_u) {
  std::array<Cell, 2> parts{cell, cell};
  if (cut_u) {
    const auto at = middle_of(cell.u0, cell.u1);
    if (!at) return std::nullopt;
    parts[0].u1 = parts[1].u0 = *at;
  } else {
    const auto at = middle_of(cell.v0, cell.v1);
    if (!at) return std::nullopt;
    parts[0].v1 = parts[1].v0 = *at;
  }
  return parts;
}

std::vector<Line> cuts_of(const std::vector<bool>& edges, Line last) {
  std::vector<Line> cuts{0};
  for (std::size_t k = 1; k < edges.size(); ++k) {
    if (edges[k]) cuts.push_back(static_cast<Line>(k) << kFractionBits);
  }
  cuts.push_back(last);
  return cuts;
}

}  // namespace

CellTree::CellTree(PatchSampler& sampler, const TessellationOptions& options)
    : sampler_(sampler),
      judge_(sampler, options),
      most_(options.most_triangles),
      bend_(2.0 * std::sin(std::min(options.angle, std::numbers::pi) / 2.0)) {}

std::vector<bool> CellTree::edges(bool across_u) const {
  const PatchAxis& axis = across_u ? sampler_.u() : sampler_.v();
  const PatchAxis& along = across_u ? sampler_.v() : sampler_.u();
  std::vector<bool> found(axis.spans(), false);
  const auto normal = [&](const Place& a, const Place& b) {
    return across_u ? sampler_.sample(a, b).normal : sampler_.sample(b, a).normal;
  };
  for (std::size_t k = 1; k < axis.spans(); ++k) {
    if (!axis.may_bend(k)) continue;
    const double t = axis.end(k);
    for (std::size_t m = 0; m < along.spans() && !found[k]; ++m) {
      for (const double part : {0.0, 0.5, 1.0}) {
        const Place b{m, Range{along.end(m), along.end(m + 1)}.at(part)};
        const Vec3 below = normal({k - 1, t}, b), above = normal({k, t}, b);
        found[k] = found[k] || norm(below - above) > bend_;
      }
    }
  }
  return found;
}

Result<void> CellTree::build() {
  edges_u_ = edges(true);
  edges_v_ = edges(false);
  const auto us = cuts_of(edges_u_, sampler_.u().last());
  const auto vs = cuts_of(edges_v_, sampler_.v().last());
  for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
    for (std::size_t i = 0; i + 1 < us.size(); ++i) {
      OBVID_TRY(refine({us[i], us[i + 1], vs[j], vs[j + 1]}));
    }
  }
  return {};
}

Result<void> CellTree::refine(const Cell& cell) {
  waiting_.assign(1, cell);
  while (!waiting_.empty()) {
    Cell next = waiting_.back();
    waiting_.pop_back();
    const CellJudge::Verdict verdict = judge_.judge(next);
    next.rising = verdict.rising;
    auto parts = verdict.good ? std::nullopt : halves(next, verdict.cut_u);
    if (!parts && !verdict.good) parts = halves(next, !verdict.cut_u);
    if (parts) {
      waiting_.push_back((*parts)[1]);
      waiting_.push_back((*parts)[0]);
      continue;
    }
    cells_.push_back(next);
    if (2 * cells_.size() > most_) {
      return error(ErrorCode::kToleranceNotReached,
                   fmt::format("the surface needs more than {} triangles", most_))
          .hint("allow a larger chord tolerance or angle, or more triangles")
          .value(static_cast<double>(most_));
    }
  }
  return {};
}

Result<bool> CellTree::improve(const std::vector<bool>& marked, std::vector<CellSeen>& seen) {
  std::vector<Cell> old;
  std::swap(old, cells_);
  std::vector<CellSeen> kept;
  bool changed = false;
  for (std::size_t k = 0; k < old.size(); ++k) {
    const bool bad = k < marked.size() && marked[k];
    const auto parts = bad && old[k].fan ? halves(old[k], judge_.cut_u(old[k])) : std::nullopt;
    changed = changed || parts || (bad && !old[k].fan);
    if (!parts) {
      cells_.push_back(old[k]);
      cells_.back().fan = old[k].fan || bad;
      kept.push_back(seen[k]);
      continue;
    }
    for (Cell part : *parts) {
      part.fan = false;
      OBVID_TRY(refine(part));
    }
    kept.resize(cells_.size());
  }
  seen = std::move(kept);
  return changed;
}

}  // namespace obvid::mesh
