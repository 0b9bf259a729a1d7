// SPDX-License-Identifier: Apache-2.0
#include "cell_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "obvid/core/internal/parallel.h"
#include "too_many_triangles.h"

namespace obvid::mesh {
namespace {

/// Cells are not cut narrower than 2^-20 of a span: normals of singular points never settle.
constexpr Line kNarrowest = kSpan >> 20;
/// First cells that are grown side by side: enough that threads end at about the same time.
constexpr std::size_t kCellsSharedOut = 64;

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
      options_(options),
      judge_(sampler, options),
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

// The first cells are cut one round after another until there are enough of them to be shared out;
// each is then a tree of its own. Their order is that of one tree.
Result<void> CellTree::build(const RunContext& run) {
  edges_u_ = edges(true);
  edges_v_ = edges(false);
  const auto us = cuts_of(edges_u_, sampler_.u().last());
  const auto vs = cuts_of(edges_v_, sampler_.v().last());
  struct First {
    Cell cell;
    bool whole = false;  ///< it is not cut any more
  };
  std::vector<First> first;
  for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
    for (std::size_t i = 0; i + 1 < us.size(); ++i) {
      first.push_back({{us[i], us[i + 1], vs[j], vs[j + 1]}});
    }
  }
  for (bool all_whole = false; !all_whole && first.size() < kCellsSharedOut;) {
    std::vector<First> next;
    all_whole = true;
    for (First& one : first) {
      const auto parts = one.whole ? std::nullopt : cut(judge_, one.cell);
      all_whole = all_whole && !parts;
      if (parts) {
        next.push_back({(*parts)[0]});
        next.push_back({(*parts)[1]});
      } else {
        next.push_back({one.cell, true});
      }
    }
    first = std::move(next);
  }
  std::vector<std::vector<Cell>> trees(first.size());
  const auto grow = [&](std::size_t k) {
    if (first[k].whole) {
      trees[k].push_back(first[k].cell);
      return;
    }
    PatchSampler sampler = sampler_;  // it and the judge keep what they have at hand
    CellJudge judge(sampler, options_);
    trees[k] = leaves(judge, first[k].cell);
  };
  OBVID_TRY(in_parallel(trees.size(), with_threads(run, options_.threads), grow));
  for (const auto& tree : trees) OBVID_TRY(append(tree));
  return {};
}

std::optional<std::array<Cell, 2>> CellTree::cut(CellJudge& judge, Cell& cell) {
  const CellJudge::Verdict verdict = judge.judge(cell);
  cell.rising = verdict.rising;
  if (verdict.good) return std::nullopt;
  auto parts = halves(cell, verdict.cut_u);
  return parts ? parts : halves(cell, !verdict.cut_u);
}

std::vector<Cell> CellTree::leaves(CellJudge& judge, const Cell& cell) const {
  std::vector<Cell> out, waiting{cell};
  while (!waiting.empty() && 2 * out.size() <= options_.most_triangles) {
    Cell next = waiting.back();
    waiting.pop_back();
    if (const auto parts = cut(judge, next)) {
      waiting.push_back((*parts)[1]);
      waiting.push_back((*parts)[0]);
    } else {
      out.push_back(next);
    }
  }
  return out;
}

Result<void> CellTree::append(const std::vector<Cell>& leaves) {
  cells_.insert(cells_.end(), leaves.begin(), leaves.end());
  if (2 * cells_.size() <= options_.most_triangles) return {};
  return fail(too_many_triangles(options_.most_triangles));
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
      OBVID_TRY(append(leaves(judge_, part)));
    }
    kept.resize(cells_.size());
  }
  seen = std::move(kept);
  return changed;
}

}  // namespace obvid::mesh
